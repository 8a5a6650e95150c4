// Places of roots that become ever narrower. Private to this folder.
#pragma once

#include <cmath>

#include "predicates/polynomial_parts.h"

namespace dsw {
namespace polynomials {

// The place of a root, ever narrower: J. Abbott, Quadratic interval refinement for real roots, 2014. The part is cut into
// 2^bits pieces, and the values at its ends say in which one the root should be. If it is, the next cut is finer.
class Narrowing {
 public:
  Narrowing(IntegerPool& pool, const Root& root) : pool_(pool), of_(root.of), low_(root.low), high_(root.high) {
    sign_low_ = sign_after(pool, of_, low_);
    share_shift();
  }

  const Dyadic& low() const noexcept { return low_; }
  const Dyadic& high() const noexcept { return high_; }
  // Whether the root is low.
  bool is_exact() const noexcept { return is_exact_; }

  void step() {
    const std::uint64_t count = std::uint64_t{1} << bits_, at = guess(count);
    const Integer width = high_.numerator - low_.numerator;
    const int shift = low_.shift + bits_;
    const auto cut = [&](std::uint64_t index) {
      const Integer part = index == 0 ? Integer{} : width * integer_of(pool_, index);
      return Dyadic{shifted(low_.numerator, bits_) + part, shift};
    };
    const Dyadic first = cut(at), second = cut(at + 1);
    const int sign_first = at == 0 ? sign_low_ : sign_at(of_, first);
    const int sign_second = at + 1 == count ? -sign_low_ : sign_at(of_, second);
    if (sign_first == 0 || sign_second == 0) {
      low_ = high_ = sign_first == 0 ? first : second;
      is_exact_ = true;
      return;
    }
    const bool is_there = sign_first == sign_low_ && sign_second != sign_low_;
    if (sign_first != sign_low_) {
      high_ = first;
    } else {
      low_ = sign_second == sign_low_ ? second : first;
      if (is_there) high_ = second;
    }
    bits_ = is_there ? (2 * bits_ < kMostBits ? 2 * bits_ : kMostBits) : (bits_ > 1 ? bits_ / 2 : 1);
    share_shift();
  }

 private:
  static constexpr int kMostBits = 40;

  void share_shift() {
    const int shift = low_.shift > high_.shift ? low_.shift : high_.shift;
    low_ = {shifted(low_.numerator, shift - low_.shift), shift};
    high_ = {shifted(high_.numerator, shift - high_.shift), shift};
  }

  // The piece where a line between the values is 0.
  std::uint64_t guess(std::uint64_t count) const {
    const IntegerPool::Scope scope(pool_);
    const Integer a = low_.numerator.size == 0 ? shifted(of_.c[0], low_.shift * of_.degree) : value_at(of_, low_),
                  b = value_at(of_, high_);
    const int length = a.bit_length() > b.bit_length() ? a.bit_length() : b.bit_length();
    const double x = std::fabs(a.scaled(length)), y = std::fabs(b.scaled(length));
    const double at = x / (x + y) * static_cast<double>(count);
    return at >= static_cast<double>(count) ? count - 1 : static_cast<std::uint64_t>(at);
  }

  IntegerPool& pool_;
  const Polynomial& of_;
  Dyadic low_, high_;
  int sign_low_ = 0;
  int bits_ = 1;
  bool is_exact_ = false;
};

}  // namespace polynomials
}  // namespace dsw
