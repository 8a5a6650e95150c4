#include "contact/describe_thick.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/vec.h"
#include "environment/marking.h"

namespace dsw {
namespace {

constexpr double kLeastWeight = 0x1p-46;

/** The corners of what came too near that its nearest point lies between. Returns how many. */
template <int D>
uint32_t find_corners(const TooNear<D>& near, uint32_t* corners) noexcept {
  uint32_t count = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    if (near.vertices[i] != kNone && near.weights[i] > kLeastWeight) corners[count++] = near.vertices[i];
  }
  return count;
}

}  // namespace

template <int D>
dsw_body_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                          const TooNear<D>& near) {
  dsw_body_contact contact{};
  std::copy_n(body.position(v), D, contact.from);
  std::copy_n(to, D, contact.to);
  contact.vertex = vertex_id(body, v);
  contact.time = near.time;
  point_at<D>(contact.from, to, near.time, contact.position);
  Vec point = near.shares[0] * to_vec<D>(contact.position);
  const bool is_of_vertex = near.shares[0] > 1 - kLeastWeight;
  uint32_t count = 0;
  for (const uint32_t corner : SimplexCorners<D>(body, near.part)) {
    if (corner == v) continue;
    const double* const at = body.position(corner);
    if (!is_of_vertex) std::copy_n(at, D, contact.fixed[count]);
    point += near.shares[++count] * to_vec<D>(at);
  }
  if (near.part.kind == Simplex::kEdge && !is_of_vertex) {
    contact.edge = edge_id(body, near.part.index);
    contact.edge_parameter = near.shares[1];
  }
  if (near.part.kind == Simplex::kFace && !is_of_vertex) contact.face = face_id(body, near.part.index);
  store<D>(point, contact.point);
  store<D>(near.normal + Vec::Zero(), contact.contact.normal);  // never -0
  if (near.partner == kNone) {
    uint32_t corners[3];
    const uint32_t corner_count = find_corners(near, corners);
    const dsw_cell_kind marked = near.vertices[1] == kNone ? DSW_CELL_VERTEX : DSW_CELL_EDGE;
    name_obstacle(env, {near.facet, near.cell, corners, corner_count, marked}, contact.contact);
  } else {
    contact.contact.front = volume_id(env.map, body.vertices[v].cell);
    contact.contact.kind = contact_kind(near.other.kind);
  }
  return contact;
}

template <int D>
dsw_contact_partner partner_of(const Partners<D>* partners, const TooNear<D>& near) noexcept {
  return near.partner == kNone ? dsw_contact_partner{} : name_partner(partners->all[near.partner], near.other);
}

template dsw_body_contact describe(const Environment<2>& env, const Body<2>& body, uint32_t v, const double* to,
                                   const TooNear<2>& near);
template dsw_body_contact describe(const Environment<3>& env, const Body<3>& body, uint32_t v, const double* to,
                                   const TooNear<3>& near);
template dsw_contact_partner partner_of(const Partners<2>* partners, const TooNear<2>& near) noexcept;
template dsw_contact_partner partner_of(const Partners<3>* partners, const TooNear<3>& near) noexcept;

}  // namespace dsw
