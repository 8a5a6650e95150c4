// A catheter that is pushed through a lumen by its tail, link by link from the inlet, its tip steered.
#ifndef DARTSWEEP_PHYSICS_CATHETER_H
#define DARTSWEEP_PHYSICS_CATHETER_H

#include "flow.h"
#include "world.h"

namespace physics {

// Units are mm, s and mg, so forces are in uN: a soft guide wire in blood.
struct CatheterOptions {
  double link = 2.5;        // mm
  double speed = 30;        // of the tail, mm/s
  double mass = 4;          // of a link, mg
  double stretching = 1e8;  // uN
  double bending = 2e6;     // uN mm^2
  double steering = 2e4;    // force on the tip along the guide, uN
  double drag = 20;         // of blood, 1/s
  SoftBodyOptions body;
};

class Catheter {
 public:
  // In the lumen of the world's environment; `flow` has to outlive the catheter. Throws LibraryError.
  Catheter(World* world, const demo_flow* flow, const CatheterOptions& options);

  // One time step of the world: the tail goes on, the tip is steered, and a link more comes in when the tail has gone so far.
  void step(double dt);

  SoftBody& body() { return *body_; }
  const SoftBody& body() const { return *body_; }
  // How far along the way from the inlet the tip is, mm.
  double reached() const;

 private:
  void feed();
  std::uint32_t slot_of_tip() const;

  World* world_;
  const demo_flow* flow_;
  CatheterOptions options_;
  SoftBody* body_ = nullptr;
  Vector3 entry_, inwards_;
  std::size_t tail_ = 0, tip_ = 1;
};

}  // namespace physics

#endif
