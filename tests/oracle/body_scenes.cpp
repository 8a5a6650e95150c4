#include "body_scenes.h"

#include <algorithm>
#include <cmath>

namespace dsw::oracle {
namespace {

/// n triangles round vertex 0; closed: the last is joined to the first.
void add_fan(BodyPlan& plan, uint32_t n, bool closed) {
  const uint32_t rim = closed ? n : n + 1;
  plan.at.resize(rim + 1);
  for (uint32_t i = 0; i < n; ++i) plan.faces.push_back({0, 1 + i, 1 + (i + 1) % rim});
}

}  // namespace

/// Lattice scenes: coordinates that are exactly on the planes of many faces.
Vec Bodies::on_lattice(Vec p) {
  if (!arena_.lattice()) return p;
  const double step = std::ldexp(1, std::ilogb(arena_.size()) - 5);
  for (double& x : p) x = std::isfinite(x / step) ? step * std::round(x / step) : x;
  return p;
}

/// Vertices without a place, edges and faces.
void Bodies::shape(BodyPlan& plan) {
  const int most = arena_.dimension == 2 ? 12 : 6;
  const auto chain = [&](uint32_t n) {
    plan.at.resize(n);
    for (uint32_t i = 0; i + 1 < n; ++i) plan.edges.push_back({i, i + 1});
  };
  const uint32_t kind = arena_.dimension == 2                           ? 5 + rng_.below(6)
                        : level_ != DSW_LEVEL_FACES || rng_.chance(0.2) ? rng_.below(11)
                                                                        : rng_.below(rng_.chance(0.4) ? 1 : 5);
  switch (kind) {
    case 0:
      return add_fan(plan, 1, false);
    case 1:
      return add_fan(plan, static_cast<uint32_t>(rng_.between(2, 3)), false);
    case 2:
      return add_fan(plan, static_cast<uint32_t>(rng_.between(3, 4)), true);
    case 3:  // a tetrahedron's surface, or an octahedron's
      add_fan(plan, rng_.chance(0.7) ? 3 : 4, true);
      if (plan.faces.size() == 3) {
        plan.faces.push_back({3, 2, 1});
      } else {
        plan.at.resize(6);
        for (uint32_t i = 0; i < 4; ++i) plan.faces.push_back({5, 1 + (i + 1) % 4, 1 + i});
      }
      return;
    case 4:  // a strip of two four-cornered faces, and a tail
      plan.at.resize(7);
      plan.faces = {{0, 1, 2, 3}, {3, 2, 4, 5}};
      plan.edges.push_back({6, rng_.below(6u)});
      if (rng_.chance(0.5)) plan.edges.push_back({1, 2});
      return;
    case 5:
    case 6:
      return chain(2);
    case 7:
      return chain(static_cast<uint32_t>(rng_.between(3, most)));
    case 8:  // a star, or a ring
      if (rng_.chance(0.5)) {
        chain(static_cast<uint32_t>(rng_.between(3, most - 2)));
        plan.edges.push_back({static_cast<uint32_t>(plan.at.size()) - 1, 0});
        return;
      }
      plan.at.resize(static_cast<size_t>(rng_.between(4, most)));
      for (uint32_t i = 1; i < plan.at.size(); ++i) plan.edges.push_back({0, i});
      return;
    case 9:  // two pieces
      chain(3);
      plan.at.resize(5);
      plan.edges.push_back({4, 3});
      return;
    default:
      plan.at.resize(rng_.chance(0.5) ? 1 : 2);
      return;
  }
}

Vec Bodies::place(const BodyPlan& plan, size_t vertex, double scale) {
  if (has_focus_ && rng_.chance(0.7))
    return rng_.chance(0.5) ? on_lattice(places_.near(focus_, scale)) : places_.near(focus_, scale);
  if (vertex == 0) return places_.start();
  const Vec& other = plan.at[rng_.below(vertex)];
  Vec p = places_.near(other, scale);
  switch (rng_.below(8)) {
    case 0:  // along an axis
      p = places_.along_axis(other, scale);
      break;
    case 1:
      return places_.site();
    case 2:
      return rng_.chance(0.3) ? other : places_.target(other);
    case 3: {  // in a row
      if (vertex < 2) break;
      static const double by[] = {-1, 0.5, 2};
      return between(plan.at[vertex - 2], plan.at[vertex - 1], by[rng_.below(3)]);
    }
    default:
      break;
  }
  return rng_.chance(0.5) ? on_lattice(p) : p;
}

BodyPlan Bodies::next() {
  BodyPlan plan;
  shape(plan);
  const std::vector<std::array<uint32_t, 2>> edges = state_of(plan).edges;
  static const double scales[] = {0.02, 0.05, 0.1, 0.3};
  double scale = scales[rng_.below(4)];
  const int most = rng_.chance(0.1) ? 1 : 12;  // some may be refused
  // Round what its inside is to meet.
  has_focus_ = level_ > DSW_LEVEL_EDGES && rng_.chance(0.6);
  if (has_focus_) focus_ = places_.obstacle(level_ == DSW_LEVEL_FACES ? 0.8 : 0.2);
  for (size_t v = 0; v < plan.at.size(); ++v) {
    for (int tries = 0; tries < most; ++tries) {
      plan.at[v] = place(plan, v, scale);
      if (!finite(plan.at[v])) plan.at[v] = places_.start();
      if (!arena_.passable(arena_.locate(plan.at[v]))) continue;
      const bool free = std::none_of(edges.begin(), edges.end(), [&](const auto& e) {
        return std::max(e[0], e[1]) == v && arena_.exact.blocked(plan.at[e[0]], plan.at[e[1]]);
      });
      if (free) break;
      scale *= 0.7;
    }
  }
  return plan;
}

/// So that the obstacle comes to lie inside of what an edge or a face of the vertex sweeps, and the rest is free if
/// possible.
Vec Bodies::round_obstacle(const BodyState& s, size_t vertex) {
  const VertexMove all = s.flight(vertex, s.at[vertex]);
  Vec best = places_.target(s.at[vertex]);
  if (all.fixed.empty()) return best;
  const bool face = !all.faces.empty() && level_ == DSW_LEVEL_FACES && rng_.chance(0.8);
  const auto close = [&]() {
    if (has_focus_ && rng_.chance(0.6)) return focus_;
    Vec chosen = s.at[vertex];
    double nearest = HUGE_VAL;
    for (int i = 0; i < 6; ++i) {
      const Vec site = places_.obstacle(face ? 1 : 0.3);
      double far = 0;
      for (size_t k = 0; k < 3; ++k) far = std::max(far, std::fabs(site[k] - all.from[k]));
      if (far < nearest) {
        nearest = far;
        chosen = site;
      }
    }
    return chosen;
  };
  Vec site = close();
  for (int tries = 0; tries < (face ? 40 : 24); ++tries) {
    const auto pair =
        face ? all.faces[rng_.below(all.faces.size())] : std::array<size_t, 2>{rng_.below(all.fixed.size()), 0};
    const double w[4] = {rng_.range(0.05, 1), rng_.range(0.2, 1.5), rng_.range(0.05, 1),
                         face ? rng_.range(0.05, 1) : 0};
    const double sum = w[0] + w[1] + w[2] + w[3];
    VertexMove move = all;
    for (size_t k = 0; k < 3; ++k) {
      move.to[k] =
          (sum * site[k] - w[0] * all.from[k] - w[2] * all.fixed[pair[0]][k] - w[3] * all.fixed[pair[1]][k]) / w[1];
    }
    if (rng_.chance(0.5)) move.to = on_lattice(move.to);
    if (!finite(move.to)) continue;
    best = move.to;
    const MoveTruth truth = arena_.exact.move(move, level_);
    if (face ? !truth.events.empty() && truth.events[0].face >= 0 : truth.inside_only()) break;
    if (tries % 4 == 3) site = close();
  }
  return best;
}

Vec Bodies::target(const BodyState& s, size_t vertex) {
  static const double steps[] = {1e-6, 0.01, 0.1, 0.3};
  static const double along[] = {-2, -1, -0.5, 0.25, 0.5, 1, 1.5, 2};
  const Vec& from = s.at[vertex];
  const uint32_t kind = rng_.below(20);
  Vec to = places_.target(from);
  if (kind < 1) return from;
  if (kind < 3) {  // along an edge, or as if there were one
    const VertexMove all = s.flight(vertex, from);
    const Vec& other = all.fixed.empty() ? s.at[rng_.below(s.at.size())] : all.fixed[rng_.below(all.fixed.size())];
    to = between(from, other, along[rng_.below(8)]);
  } else if (kind < 4) {  // a million cells
    to = places_.near(from, 1e6);
    if (rng_.chance(0.5)) to = {to[0], from[1], from[2]};
  } else if (kind < 8) {
    to = places_.near(from, steps[rng_.below(4)]);
    if (rng_.chance(0.5)) to = on_lattice(to);
  } else if (kind < 16) {
    if (level_ > DSW_LEVEL_EDGES) return round_obstacle(s, vertex);
    if (rng_.chance(0.5)) to = on_lattice(to);
  }
  return finite(to) ? to : from;
}

BodyMove Bodies::move(const BodyState& s) {
  BodyMove move;
  for (uint32_t v = 0; v < s.at.size(); ++v) {
    if (s.vertices[v].generation != 0) move.order.push_back(v);
  }
  for (size_t i = move.order.size(); i > 1; --i) std::swap(move.order[i - 1], move.order[rng_.below(i)]);
  const bool together = rng_.chance(0.5);
  if (rng_.chance(0.7)) move.order.resize(1);
  move.targets = s.at;
  const size_t leader = move.order[0];
  const Vec to = target(s, leader);
  for (uint32_t v : move.order) {
    if (v == leader || !together) {
      move.targets[v] = v == leader ? to : target(s, v);
      continue;
    }
    for (size_t k = 0; k < 3; ++k) move.targets[v][k] += to[k] - s.at[leader][k];
    if (!finite(move.targets[v])) move.targets[v] = s.at[v];
  }
  return move;
}

}  // namespace dsw::oracle
