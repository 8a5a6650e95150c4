#include "sweep_truth.h"

#include <algorithm>
#include <set>

namespace dsw::oracle {
namespace {

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

}  // namespace

SweepWorld::SweepWorld(World& world, const std::vector<std::array<int, 2>>& marked_edges,
                       const std::vector<int>& marked)
    : world_(world) {
  const std::vector<Vec>& raw = world.mesh.points;
  std::set<std::pair<int, int>> edges;
  const auto add_edge = [&](int a, int b) { edges.insert({std::min(a, b), std::max(a, b)}); };
  for (size_t t = 0; t < world.triangles.size(); ++t) {
    const int* v = world.triangles[t].v;
    if (!world.impassable(world.triangles[t].face)) continue;
    normals_.push_back({static_cast<int>(t), box_of(raw, {v[0], v[1], v[2]}), {}});
    for (size_t k = 0; k < 3; ++k) add_edge(v[k], v[(k + 1) % 3]);
  }
  for (const auto& edge : marked_edges) add_edge(edge[0], edge[1]);
  std::set<int> used(marked.begin(), marked.end());
  for (const auto& [a, b] : edges) {
    edges_.push_back({a, b, box_of(raw, {a, b})});
    used.insert({a, b});
  }
  take_points(raw, {used.begin(), used.end()});
  for (Normal& n : normals_) {
    const int* v = world.triangles[static_cast<size_t>(n.triangle)].v;
    const Point& a = points_[static_cast<size_t>(v[0])];
    n.n = cross(difference(points_[static_cast<size_t>(v[1])], a), difference(points_[static_cast<size_t>(v[2])], a));
  }
}

// det(y - x, a - x, b - x); the shift of x and y adds s.((y - x) x (b - a)).
Big SweepWorld::line_value(size_t x, size_t y, int a, int b) {
  return dot(difference(body_[y], body_[x]), cross(difference(at(a), body_[x]), difference(at(b), body_[x])));
}
SweepWorld::Point SweepWorld::line_shift(size_t x, size_t y, int a, int b) {
  return cross(difference(body_[y], body_[x]), difference(at(b), at(a)));
}
int SweepWorld::line_sign(size_t x, size_t y, int a, int b) {
  const Big value = line_value(x, y, a, b);
  return sgn(value) != 0 ? sgn(value) : sign_with_ties(value, line_shift(x, y, a, b));
}
Shifted SweepWorld::line(size_t x, size_t y, int a, int b) {
  return shifted(line_value(x, y, a, b), line_shift(x, y, a, b));
}

SweepWorld::Point SweepWorld::normal(size_t x, size_t y, size_t z) const {
  return cross(difference(body_[y], body_[x]), difference(body_[z], body_[x]));
}
// n.(vertex - on), on shifted: the shift adds -s.n.
Shifted SweepWorld::plane(const Point& n, size_t on, int vertex) {
  Point shift = n;
  negate(shift);
  return shifted(dot(n, difference(at(vertex), body_[on])), shift);
}
int SweepWorld::plane_sign(const Point& n, size_t on, int vertex) {
  const Shifted value = plane(n, on, vertex);
  tie_ = tie_ || sgn(value.c[0]) == 0;
  return value.sign();
}

/// +1 when x -> y goes through the triangle along its normal, -1 against it, 0 when it misses.
int SweepWorld::pierce(size_t x, size_t y, const Normal& t) {
  const int* v = world_.triangles[static_cast<size_t>(t.triangle)].v;
  const Point& a = at(v[0]);
  const int from = sign_with_ties(dot(t.n, difference(body_[x], a)), t.n);
  const int to = sign_with_ties(dot(t.n, difference(body_[y], a)), t.n);
  if (from == to) return 0;
  const int first = line_sign(x, y, v[0], v[1]);
  if (line_sign(x, y, v[1], v[2]) != first || line_sign(x, y, v[2], v[0]) != first) return 0;
  return to;
}

bool SweepWorld::any_pierced(size_t x, size_t y) {
  const Box box = body_box({x, y});
  return std::any_of(normals_.begin(), normals_.end(),
                     [&](const Normal& t) { return !apart(t.box, box) && pierce(x, y, t) != 0; });
}

bool SweepWorld::blocked(const Vec& x, const Vec& y, const Vec& z) {
  load({x, y, z});
  const Point n = normal(0, 1, 2);
  const Box box = body_box({0, 1, 2});
  return !is_zero(n) && std::any_of(edges_.begin(), edges_.end(), [&](const Edge& edge) {
    return !apart(edge.box, box) && goes_through(edge, 0, 1, 2, n) != 0;
  });
}

void SweepWorld::add_path_events(std::vector<SweepEvent>& events) {
  const Box box = body_box({kP, kTo});
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
    add(std::move(e), events);
  }
}

/// The sign that the three sides of the triangle have beside the obstacle's edge, or 0 if that misses it.
int SweepWorld::goes_through(const Edge& edge, size_t x, size_t y, size_t z, const Point& n) {
  if (plane_sign(n, x, edge.a) == plane_sign(n, x, edge.b)) return 0;
  const int first = line_sign(x, y, edge.a, edge.b);
  const bool through = line_sign(y, z, edge.a, edge.b) == first && line_sign(z, x, edge.a, edge.b) == first;
  return through ? first : 0;
}

void SweepWorld::add_edge_events(size_t number, std::vector<SweepEvent>& events) {
  const size_t q = kQ + number;
  const Point n = normal(kP, kTo, q);
  if (is_zero(n)) return;
  const Box box = body_box({kP, kTo, q});
  for (const Edge& edge : edges_) {
    if (apart(edge.box, box) || goes_through(edge, kP, kTo, q, n) == 0) continue;
    SweepEvent e;
    e.edge = static_cast<int>(number);
    e.a = edge.a;
    e.b = edge.b;
    // Weights of p and p' where the edge goes through: they have one sign, and that of q.
    const Shifted weight = line(kTo, q, e.a, e.b);
    e.numerator = line(q, kP, e.a, e.b);
    for (size_t k = 0; k < 4; ++k) e.denominator.c[k] = weight.c[k] + e.numerator.c[k];
    add(std::move(e), events);
  }
}

void SweepWorld::add_face_events(size_t number, const std::array<size_t, 2>& ends, std::vector<SweepEvent>& events) {
  const size_t q = kQ + ends[0], r = kQ + ends[1];
  const Box box = body_box({kP, kTo, q, r});
  // Each side of the tetrahedron and the corner across from it; the first two are the face before and after.
  const size_t sides[4][4] = {{q, r, kP, kTo}, {q, r, kTo, kP}, {kP, kTo, q, r}, {kP, kTo, r, q}};
  Point normals[4];
  int inner[4];
  for (size_t i = 0; i < 4; ++i) {
    normals[i] = normal(sides[i][0], sides[i][1], sides[i][2]);
    inner[i] = sgn(dot(normals[i], difference(body_[sides[i][3]], body_[sides[i][0]])));
  }
  if (inner[0] == 0) return;  // flat: its edges' triangles cover it
  for (const Vertex& v : vertices_) {
    if (apart(v.box, box)) continue;
    size_t inside = 0;
    while (inside < 4 && plane_sign(normals[inside], sides[inside][0], v.vertex) == inner[inside]) ++inside;
    if (inside < 4) continue;
    SweepEvent e;
    e.face = static_cast<int>(number);
    e.vertex = v.vertex;
    // Linear in time, and of opposite signs at the ends.
    e.numerator = plane(normals[0], q, v.vertex);
    const Shifted after = plane(normals[1], q, v.vertex);
    for (size_t k = 0; k < 4; ++k) e.denominator.c[k] = e.numerator.c[k] - after.c[k];
    add(std::move(e), events);
  }
}

}  // namespace dsw::oracle
