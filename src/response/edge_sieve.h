#pragma once
// Which edges of a body on its course have to be looked at one by one.

#include "base/compiler.h"
#include "response/course_casts.h"
#include "response/short_edges.h"

namespace dsw {

/** Gives edges a chunk at a time, without those that do not move or are known to be free. */
template <int D>
class EdgeSieve {
 public:
  EdgeSieve(const Environment<D>& env, SimplexSweep<D>& sweeps, Course<D>& course, CourseCasts<D>& casts)
      : env_(env), sweeps_(sweeps), course_(course), casts_(casts), short_(env, course) {}

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
  uint32_t count() const { return count_; }
  /** Which edges of the chunk are seen to be free where their ends go. At EDGES, where no corridors are kept. */
  typename ShortEdges<D>::Seen find_short() {
    return sees() ? short_.find(chunk_, count_) : typename ShortEdges<D>::Seen{};
  }

 private:
  static constexpr uint32_t kChunk = 64;
  using Vertex = typename Course<D>::Vertex;

  bool sees() const { return D == 3 && sees_; }
  void measure_clearances();
  void find_inwards();
  void gather();
  /** Bits of the edges of a block. */
  struct Sifted {
    uint64_t inside = 0;     // stay in a convex cell
    uint64_t back = 0;       // go inwards
    uint64_t kept = 0;       // move, and are neither
    uint64_t one_stays = 0;  // of `inside` and `back`: one end does not move
    uint64_t inwards = 0;    // of `inside`: of a closed surface, and an end goes inwards
  };
  void sift();
  uint64_t closed(const BodyEdge* edges, uint64_t which) const;
  Sifted sift_block(uint32_t first, uint32_t count, bool skips_back) const;
  void sift_odd(const BodyEdge& edge, uint64_t bit, bool skips_back, Sifted& sifted) const;
  void count_sifted(uint32_t first, const Sifted& block, bool leaves);
  uint32_t skip_inside(uint32_t e);
  void cast_where_they_arrive(const uint32_t* edges, uint32_t count);
  void cast_where_they_arrive(uint32_t first, uint64_t which);
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
  ShortEdges<D> short_;
  bool may_skip_ = false;
  bool sifts_ = false;        // edges are sifted while they are gathered
  bool fills_ = false;        // and a chunk is filled, since edges that are dropped are not cast in between
  bool sees_ = false;         // edges may be free that are seen to be, in space
  bool may_be_free_ = false;  // there are free slots of edges
  bool is_closed_ = false;    // every edge has two faces
  uint32_t next_ = 0, count_ = 0;
  uint32_t over_ = 0;  // edges behind the chunk, for the next one
  uint32_t chunk_[2 * kChunk] = {};
  Array<double> rooms_{env_.memory};  // by vertex, if balls are kept: see room_squared
  Array<double> ways_{env_.memory};   // by vertex, if back edges are skipped: see FindInwards
};

}  // namespace dsw
