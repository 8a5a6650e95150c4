#include "predicates/polynomial_curve.h"

namespace dsw {

namespace {

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
    ball_[i] = c_[i].ball();
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
  // What lies around a root that is not hidden was looked at with 128 bits.
  return place.is_hidden ? dsw::sign_at(p_, root) : sign_by_division(p_, root);
}

int PolynomialCurve::sure_sign(double t) const {
  const int sign = rough_.sure_sign(t);
  return sign != kOpenSign ? sign : bernstein::value_at(*this, bernstein::ball_from(t)).sign();
}

Ball rough_discriminant(const PolynomialCurve& curve) {
  // With x = t / (1-t) the curve is a polynomial in x, and its discriminant is the same.
  const Ball c[] = {curve.ball(0), curve.ball(1), curve.ball(2)}, four = dsw::ball_of(4);
  if (curve.degree() == 2) return c[1] * c[1] - four * (c[0] * c[2]);
  const Ball d = curve.ball(3), three = dsw::ball_of(3), nine = dsw::ball_of(9);
  // See Hessian in polynomial_parts.cpp.
  const Ball first = c[1] * c[1] - three * (c[0] * c[2]), middle = c[1] * c[2] - nine * (c[0] * d),
             last = c[2] * c[2] - three * (c[1] * d);
  return four * (first * last) - middle * middle;
}

}  // namespace dsw
