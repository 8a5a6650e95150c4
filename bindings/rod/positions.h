#ifndef DARTSWEEP_ROD_POSITIONS_H
#define DARTSWEEP_ROD_POSITIONS_H

#include <Eigen/Dense>
#include <vector>

namespace physics {

using Vector3 = Eigen::Vector3d;
using Positions = std::vector<Vector3>;

}  // namespace physics

#endif
