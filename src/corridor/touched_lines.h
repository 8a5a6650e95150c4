#pragma once
// Edges of the environment that an edge of a body has touched: a forecast of what it touches next.

#include <algorithm>
#include <cstdint>

#include "base/search.h"
#include "corridor/ridge.h"
#include "map/map.h"

namespace dsw {

/** The last few that an edge has touched while one of its ends moved, the last one first. */
struct TouchedLines {
  static constexpr uint32_t kCount = 4;
  /** The passable cells round an edge of the environment from wall to wall. */
  struct Fan {
    HalfFacet passed;    // a facet inside
    HalfFacet walls[2];  // seen from the cells at the ends; the first comes first where p is on the same side of both
    Dart lowest;         // the edge's name, as SweepContact has it
    bool is_alone = false;            // no other passable cells are linked round the edge
    uint64_t version = ~uint64_t{0};  // Environment::change_version of when this was so
  };
  RidgeName lines[kCount];
  Fan fan;                 // of the first, if it is known
  RidgeName kept[kCount];  // as they were when a call on the body began, if they have changed since
  uint64_t kept_in = 0;    // the number of that call

  /** Whether `line` is the first one and its fan is known in this version, with `passed` as a facet inside. */
  bool knows_fan(const RidgeName& line, HalfFacet passed, uint64_t version) const noexcept {
    return fan.passed == passed && fan.version == version && lines[0] == line;
  }
  /** Brings a line to the front in a call; if it is new, the last one is dropped. */
  void note(const RidgeName& line, uint64_t call) noexcept {
    if (lines[0] == line) return;
    if (kept_in != call) std::copy_n(lines, kCount, kept);
    kept_in = call;
    RidgeName* const last = dsw::find(lines, lines + kCount - 1, line);
    std::copy_backward(lines, last, last + 1);
    lines[0] = line;
    fan.version = ~uint64_t{0};
  }
  /** Makes the lines those of before the call. */
  void go_back(uint64_t call) noexcept {
    if (kept_in != call) return;
    std::copy_n(kept, kCount, lines);
    fan.version = ~uint64_t{0};
    kept_in = 0;
  }
};

}  // namespace dsw
