#pragma once
// Which edges of a body on its course have to be looked at one by one.

#include "base/compiler.h"
#include "response/course_casts.h"

namespace dsw {

/** Gives edges a chunk at a time, without those that do not move or are known to be free. */
template <int D>
class EdgeSieve {
 public:
  EdgeSieve(const Environment<D>& env, SimplexSweep<D>& sweeps, Course<D>& course, CourseCasts<D>& casts)
      : env_(env), sweeps_(sweeps), course_(course), casts_(casts) {}

  /** @param may_skip whether edges may be left out on their way that are free where they end. Throws std::bad_alloc. */
  void start(bool may_skip);
  /** The next chunk; false: there is none. Throws std::bad_alloc. */
  bool next();
  /** Lets what is known of them come near. */
  DSW_PREFETCH void prefetch_corridors() const {
    constexpr size_t kLine = 64;
    for (const uint32_t e : *this) {
      const auto* const corridor = reinterpret_cast<const char*>(&course_.motion.body->corridors[e]);
      for (size_t at = 0; at < sizeof(Corridor<D>); at += kLine) prefetch_line(corridor + at);
    }
  }
  const uint32_t* begin() const { return chunk_; }
  const uint32_t* end() const { return chunk_ + count_; }

 private:
  static constexpr uint32_t kChunk = 64;
  static constexpr uint32_t kMoves = 1, kSure = 2, kInwards = 4;  // of a vertex: in this order, see sift
  using Vertex = typename Course<D>::Vertex;

  void measure_clearances();
  void find_inwards();
  void note_vertices();
  void gather();
  void sift();
  uint32_t skip_inside(uint32_t e);
  void cast_where_it_arrives(uint32_t e);
  template <class Drops>
  void drop(Drops drops);
  template <class Skips>
  void drop_and_cast(Skips skips);
  bool sees_all_of_cell(uint32_t v);
  void drop_inside();
  void drop_clear();
  void drop_similar();
  void drop_back();

  const Environment<D>& env_;
  SimplexSweep<D>& sweeps_;
  Course<D>& course_;
  CourseCasts<D>& casts_;
  bool may_skip_ = false;
  bool sifts_ = false;   // edges are sifted while they are gathered
  bool others_ = false;  // a vertex stays in a cell that is not convex
  uint32_t next_ = 0, count_ = 0;
  uint32_t chunk_[kChunk] = {};
  Array<double> rooms_{env_.memory};    // by vertex, if balls are kept: see room_squared
  Array<uint32_t> stays_{env_.memory};  // by vertex: the convex cell in which it stays; kNone: it does not
  Array<uint8_t> states_{env_.memory};  // by vertex: whether it moves, is beyond doubt, goes inwards
};

}  // namespace dsw
