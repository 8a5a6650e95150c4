#include "physics_wire.h"

#include "verify.h"

#include <algorithm>

namespace dsw::bench {

namespace {

constexpr double kMass = 1.6, kStretching = 2e9, kBending = 5e6, kTwisting = 4e6;  // mg/mm, uN, uN mm^2
constexpr double kSpeed = 10;                                                      // mm/s, of the hand
constexpr std::size_t kStroke = 500;                                               // steps in, then as many back

}  // namespace

PhysicsWire::PhysicsWire(const VesselCase& vessel, std::size_t edges, double length, double radius, double thickness)
    : radius_(radius) {
  near_.radius = thickness - radius;  // beside that of the body
  near_.margin = 0.1;
  dsw_scene_desc scene_desc;
  dsw_scene_desc_init(&scene_desc, sizeof scene_desc);
  scene_desc.features = DSW_FEATURE_DEFORMING;
  dsw_scene* scene = nullptr;
  check(dsw_scene_create(vessel.world.environment(), &scene_desc, &scene));
  scene_.reset(scene);

  // The tip comes first.
  const double link = std::min(length, 0.9 * vessel.line.length()) / static_cast<double>(edges);
  for (std::size_t i = edges + 1; i-- > 0;) {
    const std::array<double, 3> at = vessel.line.point(link * (static_cast<double>(i) + 1));
    positions_.emplace_back(at[0], at[1], at[2]);
  }
  std::vector<std::uint32_t> ends;
  std::vector<physics::RodEdge> made;
  for (std::uint32_t i = 0; i < edges; ++i) {
    ends.insert(ends.end(), {i, i + 1});
    const double size = (positions_[i + 1] - positions_[i]).norm();
    made.push_back({size, kMass * size, kStretching, kBending, kTwisting, thickness});
  }
  along_ = (positions_[edges - 1] - positions_[edges]).normalized();
  rod_.emplace(positions_, made);
  rod_->options.drag = 20;
  rod_->options.contact.tolerance = 1e-4;
  rod_->held.assign(edges + 1, 0);
  rod_->held[edges] = rod_->held[edges - 1] = 1;

  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = DSW_LEVEL_EDGES_SWEPT;
  desc.positions = positions_.front().data();
  desc.stride_bytes = sizeof(physics::Vector3);
  desc.vertex_count = positions_.size();
  desc.edges = ends.data();
  desc.edge_count = edges;
  desc.radius = radius;
  check(dsw_body_create(scene, &desc, &body_));
}

void PhysicsWire::solve(std::size_t step, double dt) {
  const double speed = step % (2 * kStroke) < kStroke ? kSpeed : -kSpeed;
  for (const std::size_t v : {rod_->size() - 1, rod_->size() - 2}) rod_->velocity[v] = speed * along_;
  rows_pressing_ = rod_->step(dt, rows_).pressing;
}

void PhysicsWire::deform(std::vector<double>& next) {
  dsw_scene_deform_options options;
  dsw_scene_deform_options_init(&options, sizeof options);
  options.stop = DSW_TOGETHER_STOP_FEATURE;
  options.response = DSW_TOGETHER_RESPONSE_SLIDE;
  dsw_deform_report report;
  dsw_move_report move;
  const physics::Positions& targets = rod_->targets();
  check(dsw_scene_deform(scene_.get(), next.data(), next.size() / 3, &body_, 1, targets.front().data(), targets.size(),
                         sizeof(physics::Vector3), &options, &report, &move));
  outcome_ = report.outcome;
  contacts_ = move.contact_count;
}

void PhysicsWire::accept(double dt) {
  std::size_t count = 0;
  check(dsw_body_get_positions(scene_.get(), body_, positions_.front().data(), positions_.size(),
                               sizeof(physics::Vector3), nullptr, &count));
  rod_->accept(positions_, dt);
}

bool PhysicsWire::is_free() {
  constexpr double kRoom = 1e-9;  // of the radius: what distances are certified to
  if (!physics::verify(scene_.get(), body_).good()) return false;
  if (radius_ == 0) return true;
  // Near rows would be remembered: the next step would find them sooner, and its rows would go on from these.
  double gap = 0;
  physics::check(dsw_body_find_least_gap(scene_.get(), body_, 0, &gap), "reading a gap");
  return gap >= -kRoom * radius_;
}

}  // namespace dsw::bench
