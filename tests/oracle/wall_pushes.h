// How exactly a wall pushes: one vertex of an environment goes past a body or a particle that lies before a wall. Where
// the push is free, what was pushed has to touch the wall at the end, up to rounding.
#pragma once

#include "deform_run.h"

namespace dsw::oracle {

struct PushReport {
  explicit PushReport(int print_most) : faults(print_most) {}

  SweepReport faults;
  uint64_t pushes = 0;             // free ones, of which the gap is known
  uint64_t rigid = 0, points = 0;  // of rigid bodies, of particles
  uint64_t slides = 0;             // walls that went by, and came no nearer up to rounding
  uint64_t held = 0;               // the wall waited
  uint64_t moved_in_vain = 0;      // and something was pushed nevertheless
  uint64_t wide = 0;               // gaps above the bar: 1e-9 of the step and 8 units in the last place
  uint64_t wrong = 0;              // calls that failed
  double largest = 0;              // gap, less 8 units in the last place, over the step
  bool right() const { return wrong + wide + moved_in_vain == 0 && pushes > 0 && rigid > 0 && points > 0; }
};

/// One scene.
void push_on_ground(Ground& ground, Rng& rng, PushReport& report);
/// Until there are so many free pushes, in space and in the plane in turns.
void run_wall_pushes(const DeformRunOptions& options, PushReport& report);
std::string to_json(const PushReport& report);

}  // namespace dsw::oracle
