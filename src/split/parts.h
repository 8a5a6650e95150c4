#pragma once
// Parts that a cell is split into: by their boundary, oriented simplices between vertices.

#include <algorithm>

#include "environment/environment.h"

namespace dsw {

/** Where vertices are: those of an environment, and new ones after them. */
template <int D>
class PartPoints {
 public:
  explicit PartPoints(const Environment<D>& env) : env_(env), added_(env.memory) {}

  const Memory* memory() const { return env_.memory; }
  const double* operator[](uint32_t vertex) const {
    return vertex < env_.map.vertex_count ? env_.point(vertex) : &added_[size_t{vertex - env_.map.vertex_count} * D];
  }
  uint32_t add(const double* point) {
    const auto number = static_cast<uint32_t>(added_.size() / D);
    added_.insert(added_.end(), point, point + D);
    return env_.map.vertex_count + number;
  }
  void take_back(uint32_t from) { added_.resize(size_t{from - env_.map.vertex_count} * D); }
  /** The number that the next new vertex gets. */
  uint32_t end() const { return env_.map.vertex_count + static_cast<uint32_t>(added_.size() / D); }
  const Array<double>& added() const { return added_; }

 private:
  const Environment<D>& env_;
  Array<double> added_;
};

/** Vertices of a side of a part, the lowest one first in space: oriented counter-clockwise seen from outside, in the plane
 * with the part on the left. */
template <int D>
struct PartSide {
  uint32_t v[D];

  bool operator<(const PartSide& o) const { return std::lexicographical_compare(v, v + D, o.v, o.v + D); }
  bool operator==(const PartSide& o) const { return std::equal(v, v + D, o.v); }
};

inline PartSide<2> make_simplex(uint32_t a, uint32_t b) { return {{a, b}}; }
inline PartSide<3> make_simplex(uint32_t a, uint32_t b, uint32_t c) {
  if (a < b && a < c) return {{a, b, c}};
  return b < c ? PartSide<3>{{b, c, a}} : PartSide<3>{{c, a, b}};
}
inline PartSide<2> turned(const PartSide<2>& s) { return make_simplex(s.v[1], s.v[0]); }
inline PartSide<3> turned(const PartSide<3>& s) { return make_simplex(s.v[0], s.v[2], s.v[1]); }

template <int D>
using PartHull = Array<PartSide<D>>;

/** Whether a boundary closes a cell that is valid: a simplex with a volume, or the star of the mean of its vertices. */
template <int D>
bool is_valid_part(const PartPoints<D>& at, const PartHull<D>& boundary);
/** Whether a boundary closes a star of a point. */
template <int D>
bool is_star_of(const PartPoints<D>& at, const PartHull<D>& boundary, const double* apex);

/** Joins parts that have sides in common as long as what results is valid; parts that are used up vanish. Exact.
 * O(p^2 s) at worst for p parts with s sides. Throws std::bad_alloc. */
template <int D>
void join_parts(const PartPoints<D>& at, Array<PartHull<D>>& parts);

}  // namespace dsw
