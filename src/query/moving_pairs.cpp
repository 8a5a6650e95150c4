#include "query/moving_pairs.h"

#include <algorithm>

#include "base/batch.h"
#include "base/dimensions.h"
#include "predicates/turning_pair.h"

namespace dsw {
namespace {

/** The pairs of a batch as the predicates take them. */
template <int D>
struct Pairs {
  const uint8_t* kinds;
  PointArray from, to;

  MovingPair<D> operator[](size_t pair) const {
    MovingPair<D> moving;
    moving.kind = static_cast<PairKind>(kinds[pair]);
    for (size_t k = 0; k <= D; ++k) {
      moving.start[k] = from[(D + 1) * pair + k];
      moving.end[k] = to[(D + 1) * pair + k];
    }
    return moving;
  }
};

/** Pairs of features that may turn. */
template <int D>
struct RigidPairs {
  const uint8_t* kinds;
  PointArray from, to;
  const TurningWay* ways;
  const uint32_t* motions;  // two for each pair

  TurningPair<D> operator[](size_t pair) const {
    TurningPair<D> turning;
    turning.kind = static_cast<PairKind>(kinds[pair]);
    for (size_t k = 0; k <= D; ++k) {
      turning.start[k] = from[(D + 1) * pair + k];
      turning.end[k] = to[(D + 1) * pair + k];
    }
    for (size_t side = 0; side < 2; ++side) {
      const uint32_t motion = motions[2 * pair + side];
      turning.way[side] = motion == kNoMotion ? nullptr : ways + motion;
    }
    return turning;
  }
};

/** A pair to be ranked, and whether its time is exact. */
struct Ranked {
  uint32_t pair;
  bool is_exact;
};

/** Pairs begin .. end-1. `ranked`: all pairs, in their order, or null. */
template <class Pairs>
void find_touches(const Pairs& pairs, size_t begin, size_t end, dsw_pair_touch* touches, Ranked* ranked) {
  for (size_t i = begin; i < end; ++i) {
    const FirstTouch touch = first_touch(pairs[i]);
    touches[i] = {touch.time, touch.touches ? 1u : 0u, 0};
    if (ranked != nullptr) ranked[i] = {static_cast<uint32_t>(i), touch.is_exact};
  }
}

/** Compares the first times of two pairs of a batch that touch: `compare` returns the sign of a's minus b's. */
struct Order {
  const void* pairs;
  const dsw_pair_touch* touches;
  int (*compare)(const Order& order, const Ranked& a, const Ranked& b);
};

template <class Pairs>
int compare_touches(const Order& order, const Ranked& a, const Ranked& b) {
  const Pairs& pairs = *static_cast<const Pairs*>(order.pairs);
  const FirstTouch of_a{true, order.touches[a.pair].time, a.is_exact},
      of_b{true, order.touches[b.pair].time, b.is_exact};
  return compare_first_touches(pairs[a.pair], of_a, pairs[b.pair], of_b);
}

/** Ranks the pairs that touch. It is one function for all kinds of pairs, since a sort is 5 KB of code. */
void find_ranks(const Order& order, Array<Ranked>& ranked, size_t count, dsw_pair_touch* touches) {
  const auto is_apart = [&](const Ranked& each) { return touches[each.pair].touches == 0; };
  ranked.erase(std::remove_if(ranked.begin(), ranked.end(), is_apart), ranked.end());
  const auto compare = [&](const Ranked& a, const Ranked& b) { return order.compare(order, a, b); };
  std::sort(ranked.begin(), ranked.end(), [&](const Ranked& a, const Ranked& b) { return compare(a, b) < 0; });
  const auto touching = static_cast<uint32_t>(ranked.size());
  for (size_t i = 0; i < count; ++i) touches[i].rank = touching;
  for (uint32_t i = 0; i < touching; ++i) {
    const bool is_equal = i != 0 && compare(ranked[i - 1], ranked[i]) == 0;
    touches[ranked[i].pair].rank = is_equal ? touches[ranked[i - 1].pair].rank : i;
  }
}

/** Fills touches of a batch that may be shared out, and may have ranks. */
template <class Pairs>
DSW_NOINLINE void sweep_many(const Memory* memory, const Parallel& parallel, const Pairs& pairs, size_t count,
                             bool with_ranks, dsw_pair_touch* touches) {
  Array<Ranked> ranked(with_ranks ? count : 0, Ranked{}, memory);
  share_or_throw([&](auto& chunk) { share_out(parallel, count, chunk); },
                 [&](size_t begin, size_t end) {
                   find_touches(pairs, begin, end, touches, with_ranks ? ranked.data() : nullptr);
                 });
  if (with_ranks) find_ranks({&pairs, touches, compare_touches<Pairs>}, ranked, count, touches);
}

/** Fills touches. */
template <class Pairs>
void sweep_all(const Memory* memory, const Parallel& parallel, const Pairs& pairs, size_t count, bool with_ranks,
               dsw_pair_touch* touches) {
  if (with_ranks || count > kChunk) {
    sweep_many(memory, parallel, pairs, count, with_ranks, touches);
  } else {
    find_touches(pairs, 0, count, touches, nullptr);
  }
}

}  // namespace

template <int D>
void sweep_pairs(const Memory* memory, const Parallel& parallel, size_t count, const uint8_t* kinds, PointArray from,
                 PointArray to, bool with_ranks, dsw_pair_touch* touches) {
  sweep_all(memory, parallel, Pairs<D>{kinds, from, to}, count, with_ranks, touches);
}

template <int D>
void sweep_rigid_pairs(const Memory* memory, const Parallel& parallel, size_t count, const uint8_t* kinds,
                       PointArray from, PointArray to, const TurningWay* ways, const uint32_t* motions, bool with_ranks,
                       dsw_pair_touch* touches) {
  sweep_all(memory, parallel, RigidPairs<D>{kinds, from, to, ways, motions}, count, with_ranks, touches);
}

DSW_INSTANTIATE(sweep_pairs);
DSW_INSTANTIATE(sweep_rigid_pairs);

}  // namespace dsw
