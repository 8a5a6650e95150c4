#pragma once
// Edges of the environment that an edge of a body has touched: a forecast of what it touches next.

#include <algorithm>
#include <cstdint>

#include "map/map.h"

namespace dsw {

/** An edge of the environment by its vertices; both are the same where none is known. */
struct TouchedLine {
  uint32_t vertices[2] = {};

  bool is_known() const noexcept { return vertices[0] != vertices[1]; }
};

/** The last few that an edge has touched while one of its ends moved, the last one first. */
struct TouchedLines {
  static constexpr uint32_t kCount = 4;
  TouchedLine lines[kCount];
  // The name of the first as SweepContact has it, where its fan ends at this wall, in this version of the environment.
  Dart lowest;
  uint32_t wall = kNoFacet;
  uint64_t version = ~uint64_t{0};

  /** Brings one of them to the front. */
  void come_first(uint32_t i) noexcept {
    if (i == 0) return;
    std::swap(lines[0], lines[i]);
    version = ~uint64_t{0};
  }
};

}  // namespace dsw
