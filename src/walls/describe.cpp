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
  const uint32_t vertices[3] = {vertex, hit.others[0], hit.others[1]};
  const auto count = static_cast<uint32_t>(std::find(vertices, vertices + 3, kNone) - vertices);
  dsw_contact contact{};
  std::copy_n(normal, D, contact.normal);
  name_obstacle(env, {hit.wall, hit.cell, vertices, count, count == 1 ? DSW_CELL_VERTEX : DSW_CELL_EDGE}, contact);
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
  name_part(*owner.body, simplex_of(feature), contact);
}

template dsw_wall_contact describe(const Environment<2>& env, const Occupants<2>& all, const WallHit& hit,
                                   uint32_t vertex, const double* from, const double* to,
                                   dsw_wall_response done) noexcept;
template dsw_wall_contact describe(const Environment<3>& env, const Occupants<3>& all, const WallHit& hit,
                                   uint32_t vertex, const double* from, const double* to,
                                   dsw_wall_response done) noexcept;
DSW_INSTANTIATE(name_feature);

}  // namespace dsw
