// The oracle's run of eliminations that leave out edges on their way [JCD10] 6.2 and 6.3.
#pragma once

#include "sweep_check.h"

namespace dsw::oracle {

struct BackEdgeReport {
  explicit BackEdgeReport(int print_most) : faults(print_most) {}
  bool right() const { return faults.total.faults() == 0 && contacts != 0 && skipped != 0 && left != 0; }

  SweepReport faults;  // what is missed on the way is none
  uint64_t moves = 0, contacts = 0, missed = 0, swept = 0, skipped = 0;
  uint64_t left = 0, crossed = 0;  // edges that were untested after a move, and those of them that were not free
};

/// Closed bodies in the scenes of swept edges, until there are so many moves.
void run_back_edges(uint64_t moves, uint64_t seed, BackEdgeReport& report);
std::string to_json(const BackEdgeReport& report);

}  // namespace dsw::oracle
