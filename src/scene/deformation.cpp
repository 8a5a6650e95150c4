#include "scene/deformation.h"

#include "base/dimensions.h"
#include "scene/meeting.h"
#include "scene/scene.h"

namespace dsw {

template <int D>
Deformation<D>::Deformation(Environment<D>& environment)
    : env(environment),
      all(environment.memory),
      partners(environment.memory),
      swept(environment, all),
      end_state(environment, all),
      record(environment.memory),
      next(environment.memory) {}

template <int D>
uint64_t Deformation<D>::memory_bytes() const noexcept {
  return sizeof(*this) + all.memory_bytes() + array_bytes(partners.all) + swept.memory_bytes() + record.memory_bytes() +
         next.memory_bytes();
}

namespace {

/** All that lies in the environment now. */
template <int D>
void gather(Scene<D>& scene) {
  Deformation<D>& d = *scene.deformation.get();
  d.all.particles = scene.particles.data();
  d.all.particle_count = scene.particles.size();
  d.all.particle_slots = &scene.slots;
  d.all.forget_saved();
  d.all.bodies.assign(scene.bodies.size(), typename Occupants<D>::Owner{});
  d.partners.clear();
  d.all.partners = scene.features.contacts ? &d.partners : nullptr;
  for (uint32_t slot = 0; slot < scene.bodies.size(); ++slot) {
    const uint32_t generation = scene.body_slots.generation(slot);
    if (!scene.body_slots.alive(slot, generation)) continue;
    BodyRecord<D>& body = scene.bodies[slot];
    follow_changes(scene, body);
    keep_forecasts(body.body);
    d.all.bodies[slot] = {&body.body, &body.next, {slot, generation}};
    body.next.edits.clear();
    if (scene.features.contacts) d.partners.add({&body.body, slot, generation});
  }
}

}  // namespace

template <int D>
void deform(Scene<D>& scene, double* next, const WallSettings& settings) {
  Deformation<D>& d = *scene.deformation.get();
  gather(scene);
  try {
    if (settings.end_state) {
      d.end_state.run(next, settings, d.next);
    } else {
      d.swept.run(next, settings, d.next);
    }
  } catch (...) {
    for (const typename Occupants<D>::Owner& owner : d.all.bodies) {
      if (owner.body != nullptr) restore_forecasts(*owner.body);
    }
    throw;
  }
  if (d.env.points == next) {
    d.env.lent = settings.point_room == 0 ? nullptr : next;
    d.env.point_room = settings.point_room;
  }
  d.next.sort();
  std::swap(d.record, d.next);
  for (const typename Occupants<D>::Owner& owner : d.all.bodies) {
    if (owner.body == nullptr) continue;
    MoveRecord& record = scene.bodies[owner.id.index].record;
    std::swap(record.edits, owner.record->edits);
    record.left = {};
    record.ways_left.clear();
    refresh_body(scene, scene.bodies[owner.id.index]);
  }
  for (uint32_t slot = 0; scene.features.live && slot < scene.particles.size(); ++slot) note_particle(scene, slot);
}

void want_near(Scene<3>& scene, Repair& repair) {
  gather(scene);
  const Map<3>& map = scene.deformation.get()->env.map;
  CellQueue near(scene.memory), around(scene.memory);
  for (const Cell c : scene.deformation.get()->swept.find_occupied()) {
    for (uint32_t k = 0, n = map.vertices_of(c); k < n; ++k) {
      around.clear();
      around.insert(c);
      for_each_cell_at_vertex(map, map.vertex(c, k), around, [&](Cell at) { near.insert(at); });
    }
  }
  for (size_t i = 0; i < near.size(); ++i) repair.want(near[i]);
}

void renew_ids(Deformation<3>& deformation) noexcept {
  const Map<3>& map = deformation.env.map;
  for (dsw_volume_id& id : deformation.record.invalid) id.generation = map.cell_slots.generation(id.index);
  const auto renew = [&](uint32_t volume, uint32_t& generation) {
    if (generation != 0) generation = map.cell_slots.generation(volume);
  };
  for (dsw_wall_contact& of : deformation.record.contacts) {
    dsw_contact& contact = of.contact;
    renew(contact.wall.volume, contact.wall.generation);
    renew(contact.front.index, contact.front.generation);
    renew(contact.behind.index, contact.behind.generation);
    if (contact.obstacle.kind != DSW_CELL_VERTEX) renew(contact.obstacle.index, contact.obstacle.generation);
  }
}

template struct Deformation<2>;
template struct Deformation<3>;
DSW_INSTANTIATE(deform);

}  // namespace dsw
