#include "predicates/cell_signs.h"

namespace dsw {

bool find_tetrahedron_signs(const SweptTriangle& triangle, const double* const* corners, CellSigns& signs) noexcept {
  unsigned positive = 0, negative = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const int side = triangle.side(corners[i]);
    signs.side[i] = static_cast<std::int8_t>(side);
    positive |= static_cast<unsigned>(side > 0) << i;
    negative |= static_cast<unsigned>(side < 0);
  }
  if (positive == 0 || negative == 0) return false;
  const PassingEdges edges = passing_edges(positive);
  for (int k = 0; k < edges.count; ++k) {
    const std::uint8_t a = edges.a[k], b = edges.b[k];
    signs.lines[a][b] = signs.lines[b][a] = static_cast<std::uint8_t>(triangle.outside(corners[a], corners[b], 1));
  }
  return true;
}

bool find_pyramid_signs(const SweptTriangle& triangle, const double* const* corners, CellSigns& signs) noexcept {
  bool passes = false;
  for (unsigned i = 0; i < 5; ++i) {
    signs.side[i] = static_cast<std::int8_t>(triangle.side(corners[i]));
    passes = passes || signs.side[i] != signs.side[0];
  }
  if (!passes) return false;
  const auto ask = [&](unsigned a, unsigned b) {
    if (signs.side[a] == signs.side[b]) return;
    const std::uint32_t of_line = triangle.outside(corners[a], corners[b], signs.side[b]);
    signs.lines[a][b] = signs.lines[b][a] = static_cast<std::uint8_t>(of_line);
  };
  for (unsigned a = 0; a < 4; ++a) {
    signs.lines[a][a ^ 2u] = CellSigns::kNotAsked;
    ask(a, 4);
    ask(a, (a + 1) % 4);
  }
  return true;
}

}  // namespace dsw
