// Changes of a body while it lives, each verified free at its level.

#include "contact/describe.h"
#include "motion/move.h"
#include "response/insertion.h"
#include "scene/scene.h"

namespace dsw {
namespace {

void check_edge_free(const Environment<3>& env, const Body& body, uint32_t a, uint32_t b) {
  if (body.level == SweepLevel::kPoints) return;
  if (cast(env, body.position(a), body.position(b), body.vertices[a].cell).end == CastEnd::kReached) return;
  fail(DSW_STATUS_OCCUPIED, "the edge between vertices %u and %u meets something impassable", a, b);
}

}  // namespace

uint32_t add_body_vertex(Scene<3>& scene, Body& body, const double* position, dsw_volume_id hint) {
  Cell cell;
  place_points(scene, PointArray{position, 3}, 1, &hint, false, &cell, nullptr);
  reserve(body, 1, 0, 0);
  return add_vertex(body, position, cell);
}

uint32_t add_body_edge(Scene<3>& scene, Body& body, uint32_t a, uint32_t b) {
  if (a == b) fail(DSW_STATUS_BAD_CELL, "an edge from vertex %u to itself", a);
  if (find_edge(body, a, b) != kNone) {
    fail(DSW_STATUS_DUPLICATE_CELL, "vertices %u and %u are joined already", a, b);
  }
  check_edge_free(scene.env, body, a, b);
  reserve(body, 0, 1, 0);
  return add_edge(body, a, b);
}

uint32_t add_body_face(Scene<3>& scene, Body& body, uint32_t a, uint32_t b, uint32_t c) {
  if (a == b || b == c || c == a) fail(DSW_STATUS_BAD_CELL, "triangle (%u, %u, %u) names a vertex twice", a, b, c);
  check_face(body, body.faces.size(), a, b, c);
  if (starts_fan(body, a, b, c)) {
    fail(DSW_STATUS_SHARED_FACE, "triangle (%u, %u, %u) touches others in a vertex alone", a, b, c);
  }
  const uint32_t corners[3] = {a, b, c};
  for (int k = 0; k < 3; ++k) {
    const uint32_t from = corners[k], to = corners[(k + 1) % 3];
    if (find_edge(body, from, to) == kNone) check_edge_free(scene.env, body, from, to);
  }
  if (body.level == SweepLevel::kFaces) {
    StarSweep sweeps(scene.env);
    if (!sweeps.is_triangle_free({body.position(a), body.position(b), body.position(c)}, body.vertices[a].cell)) {
      fail(DSW_STATUS_OCCUPIED, "triangle (%u, %u, %u) meets something impassable", a, b, c);
    }
  }
  reserve(body, 0, 3, 1);
  return add_face(body, a, b, c);
}

void split_body_edge(Scene<3>& scene, Body& body, uint32_t edge, double share, dsw_body_edit* edit) {
  const BodyEdge& e = body.edges[edge];
  double point[3];
  point_at<3>(body.position(e.ends[0]), body.position(e.ends[1]), share, point);
  StarSweep sweeps(scene.env);
  Cell cell;
  if (!can_bend(scene.env, sweeps, body, edge, point, &cell)) {
    fail(DSW_STATUS_OCCUPIED, "the place at %g on the edge between vertices %u and %u, rounded, is not free", share,
         e.ends[0], e.ends[1]);
  }
  insert_vertex(body, edge, point, cell, share, edit);
}

void collapse_body_edge(Scene<3>& scene, Body& body, uint32_t edge, uint32_t vertex, dsw_body_edit* edit) {
  if (!can_collapse(body, edge, vertex)) {
    fail(DSW_STATUS_BAD_CELL, "merging vertex %u into %u would leave no manifold", vertex,
         body.edges[edge].other(vertex));
  }
  StarSweep sweeps(scene.env);
  if (!merge_vertex(sweeps, body, edge, vertex, edit)) {
    fail(DSW_STATUS_OCCUPIED, "the way of vertex %u to vertex %u is not free", vertex, body.edges[edge].other(vertex));
  }
}

}  // namespace dsw
