#pragma once
// The corridors of a body's edges. Most edges of a fine surface lie in one cell, and take a pointer each.

#include <new>

#include "corridor/corridor.h"

namespace dsw {

/** One for each edge, by its number. Those that nothing is kept of but that they are empty, or unknown, are the same two. */
template <int D>
class Corridors {
 public:
  explicit Corridors(const Memory* memory) : at_(memory), common_(memory) {}
  Corridors(const Corridors& other);
  Corridors(Corridors&& other) noexcept : at_(other.at_.get_allocator()), common_(other.common_.get_allocator()) {
    swap(other);
  }
  Corridors& operator=(Corridors other) noexcept {
    swap(other);
    return *this;
  }
  ~Corridors() { release(0); }

  size_t size() const noexcept { return at_.size(); }
  /** May be one that is common to many edges: it may be read and followed. To change it, ask for the edge's own. */
  Corridor<D>& operator[](size_t edge) const noexcept { return *at_[edge]; }
  /** Whether nothing is kept of an edge but that it lies in one cell. */
  bool is_plain(size_t edge) const noexcept { return at_[edge] == common_.data(); }
  /** The corridor of this edge alone, to be changed. One that was empty is of every version of the environment, so it becomes
   * one of `version`. Throws std::bad_alloc. */
  Corridor<D>& own(size_t edge, uint64_t version) { return is_common(at_[edge]) ? make(edge, version) : *at_[edge]; }
  /** Makes what is known unknown. */
  void forget(size_t edge) noexcept {
    if (is_common(at_[edge])) {
      at_[edge] = common_.data() + 1;
    } else {
      at_[edge]->forget();
    }
  }
  /** Puts `corridor` in the place of an edge's own one, and that in its place. */
  void swap_own(size_t edge, Corridor<D>& corridor) noexcept { std::swap(*at_[edge], corridor); }

  /** Adds edges whose corridors are empty, or takes the last ones away. Throws std::bad_alloc, and then nothing has changed. */
  void resize(size_t count);
  void shrink_to_fit() { at_.shrink_to_fit(); }
  uint64_t memory_bytes() const noexcept;

 private:
  bool is_common(const Corridor<D>* corridor) const noexcept {
    return corridor == common_.data() || corridor == common_.data() + 1;
  }
  Corridor<D>& make(size_t edge, uint64_t version);
  Corridor<D>* copy_of(const Corridor<D>& corridor) const;
  void release(size_t from) noexcept;
  void swap(Corridors& other) noexcept {
    at_.swap(other.at_);
    common_.swap(other.common_);
  }

  Array<Corridor<D>*> at_;
  Array<Corridor<D>> common_;  // an empty one and an unknown one, once there are edges
};

}  // namespace dsw
