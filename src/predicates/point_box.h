// The box of a few points against many others: comparisons alone, before any predicate is asked.
#pragma once

#include <cstdint>

#include "predicates/filtered.h"

namespace dsw {

template <int D>
class PointBox {
 public:
  template <class... Others>
  explicit PointBox(const double* first, Others... others) noexcept {
    for (int k = 0; k < D; ++k) {
      low_[k] = high_[k] = first[k];
      ((low_[k] = filter::smaller(low_[k], others[k])), ...);
      ((high_[k] = filter::larger(high_[k], others[k])), ...);
    }
  }

  // A bit for each side of the box that v lies strictly beyond: no shift brings them together. Points with a bit in
  // common do not meet what is in the box, nor does anything between them.
  std::uint32_t beyond(const double* v) const noexcept {
    std::uint32_t bits = 0;
    for (int k = 0; k < D; ++k) {
      bits |= static_cast<std::uint32_t>(v[k] < low_[k]) << (2 * k);
      bits |= static_cast<std::uint32_t>(v[k] > high_[k]) << (2 * k + 1);
    }
    return bits;
  }

 private:
  double low_[D], high_[D];
};

}  // namespace dsw
