#pragma once
// What a body crosses that was created where it is not free: see dsw_body_find_penetrations.

#include "proximity/partners.h"
#include "scene/scene.h"

namespace dsw {

/** A part of a body that is not free, with what it crosses: a wall, or a part of a body. */
template <int D>
struct CrossedPart {
  Simplex part;
  HalfFacet wall;  // the first one; invalid where there is none to name
  Partner<D> other{nullptr, 0, 0};
  Simplex other_part{Simplex::kVertex, kNone};
  double point[3] = {};
};

/** Finds the cells of a body that need not be free. A vertex that lies outside gets any cell.
 * @param inside by vertex: whether it lies in a passable cell. */
template <int D>
void find_cells(const Scene<D>& scene, Body<D>& body, Array<bool>& inside);

/** Finds what a body crosses, whose cells find_cells has found; nothing if check_free accepts it. Throws std::bad_alloc. */
template <int D>
void find_penetrations(Scene<D>& scene, const Body<D>& body, const Array<bool>& inside, Array<CrossedPart<D>>& found);

/** Gives scene.penetrations what a body of the scene crosses. Throws std::bad_alloc. */
template <int D>
void list_penetrations(Scene<D>& scene, const BodyRecord<D>& of);

}  // namespace dsw
