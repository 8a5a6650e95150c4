// One row of a contact solver: a place with a normal impulse, and friction across it.
#ifndef DARTSWEEP_ROD_ROD_ROW_H
#define DARTSWEEP_ROD_ROD_ROW_H

#include "positions.h"

namespace physics {

struct RowState {
  Eigen::Matrix3d frame;  // columns: the normal, and two directions along the obstacle that friction does not couple
  Eigen::Matrix3d compliance;  // in this frame
  Vector3 wanted;              // velocity in the frame: the least one along the normal, that of the obstacle across
  Vector3 impulse;             // in the frame

  // `world` is the compliance in space. The row starts from the impulse `start`.
  void set(const Vector3& normal, const Eigen::Matrix3d& world, const Vector3& obstacle_velocity, double least_normal,
           const Vector3& start);
  // Nothing of the row is held.
  bool moves() const { return compliance(0, 0) > 0 && compliance(1, 1) > 0 && compliance(2, 2) > 0; }
  // Block Gauss-Seidel, where the row moves with `velocity`: the normal first, then friction as the point of the disc
  // that dissipates most. Returns how much the velocity of the row changes.
  double update(double friction, const Vector3& velocity);
};

// The least velocity along the normal: a gap may close, and a share of a negative gap is taken back in a step.
inline double least_velocity(double gap, double recovery, double dt) { return -(gap > 0 ? gap : recovery * gap) / dt; }

}  // namespace physics

#endif
