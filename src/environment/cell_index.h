#pragma once
// Which cells may contain a point: the tree of an environment. The tree is made when it is worth it, and kept right
// when cells or points change. Any number of readers may ask at a time; one of them makes the tree, the others wait
// for it.

#include <atomic>
#include <mutex>

#include "base/owned.h"
#include "environment/cell_tree.h"

namespace dsw {

enum class TreeUse : uint32_t { kAtNeed, kAtOnce, kLeftOut };

template <int D>
class CellIndex {
 public:
  explicit CellIndex(const Memory* memory) : memory_(memory), made_(Allocator<uint32_t>(memory)) {}
  ~CellIndex() { release_with_older(memory_, tree_.load(std::memory_order_relaxed)); }
  CellIndex(const CellIndex&) = delete;
  CellIndex& operator=(const CellIndex&) = delete;

  /** Calls look(index) for all cells that may contain the point, some of which may be gone. False: there is no
   * tree, and all cells have to be looked at. The first tree is made after a few such answers, which take as long
   * as to make it. */
  template <class Look>
  bool visit(const Environment<D>& env, const double* point, Look&& look) const noexcept {
    return ask(
        env, [&](const CellTree<D>& tree) { tree.visit(point, look); }, look);
  }
  /** Calls ask(tree), and look(index) for the cells that are not in the tree. False: there is no tree. */
  template <class Ask, class Look>
  bool ask(const Environment<D>& env, Ask&& ask, Look&& look) const {
    const CellTree<D>* tree = tree_.load(std::memory_order_acquire);
    if (tree == nullptr || !is_current(env, *tree)) tree = renew(env);
    if (tree == nullptr) return false;
    ask(*tree);
    for (size_t i = tree->made_before; i < made_.size(); ++i) look(made_[i]);
    return true;
  }
  /** For readers that are about to ask for so many points, before they share these out: makes the first tree if it will be
   * needed, on the threads of `parallel`. While a host's pool makes it no lock is held, because the pool may run other readers then. */
  void prepare(const Environment<D>& env, const Parallel& parallel, size_t points) const noexcept;
  /** Whether there is a tree that fits the points as they are. */
  bool is_ready(const Environment<D>& env) const noexcept {
    const CellTree<D>* const tree = tree_.load(std::memory_order_acquire);
    return tree != nullptr && tree->version.load(std::memory_order_acquire) == env.points_version;
  }

  /** For writers. The tree is made now. Throws std::bad_alloc. */
  void build(const Environment<D>& env, const Parallel& parallel);
  void build(const Environment<D>& env) { build(env, sharing_); }
  /** For writers. Trees that readers make are made on threads of our own, if `parallel` is of these: a host's pool may be
   * waiting for the reader. */
  void share(const Parallel& parallel) noexcept { sharing_ = parallel.run == nullptr ? parallel : kOneThread; }
  TreeUse use() const noexcept { return use_; }
  /** For writers. A tree that there is goes. */
  void set_use(TreeUse use) noexcept;
  /** For writers. Room for so many cells that are made. Throws std::bad_alloc. */
  void make_room(size_t cells);
  /** For writers. A cell that was made, in the room for it. */
  void add(uint32_t index) noexcept {
    if (tree_.load(std::memory_order_relaxed) != nullptr) made_.push_back(index);
  }
  uint64_t memory_bytes() const noexcept;

 private:
  static constexpr uint32_t kFewCells = 32;   // are looked at one by one
  static constexpr uint32_t kScansFirst = 8;  // that take as long as to make a tree
  static constexpr uint64_t kMostWear = 16;   // cells looked at one by one, for each cell that a new tree sorts

  bool is_current(const Environment<D>& env, const CellTree<D>& tree) const noexcept;
  const CellTree<D>* renew(const Environment<D>& env) const noexcept;
  void put(const Environment<D>& env, Owned<CellTree<D>>& made) const noexcept;
  void make(const Environment<D>& env, const Parallel& parallel, Owned<CellTree<D>>& made) const;
  bool is_left_out(const Environment<D>& env) const noexcept {
    return use_ == TreeUse::kLeftOut || env.map.cell_count < kFewCells;
  }

  const Memory* memory_;
  Parallel sharing_ = kOneThread;
  TreeUse use_ = TreeUse::kAtNeed;
  mutable std::atomic<uint32_t> scans_{0};
  mutable std::mutex making_;
  mutable std::atomic<CellTree<D>*> tree_{nullptr};  // and, behind it, those that it replaced
  Array<uint32_t> made_;                             // indices of cells made since there is a tree
};

}  // namespace dsw
