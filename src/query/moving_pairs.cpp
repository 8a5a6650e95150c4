#include "query/moving_pairs.h"

#include <algorithm>
#include <atomic>
#include <new>

#include "base/batch.h"
#include "base/dimensions.h"
#include "predicates/moving_pair.h"

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

/** A pair to be ranked, and whether its time is exact. */
struct Ranked {
  uint32_t pair;
  bool is_exact;
};

/** `ranked`: all pairs, in their order, or none. */
template <int D>
void find_touches(const Pairs<D>& pairs, const Parallel& parallel, size_t count, dsw_pair_touch* touches,
                  Array<Ranked>& ranked) {
  std::atomic<bool> out_of_memory{false};
  auto body = [&](size_t begin, size_t end) noexcept {
    try {
      for (size_t i = begin; i < end; ++i) {
        const FirstTouch touch = first_touch<D>(pairs[i]);
        touches[i] = {touch.time, touch.touches ? 1u : 0u, 0};
        if (!ranked.empty()) ranked[i] = {static_cast<uint32_t>(i), touch.is_exact};
      }
    } catch (const std::bad_alloc&) {
      out_of_memory = true;
    }
  };
  share_out(parallel, count, body);
  if (out_of_memory) throw std::bad_alloc();
}

template <int D>
void find_ranks(const Pairs<D>& pairs, Array<Ranked>& ranked, size_t count, dsw_pair_touch* touches) {
  const auto is_apart = [&](const Ranked& each) { return touches[each.pair].touches == 0; };
  ranked.erase(std::remove_if(ranked.begin(), ranked.end(), is_apart), ranked.end());
  const auto compare = [&](const Ranked& a, const Ranked& b) {
    const FirstTouch of_a{true, touches[a.pair].time, a.is_exact}, of_b{true, touches[b.pair].time, b.is_exact};
    return compare_first_touches<D>(pairs[a.pair], of_a, pairs[b.pair], of_b);
  };
  std::sort(ranked.begin(), ranked.end(), [&](const Ranked& a, const Ranked& b) { return compare(a, b) < 0; });
  const auto touching = static_cast<uint32_t>(ranked.size());
  for (size_t i = 0; i < count; ++i) touches[i].rank = touching;
  for (uint32_t i = 0; i < touching; ++i) {
    const bool is_equal = i != 0 && compare(ranked[i - 1], ranked[i]) == 0;
    touches[ranked[i].pair].rank = is_equal ? touches[ranked[i - 1].pair].rank : i;
  }
}

}  // namespace

template <int D>
void sweep_pairs(const Memory* memory, const Parallel& parallel, size_t count, const uint8_t* kinds, PointArray from,
                 PointArray to, bool with_ranks, dsw_pair_touch* touches) {
  const Pairs<D> pairs{kinds, from, to};
  Array<Ranked> ranked(with_ranks ? count : 0, Ranked{}, memory);
  find_touches(pairs, parallel, count, touches, ranked);
  if (with_ranks) find_ranks(pairs, ranked, count, touches);
}

DSW_INSTANTIATE(sweep_pairs);

}  // namespace dsw
