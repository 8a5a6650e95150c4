// Signed integers without a limit of length, for polynomials whose coefficients grow. Private to this folder.
//
// The limbs of all integers of one question lie one behind the other in a pool. The pool's first part is on the stack;
// only coordinates that spread over hundreds of bits need more. Operators put their results into the pool.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "predicates/ball.h"
#include "predicates/integers.h"
#include "predicates/wide_int.h"

namespace dsw {

class IntegerPool {
 public:
  // Room for `size` limbs at the end of the pool. `keep` says how many of them are used.
  std::uint64_t* room(int size) {
    if (end_ - next_ < size) add_block(size);
    return next_;
  }
  void keep(int size) noexcept { next_ += size; }

  std::uint64_t products = 0;  // of two limbs, in all multiplications so far

  // Gives back, at its end, what was taken since it began.
  class Scope {
   public:
    explicit Scope(IntegerPool& pool) noexcept
        : pool_(pool), next_(pool.next_), end_(pool.end_), last_(pool.last_.get()) {}
    ~Scope() {
      while (pool_.last_.get() != last_) pool_.last_ = std::move(pool_.last_->before);
      pool_.next_ = next_;
      pool_.end_ = end_;
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    IntegerPool& pool_;
    std::uint64_t* next_;
    std::uint64_t* end_;
    const void* last_;
  };

  IntegerPool() noexcept : next_(own_), end_(own_ + kOwn) {}
  IntegerPool(const IntegerPool&) = delete;
  IntegerPool& operator=(const IntegerPool&) = delete;

 private:
  static constexpr int kOwn = 3000;
  struct Block {
    std::unique_ptr<Block> before;
    std::unique_ptr<std::uint64_t[]> limbs;
  };

  DSW_COLD void add_block(int size) {
    const int count = size > 4 * kOwn ? size : 4 * kOwn;
    auto block = std::make_unique<Block>();
    block->limbs.reset(new std::uint64_t[static_cast<std::size_t>(count)]);
    next_ = block->limbs.get();
    end_ = next_ + count;
    block->before = std::move(last_);
    last_ = std::move(block);
  }

  std::uint64_t* next_;
  std::uint64_t* end_;
  std::unique_ptr<Block> last_;
  std::uint64_t own_[kOwn];  // only what is in use is ever read
};

// Sign and magnitude. A copy shares the limbs.
struct Integer {
  IntegerPool* pool = nullptr;  // null for a 0
  const std::uint64_t* limb = nullptr;
  int size = 0;
  bool negative = false;

  int sign() const noexcept { return size == 0 ? 0 : negative ? -1 : 1; }
  int bit_length() const noexcept { return limbs::bit_length(limb, size); }

  // The highest 128 bits.
  Ball ball() const noexcept {
    if (size == 0) return {};
    const int low = bit_length() - 128;
    const Uint128 magnitude =
        static_cast<Uint128>(limbs::bits_from(limb, size, low + 64)) << 64 | Uint128(limbs::bits_from(limb, size, low));
    return {magnitude, low, negative, limbs::any_below(limb, size, low) ? 1.0 : 0.0};
  }

  // The value divided by 2^drop, with a relative error below 2^-52.
  double scaled(int drop) const noexcept {
    if (size == 0) return 0;
    const int top = bit_length() - 64;
    const double magnitude = std::ldexp(static_cast<double>(limbs::bits_from(limb, size, top)), top - drop);
    return negative ? -magnitude : magnitude;
  }
};

inline Integer shifted(const Integer& a, int bits) {
  if (a.size == 0 || bits == 0) return a;
  std::uint64_t* const r = a.pool->room(a.size + bits / 64 + 1);
  const int size = limbs::shift_left(r, a.limb, a.size, bits);
  a.pool->keep(size);
  return {a.pool, r, size, a.negative};
}

inline Integer integer_of(IntegerPool& pool, std::uint64_t magnitude, bool negative = false) {
  if (magnitude == 0) return {};
  std::uint64_t* const r = pool.room(1);
  *r = magnitude;
  pool.keep(1);
  return {&pool, r, 1, negative};
}

// x * 2^(1075 - low), where that is an integer.
inline Integer integer_of(IntegerPool& pool, double x, int low) {
  const integers::Decoded d = integers::decode(x);
  if (d.magnitude == 0) return {};
  const int zeros = static_cast<int>(lowest_bit(d.magnitude));
  return shifted(integer_of(pool, d.magnitude >> zeros, d.negative), d.exponent + zeros - low);
}

inline Integer operator-(Integer a) noexcept {
  a.negative = !a.negative;
  return a;
}

inline Integer operator+(const Integer& a, const Integer& b) {
  if (a.size == 0) return b;
  if (b.size == 0) return a;
  IntegerPool* const pool = a.pool;
  std::uint64_t* const r = pool->room((a.size > b.size ? a.size : b.size) + 1);
  Integer sum = {pool, r, 0, a.negative};
  if (a.negative == b.negative) {
    sum.size = limbs::add(r, a.limb, a.size, b.limb, b.size);
  } else if (limbs::compare(a.limb, a.size, b.limb, b.size) >= 0) {
    sum.size = limbs::subtract(r, a.limb, a.size, b.limb, b.size);
  } else {
    sum.size = limbs::subtract(r, b.limb, b.size, a.limb, a.size);
    sum.negative = b.negative;
  }
  pool->keep(sum.size);
  return sum;
}
inline Integer operator-(const Integer& a, const Integer& b) { return a + -b; }

inline Integer operator*(const Integer& a, const Integer& b) {
  if (a.size == 0 || b.size == 0) return {};
  std::uint64_t* const r = a.pool->room(a.size + b.size);
  const int size = limbs::multiply(r, a.limb, a.size, b.limb, b.size);
  a.pool->keep(size);
  a.pool->products += static_cast<std::uint64_t>(a.size) * static_cast<std::uint64_t>(b.size);
  return {a.pool, r, size, a.negative != b.negative};
}

}  // namespace dsw
