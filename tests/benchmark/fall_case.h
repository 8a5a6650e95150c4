// A closed surface that falls among obstacles in an environment of pyramids, presses on them and is lifted again: the
// scene of figure 12 of [JCD10].
#ifndef DARTSWEEP_TESTS_BENCHMARK_FALL_CASE_H
#define DARTSWEEP_TESTS_BENCHMARK_FALL_CASE_H

#include "surface.h"
#include "surface_bodies.h"

#include "scenes/pyramids.h"

namespace dsw::bench {

constexpr double kFineCube = 0.05;  // edge of a cube: four to five edges of the surface
constexpr double kCoarseCube = 0.1;
constexpr std::size_t kFallSteps = 60;  // steps down, then as many up
constexpr std::size_t kFreeSteps = 20;  // steps of the fall before anything can be met

struct Fall {
  Surface surface;
  BodyShape shape;
  scenes::Pyramids pyramids;
};

/** How the surface can be moved: its vertices alone, [JCD10] 6.1 to 6.3, then what is ours, and other levels. */
const std::vector<Variant>& fall_variants();

/** The file of the hand, or empty if there is none. */
std::string hand_path(const std::string& data);

/** @param path of the surface, empty: a generated one. @param cube edge of a cube. */
Fall make_fall(const std::string& path, double cube);

/** Marks the obstacles of a world that was made from the pyramids. */
void mark_obstacles(World& world, const Fall& fall);

/** Where the vertices go at a step. */
std::vector<double> place(const Fall& fall, std::size_t step);

}  // namespace dsw::bench

#endif
