#include "plane_arena.h"

#include "plane_shift.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dsw::oracle {
namespace {

constexpr double kNormal = 1e-14;  // how far the normal of a side, two differences and their norm, may be off

double size_of(const std::vector<plane::Vec>& points) {
  plane::Vec low = points[0], high = low;
  for (const plane::Vec& p : points) {
    for (size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  return std::max(high[0] - low[0], high[1] - low[1]);
}

}  // namespace

PlaneArena::PlaneArena(const plane::World& world, const std::vector<int>& marked_vertices)
    : Arena(2, std::make_unique<PlaneSweeps>(world, marked_vertices)),
      world_(world),
      obstacles_(static_cast<PlaneSweeps&>(exact).obstacles()),
      size_(size_of(world.points)) {
  for (const auto& cell : world.cells) {
    ids_.push_back({static_cast<uint32_t>(ids_.size()), 1});
    sides_of_.emplace_back(cell.size());
  }
  for (size_t s = 0; s < world.sides.size(); ++s) {
    const plane::Side& side = world.sides[s];
    for (size_t end = 0; end < 2; ++end) {
      if (side.cell[end] < 0) continue;
      sides_of_[static_cast<size_t>(side.cell[end])][static_cast<size_t>(side.local[end])] = static_cast<int>(s);
    }
  }
}

Arena::Wall PlaneArena::wall(int face) const {
  const plane::Side& side = world_.sides[static_cast<size_t>(face)];
  return {{side.cell[0], side.cell[1]}, side.marked};
}

bool PlaneArena::normal_fits(const SweepEvent& event, const double* normal) const {
  const plane::Side& side = world_.sides[static_cast<size_t>(event.triangle)];
  const plane::Vec &a = world_.points[static_cast<size_t>(side.a)], &b = world_.points[static_cast<size_t>(side.b)];
  // Halves do not overflow, and powers of two round nothing.
  double x = b[0] / 2 - a[0] / 2, y = b[1] / 2 - a[1] / 2;
  if (std::fmax(std::fabs(x), std::fabs(y)) < 0x1p-500) x = b[0] - a[0], y = b[1] - a[1];
  const int scale = -std::ilogb(std::fmax(std::fabs(x), std::fabs(y)));
  x = std::ldexp(x, scale), y = std::ldexp(y, scale);
  const double out = event.side > 0 ? -1 : 1, length = std::hypot(x, y);
  return std::fabs(normal[0] - out * y / length) <= kNormal && std::fabs(normal[1] + out * x / length) <= kNormal &&
         normal[2] == 0;
}

std::vector<int> PlaneArena::faces_round(const SweepEvent& event) const {
  std::vector<int> around;
  for (size_t s = 0; s < world_.sides.size(); ++s) {
    if (world_.sides[s].a == event.vertex || world_.sides[s].b == event.vertex) around.push_back(static_cast<int>(s));
  }
  return around;
}

std::array<Vec, 2> PlaneArena::ends_of(const SweepEvent& event) const {
  const Vec at = raised(world_.points[static_cast<size_t>(event.vertex)]);
  return {at, at};
}

std::string PlaneArena::wrong_name(const SweepEvent& event, const dsw_sweep& got) const {
  const bool right = got.contact.kind == DSW_CONTACT_VERTEX && got.contact.obstacle.kind == DSW_CELL_VERTEX &&
                     got.contact.obstacle.index == static_cast<uint32_t>(event.vertex) &&
                     got.contact.obstacle.generation == 1 && got.contact.obstacle.local == 0;
  return right ? "" : " kind " + std::to_string(got.contact.kind) + " " + name(got.contact.obstacle) + " at a vertex";
}

std::string PlaneArena::second_normal(const Sweep& s) {
  const SweepTruth& t = s.truth;
  const plane::Flight flight = plane::cast(world_, t.start, flat(s.from), flat(s.to));
  const bool fits = t.path_hit == (flight.outcome == plane::Flight::kContact) && t.path.size() <= 1 &&
                    (!t.path_hit || (flight.side == t.path[0].triangle && flight.time == t.path[0].time));
  return fits ? differs_by_small_shift(world_, obstacles_, s) : " the path is not that of the oracle's cast";
}

PlanePlaces::PlanePlaces(const plane::World& world, const Arena& arena, const std::vector<int>& marked_vertices,
                         Rng& rng)
    : Places(2, arena.size(), rng), world_(world) {
  std::set<int> ends(marked_vertices.begin(), marked_vertices.end());
  for (size_t s = 0; s < world.sides.size(); ++s) {
    const plane::Side& side = world.sides[s];
    if (world.impassable(side)) impassable_.push_back(static_cast<int>(s));
    if (!side.marked || side.cell[1] < 0) continue;
    free_standing_.push_back(static_cast<int>(s));
    ends.insert({side.a, side.b});
  }
  for (const plane::Side& side : world.sides) {
    if (side.cell[1] >= 0 && !arena.marked(side.cell[0]) && !arena.marked(side.cell[1])) continue;
    ends.erase(side.a);
    ends.erase(side.b);
  }
  spikes_.assign(ends.begin(), ends.end());
}

std::array<Vec, 2> PlanePlaces::ends_of(int side) const {
  const plane::Side& s = world_.sides[static_cast<size_t>(side)];
  return {point(s.a), point(s.b)};
}

std::array<Vec, 2> PlanePlaces::ends() {
  if (rng_.chance(0.5)) return ends_of(static_cast<int>(rng_.below(world_.sides.size())));
  const auto& cell = world_.cells[rng_.below(world_.cells.size())];
  return {point(cell[0]), point(cell[1 + rng_.below(cell.size() - 1)])};
}

Vec PlanePlaces::site() {
  const auto [a, b] = ends_of(static_cast<int>(rng_.below(world_.sides.size())));
  switch (rng_.below(8)) {
    case 0:
      return a;
    case 1:
    case 2:
      return between(a, b, 0.25 * rng_.below(5));
    case 3: {
      const auto [c, d] = ends();
      return between(c, d, 0.5);
    }
    case 4: {
      Vec p = a;
      for (size_t k = 0; k < 2; ++k) {
        if (rng_.chance(0.5)) p[k] = std::nextafter(p[k], rng_.chance(0.5) ? HUGE_VAL : -HUGE_VAL);
      }
      return p;
    }
    default: {
      Vec p = between(a, vertex(), rng_.unit());
      if (rng_.chance(0.3)) p[1] = b[1];
      return p;
    }
  }
}

Vec PlanePlaces::start() {
  if (rng_.chance(0.4)) return site();
  // Among the vertices of one cell: inside it as a rule.
  const auto& cell = world_.cells[rng_.below(world_.cells.size())];
  Vec p = point(cell[rng_.below(cell.size())]);
  for (int i = 0; i < 4; ++i) p = between(p, point(cell[rng_.below(cell.size())]), rng_.unit());
  return p;
}

/// A lone vertex, or a place on a marked side.
Vec PlanePlaces::obstacle(double exactly) {
  if (!spikes_.empty() && rng_.chance(std::max(exactly, 0.7))) return point(spikes_[rng_.below(spikes_.size())]);
  if (free_standing_.empty()) return site();
  const auto [a, b] = ends_of(free_standing_[rng_.below(free_standing_.size())]);
  return between(a, b, rng_.chance(0.3) ? 0 : rng_.range(0.01, 0.3));
}

bool PlanePlaces::round_obstacle(Vec& place, std::array<Vec, 2>& span) {
  const bool exactly = Places::round_obstacle(place, span);
  place = obstacle(exactly ? 1 : 0.2);
  return exactly;
}

Vec PlanePlaces::anchor() {
  if (!spikes_.empty() && rng_.chance(0.3)) return point(spikes_[rng_.below(spikes_.size())]);
  const auto& list = free_standing_.empty() || rng_.chance(0.3) ? impassable_ : free_standing_;
  const auto [a, b] = ends_of(list[rng_.below(list.size())]);
  return between(a, b, rng_.chance(0.7) ? 0 : 0.25 * rng_.between(0, 4));
}

}  // namespace dsw::oracle
