#pragma once
// Spheres round simplices, which sort out by few operations what is far away.

#include "base/vec.h"

namespace dsw {

/** A sphere round a simplex, up to a share of 2^-50 of its radius. */
template <int D>
struct Sphere {
  double centre[D];
  double radius;

  Sphere(const double* const* points, uint32_t count) noexcept {
    for (int k = 0; k < D; ++k) {
      centre[k] = 0;
      for (uint32_t i = 0; i < count; ++i) centre[k] += points[i][k] / count;
    }
    double largest = 0;
    for (uint32_t i = 0; i < count; ++i) {
      const Vec to = difference<D>(points[i], centre);
      largest = dot(to, to) > largest ? dot(to, to) : largest;
    }
    radius = std::sqrt(largest);
  }
};

/** Room for thousands of rounding errors of squares, and for squares that underflow. */
inline double room_of(double squares) noexcept { return 0x1p-40 * squares + 0x1p-900; }

/** Whether two spheres certainly leave more than `reach` between each other. */
template <int D>
bool are_apart(const Sphere<D>& a, const Sphere<D>& b, double reach) noexcept {
  const Vec way = difference<D>(a.centre, b.centre);
  const double square = dot(way, way), beyond = a.radius + b.radius + reach;
  return square > beyond * beyond + room_of(square);
}

/** All that is within a distance of an edge, which may be a point. */
template <int D>
class Capsule {
 public:
  Capsule(const double* from, const double* to) noexcept
      : from_(to_vec<D>(from)), along_(difference<D>(to, from)), square_(dot(along_, along_)) {}

  /** Whether a sphere certainly leaves more than `reach` between itself and the edge. */
  bool is_beyond(const Sphere<D>& sphere, double reach) const noexcept {
    const Vec w = to_vec<D>(sphere.centre) - from_;
    const double ww = dot(w, w), at = dot(w, along_), beyond = reach + sphere.radius;
    const double most = beyond * beyond + room_of(ww + square_);
    if (at <= 0) return ww > most;
    if (at >= square_) return ww - 2 * at + square_ > most;
    return ww - at * (at / square_) > most;
  }

 private:
  Vec from_, along_;
  double square_;
};

}  // namespace dsw
