#pragma once
// Rigid bodies that move at once, each on a motion of its own.

#include "scene/rigid_moves.h"
#include "scene/together_moves.h"
#include "together/turning_together.h"

namespace dsw {

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

/** Notes what is left of the motion of a body, and its shape. */
template <int D>
void keep_motion(BodyRecord<D>& of, const RigidMove<D>& motion) {
  const RigidMotion<D> made = motion.part(of.next.fraction);
  if (of.next.fraction < 1) of.next.left = motion_left(motion.part(1), made);
  if (!of.body.is_rigid() || of.next.fraction == 0) return;
  of.body.shape[0].moved = ShapeMove<D>{motion, of.body.shape[0]}.moved(of.next.fraction);
}

}  // namespace dsw
