// The lattice environment of [JCD10] 7.4: n hexahedral cells of unit size, some of them obstacles.
#ifndef DARTSWEEP_TESTS_SCENES_HEX_GRID_H
#define DARTSWEEP_TESTS_SCENES_HEX_GRID_H

#include "scenes/mesh.h"

namespace dsw::scenes {

struct HexGridOptions {
  std::array<std::uint32_t, 3> size{10, 10, 10};  // cells along x, y, z
  double obstacle_share = 0.05;
  double jitter = 0.0;  // largest shift of an interior vertex along each axis, in cells
  bool sheared = false;
  std::uint64_t seed = 1;
};

struct HexGrid {
  HexGridOptions options;
  VolumeMesh mesh;                     // cells and points numbered x first, then y, then z
  std::vector<std::uint8_t> obstacle;  // one a cell

  std::uint32_t cell(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x + options.size[0] * (y + options.size[1] * z);
  }
  /** The lattice cell of a point in lattice coordinates, kNone outside. */
  std::uint32_t cell_at(const double* lattice_point) const;
};

/** Lattice with exactly `cells` cells for 1e3, 1e4, 1e5 and 1e6, and a cube of about as many otherwise. */
std::array<std::uint32_t, 3> hex_grid_size(std::size_t cells);

/** Obstacles depend on seed and size alone, so that variants of one lattice have the same ones. */
HexGrid make_hex_grid(const HexGridOptions& options);

/** Lattice coordinates to space: the identity, or the shear. All multiples of 1/8 map to exact doubles, so the faces of
 * a sheared lattice are exactly flat. */
void lattice_to_space(const HexGridOptions& options, const double* lattice, double* space);

/** Walls of one passable cell, appended. */
void append_cell_walls(const HexGrid& grid, std::uint32_t cell, std::vector<Wall>& walls);

/** The wall at face `side` (order of kHexFaces) of a passable cell, seen from inside of it. */
Wall cell_wall(const HexGrid& grid, std::uint32_t cell, std::uint32_t side);

/** The cell beyond face `side`, kNone at the outer boundary. */
std::uint32_t neighbour(const HexGrid& grid, std::uint32_t cell, std::uint32_t side);

/** All walls: faces between a passable cell and an obstacle or the outside. */
std::vector<Wall> hex_grid_walls(const HexGrid& grid);

}  // namespace dsw::scenes

#endif
