#pragma once
// Bodies of which all vertices move at once.

#include <algorithm>

#include "scene/bodies.h"
#include "scene/meeting.h"
#include "together/settings.h"
#include "together/trajectory.h"

namespace dsw {

/** Bodies, distinct, with their finite targets one after the other. Throws before anything has moved. */
template <int D>
void move_together(Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, PointArray targets,
                   const TogetherSettings& settings);

/** Where the vertices of a body are. */
template <int D>
PointArray positions_of(const Body<D>& body) {
  static_assert(sizeof(BodyVertex<D>) % sizeof(double) == 0);
  return {body.vertices.empty() ? nullptr : body.vertices[0].position, sizeof(BodyVertex<D>) / sizeof(double)};
}
/** Leaves only bodies that stand still as partners of the islands. */
template <int D>
void leave_still_ones(const Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, Islands<D>& islands);
/** The body stays where it is at the work limit.
 * @param target finds where the call would take a vertex: D numbers. */
template <int D, class Target>
void stay_at_limit(BodyRecord<D>& of, Target target) {
  of.next.clear();
  of.next.fraction = 0;
  of.next.ways_left.assign(D * of.body.vertices.size(), 0.0);
  for (uint32_t v = 0; v < of.body.vertices.size(); ++v) {
    if (!of.body.has_vertex(v)) continue;
    double to[D];
    target(v, to);
    for (size_t k = 0; k < D; ++k) of.next.ways_left[D * v + k] = to[k] - of.body.position(v)[k];
    ++of.next.moved;
    of.next.limited += std::equal(to, to + D, of.body.position(v)) ? 0 : 1;
  }
  of.next.stopped = of.next.limited;
}
/** A body of a call, without its vertices' ends. */
template <int D>
Trajectory<D> trajectory_of(const Scene<D>& scene, BodyRecord<D>& of, const Partners<D>* still, PointArray targets);

/** Calls visit(body) for the bodies of a scene that a call does not move, where the environment moves. */
template <int D, class Visit>
void for_each_other_body(Scene<D>& scene, BodyRecord<D>* const* moved, size_t count, Visit visit) {
  Array<bool> moves(scene.bodies.size(), false, scene.memory);
  for (size_t i = 0; i < count; ++i) moves[static_cast<size_t>(moved[i] - scene.bodies.data())] = true;
  for (uint32_t slot = 0; slot < scene.bodies.size(); ++slot) {
    BodyRecord<D>& of = scene.bodies[slot];
    if (!scene.body_slots.alive(slot, scene.body_slots.generation(slot))) continue;
    if (!moves[slot]) visit(of);
  }
}
/** Adds the trajectory of all particles of a scene, if there are any: vertices of a body that stands still and meets no
 * other body. Their order is that of the particles' slots.
 * @param particles an empty body, which lives as long as the trajectory. */
template <int D>
void add_particles(const Scene<D>& scene, Body<D>& particles, MoveRecord& record, Array<Trajectory<D>>& trajectories);

}  // namespace dsw
