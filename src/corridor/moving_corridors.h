#pragma once
// Edges of which both ends move, inside of convex cells that they are known to cross.

#include "corridor/ask.h"
#include "corridor/ridge_rings.h"

namespace dsw {

/** The only facet between two cells, seen from the first, if there is just one and it is passable. */
template <int D>
HalfFacet find_only_facet(const Environment<D>& env, Cell from, Cell to) noexcept;

/** One for each thread. */
template <int D>
class MovingCorridors {
 public:
  explicit MovingCorridors(const Environment<D>& env)
      : env_(env), writer_(env.memory), rings_(env), paths_{Array<uint32_t>(env.memory), Array<uint32_t>(env.memory)} {}

  /** Asks about the ways of both ends, up to `places` on them: kUnknown, kHolds, or kStopsAtRidge where the edge may touch
   * `features`. If the answer is kHolds, and the places are the ends of the ways, the corridor becomes that of the end.
   * Throws std::bad_alloc.
   * @param ends where a path is blocked, `arrival` is not valid.
   * @param call the number of the call on the body.
   * @param is_kept whether the corridor serves another call, and should become that of the end. */
  Verdict ask(Corridor<D>& corridor, uint64_t call, const PointWay (&ends)[2], const double* const (&places)[2],
              bool are_ends, bool is_kept = true);
  /** Whether an edge in two cells passes the only facet between them on its whole way: much cheaper than to ask, and nothing is
   * noted. The facets that its ends pass are known, or they do not leave their cells. */
  bool keeps_to_facet(const PointWay (&ends)[2]) const noexcept;
  /** What the last edge may touch. */
  CandidateView<D> features() const noexcept { return rings_.features(); }
  /** Takes the last edge on: its corridor becomes that of the ends of its ways, if a few turns are enough. Nothing is
   * done if an end is blocked. */
  void go_on(Corridor<D>& corridor, uint64_t call, const PointWay (&ends)[2]);

  CastCounters* counters = nullptr;

 private:
  bool find_path(const PointWay& end, const double* place, Array<uint32_t>& path);
  bool cast_path(const double* from, const double* to, Cell start, Cell end);
  bool is_of(const Corridor<D>& corridor, const PointWay& a, const PointWay& b) const;
  bool note_start(Corridor<D>& corridor, uint64_t call, const PointWay& a, const PointWay& b);
  bool stays(Corridor<D>& corridor, uint64_t call, const PointWay& a, const PointWay& b);
  bool passes_all(Corridor<D>& corridor, const PointWay& a, const PointWay& b) const;

  const Environment<D>& env_;
  CorridorWriter<D> writer_;
  RidgeRings<D> rings_;
  Array<uint32_t> paths_[2];  // the facets that each end passes, each seen from the cell that is left
};

}  // namespace dsw
