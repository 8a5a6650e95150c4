#pragma once
// A contact of a body as a host reads it.

#include "contact/geometry.h"
#include "contact/names.h"
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

/** What of the environment is touched: a corner, a side or the whole of a wall, or something thin that is marked. */
struct TouchedObstacle {
  HalfFacet facet;           // an impassable facet that has it; invalid: there is none
  Cell cell;                 // then a cell at it
  const uint32_t* vertices;  // between which it is touched
  uint32_t count;
  dsw_cell_kind marked;  // what is marked, if there is no facet
};
/** Names it in a contact, which has its normal. */
template <int D>
void name_obstacle(const Environment<D>& env, const TouchedObstacle& touched, dsw_contact& contact) noexcept;

/** What a sweep has met, with its normal. */
template <int D>
dsw_contact contact_of(const Environment<D>& env, const SweepContact& met, const double* normal) noexcept;

/** All but `distance_left` and `history` of the contact that vertex v met on its way to `to`. */
template <int D>
dsw_body_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                          const StarContact& met);

/** Describes the contact of an edge that runs into a wall when v is at `end`: `hit` is what a cast along the edge met
 * first. The face is the obstacle, and the normal is that of its triangle. `time` and `position` are not written. */
template <int D>
dsw_body_contact describe_cast(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                               uint32_t edge, const double* end, const CastResult& hit);

/** Names an obstacle in 64 bits, to see it again. */
uint64_t obstacle_key(const dsw_cell& obstacle) noexcept;

}  // namespace dsw
