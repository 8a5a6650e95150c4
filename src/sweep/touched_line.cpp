// Why the contact is that of a flood. Let an edge of the environment, the line, pierce the swept triangle, and let the
// body's edge keep to its sequence until it comes to the line. So nothing is met before. Just before, the edge passes
// facets at the line: these and the cells between them are the fan from which the edge comes. A flood sees the two
// walls that end this fan, and no other wall at the line if flood/fan.h says so. Of the two the first in the order of
// contacts counts.

#include "sweep/touched_line.h"

#include <algorithm>
#include <new>

#include "environment/marking.h"
#include "flood/fan.h"
#include "predicates/filtered.h"
#include "predicates/point_box.h"
#include "predicates/swept_triangle.h"
#include "predicates/tally.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

TouchedLines* lines_of(const Body<3>& body, const EdgeSweep& sweep) noexcept {
  const size_t slot = 2 * size_t{sweep.e} + body.edges[sweep.e].side_of(sweep.v);
  return slot < body.touched.size() ? &body.touched[slot] : nullptr;
}

bool pierces(const Environment<3>& env, const SweptTriangle& triangle, const TouchedLine& line) noexcept {
  const double *const a = env.point(line.vertices[0]), *const b = env.point(line.vertices[1]);
  const int side_a = triangle.side(a), side_b = triangle.side(b);
  return side_a != side_b && !triangle.leaves(a, b, side_b);
}

/** The contact with the line at a wall. */
SweepContact contact_at(const Environment<3>& env, const EdgeMotion& m, HalfFacet wall,
                        const TouchedLine& line) noexcept {
  const Map<3>& map = env.map;
  SweepContact contact;
  contact.front = map.cell_of(wall);
  contact.facet = wall;
  contact.simplex = map.local_of(wall, contact.front);
  const uint8_t(&local)[3] = kTetrahedronFacets[contact.simplex];
  uint32_t corners[3], k = 0;
  const double* at[3];
  for (int i = 0; i < 3; ++i) {
    corners[i] = map.vertex(contact.front, local[i]);
    at[i] = env.point(corners[i]);
  }
  const auto is_of_line = [&](uint32_t vertex) { return vertex == line.vertices[0] || vertex == line.vertices[1]; };
  while (!is_of_line(corners[k]) || !is_of_line(corners[(k + 1) % 3])) ++k;
  contact.dart = 3 * contact.simplex + k;
  contact.faces_start = plane_side<3>(at, m.p, NoTally{}).sign < 0;
  contact.event = {{m.q, at[k], at[(k + 1) % 3]}, EventKind::kEdge};
  return contact;
}

}  // namespace

void keep_touched_line(const Environment<3>& env, const Body<3>& body, uint32_t e, uint32_t v,
                       const SweepContact& contact) noexcept {
  if (contact.event.kind != EventKind::kEdge || !contact.facet.valid() || contact.dart == kNoFacet) return;
  const auto vertex = [&](int i) { return static_cast<uint32_t>((contact.event.points[i] - env.points) / 3); };
  try {
    if (body.touched.size() < 2 * body.edges.size()) body.touched.resize(2 * body.edges.size());
  } catch (const std::bad_alloc&) {  // nothing is kept
    return;
  }
  TouchedLines& kept = body.touched[2 * size_t{e} + body.edges[e].side_of(v)];
  kept.version = ~uint64_t{0};
  TouchedLine* const lines = kept.lines;
  TouchedLine line;
  line.vertices[0] = std::min(vertex(1), vertex(2));
  line.vertices[1] = std::max(vertex(1), vertex(2));
  // Moves to the front; if it is new, the last one is dropped.
  const auto is_same = [&](const TouchedLine& each) {
    return std::equal(line.vertices, line.vertices + 2, each.vertices);
  };
  TouchedLine* const last = std::find_if(lines, lines + TouchedLines::kCount - 1, is_same);
  std::copy_backward(lines, last, last + 1);
  lines[0] = line;
}

PiercedLine find_pierced_line(const Environment<3>& env, const Body<3>& body, const EdgeSweep& sweep) noexcept {
  PiercedLine pierced;
  TouchedLines* const kept = lines_of(body, sweep);
  if (kept == nullptr || !kept->lines[0].is_known()) return pierced;
  const EdgeMotion m{body.position(sweep.v), sweep.to, sweep.q};
  const PointBox<3> box(m.p, m.to, m.q);
  uint32_t near = 0;
  for (uint32_t i = 0; i < TouchedLines::kCount && kept->lines[i].is_known(); ++i) {
    const uint32_t(&ends)[2] = kept->lines[i].vertices;
    if (std::max(ends[0], ends[1]) >= env.map.vertex_count) continue;
    if ((box.beyond(env.point(ends[0])) & box.beyond(env.point(ends[1]))) == 0) near |= 1u << i;
  }
  if (near == 0) return pierced;
  const SweptTriangle triangle(m);
  uint32_t first = 0;
  for (; near != 0; near &= near - 1) {
    const uint32_t i = static_cast<uint32_t>(__builtin_ctz(near));
    const TouchedLine& line = kept->lines[i];
    const uint32_t(&ends)[2] = line.vertices;
    if (!pierces(env, triangle, line) || edge_marked(env, ends[0], ends[1])) continue;
    const SweepEvent event{{m.q, env.point(ends[0]), env.point(ends[1])}, EventKind::kEdge};
    if (pierced && compare_events<3>(m.p, m.to, event, pierced.event).sign >= 0) continue;
    pierced = {kept, event};
    first = i;
  }
  if (pierced) kept->come_first(first);
  return pierced;
}

bool meets_first(const Environment<3>& env, const Body<3>& body, const EdgeSweep& sweep, const PiercedLine& pierced,
                 SweepContact* found, EdgeScratch<3>& scratch) {
  TouchedLines& kept = *pierced.kept;
  const TouchedLine& line = kept.lines[0];
  HalfFacet passed;
  if (!is_free_before(env, body, sweep, pierced.event, scratch, &passed) || !passed.valid()) return false;
  const HalfFacet walls[2] = {find_wall(env, passed, line.vertices),
                              find_wall(env, env.map.opposite(passed), line.vertices)};
  if (!walls[0].valid() || !walls[1].valid()) return false;
  const EdgeMotion m{body.position(sweep.v), sweep.to, sweep.q};
  if (!sees_only_fan(env, SweptTriangle(m), walls, line.vertices)) return false;
  *found = contact_at(env, m, walls[0], line);
  const SweepContact second = contact_at(env, m, walls[1], line);
  if (comes_before(env.map, m.p, m.to, second, *found)) *found = second;
  // Parts of the environment that touch each other in the line alone have names of their own for it.
  const uint32_t wall = std::min(walls[0].word, walls[1].word);
  if (kept.version != env.obstacle_version || kept.wall != wall) {
    kept.lowest = lowest_dart_round(env.map, {found->front, found->dart});
    kept.wall = wall;
    kept.version = env.obstacle_version;
  }
  found->lowest = kept.lowest;
  return true;
}

}  // namespace dsw
