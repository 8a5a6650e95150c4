#pragma once
// Arguments of calls in which points go: an array of starts, and one of ends with the same stride.

#include "base/points.h"

namespace dsw {

/** Where points start and where they end. */
struct PointEnds {
  PointArray starts, ends;
};

/** Returns the arguments "from" and "to", and throws unless all coordinates are finite. Both are read in one pass. */
PointEnds to_finite_ends(int dimension, const double* from, const double* to, size_t count, size_t stride_bytes);

}  // namespace dsw
