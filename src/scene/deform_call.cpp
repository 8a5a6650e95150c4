#include "scene/deform_call.h"

#include <utility>

#include "environment/moving.h"
#include "scene/meeting.h"
#include "scene/scene.h"

namespace dsw {

template <int D>
DeformCall<D>::DeformCall(Scene<D>& of, double* next)
    : scene(of),
      env(of.deformation.get()->env),
      record(of.deformation.get()->next),
      points(env),
      particles(of.memory),
      slots(of.memory),
      still(of.memory) {
  points.begin(next);
}

template <int D>
Trajectory<D> DeformCall<D>::trajectory(BodyRecord<D>& of, PointArray targets, MoveRecord* of_move) {
  begin_move(scene, of);
  const auto slot = static_cast<uint32_t>(&of - scene.bodies.data());
  Trajectory<D> made(scene.memory);
  made.motion.body = &of.body;
  made.name = {&of.body, slot, scene.body_slots.generation(slot)};
  made.motion.targets = targets;
  made.record = of_move;
  made.stands = of_move == &still;
  return made;
}

template <int D>
void DeformCall<D>::add_still(BodyRecord<D>* const* moved, size_t count, Array<Trajectory<D>>& to) {
  for_each_other_body(scene, moved, count,
                      [&](BodyRecord<D>& of) { to.push_back(trajectory(of, positions_of(of.body), &still)); });
  add_particles(scene, particles, still, to);
  for (uint32_t slot = 0; slot < scene.particles.size(); ++slot) {
    if (scene.particles[slot].cell.valid()) slots.push_back(slot);
  }
}

template <int D>
void DeformCall<D>::take_back(const Array<Trajectory<D>>& trajectories) {
  points.restore_targets();
  points.read_start();
  for (const Trajectory<D>& of : trajectories) {
    if (of.motion.body == &particles) continue;
    put_vertices(*of.motion.body, scene.bodies[of.name.index].before.data());
    restore_forecasts(*of.motion.body);
  }
}

template <int D>
void DeformCall<D>::keep_contacts(const Array<dsw_wall_contact>& contacts) {
  record.contacts.assign(contacts.begin(), contacts.end());
  for (dsw_wall_contact& contact : record.contacts) {
    if (contact.body.index != kNone) continue;
    const uint32_t slot = slots[contact.vertex.index];
    contact.body = {};
    contact.vertex = {};
    contact.particle = {slot, scene.slots.generation(slot)};
  }
}

template <int D>
void DeformCall<D>::keep_outcome() noexcept {
  record.outcome = record.fraction == 0   ? DSW_DEFORM_REFUSED
                   : !record.held.empty() ? DSW_DEFORM_HELD
                   : record.fraction == 1 ? DSW_DEFORM_DONE
                                          : DSW_DEFORM_FRACTION;
}

template <int D>
void DeformCall<D>::keep_points(size_t point_room) noexcept {
  if (env.points != points.nexts()) return;
  release_owned_points(env);
  env.lent = point_room == 0 ? nullptr : points.nexts();
  env.point_room = point_room;
}

template <int D>
void DeformCall<D>::finish(BodyRecord<D>* const* bodies, size_t count, const Array<Trajectory<D>>& trajectories) {
  record.sort();
  std::swap(scene.deformation.get()->record, scene.deformation.get()->next);
  for (size_t i = 0; i < count; ++i) end_move(scene, *bodies[i], {});
  for (const Trajectory<D>& of : trajectories) {
    if (of.record == &still && of.motion.body != &particles) refresh_body(scene, scene.bodies[of.name.index]);
  }
  for (uint32_t i = 0; i < slots.size(); ++i) {
    ParticleState<D>& particle = scene.particles[slots[i]];
    const Cell cell = particles.vertices[i].cell;
    if (particle.cell != cell) particle.forecast = kNoFacet;
    particle.cell = cell;
    if (scene.features.live) note_particle(scene, slots[i]);
  }
}

template struct DeformCall<2>;
template struct DeformCall<3>;

}  // namespace dsw
