#include "environment/facet_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "map/integrity.h"
#include "test_mesh.h"

namespace dsw::test {
namespace {

constexpr int64_t kSide = 42;  // cubes: enough cells for parts side by side

/** Cubes, each of which is a hexahedron, a polyhedron, two wedges or six tetrahedra. */
MeshData mixed_lattice(uint64_t seed) {
  Random random(seed);
  MeshData mesh;
  const int64_t n = kSide + 1;
  for (int64_t i = 0; i < n * n * n; ++i) {
    for (const int64_t x : {i % n, i / n % n, i / n / n}) mesh.points.push_back(static_cast<double>(x));
  }
  for (int64_t i = 0; i < kSide * kSide * kSide; ++i) {
    int64_t v[8];
    const int64_t low = i % kSide + i / kSide % kSide * n + i / kSide / kSide * n * n;
    for (int64_t k = 0; k < 8; ++k) v[k] = low + (k % 4 == 1 || k % 4 == 2) + (k % 4 >= 2) * n + (k / 4) * n * n;
    switch (random.below(4)) {
      case 0:
        mesh.cell(kHexahedron, {v, v + 8});
        break;
      case 1:
        mesh.polyhedron({{v[0], v[3], v[2], v[1]},
                         {v[4], v[5], v[6], v[7]},
                         {v[0], v[1], v[5], v[4]},
                         {v[1], v[2], v[6], v[5]},
                         {v[2], v[3], v[7], v[6]},
                         {v[3], v[0], v[4], v[7]}});
        break;
      case 2:
        mesh.cell(kWedge, {v[0], v[2], v[1], v[4], v[6], v[5]});
        mesh.cell(kWedge, {v[0], v[3], v[2], v[4], v[7], v[6]});
        break;
      default:
        for (const auto& t : {std::array{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}) {
          mesh.cell(kTetra, {v[0], v[t[0]], v[t[1]], v[6]});
        }
    }
  }
  return mesh;
}

struct Made {
  Environment<3> env{nullptr};
  BuildReport report;
  dsw_status status = DSW_STATUS_OK;

  Made(const MeshData& mesh, unsigned threads) {
    const dsw_environment_desc input = mesh.description<3>();
    try {
      read_mesh(env, input, report, {nullptr, nullptr, threads});
    } catch (const Error& error) {
      status = error.status();
    }
  }
};

TEST(FacetMatcherTest, LinksAreTheSameForAnyNumberOfThreads) {
  const MeshData mesh = mixed_lattice(1);
  ASSERT_GE(mesh.types.size(), size_t{1} << 16);
  const Made one(mesh, 1);
  EXPECT_EQ(one.status, DSW_STATUS_OK);
  EXPECT_EQ(check_integrity(one.env.map), nullptr);
  for (const unsigned threads : {2u, 3u, 8u}) {
    const Made several(mesh, threads);
    EXPECT_EQ(several.env.map.words, one.env.map.words);
    EXPECT_EQ(several.env.map.facet_count, one.env.map.facet_count);
    EXPECT_EQ(several.env.map.boundary_facet_count, one.env.map.boundary_facet_count);
  }
}

/** A facet is matched if and only if another cell has the same vertices: facets are counted by their sorted vertices. */
TEST(FacetMatcherTest, AllThatHaveTheSameVerticesAreLinked) {
  const MeshData mesh = mixed_lattice(2);
  const Made made(mesh, 2);
  const Map<3>& map = made.env.map;
  std::vector<std::vector<uint32_t>> facets;
  for_each_cell(map, [&](Cell c) {
    const Shape shape = map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      std::vector<uint32_t> vertices;
      for_each_facet_vertex<3>(shape, f, [&](uint32_t local) { vertices.push_back(map.vertex(c, local)); });
      std::sort(vertices.begin(), vertices.end());
      facets.push_back(vertices);
    }
  });
  const size_t sides = facets.size();
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  EXPECT_EQ(map.facet_count, facets.size());
  EXPECT_EQ(map.boundary_facet_count, 2 * facets.size() - sides);
}

/** Adds a tetrahedron of the mesh again. */
void repeat_some_tetrahedron(MeshData& mesh, Random& random) {
  size_t i;
  do {
    i = static_cast<size_t>(random.below(static_cast<int>(mesh.types.size())));
  } while (mesh.types[i] != kTetra);
  const auto at = mesh.connectivity.begin() + mesh.offsets[i];
  mesh.cell(kTetra, {at[0], at[1], at[2], at[3]});
}

/** Adds a tetrahedron beside the mesh, twice. */
void add_twice(MeshData& mesh) {
  const auto first = static_cast<int64_t>(mesh.points.size() / 3);
  mesh.points.insert(mesh.points.end(), {-2, 0, 0, -1, 0, 0, -2, 1, 0, -2, 0, 1});
  for (int i = 0; i < 2; ++i) mesh.cell(kTetra, {first, first + 1, first + 2, first + 3});
}

TEST(FacetMatcherTest, OffendersAreTheSameForAnyNumberOfThreads) {
  Random random(5);
  const MeshData sound = mixed_lattice(3);
  for (const dsw_status expected : {DSW_STATUS_SHARED_FACE, DSW_STATUS_DUPLICATE_CELL}) {
    MeshData mesh = sound;
    if (expected == DSW_STATUS_DUPLICATE_CELL) add_twice(mesh);
    for (int i = 0; i < 3; ++i) repeat_some_tetrahedron(mesh, random);
    const Made one(mesh, 1), two(mesh, 2);
    EXPECT_EQ(one.status, expected);
    EXPECT_EQ(two.status, expected);
    ASSERT_EQ(two.report.offenders.count, one.report.offenders.count);
    EXPECT_TRUE(std::equal(one.report.offenders.index, one.report.offenders.index + one.report.offenders.count,
                           two.report.offenders.index));
  }
}

TEST(FacetMatcherTest, AThirdCellIsToldWithTheFirst) {
  MeshData mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 1, 1, 2};
  mesh.cell(kTetra, {0, 1, 2, 3});
  mesh.cell(kTetra, {0, 2, 1, 4});
  mesh.cell(kTetra, {0, 1, 2, 5});
  const Made made(mesh, 1);
  EXPECT_EQ(made.status, DSW_STATUS_SHARED_FACE);
  ASSERT_EQ(made.report.offenders.count, 2u);
  EXPECT_EQ(made.report.offenders.index[0], 0u);
  EXPECT_EQ(made.report.offenders.index[1], 2u);
}

}  // namespace
}  // namespace dsw::test
