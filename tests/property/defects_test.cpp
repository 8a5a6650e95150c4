// Every defect of a mesh has its own status and names the first offenders.
#include "support.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace dsw::oracle {
namespace {

struct Outcome {
  dsw_status status;
  std::vector<uint32_t> offenders;
  dsw_build_report report;
};

Outcome create(const dsw_environment_desc& desc) {
  dsw_build_report report;
  std::memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  dsw_environment* const untouched = reinterpret_cast<dsw_environment*>(0x1);
  dsw_environment* environment = untouched;
  const dsw_status status = dsw_environment_create(nullptr, &desc, &environment, &report);
  if (status == DSW_STATUS_OK) {
    dsw_environment_destroy(environment);
  } else {
    EXPECT_EQ(environment, untouched);
    EXPECT_STRNE(dsw_last_error_message(), "");
  }
  // The report is promised once the arguments themselves are sound.
  const bool arguments = status == DSW_STATUS_WRONG_SIZE || status == DSW_STATUS_OUT_OF_RANGE ||
                         status == DSW_STATUS_UNSUPPORTED || status == DSW_STATUS_TOO_LARGE;
  if (!arguments) {
    EXPECT_EQ(report.status, status);
  }
  return {status, {report.offenders, report.offenders + std::min<uint32_t>(report.offender_count, 8)}, report};
}

Outcome create(const Mesh& mesh, uint32_t flags = 0) {
  const DescArrays arrays(mesh, {});
  dsw_environment_desc desc = arrays.desc;
  desc.flags = flags;
  return create(desc);
}

using List = std::vector<uint32_t>;

Mesh cubes(int n = 4) { return hex_grid(axis(n, 1), {0, 1}, {0, 1}); }

TEST(DefectTest, AGoodMeshHasNone) {
  const Outcome o = create(cubes());
  EXPECT_EQ(o.status, DSW_STATUS_OK);
  EXPECT_TRUE(o.offenders.empty());
  EXPECT_EQ(o.report.part_count, 1u);
  EXPECT_EQ(o.report.boundary_face_count, 18u);
  EXPECT_EQ(o.report.convex_volume_count, 4u);
  EXPECT_EQ(o.report.unused_point_count, 0u);
}

TEST(DefectTest, IndexOutOfRange) {
  for (int bad : {-1, 20, 1 << 30}) {
    Mesh mesh = cubes();
    mesh.cells[1].vertices[3] = bad;
    mesh.cells[3].vertices[7] = bad;
    const Outcome o = create(mesh);
    EXPECT_EQ(o.status, DSW_STATUS_INDEX_OUT_OF_RANGE);
    EXPECT_EQ(o.offenders, (List{1, 3}));
  }
}

TEST(DefectTest, NotFinitePoints) {
  for (double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Mesh mesh = cubes();
    mesh.points[6][1] = bad;
    mesh.points[11][2] = -bad;
    const Outcome o = create(mesh);
    EXPECT_EQ(o.status, DSW_STATUS_NON_FINITE);
    EXPECT_EQ(o.offenders, (List{6, 11}));  // points here
  }
}

TEST(DefectTest, UnknownCellType) {
  Mesh mesh = cubes();
  mesh.cells[2].type = 25;
  const Outcome o = create(mesh);
  EXPECT_EQ(o.status, DSW_STATUS_BAD_CELL_TYPE);
  EXPECT_EQ(o.offenders, (List{2}));
}

TEST(DefectTest, APointTwiceInACell) {
  Mesh mesh = cubes();
  mesh.cells[2].vertices[5] = mesh.cells[2].vertices[4];
  const Outcome o = create(mesh);
  EXPECT_EQ(o.status, DSW_STATUS_BAD_CELL);
  EXPECT_EQ(o.offenders, (List{2}));
}

TEST(DefectTest, APolyhedronThatDoesNotClose) {
  Mesh mesh = cubes();
  for (Cell& c : mesh.cells) {
    c.type = DSW_CELL_TYPE_POLYHEDRON;
    c.vertices.clear();
  }
  EXPECT_EQ(create(mesh).status, DSW_STATUS_OK);
  Mesh open = mesh;
  open.cells[3].faces.pop_back();
  Outcome o = create(open);
  EXPECT_EQ(o.status, DSW_STATUS_BAD_CELL);
  EXPECT_EQ(o.offenders, (List{3}));
  Mesh turned = mesh;
  std::reverse(turned.cells[1].faces[2].begin(), turned.cells[1].faces[2].end());
  o = create(turned);
  EXPECT_EQ(o.status, DSW_STATUS_BAD_CELL);
  EXPECT_EQ(o.offenders, (List{1}));
  Mesh two = mesh;  // two spheres in one cell
  const std::vector<Loop> other = two.cells[2].faces;
  two.cells[0].faces.insert(two.cells[0].faces.end(), other.begin(), other.end());
  two.cells.erase(two.cells.begin() + 2);
  o = create(two);
  EXPECT_EQ(o.status, DSW_STATUS_BAD_CELL);
  EXPECT_EQ(o.offenders, (List{0}));
}

TEST(DefectTest, InvertedCells) {
  Mesh mesh = cubes();
  for (size_t c : {size_t{0}, size_t{2}}) {
    auto& v = mesh.cells[c].vertices;
    v = {v[4], v[5], v[6], v[7], v[0], v[1], v[2], v[3]};
  }
  Outcome o = create(mesh);
  EXPECT_EQ(o.status, DSW_STATUS_INVERTED_CELL);
  EXPECT_EQ(o.offenders, (List{0, 2}));
  o = create(mesh, DSW_ENVIRONMENT_REORIENT);
  EXPECT_EQ(o.status, DSW_STATUS_OK);
  EXPECT_EQ(o.report.reoriented_count, 2u);
  Mesh tet;
  tet.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tet.add_standard(DSW_CELL_TYPE_TETRA, {0, 2, 1, 3});
  EXPECT_EQ(create(tet).status, DSW_STATUS_INVERTED_CELL);
}

TEST(DefectTest, FlatAndFoldedCells) {
  Mesh flat = cubes();
  for (int v : {2, 7, 12, 17}) flat.points[static_cast<size_t>(v)][0] = 1;  // cell 1 has no thickness left
  Outcome o = create(flat);
  EXPECT_EQ(o.status, DSW_STATUS_INVALID_CELL);
  EXPECT_EQ(o.offenders, (List{1}));
  Mesh tet;
  tet.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 0}};
  tet.add_standard(DSW_CELL_TYPE_TETRA, {0, 1, 2, 3});
  EXPECT_EQ(create(tet).status, DSW_STATUS_INVALID_CELL);
  Mesh folded = cubes(2);
  folded.points[4] = {2.5, 0.5, 0.5};  // pushed through the far sides of both cells it belongs to
  o = create(folded);
  EXPECT_EQ(o.status, DSW_STATUS_INVALID_CELL);
}

/// All star tetrahedra positive and yet covered twice: an octagonal column wound twice round its axis.
TEST(DefectTest, ACellThatCoversItselfTwice) {
  Mesh mesh;
  const int n = 10;
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < n; ++i) {
      const double a = 2 * 3.14159265358979 * 2 * i / n;  // two turns
      const double r = 1 + 0.05 * i;
      mesh.points.push_back({r * std::cos(a), r * std::sin(a), k ? 1.0 : -1.0});
    }
  }
  const int top = 2 * n, bottom = top + 1;
  mesh.points.push_back({0, 0, 2});
  mesh.points.push_back({0, 0, -2});
  std::vector<Loop> faces;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    faces.push_back({i, j, n + j, n + i});
    faces.push_back({n + i, n + j, top});
    faces.push_back({j, i, bottom});
  }
  mesh.add_polyhedron(faces);
  const Outcome o = create(mesh);
  EXPECT_EQ(o.status, DSW_STATUS_INVALID_CELL);
  EXPECT_EQ(o.offenders, (List{0}));
}

TEST(DefectTest, DuplicateCells) {
  Mesh mesh = cubes();
  mesh.cells.push_back(mesh.cells[1]);
  Outcome o = create(mesh);
  EXPECT_EQ(o.status, DSW_STATUS_SHARED_FACE);  // with its neighbour, which is looked at first
  Mesh lone = cubes(1);
  lone.cells.push_back(lone.cells[0]);
  o = create(lone);
  EXPECT_EQ(o.status, DSW_STATUS_DUPLICATE_CELL);
  EXPECT_EQ(o.offenders, (List{0, 1}));
  // Two different tetrahedra on the same side of one face.
  Mesh same;
  same.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}};
  same.add_standard(DSW_CELL_TYPE_TETRA, {0, 1, 2, 3});
  same.add_standard(DSW_CELL_TYPE_TETRA, {0, 1, 2, 4});
  o = create(same);
  EXPECT_EQ(o.status, DSW_STATUS_DUPLICATE_CELL);
  EXPECT_EQ(o.offenders, (List{0, 1}));
}

TEST(DefectTest, AFaceOfThreeCells) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.2, 0.2, 2}};
  mesh.add_standard(DSW_CELL_TYPE_TETRA, {0, 1, 2, 3});
  mesh.add_standard(DSW_CELL_TYPE_TETRA, {0, 2, 1, 4});
  mesh.add_standard(DSW_CELL_TYPE_TETRA, {0, 1, 2, 5});
  const Outcome o = create(mesh);
  EXPECT_EQ(o.status, DSW_STATUS_SHARED_FACE);
  EXPECT_EQ(o.offenders, (List{0, 2}));
}

TEST(DefectTest, ABoundaryThatCrossesItself) {
  Mesh mesh = cubes(1);
  const Mesh other = cubes(1);
  for (const Vec& p : other.points) mesh.points.push_back({p[0] + 0.5, p[1] + 0.25, p[2] + 0.25});
  std::vector<int> v = other.cells[0].vertices;
  for (int& x : v) x += 8;
  mesh.add_standard(DSW_CELL_TYPE_HEXAHEDRON, v);
  EXPECT_EQ(create(mesh).status, DSW_STATUS_OK) << "on request only";
  EXPECT_EQ(create(mesh, DSW_ENVIRONMENT_CHECK_BOUNDARY).status, DSW_STATUS_BOUNDARY_CROSSES);
  const EnvironmentPtr environment = create_environment(mesh);
  ASSERT_NE(environment, nullptr);
  EXPECT_EQ(dsw_environment_check(environment.get(), nullptr), DSW_STATUS_BOUNDARY_CROSSES);
  // Touching is allowed: side by side without shared points.
  Mesh touching = cubes(1);
  for (const Vec& p : other.points) touching.points.push_back({p[0] + 1, p[1], p[2]});
  touching.add_standard(DSW_CELL_TYPE_HEXAHEDRON, v);
  const Outcome o = create(touching, DSW_ENVIRONMENT_CHECK_BOUNDARY);
  EXPECT_EQ(o.status, DSW_STATUS_OK);
  EXPECT_EQ(o.report.part_count, 2u);
}

TEST(DefectTest, UnusedPointsAndPartsAreCounted) {
  Mesh mesh = cubes(1);
  mesh.points.push_back({9, 9, 9});
  mesh.points.push_back({1e300, 9, 9});
  for (const Vec& p : cubes(1).points) mesh.points.push_back({p[0] + 5, p[1], p[2]});
  std::vector<int> v = mesh.cells[0].vertices;
  for (int& x : v) x += 10;
  mesh.add_standard(DSW_CELL_TYPE_HEXAHEDRON, v);
  const Outcome o = create(mesh);
  EXPECT_EQ(o.status, DSW_STATUS_OK);
  EXPECT_EQ(o.report.unused_point_count, 2u);
  EXPECT_EQ(o.report.part_count, 2u);
}

TEST(DefectTest, WrongSizesAndOffsets) {
  const Mesh mesh = cubes();
  const DescArrays good(mesh, {});
  dsw_environment_desc desc = good.desc;
  desc.connectivity_count -= 1;
  EXPECT_EQ(create(desc).status, DSW_STATUS_WRONG_SIZE);
  for (int64_t bad : {int64_t{-1}, int64_t{7}, int64_t{33}, std::numeric_limits<int64_t>::max(),
                      std::numeric_limits<int64_t>::min()}) {
    DescArrays arrays(mesh, {});
    arrays.offsets[2] = bad;
    EXPECT_EQ(create(arrays.desc).status, DSW_STATUS_WRONG_SIZE) << bad;
  }
  desc = good.desc;
  desc.point_stride_bytes = 8;
  EXPECT_EQ(create(desc).status, DSW_STATUS_WRONG_SIZE);
  desc = good.desc;
  desc.index_bytes = 3;
  EXPECT_EQ(create(desc).status, DSW_STATUS_OUT_OF_RANGE);
  desc = good.desc;
  desc.point_count = size_t{1} << 28;
  EXPECT_EQ(create(desc).status, DSW_STATUS_TOO_LARGE);
  desc = good.desc;
  desc.volume_count = 0;
  EXPECT_EQ(create(desc).status, DSW_STATUS_OUT_OF_RANGE);
  desc = good.desc;
  desc.flags = 0x40000000u;
  EXPECT_EQ(create(desc).status, DSW_STATUS_UNSUPPORTED);
  desc = good.desc;
  desc.dimension = 4;
  EXPECT_EQ(create(desc).status, DSW_STATUS_OUT_OF_RANGE);
}

TEST(DefectTest, DamagedFaceStreams) {
  Mesh mesh = cubes(1);
  mesh.cells[0].type = DSW_CELL_TYPE_POLYHEDRON;
  for (bool separate : {false, true}) {
    Layout layout;
    layout.separate_faces = separate;
    const DescArrays good(mesh, layout);
    ASSERT_EQ(create(good.desc).status, DSW_STATUS_OK);
    const size_t length = separate ? good.faces.size() : good.connectivity.size();
    for (size_t at = 0; at < length; ++at) {
      for (int64_t bad : {int64_t{-1}, int64_t{0}, int64_t{1}, int64_t{2}, int64_t{100},
                          std::numeric_limits<int64_t>::max(), std::numeric_limits<int64_t>::min()}) {
        DescArrays arrays(mesh, layout);
        auto& stream = separate ? arrays.faces : arrays.connectivity;
        if (stream[at] == bad) continue;
        stream[at] = bad;
        const dsw_status status = create(arrays.desc).status;
        EXPECT_NE(status, DSW_STATUS_OK) << "stream[" << at << "] = " << bad;
        EXPECT_NE(status, DSW_STATUS_INTERNAL);
      }
    }
  }
}

TEST(DefectTest, OnlyTheFirstEightOffendersAreNamed) {
  Mesh mesh = cubes(20);
  for (size_t c = 3; c < 20; ++c) mesh.cells[c].vertices[0] = 1000;
  const Outcome o = create(mesh);
  EXPECT_EQ(o.status, DSW_STATUS_INDEX_OUT_OF_RANGE);
  EXPECT_EQ(o.offenders, (List{3, 4, 5, 6, 7, 8, 9, 10}));
}

}  // namespace
}  // namespace dsw::oracle
