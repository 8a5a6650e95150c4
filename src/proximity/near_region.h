#pragma once
// What can be within a distance of simplices of a body: a box along the first one, which is a little too large.

#include <algorithm>
#include <cstdint>

#include "base/vec.h"

namespace dsw {

template <int D>
class NearRegion {
 public:
  /** All that is within `reach` of the simplex of these points. */
  NearRegion(const double* const* points, uint32_t count, double reach) noexcept : origin_(to_vec<D>(points[0])) {
    set_axes(points, count);
    reach += 0x1p-48 * reach;
    for (int k = 0; k < D; ++k) {
      lower_[k] = -reach;
      upper_[k] = reach;
    }
    reach_ = reach;
    for (uint32_t i = 1; i < count; ++i) add(points[i]);
  }

  /** All that is within reach of a point, too, and what lies between. */
  void add(const double* point) noexcept {
    const Vec at = to_vec<D>(point) - origin_;
    const double error = error_of(at);
    for (int k = 0; k < D; ++k) {
      const double x = dot(axes_[k], at);
      lower_[k] = std::min(lower_[k], x - error - reach_);
      upper_[k] = std::max(upper_[k], x + error + reach_);
    }
  }
  /** Extends the region by all that is within reach of this axis-parallel box. */
  void add_box(const double* low, const double* high) noexcept {
    const Vec first = to_vec<D>(low) - origin_, last = to_vec<D>(high) - origin_;
    const double error = error_of(first) + error_of(last);
    for (int k = 0; k < D; ++k) {
      double least = 0, most = 0;
      for (int j = 0; j < D; ++j) {
        const double a = axes_[k][j] * first[j], b = axes_[k][j] * last[j];
        least += std::min(a, b);
        most += std::max(a, b);
      }
      lower_[k] = std::min(lower_[k], least - error - reach_);
      upper_[k] = std::max(upper_[k], most + error + reach_);
    }
  }
  /** In the plane its area. Rounded. */
  double volume() const noexcept {
    double product = 1;
    for (int k = 0; k < D; ++k) product *= upper_[k] - lower_[k];
    return product;
  }

  /** Beyond which sides of the box a point is: a bit for each. A polytope may be in the region unless its corners have
   * a bit in common. No bits, if the differences overflow.
   * @param among the bits that are of interest: axes without one of them are not looked at */
  uint32_t outside(const double* point, uint32_t among = ~0u) const noexcept {
    const Vec at = to_vec<D>(point) - origin_;
    const double error = error_of(at);
    uint32_t bits = 0;
    for (int k = 0; k < D; ++k) {
      if ((among >> 2 * k & 3) == 0) continue;
      const double x = dot(axes_[k], at);
      bits |= static_cast<uint32_t>(x - error > upper_[k]) << 2 * k;
      bits |= static_cast<uint32_t>(x + error < lower_[k]) << (2 * k + 1);
    }
    return bits & among;
  }

 private:
  /** The error of a coordinate of a point. The axes have length 1 up to 4 roundings. A difference loses one, and each
   * of three products and two sums one more. So 2^-48 of the sum of the differences is enough, and pays for what the
   * box itself loses. */
  static double error_of(const Vec& at) noexcept {
    return 0x1p-48 * (std::fabs(at.x()) + std::fabs(at.y()) + std::fabs(at.z())) + 0x1p-1070;
  }
  /** Along the simplex where that can be told. Any axes of length 1 are right: none measures more than the distance. */
  void set_axes(const double* const* points, uint32_t count) noexcept {
    Vec along = count > 1 ? unit(difference<D>(points[1], points[0])) : Vec::Zero();
    if (is_zero(along)) along = Vec(1, 0, 0);
    Vec up = D == 2 ? turned(along) : Vec::Zero();
    if (D == 3 && count > 2) up = unit(along.cross(unit(difference<D>(points[2], points[0]))));
    if (is_zero(up)) {
      // The axis that is most across.
      const Vec sizes = along.magnitudes();
      Vec other = Vec::Zero();
      other[sizes.x() <= sizes.y() && sizes.x() <= sizes.z() ? 0 : sizes.y() <= sizes.z() ? 1 : 2] = 1;
      up = unit(along.cross(other));
    }
    axes_[0] = along;
    axes_[1] = up;
    axes_[2] = unit(along.cross(up));
  }

  Vec origin_;
  Vec axes_[3];  // the first D
  double reach_;
  double lower_[D], upper_[D];
};

}  // namespace dsw
