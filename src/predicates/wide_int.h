// Signed integers of fixed capacity and dynamic length, on the stack: what decides a sign when doubles cannot.
//
// Sign and magnitude, 64-bit limbs, least significant first. Only the used limbs are ever touched, so the cost follows
// the operands and a large capacity is free. Results have the capacity their type needs (a sum one limb more than
// the larger operand, a product the sum of both), so nothing can overflow; only shifted_left states a precondition.
#pragma once

#include <cstdint>

#include "base/compiler.h"

namespace dsw {

// Magnitudes. Lengths count used limbs (the last one is not 0, zero has length 0); each returns the length of r.
namespace limbs {
int compare(const std::uint64_t* a, int a_size, const std::uint64_t* b, int b_size) noexcept;
int add(std::uint64_t* r, const std::uint64_t* a, int a_size, const std::uint64_t* b, int b_size) noexcept;
int subtract(std::uint64_t* r, const std::uint64_t* a, int a_size, const std::uint64_t* b,
             int b_size) noexcept;  // a >= b
int multiply(std::uint64_t* r, const std::uint64_t* a, int a_size, const std::uint64_t* b, int b_size) noexcept;
int shift_left(std::uint64_t* r, const std::uint64_t* a, int a_size, int bits) noexcept;  // r may not overlap a
int bit_length(const std::uint64_t* a, int a_size) noexcept;
// The 64 bits of a from `bit` upwards; bits beyond either end are 0 (bit may be negative).
std::uint64_t bits_from(const std::uint64_t* a, int a_size, int bit) noexcept;
// Whether a has a bit set below `bit`.
bool any_below(const std::uint64_t* a, int a_size, int bit) noexcept;
// floor(a * 2^shift / b) for shift >= 0, a >= 0, b > 0, when that is below 2^60. Allocates nothing, copies nothing.
std::uint64_t scaled_quotient(const std::uint64_t* a, int a_size, int shift, const std::uint64_t* b,
                              int b_size) noexcept;
}  // namespace limbs

template <int Capacity>
class WideInt {
 public:
  static_assert(Capacity > 0, "a WideInt holds at least one limb");
  static constexpr int kCapacity = Capacity;

  WideInt() noexcept : size_(0), negative_(false) {}

  // magnitude * 2^shift, shift >= 0; the result must fit.
  WideInt(std::uint64_t magnitude, bool negative, int shift) noexcept : size_(0), negative_(false) {
    if (magnitude == 0) return;
    negative_ = negative;
    size_ = limbs::shift_left(limb_, &magnitude, 1, shift);
  }

  // Limbs of a magnitude; leading zeros are allowed.
  WideInt(const std::uint64_t* magnitude, int size, bool negative) noexcept : size_(0), negative_(false) {
    while (size > 0 && magnitude[size - 1] == 0) --size;
    size_ = size;
    negative_ = negative && size > 0;
    for (int i = 0; i < size; ++i) limb_[i] = magnitude[i];
  }

  WideInt(const WideInt& other) noexcept : size_(other.size_), negative_(other.negative_) { copy(other.limb_); }

  template <int Other>
  WideInt(const WideInt<Other>& other) noexcept : size_(other.size()), negative_(other.sign() < 0) {
    static_assert(Other <= Capacity, "a WideInt converts to a larger capacity only");
    copy(other.limb());
  }

  WideInt& operator=(const WideInt& other) noexcept {
    if (this == &other) return *this;
    size_ = other.size_;
    negative_ = other.negative_;
    copy(other.limb_);
    return *this;
  }

  int sign() const noexcept { return size_ == 0 ? 0 : (negative_ ? -1 : 1); }
  int size() const noexcept { return size_; }
  const std::uint64_t* limb() const noexcept { return limb_; }
  int bit_length() const noexcept { return limbs::bit_length(limb_, size_); }

  WideInt operator-() const noexcept {
    WideInt r(*this);
    r.negative_ = size_ > 0 && !negative_;
    return r;
  }

  // *this = a + b, or a - b with flip.
  template <int A, int B>
  void set_sum(const WideInt<A>& a, const WideInt<B>& b, bool flip) noexcept {
    static_assert(Capacity > A && Capacity > B, "a sum needs one limb more than its terms");
    const bool a_negative = a.sign() < 0;
    const bool b_negative = (b.sign() < 0) != flip;
    if (a_negative == b_negative) {
      size_ = limbs::add(limb_, a.limb(), a.size(), b.limb(), b.size());
      negative_ = a_negative && size_ > 0;
    } else if (limbs::compare(a.limb(), a.size(), b.limb(), b.size()) >= 0) {
      size_ = limbs::subtract(limb_, a.limb(), a.size(), b.limb(), b.size());
      negative_ = a_negative && size_ > 0;
    } else {
      size_ = limbs::subtract(limb_, b.limb(), b.size(), a.limb(), a.size());
      negative_ = b_negative;
    }
  }

  template <int A, int B>
  void set_product(const WideInt<A>& a, const WideInt<B>& b) noexcept {
    static_assert(Capacity >= A + B, "a product needs the limbs of both factors");
    size_ = limbs::multiply(limb_, a.limb(), a.size(), b.limb(), b.size());
    negative_ = size_ > 0 && (a.sign() < 0) != (b.sign() < 0);
  }

 private:
  void copy(const std::uint64_t* from) noexcept {
    for (int i = 0; i < size_; ++i) limb_[i] = from[i];
  }

  int size_;
  bool negative_;
  std::uint64_t limb_[Capacity];  // only the first size_ are ever read
};

constexpr int wide_max(int a, int b) noexcept { return a > b ? a : b; }

template <int A, int B>
WideInt<wide_max(A, B) + 1> operator+(const WideInt<A>& a, const WideInt<B>& b) noexcept {
  WideInt<wide_max(A, B) + 1> r;
  r.set_sum(a, b, false);
  return r;
}

template <int A, int B>
WideInt<wide_max(A, B) + 1> operator-(const WideInt<A>& a, const WideInt<B>& b) noexcept {
  WideInt<wide_max(A, B) + 1> r;
  r.set_sum(a, b, true);
  return r;
}

template <int A, int B>
WideInt<A + B> operator*(const WideInt<A>& a, const WideInt<B>& b) noexcept {
  WideInt<A + B> r;
  r.set_product(a, b);
  return r;
}

// Sign of a - b.
template <int A, int B>
int compare(const WideInt<A>& a, const WideInt<B>& b) noexcept {
  if (a.sign() != b.sign()) return a.sign() < b.sign() ? -1 : 1;
  const int magnitude = limbs::compare(a.limb(), a.size(), b.limb(), b.size());
  return a.sign() < 0 ? -magnitude : magnitude;
}

// a * 2^bits; Capacity must hold it.
template <int Capacity, int A>
WideInt<Capacity> shifted_left(const WideInt<A>& a, int bits) noexcept {
  std::uint64_t shifted[Capacity];
  const int size = a.sign() == 0 ? 0 : limbs::shift_left(shifted, a.limb(), a.size(), bits);
  return WideInt<Capacity>(shifted, size, a.sign() < 0);
}

}  // namespace dsw
