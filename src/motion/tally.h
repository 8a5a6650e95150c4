#pragma once
// Counting in the hot loops: a policy, so that a scene without statistics pays nothing.

#include "motion/cast.h"

namespace dsw {

struct CountNothing {
  void test() noexcept {}
  void tests(uint32_t) noexcept {}
  void exact() noexcept {}
  void tie() noexcept {}
};

struct CountAll {
  CastCounters* counters;
  void test() noexcept { ++counters->orientation_tests; }
  void tests(uint32_t n) noexcept { counters->orientation_tests += n; }
  void exact() noexcept { ++counters->exact_fallbacks; }
  void tie() noexcept { ++counters->ties; }
};

}  // namespace dsw
