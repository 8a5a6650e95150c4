#include "rod_catheter.h"

#include <algorithm>
#include <chrono>

namespace physics {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFastestHand = 3;  // times the hand's own speed
constexpr double kReaction = 0.02;  // s, in which the hand changes its speed

// The point at the distance `length` from `from` towards `to`.
Vector3 towards(const Vector3& from, const Vector3& to, double length) {
  return from + length * (to - from).normalized();
}

}  // namespace

RodCatheterOptions scaled(RodCatheterOptions options, double scale) {
  for (double* length_or_force : {&options.link, &options.speed, &options.feeding, &options.stretching,
                                  &options.tip_length, &options.steering, &options.look_ahead, &options.most_force,
                                  &options.near.radius, &options.near.margin, &options.rod.contact.tolerance}) {
    *length_or_force *= scale;
  }
  options.mass /= scale;
  options.bending *= scale * scale * scale;
  options.twisting *= scale * scale * scale;
  return options;
}

RodCatheter::RodCatheter(dsw_scene* scene, const Route* route, const RodCatheterOptions& options)
    : scene_(scene), route_(route), options_(options) {
  const Vector3 inlet = route->at(0);
  const Positions line = {towards(inlet, route->at(options.link), options.link), inlet};
  direction_ = (line[0] - line[1]) / options.link;
  create(line);
  rod_.emplace(line, std::vector<RodEdge>{edge_at(0)});
  rod_->options = options.rod;
  rod_->held = {1, 1};
  rod_->held_turn = {1};
}

RodEdge RodCatheter::edge_at(std::size_t edge) const {
  const double from_tip = (static_cast<double>(edge) + 0.5) * options_.link;
  const double share = from_tip < options_.tip_length ? from_tip / options_.tip_length : 1;
  const double softness = options_.tip_softness + share * (1 - options_.tip_softness);
  RodEdge made;
  made.length = options_.link;
  made.mass = options_.mass * options_.link;
  made.stretching = options_.stretching;
  made.bending = softness * options_.bending;
  made.twisting = softness * options_.twisting;
  made.radius = options_.near.radius;
  return made;
}

void RodCatheter::create(const Positions& line) {
  const std::uint32_t edges[] = {0, 1};
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = options_.level;
  desc.positions = line.front().data();
  desc.stride_bytes = sizeof(Vector3);
  desc.vertex_count = line.size();
  desc.edges = edges;
  desc.edge_count = 1;
  check(dsw_body_create(scene_, &desc, &id_), "creating a body");
  volumes_.assign(line.size(), dsw_volume_id{0, 0});
}

// Where the new edge would not be free the hand goes on for now.
void RodCatheter::feed() {
  const bool has_more = options_.links == 0 || links() < options_.links;
  if (!has_more || pushed_ < options_.link) {
    return;
  }
  const std::size_t last = rod_->size() - 1;
  const Vector3 at = towards(rod_->shape.position[last], route_->at(pushed_ - options_.link), options_.link);
  dsw_body_vertex_id vertex, end;
  dsw_body_edge_id edge;
  check(dsw_body_get_vertex_id(scene_, id_, static_cast<std::uint32_t>(last), &end), "reading a vertex");
  if (dsw_body_add_vertex(scene_, id_, at.data(), volumes_[last], &vertex) != DSW_STATUS_OK) {
    return;
  }
  const dsw_status status = dsw_body_add_edge(scene_, id_, vertex, end, &edge);
  if (status == DSW_STATUS_OCCUPIED) {
    check(dsw_body_remove_vertex(scene_, id_, vertex), "removing a vertex");
    return;
  }
  check(status, "adding an edge");
  rod_->add_vertex(at, edge_at(links()));
  volumes_.push_back(dsw_volume_id{0, 0});
  const double bent = (static_cast<double>(last) - 0.5) * options_.link;  // where the bend of the vertex begins
  if (bent < options_.tip_length) {
    rod_->rest_curvature[last].x() = options_.tip_angle * options_.link / options_.tip_length;
  }
  rod_->held[last + 1] = 1;
  rod_->held[last - 1] = 0;
  rod_->held_turn[last] = 1;
  rod_->held_turn[last - 1] = 0;
  pushed_ -= options_.link;
}

// The hand feels how hard it pushes. From half of its force on it goes slower, then back. It takes its two vertices to
// where they should be, but not faster than so many times its own speed.
void RodCatheter::lead(double dt) {
  const bool all_in = options_.links > 0 && links() >= options_.links;
  const double speed = options_.feeding > 0 && !all_in ? options_.feeding : options_.speed;
  const bool is_there = all_in && reached() + options_.link >= route_->length();
  const std::size_t tail = rod_->size() - 1, before = tail - 1;
  const double push = links() > 1 ? -rod_->tension(before - 1) : 0;
  const double wanted = is_there ? 0 : speed * std::clamp(2 - 2 * push / options_.most_force, -1.0, 1.0);
  speed_ += std::min(1.0, dt / kReaction) * (wanted - speed_);
  pushed_ = std::max(0.0, pushed_ + speed_ * dt);
  // A route is a polyline. The hand turns into its direction while it goes on by a link, not at once.
  const Vector3 at = route_->at(pushed_);
  const Vector3 ahead = (route_->at(pushed_ + options_.link) - at).normalized();
  direction_ = (direction_ + std::min(1.0, std::abs(speed_) * dt / options_.link) * (ahead - direction_)).normalized();
  const Vector3 ways[] = {at + options_.link * direction_ - rod_->shape.position[before],
                          at - rod_->shape.position[tail]};
  const double slowest = std::max(dt, std::max(ways[0].norm(), ways[1].norm()) / (kFastestHand * speed));
  rod_->velocity[before] = ways[0] / slowest;
  rod_->velocity[tail] = ways[1] / slowest;
  rod_->spin.back() = options_.turning;
}

void RodCatheter::step(double dt) {
  feed();
  lead(dt);
  const Vector3& tip = rod_->shape.position.front();
  const Vector3 ahead = route_->at(reached() + options_.look_ahead) - tip;
  std::fill(rod_->load.begin(), rod_->load.end(), Vector3::Zero());
  rod_->load.front() = options_.steering * ahead / std::max(ahead.norm(), options_.look_ahead);
  const auto start = Clock::now();
  find_near_rows(scene_, id_, options_.near, &rows_);
  const auto found = Clock::now();
  contact_report_ = rod_->step(dt, rows_);
  rows_seconds_ = std::chrono::duration<double>(found - start).count();
  rod_seconds_ = std::chrono::duration<double>(Clock::now() - found).count();
  move(dt);
}

// What the library refuses is no number, or too far away: the rod stays where it is, at rest.
void RodCatheter::move(double dt) {
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  options.vertex_response = DSW_RESPONSE_SLIDE;
  options.edge_response = DSW_RESPONSE_SLIDE;
  options.flags = DSW_MOVE_KEEP_WALLS;
  Positions positions = rod_->targets();
  report_ = StepReport();
  const auto start = Clock::now();
  report_.status =
      dsw_body_move(scene_, id_, positions.front().data(), positions.size(), sizeof(Vector3), &options, &report_.move);
  report_.library_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (report_.status == DSW_STATUS_NON_FINITE) {
    report_.message = dsw_last_error_message();
    report_.was_finite = false;
    rod_->rest();
    return;
  }
  check(report_.status, "moving a body");
  std::size_t count = 0;
  check(dsw_body_get_positions(scene_, id_, positions.front().data(), positions.size(), sizeof(Vector3),
                               volumes_.data(), &count),
        "reading positions");
  rod_->accept(positions, dt);
}

}  // namespace physics
