#pragma once
// When a cell is valid, exactly: every simplex of its star has positive volume and one generic direction from
// the centre meets exactly one simplex of its boundary (positive stars alone can cover a direction twice).

#include "environment/environment.h"

namespace dsw {

enum class CellState { kValid, kValidConvex, kInverted, kInvalid };

/** kValidConvex: also exactly convex with exactly flat facets. kInverted: every star volume is negative. */
template <int D>
CellState check_cell(const Environment<D>& env, Cell c) noexcept;

/** Whether a valid cell stays valid while all of its vertices go straight and steadily to where they are in `next`. Its
 * centre is led along the straight way between its places, so a cell may be valid all the time and still fail here. Throws
 * std::bad_alloc. */
template <int D>
bool stays_valid(const Environment<D>& env, Cell c, const double* next);

/** Whether a polyhedron that no environment has yet would be valid: its vertices in their order, and triangles that
 * close a sphere, three places among the vertices each, counter-clockwise seen from outside. */
bool is_valid_star(const double* const* vertices, uint32_t vertex_count, const uint8_t* triangles,
                   uint32_t triangle_count) noexcept;

/** Whether simplices that close a surface are a valid star of `apex`: D points each, oriented as facets. */
template <int D>
bool is_valid_star(const double* const* simplices, uint32_t simplex_count, const double* apex) noexcept;

/** The volume of a cell times 6, in the plane its area times 2; negative if it is inside out. Rounded, up to a positive
 * factor. */
template <int D>
double rounded_volume(const Environment<D>& env, Cell c) noexcept;

}  // namespace dsw
