#include "environment/cell_index.h"

#include "base/slot_pool.h"
#include "environment/environment.h"

namespace dsw {

template <int D>
bool CellIndex<D>::is_current(const Environment<D>& env, const CellTree<D>& tree) const noexcept {
  if (tree.version.load(std::memory_order_acquire) != env.points_version) return false;
  const size_t beside = made_.size() - tree.made_before;
  return beside == 0 || tree.wear.fetch_add(beside, std::memory_order_relaxed) <= kMostWear * tree.cell_count();
}

template <int D>
void CellIndex<D>::make(const Environment<D>& env, const Parallel& parallel, Owned<CellTree<D>>& made) const {
  made.make(memory_);
  made.get()->build(env, parallel);
}

/** Puts a new tree in front of the one that there is. */
template <int D>
void CellIndex<D>::put(const Environment<D>& env, Owned<CellTree<D>>& made) const noexcept {
  made.get()->made_before = made_.size();
  made.get()->version.store(env.points_version, std::memory_order_relaxed);
  made.get()->older = tree_.load(std::memory_order_relaxed);
  tree_.store(made.release(), std::memory_order_release);
  scans_.store(kScansFirst, std::memory_order_relaxed);
}

/** Points move while nobody reads, so nobody reads a tree that has to be fitted to them. A new tree and the worn
 * one that it replaces can be read at the same time. */
template <int D>
const CellTree<D>* CellIndex<D>::renew(const Environment<D>& env) const noexcept {
  if (tree_.load(std::memory_order_acquire) == nullptr) {
    if (is_left_out(env)) return nullptr;
    if (scans_.fetch_add(1, std::memory_order_relaxed) < kScansFirst) return nullptr;
  }
  try {
    const std::lock_guard<std::mutex> lock(making_);
    CellTree<D>* const tree = tree_.load(std::memory_order_acquire);
    if (tree == nullptr || tree->version.load(std::memory_order_relaxed) == env.points_version) {
      if (tree == nullptr || !is_current(env, *tree)) {
        Owned<CellTree<D>> made(memory_);
        make(env, sharing_, made);
        put(env, made);
      }
    } else {
      tree->fit(env, sharing_);
      tree->version.store(env.points_version, std::memory_order_release);
    }
  } catch (...) {  // no memory: whoever asks looks at all cells
    return nullptr;
  }
  return tree_.load(std::memory_order_acquire);
}

template <int D>
void CellIndex<D>::prepare(const Environment<D>& env, const Parallel& parallel, size_t points) const noexcept {
  if (tree_.load(std::memory_order_acquire) != nullptr || is_left_out(env)) return;
  if (scans_.load(std::memory_order_relaxed) + points <= kScansFirst) return;
  try {
    std::unique_lock<std::mutex> lock(making_, std::defer_lock);
    if (parallel.run == nullptr) {
      lock.lock();
      if (tree_.load(std::memory_order_relaxed) != nullptr) return;
    }
    Owned<CellTree<D>> made(memory_);
    make(env, parallel, made);
    if (!lock.owns_lock()) lock.lock();
    if (tree_.load(std::memory_order_relaxed) == nullptr) put(env, made);
  } catch (...) {  // no memory: whoever asks looks at all cells
    return;
  }
}

template <int D>
void CellIndex<D>::build(const Environment<D>& env, const Parallel& parallel) {
  Owned<CellTree<D>> made(memory_);
  make(env, parallel, made);
  put(env, made);
}

template <int D>
void CellIndex<D>::set_use(TreeUse use) noexcept {
  release_with_older(memory_, tree_.exchange(nullptr));
  made_.clear();
  use_ = use;
}

/** Nobody reads: trees that have been replaced go. The last one goes, too, where as many cells have been made as it
 * has. */
template <int D>
void CellIndex<D>::make_room(size_t cells) {
  CellTree<D>* const tree = tree_.load(std::memory_order_relaxed);
  if (tree == nullptr) return;
  release_with_older(memory_, std::exchange(tree->older, nullptr));
  if (tree->made_before == made_.size()) {
    tree->made_before = 0;
    made_.clear();
  }
  if (made_.size() <= tree->cell_count()) return reserve_more(made_, cells);
  set_use(use_);
}

template <int D>
uint64_t CellIndex<D>::memory_bytes() const noexcept {
  return array_bytes(made_) + memory_bytes_with_older(tree_.load(std::memory_order_acquire));
}

template class CellIndex<2>;
template class CellIndex<3>;

}  // namespace dsw
