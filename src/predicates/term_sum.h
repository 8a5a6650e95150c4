// Sums of products of doubles, exactly, whatever their exponents are. A product is added where its bits are, so the zeros between
// doubles of different sizes cost nothing. Private to this folder.
#pragma once

#include "predicates/integer.h"

namespace dsw {

// magnitude * 2^shift with its sign.
struct Term {
  std::uint64_t magnitude = 0;
  int shift = 0;
  bool negative = false;

  Term() = default;
  // x * 2^(1075 - low), which is an integer.
  Term(double x, int low) noexcept {
    const integers::Decoded d = integers::decode(x);
    if (d.magnitude == 0) return;
    const int zeros = static_cast<int>(lowest_bit(d.magnitude));
    magnitude = d.magnitude >> zeros;
    shift = d.exponent + zeros - low;
    negative = d.negative;
  }
};

// A product of two terms.
struct TermPair {
  Uint128 magnitude;
  int shift;
  bool negative;

  DSW_HOT TermPair(const Term& a, const Term& b) noexcept
      : magnitude(static_cast<Uint128>(a.magnitude) * b.magnitude),
        shift(a.shift + b.shift),
        negative(a.negative != b.negative) {}
};

// Digits of 32 bits in words of 64: they are carried once, at the end. Up to 2^20 products fit.
class TermSum {
 public:
  // Products are below 2^bits.
  explicit TermSum(int bits) noexcept : size_(bits / kDigit + kSpare) {
    for (int i = 0; i < size_; ++i) digit_[i] = 0;
  }

  DSW_HOT void add(const Term& a, bool negative) noexcept {
    if (a.magnitude != 0) add_words<1>(a.magnitude, 0, 0, a.shift, negative != a.negative);
  }
  DSW_HOT void add(const TermPair& a, bool negative) noexcept {
    if (a.magnitude == Uint128(0)) return;
    add_words<2>(static_cast<std::uint64_t>(a.magnitude), static_cast<std::uint64_t>(a.magnitude >> 64), 0, a.shift,
                 negative != a.negative);
  }
  DSW_HOT void add(const TermPair& a, const Term& b, bool negative) noexcept {
    if (b.magnitude == 0) return;
    const Uint128 low = static_cast<Uint128>(static_cast<std::uint64_t>(a.magnitude)) * b.magnitude;
    const Uint128 high = static_cast<Uint128>(static_cast<std::uint64_t>(a.magnitude >> 64)) * b.magnitude +
                         static_cast<std::uint64_t>(low >> 64);
    add_words<3>(static_cast<std::uint64_t>(low), static_cast<std::uint64_t>(high),
                 static_cast<std::uint64_t>(high >> 64), a.shift + b.shift, (negative != a.negative) != b.negative);
  }

  // Takes away another sum, which has the same size.
  void subtract(const TermSum& other) noexcept {
    for (int i = 0; i < size_; ++i) digit_[i] -= other.digit_[i];
  }

  // Ends the sum.
  Integer value(IntegerPool& pool) {
    std::int64_t carry = 0;
    for (int i = 0; i < size_; ++i) {
      carry += digit_[i];
      digit_[i] = carry & kMask;
      carry >>= kDigit;
    }
    const bool negative = carry < 0;
    std::int64_t borrow = negative ? 1 : 0;
    for (int i = 0; negative && i < size_; ++i) {
      borrow += kMask - digit_[i];
      digit_[i] = borrow & kMask;
      borrow >>= kDigit;
    }
    int size = (size_ + 1) / 2;
    std::uint64_t* const r = pool.room(size);
    if (size_ % 2 != 0) digit_[size_] = 0;
    const auto digit = [&](int i) { return static_cast<std::uint64_t>(digit_[i]); };
    for (int i = 0; i < size; ++i) r[i] = digit(2 * i) | digit(2 * i + 1) << kDigit;
    while (size > 0 && r[size - 1] == 0) --size;
    if (size == 0) return {};
    pool.keep(size);
    return {&pool, r, size, negative};
  }

 private:
  static constexpr int kDigit = 32, kSpare = 8, kMostBits = 3 * 2098;
  static constexpr std::int64_t kMask = 0xffffffff;

  template <int Words>
  DSW_HOT void add_words(std::uint64_t low, std::uint64_t middle, std::uint64_t high, int shift,
                         bool negative) noexcept {
    std::int64_t* const d = digit_ + shift / kDigit;
    const int up = shift % kDigit, down = 63 - up;
    const std::int64_t flip = negative ? -1 : 0;
    const auto add_word = [&](int i, std::uint64_t x) {
      d[i] += (static_cast<std::int64_t>(x & kMask) ^ flip) - flip;
      d[i + 1] += (static_cast<std::int64_t>(x >> kDigit) ^ flip) - flip;
    };
    // What has three words is below 2^159, so that nothing is above them.
    add_word(0, low << up);
    add_word(2, middle << up | low >> 1 >> down);
    if constexpr (Words > 1) add_word(4, high << up | middle >> 1 >> down);
  }

  int size_;
  std::int64_t digit_[kMostBits / kDigit + kSpare + 2];
};

}  // namespace dsw
