#pragma once
// Line tests of many points of the plane against one line, without a branch on what a filter says: its bound over all
// of them is asked once, at the end.

#include <algorithm>

#include "predicates/filtered.h"
#include "walk/facet_rows.h"

namespace dsw {

class LineSides {
 public:
  /** The line from p, which must outlive this, to q. */
  LineSides(const double* p, const double* q) noexcept
      : p_(p), way_(filter::difference<2>(q, p)), extent_(filter::extent(way_)) {}

  /** Positive on the left; rounded. */
  double side(const double* x) noexcept {
    const filter::Vec<2> a = filter::difference<2>(x, p_), size = filter::extent(a);
    extent_ = {filter::larger(extent_.x, size.x), filter::larger(extent_.y, size.y)};
    return way_.x * a.y - way_.y * a.x;
  }
  /** Whether the line leaves a polygon through its side from a to b, as far as rounded tests tell: they are on its
   * right and left. */
  bool pass(const double* a, const double* b) noexcept {
    const double least = filter::smaller(-side(a), side(b));
    lowest_ = filter::smaller(lowest_, least);
    return least > 0;
  }
  /** Tests at most 64 sides. Bit n is set if side n is not passed; such a side does not count in `passed_all`. */
  uint64_t missed(const FacetSpan<2>& sides) noexcept {
    const double *const ax = sides.row(0, 0), *const ay = sides.row(0, 1), *const bx = sides.row(1, 0),
                        *const by = sides.row(1, 1);
    uint64_t missed = 0;
    for (size_t n = 0; n < sides.size(); ++n) {
      const double a[2] = {ax[n], ay[n]}, b[2] = {bx[n], by[n]}, lowest = lowest_;
      if (pass(a, b)) continue;
      missed |= uint64_t{1} << n;
      lowest_ = lowest;
    }
    return missed;
  }
  /** Whether the line certainly leaves through every side that was asked. */
  bool passed_all() const noexcept { return lowest_ > 0 && filter::certain(lowest_, extent_); }

 private:
  const double* p_;
  filter::Vec<2> way_, extent_;
  double lowest_ = 1e300;
};

}  // namespace dsw
