// The first touch of a pair whose points move along polynomials in time with integer coefficients, whatever they are.
// Private to this folder.
//
// Four points of a pair that touches lie in one plane: their volume, a polynomial in time, is 0. Project the
// points along an axis. If one of their four triangles has an area there, the projection of the plane is one-to-one. Then
// the signs of the areas, polynomials, too, say whether the pair touches. If no triangle has an area along any
// axis, all points are on one line, and the coordinates decide: the pair is apart if it is apart on one axis. In the plane
// this begins one dimension lower, with the area of the three points.
//
// If the volume is always 0, the first touch is at time 0 or at a root of one of the areas, or of one of the differences of
// coordinates if all areas are always 0.
#pragma once

#include "predicates/polynomial_curve.h"
#include "predicates/quick_touch.h"

namespace dsw {

namespace exact_touch {

inline void add(const IntegerPool& pool, PairWork* work) {
  if (work == nullptr) return;
  work->done += pool.products;
  if (work->done > work->most) throw WorkOver();
}

// ask(pool) returns the first touch.
template <class Ask>
FirstTouch first_touch(const Ask& ask, PairWork* work) {
  IntegerPool pool;
  const FirstTouch touch = ask(pool);
  add(pool, work);
  return touch;
}

// The order of two first roots that are there. find(pool, &root) finds one.
template <class FindA, class FindB>
int compare_first_touches(const FindA& find_a, const FindB& find_b, PairWork* work) {
  IntegerPool pool;
  Root first[2];
  find_a(pool, &first[0]);
  find_b(pool, &first[1]);
  const int order = compare(first[0], first[1]);
  add(pool, work);
  return order;
}

}  // namespace exact_touch

// A base of Points, which has difference(axis, i, j), a positive multiple of the coordinate of point j less that of point i,
// where the points are of two features; area(view, triangle); and volume(), in the plane the area.
template <int D, class Points>
class ExactTouch {
 public:
  FirstTouch first_touch();
  // Whether the pair touches; first is then the first time.
  bool find_first(Root* first);
  // Whether it touches at a time when its volume is 0.
  bool touches(const Root& time);

 protected:
  ExactTouch(IntegerPool& pool, PairKind kind) noexcept : pool_(pool), kind_(kind) {}

  static constexpr int kViews = D == 3 ? 3 : 1;  // axes along which areas are seen
  static constexpr int kTriangles = D == 3 ? 4 : 1;

  IntegerPool& pool_;
  PairKind kind_;

 private:
  Points& points() noexcept { return static_cast<Points&>(*this); }
  bool find_first_root(const Polynomial& p, Root* first);
  bool find_first_change(Root* first);
  void consider(const Polynomial& p, bool* found, Root* first);
};

// The volume is 0 at this time.
template <int D, class Points>
bool ExactTouch<D, Points>::touches(const Root& time) {
  return exact_touch::flat_pair_touches<D>(
      kind_, [&](int view, int i) { return sign_at(points().area(view, i), time); },
      [&](int axis, int i, int j) { return sign_at(points().difference(axis, i, j), time); });
}

template <int D, class Points>
bool ExactTouch<D, Points>::find_first_root(const Polynomial& p, Root* first) {
  Root roots[Polynomial::kMostDegree];
  const int count = find_roots(pool_, p, roots);
  for (int i = 0; i < count; ++i) {
    if (touches(roots[i])) {
      *first = roots[i];
      return true;
    }
  }
  return false;
}

template <int D, class Points>
void ExactTouch<D, Points>::consider(const Polynomial& p, bool* found, Root* first) {
  if (p.degree <= 0) return;
  Root root;
  if (find_first_root(p, &root) && (!*found || compare(root, *first) < 0)) {
    *found = true;
    *first = root;
  }
}

// The volume is always 0.
template <int D, class Points>
bool ExactTouch<D, Points>::find_first_change(Root* first) {
  *first = root_at_start();
  if (touches(*first)) return true;
  bool found = false;
  if constexpr (D == 3) {
    for (int k = 0; k < 3; ++k) {
      bool seen = false;
      for (int i = 0; i < 4; ++i) seen = seen || points().area(k, i).degree >= 0;
      if (!seen) continue;
      for (int i = 0; i < 4; ++i) consider(points().area(k, i), &found, first);
      return found;
    }
  }
  const exact_touch::Opposite& pairs = exact_touch::opposite(kind_);
  for (int k = 0; k < D; ++k) {
    for (int i = 0; i < pairs.count; ++i)
      consider(points().difference(k, pairs.pair[i][0], pairs.pair[i][1]), &found, first);
  }
  return found;
}

template <int D, class Points>
bool ExactTouch<D, Points>::find_first(Root* first) {
  const Polynomial f = points().volume();
  return f.degree >= 0 ? find_first_root(f, first) : find_first_change(first);
}

template <int D, class Points>
FirstTouch ExactTouch<D, Points>::first_touch() {
  PolynomialCurves<D, Points> curves(pool_, points());
  FirstTouch touch{};
  if (QuickTouch<D, PolynomialCurves<D, Points>>(curves, kind_).find_first(&touch)) return touch;
  Root first;
  if (!find_first(&first)) return {false, 0};
  return {true, first.floor, first.is_floor};
}

}  // namespace dsw
