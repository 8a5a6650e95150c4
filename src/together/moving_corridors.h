#pragma once
// Edges of which both ends move, inside of convex cells that they are known to cross.

#include "together/ridge_rings.h"
#include "together/trajectory.h"

namespace dsw {

/** One for each thread. */
template <int D>
class MovingCorridors {
 public:
  explicit MovingCorridors(const Environment<D>& env)
      : env_(env), writer_(env.memory), rings_(env), paths_{Array<uint32_t>(env.memory), Array<uint32_t>(env.memory)} {}

  /** What an edge may touch on its way. kUnknown also for bodies that keep no corridors. */
  enum class Answer { kNothing, kFeatures, kUnknown };
  /** Asks about the ways of both ends, up to `places` on them. If the answer is kNothing, and the places are the ends of the
   * ways, the corridor becomes that of the end. Throws std::bad_alloc. */
  Answer ask(const Trajectory<D>& of, uint32_t edge, const double* const (&places)[2], bool are_ends);
  /** What the last edge may touch. */
  Candidates<D> features() const noexcept { return rings_.features(); }
  /** Takes the last edge on: its corridor becomes that of the ends of its ways, if a few turns are enough. Nothing is
   * done if an end is blocked. */
  void go_on(const Trajectory<D>& of, uint32_t edge);

  CastCounters* counters = nullptr;

 private:
  /** An end of an edge. */
  struct End {
    const double *start, *end;
    Cell from, to;                // `to` is not valid if the path is blocked
    const Array<uint32_t>& path;  // the facets that it passes, each seen from the cell that is left
  };
  End end_of(const Trajectory<D>& of, uint32_t edge, uint32_t k) const;
  bool find_path(const Trajectory<D>& of, uint32_t v, const double* place, Array<uint32_t>& path);
  bool cast_path(const double* from, const double* to, Cell start, Cell end);
  bool is_of(const Corridor<D>& corridor, const End& a, const End& b) const;
  bool note_start(Corridor<D>& corridor, uint64_t call, const End& a, const End& b);
  bool stays(Corridor<D>& corridor, uint64_t call, const End& a, const End& b);
  bool passes_all(Corridor<D>& corridor, const End& a, const End& b) const;

  const Environment<D>& env_;
  CorridorWriter<D> writer_;
  RidgeRings<D> rings_;
  Array<uint32_t> paths_[2];
};

}  // namespace dsw
