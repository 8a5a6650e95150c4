// What a caller may count about the predicates. A policy, so that counting costs nothing where nobody asks.
#pragma once

namespace dsw {

struct NoTally {
  void test() noexcept {}
  void exact() noexcept {}
  void tie() noexcept {}
};

}  // namespace dsw
