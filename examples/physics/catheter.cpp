#include "catheter.h"

namespace physics {

Catheter::Catheter(World* world, const demo_flow* flow, const CatheterOptions& options)
    : world_(world), flow_(flow), options_(options) {
  const std::uint32_t inlet = flow->path[0];
  entry_ = Eigen::Map<const Vector3>(flow->centre + 3 * std::size_t{inlet});
  inwards_ = Eigen::Map<const Vector3>(flow->guide + 3 * std::size_t{inlet});
  const Positions line = {entry_, entry_ + options.link * inwards_};
  options_.body.move.min_length = 0.1 * options.link;
  body_ = world->add(std::make_unique<SoftBody>(world->scene(), line, options.mass, options_.body));
  body_->springs = make_rod(line, options.stretching, options.bending);
  body_->load.drag = options.drag;
  body_->points.held[tail_] = 1;
}

std::uint32_t Catheter::slot_of_tip() const { return flow_->slot_of[body_->volumes[tip_].index]; }

double Catheter::reached() const { return flow_->from_inlet[slot_of_tip()]; }

void Catheter::step(double dt) {
  Points& points = body_->points;
  points.velocity[tail_] = options_.speed * inwards_;
  body_->load.force.assign(points.size(), Vector3::Zero());
  body_->load.force[tip_] =
      options_.steering * Eigen::Map<const Vector3>(flow_->guide + 3 * std::size_t{slot_of_tip()});
  world_->step(dt);
  feed();
}

// Where the new edge would not be free the tail goes on for now.
void Catheter::feed() {
  std::size_t added = 0;
  if ((body_->points.position[tail_] - entry_).norm() >= options_.link &&
      body_->add_vertex(entry_, tail_, options_.mass, options_.stretching, options_.bending, &added)) {
    body_->points.held[tail_] = 0;
    body_->points.held[added] = 1;
    tail_ = added;
  }
}

}  // namespace physics
