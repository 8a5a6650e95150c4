#pragma once
// Line tests of many edges against one line, by a shear along the line onto the plane of two axes: with d = q - p, its longest
// component d_k and A' = A - (A_k / d_k) d, d.(A x B) = d_k (A'_i B'_j - A'_j B'_i).
// With u the unit roundoff and M over the components of all A: A is off by uM, the ratio of two components of d by 4u, A' by 9uM with
// |A'| <= 2M, and the two products and their difference by (72 + 16)uM^2.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "motion/triangle_rows.h"

namespace dsw {

class Shear {
 public:
  /** The line from p, which must outlive this, to q. */
  Shear(const double* p, const double* q) noexcept : p_(p) {
    double d[3];
    for (int k = 0; k < 3; ++k) d[k] = q[k] - p[k];
    k_ = std::fabs(d[1]) > std::fabs(d[0]) ? 1 : 0;
    if (std::fabs(d[2]) > std::fabs(d[k_])) k_ = 2;
    turned_ = d[k_] < 0;
    i_ = (k_ + (turned_ ? 2 : 1)) % 3;  // so that d_k counts as positive
    j_ = (k_ + (turned_ ? 1 : 2)) % 3;
    slope_i_ = d[i_] / d[k_];
    slope_j_ = d[j_] / d[k_];
    largest_ = std::fabs(d[k_]);
  }

  struct Point {
    double i, j;
  };
  Point operator()(const double* x) noexcept {
    const double a = x[i_] - p_[i_], b = x[j_] - p_[j_], c = x[k_] - p_[k_];
    largest_ = std::max(largest_, std::max(std::max(std::fabs(a), std::fabs(b)), std::fabs(c)));
    return {a - slope_i_ * c, b - slope_j_ * c};
  }
  static double side(const Point& a, const Point& b) noexcept { return a.i * b.j - a.j * b.i; }
  /** The line leaves a facet whose boundary goes from a to b, counter-clockwise seen from outside, if this is positive for all. */
  void pass(const Point& a, const Point& b) noexcept { lowest_ = std::min(lowest_, side(a, b)); }

  /** Of all tests, and of all components of points. */
  double lowest() const noexcept { return lowest_; }
  double largest() const noexcept { return largest_; }

  bool passed_all() const noexcept {
    // A line of no length has no slope.
    return !std::isnan(slope_i_) && largest_ > kLeast && largest_ < kMost && lowest_ > kBound * largest_ * largest_;
  }

 private:
  static constexpr double kBound = 128 * 1.1102230246251565e-16;
  static constexpr double kLeast = 1e-120, kMost = 1e120;  // of M: squares stay normal
  template <class Lanes>
  friend class ShearLanes;

  const double* p_;
  int i_, j_, k_;
  bool turned_;
  double slope_i_, slope_j_, largest_, lowest_ = 1e300;
};

/** Passes triangles until one is not passed; returns how many were, all or up to that one. As far as rounded tests tell: ask `passed_all`
 * too. Several instruction sets, the same number, and the same bits if all were passed. */
using PassTriangles = size_t (*)(Shear& shear, const TriangleRows& triangles) noexcept;
size_t pass_triangles(Shear& shear, const TriangleRows& triangles) noexcept;
#if defined(__x86_64__)
size_t pass_triangles_avx2(Shear& shear, const TriangleRows& triangles) noexcept;
size_t pass_triangles_avx512(Shear& shear, const TriangleRows& triangles) noexcept;
#endif
PassTriangles choose_pass_triangles() noexcept;

}  // namespace dsw
