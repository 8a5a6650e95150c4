#include "conform/hanging_points.h"

#include <algorithm>
#include <cmath>

#include "environment/box_tree.h"
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

}  // namespace

template <int D>
bool lies_on_edge(const double* a, const double* b, const double* p, double room) noexcept {
  for (int k = 0; k < D; ++k) {  // most points are seen to lie elsewhere by one coordinate
    if ((p[k] < a[k] - room && p[k] < b[k] - room) || (p[k] > a[k] + room && p[k] > b[k] + room)) return false;
  }
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

template <int D>
void HangingPoints<D>::add(uint32_t u, uint32_t v, uint32_t vertex) {
  const uint32_t edge = edges_.insert(pair_key(u, v));
  if (edge == first_.size()) {
    first_.push_back(kEnd);
    for (const uint32_t end : {u, v}) ends_[end / 64] |= uint64_t{1} << end % 64;
  }
  const double *const low = env_.point(std::min(u, v)), *const high = env_.point(std::max(u, v));
  const int axis = longest_axis<D>(low, high);
  const double at = env_.point(vertex)[axis], along = low[axis] < high[axis] ? at : -at;
  uint32_t before = kEnd, after = first_[edge];
  while (after != kEnd && points_[after].along < along) {
    before = after;
    after = points_[after].next;
  }
  for (uint32_t same = after; same != kEnd && !(along < points_[same].along); same = points_[same].next) {
    if (points_[same].vertex == vertex) return;
    if (points_[same].vertex > vertex) continue;
    before = same;
    after = points_[same].next;
  }
  points_.push_back({vertex, after, along});
  (before == kEnd ? first_[edge] : points_[before].next) = count() - 1;
}

template <int D>
void HangingPoints<D>::append_points(uint32_t u, uint32_t v, Array<uint32_t>& loop) const {
  const uint32_t edge = edges_.find(pair_key(u, v));
  if (edge == KeyTable::kNone) return;
  const auto before = static_cast<std::ptrdiff_t>(loop.size());
  for (uint32_t i = first_[edge]; i != kEnd; i = points_[i].next) loop.push_back(points_[i].vertex);
  if (u > v) std::reverse(loop.begin() + before, loop.end());
}

template <int D>
Array<uint64_t> HangingPoints<D>::poor_fans() const {
  Array<uint64_t> made(ends_);
  for (uint32_t i : first_) {
    for (const bool are_several = points_[i].next != kEnd; are_several && i != kEnd; i = points_[i].next) {
      made[points_[i].vertex / 64] |= uint64_t{1} << points_[i].vertex % 64;
    }
  }
  return made;
}

void find_hanging_points(const Environment<2>& env, const OuterFacets<2>& outer, double room, HangingPoints<2>& found) {
  KeyTable vertices(env.memory);
  for (uint32_t i = 0; i < outer.count(); ++i) {
    for (const uint32_t v : outer.loop(i)) vertices.insert(v);
  }
  const auto at = [&](uint32_t i) { return env.point(static_cast<uint32_t>(vertices[i])); };
  const auto box_of = [&](uint32_t i) {
    ClosedBox<2> box;
    box.add(at(i));
    return box;
  };
  const BoxTree<2> tree(vertices.size(), box_of, env.memory);
  for (uint32_t i = 0; i < outer.count(); ++i) {
    const uint32_t u = outer.loop(i)[0], v = outer.loop(i)[1];
    ClosedBox<2> box = outer.box(i);
    box.widen(room);
    tree.for_each(box.lower, box.upper, [&](uint32_t k) {
      const auto vertex = static_cast<uint32_t>(vertices[k]);
      if (vertex == u || vertex == v || !lies_on_edge<2>(env.point(u), env.point(v), at(k), room)) return;
      found.add(u, v, vertex);
    });
  }
}

template bool lies_on_edge<2>(const double*, const double*, const double*, double) noexcept;
template bool lies_on_edge<3>(const double*, const double*, const double*, double) noexcept;
template class HangingPoints<2>;
template class HangingPoints<3>;

}  // namespace dsw
