#pragma once
// A contact of two bodies as a host reads it.

#include "dartsweep/contact.h"
#include "proximity/pair_sweep.h"

namespace dsw {

template <int D>
struct Environment;

/** All but `distance_left` and `history` of the contact that vertex v met on its way to `to`. */
template <int D>
dsw_body_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                          const PairContact<D>& met);

/** What was touched. */
template <int D>
dsw_contact_partner partner_of(const PairContact<D>& met) noexcept;

/** Names a part of a body in 64 bits, to see it again. */
uint64_t part_key(const dsw_contact_partner& partner) noexcept;

}  // namespace dsw
