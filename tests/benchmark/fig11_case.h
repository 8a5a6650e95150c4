// Figure 11 of [JCD10]: 225 deformable hexahedra of 8 particles in a lattice, simulated by shape matching while
// obstacles come and go. What they do is recorded once, so that all engines answer the same casts.
#ifndef DARTSWEEP_TESTS_BENCHMARK_FIG11_CASE_H
#define DARTSWEEP_TESTS_BENCHMARK_FIG11_CASE_H

#include "change_list.h"
#include "surface_bodies.h"

namespace dsw::bench {

constexpr std::size_t kBodies = 225;
constexpr std::size_t kCastsPerParticle = 4;  // its own move and its three edges
constexpr std::size_t kStepsPerChange = 10;

/** What happens in a scene, step by step. */
struct Script {
  std::size_t particles = 0, steps = 0;
  std::vector<double> starts;                // of the particles, before the first step
  std::vector<std::vector<double>> targets;  // of each step
  /** Where particles are: before the first step, then after each. */
  std::vector<std::vector<double>> positions;
  std::vector<std::vector<dsw_volume_id>> volumes;
  /** Before every tenth step obstacles vanish and others appear; empty if nothing changes. */
  std::vector<std::array<WallChange, 2>> changes;
  std::vector<WallChange> undo;                              // brings back the lattice as it was
  std::size_t slots = 0;                                     // ids of walls
  double mean_step = 0, deformation = 0, stopped_share = 0;  // see SoftHexahedra; of the moves of particles

  /** Casts of a step. */
  std::size_t batch() const { return kCastsPerParticle * particles; }
  /** What the method casts in some steps: of every particle its move p p', then q p' for its edges, q where p's turn
   * finds it. A batch is a step. */
  Segments casts(std::size_t first_step, std::size_t count) const;
};

struct Fig11Case {
  explicit Fig11Case(std::size_t cells);

  BodyShape shape;  // 12 edges
  BodyShape skin;   // also a closed surface of 12 triangles, whose diagonals are edges
  scenes::HexGrid grid;
  World world;
  WallMesh walls;

  /** Simulates some steps at DSW_LEVEL_EDGES and records them.
   * @param changed obstacles come and go; they are back when it returns. */
  Script record(std::size_t steps, bool changed);
};

void mark(const World& world, const WallChange& change);

}  // namespace dsw::bench

#endif
