#include "predicates/tetrahedron_signs.h"

namespace dsw {

void find_tetrahedron_signs(const SweptTriangle& triangle, const double* const* corners,
                            TetrahedronSigns& signs) noexcept {
  unsigned positive = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const int side = triangle.side(corners[i]);
    signs.side[i] = static_cast<std::int8_t>(side);
    positive |= static_cast<unsigned>(side > 0) << i;
  }
  const PassingEdges edges = passing_edges(positive);
  for (int k = 0; signs.passes_plane() && k < edges.count; ++k) {
    const std::uint8_t a = edges.a[k], b = edges.b[k];
    signs.lines[a][b] = signs.lines[b][a] = static_cast<std::uint8_t>(triangle.outside(corners[a], corners[b], 1));
  }
}

}  // namespace dsw
