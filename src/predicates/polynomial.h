// Polynomials in time with integer coefficients, and their roots in [0,1], exactly. Private to this folder.
//
// Sources: S. Basu, R. Pollack, M.-F. Roy, Algorithms in Real Algebraic Geometry, 2006, chapter 2: Sturm's theorem, and
// Tarski's for the sign of one polynomial at the roots of another.
#pragma once

#include "predicates/integer.h"

namespace dsw {

// c[0] + c[1] t + ... The last coefficient is not 0; the degree of 0 is -1.
struct Polynomial {
  static constexpr int kMostDegree = 5;
  int degree = -1;
  Integer c[kMostDegree + 1];

  void trim() noexcept {
    while (degree >= 0 && c[degree].sign() == 0) --degree;
  }
};

Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);  // of kMostDegree at most

// numerator / 2^shift, at least 0.
struct Dyadic {
  Integer numerator;
  int shift = 0;
};

// A root in [0,1]: `low` itself, or the only one between low and high. No factor of `of` is repeated.
struct Root {
  Polynomial of;
  bool is_low = false;
  Dyadic low, high;
  double floor = 0;       // the largest double not above the root
  bool is_floor = false;  // whether it is the root
};

// Roots in [0,1] of a polynomial that is not 0, ascending. Returns their number.
int find_roots(IntegerPool& pool, const Polynomial& p, Root (&roots)[Polynomial::kMostDegree]);

// The root 0, of any polynomial.
Root root_at_start();

// Sign of p at the root.
int sign_at(const Polynomial& p, const Root& root);
// Sign of p at a root that is not its `low`, found by division: whether p is 0 there is asked first.
int sign_by_division(const Polynomial& p, const Root& root);

// Sign of a - b.
int compare(const Root& a, const Root& b);

}  // namespace dsw
