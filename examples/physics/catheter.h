// A catheter that is pushed through a lumen by its tail, link by link from the inlet, its tip steered.
#ifndef DARTSWEEP_PHYSICS_CATHETER_H
#define DARTSWEEP_PHYSICS_CATHETER_H

#include "route.h"
#include "world.h"

namespace physics {

// Units are mm, s and mg, so forces are in uN: a soft guide wire in blood. See `scaled` for other sizes.
struct CatheterOptions {
  double link = 2.5;      // mm
  std::size_t links = 0;  // at most; once all are in, the tail goes on along the route. 0: there is always another one
  double speed = 30;      // of the hand, mm/s
  double feeding = 0;     // of the hand until all links are in, mm/s; 0: the same
  double mass = 1.6;      // mg/mm
  double stretching = 1e8;  // uN
  double bending = 1e7;     // uN mm^2
  double steering = 1e5;    // force on the tip towards the route ahead of it, uN
  double look_ahead = 4;    // how far ahead that is, mm
  // The hand feels the force: it waits while the link before it is shorter or longer than at rest by this share. When all
  // links are in and the tip is at the end of the route, it rests.
  double most_strain = 0.2;
  double drag = 20;  // of blood, 1/s
  SoftBodyOptions body;
};

// Gives the options of a catheter where a mm is `scale` units of length: it does the same motion, larger. (Its mass
// stays; its density does not.)
CatheterOptions scaled(CatheterOptions options, double scale);

class Catheter {
 public:
  // In the lumen of the world's environment; `route` has to outlive the catheter. Throws LibraryError.
  Catheter(World* world, const Route* route, const CatheterOptions& options);

  // One time step of the world: a link more comes in when the tail has gone so far, the tail goes on, and the tip is steered.
  void step(double dt);

  SoftBody& body() { return *body_; }
  const SoftBody& body() const { return *body_; }
  // How far along the route the tip is.
  double reached() const { return route_->nearest(body_->points.position[tip_]); }
  // Links are in; vertices that a response inserted make no link more.
  std::size_t links() const { return links_; }
  // Vertices in order, the tail first. O(vertices).
  std::vector<std::size_t> line() const;

 private:
  void feed();
  void lead(std::size_t vertex, double way, double dt);
  double strain_before_hand() const;

  World* world_;
  const Route* route_;
  CatheterOptions options_;
  SoftBody* body_ = nullptr;
  std::size_t tail_ = 0, second_ = 1, tip_ = 1,
              links_ = 1;          // the first two are in the hand, so it pushes along the route
  double pushed_ = 0, speed_ = 0;  // where on the route the hand is, and how fast
};

}  // namespace physics

#endif
