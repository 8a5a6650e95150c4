// Mass points: what every model here moves. Their indices are those of the body's vertices, so arrays go to the library as they are.
#ifndef DARTSWEEP_PHYSICS_POINTS_H
#define DARTSWEEP_PHYSICS_POINTS_H

#include <cstddef>
#include <vector>

#include "rod/positions.h"

namespace physics {

// State of all points, by index. Units are the host's, as long as they fit each other (mm, s, mg and uN do).
struct Points {
  Positions position, velocity;
  std::vector<double> mass;  // 0: nobody has this index (a free slot of the body)
  std::vector<char> held;    // in a hand: moves with its velocity, whatever the forces are

  std::size_t size() const { return mass.size(); }
  // 0 where forces change nothing: held points and free slots.
  double inverse_mass(std::size_t i) const { return held[i] || mass[i] == 0 ? 0 : 1 / mass[i]; }

  // Places a point at an index, which may be new or free. (`at` by value: it may be a position from here.)
  void set(std::size_t i, Vector3 at, double point_mass);
  // Takes a point away without a trace; `split` and `merge` are what keeps momentum.
  void clear(std::size_t i);
  // Ends all motion.
  void rest() { velocity.assign(size(), Vector3::Zero()); }

  // A response inserted `added` between a and b: it takes `omega` of what interpolation would give it, (1 - share) of a's mass and share
  // of b's, out of these two. Mass and momentum stay what they were. A held end gives a copy of its share instead.
  void split(std::size_t a, std::size_t b, std::size_t added, double share, double omega);
  // The way back: `gone` gives mass and momentum to its neighbours, (1 - share) to a and share to b.
  void merge(std::size_t gone, std::size_t a, std::size_t b, double share);
  // Shares the mass out anew, by index. The velocity of the centre of mass stays what it was, and so does momentum if the sum does.
  void share_out(const std::vector<double>& masses);
};

// Sums over all points that are not held.
Vector3 momentum_of(const Points& points);
Vector3 angular_momentum_of(const Points& points);
double kinetic_energy_of(const Points& points);

// Whether every position and velocity is a number.
bool is_finite(const Points& points);

}  // namespace physics

#endif
