#pragma once
// A vector of three numbers. Eigen's expressions take long to compile, and add in another order than ours.

#include <algorithm>
#include <cmath>

#include "base/fp_rules.h"
#include "base/position.h"

namespace dsw {

/** Zero unless it is given numbers. In the plane z is 0. */
class Vec {
 public:
  constexpr Vec() = default;
  constexpr Vec(double x, double y, double z) : v_{x, y, z} {}
  static constexpr Vec Zero() { return {}; }
  static constexpr Vec Constant(double all) { return {all, all, all}; }
  /** The axis of a number. */
  static constexpr Vec Unit(int axis) { return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0}; }

  double& x() { return v_[0]; }
  double& y() { return v_[1]; }
  double& z() { return v_[2]; }
  double x() const { return v_[0]; }
  double y() const { return v_[1]; }
  double z() const { return v_[2]; }
  double& operator[](int axis) { return v_[axis]; }
  double operator[](int axis) const { return v_[axis]; }
  double* data() { return v_; }
  const double* data() const { return v_; }

  Vec cross(const Vec& b) const {
    return {v_[1] * b.v_[2] - v_[2] * b.v_[1], v_[2] * b.v_[0] - v_[0] * b.v_[2], v_[0] * b.v_[1] - v_[1] * b.v_[0]};
  }
  /** The magnitude of each component. */
  Vec magnitudes() const { return {std::fabs(v_[0]), std::fabs(v_[1]), std::fabs(v_[2])}; }

  friend Vec operator+(const Vec& a, const Vec& b) { return {a.v_[0] + b.v_[0], a.v_[1] + b.v_[1], a.v_[2] + b.v_[2]}; }
  friend Vec operator-(const Vec& a, const Vec& b) { return {a.v_[0] - b.v_[0], a.v_[1] - b.v_[1], a.v_[2] - b.v_[2]}; }
  friend Vec operator*(const Vec& a, double s) { return {a.v_[0] * s, a.v_[1] * s, a.v_[2] * s}; }
  friend Vec operator*(double s, const Vec& a) { return a * s; }
  friend Vec operator/(const Vec& a, double s) { return {a.v_[0] / s, a.v_[1] / s, a.v_[2] / s}; }
  friend bool operator==(const Vec& a, const Vec& b) {
    return a.v_[0] == b.v_[0] && a.v_[1] == b.v_[1] && a.v_[2] == b.v_[2];
  }
  friend bool operator!=(const Vec& a, const Vec& b) { return !(a == b); }
  Vec operator-() const { return {-v_[0], -v_[1], -v_[2]}; }
  Vec& operator+=(const Vec& b) { return *this = *this + b; }
  Vec& operator-=(const Vec& b) { return *this = *this - b; }
  Vec& operator*=(double s) { return *this = *this * s; }
  Vec& operator/=(double s) { return *this = *this / s; }

 private:
  double v_[3] = {0, 0, 0};
};

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
inline double dot(const Vec& a, const Vec& b) { return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z(); }
/** Without a tolerance. */
inline bool is_zero(const Vec& a) { return a.x() == 0 && a.y() == 0 && a.z() == 0; }
template <int D>
inline void store(const Vec& a, double* out) {
  std::copy_n(a.data(), D, out);
}
/** Normal to a vector of the plane, to its right. */
inline Vec turned(const Vec& a) { return {a.y(), 0 - a.x(), 0}; }

/** The largest magnitude of a component. */
inline double largest(const Vec& a) { return std::max({std::fabs(a.x()), std::fabs(a.y()), std::fabs(a.z())}); }

/** The larger number of each component. */
inline Vec larger_of(const Vec& a, const Vec& b) {
  return {std::max(a.x(), b.x()), std::max(a.y(), b.y()), std::max(a.z(), b.z())};
}

/** Length by the largest component first, so that no square over- or underflows. */
inline double length(const Vec& a) {
  const double size = largest(a);
  if (!(size > 0) || !std::isfinite(size)) return size;
  const Vec b = a / size;
  return size * std::sqrt(dot(b, b));
}

/** Length 1; zero if it is zero or not finite. */
inline Vec unit(const Vec& a) {
  const double size = largest(a);
  if (!(size > 0) || !std::isfinite(size)) return Vec::Zero();
  const Vec b = a / size;
  return b / std::sqrt(dot(b, b));
}

}  // namespace dsw
