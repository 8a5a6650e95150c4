#pragma once
// What doubles tell of distances for certain. All products are compared with room of 2^-40 of the largest terms in them.
// That is thousands of their rounding errors. Where squares are so small or large that products might under- or
// overflow, nothing is certain.

#include "base/vec.h"

namespace dsw::rough {

constexpr double kRoom = 0x1p-40;
inline bool is_usual(double square) noexcept { return square >= 0x1p-300 && square <= 0x1p+200; }

/** Whether a point is farther away than `beyond`. w leads to it. */
inline bool is_far_from_point(const Vec& w, double beyond) noexcept {
  const double ww = dot(w, w);
  return is_usual(ww) && ww * (1 - kRoom) > beyond * beyond;
}

// Products of lengths are bounded by their squares: 2 |u| |w| is not more than u.u + w.w. So few square roots are needed.

/** Whether the foot of w on edge u lies outside by more than `outside`, or w is farther away than `beyond`. */
inline bool is_far_from_edge(const Vec& u, const Vec& w, double beyond, double outside) noexcept {
  const double uu = dot(u, u), uw = dot(u, w), ww = dot(w, w);
  if (!is_usual(uu) || !is_usual(ww)) return false;
  const double room = kRoom * (uu + ww), more = outside > 0 ? outside * std::sqrt(uu) * (1 + kRoom) : 0;
  return (uw < -room - more) | (uw > uu + room + more) | (ww * uu - uw * uw - room * uu > beyond * beyond * uu);
}

/** Whether w is farther than `beyond` from a plane with the normal u x v. `uv` and `ww` are not less than the squares of
 * |u| |v| and |w|. */
inline bool is_far_from_plane(const Vec& normal, const Vec& w, double uv, double ww, double beyond) noexcept {
  const double height = dot(normal, w);
  return height * height - kRoom * uv * ww > beyond * beyond * (dot(normal, normal) + kRoom * uv);
}

/** A triangle from its first corner. */
class Triangle {
 public:
  Triangle(const Vec& to_second, const Vec& to_third) noexcept
      : u_(to_second), v_(to_third), uu_(dot(u_, u_)), uv_(dot(u_, v_)), vv_(dot(v_, v_)) {}

  /** Whether the foot of w lies outside by more than `outside`, or w is farther away than `beyond`. */
  bool is_far(const Vec& w, double beyond, double outside) const noexcept {
    const double ww = dot(w, w), size = uu_ + vv_;  // not less than any of the squares
    if (!is_usual(size) || !is_usual(ww)) return false;
    // Shares of the corners, times the square of twice the area. Times a side, too, they are distances from the sides.
    const double uw = dot(u_, w), vw = dot(v_, w), room = kRoom * size * (size + ww);
    const double s = vv_ * uw - uv_ * vw, t = uu_ * vw - uv_ * uw, rest = uu_ * vv_ - uv_ * uv_ - s - t;
    double to_s = 0, to_t = 0, to_rest = 0;
    const Vec normal = u_.cross(v_);
    if (outside > 0) {
      const double more = outside * std::sqrt(dot(normal, normal) + kRoom * size * size) * (1 + kRoom);
      to_s = more * std::sqrt(vv_);
      to_t = more * std::sqrt(uu_);
      to_rest = more * std::sqrt(uu_ - 2 * uv_ + vv_ + kRoom * size);
    }
    return (s < -room - to_s) | (t < -room - to_t) | (rest < -4 * room - to_rest) |
           is_far_from_plane(normal, w, size * size, ww, beyond);
  }

 private:
  Vec u_, v_;
  double uu_, uv_, vv_;
};

/** Whether the nearest points of the lines through edges d and u lie outside, or the lines are farther apart than
 * `beyond`. w leads from the start of u to that of d. */
inline bool are_far_lines(const Vec& d, const Vec& u, const Vec& w, double beyond) noexcept {
  const double dd = dot(d, d), uu = dot(u, u), ww = dot(w, w);
  if (!is_usual(dd) || !is_usual(uu) || !is_usual(ww)) return false;
  const double du = dot(d, u), dw = dot(d, w), uw = dot(u, w), both = dd * uu;
  const double s = uw * du - dw * uu, t = uw * dd - dw * du, all = both - du * du, room = kRoom * both;
  const double room_s = kRoom * uu * (dd + ww), room_t = kRoom * dd * (uu + ww);
  return (s < -room_s) | (s > all + room + room_s) | (t < -room_t) | (t > all + room + room_t) ||
         is_far_from_plane(d.cross(u), w, both, ww, beyond);
}

/** Whether the edges themselves are farther apart than `beyond`: a plane across the way between points that are nearly
 * the nearest ones has them that far on either side. */
inline bool are_far_edges(const Vec& d, const Vec& u, const Vec& w, double beyond) noexcept {
  const double dd = dot(d, d), uu = dot(u, u), ww = dot(w, w);
  if (!is_usual(dd) || !is_usual(uu) || !is_usual(ww)) return false;
  const auto share = [](double x) { return x > 0 ? x < 1 ? x : 1 : 0; };
  const double du = dot(d, u), dw = dot(d, w), uw = dot(u, w), all = dd * uu - du * du;
  const double t = share((uw + du * (all > 0 ? share((uw * du - dw * uu) / all) : 0)) / uu),
               s = share((t * du - dw) / dd);
  const Vec way = w + s * d - t * u;
  const double at_start = dot(way, w), along = dot(way, d), across = dot(way, u);
  const double apart = at_start + (along < 0 ? along : 0) - (across > 0 ? across : 0);
  const double size = std::sqrt(dot(way, way));
  return apart - kRoom * size * (std::sqrt(ww) + std::sqrt(dd) + std::sqrt(uu)) > beyond * size * (1 + kRoom);
}

}  // namespace dsw::rough
