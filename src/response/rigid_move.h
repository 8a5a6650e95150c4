#pragma once
// A rotation about a centre and a translation, both made steadily: what dsw_rigid_motion asks for.

#include "base/vec.h"
#include "body/body.h"
#include "body/box.h"
#include "predicates/turning_pair.h"

namespace dsw {

template <int D>
class RigidMove {
 public:
  /** All finite. The quaternion x y z w has any length but 0; of the two ways round, the shorter one is taken. In the
   * plane x and y of the quaternion, and what is given as third component, are 0. */
  RigidMove(const double* quaternion, const double* centre, const double* translation) noexcept;

  /** A fraction of the motion. */
  RigidMotion<D> part(double fraction) const noexcept;
  /** Where a point is at a fraction of the motion; `user` is the motion: a PlaceFn. */
  static void place(const void* user, uint32_t vertex, const double* from, double fraction, double* to) noexcept;

  /** The motion exactly, but for the rounding of the end of the centre's way. */
  TurningWay way() const noexcept;
  /** A box around all that a part of it does to a body: points keep their distance from the centre, which goes along a
   * line. */
  Box<D> reach(const Body<D>& body) const noexcept;

 private:
  double rotation_[4];  // a quaternion of length 1
  Vec centre_, translation_;
};

}  // namespace dsw
