// The oracle's run of bodies: scenes, marks, bodies and moves from a seed, at every level.
#pragma once

#include "body_check.h"
#include "opinions.h"

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
        hybrid(print_most) {}
  SweepReport& at(dsw_level level) { return levels[static_cast<size_t>(level) - 1]; }
  uint64_t faults() const;

  std::array<SweepReport, 4> levels;
  SweepReport hybrid;  // elimination by motion; what it drops is no fault
  uint64_t bodies = 0, refused = 0, responses = 0, edits = 0, body_edits = 0, twins = 0;
  uint64_t hybrid_contacts = 0, hybrid_dropped = 0;
  double time_error = 0, bisection_slope = 0;
  Opinions opinions;  // on contacts of all bodies
};

void run_bodies(const BodyRunOptions& options, BodyReport& report);
std::string to_json(const BodyReport& report);

/// Slope of log2(mean error of a bisected time) over depths 4 to 40, of contacts with one plane.
double bisection_slope(uint64_t seed, BodyReport& report);

}  // namespace dsw::oracle
