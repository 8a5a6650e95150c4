// The portable forms give what the compiler's own give.
#include "base/compiler.h"

#include "../../effort.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace dsw {
namespace {

/** Words with few bits, with many, at the ends of ranges, and between. */
std::vector<uint64_t> words() {
  std::vector<uint64_t> all = {0, 1, 2, 3, 0xffffffffu, 0x100000000u, 0x7fffffffffffffffu, 0x8000000000000000u};
  for (uint32_t i = 0; i < 64; ++i) {
    const uint64_t one = uint64_t{1} << i;
    for (const uint64_t x : {one, one - 1, ~one, ~(one - 1)}) all.push_back(x);
  }
  std::mt19937_64 random(seed_of(3));
  for (int i = 0; i < 100; ++i) {
    const uint64_t x = random();
    for (const uint64_t part : {x, x >> 32, x << 32, x >> (x & 63u)}) all.push_back(part);
  }
  return all;
}

TEST(Compiler, BitsAreFoundAndCounted) {
  for (const uint64_t x : words()) {
    uint32_t lowest = 64, highest = 64, count = 0;
    for (uint32_t i = 0; i < 64; ++i) {
      if ((x >> i & 1u) == 0) continue;
      if (lowest == 64) lowest = i;
      highest = i;
      ++count;
    }
    ASSERT_EQ(bit_count(x), count) << x;
    ASSERT_EQ(plain::bit_count(x), count) << x;
    if (x == 0) continue;
    ASSERT_EQ(lowest_bit(x), lowest) << x;
    ASSERT_EQ(plain::lowest_bit(x), lowest) << x;
    ASSERT_EQ(highest_bit(x), highest) << x;
    ASSERT_EQ(plain::highest_bit(x), highest) << x;
    if (x > 0xffffffffu) continue;
    const auto half = static_cast<uint32_t>(x);
    ASSERT_EQ(bit_count(half), count) << x;
    ASSERT_EQ(lowest_bit(half), lowest) << x;
    ASSERT_EQ(highest_bit(half), highest) << x;
  }
}

TEST(Compiler, FusedProductsAreRoundedOnce) {
  const double a = 1 + 0x1p-30;
  EXPECT_EQ(fused_multiply_add(a, a, -(1 + 0x1p-29)), 0x1p-60);
}

uint64_t high(const plain::Uint128& x) { return static_cast<uint64_t>(x >> 64); }
uint64_t low(const plain::Uint128& x) { return static_cast<uint64_t>(x); }

/** Holds for the portable form on any machine. */
TEST(Compiler, QuotientsOfTwoWordsAreLargestWhoseProductFits) {
  const std::vector<uint64_t> all = words();
  for (size_t i = 0; i < all.size(); ++i) {
    for (const uint64_t b : all) {
      if (b == 0) continue;
      const plain::Uint128 a(all[i], all[(i * 7 + 3) % all.size()]), quotient = a / b, rest = a - quotient * b;
      ASSERT_EQ(high(rest), 0u);
      ASSERT_LT(low(rest), b);
      ASSERT_EQ(high(quotient), high(a) / b);
    }
  }
}

#if DSW_NATIVE_INT128

Uint128 native(const plain::Uint128& x) { return static_cast<Uint128>(high(x)) << 64 | low(x); }
Int128 native(const plain::Int128& x) { return static_cast<Int128>(native(plain::Uint128(x))); }

TEST(Compiler, IntegersOfTwoWordsAreThoseOfTheCompiler) {
  const std::vector<uint64_t> all = words();
  std::mt19937_64 random(seed_of(4));
  const auto any = [&] { return all[random() % all.size()]; };
  for (int i = 0; i < at_least(200000); ++i) {
    const uint64_t word[4] = {any(), any(), any(), any()};
    const plain::Uint128 a(word[0], word[1]), b(word[2], word[3]);
    const Uint128 x = native(a), y = native(b);
    ASSERT_TRUE(native(a + b) == x + y);
    ASSERT_TRUE(native(a - b) == x - y);
    ASSERT_TRUE(native(a * b) == x * y);
    ASSERT_TRUE(native(a | b) == (x | y));
    ASSERT_TRUE(native(-a) == -x);
    ASSERT_EQ(a == b, x == y);
    ASSERT_TRUE(a == a);
    const int shift = static_cast<int>(random() % 128);
    ASSERT_TRUE(native(a << shift) == x << shift) << shift;
    ASSERT_TRUE(native(a >> shift) == x >> shift) << shift;
    const uint64_t divisor = word[3] | 1u;
    ASSERT_TRUE(native(a / divisor) == x / divisor);
    plain::Uint128 sum = a;
    ASSERT_TRUE(native(sum += b) == x + y);
    ASSERT_TRUE(native(sum >>= 64) == (x + y) >> 64);
    ASSERT_TRUE(native(a + word[2]) == x + word[2]);
    ASSERT_TRUE(native(a * word[2] + word[3]) == x * word[2] + word[3]);

    const plain::Int128 s(a), t(b);
    const auto v = static_cast<Int128>(x), w = static_cast<Int128>(y);
    ASSERT_TRUE(native(s + t) == static_cast<Int128>(x + y));
    ASSERT_TRUE(native(s - t) == static_cast<Int128>(x - y));
    ASSERT_TRUE(native(s * t) == static_cast<Int128>(x * y));
    ASSERT_TRUE(native(s >> shift) == v >> shift) << shift;
    ASSERT_EQ(s < t, v < w);
    ASSERT_EQ(s > t, v > w);
    ASSERT_EQ(s < 0, v < 0);
    ASSERT_EQ(s > 0, v > 0);
    ASSERT_EQ(static_cast<int64_t>(s), static_cast<int64_t>(v));
    ASSERT_EQ(static_cast<uint64_t>(s), static_cast<uint64_t>(v));

    const auto m = static_cast<int64_t>(word[0]), n = static_cast<int64_t>(word[1]);
    ASSERT_TRUE(native(static_cast<plain::Int128>(m)) == m);
    ASSERT_TRUE(native(static_cast<plain::Int128>(m) * n) == static_cast<Int128>(m) * n);
    ASSERT_TRUE(native(plain::Int128(word[0])) == static_cast<Int128>(word[0]));
    ASSERT_TRUE(native(plain::Uint128(-1)) == static_cast<Uint128>(-1));
  }
}

#endif

/** Numbers that lanes compare and compute with: of both signs, zeros, denormal, infinite, and none. */
std::vector<double> numbers() {
  const double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> all = {0.0,        -0.0,  1,      -1,       3,         0x1p-1074,
                             -0x1p-1074, 1e308, -1e308, infinite, -infinite, std::nan("")};
  std::mt19937 random(static_cast<uint32_t>(seed_of(5)));
  for (int i = 0; i < 20; ++i) all.push_back(std::ldexp(static_cast<double>(random()) - 0x1p31, i - 40));
  return all;
}

/** Bits, but that of a NaN nobody promises more than that it is one. */
bool are_same(double a, double b) { return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0; }

template <class Pair, class Mask>
void expect_lanes() {
  static_assert(sizeof(Pair) == 16 && alignof(Pair) == 16 && sizeof(Mask) == 16 && alignof(Mask) == 16);
  const std::vector<double> all = numbers();
  for (size_t i = 0; i < all.size(); ++i) {
    for (size_t j = 0; j < all.size(); ++j) {
      const double a[2] = {all[i], all[j]}, b[2] = {all[j], all[(i * 5 + j) % all.size()]};
      const Pair x{a[0], a[1]}, y{b[0], b[1]};
      const Pair sum = x + y, difference = x - y, product = x * y, quotient = x / y, back = pair_of(bits_of(x));
      const Mask less = x<y, greater = x> y, bits = bits_of(x), neither = ~(less | greater);
      Mask either = less;
      either |= greater;
      const Mask none = less & greater;
      for (uint32_t k = 0; k < 2; ++k) {
        ASSERT_TRUE(are_same(sum[k], a[k] + b[k]));
        ASSERT_TRUE(are_same(difference[k], a[k] - b[k]));
        ASSERT_TRUE(are_same(product[k], a[k] * b[k]));
        ASSERT_TRUE(are_same(quotient[k], a[k] / b[k]));
        ASSERT_EQ(std::memcmp(&back, a, sizeof a), 0);
        ASSERT_EQ(std::memcmp(&bits, a, sizeof a), 0);
        ASSERT_EQ(less[k], a[k] < b[k] ? -1 : 0);
        ASSERT_EQ(greater[k], a[k] > b[k] ? -1 : 0);
        ASSERT_EQ(either[k], less[k] != 0 || greater[k] != 0 ? -1 : 0);
        ASSERT_EQ(neither[k], either[k] != 0 ? 0 : -1);
        ASSERT_EQ(none[k], 0);
      }
    }
  }
}

TEST(Compiler, PairsComputeLaneByLane) {
  expect_lanes<DoublePair, PairMask>();
  expect_lanes<plain::DoublePair, plain::PairMask>();
}

template <class Eight>
void expect_eight(const Eight& two) {
  static_assert(sizeof(Eight) == 16 && alignof(Eight) == 16);
  const int16_t ends[] = {INT16_MIN, INT16_MIN + 1, -1, 0, 1, INT16_MAX};
  std::mt19937 random(static_cast<uint32_t>(seed_of(6)));
  for (int i = 0; i < at_least(1000); ++i) {
    Eight a{}, b{};
    for (uint32_t k = 0; k < 8; ++k) {
      a[k] = ends[random() % 6];
      b[k] = random() % 2 == 0 ? ends[random() % 6] : static_cast<int16_t>(random());
    }
    const Eight less = a<b, greater = a> b, both = a & b, either = a | b, inverse = ~a;
    Eight joined = a;
    joined |= b;
    for (uint32_t k = 0; k < 8; ++k) {
      ASSERT_EQ(less[k], a[k] < b[k] ? -1 : 0);
      ASSERT_EQ(greater[k], a[k] > b[k] ? -1 : 0);
      ASSERT_EQ(both[k], a[k] & b[k]);
      ASSERT_EQ(either[k], a[k] | b[k]);
      ASSERT_EQ(joined[k], either[k]);
      ASSERT_EQ(inverse[k], ~a[k]);
      ASSERT_EQ(two[k], 2);
    }
  }
}

TEST(Compiler, EightComputeLaneByLane) {
  expect_eight(eight_of(int16_t{2}));
  expect_eight(plain::eight_of(int16_t{2}));
}

}  // namespace
}  // namespace dsw
