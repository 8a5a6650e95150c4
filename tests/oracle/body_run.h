// The oracle's run of bodies: scenes, marks, bodies and moves from a seed, at every level.
#pragma once

#include "body_check.h"
#include "cross_checks.h"
#include "places.h"

#include <functional>

namespace dsw::oracle {

struct BodyRunOptions {
  uint64_t steps = 0;  // of one vertex, at each level
  uint64_t seed = 1;
  std::string only;         // a scene's name, or empty
  uint64_t scene_seed = 0;  // as printed with a fault: that scene alone, once; 0: all
  int level = 0;            // 0: all
  bool responses = true;
};

struct BodyReport {
  explicit BodyReport(int print_most)
      : levels{SweepReport(print_most), SweepReport(print_most), SweepReport(print_most), SweepReport(print_most)},
        similar(print_most) {}
  SweepReport& at(dsw_level level) { return levels[static_cast<size_t>(level) - 1]; }
  uint64_t faults() const;
  void begin(const std::string& scene, const std::string& reproduce);

  std::array<SweepReport, 4> levels;
  SweepReport similar;  // elimination by similar motion; what it drops is no fault
  uint64_t bodies = 0, refused = 0, responses = 0, edits = 0, body_edits = 0, twins = 0;
  uint64_t similar_contacts = 0, similar_dropped = 0;
  double time_error = 0, bisection_slope = 0;
  CrossChecks cross_checks;  // on contacts of all bodies
};

/// Bodies of some levels in one arena; `places_for` gives the places that a level's own sequence of numbers chooses.
void bodies_in_arena(Arena& arena, const std::function<std::unique_ptr<Places>(Rng&)>& places_for,
                     dsw_environment* environment, uint64_t seed, uint64_t steps, const BodyRunOptions& options,
                     BodyReport& report);
/// The least number of steps at one of the levels that are run, of those up to `last`.
uint64_t least_steps(const BodyRunOptions& options, BodyReport& report, dsw_level last = DSW_LEVEL_FACES);
void run_bodies(const BodyRunOptions& options, BodyReport& report);
std::string to_json(const BodyReport& report);

/// Slope of log2(mean error of a bisected time) over depths 4 to 40, of contacts with one plane.
double bisection_slope(uint64_t seed, BodyReport& report);

}  // namespace dsw::oracle
