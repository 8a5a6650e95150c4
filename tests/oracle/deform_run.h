// The oracle's run of deformations: bodies and particles lie in small environments whose points go where a seed sends
// them. After each deformation a new picture of the environment is made, and everything is looked at in that.
#pragma once

#include "body_scenes.h"
#include "deform_ground.h"

namespace dsw::oracle {

struct DeformRunOptions {
  uint64_t steps = 0;
  uint64_t seed = 1;
  std::string only;
  uint64_t scene_seed = 0;  // as printed with a fault; 0: all
};

struct DeformReport {
  explicit DeformReport(int print_most) : faults(print_most) {}

  SweepReport faults;
  uint64_t steps = 0, bodies = 0, particles = 0, contacts = 0, pushed = 0, edits = 0;
  uint64_t lost = 0;                    // in another volume than they say, or beyond a wall
  uint64_t not_free = 0;                // at their level
  uint64_t rigid = 0, rigid_moves = 0;  // bodies with DSW_BODY_RIGID, and steps in which one was moved
  uint64_t bent = 0;                    // of those that lost their shape
  uint64_t wrong = 0;                   // answers that do not fit
  uint64_t whole = 0;                   // steps after which the whole environment was valid
  uint64_t outcomes[4] = {};            // by dsw_deform_outcome
  uint64_t validated_parts = 0, validated_contacts = 0;
  bool right() const { return wrong + lost + not_free + bent == 0 && bodies > 0; }
};

/// One scene.
void run_on_ground(Ground& ground, Rng& rng, DeformReport& report);
void run_deformations(const DeformRunOptions& options, DeformReport& report);
void run_plane_deformations(const DeformRunOptions& options, DeformReport& report);
/// `prefix` of the figures' names.
std::string to_json(const DeformReport& report, const std::string& prefix = "");

}  // namespace dsw::oracle
