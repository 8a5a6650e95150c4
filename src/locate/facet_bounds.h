#pragma once
// Between which numbers the distances of facets from a segment lie: four triangles side by side, for a fraction of what
// an exact distance takes.
//
// Coordinates are turned into a frame of the segment: t along it, from 0 to `length`, u and v across. Let r be the
// distance of the segment's line from a triangle, and g the gap in t between the segment and the triangle. No point of
// the triangle is nearer than sqrt(r^2 + g^2), nor than the triangle's plane, if both ends of the segment are on one
// side of it. Points of the triangle's sides show that it is not farther than a second number.
//
// Rounding. Let `size` be the largest coordinate in the frame. The frame, the turned points and points of sides have
// errors of some 2^-50 size. So has the place on a side that is nearest to the line, times the length of the side: it
// comes from a product of a point and the side. If a line test takes the line to be beside the triangle that it passes,
// the line passes it that near to a side. The bounds allow 2^-44 size and what underflows. The plane's normal may be
// short against the sides; its errors are counted as in segment_distances.cpp.

#include "base/vec.h"

namespace dsw {

struct SegmentFrame {
  double first[3] = {};    // the segment's first point, times `scale`
  double axes[3][3] = {};  // along the segment and across, orthonormal up to rounding
  double length = 0;
  double scale = 1;

  SegmentFrame(const Vec& from, const Vec& along, double point_scale);
};

/** Coordinates between which bounds hold: nothing overflows, and what underflows is allowed for. */
constexpr double kLeastBounded = 0x1p-150, kMostBounded = 0x1p150;

/** Of four triangles. A lower bound may be negative. */
struct FacetBounds {
  double lower[4], upper[4];
};

/** Bounds of four triangles: corner k of triangle i is corners[4 k + i]. In the plane of four sides, two corners each. */
template <int D>
using TriangleBounds = void (*)(const SegmentFrame& frame, const double* const* corners, FacetBounds& bounds) noexcept;

/** Of one instruction set; all give the same bits. */
template <int D>
struct BoundsKernel {
  TriangleBounds<D> of_triangles;
  /** In space of the facets of a tetrahedron with these four vertices. */
  TriangleBounds<D> of_tetrahedron;
};

/** The fastest of this processor. */
template <int D>
const BoundsKernel<D>& bounds_kernel() noexcept;

template <int D>
BoundsKernel<D> portable_bounds() noexcept;
#if defined(__x86_64__)
template <int D>
BoundsKernel<D> avx2_bounds() noexcept;
#endif

}  // namespace dsw
