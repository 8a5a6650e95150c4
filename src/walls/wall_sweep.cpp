#include "walls/wall_sweep.h"

#include <array>

#include "base/dimensions.h"
#include "base/search.h"
#include "base/vec.h"
#include "contact/normals.h"
#include "environment/marking.h"
#include "map/cell_queue.h"
#include "predicates/swept_triangle.h"
#include "proximity/thick_sweep.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

/** Whether two sets of points lie strictly apart along an axis: then no shift brings their hulls together. */
template <int D>
bool are_apart(const double* const* a, int count_a, const double* const* b, int count_b) noexcept {
  for (int k = 0; k < D; ++k) {
    double low_a = a[0][k], high_a = low_a, low_b = b[0][k], high_b = low_b;
    for (int i = 1; i < count_a; ++i) low_a = std::min(low_a, a[i][k]), high_a = std::max(high_a, a[i][k]);
    for (int i = 1; i < count_b; ++i) low_b = std::min(low_b, b[i][k]), high_b = std::max(high_b, b[i][k]);
    if (high_a < low_b || high_b < low_a) return true;
  }
  return false;
}

/** Whether a body point, shifted, lies inside of D + 1 points of the environment; a flat one holds nothing. */
template <int D>
bool is_inside(const double* const (&simplex)[D + 1], const double* x) noexcept {
  // The side of a corner against the other corners in their order changes from each corner to the one before.
  int side = orient<D>(simplex, simplex[D]);
  if (side == 0) return false;
  for (int corner = D; corner >= 0; --corner, side = -side) {
    const double* others[D];
    for (int k = 0; k < D; ++k) others[k] = simplex[k < corner ? k : k + 1];
    if (plane_side<D>(others, x, NoTally{}).sign != side) return false;
  }
  return true;
}

/** Whether a segment between body points, shifted, pierces D points of the environment. */
template <int D>
bool pierces(const double* x, const double* y, const double* const (&simplex)[D]) noexcept {
  NoTally none;
  const int side_x = plane_side<D>(simplex, x, none).sign, side_y = plane_side<D>(simplex, y, none).sign;
  if (side_x * side_y >= 0) return false;
  const double *const inner = side_x < 0 ? x : y, *const outer = side_x < 0 ? y : x;
  for (int k = 0; k < D; ++k) {
    if (ridge_side<D>(inner, outer, simplex, k, none) <= 0) return false;
  }
  return true;
}

/** What a part of a wall sweeps: the way of the moving vertex, and the others. */
template <int D, size_t Size>
void read_swept(const Environment<D>& env, const WallFeature& part, const double* from, const double* to,
                const double* (&swept)[Size]) noexcept {
  swept[0] = from;
  swept[1] = to;
  for (size_t k = 2; k < Size; ++k) swept[k] = env.point(part.vertices[k - 1]);
}

/** When that touches as many points of a body as it has fewer than D + 2: the event of a moving body that has as many
 * points at rest as the part has beside the moving vertex. */
template <int D, size_t Size>
WallHit hit_of(const WallFeature& part, const double* const (&swept)[Size], const double* const* touched) noexcept {
  constexpr size_t kCount = Size - 2;
  SweepEvent event;
  event.kind = static_cast<EventKind>(kCount);
  std::copy_n(swept + 2, kCount, event.points);
  std::copy_n(touched, D - kCount, event.points + kCount);
  WallHit hit;
  hit.time = event_time<D>(swept[0], swept[1], event);
  hit.wall = part;
  return hit;
}

void keep_first(const WallHit& found, WallHit* hit, bool* any) noexcept {
  if (*any && !(found.time < hit->time)) return;
  *hit = found;
  *any = true;
}

}  // namespace

template <int D>
WallSweep<D>::WallSweep(const Environment<D>& env) : env_(env) {}

template <int D>
void WallSweep<D>::start(uint32_t vertex, const Array<Cell>& star, bool passable) {
  const Map<D>& map = env_.map;
  vertex_ = vertex;
  front_ = {};
  simplices_.clear();
  ridges_.clear();
  if (passable) front_ = star[0];
  for (size_t i = passable ? star.size() : 0; i < star.size(); ++i) {
    const Cell c = star[i];
    if (!front_.valid() || map.marked(front_)) front_ = c;
    if (map.marked(c)) continue;
    for_each_facet_at_vertex(map, c, vertex, [&](HalfFacet h, uint32_t facet) {
      const HalfFacet o = map.opposite(h);
      if (o.valid() && !map.facet_marked(h)) {
        if (!map.marked(map.cell_of(o))) return;
      } else if (o.valid() && !map.marked(map.cell_of(o)) && canonical(map, h) != h) {
        return;  // what is passable on both sides is met from both
      }
      add_facet(h, map.shape(c), c, facet);
    });
  }
  add_lone_ridges(star);
  impassable_ = !ridges_.empty() || vertex_marked(env_, vertex);
}

template <int D>
void WallSweep<D>::add_facet(HalfFacet h, const Shape& shape, Cell c, uint32_t facet) {
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
    std::array<uint32_t, D> corners;
    for (uint32_t k = 0; k < D; ++k) corners[k] = env_.map.vertex(c, shape.simplices()[D * s + k]);
    const auto at = dsw::find(corners.begin(), corners.end(), vertex_);
    if (at == corners.end()) continue;
    std::rotate(corners.begin(), at, corners.end());
    WallFeature simplex{{kNone, kNone, kNone}, D, h, c};
    std::copy(corners.begin(), corners.end(), simplex.vertices);
    simplices_.push_back(simplex);
    if constexpr (D == 3) {
      for (uint32_t k = 1; k < D; ++k) add_ridge(corners[k], h, c);
    } else {
      add_ridge(kNone, h, c);
    }
  }
}

/** Adds the ridges that are impassable by their own marks. */
template <int D>
void WallSweep<D>::add_lone_ridges(const Array<Cell>& star) {
  if constexpr (D == 2) {
    if (vertex_marked(env_, vertex_)) add_ridge(kNone, {}, front_);
  } else if (env_.marked_edges != 0) {
    for (const Cell c : star) {
      const Shape shape = env_.map.shape(c);
      for (uint32_t d = 0; d < shape.dart_count(); ++d) {
        if (env_.map.vertex(c, shape.dart_vertex(d)) != vertex_) continue;
        for (const uint32_t end : {shape.beta1(d), shape.beta0(d)}) {
          const uint32_t q = env_.map.vertex(c, shape.dart_vertex(end));
          if (edge_marked(env_, vertex_, q)) add_ridge(q, {}, c);
        }
      }
    }
  }
}

/** @param other the other end of the ridge, in the plane kNone. */
template <int D>
void WallSweep<D>::add_ridge(uint32_t other, HalfFacet facet, Cell cell) {
  for (WallFeature& ridge : ridges_) {
    if (ridge.vertices[1] != other) continue;
    if (env_.map.marked(ridge.cell)) ridge.cell = cell;
    return;
  }
  ridges_.push_back({{vertex_, other, kNone}, D - 1, facet, cell});
}

template <int D>
bool WallSweep<D>::meets(const Occupants<D>& all, const Feature& feature, const double* from, const double* to,
                         WallHit* hit) const {
  const Body<D>* const body = feature.kind == Feature::kParticle ? nullptr : all.bodies[feature.owner].body;
  const bool is_thick = body != nullptr && body->radius > 0;
  const bool any = is_thick                         ? comes_near(*body, feature, from, to, hit)
                   : feature.is_point()             ? meets_point(position(all, feature), from, to, hit)
                   : feature.kind == Feature::kEdge ? meets_edge(*body, feature.index, from, to, hit)
                                                    : meets_face(*body, feature.index, from, to, hit);
  hit->feature = feature;
  return any;
}

/** All that the walls at the vertex sweep, against a part of a thick body. */
template <int D>
bool WallSweep<D>::comes_near(const Body<D>& body, const Feature& feature, const double* from, const double* to,
                              WallHit* hit) const {
  ConvexHull part;
  for (const uint32_t v : SimplexCorners<D>(body, simplex_of(feature))) part.points[part.count++] = body.position(v);
  const double wanted = least_kept(body.radius);
  bool any = false;
  const auto look = [&](const WallFeature& each) {
    ConvexHull wall{{from}, 1};
    for (uint32_t k = 1; k < each.count; ++k) wall.points[wall.count++] = env_.point(each.vertices[k]);
    WallHit found;
    HullGap gap;
    found.time = time_apart<D>(wall, to, part, wanted, &gap);
    if (found.time == 1) return;
    found.wall = each;
    found.is_near = true;
    std::copy_n(gap.other_weights, 3, found.weights);
    // The hull is the wall at the start, and its vertex where it is then.
    found.left = std::min(gap.weights[0] + gap.weights[each.count], 1.0) * (1 - found.time);
    const Vec normal = is_zero(gap.normal) ? unit(difference<D>(to, from)) : Vec(Vec::Zero() - gap.normal);
    store<D>(normal, found.other.normal);
    store<D>(normal, found.end_normal);
    keep_first(found, hit, &any);
  };
  for (const WallFeature& each : simplices_) look(each);
  for (const WallFeature& each : ridges_) {
    if (!each.facet.valid()) look(each);
  }
  if (simplices_.empty() && ridges_.empty() && impassable_) look({{vertex_, kNone, kNone}, 1, {}, front_});
  return any;
}

template <int D>
bool WallSweep<D>::meets_point(const double* x, const double* from, const double* to, WallHit* hit) const {
  bool any = false;
  for (const WallFeature& simplex : simplices_) {
    const double* swept[D + 1];
    read_swept(env_, simplex, from, to, swept);
    if (are_apart<D>(swept, D + 1, &x, 1) || !is_inside<D>(swept, x)) continue;
    keep_first(hit_of<D>(simplex, swept, &x), hit, &any);
  }
  return any;
}

template <int D>
bool WallSweep<D>::meets_edge(const Body<D>& body, uint32_t e, const double* from, const double* to,
                              WallHit* hit) const {
  bool any = false;
  const double* const ends[2] = {body.position(body.edges[e].ends[0]), body.position(body.edges[e].ends[1])};
  for (const WallFeature& ridge : ridges_) {
    if (!ridge.facet.valid() && !sweeps_edges(body.level)) continue;
    const double* swept[D];
    read_swept(env_, ridge, from, to, swept);
    if (are_apart<D>(swept, D, ends, 2) || !pierces<D>(ends[0], ends[1], swept)) continue;
    keep_first(hit_of<D>(ridge, swept, ends), hit, &any);
  }
  return any;
}

template <int D>
bool WallSweep<D>::meets_face([[maybe_unused]] const Body<D>& body, [[maybe_unused]] uint32_t f,
                              [[maybe_unused]] const double* from, [[maybe_unused]] const double* to,
                              [[maybe_unused]] WallHit* hit) const {
  if constexpr (D == 3) {
    if (!impassable_) return false;
    const uint32_t(&corners)[3] = body.faces[f].corners;
    const double* const face[3] = {body.position(corners[0]), body.position(corners[1]), body.position(corners[2])};
    const double* const way[2] = {from, to};
    if (are_apart<D>(way, 2, face, 3)) return false;
    const SweptTriangle triangle({face[0], face[1], face[2]});
    const int side = triangle.side(to);
    if (side * triangle.side(from) >= 0 || triangle.outside(from, to, side) != 0) return false;
    const HalfFacet facet = simplices_.empty() ? HalfFacet{} : simplices_.front().facet;
    const WallFeature vertex{{vertex_, kNone, kNone}, 1, facet, front_};
    *hit = hit_of<D>(vertex, way, face);
    return true;
  }
  return false;
}

/** Normal of a triangle, from its two shorter sides: the third one can be almost one of them turned round. */
static Vec normal_of(const Vec& a, const Vec& b) {  // sides from one corner
  const Vec c = b - a;
  const double size_a = length(a), size_b = length(b), size_c = length(c);
  if (size_c > size_a && size_c > size_b) return unit(a).cross(unit(b));
  return size_a < size_b ? unit(a).cross(unit(c)) : unit(b).cross(unit(c));
}

template <int D>
Vec find_end_normal(const Environment<D>& env, const WallHit& hit, const double* const* corners, const double* to) {
  const auto to_other = [&](int k) { return difference<D>(env.point(hit.wall.vertices[k + 1]), to); };
  const auto side = [&](int k) { return difference<D>(corners[k], corners[0]); };
  if constexpr (D == 2) {
    return turned(hit.feature.is_point() ? to_other(0) : side(1));
  } else {
    if (hit.feature.is_point()) return normal_of(to_other(0), to_other(1));
    if (hit.feature.kind == Feature::kFace) return normal_of(side(1), side(2));
    return unit(side(1)).cross(unit(to_other(0)));
  }
}

namespace {

/** Fills in how far the wall still goes: until what is touched, moved along the vertex's way, leaves the wall's place at
 * the end. `normal` is that of this place, of any sign and length; `touched` any point of what is touched. */
template <int D>
void find_way_left(const Vec& normal, const Vec& way, const double* touched, const double* to, double time,
                   WallHit& touch) {
  const Vec out = unit(normal);
  const double most = 1 - time, part = dot(out, difference<D>(to, touched)) / dot(out, way);
  touch.left = part < most ? std::max(part, 0.0) : most;  // also where it is no number
  const double sense = dot(out, way);
  store<D>(sense > 0 ? out : sense < 0 ? Vec(-1.0 * out) : to_vec<D>(touch.other.normal), touch.end_normal);
}

/** Point, weights and normal of a touched edge, whose corners are these; the moving vertex is `at` a place on `way`. */
template <int D>
Vec describe_edge(const double* const* corners, const double* other, const double* from, const double* at,
                  const Vec& way, WallHit& touch) {
  const double *const x = corners[0], *const y = corners[1];
  const Vec edge = difference<D>(y, x);
  double along;
  Vec normal;
  if constexpr (D == 3) {
    const Vec wall = unit(difference<D>(other, at)), across = edge.cross(wall);
    const double size = dot(across, across);
    along = size > 0 ? dot(difference<D>(at, x).cross(wall), across) / size : 0.5;
    normal = unit(wall.cross(unit(edge)));
  } else {
    const double* const line[2] = {x, y};
    const int k = std::fabs(edge.x()) < std::fabs(edge.y()) ? 1 : 0;
    const double size = y[k] / 2 - x[k] / 2;  // halves, which do not overflow
    along = size != 0 ? (at[k] / 2 - x[k] / 2) / size : 0.5;
    normal = Vec::Zero() - normal_on<2>(orient<2>(line, from), line, way);
  }
  touch.along = std::min(std::max(along, 0.0), 1.0);
  point_at<D>(x, y, touch.along, touch.point);
  touch.weights[0] = 1 - touch.along;
  touch.weights[1] = touch.along;
  return normal;
}

/** Weights and normal of a touched face. */
template <int D>
Vec describe_face(const double* const* corners, const double* at, WallHit& touch) {
  std::copy_n(at, D, touch.point);
  const Vec normal = unit(difference<D>(corners[1], corners[0]).cross(difference<D>(corners[2], corners[0])));
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec a = difference<D>(corners[(k + 1) % 3], at), b = difference<D>(corners[(k + 2) % 3], at);
    touch.weights[k] = std::max(0.0, dot(normal, a.cross(b)));
    sum += touch.weights[k];
  }
  for (double& weight : touch.weights) weight = sum > 0 && std::isfinite(sum) ? weight / sum : 1.0 / 3;
  return normal;
}

}  // namespace

template <int D>
void measure(const Environment<D>& env, const Occupants<D>& all, const double* from, const double* to, WallHit& hit) {
  const double* corners[3] = {hit.point};
  int count = 0;
  if (hit.feature.kind == Feature::kParticle || (hit.feature.is_point() && !hit.is_near)) {
    std::copy_n(position(all, hit.feature), D, hit.point);
  } else {
    const Body<D>& body = *all.bodies[hit.feature.owner].body;
    for (const uint32_t v : SimplexCorners<D>(body, simplex_of(hit.feature))) corners[count++] = body.position(v);
  }
  if (hit.is_near) {
    Vec point = Vec::Zero();
    for (int k = 0; k < count; ++k) point += hit.weights[k] * to_vec<D>(corners[k]);
    store<D>(point, hit.point);
    if (hit.feature.kind == Feature::kEdge) hit.along = hit.weights[1];
    return;
  }
  double at[D];
  point_at<D>(from, to, hit.time, at);
  const Vec way = difference<D>(to, from);
  const auto other = [&](int k) { return env.point(hit.wall.vertices[k + 1]); };
  Vec normal;
  if (count == 2) {
    normal = describe_edge<D>(corners, D == 3 ? other(0) : nullptr, from, at, way, hit);
  } else if (count == 3) {
    normal = describe_face<D>(corners, at, hit);
  } else if constexpr (D == 3) {
    normal = unit(difference<D>(other(0), at).cross(difference<D>(other(1), at)));
  } else {
    normal = Vec::Zero() - swing_normal({from, to, other(0)}, at, hit.point);
  }
  if constexpr (D == 3) {
    if (is_zero(normal)) normal = unit(way);
    if (dot(normal, way) < 0) normal = -1.0 * normal;
  }
  store<D>(normal, hit.other.normal);
  find_way_left<D>(find_end_normal(env, hit, corners, to), way, corners[0], to, hit.time, hit);
}

template class WallSweep<2>;
template class WallSweep<3>;
DSW_INSTANTIATE(find_end_normal);
DSW_INSTANTIATE(measure);

}  // namespace dsw
