#include "environment/cell_tree.h"

#include <algorithm>
#include <cmath>

#include "base/compiler.h"
#include "environment/curve.h"
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
    const uint32_t n = env.map.vertices_of(c);
    if (content == BoxOf::kObstacles) {
      for_each_obstacle_vertex(env, c, add_vertex);
    } else if (env.checked.active()) {
      for (uint32_t i = 0; i < n; ++i) add_vertex(i);
    } else {
      for (uint32_t i = 0; i < n; ++i) add_finite(env.point(c, i));
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
  void add_finite(const double* p) noexcept {
    for (int k = 0; k < D; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
};

constexpr size_t kGroupsAtOnce = 2048;  // that one thread takes

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

/** Writes to each page of a block that is still unused. The system clears a page when it is first written to, which for
 * a large tree takes as long as all else: threads share it. */
void touch(void* block, size_t bytes, const Parallel& parallel) {
  constexpr size_t kPage = 4096, kPagesAtOnce = 1024;
  if (bytes < 4 * kPage * kPagesAtOnce) return;
  auto* const first = static_cast<unsigned char*>(block);
  auto write = [first](size_t begin, size_t end) noexcept {
    for (size_t page = begin; page < end; ++page) first[page * kPage] = 0;
  };
  parallel_chunks(parallel, bytes / kPage, kPagesAtOnce, write);
}

/** Calls body(i) for 0 .. count-1. */
template <class Body>
void for_groups(const Parallel& parallel, size_t count, const Body& body) {
  auto chunk = [&](size_t begin, size_t end) noexcept {
    for (size_t i = begin; i < end; ++i) body(i);
  };
  if (count <= kGroupsAtOnce) return chunk(0, count);
  parallel_chunks(parallel, count, kGroupsAtOnce, chunk);
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

/** What a tree is made from. */
template <int D>
struct CellTree<D>::Keys {
  explicit Keys(const Memory* memory) : groups(memory), others(memory), loose(memory) {}

  Curve<D> curve;
  Array<uint64_t> groups;  // of level 0, with their places on the curve; kLoose: its cells are sorted one by one
  Array<uint64_t> others;  // indices of those cells, with their places
  Array<uint32_t> loose;   // groups, while those of `others` are sought

  static constexpr uint64_t kLoose = ~uint64_t{0};

  /** The key of what lies in a box. */
  uint64_t key(const int16_t* lower, const int16_t* upper, uint32_t item) const noexcept {
    uint32_t middle[D];
    for (int k = 0; k < D; ++k) {
      middle[k] = static_cast<uint32_t>(lower[k] + upper[k] - 2 * INT16_MIN) >> (17 - kCurveBits);
    }
    return curve.key(middle, item);
  }
};

template <int D>
void CellTree<D>::build(const Environment<D>& env, const Parallel& parallel) {
  cells_.clear();
  cells_.reserve(env.map.cell_count);
  for_each_cell(env.map, [&](Cell c) { cells_.push_back(env.map.index(c)); });
  arrange(env, parallel);
}

template <int D>
void CellTree<D>::build(const Environment<D>& env, const Array<uint32_t>& cells) {
  cells_.assign(cells.begin(), cells.end());
  arrange(env, kOneThread);
}

template <int D>
void CellTree<D>::arrange(const Environment<D>& env, const Parallel& parallel) {
  set_frame(env);
  const size_t groups = set_levels();
  groups_.clear();
  groups_.reserve(groups);
  touch(groups_.data(), array_bytes(groups_), parallel);
  groups_.resize(groups);
  Keys keys(memory_);
  group_neighbours(env, parallel, keys);
  keep_neighbours(parallel, keys);
  group_others(env, parallel, keys);
  // Groups of cells that were sorted follow the curve.
  if (keys.loose.size() != leaf_groups()) {
    sort_along_curve<D>(keys.groups, parallel);
    put_in_order(keys);
  }
  fit_upper(parallel);
}

/** Moves each group of level 0 to its place along the curve, round by round. */
template <int D>
void CellTree<D>::put_in_order(Keys& keys) noexcept {
  const auto from = [&](size_t place) { return size_t{Curve<D>::item(keys.groups[place])}; };
  for (size_t first = 0; first < keys.groups.size(); ++first) {
    if (from(first) == first || kWidth * (first + 1) > cells_.size()) continue;
    const Group group = groups_[first];
    uint32_t cells[kWidth];
    std::copy_n(&cells_[kWidth * first], kWidth, cells);
    size_t place = first;
    while (from(place) != first) {
      const size_t next = from(place);
      groups_[place] = groups_[next];
      std::copy_n(&cells_[kWidth * next], kWidth, &cells_[kWidth * place]);
      keys.groups[place] = place;
      place = next;
    }
    groups_[place] = group;
    std::copy_n(cells, kWidth, &cells_[kWidth * place]);
    keys.groups[place] = place;
  }
}

/** Where the groups of each level begin. Returns how many there are. */
template <int D>
size_t CellTree<D>::set_levels() noexcept {
  size_t boxes = cells_.size(), groups = 0;
  level_count_ = 0;
  do {
    boxes = (boxes + kWidth - 1) / kWidth;
    level_first_[level_count_++] = static_cast<uint32_t>(groups);
    groups += boxes;
  } while (boxes > 1);
  return groups;
}

/** Makes groups of eight cells that follow each other. A group is kept where its box is no larger than those of its cells
 * together: then a point lies in no more groups than it would lie in cells' boxes. Boxes of obstacles are asked for what is
 * near, which they are for few cells: all of them are sorted. */
template <int D>
void CellTree<D>::group_neighbours(const Environment<D>& env, const Parallel& parallel, Keys& keys) {
  keys.groups.resize(leaf_groups());
  for_groups(parallel, leaf_groups(), [&](size_t g) {
    fit_group(env, g);
    const Group& group = groups_[g];
    const Hull hull(group);
    double whole = 1, sum = 0;
    for (int k = 0; k < D; ++k) whole *= hull.upper[k] - hull.lower[k] + 1;
    for (uint32_t i = 0; i < kWidth; ++i) {
      double part = 1;
      for (int k = 0; k < D; ++k) part *= std::max(0, group.upper[k][i] - group.lower[k][i] + 1);
      sum += part;
    }
    const bool is_kept = content_ == BoxOf::kCell && kWidth * (g + 1) <= cells_.size() && whole <= sum;
    keys.groups[g] = is_kept ? keys.key(hull.lower, hull.upper, 0) : Keys::kLoose;
  });
  for (size_t g = 0; g < leaf_groups(); ++g) {
    if (keys.groups[g] == Keys::kLoose) keys.loose.push_back(static_cast<uint32_t>(g));
  }
}

/** Puts the groups that are kept side by side; the cells of the rest go to keys.others. */
template <int D>
void CellTree<D>::keep_neighbours(const Parallel& parallel, Keys& keys) {
  const size_t kept = leaf_groups() - keys.loose.size();
  keys.others.resize(cells_.size() - kWidth * kept);
  for_groups(parallel, keys.loose.size(), [&](size_t i) {
    const size_t first = kWidth * size_t{keys.loose[i]};
    const Group& group = groups_[keys.loose[i]];
    for (uint32_t lane = 0; lane < kWidth && first + lane < cells_.size(); ++lane) {
      int16_t lower[D], upper[D];
      for (int k = 0; k < D; ++k) {
        lower[k] = group.lower[k][lane];
        upper[k] = group.upper[k][lane];
      }
      keys.others[kWidth * i + lane] = keys.key(lower, upper, cells_[first + lane]);
    }
  });
  size_t to = 0;
  for (size_t g = 0; g < leaf_groups(); ++g) {
    if (keys.groups[g] == Keys::kLoose) continue;
    if (to != g) {
      groups_[to] = groups_[g];
      std::copy_n(&cells_[kWidth * g], kWidth, &cells_[kWidth * to]);
    }
    keys.groups[to] = keys.groups[g] | to;
    ++to;
  }
}

/** Sorts the other cells along the curve, and makes groups of them. */
template <int D>
void CellTree<D>::group_others(const Environment<D>& env, const Parallel& parallel, Keys& keys) {
  const size_t kept = leaf_groups() - keys.loose.size();
  sort_along_curve<D>(keys.others, parallel);
  for (size_t i = 0; i < keys.others.size(); ++i) cells_[kWidth * kept + i] = Curve<D>::item(keys.others[i]);
  for_groups(parallel, keys.loose.size(), [&](size_t i) {
    const size_t g = kept + i;
    fit_group(env, g);
    const Hull hull(groups_[g]);
    // A group of fewer cells stays the last.
    const bool is_full = kWidth * (g + 1) <= cells_.size();
    keys.groups[g] =
        is_full ? keys.key(hull.lower, hull.upper, static_cast<uint32_t>(g)) : Keys::kLoose << kCurveItemBits | g;
  });
}

template <int D>
void CellTree<D>::fit(const Environment<D>& env, const Parallel& parallel) noexcept {
  set_frame(env);
  for_groups(parallel, leaf_groups(), [&](size_t g) { fit_group(env, g); });
  fit_upper(parallel);
}

/** The boxes of the cells of a group of level 0. Neighbours on the curve lie anywhere in memory. */
template <int D>
void CellTree<D>::fit_group(const Environment<D>& env, size_t group) noexcept {
  constexpr size_t kVerticesAhead = 8, kRecordAhead = 24;
  Group& to = groups_[group];
  to = nothing();
  const size_t first = kWidth * group, end = std::min(cells_.size(), first + kWidth);
  for (size_t i = first; i < end; ++i) {
    if (i + kRecordAhead < cells_.size()) prefetch_record(env, cells_[i + kRecordAhead]);
    if (i + kVerticesAhead < cells_.size()) prefetch_vertices(env, cells_[i + kVerticesAhead]);
    const Cell c = env.map.cell(cells_[i]);
    if (!c.valid()) continue;
    const Box<D> box(env, c, content_);
    for (int k = 0; k < D; ++k) {
      to.lower[k][i - first] = step(k, box.lower[k]);
      to.upper[k][i - first] = step(k, box.upper[k]);
    }
  }
}

/** The boxes of groups, from those of their parts. */
template <int D>
void CellTree<D>::fit_upper(const Parallel& parallel) {
  for (uint32_t level = 1; level < level_count_; ++level) {
    const uint32_t below = level_first_[level - 1], parts = level_first_[level] - below;
    for_groups(parallel, (parts + kWidth - 1) / kWidth, [&](size_t g) {
      Group& to = groups_[level_first_[level] + g];
      to = nothing();
      for (uint32_t i = 0; i < kWidth && kWidth * g + i < parts; ++i) {
        const size_t part = kWidth * g + i;
        const Hull hull(groups_[below + part]);
        for (int k = 0; k < D; ++k) {
          to.lower[k][i] = hull.lower[k];
          to.upper[k][i] = hull.upper[k];
        }
      }
    });
  }
}

template class CellTree<2>;
template class CellTree<3>;

}  // namespace dsw
