// Why a free box is enough. The flood of a sweep goes through passable facets that are met by what is swept, so by the
// box: this one goes through them too. An impassable facet that the sweep meets would have been met here, from the same
// cell. A vertex inside of what a face sweeps is in the box, so all facets at it meet the box: going round it through
// passable ones the flood has entered all cells there, or met an impassable one.

#include "corridor/box_probe.h"

#include "base/compiler.h"
#include "base/processor.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

const FacetsInBox kFacetsInBox = DSW_WITH_AVX2(facets_in_box);

}  // namespace

bool BoxProbe<3>::is_free(const Bounds<3>& box, Cell start) noexcept {
  count_ = 0;
  // Marked edges and vertices are not seen on the facets there.
  if ((env_.marked_edges | env_.marked_vertices) != 0 || !enter(start)) return false;
  for (uint32_t i = 0; i < count_; ++i) {
    if (!enter_neighbours(box, cells_[i])) return false;
  }
  return true;
}

/** False: there is no room, or it is no hexahedron that may be entered. */
bool BoxProbe<3>::enter(Cell c) noexcept {
  if (count_ == kMost || !suits(env_, c) || is_closed(env_, c)) return false;
  cells_[count_++] = c;
  return true;
}

bool BoxProbe<3>::enter_neighbours(const Bounds<3>& box, Cell c) noexcept {
  const Map<3>& map = env_.map;
  const uint32_t* const w = map.record(c);
  for (uint32_t met = kFacetsInBox(env_.points, w + kUnitWords<3>, box); met != 0; met &= met - 1) {
    const uint32_t link = w[kUnitWords<3> - 6 + lowest_bit(met)];
    if (link >= kNoFacet) return false;  // the boundary, or marked
    const Cell next = map.cell_of(HalfFacet{link});
    if (!has_entered(next) && !enter(next)) return false;
  }
  return true;
}

uint32_t facets_in_box(const double* points, const uint32_t* vertices, const Bounds<3>& box) noexcept {
  uint32_t beyond[8];
  for (int i = 0; i < 8; ++i) {
    const double* const v = points + size_t{vertices[i]} * 3;
    beyond[i] = 0;
    for (int k = 0; k < 3; ++k) {
      beyond[i] |= static_cast<uint32_t>(v[k] < box.low[k]) << (2 * k);
      beyond[i] |= static_cast<uint32_t>(v[k] > box.high[k]) << (2 * k + 1);
    }
  }
  uint32_t met = 0;
  for (uint32_t f = 0; f < 6; ++f) {
    const uint8_t(&corner)[4] = kBoxFacets[f];
    const uint32_t all = beyond[corner[0]] & beyond[corner[1]] & beyond[corner[2]] & beyond[corner[3]];
    met |= (all == 0 ? 1u : 0u) << f;
  }
  return met;
}

}  // namespace dsw
