#include "scene/together_moves.h"

#include <algorithm>

#include "base/dimensions.h"
#include "scene/meeting.h"
#include "scene/scene.h"
#include "together/together_move.h"

namespace dsw {

template <int D>
void leave_still_ones(const Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, Islands<D>& islands) {
  Array<bool> moves(scene.bodies.size(), false, scene.memory);
  for (size_t i = 0; i < count; ++i) moves[static_cast<size_t>(bodies[i] - scene.bodies.data())] = true;
  for (Partners<D>& each : islands.partners) {
    each.remove([&](const Partner<D>& partner) { return moves[partner.index]; });
  }
}

template <int D>
Trajectory<D> trajectory_of(const Scene<D>& scene, BodyRecord<D>& of, const Partners<D>* still, PointArray targets) {
  Trajectory<D> made(scene.memory);
  const auto slot = static_cast<uint32_t>(&of - scene.bodies.data());
  made.motion.body = &of.body;
  made.name = {&of.body, slot, scene.body_slots.generation(slot)};
  made.motion.targets = targets;
  made.notes = &of.kept_near;
  made.record = &of.next;
  made.still = still;
  return made;
}

template <int D>
void add_particles(const Scene<D>& scene, Body<D>& particles, MoveRecord& record, Array<Trajectory<D>>& trajectories) {
  particles.level = SweepLevel::kPoints;
  particles.filter = {0, 0, false};
  reserve(particles, scene.particles.size(), 0, 0);
  for (const ParticleState<D>& particle : scene.particles) {
    if (particle.cell.valid()) add_vertex(particles, particle.position, particle.cell);
  }
  if (particles.vertices.empty()) return;
  Trajectory<D>& made = trajectories.emplace_back(scene.memory);
  made.motion.body = &particles;
  made.name = {&particles, kNone, 0};
  made.motion.targets = positions_of(particles);
  made.record = &record;
  made.stands = true;
}

namespace {

/** The body's vertices are where they were before the call. */
template <int D>
void take_back(BodyRecord<D>& of) {
  put_vertices(of.body, of.before.data());
  restore_forecasts(of.body);
}

/** Moves bodies that depend on nobody else that moves. At the work limit they stay where they are. */
template <int D>
void move_island(TogetherMove<D>& move, Array<Trajectory<D>>& trajectories, BodyRecord<D>* const* bodies,
                 const uint32_t* numbers, bool bodies_meet, const TogetherSettings& settings) {
  try {
    move.move(trajectories, bodies_meet, settings);
  } catch (const WorkOver&) {
    for (size_t k = 0; k < trajectories.size(); ++k) {
      BodyRecord<D>& of = *bodies[numbers[k]];
      take_back(of);
      stay_at_limit(of, [&](uint32_t v, double* to) { std::copy_n(trajectories[k].motion.targets[v], D, to); });
    }
  }
}

/** Bodies that go beside their targets may meet all that they see. */
template <int D>
void find_one_island(const Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, PointArray targets,
                     Islands<D>& islands) {
  Box<D> all;
  for (uint32_t slot = 0; slot < scene.bodies.size(); ++slot) {
    if (!scene.body_slots.alive(slot, scene.body_slots.generation(slot))) continue;
    for (const BodyVertex<D>& each : scene.bodies[slot].body.vertices) {
      if (each.cell.valid()) all.add(each.position);
    }
  }
  for (size_t i = 0, at = 0; i < count; ++i) {
    const Body<D>& body = bodies[i]->body;
    for (uint32_t v = 0; v < body.vertices.size(); ++v, ++at) {
      if (body.has_vertex(v)) all.add(targets[static_cast<uint32_t>(at)]);
    }
  }
  const Array<Box<D>> reaches(count, all, scene.memory);
  find_islands(scene, bodies, count, reaches.data(), islands);
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
    begin_move(scene, of);
    of.next.clear();
    first[i] = at;
    at += of.body.vertices.size();
  }
  Islands<D> islands(scene.memory);
  if (settings.response == TogetherResponse::kStop) {
    find_islands(scene, bodies, count, targets, first.data(), false, islands);
  } else {
    find_one_island(scene, bodies, count, targets, islands);
  }
  leave_still_ones(scene, bodies, count, islands);
  CastCounters casts;
  try {
    if (scene.together.get() == nullptr) scene.together.make(scene.env);
    TogetherMove<D>& move = *scene.together.get();
    move.set_counters(scene.features.statistics ? &casts : nullptr);
    Array<Trajectory<D>> trajectories(scene.memory);
    for (size_t island = 0; island < islands.count(); ++island) {
      for (size_t k = islands.first[island]; k < islands.first[island + 1]; ++k) {
        const uint32_t i = islands.bodies[k];
        const Partners<D>* const still = scene.features.contacts ? &islands.partners[i] : nullptr;
        trajectories.push_back(
            trajectory_of(scene, *bodies[i], still, {targets.data + first[i] * targets.step, targets.step}));
        trajectories.back().is_led = settings.response != TogetherResponse::kStop;
      }
      const bool is_one = settings.stop == TogetherStop::kAll || settings.response != TogetherResponse::kStop;
      if (is_one && island + 1 != islands.count()) continue;
      // The bodies of islands stand one after the other, as the trajectories do.
      move_island(move, trajectories, bodies, islands.bodies.data() + islands.first[island + 1] - trajectories.size(),
                  scene.features.contacts, settings);
      trajectories.clear();
    }
  } catch (...) {
    for (size_t i = 0; i < count; ++i) take_back(*bodies[i]);
    throw;
  }
  for (size_t i = 0; i < count; ++i) end_move(scene, *bodies[i], i == 0 ? casts : CastCounters{});
}

DSW_INSTANTIATE(move_together);
DSW_INSTANTIATE(leave_still_ones);
DSW_INSTANTIATE(trajectory_of);
DSW_INSTANTIATE(add_particles);

}  // namespace dsw
