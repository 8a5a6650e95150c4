#include "predicates/polynomial.h"

#include <utility>

#include "predicates/polynomial_narrowing.h"

namespace dsw {

using namespace polynomials;

namespace {

using integers::bits_of;
using integers::of_bits;

constexpr int kManyLimbs = 6;

// Sign of p at the zero of a polynomial of degree 1.
int sign_at_zero(const Polynomial& p, const Polynomial& line) {
  if (p.degree < 0) return 0;
  const bool falls = line.c[1].negative;
  const Integer numerator = falls ? line.c[0] : -line.c[0];
  Integer denominator = line.c[1];
  denominator.negative = false;
  const auto sign_of = [&](const auto& leading, const auto& above, const auto& below, auto coefficient) {
    auto sum = leading, weight = below;
    for (int i = p.degree - 1; i >= 0; --i) {
      sum = sum * above + coefficient(i) * weight;
      if (i > 0) weight = weight * below;
    }
    return sum.sign();
  };
  if (denominator.size > kManyLimbs) {
    const int sign =
        sign_of(p.c[p.degree].ball(), numerator.ball(), denominator.ball(), [&](int i) { return p.c[i].ball(); });
    if (sign != kOpenSign) return sign;
  }
  return sign_of(p.c[p.degree], numerator, denominator, [&](int i) { return p.c[i]; });
}

// A sequence of Sturm: each member is a negative multiple of the remainder of the two before, down to the last that is not 0.
struct SturmSequence {
  Polynomial member[4];
  int count = 0;

  SturmSequence(const Polynomial& p, const Polynomial& q) {
    member[0] = p;
    count = 1;
    Polynomial next = q.degree >= p.degree ? remainder(q, p) : q;
    while (next.degree >= 0) {
      member[count++] = next;
      next = remainder(member[count - 2], member[count - 1]);
      for (int i = 0; i <= next.degree; ++i) next.c[i] = -next.c[i];
    }
  }

  const Polynomial& last() const noexcept { return member[count - 1]; }

  // Changes of sign along the sequence at x.
  int variations(const Dyadic& x) const {
    int number = 0;
    int before = 0;
    for (int i = 0; i < count; ++i) {
      const int sign = sign_at(member[i], x);
      if (sign == 0) continue;
      number += sign * before < 0 ? 1 : 0;
      before = sign;
    }
    return number;
  }
};

// The blossom of p at a, ..., a, b, times a positive number: a coefficient of p in the basis of Bernstein over [a, b]. The degree
// is 2 or 3.
Integer near_coefficient(IntegerPool& pool, const Polynomial& p, const Dyadic& a, const Dyadic& b) {
  const int shift = a.shift > b.shift ? a.shift : b.shift;
  const Integer x = shifted(a.numerator, shift - a.shift), y = shifted(b.numerator, shift - b.shift);
  const Integer number = integer_of(pool, static_cast<std::uint64_t>(p.degree));
  const Integer constant = shifted(p.c[0] * number, shift * p.degree);
  if (p.degree == 2) return constant + shifted(p.c[1] * (x + y), shift) + p.c[2] * shifted(x * y, 1);
  const Integer linear = shifted(p.c[1] * (shifted(x, 1) + y), 2 * shift);
  const Integer square = shifted(p.c[2] * (x * (x + shifted(y, 1))), shift);
  return constant + linear + square + p.c[3] * (number * (x * x * y));
}

// Changes of sign among the coefficients of p in the basis of Bernstein: by Descartes' rule the roots with low < root < high are that
// many, or fewer by an even number. *last is the sign of p at high.
int count_changes(IntegerPool& pool, const Polynomial& p, const Dyadic& low, const Dyadic& high, int* last) {
  int signs[4] = {sign_at(p, low)};
  if (p.degree > 1) signs[1] = near_coefficient(pool, p, low, high).sign();
  if (p.degree > 2) signs[2] = near_coefficient(pool, p, high, low).sign();
  signs[p.degree] = *last = sign_at(p, high);
  int number = 0, before = 0;
  for (int i = 0; i <= p.degree; ++i) {
    number += signs[i] * before < 0 ? 1 : 0;
    if (signs[i] != 0) before = signs[i];
  }
  return number;
}

class RootFinder {
 public:
  RootFinder(IntegerPool& pool, const Polynomial& p, Root* roots) : pool_(pool), p_(p), roots_(roots), rounded_(p) {
    if (p_.c[0].sign() == 0) add_exact({}, 0);
  }

  int found() const noexcept { return found_; }

  // Whether Descartes' rule of signs separates the roots.
  bool find_by_signs() {
    if (find_between(0, 1)) return true;
    double ends[4] = {0};
    const int count = find_ends(ends);
    for (int i = 1; i < count; ++i) {
      if (!find_between(ends[i - 1], ends[i])) return false;
    }
    return true;
  }

  // No root is repeated.
  void find_by_sturm(const SturmSequence& sturm) {
    sturm_ = &sturm;
    double ends[4] = {0};
    const int count = find_ends(ends);
    int before = sturm.variations({});
    const int last = sturm.variations(dyadic_of(pool_, 1));
    for (int i = 1; i < count && before != last; ++i) {
      const int after = i + 1 == count ? last : sturm.variations(dyadic_of(pool_, ends[i]));
      isolate(ends[i - 1], ends[i], before, after);
      before = after;
    }
  }

 private:
  // 0, the turning points, and 1. Returns their number.
  int find_ends(double (&ends)[4]) const noexcept {
    int count = 1;
    if (p_.degree > 1) count = turning_points(ends);
    ends[count++] = 1;
    return count;
  }

  // Finds the roots with low < root <= high, unless the rule leaves their number open.
  bool find_between(double low, double high) {
    int changes = 0, last = 0;
    {
      const IntegerPool::Scope scope(pool_);
      changes = count_changes(pool_, p_, dyadic_of(pool_, low), dyadic_of(pool_, high), &last);
    }
    if (changes > 1 || (changes == 1 && last == 0)) return false;
    if (changes == 1) refine(low, high);
    if (last == 0) add_exact(dyadic_of(pool_, high), high);
    return true;
  }

  // Appends the rounded roots of p' in (0,1), ascending. Between them p has at most one root, nearly always.
  int turning_points(double (&ends)[4]) const noexcept {
    int count = 1;
    double turns[2];
    int number = 1;
    if (p_.degree == 2) {
      turns[0] = -rounded_.c[1] / (2 * rounded_.c[2]);
    } else {
      const double a = 3 * rounded_.c[3], b = rounded_.c[2], c = rounded_.c[1];
      const double square = b * b - a * c;
      const double q = -(b + std::copysign(std::sqrt(square > 0 ? square : 0), b));
      turns[0] = q / a;
      turns[1] = c / q;
      if (turns[1] < turns[0]) std::swap(turns[0], turns[1]);
      number = 2;
    }
    for (int i = 0; i < number; ++i) {
      if (turns[i] > ends[count - 1] && turns[i] < 1) ends[count++] = turns[i];
    }
    return count;
  }

  // Roots with low < root <= high. Calls nest only where both halves have roots.
  void isolate(double low, double high, int before, int after) {
    while (before - after > 1) {
      const std::uint64_t a = bits_of(low), b = bits_of(high);
      if (b - a == 1) return isolate_within(low, dyadic_of(pool_, low), dyadic_of(pool_, high), before, after, high);
      const double middle = of_bits(a + (b - a) / 2);
      const int between = sturm_->variations(dyadic_of(pool_, middle));
      if (between == after) {
        high = middle;
        continue;
      }
      if (between != before) isolate(low, middle, before, between);
      low = middle;
      before = between;
    }
    if (before != after) refine(low, high);
  }

  // A time between two roots, of which there are two or three between low and high: next to where p turns or bends, which takes some
  // steps of Narrowing where halving takes one for each bit. Where this is not near a single turn or bend: half way.
  Dyadic between_roots(const Dyadic& low, const Dyadic& high, int before, int after) {
    const int count = before - after, sign_low = sign_after(pool_, p_, low);
    const auto is_between = [&](const Dyadic& time) {
      if (count == 2 && sign_at(p_, time) == sign_low) return false;
      const int here = sturm_->variations(time);
      return here != before && here != after;
    };
    Root turn;
    turn.of = derivative(pool_, p_);
    if (count == 3) turn.of = derivative(pool_, turn.of);
    if (sign_at(turn.of, low) * sign_at(turn.of, high) < 0) {
      turn.low = low;
      turn.high = high;
      for (Narrowing narrow(pool_, turn); !narrow.is_exact();) {
        narrow.step();
        if (is_between(narrow.low())) return narrow.low();
        if (is_between(narrow.high())) return narrow.high();
      }
    }
    return half_way(low, high);
  }

  // Isolates roots between two neighbouring doubles.
  void isolate_within(double floor, Dyadic low, Dyadic high, int before, int after, double next) {
    while (before - after > 1) {
      const Dyadic middle = between_roots(low, high, before, after);
      const int between = sturm_->variations(middle);
      if (between == after) {
        high = middle;
        continue;
      }
      if (between != before) isolate_within(floor, low, middle, before, between, next);
      low = middle;
      before = between;
    }
    if (sign_at(p_, high) == 0) {
      const bool is_next = compare(high, dyadic_of(pool_, next)) == 0;
      roots_[found_++] = exact_root(p_, high, is_next ? next : floor, is_next);
    } else {
      add(low, high, floor);
    }
  }

  // The root with low < root <= high, between two neighbouring doubles.
  void refine(double low, double high) {
    const Dyadic first = dyadic_of(pool_, low), last = dyadic_of(pool_, high);
    if (sign_at(p_, last) == 0) return add_exact(last, high);
    roots_[found_++] = refined_root(pool_, p_, rounded_, first, last, low, high);
  }

  void add_exact(const Dyadic& at, double floor) { roots_[found_++] = exact_root(p_, at, floor, true); }
  void add(const Dyadic& low, const Dyadic& high, double floor) {
    Root& root = roots_[found_++];
    root.of = p_;
    root.is_low = root.is_floor = false;
    root.low = low;
    root.high = high;
    root.floor = floor;
  }

  IntegerPool& pool_;
  const Polynomial& p_;
  Root* roots_;
  Rounded rounded_;
  const SturmSequence* sturm_ = nullptr;
  int found_ = 0;
};

IntegerPool& pool_of(const Polynomial& p) noexcept { return *p.c[p.degree].pool; }

using polynomials::compare;

// Sign of root - x.
int compare(const Root& root, const Dyadic& x) {
  if (root.is_low) return compare(root.low, x);
  if (compare(x, root.low) <= 0) return 1;
  if (compare(x, root.high) >= 0) return -1;
  const int sign = sign_at(root.of, x);
  return sign == 0 ? 0 : sign == sign_after(pool_of(root.of), root.of, root.low) ? 1 : -1;
}

// Sign at the root of a polynomial of degree 1 at most. The root is not its `low`.
int sign_of_line(IntegerPool& pool, const Polynomial& line, const Root& root) {
  if (line.degree < 1) return line.degree < 0 ? 0 : line.c[0].sign();
  const int at_low = sign_at(line, root.low), at_high = sign_at(line, root.high);
  if (at_low == at_high || at_high == 0) return at_low;
  if (at_low == 0) return at_high;
  const int at_zero = sign_at_zero(root.of, line);
  if (at_zero == 0) return 0;
  return at_zero == sign_after(pool, root.of, root.low) ? at_high : at_low;
}

}  // namespace

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  Polynomial r;
  r.degree = a.degree > b.degree ? a.degree : b.degree;
  for (int i = 0; i <= r.degree; ++i) r.c[i] = i > a.degree ? b.c[i] : i > b.degree ? a.c[i] : a.c[i] + b.c[i];
  r.trim();
  return r;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) {
  Polynomial negative = b;
  for (int i = 0; i <= b.degree; ++i) negative.c[i] = -b.c[i];
  return a + negative;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial r;
  if (a.degree < 0 || b.degree < 0) return r;
  r.degree = a.degree + b.degree;
  for (int i = 0; i <= a.degree; ++i) {
    // The second condition always holds. Without it g++ for ARM warns.
    for (int j = 0; j <= b.degree && i + j <= Polynomial::kMostDegree; ++j) r.c[i + j] = r.c[i + j] + a.c[i] * b.c[j];
  }
  return r;
}

int find_roots(IntegerPool& pool, const Polynomial& p, Root (&roots)[Polynomial::kMostDegree]) {
  if (p.degree == 0) return 0;
  if (p.degree > 3) return find_roots_by_halving(pool, p, roots);
  RootFinder by_signs(pool, p, roots);
  if (by_signs.find_by_signs()) return by_signs.found();
  const SturmSequence sturm(p, derivative(pool, p));
  const bool is_simple = sturm.last().degree == 0;
  Polynomial rest = p;
  const Polynomial simple = is_simple ? p : divide(rest, sturm.last());
  RootFinder finder(pool, simple, roots);
  finder.find_by_sturm(is_simple ? sturm : SturmSequence(simple, derivative(pool, simple)));
  return finder.found();
}

Root root_at_start() {
  Root root;
  root.is_low = root.is_floor = true;
  return root;
}

int sign_at(const Polynomial& p, const Root& root) {
  if (p.degree <= 0) return p.degree < 0 ? 0 : p.c[0].sign();
  if (root.is_low) return sign_at(p, root.low);
  const int sure = Rounded(p).sure_sign(root.floor);
  if (sure != 0) return sure;
  {
    IntegerPool& pool = pool_of(root.of);
    const IntegerPool::Scope scope(pool);
    const int clear = clear_sign(pool, p, root.low, root.high);
    if (clear != 0) return clear;
  }
  return sign_by_division(p, root);
}

int sign_by_division(const Polynomial& p, const Root& root) {
  if (p.degree <= 0) return p.degree < 0 ? 0 : p.c[0].sign();
  IntegerPool& pool = pool_of(root.of);
  const IntegerPool::Scope scope(pool);
  if (p.degree > 3 || root.of.degree > 3) return sign_by_divisor(pool, p, root);
  const Polynomial rest = p.degree < root.of.degree ? p : remainder(p, root.of);
  if (rest.degree < 2) return sign_of_line(pool, rest, root);
  // `of` is the line times `rest`, and a remainder. It is 0 at the root.
  Polynomial left = root.of;
  const Polynomial line = divide(left, rest);
  const int side = sign_of_line(pool, line, root);
  return side == 0 ? sign_at_zero(rest, line) : -side * sign_of_line(pool, left, root);
}

int compare(const Root& a, const Root& b) {
  if (a.floor != b.floor) return a.floor < b.floor ? -1 : 1;
  if (b.is_low) return compare(a, b.low);
  if (a.is_low) return -compare(b, a.low);
  IntegerPool& pool = pool_of(b.of);
  const IntegerPool::Scope scope(pool);
  if (compare(a, b.low) <= 0) return -1;
  if (compare(a, b.high) >= 0) return 1;
  const int sign = sign_at(b.of, a);
  return sign == 0 ? 0 : sign == sign_after(pool, b.of, b.low) ? -1 : 1;
}

}  // namespace dsw