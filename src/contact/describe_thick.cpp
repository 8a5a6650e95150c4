// What comes too near to a thick body.

#include <algorithm>

#include "base/vec.h"
#include "contact/describe.h"

namespace dsw {
namespace {

constexpr double kLeastWeight = 0x1p-46;

/** What came too near, with the corners alone that its nearest point lies between. */
template <int D>
WallFeature wall_of(const TooNear<D>& near) noexcept {
  WallFeature wall{{kNone, kNone, kNone}, 0, near.facet, near.cell};
  for (uint32_t i = 0; i < near.count; ++i) {
    if (near.weights[i] > kLeastWeight) wall.vertices[wall.count++] = near.vertices[i];
  }
  return wall;
}

}  // namespace

template <int D>
Touch touch_of(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to, const TooNear<D>& near) {
  Touch touch;
  touch.time = near.time;
  point_at<D>(body.position(v), to, near.time, touch.position);
  Vec point = near.shares[0] * to_vec<D>(touch.position);
  uint32_t count = 0;
  for (const uint32_t corner : SimplexCorners<D>(body, near.part)) {
    if (corner != v) point += near.shares[++count] * to_vec<D>(body.position(corner));
  }
  store<D>(point, touch.point);
  if (!(near.shares[0] > 1 - kLeastWeight)) touch.part = near.part;
  if (touch.part.kind == Simplex::kEdge) touch.along = near.shares[1];
  store<D>(near.normal + Vec::Zero(), touch.other.normal);  // never -0
  if (near.partner == kNone) {
    name_obstacle(env, wall_of(near), near.count == 1 ? DSW_CELL_VERTEX : DSW_CELL_EDGE, touch.other);
  } else {
    touch.other.front = volume_id(env.map, body.vertices[v].cell);
    touch.other.kind = contact_kind(near.other.kind);
  }
  return touch;
}

template <int D>
dsw_body_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                          const TooNear<D>& near) {
  const Touch touch = touch_of(env, body, v, to, near);
  dsw_body_contact contact = describe(body, v, to, touch);
  uint32_t count = 0;
  for (const uint32_t corner : SimplexCorners<D>(body, near.part)) {
    if (touch.part.kind == Simplex::kFace && corner != v) std::copy_n(body.position(corner), D, contact.fixed[count++]);
  }
  return contact;
}

template dsw_body_contact describe(const Environment<2>& env, const Body<2>& body, uint32_t v, const double* to,
                                   const TooNear<2>& near);
template dsw_body_contact describe(const Environment<3>& env, const Body<3>& body, uint32_t v, const double* to,
                                   const TooNear<3>& near);
template Touch touch_of(const Environment<2>& env, const Body<2>& body, uint32_t v, const double* to,
                        const TooNear<2>& near);
template Touch touch_of(const Environment<3>& env, const Body<3>& body, uint32_t v, const double* to,
                        const TooNear<3>& near);

}  // namespace dsw
