#pragma once
// Casts of a part of a batch, for callers that ask more about each segment while it is at hand.

#include "query/starts.h"

namespace dsw {

/** Casts segments begin .. end-1, a packet at a time; not with open ends. */
template <int D>
void cast_range(const Environment<D>& env, Starts<D> starts, PointArray from, PointArray to, SegmentOptions options,
                size_t begin, size_t end, dsw_flight* flights) noexcept;

}  // namespace dsw
