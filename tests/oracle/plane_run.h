// The oracle's runs in the plane: meshes, marks, casts, particles, swept edges and bodies from a seed.
#pragma once

#include <cstdint>
#include <string>

namespace dsw::oracle {

struct PlaneRunOptions {
  uint64_t casts = 0;   // particle moves included
  uint64_t sweeps = 0;  // swept edges (each at every level), and moves of single vertices of bodies at each level
  uint64_t seed = 1;
  std::string only;         // a scene's name, or empty
  uint64_t scene_seed = 0;  // of sweeps, as printed with a fault: such scenes alone, once; 0: all
  int level = 0;            // of bodies; 0: all
};

struct PlaneReport {
  uint64_t casts = 0, moves = 0;  // a cast is either
  uint64_t sweeps = 0, bodies = 0, vertex_contacts = 0, inside_only = 0, responses = 0, edits = 0, twins = 0;
  uint64_t stuck = 0;  // stopped, and did not move although there was a way
  uint64_t contacts = 0, ties = 0, missed = 0, late = 0, not_free_after = 0;
  uint64_t wrong = 0;  // anything else that differs
  double time_error = 0;
  uint64_t faults() const { return missed + late + not_free_after + wrong; }
};

void run_plane(const PlaneRunOptions& options, int print_most, PlaneReport& report);
void run_plane_sweeps(const PlaneRunOptions& options, int print_most, PlaneReport& report);
std::string to_json(const PlaneReport& report);

}  // namespace dsw::oracle
