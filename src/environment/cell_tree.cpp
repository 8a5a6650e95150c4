#include "environment/cell_tree.h"

#include <algorithm>
#include <cmath>

#include "base/compiler.h"
#include "environment/environment.h"
#include "environment/obstacles.h"

namespace dsw {
namespace {

template <int D>
struct Box {
  double lower[D], upper[D];

  Box() {
    std::fill_n(lower, D, HUGE_VAL);
    std::fill_n(upper, D, -HUGE_VAL);
  }
  Box(const Environment<D>& env, Cell c, BoxOf content) : Box() {
    const auto add_vertex = [&](uint32_t i) { add(env.point(c, i)); };
    if (content == BoxOf::kObstacles) {
      for_each_obstacle_vertex(env, c, add_vertex);
    } else {
      for (uint32_t i = 0, n = env.map.vertices_of(c); i < n; ++i) add_vertex(i);
    }
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

template <int D>
void prefetch_record(const Environment<D>& env, uint32_t index) noexcept {
  const Cell c = env.map.cell(index);
  if (c.valid()) prefetch_line(env.map.record(c));
}
template <int D>
void prefetch_vertices(const Environment<D>& env, uint32_t index) noexcept {
  const Cell c = env.map.cell(index);
  for (uint32_t i = 0, n = c.valid() ? env.map.vertices_of(c) : 0; i < n; ++i) prefetch_line(env.point(c, i));
}

/** How far along the Hilbert curve a place is: J. Skilling, Programming the Hilbert curve, 2004. What follows each
 * other on this curve lies side by side, which keeps boxes small. Places are turned and mirrored in cubes of half
 * the size, from the largest cube on. */
template <int D>
uint64_t place_on_curve(uint32_t* x, const SpreadBits<D>& spread) noexcept {
  for (uint32_t half = 1u << (kKeyBits - 1); half > 1; half /= 2) {
    const uint32_t below = half - 1;
    for (int k = 0; k < D; ++k) {
      const uint32_t upper = (x[k] & half) != 0 ? below : 0;
      const uint32_t swapped = (x[0] ^ x[k]) & (below ^ upper);
      x[0] ^= upper | swapped;
      x[k] ^= swapped;
    }
  }
  for (int k = 1; k < D; ++k) x[k] ^= x[k - 1];
  uint32_t mirrored = 0;
  for (uint32_t half = 1u << (kKeyBits - 1); half > 1; half /= 2) {
    if ((x[D - 1] & half) != 0) mirrored ^= half - 1;
  }
  uint64_t place = 0;
  for (int k = 0; k < D; ++k) place |= spread(x[k] ^ mirrored) << (D - 1 - k);
  return place;
}

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
    const double length = upper_[k] - lower_[k], scale = kLastStep / length;
    steps_per_unit_[k] = std::isfinite(length) && std::isfinite(scale) && length > 0 ? scale : 0;
  }
}

template <int D>
void CellTree<D>::build(const Environment<D>& env) {
  Array<uint64_t> keys{Allocator<uint64_t>(memory_)};
  keys.reserve(env.map.cell_count);
  for_each_cell(env.map, [&](Cell c) { keys.push_back(env.map.index(c)); });
  arrange(env, keys);
}

template <int D>
void CellTree<D>::build(const Environment<D>& env, const Array<uint32_t>& cells) {
  Array<uint64_t> keys(cells.begin(), cells.end(), Allocator<uint64_t>(memory_));
  arrange(env, keys);
}

/** `keys` are indices of cells at first. */
template <int D>
void CellTree<D>::arrange(const Environment<D>& env, Array<uint64_t>& keys) {
  set_frame(env);
  const SpreadBits<D> spread;
  for (uint64_t& key : keys) {
    const Box<D> box(env, env.map.cell(static_cast<uint32_t>(key)), content_);
    uint32_t middle[D];
    for (int k = 0; k < D; ++k) {
      const int twice = step(k, box.lower[k]) + step(k, box.upper[k]) - 2 * INT16_MIN;
      middle[k] = static_cast<uint32_t>(twice) >> (17 - kKeyBits);
    }
    key |= place_on_curve<D>(middle, spread) << kIndexBits;
  }
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
  constexpr int16_t kFirst = INT16_MIN, kLast = INT16_MAX;
  Group nothing;
  for (int k = 0; k < D; ++k) {
    nothing.lower[k] = eight_of(kLast);
    nothing.upper[k] = eight_of(kFirst);
  }
  std::fill(groups_.begin(), groups_.end(), nothing);
  constexpr size_t kVerticesAhead = 8, kRecordAhead = 24;  // neighbours on the curve lie anywhere in memory
  for (size_t i = 0; i < cells_.size(); ++i) {
    if (i + kRecordAhead < cells_.size()) prefetch_record(env, cells_[i + kRecordAhead]);
    if (i + kVerticesAhead < cells_.size()) prefetch_vertices(env, cells_[i + kVerticesAhead]);
    const Cell c = env.map.cell(cells_[i]);
    if (!c.valid()) continue;
    const Box<D> box(env, c, content_);
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
        for (uint32_t lane = 0; lane < kWidth; ++lane) {
          to.lower[k][i % kWidth] = std::min<int16_t>(to.lower[k][i % kWidth], from.lower[k][lane]);
          to.upper[k][i % kWidth] = std::max<int16_t>(to.upper[k][i % kWidth], from.upper[k][lane]);
        }
      }
    }
  }
}

template class CellTree<2>;
template class CellTree<3>;

}  // namespace dsw
