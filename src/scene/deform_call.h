#pragma once
// What calls that move bodies and the environment at once have in common.

#include "motion/points_way.h"
#include "scene/bodies.h"
#include "scene/deformation.h"
#include "scene/together_moves.h"

namespace dsw {

/** One call. Particles are the vertices of a body that stands still and meets no other body. Throws std::bad_alloc. */
template <int D>
struct DeformCall {
  DeformCall(Scene<D>& of, double* next);

  /** A body of the scene. `still` is the record of those that the call does not move. */
  Trajectory<D> trajectory(BodyRecord<D>& of, PointArray targets, MoveRecord* of_move);
  /** Adds the bodies of the scene that the call does not move, and the particles. */
  void add_still(BodyRecord<D>* const* moved, size_t count, Array<Trajectory<D>>& to);
  /** Makes the host's points, the environment and the bodies what they were before. */
  void take_back(const Array<Trajectory<D>>& trajectories);
  /** Keeps contacts of walls, with the scene's names of particles. */
  void keep_contacts(const Array<dsw_wall_contact>& contacts);
  /** Notes the outcome that follows from the fraction and the points that are held. */
  void keep_outcome() noexcept;
  /** Notes that the environment has been lent the host's points, if it reads them. */
  void keep_points(size_t point_room) noexcept;
  /** Makes the results those of the scene's last deformation. */
  void finish(BodyRecord<D>* const* bodies, size_t count, const Array<Trajectory<D>>& trajectories);

  Scene<D>& scene;
  Environment<D>& env;
  WallRecord& record;
  PointsWay<D> points;
  Body<D> particles;
  Array<uint32_t> slots;  // of the particles
  MoveRecord still;       // of what stands still
};

}  // namespace dsw
