#pragma once
// Edges of the environment that an edge of a body has touched: a forecast of what it touches next.

#include <cstdint>

#include "map/map.h"

namespace dsw {

/** An edge of the environment by its vertices; both are the same where none is known. */
struct TouchedLine {
  uint32_t vertices[2] = {};
  Dart lowest;                      // as in SweepContact
  uint64_t version = ~uint64_t{0};  // of the environment for which that is known

  bool is_known() const noexcept { return vertices[0] != vertices[1]; }
};

/** The last few that an edge has touched while one of its ends moved, the last one first. */
struct TouchedLines {
  static constexpr uint32_t kCount = 4;
  TouchedLine lines[kCount];
};

}  // namespace dsw
