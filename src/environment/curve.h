#pragma once
// Places along the Hilbert curve. What follows each other on this curve lies side by side, which keeps boxes small.

#include <cstdint>

#include "base/memory.h"
#include "base/parallel.h"

namespace dsw {

constexpr uint32_t kCurveBits = 12;      // of a coordinate
constexpr uint32_t kCurveItemBits = 28;  // of the number of an item

template <int D>
class Curve {
 public:
  Curve() noexcept {
    for (uint32_t i = 0; i < 64; ++i) {
      spread_[i] = 0;
      for (uint32_t bit = 0; bit < 6; ++bit) spread_[i] |= uint64_t{i >> bit & 1u} << D * bit;
    }
  }

  /** How far along the curve a place is, with an item's number below it. J. Skilling, Programming the Hilbert curve, 2004:
   * places are turned and mirrored in cubes of half the size, from the largest cube on. Overwrites `x`. */
  uint64_t key(uint32_t* x, uint32_t item) const noexcept {
    for (uint32_t half = 1u << (kCurveBits - 1); half > 1; half /= 2) {
      const uint32_t below = half - 1;
      for (int k = 0; k < D; ++k) {
        const uint32_t upper = (x[k] & half) != 0 ? below : 0;
        const uint32_t swapped = (x[0] ^ x[k]) & (below ^ upper);
        x[0] ^= upper | swapped;
        x[k] ^= swapped;
      }
    }
    for (int k = 1; k < D; ++k) x[k] ^= x[k - 1];
    uint32_t mirrored = 0;
    for (uint32_t half = 1u << (kCurveBits - 1); half > 1; half /= 2) {
      if ((x[D - 1] & half) != 0) mirrored ^= half - 1;
    }
    uint64_t place = 0;
    for (int k = 0; k < D; ++k) place |= spread(x[k] ^ mirrored) << (D - 1 - k);
    return place << kCurveItemBits | item;
  }
  static uint32_t item(uint64_t key) noexcept { return static_cast<uint32_t>(key) & ((1u << kCurveItemBits) - 1); }

 private:
  /** The bits of x, D apart. */
  uint64_t spread(uint32_t x) const noexcept { return spread_[x & 63u] | spread_[x >> 6] << 6 * D; }

  uint64_t spread_[64];
};

/** Sorts keys by their places; equal places keep their order. Throws std::bad_alloc. O(keys), shared out. */
template <int D>
void sort_along_curve(Array<uint64_t>& keys, const Parallel& parallel);

}  // namespace dsw
