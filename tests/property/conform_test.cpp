// Meshes whose parts lie on each other: octrees, interfaces of unlike faces, points of their own. Every cell is known as a
// box or prism from which the mesh was made, so where casts end and which cell holds a point is known without the engine.
#include "loose_mesh.h"

#include <map>
#include <string>

namespace dsw::loose {
namespace {

class ConformTest : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(All, ConformTest, testing::Values(2u, 3u),
                         [](const auto& value) { return value.param == 2 ? "plane" : "space"; });

TEST_P(ConformTest, AnOctreeIsOnePart) {
  const unsigned dimension = GetParam();
  for (int round = 0; round < effort_of(12); ++round) {
    std::mt19937_64 random(seed_of(700 + static_cast<unsigned>(round)));
    LooseMesh mesh;
    mesh.dimension = dimension;
    std::vector<Box> boxes;
    const int side = round == 0 && effort_of(1) >= 10 ? 20 : 3;  // in space 20 make about 1e5 cells
    for (int z = 0; z < (dimension == 3 ? side : 1); ++z) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const Vec3 low{double(x), double(y), double(z)};
          refine({low, {low[0] + 1, low[1] + 1, low[2] + 1}}, dimension, 2, 0.4, random, boxes);
        }
      }
    }
    for (const Box& box : boxes) mesh.add_box(box.low, box.high);
    dsw_build_report report;
    const Owner loose = mesh.create(DSW_ENVIRONMENT_FIND_TOUCHING, report);
    ASSERT_EQ(report.status, DSW_STATUS_OK);
    EXPECT_EQ(report.part_count, boxes.size());
    EXPECT_GT(report.touching_face_count, boxes.size());
    const Owner sewn = mesh.create(DSW_ENVIRONMENT_CONFORM | DSW_ENVIRONMENT_FIND_TOUCHING, report);
    ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message();
    EXPECT_EQ(report.part_count, 1u);
    EXPECT_EQ(report.touching_face_count, 0u);
    EXPECT_EQ(report.convex_volume_count, boxes.size());
    EXPECT_EQ(dsw_environment_check(sewn.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    expect_no_walls(sewn.get(), boxes, dimension, side, random);
  }
}

/** Faces of a sheared octree are seen largest along any axis; products of their sides overflow or vanish. */
TEST_P(ConformTest, TheUnitOfLengthDoesNotMatter) {
  const unsigned dimension = GetParam();
  for (int round = 0; round < effort_of(40); ++round) {
    std::mt19937_64 random(seed_of(1700 + static_cast<unsigned>(round)));
    std::vector<Box> boxes;
    for (int x = 0; x < 2; ++x) refine({{double(x), 0, 0}, {x + 1.0, 1, 1}}, dimension, 2, 0.7, random, boxes);
    double shear[3][3] = {};
    for (unsigned k = 0; k < dimension; ++k) {
      for (unsigned j = 0; j < dimension; ++j) shear[k][j] = k == j ? 1 : k > j ? double(int(random() % 5) - 2) / 4 : 0;
    }
    for (const int exponent : {0, 900, 1020, -480, -700, -1000}) {
      LooseMesh mesh;
      mesh.dimension = dimension;
      for (const Box& box : boxes) mesh.add_box(box.low, box.high);
      for (size_t at = 0; at < mesh.points.size(); at += dimension) {
        const std::vector<double> p(&mesh.points[at], &mesh.points[at] + dimension);
        for (unsigned k = 0; k < dimension; ++k) {
          double sum = 0;
          for (unsigned j = 0; j < dimension; ++j) sum += shear[k][j] * p[j];
          mesh.points[at + k] = std::ldexp(sum, exponent);
        }
      }
      dsw_build_report report;
      const Owner sewn = mesh.create(DSW_ENVIRONMENT_CONFORM | DSW_ENVIRONMENT_FIND_TOUCHING, report);
      ASSERT_EQ(report.status, DSW_STATUS_OK) << round << " 2^" << exponent << ": " << dsw_last_error_message();
      EXPECT_EQ(report.part_count, 1u) << round << " 2^" << exponent;
      EXPECT_EQ(report.touching_face_count, 0u) << round << " 2^" << exponent;
    }
  }
}

/** Boxes of a grid; sides between them that are planted have points of their own, one in `finer` has half the width. */
TEST_P(ConformTest, PlantedPartsAreAllCounted) {
  const unsigned dimension = GetParam();
  for (int round = 0; round < effort_of(100); ++round) {
    std::mt19937_64 random(seed_of(9000 + static_cast<unsigned>(round)));
    const int n[3] = {3, 3, dimension == 3 ? 3 : 1};
    LooseMesh mesh;
    mesh.dimension = dimension;
    std::vector<int> part(static_cast<size_t>(n[0] * n[1] * n[2]));
    for (int& each : part) each = static_cast<int>(random() % 3);
    const auto part_at = [&](int x, int y, int z) { return part[static_cast<size_t>(x + n[0] * (y + n[1] * z))]; };
    std::map<std::array<int, 4>, int64_t> points;  // of each part its own
    uint32_t planted = 0;
    for (int z = 0; z < n[2]; ++z) {
      for (int y = 0; y < n[1]; ++y) {
        for (int x = 0; x < n[0]; ++x) {
          const int own = part_at(x, y, z);
          if (x > 0 && part_at(x - 1, y, z) != own) planted += 2;
          if (y > 0 && part_at(x, y - 1, z) != own) planted += 2;
          if (z > 0 && part_at(x, y, z - 1) != own) planted += 2;
          static constexpr int kCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
          for (unsigned k = 0; k < (dimension == 3 ? 8u : 4u); ++k) {
            const std::array<int, 4> key{x + kCorners[k][0], y + kCorners[k][1], z + kCorners[k][2], own};
            const auto [at, is_new] = points.emplace(key, static_cast<int64_t>(mesh.points.size() / dimension));
            for (unsigned c = 0; c < dimension && is_new; ++c) mesh.points.push_back(0.1 * key[c]);
            mesh.connectivity.push_back(at->second);
          }
          mesh.types.push_back(dimension == 3 ? DSW_CELL_TYPE_HEXAHEDRON : DSW_CELL_TYPE_QUAD);
          mesh.offsets.push_back(static_cast<int64_t>(mesh.connectivity.size()));
        }
      }
    }
    dsw_build_report report;
    const Owner made = mesh.create(DSW_ENVIRONMENT_FIND_TOUCHING, report);
    ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message();
    EXPECT_EQ(report.touching_face_count, planted);
    EXPECT_EQ(report.touching_face.generation != 0, planted != 0);
    const Owner merged = mesh.create(DSW_ENVIRONMENT_MERGE_POINTS | DSW_ENVIRONMENT_FIND_TOUCHING, report);
    ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message();
    EXPECT_EQ(report.touching_face_count, 0u);
    EXPECT_EQ(report.part_count, 1u);
    dsw_build_report checked{};
    checked.struct_size = sizeof checked;
    EXPECT_EQ(dsw_environment_check(made.get(), &checked), DSW_STATUS_OK);
    EXPECT_EQ(checked.touching_face_count, planted);
  }
}

/** A triangulation of the points of a square grid, as prisms between two heights. */
void add_prisms(LooseMesh& mesh, int n, double low, double high, const std::vector<int>& diagonals) {
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const double a = x, b = x + 1, c = y, d = y + 1;
      const bool rising = diagonals[static_cast<size_t>(x + n * y)] != 0;
      using Triangle = std::array<std::array<double, 2>, 3>;
      const Triangle triangles[2] = {rising ? Triangle{{{a, c}, {b, c}, {b, d}}} : Triangle{{{a, c}, {b, c}, {a, d}}},
                                     rising ? Triangle{{{a, c}, {b, d}, {a, d}}} : Triangle{{{b, c}, {b, d}, {a, d}}}};
      for (const Triangle& t : triangles) {  // 0 1 2 counter-clockwise seen from outside, below
        std::vector<Vec3> corners;
        for (const double z : {low, high}) {
          for (const int k : {0, 2, 1}) corners.push_back({t[size_t(k)][0], t[size_t(k)][1], z});
        }
        mesh.add(DSW_CELL_TYPE_WEDGE, corners);
      }
    }
  }
}

TEST(ConformSpaceTest, QuadsLieOnTrianglesOfEitherDiagonal) {
  for (int round = 0; round < effort_of(10); ++round) {
    std::mt19937_64 random(seed_of(40 + static_cast<unsigned>(round)));
    const int n = 4;
    LooseMesh mesh;
    std::vector<Box> boxes;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        boxes.push_back({{double(x), double(y), 0}, {x + 1.0, y + 1.0, 1}});
        mesh.add_box(boxes.back().low, boxes.back().high);
      }
    }
    std::vector<int> diagonals;
    for (int i = 0; i < n * n; ++i) diagonals.push_back(static_cast<int>(random() & 1));
    add_prisms(mesh, n, 1, 2, diagonals);
    for (int i = 0; i < n * n; ++i) {  // a prism lies in the box of its square
      const Box square{{double(i % n), double(i / n), 1}, {i % n + 1.0, i / n + 1.0, 2}};
      boxes.push_back(square);
      boxes.push_back(square);
    }
    dsw_build_report report;
    const Owner sewn = mesh.create(DSW_ENVIRONMENT_CONFORM, report);
    ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message();
    EXPECT_EQ(report.part_count, 1u);
    EXPECT_EQ(report.changed_count, uint32_t{n * n});
    EXPECT_EQ(dsw_environment_check(sewn.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    expect_no_walls(sewn.get(), boxes, 3, 2, random);
  }
}

TEST(ConformSpaceTest, TrianglesThatCrossAreRefusedAndNamed) {
  for (int round = 0; round < effort_of(10); ++round) {
    std::mt19937_64 random(seed_of(80 + static_cast<unsigned>(round)));
    const int n = round < 2 && effort_of(1) >= 10 ? 70 : 3;
    std::vector<int> below, above;
    for (int i = 0; i < n * n; ++i) {
      below.push_back(static_cast<int>(random() & 1));
      above.push_back(round == 0 ? below.back() : static_cast<int>(random() & 1));
    }
    LooseMesh mesh;
    add_prisms(mesh, n, 0, 1, below);
    add_prisms(mesh, n, 1, 2, above);
    dsw_build_report report;
    const Owner made = mesh.create(DSW_ENVIRONMENT_CONFORM, report);
    if (below == above) {
      EXPECT_EQ(report.status, DSW_STATUS_OK);
      EXPECT_EQ(report.part_count, 1u);
      continue;
    }
    EXPECT_EQ(report.status, DSW_STATUS_NOT_CONFORMING);
    ASSERT_EQ(report.offender_count, 2u);
    const uint32_t square = report.offenders[0] / 2;  // the first whose diagonals cross
    EXPECT_EQ(square,
              static_cast<uint32_t>(std::mismatch(below.begin(), below.end(), above.begin()).first - below.begin()));
    EXPECT_EQ(report.offenders[1] / 2, static_cast<uint32_t>(n * n) + square);
  }
}

/** Boxes that are shifted against each other by half of their width, and a small one in the middle of a large face. */
TEST(ConformSpaceTest, FacesThatDoNotNestAreSplitAtPointsThatExist) {
  LooseMesh bricks;
  std::vector<Box> boxes{{{0, 0, 0}, {2, 2, 1}},
                         {{2, 0, 0}, {4, 2, 1}},
                         {{0, 0, 1}, {1, 2, 2}},
                         {{1, 0, 1}, {3, 2, 2}},
                         {{3, 0, 1}, {4, 2, 2}}};
  for (const Box& box : boxes) bricks.add_box(box.low, box.high);
  dsw_build_report report;
  Owner sewn = bricks.create(DSW_ENVIRONMENT_CONFORM, report);
  ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(report.part_count, 1u);
  EXPECT_EQ(report.changed_count, 3u);
  EXPECT_EQ(dsw_environment_check(sewn.get(), nullptr), DSW_STATUS_OK);
  std::mt19937_64 random(seed_of(5));
  expect_no_walls(sewn.get(), boxes, 3, 2, random);

  LooseMesh tower;
  boxes = {{{0, 0, 0}, {3, 3, 1}}, {{1, 1, 1}, {2, 2, 2}}};
  for (const Box& box : boxes) tower.add_box(box.low, box.high);
  sewn = tower.create(DSW_ENVIRONMENT_CONFORM, report);
  ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(report.part_count, 1u);
  EXPECT_EQ(dsw_environment_check(sewn.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  const Vec3 from{1.5, 1.25, 0.5}, up{1.5, 1.25, 1.75}, beside{0.5, 0.25, 1.75};
  dsw_flight flight;
  ASSERT_EQ(dsw_environment_cast(sewn.get(), {0, 0}, from.data(), up.data(), nullptr, &flight), DSW_STATUS_OK);
  EXPECT_EQ(flight.outcome, DSW_OUTCOME_REACHED);
  ASSERT_EQ(dsw_environment_cast(sewn.get(), {0, 0}, from.data(), beside.data(), nullptr, &flight), DSW_STATUS_OK);
  EXPECT_EQ(flight.outcome, DSW_OUTCOME_CONTACT);
  EXPECT_EQ(flight.position[2], 1);
}

/** Points of both sides differ by rounding: they are one within a distance, and points on edges and faces, too. */
TEST(ConformSpaceTest, PointsThatDifferByRoundingAreOneWithinADistance) {
  for (int round = 0; round < effort_of(10); ++round) {
    std::mt19937_64 random(seed_of(60 + static_cast<unsigned>(round)));
    LooseMesh mesh;
    std::vector<Box> boxes;
    for (int x = 0; x < 2; ++x) refine({{double(x), 0, 0}, {x + 1.0, 1, 1}}, 3, x + 1, 1, random, boxes);
    for (const Box& box : boxes) mesh.add_box(box.low, box.high);
    // Turned, so that nothing is exactly on a line or in a plane; points at one place may differ afterwards.
    for (size_t i = 0; i < mesh.points.size(); i += 3) {
      double* const p = &mesh.points[i];
      const double x = 0.6 * p[0] - 0.7 * p[1] + 0.1 * p[2], y = 0.5 * p[0] + 0.6 * p[1] - 0.3 * p[2],
                   z = 0.2 * p[0] + 0.3 * p[1] + 0.9 * p[2];
      p[0] = x + uniform(random, -1e-13, 1e-13);
      p[1] = y + uniform(random, -1e-13, 1e-13);
      p[2] = z + uniform(random, -1e-13, 1e-13);
    }
    dsw_build_report report;
    const Owner exact = mesh.create(DSW_ENVIRONMENT_CONFORM, report);
    EXPECT_TRUE(report.status != DSW_STATUS_OK || report.part_count > 1);
    mesh.merge_distance = 1e-9;
    const Owner sewn = mesh.create(DSW_ENVIRONMENT_CONFORM, report);
    ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message();
    EXPECT_EQ(report.part_count, 1u);
    EXPECT_EQ(report.boundary_face_count, 5u * 4u + 5u * 16u);  // five sides of each half
    EXPECT_EQ(dsw_environment_check(sewn.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  }
}

}  // namespace
}  // namespace dsw::loose
