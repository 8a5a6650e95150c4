#pragma once
// At which cells there may be an obstacle: a tree of the passable cells with obstacles (obstacles.h), for who asks what
// is nearest. The tree is made when floods have taken as long as to make it, and kept right when marks, cells or points
// change. Any number of readers may ask at a time; one of them makes the tree, the others wait for it.

#include <atomic>
#include <mutex>

#include "environment/cell_tree.h"

namespace dsw {

template <int D>
class ObstacleIndex {
 public:
  explicit ObstacleIndex(const Memory* memory)
      : memory_(memory), noted_(Allocator<uint32_t>(memory)), vertices_(Allocator<uint32_t>(memory)) {}
  ~ObstacleIndex() { release_with_older(memory_, tree_.load(std::memory_order_relaxed)); }
  ObstacleIndex(const ObstacleIndex&) = delete;
  ObstacleIndex& operator=(const ObstacleIndex&) = delete;

  /** The tree as it is right now, or null: who asks has to flood. */
  const CellTree<D>* find(const Environment<D>& env) const noexcept {
    const CellTree<D>* tree = tree_.load(std::memory_order_acquire);
    return tree != nullptr && is_current(env, *tree) ? tree : renew(env);
  }
  /** Calls look(index) for the cells that may have got obstacles since the tree was made; some may be gone. */
  template <class Look>
  void for_each_beside(const CellTree<D>& tree, Look&& look) const {
    for (size_t i = tree.made_before; i < noted_.size(); ++i) look(noted_[i]);
  }
  /** How many cells floods may visit before a tree is made; the largest number if none ever is. */
  uint32_t patience(const Environment<D>& env) const noexcept;
  /** For readers who had no tree: how many cells they visited. */
  void note_flood(const Environment<D>& env, size_t cells) const noexcept;

  /** For writers. The tree is made now. Throws std::bad_alloc. */
  void build(const Environment<D>& env);
  /** For writers. A cell may have got an obstacle. */
  void note_cell(uint32_t index) noexcept {
    if (exists()) note(noted_, index);
  }
  /** For writers. A vertex was marked, or an edge at it. */
  void note_vertex(uint32_t vertex) noexcept {
    if (!exists()) return;
    note(vertices_, vertex);
    is_resolved_.store(vertices_.empty(), std::memory_order_relaxed);
  }
  /** For writers: whether there is anything to note. */
  bool exists() const noexcept { return tree_.load(std::memory_order_relaxed) != nullptr; }
  /** For writers. A tree that there is goes. */
  void drop() noexcept;
  uint64_t memory_bytes() const noexcept;

 private:
  static constexpr size_t kFirstFloods = 4096;  // cells visited by floods before a tree is made, and
  static constexpr size_t kFloodShare = 12;     // a share of all cells: to visit so many takes as long as to make it
  static constexpr uint64_t kMostWear = 2;      // cells looked at one by one, for each cell that a new tree sorts

  bool is_current(const Environment<D>& env, const CellTree<D>& tree) const noexcept;
  const CellTree<D>* renew(const Environment<D>& env) const noexcept;
  void gather(const Environment<D>& env) const;
  void resolve(const Environment<D>& env) const;
  void merge(const Environment<D>& env) const;
  void put(const Environment<D>& env, const Array<uint32_t>& cells, CellTree<D>* older) const;
  void note(Array<uint32_t>& list, uint32_t item) noexcept;

  const Memory* memory_;
  mutable std::atomic<uint64_t> flooded_{0}, flooded_version_{0};  // cells; and where points were then
  mutable std::mutex making_;
  mutable std::atomic<CellTree<D>*> tree_{nullptr};  // and, behind it, those that it replaced
  mutable Array<uint32_t> noted_;                    // indices of cells that may have got obstacles since
  mutable Array<uint32_t> vertices_;                 // whose cells are not noted yet
  mutable std::atomic<bool> is_resolved_{true};      // there are none
};

}  // namespace dsw
