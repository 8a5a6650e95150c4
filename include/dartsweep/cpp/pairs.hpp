// Pairs of moving features: dsw_sweep_pairs, whose comment says what it does.
#pragma once

#include "dartsweep/cpp/arrays.hpp"
#include "dartsweep/cpp/handles.hpp"

namespace dartsweep {

/** Fills `touches`, one for each of `kinds`. A pair has `dimension + 1` points. `kinds` are
 * dsw_pair_kind, and `context` may be null. */
inline void sweep_pairs(std::uint32_t dimension, View<const std::uint8_t> kinds, Points from,
                        Points to, View<dsw_pair_touch> touches, std::uint32_t flags = 0,
                        const Context *context = nullptr) {
  if (dimension != 2 && dimension != 3)
    throw OutOfRange("dimension is " + std::to_string(dimension) + ", must be 2 or 3");
  count_points(dimension, from, to);
  same_count("from", from.count, (dimension + 1) * kinds.count);
  same_count("to", to.count, from.count);
  same_count("touches", touches.count, kinds.count);
  check(dsw_sweep_pairs(context ? context->state().get() : nullptr, dimension, kinds.count,
                        kinds.data, from.data, to.data, common_stride(from, to), flags,
                        touches.data));
}

}  // namespace dartsweep
