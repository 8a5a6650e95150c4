#include "plane_truth.h"

#include <algorithm>

namespace dsw::oracle::plane {
namespace {

/// A value in e: c[0] + c[1] e + c[2] e^2.
struct Shifted {
  Big c[3];

  int sign() const {
    for (const Big& each : c) {
      if (each != 0) return sgn(each);
    }
    return 0;
  }
  bool tie() const { return c[0] == 0; }
};

struct Point {
  Big x, y;
};

/// Coordinates as integers over one power of two that suits all of them.
class Numbers {
 public:
  Numbers(const std::vector<Vec>& points, const Vec& p, const Vec& q) {
    int lowest = 0;
    const auto see = [&](const Vec& v) { lowest = std::min({lowest, lowest_exponent(v[0]), lowest_exponent(v[1])}); };
    for (const Vec& v : points) see(v);
    see(p), see(q);
    const auto to_point = [&](const Vec& v) { return Point{to_big(v[0], -lowest), to_big(v[1], -lowest)}; };
    for (const Vec& v : points) at.push_back(to_point(v));
    from = to_point(p);
    to = to_point(q);
  }
  const Point& operator[](int v) const { return at[static_cast<size_t>(v)]; }

  std::vector<Point> at;
  Point from, to;
};

Big cross(const Big& ax, const Big& ay, const Big& bx, const Big& by) { return ax * by - ay * bx; }

/// Positive if body point x is on the right of a -> b.
Shifted right_of(const Point& a, const Point& b, const Point& x) {
  const Big dx = b.x - a.x, dy = b.y - a.y;
  return {{-cross(dx, dy, x.x - a.x, x.y - a.y), dy, -dx}};
}

/// Positive if a is on the left of the body's way p -> q.
Shifted left_of(const Point& p, const Point& q, const Point& a) {
  const Big ux = q.x - p.x, uy = q.y - p.y;
  return {{cross(ux, uy, a.x - p.x, a.y - p.y), uy, -ux}};
}

/// Whether a ray to the right of the shifted point crosses a side. A point as high as the ray starts lies below it.
bool is_right_of(const World& world, const Side& side, const Vec& p) {
  const Vec &a = world.points[static_cast<size_t>(side.a)], &b = world.points[static_cast<size_t>(side.b)];
  const bool up = b[1] > p[1];
  if ((a[1] > p[1]) == up || std::max(a[0], b[0]) < p[0]) return false;
  if (std::min(a[0], b[0]) > p[0]) return true;
  const Numbers n({a, b}, p, p);
  return (right_of(n[0], n[1], n.from).sign() < 0) == up;
}

struct Hit {
  int side, toward;  // +1: out of cell[0]
  Shifted numerator;
  Big denominator;  // positive

  bool operator<(const Hit& o) const {
    for (int k = 0; k < 3; ++k) {
      const Big one = numerator.c[k] * o.denominator, other = o.numerator.c[k] * denominator;
      if (one != other) return one < other;
    }
    return false;
  }
};

double floor_time(const Hit& hit) {
  const Big& top = hit.numerator.c[0];
  if (top <= 0) return 0;
  return top >= hit.denominator ? 1 : floor_to_double(top, hit.denominator);
}

}  // namespace

bool contains(const World& world, int cell, const Vec& p) {
  bool odd = false;
  for (const Side& side : world.sides) {
    if ((side.cell[0] == cell || side.cell[1] == cell) && is_right_of(world, side, p)) odd = !odd;
  }
  return odd;
}

/// Cells that the ray leaves an odd number of times.
int locate(const World& world, const Vec& p) {
  std::vector<char> odd(world.cells.size(), 0);
  for (const Side& side : world.sides) {
    if (!is_right_of(world, side, p)) continue;
    for (int cell : side.cell) {
      if (cell >= 0) odd[static_cast<size_t>(cell)] ^= 1;
    }
  }
  const auto found = std::find(odd.begin(), odd.end(), 1);
  if (found == odd.end()) return -1;
  return std::find(found + 1, odd.end(), 1) == odd.end() ? static_cast<int>(found - odd.begin()) : -2;
}

Flight cast(const World& world, int start, const Vec& p, const Vec& q) {
  Flight flight;
  flight.cells.push_back(start);
  flight.times.push_back(0);
  if (p == q) return flight;
  const Numbers n(world.points, p, q);
  std::vector<int> left(world.points.size());
  for (size_t v = 0; v < left.size(); ++v) {
    const Shifted value = left_of(n.from, n.to, n.at[v]);
    left[v] = value.sign();
    flight.tie = flight.tie || value.tie();
  }
  std::vector<Hit> hits;
  for (size_t s = 0; s < world.sides.size(); ++s) {
    const Side& side = world.sides[s];
    if (left[static_cast<size_t>(side.a)] == left[static_cast<size_t>(side.b)]) continue;
    const Point &a = n[side.a], &b = n[side.b];
    Shifted before = right_of(a, b, n.from);
    const Shifted after = right_of(a, b, n.to);
    if (before.sign() == after.sign()) continue;
    const int toward = after.sign();
    Hit hit{static_cast<int>(s), toward, {}, (after.c[0] - before.c[0]) * toward};
    for (int k = 0; k < 3; ++k) hit.numerator.c[k] = before.c[k] * -toward;
    hits.push_back(hit);
  }
  std::sort(hits.begin(), hits.end());
  for (const Hit& hit : hits) {
    const Side& side = world.sides[static_cast<size_t>(hit.side)];
    const int out = side.cell[hit.toward > 0 ? 0 : 1], in = side.cell[hit.toward > 0 ? 1 : 0];
    if (out != flight.cells.back()) {
      flight.outcome = Flight::kBroken;
      return flight;
    }
    if (world.impassable(side)) {
      flight.outcome = Flight::kContact;
      flight.side = hit.side;
      flight.time = floor_time(hit);
      return flight;
    }
    flight.cells.push_back(in);
    flight.times.push_back(floor_time(hit));
  }
  return flight;
}

bool is_star_of(const World& world, int cell, const Vec& centre) {
  const Numbers n(world.points, centre, centre);
  const std::vector<int>& loop = world.cells[static_cast<size_t>(cell)];
  if (loop.size() == 3) return right_of(n[loop[0]], n[loop[1]], n[loop[2]]).c[0] < 0;
  int rounds = 0;  // how often the way round crosses the ray to the right
  for (size_t i = 0; i < loop.size(); ++i) {
    const Point &a = n[loop[i]], &b = n[loop[(i + 1) % loop.size()]];
    if (right_of(a, b, n.from).c[0] >= 0) return false;
    rounds += a.y <= n.from.y && b.y > n.from.y ? 1 : 0;
  }
  return rounds == 1;
}

void double_areas(const World& world, Big* cells, Big* enclosed) {
  const Numbers n(world.points, world.points[0], world.points[0]);
  const auto area = [&](int a, int b) { return cross(n[a].x, n[a].y, n[b].x, n[b].y); };
  *cells = *enclosed = 0;
  for (const std::vector<int>& loop : world.cells) {
    for (size_t i = 0; i < loop.size(); ++i) *cells += area(loop[i], loop[(i + 1) % loop.size()]);
  }
  for (const Side& side : world.sides) {
    if (side.cell[1] < 0) *enclosed += area(side.a, side.b);
  }
}

}  // namespace dsw::oracle::plane
