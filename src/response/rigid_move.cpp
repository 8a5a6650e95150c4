#include "response/rigid_move.h"

#include <algorithm>
#include <cmath>

namespace dsw {

template <int D>
RigidMove<D>::RigidMove(const double* quaternion, const double* centre, const double* translation) noexcept
    : centre_(to_vec<3>(centre)), translation_(to_vec<3>(translation)) {
  double size = 0;
  for (int k = 0; k < 4; ++k) size = std::max(size, std::fabs(quaternion[k]));
  for (int k = 0; k < 4; ++k) rotation_[k] = quaternion[k] / size;  // squares neither over- nor underflow
  normalise(rotation_);
  if (rotation_[3] < 0) {
    for (double& each : rotation_) each *= -1;
  }
}

template <int D>
RigidMotion<D> RigidMove<D>::part(double fraction) const noexcept {
  RigidMotion<D> part;
  store<3>(fraction * to_vec<3>(rotation_), part.rotation);
  part.rotation[3] = (1 - fraction) + fraction * rotation_[3];
  normalise(part.rotation);
  store<D>(centre_, part.centre);
  store<D>(fraction * translation_, part.translation);
  return part;
}

template <int D>
TurningWay RigidMove<D>::way() const noexcept {
  TurningWay way{{{0, 0, 0, 1}, {}}, {}, {}};
  std::copy_n(rotation_, 4, way.turn[1]);
  for (int k = 0; k < 3; ++k) {
    // What does not turn goes the same way about every centre: about 0 nothing is rounded.
    way.centre[k] = way.place[0][k] = is_zero(to_vec<3>(rotation_)) ? 0 : centre_[k];
    way.place[1][k] = way.place[0][k] + translation_[k];
  }
  return way;
}

template <int D>
void RigidMove<D>::place(const void* user, uint32_t, const double* from, double fraction, double* to) noexcept {
  static_cast<const RigidMove*>(user)->part(fraction).place(from, to);
}

template <int D>
Box<D> RigidMove<D>::reach(const Body<D>& body) const noexcept {
  double radius = 0;
  for (const BodyVertex<D>& each : body.vertices) {
    if (each.cell.valid()) radius = std::max(radius, length(difference<D>(each.position, centre_.data())));
  }
  radius *= 1 + 0x1p-20;
  Box<D> box;
  for (const double way : {0.0, 1.0}) {
    const Vec at = centre_ + way * translation_, room = Vec::Constant(radius) + 0x1p-40 * at.magnitudes();
    const Vec low = at - room, high = at + room;
    box.add(low.data());
    box.add(high.data());
  }
  return box;
}

template class RigidMove<2>;
template class RigidMove<3>;

}  // namespace dsw
