#pragma once
// Pairs of moving features in batches: when each first touches, and in which order. Arguments have been checked.

#include "base/memory.h"
#include "base/parallel.h"
#include "base/points.h"
#include "dartsweep/pairs.h"
#include "predicates/turning_pair.h"

namespace dsw {

/** Pairs with D + 1 points each. Throws std::bad_alloc. */
template <int D>
void sweep_pairs(const Memory* memory, const Parallel& parallel, size_t count, const uint8_t* kinds, PointArray from,
                 PointArray to, bool with_ranks, dsw_pair_touch* touches);

constexpr uint32_t kNoMotion = UINT32_MAX;

/** Features that turn: `motions` are two for each pair, places in `ways` or kNoMotion. Throws std::bad_alloc. */
template <int D>
void sweep_rigid_pairs(const Memory* memory, const Parallel& parallel, size_t count, const uint8_t* kinds,
                       PointArray from, PointArray to, const TurningWay* ways, const uint32_t* motions, bool with_ranks,
                       dsw_pair_touch* touches);

}  // namespace dsw
