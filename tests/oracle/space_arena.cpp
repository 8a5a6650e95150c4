#include "space_arena.h"

#include "sweep_truth.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace dsw::oracle {

SpaceArena::SpaceArena(World& world, const std::vector<std::array<int, 2>>& marked_edges,
                       const std::vector<int>& marked_vertices)
    : Arena(3, std::make_unique<SweepWorld>(world, marked_edges, marked_vertices)), world_(world) {
  for (size_t c = 0; c < world.mesh.cells.size(); ++c) {
    uint32_t local = 0;
    for (const auto& e : cell_edges(world.mesh.cells[c])) {
      const dsw_volume_id owner = world.ids[c];
      edges_.insert({{std::min(e[0], e[1]), std::max(e[0], e[1])}, {owner.index, owner.generation, local++}});
    }
  }
  for (const Triangle& t : world.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const int a = t.v[k], b = t.v[(k + 1) % 3];
      faces_at_[{std::min(a, b), std::max(a, b)}].push_back(t.face);
      faces_at_vertex_[a].push_back(t.face);
    }
  }
}

Arena::Wall SpaceArena::wall(int face) const {
  const Face& f = world_.faces[static_cast<size_t>(face)];
  return {{f.cell[0], f.cell[1]}, f.marked};
}

int SpaceArena::face_of(const SweepEvent& event) const {
  return world_.triangles[static_cast<size_t>(event.triangle)].face;
}

Arena::Wall SpaceArena::met(const SweepEvent& event) const {
  const Triangle& t = world_.triangles[static_cast<size_t>(event.triangle)];
  return {{t.cell[0], t.cell[1]}, world_.faces[static_cast<size_t>(t.face)].marked};
}

bool SpaceArena::normal_fits(const SweepEvent& event, const double* normal) const {
  double tolerance = 0;
  const Vec n = world_.unit_normal(event.triangle, &tolerance);
  for (size_t k = 0; k < 3; ++k) {
    if (!(std::fabs(normal[k] - (event.side > 0 ? -n[k] : n[k])) <= tolerance)) return false;
  }
  return true;
}

std::vector<int> SpaceArena::faces_round(const SweepEvent& event) const { return faces_at_.at({event.a, event.b}); }

std::array<Vec, 2> SpaceArena::ends_of(const SweepEvent& event) const {
  const std::vector<Vec>& points = world_.mesh.points;
  return {points[static_cast<size_t>(event.a)], points[static_cast<size_t>(event.b)]};
}

std::string SpaceArena::wrong_name(const SweepEvent& event, const dsw_sweep& got) const {
  const auto real = edges_.find({event.a, event.b});
  if (real == edges_.end()) {
    return got.contact.kind == DSW_CONTACT_PLANE && names_wall(got.contact)
               ? ""
               : " kind " + std::to_string(got.contact.kind) + " at a diagonal";
  }
  const dsw_edge_id want = real->second;
  if (got.contact.kind != DSW_CONTACT_EDGE) return " kind " + std::to_string(got.contact.kind);
  if (got.contact.obstacle.kind != DSW_CELL_EDGE || got.contact.obstacle.index != want.volume ||
      got.contact.obstacle.generation != want.generation || got.contact.obstacle.local != want.local) {
    return " edge " + name(got.contact.obstacle) + " for " + name(want);
  }
  return "";
}

/// A face's inside on a vertex of the environment.
std::string SpaceArena::wrong_at_face(const VertexMove& f, const SweepEvent& e, const dsw_body_contact& c,
                                      const dsw_sweep& wall) const {
  const Vec& site = world_.mesh.points[static_cast<size_t>(e.vertex)];
  std::string wrong = wrong_wall(wall, faces_at_vertex_.at(e.vertex), {DSW_CELL_EDGE, DSW_CELL_VERTEX});
  if (c.edge_parameter != 0) wrong += " along is set";
  double most = 0;
  for (const Vec* p : {&f.from, &f.to, &f.fixed[0], &f.fixed[1], &site}) {
    for (double x : *p) most = std::max(most, std::fabs(x));
  }
  if (!(most < DBL_MAX / 4)) return wrong;
  for (size_t k = 0; k < 3; ++k) {
    if (!(std::fabs(c.point[k] - site[k]) <= 32 * DBL_EPSILON * most)) wrong += " point " + hex(c.point);
  }
  const int scale = -std::ilogb(most);
  Vec n, sides[2], motion;
  for (size_t k = 0; k < 3; ++k) {
    motion[k] = std::ldexp(f.to[k], scale) - std::ldexp(f.from[k], scale);
    const double at = std::ldexp(f.from[k], scale) + e.time * motion[k];
    for (size_t i = 0; i < 2; ++i) sides[i][k] = std::ldexp(f.fixed[i][k], scale) - at;
  }
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = sides[0][i] * sides[1][j] - sides[0][j] * sides[1][i];
  }
  const double against = dot(n, motion), size = length(n);
  const double tolerance = 1e-14 * (length(sides[0]) + length(sides[1])) / size + 1e-13;
  // A motion in the face's plane, and a face that is no wider than rounding, leave the side to rounding.
  if (!(size > 0) || !(tolerance < 1e-4) || !(std::fabs(against) > tolerance * size)) return wrong;
  for (size_t k = 0; k < 3; ++k) {
    const double want = against > 0 ? -n[k] / size : n[k] / size;
    if (!(std::fabs(c.contact.normal[k] - want) <= tolerance)) wrong += " normal " + hex(c.contact.normal);
  }
  return wrong;
}

std::string SpaceArena::second_normal(const Sweep& s) {
  const SweepTruth& t = s.truth;
  const Walk walk = world_.cast(world_.body(s.from.data()), world_.body(s.to.data()), t.start);
  const bool fits = t.path_hit == (walk.outcome == Walk::kContact) && t.path.size() <= 1 &&
                    (!t.path_hit || (walk.triangle == t.path[0].triangle && walk.time == t.path[0].time));
  return fits ? "" : " the path is not that of the oracle's cast";
}

}  // namespace dsw::oracle
