#pragma once
// Little-endian arrays in a block of any alignment, and the block's checksum.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace dsw {

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
constexpr bool kBigEndian = true;
#else
constexpr bool kBigEndian = false;
#endif

template <class T>
void store(uint8_t* out, const T* values, size_t count) noexcept {
  if (count == 0) return;
  std::memcpy(out, values, count * sizeof(T));
  for (size_t i = 0; kBigEndian && i < count; ++i) std::reverse(out + i * sizeof(T), out + (i + 1) * sizeof(T));
}

template <class T>
void fetch(T* values, const uint8_t* in, size_t count) noexcept {
  if (count == 0) return;
  std::memcpy(values, in, count * sizeof(T));
  auto* bytes = reinterpret_cast<uint8_t*>(values);
  for (size_t i = 0; kBigEndian && i < count; ++i) std::reverse(bytes + i * sizeof(T), bytes + (i + 1) * sizeof(T));
}

/** Goes on from `sum` over bytes whose count is a multiple of 8. Every step is a bijection of the sum for a given word
 * and of the word for a given sum, so that a block with one damaged word never has the sum of the sound one. */
inline uint64_t checksum(uint64_t sum, const uint8_t* bytes, size_t size) noexcept {
  for (size_t i = 0; i < size; i += 8) {
    uint64_t word;
    fetch(&word, bytes + i, 1);
    sum = (sum ^ word) * 0x9e3779b97f4a7c15ull;
    sum ^= sum >> 32;
  }
  return sum;
}

}  // namespace dsw
