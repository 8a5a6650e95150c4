#include "contact/describe.h"

#include <algorithm>

#include "base/dimensions.h"
#include "environment/marking.h"

namespace dsw {
namespace {

/** What of a body touches on the way of v. */
template <int D>
dsw_body_contact name_parts(const Body<D>& body, uint32_t v, const double* to, uint32_t edge, uint32_t face) {
  dsw_body_contact contact{};
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
void name_obstacle(const Environment<D>& env, const TouchedObstacle& touched, dsw_contact& contact) noexcept {
  [[maybe_unused]] Cell front = touched.cell;
  if (touched.facet.valid()) {
    const HalfFacet wall = facing(env, touched.facet, contact.normal);
    name_wall(env, wall, contact);
    front = env.map.cell_of(wall);
  } else {
    contact.front = volume_id(env.map, front);
    contact.marked_kind = touched.marked;
  }
  if (touched.count == 1) name_vertex(env.map, touched.vertices[0], contact);
  if constexpr (D == 3) {
    // A diagonal of a face is no edge of the cell.
    const Dart edge = touched.count == 2 ? dart_between(env.map, front, touched.vertices) : Dart{};
    if (edge.cell.valid()) name_edge(edge_id(env.map, edge), contact);
  }
}

template <int D>
dsw_contact contact_of(const Environment<D>& env, const SweepContact& met, const double* normal) noexcept {
  dsw_contact contact{};
  std::copy_n(normal, D, contact.normal);
  if (met.facet.valid()) name_wall(env, seen_wall(env, met.front, met.facet, normal), contact);
  contact.front = volume_id(env.map, met.front);
  const bool has_wall = met.facet.valid();
  switch (kind_of(met)) {
    case ContactKind::kVertex:
      name_vertex(env.map, met.vertex, contact);
      if (!has_wall) contact.marked_kind = vertex_marked(env, met.vertex) ? DSW_CELL_VERTEX : DSW_CELL_EDGE;
      break;
    case ContactKind::kEdge:
      if constexpr (D == 3) {
        const bool is_named = met.lowest.cell.valid();
        name_edge(is_named ? id_of_lowest(env.map, met.lowest) : edge_id(env.map, {met.front, met.dart}), contact);
      }
      if (!has_wall) contact.marked_kind = DSW_CELL_EDGE;
      break;
    case ContactKind::kPlane:
      break;
  }
  return contact;
}

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
dsw_body_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                          const StarContact& met) {
  dsw_body_contact contact = name_parts(body, v, to, met.edge, met.face);
  const double* const from = body.position(v);
  const ContactGeometry geometry = contact_geometry(env, from, to, met.contact);
  contact.time = geometry.time;
  contact.edge_parameter = geometry.along;
  std::copy_n(geometry.position, D, contact.position);
  std::copy_n(geometry.point, D, contact.point);
  contact.contact = contact_of(env, met.contact, geometry.normal);
  return contact;
}

template <int D>
dsw_body_contact describe_cast(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                               uint32_t edge, const double* end, const CastResult& hit) {
  dsw_body_contact contact = name_parts(body, v, to, edge, kNone);
  const SweepContact met = path_contact(env, hit);
  // The cast is the flight of a particle along the edge, from its moving end.
  const ContactGeometry geometry = contact_geometry(env, end, contact.fixed[0], met);
  contact.edge_parameter = geometry.time;
  std::copy_n(geometry.point, D, contact.point);
  contact.contact = contact_of(env, met, geometry.normal);
  return contact;
}

uint64_t obstacle_key(const dsw_cell& obstacle) noexcept {
  return uint64_t{obstacle.index} << 32 | static_cast<uint64_t>(obstacle.kind) << 24 | (obstacle.local & 0xffffffu);
}

DSW_INSTANTIATE(contact_of);
DSW_INSTANTIATE(name_obstacle);
DSW_INSTANTIATE(vertex_id);
template dsw_body_edge_id edge_id(const Body<2>& body, uint32_t e) noexcept;
template dsw_body_edge_id edge_id(const Body<3>& body, uint32_t e) noexcept;
template dsw_body_face_id face_id(const Body<2>& body, uint32_t f) noexcept;
template dsw_body_face_id face_id(const Body<3>& body, uint32_t f) noexcept;
DSW_INSTANTIATE(describe);
DSW_INSTANTIATE(describe_cast);

}  // namespace dsw
