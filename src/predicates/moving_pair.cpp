#include "predicates/moving_pair.h"

#include "predicates/moving_pair_exact.h"

namespace dsw {

template <int D>
FirstTouch first_touch(const MovingPair<D>& pair) {
  IntegerPool pool;
  ExactPair<D> exact(pool, pair);
  Root first;
  if (!exact.find_first(&first)) return {false, 0};
  return {true, first.floor};
}

template <int D>
int compare_first_touches(const MovingPair<D>& a, const MovingPair<D>& b) {
  IntegerPool pool;
  Root first[2];
  ExactPair<D>(pool, a).find_first(&first[0]);
  ExactPair<D>(pool, b).find_first(&first[1]);
  return compare(first[0], first[1]);
}

template FirstTouch first_touch(const MovingPair<2>&);
template FirstTouch first_touch(const MovingPair<3>&);
template int compare_first_touches(const MovingPair<2>&, const MovingPair<2>&);
template int compare_first_touches(const MovingPair<3>&, const MovingPair<3>&);

}  // namespace dsw
