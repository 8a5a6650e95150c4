// Walls and casts of tetrahedral meshes.
#ifndef DARTSWEEP_TESTS_SCENES_TETS_H
#define DARTSWEEP_TESTS_SCENES_TETS_H

#include "scenes/mesh.h"

namespace dsw::scenes {

/** Walls of a tetrahedral mesh whose cells are all passable. */
struct TetWalls {
  std::vector<Wall> all;                             // the outer boundary and the marked faces
  std::vector<std::array<std::uint32_t, 3>> marked;  // the marked inner faces by their points
};

/** Marks a share of the inner faces, evenly at random. */
TetWalls random_tet_walls(const VolumeMesh& mesh, const std::vector<std::array<std::uint32_t, 4>>& neighbours,
                          double share, std::uint64_t seed);

/** Marks every inner face between two regions. */
TetWalls region_walls(const VolumeMesh& mesh, const std::vector<std::array<std::uint32_t, 4>>& neighbours);

struct TetCasts {
  std::vector<double> from, to;      // 3 a cast
  std::vector<std::uint32_t> cells;  // where each starts, up to rounding
};

/** Casts of 1 to 2 cells in random order: from a random point of a random cell, one half to a random point of the same
 * cell, the other to one of a random neighbour. */
TetCasts short_tet_casts(const VolumeMesh& mesh, const std::vector<std::array<std::uint32_t, 4>>& neighbours,
                         std::size_t count, std::uint64_t seed);

/** Casts of a given length in random directions from random points of the cells of one region, or of any. */
TetCasts long_tet_casts(const VolumeMesh& mesh, std::size_t count, double length, std::int32_t region, bool any_region,
                        std::uint64_t seed);

/** Mean length of the edges of all cells, or of those of one region; an edge counts once for each cell. */
double mean_edge(const VolumeMesh& mesh);
double mean_edge(const VolumeMesh& mesh, std::int32_t region);

}  // namespace dsw::scenes

#endif
