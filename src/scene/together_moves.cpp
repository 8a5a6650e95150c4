#include "scene/together_moves.h"

#include "base/dimensions.h"
#include "scene/meeting.h"
#include "scene/scene.h"

namespace dsw {
namespace {

/** Leaves only bodies that stand still as partners of the islands. Refuses islands that can meet a thick body. */
template <int D>
void leave_still_ones(const Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, Islands<D>& islands) {
  Array<bool> moves(scene.bodies.size(), false, scene.memory);
  for (size_t i = 0; i < count; ++i) moves[static_cast<size_t>(bodies[i] - scene.bodies.data())] = true;
  for (Partners<D>& each : islands.partners) {
    if (each.has_thick) fail(DSW_STATUS_UNSUPPORTED, "a body can meet one that has a radius");
    each.remove([&](const Partner<D>& partner) { return moves[partner.index]; });
  }
}

/** Bodies of the call, without their vertices' ends. */
template <int D>
Traveller<D> traveller_of(const Scene<D>& scene, BodyRecord<D>& of, const Partners<D>* still, PointArray targets) {
  Traveller<D> made(scene.memory);
  const auto slot = static_cast<uint32_t>(&of - scene.bodies.data());
  made.body = &of.body;
  made.name = {&of.body, slot, scene.body_slots.generation(slot)};
  made.targets = targets;
  made.notes = &of.kept_near;
  made.record = &of.next;
  made.still = still;
  return made;
}

}  // namespace

template <int D>
void move_together(Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, PointArray targets,
                   const TogetherSettings& settings) {
  if (count == 0) return;
  Array<size_t> first(count, 0, scene.memory);
  size_t at = 0;
  for (size_t i = 0; i < count; ++i) {
    BodyRecord<D>& of = *bodies[i];
    if (of.body.radius > 0) fail(DSW_STATUS_UNSUPPORTED, "bodies[%zu] has a radius", i);
    begin_move(scene, of);
    of.next.clear();
    first[i] = at;
    at += of.body.vertices.size();
  }
  Islands<D> islands(scene.memory);
  find_islands(scene, bodies, count, targets, first.data(), false, islands);
  leave_still_ones(scene, bodies, count, islands);
  CastCounters casts;
  try {
    if (scene.together.get() == nullptr) scene.together.make(scene.env);
    TogetherMove<D>& move = *scene.together.get();
    move.set_counters(scene.features.statistics ? &casts : nullptr);
    Array<Traveller<D>> travellers(scene.memory);
    for (size_t island = 0; island < islands.count(); ++island) {
      for (size_t k = islands.first[island]; k < islands.first[island + 1]; ++k) {
        const uint32_t i = islands.bodies[k];
        const Partners<D>* const still = scene.features.contacts ? &islands.partners[i] : nullptr;
        travellers.push_back(
            traveller_of(scene, *bodies[i], still, {targets.data + first[i] * targets.step, targets.step}));
      }
      if (settings.stop == TogetherStop::kAll && island + 1 != islands.count()) continue;
      move.move(travellers, scene.features.contacts, settings);
      travellers.clear();
    }
  } catch (...) {
    for (size_t i = 0; i < count; ++i) {
      put_vertices(bodies[i]->body, bodies[i]->before.data());
      restore_forecasts(bodies[i]->body);
    }
    throw;
  }
  for (size_t i = 0; i < count; ++i) end_move(scene, *bodies[i], i == 0 ? casts : CastCounters{});
}

DSW_INSTANTIATE(move_together);

}  // namespace dsw
