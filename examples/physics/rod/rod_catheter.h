// A rod that is pushed through a lumen: catheter.h with the rod as its physics. Vertices in order, the tip first.
#ifndef DARTSWEEP_PHYSICS_ROD_ROD_CATHETER_H
#define DARTSWEEP_PHYSICS_ROD_ROD_CATHETER_H

#include "near_rows.h"
#include "rod/rod.h"
#include "route.h"
#include "soft_body.h"

namespace physics {

// Units are mm, s and mg, so forces are in uN.
struct RodCatheterOptions {
  double link = 2.5;      // mm
  std::size_t links = 0;  // at most; once all are in, the hand goes on along the route. 0: there is always another one
  double speed = 30;      // of the hand, mm/s
  double feeding = 0;     // of the hand until all links are in, mm/s; 0: the same
  double turning = 0;     // of the hand, about the wire, rad/s
  double mass = 1.6;      // mg/mm
  double stretching = 2e9;  // uN
  double bending = 5e6;     // uN mm^2
  double twisting = 4e6;    // uN mm^2
  double tip_length = 0;  // mm, over which the wire gets as soft as `tip_softness`, and is bent at rest by `tip_angle`
  double tip_softness = 1;  // share of the stiffness
  double tip_angle = 0;     // rad
  double steering = 3e5;    // force on the tip towards the route ahead of it, uN
  double look_ahead = 4;    // how far ahead that is, mm
  double most_force = 1e6;  // uN, with which the hand pushes
  dsw_level level = DSW_LEVEL_EDGES_SWEPT;
  NearRowOptions near;
  RodOptions rod;

  RodCatheterOptions() {
    rod.drag = 20;
    rod.contact.tolerance = 1e-4;
  }
};

// Gives the options of a catheter where a mm is `scale` units of length, as `scaled` of catheter.h does.
RodCatheterOptions scaled(RodCatheterOptions options, double scale);

class RodCatheter {
 public:
  // `scene` and `route` have to outlive the catheter. Throws LibraryError.
  RodCatheter(dsw_scene* scene, const Route* route, const RodCatheterOptions& options);

  // One time step: a link more comes in when the hand has gone so far, the hand goes on, and the tip is steered.
  void step(double dt);

  const Rod& rod() const { return *rod_; }
  dsw_body_id id() const { return id_; }
  const StepReport& report() const { return report_; }
  const RodContactReport& contact_report() const { return contact_report_; }
  const NearRows& rows() const { return rows_; }
  // The seconds of the last step, on the wall clock: for finding the rows, and for the rod's own step.
  double rows_seconds() const { return rows_seconds_; }
  double rod_seconds() const { return rod_seconds_; }
  // How far along the route the tip is.
  double reached() const { return route_->nearest(rod_->shape.position.front()); }
  std::size_t links() const { return rod_->edges.size(); }

 private:
  RodEdge edge_at(std::size_t edge) const;
  void create(const Positions& line);
  void feed();
  void lead(double dt);
  void move(double dt);

  dsw_scene* scene_;
  const Route* route_;
  RodCatheterOptions options_;
  dsw_body_id id_ = {0, 0};
  std::optional<Rod> rod_;
  std::vector<dsw_volume_id> volumes_;  // that the vertices lie in
  NearRows rows_;
  StepReport report_;
  RodContactReport contact_report_;
  double rows_seconds_ = 0, rod_seconds_ = 0;
  Vector3 direction_ = Vector3::UnitX();  // of the hand
  double pushed_ = 0, speed_ = 0;         // where on the route the hand is, and how fast
};

}  // namespace physics

#endif
