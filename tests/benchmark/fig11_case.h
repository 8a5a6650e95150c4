// Figure 11 of [JCD10]: tori of 18 vertices with six neighbours each in a lattice; what they do is recorded once, so that all
// engines answer the same casts.
#ifndef DARTSWEEP_TESTS_BENCHMARK_FIG11_CASE_H
#define DARTSWEEP_TESTS_BENCHMARK_FIG11_CASE_H

#include "change_list.h"
#include "surface_bodies.h"

#include "scenes/tori.h"

namespace dsw::bench {

constexpr std::size_t kCastsPerParticle = 7;  // its own move and six edges
constexpr std::size_t kStepsPerChange = 10;

/** What happens in a scene, step by step. */
struct Script {
  std::size_t particles = 0, steps = 0;
  std::vector<double> starts;                // of the vertices, before the first step
  std::vector<std::vector<double>> targets;  // of each step
  /** Of every vertex: its move p p', then q p' for its edges, q where its turn finds it. A batch is a step. */
  Segments segments;
  /** Before every tenth step obstacles vanish and others appear; empty if nothing changes. */
  std::vector<std::array<WallChange, 2>> changes;
  std::vector<WallChange> undo;  // brings back the lattice as it was
  std::size_t slots = 0;         // ids of walls
};

struct Fig11Case {
  explicit Fig11Case(std::size_t cells);

  BodyShape shape;
  scenes::HexGrid grid;
  World world;
  WallMesh walls;

  /** Moves bodies for some steps and records them. @param changed obstacles come and go. */
  Script record(std::size_t steps, bool changed);
};

void mark(const World& world, const WallChange& change);

}  // namespace dsw::bench

#endif
