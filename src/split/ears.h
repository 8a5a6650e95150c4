#pragma once
// A simple polygon, cut into triangles.

#include "base/memory.h"

namespace dsw {

/** Appends the triangles of a loop, three vertices each, oriented as it: ears without any other corner in them or on them.
 * turn(a, b, c): positive to the left, as the loop turns. Corners on a side are none of an ear. False: the loop meets itself.
 * O(n^2) mostly, O(n^3) at worst. Throws std::bad_alloc. */
template <class Turn>
bool clip_ears(Array<uint32_t> loop, const Turn& turn, Array<uint32_t>& triangles) {
  size_t at = 0;
  while (loop.size() >= 3) {
    const size_t n = loop.size();
    const auto is_ear = [&](size_t k) {
      const uint32_t a = loop[(k + n - 1) % n], b = loop[k], c = loop[(k + 1) % n];
      if (turn(a, b, c) <= 0) return false;
      for (const uint32_t w : loop) {
        if (w != a && w != b && w != c && turn(a, b, w) >= 0 && turn(b, c, w) >= 0 && turn(c, a, w) >= 0) return false;
      }
      return true;
    };
    size_t tried = 0;
    while (tried < n && !is_ear((at + tried) % n)) ++tried;
    if (tried == n) return false;
    const size_t k = (at + tried) % n;
    for (const size_t corner : {(k + n - 1) % n, k, (k + 1) % n}) triangles.push_back(loop[corner]);
    if (n == 3) return true;
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(k));
    at = k % loop.size();
  }
  return false;
}

}  // namespace dsw
