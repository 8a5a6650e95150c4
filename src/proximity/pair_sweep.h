#pragma once
// What of other bodies, or of its own, a body touches when one of its vertices moves and everything else stands still
// [JCD10] 4.4.

#include "body/simplices.h"
#include "predicates/touch.h"
#include "proximity/near_edges.h"
#include "proximity/partners.h"

namespace dsw {

/** A touch of what moves and what stands. */
template <int D>
struct PairContact {
  double time = kNever;
  TouchPlace place = TouchPlace::kInside;  // of two edges
  Simplex part{Simplex::kVertex, kNone};   // what moves; a vertex: the moving one
  Partner<D> other = {nullptr, 0, 0};
  Simplex other_part{Simplex::kVertex, kNone};
};

/** Whether vertex v can go to `to`, within reach, without touching anything. noexcept: looks at boxes alone.
 * @param near of the body's move, if that has a list that is active; else null. */
template <int D>
bool is_way_apart(const Partners<D>& partners, const Body<D>& body, uint32_t v, const double* to,
                  const NearEdges* near = nullptr) noexcept;

/** Whether vertex v can go to `into`, the other end of one of its edges, and become one with it. */
template <int D>
bool is_merge_apart(const Partners<D>& partners, const Body<D>& body, uint32_t v, uint32_t into) noexcept;

/** What is touched first on that way. Of equal times, as they are rounded, the vertex before edges before faces, then
 * the other body with the lowest index and of its parts vertices before edges before faces, all by index. */
template <int D>
bool find_first_pair(const Partners<D>& partners, const Body<D>& body, uint32_t v, const double* to,
                     PairContact<D>* first, const NearEdges* near = nullptr) noexcept;

}  // namespace dsw
