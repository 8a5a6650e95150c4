#include "predicates/polynomial_parts.h"

namespace dsw {
namespace polynomials {

namespace {

using integers::bits_of;
using integers::of_bits;

// One step of a division: a positive multiple of a, less a multiple of b, of lower degree than a.
void divide_step(Polynomial& a, const Polynomial& b, Integer* factor) {
  const int gap = a.degree - b.degree;
  Integer lead = b.c[b.degree];
  *factor = lead.negative ? -a.c[a.degree] : a.c[a.degree];
  lead.negative = false;
  for (int i = 0; i < a.degree; ++i) {
    a.c[i] = a.c[i] * lead;
    if (i >= gap) a.c[i] = a.c[i] - *factor * b.c[i - gap];
  }
  --a.degree;
  a.trim();
}

// Near to the root between low and high; `rising` says how p's sign changes there. Newton's method, with bisection where a
// step leaves the interval.
double guess_root(const Rounded& p, double low, double high, bool rising) noexcept {
  double t = 0.5 * (low + high);
  for (int i = 0; i < 60 && low < t && t < high; ++i) {
    double sum = p.c[p.degree];
    double slope = 0;
    for (int k = p.degree - 1; k >= 0; --k) {
      slope = slope * t + sum;
      sum = sum * t + p.c[k];
    }
    if (sum == 0) break;
    if ((sum > 0) == rising) {
      high = t;
    } else {
      low = t;
    }
    const double next = t - sum / slope;
    if (std::fabs(next - t) <= 0x1p-53 * t) break;
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  return t;
}

}  // namespace

int compare(const Dyadic& a, const Dyadic& b) {
  const int low = a.shift < b.shift ? a.shift : b.shift;
  return (shifted(a.numerator, b.shift - low) - shifted(b.numerator, a.shift - low)).sign();
}

Dyadic dyadic_of(IntegerPool& pool, double x) {
  const integers::Decoded d = integers::decode(x);
  if (d.magnitude == 0) return {};
  const int zeros = static_cast<int>(lowest_bit(d.magnitude));
  const int exponent = d.exponent + zeros - 1075;
  return {integer_of(pool, d.magnitude >> zeros), -exponent};
}

Dyadic half_way(const Dyadic& a, const Dyadic& b) {
  const int shift = a.shift > b.shift ? a.shift : b.shift;
  return {shifted(a.numerator, shift - a.shift) + shifted(b.numerator, shift - b.shift), shift + 1};
}

Polynomial derivative(IntegerPool& pool, const Polynomial& p) {
  Polynomial r;
  r.degree = p.degree < 0 ? -1 : p.degree - 1;
  for (int i = 0; i <= r.degree; ++i) r.c[i] = p.c[i + 1] * integer_of(pool, static_cast<std::uint64_t>(i + 1));
  return r;
}

// A positive multiple of the remainder of a by b.
Polynomial remainder(Polynomial a, const Polynomial& b) {
  Integer factor;
  while (a.degree >= b.degree) divide_step(a, b, &factor);
  return a;
}

// A positive multiple of a / b, and of the remainder, which takes the place of a.
Polynomial divide(Polynomial& a, const Polynomial& b) {
  Polynomial r;
  r.degree = a.degree - b.degree;
  Integer lead = b.c[b.degree];
  lead.negative = false;
  while (a.degree >= b.degree) {
    const int at = a.degree - b.degree;
    for (int i = 0; i <= r.degree; ++i) r.c[i] = r.c[i] * lead;
    divide_step(a, b, &r.c[at]);
  }
  return r;
}

namespace {

// The Hessian of a polynomial of degree 3. Its discriminant is -3 times that of the polynomial, and if this is 0, so is the Hessian at
// the repeated root.
struct Hessian {
  Integer first, middle, last;

  Hessian(IntegerPool& pool, const Integer (&c)[Polynomial::kMostDegree + 1]) {
    const Integer three = integer_of(pool, std::uint64_t{3}), nine = integer_of(pool, std::uint64_t{9});
    first = c[1] * c[1] - three * (c[0] * c[2]);
    middle = c[1] * c[2] - nine * (c[0] * c[3]);
    last = c[2] * c[2] - three * (c[1] * c[3]);
  }
};

}  // namespace

Integer discriminant(IntegerPool& pool, const Polynomial& p) {
  if (p.degree == 2) return p.c[1] * p.c[1] - shifted(p.c[0] * p.c[2], 2);
  const Hessian h(pool, p.c);
  return shifted(h.first * h.last, 2) - h.middle * h.middle;
}

int repeated_factors(IntegerPool& pool, const Polynomial& p, Polynomial (&factors)[2]) {
  if ((p.degree != 2 && p.degree != 3) || discriminant(pool, p).sign() != 0) return 0;
  Polynomial& line = factors[0];
  line.degree = 1;
  if (p.degree == 2) {
    line.c[0] = p.c[1];
    line.c[1] = shifted(p.c[2], 1);
    return 1;
  }
  const Hessian h(pool, p.c);
  if (h.last.sign() == 0) {  // so is all of it: the root is repeated twice
    line.c[0] = p.c[2];
    line.c[1] = p.c[3] * integer_of(pool, std::uint64_t{3});
    return 1;
  }
  line.c[0] = h.middle;
  line.c[1] = shifted(h.last, 1);
  Polynomial rest = p;
  factors[1] = divide(rest, line * line);
  return 2;
}

Integer value_at(const Polynomial& p, const Dyadic& x) {
  Integer sum = p.c[p.degree];
  for (int i = p.degree - 1; i >= 0; --i) sum = sum * x.numerator + shifted(p.c[i], x.shift * (p.degree - i));
  return sum;
}

int sign_at(const Polynomial& p, const Dyadic& x) {
  if (p.degree < 0) return 0;
  if (x.numerator.sign() == 0) return p.c[0].sign();
  const IntegerPool::Scope scope(*x.numerator.pool);
  return value_at(p, x).sign();
}

// Sign of p a little after x.
int sign_after(IntegerPool& pool, const Polynomial& p, const Dyadic& x) {
  const IntegerPool::Scope scope(pool);
  Polynomial q = p;
  int sign = sign_at(q, x);
  while (sign == 0 && q.degree > 0) {
    q = derivative(pool, q);
    sign = sign_at(q, x);
  }
  return sign;
}

// The sign of p between two times in [0,1], if p's slope is too small to change it; else 0.
int clear_sign(IntegerPool& pool, const Polynomial& p, const Dyadic& low, const Dyadic& high) {
  Integer slope;
  for (int i = 1; i <= p.degree; ++i) {
    Integer part = p.c[i] * integer_of(pool, static_cast<std::uint64_t>(i));
    part.negative = false;
    slope = slope + part;
  }
  Integer value = value_at(p, low);
  const int sign = value.sign();
  value.negative = false;
  const int shift = low.shift > high.shift ? low.shift : high.shift;
  const Integer width = shifted(high.numerator, shift - high.shift) - shifted(low.numerator, shift - low.shift);
  return (shifted(value, shift) - shifted(slope * width, low.shift * p.degree)).sign() > 0 ? sign : 0;
}

Rounded::Rounded(const Polynomial& p) noexcept : degree(p.degree) {
  int most = 0;
  for (int i = 0; i <= degree; ++i) {
    const int length = p.c[i].bit_length();
    most = length > most ? length : most;
  }
  for (int i = 0; i <= degree; ++i) c[i] = p.c[i].scaled(most);
}

int Rounded::sure_sign(double t) const noexcept {
  double sum = c[degree];
  double size = std::fabs(sum);
  for (int i = degree - 1; i >= 0; --i) {
    sum = sum * t + c[i];
    size = size * t + std::fabs(c[i]);
  }
  const double bound = size * 0x1p-48 + 0x1p-1000;
  return sum > bound ? 1 : sum < -bound ? -1 : 0;
}

Root exact_root(const Polynomial& p, const Dyadic& at, double floor, bool is_floor) {
  Root root;
  root.of = p;
  root.is_low = true;
  root.is_floor = is_floor;
  root.low = root.high = at;
  root.floor = floor;
  return root;
}

Root refined_root(IntegerPool& pool, const Polynomial& p, const Rounded& rounded, const Dyadic& low, const Dyadic& high,
                  double below, double above) {
  const auto sign_of = [&](double t) {
    const IntegerPool::Scope scope(pool);
    return sign_at(p, dyadic_of(pool, t));
  };
  const int sign_low = sign_after(pool, p, low);
  const std::uint64_t first = bits_of(below), last = bits_of(above);
  std::uint64_t a = first, b = last;
  const std::uint64_t at = bits_of(guess_root(rounded, below, above, sign_low < 0));
  if (integers::narrow_sign_change(&a, &b, at, sign_low, sign_of) == 0) {
    return exact_root(p, dyadic_of(pool, of_bits(a)), of_bits(a), true);
  }
  Root root;
  root.of = p;
  root.low = a == first ? low : dyadic_of(pool, of_bits(a));
  root.high = b == last ? high : dyadic_of(pool, of_bits(b));
  root.floor = of_bits(a);
  return root;
}

}  // namespace polynomials
}  // namespace dsw
