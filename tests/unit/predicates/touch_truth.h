// When closed simplices touch, over GMP: all corners of the set of points that what is swept and what stays have in
// common.
#pragma once

#include "../../gmp_numbers.h"

#include <vector>

namespace dsw {

struct TouchTruth {
  bool touches = false;   // after the start
  bool at_start = false;  // already there
  mpq_class time;         // the first, if it touches
};

/** When the hull of p(t) and the others, which stay, first meets the hull of what stands still. */
template <int D>
TouchTruth touch_truth(const double* p, const double* to, const std::vector<const double*>& others,
                       const std::vector<const double*>& still);

}  // namespace dsw
