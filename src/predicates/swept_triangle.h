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

  // Bits of the sides of its box that v lies beyond, see PointBox.
  std::uint32_t beyond_box(const double* v) const noexcept { return box_.beyond(v); }

  // As swept_side.
  int side(const double* v) const noexcept {
    const filter::Vec<3> w = filter::difference<3>(v, m_.p);
    const double det = filter::dot(normal_, w);
    const filter::Vec<3> reach{filter::larger(std::fabs(w.x), reach_.x), filter::larger(std::fabs(w.y), reach_.y),
                               filter::larger(std::fabs(w.z), reach_.z)};
    if (filter::certain(det, reach)) return filter::sign_of(det);
    return swept_side(m_, v).sign;
  }

  // Where line a b, with b on side `side_of_b` and a on the other, pierces the plane: a bit for each side of the
  // triangle, p p', p' q and q p, that has it outside. 0: inside of the triangle.
  std::uint32_t outside(const double* a, const double* b, int side_of_b) const noexcept {
    const filter::Vec<3> a_start = filter::difference<3>(a, m_.p), b_start = filter::difference<3>(b, m_.p);
    const filter::Vec<3> a_end = filter::difference<3>(a, m_.to), b_end = filter::difference<3>(b, m_.to);
    const filter::Vec<3> start = filter::cross(a_start, b_start), end = filter::cross(a_end, b_end);
    const int signs[3] = {line(move_, start, a_start, b_start, m_.p, m_.to, a, b),
                          line(new_, end, a_end, b_end, m_.to, m_.q, a, b),
                          -line(old_, start, a_start, b_start, m_.p, m_.q, a, b)};
    std::uint32_t bits = 0;
    for (int i = 0; i < 3; ++i) bits |= static_cast<std::uint32_t>(signs[i] != side_of_b) << i;
    return bits;
  }

 private:
  // Sign of orient3(x, y, a, b): u = y-x times the cross product of a-x and b-x.
  static int line(const filter::Vec<3>& u, const filter::Vec<3>& product, const filter::Vec<3>& to_a,
                  const filter::Vec<3>& to_b, const double* x, const double* y, const double* a,
                  const double* b) noexcept {
    const double det = filter::dot(product, u);
    if (filter::certain(det, filter::extent(u, to_a, to_b))) return filter::sign_of(det);
    const double* const ridge[2] = {a, b};
    return line_side<3>(x, y, ridge, NoTally{}).sign;
  }

  EdgeMotion m_;
  filter::Vec<3> move_, old_, new_, normal_, reach_;
  PointBox<3> box_;
};

}  // namespace dsw
