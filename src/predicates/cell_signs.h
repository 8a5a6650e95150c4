// A tetrahedron or a pyramid against the triangle that an edge sweeps: what SweptTriangle says of its corners and of the
// edges that pass the plane, side by side. In lanes the arithmetic is that of SweptTriangle, operation by operation, so the
// bounds and their proof are the same; what a filter leaves open is asked of SweptTriangle itself.
#pragma once

#include "base/compiler.h"
#include "predicates/swept_triangle.h"

namespace dsw {

struct CellSigns {
  static constexpr std::uint8_t kNotAsked = 0xff;
  std::int8_t side[5];  // of each corner, as SweptTriangle::side
  // What SweptTriangle::outside says of the edge between two corners on different sides. A diagonal of a pyramid's base is not asked.
  std::uint8_t lines[5][5];
};

// Tells whether corners of the cell lie on different sides of the plane. Only then lines are asked.
using FindCellSigns = bool (*)(const SweptTriangle& triangle, const double* const* corners, CellSigns& signs) noexcept;

bool find_tetrahedron_signs(const SweptTriangle& triangle, const double* const* corners, CellSigns& signs) noexcept;
// Asks a pyramid: its corners are those of the base in turn, and the tip.
bool find_pyramid_signs(const SweptTriangle& triangle, const double* const* corners, CellSigns& signs) noexcept;
#if DSW_X86_64
bool find_tetrahedron_signs_avx2(const SweptTriangle& triangle, const double* const* corners,
                                 CellSigns& signs) noexcept;
bool find_pyramid_signs_avx2(const SweptTriangle& triangle, const double* const* corners, CellSigns& signs) noexcept;
#endif

// The edges that pass the plane, by the corners on its positive side: `count` of them, from a negative corner a to a
// positive one b. Those left over repeat the first.
struct PassingEdges {
  std::uint8_t count = 0, a[4] = {}, b[4] = {};
};
constexpr PassingEdges passing_edges(unsigned positive) noexcept {
  PassingEdges edges;
  for (std::uint8_t i = 0; i < 4; ++i) {
    for (std::uint8_t j = 0; j < 4; ++j) {
      if ((positive >> i & 1u) != 0 || (positive >> j & 1u) == 0) continue;
      edges.a[edges.count] = i;
      edges.b[edges.count++] = j;
    }
  }
  for (int k = edges.count; k < 4; ++k) {
    edges.a[k] = edges.a[0];
    edges.b[k] = edges.b[0];
  }
  return edges;
}

}  // namespace dsw
