// Near rows against their definition in exact arithmetic: none is missing, none is there that is not near.
#include "body_state.h"
#include "near_truth.h"
#include "obstacles.h"

#include <cstring>
#include <set>

namespace dsw::oracle {
namespace {

class NearRowsTest : public SceneTest {};
DSW_FOR_ALL_SCENES(NearRowsTest);

std::vector<dsw_near_row> find_rows(dsw_scene* scene, dsw_body_id body, double margin, double radius,
                                    uint32_t flags = 0) {
  dsw_near_options options = defaults(dsw_near_options_init);
  options.margin = margin;
  options.radius = radius;
  options.flags = flags;
  size_t found = 0, count = 0;
  const dsw_near_row* rows = nullptr;
  EXPECT_EQ(dsw_body_find_near_rows(scene, body, &options, &found), DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(dsw_body_get_near_rows(scene, body, &rows, &count), DSW_STATUS_OK);
  EXPECT_EQ(found, count);
  return std::vector<dsw_near_row>(rows, rows + count);
}

std::vector<int> used(const uint32_t* vertices) {
  std::vector<int> ids;
  for (int i = 0; i < 3 && vertices[i] != UINT32_MAX; ++i) ids.push_back(static_cast<int>(vertices[i]));
  std::sort(ids.begin(), ids.end());
  return ids;
}

struct Tally {
  uint64_t rows = 0, missed = 0, phantom = 0, hidden = 0;
};

/// What the points of a row must be, up to rounding. `size`: the largest coordinate.
void check_numbers(const dsw_near_row& row, const NearTruth::Row& truth, double size) {
  const double bound = 0x1p-44 * size;
  EXPECT_NEAR(row.distance, truth.distance, bound);
  double length = 0, way = 0, along = 0;
  for (int k = 0; k < 3; ++k) {
    const double w = row.point[k] - row.obstacle_point[k];
    length += row.normal[k] * row.normal[k];
    way += w * w;
    along += w * row.normal[k];
  }
  EXPECT_NEAR(length, 1, 1e-14);
  EXPECT_NEAR(std::sqrt(way), truth.distance, bound);
  EXPECT_NEAR(along, truth.distance, bound);
  double sum = 0, obstacle_sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum += row.weights[i];
    obstacle_sum += row.obstacle_weights[i];
    EXPECT_GE(row.weights[i], 0);
    EXPECT_GE(row.obstacle_weights[i], 0);
  }
  EXPECT_NEAR(sum, 1, 1e-14);
  EXPECT_NEAR(obstacle_sum, 1, 1e-14);
}

/// Rows with the environment, part by part.
void check_walls(const std::vector<dsw_near_row>& rows, const BodyState& state, const NearTruth& truth, double limit,
                 dsw_level level, double size, Tally& tally) {
  std::map<std::pair<std::vector<int>, std::vector<int>>, const dsw_near_row*> by_ids;
  for (const dsw_near_row& row : rows) {
    if (row.body.generation != 0) continue;
    EXPECT_TRUE(by_ids.emplace(std::pair(used(row.vertices), used(row.obstacle_vertices)), &row).second) << "twice";
  }
  const double tolerance = 0x1p-40 * size;
  const auto check = [&](std::vector<int> ids) {
    std::sort(ids.begin(), ids.end());
    std::vector<Vec> part;
    for (const int v : ids) part.push_back(state.at[static_cast<size_t>(v)]);
    NearTruth::Rows known = truth.rows_of(part, limit + tolerance);
    for (const auto& [obstacle, expected] : known) {
      const auto at = by_ids.find({ids, obstacle});
      const bool is_there = at != by_ids.end(), is_near = expected.distance <= limit;
      const bool is_sure = std::fabs(expected.distance - limit) > tolerance;
      if (is_there) {
        ++tally.rows;
        check_numbers(*at->second, expected, size);
        tally.phantom += expected.sight == NearTruth::Sight::kHidden || (is_sure && !is_near);
        EXPECT_NE(expected.sight, NearTruth::Sight::kHidden);
        by_ids.erase(at);
        continue;
      }
      if (expected.sight == NearTruth::Sight::kHidden) ++tally.hidden;
      if (!is_sure || !is_near || expected.sight != NearTruth::Sight::kClear) continue;
      ++tally.missed;
      ADD_FAILURE() << "missing: part of " << ids.size() << " with " << ids[0] << ", obstacle of " << obstacle.size()
                    << " with " << obstacle[0] << " at " << expected.distance << " of " << limit;
    }
  };
  for (size_t v = 0; v < state.at.size(); ++v) check({static_cast<int>(v)});
  for (const auto& e : state.edges) {
    if (level >= DSW_LEVEL_EDGES) check({static_cast<int>(e[0]), static_cast<int>(e[1])});
  }
  for (const auto& f : state.faces) {
    if (level == DSW_LEVEL_FACES) check({static_cast<int>(f[0]), static_cast<int>(f[1]), static_cast<int>(f[2])});
  }
  for (const auto& [ids, row] : by_ids) {
    ++tally.phantom;
    ADD_FAILURE() << "phantom: part of " << ids.first.size() << " with " << ids.first[0] << ", obstacle of "
                  << ids.second.size() << " with " << ids.second[0] << " at " << row->distance << " obstacle "
                  << row->obstacle << " point " << hex({row->point[0], row->point[1], row->point[2]});
  }
}

BodyPlan any_plan(Motions& motions, Rng& rng) {
  const double share = std::pow(10, rng.range(-3, -0.3));
  BodyPlan plan;
  plan.at.push_back(rng.chance(0.5) ? motions.start() : motions.site());
  const size_t more = 1 + rng.below(3);
  // Of flat scenes only what lies between two points of them lies in them.
  const bool flat = rng.chance(0.5);
  for (size_t i = 0; i < more; ++i) {
    const Vec& last = plan.at.back();
    plan.at.push_back(flat ? between(last, motions.start(), share) : motions.near(last, share));
  }
  if (more == 2 && rng.chance(0.6)) {
    plan.faces.push_back({0, 1, 2});
  } else {
    for (uint32_t i = 0; i < more; ++i) plan.edges.push_back({i, i + 1});
  }
  return plan;
}

TEST_P(NearRowsTest, AreAllThatAreNear) {
  Tally tally;
  for (uint64_t seed = 41; seed <= 42; ++seed) {
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    World& world = *place.world;
    Rng rng(seed);
    Motions motions(world, rng);
    const Obstacles obstacles(place, rng);
    NearTruth::Scene scene_truth;
    scene_truth.points = scene_truth.wall_points = place.mesh.points;
    obstacles.for_each_simplex([&](const dsw_cell&, std::vector<int> ids) {
      std::sort(ids.begin(), ids.end());
      scene_truth.obstacles.push_back(ids);
      if (ids.size() == 3) scene_truth.walls.push_back(ids);
    });
    double size = 0;
    for (const Vec& p : place.mesh.points) {
      for (const double x : p) size = std::max(size, std::fabs(x));
    }
    scene_truth.tolerance = 0x1p-40 * size;
    const NearTruth truth(scene_truth);
    const ScenePtr scene = make_scene(place.get());
    int made = 0;
    for (int i = 0; i < 400 && made < 25; ++i) {
      const BodyPlan plan = any_plan(motions, rng);
      if (!std::all_of(plan.at.begin(), plan.at.end(), finite)) continue;
      const dsw_level level =
          std::array{DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}[rng.below(4)];
      dsw_body_id body;
      if (create_body(scene.get(), plan, level, 0, {}, &body) != DSW_STATUS_OK) continue;
      ++made;
      const double limit = world.size * std::pow(10, rng.range(-3, -0.6)), radius = rng.chance(0.5) ? 0 : 0.3 * limit;
      for (int round = 0; round < 3; ++round) {
        BodyState state;
        ASSERT_EQ(read_body(scene.get(), body, state), "");
        SCOPED_TRACE("seed " + std::to_string(seed) + " body " + std::to_string(i) + " round " + std::to_string(round));
        check_walls(find_rows(scene.get(), body, limit - radius, radius), state, truth, limit, level, size, tally);
        if (HasFailure()) return;
        std::vector<Vec> targets = state.at;
        for (Vec& t : targets) t = motions.near(t, round == 0 ? 1e-3 : 0.05);
        if (!std::all_of(targets.begin(), targets.end(), finite)) break;
        ASSERT_EQ(dsw_body_move(scene.get(), body, targets[0].data(), targets.size(), sizeof(Vec), nullptr, nullptr),
                  DSW_STATUS_OK);
      }
      dsw_body_destroy(scene.get(), body);
    }
  }
  RecordProperty("rows", std::to_string(tally.rows));
  std::printf("%s: %llu rows, %llu hidden\n", GetParam().c_str(), static_cast<unsigned long long>(tally.rows),
              static_cast<unsigned long long>(tally.hidden));
  EXPECT_EQ(tally.missed, 0u);
  EXPECT_EQ(tally.phantom, 0u);
  EXPECT_GT(tally.rows, 100u);
}

}  // namespace
}  // namespace dsw::oracle
