#pragma once
// Environments whose points move.

#include "environment/environment.h"

namespace dsw {

/** From now on points may move. Once they have, cells are looked at when they are first entered, and only simplices are
 * taken to be convex. Throws std::bad_alloc before it changes anything. O(cells), once. */
template <int D>
void let_points_move(Environment<D>& env);

/** Gives back memory for points that the environment no longer reads. */
template <int D>
void release_owned_points(Environment<D>& env) noexcept;

}  // namespace dsw
