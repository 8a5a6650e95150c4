#include <algorithm>

#include "base/dimensions.h"
#include "scene/rigid_moves.h"
#include "scene/together_moves.h"
#include "together/turning_together.h"

namespace dsw {
namespace {

/** The bodies of a call as they were, to go back to. */
template <int D>
class BodiesBefore {
 public:
  BodiesBefore(BodyRecord<D>* const* bodies, size_t count, const Memory* memory)
      : bodies_(bodies), shapes_(memory), is_back_(count, false, memory) {
    for (size_t i = 0; i < count; ++i) shapes_.push_back(bodies[i]->body.shape);
  }
  /** Once: a second time changes nothing. */
  void put_back(size_t i) noexcept {
    if (is_back_[i]) return;
    is_back_[i] = true;
    put_vertices(bodies_[i]->body, bodies_[i]->before.data());
    restore_forecasts(bodies_[i]->body);
    bodies_[i]->body.shape.swap(shapes_[i]);
  }
  void put_all_back() noexcept {
    for (size_t i = 0; i < is_back_.size(); ++i) put_back(i);
  }

 private:
  BodyRecord<D>* const* bodies_;
  Array<Array<RigidShape<D>>> shapes_;
  Array<bool> is_back_;
};

/** Bodies that are moved together, by their numbers in the call. */
template <int D>
struct RigidIsland {
  Array<RigidTrajectory<D>> turning;
  Array<Trajectory<D>> trajectories;
  Array<uint32_t> numbers;

  explicit RigidIsland(const Memory* memory) : turning(memory), trajectories(memory), numbers(memory) {}
  /** @param shapes has room for one of each body of the call: trajectories point at them. */
  void add(const Scene<D>& scene, BodyRecord<D>& of, const RigidMove<D>& motion, const Partners<D>* still,
           double* targets, uint32_t number, Array<ShapeMove<D>>& shapes) {
    PlaceFn place = RigidMove<D>::place;
    const void* user = &motion;
    if (of.body.is_rigid()) {
      keep_shape(of.body);
      shapes.push_back({motion, of.body.shape[0]});
      place = ShapeMove<D>::place;
      user = &shapes.back();
    }
    turning.push_back({&of.body, &motion, place, user, still, RigidWay<D>(scene.memory),
                       Array<BodyVertex<D>>(scene.memory), Array<BodyVertex<D>>(scene.memory),
                       Array<BodyVertex<D>>(scene.memory), targets});
    trajectories.push_back(trajectory_of(scene, of, still, PointArray{targets, D}));
    numbers.push_back(number);
  }
  void clear() {
    turning.clear();
    trajectories.clear();
    numbers.clear();
  }
};

/** Moves them, or leaves them where they are at the work limit. */
template <int D>
void move_rigid_island(TurningTogether<D>& move, RigidIsland<D>& island, BodyRecord<D>* const* bodies,
                       const RigidMove<D>* motions, bool bodies_meet, const TogetherSettings& settings,
                       BodiesBefore<D>& before) {
  try {
    move.move(island.turning, island.trajectories, bodies_meet, settings);
    for (const uint32_t i : island.numbers) {
      BodyRecord<D>& of = *bodies[i];
      const RigidMotion<D> made = motions[i].part(of.next.fraction);
      if (of.next.fraction < 1) of.next.left = motion_left(motions[i].part(1), made);
      if (!of.body.is_rigid() || of.next.fraction == 0) continue;
      of.body.shape[0].moved = ShapeMove<D>{motions[i], of.body.shape[0]}.moved(of.next.fraction);
    }
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
