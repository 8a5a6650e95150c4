// When two features first touch while all of their points move at once, each straight and steadily from its start to
// its end. Touching counts, also where everything lies in one plane or line, and where features have no extent. Right
// for all finite doubles.
#pragma once

#include <cstdint>

namespace dsw {

// The points of a pair, in this order. Edges and triangles are closed.
enum class PairKind : std::uint8_t {
  kVertexFace = 0,  // in space: a vertex, the corners of a triangle
  kEdgeEdge = 1,    // in space: the ends of one edge, the ends of the other
  kVertexEdge = 2   // in the plane: a vertex, the ends of an edge
};

template <int D>
struct MovingPair {
  PairKind kind;
  const double* start[D + 1];
  const double* end[D + 1];
};

struct FirstTouch {
  bool touches;
  double time;            // the largest double not later than the first time in [0,1]; 0 without a touch
  bool is_exact = false;  // whether it is known to be the first time
};

// What integers cost, in products of two words of 64 bits. It depends on the pairs alone.
struct PairWork {
  std::uint64_t most = UINT64_MAX;
  std::uint64_t done = 0;
};
struct WorkOver {};  // thrown if more than `most` is done

// Takes memory only if coordinates of one axis spread over hundreds of bits. Throws std::bad_alloc, and WorkOver if there is `work`.
// A touch after `until` may be left out, which saves the search for its time.
template <int D>
FirstTouch first_touch(const MovingPair<D>& pair, PairWork* work = nullptr, double until = 1);

// Sign of a's first time minus b's, exactly. Both touch, as first_touch has said.
template <int D>
int compare_first_touches(const MovingPair<D>& a, const FirstTouch& first_a, const MovingPair<D>& b,
                          const FirstTouch& first_b, PairWork* work = nullptr);

// The sign of det(p1 - p0, ..., pD - p0) if it never changes and is never 0 in [0,1]; else 0.
template <int D>
int kept_side(const MovingPair<D>& points);

}  // namespace dsw
