// The middle line of a lumen, from its inlet to one of its ends: where a hand pushes a catheter along.
#ifndef DARTSWEEP_PHYSICS_ROUTE_H
#define DARTSWEEP_PHYSICS_ROUTE_H

#include "flow.h"
#include "library.h"
#include "points.h"

namespace physics {

class Route {
 public:
  // Through the middles of the volumes on the path of `flow`, made smooth as far as every piece of it stays free. Throws LibraryError;
  // std::invalid_argument where the path has fewer than two volumes.
  Route(const dsw_environment* environment, const demo_flow& flow);

  double length() const { return from_inlet_.back(); }
  // `way` is the length from the inlet; the ends count where it is out of range. O(log points).
  Vector3 at(double way) const;
  // How far from the inlet the nearest point of the line is. O(points).
  double nearest(const Vector3& point) const;

 private:
  void smooth(const dsw_environment* environment, const demo_flow& flow);

  Positions line_;
  std::vector<double> from_inlet_;
};

}  // namespace physics

#endif
