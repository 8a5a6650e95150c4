// Cells whose mean does not see them whole: random polygons, voxels joined to one polyhedron, hexahedra with corners pushed in,
// cells with repeated points. What they cover is known without the engine: volumes are added up as exact rational numbers, and
// where points lie and casts end follows from voxels and from rational turns.
#include "split_support.h"

#include <algorithm>

namespace dsw {
namespace {

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
  for (int round = 0; round < std::max(effort_of(30), 4); ++round) {
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

/** Six times the volume that faces enclose that are flat and convex. */
mpq_class volume_of(const Cells& cells, const Loops& faces) {
  mpq_class sum = 0;
  for (const auto& face : faces) {
    const auto at = [&](size_t k) { return exact(&cells.points[3 * static_cast<size_t>(face[k])], 3); };
    for (size_t k = 1; k + 1 < face.size(); ++k) sum += determinant(at(0), at(k), at(k + 1));
  }
  return sum;
}

/** A prism twisted so far that no tetrahedra between its points fill it (Schoenhardt 1928), whose mean is drawn to one edge by
 * points there. With an arm, no place in it sees all of it. */
Loops twisted_prism(Cells& cells, double twist, int points_on_edge, bool has_arm) {
  const Vec3 low[3] = {{1, 0, 0}, {-0.5, 0.875, 0}, {-0.5, -0.875, 0}};
  const int levels = has_arm ? 3 : 1;
  std::vector<std::array<int64_t, 3>> rings(static_cast<size_t>(levels) + 1);
  for (size_t k = 0; k < 3; ++k) {
    rings[0][k] = cells.add_point(low[k]);
    const double angle = 2 * 3.14159265358979 * double(k) / 3 - twist;
    for (int level = 1; level <= levels; ++level) {
      const double shift = level == 3 ? 3 : 0;
      const double x = std::round(std::cos(angle) * 0x1p20) * 0x1p-20;  // so that sides of the arm are flat
      rings[static_cast<size_t>(level)][k] = cells.add_point({x + shift, std::sin(angle), (level + 1) / 2.0});
    }
  }
  std::vector<int64_t> edge{rings[0][0]};
  for (int i = 1; i <= points_on_edge; ++i) {  // exactly on it: shares are of 8
    edge.push_back(cells.add_point({1 - 1.5 * i / 8, 0.875 * i / 8, 0}));
  }
  edge.push_back(rings[0][1]);
  Loops faces{{rings[0][2]}, {rings.back()[0], rings.back()[1], rings.back()[2]}};
  faces[0].insert(faces[0].end(), edge.rbegin(), edge.rend());
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    faces.push_back(k == 0 ? edge : std::vector<int64_t>{rings[0][k], rings[0][next]});
    faces.back().push_back(rings[1][k]);
    faces.push_back({rings[0][next], rings[1][next], rings[1][k]});
    for (size_t level = 1; level < static_cast<size_t>(levels); ++level) {
      faces.push_back({rings[level][k], rings[level][next], rings[level + 1][next], rings[level + 1][k]});
    }
  }
  return faces;
}

TEST(SplitTest, WhatNoTetrahedraFillGetsAPoint) {
  for (int round = 0; round < effort_of(20); ++round) {
    std::mt19937_64 random(seed_of(1200 + static_cast<unsigned>(round)));
    Cells cells;
    const Loops faces = twisted_prism(cells, uniform(random, 50, 58) * 3.14159265358979 / 180, 7, round % 2 == 1);
    cells.add(faces);
    dsw_build_report report;
    EXPECT_EQ(cells.create(0, report), nullptr);
    ASSERT_EQ(report.status, DSW_STATUS_INVALID_CELL);
    EXPECT_EQ(cells.create(DSW_ENVIRONMENT_SPLIT | DSW_ENVIRONMENT_BORROW_POINTS, report), nullptr);
    EXPECT_EQ(report.status, DSW_STATUS_INVALID_CELL);
    EXPECT_NE(std::string(dsw_last_error_message()).find("takes a new point"), std::string::npos);
    const Owner made = cells.create(DSW_ENVIRONMENT_SPLIT, report);
    ASSERT_EQ(report.status, DSW_STATUS_OK) << dsw_last_error_message() << " round " << round;
    EXPECT_GE(report.added_point_count, 1u);
    EXPECT_EQ(report.part_count, 1u);
    expect_parts(made.get(), cells, {volume_of(cells, faces)});
  }
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
