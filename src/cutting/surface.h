#pragma once
// The surface of a piece as triangles of a manifold.

#include "cutting/piece.h"

namespace dsw {

/** Where the triangles of a vertex form several fans, each fan has its own. */
struct SurfaceVertex {
  uint32_t from[2];  // vertices of the environment: it lies in their middle, if they are not the same
  Cell cell;         // of the piece, one of those at its fan
};

struct SurfaceTriangle {
  uint32_t corners[3];  // counter-clockwise seen from outside
  HalfFacet facet;      // of the piece, which it is a part of
};

struct PieceSurface {
  Array<SurfaceVertex> vertices;
  Array<SurfaceTriangle> triangles;

  /** Throws std::bad_alloc. O(size of the piece). */
  PieceSurface(const Environment<3>& env, const Piece& piece);
};

}  // namespace dsw
