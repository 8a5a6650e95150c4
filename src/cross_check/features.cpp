#include "cross_check/features.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "map/dart.h"

namespace dsw {
namespace {

/** Edges are parallel, for libccd, when the sine of their angle is below this. */
constexpr double kParallel = 1e-3;

/** By how much a face may lie above the plane that touches the wedge: rounding of directions, radians. */
constexpr double kConeSlack = 1e-6;

/** How far from the contact point a feature may pass, and how far it may reach, of the obstacle's size. */
constexpr double kNearby = 0.1, kFarthest = 4;

/** Length 1; NaN where there is none, which is no cross-check in the end. */
Vec direction(const Vec& a) {
  const Vec b = (1 / largest(a)) * a;
  return (1 / std::sqrt(dot(b, b))) * b;
}

/** Points as seen from the contact point, in units of the cell at hand: so no product over- or underflows. */
class Frame {
 public:
  Frame(const Environment<3>& env, const ReportedTouch& touch) : env_(env), touch_(touch) {
    const Cell c = touch.kind == TouchKind::kEdge ? touch.edge.cell : env.map.cell_of(touch.wall);
    double size = 0;
    for (uint32_t i = 0; i < env.map.vertices_of(c); ++i) size = std::max(size, largest(at_vertex(c, i)));
    unit_ = size;
  }

  Vec at(const double* x) const {
    const double* const o = touch_.point;
    return {(x[0] - o[0]) / unit_, (x[1] - o[1]) / unit_, (x[2] - o[2]) / unit_};
  }
  Vec at_vertex(Cell c, uint32_t local) const { return at(env_.point(c, local)); }
  Vec at_centre(Cell c) const {
    double x[3];
    centre(env_, c, x);
    return at(x);
  }
  Vec normal() const { return {touch_.normal[0], touch_.normal[1], touch_.normal[2]}; }
  double unit() const { return unit_; }

 private:
  const Environment<3>& env_;
  const ReportedTouch& touch_;
  double unit_ = 1;  // scene units
};

void add(Hull& hull, const Vec& p) { hull.points.insert(hull.points.end(), {p.x(), p.y(), p.z()}); }

/** Whether the box of a hull reaches the contact point, or nearly, and nothing far beyond the obstacle. */
bool is_at_contact(const Hull& hull) {
  for (size_t axis = 0; axis < 3; ++axis) {
    double low = kFarthest, high = -kFarthest;
    for (size_t i = axis; i < hull.points.size(); i += 3) {
      if (!(std::fabs(hull.points[i]) < kFarthest)) return false;
      low = std::min(low, hull.points[i]);
      high = std::max(high, hull.points[i]);
    }
    if (low > kNearby || high < -kNearby) return false;
  }
  return true;
}

/** Makes the obstacle as large as 1, and the body with it. libccd does not survive features that are not where they
 * touch. */
NoFeatures rescale(const Frame& frame, Features& features) {
  double size = 0;
  for (const double x : features.obstacle.points) size = std::max(size, std::fabs(x));
  for (Hull* hull : {&features.obstacle, &features.body}) {
    for (double& x : hull->points) x /= size;
    if (!is_at_contact(*hull)) return NoFeatures::kDegenerate;
  }
  features.unit = size * frame.unit();
  return NoFeatures::kFound;
}

/** The part of segment a b that is no farther than `reach` from `foot`, moved by `shift`. */
void add_segment(Hull& hull, const Vec& a, const Vec& b, const Vec& foot, double reach, const Vec& shift) {
  const Vec along = direction(b - a);
  const double before = std::min(dot(foot - a, along), reach), after = std::min(dot(b - foot, along), reach);
  add(hull, foot - before * along + shift);
  add(hull, foot + after * along + shift);
}

/** The point of segment a b that is nearest to the contact point. */
Vec foot_on(const Vec& a, const Vec& b) {
  const Vec along = direction(b - a);
  const double length = dot(b - a, along);
  return a + std::clamp(-dot(a, along), 0.0, length) * along;
}

/** An edge of the environment and the boundary triangles at it: by their third corners. */
struct Wedge {
  Vec a, b;
  Array<Vec> corners;
};

/** The two corners between which all others lie, seen along the edge, if the normal is one of the wedge's. */
NoFeatures extreme_corners(const Wedge& wedge, const Vec& normal, const Vec*& first, const Vec*& last) {
  const Vec along = direction(wedge.b - wedge.a), aside = along.cross(normal);
  double lowest = 4, highest = -4;
  for (const Vec& corner : wedge.corners) {
    const Vec off = corner - wedge.a, across = direction(off - dot(off, along) * along);
    const double above = dot(across, normal);
    if (!std::isfinite(above)) return NoFeatures::kDegenerate;
    if (above > kConeSlack) return NoFeatures::kOutsideCone;
    const double turn = std::atan2(dot(across, aside), -above);
    if (turn < lowest) {
      lowest = turn;
      first = &corner;
    }
    if (turn > highest) {
      highest = turn;
      last = &corner;
    }
  }
  return wedge.corners.empty() ? NoFeatures::kDegenerate : NoFeatures::kFound;
}

/** The touching segment against the tetrahedron of a wedge. */
NoFeatures segment_on_wedge(const Frame& frame, const ReportedTouch& touch, const Wedge& wedge, Features& features) {
  const Vec p = frame.at(touch.position), q = frame.at(touch.fixed);
  const Vec sine = direction(wedge.b - wedge.a).cross(direction(q - p));
  if (!(dot(sine, sine) >= kParallel * kParallel)) return NoFeatures::kParallel;
  const Vec *first = nullptr, *last = nullptr;
  const NoFeatures reason = extreme_corners(wedge, frame.normal(), first, last);
  if (reason != NoFeatures::kFound) return reason;
  double reach = 0;
  for (const Vec* x : {&wedge.a, &wedge.b, first, last}) {
    add(features.obstacle, *x);
    reach = std::max(reach, largest(*x));
  }
  const Vec foot = foot_on(p, q);
  add_segment(features.body, p, q, foot, reach, foot_on(wedge.a, wedge.b) - foot);
  return rescale(frame, features);
}

/** The third corner of the boundary triangle that a dart's facet has at it. */
uint32_t third_corner(const Shape& shape, uint32_t dart) {
  const uint32_t facet = shape.dart_facet(dart), from = shape.dart_vertex(dart),
                 to = shape.dart_vertex(shape.beta1(dart));
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
    const uint16_t* const local = shape.simplices() + 3 * s;
    for (int k = 0; k < 3; ++k) {
      if (local[k] == from && local[(k + 1) % 3] == to) return local[(k + 2) % 3];
    }
  }
  return from;
}

NoFeatures edge_features(const Environment<3>& env, const Frame& frame, const ReportedTouch& touch,
                         Features& features) {
  const Map<3>& map = env.map;
  const Shape shape = map.shape(touch.edge.cell);
  Wedge wedge{frame.at_vertex(touch.edge.cell, shape.dart_vertex(touch.edge.local)),
              frame.at_vertex(touch.edge.cell, shape.dart_vertex(shape.beta1(touch.edge.local))),
              Array<Vec>(env.memory)};
  const auto look_at = [&](Dart d) {
    if (is_impassable(map, half_facet(map, d))) {
      wedge.corners.push_back(frame.at_vertex(d.cell, third_corner(map.shape(d.cell), d.local)));
    }
  };
  for_each_volume_round_edge(map, touch.edge, [&](Dart d) {
    look_at(d);
    look_at(beta2(map, d));
    return true;
  });
  return segment_on_wedge(frame, touch, wedge, features);
}

/** The diagonal of the wall that lies nearest to the contact point, with both of its triangles. */
NoFeatures diagonal_features(const Environment<3>& env, const Frame& frame, const ReportedTouch& touch,
                             Features& features) {
  const Cell c = env.map.cell_of(touch.wall);
  const Shape shape = env.map.shape(c);
  const uint32_t facet = env.map.local_of(touch.wall, c);
  Wedge wedge{{}, {}, Array<Vec>(env.memory)};
  double nearest = -1;
  const uint16_t* const local = shape.simplices();
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
    for (uint32_t t = s + 1; t < shape.simplex_first(facet + 1); ++t) {
      for (uint32_t k = 0; k < 9; ++k) {
        const uint32_t i = k / 3, j = k % 3;
        const uint16_t *one = local + 3 * s, *other = local + 3 * t;
        if (one[i] != other[(j + 1) % 3] || one[(i + 1) % 3] != other[j]) continue;
        const Vec a = frame.at_vertex(c, one[i]), b = frame.at_vertex(c, other[j]), foot = foot_on(a, b);
        if (nearest >= 0 && !(dot(foot, foot) < nearest)) continue;
        nearest = dot(foot, foot);
        wedge.a = a;
        wedge.b = b;
        wedge.corners.assign({frame.at_vertex(c, one[(i + 2) % 3]), frame.at_vertex(c, other[(j + 2) % 3])});
      }
    }
  }
  return nearest < 0 ? NoFeatures::kDegenerate : segment_on_wedge(frame, touch, wedge, features);
}

/** Triangle of the wall, counter-clockwise seen from behind it. */
struct Triangle {
  Vec corner[3];
  Vec outward() const { return direction((corner[1] - corner[0]).cross(corner[2] - corner[0])); }
};

Triangle wall_triangle(const Frame& frame, Cell c, const Shape& shape, uint32_t simplex) {
  const uint16_t* const local = shape.simplices() + 3 * simplex;
  return {{frame.at_vertex(c, local[0]), frame.at_vertex(c, local[1]), frame.at_vertex(c, local[2])}};
}

/** How far inside of a triangle the contact point lies, seen along its normal; negative outside. */
double inside_by(const Triangle& t) {
  const Vec n = t.outward();
  double least = HUGE_VAL;
  for (int k = 0; k < 3; ++k) {
    const Vec& a = t.corner[k];
    least = std::min(least, dot(a.cross(direction(t.corner[(k + 1) % 3] - a)), n));
  }
  return least;
}

/** The obstacle behind a wall: its volume where that is convex, else the tetrahedron over one of its triangles. */
void add_behind(const Environment<3>& env, const Frame& frame, HalfFacet wall, const Triangle& t, Hull& hull) {
  const HalfFacet other = env.map.opposite(wall);
  const Cell behind = other.valid() ? env.map.cell_of(other) : Cell{};
  if (behind.valid() && env.map.marked(behind) && env.map.convex(behind)) {
    for (uint32_t i = 0; i < env.map.vertices_of(behind); ++i) add(hull, frame.at_vertex(behind, i));
    return;
  }
  for (const Vec& corner : t.corner) add(hull, corner);
  if (behind.valid()) {
    add(hull, frame.at_centre(behind));
  } else {  // what is in front, seen in the middle of the triangle
    const Vec sum = t.corner[0] + t.corner[1] + t.corner[2];
    add(hull, (2.0 / 3) * sum - frame.at_centre(env.map.cell_of(wall)));
  }
}

NoFeatures point_features(const Environment<3>& env, const Frame& frame, const ReportedTouch& touch,
                          Features& features) {
  const Cell c = env.map.cell_of(touch.wall);
  const Shape shape = env.map.shape(c);
  const uint32_t facet = env.map.local_of(touch.wall, c);
  Triangle best{};
  double most = -HUGE_VAL;
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
    const Triangle t = wall_triangle(frame, c, shape, s);
    const double inside = inside_by(t);
    if (!(inside > most)) continue;
    most = inside;
    best = t;
  }
  if (!std::isfinite(most)) return NoFeatures::kDegenerate;
  add_behind(env, frame, touch.wall, best, features.obstacle);
  const Vec out = best.outward();
  add(features.body, dot(best.corner[0], out) * out);
  return rescale(frame, features);
}

/** A face of the body on a corner of the obstacle. */
NoFeatures corner_features(const Environment<3>& env, const Frame& frame, const ReportedTouch& touch,
                           Features& features) {
  const Cell c = env.map.cell_of(touch.wall);
  const Shape shape = env.map.shape(c);
  const uint32_t facet = env.map.local_of(touch.wall, c);
  const Vec corner = frame.at(env.point(touch.vertex));
  bool found = false;
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1) && !found; ++s) {
    for (uint32_t k = 0; k < 3; ++k) found = found || env.map.vertex(c, shape.simplices()[3 * s + k]) == touch.vertex;
    if (found) add_behind(env, frame, touch.wall, wall_triangle(frame, c, shape, s), features.obstacle);
  }
  if (!found) return NoFeatures::kDegenerate;
  const Vec n = frame.normal();
  const double* const points = features.obstacle.points.data();
  for (size_t i = 0; i < features.obstacle.count(); ++i) {
    const Vec away = Vec{points[3 * i], points[3 * i + 1], points[3 * i + 2]} - corner;
    if (dot(away, n) > kConeSlack * largest(away)) return NoFeatures::kOutsideCone;
  }
  const Vec p = frame.at(touch.position), q = frame.at(touch.fixed), r = frame.at(touch.fixed + 3);
  const Vec across = direction(direction(q - p).cross(direction(r - p))), shift = dot(corner - p, across) * across;
  double reach = 0;
  for (size_t i = 0; i < features.obstacle.count(); ++i) {
    reach = std::max(reach, largest(Vec{points[3 * i], points[3 * i + 1], points[3 * i + 2]} - corner));
  }
  for (const Vec& x : {p, q, r}) {  // each drawn nearer to the corner, which stays inside
    const Vec off = x + shift - corner;
    add(features.body, corner + std::min(1.0, reach / largest(off)) * off);
  }
  return rescale(frame, features);
}

}  // namespace

NoFeatures find_features(const Environment<3>& env, const ReportedTouch& touch, Features& features) {
  const Frame frame(env, touch);
  switch (touch.kind) {
    case TouchKind::kEdge:
      return edge_features(env, frame, touch, features);
    case TouchKind::kDiagonal:
      return diagonal_features(env, frame, touch, features);
    case TouchKind::kCorner:
      return corner_features(env, frame, touch, features);
    default:
      return point_features(env, frame, touch, features);
  }
}

const double* farthest(const Hull& hull, const double* direction) noexcept {
  const double *best = hull.points.data(), *const end = best + hull.points.size();
  const auto reach = [direction](const double* p) {
    return (p[0] * direction[0] + p[1] * direction[1]) + p[2] * direction[2];
  };
  double most = reach(best);
  for (const double* p = best + 3; p < end; p += 3) {
    const double far = reach(p);
    if (!(far > most)) continue;
    most = far;
    best = p;
  }
  return best;
}

double way_out(const Hull& body, const Hull& obstacle, const double* along) noexcept {
  const double back[3] = {-along[0], -along[1], -along[2]};
  const double *const out = farthest(obstacle, along), *const in = farthest(body, back);
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += along[k] * (out[k] - in[k]);
  return sum;
}

void push_in(Hull& body, const double* normal, double depth) noexcept {
  for (size_t i = 0; i < body.points.size(); ++i) body.points[i] -= depth * normal[i % 3];
}

}  // namespace dsw
