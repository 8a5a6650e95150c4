#pragma once
// The largest part of a way that can be gone, found by halving.

namespace dsw {

/** The part of a way to be tried: how often ways are halved before nothing moves is decided here alone. */
struct Halving {
  static constexpr int kMost = 52;
  double way = 1;
  int count = 0;

  bool is_last() const noexcept { return count == kMost; }
  /** Whether there is a shorter part of the way, which is `way` then. */
  bool next() noexcept {
    if (is_last()) return false;
    ++count;
    way /= 2;
    return true;
  }
};

}  // namespace dsw
