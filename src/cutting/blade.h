#pragma once
// The surface that a blade sweeps: its edge, a chain of points, at one place after the other. Four neighbouring points make two
// triangles. Any may be flat: what is degenerate cuts nothing.

#include "base/points.h"
#include "base/vec.h"
#include "predicates/swept_triangle.h"

namespace dsw {

struct Blade {
  PointArray points;       // row after row
  uint32_t rows, columns;  // at least 2 of each

  static constexpr uint32_t kNone = 0xffffffffu;

  uint32_t point_count() const { return rows * columns; }
  uint32_t triangle_count() const { return 2 * (rows - 1) * (columns - 1); }

  /** The points of a triangle: of each four, those before the diagonal from the first to the last (even) or behind it (odd). */
  void corners(uint32_t triangle, const double* out[3]) const {
    const uint32_t quad = triangle / 2, row = quad / (columns - 1), column = quad % (columns - 1);
    const size_t first = size_t{row} * columns + column, across = first + columns + 1;
    out[0] = points[first];
    out[1] = triangle % 2 == 0 ? points[first + 1] : points[across];
    out[2] = triangle % 2 == 0 ? points[across] : points[across - 1];
  }

  /** The triangle across side `side` of a triangle, which joins its corners `side` and the next; kNone: the blade's rim. */
  uint32_t neighbour(uint32_t triangle, int side) const {
    const uint32_t quad = triangle / 2, wide = columns - 1, row = quad / wide, column = quad % wide;
    const bool even = triangle % 2 == 0;
    if (side == (even ? 2 : 0)) return triangle ^ 1u;
    if (even && side == 0) return row == 0 ? kNone : 2 * (quad - wide) + 1;
    if (even) return column + 1 == wide ? kNone : 2 * (quad + 1) + 1;
    if (side == 1) return row + 2 == rows ? kNone : 2 * (quad + wide);
    return column == 0 ? kNone : 2 * (quad - 1);
  }

  SweptTriangle swept(uint32_t triangle) const {
    const double* at[3];
    corners(triangle, at);
    return SweptTriangle(EdgeMotion{at[0], at[1], at[2]});
  }
};

/** The vector from a point to the nearest one of a triangle, rounded. */
Vec to_triangle(const double* from, const double* const* corners);

}  // namespace dsw
