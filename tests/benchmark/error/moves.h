// Moves of single vertices with their edges and faces: what is true of each, and bodies that make them.
#ifndef DARTSWEEP_TESTS_BENCHMARK_ERROR_MOVES_H
#define DARTSWEEP_TESTS_BENCHMARK_ERROR_MOVES_H

#include "body_state.h"
#include "place.h"

#include <optional>

namespace dsw::curves {

/** A body and where all of its vertices go to in one move. */
struct Trip {
  oracle::BodyPlan body;
  std::vector<Vec> targets;
};

/** One in which vertex 0 alone goes elsewhere, and what is true of it at the level asked for. */
struct Move : Trip {
  oracle::MoveTruth truth;
};

/** Exact time of the first event; only where there is one. */
mpq_class time_of(const oracle::MoveTruth& truth);
/** Where the vertex is at that time, and how far a point is from it. */
double distance_at(const Vec& from, const Vec& to, const mpq_class& time, const double* point);

/** A body of `vertices` (1: a point, 2: an edge, 3: a face) whose edges from the first are `length` long, and a move of
 * `step`, with its truth. */
Move random_move(Place& place, Rng& rng, int vertices, double length, double step, dsw_level level);
/** Makes a body and a move, as random_move does, with the first vertex near `start`; nothing if the place that is tried
 * is not free. */
std::optional<Move> move_from(Place& place, Rng& rng, const Vec& start, int vertices, double length, double step,
                              dsw_level level);

/** Exact time, no distance kept: what an approximation is compared with. */
dsw_move_options move_options();

/** How bodies are made and moved. */
struct Setting {
  dsw_level level = DSW_LEVEL_EDGES_SWEPT;
  std::uint32_t flags = 0;
  double motion_share = 0;
  dsw_move_options options = move_options();
};

dsw_body_id create_body(dsw_scene* scene, const oracle::BodyPlan& plan, const Setting& setting);

/** Many bodies in one scene, each of which makes its trip; one call moves all. */
class Movers {
 public:
  /** @param trips a vector of Trip or Move; stays as it is. */
  template <class Trips>
  Movers(Place& place, const Trips& trips, const Setting& setting) : setting_(setting), scene_(place.scene()) {
    for (const Trip& trip : trips) add(trip);
  }

  /** Puts all bodies back to where they start. */
  void prepare();
  void run();
  /** Contacts of body i in the last run. */
  std::vector<dsw_body_contact> contacts(std::size_t i) const;

 private:
  void add(const Trip& trip);

  Setting setting_;
  oracle::ScenePtr scene_;
  std::vector<const Trip*> trips_;
  std::vector<dsw_body_id> bodies_;
  std::vector<double> targets_;
};

std::vector<Vec> positions_of(const dsw_scene* scene, dsw_body_id body, std::size_t vertices);

}  // namespace dsw::curves

#endif
