#pragma once
// Whether an edge meets a triangle, exactly.

#include "predicates/turn.h"
#include "split/parts.h"

namespace dsw {

/** Whether the closed segment from u to v has a point of a closed triangle, other than a vertex of both. The triangle has an
 * area. */
bool edge_meets(const PartPoints<3>& at, uint32_t u, uint32_t v, const PartSide<3>& triangle) noexcept;

}  // namespace dsw
