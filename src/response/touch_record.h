#pragma once
// Contacts of the two parts that touch first on rigid ways, where the bodies are now.

#include "predicates/hull_gap.h"
#include "response/rigid_touches.h"
#include "response/settings.h"

namespace dsw {

/** Finds the gap between a part of a body and what it touches first. */
template <int D>
HullGap gap_of(const Body<D>& body, const RigidTouch<D>& touch, double cutoff, double tolerance) noexcept;
/** Whether that distance is surely not more than some length: by doubles, where lines across both parts show it. */
template <int D>
bool is_surely_near(const Body<D>& body, const RigidTouch<D>& touch, double length) noexcept;

/** Adds a contact, without `distance_left`, of a part of a body with what it touches first. Throws std::bad_alloc.
 * @param way of the body.
 * @param other the touched body; null: the environment. */
template <int D>
void record_touch(const Environment<D>& env, const Body<D>& body, const RigidWay<D>& way, const RigidTouch<D>& touch,
                  const Partner<D>* other, MoveRecord& record);

}  // namespace dsw
