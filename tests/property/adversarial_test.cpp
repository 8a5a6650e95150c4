// A table of motions that break walks: along faces and edges, through vertices, zero, far, not finite, and long.
#include "support.h"

#include <cfloat>
#include <cmath>
#include <cstring>
#include <limits>

namespace dsw::oracle {
namespace {

/// A 4 x 4 x 4 grid of unit cubes at 0 .. 4, everything passable but the outer boundary, or chosen cells not.
struct Grid {
  explicit Grid(Transform transform = Transform::kNone) {
    Mesh mesh = hex_grid(axis(4, 1), axis(4, 1), axis(4, 1));
    apply_transform(mesh, transform);
    place = place_of(std::move(mesh));
    report.begin("grid", std::string("grid") + transform_name(transform));
  }
  void check(const Vec& p, const Vec& q) {
    Checker checker(*place.world, place.get(), report);
    for (int way = 0; way < Checker::kWays; ++way)
      checker.free_cast(p, q, static_cast<Checker::Way>(way), {0, 0}, way % 2 == 0, 0);
  }
  Place place;
  Report report;
};

struct Row {
  const char* what;
  Vec from, to;
};

const std::vector<Row>& table() {
  static const std::vector<Row> rows = {
      {"zero length inside", {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}},
      {"zero length on a face", {1, 0.5, 0.5}, {1, 0.5, 0.5}},
      {"zero length on an edge", {1, 1, 0.5}, {1, 1, 0.5}},
      {"zero length on a vertex", {1, 1, 1}, {1, 1, 1}},
      {"zero length on the boundary", {0, 0, 0}, {0, 0, 0}},
      {"along a face", {1, 0.25, 0.25}, {1, 3.75, 3.5}},
      {"along a face and its diagonals", {1, 0, 0}, {1, 4, 4}},
      {"along the other diagonals", {1, 0, 4}, {1, 4, 0}},
      {"along the outer boundary", {0, 0.5, 0.5}, {0, 3.5, 3.5}},
      {"along the far outer boundary", {4, 0.5, 0.5}, {4, 3.5, 3.5}},
      {"along an edge", {1, 1, 0}, {1, 1, 4}},
      {"along an edge, backwards", {1, 1, 4}, {1, 1, 0}},
      {"along an edge of the boundary", {0, 0, 0}, {0, 0, 4}},
      {"along the last edge of the boundary", {4, 4, 0}, {4, 4, 4}},
      {"through vertices", {0.5, 0.5, 0.5}, {3.5, 3.5, 3.5}},
      {"through vertices, backwards", {3.5, 3.5, 3.5}, {0.5, 0.5, 0.5}},
      {"from vertex to vertex", {1, 1, 1}, {3, 3, 3}},
      {"from vertex to vertex, skew", {1, 3, 1}, {3, 1, 3}},
      {"knight's move over vertices", {0, 0, 0}, {4, 2, 0}},
      {"through edges", {0.5, 0.5, 0.3}, {3.5, 3.5, 0.3}},
      {"from an edge through edges", {1, 1, 0.5}, {3, 3, 0.5}},
      {"into a vertex of the boundary", {2, 2, 2}, {4, 4, 4}},
      {"through a vertex of the boundary", {2, 2, 2}, {5, 5, 5}},
      {"out of a vertex of the boundary", {4, 4, 4}, {2, 2, 2}},
      {"touching the boundary from inside", {2, 2, 2}, {4, 2, 2}},
      {"one unit short of a face", {2.5, 2.5, 2.5}, {0x1.7ffffffffffffp+1, 2.5, 2.5}},
      {"one unit past a face", {2.5, 2.5, 2.5}, {0x1.8000000000001p+1, 2.5, 2.5}},
      {"exactly on a face", {2.5, 2.5, 2.5}, {3, 2.5, 2.5}},
      {"from face to face", {1, 0.5, 0.5}, {2, 0.5, 0.5}},
      {"from face to face, backwards", {2, 0.5, 0.5}, {1, 0.5, 0.5}},
      {"one denormal", {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5 + DBL_TRUE_MIN}},
      {"denormal around the corner", {DBL_TRUE_MIN, DBL_TRUE_MIN, DBL_TRUE_MIN}, {-DBL_TRUE_MIN, 0, DBL_TRUE_MIN}},
      {"1e300 along x", {0.5, 0.5, 0.5}, {1e300, 0.5, 0.5}},
      {"1e300 through vertices", {0.5, 0.5, 0.5}, {1e300, 1e300, 1e300}},
      {"minus 1e300", {0.5, 0.5, 0.5}, {-1e300, 1e300, -1e-300}},
      {"the largest doubles", {0.5, 0.5, 0.5}, {DBL_MAX, -DBL_MAX, DBL_MAX}},
      {"1e-300", {0.5, 0.5, 0.5}, {1e-300, 1e-300, 1e-300}},
      {"minus 1e-300: past the boundary", {0.5, 0.5, 0.5}, {-1e-300, 0.5, 0.5}},
      {"start outside", {-1, 0.5, 0.5}, {2, 0.5, 0.5}},
      {"start far outside", {1e300, 1e300, 1e300}, {0.5, 0.5, 0.5}},
      {"start at the largest double", {DBL_MAX, 0.5, 0.5}, {-DBL_MAX, 0.5, 0.5}},
  };
  return rows;
}

TEST(AdversarialTest, TableOnAGrid) {
  Grid grid;
  ASSERT_PLACE(grid.place);
  for (const Row& row : table()) {
    SCOPED_TRACE(row.what);
    grid.check(row.from, row.to);
    EXPECT_EQ(grid.report.total.mismatches, 0u);
  }
  EXPECT_GT(grid.report.total.ties, 60u);
}

TEST(AdversarialTest, TableOnAGridWithWalls) {
  Grid grid;
  ASSERT_PLACE(grid.place);
  World& world = *grid.place.world;
  for (size_t f = 0; f < world.faces.size(); f += 3) {
    world.faces[f].marked = true;
    const dsw_face_id id = face_id(world, static_cast<int>(f));
    ASSERT_EQ(dsw_environment_mark_faces(grid.place.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  for (size_t c = 5; c < world.ids.size(); c += 7) {
    world.cell_marked[c] = 1;
    ASSERT_EQ(dsw_environment_mark_volumes(grid.place.get(), &world.ids[c], 1, DSW_MARK_IMPASSABLE, 0, nullptr),
              DSW_STATUS_OK);
  }
  for (const Row& row : table()) {
    SCOPED_TRACE(row.what);
    grid.check(row.from, row.to);
    EXPECT_EQ(grid.report.total.mismatches, 0u);
  }
}

TEST(AdversarialTest, TableMovedAndScaled) {
  for (Transform t : {Transform::kFar, Transform::kLarge, Transform::kSmall, Transform::kPower}) {
    Grid grid(t);
    ASSERT_PLACE(grid.place);
    for (const Row& row : table()) {
      SCOPED_TRACE(std::string(row.what) + transform_name(t));
      Mesh ends;
      ends.points = {row.from, row.to};
      apply_transform(ends, t);
      if (!std::isfinite(ends.points[0][0]) || !std::isfinite(ends.points[1][0]) || !std::isfinite(ends.points[1][1]) ||
          !std::isfinite(ends.points[0][1]) || !std::isfinite(ends.points[1][2])) {
        continue;
      }
      grid.check(ends.points[0], ends.points[1]);
      EXPECT_EQ(grid.report.total.mismatches, 0u);
    }
  }
}

TEST(AdversarialTest, AnEnvironmentOfDenormals) {
  Mesh mesh = hex_grid(axis(3, 4 * DBL_TRUE_MIN), axis(3, 4 * DBL_TRUE_MIN), axis(3, 4 * DBL_TRUE_MIN));
  Place place = place_of(std::move(mesh));
  ASSERT_PLACE(place);
  Report report;
  report.begin("denormal", "denormal grid");
  Checker checker(*place.world, place.get(), report);
  Rng rng(5);
  for (int i = 0; i < at_least(2000); ++i) {
    Vec p, q;
    for (size_t k = 0; k < 3; ++k) {
      p[k] = rng.between(0, 12) * DBL_TRUE_MIN;
      q[k] = rng.between(-3, 15) * DBL_TRUE_MIN;
    }
    checker.free_cast(p, q, static_cast<Checker::Way>(rng.below(4)), {0, 0}, rng.chance(0.5), 0);
    checker.locate(p, {0, 0});
  }
  EXPECT_EQ(report.total.mismatches, 0u);
}

TEST(AdversarialTest, NotFiniteIsRefusedAndNothingChanges) {
  Grid grid;
  ASSERT_PLACE(grid.place);
  dsw_environment* environment = grid.place.get();
  const ScenePtr scene = make_scene(environment, DSW_FEATURE_STATISTICS);
  const double at[3] = {0.5, 0.5, 0.5};
  dsw_particle_id particle, unset = {77, 77};
  ASSERT_EQ(dsw_particle_create(scene.get(), at, {0, 0}, &particle), DSW_STATUS_OK);
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()}) {
    for (size_t k = 0; k < 3; ++k) {
      double p[3] = {1.5, 1.5, 1.5};
      p[k] = bad;
      dsw_flight flight;
      std::memset(&flight, 0x5a, sizeof flight);
      const std::string before = bits_of(flight);
      EXPECT_EQ(dsw_environment_cast(environment, {0, 0}, p, at, nullptr, &flight), DSW_STATUS_NON_FINITE);
      EXPECT_EQ(dsw_environment_cast(environment, {0, 0}, at, p, nullptr, &flight), DSW_STATUS_NON_FINITE);
      EXPECT_EQ(dsw_particle_move(scene.get(), particle, p, nullptr, &flight), DSW_STATUS_NON_FINITE);
      EXPECT_EQ(bits_of(flight), before) << "an out-argument was touched";
      size_t count = 77;
      EXPECT_EQ(dsw_environment_cast_path(environment, {0, 0}, at, p, nullptr, nullptr, 0, &count, &flight),
                DSW_STATUS_NON_FINITE);
      dsw_volume_id v = {77, 77};
      dsw_location where = DSW_LOCATION_NONE;
      EXPECT_EQ(dsw_environment_locate(environment, p, {0, 0}, &v, &where), DSW_STATUS_NON_FINITE);
      EXPECT_EQ(v.index, 77u);
      EXPECT_EQ(dsw_particle_create(scene.get(), p, {0, 0}, &unset), DSW_STATUS_NON_FINITE);
      EXPECT_EQ(unset.index, 77u);
      dsw_cell cell;
      EXPECT_EQ(dsw_environment_classify(environment, p, grid.place.world->ids[0], &cell), DSW_STATUS_NON_FINITE);
      const double both[6] = {1.5, 1.5, 1.5, p[0], p[1], p[2]};
      dsw_particle_id two[2];
      size_t offender = 77;
      EXPECT_EQ(dsw_scene_create_particles(scene.get(), both, 2, 0, nullptr, two, &offender), DSW_STATUS_NON_FINITE);
      EXPECT_EQ(offender, 1u);
      EXPECT_EQ(dsw_scene_move_particles(scene.get(), &particle, 1, both + 3, 0, nullptr, &flight),
                DSW_STATUS_NON_FINITE);
    }
  }
  size_t count = 0;
  ASSERT_EQ(dsw_scene_get_particle_count(scene.get(), &count), DSW_STATUS_OK);
  EXPECT_EQ(count, 1u);
  double position[3];
  dsw_volume_id volume;
  ASSERT_EQ(dsw_particle_get_position(scene.get(), particle, position, &volume), DSW_STATUS_OK);
  EXPECT_EQ(hex(position), hex(at));
  EXPECT_TRUE(same(volume, grid.place.world->ids[0]));
}

// --- a million cells ----------------------------------------------------------------------------------------------

constexpr uint32_t kLong = 1000000;

/// A row of unit cubes along x, or of wedges (each cube cut in two).
EnvironmentPtr row(bool wedges) {
  std::vector<double> points;
  for (uint32_t i = 0; i <= kLong; ++i) {
    for (int j = 0; j < 4; ++j) {
      points.push_back(i);
      points.push_back(j == 1 || j == 2 ? 1 : 0);
      points.push_back(j >= 2 ? 1 : 0);
    }
  }
  std::vector<int32_t> cells;
  for (uint32_t i = 0; i < kLong; ++i) {
    const auto a = static_cast<int32_t>(4 * i), b = a + 4;
    // x runs from a to b; seen from b, a's corners 0 1 2 3 turn counter-clockwise (y to the right, z up).
    if (wedges) {
      for (int32_t v : {a + 0, a + 2, a + 1, b + 0, b + 2, b + 1, a + 0, a + 3, a + 2, b + 0, b + 3, b + 2})
        cells.push_back(v);
    } else {
      for (int32_t v : {a, a + 1, a + 2, a + 3, b, b + 1, b + 2, b + 3}) cells.push_back(v);
    }
  }
  dsw_environment_desc desc =
      uniform_desc(3, wedges ? DSW_CELL_TYPE_WEDGE : DSW_CELL_TYPE_HEXAHEDRON, wedges ? 6 : 8, points, cells);
  desc.flags = DSW_ENVIRONMENT_LOCATE_TREE;
  return create_from(desc);
}

TEST(AdversarialLongTest, AMillionHexahedraInOneFlight) {
  const EnvironmentPtr environment = row(false);
  ASSERT_NE(environment, nullptr);
  const double last = kLong - 0.5;
  const double rows[][2][3] = {
      {{0.5, 0.5, 0.5}, {last, 0.5, 0.5}},                                   // through the middles of the faces
      {{0.5, 0.25, 0.75}, {last, 0.75, 0.25}}, {{0.5, 0, 0}, {last, 0, 0}},  // along an edge of all of them
      {{0, 0.5, 0}, {kLong - 1.0, 0.5, 0}},                                  // along faces, from face to face
      {{0, 0, 0}, {kLong - 1.0, 0.5, 0.5}},
  };
  for (const auto& r : rows) {
    dsw_flight flight;
    ASSERT_EQ(dsw_environment_cast(environment.get(), {0, 0}, r[0], r[1], nullptr, &flight), DSW_STATUS_OK);
    EXPECT_EQ(flight.outcome, DSW_OUTCOME_REACHED) << hex(r[0]);
    EXPECT_EQ(flight.volumes_visited, kLong);
    EXPECT_EQ(flight.volume.index, kLong - 1);
  }
  // Back, and out at the near end: the time is exactly known.
  const double from[3] = {last, 0.5, 0.5}, to[3] = {-last, 0.5, 0.5};
  dsw_flight flight;
  ASSERT_EQ(dsw_environment_cast(environment.get(), {0, 0}, from, to, nullptr, &flight), DSW_STATUS_OK);
  EXPECT_EQ(flight.outcome, DSW_OUTCOME_CONTACT);
  EXPECT_EQ(flight.time, 0.5);
  EXPECT_EQ(flight.volume.index, 0u);
  EXPECT_EQ(flight.volumes_visited, kLong);
  EXPECT_EQ(flight.contact.normal[0], 1);
  // Every crossing: at exactly i in x, so at the floor of (i - 1/2) / (last - 1/2).
  std::vector<dsw_crossing> crossings(kLong);
  size_t count = 0;
  ASSERT_EQ(dsw_environment_cast_path(environment.get(), {0, 0}, rows[0][0], rows[0][1], nullptr, crossings.data(),
                                      kLong, &count, nullptr),
            DSW_STATUS_OK);
  ASSERT_EQ(count, kLong);
  size_t wrong = 0;
  for (uint32_t i = 0; i < kLong; ++i) {
    const double time =
        i == 0 ? 0 : floor_to_double(Big(2 * static_cast<unsigned long>(i) - 1), Big(2 * (kLong - 1ul)));
    wrong += crossings[i].volume.index != i || crossings[i].time != time;
  }
  EXPECT_EQ(wrong, 0u);
  // A work limit in the middle of it.
  dsw_cast_options options = defaults(dsw_cast_options_init);
  options.max_volumes = 1000;
  ASSERT_EQ(dsw_environment_cast(environment.get(), {0, 0}, rows[0][0], rows[0][1], &options, &flight), DSW_STATUS_OK);
  EXPECT_EQ(flight.outcome, DSW_OUTCOME_WORK_LIMIT);
  EXPECT_EQ(flight.volumes_visited, 1000u);
  EXPECT_EQ(flight.volume.index, 999u);
}

TEST(AdversarialLongTest, AMillionPairsOfWedgesInOneFlight) {
  const EnvironmentPtr environment = row(true);
  ASSERT_NE(environment, nullptr);
  // In the plane between the wedges of every pair, then crossing it once, half way.
  const double along[2][3] = {{0.5, 0.5, 0.5}, {kLong - 0.5, 0.5, 0.5}};
  const double across[2][3] = {{0.5, 0.25, 0.75}, {kLong - 0.5, 0.75, 0.25}};
  dsw_flight flight;
  ASSERT_EQ(dsw_environment_cast(environment.get(), {0, 0}, along[0], along[1], nullptr, &flight), DSW_STATUS_OK);
  EXPECT_EQ(flight.outcome, DSW_OUTCOME_REACHED);
  EXPECT_EQ(flight.volumes_visited, kLong);
  ASSERT_EQ(dsw_environment_cast(environment.get(), {0, 0}, across[0], across[1], nullptr, &flight), DSW_STATUS_OK);
  EXPECT_EQ(flight.outcome, DSW_OUTCOME_REACHED);
  EXPECT_EQ(flight.volumes_visited, kLong + 1);
  EXPECT_EQ(flight.volume.index / 2, kLong - 1);
}

TEST(AdversarialLongTest, AMillionStepsAgainstAWall) {
  Rng rng(9);
  Mesh mesh = hex_grid(axis(3, 16), axis(3, 16), axis(3, 16));
  for (Vec& p : mesh.points) {
    for (double& x : p) x += rng.range(-3, 3);
  }
  Place place = place_of(std::move(mesh));
  ASSERT_PLACE(place);
  World& world = *place.world;
  for (size_t f = 0; f < world.faces.size(); f += 4) {
    world.faces[f].marked = true;
    const dsw_face_id id = face_id(world, static_cast<int>(f));
    ASSERT_EQ(dsw_environment_mark_faces(place.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  const ScenePtr scene = make_scene(place.get());
  const double start[3] = {24, 24, 24};
  dsw_particle_id particle;
  ASSERT_EQ(dsw_particle_create(scene.get(), start, {0, 0}, &particle), DSW_STATUS_OK);
  Vec p = {24, 24, 24}, push = {1, 0.3, -0.2};
  uint64_t steps = 0, free_steps = 0, kept = 0, contacts = 0, moved = 0;
  dsw_volume_id old_volume;
  ASSERT_EQ(dsw_particle_get_position(scene.get(), particle, nullptr, &old_volume), DSW_STATUS_OK);
  for (; steps < 1000000; ++steps) {
    if (steps % 50000 == 0) push = {rng.range(-1, 1), rng.range(-1, 1), rng.range(-1, 1)};
    // Pressed on, jittering on all scales from one unit in the last place upwards.
    const double scale = std::ldexp(1.0, -static_cast<int>(rng.below(50)));
    Vec target;
    for (size_t k = 0; k < 3; ++k) target[k] = p[k] + 0.5 * push[k] * rng.unit() + scale * rng.range(-1, 1);
    dsw_flight flight;
    ASSERT_EQ(dsw_particle_move(scene.get(), particle, target.data(), nullptr, &flight), DSW_STATUS_OK);
    contacts += flight.outcome == DSW_OUTCOME_CONTACT;
    Vec reached;
    dsw_volume_id volume;
    ASSERT_EQ(dsw_particle_get_position(scene.get(), particle, reached.data(), &volume), DSW_STATUS_OK);
    moved += reached != p;
    const BodyPoint from = world.body(p.data()), to = world.body(reached.data());
    kept += world.contains(static_cast<int>(volume.index), to);
    // The whole way is checked every tenth time, the end every time.
    if (steps % 10 == 0 || flight.outcome != DSW_OUTCOME_REACHED) {
      const Walk way = world.cast(from, to, static_cast<int>(old_volume.index));
      free_steps += way.outcome == Walk::kReached && way.cell == static_cast<int>(volume.index);
    } else {
      ++free_steps;
    }
    p = reached;
    old_volume = volume;
  }
  EXPECT_EQ(free_steps, steps) << "a move passed something impassable";
  EXPECT_EQ(kept, steps) << "the recorded volume did not hold the particle";
  EXPECT_GT(contacts, steps / 10);
  EXPECT_GT(moved, steps / 10);
}

}  // namespace
}  // namespace dsw::oracle
