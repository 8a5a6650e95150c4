// Which signs of areas and of differences of coordinates part a pair whose points lie in one plane. Private to this folder.
#pragma once

#include "predicates/moving_pair.h"

namespace dsw {
namespace exact_touch {

// Points of the triangles of a pair in space; in the plane there is only the first.
constexpr int kTriangle[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};

// Whether the pair is apart: the point is not in the triangle, or both ends of an edge are on one side of the other. At
// least one sign is not 0. The same rule as judge() of the filter, but there 0 is unknown.
inline bool areas_part(PairKind kind, const int (&sign)[4]) noexcept {
  if (kind == PairKind::kEdgeEdge) return sign[0] * sign[1] > 0 || sign[2] * sign[3] > 0;
  const int side = sign[3];
  return side == 0 || sign[2] * side < 0 || sign[1] * side > 0 || sign[0] * side < 0;
}

// The points of one feature and of the other, each of the first with each of the second.
struct Opposite {
  int count;
  int pair[4][2];
};
inline const Opposite& opposite(PairKind kind) noexcept {
  static constexpr Opposite kOf[3] = {
      {3, {{0, 1}, {0, 2}, {0, 3}}}, {4, {{0, 2}, {0, 3}, {1, 2}, {1, 3}}}, {2, {{0, 1}, {0, 2}}}};
  return kOf[static_cast<int>(kind)];
}

// Whether a pair touches. All its points lie in one plane; if D is 2, on one line. area(view, i) is the sign of the area of kTriangle[i],
// seen along axis `view`. difference(axis, i, j) is the sign of the coordinate of point j less that of point i.
template <int D, class Area, class Difference>
bool flat_pair_touches(PairKind kind, Area area, Difference difference) {
  for (int view = 0; D == 3 && view < 3; ++view) {
    int sign[4];
    for (int i = 0; i < 4; ++i) sign[i] = area(view, i);
    if (sign[0] != 0 || sign[1] != 0 || sign[2] != 0 || sign[3] != 0) return !areas_part(kind, sign);
  }
  const Opposite& pairs = opposite(kind);
  for (int k = 0; k < D; ++k) {
    const int first = difference(k, pairs.pair[0][0], pairs.pair[0][1]);
    bool apart = first != 0;
    for (int i = 1; i < pairs.count && apart; ++i) apart = difference(k, pairs.pair[i][0], pairs.pair[i][1]) == first;
    if (apart) return false;
  }
  return true;
}

}  // namespace exact_touch
}  // namespace dsw
