#include "rope.h"

#include "timing.h"

#include "scenes/random.h"

#include <algorithm>
#include <cmath>

namespace dsw::bench {

namespace {

constexpr double kSize = 10;  // of the lattice

scenes::HexGrid make_space() {
  scenes::HexGridOptions options;
  options.size = scenes::hex_grid_size(1000);
  options.obstacle_share = 0;
  return scenes::make_hex_grid(options);
}

}  // namespace

RopeSpace::RopeSpace() : grid_(make_space()), world_(grid_.mesh, 1) {}

std::vector<std::vector<double>> rope_targets(std::size_t edges, std::size_t steps) {
  const double turns = 0.8 * std::sqrt(static_cast<double>(edges)), gap = 7 / turns, radius = 3;
  const double per_turn = static_cast<double>(edges) / turns, two_pi = 8 * std::atan(1.0);
  scenes::Random random(31);
  std::vector<std::array<double, 3>> phases(edges + 1);
  for (auto& phase : phases) {
    for (double& each : phase) each = random.uniform(0, two_pi);
  }
  std::vector<std::vector<double>> targets;
  for (std::size_t step = 0; step <= steps; ++step) {
    const double time = static_cast<double>(step), height = gap * std::min(1.0, time / 20);
    std::vector<double> at;
    for (std::size_t i = 0; i <= edges; ++i) {
      const auto wobble = [&](std::size_t k) { return 0.7 * height * std::sin(0.1 * time + phases[i][k]); };
      const double angle = two_pi * static_cast<double>(i) / per_turn;
      at.push_back(kSize / 2 + (radius + wobble(0)) * std::cos(angle) + 0.1 * wobble(1));
      at.push_back(kSize / 2 + (radius + wobble(0)) * std::sin(angle));
      at.push_back(1.5 + gap * static_cast<double>(i) / per_turn + wobble(2));
    }
    targets.push_back(std::move(at));
  }
  return targets;
}

Rope::Rope(dsw_environment* environment, const std::vector<double>& at, bool meets_itself) : at_(at) {
  dsw_scene_desc scene_desc;
  dsw_scene_desc_init(&scene_desc, sizeof scene_desc);
  scene_desc.features = meets_itself ? DSW_FEATURE_BODY_CONTACTS : 0;
  check(dsw_scene_create(environment, &scene_desc, &scene_));
  std::vector<std::uint32_t> edges;
  for (std::uint32_t i = 0; i + 1 < at.size() / 3; ++i) edges.insert(edges.end(), {i, i + 1});
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = at.data();
  desc.vertex_count = at.size() / 3;
  desc.edges = edges.data();
  desc.edge_count = edges.size() / 2;
  desc.level = DSW_LEVEL_EDGES;
  desc.flags = meets_itself ? DSW_BODY_SELF_CONTACTS : 0;
  check(dsw_body_create(scene_, &desc, &body_));
}

Rope::~Rope() { dsw_scene_destroy(scene_); }

double Rope::move(const std::vector<double>& targets, RopeStep& step) {
  step.before = at_;
  const double ns = cpu_time_ns(
      [&] { check(dsw_body_move(scene_, body_, targets.data(), targets.size() / 3, 0, nullptr, nullptr)); });
  std::size_t count = 0;
  check(dsw_body_get_positions(scene_, body_, at_.data(), at_.size() / 3, 0, nullptr, &count));
  step.after = at_;
  step.stopped.assign(at_.size() / 3, 0);
  const dsw_body_contact* contacts = nullptr;
  check(dsw_body_get_contacts(scene_, body_, &contacts, &count));
  for (std::size_t i = 0; i < count; ++i) step.stopped[contacts[i].vertex.index] = 1;
  step.contacts = count;
  return ns;
}

}  // namespace dsw::bench
