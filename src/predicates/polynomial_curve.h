// Polynomials with integer coefficients as curves in the sense of bernstein.h. Private to this folder.
#pragma once

#include <optional>

#include "predicates/bernstein.h"
#include "predicates/polynomial_parts.h"

namespace dsw {

class PolynomialCurve {
 public:
  PolynomialCurve(IntegerPool& pool, const Polynomial& p);

  int degree() const noexcept { return degree_; }
  int sign(int i) const noexcept { return c_[i].sign(); }
  Ball ball(int i) const noexcept { return ball_[i]; }
  const bernstein::RoughCurve& rough() const noexcept { return rough_; }
  int sign_at(double t) const;
  int sure_sign(double t) const;
  // At a root of another curve that is not a double.
  int sign_at_root(const PolynomialCurve& of, const bernstein::Place& place) const;
  const Polynomial& polynomial() const noexcept { return p_; }

 private:
  IntegerPool& pool_;
  Polynomial p_;
  int degree_;
  Integer c_[Polynomial::kMostDegree + 1];
  Ball ball_[Polynomial::kMostDegree + 1];
  bernstein::RoughCurve rough_;
};

// The discriminant of a curve of degree 2 or 3, times a positive number.
Ball rough_discriminant(const PolynomialCurve& curve);

// The curves of Points, which ExactTouch explains.
template <int D, class Points>
class PolynomialCurves {
 public:
  PolynomialCurves(IntegerPool& pool, Points& points) noexcept : pool_(pool), points_(points) {}

  const PolynomialCurve& volume() {
    if (!volume_) volume_.emplace(pool_, points_.volume());
    return *volume_;
  }
  int volume_at_start() { return volume().sign(0); }
  int area_at_start(int view, int triangle) { return area(view, triangle).sign(0); }
  const PolynomialCurve& area(int view, int triangle) {
    std::optional<PolynomialCurve>& area = area_[view][triangle];
    if (!area) area.emplace(pool_, points_.area(view, triangle));
    return *area;
  }
  // Its sign, or kOpenSign if the degree is not 2 or 3.
  int discriminant(const PolynomialCurve& curve) {
    const int degree = curve.polynomial().degree;
    if (degree != 2 && degree != 3) return kOpenSign;
    const int sign = rough_discriminant(curve).sign();
    if (sign != kOpenSign) return sign;
    const IntegerPool::Scope scope(pool_);
    return polynomials::discriminant(pool_, curve.polynomial()).sign();
  }
  // If the curve has a repeated root, and its degree is 2 or 3, the factors of degree 1 that have all its roots. Returns their number.
  int factors(const PolynomialCurve& curve, std::optional<PolynomialCurve> (&lines)[2]) {
    Polynomial found[2];
    const int count = polynomials::repeated_factors(pool_, curve.polynomial(), found);
    for (int i = 0; i < count; ++i) lines[i].emplace(pool_, found[i]);
    return count;
  }
  const PolynomialCurve& difference(int axis, int i, int j) {
    std::optional<PolynomialCurve>& difference = difference_[axis][i][j];
    if (!difference) difference.emplace(pool_, points_.difference(axis, i, j));
    return *difference;
  }

 private:
  IntegerPool& pool_;
  Points& points_;
  std::optional<PolynomialCurve> volume_, area_[D == 3 ? 3 : 1][D == 3 ? 4 : 1], difference_[D][D + 1][D + 1];
};

}  // namespace dsw
