// Signed integers of so many words, in two's complement, without a branch. Nothing overflows where the caller proves it. Private
// to this folder.
#pragma once

#include <cstdint>

#include "predicates/ball.h"

namespace dsw {

template <int N>
struct FixedInt {
  std::uint64_t limb[N];  // least significant first

  FixedInt() = default;
  explicit FixedInt(std::int64_t x) noexcept {
    limb[0] = static_cast<std::uint64_t>(x);
    fill(1, x < 0);
  }
  explicit FixedInt(Int128 x) noexcept {
    limb[0] = static_cast<std::uint64_t>(x);
    limb[1] = static_cast<std::uint64_t>(x >> 64);
    fill(2, static_cast<std::int64_t>(limb[1]) < 0);
  }
  explicit FixedInt(const integers::Int256& x) noexcept {
    static_assert(N >= 4, "it must hold the number");
    for (int i = 0; i < 4; ++i) limb[i] = x.limb[i];
    fill(4, x.limb[3] >> 63 != 0);
  }
  template <int M>
  explicit FixedInt(const FixedInt<M>& x) noexcept {
    static_assert(N >= M, "it must hold the number");
    for (int i = 0; i < M; ++i) limb[i] = x.limb[i];
    fill(M, x.is_negative());
  }

  bool is_negative() const noexcept { return limb[N - 1] >> 63 != 0; }
  int sign() const noexcept {
    std::uint64_t any = 0;
    for (int i = 0; i < N; ++i) any |= limb[i];
    return is_negative() ? -1 : any != 0 ? 1 : 0;
  }

  friend FixedInt operator+(const FixedInt& a, const FixedInt& b) noexcept {
    FixedInt r;
    Uint128 carry = 0;
    for (int i = 0; i < N; ++i) {
      carry += static_cast<Uint128>(a.limb[i]) + b.limb[i];
      r.limb[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return r;
  }
  FixedInt operator-() const noexcept {
    FixedInt r;
    Uint128 carry = 1;
    for (int i = 0; i < N; ++i) {
      carry += ~limb[i];
      r.limb[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return r;
  }
  friend FixedInt operator-(const FixedInt& a, const FixedInt& b) noexcept { return a + -b; }
  friend FixedInt operator*(const FixedInt& a, std::uint64_t b) noexcept {
    FixedInt r;
    std::uint64_t carry = 0;
    for (int i = 0; i < N; ++i) {
      const Uint128 part = static_cast<Uint128>(a.limb[i]) * b + carry;
      r.limb[i] = static_cast<std::uint64_t>(part);
      carry = static_cast<std::uint64_t>(part >> 64);
    }
    return r;
  }
  // Times 2^(64 words).
  FixedInt up(int words) const noexcept {
    FixedInt r;
    for (int i = 0; i < N; ++i) r.limb[i] = i < words ? 0 : limb[i - words];
    return r;
  }

  // With an error of N + 3 roundings, below 8u for what is used here.
  double rounded() const noexcept {
    const FixedInt size = is_negative() ? -*this : *this;
    double sum = 0;
    for (int i = N; i-- > 0;) sum = sum * 0x1p64 + static_cast<double>(size.limb[i]);
    return is_negative() ? -sum : sum;
  }

  Ball ball() const noexcept {
    const FixedInt size = is_negative() ? -*this : *this;
    int top = N - 1;
    while (top > 0 && size.limb[top] == 0) --top;
    if (top == 0) return balls::normal(size.limb[0], 0, is_negative(), 0);
    const Uint128 words = static_cast<Uint128>(size.limb[top]) << 64 | Uint128(size.limb[top - 1]);
    const int zeros = balls::leading_zeros(words), below = top > 1 ? zeros : 0;
    Uint128 magnitude = words << zeros;
    if (below > 0) magnitude = magnitude | Uint128(size.limb[top - 2] >> (64 - below));
    bool is_exact = top < 2 || size.limb[top - 2] << below == 0;
    for (int i = 0; i < top - 2; ++i) is_exact = is_exact && size.limb[i] == 0;
    return {magnitude, 64 * (top - 1) - zeros, is_negative(), is_exact ? 0.0 : 1.0};
  }

 private:
  void fill(int from, bool negative) noexcept {
    for (int i = from; i < N; ++i) limb[i] = negative ? ~std::uint64_t{0} : 0;
  }
};

}  // namespace dsw
