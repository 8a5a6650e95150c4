#include "predicates/polynomial_curve.h"

namespace dsw {

namespace {

// The highest 128 bits.
Ball ball_of(const Integer& x) noexcept {
  if (x.size == 0) return {};
  const int low = x.bit_length() - 128;
  const Uint128 magnitude = static_cast<Uint128>(limbs::bits_from(x.limb, x.size, low + 64)) << 64 |
                            Uint128(limbs::bits_from(x.limb, x.size, low));
  return {magnitude, low, x.negative, limbs::any_below(x.limb, x.size, low) ? 1.0 : 0.0};
}

Dyadic hidden_time(IntegerPool& pool, const bernstein::Place& place, double length) {
  Dyadic time = polynomials::dyadic_of(pool, length);
  time.shift -= place.power;
  if (place.is_at_end) time.numerator = shifted(integer_of(pool, std::uint64_t{1}), time.shift) - time.numerator;
  return time;
}

}  // namespace

PolynomialCurve::PolynomialCurve(IntegerPool& pool, const Polynomial& p)
    : pool_(pool), p_(p), degree_(p.degree < 0 ? 0 : p.degree) {
  for (int i = 0; i <= degree_; ++i) c_[i] = p.c[i];
  for (int last = degree_; last > 0; --last) {
    for (int i = 1; i <= last; ++i) c_[i] = c_[i] + c_[i - 1];
  }
  int top = 0;
  for (int i = 0; i <= degree_; ++i) {
    ball_[i] = ball_of(c_[i]);
    const int length = c_[i].bit_length();
    top = length > top ? length : top;
  }
  rough_.degree = degree_;
  int binomial = 1;
  for (int i = 0; i <= degree_; ++i) {
    const double size = static_cast<double>(static_cast<std::uint64_t>(ball_[i].magnitude >> 64)) / binomial;
    rough_.c[i] = size * balls::power_of_two(ball_[i].exponent + 64 - top) * (ball_[i].negative ? -1 : 1);
    binomial = binomial * (degree_ - i) / (i + 1);
  }
}

int PolynomialCurve::sign_at(double t) const {
  const int sign = bernstein::value_at(*this, dsw::ball_of(t)).sign();
  if (sign != kOpenSign) return sign;
  const IntegerPool::Scope scope(pool_);
  return polynomials::sign_at(p_, polynomials::dyadic_of(pool_, t));
}

int PolynomialCurve::sign_at_root(const PolynomialCurve& of, const bernstein::Place& place) const {
  if (place.is_crowded) return kOpenSign;
  const IntegerPool::Scope scope(pool_);
  Root root;
  root.of = of.p_;
  root.floor = place.floor;
  if (place.is_hidden) {
    root.low = hidden_time(pool_, place, place.is_at_end ? place.high : place.low);
    root.high = hidden_time(pool_, place, place.is_at_end ? place.low : place.high);
  } else {
    root.low = polynomials::dyadic_of(pool_, place.floor);
    root.high = polynomials::dyadic_of(pool_, integers::of_bits(integers::bits_of(place.floor) + 1));
  }
  return dsw::sign_at(p_, root);
}

int PolynomialCurve::sure_sign(double t) const {
  const int sign = rough_.sure_sign(t);
  return sign != kOpenSign ? sign : bernstein::value_at(*this, bernstein::ball_from(t)).sign();
}

}  // namespace dsw
