// A volume mesh as every mesh library has it, and its impassable faces as a triangle-based peer wants them.
#ifndef DARTSWEEP_TESTS_SCENES_MESH_H
#define DARTSWEEP_TESTS_SCENES_MESH_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dsw::scenes {

constexpr std::uint32_t kNone = 0xffffffffu;

/** Cells of one type, points ordered as in VTK: 4 points a cell are tetrahedra, 5 pyramids, 8 hexahedra. */
struct VolumeMesh {
  std::vector<double> points;              // 3 a point
  std::vector<std::int32_t> connectivity;  // points_per_cell a cell
  std::vector<std::int32_t> regions;       // empty, or one a cell
  std::uint32_t points_per_cell = 8;

  std::size_t point_count() const { return points.size() / 3; }
  std::size_t cell_count() const { return connectivity.size() / points_per_cell; }
  const double* point(std::size_t index) const { return points.data() + 3 * index; }
  const std::int32_t* cell(std::size_t index) const { return connectivity.data() + index * points_per_cell; }
};

/** An impassable face with something passable on one side (or on both, for a marked face between passable cells). */
struct Wall {
  std::array<std::uint32_t, 4> vertices{};  // counter-clockwise seen from a passable side; the 4th unused in a triangle
  std::uint8_t vertex_count = 0;
  std::uint8_t diagonal = 0;  // of a quad: 0 joins vertices 0 and 2, 1 joins 1 and 3
  bool two_sided = false;

  std::uint32_t triangle_count() const { return vertex_count == 4 ? 2u : 1u; }

  /** Triangle 0 or 1, turning as the wall does. */
  std::array<std::uint32_t, 3> triangle(std::uint32_t index) const {
    const auto& v = vertices;
    if (vertex_count == 3) return {v[0], v[1], v[2]};
    if (diagonal == 0) {
      return index == 0 ? std::array<std::uint32_t, 3>{v[0], v[1], v[2]}
                        : std::array<std::uint32_t, 3>{v[0], v[2], v[3]};
    }
    return index == 0 ? std::array<std::uint32_t, 3>{v[1], v[2], v[3]} : std::array<std::uint32_t, 3>{v[1], v[3], v[0]};
  }
};

/** Triangles 0 1 2 of a tetrahedron's four faces, counter-clockwise seen from outside. */
constexpr std::array<std::array<std::uint32_t, 3>, 4> kTetFaces = {{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}}};

/** Faces of a hexahedron, counter-clockwise seen from outside: -x +x -y +y -z +z of a lattice cell. */
constexpr std::array<std::array<std::uint32_t, 4>, 6> kHexFaces = {
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

/** Neighbours of tetrahedra through their faces, in the order of kTetFaces; kNone at the outer boundary. */
std::vector<std::array<std::uint32_t, 4>> tet_neighbours(const VolumeMesh& mesh);

}  // namespace dsw::scenes

#endif
