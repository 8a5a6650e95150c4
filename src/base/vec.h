#pragma once
// A few lines of vector algebra in a fixed order of operations, so that results have the same bits everywhere.

#include <algorithm>
#include <cmath>

namespace dsw {

/** In the plane z is 0. */
struct Vec {
  double x = 0, y = 0, z = 0;
};

inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, const Vec& a) { return {a.x * s, a.y * s, a.z * s}; }

template <int D>
inline Vec to_vec(const double* a) {
  if constexpr (D == 2) {
    return {a[0], a[1], 0};
  } else {
    return {a[0], a[1], a[2]};
  }
}
template <int D>
inline Vec difference(const double* a, const double* b) {
  return to_vec<D>(a) - to_vec<D>(b);
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double dot(const Vec& a, const Vec& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
/** To compare with others; overflows to infinity, which compares as it should. */
template <int D>
inline double distance_squared(const double* a, const double* b) {
  const Vec d = difference<D>(a, b);
  return dot(d, d);
}
inline bool is_zero(const Vec& a) { return a.x == 0 && a.y == 0 && a.z == 0; }
template <int D>
inline void store(const Vec& a, double* out) {
  out[0] = a.x;
  out[1] = a.y;
  if constexpr (D == 3) out[2] = a.z;
}
/** Normal to a vector of the plane, to its right. */
inline Vec turned(const Vec& a) { return {a.y, 0 - a.x, 0}; }

/** Length by the largest component first, so that no square over- or underflows. */
inline double length(const Vec& a) {
  const double largest = std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return largest;
  const Vec b{a.x / largest, a.y / largest, a.z / largest};
  return largest * std::sqrt(dot(b, b));
}

/** Length 1; zero if it is zero or not finite. */
inline Vec unit(const Vec& a) {
  const double largest = std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  const Vec b{a.x / largest, a.y / largest, a.z / largest};
  const double size = std::sqrt(dot(b, b));
  return {b.x / size, b.y / size, b.z / size};
}

/** p + time * (q - p), rounded; also where q - p is too large for a double. `out` may be p or q. */
template <int D>
inline void point_at(const double* p, const double* q, double time, double* out) noexcept {
  for (int k = 0; k < D; ++k) {
    const double step = q[k] - p[k];
    out[k] = std::isfinite(step) ? p[k] + time * step : (1 - time) * p[k] + time * q[k];
  }
}

}  // namespace dsw
