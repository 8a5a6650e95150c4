// Lattices of pyramids.
#pragma once

#include "small_meshes.h"

namespace dsw::testing_meshes {

/** Six round the middle of a cube, one for each of its faces. */
inline void add_pyramids(SmallMesh& mesh, const std::vector<int64_t>& cube) {
  const size_t low = 3 * static_cast<size_t>(cube[0]);
  const double middle[3] = {mesh.points[low] + 0.5, mesh.points[low + 1] + 0.5, mesh.points[low + 2] + 0.5};
  const int64_t apex = static_cast<int64_t>(mesh.points.size() / 3);
  mesh.point(middle[0], middle[1], middle[2]);
  for (const auto& face : box_faces(cube)) mesh.cell(kPyramid, {face[3], face[2], face[1], face[0], apex});
}

/** A lattice whose cells are divided: `add` adds to a mesh what takes the place of a hexahedron. */
template <class Add>
SmallMesh divided_lattice(int64_t n, const char* name, Add add) {
  const SmallMesh mesh = lattice(n, kHexahedron);
  SmallMesh divided = mesh;
  divided.name = name;
  divided.types.clear();
  divided.offsets = {0};
  divided.connectivity.clear();
  for (size_t i = 0; i < mesh.types.size(); ++i) {
    const auto first = mesh.connectivity.begin() + static_cast<std::ptrdiff_t>(8 * i);
    add(divided, std::vector<int64_t>(first, first + 8));
  }
  return divided;
}

/** Six to a cell of a lattice. */
inline SmallMesh pyramid_lattice(int64_t n) { return divided_lattice(n, "pyramids", add_pyramids); }

}  // namespace dsw::testing_meshes
