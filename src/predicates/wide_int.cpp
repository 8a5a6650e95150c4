// Magnitude arithmetic of wide_int.h: schoolbook throughout; operands rarely exceed a handful of limbs, and reach a
// hundred only when the largest doubles stand next to the smallest.
#include "predicates/wide_int.h"

#include "base/compiler.h"

namespace dsw {
namespace limbs {

namespace {

int trimmed(const std::uint64_t* r, int size) noexcept {
  while (size > 0 && r[size - 1] == 0) --size;
  return size;
}

}  // namespace

int compare(const std::uint64_t* a, int a_size, const std::uint64_t* b, int b_size) noexcept {
  if (a_size != b_size) return a_size < b_size ? -1 : 1;
  for (int i = a_size - 1; i >= 0; --i) {
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  }
  return 0;
}

int add(std::uint64_t* r, const std::uint64_t* a, int a_size, const std::uint64_t* b, int b_size) noexcept {
  if (a_size < b_size) return add(r, b, b_size, a, a_size);
  Uint128 carry = 0;
  for (int i = 0; i < b_size; ++i) {
    carry += static_cast<Uint128>(a[i]) + b[i];
    r[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  for (int i = b_size; i < a_size; ++i) {
    carry += a[i];
    r[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  if (carry == 0) return a_size;
  r[a_size] = static_cast<std::uint64_t>(carry);
  return a_size + 1;
}

int subtract(std::uint64_t* r, const std::uint64_t* a, int a_size, const std::uint64_t* b, int b_size) noexcept {
  std::uint64_t borrow = 0;
  for (int i = 0; i < b_size; ++i) {
    const Uint128 d = static_cast<Uint128>(a[i]) - b[i] - borrow;
    r[i] = static_cast<std::uint64_t>(d);
    borrow = static_cast<std::uint64_t>(d >> 64) & 1;
  }
  for (int i = b_size; i < a_size; ++i) {
    const Uint128 d = static_cast<Uint128>(a[i]) - borrow;
    r[i] = static_cast<std::uint64_t>(d);
    borrow = static_cast<std::uint64_t>(d >> 64) & 1;
  }
  return trimmed(r, a_size);
}

int multiply(std::uint64_t* r, const std::uint64_t* a, int a_size, const std::uint64_t* b, int b_size) noexcept {
  if (a_size == 0 || b_size == 0) return 0;
  for (int j = 0; j < b_size; ++j) r[j] = 0;
  for (int i = 0; i < a_size; ++i) {
    std::uint64_t carry = 0;
    const Uint128 factor = a[i];
    for (int j = 0; j < b_size && factor != 0; ++j) {
      const Uint128 t = factor * b[j] + r[i + j] + carry;
      r[i + j] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    r[i + b_size] = carry;
  }
  return trimmed(r, a_size + b_size);
}

int shift_left(std::uint64_t* r, const std::uint64_t* a, int a_size, int bits) noexcept {
  const int whole = bits / 64;
  const int rest = bits % 64;
  for (int i = 0; i < whole; ++i) r[i] = 0;
  if (rest == 0) {
    for (int i = 0; i < a_size; ++i) r[whole + i] = a[i];
    return trimmed(r, whole + a_size);
  }
  std::uint64_t carry = 0;
  for (int i = 0; i < a_size; ++i) {
    r[whole + i] = (a[i] << rest) | carry;
    carry = a[i] >> (64 - rest);
  }
  if (carry == 0) return trimmed(r, whole + a_size);
  r[whole + a_size] = carry;
  return whole + a_size + 1;
}

int bit_length(const std::uint64_t* a, int a_size) noexcept {
  return a_size == 0 ? 0 : 64 * (a_size - 1) + 1 + static_cast<int>(highest_bit(a[a_size - 1]));
}

std::uint64_t bits_from(const std::uint64_t* a, int a_size, int bit) noexcept {
  if (bit <= -64) return 0;
  if (bit < 0) return a_size > 0 ? a[0] << -bit : 0;
  const int whole = bit / 64;
  const int rest = bit % 64;
  const std::uint64_t low = whole < a_size ? a[whole] : 0;
  if (rest == 0) return low;
  const std::uint64_t high = whole + 1 < a_size ? a[whole + 1] : 0;
  return (low >> rest) | (high << (64 - rest));
}

bool any_below(const std::uint64_t* a, int a_size, int bit) noexcept {
  for (int i = 0; i < a_size && 64 * i < bit; ++i) {
    const int kept = bit - 64 * i;
    if ((kept >= 64 ? a[i] : a[i] << (64 - kept)) != 0) return true;
  }
  return false;
}

std::uint64_t scaled_quotient(const std::uint64_t* a, int a_size, int shift, const std::uint64_t* b,
                              int b_size) noexcept {
  // With the top 64 bits t of b = t * 2^s + ..., and the numerator cut at the same place, floor(cut / t) is the
  // quotient or, as the quotient is below 2^60 and t >= 2^63, one more. If b is shorter than that it is exact.
  const int b_bits = bit_length(b, b_size);
  const int s = b_bits > 64 ? b_bits - 64 : 0;
  const std::uint64_t top = bits_from(b, b_size, s);
  const Uint128 cut =
      (static_cast<Uint128>(bits_from(a, a_size, s - shift + 64)) << 64) | bits_from(a, a_size, s - shift);
  std::uint64_t quotient = static_cast<std::uint64_t>(cut / top);
  // a * 2^shift - quotient * b < 0 ?
  std::uint64_t carry = 0;
  std::uint64_t borrow = 0;
  for (int i = 0; i <= b_size; ++i) {
    const Uint128 product = static_cast<Uint128>(quotient) * (i < b_size ? b[i] : 0) + carry;
    carry = static_cast<std::uint64_t>(product >> 64);
    const Uint128 d =
        static_cast<Uint128>(bits_from(a, a_size, 64 * i - shift)) - static_cast<std::uint64_t>(product) - borrow;
    borrow = static_cast<std::uint64_t>(d >> 64) & 1;
  }
  return quotient - borrow;
}

}  // namespace limbs
}  // namespace dsw
