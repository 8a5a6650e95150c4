// The oracle's run of swept edges: scenes, marks and sweeps from a seed.
#pragma once

#include "places.h"
#include "sweep_check.h"

namespace dsw::oracle {

struct SweepRunOptions {
  uint64_t sweeps = 20000;  // each at every level
  uint64_t seed = 1;
  std::string only;  // a scene's name, or empty
};

/// Sweeps in one arena, in one call for each level and each choice of flags, compared.
void sweep_arena(Arena& arena, Places& places, dsw_environment* environment, uint64_t sweeps, Rng& rng,
                 SweepReport& report);
void run_sweeps(const SweepRunOptions& options, SweepReport& report);
std::string to_json(const SweepReport& report);

}  // namespace dsw::oracle
