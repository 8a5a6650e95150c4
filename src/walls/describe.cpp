#include "walls/describe.h"

#include <algorithm>

#include "base/dimensions.h"
#include "contact/describe.h"
#include "contact/geometry.h"

namespace dsw {
template <int D>
dsw_wall_contact describe(const Environment<D>& env, const Occupants<D>& all, const WallHit& hit, uint32_t vertex,
                          const double* from, const double* to, dsw_wall_response done) noexcept {
  const WallTouch touch = describe_touch(env, all, hit, from, to);
  dsw_wall_contact c{};
  std::copy_n(from, D, c.from);
  std::copy_n(to, D, c.to);
  c.time = hit.time;
  std::copy_n(touch.point, D, c.point);
  std::copy_n(touch.normal, D, c.normal);
  c.along = touch.along;
  c.moving = {vertex, env.map.vertex_generation(vertex)};
  for (int k = 0; k < 2 && hit.others[k] != kNone; ++k) {
    c.others[k] = {hit.others[k], env.map.vertex_generation(hit.others[k])};
  }
  c.response = done;
  name_wall(env, facing(env, hit.wall, touch.normal), c);
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

template <int D>
void name_wall(const Environment<D>& env, HalfFacet wall, dsw_wall_contact& contact) noexcept {
  if (!wall.valid()) return;
  contact.wall = face_id(env.map, canonical(env.map, wall));
  contact.tag = obstacle_tag(env, wall, env.map.cell_of(wall));
}

template dsw_wall_contact describe(const Environment<2>& env, const Occupants<2>& all, const WallHit& hit,
                                   uint32_t vertex, const double* from, const double* to,
                                   dsw_wall_response done) noexcept;
template dsw_wall_contact describe(const Environment<3>& env, const Occupants<3>& all, const WallHit& hit,
                                   uint32_t vertex, const double* from, const double* to,
                                   dsw_wall_response done) noexcept;
DSW_INSTANTIATE(name_feature);
DSW_INSTANTIATE(name_wall);

}  // namespace dsw
