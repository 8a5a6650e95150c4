#include "world.h"

#include <algorithm>

namespace physics {
namespace {

// A wall that pushed a vertex takes it along: it is at least as fast as the wall was, in the direction of the push.
void follow_walls(double dt, SoftBody* body, StepReport* report) {
  const Positions before = body->points.position;
  body->follow_edits(report);
  body->read_positions();
  Points& points = body->points;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Vector3 push = points.position[i] - before[i];
    const double length = push.norm();
    if (length > 0 && points.inverse_mass(i) > 0) {
      const Vector3 direction = push / length;
      points.velocity[i] += std::max(0.0, length / dt - points.velocity[i].dot(direction)) * direction;
    }
  }
}

Scene create_scene(dsw_environment* environment, std::uint32_t features) {
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = features;
  dsw_scene* scene = nullptr;
  check(dsw_scene_create(environment, &desc, &scene), "creating a scene");
  return Scene(scene);
}

}  // namespace

World::World(dsw_environment* environment, std::uint32_t features) : scene_(create_scene(environment, features)) {}

SoftBody* World::add(std::unique_ptr<SoftBody> body) {
  bodies_.push_back(std::move(body));
  reports_.emplace_back();
  return bodies_.back().get();
}

Walls* World::add_walls(const WallOptions& options) {
  walls_ = std::make_unique<Walls>(scene(), options);
  return walls_.get();
}

std::size_t World::step(double dt) {
  std::size_t refused = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    reports_[i] = bodies_[i]->step(dt);
    refused += reports_[i].was_finite ? 0 : 1;
  }
  if (!walls_) {
    return refused;
  }
  for (const auto& body : bodies_) {
    walls_->take_reactions(body->touches());
  }
  if (walls_->step(dt, &wall_report_) != DSW_STATUS_OK) {
    return refused + 1;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    follow_walls(dt, bodies_[i].get(), &reports_[i]);
  }
  return refused;
}

}  // namespace physics
