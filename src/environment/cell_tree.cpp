#include "environment/cell_tree.h"

#include <algorithm>
#include <cmath>

#include "environment/environment.h"

namespace dsw {
namespace {

template <int D>
struct Box {
  double lower[D], upper[D];

  Box() {
    std::fill_n(lower, D, HUGE_VAL);
    std::fill_n(upper, D, -HUGE_VAL);
  }
  Box(const Environment<D>& env, Cell c) : Box() {
    for (uint32_t i = 0, n = env.map.vertices_of(c); i < n; ++i) add(env.point(c, i));
  }
  /** Coordinates that are not finite are left out: what has them is invalid. */
  void add(const double* p) noexcept {
    for (int k = 0; k < D; ++k) {
      if (!std::isfinite(p[k])) continue;
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
};

constexpr uint32_t kKeyBits = 12, kIndexBits = 28;  // an axis; of a cell's index

/** Bits of 0 .. 63, D apart. */
template <int D>
struct SpreadBits {
  uint64_t of[64];
  SpreadBits() {
    for (uint32_t i = 0; i < 64; ++i) {
      of[i] = 0;
      for (uint32_t bit = 0; bit < 6; ++bit) of[i] |= uint64_t{i >> bit & 1u} << D * bit;
    }
  }
  uint64_t operator()(uint32_t x) const { return of[x & 63u] | of[x >> 6] << 6 * D; }
};

/** Sorts by the bits above the index, which are D digits. */
template <int D>
void sort_keys(Array<uint64_t>& keys) {
  constexpr uint32_t kDigits = 1u << kKeyBits;
  Array<uint64_t> other(keys.size(), 0, keys.get_allocator());
  Array<uint32_t> first(kDigits, 0, Allocator<uint32_t>(keys.get_allocator()));
  for (int digit = 0; digit < D; ++digit) {
    const uint32_t shift = kIndexBits + kKeyBits * static_cast<uint32_t>(digit);
    std::fill(first.begin(), first.end(), 0u);
    for (const uint64_t key : keys) ++first[key >> shift & (kDigits - 1)];
    uint32_t sum = 0;
    for (uint32_t& count : first) sum += std::exchange(count, sum);
    for (const uint64_t key : keys) other[first[key >> shift & (kDigits - 1)]++] = key;
    keys.swap(other);
  }
}

}  // namespace

/** The box of all vertices. That of an environment whose points stay is known. */
template <int D>
void CellTree<D>::set_frame(const Environment<D>& env) noexcept {
  Box<D> all;
  if (env.checked.active()) {
    const Array<uint32_t>& uses = env.map.vertex_uses;
    for (uint32_t v = 0; v < env.map.vertex_count; ++v) {
      if (uses.empty() || uses[v] != 0) all.add(env.point(v));
    }
  } else {
    all.add(env.lower);
    all.add(env.upper);
  }
  for (int k = 0; k < D; ++k) {
    lower_[k] = all.lower[k];
    upper_[k] = all.upper[k];
    const double length = upper_[k] - lower_[k], scale = 65535 / length;
    steps_per_unit_[k] = std::isfinite(length) && std::isfinite(scale) && length > 0 ? scale : 0;
  }
}

template <int D>
void CellTree<D>::build(const Environment<D>& env) {
  set_frame(env);
  Array<uint64_t> keys{Allocator<uint64_t>(memory_)};
  keys.reserve(env.map.cell_count);
  const SpreadBits<D> spread;
  for_each_cell(env.map, [&](Cell c) {
    const Box<D> box(env, c);
    uint64_t key = 0;
    for (int k = 0; k < D; ++k) {
      const uint32_t middle = (uint32_t{step(k, box.lower[k])} + step(k, box.upper[k])) >> (17 - kKeyBits);
      key |= spread(middle) << k;
    }
    keys.push_back(key << kIndexBits | env.map.index(c));
  });
  sort_keys<D>(keys);
  cells_.resize(keys.size());
  for (size_t i = 0; i < keys.size(); ++i) cells_[i] = static_cast<uint32_t>(keys[i] & kVertexMask);
  size_t boxes = cells_.size(), groups = 0;
  level_count_ = 0;
  do {
    boxes = (boxes + kWidth - 1) / kWidth;
    level_first_[level_count_++] = static_cast<uint32_t>(groups);
    groups += boxes;
  } while (boxes > 1);
  groups_.resize(groups);
  fit(env);
}

template <int D>
void CellTree<D>::fit(const Environment<D>& env) noexcept {
  set_frame(env);
  Group nothing;
  std::fill_n(&nothing.lower[0][0], D * kWidth, uint16_t{65535});
  std::fill_n(&nothing.upper[0][0], D * kWidth, uint16_t{0});
  std::fill(groups_.begin(), groups_.end(), nothing);
  for (size_t i = 0; i < cells_.size(); ++i) {
    const Cell c = env.map.cell(cells_[i]);
    if (!c.valid()) continue;
    const Box<D> box(env, c);
    Group& group = groups_[i / kWidth];
    for (int k = 0; k < D; ++k) {
      group.lower[k][i % kWidth] = step(k, box.lower[k]);
      group.upper[k][i % kWidth] = step(k, box.upper[k]);
    }
  }
  for (uint32_t level = 0; level + 1 < level_count_; ++level) {
    const uint32_t first = level_first_[level], count = level_first_[level + 1] - first;
    for (uint32_t i = 0; i < count; ++i) {
      const Group& from = groups_[first + i];
      Group& to = groups_[level_first_[level + 1] + i / kWidth];
      for (int k = 0; k < D; ++k) {
        to.lower[k][i % kWidth] = *std::min_element(from.lower[k], from.lower[k] + kWidth);
        to.upper[k][i % kWidth] = *std::max_element(from.upper[k], from.upper[k] + kWidth);
      }
    }
  }
}

template class CellTree<2>;
template class CellTree<3>;

}  // namespace dsw
