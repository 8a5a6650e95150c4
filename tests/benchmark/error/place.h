// The environments of the curves: a lattice of tetrahedra, shaken so that nothing is flat or in a row, and what is
// impassable in it, as the library sees it and as the oracle does.
#ifndef DARTSWEEP_TESTS_BENCHMARK_ERROR_PLACE_H
#define DARTSWEEP_TESTS_BENCHMARK_ERROR_PLACE_H

#include "../engine.h"
#include "check.h"
#include "sweep_truth.h"

#include <memory>

namespace dsw::curves {

using oracle::Rng;
using oracle::Vec;

enum class Kind {
  kVessel,  // a winding lumen with closed walls
  kFaces,   // free-standing faces
  kSpikes   // free-standing tetrahedra
};

struct ContextDelete {
  void operator()(dsw_context* context) const { dsw_context_destroy(context); }
};

/** Throws with the library's message unless the status is DSW_STATUS_OK. */
void check(dsw_status status);

/** |a - b|, rounded. */
double difference(double a, const mpq_class& b);

class Place {
 public:
  /** Cubes of unit edge, `side` along each axis, six tetrahedra in each: one cell is 1 long. */
  Place(Kind kind, int side, std::uint64_t seed);
  ~Place() = default;
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  dsw_environment* environment() const { return environment_.get(); }
  /** A new scene; one thread. */
  oracle::ScenePtr scene(std::uint32_t features = 0) const;
  oracle::World& world() { return *world_; }
  oracle::SweepWorld& exact() { return *exact_; }
  /** The impassable faces, for the peers. */
  const bench::WallMesh& walls() const { return *walls_; }

  /** A random point of a random cell in which something can move. */
  Vec point(Rng& rng);
  /** A random point in such a cell, within some distance of something impassable. */
  Vec point_at_wall(Rng& rng, double distance);
  /** A vector of this length in a random direction. */
  static Vec direction(Rng& rng, double length);
  /** Whether no edge of it meets anything; exact. */
  bool is_free(const std::vector<Vec>& polyline);
  /** In a cell in which something can move. */
  bool is_open(const Vec& p) const;
  /** Inside of the whole, with this margin. */
  bool holds(const Vec& p, double margin = 0.5) const;

 private:
  void mark_faces();
  void mark_volumes(double share, Rng& rng);

  int side_;
  std::unique_ptr<dsw_context, ContextDelete> context_;
  oracle::EnvironmentPtr environment_;
  std::unique_ptr<oracle::World> world_;
  std::unique_ptr<oracle::SweepWorld> exact_;
  std::vector<double> points_;  // of the walls
  std::unique_ptr<bench::WallMesh> walls_;
  std::vector<std::size_t> open_;  // cells in which something can move
  std::vector<char> is_open_;      // by cell
};

}  // namespace dsw::curves

#endif
