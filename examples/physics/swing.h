// A rope of springs that hangs from one end and swings: the same in every program, also in peers, that solves it.
#ifndef DARTSWEEP_PHYSICS_SWING_H
#define DARTSWEEP_PHYSICS_SWING_H

#include "integrators.h"

namespace physics {

struct Swing {
  static constexpr int kLinks = 12;
  static constexpr double kLink = 0.1, kMass = 0.1, kGravity = 9.81;  // m, kg, m/s^2
  static constexpr double kTilt = 0.3;                                // of the rope at the start: dx over -dz

  Points points;
  Springs springs;
  Load load;

  explicit Swing(double stiffness);  // N/m, of each link
};

// Processor time of a run; `trace` gets all positions after every 0.1 s. `seconds` has to be a multiple of it, and that of dt.
double run(const Swing& swing, const IntegratorOptions& options, double dt, double seconds,
           std::vector<Positions>* trace);

// Runs the swing by the classical method of Runge and Kutta, of fourth order: with a small step, the truth.
void run_reference(const Swing& swing, double dt, double seconds, std::vector<Positions>* trace);

// Largest distance between points of the same index at the same time; what is no number is the largest.
double distance_of(const std::vector<Positions>& a, const std::vector<Positions>& b);

}  // namespace physics

#endif
