#include "plane_sweeps.h"

#include <algorithm>
#include <set>

namespace dsw::oracle {

PlaneSweeps::PlaneSweeps(const plane::World& world, const std::vector<int>& marked) : world_(world) {
  std::vector<Vec> raw;
  for (const plane::Vec& p : world.points) raw.push_back(raised(p));
  std::set<int> used(marked.begin(), marked.end());
  for (size_t s = 0; s < world.sides.size(); ++s) {
    const plane::Side& side = world.sides[s];
    if (!world.impassable(side)) continue;
    sides_.push_back({static_cast<int>(s), box_of(raw, {side.a, side.b})});
    used.insert({side.a, side.b});
  }
  obstacles_.assign(used.begin(), used.end());
  take_points(raw, obstacles_);
}

/// Twice that of the triangle, counter-clockwise positive.
Big PlaneSweeps::area(const Point& x, const Point& y, const Point& z) const {
  return (y[0] - x[0]) * (z[1] - x[1]) - (y[1] - x[1]) * (z[0] - x[0]);
}

// With u = b - a and x shifted by s: -u x (x + s - a).
Shifted PlaneSweeps::right_of(int a, int b, size_t x) {
  return shifted(-area(at(a), at(b), body_[x]), {at(b)[1] - at(a)[1], at(a)[0] - at(b)[0], 0});
}
int PlaneSweeps::right_of_sign(int a, int b, size_t x) {
  const Big value = -area(at(a), at(b), body_[x]);
  return sgn(value) != 0 ? sgn(value) : sign_with_ties(value, {at(b)[1] - at(a)[1], at(a)[0] - at(b)[0], 0});
}
// With u = y - x, both shifted by s: u x (a - x - s).
Shifted PlaneSweeps::left_of(size_t x, size_t y, int a) {
  return shifted(area(body_[x], body_[y], at(a)), {body_[y][1] - body_[x][1], body_[x][0] - body_[y][0], 0});
}
int PlaneSweeps::left_of_sign(size_t x, size_t y, int a) {
  const Big value = area(body_[x], body_[y], at(a));
  return sgn(value) != 0 ? sgn(value)
                         : sign_with_ties(value, {body_[y][1] - body_[x][1], body_[x][0] - body_[y][0], 0});
}

/// +1 when x -> y leaves cell[0] of the side, -1 when it enters it, 0 when it misses.
int PlaneSweeps::pierce(size_t x, size_t y, const Side& s) {
  const plane::Side& side = world_.sides[static_cast<size_t>(s.side)];
  const int from = right_of_sign(side.a, side.b, x), to = right_of_sign(side.a, side.b, y);
  if (from == to) return 0;
  return left_of_sign(x, y, side.a) == left_of_sign(x, y, side.b) ? 0 : to;
}

bool PlaneSweeps::any_pierced(size_t x, size_t y) {
  const Box box = body_box({x, y});
  return std::any_of(sides_.begin(), sides_.end(),
                     [&](const Side& s) { return !apart(s.box, box) && pierce(x, y, s) != 0; });
}

void PlaneSweeps::add_path_events(std::vector<SweepEvent>& events) {
  const Box box = body_box({kP, kTo});
  for (const Side& s : sides_) {
    if (apart(s.box, box)) continue;
    SweepEvent e;
    e.side = pierce(kP, kTo, s);
    if (e.side == 0) continue;
    const plane::Side& side = world_.sides[static_cast<size_t>(s.side)];
    // Who comes in from outside has left before.
    if (side.cell[e.side > 0 ? 0 : 1] < 0) continue;
    e.triangle = s.side;
    e.numerator = right_of(side.a, side.b, kP);
    const Shifted after = right_of(side.a, side.b, kTo);
    for (size_t k = 0; k < 4; ++k) e.denominator.c[k] = e.numerator.c[k] - after.c[k];
    add(std::move(e), events);
  }
}

void PlaneSweeps::add_edge_events(size_t number, std::vector<SweepEvent>& events) {
  const size_t q = kQ + number;
  const int turn = sgn(area(body_[kP], body_[kTo], body_[q]));
  if (turn == 0) return;
  const Box box = body_box({kP, kTo, q});
  for (const Vertex& v : vertices_) {
    if (apart(v.box, box) || left_of_sign(kP, kTo, v.vertex) != turn || left_of_sign(kTo, q, v.vertex) != turn ||
        left_of_sign(q, kP, v.vertex) != turn) {
      continue;
    }
    SweepEvent e;
    e.edge = static_cast<int>(number);
    e.vertex = v.vertex;
    // The edge's line passes the vertex at a time that is linear in where its other end is.
    e.numerator = left_of(q, kP, v.vertex);
    const Shifted after = left_of(q, kTo, v.vertex);
    for (size_t k = 0; k < 4; ++k) e.denominator.c[k] = e.numerator.c[k] - after.c[k];
    add(std::move(e), events);
  }
}

}  // namespace dsw::oracle
