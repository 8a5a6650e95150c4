// Random numbers that are the same on every machine: the standard's generator, our own mapping to intervals (the
// standard leaves its distributions open).
#ifndef DARTSWEEP_TESTS_SCENES_RANDOM_H
#define DARTSWEEP_TESTS_SCENES_RANDOM_H

#include <cstddef>
#include <cstdint>
#include <random>

namespace dsw::scenes {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }

  /** In [0, 1), a multiple of 2^-53. */
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /** In 0 .. count-1. The bias is below count / 2^64. */
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace dsw::scenes

#endif
