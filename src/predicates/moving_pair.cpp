#include "predicates/moving_pair.h"

#include "predicates/moving_pair_exact.h"
#include "predicates/moving_pair_filter.h"
#include "predicates/moving_pair_small.h"

namespace dsw {

namespace {

template <int D>
auto find_of(const MovingPair<D>& pair) {
  return [&pair](IntegerPool& pool, Root* first) { return ExactPair<D>(pool, pair).find_first(first); };
}

template <int D>
DSW_COLD FirstTouch first_touch_by_integers(const MovingPair<D>& pair, PairWork* work) {
  FirstTouch touch{};
  if (small_first_touch(pair, &touch)) return touch;
  return exact_touch::first_touch([&pair](IntegerPool& pool) { return ExactPair<D>(pool, pair).first_touch(); }, work);
}

template <int D>
DSW_COLD int compare_by_integers(const MovingPair<D>& a, const MovingPair<D>& b, PairWork* work) {
  return exact_touch::compare_first_touches(find_of(a), find_of(b), work);
}

template <int D>
DSW_COLD int kept_side_by_integers(const MovingPair<D>& points) {
  IntegerPool pool;
  return ExactPair<D>(pool, points).kept_side();
}

}  // namespace

template <int D>
FirstTouch first_touch(const MovingPair<D>& pair, PairWork* work, double until) {
  double time = 0;
  const Filtered answer = filter_first_touch(pair, until, &time);
  if (answer == Filtered::kUnknown) return first_touch_by_integers(pair, work);
  // Time 0 is exact: doubles next to it are nearer to each other than the bounds of roots.
  return answer == Filtered::kApart ? FirstTouch{false, 0} : FirstTouch{true, time, time == 0};
}

template <int D>
int compare_first_touches(const MovingPair<D>& a, const FirstTouch& first_a, const MovingPair<D>& b,
                          const FirstTouch& first_b, PairWork* work) {
  if (first_a.time != first_b.time) return first_a.time < first_b.time ? -1 : 1;
  return first_a.is_exact && first_b.is_exact ? 0 : compare_by_integers(a, b, work);
}

template <int D>
int kept_side(const MovingPair<D>& points) {
  bool is_sure = false;
  const int side = filter_kept_side(points, &is_sure);
  return is_sure ? side : kept_side_by_integers(points);
}

template FirstTouch first_touch(const MovingPair<2>&, PairWork*, double);
template FirstTouch first_touch(const MovingPair<3>&, PairWork*, double);
template int compare_first_touches(const MovingPair<2>&, const FirstTouch&, const MovingPair<2>&, const FirstTouch&,
                                   PairWork*);
template int compare_first_touches(const MovingPair<3>&, const FirstTouch&, const MovingPair<3>&, const FirstTouch&,
                                   PairWork*);
template int kept_side(const MovingPair<2>&);
template int kept_side(const MovingPair<3>&);

}  // namespace dsw
