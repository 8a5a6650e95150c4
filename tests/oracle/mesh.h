// A mesh as the oracle sees it (face loops), and the arrays that the library is given.
#pragma once

#include "dartsweep/dartsweep.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dsw::oracle {

using Vec = std::array<double, 3>;
using Loop = std::vector<int>;

/// A cell: vertices in the order of its type (empty for a polyhedron) and faces counter-clockwise from outside.
struct Cell {
  int type = DSW_CELL_TYPE_POLYHEDRON;
  std::vector<int> vertices;
  std::vector<Loop> faces;
};

struct Mesh {
  std::vector<Vec> points;
  std::vector<Cell> cells;
  std::vector<int32_t> regions;  // empty, or one for each cell
  std::vector<uint32_t> tags;    // likewise
  /// Empty, or cells of which DSW_ENVIRONMENT_CONFORM makes `cells`: then it is given these.
  std::vector<Cell> loose;

  void add_standard(int type, std::vector<int> vertices);
  void add_polyhedron(std::vector<Loop> faces);
};

/// Faces of a standard cell in VTK's order, as local numbers.
const std::vector<Loop>& standard_faces(int type);

/// Ways to hand the same mesh over.
struct Layout {
  int index_bytes = 8;          // 4 or 8
  bool separate_faces = false;  // polyhedra in faces/face_locations
  size_t stride = 24;
};

/// Owns the arrays a dsw_environment_desc points to.
class DescArrays {
 public:
  DescArrays(const Mesh& mesh, const Layout& layout);
  DescArrays(const DescArrays&) = delete;
  DescArrays& operator=(const DescArrays&) = delete;
  dsw_environment_desc desc;
  std::vector<unsigned char> points;
  std::vector<uint8_t> types;
  std::vector<int64_t> offsets, connectivity, faces, locations;
  std::vector<int32_t> offsets32, connectivity32, faces32, locations32;
};

/// Edges of a cell, numbered as ids.h says.
std::vector<std::array<int, 2>> cell_edges(const Cell& cell);

/// Six pyramids (the centre is a new point) in place of hexahedron `cell`.
void split_to_pyramids(Mesh& mesh, size_t cell, const Vec& centre);
/// Two tetrahedra in place of pyramid `cell`: only right where the base lies on the outer boundary.
void split_pyramid(Mesh& mesh, size_t cell);
/// Cuts vertex v off all its cells at `depth` of every edge; inside, a new cell fills the gap.
void truncate_vertex(Mesh& mesh, int v, double depth);

}  // namespace dsw::oracle
