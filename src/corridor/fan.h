#pragma once
// Passable tetrahedra round an edge of the environment, from wall to wall.

#include "environment/environment.h"
#include "map/dart.h"
#include "predicates/swept_triangle.h"

namespace dsw {

/** From a facet at an edge of the environment on, round the edge, through passable tetrahedra to a wall, seen from its
 * cell. Invalid: there is none, or there are other cells, or too many. */
HalfFacet find_wall(const Environment<3>& env, HalfFacet start, const uint32_t (&edge)[2]) noexcept;

/** Whether a flood of a swept triangle T sees no other walls at an edge of the environment than the two that end a fan
 * there. The edge pierces T in y, and a body's edge comes to y through the fan. False also where that is not known.
 *
 * Let the flood see another wall at y, from other passable cells. Then a path in T leads through passable cells from
 * the fan to these cells, and with y it is a closed curve in T. There is a gap between both on either side of y, and
 * one of the gaps begins inside of the curve. So does the wall of the fan at this gap. The curve passes no wall. So all
 * that continues this wall through T, but for y, stays inside of the curve, and in T. Hence there are no other cells if
 * both walls can be followed from y, from facet to facet and not through y, until they leave T. */
bool sees_only_fan(const Environment<3>& env, const SweptTriangle& triangle, const HalfFacet (&walls)[2],
                   const uint32_t (&edge)[2]) noexcept;

/** Whether no passable cells are linked round an edge of the environment but those of a fan with these walls, known by
 * a way round it behind the walls. Then a contact with the edge that comes through the fan is that with the first of
 * both walls. A flood sees both, since it enters the fan. Of cells that touch the edge and are not linked it may see
 * walls, too, but those do not count. */
bool is_alone(const Environment<3>& env, const HalfFacet (&walls)[2], const uint32_t (&edge)[2]) noexcept;

/** The dart of an edge in the cell of the lowest index round it. Invalid if one of these cells is no tetrahedron. */
Dart lowest_dart_round(const Map<3>& map, Dart d) noexcept;

}  // namespace dsw
