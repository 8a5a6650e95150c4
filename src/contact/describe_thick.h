#pragma once
// A contact of a thick body as a host reads it.

#include "contact/describe.h"
#include "proximity/thick_sweep.h"

namespace dsw {

/** All but `distance_left` and `history` of the contact of vertex v on its way to `to`, with what comes too near. */
template <int D>
dsw_body_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                          const TooNear<D>& near);

/** What came too near, if that is a part of a body; else null. */
template <int D>
dsw_contact_partner partner_of(const Partners<D>* partners, const TooNear<D>& near) noexcept;

}  // namespace dsw
