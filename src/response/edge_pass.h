#pragma once
// Edges and faces of a body on its course, as if nobody met anything: vertices that may meet something are in doubt.

#include "response/edge_sieve.h"

namespace dsw {

/** What is done about edges that go towards the inside of a body [JCD10] 6.2: nothing, they are cast where they arrive, or they
 * are left. */
enum class BackEdges { kCast, kSkipped, kLeft };

template <int D>
class EdgePass {
 public:
  EdgePass(const Environment<D>& env, SimplexSweep<D>& sweeps, Course<D>& course, CourseCasts<D>& casts)
      : env_(env), sweeps_(sweeps), course_(course), casts_(casts), sieve_(env, sweeps, course, casts) {}

  /** @param may_skip whether edges may be left out on their way that are free where they end.
   * @param may_guess whether vertices may be in doubt by what is forecast alone: each of them is then moved alone.
   * Throws std::bad_alloc. */
  void sweep(bool may_skip, bool may_guess);

 private:
  using End = typename CourseCasts<D>::End;
  using Vertex = typename Course<D>::Vertex;
  /** How many tests of an edge are left out, and whether that of its last end is. */
  struct Left {
    uint8_t tests = 0, last = 0;
  };

  template <BackEdges Back>
  void pass_places();
  template <BackEdges Back>
  void count_plain(uint64_t which, uint64_t inwards);
  template <BackEdges Back>
  static Left left_out(const Vertex& a, const Vertex& b, bool is_closed);
  template <BackEdges Back>
  void cast_places(uint32_t e, bool first_seen, bool second_seen);
  void add_place(bool is_seen, uint32_t e, uint32_t v, const End& from, const End& to);
  void ask_side_by_side();
  bool keeps_between(uint32_t e) const;
  void sweep_chunk();
  void sweep_ways(uint32_t e);
  void sweep_way(uint32_t e, uint32_t v, uint32_t other, bool boxed);
  bool is_boxed(uint32_t e);

  const Environment<D>& env_;
  SimplexSweep<D>& sweeps_;
  Course<D>& course_;
  CourseCasts<D>& casts_;
  EdgeSieve<D> sieve_;
  bool may_guess_ = false;
  uint64_t inside_ = 0, keeping_ = 0;  // of the edges of a chunk: those that ask_side_by_side has decided
};

/** Its edges have been swept. */
template <int D>
class FacePass {
 public:
  FacePass(const Environment<D>& env, SimplexSweep<D>& sweeps, Course<D>& course)
      : env_(env), sweeps_(sweeps), course_(course) {}

  /** Throws std::bad_alloc. */
  void sweep();

 private:
  void find_sides();
  void sweep_face(uint32_t f);
  bool is_boxed(uint32_t f);
  bool keeps_at_rest(uint32_t e) const;
  bool shares_corridor(uint32_t f) const;

  const Environment<D>& env_;
  SimplexSweep<D>& sweeps_;
  Course<D>& course_;
  Array<uint32_t> sides_{env_.memory};  // by face: its edges, that opposite of corner k in place k
};

}  // namespace dsw
