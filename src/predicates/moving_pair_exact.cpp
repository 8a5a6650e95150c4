#include "predicates/moving_pair_exact.h"

namespace dsw {

namespace {

// Points of the triangles of a pair in space; in the plane there is only the first.
constexpr int kTriangle[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};

// Whether the pair is apart: the point is not in the triangle, or both ends of an edge are on one side of the other. At
// least one sign is not 0. The same rule as judge() of the filter, but there 0 is unknown.
bool areas_part(PairKind kind, const int (&sign)[4]) noexcept {
  if (kind == PairKind::kEdgeEdge) return sign[0] * sign[1] > 0 || sign[2] * sign[3] > 0;
  const int side = sign[3];
  return side == 0 || sign[2] * side < 0 || sign[1] * side > 0 || sign[0] * side < 0;
}

// The points of one feature and of the other, each of the first with each of the second.
struct Opposite {
  int count;
  int pair[4][2];
};
const Opposite& opposite(PairKind kind) noexcept {
  static constexpr Opposite kOf[3] = {
      {3, {{0, 1}, {0, 2}, {0, 3}}}, {4, {{0, 2}, {0, 3}, {1, 2}, {1, 3}}}, {2, {{0, 1}, {0, 2}}}};
  return kOf[static_cast<int>(kind)];
}

}  // namespace

template <int D>
ExactPair<D>::ExactPair(IntegerPool& pool, const MovingPair<D>& pair) : pool_(pool), kind_(pair.kind) {
  const double* points[2 * (D + 1)];
  for (int i = 0; i <= D; ++i) {
    points[i] = pair.start[i];
    points[D + 1 + i] = pair.end[i];
  }
  const integers::Span<D> span(points);
  for (int k = 0; k < D; ++k) {
    const Integer start = integer_of(pool, points[0][k], span.low[k]);
    const Integer end = integer_of(pool, points[D + 1][k], span.low[k]);
    for (int i = 1; i <= D; ++i) {
      Polynomial& p = from_first_[k][i];
      p.c[0] = integer_of(pool, points[i][k], span.low[k]) - start;
      p.c[1] = integer_of(pool, points[D + 1 + i][k], span.low[k]) - end - p.c[0];
      p.degree = 1;
      p.trim();
    }
  }
}

template <int D>
Polynomial ExactPair<D>::difference(int axis, int i, int j) const {
  if (i == 0) return from_first_[axis][j];
  return from_first_[axis][j] - from_first_[axis][i];
}

template <int D>
const Polynomial& ExactPair<D>::area(int view, int triangle) {
  Polynomial& r = area_[view][triangle];
  if (!has_area_[view][triangle]) {
    has_area_[view][triangle] = true;
    const int x = D == 3 ? (view + 1) % 3 : 0, y = D == 3 ? (view + 2) % 3 : 1;
    const auto [a, b, c] = kTriangle[triangle];
    r = difference(x, a, b) * difference(y, a, c) - difference(y, a, b) * difference(x, a, c);
  }
  return r;
}

template <>
Polynomial ExactPair<2>::volume() {
  return area(0, 0);
}
template <>
Polynomial ExactPair<3>::volume() {
  Polynomial sum = from_first_[0][1] * area(0, 2);
  for (int k = 1; k < 3; ++k) sum = sum + from_first_[k][1] * area(k, 2);
  return sum;
}

template <int D>
bool ExactPair<D>::touches_in_line(const Root& time) const {
  const Opposite& pairs = opposite(kind_);
  for (int k = 0; k < D; ++k) {
    const int first = sign_at(difference(k, pairs.pair[0][0], pairs.pair[0][1]), time);
    bool apart = first != 0;
    for (int i = 1; i < pairs.count && apart; ++i) {
      apart = sign_at(difference(k, pairs.pair[i][0], pairs.pair[i][1]), time) == first;
    }
    if (apart) return false;
  }
  return true;
}

// The volume is 0 at this time.
template <int D>
bool ExactPair<D>::touches(const Root& time) {
  if constexpr (D == 3) {
    for (int k = 0; k < 3; ++k) {
      int sign[4];
      for (int i = 0; i < 4; ++i) sign[i] = sign_at(area(k, i), time);
      if (sign[0] != 0 || sign[1] != 0 || sign[2] != 0 || sign[3] != 0) return !areas_part(kind_, sign);
    }
  }
  return touches_in_line(time);
}

template <int D>
bool ExactPair<D>::find_first_root(const Polynomial& p, Root* first) {
  Root roots[3];
  const int count = find_roots(pool_, p, roots);
  for (int i = 0; i < count; ++i) {
    if (touches(roots[i])) {
      *first = roots[i];
      return true;
    }
  }
  return false;
}

template <int D>
void ExactPair<D>::consider(const Polynomial& p, bool* found, Root* first) {
  if (p.degree <= 0) return;
  Root root;
  if (find_first_root(p, &root) && (!*found || compare(root, *first) < 0)) {
    *found = true;
    *first = root;
  }
}

// The volume is always 0.
template <int D>
bool ExactPair<D>::find_first_change(Root* first) {
  *first = root_at_start();
  if (touches(*first)) return true;
  bool found = false;
  if constexpr (D == 3) {
    for (int k = 0; k < 3; ++k) {
      bool seen = false;
      for (int i = 0; i < 4; ++i) seen = seen || area(k, i).degree >= 0;
      if (!seen) continue;
      for (int i = 0; i < 4; ++i) consider(area(k, i), &found, first);
      return found;
    }
  }
  const Opposite& pairs = opposite(kind_);
  for (int k = 0; k < D; ++k) {
    for (int i = 0; i < pairs.count; ++i) consider(difference(k, pairs.pair[i][0], pairs.pair[i][1]), &found, first);
  }
  return found;
}

template <int D>
bool ExactPair<D>::find_first(Root* first) {
  const Polynomial f = volume();
  return f.degree >= 0 ? find_first_root(f, first) : find_first_change(first);
}

template <int D>
int ExactPair<D>::kept_side() {
  const Polynomial f = volume();
  Root roots[3];
  if (f.degree < 0 || find_roots(pool_, f, roots) != 0) return 0;
  return sign_at(f, root_at_start());
}

template class ExactPair<2>;
template class ExactPair<3>;

}  // namespace dsw
