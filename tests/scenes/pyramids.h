// A lattice of cubes, each cut into six pyramids round its centre; some cubes are obstacles.
#ifndef DARTSWEEP_TESTS_SCENES_PYRAMIDS_H
#define DARTSWEEP_TESTS_SCENES_PYRAMIDS_H

#include "scenes/mesh.h"

namespace dsw::scenes {

struct PyramidOptions {
  std::array<std::uint32_t, 3> size{10, 10, 10};  // cubes along x, y, z
  std::array<double, 3> low{0, 0, 0};
  double edge = 1.0;  // of a cube
  double obstacle_share = 0.05;
  std::uint64_t seed = 1;
};

struct Pyramids {
  PyramidOptions options;
  VolumeMesh mesh;                     // pyramids of cube c are cells 6 c to 6 c + 5, points ordered as in VTK
  std::vector<std::uint8_t> obstacle;  // one a cube, numbered x first, then y, then z

  std::uint32_t cube(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x + options.size[0] * (y + options.size[1] * z);
  }
};

Pyramids make_pyramids(const PyramidOptions& options);

/** Makes the cubes that a box meets passable. */
void clear_box(Pyramids& pyramids, const std::array<double, 3>& low, const std::array<double, 3>& high);

/** Faces between a passable cube and an obstacle or the outside. */
std::vector<Wall> pyramid_walls(const Pyramids& pyramids);

}  // namespace dsw::scenes

#endif
