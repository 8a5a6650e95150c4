// The oracle's run in the plane: meshes, marks, casts and particles from a seed.
#pragma once

#include <cstdint>
#include <string>

namespace dsw::oracle {

struct PlaneRunOptions {
  uint64_t casts = 20000;  // particle moves included
  uint64_t seed = 1;
};

struct PlaneReport {
  uint64_t casts = 0, moves = 0, contacts = 0, ties = 0;
  uint64_t missed = 0, late = 0, not_free_after = 0;
  uint64_t wrong = 0;  // anything else that differs
  uint64_t faults() const { return missed + late + not_free_after + wrong; }
};

void run_plane(const PlaneRunOptions& options, int print_most, PlaneReport& report);
std::string to_json(const PlaneReport& report);

}  // namespace dsw::oracle
