// In one turn a part sweeps a triangle or a tetrahedron. Its corners are places of the part's vertices, before or after their
// own turns. So it is apart from an obstacle if all of these places lie beyond one of the obstacle's ends.
//
// The paths of vertices are cast. Then an edge of space meets nothing before a side of an obstacle, and a face nothing before a
// corner, or its own edges meet something (corridor/solid_sweep.h). So other parts of an obstacle need not be apart.

#include "response/clear_parts.h"

#include "predicates/hull_gap.h"
#include "proximity/obstacle_sides.h"

namespace dsw {
namespace {

/** Whether an edge or a face meets no obstacle whose ends are so beyond it. */
template <int D>
bool is_clear(uint32_t beyond, uint32_t vertices, uint32_t count) noexcept {
  using Sides = ObstacleSides<D>;
  if ((beyond & Sides::kApart) != 0) return true;
  if (D == 2 || count != 3) return false;
  bool misses = true;
  for (uint32_t k = 0; k < 3; ++k) {
    misses = misses && (vertices == 2 ? Sides::misses_side(beyond, k) : Sides::misses_corner(beyond, k));
  }
  return misses;
}

/** Whether the hull of all places of a part's vertices is certainly apart from an obstacle, along whatever direction. This costs a third of
 * what a sweep through cells does, and shows most parts to be clear that the obstacle's own directions do not. */
template <int D>
bool is_hull_apart(const Course<D>& course, const uint32_t* vertices, uint32_t count,
                   const ConvexHull& obstacle) noexcept {
  const Body<D>& body = *course.motion.body;
  ConvexHull places;
  for (uint32_t i = 0; i < count; ++i) {
    places.points[places.count++] = body.position(vertices[i]);
    if (course.moves(vertices[i])) places.points[places.count++] = course.motion.targets[vertices[i]];
  }
  return are_surely_apart<D>(places, obstacle);
}

}  // namespace

template <int D>
void find_clear_parts(const Environment<D>& env, const KnownObstacles<D>& known, Course<D>& course,
                      Array<uint16_t>& beyond) {
  constexpr uint32_t kApart = ObstacleSides<D>::kApart;
  const Body<D>& body = *course.motion.body;
  const auto count = static_cast<uint32_t>(body.vertices.size());
  Box<D> whole;
  for (uint32_t v = 0; v < count; ++v) {
    if (!body.has_vertex(v)) continue;
    whole.add(body.position(v));
    if (course.moves(v)) whole.add(course.motion.targets[v]);
  }
  if (!known.box.contains(whole.lower) || !known.box.contains(whole.upper)) return;
  course.all_clear = true;
  for (const WallFeature& obstacle : known.list.obstacles()) {
    const double* points[3] = {};
    for (uint32_t i = 0; i < obstacle.count; ++i) points[i] = env.point(obstacle.vertices[i]);
    if (!whole.overlaps(points, static_cast<int>(obstacle.count))) continue;
    const ObstacleSides<D> sides(points, obstacle.count);
    ConvexHull hull;
    for (; hull.count < obstacle.count; ++hull.count) hull.points[hull.count] = points[hull.count];
    beyond.assign(count, static_cast<uint16_t>(kApart));
    uint32_t all = kApart;
    for (uint32_t v = 0; v < count; ++v) {
      if (!body.has_vertex(v)) continue;
      uint32_t bits = sides.beyond(body.position(v), 0);
      if (course.moves(v)) bits &= sides.beyond(course.motion.targets[v], 0);
      beyond[v] = static_cast<uint16_t>(bits);
      all &= bits;
    }
    if (all != 0) continue;
    if (course.all_clear) {
      course.all_clear = false;
      course.clear_edges.assign(body.edges.size(), 1);
      course.clear_faces.assign(body.faces.size(), 1);
    }
    for (uint32_t e = 0; e < body.edges.size(); ++e) {
      const uint32_t(&ends)[2] = body.edges[e].ends;
      if (course.clear_edges[e] == 0 || !body.has_edge(e)) continue;
      if (is_clear<D>(beyond[ends[0]] & beyond[ends[1]], 2, obstacle.count)) continue;
      if (!is_hull_apart(course, ends, 2, hull)) course.clear_edges[e] = 0;
    }
    for (uint32_t f = 0; D == 3 && f < body.faces.size(); ++f) {
      if (course.clear_faces[f] == 0 || !body.has_face(f)) continue;
      const uint32_t(&corners)[3] = body.faces[f].corners;
      const uint32_t all_corners = beyond[corners[0]] & beyond[corners[1]] & beyond[corners[2]];
      if (is_clear<D>(all_corners, 3, obstacle.count)) continue;
      if (!is_hull_apart(course, corners, 3, hull)) course.clear_faces[f] = 0;
    }
  }
}

#define DSW_CLEAR_PARTS(D) \
  template void find_clear_parts(const Environment<D>&, const KnownObstacles<D>&, Course<D>&, Array<uint16_t>&)
DSW_CLEAR_PARTS(2);
DSW_CLEAR_PARTS(3);
#undef DSW_CLEAR_PARTS

}  // namespace dsw
