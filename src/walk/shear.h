#pragma once
// Line tests of many edges against one line, by a shear along the line onto the plane of two axes: with d = q - p, its
// longest component d_k and A' = A - (A_k / d_k) d, d.(A x B) = d_k (A'_i B'_j - A'_j B'_i). With u the unit roundoff
// and M over the components of all A: A is off by uM, the ratio of two components of d by 4u, A' by 9uM with
// |A'| <= 2M, and the two products and their difference by (72 + 16)uM^2.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/compiler.h"
#include "base/fp_rules.h"
#include "walk/facet_rows.h"

namespace dsw {

class Shear {
 public:
  /** No line. */
  Shear() noexcept : p_(nullptr), i_(0), j_(0), k_(0), turned_(false), slopes_{NAN, NAN}, largest_(0) {}
  /** The line from p, which must outlive this, to q. */
  Shear(const double* p, const double* q) noexcept : p_(p) {
    double d[3];
    for (int k = 0; k < 3; ++k) d[k] = q[k] - p[k];
    // Without a branch: nobody can predict directions.
    const double x = std::fabs(d[0]), y = std::fabs(d[1]), z = std::fabs(d[2]);
    const int y_longer = y > x, z_longest = z > (y > x ? y : x);
    k_ = 2 * z_longest + (1 - z_longest) * y_longer;
    const int turned = d[k_] < 0;
    turned_ = turned != 0;
    i_ = kTurn[k_ + 1 + turned];  // so that d_k counts as positive
    j_ = kTurn[k_ + 2 - turned];
    slopes_[0] = d[i_] / d[k_];
    slopes_[1] = d[j_] / d[k_];
    largest_ = std::fabs(d[k_]);
  }

  struct Point {
    double i, j;
  };
  Point operator()(const double* x) noexcept {
    const double a = x[i_] - p_[i_], b = x[j_] - p_[j_], c = x[k_] - p_[k_];
    largest_ = std::max(largest_, std::max(std::max(std::fabs(a), std::fabs(b)), std::fabs(c)));
    return {a - slopes_[0] * c, b - slopes_[1] * c};
  }
  static double side(const Point& a, const Point& b) noexcept { return a.i * b.j - a.j * b.i; }
  /** The line leaves a facet whose boundary goes from a to b, counter-clockwise seen from outside, if this is positive
   * for all. */
  void pass(const Point& a, const Point& b) noexcept { lowest_ = std::min(lowest_, side(a, b)); }

  /** The lowest side of all tests, and the largest component of all points. */
  double lowest() const noexcept { return lowest_; }
  double largest() const noexcept { return largest_; }

  /** Whether bound() holds. A line of no length has no slope. */
  bool is_in_range(double largest) const noexcept {
    return !std::isnan(slopes_[0]) && largest > kLeast && largest < kMost;
  }
  /** Sides beyond it have the sign of the true ones. */
  static double bound(double largest) noexcept { return kBound * largest * largest; }
  bool passed_all() const noexcept { return is_in_range(largest_) && lowest_ > bound(largest_); }

  const double* from() const noexcept { return p_; }
  int i() const noexcept { return i_; }
  int j() const noexcept { return j_; }
  int k() const noexcept { return k_; }
  /** Whether the line goes down the axis k. */
  bool turned() const noexcept { return turned_; }
  /** The axes i, j and k by their order: 0 1 2 is order 4. */
  int order() const noexcept { return 2 * k_ + (turned_ ? 1 : 0); }
  /** The slopes along i and j, one after the other. */
  const double* slopes() const noexcept { return slopes_; }

 private:
  static constexpr int kTurn[5] = {0, 1, 2, 0, 1};
  static constexpr double kBound = 128 * 1.1102230246251565e-16;
  static constexpr double kLeast = 1e-120, kMost = 1e120;  // of M: squares stay normal
  template <class Lanes>
  friend class ShearLanes;

  const double* p_;
  int i_, j_, k_;
  bool turned_;
  double slopes_[2], largest_, lowest_ = 1e300;
};

/** Tests at most kMostMissed triangles. Bit n is set if triangle n is not passed. `passed_all` then says whether the
 * others are passed for certain. Several instruction sets, the same bits where the line is in range. */
using MissedTriangles = uint64_t (*)(Shear& shear, const FacetSpan<3>& triangles) noexcept;
uint64_t missed_triangles(Shear& shear, const FacetSpan<3>& triangles) noexcept;
#if DSW_X86_64
uint64_t missed_triangles_avx2(Shear& shear, const FacetSpan<3>& triangles) noexcept;
uint64_t missed_triangles_avx512(Shear& shear, const FacetSpan<3>& triangles) noexcept;
#endif
extern const MissedTriangles kMissedTriangles;  // the most that the processor has, or DARTSWEEP_KERNEL leaves
constexpr size_t kMostMissed = 64;

/** Whether the line from one point to another passes any number of triangles for certain. Several instruction sets, the
 * same answers. */
using PassesTriangles = bool (*)(const double* from, const double* to, const FacetSpan<3>& triangles) noexcept;
bool passes_triangles(const double* from, const double* to, const FacetSpan<3>& triangles) noexcept;
#if DSW_X86_64
bool passes_triangles_avx2(const double* from, const double* to, const FacetSpan<3>& triangles) noexcept;
bool passes_triangles_avx512(const double* from, const double* to, const FacetSpan<3>& triangles) noexcept;
#endif
extern const PassesTriangles kPassesTriangles;  // likewise

}  // namespace dsw
