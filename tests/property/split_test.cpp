// Cells whose mean does not see them whole: random polygons, voxels joined to one polyhedron, hexahedra with corners pushed in,
// cells with repeated points. What they cover is known without the engine: volumes are added up as exact rational numbers, and
// where points lie and casts end follows from voxels and from rational turns.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "../effort.h"
#include "dartsweep/dartsweep.h"

namespace dsw {
namespace {

using Vec3 = std::array<double, 3>;
using Loops = std::vector<std::vector<int64_t>>;

struct Destroy {
  void operator()(dsw_environment* environment) const { dsw_environment_destroy(environment); }
};
using Owner = std::unique_ptr<dsw_environment, Destroy>;

/** Cells of any type. */
struct Cells {
  unsigned dimension = 3;
  std::vector<double> points;
  std::vector<uint8_t> types;
  std::vector<int64_t> offsets{0}, connectivity;
  std::vector<int32_t> regions;
  std::vector<uint32_t> tags;

  int64_t add_point(const Vec3& p) {
    points.insert(points.end(), p.begin(), p.begin() + dimension);
    return static_cast<int64_t>(points.size() / dimension) - 1;
  }
  void add(dsw_cell_type type, const std::vector<int64_t>& corners) {
    types.push_back(static_cast<uint8_t>(type));
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
    regions.push_back(static_cast<int32_t>(100 + types.size()));
    tags.push_back(static_cast<uint32_t>(7000 + types.size()));
  }
  void add(const Loops& faces) {
    std::vector<int64_t> stream{static_cast<int64_t>(faces.size())};
    for (const auto& face : faces) {
      stream.push_back(static_cast<int64_t>(face.size()));
      stream.insert(stream.end(), face.begin(), face.end());
    }
    add(DSW_CELL_TYPE_POLYHEDRON, stream);
  }
  dsw_environment_desc desc(uint32_t flags) const {
    dsw_environment_desc d;
    dsw_environment_desc_init(&d, sizeof d);
    d.dimension = dimension;
    d.flags = flags;
    d.points = points.data();
    d.point_count = points.size() / dimension;
    d.cell_types = types.data();
    d.volume_count = types.size();
    d.offsets = offsets.data();
    d.connectivity = connectivity.data();
    d.connectivity_count = connectivity.size();
    d.regions = regions.data();
    d.tags = tags.data();
    return d;
  }
  Owner create(uint32_t flags, dsw_build_report& report) const {
    const dsw_environment_desc d = desc(flags);
    report = {};
    report.struct_size = sizeof report;
    dsw_environment* made = nullptr;
    dsw_environment_create(nullptr, &d, &made, &report);
    return Owner(made);
  }
};

double uniform(std::mt19937_64& random, double low = 0, double high = 1) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

using Exact3 = std::array<mpq_class, 3>;

Exact3 exact(const double* p, unsigned dimension) {
  Exact3 q;
  for (unsigned k = 0; k < dimension; ++k) q[k] = p[k];
  return q;
}

mpq_class determinant(const Exact3& a, const Exact3& b, const Exact3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/** Twice the area of a loop of the plane. */
mpq_class area(const std::vector<Exact3>& loop) {
  mpq_class sum = 0;
  for (size_t k = 0; k < loop.size(); ++k) {
    const Exact3 &p = loop[k], &q = loop[(k + 1) % loop.size()];
    sum += p[0] * q[1] - p[1] * q[0];
  }
  return sum;
}

dsw_volume_id volume_at(const dsw_environment* environment, uint32_t index) {
  dsw_volume_id id;
  EXPECT_EQ(dsw_environment_get_volume_id(environment, index, &id), DSW_STATUS_OK);
  return id;
}

std::vector<Exact3> corners_of(const dsw_environment* environment, const dsw_cell& cell, unsigned dimension) {
  std::vector<dsw_vertex_id> vertices(4096);
  size_t count = 0;
  EXPECT_EQ(dsw_environment_copy_vertices(environment, cell, vertices.data(), vertices.size(), &count), DSW_STATUS_OK)
      << dsw_last_error_message();
  std::vector<Exact3> corners;
  for (size_t k = 0; k < count; ++k) {
    double p[3];
    EXPECT_EQ(dsw_environment_get_vertex_position(environment, vertices[k], p), DSW_STATUS_OK);
    corners.push_back(exact(p, dimension));
  }
  return corners;
}

/** Six times the volume, or twice the area, of a part all of whose faces are flat. */
mpq_class size_of(const dsw_environment* environment, uint32_t index, unsigned dimension) {
  const dsw_volume_id volume = volume_at(environment, index);
  if (dimension == 2) {
    dsw_cell cell{};
    cell.kind = DSW_CELL_VOLUME;
    cell.index = volume.index;
    cell.generation = volume.generation;
    return area(corners_of(environment, cell, 2));
  }
  uint32_t faces = 0;
  EXPECT_EQ(dsw_environment_get_volume_counts(environment, volume, nullptr, nullptr, nullptr, &faces), DSW_STATUS_OK);
  mpq_class sum = 0;
  for (uint32_t f = 0; f < faces; ++f) {
    dsw_face_id face;
    dsw_volume_id near_side, far_side;
    EXPECT_EQ(dsw_environment_get_face_id(environment, volume, f, &face), DSW_STATUS_OK);
    EXPECT_EQ(dsw_environment_get_face_volumes(environment, face, &near_side, &far_side), DSW_STATUS_OK);
    dsw_cell cell{};
    cell.kind = DSW_CELL_FACE;
    cell.index = face.volume;
    cell.generation = face.generation;
    cell.local = face.local;
    const std::vector<Exact3> loop = corners_of(environment, cell, 3);
    mpq_class part = 0;
    for (size_t k = 1; k + 1 < loop.size(); ++k) part += determinant(loop[0], loop[k], loop[k + 1]);
    sum += near_side.index == volume.index ? part : mpq_class(-part);
  }
  return sum;
}

uint32_t volume_count(const dsw_environment* environment) {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  EXPECT_EQ(dsw_environment_get_info(environment, &info), DSW_STATUS_OK);
  return info.volume_count;
}

uint32_t parent_of(const dsw_environment* environment, uint32_t index) {
  uint32_t parent = 0xdeadu;
  EXPECT_EQ(dsw_environment_get_parent(environment, volume_at(environment, index), &parent), DSW_STATUS_OK);
  return parent;
}

/** Parts have the labels of their parent, the first part its index, and together its size. */
void expect_parts(const dsw_environment* environment, const Cells& cells, const std::vector<mpq_class>& sizes) {
  ASSERT_NE(environment, nullptr) << dsw_last_error_message();
  ASSERT_EQ(dsw_environment_check(environment, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  std::vector<mpq_class> sums(sizes.size(), 0);
  for (uint32_t i = 0; i < volume_count(environment); ++i) {
    const uint32_t parent = parent_of(environment, i);
    ASSERT_LT(parent, cells.types.size());
    ASSERT_TRUE(i >= cells.types.size() || parent == i);
    int32_t region;
    uint32_t tag;
    ASSERT_EQ(dsw_environment_get_region(environment, volume_at(environment, i), &region), DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_get_tag(environment, volume_at(environment, i), &tag), DSW_STATUS_OK);
    EXPECT_EQ(region, cells.regions[parent]);
    EXPECT_EQ(tag, cells.tags[parent]);
    const mpq_class size = size_of(environment, i, cells.dimension);
    EXPECT_GT(size, 0);
    sums[parent] += size;
  }
  for (size_t i = 0; i < sizes.size(); ++i) EXPECT_EQ(sums[i], sizes[i]) << "cell " << i;
}

// The plane.

int turn(const Exact3& a, const Exact3& b, const Exact3& c) {
  return sgn((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

/** A star of random radii about a place, or a comb, or a spiral: simple, with many reflex corners. */
std::vector<Vec3> random_polygon(std::mt19937_64& random) {
  std::vector<Vec3> loop;
  const int kind = static_cast<int>(random() % 3), n = 5 + static_cast<int>(random() % 20);
  if (kind == 0) {
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * 3.14159265358979 * k / n, radius = uniform(random, 0.1, 1);
      loop.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
  } else if (kind == 1) {  // a comb with teeth of random lengths, with corners on its sides
    for (int k = 0; k < n; ++k) loop.push_back({double(k), 0, 0});
    for (int k = n; k-- > 0;) loop.push_back({k + 0.5, k % 2 == 0 ? 0.25 : uniform(random, 0.5, 9), 0});
  } else {  // a spiral: out on one radius, back on a smaller one
    for (int k = 0; k <= 2 * n; ++k) {
      const double angle = 0.5 * k, radius = 1 + 0.5 * angle;
      loop.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    for (int k = 2 * n; k >= 0; --k) {
      const double angle = 0.5 * k, radius = 0.25 + 0.5 * angle;
      loop.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
  }
  return loop;
}

/** Even-odd rule, exact. A place on a side counts as neither. */
int inside(const std::vector<Exact3>& loop, const Exact3& p) {
  bool is_in = false;
  for (size_t k = 0; k < loop.size(); ++k) {
    const Exact3 &a = loop[k], &b = loop[(k + 1) % loop.size()];
    const int side = turn(a, b, p);
    const bool between = std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= p[1] &&
                         p[1] <= std::max(a[1], b[1]);
    if (side == 0 && between) return 0;
    if ((a[1] > p[1]) != (b[1] > p[1]) && (side > 0) == (b[1] > a[1])) is_in = !is_in;
  }
  return is_in ? 1 : -1;
}

TEST(SplitTest, PolygonsAreWhatTheyWere) {
  int split = 0;
  for (int round = 0; round < effort_of(200); ++round) {
    std::mt19937_64 random(seed_of(100 + static_cast<unsigned>(round)));
    const std::vector<Vec3> loop = random_polygon(random);
    Cells cells;
    cells.dimension = 2;
    std::vector<int64_t> corners;
    for (const Vec3& p : loop) corners.push_back(cells.add_point(p));
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random() % corners.size()),
                corners.end());
    const bool is_turned = random() % 2 == 0;
    if (is_turned) std::reverse(corners.begin(), corners.end());
    cells.add(DSW_CELL_TYPE_POLYGON, corners);
    std::vector<Exact3> outline;
    for (const Vec3& p : loop) outline.push_back(exact(p.data(), 2));
    dsw_build_report report;
    if (is_turned) {
      EXPECT_EQ(cells.create(DSW_ENVIRONMENT_SPLIT, report), nullptr);
      EXPECT_EQ(report.status, DSW_STATUS_INVERTED_CELL) << dsw_last_error_message();
    }
    const Owner made = cells.create(DSW_ENVIRONMENT_SPLIT | DSW_ENVIRONMENT_REORIENT, report);
    ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message() << " round " << round;
    EXPECT_EQ(report.reoriented_count, is_turned ? 1u : 0u);
    split += static_cast<int>(report.split_count);
    EXPECT_EQ(report.part_count, 1u);
    EXPECT_EQ(report.boundary_face_count, loop.size());
    expect_parts(made.get(), cells, {area(outline)});
    for (int i = 0; i < 100; ++i) {
      const Vec3 &a = loop[random() % loop.size()], &b = loop[random() % loop.size()];
      const double share = uniform(random, -0.2, 1.2);
      const double place[2] = {a[0] + share * (b[0] - a[0]) + uniform(random, -0.1, 0.1), a[1] + share * (b[1] - a[1])};
      dsw_volume_id found{};
      ASSERT_EQ(dsw_environment_locate(made.get(), place, {0, 0}, &found, nullptr), DSW_STATUS_OK);
      const int truth = inside(outline, exact(place, 2));
      ASSERT_TRUE(truth == 0 || (found.generation != 0) == (truth > 0)) << place[0] << " " << place[1];
    }
  }
  EXPECT_GT(split, effort_of(200) / 2);
}

// Space.

using Voxel = std::array<int, 3>;

/** Cells of voxels: each a set that hangs together by faces, without edges or corners that only touch. */
struct Voxels {
  Cells cells;
  std::map<Voxel, int64_t> points;
  std::map<Voxel, uint32_t> cell_of;

  int64_t point(const Voxel& v) {
    const auto known = points.find(v);
    if (known != points.end()) return known->second;
    return points[v] = cells.add_point({double(v[0]), double(v[1]), double(v[2])});
  }
  static std::array<Voxel, 4> face(const Voxel& v, int axis, bool high) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    std::array<Voxel, 4> corners;
    const int turns[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int k = 0; k < 4; ++k) {
      corners[static_cast<size_t>(k)] = v;
      Voxel& corner = corners[static_cast<size_t>(k)];
      corner[static_cast<size_t>(axis)] += high ? 1 : 0;
      corner[static_cast<size_t>(i)] += turns[k][high ? 0 : 1];
      corner[static_cast<size_t>(j)] += turns[k][high ? 1 : 0];
    }
    return corners;
  }
  void add(const std::set<Voxel>& of, bool is_turned) {
    Loops faces;
    for (const Voxel& v : of) {
      cell_of[v] = static_cast<uint32_t>(cells.types.size());
      for (int axis = 0; axis < 3; ++axis) {
        for (const bool high : {false, true}) {
          Voxel beyond = v;
          beyond[static_cast<size_t>(axis)] += high ? 1 : -1;
          if (of.count(beyond) != 0) continue;
          std::vector<int64_t> loop;
          for (const Voxel& corner : face(v, axis, high)) loop.push_back(point(corner));
          if (is_turned) std::reverse(loop.begin(), loop.end());
          faces.push_back(loop);
        }
      }
    }
    cells.add(faces);
  }
};

/** Whether the boundary of a set of voxels is one sphere: two faces at each edge, one ring of faces round each corner, and
 * Euler's number. */
bool is_ball(const std::set<Voxel>& of) {
  std::map<std::pair<Voxel, Voxel>, int> edges;
  std::map<Voxel, std::vector<std::pair<Voxel, Voxel>>> links;
  int faces = 0;
  for (const Voxel& v : of) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool high : {false, true}) {
        Voxel beyond = v;
        beyond[static_cast<size_t>(axis)] += high ? 1 : -1;
        if (of.count(beyond) != 0) continue;
        ++faces;
        const auto loop = Voxels::face(v, axis, high);
        for (size_t k = 0; k < 4; ++k) {
          ++edges[{std::min(loop[k], loop[(k + 1) % 4]), std::max(loop[k], loop[(k + 1) % 4])}];
          links[loop[k]].push_back({loop[(k + 3) % 4], loop[(k + 1) % 4]});
        }
      }
    }
  }
  for (const auto& edge : edges) {
    if (edge.second != 2) return false;
  }
  for (const auto& link : links) {
    std::map<Voxel, Voxel> next(link.second.begin(), link.second.end());
    size_t steps = 0;
    Voxel at = link.second[0].first;
    do at = next.at(at);
    while (++steps <= link.second.size() && at != link.second[0].first);
    if (steps != link.second.size()) return false;
  }
  return static_cast<int>(links.size()) - static_cast<int>(edges.size()) + faces == 2;
}

std::set<Voxel> grow(const std::set<Voxel>& room, size_t most, std::mt19937_64& random) {
  std::set<Voxel> grown;
  std::vector<Voxel> all(room.begin(), room.end());
  grown.insert(all[random() % all.size()]);
  for (int tries = 0; tries < 60 && grown.size() < most; ++tries) {
    Voxel v = *std::next(grown.begin(), static_cast<std::ptrdiff_t>(random() % grown.size()));
    v[random() % 3] += random() % 2 == 0 ? 1 : -1;
    if (room.count(v) == 0 || !grown.insert(v).second) continue;
    if (!is_ball(grown)) grown.erase(v);
  }
  return grown;
}

/** A box of voxels, cut into random cells. */
Voxels random_voxels(int side, size_t most, std::mt19937_64& random) {
  Voxels made;
  std::set<Voxel> room;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) room.insert({x, y, z});
    }
  }
  while (!room.empty()) {
    const std::set<Voxel> cell = grow(room, most, random);
    for (const Voxel& v : cell) room.erase(v);
    made.add(cell, false);
  }
  return made;
}

TEST(SplitTest, CellsOfVoxelsAreWhatTheyWere) {
  uint32_t split = 0, added = 0;
  for (int round = 0; round < effort_of(30); ++round) {
    std::mt19937_64 random(seed_of(500 + static_cast<unsigned>(round)));
    const int side = 4;
    const Voxels voxels = random_voxels(side, 2 + static_cast<size_t>(round % 8), random);
    std::vector<mpq_class> sizes(voxels.cells.types.size(), 0);
    for (const auto& voxel : voxels.cell_of) sizes[voxel.second] += 6;
    dsw_build_report report;
    const Owner made = voxels.cells.create(DSW_ENVIRONMENT_SPLIT, report);
    ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message() << " round " << round;
    EXPECT_EQ(report.part_count, 1u);
    expect_parts(made.get(), voxels.cells, sizes);
    split += report.split_count;
    added += report.added_point_count;
    for (int i = 0; i < 300; ++i) {
      double from[3], to[3];
      for (int k = 0; k < 3; ++k) {
        from[k] = uniform(random, 0, side);
        to[k] = random() % 3 == 0 ? double(1 + random() % 3) : uniform(random, 0, side);
      }
      dsw_flight flight;
      ASSERT_EQ(dsw_environment_cast(made.get(), {0, 0}, from, to, nullptr, &flight), DSW_STATUS_OK);
      ASSERT_EQ(flight.outcome, DSW_OUTCOME_REACHED);
      std::set<uint32_t> holders;  // of all voxels that touch the place
      for (int part = 0; part < 8; ++part) {
        Voxel v;
        for (int k = 0; k < 3; ++k) {
          const double low = std::floor(to[k]);
          v[static_cast<size_t>(k)] = static_cast<int>(low) - (low == to[k] && (part >> k & 1) != 0 ? 1 : 0);
        }
        const auto known = voxels.cell_of.find(v);
        if (known != voxels.cell_of.end()) holders.insert(known->second);
      }
      ASSERT_TRUE(holders.count(parent_of(made.get(), flight.volume.index)));
    }
  }
  EXPECT_GT(split, 0u);
  RecordProperty("split", static_cast<int>(split));
  RecordProperty("added_points", static_cast<int>(added));
  std::printf("%u cells split, %u points added\n", split, added);
}

/** Casts between places inside a box end where they were to. */
void expect_no_walls(const dsw_environment* environment, const Vec3& low, const Vec3& high, std::mt19937_64& random) {
  for (int i = 0; i < 200; ++i) {
    double from[3], to[3];
    for (size_t k = 0; k < 3; ++k) {
      from[k] = uniform(random, low[k], high[k]);
      to[k] = uniform(random, low[k], high[k]);
    }
    dsw_flight flight;
    ASSERT_EQ(dsw_environment_cast(environment, {0, 0}, from, to, nullptr, &flight), DSW_STATUS_OK);
    ASSERT_EQ(flight.outcome, DSW_OUTCOME_REACHED);
  }
}

/** Cells of voxels beside cells of voxels of half the size; no two cells have points in common, and some are turned. */
TEST(SplitTest, LooseCellsAreSewnTurnedAndSplit) {
  uint32_t split = 0;
  for (int round = 0; round < effort_of(12); ++round) {
    std::mt19937_64 random(seed_of(800 + static_cast<unsigned>(round)));
    Cells loose;
    std::vector<mpq_class> sizes;
    for (const int side : {2, 4}) {
      const Voxels voxels = random_voxels(side, 4, random);
      const double scale = 2.0 / side, shift = side == 2 ? 0 : 2;
      const mpq_class each = 6 * mpq_class(scale) * scale * scale;
      for (size_t c = 0; c < voxels.cells.types.size(); ++c) {
        std::map<int64_t, int64_t> own;
        std::vector<int64_t> stream(voxels.cells.connectivity.begin() + voxels.cells.offsets[c],
                                    voxels.cells.connectivity.begin() + voxels.cells.offsets[c + 1]);
        Loops faces;
        for (size_t k = 1; k < stream.size(); k += 5) {
          std::vector<int64_t> face;
          for (size_t j = k + 1; j < k + 5; ++j) {
            const double* const p = &voxels.cells.points[3 * static_cast<size_t>(stream[j])];
            if (own.count(stream[j]) == 0) {
              own[stream[j]] = loose.add_point({shift + scale * p[0], scale * p[1], scale * p[2]});
            }
            face.push_back(own[stream[j]]);
          }
          if (random() % 10 == 0) std::reverse(face.begin(), face.end());
          faces.push_back(face);
        }
        loose.add(faces);
        sizes.push_back(0);
      }
      for (const auto& voxel : voxels.cell_of) {
        sizes[sizes.size() - voxels.cells.types.size() + voxel.second] += each;
      }
    }
    dsw_build_report report;
    const Owner made = loose.create(
        DSW_ENVIRONMENT_SPLIT | DSW_ENVIRONMENT_CONFORM | DSW_ENVIRONMENT_REORIENT | DSW_ENVIRONMENT_FIND_TOUCHING,
        report);
    ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message() << " round " << round;
    EXPECT_EQ(report.part_count, 1u);
    EXPECT_EQ(report.touching_face_count, 0u);
    split += report.split_count;
    expect_parts(made.get(), loose, sizes);
    expect_no_walls(made.get(), {0, 0, 0}, {4, 2, 2}, random);
  }
  EXPECT_GT(split, 0u);
}

/** Hexahedra round a point that is moved anywhere: faces are warped, and cells lose their corner. What is accepted is a
 * partition; without splitting fewer are accepted. */
TEST(SplitTest, PushedCornersAreWhatTheyWere) {
  int accepted = 0, valid_before = 0;
  const int rounds = effort_of(100);
  for (int round = 0; round < rounds; ++round) {
    std::mt19937_64 random(seed_of(300 + static_cast<unsigned>(round)));
    Cells cells;
    for (int i = 0; i < 27; ++i) cells.add_point({double(i % 3), double(i / 3 % 3), double(i / 9)});
    for (size_t k = 0; k < 3; ++k) cells.points[3 * 13 + k] = uniform(random, 0.2, 1.8);
    for (int i = 0; i < 8; ++i) {
      const int64_t first = i % 2 + 3 * (i / 2 % 2) + 9 * (i / 4);
      cells.add(DSW_CELL_TYPE_HEXAHEDRON,
                {first, first + 1, first + 4, first + 3, first + 9, first + 10, first + 13, first + 12});
    }
    dsw_build_report report;
    valid_before += cells.create(0, report) != nullptr ? 1 : 0;
    const Owner made = cells.create(DSW_ENVIRONMENT_SPLIT, report);
    if (made == nullptr) {
      EXPECT_TRUE(report.status == DSW_STATUS_INVALID_CELL || report.status == DSW_STATUS_INVERTED_CELL);
      EXPECT_GT(report.offender_count, 0u);
      continue;
    }
    ++accepted;
    EXPECT_EQ(report.part_count, 1u);
    ASSERT_EQ(dsw_environment_check(made.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    expect_no_walls(made.get(), {0, 0, 0}, {2, 2, 2}, random);
  }
  std::printf("%d of %d accepted, %d without splitting\n", accepted, rounds, valid_before);
  EXPECT_GT(accepted, valid_before);
}

/** Cuts, coarsening and snapshots of cells that were split: volumes keep a parent, and the whole stays a partition. */
TEST(SplitTest, PartsAreCutCoarsenedAndKept) {
  uint32_t cut_in_two = 0;
  for (int round = 0; round < effort_of(6); ++round) {
    std::mt19937_64 random(seed_of(900 + static_cast<unsigned>(round)));
    const Voxels voxels = random_voxels(3, 5, random);
    dsw_build_report report;
    const Owner made = voxels.cells.create(DSW_ENVIRONMENT_SPLIT, report);
    ASSERT_NE(made, nullptr) << dsw_last_error_message();
    dsw_environment* coarse = nullptr;
    std::vector<uint32_t> map(volume_count(made.get()));
    ASSERT_EQ(dsw_environment_coarsen(made.get(), nullptr, &coarse, map.data(), map.size(), nullptr), DSW_STATUS_OK)
        << dsw_last_error_message();
    const Owner coarser(coarse);
    for (uint32_t i = 0; i < volume_count(coarse); ++i) {
      std::set<uint32_t> parents;
      for (uint32_t j = 0; j < map.size(); ++j) {
        if (map[j] == i) parents.insert(parent_of(made.get(), j));
      }
      ASSERT_TRUE(parents.count(parent_of(coarse, i)));
    }
    const double height = uniform(random, 0.3, 2.7), tilt = uniform(random, -0.2, 0.2);
    const double blade[12] = {-1, -1, height - tilt, 4, -1, height, -1, 4, height, 4, 4, height + tilt};
    dsw_cut_desc cut;
    dsw_cut_desc_init(&cut, sizeof cut);
    cut.points = blade;
    cut.rows = cut.columns = 2;
    dsw_change change{};
    change.struct_size = sizeof change;
    ASSERT_EQ(dsw_environment_cut(made.get(), &cut, &change), DSW_STATUS_OK) << dsw_last_error_message();
    cut_in_two += change.volumes_split;
    ASSERT_EQ(dsw_environment_check(made.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    size_t size = 0;
    ASSERT_EQ(dsw_environment_save(made.get(), nullptr, 0, &size), DSW_STATUS_OK);
    std::vector<unsigned char> block(size);
    ASSERT_EQ(dsw_environment_save(made.get(), block.data(), size, &size), DSW_STATUS_OK);
    dsw_environment* again = nullptr;
    ASSERT_EQ(dsw_environment_load(nullptr, block.data(), size, &again), DSW_STATUS_OK) << dsw_last_error_message();
    const Owner loaded(again);
    for (uint32_t i = 0; i < volume_count(made.get()); ++i) {
      const uint32_t parent = parent_of(made.get(), i);
      double centre[3];
      ASSERT_EQ(dsw_environment_get_centre(made.get(), volume_at(made.get(), i), centre), DSW_STATUS_OK);
      ASSERT_EQ(parent, parent_of(again, i));
      const Voxel at{static_cast<int>(centre[0]), static_cast<int>(centre[1]), static_cast<int>(centre[2])};
      ASSERT_EQ(voxels.cell_of.at(at), parent);
    }
  }
  EXPECT_GT(cut_in_two, 0u);
}

}  // namespace
}  // namespace dsw
