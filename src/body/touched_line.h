#pragma once
// Edges of the environment that an edge of a body has touched: a forecast of what it touches next.

#include <cstdint>

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
};

}  // namespace dsw
