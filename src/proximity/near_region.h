#pragma once
// What can be within a distance of a vertex, an edge or a face: a box along the simplex, which is a little too large.

#include "base/vec.h"

namespace dsw {

/** Places in the axes of a region: from lower to upper. */
struct Extent {
  double lower[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double upper[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(const Extent& other) noexcept {
    for (int k = 0; k < 3; ++k) {
      lower[k] = other.lower[k] < lower[k] ? other.lower[k] : lower[k];
      upper[k] = upper[k] < other.upper[k] ? other.upper[k] : upper[k];
    }
  }
};

template <int D>
class NearRegion {
 public:
  /** All that is within `reach` of the simplex of these points. */
  NearRegion(const double* const* points, uint32_t count, double reach) noexcept : origin_(to_vec<D>(points[0])) {
    set_axes(points, count);
    for (uint32_t i = 0; i < count; ++i) all_.add(extent_of(points[i]));
    reach += 0x1p-48 * reach;
    for (int k = 0; k < 3; ++k) {
      all_.lower[k] -= reach;
      all_.upper[k] += reach;
    }
  }

  /** Where a point is, with its rounding error. The axes have length 1 up to 4 roundings. A difference loses one, and
   * each of three products and two sums one more. So 2^-48 of the sum of the differences is enough, and pays for what
   * the box itself loses. Everywhere, if the differences overflow. */
  Extent extent_of(const double* point) const noexcept {
    const Vec at = to_vec<D>(point) - origin_;
    const double error = 0x1p-48 * (std::fabs(at.x()) + std::fabs(at.y()) + std::fabs(at.z())) + 0x1p-1070;
    Extent e;
    for (int k = 0; k < 3; ++k) {
      const double x = error < HUGE_VAL ? dot(axes_[k], at) : 0;
      e.lower[k] = x - error;
      e.upper[k] = x + error;
    }
    return e;
  }
  /** Whether something with this extent may be within reach. */
  bool may_hold(const Extent& e) const noexcept {
    bool apart = false;
    for (int k = 0; k < 3; ++k) apart |= (e.lower[k] > all_.upper[k]) | (e.upper[k] < all_.lower[k]);
    return !apart;
  }

 private:
  /** Along the simplex where that can be told. Any axes of length 1 are right: none measures more than the distance. */
  void set_axes(const double* const* points, uint32_t count) noexcept {
    Vec along = count > 1 ? unit(difference<D>(points[1], points[0])) : Vec::Zero();
    if (is_zero(along)) along = Vec(1, 0, 0);
    Vec up = count > 2 ? unit(along.cross(unit(difference<D>(points[2], points[0])))) : Vec::Zero();
    if (D == 2) up = Vec(0, 0, 1);
    if (is_zero(up)) {
      // The axis that is most across.
      const Vec sizes = along.cwiseAbs();
      Vec other = Vec::Zero();
      other[sizes.x() <= sizes.y() && sizes.x() <= sizes.z() ? 0 : sizes.y() <= sizes.z() ? 1 : 2] = 1;
      up = unit(along.cross(other));
    }
    axes_[0] = along;
    axes_[1] = up;
    axes_[2] = unit(along.cross(up));
  }

  Vec origin_;
  Vec axes_[3];
  Extent all_;
};

}  // namespace dsw
