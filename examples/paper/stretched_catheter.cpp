#include "stretched_catheter.h"

#include <algorithm>

namespace paper {

StretchedCatheter::StretchedCatheter(physics::World* world, const physics::Route* route,
                                     const StretchedOptions& options)
    : world_(world), route_(route), options_(options), rest_(options.length) {
  physics::Positions line;
  const double edges = static_cast<double>(options.particles - 1);
  for (std::size_t i = 0; i < options.particles; ++i) {
    line.push_back(route->at(options.length * static_cast<double>(i) / edges));
  }
  physics::SoftBodyOptions body;
  body.level = DSW_LEVEL_EDGES;
  body.move.vertex_response = DSW_RESPONSE_SLIDE;
  body.move.edge_response = DSW_RESPONSE_STOP;  // the static response: no particle is added
  body.contact_memory = options.contact_memory;
  body.move.noise_share = 0;
  body.friction.otherwise = options.friction;
  body_ = world->add(std::make_unique<physics::SoftBody>(world->scene(), line, 1.0, body));
  body_->springs = physics::make_rod(line, options.stretching, options.bending);
  body_->load.drag = options.drag;
  body_->points.held[0] = 1;
  set_rest_length(rest_);
}

void StretchedCatheter::set_rest_length(double length) {
  const double edge = length / static_cast<double>(options_.particles - 1);
  for (physics::DistanceSpring& spring : body_->springs.distances) {
    spring.rest = edge;
    spring.stiffness = options_.stretching / edge;
  }
  for (physics::AngularSpring& spring : body_->springs.angles) {
    spring.stiffness = options_.bending / edge;
  }
  std::fill(body_->points.mass.begin(), body_->points.mass.end(), options_.mass * edge);
}

void StretchedCatheter::step(double dt) {
  rest_ += options_.speed * dt;
  set_rest_length(rest_);
  const std::size_t tip = options_.particles - 1;
  body_->load.force.assign(options_.particles, physics::Vector3::Zero());
  const physics::Vector3 ahead = route_->at(reached() + options_.look_ahead) - body_->points.position[tip];
  body_->load.force[tip] = options_.steering * ahead / std::max(ahead.norm(), options_.look_ahead);
  world_->step(dt);
}

double StretchedCatheter::length() const {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < options_.particles; ++i) {
    sum += (body_->points.position[i + 1] - body_->points.position[i]).norm();
  }
  return sum;
}

double StretchedCatheter::longest_edge() const {
  double longest = 0;
  for (std::size_t i = 0; i + 1 < options_.particles; ++i) {
    longest = std::max(longest, (body_->points.position[i + 1] - body_->points.position[i]).norm());
  }
  return longest;
}

}  // namespace paper
