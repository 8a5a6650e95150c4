// Small meshes for unit tests, put together cell by cell and built into environments.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <random>
#include <vector>

#include "../../effort.h"
#include "environment/builder.h"

namespace dsw::test {

constexpr uint8_t kTetra = 10, kHexahedron = 12, kWedge = 13, kPyramid = 14, kPolyhedron = 42;
constexpr uint8_t kTriangle = 5, kPolygon = 7, kQuad = 9;

/** Whole numbers, the same in every run. */
class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed_of(seed)) {}
  int below(int n) { return static_cast<int>(engine_() % static_cast<uint64_t>(n)); }
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

/** Cells of either dimension. */
struct MeshData {
  std::vector<double> points;
  std::vector<uint8_t> types;
  std::vector<int64_t> offsets{0}, connectivity;
  std::vector<int32_t> regions;
  std::vector<uint32_t> tags;

  void cell(uint8_t type, const std::vector<int64_t>& stream) {
    types.push_back(type);
    connectivity.insert(connectivity.end(), stream.begin(), stream.end());
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
  }
  void polyhedron(const std::vector<std::vector<int64_t>>& faces) {
    std::vector<int64_t> stream{static_cast<int64_t>(faces.size())};
    for (const auto& face : faces) {
      stream.push_back(static_cast<int64_t>(face.size()));
      stream.insert(stream.end(), face.begin(), face.end());
    }
    cell(kPolyhedron, stream);
  }

  /** Valid as long as this mesh stays as it is. Throws what creation throws. */
  template <int D>
  dsw_environment_desc description() const {
    dsw_environment_desc input{};
    input.points = points.data();
    input.point_count = points.size() / D;
    input.cell_types = types.data();
    input.volume_count = types.size();
    input.offsets = offsets.data();
    input.connectivity = connectivity.data();
    input.connectivity_count = connectivity.size();
    input.regions = regions.empty() ? nullptr : regions.data();
    input.tags = tags.empty() ? nullptr : tags.data();
    return check_description<D>(input);
  }
  /** Throws what creation throws. */
  template <int D>
  void build_into(Environment<D>& env, BuildReport& report) const {
    dsw::build(env, description<D>(), report);
  }
};

template <int D>
struct TestMesh : MeshData {
  int64_t point(std::initializer_list<double> p) {
    points.insert(points.end(), p);
    return static_cast<int64_t>(points.size() / D) - 1;
  }
  std::unique_ptr<Environment<D>> build(BuildReport* report = nullptr, const Memory* memory = nullptr) const {
    auto env = std::make_unique<Environment<D>>(memory);
    BuildReport own;
    build_into(*env, report == nullptr ? own : *report);
    return env;
  }
};

using Mesh3 = TestMesh<3>;
using Mesh2 = TestMesh<2>;

/** A lattice of nx * ny * nz boxes with the given spacing, appended with points of its own; only where keep(x, y,
 * z). */
template <class Keep>
void add_boxes(Mesh3& mesh, int nx, int ny, int nz, double origin_x, double origin_y, double origin_z, double spacing,
               Keep keep) {
  const int64_t first = static_cast<int64_t>(mesh.points.size() / 3);
  for (int z = 0; z <= nz; ++z) {
    for (int y = 0; y <= ny; ++y) {
      for (int x = 0; x <= nx; ++x) {
        mesh.point({origin_x + spacing * x, origin_y + spacing * y, origin_z + spacing * z});
      }
    }
  }
  const auto at = [&](int x, int y, int z) { return first + x + (nx + 1) * (y + int64_t{ny + 1} * z); };
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        if (!keep(x, y, z)) continue;
        mesh.cell(kHexahedron, {at(x, y, z), at(x + 1, y, z), at(x + 1, y + 1, z), at(x, y + 1, z), at(x, y, z + 1),
                                at(x + 1, y, z + 1), at(x + 1, y + 1, z + 1), at(x, y + 1, z + 1)});
      }
    }
  }
}
inline void add_boxes(Mesh3& mesh, int nx, int ny, int nz, double x = 0, double y = 0, double z = 0,
                      double spacing = 1) {
  add_boxes(mesh, nx, ny, nz, x, y, z, spacing, [](int, int, int) { return true; });
}

/** A lattice of nx * ny unit squares, or of triangles, two to a square. */
inline void add_squares(Mesh2& mesh, int nx, int ny, bool cut = false) {
  for (int y = 0; y <= ny; ++y) {
    for (int x = 0; x <= nx; ++x) mesh.point({x * 1.0, y * 1.0});
  }
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      const int64_t a = x + int64_t{nx + 1} * y, b = a + 1, d = a + nx + 1, c = d + 1;
      if (cut) {
        mesh.cell(kTriangle, {a, b, c});
        mesh.cell(kTriangle, {a, c, d});
      } else {
        mesh.cell(kQuad, {a, b, c, d});
      }
    }
  }
}

/** One box with points of its own. */
inline void add_box(Mesh3& mesh, const double* lower, const double* upper) {
  std::vector<int64_t> corners;
  for (int i = 0; i < 8; ++i) {
    const bool x = (i & 3) == 1 || (i & 3) == 2, y = (i & 3) >= 2, z = i >= 4;
    corners.push_back(mesh.point({x ? upper[0] : lower[0], y ? upper[1] : lower[1], z ? upper[2] : lower[2]}));
  }
  mesh.cell(kHexahedron, corners);
}

/** Every cell type in one part: a box, a wedge, a polyhedron (another box), a pyramid and a tetrahedron on its
 * faces. */
inline Mesh3 mixed_mesh() {
  Mesh3 m;
  add_boxes(m, 1, 1, 1);
  const int64_t box[8] = {0, 1, 3, 2, 4, 5, 7, 6};  // corners in the order of a hexahedron
  const int64_t apex = m.point({0.5, 0.5, 2});
  m.cell(kPyramid, {box[4], box[5], box[6], box[7], apex});
  const int64_t front = m.point({0.5, -1, 2});
  m.cell(kTetra, {box[4], box[5], apex, front});
  const int64_t right[2] = {m.point({2, 0, 0}), m.point({2, 1, 0})};
  m.cell(kWedge, {box[1], right[0], box[5], box[2], right[1], box[6]});
  const int64_t low[4] = {m.point({0, 0, -1}), m.point({1, 0, -1}), m.point({1, 1, -1}), m.point({0, 1, -1})};
  m.polyhedron({{box[0], box[1], box[2], box[3]},
                {low[0], low[3], low[2], low[1]},
                {low[0], low[1], box[1], box[0]},
                {low[1], low[2], box[2], box[1]},
                {low[2], low[3], box[3], box[2]},
                {low[3], low[0], box[0], box[3]}});
  return m;
}

}  // namespace dsw::test
