#pragma once
// Integers of 128 bits out of two words, in two's complement, and bits of words: the portable forms of
// base/compiler.h. Operators are those that the library uses; they give what built-in integers give.

#include <cstdint>
#include <type_traits>

namespace dsw {
namespace plain {

inline uint32_t bit_count(uint64_t x) noexcept {
  uint32_t count = 0;
  for (; x != 0; x &= x - 1) ++count;
  return count;
}
/** Returns the place of the highest 1 bit of x, counted from the lowest bit; returns 63 for x = 0. */
inline uint32_t highest_bit(uint64_t x) noexcept {
  uint32_t at = 63;
  while (at != 0 && x >> at == 0) --at;
  return x == 0 ? 63 : at;
}
/** Returns the place of the lowest 1 bit of x; returns 63 for x = 0. */
inline uint32_t lowest_bit(uint64_t x) noexcept { return highest_bit(x & (~x + 1)); }

struct Int128;

struct Uint128 {
  uint64_t low, high;

  Uint128() = default;
  template <class T, std::enable_if_t<std::is_integral_v<T>, int> = 0>
  constexpr Uint128(T x) noexcept : low(static_cast<uint64_t>(x)), high(extension(x)) {}
  constexpr Uint128(uint64_t high_word, uint64_t low_word) noexcept : low(low_word), high(high_word) {}
  explicit constexpr Uint128(const Int128& x) noexcept;

  explicit constexpr operator uint64_t() const noexcept { return low; }
  explicit constexpr operator int64_t() const noexcept { return static_cast<int64_t>(low); }

  /** The high word of a number of one word. */
  template <class T>
  static constexpr uint64_t extension(T x) noexcept {
    if constexpr (std::is_signed_v<T>) return x < 0 ? ~uint64_t{0} : 0;
    return 0;
  }

  friend constexpr Uint128 operator+(const Uint128& a, const Uint128& b) noexcept {
    const uint64_t sum = a.low + b.low;
    return {a.high + b.high + (sum < a.low ? 1u : 0u), sum};
  }
  friend constexpr Uint128 operator-(const Uint128& a, const Uint128& b) noexcept {
    return {a.high - b.high - (a.low < b.low ? 1u : 0u), a.low - b.low};
  }
  friend constexpr Uint128 operator-(const Uint128& a) noexcept { return Uint128(0, 0) - a; }
  friend constexpr Uint128 operator*(const Uint128& a, const Uint128& b) noexcept {
    constexpr uint64_t kHalf = 0xffffffffu;
    const uint64_t a0 = a.low & kHalf, a1 = a.low >> 32, b0 = b.low & kHalf, b1 = b.low >> 32;
    const uint64_t bottom = a0 * b0, one = a1 * b0 + (bottom >> 32), other = a0 * b1 + (one & kHalf);
    return {a1 * b1 + (one >> 32) + (other >> 32) + a.high * b.low + a.low * b.high, other << 32 | (bottom & kHalf)};
  }
  /** b > 0. */
  friend constexpr Uint128 operator/(const Uint128& a, uint64_t b) noexcept {
    uint64_t rest = a.high % b, quotient = 0;
    for (uint32_t bit = 64; bit-- != 0;) {  // rest < b
      const bool carries = rest >> 63 != 0;
      rest = rest << 1 | (a.low >> bit & 1u);
      if (!carries && rest < b) continue;
      rest -= b;
      quotient |= uint64_t{1} << bit;
    }
    return {a.high / b, quotient};
  }
  /** bits < 128. */
  friend constexpr Uint128 operator<<(const Uint128& a, int bits) noexcept {
    if (bits == 0) return a;
    if (bits >= 64) return {a.low << (bits - 64), 0};
    return {a.high << bits | a.low >> (64 - bits), a.low << bits};
  }
  friend constexpr Uint128 operator>>(const Uint128& a, int bits) noexcept {
    if (bits == 0) return a;
    if (bits >= 64) return {0, a.high >> (bits - 64)};
    return {a.high >> bits, a.low >> bits | a.high << (64 - bits)};
  }
  friend constexpr Uint128 operator|(const Uint128& a, const Uint128& b) noexcept {
    return {a.high | b.high, a.low | b.low};
  }
  friend constexpr bool operator==(const Uint128& a, const Uint128& b) noexcept {
    return a.high == b.high && a.low == b.low;
  }
  constexpr Uint128& operator+=(const Uint128& b) noexcept { return *this = *this + b; }
  constexpr Uint128& operator>>=(int bits) noexcept { return *this = *this >> bits; }
};

struct Int128 {
  Uint128 bits;

  Int128() = default;
  template <class T, std::enable_if_t<std::is_integral_v<T>, int> = 0>
  constexpr Int128(T x) noexcept : bits(x) {}
  explicit constexpr Int128(const Uint128& x) noexcept : bits(x) {}

  explicit constexpr operator uint64_t() const noexcept { return bits.low; }
  explicit constexpr operator int64_t() const noexcept { return static_cast<int64_t>(bits.low); }

  friend constexpr Int128 operator+(const Int128& a, const Int128& b) noexcept { return Int128(a.bits + b.bits); }
  friend constexpr Int128 operator-(const Int128& a, const Int128& b) noexcept { return Int128(a.bits - b.bits); }
  friend constexpr Int128 operator*(const Int128& a, const Int128& b) noexcept { return Int128(a.bits * b.bits); }
  friend constexpr bool operator<(const Int128& a, const Int128& b) noexcept {
    const auto high = static_cast<int64_t>(a.bits.high), other_high = static_cast<int64_t>(b.bits.high);
    return high != other_high ? high < other_high : a.bits.low < b.bits.low;
  }
  friend constexpr bool operator>(const Int128& a, const Int128& b) noexcept { return b < a; }
  /** shift < 128; the sign is copied. */
  friend constexpr Int128 operator>>(const Int128& a, int shift) noexcept {
    const Uint128 flip = Uint128(Uint128::extension(static_cast<int64_t>(a.bits.high)),
                                 Uint128::extension(static_cast<int64_t>(a.bits.high)));
    return Int128(flipped(flipped(a.bits, flip) >> shift, flip));
  }

 private:
  static constexpr Uint128 flipped(const Uint128& x, const Uint128& flip) noexcept {
    return {x.high ^ flip.high, x.low ^ flip.low};
  }
};

constexpr Uint128::Uint128(const Int128& x) noexcept : low(x.bits.low), high(x.bits.high) {}

}  // namespace plain
}  // namespace dsw
