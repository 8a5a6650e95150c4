#pragma once
// Between which numbers the distances of facets from a segment lie: eight triangles side by side, in single precision,
// for a fraction of what an exact distance takes.
//
// Coordinates are turned into a frame of the segment: t along it from its middle, u and v across, scaled by a power of
// two so that they are at most 4. Let r be the distance of the segment's line from a triangle, and g the gap in t
// between the segment and the triangle. No point of the triangle is nearer than sqrt(r^2 + g^2), nor than the
// triangle's plane, if both ends of the segment are on one side of it. Points of the triangle's sides show that it is
// not farther than a second number.
//
// Rounding. Let `size` be the largest sum of a corner's coordinates and of half the segment. Differences from the
// segment's first point are those of exact distances, up to 2^-24. The frame, the turned points and points of sides
// have errors of some 2^-21 size. So has the place on a side that is nearest to the line, times the length of the side:
// it comes from a product of a point and the side. If rounding takes the line to be beside a triangle that it passes,
// the line passes it that near to a side. The bounds allow 2^-17 size, and 2^-44 for what underflows and for sides that
// are shorter than 2^-50. The plane's normal may be short against the sides; its errors are counted as in
// segment_distances.cpp, with 2^-24 in place of 2^-53.

#include "base/compiler.h"
#include "base/vec.h"

namespace dsw {

template <int D>
struct SegmentFrame {
  double first[3] = {};   // the segment's first point
  float axes[3][3] = {};  // along the segment and across, orthonormal up to rounding; in the plane the third leaves it
  float half = 0;         // of the segment's scaled length
  double scale = 1;       // of all lengths here

  /** @param largest of all coordinates: a normal number. */
  SegmentFrame(const double* from, const Vec& along, double largest);
};

/** Bounds of the distances of eight triangles, scaled. A lower bound may be negative. */
struct FacetBounds {
  float lower[8], upper[8];
};

/** The functions of one instruction set; all instruction sets give the same bits. */
template <int D>
struct BoundsKernel {
  /** Bounds the distances of eight triangles: corner k of triangle i is corners[8 k + i]. In the plane there are eight
   * sides with two corners each. */
  void (*of_triangles)(const SegmentFrame<D>& frame, const double* const* corners, FacetBounds& bounds) noexcept;
  /** In space of the facets of two tetrahedra, four vertices each. */
  void (*of_tetrahedra)(const SegmentFrame<3>& frame, const double* const* vertices, FacetBounds& bounds) noexcept;
};

/** The fastest of this processor. */
template <int D>
const BoundsKernel<D>& bounds_kernel() noexcept;

template <int D>
BoundsKernel<D> portable_bounds() noexcept;
#if DSW_X86_64
template <int D>
BoundsKernel<D> avx2_bounds() noexcept;
#endif

}  // namespace dsw
