// Large interfaces, triangulations that do not nest, overlaps that are planted, and what becomes of such environments later.
#include <map>
#include <set>

#include "loose_mesh.h"
#include "support.h"

namespace dsw::loose {
namespace {

using Point2 = std::array<double, 2>;
using Triangle2 = std::array<size_t, 3>;

/** A triangulation of a square, counter-clockwise. */
struct Triangulation {
  std::vector<Point2> points;
  std::vector<Triangle2> triangles;

  /** Puts a point into a triangle. */
  void divide(size_t t, const Point2& p) {
    const Triangle2 old = triangles[t];
    points.push_back(p);
    const size_t v = points.size() - 1;
    triangles[t] = {old[0], old[1], v};
    triangles.push_back({old[1], old[2], v});
    triangles.push_back({old[2], old[0], v});
  }
};

/** Inner points on a lattice, so that all differences are exact. A triangle that has none is left. */
void divide_at_random(Triangulation& mesh, int count, std::mt19937_64& random) {
  for (int i = 0; i < count; ++i) {
    const size_t t = random() % mesh.triangles.size();
    const Triangle2& corners = mesh.triangles[t];
    Point2 p{0, 0};
    for (size_t k = 0; k < 2; ++k) {
      double sum = 0;
      for (const size_t v : corners) sum += mesh.points[v][k] * (v == corners[0] ? 0.25 : v == corners[1] ? 0.25 : 0.5);
      p[k] = sum;
    }
    mesh.divide(t, p);
  }
}

Triangulation two_triangles(double side, bool rising) {
  Triangulation made;
  made.points = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  if (rising) {
    made.triangles = {{0, 1, 2}, {0, 2, 3}};
  } else {
    made.triangles = {{0, 1, 3}, {1, 2, 3}};
  }
  return made;
}

void add_layer(LooseMesh& mesh, const Triangulation& of, double low, double high) {
  for (const Triangle2& t : of.triangles) {
    std::vector<Vec3> corners;
    for (const double z : {low, high}) {
      for (const size_t k : {size_t{0}, size_t{2}, size_t{1}}) {  // counter-clockwise seen from below
        corners.push_back({of.points[t[k]][0], of.points[t[k]][1], z});
      }
    }
    mesh.add(DSW_CELL_TYPE_WEDGE, corners);
  }
}

/** A square of side 1 at a place, as 2, 4 or 5 triangles; 5 have a point on the side y = 0. */
Triangulation square(int x, int y, uint64_t kind) {
  const double a = x, c = y;
  Triangulation made;
  made.points = {{a, c}, {a + 1, c}, {a + 1, c + 1}, {a, c + 1}, {a + 0.5, c + 0.5}, {a + 0.5, c}};
  if (kind == 0) made.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (kind == 1) made.triangles = {{0, 1, 3}, {1, 2, 3}};
  if (kind == 2) made.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  if (kind == 3) made.triangles = {{0, 5, 4}, {5, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return made;
}

TEST(ConformInterfaceTest, QuadsOnTwoFourAndFiveTrianglesAreOnePart) {
  const int n = std::min(100, 12 * effort_of(1));
  std::mt19937_64 random(seed_of(11));
  LooseMesh mesh;
  std::vector<Box> boxes;
  for (int i = 0; i < n * n; ++i) {
    const double x = i % n, y = i / n;
    boxes.push_back({{x, y, 0}, {x + 1, y + 1, 1}});
    mesh.add_box(boxes.back().low, boxes.back().high);
  }
  for (int i = 0; i < n * n; ++i) {
    const Triangulation of = square(i % n, i / n, random() % 4);
    add_layer(mesh, of, 1, 2);
    const Box above{{double(i % n), double(i / n), 1}, {i % n + 1.0, i / n + 1.0, 2}};
    boxes.insert(boxes.end(), of.triangles.size(), above);
  }
  dsw_build_report report;
  const Owner sewn = mesh.create(DSW_ENVIRONMENT_CONFORM | DSW_ENVIRONMENT_FIND_TOUCHING, report);
  ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(report.part_count, 1u);
  EXPECT_EQ(report.touching_face_count, 0u);
  EXPECT_EQ(dsw_environment_check(sewn.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  expect_no_walls(sewn.get(), boxes, 3, 2, random);
}

TEST(ConformInterfaceTest, RandomTriangulationsAreSewnIfOneRefinesTheOtherElseRefused) {
  int sewn = 0, refused = 0;
  const int rounds = effort_of(40);
  for (int round = 0; round < rounds; ++round) {
    std::mt19937_64 random(seed_of(3000 + static_cast<unsigned>(round)));
    const bool is_large = round < 2 && effort_of(1) >= 10;  // 1e4 faces
    const int points = is_large ? 5000 : 3 + static_cast<int>(random() % 12);
    Triangulation below = two_triangles(0x1p20, true);
    divide_at_random(below, points, random);
    Triangulation above = below;
    const bool nests = round % 2 == 0;
    if (!nests) {
      above = two_triangles(0x1p20, false);
      divide_at_random(above, points, random);
    }
    divide_at_random(above, points, random);
    LooseMesh mesh;
    add_layer(mesh, below, 0, 0x1p18);
    add_layer(mesh, above, 0x1p18, 0x1p19);
    dsw_build_report report;
    const Owner made = mesh.create(DSW_ENVIRONMENT_CONFORM, report);
    if (report.status == DSW_STATUS_OK) {
      ++sewn;
      EXPECT_EQ(report.part_count, 1u);
      EXPECT_EQ(report.boundary_face_count, below.triangles.size() + above.triangles.size() + 8);
      EXPECT_EQ(dsw_environment_check(made.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    } else {
      ++refused;
      EXPECT_FALSE(nests) << dsw_last_error_message();
      EXPECT_EQ(report.status, DSW_STATUS_NOT_CONFORMING);
      ASSERT_EQ(report.offender_count, 2u);
      EXPECT_NE(report.offenders[0] < below.triangles.size(), report.offenders[1] < below.triangles.size());
    }
  }
  EXPECT_EQ(sewn, (rounds + 1) / 2);
  EXPECT_EQ(refused, rounds / 2);
}

using Ints = std::array<int64_t, 3>;

Ints between(const Ints& a, const Ints& b) { return {b[0] - a[0], b[1] - a[1], b[2] - a[2]}; }
Ints across(const Ints& a, const Ints& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
int64_t along(const Ints& a, const Ints& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/** Whether two triangles of integers lie in one plane and have an area in common: no side of one has the other beyond it. */
bool have_common_area(const std::array<Ints, 3>& a, const std::array<Ints, 3>& b) {
  const Ints normal = across(between(a[0], a[1]), between(a[0], a[2]));
  for (const Ints& p : b) {
    if (along(normal, between(a[0], p)) != 0) return false;
  }
  const auto separates = [&](const std::array<Ints, 3>& one, const std::array<Ints, 3>& other) {
    for (size_t k = 0; k < 3; ++k) {
      const Ints inwards = across(normal, between(one[k], one[(k + 1) % 3]));
      const int64_t sense = along(inwards, between(one[k], one[(k + 2) % 3])) > 0 ? 1 : -1;
      if (std::all_of(other.begin(), other.end(),
                      [&](const Ints& p) { return sense * along(inwards, between(one[k], p)) <= 0; }))
        return true;
    }
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

/** Boundary faces of a mesh of tetrahedra that overlap boundary faces of other cells, pair by pair. */
uint32_t count_touching(const oracle::Mesh& mesh) {
  std::map<std::vector<int>, std::vector<std::pair<size_t, std::array<Ints, 3>>>> faces;
  for (size_t c = 0; c < mesh.cells.size(); ++c) {
    for (const oracle::Loop& loop : mesh.cells[c].faces) {
      std::array<Ints, 3> corners;
      for (size_t k = 0; k < 3; ++k) {
        for (size_t i = 0; i < 3; ++i)
          corners[k][i] = static_cast<int64_t>(mesh.points[static_cast<size_t>(loop[k])][i]);
      }
      std::vector<int> key = loop;
      std::sort(key.begin(), key.end());
      faces[key].push_back({c, corners});
    }
  }
  std::vector<std::pair<size_t, std::array<Ints, 3>>> outer;
  for (const auto& face : faces) {
    if (face.second.size() == 1) outer.push_back(face.second[0]);
  }
  uint32_t count = 0;
  for (const auto& a : outer) {
    count += std::any_of(outer.begin(), outer.end(),
                         [&](const auto& b) { return a.first != b.first && have_common_area(a.second, b.second); })
                 ? 1u
                 : 0u;
  }
  return count;
}

int add_point(oracle::Mesh& mesh, const oracle::Vec& at) {
  mesh.points.push_back(at);
  return static_cast<int>(mesh.points.size()) - 1;
}

/** Puts a tetrahedron on a face, of which it has some points in common and others at the same place, or on a part of it. */
void plant(oracle::Mesh& mesh, const oracle::Loop& face, oracle::Rng& rng) {
  const auto at = [&](int v) { return mesh.points[static_cast<size_t>(v)]; };
  std::vector<int> corners;
  const bool is_part = rng.chance(0.5);
  oracle::Vec apex = at(face[0]), a = at(face[0]), b = at(face[1]), c = at(face[2]);
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double normal = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    apex[k] += (normal > 0 ? 1 : normal < 0 ? -1 : 0) * 4 + rng.between(-1, 1);
  }
  for (size_t k = 0; k < 3; ++k) {
    const int v = face[k];
    oracle::Vec place = at(v);
    if (is_part && k != 0) {  // half of the way to corner 0, or beyond this corner
      const double share = rng.chance(0.5) ? 0.5 : 1.5;
      for (size_t i = 0; i < 3; ++i) place[i] = a[i] + share * (place[i] - a[i]);
      corners.push_back(add_point(mesh, place));
    } else {
      corners.push_back(rng.chance(0.4) ? v : add_point(mesh, place));
    }
  }
  if (corners == std::vector<int>(face.begin(), face.end())) corners[0] = add_point(mesh, a);  // else it is sewn
  mesh.add_standard(DSW_CELL_TYPE_TETRA, {corners[0], corners[1], corners[2], add_point(mesh, apex)});
}

TEST(ConformCountTest, PlantedOverlapsAreAllCountedAndNoneIsInvented) {
  int planted = 0, untouched = 0;
  for (int round = 0; round < effort_of(1000); ++round) {
    oracle::Rng rng(5000 + static_cast<uint64_t>(round));
    oracle::Mesh mesh = oracle::delaunay(rng, rng.between(6, 12), 16);
    for (oracle::Vec& p : mesh.points) {
      for (double& x : p) x *= 2;  // halves are integers
    }
    std::map<std::vector<int>, oracle::Loop> outer;
    for (const oracle::Cell& cell : mesh.cells) {
      for (const oracle::Loop& loop : cell.faces) {
        std::vector<int> key = loop;
        std::sort(key.begin(), key.end());
        if (!outer.insert({key, loop}).second) outer.erase(key);
      }
    }
    const uint32_t count = rng.below(4);
    for (uint32_t i = 0; i < count; ++i) {
      const auto chosen = std::next(outer.begin(), static_cast<std::ptrdiff_t>(rng.below(outer.size())));
      plant(mesh, chosen->second, rng);
      outer.erase(chosen);
    }
    const uint32_t truth = count_touching(mesh);
    oracle::DescArrays arrays(mesh, {});
    arrays.desc.flags = DSW_ENVIRONMENT_FIND_TOUCHING | DSW_ENVIRONMENT_REORIENT;
    dsw_build_report report{};
    report.struct_size = sizeof report;
    dsw_environment* raw = nullptr;
    dsw_environment_create(nullptr, &arrays.desc, &raw, &report);
    const oracle::EnvironmentPtr made(raw);
    if (report.status == DSW_STATUS_INVALID_CELL) continue;  // the planted cell is flat
    ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message();
    ASSERT_EQ(report.touching_face_count, truth) << "round " << round;
    planted += truth != 0 ? 1 : 0;
    untouched += truth == 0 ? 1 : 0;
  }
  EXPECT_GT(planted, effort_of(500));
  EXPECT_GT(untouched, effort_of(150));
}

/** Bytes of a snapshot. */
std::vector<unsigned char> snapshot_of(const dsw_environment* environment) {
  size_t size = 0;
  EXPECT_EQ(dsw_environment_save(environment, nullptr, 0, &size), DSW_STATUS_OK);
  std::vector<unsigned char> block(size);
  EXPECT_EQ(dsw_environment_save(environment, block.data(), block.size(), &size), DSW_STATUS_OK);
  return block;
}

/** A mesh of boxes of three sizes, sewn. */
Owner sewn_octree(unsigned dimension, std::mt19937_64& random, std::vector<Box>& boxes, uint32_t flags = 0) {
  LooseMesh mesh;
  mesh.dimension = dimension;
  for (int k = 0; k < 1 << dimension; ++k) {
    const Vec3 low{double(k & 1), double(k >> 1 & 1), double(k >> 2)};
    refine({low, {low[0] + 1, low[1] + 1, low[2] + 1}}, dimension, 2, 0.5, random, boxes);
  }
  for (const Box& box : boxes) mesh.add_box(box.low, box.high);
  dsw_build_report report;
  Owner made = mesh.create(DSW_ENVIRONMENT_CONFORM | flags, report);
  EXPECT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message();
  return made;
}

class ConformedLaterTest : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(All, ConformedLaterTest, testing::Values(2u, 3u),
                         [](const auto& value) { return value.param == 2 ? "plane" : "space"; });

TEST_P(ConformedLaterTest, ASnapshotHasTheSameBytesAndAnswers) {
  for (int round = 0; round < effort_of(10); ++round) {
    std::mt19937_64 random(seed_of(600 + static_cast<unsigned>(round)));
    std::vector<Box> boxes;
    const Owner made = sewn_octree(GetParam(), random, boxes);
    const std::vector<unsigned char> block = snapshot_of(made.get());
    dsw_environment* raw = nullptr;
    ASSERT_EQ(dsw_environment_load(nullptr, block.data(), block.size(), &raw), DSW_STATUS_OK);
    const Owner loaded(raw);
    EXPECT_EQ(snapshot_of(loaded.get()), block);
    expect_no_walls(loaded.get(), boxes, GetParam(), 2, random);
  }
}

/** All points move by one linear map: cells that were sewn stay sewn, and casts go where they went. */
TEST_P(ConformedLaterTest, ADeformationKeepsPartsTogether) {
  const unsigned dimension = GetParam();
  for (int round = 0; round < effort_of(5); ++round) {
    std::mt19937_64 random(seed_of(650 + static_cast<unsigned>(round)));
    std::vector<Box> boxes;
    const Owner made = sewn_octree(dimension, random, boxes);
    dsw_scene_desc desc;
    dsw_scene_desc_init(&desc, sizeof desc);
    desc.features = DSW_FEATURE_DEFORMING;
    dsw_scene* raw = nullptr;
    ASSERT_EQ(dsw_scene_create(made.get(), &desc, &raw), DSW_STATUS_OK);
    const oracle::ScenePtr scene(raw);
    dsw_environment_info info{};
    info.struct_size = sizeof info;
    ASSERT_EQ(dsw_environment_get_info(made.get(), &info), DSW_STATUS_OK);
    std::vector<double> next(size_t{dimension} * info.vertex_index_count);
    for (uint32_t v = 0; v < info.vertex_index_count; ++v) {
      dsw_vertex_id id;
      ASSERT_EQ(dsw_environment_get_vertex_id(made.get(), v, &id), DSW_STATUS_OK);
      double* const p = next.data() + size_t{dimension} * v;
      ASSERT_EQ(dsw_environment_get_vertex_position(made.get(), id, p), DSW_STATUS_OK);
      for (unsigned k = 0; k < dimension; ++k) p[k] *= 2;
    }
    ASSERT_EQ(dsw_environment_deform(made.get(), next.data(), info.vertex_index_count, nullptr, nullptr), DSW_STATUS_OK)
        << dsw_last_error_message();
    for (Box& box : boxes) {
      for (unsigned k = 0; k < 3; ++k) box.low[k] *= 2, box.high[k] *= 2;
    }
    expect_no_walls(made.get(), boxes, dimension, 4, random);
    EXPECT_EQ(dsw_environment_check(made.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  }
}

}  // namespace
}  // namespace dsw::loose
