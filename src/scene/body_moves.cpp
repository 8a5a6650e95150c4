// Moves of bodies of a scene: one, and many side by side.

#include <new>
#include <utility>

#include "base/dimensions.h"
#include "base/search.h"
#include "response/body_move.h"
#include "scene/meeting.h"
#include "scene/scene.h"

namespace dsw {

template <int D>
BodyMove<D>& mover_of(Scene<D>& scene) {
  if (scene.mover.get() == nullptr) scene.mover.make(scene.env);
  return *scene.mover.get();
}

template <int D>
void begin_move(const Scene<D>& scene, BodyRecord<D>& of) {
  follow_changes(scene, of);
  keep_forecasts(of.body);
  of.before.assign(of.body.vertices.begin(), of.body.vertices.end());
  of.touches.prepare(of.record);
}

/** Removes the vertices that have left; reserve_removals has made room. */
template <int D>
void remove_left(Scene<D>& scene, BodyRecord<D>& of) noexcept {
  if (of.record.exits.empty()) return;
  for (const dsw_exit& exit : of.record.exits) remove_vertex(of.body, exit.vertex.index);
  refresh_body(scene, of);
}

template <int D>
void end_move(Scene<D>& scene, BodyRecord<D>& of, const CastCounters& casts) noexcept {
  of.touches.follow(of.record, of.next, of.body.vertex_slots);
  of.record.swap(of.next);
  refresh_body(scene, of);
  if (!scene.features.statistics) return;
  scene.statistics.cast.add(casts);
  scene.statistics.contacts += of.record.contacts.size();
}

template <int D>
void move_body(Scene<D>& scene, BodyRecord<D>& body, PointArray targets, MoveOrder order,
               const MoveSettings& settings) {
  CastCounters casts;
  BodyMove<D>& move = mover_of(scene);
  move.set_counters(scene.features.statistics ? &casts : nullptr);
  Partners<D> partners(scene.memory);
  follow_changes(scene, body);
  if (scene.features.contacts) {
    find_partners(scene, body.body, reach_of(body.body, targets, order, settings.may_slide()), partners);
  }
  move.set_partners(scene.features.contacts ? &partners : nullptr);
  move.set_notes(&body.kept_near);
  body.touches.prepare(body.record);
  if (settings.leaves) reserve_removals(body.body);
  move.move(body.body, targets, order, settings, body.next);
  end_move(scene, body, casts);
  remove_left(scene, body);
}

template <int D>
void move_bodies(Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, PointArray targets,
                 const MoveSettings& settings) {
  Array<size_t> first(count, 0, scene.memory);
  Array<CastCounters> casts(count, CastCounters{}, scene.memory);
  // If one runs out of memory, none has moved. Positions alone do not bring back parts and lists of untested edges.
  const bool keeps_wholes = settings.may_edit() || dsw::any_of(bodies, bodies + count, [](const BodyRecord<D>* each) {
                              return each->body.skipping.leaves_back_edges;
                            });
  Array<Body<D>> wholes{scene.memory};
  wholes.reserve(keeps_wholes ? count : 0);
  size_t at = 0;
  for (size_t i = 0; i < count; ++i) {
    BodyRecord<D>& body = *bodies[i];
    begin_move(scene, body);
    if (settings.leaves) reserve_removals(body.body);
    if (keeps_wholes) wholes.push_back(body.body);
    first[i] = at;
    at += body.body.vertices.size();
  }
  Islands<D> islands(scene.memory);
  find_islands(scene, bodies, count, targets, first.data(), settings.may_slide(), islands);
  try {
    parallel_few_chunks(scene.parallel, islands.count(), [&](size_t begin, size_t end) {
      BodyMove<D> move(scene.env);
      for (size_t k = islands.first[begin]; k < islands.first[end]; ++k) {
        const uint32_t i = islands.bodies[k];
        move.set_counters(scene.features.statistics ? &casts[i] : nullptr);
        move.set_partners(scene.features.contacts ? &islands.partners[i] : nullptr);
        move.set_notes(&bodies[i]->kept_near);
        move.move(bodies[i]->body, {targets.data + first[i] * targets.step, targets.step}, {}, settings,
                  bodies[i]->next);
      }
    });
  } catch (const std::bad_alloc&) {
    for (size_t i = 0; i < count; ++i) {
      BodyRecord<D>& body = *bodies[i];
      if (keeps_wholes) {
        std::swap(body.body, wholes[i]);
      } else {
        put_vertices(body.body, body.before.data());
        restore_forecasts(body.body);
      }
    }
    throw;
  }
  for (size_t i = 0; i < count; ++i) {
    end_move(scene, *bodies[i], casts[i]);
    remove_left(scene, *bodies[i]);
  }
}

DSW_INSTANTIATE(begin_move);
DSW_INSTANTIATE(end_move);
DSW_INSTANTIATE(move_body);
DSW_INSTANTIATE(mover_of);
DSW_INSTANTIATE(move_bodies);

}  // namespace dsw
