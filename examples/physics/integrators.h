// Three ways through one time step. Each says where the points want to be; how far they come is the library's answer.
#ifndef DARTSWEEP_PHYSICS_INTEGRATORS_H
#define DARTSWEEP_PHYSICS_INTEGRATORS_H

#include "springs.h"

namespace physics {

enum class Integrator {
  // New velocities from old positions, new positions from new velocities. One evaluation of forces; energy swings about its value without
  // drift, as long as dt * (largest frequency) < 2, and there is no mercy beyond that.
  kSymplecticEuler,
  // The end of the step is where the incremental potential, |x - inertial target|^2_M / (2 dt^2) + energy(x), is least: implicit Euler as a
  // minimisation (Martin, Thomaszewski, Grinspun, Gross 2011). Newton steps by a sparse Cholesky solve, each of which must lead
  // downhill, so it is stable at any stiffness; it damps what is faster than dt.
  kImplicitEuler,
  // Extended position based dynamics (Macklin, Mueller, Chentanez 2016): springs one after the other, with compliance 1 / stiffness. Stable
  // at any stiffness, too; how far it gets depends on the number of sweeps.
  kXpbd
};

const char* name_of(Integrator integrator);

// What acts on all points beside springs.
struct Load {
  Vector3 gravity = Vector3::Zero();  // acceleration
  double drag = 0;                    // share of the velocity lost per unit of time
  Positions force;                    // on each point; may be shorter than the points are
};

struct IntegratorOptions {
  Integrator method = Integrator::kImplicitEuler;
  int newton_steps = 8;  // implicit Euler: at most
  int sweeps = 40;       // XPBD
};

// `next` becomes the points at the end of the step as if nothing were in the way. O(points + springs) for symplectic Euler, times sweeps
// for XPBD, times Newton steps for implicit Euler of a catheter (its matrix is a band).
void integrate(const Points& now, const Springs& springs, const Load& load, double dt, const IntegratorOptions& options,
               Points* next);

}  // namespace physics

#endif
