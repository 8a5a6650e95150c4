#pragma once
// A part of a body, by number.

#include <cstdint>

namespace dsw {

/** A vertex, an edge or a face of a body. */
struct Simplex {
  enum Kind : uint32_t { kVertex, kEdge, kFace };
  Kind kind;
  uint32_t index;

  bool operator==(const Simplex& o) const { return kind == o.kind && index == o.index; }
};

}  // namespace dsw
