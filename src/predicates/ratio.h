// Exact quotients as doubles. Private to this folder.
#pragma once

#include <cstdint>
#include <cstring>

#include "predicates/wide_int.h"

namespace dsw {

inline double from_bits(std::uint64_t bits) noexcept {
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

// 2^e for e in [-1022, 1023].
inline double power_of_two(int e) noexcept { return from_bits(static_cast<std::uint64_t>(e + 1023) << 52); }

// Largest double <= numerator / denominator, clamped to [0,1]; 0 if the denominator is not positive.
template <int A>
double ratio_down(const WideInt<A>& numerator, const WideInt<A>& denominator) noexcept {
  if (numerator.sign() <= 0 || denominator.sign() <= 0) return 0;
  if (compare(numerator, denominator) >= 0) return 1;
  // The quotient of numerator * 2^k lies in [2^52, 2^54): one bit too many at most. Floors of floors are floors.
  int k = 53 + denominator.bit_length() - numerator.bit_length();
  std::uint64_t quotient =
      limbs::scaled_quotient(numerator.limb(), numerator.size(), k, denominator.limb(), denominator.size());
  if (quotient >> 53 != 0) {
    quotient >>= 1;
    --k;
  }
  if (k <= 1074) return from_bits((static_cast<std::uint64_t>(1075 - k) << 52) | (quotient & 0xfffffffffffffu));
  const int lost = k - 1074;  // subnormal
  return lost < 64 ? from_bits(quotient >> lost) : 0;
}

}  // namespace dsw
