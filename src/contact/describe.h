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
