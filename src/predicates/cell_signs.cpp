#include "predicates/cell_signs.h"

namespace dsw {
namespace {

bool find_signs(const SweptTriangle& triangle, const double* const* corners, unsigned count,
                CellSigns& signs) noexcept {
  bool passes = false;
  for (unsigned i = 0; i < count; ++i) {
    signs.side[i] = static_cast<std::int8_t>(triangle.side(corners[i]));
    passes = passes || signs.side[i] != signs.side[0];
  }
  for (unsigned b = 1; passes && b < count; ++b) {
    for (unsigned a = 0; a < b; ++a) {
      std::uint32_t of_line = CellSigns::kNotAsked;
      const bool is_diagonal = count == 5 && b == a + 2 && b != 4;
      if (!is_diagonal && signs.side[a] != signs.side[b])
        of_line = triangle.outside(corners[a], corners[b], signs.side[b]);
      signs.lines[a][b] = signs.lines[b][a] = static_cast<std::uint8_t>(of_line);
    }
  }
  return passes;
}

}  // namespace

bool find_tetrahedron_signs(const SweptTriangle& triangle, const double* const* corners, CellSigns& signs) noexcept {
  return find_signs(triangle, corners, 4, signs);
}
bool find_pyramid_signs(const SweptTriangle& triangle, const double* const* corners, CellSigns& signs) noexcept {
  return find_signs(triangle, corners, 5, signs);
}

}  // namespace dsw
