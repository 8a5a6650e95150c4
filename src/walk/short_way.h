#pragma once
// Ways that end in their first cell or at its wall, or lead from one convex cell into another one near by, seen by planes and without a
// cast.

#include "base/compiler.h"
#include "predicates/inside_tetrahedron.h"
#include "walk/cast.h"

namespace dsw {

/** For each of `count` <= kPacket convex cells, the facets that have its point outside, a bit each; 0: there are none, the
 * filter does not see all of them, or a cell has no kernel of planes. In the plane always 0. */
template <int D>
void find_outside(const Environment<D>& env, const Cell* cells, const double* const* points, uint32_t count,
                  uint8_t* facets) noexcept;

/** Tells how a cast ends by the planes of the tetrahedron where it starts: it ends in there, or its end lies outside of a single
 * facet, which is a wall. Returns false if the planes do not decide, and always in the plane. */
template <int D>
DSW_HOT bool ends_at_once([[maybe_unused]] const Environment<D>& env, [[maybe_unused]] Cell start,
                          [[maybe_unused]] const double* to, [[maybe_unused]] CastResult* result) noexcept {
  if constexpr (D == 3) {
    const Map<3>& map = env.map;
    const uint32_t* const w = map.record(start);
    if (form_of(w[0]) != Form::kSimplex) return false;
    const double* corners[4];
    for (int i = 0; i < 4; ++i) corners[i] = env.point(w[i] & kVertexMask);
    const uint32_t facets = visible_facets(corners, to);
    if (facets == kUncertainFacets || (facets & (facets - 1)) != 0) return false;
    *result = {};
    result->cell = start;
    if (facets == 0) return true;
    const uint32_t facet = lowest_bit(facets);
    const HalfFacet left = map.half_facet(start, facet), beyond = map.opposite(left);
    if (beyond.valid() && !map.facet_marked(left) && !map.marked(map.cell_of(beyond))) return false;
    result->end = CastEnd::kHit;
    result->facet = left;
    result->simplex = result->first_facet = facet;
    return true;
  }
  return false;
}

/** How many facets a cell of a standard form has. */
template <int D>
constexpr uint8_t kFacetCounts[] = {
    Map<D>::standard_facet_count(Form::kSimplex), Map<D>::standard_facet_count(Form::kPyramid),
    Map<D>::standard_facet_count(Form::kPrism), Map<D>::standard_facet_count(Form::kBox)};

/** The cell behind a facet of a convex tetrahedron, pyramid or hexahedron, if that cell is convex, too, and a cast may pass
 * from one to the other both ways; else an invalid one. */
template <int D>
DSW_HOT Cell open_neighbour(const Environment<D>& env, Cell cell, uint32_t facet) noexcept {
  const Map<D>& map = env.map;
  const uint32_t word = map.record(cell)[0], facets = kFacetCounts<D>[static_cast<uint32_t>(form_of(word))];
  const uint32_t link = map.words[(cell.unit + 1) * kUnitWords<D> - facets + facet];
  if (link >= kNoFacet || (word & kMarkBit) != 0) return {};  // a link that is marked is larger
  const Cell next = map.cell_of(HalfFacet{link});
  if (map.marked(next) || !map.convex(next)) return {};
  const auto is_valid = [&](Cell c) { return CheckedCells::is_valid(env.checked.known(map.index(c))); };
  return !env.has_moved() || (is_valid(cell) && is_valid(next)) ? next : Cell{};
}

constexpr uint32_t kMostFurtherLooks = 4;

/** Two straight ways to one end through convex cells. Each of them starts in `cell` or comes into it. */
struct TwoWays {
  const double* from[2];
  const double* to;
  Cell cell, last;
  uint32_t facets;  // of `cell`: those that have the end outside, a bit each
  uint32_t asked;   // the ways that are asked about, a bit each
  uint32_t leads;   // those that are seen to come into `last` through open neighbours alone
};

/** Follows at most kPacket pairs of ways side by side, and sets `leads` of each. A pair is given up where its end lies outside of three
 * facets, or of two that share no ridge. Where the ways of a pair part, at most one is followed further. Looks at no more than
 * kMostFurtherLooks cells behind the first. */
void follow_ways(const Environment<3>& env, TwoWays* pairs, uint32_t count) noexcept;

}  // namespace dsw
