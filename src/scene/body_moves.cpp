// Moves of bodies of a scene: one, one as a rigid whole, and many side by side.

#include <algorithm>
#include <atomic>
#include <new>
#include <utility>

#include "contact/describe.h"
#include "scene/scene.h"

namespace dsw {
namespace {

BodyRecord::Stop to_stop(const dsw_contact& contact) noexcept {
  return {obstacle_key(contact), contact.vertex.index, contact.vertex.generation};
}

/** Contacts of vertices that the same obstacle stopped in the move before are lasting ones. */
void tell_history(BodyRecord& of) noexcept {
  for (dsw_contact& contact : of.record.contacts) {
    const bool lasts = std::binary_search(of.stops.begin(), of.stops.end(), to_stop(contact));
    contact.history = lasts ? DSW_HISTORY_LASTING : DSW_HISTORY_NEW;
  }
}

void before_move(BodyRecord& of) {
  of.stops.clear();
  of.stops.reserve(of.record.contacts.size());
  for (const dsw_contact& contact : of.record.contacts) of.stops.push_back(to_stop(contact));
  std::sort(of.stops.begin(), of.stops.end());
}

BodyMove& mover_of(Scene<3>& scene) {
  if (scene.mover.empty()) scene.mover.emplace_back(scene.env);
  return scene.mover[0];
}

void count(Scene<3>& scene, const BodyRecord& of, const CastCounters& casts) noexcept {
  if (!scene.features.statistics) return;
  scene.statistics.cast.add(casts);
  scene.statistics.contacts += of.record.contacts.size();
}

}  // namespace

void move_body(Scene<3>& scene, BodyRecord& body, PointArray targets, MoveOrder order, const MoveSettings& settings) {
  CastCounters casts;
  BodyMove& move = mover_of(scene);
  move.set_counters(scene.features.statistics ? &casts : nullptr);
  before_move(body);
  move.move(body.body, targets, order, settings, body.record);
  tell_history(body);
  count(scene, body, casts);
}

void move_body_together(Scene<3>& scene, BodyRecord& body, PlaceFn place, const void* user, MoveOrder order) {
  CastCounters casts;
  BodyMove& move = mover_of(scene);
  move.set_counters(scene.features.statistics ? &casts : nullptr);
  before_move(body);
  move.move_together(body.body, place, user, order, body.record);
  tell_history(body);
  count(scene, body, casts);
}

void move_bodies(Scene<3>& scene, BodyRecord* const* bodies, size_t count_of_bodies, PointArray targets,
                 const MoveSettings& settings) {
  Array<size_t> first(count_of_bodies, 0, Allocator<size_t>(scene.memory));
  Array<CastCounters> casts(count_of_bodies, CastCounters{}, Allocator<CastCounters>(scene.memory));
  Array<Body> before{Allocator<Body>(scene.memory)};  // if one runs out of memory, none has moved
  before.reserve(count_of_bodies);
  size_t at = 0;
  for (size_t i = 0; i < count_of_bodies; ++i) {
    before.push_back(bodies[i]->body);
    first[i] = at;
    at += bodies[i]->body.vertices.size();
  }
  std::atomic<bool> out_of_memory{false};
  auto chunk = [&](size_t begin, size_t end) noexcept {
    try {
      BodyMove move(scene.env);
      for (size_t i = begin; i < end; ++i) {
        BodyRecord& body = *bodies[i];
        before_move(body);
        move.set_counters(scene.features.statistics ? &casts[i] : nullptr);
        move.move(body.body, {targets.data + first[i] * targets.step, targets.step}, {}, settings, body.record);
        tell_history(body);
      }
    } catch (const std::bad_alloc&) {
      out_of_memory = true;
    }
  };
  parallel_chunks(scene.parallel, count_of_bodies, 1, chunk);
  if (out_of_memory) {
    for (size_t i = 0; i < count_of_bodies; ++i) std::swap(bodies[i]->body, before[i]);
    throw std::bad_alloc();
  }
  for (size_t i = 0; i < count_of_bodies; ++i) count(scene, *bodies[i], casts[i]);
}

}  // namespace dsw
