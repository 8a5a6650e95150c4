#include "sweep_truth.h"

#include <algorithm>
#include <set>

namespace dsw::oracle {
namespace {

constexpr int kP = 0, kTo = 1, kQ = 2;

using Point = std::array<Big, 3>;

Point difference(const Point& x, const Point& y) {
  Point d;
  for (size_t k = 0; k < 3; ++k) d[k] = x[k] - y[k];
  return d;
}

Point cross(const Point& x, const Point& y) {
  Point c;
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    c[k] = x[i] * y[j] - x[j] * y[i];
  }
  return c;
}

Big dot(const Point& x, const Point& y) { return Big(x[0] * y[0] + x[1] * y[1] + x[2] * y[2]); }

bool is_zero(const Point& x) { return sgn(x[0]) == 0 && sgn(x[1]) == 0 && sgn(x[2]) == 0; }

void negate(Point& x) {
  for (Big& k : x) k = -k;
}

void take(const Vec& p, Vec& low, Vec& high) {
  for (size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], p[k]);
    high[k] = std::max(high[k], p[k]);
  }
}

/// Strictly apart: then no shift makes them meet.
template <class Box>
bool apart(const Box& x, const Box& y) {
  for (size_t k = 0; k < 3; ++k) {
    if (x.high[k] < y.low[k] || y.high[k] < x.low[k]) return true;
  }
  return false;
}

/// Standard part of a ratio of polynomials, 0 <= n <= d and d > 0: the coefficients where d begins.
size_t order(const Shifted& d) {
  size_t k = 0;
  while (sgn(d.c[k]) == 0) ++k;
  return k;
}

}  // namespace

int Shifted::sign() const {
  for (const Big& x : c) {
    if (sgn(x) != 0) return sgn(x);
  }
  return 0;
}

void Shifted::negate() {
  for (Big& x : c) x = -x;
}

int compare_times(const SweepEvent& a, const SweepEvent& b) {
  for (size_t degree = 0; degree <= 6; ++degree) {
    Big sum = 0;
    for (size_t i = degree < 3 ? 0 : degree - 3; i <= std::min<size_t>(degree, 3); ++i) {
      const size_t j = degree - i;
      sum += a.numerator.c[i] * b.denominator.c[j];
      sum -= b.numerator.c[i] * a.denominator.c[j];
    }
    if (sgn(sum) != 0) return sgn(sum);
  }
  return 0;
}

SweepWorld::SweepWorld(World& world, const std::vector<std::array<int, 2>>& wires) : world_(world) {
  const std::vector<Vec>& raw = world.mesh.points;
  std::set<std::pair<int, int>> edges;
  const auto add_edge = [&](int a, int b) { edges.insert({std::min(a, b), std::max(a, b)}); };
  const auto box_of = [&](std::initializer_list<int> vertices) {
    const Vec& first = raw[static_cast<size_t>(*vertices.begin())];
    Box box = {first, first};
    for (int v : vertices) take(raw[static_cast<size_t>(v)], box.low, box.high);
    return box;
  };
  for (size_t t = 0; t < world.triangles.size(); ++t) {
    const int* v = world.triangles[t].v;
    if (!world.impassable(world.triangles[t].face)) continue;
    normals_.push_back({static_cast<int>(t), box_of({v[0], v[1], v[2]}), {}});
    for (size_t k = 0; k < 3; ++k) add_edge(v[k], v[(k + 1) % 3]);
  }
  for (const auto& wire : wires) add_edge(wire[0], wire[1]);
  std::set<int> used;
  for (const auto& [a, b] : edges) {
    edges_.push_back({a, b, box_of({a, b})});
    used.insert({a, b});
  }
  // One unit is an integer too: the shift is measured in the coordinates' units.
  for (int v : used) {
    for (double x : raw[static_cast<size_t>(v)]) need_ = std::max(need_, x == 0 ? 0 : -lowest_exponent(x));
  }
  points_.resize(raw.size());
  scaled_.resize(raw.size());
  stamp_.assign(raw.size(), 0);
  for (int v : used) {
    for (size_t k = 0; k < 3; ++k) {
      points_[static_cast<size_t>(v)][k] = to_big(raw[static_cast<size_t>(v)][k], need_);
    }
  }
  for (Normal& n : normals_) {
    const int* v = world.triangles[static_cast<size_t>(n.triangle)].v;
    const Point& a = points_[static_cast<size_t>(v[0])];
    n.n = cross(difference(points_[static_cast<size_t>(v[1])], a), difference(points_[static_cast<size_t>(v[2])], a));
  }
}

void SweepWorld::load(const Vec* points, int count) {
  int need = need_;
  for (int i = 0; i < count; ++i) {
    for (double x : points[i]) need = std::max(need, x == 0 ? 0 : -lowest_exponent(x));
  }
  for (int i = 0; i < count; ++i) {
    for (size_t k = 0; k < 3; ++k) body_[i][k] = to_big(points[i][k], need);
  }
  delta_ = static_cast<unsigned>(need - need_);
  unit_ = Big(1) << static_cast<unsigned>(need);
  ++now_;
  tie_ = false;
}

const SweepWorld::Point& SweepWorld::at(int vertex) {
  const auto v = static_cast<size_t>(vertex);
  if (delta_ == 0) return points_[v];
  if (stamp_[v] != now_) {
    stamp_[v] = now_;
    for (size_t k = 0; k < 3; ++k) scaled_[v][k] = points_[v][k] << delta_;
  }
  return scaled_[v];
}

Shifted SweepWorld::shifted(const Big& unshifted, const Point& coefficients) const {
  Shifted x;
  x.c[0] = unshifted;
  for (size_t k = 0; k < 3; ++k) x.c[k + 1] = coefficients[k] * unit_;
  return x;
}

int SweepWorld::sign_with_ties(const Big& unshifted, const Point& coefficients) {
  if (sgn(unshifted) != 0) return sgn(unshifted);
  tie_ = true;
  for (const Big& c : coefficients) {
    if (sgn(c) != 0) return sgn(c);
  }
  return 0;
}

// det(y - x, a - x, b - x); the shift of x and y adds s.((y - x) x (b - a)).
Big SweepWorld::line_value(int x, int y, int a, int b) {
  return dot(difference(body_[y], body_[x]), cross(difference(at(a), body_[x]), difference(at(b), body_[x])));
}
SweepWorld::Point SweepWorld::line_shift(int x, int y, int a, int b) {
  return cross(difference(body_[y], body_[x]), difference(at(b), at(a)));
}
int SweepWorld::line_sign(int x, int y, int a, int b) {
  const Big value = line_value(x, y, a, b);
  return sgn(value) != 0 ? sgn(value) : sign_with_ties(value, line_shift(x, y, a, b));
}
Shifted SweepWorld::line(int x, int y, int a, int b) { return shifted(line_value(x, y, a, b), line_shift(x, y, a, b)); }

/// +1 when x -> y goes through the triangle along its normal, -1 against it, 0 when it misses.
int SweepWorld::pierce(int x, int y, const Normal& t) {
  const int* v = world_.triangles[static_cast<size_t>(t.triangle)].v;
  const Point& a = at(v[0]);
  const int from = sign_with_ties(dot(t.n, difference(body_[x], a)), t.n);
  const int to = sign_with_ties(dot(t.n, difference(body_[y], a)), t.n);
  if (from == to) return 0;
  const int first = line_sign(x, y, v[0], v[1]);
  if (line_sign(x, y, v[1], v[2]) != first || line_sign(x, y, v[2], v[0]) != first) return 0;
  return to;
}

bool SweepWorld::any_pierced(const Vec* points, int x, int y) {
  Box box = {points[x], points[x]};
  take(points[y], box.low, box.high);
  for (const Normal& t : normals_) {
    if (!apart(t.box, box) && pierce(x, y, t) != 0) return true;
  }
  return false;
}

bool SweepWorld::blocked(const Vec& x, const Vec& y) {
  const Vec points[2] = {x, y};
  load(points, 2);
  return any_pierced(points, 0, 1);
}

void SweepWorld::add_vertex_events(const Box& box, std::vector<SweepEvent>& events) {
  for (const Normal& t : normals_) {
    if (apart(t.box, box)) continue;
    SweepEvent e;
    e.side = pierce(kP, kTo, t);
    if (e.side == 0) continue;
    // Who comes in from outside has left before, or at once where the outer boundary is folded upon itself.
    if (world_.triangles[static_cast<size_t>(t.triangle)].cell[e.side > 0 ? 0 : 1] < 0) continue;
    e.triangle = t.triangle;
    const Point& a = at(world_.triangles[static_cast<size_t>(t.triangle)].v[0]);
    Point shift = t.n;
    negate(shift);
    e.numerator = shifted(dot(t.n, difference(a, body_[kP])), shift);
    e.denominator = shifted(dot(t.n, difference(body_[kTo], body_[kP])), {});
    if (e.denominator.sign() < 0) {
      e.numerator.negate();
      e.denominator.negate();
    }
    e.time = std::min(1.0, floor_to_double(e.numerator.c[0], e.denominator.c[0]));
    events.push_back(std::move(e));
  }
}

void SweepWorld::add_edge_events(const Box& box, std::vector<SweepEvent>& events) {
  const Point n = cross(difference(body_[kTo], body_[kP]), difference(body_[kQ], body_[kP]));
  if (is_zero(n)) return;
  Point shift = n;
  negate(shift);
  const auto side = [&](int v) { return sign_with_ties(dot(n, difference(at(v), body_[kP])), shift); };
  for (const Edge& edge : edges_) {
    if (apart(edge.box, box) || side(edge.a) == side(edge.b)) continue;
    const int first = line_sign(kP, kTo, edge.a, edge.b);
    if (line_sign(kTo, kQ, edge.a, edge.b) != first || line_sign(kQ, kP, edge.a, edge.b) != first) continue;
    SweepEvent e;
    e.a = edge.a;
    e.b = edge.b;
    // Weights of p and p' where the edge goes through: they have one sign, and that of q.
    Shifted weight[2] = {line(kTo, kQ, e.a, e.b), line(kQ, kP, e.a, e.b)};
    for (Shifted& w : weight) {
      if (first < 0) w.negate();
    }
    for (size_t k = 0; k < 4; ++k) e.denominator.c[k] = weight[0].c[k] + weight[1].c[k];
    e.numerator = weight[1];
    const size_t k = order(e.denominator);
    e.time = std::min(1.0, floor_to_double(e.numerator.c[k], e.denominator.c[k]));
    e.regular = k == 0;
    events.push_back(std::move(e));
  }
}

void SweepWorld::keep_first(std::vector<SweepEvent>& events) {
  std::vector<SweepEvent> first;
  for (SweepEvent& e : events) {
    const int c = first.empty() ? 0 : compare_times(e, first[0]);
    if (c > 0) continue;
    if (c < 0) first.clear();
    first.push_back(std::move(e));
  }
  events = std::move(first);
}

SweepTruth SweepWorld::sweep(const Vec& from, const Vec& to, const Vec& fixed) {
  const Vec points[3] = {from, to, fixed};
  load(points, 3);
  SweepTruth truth;
  truth.start = world_.locate(world_.body(from.data()));
  truth.start_free = !any_pierced(points, kP, kQ);
  truth.new_edge_hit = any_pierced(points, kTo, kQ);
  Box box = {from, from};
  take(to, box.low, box.high);
  add_vertex_events(box, truth.path);
  truth.path_hit = !truth.path.empty();
  truth.swept = truth.path;
  take(fixed, box.low, box.high);
  add_edge_events(box, truth.swept);
  const std::vector<SweepEvent> all = truth.swept;
  keep_first(truth.path);
  keep_first(truth.swept);
  // Two features at one time are a tie too.
  int at_once = 0;
  for (const SweepEvent& e : all) {
    const SweepEvent& first = truth.swept[0];
    at_once += first.regular && e.numerator.c[0] * first.denominator.c[0] == first.numerator.c[0] * e.denominator.c[0];
  }
  truth.tie = tie_ || at_once > 1;
  return truth;
}

}  // namespace dsw::oracle
