#include "cutting/blade_tree.h"

#include <algorithm>

#include "base/sort.h"
#include "base/vec.h"

namespace dsw {
namespace {

/** How well distance_to_simplex() is known: it falls short of the true distance by less than m * m / (2^40 * trust),
 * where m is the largest coordinate of a corner seen from the point. Only the foot of a perpendicular can be far off:
 * by rounding errors over the size of the simplex, and over its height, relative to its size, three times (the
 * direction of the perpendicular, the shortest side, the sharpest corner). With two equal corners there is no such
 * foot. 0: nothing is known. */
template <int D>
double trust_of(const double* const* corners) {
  Vec sides[D];
  double size = 0;
  for (int k = 0; k < D; ++k) {
    sides[k] = difference<D>(corners[(k + 1) % D], corners[k]);
    if (is_zero(sides[k])) return HUGE_VAL;
    size = std::max(size, largest(sides[k]));
  }
  if (!std::isfinite(size)) return 0;
  if (D == 2) return size;
  const double height = length((sides[0] / size).cross(sides[1] / size));
  return size * height * height * height;
}

/** The distance of a box, rounded, and the largest coordinate in it seen from there. */
template <int D>
void reach(const typename BladeTree<D>::Box& box, const double* from, double* least, double* most) {
  double square = 0;
  *most = 0;
  for (int k = 0; k < D; ++k) {
    const double below = box.lower[k] - from[k], above = from[k] - box.upper[k];
    const double gap = std::max(std::max(below, above), 0.0);
    square += gap * gap;
    *most = std::max(*most, std::max(std::fabs(below), std::fabs(above)));
  }
  *least = std::sqrt(square);
}

/** Whether distance_to_simplex() is surely above `best` for all simplices in a box. */
template <int D>
bool is_farther(const typename BladeTree<D>::Box& box, double trust, const double* from, double best) {
  constexpr double kShare = 1.0 / (uint64_t{1} << 30), kPart = 1.0 / (uint64_t{1} << 40);
  double least, most;
  reach<D>(box, from, &least, &most);
  return least - kShare * most - most * (kPart * most / trust) > best;  // not where anything is no number
}

}  // namespace

template <int D>
BladeTree<D>::Box::Box() {
  std::fill_n(lower, D, HUGE_VAL);
  std::fill_n(upper, D, -HUGE_VAL);
}

template <int D>
BladeTree<D>::Box::Box(const Environment<D>& env, Cell c) : Box() {
  for (uint32_t k = 0, n = env.map.vertices_of(c); k < n; ++k) add(env.point(c, k));
}

template <int D>
void BladeTree<D>::Box::add(const double* point) {
  for (int k = 0; k < D; ++k) {
    lower[k] = std::min(lower[k], point[k]);
    upper[k] = std::max(upper[k], point[k]);
  }
}

template <int D>
bool BladeTree<D>::Box::overlaps(const Box& other) const {
  bool apart = false;
  for (int k = 0; k < D; ++k) apart = apart || lower[k] > other.upper[k] || upper[k] < other.lower[k];
  return !apart;
}

template <int D>
bool BladeTree<D>::Box::holds(const double* point) const {
  bool apart = false;
  for (int k = 0; k < D; ++k) apart = apart || lower[k] > point[k] || upper[k] < point[k];
  return !apart;
}

template <int D>
BladeTree<D>::BladeTree(const Memory* memory, const Blade<D>& blade) : blade_(blade), leaves_(memory), nodes_(memory) {
  leaves_.resize(blade.simplex_count());
  for (uint32_t t = 0; t < leaves_.size(); ++t) {
    const double* at[D];
    blade.corners(t, at);
    leaves_[t] = {box(t), t, trust_of<D>(at)};
  }
  build(0, static_cast<uint32_t>(leaves_.size()));
}

template <int D>
typename BladeTree<D>::Box BladeTree<D>::box(uint32_t simplex) const {
  const double* at[D];
  blade_.corners(simplex, at);
  Box box;
  for (const double* const corner : at) box.add(corner);
  return box;
}

template <int D>
double BladeTree<D>::distance(const double* from, uint32_t* nearest) const {
  const auto distance_of = [&](uint32_t simplex) {
    const double* at[D];
    blade_.corners(simplex, at);
    return distance_to_simplex<D>(from, at);
  };
  double best = distance_of(*nearest);
  for (uint32_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    if (is_farther<D>(node.box, node.trust, from, best)) {
      i = node.next;
      continue;
    }
    for (uint32_t k = node.first; k < node.end; ++k) {
      if (is_farther<D>(leaves_[k].box, leaves_[k].trust, from, best)) continue;
      const double distance = distance_of(leaves_[k].simplex);
      if (!(distance < best)) continue;
      best = distance;
      *nearest = leaves_[k].simplex;
    }
    ++i;
  }
  return best;
}

/** Sorted by middle, then by number: no result depends on how a library sorts. */
template <int D>
void BladeTree<D>::build(uint32_t first, uint32_t end) {
  constexpr uint32_t kFew = 4;
  const auto number = static_cast<uint32_t>(nodes_.size());
  Box box;
  double trust = HUGE_VAL;
  for (uint32_t i = first; i < end; ++i) {
    box.add(leaves_[i].box.lower);
    box.add(leaves_[i].box.upper);
    trust = std::min(trust, leaves_[i].trust);
  }
  const bool is_last = end - first <= kFew;
  nodes_.push_back({box, is_last ? first : 0, is_last ? end : 0, 0, trust});
  if (!is_last) {
    int longest = 0;
    const auto extent = [&](int k) { return 0.5 * box.upper[k] - 0.5 * box.lower[k]; };
    for (int k = 1; k < D; ++k) longest = extent(k) > extent(longest) ? k : longest;
    const auto middle = [&](const Leaf& leaf) { return 0.5 * leaf.box.lower[longest] + 0.5 * leaf.box.upper[longest]; };
    dsw::sort(leaves_.data() + first, leaves_.data() + end, [&](const Leaf& a, const Leaf& b) {
      const double of_a = middle(a), of_b = middle(b);
      return of_a != of_b ? of_a < of_b : a.simplex < b.simplex;
    });
    const uint32_t half = first + (end - first) / 2;
    build(first, half);
    build(half, end);
  }
  nodes_[number].next = static_cast<uint32_t>(nodes_.size());
}

template class BladeTree<2>;
template class BladeTree<3>;

}  // namespace dsw
