#pragma once
// Rows of numbers that a host gives: motions and poses.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/error.h"

namespace dsw::capi {

/** Throws unless all numbers of a row are finite, and those are 0 whose bits are set in `zeros`: what would leave the plane.
 * @param name of the array that has the row. */
inline void check_row(const char* name, size_t row, const double* numbers, size_t count, uint32_t zeros) {
  for (size_t k = 0; k < count; ++k) {
    if (!std::isfinite(numbers[k])) {
      fail(DSW_STATUS_NON_FINITE, "%s[%zu][%zu] is %g, must be finite", name, row, k, numbers[k]);
    }
  }
  for (size_t k = 0; zeros >> k != 0; ++k) {
    if ((zeros >> k & 1) == 0 || numbers[k] == 0) continue;
    fail(DSW_STATUS_OUT_OF_RANGE, "%s[%zu][%zu] is %g, must be 0 in the plane", name, row, k, numbers[k]);
  }
}

}  // namespace dsw::capi
