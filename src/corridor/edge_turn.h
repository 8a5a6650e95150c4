#pragma once
// A corridor turned round an edge of the environment, in the plane round a vertex.

#include "corridor/corridor.h"
#include "map/ridge_walk.h"

namespace dsw {

/** Puts the other facets at a pivot in the place of those that a corridor passes there, the first of which is at `begin`.
 * `cells` says whether the way may lead through a cell, whether a facet has the pivot, and which other facet of a cell
 * has it. False, and nothing is changed: there is no passable way. Throws std::bad_alloc. */
template <int D, class Cells>
bool turn_at(const Environment<D>& env, Corridor<D>& corridor, size_t begin, const RidgeName& pivot,
             const Cells& cells) {
  constexpr size_t kMost = 64;  // facets at a pivot
  const Map<D>& map = env.map;
  const Array<uint32_t>& old = corridor.facets;
  size_t end = begin + 1;
  while (end < old.size() && cells.has(old[end], pivot)) ++end;

  const Cell last = map.cell_of(map.opposite({old[end - 1]}));
  uint32_t turned[kMost];
  size_t count = 0;
  bool arrives = false;
  walk_round(map, HalfFacet{old[begin]}, kMost + 1, [&](Cell c, HalfFacet entered) {
    arrives = c == last;
    if (arrives || !cells.suits(c) || is_closed(env, c) || count == kMost) return HalfFacet{};
    const HalfFacet next = cells.other(c, entered, pivot);
    if (!next.valid() || map.facet_marked(next)) return HalfFacet{};
    turned[count++] = next.word;
    return next;
  });
  if (!arrives) return false;
  corridor.replace(env, begin, end, turned, count);
  return true;
}

/** Turns, as `turn` does, a corridor that is not kept in rows: its cells are tetrahedra, pyramids and hexahedra that
 * are exactly convex. What the edge sweeps is free as it is among tetrahedra (corridor/ask.cpp has the proof): all
 * cells round the pivot have it as an edge. Throws std::bad_alloc. */
bool turn_round_edge(const Environment<3>& env, Corridor<3>& corridor, const double* from, const double* to,
                     RidgeName& pivot);

}  // namespace dsw
