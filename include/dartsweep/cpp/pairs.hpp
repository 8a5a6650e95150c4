// Pairs of moving features: dsw_sweep_pairs and dsw_sweep_rigid_pairs, whose comments say what they do.
#pragma once

#include "dartsweep/cpp/arrays.hpp"
#include "dartsweep/cpp/handles.hpp"

namespace dartsweep {

/** Checks that the arrays of pairs have the lengths that belong together. */
inline void count_pairs(std::uint32_t dimension, View<const std::uint8_t> kinds, Points &from,
                        Points &to, View<dsw_pair_touch> touches) {
  if (dimension != 2 && dimension != 3)
    throw OutOfRange("dimension is " + std::to_string(dimension) + ", must be 2 or 3");
  count_points(dimension, from, to);
  same_count("from", from.count, (dimension + 1) * kinds.count);
  same_count("to", to.count, from.count);
  same_count("touches", touches.count, kinds.count);
}

/** Fills `touches`, one for each of `kinds`. A pair has `dimension + 1` points. `kinds` are
 * dsw_pair_kind, and `context` may be null. */
inline void sweep_pairs(std::uint32_t dimension, View<const std::uint8_t> kinds, Points from,
                        Points to, View<dsw_pair_touch> touches, std::uint32_t flags = 0,
                        const Context *context = nullptr) {
  count_pairs(dimension, kinds, from, to, touches);
  check(dsw_sweep_pairs(context ? context->state().get() : nullptr, dimension, kinds.count,
                        kinds.data, from.data, to.data, common_stride(from, to), flags,
                        touches.data));
}

/** sweep_pairs with features that may turn. `to` may be empty: features without a motion stand.
 * `motions` has 17 numbers for each motion, and `indices` has two for each pair. */
inline void sweep_rigid_pairs(std::uint32_t dimension, View<const std::uint8_t> kinds, Points from,
                              Points to, View<const double> motions,
                              View<const std::uint32_t> indices, View<dsw_pair_touch> touches,
                              std::uint32_t flags = 0, const Context *context = nullptr) {
  if (to.count == 0) to = from;
  count_pairs(dimension, kinds, from, to, touches);
  if (motions.count % 17 != 0)
    throw WrongSize("motions has " + std::to_string(motions.count) +
                    " numbers, must have 17 for each motion");
  same_count("indices", indices.count, 2 * kinds.count);
  check(dsw_sweep_rigid_pairs(context ? context->state().get() : nullptr, dimension, kinds.count,
                              kinds.data, from.data, to.data, common_stride(from, to), motions.data,
                              motions.count / 17, indices.data, flags, touches.data));
}

}  // namespace dartsweep
