// What a caller may count about the predicates. A policy, so that counting costs nothing where nobody asks.
#pragma once

#include <cstdint>

namespace dsw {

struct NoTally {
  void test() noexcept {}
  void exact() noexcept {}
  void tie() noexcept {}
};

// tests: predicates asked; exacts: those the filter left to integers; ties: those whose unshifted value is zero.
struct CountingTally {
  std::uint64_t tests = 0;
  std::uint64_t exacts = 0;
  std::uint64_t ties = 0;

  void test() noexcept { ++tests; }
  void exact() noexcept { ++exacts; }
  void tie() noexcept { ++ties; }
};

}  // namespace dsw
