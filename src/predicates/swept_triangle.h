// The triangle that an edge sweeps against many points and lines of the environment: what depends on it alone is
// computed once. Filters as in filter_bounds.h, whose proof lets any row of a determinant come first; then exact.h.
#pragma once

#include <cstdint>

#include "predicates/filtered.h"
#include "predicates/point_box.h"
#include "predicates/sweep_events.h"
#include "predicates/tally.h"

namespace dsw {

class SweptTriangle {
 public:
  explicit SweptTriangle(const EdgeMotion& m) noexcept
      : m_(m),
        move_(filter::difference<3>(m.to, m.p)),
        old_(filter::difference<3>(m.q, m.p)),
        new_(filter::difference<3>(m.q, m.to)),
        normal_(filter::cross(move_, old_)),
        reach_(filter::extent(move_, old_)),
        box_(m.p, m.to, m.q) {}

  const EdgeMotion& motion() const noexcept { return m_; }

  // Rounded: p' - p, q - p and q - p', the product of the first two, and what these reach along each axis.
  const filter::Vec<3>& move() const noexcept { return move_; }
  const filter::Vec<3>& old_edge() const noexcept { return old_; }
  const filter::Vec<3>& new_edge() const noexcept { return new_; }
  const filter::Vec<3>& normal() const noexcept { return normal_; }
  const filter::Vec<3>& reach() const noexcept { return reach_; }

  // Bits of the sides of its box that v lies beyond, see PointBox.
  std::uint32_t beyond_box(const double* v) const noexcept { return box_.beyond(v); }

  // Tells the side of v as swept_side does.
  int side(const double* v) const noexcept {
    const filter::Vec<3> w = filter::difference<3>(v, m_.p);
    const double det = filter::dot(normal_, w);
    const filter::Vec<3> reach{filter::larger(std::fabs(w.x), reach_.x), filter::larger(std::fabs(w.y), reach_.y),
                               filter::larger(std::fabs(w.z), reach_.z)};
    if (filter::certain(det, reach)) return filter::sign_of(det);
    return swept_side(m_, v).sign;
  }

  // Events after a time need not be seen any more. It lies in [0,1].
  void end_at(double time) noexcept { end_ = time; }
  double end() const noexcept { return end_; }

  // Where line a b, with b on side `side_of_b` and a on the other, pierces the plane: a bit for each side of the
  // triangle, p p', p' q and q p, that has it outside, and kLater where it is certainly met after the end. 0: inside of
  // the triangle, and not known to be later. The time is that at which L(t) = (1-t) L(p) + t L(p') is 0, see
  // sweep_events.h: both values are off by the filter's bound at most, and their combination by less than 4u of both.
  std::uint32_t outside(const double* a, const double* b, int side_of_b) const noexcept {
    const filter::Vec<3> a_start = filter::difference<3>(a, m_.p), b_start = filter::difference<3>(b, m_.p);
    const filter::Vec<3> a_end = filter::difference<3>(a, m_.to), b_end = filter::difference<3>(b, m_.to);
    const filter::Vec<3> start = filter::cross(a_start, b_start), end = filter::cross(a_end, b_end);
    const Line along = line(move_, start, a_start, b_start), last = line(new_, end, a_end, b_end),
               first = line(old_, start, a_start, b_start);
    const int signs[3] = {sign(along, m_.p, m_.to, a, b), sign(last, m_.to, m_.q, a, b),
                          -sign(first, m_.p, m_.q, a, b)};
    std::uint32_t bits = 0;
    for (int i = 0; i < 3; ++i) bits |= static_cast<std::uint32_t>(signs[i] != side_of_b) << i;
    return end_ < 1 && is_later(first, last, side_of_b) ? bits | kLater : bits;
  }
  static constexpr std::uint32_t kSides = 7, kLater = 8;
  // Whether it pierces the plane outside of the triangle: whether `outside` has one of kSides.
  bool leaves(const double* a, const double* b, int side_of_b) const noexcept {
    const filter::Vec<3> a_end = filter::difference<3>(a, m_.to), b_end = filter::difference<3>(b, m_.to);
    if (sign(line(new_, filter::cross(a_end, b_end), a_end, b_end), m_.to, m_.q, a, b) != side_of_b) return true;
    const filter::Vec<3> a_start = filter::difference<3>(a, m_.p), b_start = filter::difference<3>(b, m_.p);
    const filter::Vec<3> start = filter::cross(a_start, b_start);
    if (sign(line(move_, start, a_start, b_start), m_.p, m_.to, a, b) != side_of_b) return true;
    return -sign(line(old_, start, a_start, b_start), m_.p, m_.q, a, b) != side_of_b;
  }

 private:
  // orient3(x, y, a, b), rounded: u = y-x times the cross product of a-x and b-x.
  struct Line {
    double det;
    filter::Vec<3> reach;
  };
  static Line line(const filter::Vec<3>& u, const filter::Vec<3>& product, const filter::Vec<3>& to_a,
                   const filter::Vec<3>& to_b) noexcept {
    return {filter::dot(product, u), filter::extent(u, to_a, to_b)};
  }
  static int sign(const Line& line, const double* x, const double* y, const double* a, const double* b) noexcept {
    if (filter::certain(line.det, line.reach)) return filter::sign_of(line.det);
    const double* const ridge[2] = {a, b};
    return line_side<3>(x, y, ridge, NoTally{}).sign;
  }
  bool is_later(const Line& first, const Line& last, int side_of_b) const noexcept {
    const double det = (1 - end_) * first.det + end_ * last.det;
    const double size = 4 * kUnitRoundoff * (std::fabs(first.det) + std::fabs(last.det));
    const double bound = kTimeSlack * ((filter::bound(first.reach) + filter::bound(last.reach)) + size);
    const auto in_range = [](const filter::Vec<3>& m) {
      return filter::lowest(m) >= kTimeFilterMin && filter::highest(m) <= kTimeFilterMax;
    };
    return in_range(first.reach) && in_range(last.reach) && (side_of_b > 0 ? -det : det) > bound;
  }

  EdgeMotion m_;
  filter::Vec<3> move_, old_, new_, normal_, reach_;
  PointBox<3> box_;
  double end_ = 1;
};

}  // namespace dsw
