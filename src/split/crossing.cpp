#include "split/crossing.h"

#include "base/search.h"

namespace dsw {
namespace {

/** From vertex `k` of a triangle the segment to q lies in its plane: whether it begins in the triangle. */
bool goes_into(const double* const (&t)[3], int k, const double* q) noexcept {
  const int axis = projection(t), sense = turn_sign<3>(t[0], t[1], t[2], axis);
  const double *const a = t[k], *const b = t[(k + 1) % 3], *const c = t[(k + 2) % 3];
  return turn_sign<3>(a, b, q, axis) * sense >= 0 && turn_sign<3>(a, q, c, axis) * sense >= 0;
}

/** In the plane of a triangle: whether no side and not the segment itself separates them. */
bool meet_in_plane(const double* const (&t)[3], const double* p, const double* q) noexcept {
  const int axis = projection(t), sense = turn_sign<3>(t[0], t[1], t[2], axis);
  for (int k = 0; k < 3; ++k) {
    const double *const a = t[k], *const b = t[(k + 1) % 3];
    if (turn_sign<3>(a, b, p, axis) * sense < 0 && turn_sign<3>(a, b, q, axis) * sense < 0) return false;
  }
  int left = 0, right = 0;
  for (const double* const corner : t) {
    const int side = turn_sign<3>(p, q, corner, axis);
    left += side > 0 ? 1 : 0;
    right += side < 0 ? 1 : 0;
  }
  return left != 3 && right != 3;
}

/** The line through p and q, which is not in the plane of the triangle, meets it. */
bool line_meets(const double* const (&t)[3], const double* p, const double* q) noexcept {
  bool is_left = false, is_right = false;
  for (int k = 0; k < 3; ++k) {
    const double* const side[3] = {p, q, t[k]};
    const int sign = orient<3>(side, t[(k + 1) % 3]);
    is_left = is_left || sign > 0;
    is_right = is_right || sign < 0;
  }
  return !(is_left && is_right);
}

}  // namespace

bool edge_meets(const PartPoints<3>& at, uint32_t u, uint32_t v, const PartSide<3>& triangle) noexcept {
  const double* const t[3] = {at[triangle.v[0]], at[triangle.v[1]], at[triangle.v[2]]};
  const uint32_t* const end = triangle.v + 3;
  const uint32_t *const of_u = dsw::find(triangle.v, end, u), *const of_v = dsw::find(triangle.v, end, v);
  if (of_u != end && of_v != end) return false;
  const double *const p = at[u], *const q = at[v];
  if (of_u != end) return orient<3>(t, q) == 0 && goes_into(t, static_cast<int>(of_u - triangle.v), q);
  if (of_v != end) return orient<3>(t, p) == 0 && goes_into(t, static_cast<int>(of_v - triangle.v), p);
  const int side_p = orient<3>(t, p), side_q = orient<3>(t, q);
  if (side_p == 0 && side_q == 0) return meet_in_plane(t, p, q);
  return side_p * side_q <= 0 && line_meets(t, p, q);
}

}  // namespace dsw
