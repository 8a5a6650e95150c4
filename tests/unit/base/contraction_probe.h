// Products and sums compiled with the engine's options, and with fused instructions where the processor has them.
#pragma once

#include <cstddef>

namespace contraction {

double product_plus(double a, double b, double c) noexcept;
double product_minus(double a, double b, double c) noexcept;
double minus_product(double a, double b, double c) noexcept;  // c - a * b
double dot(const double* a, const double* b) noexcept;        // of two components
/** c[i] += a[i] * b[i], which compilers make vectors of. */
void add_products(const double* a, const double* b, double* c, std::size_t count) noexcept;

}  // namespace contraction
