#include "walls/wall_sweep.h"

#include "base/vec.h"
#include "environment/marking.h"
#include "predicates/swept_triangle.h"

namespace dsw {
namespace {

/** Whether two sets of points lie strictly apart along an axis: then no shift brings their hulls together. */
bool are_apart(const double* const* a, int count_a, const double* const* b, int count_b) noexcept {
  for (int k = 0; k < 3; ++k) {
    double low_a = a[0][k], high_a = low_a, low_b = b[0][k], high_b = low_b;
    for (int i = 1; i < count_a; ++i) low_a = std::min(low_a, a[i][k]), high_a = std::max(high_a, a[i][k]);
    for (int i = 1; i < count_b; ++i) low_b = std::min(low_b, b[i][k]), high_b = std::max(high_b, b[i][k]);
    if (high_a < low_b || high_b < low_a) return true;
  }
  return false;
}

/** Whether a body point, shifted, lies inside of a tetrahedron of the environment; in a flat one there is nothing. */
template <int D>
bool is_inside(const double* a, const double* b, const double* q, const double* r, const double* x) noexcept {
  NoTally none;
  const double *const aqr[3] = {a, q, r}, *const bqr[3] = {b, q, r}, *const abq[3] = {a, b, q},
                      *const abr[3] = {a, b, r};
  const int turn = orient<D>(aqr, b);
  return turn != 0 && plane_side<D>(aqr, x, none).sign == turn && plane_side<D>(bqr, x, none).sign == -turn &&
         plane_side<D>(abq, x, none).sign == turn && plane_side<D>(abr, x, none).sign == -turn;
}

/** Whether a segment between body points, shifted, pierces a triangle of the environment. */
template <int D>
bool pierces(const double* x, const double* y, const double* const* abc) noexcept {
  NoTally none;
  const int side_x = plane_side<D>(abc, x, none).sign, side_y = plane_side<D>(abc, y, none).sign;
  if (side_x * side_y >= 0) return false;
  const double *const inner = side_x < 0 ? x : y, *const outer = side_x < 0 ? y : x;
  for (int k = 0; k < 3; ++k) {
    const double* const ridge[2] = {abc[k], abc[(k + 1) % 3]};
    if (line_side<D>(inner, outer, ridge, none).sign <= 0) return false;
  }
  return true;
}

void keep_first(const WallHit& found, WallHit* hit, bool* any) noexcept {
  if (*any && !(found.time < hit->time)) return;
  *hit = found;
  *any = true;
}

}  // namespace

template <int D>
WallSweep<D>::WallSweep(const Environment<D>& env)
    : env_(env), triangles_(Allocator<Triangle>(env.memory)), edges_(Allocator<Edge>(env.memory)) {}

template <int D>
void WallSweep<D>::start(uint32_t vertex, const Array<Cell>& star) {
  const Map<D>& map = env_.map;
  vertex_ = vertex;
  triangles_.clear();
  edges_.clear();
  for (const Cell c : star) {
    if (map.marked(c)) continue;
    const Shape shape = map.shape(c);
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      if (map.vertex(c, shape.dart_vertex(d)) != vertex) continue;
      const uint32_t facet = shape.dart_facet(d);
      const HalfFacet h = map.half_facet(c, facet), o = map.opposite(h);
      // One that is passable on both sides is met from both.
      const bool twice = o.valid() && !map.marked(map.cell_of(o)) && canonical(map, h) != h;
      if (!twice && is_impassable(map, h)) add_facet(h, shape, c, facet);
    }
  }
  if (env_.marked_edges != 0) {
    for (const Cell c : star) {
      const Shape shape = map.shape(c);
      for (uint32_t d = 0; d < shape.dart_count(); ++d) {
        if (map.vertex(c, shape.dart_vertex(d)) != vertex) continue;
        const uint32_t ends[2] = {map.vertex(c, shape.dart_vertex(shape.beta1(d))),
                                  map.vertex(c, shape.dart_vertex(shape.beta0(d)))};
        for (const uint32_t q : ends) {
          if (edge_marked(env_, vertex, q)) add_edge(q, {});
        }
      }
    }
  }
  marked_ = !edges_.empty() || vertex_marked(env_, vertex);
}

template <int D>
void WallSweep<D>::add_facet(HalfFacet h, const Shape& shape, Cell c, uint32_t facet) {
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
    uint32_t corners[3];
    for (int k = 0; k < 3; ++k) corners[k] = env_.map.vertex(c, shape.simplices()[3 * s + static_cast<uint32_t>(k)]);
    const auto at = std::find(corners, corners + 3, vertex_);
    if (at == corners + 3) continue;
    std::rotate(corners, at, corners + 3);
    triangles_.push_back({corners[1], corners[2], h});
    add_edge(corners[1], h);
    add_edge(corners[2], h);
  }
}

template <int D>
void WallSweep<D>::add_edge(uint32_t q, HalfFacet facet) {
  for (const Edge& edge : edges_) {
    if (edge.q == q) return;
  }
  edges_.push_back({q, facet});
}

template <int D>
bool WallSweep<D>::meets(const Occupants<D>& all, const Feature& feature, const double* from, const double* to,
                         WallHit* hit) const {
  const bool any = feature.is_point() ? meets_point(position(all, feature), from, to, hit)
                   : feature.kind == Feature::kEdge
                       ? meets_edge(*all.bodies[feature.owner].body, feature.index, from, to, hit)
                       : meets_face(*all.bodies[feature.owner].body, feature.index, from, to, hit);
  hit->feature = feature;
  return any;
}

template <int D>
bool WallSweep<D>::meets_point(const double* x, const double* from, const double* to, WallHit* hit) const {
  bool any = false;
  for (const Triangle& t : triangles_) {
    const double *const q = env_.point(t.q), *const r = env_.point(t.r);
    const double* const swept[4] = {from, to, q, r};
    if (are_apart(swept, 4, &x, 1) || !is_inside<D>(from, to, q, r, x)) continue;
    const SweepEvent event{{q, r, x}, EventKind::kFace};
    keep_first({event_time<D>(from, to, event), {}, t.facet, t.q, t.r}, hit, &any);
  }
  return any;
}

template <int D>
bool WallSweep<D>::meets_edge(const Body<D>& body, uint32_t e, const double* from, const double* to,
                              WallHit* hit) const {
  bool any = false;
  const double* const ends[2] = {body.position(body.edges[e].ends[0]), body.position(body.edges[e].ends[1])};
  for (const Edge& edge : edges_) {
    if (!edge.facet.valid() && body.level < SweepLevel::kEdgesSwept) continue;
    const double* const q = env_.point(edge.q);
    const double* const swept[3] = {from, to, q};
    if (are_apart(swept, 3, ends, 2) || !pierces<D>(ends[0], ends[1], swept)) continue;
    const SweepEvent event{{q, ends[0], ends[1]}, EventKind::kEdge};
    keep_first({event_time<D>(from, to, event), {}, edge.facet, edge.q, kNone}, hit, &any);
  }
  return any;
}

template <int D>
bool WallSweep<D>::meets_face(const Body<D>& body, uint32_t f, const double* from, const double* to,
                              WallHit* hit) const {
  if (!marked_) return false;
  const uint32_t(&corners)[3] = body.faces[f].corners;
  const double* const face[3] = {body.position(corners[0]), body.position(corners[1]), body.position(corners[2])};
  const double* const way[2] = {from, to};
  if (are_apart(way, 2, face, 3)) return false;
  const SweptTriangle triangle({face[0], face[1], face[2]});
  const int side = triangle.side(to);
  if (side * triangle.side(from) >= 0 || triangle.outside(from, to, side) != 0) return false;
  *hit = {event_time<D>(from, to, {{face[0], face[1], face[2]}, EventKind::kVertex}), {}, {}, kNone, kNone};
  if (!triangles_.empty()) hit->wall = triangles_.front().facet;
  return true;
}

template <int D>
WallTouch describe_touch(const Environment<D>& env, const Occupants<D>& all, const WallHit& hit, const double* from,
                         const double* to) {
  WallTouch touch;
  double at[3];
  point_at<D>(from, to, hit.time, at);
  const Vec way = difference<D>(to, from);
  Vec normal;
  if (hit.feature.is_point()) {
    std::copy_n(position(all, hit.feature), 3, touch.point);
    normal = unit(cross(difference<D>(env.point(hit.q), at), difference<D>(env.point(hit.r), at)));
  } else if (hit.feature.kind == Feature::kEdge) {
    const Body<D>& body = *all.bodies[hit.feature.owner].body;
    const double *const x = body.position(body.edges[hit.feature.index].ends[0]),
                        *const y = body.position(body.edges[hit.feature.index].ends[1]);
    const Vec wall = unit(difference<D>(env.point(hit.q), at)), edge = difference<D>(y, x), across = cross(edge, wall);
    const double size = dot(across, across);
    const double along = size > 0 ? dot(cross(difference<D>(at, x), wall), across) / size : 0.5;
    touch.along = std::min(std::max(along, 0.0), 1.0);
    point_at<D>(x, y, touch.along, touch.point);
    normal = unit(cross(wall, unit(edge)));
  } else {
    const Body<D>& body = *all.bodies[hit.feature.owner].body;
    const uint32_t(&corners)[3] = body.faces[hit.feature.index].corners;
    std::copy_n(at, 3, touch.point);
    normal = unit(cross(difference<D>(body.position(corners[1]), body.position(corners[0])),
                        difference<D>(body.position(corners[2]), body.position(corners[0]))));
  }
  if (is_zero(normal)) normal = unit(way);
  store<D>(dot(normal, way) < 0 ? -1.0 * normal : normal, touch.normal);
  return touch;
}

#define DSW_WALL_SWEEP(D)                                                                                   \
  template class WallSweep<D>;                                                                              \
  template WallTouch describe_touch(const Environment<D>& env, const Occupants<D>& all, const WallHit& hit, \
                                    const double* from, const double* to)
DSW_WALL_SWEEP(3);
#undef DSW_WALL_SWEEP

}  // namespace dsw
