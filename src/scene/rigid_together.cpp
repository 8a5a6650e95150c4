#include "base/dimensions.h"
#include "scene/rigid_island.h"

namespace dsw {
namespace {

/** Moves them, or leaves them where they are at the work limit. */
template <int D>
void move_rigid_island(TurningTogether<D>& move, RigidIsland<D>& island, BodyRecord<D>* const* bodies,
                       const RigidMove<D>* motions, bool bodies_meet, const TogetherSettings& settings,
                       BodiesBefore<D>& before) {
  try {
    move.move(island.turning, island.trajectories, bodies_meet, settings);
    for (const uint32_t i : island.numbers) keep_motion(*bodies[i], motions[i]);
  } catch (const WorkOver&) {
    for (size_t k = 0; k < island.numbers.size(); ++k) {
      const uint32_t i = island.numbers[k];
      const RigidTrajectory<D>& turning = island.turning[k];
      BodyRecord<D>& of = *bodies[i];
      before.put_back(i);
      stay_at_limit(of, [&](uint32_t v, double* to) { turning.place(turning.user, v, of.body.position(v), 1, to); });
      of.next.left = motion_left(motions[i].part(1), motions[i].part(0));
    }
  }
}

}  // namespace

template <int D>
void move_rigid_together(Scene<D>& scene, BodyRecord<D>* const* bodies, const RigidMove<D>* motions, size_t count,
                         const TogetherSettings& settings) {
  if (count == 0) return;
  Array<Box<D>> reaches(scene.memory);
  Array<Array<double>> targets(scene.memory);
  for (size_t i = 0; i < count; ++i) {
    BodyRecord<D>& of = *bodies[i];
    reaches.push_back(motions[i].reach(of.body));
    targets.emplace_back(D * of.body.vertices.size(), 0.0, scene.memory);
  }
  for (size_t i = 0; i < count; ++i) {
    begin_move(scene, *bodies[i]);
    bodies[i]->next.clear();
  }
  Islands<D> islands(scene.memory);
  find_islands(scene, bodies, count, reaches.data(), islands);
  leave_still_ones(scene, bodies, count, islands);
  BodiesBefore<D> before(bodies, count, scene.memory);
  Array<ShapeMove<D>> shapes(scene.memory);
  shapes.reserve(count);
  CastCounters casts;
  try {
    if (scene.turning_together.get() == nullptr) scene.turning_together.make(scene.env);
    TurningTogether<D>& move = *scene.turning_together.get();
    move.set_counters(scene.features.statistics ? &casts : nullptr);
    RigidIsland<D> moved(scene.memory);
    for (size_t island = 0; island < islands.count(); ++island) {
      for (size_t k = islands.first[island]; k < islands.first[island + 1]; ++k) {
        const uint32_t i = islands.bodies[k];
        const Partners<D>* const still = scene.features.contacts ? &islands.partners[i] : nullptr;
        moved.add(scene, *bodies[i], motions[i], still, targets[i].data(), i, shapes);
      }
      if (settings.stop == TogetherStop::kAll && island + 1 != islands.count()) continue;
      move_rigid_island(move, moved, bodies, motions, scene.features.contacts, settings, before);
      moved.clear();
    }
  } catch (...) {
    before.put_all_back();
    throw;
  }
  for (size_t i = 0; i < count; ++i) end_move(scene, *bodies[i], i == 0 ? casts : CastCounters{});
}

template void move_rigid_together(Scene<2>&, BodyRecord<2>* const*, const RigidMove<2>*, size_t,
                                  const TogetherSettings&);
template void move_rigid_together(Scene<3>&, BodyRecord<3>* const*, const RigidMove<3>*, size_t,
                                  const TogetherSettings&);

}  // namespace dsw
