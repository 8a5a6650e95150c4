// The dials of physics, each as a curve of error against run time (see curve.h).
#ifndef DARTSWEEP_PHYSICS_DIALS_H
#define DARTSWEEP_PHYSICS_DIALS_H

#include <string>

namespace physics {

// A rope that swings, without anything to meet, by each integrator and at time steps from 1e-5 to 0.1 s: how far its points come to lie from
// those of a reference solution. Curve `integrator`, and swing.json, the rope for mujoco_peer.py. False where a file can't be written, here and below.
bool measure_integrators(const std::string& folder, bool quick);

// The sweeps of XPBD, and the Newton steps of implicit Euler, at three stiffnesses: how far they stay from the end of the step that both are
// looking for. Curve `solver_steps`.
bool measure_solvers(const std::string& folder, bool quick);

// The share of the way to its goals that a matched shape makes in a step: how far it sags. Curve `shape_matching`.
bool measure_shape_matching(const std::string& folder, bool quick);

// The weight omega of inserted vertices in equation 1 of [JCD10] 7.3: a body folds over a ridge that it lies on by one
// end. How far its rotation is from that of the same body with eight times as many vertices along, and the rotation that
// inserted vertices add in a step.
// Curve `omega`. Throws LibraryError.
bool measure_omega(const std::string& folder, bool quick);

// A rod that turns against a post, its vertices moved one at a time, at time steps from 1e-5 to 0.1 s: contact times and the shape reached,
// against those of all vertices moving at once. Curve `time_step`. Throws LibraryError.
bool measure_time_step(const std::string& folder, bool quick);

// A rod that falls on posts: rounds of impulses, steps that contacts are kept, and the most vertices, against many rounds, none and no bound.
// Curve `contact_response`. Throws LibraryError.
bool measure_contacts(const std::string& folder, bool quick);

// From which pull on an inserted vertex is removed by [JCD10] 7.3.1: the rotation of a bar that is pressed on a ridge and lifted. Curve
// `negligible`. Throws LibraryError.
bool measure_negligible(const std::string& folder, bool quick);

// The implicit rod in a ring-shaped lumen: linearisations, sweeps, tolerance, direct solutions and recovery. Curve `rod`.
bool measure_rod(const std::string& folder, bool quick);

}  // namespace physics

#endif
