#pragma once
// Turns the fuzzer's bytes into numbers. When the bytes end, zeros follow, so every input means something.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

namespace dsw_fuzz {

class Bytes {
 public:
  Bytes(const uint8_t* data, size_t size) : data_(data), size_(size) {}

  bool empty() const { return next_ >= size_; }
  uint8_t byte() { return next_ < size_ ? data_[next_++] : uint8_t{0}; }
  uint32_t below(uint32_t limit) { return byte() % limit; }

  int64_t raw_integer() {
    uint64_t value = 0;
    for (int i = 0; i < 8; ++i) value = (value << 8) | byte();
    return static_cast<int64_t>(value);
  }

  /** Mostly small lattice numbers, which make ties; 0x7f and 0x80 open the door to everything a double can be. */
  double number() {
    const uint8_t b = byte();
    if (b == 0x80) {
      const int64_t bits = raw_integer();
      double value;
      std::memcpy(&value, &bits, sizeof value);
      return value;
    }
    if (b == 0x7f) {
      const double special[] = {1e300,
                                -1e300,
                                1e-300,
                                5e-324,
                                -5e-324,
                                0.1,
                                1e8,
                                1.0 + 0x1p-52,
                                1e-100,
                                1e100,
                                -0.0,
                                1e-12,
                                std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::min()};
      return special[below(sizeof special / sizeof special[0])];
    }
    return static_cast<int8_t>(b) / 4.0;
  }

  void point(double* xyz) {
    for (int k = 0; k < 3; ++k) xyz[k] = number();
  }

 private:
  const uint8_t* data_;
  size_t size_;
  size_t next_ = 0;
};

/** What must hold for every input; a broken one ends the program, so that the fuzzer keeps the input. */
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", what);
  std::abort();
}

}  // namespace dsw_fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
