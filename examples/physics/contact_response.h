// What contacts do to velocities: impulses that end the approach, friction within its cone, and the reaction on the wall.
//
// The library has settled the positions: nothing passed anything. What is left is momentum. A contact in the middle of an edge (or face)
// belongs to all of its ends: the touching point moves with (1 - along) of the one and along of the other, and an impulse there is shared
// in the same way.
#ifndef DARTSWEEP_PHYSICS_CONTACT_RESPONSE_H
#define DARTSWEEP_PHYSICS_CONTACT_RESPONSE_H

#include <dartsweep/dartsweep.h>

#include <unordered_map>

#include "points.h"

namespace physics {

// Coefficients of friction by the host tag of cells.
struct Friction {
  std::unordered_map<std::uint32_t, double> by_tag;
  double otherwise = 0.1;

  double of(std::uint32_t tag) const {
    const auto found = by_tag.find(tag);
    return found == by_tag.end() ? otherwise : found->second;
  }
};

// One contact as momentum sees it.
struct Touch {
  int count = 1;
  std::size_t point[6] = {0, 0, 0, 0, 0, 0};
  // Weights of the touching point's place; their sum is 1. Where it touches another body of the same points, these follow with negative shares.
  double share[6] = {1, 0, 0, 0, 0, 0};
  Vector3 normal = Vector3::Zero();  // unit, out of the wall
  Vector3 at = Vector3::Zero();
  double friction = 0;
  dsw_face_id wall = {0, 0, 0};       // null: a marked edge or vertex
  std::size_t contact = 0;            // its number in dsw_body_get_contacts
  int age = 0;                        // steps since it was found
  Vector3 impulse = Vector3::Zero();  // found by `resolve`: what the body got; the wall got its opposite
};

// The contacts of the last move of a body. Contacts of vertices that were removed since are left out; so is the share of an end of an edge
// that was split since, then all of it is the moving vertex's.
// Throws LibraryError.
std::vector<Touch> read_touches(const dsw_scene* scene, dsw_body_id body, const Points& points,
                                const Friction& friction);

// Changes velocities until no touching point approaches its wall: sequential impulses (Catto 2005), all sums clamped, so that walls only
// push and friction stays in its cone. `restitution` 0: no bounce, 1: full. O(touches * rounds).
void resolve(double restitution, int rounds, std::vector<Touch>* touches, Points* points);

}  // namespace physics

#endif
