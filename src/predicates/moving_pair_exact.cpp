#include "predicates/moving_pair_exact.h"

namespace dsw {

template <int D>
ExactPair<D>::ExactPair(IntegerPool& pool, const MovingPair<D>& pair) : Base(pool, pair.kind) {
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
    const auto [a, b, c] = exact_touch::kTriangle[triangle];
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
int ExactPair<D>::kept_side() {
  const Polynomial f = volume();
  Root roots[Polynomial::kMostDegree];
  if (f.degree < 0 || find_roots(this->pool_, f, roots) != 0) return 0;
  return sign_at(f, root_at_start());
}

template class ExactPair<2>;
template class ExactPair<3>;

}  // namespace dsw
