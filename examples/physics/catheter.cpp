#include "catheter.h"

#include <algorithm>
#include <cmath>

namespace physics {
namespace {

constexpr double kFastest = 3;

}  // namespace

CatheterOptions scaled(CatheterOptions options, double scale) {
  options.link *= scale;
  options.look_ahead *= scale;
  options.speed *= scale;
  options.feeding *= scale;
  options.mass /= scale;
  options.stretching *= scale;
  options.bending *= scale * scale * scale;
  options.steering *= scale;
  return options;
}

Catheter::Catheter(World* world, const Route* route, const CatheterOptions& options)
    : world_(world), route_(route), options_(options) {
  const Positions line = {route->at(0), route->at(options.link)};
  options_.body.move.min_length = 0.3 * options.link;
  body_ = world->add(std::make_unique<SoftBody>(world->scene(), line, options.mass * options.link, options_.body));
  body_->springs = make_rod(line, options.stretching, options.bending);
  body_->load.drag = options.drag;
  body_->points.held = {1, 1};
}

void Catheter::step(double dt) {
  feed();
  Points& points = body_->points;
  const bool feeds = options_.feeding > 0 && links_ < options_.links;
  speed_ = feeds ? options_.feeding : options_.speed;
  const double reached_now = reached();
  const bool is_there =
      options_.links > 0 && links_ >= options_.links && reached_now + options_.link >= route_->length();
  if (!is_there && !(strain_before_hand() > options_.most_strain)) {
    pushed_ += speed_ * dt;
  }
  lead(tail_, pushed_, dt);
  lead(second_, pushed_ + options_.link, dt);
  body_->load.force.assign(points.size(), Vector3::Zero());
  const Vector3 ahead = route_->at(reached_now + options_.look_ahead) - points.position[tip_];
  body_->load.force[tip_] = options_.steering * ahead / std::max(ahead.norm(), options_.look_ahead);
  world_->step(dt);
}

// The hand takes a vertex to where it should be, but not faster than so many times its own speed.
void Catheter::lead(std::size_t vertex, double way, double dt) {
  const Vector3 left = route_->at(way) - body_->points.position[vertex];
  body_->points.velocity[vertex] = left / std::max(dt, left.norm() / (kFastest * speed_));
}

// How much the first spring that is not in the hand is shorter or longer than at rest, as a share of that.
double Catheter::strain_before_hand() const {
  for (const DistanceSpring& spring : body_->springs.distances) {
    const bool starts = spring.a == second_ && spring.b != tail_, ends = spring.b == second_ && spring.a != tail_;
    if (starts || ends) {
      const Positions& at = body_->points.position;
      return std::abs((at[spring.b] - at[spring.a]).norm() / spring.rest - 1);
    }
  }
  return 0;
}

// Where the new edge would not be free the tail goes on for now.
void Catheter::feed() {
  std::size_t added = 0;
  if ((options_.links == 0 || links_ < options_.links) && pushed_ >= options_.link &&
      body_->add_vertex(route_->at(0), tail_, options_.mass * options_.link, options_.stretching, options_.bending,
                        &added)) {
    body_->points.held[second_] = 0;
    body_->points.held[added] = 1;
    second_ = tail_;
    tail_ = added;
    pushed_ = 0;
    ++links_;
  }
}

std::vector<std::size_t> Catheter::line() const {
  std::vector<std::vector<std::size_t>> neighbours(body_->points.size());
  for (const DistanceSpring& spring : body_->springs.distances) {
    neighbours[spring.a].push_back(spring.b);
    neighbours[spring.b].push_back(spring.a);
  }
  std::vector<std::size_t> line = {tail_};
  for (std::size_t before = tail_; line.back() != tip_;) {
    const std::vector<std::size_t>& both = neighbours[line.back()];
    const std::size_t next = both.front() == before ? both.back() : both.front();
    before = line.back();
    line.push_back(next);
  }
  return line;
}

}  // namespace physics
