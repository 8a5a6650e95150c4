#pragma once
// Places near the vertices of a piece's surface, inside of the piece.

#include "cutting/surface.h"

namespace dsw {

class Inset {
 public:
  /** Throws std::bad_alloc. O(size of the piece). */
  Inset(const Environment<3>& env, const Piece& piece, const PieceSurface& surface);

  /** The `attempt`-th place that a vertex can be drawn to, from 0 on: `share` of the shortest edge there in two
   * directions, then half of that, twice as much, a quarter, ... False if it is too far, or in no cell of the piece at
   * the vertex. */
  bool place(uint32_t vertex, uint32_t attempt, double share, double* position, Cell* cell) const;
  /** Where it is before, rounded. */
  void origin(uint32_t vertex, double* position) const;

 private:
  struct Way {
    double directions[2][3] = {};      // of length 1, the better one first
    double shortest = 0, longest = 0;  // lengths of the edges there
  };
  void find_cells(const Piece& piece, uint32_t vertex);
  /** From a vertex to the middle of its cells. */
  void find_middle(uint32_t vertex, double* way) const;

  const Environment<3>& env_;
  const PieceSurface& surface_;
  Array<Way> ways_;
  Array<Cell> cells_{env_.memory};  // of the piece at each vertex that hang together with its fan, one after the other
  Array<size_t> first_{env_.memory};  // of a vertex; one more at the end
};

}  // namespace dsw
