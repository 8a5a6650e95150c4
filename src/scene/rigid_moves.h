#pragma once
// Bodies of a scene that rotate and move along as a whole.

#include "response/rigid_move.h"
#include "scene/scene.h"
#include "together/settings.h"

namespace dsw {

/** The motion of a body that keeps its shape, added to those that the shape has made. */
template <int D>
struct ShapeMove {
  const RigidMove<D>& move;
  const RigidShape<D>& shape;

  RigidMotion<D> moved(double fraction) const noexcept {
    const RigidMotion<D> part = move.part(fraction);
    RigidMotion<D> all = shape.moved;
    all.add_about(part.rotation, part.centre, part.translation);
    return all;
  }
  /** Finds where a vertex is at a fraction of the motion: a PlaceFn whose `user` is this ShapeMove. */
  static void place(const void* user, uint32_t vertex, const double*, double fraction, double* to) noexcept {
    const ShapeMove& m = *static_cast<const ShapeMove*>(user);
    m.moved(fraction).place(rest_of(m.shape, vertex), to);
  }
};

/** Whether the motion takes no vertex of a body further than doubles go. */
template <int D>
bool stays_finite(const Body<D>& body, const RigidMove<D>& motion) noexcept;

/** Moves a body as a whole as far as it is free. The places of a body that walls move as a whole follow from the shape
 * that it keeps.
 * @param rounds in how many further motions it may slide at most on what it touches. */
template <int D>
void move_rigid(Scene<D>& scene, BodyRecord<D>& of, const RigidMove<D>& motion, const MoveOrder& order,
                uint32_t rounds);

/** Moves bodies, distinct and each as a whole, all at once, up to the first touch. Throws before anything has moved. */
template <int D>
void move_rigid_together(Scene<D>& scene, BodyRecord<D>* const* bodies, const RigidMove<D>* motions, size_t count,
                         const TogetherSettings& settings);

/** The motion that is left of one that ends at `end`, after what has been made of it. Both have the centre of the whole. */
template <int D>
PlainMotion motion_left(const RigidMotion<D>& end, const RigidMotion<D>& made) noexcept;

}  // namespace dsw
