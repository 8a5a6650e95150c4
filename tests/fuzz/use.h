#pragma once
// A short life of an environment, driven by bytes: what any host may do with it.

#include <cmath>

#include "bytes.h"
#include "dartsweep/dartsweep.h"

namespace dsw_fuzz {

/** Marks, locates, casts, sweeps, moves. `is_partition`: whether dsw_environment_check found nothing. */
void use_environment(dsw_environment* environment, bool is_partition, Bytes* bytes);

/** Marks one cell, a region, or what is between two; any answer is fine. */
void mark_something(dsw_environment* environment, Bytes* bytes);

/** Creates a body, moves and edits it, marks cells round it, and checks it after each. */
void use_body(dsw_scene* scene, bool is_partition, Bytes* bytes);

/** The radius of a body, which lives. It keeps its radius from everything, and the sum of both from other bodies. */
double check_radius(dsw_scene* scene, dsw_body_id body);
/** Checks the radii of all bodies, as check_radius does. */
void check_radii(dsw_scene* scene);

/** Casts one segment and checks what a report always promises. */
dsw_flight cast(const dsw_environment* environment, dsw_volume_id start, const double* from, const double* to,
                dsw_status* status);

inline bool is_unit(const double* v) {
  return std::fabs(std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) - 1) < 1e-12;
}

/** Starts a recording. */
void record(dsw_scene* scene, dsw_write_fn write, void* user);

/** Snapshots. */
std::vector<uint8_t> save(const dsw_environment* environment);
std::vector<uint8_t> save(const dsw_scene* scene);
/** A block with its size and checksum set right; empty when the bytes are too few to have them. */
std::vector<uint8_t> repaired(const uint8_t* data, size_t size);

/** Tries a block as it is and, where that is not taken, repaired. @param run (block, size) -> whether it was taken. */
template <class Run>
void try_block(const uint8_t* data, size_t size, Run run) {
  const std::vector<uint8_t> block = repaired(data, size);
  if (run(data, size)) {
    require(block == std::vector<uint8_t>(data, data + size), "repaired() still knows the format");
  } else if (!block.empty()) {
    run(block.data(), block.size());
  }
}

/** A block of boxes of unit size, or without layers of boxes squares in the plane, each cut into cells of one type. */
struct World {
  uint32_t boxes[3];
  dsw_cell_type type;

  bool is_planar() const { return boxes[2] == 0; }
};
/** One of a few, by a byte. */
World world_of(uint8_t byte);
/** Some of its corners are moved, so that faces are warped; the cell in the middle is a wall. */
dsw_environment* make_world(const World& world, dsw_context* context = nullptr);
/** The environment of all saved scenes: hexahedra, or quads. */
dsw_environment* make_home(bool is_planar);
/** Bodies at every level and particles in it, moved a little; some are gone again. */
dsw_scene* make_inhabited(dsw_environment* home);
/** Moves all that can be in a scene made by make_inhabited, whatever has been made of it. */
void use_scene(dsw_scene* scene);

dsw_environment_info info_of(const dsw_environment* environment);
/** Doubles of a point. */
inline size_t dimension_of(const dsw_environment* environment) { return info_of(environment).dimension; }

}  // namespace dsw_fuzz
