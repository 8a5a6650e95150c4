// Stability in contact: what touches at ratios of masses, friction, aspect ratios, stiffness and time steps, by everything that can move it.
#ifndef DARTSWEEP_PHYSICS_CONTACT_STABILITY_H
#define DARTSWEEP_PHYSICS_CONTACT_STABILITY_H

#include <string>
#include <vector>

#include "outcome.h"

namespace physics {

// What is simulated. A rod of 8 links falls and slides on posts.
enum class ContactScene {
  kPosts,           // the posts stand; the tip of the rod has `mass_ratio` times the mass of its other points
  kWalls,           // the posts give way (SWEPT); the rod has `mass_ratio` times the mass of a point of theirs
  kEndState,        // the same with END_STATE
  kBodies,          // a second rod falls on the first one, with `mass_ratio` times its mass
  kBodiesTogether,  // the same, all vertices at once
  kSelf,            // a rod lies folded over itself; the half above has `mass_ratio` times the mass of that below
  kThick,           // the rod has a radius
  kRigid,           // a rigid bar on posts that give way
  kAll  // two thick rods that meet themselves, too, all vertices at once, on posts that give way by END_STATE
};
constexpr ContactScene kContactScenes[] = {
    ContactScene::kPosts,  ContactScene::kWalls,          ContactScene::kEndState,
    ContactScene::kBodies, ContactScene::kBodiesTogether, ContactScene::kSelf,
    ContactScene::kThick,  ContactScene::kRigid,          ContactScene::kAll};
const char* name_of(ContactScene scene);

// One row is asked for by these; the defaults are easy.
struct ContactCase {
  ContactScene scene = ContactScene::kPosts;
  Integrator integrator = Integrator::kImplicitEuler;  // of a rigid bar: of the posts
  double stiffness = 1;                                // in units of mass / dt^2, the mass 1
  double dt = 1e-3;                                    // s
  double mass_ratio = 1, friction = 0.3;
  double aspect = 1;  // longest link over the shortest
};

struct ContactRow {
  ContactCase asked;
  Outcome outcome;             // `not_free`: also thick bodies that are too near, and rods that went through each other
  double energy_largest = 0;   // kinetic, over all that was put in: at the start, and by gravity down to the floor
  double largest_stretch = 0;  // | length / rest - 1 | of links
  double largest_force = 0;    // of a contact, over that which stops all of the mass in one step
  // Why the row is not stable: the axis that makes it stable when it alone is set to its default ("integrator": implicit Euler).
  std::string cause;
};

// Whether no number was refused, something moved, and no motion had twice the energy that was put in.
bool is_stable(const ContactRow& row);

// Steps until there were so many contacts, at least `least_steps` and at most `most_steps`. All is verified after every step. Throws LibraryError.
ContactRow run_contacts(const ContactCase& asked, int least_steps, int most_steps, std::size_t contacts);

// Runs a row, and finds the cause if it is not stable.
ContactRow run_contacts_with_cause(const ContactCase& asked, int least_steps, int most_steps, std::size_t contacts);

// For every scene and integrator the easy case, each axis alone with every so many-th of its values, and `corners` random corners.
std::vector<ContactCase> contact_cases(int corners, std::size_t every = 1);

}  // namespace physics

#endif
