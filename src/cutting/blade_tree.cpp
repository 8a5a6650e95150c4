#include "cutting/blade_tree.h"

#include <algorithm>

namespace dsw {

template <int D>
BladeTree<D>::Box::Box() {
  std::fill_n(lower, D, HUGE_VAL);
  std::fill_n(upper, D, -HUGE_VAL);
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
BladeTree<D>::BladeTree(const Memory* memory, const Blade<D>& blade) : leaves_(memory), nodes_(memory) {
  leaves_.resize(blade.simplex_count());
  for (uint32_t t = 0; t < leaves_.size(); ++t) {
    const double* at[D];
    blade.corners(t, at);
    for (const double* const corner : at) leaves_[t].box.add(corner);
    leaves_[t].simplex = t;
  }
  build(0, static_cast<uint32_t>(leaves_.size()));
}

/** Sorted by middle, then by number: no result depends on how a library sorts. */
template <int D>
void BladeTree<D>::build(uint32_t first, uint32_t end) {
  constexpr uint32_t kFew = 4;
  const auto number = static_cast<uint32_t>(nodes_.size());
  Box box;
  for (uint32_t i = first; i < end; ++i) {
    box.add(leaves_[i].box.lower);
    box.add(leaves_[i].box.upper);
  }
  const bool is_last = end - first <= kFew;
  nodes_.push_back({box, is_last ? first : 0, is_last ? end : 0, 0});
  if (!is_last) {
    int longest = 0;
    const auto extent = [&](int k) { return 0.5 * box.upper[k] - 0.5 * box.lower[k]; };
    for (int k = 1; k < D; ++k) longest = extent(k) > extent(longest) ? k : longest;
    const auto middle = [&](const Leaf& leaf) { return 0.5 * leaf.box.lower[longest] + 0.5 * leaf.box.upper[longest]; };
    std::sort(leaves_.begin() + first, leaves_.begin() + end, [&](const Leaf& a, const Leaf& b) {
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
