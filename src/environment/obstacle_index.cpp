#include "environment/obstacle_index.h"

#include <new>

#include "base/owned.h"
#include "base/sort.h"
#include "environment/environment.h"
#include "environment/obstacles.h"

namespace dsw {

template <int D>
bool ObstacleIndex<D>::is_current(const Environment<D>& env, const CellTree<D>& tree) const noexcept {
  if (tree.version.load(std::memory_order_acquire) != env.points_version) return false;
  if (!is_resolved_.load(std::memory_order_acquire)) return false;
  const size_t beside = noted_.size() - tree.made_before;
  return beside == 0 || tree.wear.fetch_add(beside, std::memory_order_relaxed) <= kMostWear * (tree.cell_count() + 16);
}

template <int D>
uint32_t ObstacleIndex<D>::patience(const Environment<D>& env) const noexcept {
  if (env.index.use() == TreeUse::kLeftOut) return kNoCell;
  const bool counts = flooded_version_.load(std::memory_order_relaxed) == env.points_version;
  const uint64_t done = counts ? flooded_.load(std::memory_order_relaxed) : 0;
  const uint64_t most = kFirstFloods + env.map.cell_count / kFloodShare;
  return static_cast<uint32_t>(done < most ? most - done : 0);
}

template <int D>
void ObstacleIndex<D>::note_flood(const Environment<D>& env, size_t cells) const noexcept {
  if (env.index.use() == TreeUse::kLeftOut) return;
  if (flooded_version_.exchange(env.points_version, std::memory_order_relaxed) != env.points_version) {
    flooded_.store(0, std::memory_order_relaxed);  // a tree for where points were before was not worth it
  }
  flooded_.fetch_add(cells, std::memory_order_relaxed);
}

/** Points move, and cells and marks change, while nobody reads. So nobody reads the boxes of a tree for other points,
 * or the list while it gets longer. A new tree and the worn one that it replaces can be read at the same time. */
template <int D>
const CellTree<D>* ObstacleIndex<D>::renew(const Environment<D>& env) const noexcept {
  const auto is_for_points = [&](const CellTree<D>* tree) {
    return tree != nullptr && tree->version.load(std::memory_order_relaxed) == env.points_version;
  };
  if (!is_for_points(tree_.load(std::memory_order_acquire)) && patience(env) != 0) return nullptr;
  try {
    const std::lock_guard<std::mutex> lock(making_);
    const CellTree<D>* const tree = tree_.load(std::memory_order_acquire);
    if (!is_for_points(tree)) {
      flooded_.store(0, std::memory_order_relaxed);  // nor is it tried again at once if there is no memory
      gather(env);
    } else {
      if (!is_resolved_.load(std::memory_order_relaxed)) resolve(env);
      if (!is_current(env, *tree)) merge(env);
    }
  } catch (...) {  // no memory: who asks floods
    return nullptr;
  }
  return tree_.load(std::memory_order_acquire);
}

/** A tree of all obstacles that there are. One for other points is written anew in its place, since readers who wait
 * look at its version. */
template <int D>
void ObstacleIndex<D>::gather(const Environment<D>& env) const {
  Array<uint32_t> cells{Allocator<uint32_t>(memory_)};
  for_each_cell(env.map, [&](Cell c) {
    if (has_obstacle(env, c)) cells.push_back(env.map.index(c));
  });
  noted_.clear();
  vertices_.clear();
  is_resolved_.store(true, std::memory_order_release);
  CellTree<D>* const tree = tree_.load(std::memory_order_relaxed);
  if (tree == nullptr) return put(env, cells, nullptr);
  release_with_older(memory_, std::exchange(tree->older, nullptr));
  tree->build(env, cells);
  tree->made_before = 0;
  tree->wear.store(0, std::memory_order_relaxed);
  tree->version.store(env.points_version, std::memory_order_release);
}

/** Notes the cells at vertices that were noted. */
template <int D>
void ObstacleIndex<D>::resolve(const Environment<D>& env) const {
  dsw::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  bool has_room = true;
  const auto look = [&](uint32_t index) {
    const Cell c = env.map.cell(index);
    for (uint32_t i = 0, n = c.valid() ? env.map.vertices_of(c) : 0; i < n; ++i) {
      if (!std::binary_search(vertices_.begin(), vertices_.end(), env.map.vertex(c, i))) continue;
      try {
        noted_.push_back(index);
      } catch (...) {
        has_room = false;
      }
      return;
    }
  };
  for (const uint32_t v : vertices_) {
    if (v < env.map.vertex_count && env.index.visit(env, env.point(v), look)) continue;
    for_each_cell(env.map, [&](Cell c) { look(env.map.index(c)); });
    break;
  }
  if (!has_room) throw std::bad_alloc();
  vertices_.clear();
  is_resolved_.store(true, std::memory_order_release);
}

/** A tree of its cells and those beside it that still have obstacles, in front of it. */
template <int D>
void ObstacleIndex<D>::merge(const Environment<D>& env) const {
  CellTree<D>* const tree = tree_.load(std::memory_order_relaxed);
  Array<uint32_t> cells(tree->cells().begin(), tree->cells().end(), Allocator<uint32_t>(memory_));
  for_each_beside(*tree, [&](uint32_t index) { cells.push_back(index); });
  dsw::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const auto is_idle = [&](uint32_t index) {
    const Cell c = env.map.cell(index);
    return !c.valid() || !has_obstacle(env, c);
  };
  cells.erase(std::remove_if(cells.begin(), cells.end(), is_idle), cells.end());
  put(env, cells, tree);
}

template <int D>
void ObstacleIndex<D>::put(const Environment<D>& env, const Array<uint32_t>& cells, CellTree<D>* older) const {
  Owned<CellTree<D>> made(memory_);
  made.make(memory_, BoxOf::kObstacles);
  made.get()->build(env, cells);
  made.get()->made_before = noted_.size();
  made.get()->version.store(env.points_version, std::memory_order_relaxed);
  made.get()->older = older;
  tree_.store(made.release(), std::memory_order_release);
}

template <int D>
void ObstacleIndex<D>::build(const Environment<D>& env) {
  drop();
  gather(env);
}

/** Nobody reads: trees that have been replaced go. The last one goes, too, where more is noted than it has, or where
 * there is no memory to note it. */
template <int D>
void ObstacleIndex<D>::note(Array<uint32_t>& list, uint32_t item) noexcept {
  CellTree<D>* const tree = tree_.load(std::memory_order_relaxed);
  release_with_older(memory_, std::exchange(tree->older, nullptr));
  if (tree->made_before != 0 && tree->made_before == noted_.size()) {
    tree->made_before = 0;
    noted_.clear();
  }
  if (list.size() > kFirstFloods + tree->cell_count()) return drop();
  try {
    list.push_back(item);
  } catch (...) {
    drop();
  }
}

template <int D>
void ObstacleIndex<D>::drop() noexcept {
  release_with_older(memory_, tree_.exchange(nullptr));
  noted_.clear();
  vertices_.clear();
  is_resolved_.store(true, std::memory_order_relaxed);
}

template <int D>
uint64_t ObstacleIndex<D>::memory_bytes() const noexcept {
  return array_bytes(noted_) + array_bytes(vertices_) + memory_bytes_with_older(tree_.load(std::memory_order_acquire));
}

template class ObstacleIndex<2>;
template class ObstacleIndex<3>;

}  // namespace dsw
