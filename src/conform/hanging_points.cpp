#include "conform/hanging_points.h"

#include <cmath>

#include "predicates/turn.h"

namespace dsw {
namespace {

template <int D>
int longest_axis(const double* a, const double* b) noexcept {
  int axis = 0;
  for (int k = 1; k < D; ++k) {
    if (std::fabs(b[k] / 2 - a[k] / 2) > std::fabs(b[axis] / 2 - a[axis] / 2)) axis = k;
  }
  return axis;
}

/** Whether a point lies between the ends of an edge and is not farther from it than `room`. 0: exactly on it. */
template <int D>
bool lies_on(const double* a, const double* b, const double* p, double room) noexcept {
  const int axis = longest_axis<D>(a, b);
  const bool is_between =
      a[axis] < b[axis] ? a[axis] < p[axis] && p[axis] < b[axis] : b[axis] < p[axis] && p[axis] < a[axis];
  if (!is_between) return false;
  if (!(room > 0)) return are_collinear<D>(a, b, p);
  const double share = (p[axis] - a[axis]) / (b[axis] - a[axis]);
  double sum = 0;
  for (int k = 0; k < D; ++k) {
    const double off = (a[k] + share * (b[k] - a[k]) - p[k]) / room;
    sum += off * off;
  }
  return sum <= 1;
}

/** Edges of all loops and their ends, each once. */
template <int D>
struct Boundary {
  KeyTable edges, vertices;

  Boundary(const OuterFacets<D>& outer, const Memory* memory) : edges(memory), vertices(memory) {
    for (uint32_t i = 0; i < outer.count(); ++i) {
      const VertexRange loop = outer.loop(i);
      for (uint32_t k = 0; k < loop.size(); ++k) {
        edges.insert(pair_key(loop[k], loop.after(k)));
        vertices.insert(loop[k]);
      }
    }
  }
};

}  // namespace

template <int D>
HangingPoints<D>::HangingPoints(const Environment<D>& env, const OuterFacets<D>& outer, double room)
    : env_(env),
      edges_(env.memory),
      first_(env.memory),
      points_(env.memory),
      ends_((size_t{env.map.vertex_count} + 63) / 64, 0, env.memory) {
  const Boundary<D> boundary(outer, env.memory);
  const auto at = [&](uint32_t i) { return env.point(static_cast<uint32_t>(boundary.vertices[i])); };
  const auto box_of = [&](uint32_t i) {
    ClosedBox<D> box;
    box.add(at(i));
    return box;
  };
  const BoxTree<D> tree(boundary.vertices.size(), box_of, env.memory);
  for (uint32_t e = 0; e < boundary.edges.size(); ++e) {
    const uint64_t key = boundary.edges[e];
    const uint32_t ends[2] = {static_cast<uint32_t>(key >> 32), static_cast<uint32_t>(key)};
    const double *const a = env.point(ends[0]), *const b = env.point(ends[1]);
    ClosedBox<D> box;
    box.add(a);
    box.add(b);
    box.widen(room);
    const size_t before = points_.size();
    const int axis = longest_axis<D>(a, b);
    tree.for_each(box.lower, box.upper, [&](uint32_t i) {
      const auto vertex = static_cast<uint32_t>(boundary.vertices[i]);
      if (vertex == ends[0] || vertex == ends[1] || !lies_on<D>(a, b, at(i), room)) return;
      points_.push_back({edges_.size(), vertex, at(i)[axis]});
    });
    if (points_.size() == before) continue;
    first_.push_back(static_cast<uint32_t>(before));
    edges_.insert(key);
    for (const uint32_t end : ends) ends_[end / 64] |= uint64_t{1} << end % 64;
    const bool is_rising = a[axis] < b[axis];
    std::sort(points_.begin() + static_cast<std::ptrdiff_t>(before), points_.end(),
              [is_rising](const Point& p, const Point& q) {
                if (p.along != q.along) return (p.along < q.along) == is_rising;
                return p.vertex < q.vertex;
              });
  }
  first_.push_back(static_cast<uint32_t>(points_.size()));
}

template <int D>
void HangingPoints<D>::append(uint32_t u, uint32_t v, Array<uint32_t>& loop) const {
  loop.push_back(u);
  if (!may_have(u) || !may_have(v)) return;
  const uint32_t edge = edges_.find(pair_key(u, v));
  if (edge == KeyTable::kNone) return;
  const uint32_t first = first_[edge], end = first_[edge + 1];
  for (uint32_t i = 0; i < end - first; ++i) loop.push_back(points_[u < v ? first + i : end - 1 - i].vertex);
}

template class HangingPoints<2>;
template class HangingPoints<3>;

}  // namespace dsw
