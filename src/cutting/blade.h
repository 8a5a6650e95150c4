#pragma once
// A surface of triangles to cut with: what a blade's edge sweeps, a shape, or what a loop spans. Any triangle may be flat: what is
// degenerate cuts nothing.

#include "base/memory.h"
#include "base/points.h"
#include "base/vec.h"
#include "predicates/swept_triangle.h"

namespace dsw {

class Blade {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;

  /** Points are read in place. Throws std::bad_alloc, as all that makes one. */
  Blade(const Memory* memory, PointArray points, uint32_t point_count);

  /** A chain of `columns` points at `rows` places, row after row: of each four neighbours, the triangle before the diagonal from the first
   * to the last, and that behind it. */
  static Blade of_grid(const Memory* memory, PointArray points, uint32_t rows, uint32_t columns);
  /** Three points each. */
  static Blade of_triangles(const Memory* memory, PointArray points, uint32_t point_count, const uint32_t* corners,
                            uint32_t triangle_count);
  /** What a loop spans, from its centre: the last one of the points, which is not of the loop. */
  static Blade fan(const Memory* memory, PointArray points, uint32_t point_count);

  uint32_t point_count() const { return point_count_; }
  const double* point(uint32_t i) const { return points_[i]; }
  uint32_t triangle_count() const { return static_cast<uint32_t>(triangles_.size()); }

  void corners(uint32_t triangle, const double* out[3]) const {
    for (int k = 0; k < 3; ++k) out[k] = points_[triangles_[triangle].corners[k]];
  }
  /** The triangle across side `side` of a triangle, which joins its corners `side` and the next and runs the other way there; kNone: the
   * surface ends. */
  uint32_t neighbour(uint32_t triangle, int side) const { return triangles_[triangle].neighbours[side]; }
  /** A triangle that has no neighbour across one of its sides, or kNone: the surface is closed. O(triangles). */
  uint32_t find_rim() const;

  SweptTriangle swept(uint32_t triangle) const {
    const double* at[3];
    corners(triangle, at);
    return SweptTriangle(EdgeMotion{at[0], at[1], at[2]});
  }

 private:
  struct Triangle {
    uint32_t corners[3], neighbours[3];
  };

  void add(uint32_t a, uint32_t b, uint32_t c) { triangles_.push_back({{a, b, c}, {kNone, kNone, kNone}}); }
  void join(const Memory* memory);

  PointArray points_;
  uint32_t point_count_;
  Array<Triangle> triangles_;
};

/** The vector from a point to the nearest one of a triangle, rounded. */
Vec to_triangle(const double* from, const double* const* corners);

}  // namespace dsw
