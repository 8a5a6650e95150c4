// What is called for bodies.
#include "life.h"

#include "defaults.h"

#include <algorithm>
#include <cmath>

namespace dsw::portable {

using oracle::defaults;

namespace {

constexpr uint32_t kWireVertices = 14, kRingVertices = 8, kClothSide = 3;

double distance(const Vec& a, const Vec& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace

/// Places relative to the first vertex, in units; edges, or corners of triangles.
void Life::add_parts(std::vector<Vec>& at, std::vector<uint32_t>& edges, std::vector<uint32_t>& corners) {
  switch (kind_.bodies.shape) {
    case Shape::kWire: {
      Vec way = some_way(1 / unit());
      for (uint32_t i = 0; i < kWireVertices; ++i) {
        at.push_back({0.3 * i * way[0], 0.3 * i * way[1], 0.3 * i * way[2]});
        if (i != 0) edges.insert(edges.end(), {i - 1, i});
      }
      return;
    }
    case Shape::kRing: {
      static const double circle[kRingVertices][2] = {{0.5, 0},  {0.35, 0.35},   {0, 0.5},  {-0.35, 0.35},
                                                      {-0.5, 0}, {-0.35, -0.35}, {0, -0.5}, {0.35, -0.35}};
      const double tilt = rng_.range(-1, 1);
      for (uint32_t i = 0; i < kRingVertices; ++i) {
        at.push_back({circle[i][0], circle[i][1], dimension() == 3 ? tilt * circle[i][0] : 0});
        edges.insert(edges.end(), {i, (i + 1) % kRingVertices});
      }
      return;
    }
    case Shape::kCloth:
      for (uint32_t i = 0; i < kClothSide * kClothSide; ++i) {
        const uint32_t row = i / kClothSide, column = i % kClothSide;
        at.push_back({0.25 * column, 0.25 * row, rng_.range(-0.05, 0.05)});
        if (row + 1 == kClothSide || column + 1 == kClothSide) continue;
        corners.insert(corners.end(), {i, i + 1, i + kClothSide, i + 1, i + kClothSide + 1, i + kClothSide});
      }
      return;
    default:
      at = {{0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}};
      corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
  }
}

dsw_status Life::create_body() {
  std::vector<Vec> at;
  std::vector<uint32_t> edges, corners;
  add_parts(at, edges, corners);
  dsw_body_desc desc = defaults(dsw_body_desc_init);
  desc.level =
      static_cast<dsw_level>(kind_.bodies.level != 0 ? kind_.bodies.level : rng_.between(1, dimension() == 3 ? 4 : 3));
  desc.flags = kind_.bodies.flags;
  if (kind_.bodies.level == 0) desc.flags |= rng_.below(8);  // lossless
  desc.vertex_count = at.size();
  desc.edges = edges.data();
  desc.edge_count = edges.size() / 2;
  std::vector<uint32_t> offsets;
  for (uint32_t i = 0; i <= corners.size(); i += 3) offsets.push_back(i);
  desc.face_offsets = offsets.data();
  desc.face_corners = corners.data();
  desc.face_count = corners.size() / 3;
  desc.face_corner_count = corners.size();
  desc.radius = kind_.bodies.radius * unit();
  dsw_status status = DSW_STATUS_OK;
  double scale = unit();
  for (int tries = 0; tries < 8; ++tries, scale *= 0.7) {
    const Vec origin = places_.start();
    std::vector<double> positions;
    for (const Vec& p : at)
      append(positions, {origin[0] + scale * p[0], origin[1] + scale * p[1], origin[2] + scale * p[2]});
    desc.positions = positions.data();
    dsw_body_id body;
    status = dsw_body_create(scene(), &desc, &body);
    if (status != DSW_STATUS_OK) continue;
    movers_.push_back({body, some_way(0.15)});
    break;
  }
  return status;
}

dsw_status Life::destroy_body() {
  if (movers_.empty()) return create_body();
  const size_t i = rng_.below(movers_.size());
  const dsw_body_id body = movers_[i].body;
  movers_.erase(movers_.begin() + static_cast<std::ptrdiff_t>(i));
  return dsw_body_destroy(scene(), body);
}

Life::Mover* Life::some_mover() {
  // What the calls of others destroyed is forgotten.
  movers_.erase(std::remove_if(movers_.begin(), movers_.end(),
                               [&](const Mover& each) {
                                 dsw_level level;
                                 return dsw_body_get_level(scene(), each.body, &level) != DSW_STATUS_OK;
                               }),
                movers_.end());
  return movers_.empty() ? nullptr : &movers_[rng_.below(movers_.size())];
}

/// The body drifts; a wire is pulled at its first vertex, and the others follow. Now and then a vertex jumps.
std::vector<double> Life::targets_of(Mover& mover) {
  dsw_body_counts counts;
  counts.struct_size = sizeof counts;
  dsw_body_get_counts(scene(), mover.body, &counts);
  std::vector<double> targets(dimension() * counts.vertex_slots);
  size_t count = 0;
  dsw_body_get_positions(scene(), mover.body, targets.data(), counts.vertex_slots, 0, nullptr, &count);
  if (rng_.chance(0.08)) mover.velocity = some_way(0.25);
  const bool pulled = kind_.bodies.shape == Shape::kWire, wobbles = rng_.chance(0.3);
  Vec before = {0, 0, 0};
  for (size_t v = 0; v < count; ++v) {
    Vec p = {0, 0, 0};
    std::copy_n(&targets[dimension() * v], dimension(), p.begin());
    Vec way = mover.velocity;
    if (pulled && v != 0) {
      const double far = distance(before, p), rest = 0.3 * unit();
      const double share = far > rest ? (far - rest) / far : 0;
      for (size_t k = 0; k < 3; ++k) way[k] = share * (before[k] - p[k]);
    }
    if (wobbles) {
      const Vec by = some_way(0.05);
      for (size_t k = 0; k < 3; ++k) way[k] += by[k];
    }
    before = p;
    for (size_t k = 0; k < dimension(); ++k) targets[dimension() * v + k] = p[k] + way[k];
  }
  if (rng_.chance(0.1) && count != 0) {
    const Vec to = places_.target(before);
    std::copy_n(to.begin(), dimension(), &targets[dimension() * rng_.below(count)]);
  }
  return targets;
}

dsw_move_options Life::move_options() {
  dsw_move_options options = defaults(dsw_move_options_init);
  options.vertex_response = rng_.chance(0.5) ? DSW_RESPONSE_STOP : DSW_RESPONSE_SLIDE;
  options.edge_response = static_cast<dsw_response>(rng_.below(6));
  options.search = static_cast<dsw_search>(rng_.below(3));
  options.bisection_depth = rng_.below(30);
  options.flags = rng_.chance(0.3) ? uint32_t{DSW_MOVE_KEEP_WALLS} : 0;
  options.passes = rng_.below(3);
  options.max_volumes = rng_.chance(0.05) ? 1 + rng_.below(20) : 0;
  options.min_length = 0.05 * unit();
  options.noise_share = 0.05;
  return options;
}

dsw_status Life::move_body() {
  Mover* const mover = some_mover();
  if (mover == nullptr) return create_body();
  const std::vector<double> targets = targets_of(*mover);
  const dsw_move_options options = move_options();
  if (targets.size() / dimension() > 3 * kWireVertices) return destroy_body();  // too much has been inserted
  return dsw_body_move(scene(), mover->body, targets.data(), targets.size() / dimension(), 0, &options, nullptr);
}

std::vector<dsw_body_id> Life::all_movers(std::vector<double>& targets) {
  std::vector<dsw_body_id> bodies;
  for (Mover& each : movers_) {
    const std::vector<double> own = targets_of(each);
    bodies.push_back(each.body);
    targets.insert(targets.end(), own.begin(), own.end());
  }
  return bodies;
}

dsw_status Life::move_together() {
  if (some_mover() == nullptr) return create_body();
  std::vector<double> targets;
  const std::vector<dsw_body_id> bodies = all_movers(targets);
  dsw_together_options options = defaults(dsw_together_options_init);
  options.stop = static_cast<dsw_together_stop>(rng_.below(3));
  options.max_rounds = rng_.below(6);
  if (options.stop == DSW_TOGETHER_STOP_FEATURE) options.response = static_cast<dsw_together_response>(rng_.below(3));
  return dsw_scene_move_together(scene(), bodies.data(), bodies.size(), targets.data(), targets.size() / dimension(), 0,
                                 &options, nullptr);
}

dsw_status Life::move_bodies() {
  if (some_mover() == nullptr) return create_body();
  std::vector<double> targets;
  const std::vector<dsw_body_id> bodies = all_movers(targets);
  const dsw_move_options options = move_options();
  return dsw_scene_move_bodies(scene(), bodies.data(), bodies.size(), targets.data(), targets.size() / dimension(), 0,
                               &options, nullptr);
}

dsw_status Life::move_rigidly() {
  Mover* const mover = some_mover();
  if (mover == nullptr) return create_body();
  if (rng_.chance(0.1)) mover->velocity = some_way(0.3);
  std::vector<double> at = targets_of(*mover);
  dsw_rigid_motion motion = {{0, 0, 0, 1}, {0, 0, 0}, {0, 0, 0}};
  for (size_t k = 0; k < 3; ++k) motion.rotation[k] = dimension() == 3 || k == 2 ? rng_.range(-0.1, 0.1) : 0;
  std::copy_n(at.begin(), dimension(), motion.centre);
  std::copy_n(mover->velocity.begin(), dimension(), motion.translation);
  const dsw_move_options options = defaults(dsw_move_options_init);
  return dsw_body_move_rigid(scene(), mover->body, &motion, &options, nullptr);
}

dsw_status Life::change_radius() {
  Mover* const mover = some_mover();
  if (mover == nullptr) return create_body();
  return dsw_body_set_radius(scene(), mover->body, rng_.range(0, 2) * kind_.bodies.radius * unit());
}

}  // namespace dsw::portable
