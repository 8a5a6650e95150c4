// Distance springs keep lengths, angular springs keep a line straight: a catheter is a row of both.
//
// Both are one thing to an integrator: a number C that is 0 at rest, its gradient, and a stiffness k; the energy is k C^2 / 2.
#ifndef DARTSWEEP_PHYSICS_SPRINGS_H
#define DARTSWEEP_PHYSICS_SPRINGS_H

#include <Eigen/SparseCore>

#include "points.h"

namespace physics {

// A leg of a rod that is pressed together to less than this share of its length has lost its direction.
constexpr double kPressedShare = 0.1;

// C = |b - a| - rest.
struct DistanceSpring {
  std::size_t a, b;
  double rest;       // length
  double stiffness;  // force per length
};

// C = |v - u| = 2 sin(angle / 2), where u and v are the directions from a to b and from b to c. No angle is singular but that of a fold.
// The direction of a leg that is pressed together, to less than `least`, is that leg over `least`: its torque stays finite.
struct AngularSpring {
  std::size_t a, b, c;
  double stiffness;  // torque per radian, for small angles
  double least = 0;  // length of a leg
};

// One spring as it stands: value and gradient, in up to three points.
struct Deformation {
  int count = 0;
  std::size_t point[3] = {0, 0, 0};
  Vector3 gradient[3];
  double value = 0, stiffness = 0;
};

Deformation deformation_of(const DistanceSpring& spring, const Positions& at);
Deformation deformation_of(const AngularSpring& spring, const Positions& at);

class Springs {
 public:
  std::vector<DistanceSpring> distances;
  std::vector<AngularSpring> angles;

  double energy(const Positions& at) const;
  // Adds the forces to `force`, one vector for each point.
  void add_forces(const Positions& at, Positions* force) const;
  // Adds scale * stiffness matrix as entries (3 i + row, 3 j + column). It is the second derivative of the energy without what would
  // make it indefinite, so that a Newton step always leads downhill (Choi and Ko 2002).
  void add_stiffness(const Positions& at, double scale, std::vector<Eigen::Triplet<double>>* entries) const;
  // Largest | length / rest - 1 | of the distance springs.
  double largest_stretch(const Positions& at) const;

  // A vertex was inserted between a and b: their spring becomes two in series, and the line goes through it.
  void split(std::size_t a, std::size_t b, std::size_t added, double share);
  // Undoes it: the two springs at `gone` become one. Returns the neighbours and where between them it was in `share`, 0 at a; false,
  // with all springs at it gone, where it had not two distance springs.
  bool merge(std::size_t gone, std::size_t* a, std::size_t* b, double* share);
};

// A row of springs through points in order: stretching and bending resistance are those of a rod (force; force times area).
Springs make_rod(const Positions& line, double stretching, double bending);

}  // namespace physics

#endif
