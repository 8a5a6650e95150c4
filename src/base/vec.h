#pragma once
// Vectors of Eigen, with what Eigen does in another order of operations than ours, or for no plane.
//
// Results have the same bits for any compiler, instruction set and host. So Eigen is told to use no vector
// instructions, which add in another order, and gets a namespace of its own: in a program that is linked to the static
// library and uses Eigen, too, the linker keeps one of two functions of the same name, and that of the host may fuse
// multiplications and additions.
//
// Never `auto` for what Eigen's operators return: it refers to operands that may be gone.

#ifdef EIGEN_CORE_H
#error "base/vec.h comes before any other header that includes Eigen"
#endif
#define EIGEN_DONT_VECTORIZE
#define EIGEN_DONT_PARALLELIZE
#define EIGEN_INITIALIZE_MATRICES_BY_ZERO  // Vec{} is zero
#define EIGEN_MPL2_ONLY
#define EIGEN_NO_MALLOC  // memory is the context's
#define Eigen dsw_eigen
#include <Eigen/Geometry>
#undef Eigen

#include <algorithm>
#include <cmath>

#include "base/fp_rules.h"
#include "base/position.h"

namespace dsw {

namespace Eigen = ::dsw_eigen;

/** In the plane z is 0. */
using Vec = Eigen::Vector3d;

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
/** Not a.dot(b), which is x + (y + z). */
inline double dot(const Vec& a, const Vec& b) { return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z(); }
/** Exactly; a.isZero() has a tolerance. */
inline bool is_zero(const Vec& a) { return a.x() == 0 && a.y() == 0 && a.z() == 0; }
template <int D>
inline void store(const Vec& a, double* out) {
  std::copy_n(a.data(), D, out);
}
/** Normal to a vector of the plane, to its right. */
inline Vec turned(const Vec& a) { return {a.y(), 0 - a.x(), 0}; }

/** The largest magnitude of a component. */
inline double largest(const Vec& a) { return std::max({std::fabs(a.x()), std::fabs(a.y()), std::fabs(a.z())}); }

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
