// The oracle's picture of an environment in the plane and its own, brute-force answer to "where is this point" and
// "what does this segment cross". Exact: integers over a common power of two. Body points are shifted by (e, e^2); a
// cell is what its sides enclose.
#pragma once

#include "numbers.h"

#include <array>
#include <vector>

namespace dsw::oracle::plane {

using Vec = std::array<double, 2>;

struct Side {
  int a, b;      // counter-clockwise round cell[0]
  int cell[2];   // the second < 0: outer boundary
  int local[2];  // its number in each
  bool marked = false;
};

/// Convex or star-shaped polygons; their vertices counter-clockwise.
struct World {
  std::vector<Vec> points;
  std::vector<std::vector<int>> cells;
  std::vector<char> cell_marked;
  std::vector<uint32_t> tags;
  std::vector<Side> sides;
  bool lattice = false;  // small integers, scaled

  /// Finds the sides, and gives each cell its number as its tag. Every side has one cell or two.
  void link();
  bool impassable(const Side& s) const;
};

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
/// Whether a cell is exactly the star of the mean of its vertices over its sides, each of them well seen.
bool is_star(const std::vector<Vec>& points, const std::vector<int>& cell);

}  // namespace dsw::oracle::plane
