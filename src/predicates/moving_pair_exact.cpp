#include "predicates/moving_pair_exact.h"

namespace dsw {

namespace {

// A polynomial from the coefficients of (1-t)^(n-i) t^i, which change.
template <int Degree>
Polynomial polynomial_of(IntegerPool& pool, TermSum (&sums)[Degree + 1]) {
  for (int last = 1; last <= Degree; ++last) {
    for (int i = last; i > 0; --i) sums[i].subtract(sums[i - 1]);
  }
  Polynomial p;
  p.degree = Degree;
  for (int i = 0; i <= Degree; ++i) p.c[i] = sums[i].value(pool);
  p.trim();
  return p;
}

}  // namespace

template <int D>
ExactPair<D>::ExactPair(IntegerPool& pool, const MovingPair<D>& pair) : Base(pool, pair.kind) {
  const double* points[2 * (D + 1)];
  for (int i = 0; i <= D; ++i) {
    points[i] = pair.start[i];
    points[D + 1 + i] = pair.end[i];
  }
  const integers::Span<D> span(points);
  is_small_ = span.width <= kMostSmallSpan;
  if (is_small_) {
    small_ = SmallPoints<D>(pair, span.low);
    return;
  }
  width_ = span.width;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i <= D; ++i) {
      for (int k = 0; k < D; ++k) term_[side][i][k] = Term(points[side * (D + 1) + i][k], span.low[k]);
    }
  }
}

template <int D>
Polynomial ExactPair<D>::difference(int axis, int i, int j) const {
  if (is_small_) return small_.difference(this->pool_, axis, i, j);
  TermSum sums[2] = {TermSum(width_), TermSum(width_)};
  for (int side = 0; side < 2; ++side) {
    sums[side].add(term_[side][j][axis], false);
    sums[side].add(term_[side][i][axis], true);
  }
  return polynomial_of<1>(this->pool_, sums);
}

template <int D>
Polynomial ExactPair<D>::new_area(int view, int triangle) {
  if (is_small_) return small_.area(this->pool_, view, triangle);
  const int x = D == 3 ? (view + 1) % 3 : 0, y = D == 3 ? (view + 2) % 3 : 1;
  const auto [a, b, c] = exact_touch::kTriangle[triangle];
  const int pairs[3][2] = {{a, b}, {b, c}, {c, a}};
  TermSum sums[3] = {TermSum(2 * width_), TermSum(2 * width_), TermSum(2 * width_)};
  for (const auto& [first, second] : pairs) {
    for (int sides = 0; sides < 4; ++sides) {
      const Term *const p = term_[sides & 1][first], *const q = term_[sides >> 1][second];
      TermSum& sum = sums[(sides & 1) + (sides >> 1)];
      sum.add(TermPair(p[x], q[y]), false);
      sum.add(TermPair(p[y], q[x]), true);
    }
  }
  return polynomial_of<2>(this->pool_, sums);
}

template <int D>
const Polynomial& ExactPair<D>::area(int view, int triangle) {
  Polynomial& r = area_[view][triangle];
  if (!has_area_[view][triangle]) {
    has_area_[view][triangle] = true;
    r = new_area(view, triangle);
    this->pool_.products += 24;
  }
  return r;
}

// Adds the determinant of three points, times 1 or -1.
template <int D>
void ExactPair<D>::add_determinant(TermSum (&sums)[4], int a, int b, int c, bool negative) const {
  for (int sides = 0; sides < 4; ++sides) {
    const Term *const p = term_[sides & 1][a], *const q = term_[sides >> 1][b];
    TermSum* const sum = sums + (sides & 1) + (sides >> 1);
    for (int k = 0; k < 3; ++k) {
      const int x = (k + 1) % 3, y = (k + 2) % 3;
      const TermPair first(p[x], q[y]), second(p[y], q[x]);
      for (int side = 0; side < 2; ++side) {
        sum[side].add(first, term_[side][c][k], negative);
        sum[side].add(second, term_[side][c][k], !negative);
      }
    }
  }
}

template <>
Polynomial ExactPair<2>::volume() {
  return area(0, 0);
}
template <>
Polynomial ExactPair<3>::volume() {
  if (is_small_) {
    this->pool_.products += 24;
    return small_.volume(this->pool_);
  }
  TermSum sums[4] = {TermSum(3 * width_), TermSum(3 * width_), TermSum(3 * width_), TermSum(3 * width_)};
  add_determinant(sums, 1, 2, 3, false);
  add_determinant(sums, 0, 2, 3, true);
  add_determinant(sums, 0, 1, 3, false);
  add_determinant(sums, 0, 1, 2, true);
  this->pool_.products += 480;
  return polynomial_of<3>(this->pool_, sums);
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
