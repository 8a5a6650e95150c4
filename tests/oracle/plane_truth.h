// The oracle's picture of an environment in the plane and its own, brute-force answer to "where is this point" and
// "what does this segment cross". Exact: integers over a common power of two. Body points are shifted by (e, e^2); a
// cell is what its sides enclose.
#pragma once

#include "numbers.h"
#include "plane_mesh.h"

namespace dsw::oracle::plane {

struct Flight {
  enum Outcome { kReached, kContact, kBroken };
  Outcome outcome = kReached;
  std::vector<int> cells;  // entered, the first included
  std::vector<double> times;
  int side = -1;    // contact
  double time = 1;  // the exact ratio rounded down
  bool tie = false;
};

/// Whether a cell encloses the shifted point.
bool contains(const World& world, int cell, const Vec& p);
/// The cell that contains the shifted point, or -1; -2 if there are several.
int locate(const World& world, const Vec& p);
/// Follows p -> q from the cell of p, which is passable.
Flight cast(const World& world, int start, const Vec& p, const Vec& q);
/// Whether each side of a cell has this point strictly on its left, and all of them go round it once; a triangle needs
/// no such point.
bool is_star_of(const World& world, int cell, const Vec& centre);
/// Twice the area of all cells and twice what the sides on the outer boundary enclose, over a common power of two.
void double_areas(const World& world, Big* cells, Big* enclosed);

}  // namespace dsw::oracle::plane
