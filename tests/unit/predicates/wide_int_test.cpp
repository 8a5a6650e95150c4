#include "predicates/wide_int.h"

#include <gtest/gtest.h>
#include "../../gmp_numbers.h"

#include <cstdint>

#include "cases.h"

namespace dsw {
namespace {

template <int N>
mpz_class value(const WideInt<N>& x) {
  mpz_class r;
  mpz_import(r.get_mpz_t(), static_cast<std::size_t>(x.size()), -1, sizeof(std::uint64_t), 0, 0, x.limb());
  return x.sign() < 0 ? mpz_class(-r) : r;
}

// Limbs of all ones and of zeros, where carries run through, come as often as random ones.
template <int N>
WideInt<N> any(Random& random) {
  std::uint64_t limb[N];
  const int size = random.below(N + 1);
  for (int i = 0; i < size; ++i) {
    const int kind = random.below(4);
    limb[i] = kind == 0 ? 0 : (kind == 1 ? ~std::uint64_t{0} : random.next() >> (kind == 2 ? 0 : random.below(64)));
  }
  return WideInt<N>(limb, size, random.below(2) != 0);
}

template <int A, int B>
void check_arithmetic(Random& random) {
  const WideInt<A> a = any<A>(random);
  const WideInt<B> b =
      random.below(8) == 0 && A <= B ? WideInt<B>(a.limb(), a.size() < B ? a.size() : B, a.sign() > 0) : any<B>(random);
  const mpz_class x = value(a);
  const mpz_class y = value(b);
  ASSERT_EQ(a.sign(), sgn(x));
  ASSERT_EQ(value(a + b), mpz_class(x + y));
  ASSERT_EQ(value(a - b), mpz_class(x - y));
  ASSERT_EQ(value(a * b), mpz_class(x * y));
  ASSERT_EQ(value(-a), mpz_class(-x));
  ASSERT_EQ((a + b).sign(), sgn(mpz_class(x + y)));
  ASSERT_EQ((a - b).sign(), sgn(mpz_class(x - y)));
  ASSERT_EQ(compare(a, b), x < y ? -1 : (x > y ? 1 : 0));
  ASSERT_EQ(a.bit_length(), sgn(x) == 0 ? 0 : static_cast<int>(mpz_sizeinbase(x.get_mpz_t(), 2)));
  const int shift = random.below(300);
  ASSERT_EQ(value(shifted_left<A + 5>(a, shift)), mpz_class(x << static_cast<mp_bitcnt_t>(shift)));
  const WideInt<A + 3> wider = a;
  ASSERT_EQ(value(wider), x);
}

TEST(WideInt, ArithmeticAgreesWithGmp) {
  Random random(1);
  for (int i = 0; i < at_least(50000); ++i) {
    check_arithmetic<1, 1>(random);
    check_arithmetic<3, 3>(random);
    check_arithmetic<9, 4>(random);
    check_arithmetic<4, 9>(random);
    if (i % 16 == 0) check_arithmetic<105, 105>(random);
    if (HasFatalFailure()) return;
  }
}

TEST(WideInt, ConstructionShiftsAMagnitude) {
  Random random(2);
  for (int i = 0; i < at_least(20000); ++i) {
    const std::uint64_t m = random.next() >> random.below(64);
    const int shift = random.below(500);
    const bool negative = random.below(2) != 0;
    mpz_class wanted;
    mpz_import(wanted.get_mpz_t(), 1, -1, sizeof m, 0, 0, &m);
    wanted <<= static_cast<mp_bitcnt_t>(shift);
    ASSERT_EQ(value(WideInt<9>(m, negative, shift)), negative ? mpz_class(-wanted) : wanted);
  }
}

TEST(WideInt, ZeroHasNoSignHoweverItIsMade) {
  const std::uint64_t zeros[2] = {0, 0};
  const WideInt<2> zero(zeros, 2, true);
  EXPECT_EQ(zero.sign(), 0);
  EXPECT_EQ((-zero).sign(), 0);
  const WideInt<2> a(5, true, 70);
  EXPECT_EQ((a - a).sign(), 0);
  EXPECT_EQ((a * zero).sign(), 0);
  EXPECT_EQ((zero - a).sign(), 1);
  EXPECT_EQ(WideInt<3>(0, true, 9).sign(), 0);
}

// Quotients next to an integer are where an estimate goes wrong.
TEST(WideInt, ScaledQuotientIsTheFloor) {
  Random random(3);
  for (int i = 0; i < at_least(50000); ++i) {
    WideInt<12> b = any<12>(random);
    if (b.sign() == 0) continue;
    const std::uint64_t quotient = random.next() >> random.between(4, 63);
    const WideInt<13> product = b * WideInt<1>(quotient, b.sign() < 0, 0);
    const WideInt<1> one(1, false, 0);
    const WideInt<14> near = random.below(2) != 0 ? product - one : product + one;
    const WideInt<14> a = random.below(3) == 0 ? WideInt<14>(product) : near;
    if (a.sign() < 0) continue;
    const int shift = random.below(2) != 0 ? 0 : random.below(400);
    // (a * 2^shift) / b must stay below 2^60: divide by b * 2^shift.
    const WideInt<20> divisor = shifted_left<20>(b, shift);
    const mpz_class wanted = (value(a) << static_cast<mp_bitcnt_t>(shift)) / abs(value(divisor));
    if (mpz_sizeinbase(wanted.get_mpz_t(), 2) > 60) continue;
    const std::uint64_t given = limbs::scaled_quotient(a.limb(), a.size(), shift, divisor.limb(), divisor.size());
    ASSERT_EQ(value(WideInt<1>(&given, 1, false)), wanted);
  }
}

}  // namespace
}  // namespace dsw
