// Vectors of three doubles.
#ifndef DARTSWEEP_TESTS_BENCHMARK_VECTOR_H
#define DARTSWEEP_TESTS_BENCHMARK_VECTOR_H

#include <array>

namespace dsw::bench {

using Vector = std::array<double, 3>;

inline Vector minus(const double* a, const double* b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace dsw::bench

#endif
