// Why the contact is that of a flood. Let the body's edge keep to its corridor until it comes to an edge of the
// environment, the line. So nothing is met before. Just before, the edge passes facets at the line: these and the cells
// between them are the fan from which the edge comes. A flood sees the two walls that end this fan, and no other wall
// at the line that counts if corridor/fan.h says so. Of the two the first in the order of contacts counts.

#include "sweep/touched_line.h"

#include <algorithm>
#include <new>
#include <utility>

#include "base/search.h"
#include "corridor/fan.h"
#include "environment/marking.h"
#include "predicates/filtered.h"
#include "predicates/point_box.h"
#include "predicates/swept_triangle.h"
#include "predicates/tally.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

/** Gives the slot for what an edge has touched while one end moves, and makes it if there is none; null: there is no
 * memory. */
TouchedLines* make_lines(const Body<3>& body, uint32_t e, uint32_t v) noexcept {
  try {
    if (body.touched.size() < 2 * body.edges.size()) body.touched.resize(2 * body.edges.size());
  } catch (const std::bad_alloc&) {  // nothing is kept
    return nullptr;
  }
  return lines_of(body, e, v);
}

bool pierces(const Environment<3>& env, const SweptTriangle& triangle, const RidgeName& line) noexcept {
  const double *const a = env.point(line.vertices[0]), *const b = env.point(line.vertices[1]);
  const int side_a = triangle.side(a), side_b = triangle.side(b);
  return side_a != side_b && !triangle.leaves(a, b, side_b);
}

/** The contact with the line at a wall. */
SweepContact contact_at(const Environment<3>& env, const EdgeMotion& m, HalfFacet wall,
                        const RidgeName& line) noexcept {
  const Map<3>& map = env.map;
  SweepContact contact;
  contact.front = tetrahedron_of(wall);
  contact.facet = wall;
  contact.simplex = local_in_tetrahedron(wall);
  const uint8_t(&local)[3] = kTetrahedronFacets[contact.simplex];
  const uint32_t* const w = map.record(contact.front);
  uint32_t corners[3], k = 0;
  const double* at[3];
  for (int i = 0; i < 3; ++i) {
    corners[i] = w[local[i]] & kVertexMask;
    at[i] = env.point(corners[i]);
  }
  const auto is_of_line = [&](uint32_t vertex) { return vertex == line.vertices[0] || vertex == line.vertices[1]; };
  while (!is_of_line(corners[k]) || !is_of_line(corners[(k + 1) % 3])) ++k;
  contact.dart = 3 * contact.simplex + k;
  contact.faces_start = plane_side<3>(at, m.p, NoTally{}).sign < 0;
  contact.event = {{m.q, at[k], at[(k + 1) % 3]}, EventKind::kEdge};
  return contact;
}

/** The fan round a line that has a facet. False: not known, or it has no walls. */
bool find_fan(const Environment<3>& env, const EdgeMotion& m, HalfFacet passed, const RidgeName& line,
              TouchedLines::Fan& fan) noexcept {
  fan.walls[0] = find_wall(env, passed, line.vertices);
  if (!fan.walls[0].valid()) return false;
  fan.walls[1] = find_wall(env, env.map.opposite(passed), line.vertices);
  if (!fan.walls[1].valid()) return false;
  SweepContact first = contact_at(env, m, fan.walls[0], line), second = contact_at(env, m, fan.walls[1], line);
  first.faces_start = second.faces_start = true;
  if (comes_before(env.map, m.p, m.to, second, first)) std::swap(fan.walls[0], fan.walls[1]);
  // Parts of the environment that touch each other in the line alone have names of their own for it.
  fan.lowest = lowest_dart_round(env.map, {first.front, first.dart});
  fan.is_alone = is_alone(env, fan.walls, line.vertices);
  fan.passed = passed;
  fan.version = env.change_version;
  return true;
}

}  // namespace

void keep_touched_line(const Environment<3>& env, const Body<3>& body, uint32_t e, uint32_t v,
                       const SweepContact& contact) noexcept {
  if (contact.event.kind != EventKind::kEdge || !contact.facet.valid() || contact.dart == kNoFacet) return;
  const auto vertex = [&](int i) { return static_cast<uint32_t>((contact.event.points[i] - env.points) / 3); };
  TouchedLines* const kept = make_lines(body, e, v);
  if (kept != nullptr) kept->note({{std::min(vertex(1), vertex(2)), std::max(vertex(1), vertex(2))}}, body.call);
}

bool pierces_touched_line(const Environment<3>& env, const Body<3>& body, const MovingPart& edge) noexcept {
  const TouchedLines* const kept = lines_of(body, edge.part.index, edge.vertex);
  if (kept == nullptr || !kept->lines[0].is_known()) return false;
  const EdgeMotion m = edge.edge();
  const PointBox<3> box(m.p, m.to, m.q);
  RidgeName near[TouchedLines::kCount];
  uint32_t count = 0;
  for (const RidgeName& line : kept->lines) {
    // One of a snapshot may hold any numbers.
    if (!line.is_known() || std::max(line.vertices[0], line.vertices[1]) >= env.map.vertex_count) continue;
    if ((box.beyond(env.point(line.vertices[0])) & box.beyond(env.point(line.vertices[1]))) == 0) near[count++] = line;
  }
  if (count == 0) return false;
  const SweptTriangle triangle(m);
  return dsw::any_of(near, near + count, [&](const RidgeName& line) {
    return pierces(env, triangle, line) && !edge_marked(env, line.vertices[0], line.vertices[1]);
  });
}

bool meets_first(const Environment<3>& env, const Body<3>& body, const MovingPart& edge, const FirstRidge& ridge,
                 SweepContact* found) noexcept {
  const RidgeName& line = ridge.ridge;
  if (env.marked_edges != 0 && edge_marked(env, line.vertices[0], line.vertices[1])) return false;
  const EdgeMotion m = edge.edge();
  TouchedLines* kept = lines_of(body, edge.part.index, edge.vertex);
  TouchedLines::Fan fan;
  if (kept != nullptr && kept->knows_fan(line, ridge.facet, env.change_version)) {
    fan = kept->fan;
  } else {
    if (!find_fan(env, m, ridge.facet, line, fan)) return false;
    kept = make_lines(body, edge.part.index, edge.vertex);
    if (kept != nullptr) {
      kept->note(line, body.call);
      kept->fan = fan;
    }
  }
  if (!fan.is_alone && !sees_only_fan(env, SweptTriangle(m), fan.walls, line.vertices)) return false;
  *found = contact_at(env, m, fan.walls[0], line);
  if (!found->faces_start) {
    const SweepContact second = contact_at(env, m, fan.walls[1], line);
    if (second.faces_start) *found = second;
  }
  found->lowest = fan.lowest;
  return true;
}

}  // namespace dsw
