#pragma once
// Few numbers side by side: the portable forms of base/compiler.h. Operators are those that the library uses.

#include <cstdint>
#include <cstring>

namespace dsw {
namespace plain {

/** Two words. */
struct alignas(16) PairMask {
  int64_t lane[2];

  int64_t operator[](uint32_t i) const noexcept { return lane[i]; }
  friend PairMask operator&(PairMask a, PairMask b) noexcept { return {{a[0] & b[0], a[1] & b[1]}}; }
  friend PairMask operator|(PairMask a, PairMask b) noexcept { return {{a[0] | b[0], a[1] | b[1]}}; }
  friend PairMask operator~(PairMask a) noexcept { return {{~a[0], ~a[1]}}; }
  PairMask& operator|=(PairMask b) noexcept { return *this = *this | b; }
};

/** Two doubles. */
struct alignas(16) DoublePair {
  double lane[2];

  double operator[](uint32_t i) const noexcept { return lane[i]; }
  friend DoublePair operator+(DoublePair a, DoublePair b) noexcept { return {{a[0] + b[0], a[1] + b[1]}}; }
  friend DoublePair operator-(DoublePair a, DoublePair b) noexcept { return {{a[0] - b[0], a[1] - b[1]}}; }
  friend DoublePair operator*(DoublePair a, DoublePair b) noexcept { return {{a[0] * b[0], a[1] * b[1]}}; }
  friend DoublePair operator/(DoublePair a, DoublePair b) noexcept { return {{a[0] / b[0], a[1] / b[1]}}; }
  friend PairMask operator<(DoublePair a, DoublePair b) noexcept {
    return {{-int64_t{a[0] < b[0]}, -int64_t{a[1] < b[1]}}};
  }
  friend PairMask operator>(DoublePair a, DoublePair b) noexcept { return b < a; }
};

inline PairMask bits_of(DoublePair x) noexcept {
  PairMask bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
inline DoublePair pair_of(PairMask bits) noexcept {
  DoublePair x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

inline DoublePair turned(DoublePair x) noexcept { return {{x.lane[1], x.lane[0]}}; }

/** Eight short words. */
struct alignas(16) ShortEight {
  int16_t lane[8];

  int16_t& operator[](uint32_t i) noexcept { return lane[i]; }
  int16_t operator[](uint32_t i) const noexcept { return lane[i]; }
  friend ShortEight operator&(ShortEight a, const ShortEight& b) noexcept { return a.change(b, bit_and); }
  friend ShortEight operator|(ShortEight a, const ShortEight& b) noexcept { return a.change(b, bit_or); }
  friend ShortEight operator~(ShortEight a) noexcept { return a.change(a, inverse); }
  friend ShortEight operator<(ShortEight a, const ShortEight& b) noexcept { return a.change(b, less); }
  friend ShortEight operator>(ShortEight a, const ShortEight& b) noexcept { return a.change(b, greater); }
  ShortEight& operator|=(const ShortEight& b) noexcept { return change(b, bit_or); }

 private:
  static int bit_and(int a, int b) noexcept { return a & b; }
  static int bit_or(int a, int b) noexcept { return a | b; }
  static int inverse(int a, int) noexcept { return ~a; }
  static int less(int a, int b) noexcept { return a < b ? -1 : 0; }
  static int greater(int a, int b) noexcept { return a > b ? -1 : 0; }
  ShortEight& change(const ShortEight& b, int (*to)(int, int) noexcept) noexcept {
    for (uint32_t i = 0; i < 8; ++i) lane[i] = static_cast<int16_t>(to(lane[i], b.lane[i]));
    return *this;
  }
};

inline ShortEight eight_of(int16_t x) noexcept { return {{x, x, x, x, x, x, x, x}}; }

}  // namespace plain
}  // namespace dsw
