// What polynomials in time are divided, signed and refined with. Private to this folder.
#pragma once

#include "predicates/polynomial.h"

namespace dsw {
namespace polynomials {

// Sign of a - b.
int compare(const Dyadic& a, const Dyadic& b);
Dyadic dyadic_of(IntegerPool& pool, double x);
Dyadic half_way(const Dyadic& a, const Dyadic& b);

Polynomial derivative(IntegerPool& pool, const Polynomial& p);

// A positive multiple of the remainder of a by b.
Polynomial remainder(Polynomial a, const Polynomial& b);

// A positive multiple of a / b, and of the remainder, which takes the place of a.
Polynomial divide(Polynomial& a, const Polynomial& b);

// That of p, of degree 2 or 3, times a positive number.
Integer discriminant(IntegerPool& pool, const Polynomial& p);
// If p, of degree 2 or 3, has a repeated root, the factors of degree 1 that have all its roots. Returns their number, or 0.
int repeated_factors(IntegerPool& pool, const Polynomial& p, Polynomial (&factors)[2]);

int sign_at(const Polynomial& p, const Dyadic& x);

// p(x) * 2^(degree * shift). p is not 0.
Integer value_at(const Polynomial& p, const Dyadic& x);

// Sign of p a little after x.
int sign_after(IntegerPool& pool, const Polynomial& p, const Dyadic& x);

// The sign of p between two times in [0,1], if p's slope is too small to change it; else 0.
int clear_sign(IntegerPool& pool, const Polynomial& p, const Dyadic& low, const Dyadic& high);

// A polynomial in doubles, times a power of two: the largest coefficient is near 1.
struct Rounded {
  int degree;
  double c[Polynomial::kMostDegree + 1];

  explicit Rounded(const Polynomial& p) noexcept;

  // The sign at all times between t and the next double, or 0 if it is not sure. A coefficient has an error of 2u, a step
  // of Horner's rule 2u, and t itself 2u, once for each power; 2^-1000 pays for underflow.
  int sure_sign(double t) const noexcept;
};

// `at`, a root of p. `floor` is the largest double not above it, and is_floor says whether it is the root.
Root exact_root(const Polynomial& p, const Dyadic& at, double floor, bool is_floor);

// The root of p with low < root < high. There is one, it is simple, and p is not 0 at `high`. `below` is the largest double
// not above `low`, and `above` is the smallest not below `high`.
Root refined_root(IntegerPool& pool, const Polynomial& p, const Rounded& rounded, const Dyadic& low, const Dyadic& high,
                  double below, double above);

// find_roots for degrees above 3.
int find_roots_by_halving(IntegerPool& pool, const Polynomial& p, Root (&roots)[Polynomial::kMostDegree]);

// sign_at for a root that is not its `low`, and for all degrees.
int sign_by_divisor(IntegerPool& pool, const Polynomial& p, const Root& root);

}  // namespace polynomials
}  // namespace dsw
