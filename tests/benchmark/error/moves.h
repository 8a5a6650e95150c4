// Moves of single vertices with their edges and faces: what is true of each, and bodies that make them.
#ifndef DARTSWEEP_TESTS_BENCHMARK_ERROR_MOVES_H
#define DARTSWEEP_TESTS_BENCHMARK_ERROR_MOVES_H

#include "body_state.h"
#include "place.h"

#include <optional>

namespace dsw::curves {

/** Vertex 0 of a body goes to `to`, the others stay. */
struct Move {
  oracle::BodyPlan body;
  Vec to;
  oracle::MoveTruth truth;  // at the level asked for
};

/** Exact time of the first event; only where there is one. */
mpq_class time_of(const oracle::MoveTruth& truth);
/** Where the vertex is at that time, and how far a point is from it. */
double distance_at(const Vec& from, const Vec& to, const mpq_class& time, const double* point);

/** A body of `vertices` (1: a point, 2: an edge, 3: a face) whose edges from the first are `length` long, and a move of `step`, with its
 * truth. */
Move random_move(Place& place, Rng& rng, int vertices, double length, double step, dsw_level level);
/** Likewise, with the first vertex near `start`; nothing where what is tried is not free. */
std::optional<Move> move_from(Place& place, Rng& rng, const Vec& start, int vertices, double length, double step,
                              dsw_level level);

/** Many bodies in one scene, each of which makes its move; one call moves all. */
class Movers {
 public:
  Movers(Place& place, const std::vector<Move>& moves, dsw_level level, const dsw_move_options& options,
         std::uint32_t flags = 0);
  ~Movers() { clear(); }
  Movers(const Movers&) = delete;
  Movers& operator=(const Movers&) = delete;

  /** Puts all bodies back to where they start. */
  void prepare();
  void run();
  /** The contact of body i in the last run, or null. */
  const dsw_contact* contact(std::size_t i) const;

 private:
  void clear();

  const std::vector<Move>& moves_;
  dsw_level level_;
  dsw_move_options options_;
  std::uint32_t flags_;
  oracle::ScenePtr scene_;
  std::vector<dsw_body_id> bodies_;
  std::vector<double> targets_;
};

dsw_move_options move_options();

}  // namespace dsw::curves

#endif
