#include "scene/rigid_moves.h"

#include <utility>

namespace dsw {
namespace {

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

}  // namespace

template <int D>
bool stays_finite(const Body<D>& body, const RigidMove<D>& motion) noexcept {
  if (!is_finite<3>(motion.way().place[1])) return false;
  for (const BodyVertex<D>& each : body.vertices) {
    double to[D];
    if (!each.cell.valid()) continue;
    RigidMove<D>::place(&motion, 0, each.position, 1, to);
    if (!is_finite<D>(to)) return false;
  }
  return true;
}

template <int D>
void move_rigid(Scene<D>& scene, BodyRecord<D>& of, const RigidMove<D>& motion, const MoveOrder& order) {
  if (!of.body.is_rigid()) {
    return move_body_rigidly(scene, of, motion, RigidMove<D>::place, &motion, order);
  }
  RigidShape<D> before = of.body.shape[0];
  keep_shape(of.body);
  const ShapeMove<D> kept{motion, of.body.shape[0]};
  try {
    move_body_rigidly(scene, of, motion, ShapeMove<D>::place, &kept, order);
  } catch (...) {
    std::swap(of.body.shape[0], before);
    throw;
  }
  if (of.record.fraction > 0) of.body.shape[0].moved = kept.moved(of.record.fraction);
}

#define DSW_RIGID_MOVES(D)                                                  \
  template bool stays_finite(const Body<D>&, const RigidMove<D>&) noexcept; \
  template void move_rigid(Scene<D>&, BodyRecord<D>&, const RigidMove<D>&, const MoveOrder&)
DSW_RIGID_MOVES(2);
DSW_RIGID_MOVES(3);
#undef DSW_RIGID_MOVES

}  // namespace dsw
