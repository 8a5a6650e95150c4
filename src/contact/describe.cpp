#include "contact/describe.h"

#include <algorithm>

#include "base/dimensions.h"

namespace dsw {

template <int D>
void name_obstacle(const Environment<D>& env, const WallFeature& touched, dsw_cell_kind marked,
                   dsw_contact& contact) noexcept {
  [[maybe_unused]] Cell front = touched.cell;
  if (touched.facet.valid()) {
    const HalfFacet wall = facing(env, touched.facet, contact.normal);
    name_wall(env, wall, contact);
    front = env.map.cell_of(wall);
  } else {
    contact.front = volume_id(env.map, front);
    contact.marked_kind = marked;
  }
  if (touched.count == 1) name_vertex(env.map, touched.vertices[0], contact);
  if constexpr (D == 3) {
    // A diagonal of a face is no edge of the cell.
    const Dart edge = touched.count == 2 ? dart_between(env.map, front, touched.vertices) : Dart{};
    if (edge.cell.valid()) name_edge(edge_id(env.map, edge), contact);
  }
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
dsw_body_contact describe(const Body<D>& body, uint32_t v, const double* to, const Touch& touch) {
  dsw_body_contact contact{};
  std::copy_n(body.position(v), D, contact.from);
  std::copy_n(to, D, contact.to);
  if (touch.part.kind != Simplex::kVertex) name_part(body, touch.part, contact);
  contact.vertex = vertex_id(body, v);
  if (touch.part.kind == Simplex::kEdge) {
    std::copy_n(body.position(body.edges[touch.part.index].other(v)), D, contact.fixed[0]);
  } else if (touch.part.kind == Simplex::kFace) {
    std::copy_n(body.position(body.faces[touch.part.index].after(v)), D, contact.fixed[0]);
    std::copy_n(body.position(body.faces[touch.part.index].before(v)), D, contact.fixed[1]);
  }
  std::copy_n(touch.position, D, contact.position);
  contact.time = touch.time;
  std::copy_n(touch.point, D, contact.point);
  contact.edge_parameter = touch.along;
  contact.contact = touch.other;
  return contact;
}

template <int D>
dsw_wall_contact describe(const Environment<D>& env, const WallFeature& wall, const double* from, const double* to,
                          const Touch& touch, dsw_wall_response response) noexcept {
  const auto id_of = [&](uint32_t v) { return dsw_vertex_id{v, env.map.vertex_generation(v)}; };
  dsw_wall_contact contact{};
  std::copy_n(from, D, contact.from);
  std::copy_n(to, D, contact.to);
  contact.time = touch.time;
  std::copy_n(touch.point, D, contact.point);
  contact.edge_parameter = touch.along;
  contact.contact = touch.other;
  contact.moving = id_of(wall.vertices[0]);
  for (uint32_t i = 1; i < wall.count; ++i) contact.others[i - 1] = id_of(wall.vertices[i]);
  contact.response = response;
  return contact;
}

template <int D>
Touch touch_of(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to, const SweepContact& met) {
  Touch touch = touch_of(env, body.position(v), to, met);
  touch.part = met.part;
  return touch;
}

template <int D>
dsw_body_contact describe_cast(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                               uint32_t edge, const double* end, const CastResult& hit) {
  // The cast is the flight of a particle along the edge, from its moving end.
  const double* const fixed = body.position(body.edges[edge].other(v));
  Touch touch = touch_of(env, end, fixed, path_contact(env, hit));
  touch.part = {Simplex::kEdge, edge};
  touch.along = touch.time;
  touch.time = 0;
  std::fill_n(touch.position, D, 0.0);
  return describe(body, v, to, touch);
}

uint64_t obstacle_key(const dsw_cell& obstacle) noexcept {
  return uint64_t{obstacle.index} << 32 | static_cast<uint64_t>(obstacle.kind) << 24 | (obstacle.local & 0xffffffu);
}

uint64_t part_key(const dsw_contact_partner& partner) noexcept {
  if (partner.vertex.generation != 0) return uint64_t{1} << 32 | partner.vertex.index;
  if (partner.edge.generation != 0) return uint64_t{2} << 32 | partner.edge.index;
  return uint64_t{3} << 32 | partner.face.index;
}

DSW_INSTANTIATE(name_obstacle);
DSW_INSTANTIATE(vertex_id);
template dsw_body_edge_id edge_id(const Body<2>& body, uint32_t e) noexcept;
template dsw_body_edge_id edge_id(const Body<3>& body, uint32_t e) noexcept;
template dsw_body_face_id face_id(const Body<2>& body, uint32_t f) noexcept;
template dsw_body_face_id face_id(const Body<3>& body, uint32_t f) noexcept;
template dsw_body_contact describe(const Body<2>& body, uint32_t v, const double* to, const Touch& touch);
template dsw_body_contact describe(const Body<3>& body, uint32_t v, const double* to, const Touch& touch);
template dsw_wall_contact describe(const Environment<2>& env, const WallFeature& wall, const double* from,
                                   const double* to, const Touch& touch, dsw_wall_response response) noexcept;
template dsw_wall_contact describe(const Environment<3>& env, const WallFeature& wall, const double* from,
                                   const double* to, const Touch& touch, dsw_wall_response response) noexcept;
template Touch touch_of(const Environment<2>& env, const Body<2>& body, uint32_t v, const double* to,
                        const SweepContact& met);
template Touch touch_of(const Environment<3>& env, const Body<3>& body, uint32_t v, const double* to,
                        const SweepContact& met);
DSW_INSTANTIATE(describe_cast);

}  // namespace dsw
