// Changes of a body while it lives, each verified free at its level.

#include <utility>

#include "base/dimensions.h"
#include "contact/describe.h"
#include "response/insertion.h"
#include "scene/distances.h"
#include "scene/meeting.h"
#include "scene/scene.h"
#include "walk/move.h"

namespace dsw {
namespace {

template <int D>
void check_edge_free(const Environment<D>& env, const Body<D>& body, uint32_t a, uint32_t b) {
  if (!covers_edges(body.level)) return;
  if (cast(env, body.position(a), body.position(b), body.vertices[a].cell).end == CastEnd::kReached) return;
  fail(DSW_STATUS_OCCUPIED, "the edge between vertices %u and %u meets something impassable", a, b);
}

/** The bodies that a body can touch when it is changed inside of a box, or none if bodies do not meet each other. */
template <int D>
class Neighbours {
 public:
  Neighbours(const Scene<D>& scene, const Body<D>& body, const Box<D>& box)
      : meet_(scene.features.contacts), body_(body), partners_(scene.memory), thick_(scene.env) {
    if (meet_) find_partners(scene, body, box, partners_);
  }
  Neighbours(const Scene<D>& scene, const Body<D>& body)
      : Neighbours(scene, body, scene.features.contacts ? reach_of(body) : Box<D>()) {}

  void check_segment(const Corner& a, const Corner& b) const {
    if (!meet_ || is_segment_apart(partners_, body_, a, b)) return;
    fail(DSW_STATUS_OCCUPIED, a.vertex == b.vertex ? "the vertex touches a body" : "the edge touches a body");
  }
  void check_edge(uint32_t a, uint32_t b) const {
    if (covers_edges(body_.level)) check_segment({body_.position(a), a}, {body_.position(b), b});
  }
  void check_triangle(const uint32_t* c) const {
    const Corner corners[3] = {
        {body_.position(c[0]), c[0]}, {body_.position(c[1]), c[1]}, {body_.position(c[2]), c[2]}};
    if (!meet_ || !covers_faces(body_.level) || is_triangle_apart(partners_, body_, corners)) return;
    fail(DSW_STATUS_OCCUPIED, "triangle (%u, %u, %u) touches a body", c[0], c[1], c[2]);
  }
  /** Checks the distances of a new part with these corners. */
  void check_distances(std::initializer_list<uint32_t> corners) {
    ConvexHull hull;
    WayAlong from[3];
    for (const uint32_t v : corners) {
      from[hull.count] = {v, 0};
      hull.points[hull.count++] = body_.position(v);
    }
    check_distances(hull, body_.vertices[*corners.begin()].cell, from);
  }
  void check_distances(const ConvexHull& hull, Cell start, const WayAlong* from) {
    if (thick_.keeps_at_rest(partners(), body_, hull, start, from, from != nullptr ? hull.count : 0)) return;
    fail(DSW_STATUS_OCCUPIED, "the new %s is too near to something",
         hull.count == 1   ? "vertex"
         : hull.count == 2 ? "edge"
                           : "triangle");
  }
  const Partners<D>* partners() const { return meet_ ? &partners_ : nullptr; }

 private:
  bool meet_;
  const Body<D>& body_;
  Partners<D> partners_;
  ThickSweep<D> thick_;
};

}  // namespace

template <int D>
uint32_t add_body_vertex(Scene<D>& scene, BodyRecord<D>& of, const double* position, dsw_volume_id hint) {
  Body<D>& body = of.body;
  Cell cell;
  place_points(scene, PointArray{position, D}, 1, &hint, false, &cell, nullptr);
  Box<D> box;
  box.add(position);
  Neighbours<D> neighbours(scene, body, box);
  neighbours.check_segment({position, kNone}, {position, kNone});
  neighbours.check_distances({{position}, 1}, cell, nullptr);
  reserve(body, 1, 0, 0);
  const uint32_t v = add_vertex(body, position, cell);
  refresh_body(scene, of);
  return v;
}

template <int D>
uint32_t add_body_edge(Scene<D>& scene, Body<D>& body, uint32_t a, uint32_t b) {
  if (a == b) fail(DSW_STATUS_REPEATED_VERTEX, "an edge from vertex %u to itself", a);
  if (find_edge(body, a, b) != kNone) {
    fail(DSW_STATUS_DUPLICATE_PART, "vertices %u and %u are joined already", a, b);
  }
  check_edge_free(scene.env, body, a, b);
  Neighbours<D> neighbours(scene, body);
  neighbours.check_edge(a, b);
  if (covers_edges(body.level)) neighbours.check_distances({a, b});
  reserve(body, 0, 1, 0);
  return add_edge(body, a, b);
}

template <int D>
uint32_t add_body_face(Scene<D>& scene, Body<D>& body, uint32_t a, uint32_t b, uint32_t c) {
  if (a == b || b == c || c == a)
    fail(DSW_STATUS_REPEATED_VERTEX, "triangle (%u, %u, %u) names a vertex twice", a, b, c);
  check_face(body, body.faces.size(), a, b, c);
  if (starts_fan(body, a, b, c)) {
    fail(DSW_STATUS_NOT_MANIFOLD, "triangle (%u, %u, %u) shares only a vertex with the others", a, b, c);
  }
  const uint32_t corners[3] = {a, b, c};
  Neighbours<D> neighbours(scene, body);
  for (int k = 0; k < 3; ++k) {
    const uint32_t from = corners[k], to = corners[(k + 1) % 3];
    if (find_edge(body, from, to) != kNone) continue;
    check_edge_free(scene.env, body, from, to);
    neighbours.check_edge(from, to);
    if (covers_edges(body.level)) neighbours.check_distances({from, to});
  }
  neighbours.check_triangle(corners);
  if (covers_faces(body.level)) neighbours.check_distances({a, b, c});
  if (covers_faces(body.level)) {
    SimplexSweep<D> sweeps(scene.env);
    if (!sweeps.is_triangle_free({body.position(a), body.position(b), body.position(c)}, body.vertices[a].cell)) {
      fail(DSW_STATUS_OCCUPIED, "triangle (%u, %u, %u) meets something impassable", a, b, c);
    }
  }
  reserve(body, 0, 3, 1);
  return add_face(body, a, b, c);
}

namespace {

/** Removes a part. What it joined may then be too near to each other. */
template <int D, class Remove>
void remove_part(Scene<D>& scene, Body<D>& body, Remove remove) {
  reserve_removals(body);
  if (!body.keeps_lengths()) return remove();
  scene.offending.clear();
  Body<D> before = body;
  remove();
  try {
    check_distances(scene, body);
  } catch (...) {
    std::swap(body, before);
    throw;
  }
}

}  // namespace

template <int D>
void remove_body_edge(Scene<D>& scene, Body<D>& body, uint32_t edge) {
  remove_part(scene, body, [&] { remove_edge(body, edge); });
}

template <int D>
void remove_body_vertex(Scene<D>& scene, Body<D>& body, uint32_t vertex) {
  remove_part(scene, body, [&] { remove_vertex(body, vertex); });
}

template <int D>
void split_body_edge(Scene<D>& scene, BodyRecord<D>& of, uint32_t edge, double share, dsw_body_edit* edit) {
  Body<D>& body = of.body;
  follow_changes(scene, of);
  const BodyEdge& e = body.edges[edge];
  double point[D];
  point_at<D>(body.position(e.ends[0]), body.position(e.ends[1]), share, point);
  const Neighbours<D> neighbours(scene, body);
  StarSweep<D> sweeps(scene.env);
  sweeps.partners = neighbours.partners();
  Cell cell;
  if (!can_bend(scene.env, sweeps, body, edge, point, &cell)) {
    fail(DSW_STATUS_OCCUPIED, "the point at %g on the edge between vertices %u and %u, rounded, is not free", share,
         e.ends[0], e.ends[1]);
  }
  insert_vertex(body, edge, point, cell, share, edit);
  refresh_body(scene, of);
}

template <int D>
void collapse_body_edge(Scene<D>& scene, BodyRecord<D>& of, uint32_t edge, uint32_t vertex, dsw_body_edit* edit) {
  Body<D>& body = of.body;
  follow_changes(scene, of);
  if (!can_collapse(body, edge, vertex)) {
    fail(DSW_STATUS_NOT_MANIFOLD, "merging vertex %u into %u would leave no manifold", vertex,
         body.edges[edge].other(vertex));
  }
  const Neighbours<D> neighbours(scene, body);
  StarSweep<D> sweeps(scene.env);
  sweeps.partners = neighbours.partners();
  keep_forecasts(body);
  try {
    if (!merge_vertex(sweeps, body, edge, vertex, edit)) {
      fail(DSW_STATUS_OCCUPIED, "the path from vertex %u to vertex %u is not free", vertex,
           body.edges[edge].other(vertex));
    }
  } catch (...) {
    restore_forecasts(body);
    throw;
  }
}

DSW_INSTANTIATE(add_body_vertex);
DSW_INSTANTIATE(add_body_edge);
DSW_INSTANTIATE(remove_body_edge);
DSW_INSTANTIATE(remove_body_vertex);
DSW_INSTANTIATE(split_body_edge);
DSW_INSTANTIATE(collapse_body_edge);
template uint32_t add_body_face(Scene<3>& scene, Body<3>& body, uint32_t a, uint32_t b, uint32_t c);

}  // namespace dsw
