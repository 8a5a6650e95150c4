#include "walls/describe.h"

#include <algorithm>

#include "base/dimensions.h"
#include "contact/describe.h"

namespace dsw {

template <int D>
dsw_wall_contact describe(const Environment<D>& env, const Occupants<D>& all, const WallHit& hit, const double* from,
                          const double* to, dsw_wall_response done) noexcept {
  WallHit touch = hit;
  measure(env, all, from, to, touch);
  name_obstacle(env, hit.wall, hit.wall.count == 1 ? DSW_CELL_VERTEX : DSW_CELL_EDGE, touch.other);
  dsw_wall_contact contact = describe(env, hit.wall, from, to, touch, done);
  name_feature(all, hit.feature, contact);
  return contact;
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
                                   const double* from, const double* to, dsw_wall_response done) noexcept;
template dsw_wall_contact describe(const Environment<3>& env, const Occupants<3>& all, const WallHit& hit,
                                   const double* from, const double* to, dsw_wall_response done) noexcept;
DSW_INSTANTIATE(name_feature);

}  // namespace dsw
