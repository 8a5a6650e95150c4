#include "walls/describe.h"

#include <algorithm>

#include "base/dimensions.h"
#include "contact/describe.h"
#include "contact/geometry.h"

namespace dsw {
namespace {

/** The part of a wall that touches. */
template <int D>
dsw_contact contact_of(const Environment<D>& env, const WallHit& hit, uint32_t vertex, const double* normal) noexcept {
  const Map<D>& map = env.map;
  const uint32_t other = hit.others[0];
  dsw_contact contact{};
  if (hit.wall.valid()) {
    name_wall(env, facing(env, hit.wall, normal), contact);
  } else {
    contact.front = volume_id(map, hit.cell);
    contact.marked_kind = other == kNone ? DSW_CELL_VERTEX : DSW_CELL_EDGE;
  }
  std::copy_n(normal, D, contact.normal);
  if (other == kNone) {
    name_vertex(map, vertex, contact);
  } else if constexpr (D == 3) {
    if (hit.others[1] != kNone) return contact;
    for (Dart d{hit.cell, 0}; d.local < map.shape(d.cell).dart_count(); ++d.local) {
      const uint32_t from = dart_vertex(map, d), to = dart_target(map, d);
      if (std::minmax(from, to) != std::minmax(vertex, other)) continue;
      name_edge(edge_id(map, d), contact);
      break;
    }
  }
  return contact;
}

}  // namespace

template <int D>
dsw_wall_contact describe(const Environment<D>& env, const Occupants<D>& all, const WallHit& hit, uint32_t vertex,
                          const double* from, const double* to, dsw_wall_response done) noexcept {
  const WallTouch touch = describe_touch(env, all, hit, from, to);
  dsw_wall_contact c{};
  std::copy_n(from, D, c.from);
  std::copy_n(to, D, c.to);
  c.time = hit.time;
  std::copy_n(touch.point, D, c.point);
  c.contact = contact_of(env, hit, vertex, touch.normal);
  c.edge_parameter = touch.along;
  c.moving = {vertex, env.map.vertex_generation(vertex)};
  for (int k = 0; k < 2 && hit.others[k] != kNone; ++k) {
    c.others[k] = {hit.others[k], env.map.vertex_generation(hit.others[k])};
  }
  c.response = done;
  name_feature(all, hit.feature, c);
  return c;
}

template <int D>
void name_feature(const Occupants<D>& all, const Feature& feature, dsw_wall_contact& contact) noexcept {
  if (feature.kind == Feature::kParticle) {
    contact.particle = {feature.index, all.particle_slots->generation(feature.index)};
    return;
  }
  const typename Occupants<D>::Owner& owner = all.bodies[feature.owner];
  contact.body = owner.id;
  if (feature.kind == Feature::kVertex) contact.vertex = vertex_id(*owner.body, feature.index);
  if (feature.kind == Feature::kEdge) contact.edge = edge_id(*owner.body, feature.index);
  if (feature.kind == Feature::kFace) contact.face = face_id(*owner.body, feature.index);
}

template dsw_wall_contact describe(const Environment<2>& env, const Occupants<2>& all, const WallHit& hit,
                                   uint32_t vertex, const double* from, const double* to,
                                   dsw_wall_response done) noexcept;
template dsw_wall_contact describe(const Environment<3>& env, const Occupants<3>& all, const WallHit& hit,
                                   uint32_t vertex, const double* from, const double* to,
                                   dsw_wall_response done) noexcept;
DSW_INSTANTIATE(name_feature);

}  // namespace dsw
