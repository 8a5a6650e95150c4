// Doubles as exact integers over a common power of two, and the way back.
#pragma once

#include "../gmp_numbers.h"

#include <climits>
#include <cmath>
#include <cstdint>

namespace dsw::oracle {

using Big = mpz_class;

/// Exponent of the lowest set bit: x = odd * 2^result. INT_MAX for 0.
inline int lowest_exponent(double x) {
  if (x == 0) return INT_MAX;
  int e = 0;
  const double m = std::frexp(std::fabs(x), &e);
  const auto bits = static_cast<uint64_t>(std::ldexp(m, 53));
  return e - 53 + __builtin_ctzll(bits);
}

/// GMP takes a long, which has 32 bits on some targets.
inline Big to_big(int64_t x) { return (Big(static_cast<int32_t>(x >> 32)) << 32u) + static_cast<uint32_t>(x); }

/// x * 2^shift; shift must make it an integer.
inline Big to_big(double x, int shift) {
  if (x == 0) return Big(0);
  int e = 0;
  const double m = std::frexp(x, &e);
  Big z(std::ldexp(m, 53));
  const int s = e - 53 + shift;
  if (s >= 0) {
    z <<= static_cast<unsigned>(s);
  } else {
    mpz_tdiv_q_2exp(z.get_mpz_t(), z.get_mpz_t(), static_cast<unsigned>(-s));
  }
  return z;
}

/// Largest double that is not greater than numerator / denominator; numerator >= 0, denominator > 0.
inline double floor_to_double(const Big& numerator, const Big& denominator) {
  if (sgn(numerator) == 0) return 0;
  const auto nb = static_cast<long>(mpz_sizeinbase(numerator.get_mpz_t(), 2));
  const auto db = static_cast<long>(mpz_sizeinbase(denominator.get_mpz_t(), 2));
  long s = 53 - (nb - db);
  if (s > 1074) s = 1074;
  Big q;
  for (;;) {
    const Big n = s >= 0 ? Big(numerator << static_cast<unsigned long>(s)) : numerator;
    const Big d = s >= 0 ? denominator : Big(denominator << static_cast<unsigned long>(-s));
    mpz_fdiv_q(q.get_mpz_t(), n.get_mpz_t(), d.get_mpz_t());
    if (mpz_sizeinbase(q.get_mpz_t(), 2) <= 53) break;
    --s;
  }
  return std::ldexp(q.get_d(), static_cast<int>(-s));
}

}  // namespace dsw::oracle
