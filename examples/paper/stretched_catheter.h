// The catheter of [JCD10] 7.2: twenty particles, distance springs and angular springs. It is pushed in without adding particles, so its
// edges get longer.
#ifndef DARTSWEEP_PAPER_STRETCHED_CATHETER_H
#define DARTSWEEP_PAPER_STRETCHED_CATHETER_H

#include "route.h"
#include "world.h"

namespace paper {

// Units are mm, s and mg, so forces are in uN, as in physics/catheter.h.
struct StretchedOptions {
  std::size_t particles = 20;
  double length = 10;       // at the beginning, mm
  double speed = 30;        // by which the length at rest grows, mm/s
  double mass = 1.6;        // mg/mm, of the length at rest
  double stretching = 3e6;  // uN
  double bending = 1e7;     // uN mm^2
  double steering = 1e5;    // force on the tip towards the route ahead of it, uN
  double look_ahead = 4;    // how far ahead that is, mm
  double drag = 20;         // of blood, 1/s
  double friction = 0.04;   // of a coated catheter
  // Steps for which a contact stays a constraint of the physics, see physics::SoftBodyOptions. 0: edges catch at the wall until the springs
  // tear them off. 1 or more: the catheter slides on.
  int contact_memory = 1;
};

class StretchedCatheter {
 public:
  // Lies on the route from its beginning, where the hand holds the first particle. `route` has to outlive the catheter. Throws LibraryError.
  StretchedCatheter(physics::World* world, const physics::Route* route, const StretchedOptions& options);

  // One time step of the world. The springs' lengths at rest grow first, all alike: that is the push.
  void step(double dt);

  physics::SoftBody& body() { return *body_; }
  double length() const;  // of the line
  double rest_length() const { return rest_; }
  double longest_edge() const;
  double reached() const { return route_->nearest(body_->points.position.back()); }

 private:
  void set_rest_length(double length);

  physics::World* world_;
  const physics::Route* route_;
  StretchedOptions options_;
  physics::SoftBody* body_ = nullptr;
  double rest_;
};

}  // namespace paper

#endif
