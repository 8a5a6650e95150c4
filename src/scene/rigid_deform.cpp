#include "scene/rigid_deform.h"

#include <algorithm>

#include "base/dimensions.h"
#include "scene/deform_call.h"
#include "scene/rigid_island.h"

namespace dsw {
namespace {

/** One call. */
template <int D>
class RigidDeformCall : DeformCall<D> {
  using Base = DeformCall<D>;
  using Base::env, Base::points, Base::record, Base::scene;

 public:
  RigidDeformCall(Scene<D>& of, double* next, BodyRecord<D>* const* bodies, const RigidMove<D>* motions, size_t count)
      : Base(of, next), bodies_(bodies), motions_(motions), count_(count), before_(bodies, count, of.memory) {}

  void gather();
  void run(const TogetherSettings& settings);
  void keep_results(size_t point_room);

 private:
  void refuse_thick() const;
  void arrive(double fraction);
  void take_back_all();
  void stay();

  BodyRecord<D>* const* bodies_;
  const RigidMove<D>* motions_;
  size_t count_;
  BodiesBefore<D> before_;
  Islands<D> islands_{scene.memory};
  Array<ShapeMove<D>> shapes_{scene.memory};
  Array<Array<double>> targets_{scene.memory};
  RigidIsland<D> moved_{scene.memory};
  RoomSteps<D> room_{env};
};

/** Throws before anything has changed. */
template <int D>
void RigidDeformCall<D>::refuse_thick() const {
  for (uint32_t slot = 0; slot < scene.bodies.size(); ++slot) {
    if (!scene.body_slots.alive(slot, scene.body_slots.generation(slot))) continue;
    if (scene.bodies[slot].body.radius > 0) fail(DSW_STATUS_UNSUPPORTED, "a body of the scene has a radius");
  }
}

template <int D>
void RigidDeformCall<D>::gather() {
  refuse_thick();
  Array<Box<D>> reaches(scene.memory);
  shapes_.reserve(count_);
  for (size_t i = 0; i < count_; ++i) {
    BodyRecord<D>& of = *bodies_[i];
    reaches.push_back(motions_[i].reach(of.body));
    targets_.emplace_back(D * of.body.vertices.size(), 0.0, scene.memory);
  }
  this->add_still(bodies_, count_, room_.standing);
  for (size_t i = 0; i < count_; ++i) {
    begin_move(scene, *bodies_[i]);
    bodies_[i]->next.clear();
  }
  if (count_ == 0) return;
  find_islands(scene, bodies_, count_, reaches.data(), islands_);
  leave_still_ones(scene, bodies_, count_, islands_);
  for (uint32_t i = 0; i < count_; ++i) {
    const Partners<D>* const standing = scene.features.contacts ? &islands_.partners[i] : nullptr;
    moved_.add(scene, *bodies_[i], motions_[i], standing, targets_[i].data(), i, shapes_);
    // What stands has trajectories of its own here.
    moved_.trajectories.back().still = nullptr;
  }
}

template <int D>
void RigidDeformCall<D>::run(const TogetherSettings& settings) {
  record.clear();
  try {
    room_.begin(points.nexts(), record.invalid);
    if (scene.turning_together.get() == nullptr) scene.turning_together.make(scene.env);
    record.fraction = scene.turning_together.get()->move(moved_.turning, moved_.trajectories, scene.features.contacts,
                                                         settings, &room_);
    this->keep_contacts(room_.contacts);
    if (record.fraction > 0) arrive(record.fraction);
  } catch (const WorkOver&) {
    take_back_all();
    record.clear();
    record.fraction = 0;
    record.outcome = DSW_DEFORM_LIMITED;
    stay();
    return;
  } catch (...) {
    take_back_all();
    throw;
  }
  this->keep_outcome();
  for (size_t i = 0; i < count_; ++i) keep_motion(*bodies_[i], motions_[i]);
}

/** The host's points are where the environment has gone, and it reads them. */
template <int D>
void RigidDeformCall<D>::arrive(double fraction) {
  if (fraction < 1) {
    points.keep_targets();
    std::copy_n(env.points, size_t{D} * env.map.vertex_count, points.nexts());
  }
  points.read_next();
}

template <int D>
void RigidDeformCall<D>::take_back_all() {
  this->take_back(moved_.trajectories);
  before_.put_all_back();
}

/** All bodies are where they were, at the work limit. */
template <int D>
void RigidDeformCall<D>::stay() {
  for (size_t i = 0; i < count_; ++i) {
    const RigidTrajectory<D>& of = moved_.turning[i];
    stay_at_limit(*bodies_[i], [&](uint32_t v, double* to) { of.place(of.user, v, of.body->position(v), 1, to); });
    bodies_[i]->next.left = motion_left(motions_[i].part(1), motions_[i].part(0));
  }
}

template <int D>
void RigidDeformCall<D>::keep_results(size_t point_room) {
  this->keep_points(point_room);
  this->finish(bodies_, count_, moved_.trajectories);
}

}  // namespace

template <int D>
void deform_rigid(Scene<D>& scene, double* next, size_t point_room, BodyRecord<D>* const* bodies,
                  const RigidMove<D>* motions, size_t count, const TogetherSettings& settings) {
  RigidDeformCall<D> call(scene, next, bodies, motions, count);
  call.gather();
  call.run(settings);
  call.keep_results(point_room);
}

template void deform_rigid(Scene<2>&, double*, size_t, BodyRecord<2>* const*, const RigidMove<2>*, size_t,
                           const TogetherSettings&);
template void deform_rigid(Scene<3>&, double*, size_t, BodyRecord<3>* const*, const RigidMove<3>*, size_t,
                           const TogetherSettings&);

}  // namespace dsw
