// Signs by integers; what each function means stands in exact.h.
//
// Every predicate is written once, over the integers of integers.h, and runs on machine integers where the coordinates
// allow it. Integers right after the filter, no floating-point expansions between. What
// reaches this file is mostly ties, and an expansion of a tie has to be carried to its last component.
#include "predicates/exact.h"

#include "base/dimensions.h"
#include "predicates/integers.h"

namespace dsw {
namespace exact {

namespace {

using integers::cross;
using integers::dot;
using integers::evaluate;
using integers::Normal;
using integers::Points;
using integers::sign;
using integers::turned;
using integers::Vec;
using integers::wide;

template <class R, int D, int Count>
ShiftedSign plane_side_of(const Points<R, D, Count>& x) noexcept {
  const Normal<R, D> n = x.normal(0);
  const int s = sign(dot<R>(n, x.difference(D, 0)));
  if (s != 0) return {s, false};
  return {n.first_sign(), true};
}

// Points p, q, ridge.
template <class R>
ShiftedSign line_side_of(const Points<R, 3, 4>& x) noexcept {
  const Vec<R, 3> u = x.difference(1, 0);
  const int s = sign(dot<R>(cross<R>(u, x.difference(2, 0)), x.difference(3, 0)));
  if (s != 0) return {s, false};
  return {cross<R>(u, x.difference(3, 2)).first_sign(), true};
}
template <class R>
ShiftedSign line_side_of(const Points<R, 2, 3>& x) noexcept {
  // u_x w_y - u_y w_x = -(u_y, -u_x).w for w = a-p; with a-p-s instead, the shift adds +(u_y, -u_x).
  const Normal<R, 2> n = turned<R>(x.difference(1, 0));
  const int s = -sign(dot<R>(n, x.difference(2, 0)));
  if (s != 0) return {s, false};
  return {n.first_sign(), true};
}

// Points p, q, a, b. Numerators are n.(a-p), denominators n.u; the shift subtracts n.s from the numerators.
template <class R, int D, int Count>
ShiftedSign compare_times_of(const Points<R, D, Count>& x) noexcept {
  const Vec<R, D> u = x.difference(1, 0);
  const Normal<R, D> na = x.normal(2);
  const Normal<R, D> nb = x.normal(2 + D);
  const auto da = wide(dot<R>(na, u));
  const auto db = wide(dot<R>(nb, u));
  const int turn = da.sign() * db.sign();
  const auto ta = wide(dot<R>(na, x.difference(2, 0)));
  const auto tb = wide(dot<R>(nb, x.difference(2 + D, 0)));
  int s = compare(ta * db, tb * da);
  if (s != 0) return {turn * s, false};
  for (int k = 0; k < D && s == 0; ++k) s = compare(wide(nb.v[k]) * da, wide(na.v[k]) * db);
  return {turn * s, true};
}

template <class R, int D, int Count>
int orient_of(const Points<R, D, Count>& x) noexcept {
  return sign(dot<R>(x.normal(0), x.difference(D, 0)));
}

/** Whether four points are at two places if a coordinate is left out: they lie in a plane, as on the sides of prisms that stand upright. */
bool are_upright(const double* const (&p)[4]) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const auto same = [&](int a, int b) { return p[a][i] == p[b][i] && p[a][j] == p[b][j]; };
    if ((same(0, 1) && same(2, 3)) || (same(0, 2) && same(1, 3)) || (same(0, 3) && same(1, 2))) return true;
  }
  return false;
}
bool are_upright(const double* const (&)[3]) noexcept { return false; }

}  // namespace

template <int D>
ShiftedSign plane_side(const double* const* simplex, const double* q) noexcept {
  const double* points[D + 1];
  for (int i = 0; i < D; ++i) points[i] = simplex[i];
  points[D] = q;
  return evaluate<D>(points, [](const auto& x) noexcept { return plane_side_of(x); });
}

template <int D>
ShiftedSign line_side(const double* p, const double* q, const double* const* ridge) noexcept {
  const double* points[D + 1] = {p, q};
  for (int i = 0; i < D - 1; ++i) points[2 + i] = ridge[i];
  return evaluate<D>(points, [](const auto& x) noexcept { return line_side_of(x); });
}

template <int D>
ShiftedSign compare_times(const double* p, const double* q, const double* const* a, const double* const* b) noexcept {
  const double* points[2 + 2 * D] = {p, q};
  for (int i = 0; i < D; ++i) {
    points[2 + i] = a[i];
    points[2 + D + i] = b[i];
  }
  return evaluate<D>(points, [](const auto& x) noexcept { return compare_times_of(x); });
}

template <int D>
int orient(const double* const* simplex, const double* q) noexcept {
  const double* points[D + 1];
  for (int i = 0; i < D; ++i) points[i] = simplex[i];
  points[D] = q;
  if (are_upright(points)) return 0;
  return evaluate<D>(points, [](const auto& x) noexcept { return orient_of(x); });
}

DSW_INSTANTIATE(plane_side);
DSW_INSTANTIATE(line_side);
DSW_INSTANTIATE(compare_times);
DSW_INSTANTIATE(orient);

}  // namespace exact
}  // namespace dsw
