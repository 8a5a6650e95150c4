#pragma once
// Who goes where, below bodies: a point, and an edge or a face one point of which goes. All go straight and steadily.
//
// A motion that turns is asked piece by piece: the chords of a piece are the PointWays of its ends, and response/rigid_way.h says how
// far the arcs are beside them. To ask about the arcs themselves, a turning way would stand here beside PointWay, with a place at a
// time, a box of a part of the time, and the exact touch of a line (predicates/turning_pair.h has that); MovingCorridors::ask would take it.

#include "base/simplex.h"
#include "map/map.h"
#include "predicates/sweep_events.h"

namespace dsw {

/** The facets that a path passes up to its target or the wall that it meets, each seen from the cell that is left. Known
 * are up to two; else `count` is 0. */
struct PathFacets {
  bool is_known = false;
  uint32_t count = 0;
  HalfFacet facets[2];
};

/** The way of a point. One that stays ends where it starts. */
struct PointWay {
  const double *start, *end;
  Cell from, arrival;  // where something is on the path: the cell in front of that, or none
  PathFacets crossed;
};

/** An edge p q, or a face p q r, whose point p goes. The others stay. */
struct MovingPart {
  Simplex part;     // of the body,
  uint32_t vertex;  // and p
  PointWay way;     // of p
  const double *q, *r;
  Cell q_cell, r_cell;
  bool p_first;         // the edge, and its corridor, begins at p
  bool reached = true;  // false: the path of p meets a wall of `way.arrival`

  EdgeMotion edge() const noexcept { return {way.start, way.end, q}; }
  FaceMotion face() const noexcept { return {way.start, way.end, q, r}; }
};

}  // namespace dsw
