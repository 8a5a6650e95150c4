#include "contact/describe.h"

#include <algorithm>

#include "base/dimensions.h"
#include "environment/marking.h"

namespace dsw {
namespace {

template <int D>
void name_obstacle(const Environment<D>& env, const SweepContact& met, dsw_contact& contact) {
  const Map<D>& map = env.map;
  contact.front = volume_id(map, met.front);
  if (met.facet.valid()) {
    contact.wall = face_id(map, canonical(map, met.facet));
    contact.cause = obstacle_kind(env, met.facet);
    const HalfFacet wall = seen_wall(env, met, contact.normal);
    contact.tag = obstacle_tag(env, wall, map.cell_of(wall));
  }
  switch (kind_of(met)) {
    case ContactKind::kVertex:
      contact.kind = DSW_CONTACT_VERTEX;
      contact.obstacle = {DSW_CELL_VERTEX, met.vertex, map.vertex_generation(met.vertex), 0};
      if (!met.facet.valid()) contact.cause = vertex_marked(env, met.vertex) ? DSW_CELL_VERTEX : DSW_CELL_EDGE;
      break;
    case ContactKind::kEdge:
      if constexpr (D == 3) {
        contact.kind = DSW_CONTACT_EDGE;
        const dsw_edge_id edge = edge_id(map, {met.front, met.dart});
        contact.obstacle = {DSW_CELL_EDGE, edge.volume, edge.generation, edge.local};
        if (!met.facet.valid()) contact.cause = DSW_CELL_EDGE;
      }
      break;
    case ContactKind::kPlane:
      contact.kind = DSW_CONTACT_PLANE;
      contact.obstacle = {DSW_CELL_FACE, contact.wall.volume, contact.wall.generation, contact.wall.local};
      break;
  }
}

/** What of a body touches on the way of v. */
template <int D>
dsw_contact name_parts(const Body<D>& body, uint32_t v, const double* to, uint32_t edge, uint32_t face) {
  dsw_contact contact{};
  std::copy_n(body.position(v), D, contact.from);
  std::copy_n(to, D, contact.to);
  contact.vertex = vertex_id(body, v);
  if (edge != kNone) {
    contact.edge = edge_id(body, edge);
    std::copy_n(body.position(body.edges[edge].other(v)), D, contact.fixed[0]);
  } else if (face != kNone) {
    contact.face = face_id(body, face);
    std::copy_n(body.position(body.faces[face].after(v)), D, contact.fixed[0]);
    std::copy_n(body.position(body.faces[face].before(v)), D, contact.fixed[1]);
  }
  return contact;
}

}  // namespace

template <int D>
dsw_body_vertex_id vertex_id(const Body<D>& body, uint32_t v) noexcept {
  return {v, body.vertex_slots.generation(v)};
}
template <int D>
dsw_body_edge_id edge_id(const Body<D>& body, uint32_t e) noexcept {
  return {e, body.edge_slots.generation(e)};
}
template <int D>
dsw_body_face_id face_id(const Body<D>& body, uint32_t f) noexcept {
  return {f, body.face_slots.generation(f)};
}

template <int D>
dsw_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                     const StarContact& met) {
  dsw_contact contact = name_parts(body, v, to, met.edge, met.face);
  const double* const from = body.position(v);
  const ContactGeometry geometry = contact_geometry(env, from, to, met.contact);
  contact.time = geometry.time;
  contact.along = geometry.along;
  std::copy_n(geometry.position, D, contact.position);
  std::copy_n(geometry.point, D, contact.point);
  std::copy_n(geometry.normal, D, contact.normal);
  name_obstacle(env, met.contact, contact);
  return contact;
}

template <int D>
dsw_contact describe_cast(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to, uint32_t edge,
                          const double* end, const CastResult& hit) {
  dsw_contact contact = name_parts(body, v, to, edge, kNone);
  const SweepContact met = path_contact(env, hit);
  // The cast is the flight of a particle along the edge, from its moving end.
  const ContactGeometry geometry = contact_geometry(env, end, contact.fixed[0], met);
  contact.along = geometry.time;
  std::copy_n(geometry.point, D, contact.point);
  std::copy_n(geometry.normal, D, contact.normal);
  name_obstacle(env, met, contact);
  return contact;
}

uint64_t obstacle_key(const dsw_contact& contact) noexcept {
  return uint64_t{contact.obstacle.index} << 32 | static_cast<uint64_t>(contact.obstacle.kind) << 24 |
         (contact.obstacle.local & 0xffffffu);
}

DSW_INSTANTIATE(vertex_id);
template dsw_body_edge_id edge_id(const Body<2>& body, uint32_t e) noexcept;
template dsw_body_edge_id edge_id(const Body<3>& body, uint32_t e) noexcept;
template dsw_body_face_id face_id(const Body<2>& body, uint32_t f) noexcept;
template dsw_body_face_id face_id(const Body<3>& body, uint32_t f) noexcept;
DSW_INSTANTIATE(describe);
DSW_INSTANTIATE(describe_cast);

}  // namespace dsw
