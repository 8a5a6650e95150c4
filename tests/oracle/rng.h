// A small generator: the same scenes and casts on every machine. DSW_SEED draws others (../effort.h).
#pragma once

#include "../effort.h"

#include <cstddef>
#include <cstdint>

namespace dsw::oracle {

class Rng {
 public:
  explicit Rng(uint64_t seed) : state_(seed_of(seed) * 0x9e3779b97f4a7c15ull + 0x2545f4914f6cdd1dull) {}

  uint64_t next() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  /// Uniform in 0 .. n-1; n > 0.
  template <class Count>
  uint32_t below(Count n) {
    return static_cast<uint32_t>((next() >> 32) * static_cast<uint64_t>(n) >> 32);
  }
  int between(int low, int high) { return low + static_cast<int>(below(static_cast<uint32_t>(high - low + 1))); }
  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double range(double low, double high) { return low + (high - low) * unit(); }
  bool chance(double p) { return unit() < p; }

 private:
  uint64_t state_;
};

}  // namespace dsw::oracle
