#include "predicates/turning_pair.h"

#include "predicates/exact_crossing.h"
#include "predicates/moving_pair_exact.h"
#include "predicates/turning_pair_exact.h"
#include "predicates/turning_pair_filter.h"

namespace dsw {

namespace {

template <int D>
MovingPair<D> straight(const TurningPair<D>& pair) noexcept {
  MovingPair<D> r;
  r.kind = pair.kind;
  for (int i = 0; i <= D; ++i) {
    r.start[i] = pair.start[i];
    r.end[i] = pair.end[i];
  }
  return r;
}

// ask(points) of the exact pair.
template <int D, class Ask>
auto with_exact(IntegerPool& pool, const TurningPair<D>& pair, Ask ask) {
  if (pair.way[0] == nullptr && pair.way[1] == nullptr) {
    ExactPair<D> points(pool, straight(pair));
    return ask(points);
  }
  if (pair.way[0] == nullptr || pair.way[1] == nullptr) {
    ExactTurningPair<D, false> points(pool, pair);
    return ask(points);
  }
  ExactTurningPair<D, true> points(pool, pair);
  return ask(points);
}

template <int D>
auto find_of(const TurningPair<D>& pair) {
  return [&pair](IntegerPool& pool, Root* first) {
    return with_exact(pool, pair, [first](auto& points) { return points.find_first(first); });
  };
}

template <int D>
DSW_COLD FirstTouch first_touch_by_integers(const TurningPair<D>& pair, PairWork* work) {
  const auto ask = [&pair](IntegerPool& pool) {
    return with_exact(pool, pair, [](auto& points) { return points.first_touch(); });
  };
  return exact_touch::first_touch(ask, work);
}

template <int D>
DSW_COLD FirstEntry first_entry_by_integers(const TurningPair<D>& pair, PairWork* work) {
  FirstEntry entry;
  const auto ask = [&](IntegerPool& pool) {
    Root first;
    if (!ExactCrossing<D>(pool, pair).find_first(&first, &entry.is_open)) return FirstTouch{false, 0};
    return FirstTouch{true, first.floor, first.is_floor};
  };
  entry.touch = exact_touch::first_touch(ask, work);
  return entry;
}

template <int D>
DSW_COLD int compare_by_integers(const TurningPair<D>& a, const TurningPair<D>& b, PairWork* work) {
  return exact_touch::compare_first_touches(find_of(a), find_of(b), work);
}

}  // namespace

template <int D>
FirstTouch first_touch(const TurningPair<D>& pair, PairWork* work, const Asked& asked) {
  if (pair.way[0] == nullptr && pair.way[1] == nullptr) return first_touch(straight(pair), work);
  double time = 0;
  const Filtered answer = filter_first_touch(pair, asked, &time);
  if (answer == Filtered::kUnknown) return first_touch_by_integers(pair, work);
  return answer == Filtered::kApart ? FirstTouch{false, 0} : FirstTouch{true, time};
}

// What the filter is sure of has no ties.
template <int D>
FirstEntry first_entry(const TurningPair<D>& pair, PairWork* work, const Asked& asked) {
  double time = 0;
  const Filtered answer = filter_first_touch(pair, asked, &time);
  if (answer == Filtered::kUnknown) return first_entry_by_integers(pair, work);
  return {answer == Filtered::kApart ? FirstTouch{false, 0} : FirstTouch{true, time}};
}

template <int D>
int compare_first_touches(const TurningPair<D>& a, const FirstTouch& first_a, const TurningPair<D>& b,
                          const FirstTouch& first_b, PairWork* work) {
  if (first_a.time != first_b.time) return first_a.time < first_b.time ? -1 : 1;
  return first_a.is_exact && first_b.is_exact ? 0 : compare_by_integers(a, b, work);
}

template FirstTouch first_touch(const TurningPair<2>&, PairWork*, const Asked&);
template FirstTouch first_touch(const TurningPair<3>&, PairWork*, const Asked&);
template FirstEntry first_entry(const TurningPair<2>&, PairWork*, const Asked&);
template FirstEntry first_entry(const TurningPair<3>&, PairWork*, const Asked&);
template int compare_first_touches(const TurningPair<2>&, const FirstTouch&, const TurningPair<2>&, const FirstTouch&,
                                   PairWork*);
template int compare_first_touches(const TurningPair<3>&, const FirstTouch&, const TurningPair<3>&, const FirstTouch&,
                                   PairWork*);

}  // namespace dsw
