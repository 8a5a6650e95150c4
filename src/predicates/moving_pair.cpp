#include "predicates/moving_pair.h"

#include "predicates/moving_pair_exact.h"
#include "predicates/moving_pair_filter.h"

namespace dsw {

namespace {

template <int D>
DSW_COLD FirstTouch first_touch_by_integers(const MovingPair<D>& pair) {
  IntegerPool pool;
  ExactPair<D> exact(pool, pair);
  Root first;
  if (!exact.find_first(&first)) return {false, 0};
  return {true, first.floor, first.is_floor};
}

template <int D>
DSW_COLD int compare_by_integers(const MovingPair<D>& a, const MovingPair<D>& b) {
  IntegerPool pool;
  Root first[2];
  ExactPair<D>(pool, a).find_first(&first[0]);
  ExactPair<D>(pool, b).find_first(&first[1]);
  return compare(first[0], first[1]);
}

template <int D>
DSW_COLD int kept_side_by_integers(const MovingPair<D>& points) {
  IntegerPool pool;
  return ExactPair<D>(pool, points).kept_side();
}

}  // namespace

template <int D>
FirstTouch first_touch(const MovingPair<D>& pair) {
  double time = 0;
  const Filtered answer = filter_first_touch(pair, &time);
  if (answer == Filtered::kUnknown) return first_touch_by_integers(pair);
  return answer == Filtered::kApart ? FirstTouch{false, 0} : FirstTouch{true, time};
}

template <int D>
int compare_first_touches(const MovingPair<D>& a, const FirstTouch& first_a, const MovingPair<D>& b,
                          const FirstTouch& first_b) {
  if (first_a.time != first_b.time) return first_a.time < first_b.time ? -1 : 1;
  return first_a.is_exact && first_b.is_exact ? 0 : compare_by_integers(a, b);
}

template <int D>
int kept_side(const MovingPair<D>& points) {
  bool is_sure = false;
  const int side = filter_kept_side(points, &is_sure);
  return is_sure ? side : kept_side_by_integers(points);
}

template FirstTouch first_touch(const MovingPair<2>&);
template FirstTouch first_touch(const MovingPair<3>&);
template int compare_first_touches(const MovingPair<2>&, const FirstTouch&, const MovingPair<2>&, const FirstTouch&);
template int compare_first_touches(const MovingPair<3>&, const FirstTouch&, const MovingPair<3>&, const FirstTouch&);
template int kept_side(const MovingPair<2>&);
template int kept_side(const MovingPair<3>&);

}  // namespace dsw
