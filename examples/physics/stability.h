// How physics behaves from soft to absurdly stiff, and what the library guarantees meanwhile.
#ifndef DARTSWEEP_PHYSICS_STABILITY_H
#define DARTSWEEP_PHYSICS_STABILITY_H

#include "outcome.h"

namespace physics {

struct StabilityRow {
  Integrator integrator;
  double stiffness;  // in units of mass / dt^2
  double dt;         // s
  // A rod of 12 links of 0.1 m tumbles freely, its points thrown at up to 1 m/s each:
  double energy_drift;     // energy at the end over that at the start, minus 1
  double energy_largest;   // largest energy on the way over that at the start
  double kinetic_largest;  // largest kinetic energy on the way over the energy at the start
  double largest_stretch;  // largest | length / rest - 1 |
  double momentum_change;  // at the end, relative to the sum of all |mass * velocity| at the start
  Outcome free;
  Outcome posts;           // the same rod falls on posts, with gravity, friction and new vertices at the contacts
  Outcome pressed;         // a hand presses its end against a wall, half a link deep, and drags it along
  double pressed_stretch;  // of what was pressed; new vertices, whose links may be short, included
  Outcome surface;         // a closed surface of such springs, at level FACES, is thrown at the posts
  Outcome walls;           // the pressed rod again; the wall gives way, by springs as stiff as those of the rod

  Outcome all() const;
};

// Everything is verified after every step. O(steps).
StabilityRow run_stability(Integrator integrator, double stiffness, double dt, int steps);

// Whether the free rod is stable: all is finite, no motion has twice the energy that was put in, and it never comes to the walls, a thousand
// times its length away. (What springs hold is no measure at the stiff end: XPBD leaves a stretch of 1e-7, which is motionless, and
// times 1e12 a lot of energy.)
inline bool is_stable(const StabilityRow& row) {
  return row.free.nonfinite + row.free.refused + row.free.contacts == 0 && row.kinetic_largest <= 2;
}

}  // namespace physics

#endif
