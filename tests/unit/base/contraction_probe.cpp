#include "contraction_probe.h"

namespace contraction {

double product_plus(double a, double b, double c) noexcept { return a * b + c; }
double product_minus(double a, double b, double c) noexcept { return a * b - c; }
double minus_product(double a, double b, double c) noexcept { return c - a * b; }
double dot(const double* a, const double* b) noexcept { return a[0] * b[0] + a[1] * b[1]; }
void add_products(const double* a, const double* b, double* c, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) c[i] += a[i] * b[i];
}

}  // namespace contraction
