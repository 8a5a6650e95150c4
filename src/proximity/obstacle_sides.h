#pragma once
// Directions in which an obstacle ends, to tell by a few products that something does not come to it.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/vec.h"

namespace dsw {

/** A triangle, a segment or a point, seen along the axes, along its normal and along those of its sides. If all corners of
 * something convex lie beyond one end, it is apart from the obstacle. Any direction is right, so directions may be rounded. */
template <int D>
class ObstacleSides {
 public:
  /** Bits of ends. kInside: before side k of a triangle, so apart from that side and its corners. */
  static constexpr uint32_t kApart = (1u << 11) - 1, kInside = 1u << 11;

  ObstacleSides(const double* const* points, uint32_t count) noexcept : origin_(to_vec<D>(points[0])) {
    for (int k = 0; k < D; ++k) {
      lower_[k] = upper_[k] = points[0][k];
      for (uint32_t i = 1; i < count; ++i) {
        lower_[k] = std::min(lower_[k], points[i][k]);
        upper_[k] = std::max(upper_[k], points[i][k]);
      }
      extent_ += upper_[k] - lower_[k];
    }
    if (count != D) return;
    if constexpr (D == 2) {
      const Vec along = difference<D>(points[1], points[0]), corners[2] = {Vec::Zero(), along};
      add(corners, turned(unit(along)));
    } else {
      const Vec corners[3] = {Vec::Zero(), difference<D>(points[1], points[0]), difference<D>(points[2], points[0])};
      const double size = std::max(largest(corners[1]), largest(corners[2]));
      if (!(size >= kLeast && size <= 1 / kLeast)) return;
      const double scale = 1 / size;
      const Vec first = direction(scale * corners[1]), last = direction(-scale * corners[2]);
      const Vec normal = direction(last.cross(first));
      add(corners, normal);
      add(corners, first.cross(normal));
      add(corners, direction(scale * (corners[2] - corners[1])).cross(normal));
      add(corners, last.cross(normal));
    }
  }

  /** With bits of something convex, whether it is apart from side k of the triangle, or from corner k. */
  static bool misses_side(uint32_t beyond, uint32_t k) noexcept { return (beyond & (kApart | kInside << k)) != 0; }
  static bool misses_corner(uint32_t beyond, uint32_t k) noexcept {
    return misses_side(beyond, k) || misses_side(beyond, (k + 2) % 3);
  }

  /** Beyond which ends all points are that are within `room` of a point. */
  DSW_HOT uint32_t beyond(const double* point, double room) const noexcept {
    uint32_t bits = 0;
    double size = extent_;
    Vec at = Vec::Zero();
    for (int k = 0; k < D; ++k) {
      at[k] = point[k] - origin_[k];
      size += std::fabs(at[k]);
    }
    // Differences, products and sums lose less than 2^-48 of these lengths, and directions are not longer than 1 + 2^-48.
    const double margin = room * (1 + 0x1p-20) + 0x1p-44 * size + 0x1p-1000;
    for (int k = 0; k < D; ++k) {
      const double error = margin + 0x1p-50 * std::fabs(point[k]);
      bits |= static_cast<uint32_t>(point[k] + error < lower_[k]) << 2 * k;
      bits |= static_cast<uint32_t>(point[k] - error > upper_[k]) << (2 * k + 1);
    }
    for (int i = 0; i < kMost && i < count_; ++i) {
      const Direction& d = directions_[i];
      const double along = dot(d.normal, at);
      if (D == 2 || i == 0) {
        bits |= static_cast<uint32_t>(along + margin < d.low) << 6 | static_cast<uint32_t>(along - margin > d.high)
                                                                         << 7;
      } else {
        bits |= static_cast<uint32_t>(along - margin > d.high) << (7 + i);
        bits |= static_cast<uint32_t>(along + margin < d.side) << (10 + i);
      }
    }
    return bits;
  }

 private:
  static constexpr int kMost = D == 3 ? 4 : 1;
  struct Direction {
    Vec normal;
    double low, high, side;  // side: the least of the two ends of the side
  };

  static constexpr double kLeast = 0x1p-300;

  /** Length 1, of a vector of at most about this length. Zero if it is much shorter: nothing lies beyond such a direction. */
  static Vec direction(const Vec& a) noexcept {
    const double square = dot(a, a);
    return square >= kLeast ? (1 / std::sqrt(square)) * a : Vec::Zero();
  }

  /** @param corners less the first one. */
  void add(const Vec* corners, const Vec& normal) noexcept {
    Direction& d = directions_[count_];
    d.normal = normal;
    double at[D] = {};
    for (int i = 1; i < D; ++i) at[i] = dot(normal, corners[i]);
    d.low = *std::min_element(at, at + D);
    d.high = *std::max_element(at, at + D);
    d.side = count_ == 0 ? 0 : std::min(at[(count_ - 1) % D], at[count_ % D]);
    ++count_;
  }

  Vec origin_;
  double lower_[D], upper_[D], extent_ = 0;
  Direction directions_[kMost];
  int count_ = 0;
};

}  // namespace dsw
