#pragma once
// A contact of a body as a host reads it.

#include "contact/geometry.h"
#include "contact/names.h"
#include "contact/touch.h"
#include "corridor/candidates.h"
#include "sweep/star.h"

namespace dsw {

template <int D>
dsw_body_vertex_id vertex_id(const Body<D>& body, uint32_t v) noexcept;
template <int D>
dsw_body_edge_id edge_id(const Body<D>& body, uint32_t e) noexcept;
template <int D>
dsw_body_face_id face_id(const Body<D>& body, uint32_t f) noexcept;

/** Names a part of a body in a report, which has a `vertex`, an `edge` and a `face` of one. */
template <int D, class Report>
void name_part(const Body<D>& body, const Simplex& part, Report& report) noexcept {
  if (part.kind == Simplex::kVertex) report.vertex = vertex_id(body, part.index);
  if (part.kind == Simplex::kEdge) report.edge = edge_id(body, part.index);
  if (part.kind == Simplex::kFace) report.face = face_id(body, part.index);
}

/** Names a part of a body that is touched. */
template <int D>
dsw_contact_partner name_partner(const Partner<D>& of, const Simplex& part) noexcept {
  dsw_contact_partner partner{};
  partner.body = {of.index, of.generation};
  name_part(*of.body, part, partner);
  return partner;
}
inline dsw_contact_kind contact_kind(Simplex::Kind touched) noexcept {
  return touched == Simplex::kVertex ? DSW_CONTACT_VERTEX
         : touched == Simplex::kEdge ? DSW_CONTACT_EDGE
                                     : DSW_CONTACT_PLANE;
}

/** Names in a contact, which has its normal, what of the environment is touched: a corner, a side or the whole of a wall,
 * or something thin that is marked.
 * @param touched with the vertices between which it is touched.
 * @param marked what is marked, if there is no wall. */
template <int D>
void name_obstacle(const Environment<D>& env, const WallFeature& touched, dsw_cell_kind marked,
                   dsw_contact& contact) noexcept;

/** What vertex v, or a part at it, touches on its way to `to`: of the environment, of a body, or of what comes too near. */
template <int D>
Touch touch_of(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to, const SweepContact& met);
template <int D>
Touch touch_of(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to, const PairContact<D>& met);
template <int D>
Touch touch_of(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to, const TooNear<D>& near);

/** The unit normal, out of a body, where a point on its way from p to `to` touches the body. */
template <int D>
Vec normal_on_way(const double* p, const double* to, const PairContact<D>& met);

/** All but `distance_left` and `history` of the contact that vertex v met on its way to `to`. */
template <int D, class Met>
dsw_body_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                          const Met& met) {
  return describe(body, v, to, touch_of(env, body, v, to, met));
}
/** Names the other ends of a face in the order in which the face has them. */
template <int D>
dsw_body_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                          const TooNear<D>& near);
/** Which body was touched. */
template <int D>
dsw_contact_partner partner_of(const PairContact<D>& met) noexcept {
  return name_partner(met.other, met.other_part);
}
/** What came too near, if that is a part of a body; else null. */
template <int D>
dsw_contact_partner partner_of(const Partners<D>* partners, const TooNear<D>& near) noexcept {
  return near.partner == kNone ? dsw_contact_partner{} : name_partner(partners->all[near.partner], near.other);
}

/** Describes the contact of an edge that runs into a wall when v is at `end`: `hit` is what a cast along the edge met
 * first. The face is the obstacle, and the normal is that of its triangle. `time` and `position` are not written. */
template <int D>
dsw_body_contact describe_cast(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                               uint32_t edge, const double* end, const CastResult& hit);

/** Names an obstacle, or a part of a body, in 64 bits, to see it again. */
uint64_t obstacle_key(const dsw_cell& obstacle) noexcept;
uint64_t part_key(const dsw_contact_partner& partner) noexcept;

}  // namespace dsw
