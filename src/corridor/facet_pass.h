#pragma once
// A line against the ridges of one facet, side by side.

#include "base/compiler.h"
#include "predicates/filtered.h"

namespace dsw {

/** Whether the line from one point to another certainly leaves through a facet: it passes all ridges on the facet's
 * side. Corners are counter-clockwise seen from outside; a triangle repeats the last. The bounds are those of
 * predicates/filter_bounds.h. */
using PassesFacet = bool (*)(const double* const* corners, const double* from, const double* to) noexcept;
bool passes_facet(const double* const* corners, const double* from, const double* to) noexcept;
#if DSW_X86_64
/** Computes passes_facet with the same arithmetic, one ridge in each lane, and gives the same answers. */
bool passes_facet_avx2(const double* const* corners, const double* from, const double* to) noexcept;
#endif
extern const PassesFacet kPassesFacet;  // the fastest of this processor

/** An edge whose two ends move: `first` before `other`, unless it is `at_once`. */
struct EdgeWay {
  const double *first, *first_to, *other, *other_to;
  bool from_first;       // lines go from the end that moves first to the other one
  bool at_once = false;  // both move at the same time: the line through `first` and `other_to` counts, too

  static EdgeWay of_both(const double* a, const double* a_to, const double* b, const double* b_to) noexcept {
    return {a, a_to, b, b_to, true, true};
  }
};

/** Whether the lines through both ends, before, between and after their moves, certainly leave through a facet. Corners
 * as above. One bound holds for all: no rounded difference exceeds that of the ends of the box of all points, since
 * rounding keeps the order. */
using KeepsToFacet = bool (*)(const double* const* corners, const EdgeWay& edge) noexcept;
bool keeps_to_facet(const double* const* corners, const EdgeWay& edge) noexcept;
#if DSW_X86_64
bool keeps_to_facet_avx2(const double* const* corners, const EdgeWay& edge) noexcept;
#endif
extern const KeepsToFacet kKeepsToFacet;

/** Tells for one ridge from x to y what passes_facet tells for all ridges of a facet; `way` is the rounded difference
 * of the line's points. */
inline bool passes_ridge(const double* x, const double* y, const double* from, const filter::Vec<3>& way) noexcept {
  const filter::Vec<3> a = filter::difference<3>(x, from), b = filter::difference<3>(y, from);
  const double det = filter::dot(filter::cross(a, b), way);
  return det > 0 && filter::certain(det, filter::extent(way, a, b));
}

}  // namespace dsw
