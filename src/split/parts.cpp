#include "split/parts.h"

#include "base/dimensions.h"
#include "base/disjoint_sets.h"
#include "base/search.h"
#include "base/sort.h"
#include "environment/validity.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

template <int D>
Array<uint32_t> vertices_of(const PartHull<D>& boundary) {
  Array<uint32_t> vertices(boundary.get_allocator());
  for (const PartSide<D>& s : boundary) {
    for (const uint32_t v : s.v) {
      if (dsw::find(vertices.begin(), vertices.end(), v) == vertices.end()) vertices.push_back(v);
    }
  }
  return vertices;
}

/** Tells whether the boundary is that of a simplex with a volume. */
template <int D>
bool is_positive(const PartPoints<D>& at, const PartHull<D>& boundary, const Array<uint32_t>& vertices) {
  if (vertices.size() != D + 1) return false;
  const double* points[D];
  for (int k = 0; k < D; ++k) points[k] = at[boundary[0].v[k]];
  return dsw::any_of(vertices.begin(), vertices.end(), [&](uint32_t v) { return orient<D>(points, at[v]) < 0; });
}

/** A side between two parts. */
template <int D>
struct PartWall {
  PartSide<D> side;
  uint32_t part;
  bool is_turned;

  bool operator<(const PartWall& o) const {
    if (!(side == o.side)) return side < o.side;
    return is_turned < o.is_turned;
  }
};

template <int D>
Array<PartWall<D>> walls_of(const Array<PartHull<D>>& parts) {
  Array<PartWall<D>> walls(parts.get_allocator());
  for (uint32_t p = 0; p < parts.size(); ++p) {
    for (const PartSide<D>& s : parts[p]) {
      const PartSide<D> other = turned(s);
      walls.push_back(other < s ? PartWall<D>{other, p, true} : PartWall<D>{s, p, false});
    }
  }
  dsw::sort(walls.begin(), walls.end());
  return walls;
}

/** Both boundaries without what they have in common. */
template <int D>
PartHull<D> joined(const PartHull<D>& a, const PartHull<D>& b) {
  PartHull<D> sorted_a(a), sorted_b(b), left(a.get_allocator());
  dsw::sort(sorted_a.begin(), sorted_a.end());
  dsw::sort(sorted_b.begin(), sorted_b.end());
  const auto add_others = [&](const PartHull<D>& from, const PartHull<D>& than) {
    for (const PartSide<D>& s : from) {
      if (!std::binary_search(than.begin(), than.end(), turned(s))) left.push_back(s);
    }
  };
  add_others(a, sorted_b);
  add_others(b, sorted_a);
  return left;
}

}  // namespace

template <int D>
bool is_star_of(const PartPoints<D>& at, const PartHull<D>& boundary, const double* apex) {
  Array<const double*> points(boundary.get_allocator());
  for (const PartSide<D>& s : boundary) {
    for (const uint32_t v : s.v) points.push_back(at[v]);
  }
  return is_valid_star<D>(points.data(), static_cast<uint32_t>(boundary.size()), apex);
}

template <int D>
bool is_valid_part(const PartPoints<D>& at, const PartHull<D>& boundary) {
  const Array<uint32_t> vertices = vertices_of<D>(boundary);
  if (boundary.size() == D + 1) return is_positive<D>(at, boundary, vertices);
  double mean[D];
  mean_point<D>(
      static_cast<uint32_t>(vertices.size()), [&](uint32_t i) { return at[vertices[i]]; }, mean);
  return is_star_of<D>(at, boundary, mean);
}

template <int D>
void join_parts(const PartPoints<D>& at, Array<PartHull<D>>& parts) {
  DisjointSets sets(static_cast<uint32_t>(parts.size()), at.memory());
  const Array<PartWall<D>> walls = walls_of<D>(parts);
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (size_t i = 0; i + 1 < walls.size(); ++i) {
      if (!(walls[i].side == walls[i + 1].side)) continue;
      const uint32_t a = sets.root(walls[i].part), b = sets.root(walls[i + 1].part);
      if (a == b) continue;
      PartHull<D> both = joined<D>(parts[a], parts[b]);
      if (!is_valid_part<D>(at, both)) continue;
      sets.join(a, b);
      parts[std::min(a, b)] = std::move(both);
      parts[std::max(a, b)].clear();
      has_changed = true;
    }
  }
  const auto is_empty = [](const PartHull<D>& part) { return part.empty(); };
  parts.erase(std::remove_if(parts.begin(), parts.end(), is_empty), parts.end());
}

#define DSW_PARTS(D)                                                                    \
  template bool is_star_of<D>(const PartPoints<D>&, const PartHull<D>&, const double*); \
  template bool is_valid_part<D>(const PartPoints<D>&, const PartHull<D>&);             \
  template void join_parts<D>(const PartPoints<D>&, Array<PartHull<D>>&)
DSW_PARTS(2);
DSW_PARTS(3);
#undef DSW_PARTS

}  // namespace dsw
