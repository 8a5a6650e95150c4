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

template <int D>
void find_touches(const Pairs<D>& pairs, const Parallel& parallel, size_t count, dsw_pair_touch* touches) {
  std::atomic<bool> out_of_memory{false};
  auto body = [&](size_t begin, size_t end) noexcept {
    try {
      for (size_t i = begin; i < end; ++i) {
        const FirstTouch touch = first_touch<D>(pairs[i]);
        touches[i] = {touch.time, touch.touches ? 1u : 0u, 0};
      }
    } catch (const std::bad_alloc&) {
      out_of_memory = true;
    }
  };
  share_out(parallel, count, body);
  if (out_of_memory) throw std::bad_alloc();
}

/** Ranks of pairs whose rounded times are equal. `first` is the rank of the earliest. */
template <int D>
void rank_equal_times(const Pairs<D>& pairs, uint32_t* begin, uint32_t* end, uint32_t first, dsw_pair_touch* touches) {
  // The time 1 is never rounded: the move ends there.
  const bool is_end = touches[*begin].time == 1;
  const auto compare = [&](uint32_t a, uint32_t b) {
    return is_end ? 0 : compare_first_touches<D>(pairs[a], pairs[b]);
  };
  // Often all are equal, as at time 0, and need no sorting.
  const bool are_equal = std::all_of(begin + 1, end, [&](uint32_t i) { return compare(*begin, i) == 0; });
  if (!are_equal) std::sort(begin, end, [&](uint32_t a, uint32_t b) { return compare(a, b) < 0; });
  uint32_t rank = first;
  for (const uint32_t* i = begin; i != end; ++i) {
    if (!are_equal && i != begin && compare(i[-1], *i) != 0) rank = first + static_cast<uint32_t>(i - begin);
    touches[*i].rank = rank;
  }
}

template <int D>
void find_ranks(const Pairs<D>& pairs, const Memory* memory, size_t count, dsw_pair_touch* touches) {
  Array<uint32_t> order(memory);
  const auto does_touch = [](const dsw_pair_touch& touch) { return touch.touches != 0; };
  order.reserve(static_cast<size_t>(std::count_if(touches, touches + count, does_touch)));
  for (uint32_t i = 0; i < count; ++i) {
    if (does_touch(touches[i])) order.push_back(i);
  }
  const auto time = [&](uint32_t i) { return touches[i].time; };
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return time(a) < time(b); });
  uint32_t* const all = order.data();
  uint32_t* const end = all + order.size();
  for (uint32_t *begin = all, *next; begin != end; begin = next) {
    next = std::find_if(begin, end, [&](uint32_t i) { return time(i) != time(*begin); });
    rank_equal_times(pairs, begin, next, static_cast<uint32_t>(begin - all), touches);
  }
  for (size_t i = 0; i < count; ++i) {
    if (!does_touch(touches[i])) touches[i].rank = static_cast<uint32_t>(order.size());
  }
}

}  // namespace

template <int D>
void sweep_pairs(const Memory* memory, const Parallel& parallel, size_t count, const uint8_t* kinds, PointArray from,
                 PointArray to, bool with_ranks, dsw_pair_touch* touches) {
  const Pairs<D> pairs{kinds, from, to};
  find_touches(pairs, parallel, count, touches);
  if (with_ranks) find_ranks(pairs, memory, count, touches);
}

DSW_INSTANTIATE(sweep_pairs);

}  // namespace dsw
