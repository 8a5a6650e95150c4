// Which part of a segment lies on a point, a segment or a triangle, and whether a place is in a cell: in rational numbers.
#pragma once

#include "exact_places.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace dsw::oracle::exact {

inline Q3 exact(const Vec& a) { return {mpq_class(a[0]), mpq_class(a[1]), mpq_class(a[2])}; }
inline Q3 minus(const Q3& a, const Q3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Q3 at(const Q3& p, const Q3& q, const mpq_class& t) {
  return {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])};
}

/// The shares of a segment at which it lies on a closed simplex: an interval, as both are convex.
class Span {
 public:
  Span(const Q3& p, const Q3& q, const std::vector<Q3>& s) {
    const Q3 way = minus(q, p), from = minus(p, s[0]);
    const bool is_point = s.size() == 1 || (s.size() == 2 && s[0] == s[1]);
    if (is_point) {
      for (size_t k = 0; k < 3; ++k) be_zero(from[k], way[k]);
    } else if (s.size() == 2) {
      const Q3 u = minus(s[1], s[0]), first = cross(u, from), slope = cross(u, way);
      for (size_t k = 0; k < 3; ++k) be_zero(first[k], slope[k]);
      be_positive(dot(u, from), dot(u, way));
      be_positive(dot(u, u) - dot(u, from), -dot(u, way));
    } else {
      const Q3 n = cross(minus(s[1], s[0]), minus(s[2], s[0]));
      be_zero(dot(n, from), dot(n, way));
      for (size_t k = 0; k < 3 && !empty_; ++k) {
        const Q3 inward = cross(n, minus(s[(k + 1) % 3], s[k]));
        be_positive(dot(inward, minus(p, s[k])), dot(inward, way));
      }
    }
  }
  /// The first share, of a closed segment or of what lies between its ends.
  std::optional<mpq_class> first(bool open) const {
    if (empty_ || (open && !(low_ < 1 && high_ > 0))) return {};
    return low_;
  }

 private:
  void be_zero(const mpq_class& start, const mpq_class& slope) {
    be_positive(start, slope);
    be_positive(-start, -slope);
  }
  void be_positive(const mpq_class& start, const mpq_class& slope) {
    if (slope == 0) {
      empty_ = empty_ || start < 0;
    } else if (slope > 0) {
      low_ = std::max<mpq_class>(low_, -start / slope);
    } else {
      high_ = std::min<mpq_class>(high_, -start / slope);
    }
    empty_ = empty_ || low_ > high_;
  }

  mpq_class low_ = 0, high_ = 1;
  bool empty_ = false;
};

/// Whether a place lies in a closed cell: a ray from it leaves the cell once more often than it enters.
inline bool in_cell(const World& world, size_t cell, const Q3& place) {
  const auto corner = [&](int v) { return exact(world.mesh.points[static_cast<size_t>(v)]); };
  for (int attempt = 1;; ++attempt) {
    const Q3 way = {mpq_class(1, 3) * attempt, mpq_class(5, 7) + attempt * attempt, mpq_class(-11, 13)};
    int crossings = 0;
    bool is_clear = true;
    for (const int t : world.cell_triangles[cell]) {
      const auto& v = world.triangles[static_cast<size_t>(t)].v;
      const Q3 a = minus(corner(v[0]), place), b = minus(corner(v[1]), place), c = minus(corner(v[2]), place);
      const int x = sgn(dot(way, cross(a, b))), y = sgn(dot(way, cross(b, c))), z = sgn(dot(way, cross(c, a)));
      const int side = sgn(dot(a, cross(b, c)));
      const bool outside = (x < 0 || y < 0 || z < 0) && (x > 0 || y > 0 || z > 0);
      if (outside) continue;
      if (side == 0 && Span(place, place, {corner(v[0]), corner(v[1]), corner(v[2])}).first(false)) return true;
      if (x == 0 || y == 0 || z == 0) {
        is_clear = false;
        break;
      }
      if (side * x > 0) ++crossings;
    }
    if (is_clear) return crossings % 2 != 0;
  }
}

inline bool in_passable_cell(const World& world, const Q3& place) {
  for (size_t c = 0; c < world.ids.size(); ++c) {
    if (world.cell_marked[c] == 0 && in_cell(world, c, place)) return true;
  }
  return false;
}

/// Whether a time is the largest double that is not above the exact one.
inline bool is_rounded_down(double time, const mpq_class& exact_time) {
  return mpq_class(time) <= exact_time && (time == 1 || mpq_class(std::nextafter(time, 2)) > exact_time);
}

}  // namespace dsw::oracle::exact
