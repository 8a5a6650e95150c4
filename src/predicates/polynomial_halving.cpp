// Roots of any degree by halving [0,1]: G. E. Collins, A. G. Akritas, Polynomial real root isolation using Descartes' rule
// of signs, 1976. A part of [0,1] has no root if the coefficients in the basis of Bernstein do not change their sign, and
// one root if they change it once.
//
// Repeated roots are never separated. So after some halvings repeated factors are divided out. Whether there are any is
// asked modulo a prime first: if there are none there, there are none.
#include <utility>

#include "predicates/polynomial_narrowing.h"

namespace dsw {
namespace polynomials {

namespace {

constexpr int kMostTerms = Polynomial::kMostDegree + 1;
constexpr int kMostPlainHalvings = 40;

// 2^61 - 1. Values are below it.
constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;

std::uint64_t modulo(Uint128 x) noexcept {
  std::uint64_t sum = (static_cast<std::uint64_t>(x) & kPrime) + static_cast<std::uint64_t>(x >> 61);
  while (sum >= kPrime) sum -= kPrime;
  return sum;
}
std::uint64_t product(std::uint64_t a, std::uint64_t b) noexcept { return modulo(static_cast<Uint128>(a) * b); }

// A polynomial modulo the prime.
struct Residues {
  int degree;
  std::uint64_t c[kMostTerms];

  explicit Residues(const Polynomial& p) noexcept : degree(p.degree) {
    for (int i = 0; i <= degree; ++i) {
      std::uint64_t sum = 0;
      // 2^64 is 8 modulo the prime.
      for (int k = p.c[i].size; k-- > 0;) sum = modulo(static_cast<Uint128>(sum) * 8 + p.c[i].limb[k]);
      c[i] = p.c[i].negative && sum != 0 ? kPrime - sum : sum;
    }
  }

  bool keeps_degree() const noexcept { return degree >= 0 && c[degree] != 0; }
};

// Whether they certainly have no common divisor.
bool are_coprime(const Polynomial& p, const Polynomial& q) noexcept {
  Residues a(p), b(q);
  if (!a.keeps_degree() || !b.keeps_degree()) return false;
  while (true) {
    if (a.degree < b.degree) std::swap(a, b);
    if (b.degree <= 0) return b.degree == 0;
    const std::uint64_t of_a = a.c[a.degree], of_b = b.c[b.degree];
    const int ahead = a.degree - b.degree;
    for (int i = 0; i < a.degree; ++i) {
      a.c[i] = product(a.c[i], of_b);
      if (i >= ahead) a.c[i] = modulo(static_cast<Uint128>(a.c[i]) + (kPrime - product(of_a, b.c[i - ahead])));
    }
    while (--a.degree >= 0 && a.c[a.degree] == 0) {
    }
  }
}

// A multiple of the greatest common divisor of two that are not 0.
Polynomial common_divisor(Polynomial a, Polynomial b) {
  if (a.degree < b.degree) std::swap(a, b);
  while (b.degree >= 0) {
    Polynomial rest = b.degree == 0 ? Polynomial{} : remainder(a, b);
    a = std::move(b);
    b = std::move(rest);
  }
  return a;
}

// The sum of c[i] s^(n-i) t^i, where t goes from 0 to 1 over a part of [0,1] and s = 1 - t. The part has `low` as its
// low end, and halves in [0,1].
struct Part {
  int degree;
  Integer c[kMostTerms];
  Dyadic low;

  // Replaces c[j] by the sum of c[i] (n-i over j-i) for all i up to j.
  void spread() {
    for (int last = degree; last > 0; --last) {
      for (int i = 1; i <= last; ++i) c[i] = c[i] + c[i - 1];
    }
  }

  Dyadic high() const { return {low.numerator + one_, low.shift}; }

  // Changes of sign: as many roots lie strictly inside, or fewer by an even number.
  int changes() const noexcept {
    int number = 0, before = 0;
    for (int i = 0; i <= degree; ++i) {
      const int sign = c[i].sign();
      number += sign * before < 0 ? 1 : 0;
      if (sign != 0) before = sign;
    }
    return number;
  }

  // Both halves, times powers of 2.
  Part first_half() const {
    Part half = *this;
    half.spread();
    for (int i = 0; i <= degree; ++i) half.c[i] = shifted(half.c[i], degree - i);
    half.low = {shifted(low.numerator, 1), low.shift + 1};
    return half;
  }
  Part second_half(const Part& first) const {
    Part half = *this;
    half.reverse();
    half.spread();
    for (int i = 0; i <= degree; ++i) half.c[i] = shifted(half.c[i], degree - i);
    half.reverse();
    half.low = first.high();
    return half;
  }
  void reverse() noexcept {
    for (int i = 0; 2 * i < degree; ++i) std::swap(c[i], c[degree - i]);
  }

  Part(IntegerPool& pool, const Polynomial& p) : degree(p.degree), one_(integer_of(pool, std::uint64_t{1})) {
    for (int i = 0; i <= degree; ++i) c[i] = p.c[i];
    spread();
  }

 private:
  Integer one_;
};

// The largest double that is not above x, which is at least 0.
double double_below(const Dyadic& x, bool* is_exact) {
  *is_exact = true;
  const Integer& n = x.numerator;
  if (n.size == 0) return 0;
  const int length = n.bit_length();
  int drop = length - 53;
  if (drop - x.shift < -1074) drop = x.shift - 1074;
  if (drop >= length) {
    *is_exact = false;
    return 0;
  }
  const std::uint64_t top = limbs::bits_from(n.limb, n.size, drop);
  *is_exact = drop <= 0 || !limbs::any_below(n.limb, n.size, drop);
  return std::ldexp(static_cast<double>(top), drop - x.shift);
}

class Isolation {
 public:
  Isolation(IntegerPool& pool, const Polynomial& p, bool is_simple, Root (&roots)[Polynomial::kMostDegree])
      : pool_(pool), p_(p), is_simple_(is_simple), roots_(roots), rounded_(p) {}

  // False: p may have repeated factors, and they come first.
  bool find() {
    found_ = 0;
    if (p_.c[0].sign() == 0) roots_[found_++] = exact_root(p_, {}, 0, true);
    const Part whole(pool_, p_);
    if (!isolate(whole)) return false;
    if (whole.c[whole.degree].sign() == 0) roots_[found_++] = exact_root(p_, whole.high(), 1, true);
    return true;
  }

  int found() const noexcept { return found_; }

 private:
  // Calls nest only where both halves have roots.
  bool isolate(Part part) {
    while (true) {
      const int changes = part.changes();
      if (changes == 0) return true;
      if (changes == 1) {
        add_only_root(part);
        return true;
      }
      if (part.low.shift == kMostPlainHalvings && !is_simple_) {
        is_simple_ = are_coprime(p_, derivative(pool_, p_));
        if (!is_simple_) return false;
      }
      Part first = part.first_half();
      Part second = part.second_half(first);
      if (first.changes() != 0 && !isolate(std::move(first))) return false;
      if (second.c[0].sign() == 0) {
        bool is_floor = false;
        const double floor = double_below(second.low, &is_floor);
        roots_[found_++] = exact_root(p_, second.low, floor, is_floor);
      }
      part = std::move(second);
    }
  }

  void add_only_root(const Part& part) {
    Dyadic low = part.low, high = part.high();
    if (part.c[part.degree].sign() == 0) {  // the next root
      const int after_low = sign_after(pool_, p_, low);
      int sign = after_low;
      while (sign == after_low) {
        const Dyadic middle = half_way(low, high);
        sign = sign_at(p_, middle);
        (sign == after_low ? low : high) = middle;
      }
      if (sign == 0) {
        bool is_floor = false;
        const double floor = double_below(high, &is_floor);
        roots_[found_++] = exact_root(p_, high, floor, is_floor);
        return;
      }
    }
    bool is_exact = false;
    const double below = double_below(low, &is_exact);
    double above = double_below(high, &is_exact);
    if (!is_exact) above = integers::of_bits(integers::bits_of(above) + 1);
    roots_[found_++] = refined_root(pool_, p_, rounded_, low, high, below, above);
  }

  IntegerPool& pool_;
  const Polynomial& p_;
  bool is_simple_;
  Root (&roots_)[Polynomial::kMostDegree];
  Rounded rounded_;
  int found_ = 0;
};

int clear_sign_within(IntegerPool& pool, const Polynomial& p, const Dyadic& low, const Dyadic& high) {
  const IntegerPool::Scope scope(pool);
  return clear_sign(pool, p, low, high);
}

}  // namespace

int find_roots_by_halving(IntegerPool& pool, const Polynomial& p, Root (&roots)[Polynomial::kMostDegree]) {
  Isolation plain(pool, p, false, roots);
  if (plain.find()) return plain.found();
  const Polynomial divisor = common_divisor(p, derivative(pool, p));
  Polynomial rest = p;
  const Polynomial simple = divisor.degree > 0 ? divide(rest, divisor) : p;
  if (simple.degree <= 3) return find_roots(pool, simple, roots);
  Isolation isolation(pool, simple, true, roots);
  isolation.find();
  return isolation.found();
}

int sign_by_divisor(IntegerPool& pool, const Polynomial& p, const Root& root) {
  if (!are_coprime(p, root.of)) {
    const Polynomial divisor = common_divisor(p, root.of);
    if (divisor.degree > 0 && sign_after(pool, divisor, root.low) != sign_at(divisor, root.high)) return 0;
  }
  Narrowing narrow(pool, root);
  while (true) {
    if (narrow.is_exact()) return sign_at(p, narrow.low());
    const int clear = clear_sign_within(pool, p, narrow.low(), narrow.high());
    if (clear != 0) return clear;
    narrow.step();
  }
}

}  // namespace polynomials
}  // namespace dsw
