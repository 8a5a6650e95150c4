// A mesh in the plane as the oracle sees it.
#pragma once

#include <array>
#include <cstdint>
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

/// Whether a cell is exactly the star of the mean of its vertices over its sides, each of them well seen.
bool is_star(const std::vector<Vec>& points, const std::vector<int>& cell);

}  // namespace dsw::oracle::plane
