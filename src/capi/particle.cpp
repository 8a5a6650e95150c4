#include "dartsweep/particle.h"

#include <algorithm>

#include "capi/convert.h"
#include "capi/recorded.h"
#include "capi/scene_handle.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

/** A particle knows its volume, so DSW_CAST_START_KNOWN means nothing here. `other` flags are those of moves. */
dsw::FlightOptions to_flight_options(const dsw_cast_options* options, uint32_t other = 0) {
  const dsw::SegmentOptions o = capi::to_options(options, other);
  return {o.max_volumes, o.detail, o.leave};
}

/** Where particles are. */
template <int D>
struct Places {
  const dsw::Scene<D>& scene;
  const dsw_particle_id* particles;
  size_t count;
};

template <int D, class Use>
void for_each_part(const Places<D>& of, const Use& use) {
  for (size_t i = 0; i < of.count; ++i) {
    const auto& position = of.scene.particles[of.particles[i].index].position;
    use(position, sizeof position);
  }
}

}  // namespace

dsw_status dsw_particle_create(dsw_scene* scene, const double* position, dsw_volume_id hint,
                               dsw_particle_id* particle) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    dsw::require(position, "position");
    dsw::require(particle, "particle");
    capi::Recorded call(scene, capi::row_of<dsw_particle_create>, position, hint);
    create_particles(s, {position, D}, 1, &hint, false, particle, nullptr);
    call.done(*particle);
  });
}

dsw_status dsw_scene_create_particles(dsw_scene* scene, const double* positions, size_t count, size_t stride_bytes,
                                      const dsw_volume_id* hints, dsw_particle_id* particles, size_t* offender) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    const dsw::PointArray points = dsw::to_points(s.kDimension, positions, count, stride_bytes, "positions");
    dsw::require_array(particles, count, "particles");
    capi::Recorded call(scene, capi::row_of<dsw_scene_create_particles>, positions, count, stride_bytes, hints);
    create_particles(s, points, count, hints, true, particles, offender);
    call.done(capi::Items<dsw_particle_id>{particles, count});
  });
}

dsw_status dsw_particle_destroy(dsw_scene* scene, dsw_particle_id particle) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    check_particle(s, particle);
    capi::Recorded call(scene, capi::row_of<dsw_particle_destroy>, particle);
    destroy_particle(s, particle.index);
    call.done();
  });
}

dsw_status dsw_scene_get_particle_count(const dsw_scene* scene, size_t* count) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) { capi::give(count, "count", s.slots.alive_count()); });
}

dsw_status dsw_scene_get_particle_ids(const dsw_scene* scene, dsw_particle_id* particles, size_t capacity,
                                      size_t* count) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) { capi::copy_ids(s.slots, particles, capacity, count); });
}

dsw_status dsw_particle_get_position(const dsw_scene* scene, dsw_particle_id particle, double* position,
                                     dsw_volume_id* volume) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    check_particle(s, particle);
    const auto& state = s.particles[particle.index];
    if (position != nullptr) std::copy(state.position, state.position + D, position);
    if (volume != nullptr) *volume = volume_id(s.env.map, state.cell);
  });
}

dsw_status dsw_particle_get_state(const dsw_scene* scene, dsw_particle_id particle, dsw_cell* cell,
                                  dsw_cell* aimed_at) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    check_particle(s, particle);
    const auto& state = s.particles[particle.index];
    const dsw_volume_id volume = volume_id(s.env.map, state.cell);
    if (cell != nullptr) *cell = {DSW_CELL_VOLUME, volume.index, volume.generation, 0};
    if (aimed_at == nullptr) return;
    *aimed_at = {};
    if (state.forecast == dsw::kNoFacet) return;
    const dsw_face_id face = face_id(s.env.map, s.env.map.half_facet(state.cell, state.forecast));
    *aimed_at = {DSW_CELL_FACE, face.volume, face.generation, face.local};
  });
}

dsw_status dsw_scene_get_particle_positions(const dsw_scene* scene, const dsw_particle_id* particles, size_t count,
                                            double* positions, size_t stride_bytes, dsw_volume_id* volumes) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    dsw::require_array(particles, count, "particles");
    const size_t step = dsw::to_step(s.kDimension, positions, count, stride_bytes, "positions");
    check_particles(s, particles, count);
    for (size_t i = 0; i < count; ++i) {
      const auto& state = s.particles[particles[i].index];
      if (positions != nullptr) std::copy(state.position, state.position + D, positions + i * step);
      if (volumes != nullptr) volumes[i] = volume_id(s.env.map, state.cell);
    }
  });
}

dsw_status dsw_particle_move(dsw_scene* scene, dsw_particle_id particle, const double* target,
                             const dsw_cast_options* options, dsw_flight* flight) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    dsw::require(target, "target");
    const dsw::FlightOptions o = to_flight_options(options, DSW_CAST_LEAVE);
    check_particle(s, particle);
    capi::Recorded call(scene, capi::row_of<dsw_particle_move>, particle, target, options);
    move_particle(s, particle, target, o, flight);
    call.done(s.particles[particle.index].position);
  });
}

dsw_status dsw_scene_move_particles(dsw_scene* scene, const dsw_particle_id* particles, size_t count,
                                    const double* targets, size_t stride_bytes, const dsw_cast_options* options,
                                    dsw_flight* flights) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    dsw::require_array(particles, count, "particles");
    const dsw::PointArray points = dsw::to_points(s.kDimension, targets, count, stride_bytes, "targets");
    const dsw::FlightOptions o = to_flight_options(options, DSW_CAST_LEAVE);
    capi::Recorded call(scene, capi::row_of<dsw_scene_move_particles>, particles, count, targets, stride_bytes,
                        options);
    move_particles(s, particles, count, points, o, flights);
    call.done(Places<D>{s, particles, count});
  });
}

dsw_status dsw_scene_cast_from_particles(dsw_scene* scene, const dsw_particle_id* particles, size_t count,
                                         const double* to, size_t stride_bytes, const dsw_cast_options* options,
                                         dsw_flight* flights) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    dsw::require_array(particles, count, "particles");
    const dsw::PointArray points = dsw::to_points(s.kDimension, to, count, stride_bytes, "to");
    dsw::require_array(flights, count, "flights");
    const dsw::FlightOptions o = to_flight_options(options);
    capi::Recorded call(scene, capi::row_of<dsw_scene_cast_from_particles>, particles, count, to, stride_bytes,
                        options);
    cast_from_particles(s, particles, count, points, o, flights);
    call.done(capi::Items<dsw_flight>{flights, count});
  });
}

dsw_status dsw_scene_get_crossings(const dsw_scene* scene, const dsw_crossing** crossings, const size_t** first,
                                   size_t* flight_count) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    dsw::require(crossings, "crossings");
    dsw::require(first, "first");
    dsw::require(flight_count, "flight_count");
    capi::check_enabled(s.features.crossings, "DSW_FEATURE_CROSSINGS");
    *crossings = s.crossings.data();
    *first = s.crossing_first.data();
    *flight_count = s.crossing_first.size() - 1;
  });
}

dsw_status dsw_scene_get_exits(const dsw_scene* scene, const dsw_exit** exits, size_t* count) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) { capi::hand_out(s.exits, exits, count, "exits"); });
}

dsw_status dsw_scene_get_occupants(const dsw_scene* scene, const dsw_particle_id** particles, size_t* count) {
  return capi::guarded_visit(__func__, scene,
                             [&](auto& s) { capi::hand_out(s.occupants, particles, count, "particles"); });
}
