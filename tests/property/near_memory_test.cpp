// What near rows remember from call to call changes nothing: a body that has moved for long has the rows of a new one.
#include "body_state.h"
#include "obstacles.h"
#include "support.h"

#include <cstring>

namespace dsw::oracle {
namespace {

class NearMemoryTest : public SceneTest {};
DSW_FOR_ALL_SCENES(NearMemoryTest);

std::vector<dsw_near_row> rows_of_call(dsw_scene* scene, dsw_body_id body, double margin) {
  dsw_near_options options = defaults(dsw_near_options_init);
  options.margin = margin;
  size_t count = 0;
  const dsw_near_row* rows = nullptr;
  EXPECT_EQ(dsw_body_find_near_rows(scene, body, &options, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(dsw_body_get_near_rows(scene, body, &rows, &count), DSW_STATUS_OK);
  std::vector<dsw_near_row> found(rows, rows + count);
  for (dsw_near_row& row : found) row.previous = UINT32_MAX;
  return found;
}

bool are_same(const std::vector<dsw_near_row>& a, const std::vector<dsw_near_row>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

Vec way_between(const Vec& from, const Vec& to) { return {to[0] - from[0], to[1] - from[1], to[2] - from[2]}; }
Vec shifted(const Vec& at, const Vec& way) { return {at[0] + way[0], at[1] + way[1], at[2] + way[2]}; }

/// A chain or a strip of triangles from a free place, of `links` steps of about `link`.
BodyPlan long_plan(Motions& motions, Rng& rng, size_t links, double link) {
  BodyPlan plan;
  plan.at.push_back(motions.start());
  // In a flat scene a place must lie between two points of the scene to lie in it.
  const bool is_straight = rng.chance(0.3);
  const Vec to = is_straight ? motions.start() : motions.near(plan.at[0], link);
  const Vec way = way_between(plan.at[0], to);
  for (size_t i = 0; i < links; ++i) {
    const Vec& last = plan.at.back();
    plan.at.push_back(is_straight ? between(last, to, link) : motions.near(shifted(last, way), 0.3 * link));
  }
  const bool is_strip = rng.chance(0.3);
  for (uint32_t i = 0; i < links; ++i) {
    if (!is_strip) plan.edges.push_back({i, i + 1});
    if (is_strip && i + 1 < links) plan.faces.push_back({i, i + 1, i + 2});
  }
  return plan;
}

TEST_P(NearMemoryTest, ChangesNothing) {
  size_t rows_seen = 0;
  for (uint64_t seed = 71; seed < 71 + static_cast<uint64_t>(effort_of(1)); ++seed) {
    size_t bodies = 0;
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    World& world = *place.world;
    Rng rng(seed);
    Motions motions(world, rng);
    const Obstacles obstacles(place, rng);
    const ScenePtr scene = make_scene(place.get()), other = make_scene(place.get());
    constexpr size_t kMost = 40;
    for (int i = 0; i < 1000 && bodies < kMost; ++i) {
      const double link = std::pow(10, rng.range(-3, -1));
      const BodyPlan plan = long_plan(motions, rng, 2 + rng.below(17), link);
      const dsw_level level = std::array{DSW_LEVEL_POINTS, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}[rng.below(3)];
      dsw_body_id body;
      if (!std::all_of(plan.at.begin(), plan.at.end(), finite)) continue;
      if (create_body(scene.get(), plan, level, 0, {}, &body) != DSW_STATUS_OK) continue;
      ++bodies;
      const double margin = world.size * link * std::pow(2, rng.range(-2, 1));
      const double step = link * std::pow(10, rng.range(-2.5, -0.5));
      for (int round = 0; round < 24; ++round) {
        SCOPED_TRACE("seed " + std::to_string(seed) + " body " + std::to_string(i) + " round " + std::to_string(round));
        const double now = rng.chance(0.8) ? margin : rng.range(0, 2) * margin;
        const std::vector<dsw_near_row> rows = rows_of_call(scene.get(), body, now);
        BodyState state;
        ASSERT_EQ(read_body(scene.get(), body, state), "");
        BodyPlan again = plan;
        again.at = state.at;
        dsw_body_id fresh;
        ASSERT_EQ(create_body(other.get(), again, level, 0, {}, &fresh), DSW_STATUS_OK) << dsw_last_error_message();
        ASSERT_TRUE(are_same(rows, rows_of_call(other.get(), fresh, now))) << rows.size() << " rows";
        dsw_body_destroy(other.get(), fresh);
        rows_seen += rows.size();
        // Nearly always all go the same way, as a wire that is pushed does.
        const bool is_straight = rng.chance(0.3);
        const Vec to = is_straight ? between(state.at[0], motions.start(), step) : motions.near(state.at[0], step);
        const Vec way = way_between(state.at[0], to);
        std::vector<Vec> targets = state.at;
        for (Vec& t : targets) t = rng.chance(0.9) ? shifted(t, way) : motions.near(t, step);
        if (!std::all_of(targets.begin(), targets.end(), finite)) break;
        ASSERT_EQ(dsw_body_move(scene.get(), body, targets[0].data(), targets.size(), sizeof(Vec), nullptr, nullptr),
                  DSW_STATUS_OK);
      }
      dsw_body_destroy(scene.get(), body);
    }
  }
  EXPECT_GT(rows_seen, 50u);
}

/// Makes a wall of some rows passable, or some of what was opened a wall again. A face that a body passes stays open.
void change_marks(const Place& place, const std::vector<dsw_near_row>& rows, Rng& rng, std::vector<dsw_face_id>& open) {
  if (!open.empty() && rng.chance(0.4)) {
    const size_t at = rng.below(open.size());
    if (dsw_environment_mark_faces(place.get(), &open[at], 1, DSW_MARK_IMPASSABLE) == DSW_STATUS_OK) {
      open.erase(open.begin() + static_cast<ptrdiff_t>(at));
    }
  } else if (!rows.empty()) {
    const dsw_face_id wall = rows[rng.below(rows.size())].wall;
    if (dsw_environment_mark_faces(place.get(), &wall, 1, DSW_MARK_PASSABLE) == DSW_STATUS_OK) open.push_back(wall);
  }
}

TEST_P(NearMemoryTest, IsForgottenWhenMarksChange) {
  size_t rows_seen = 0, changes = 0;
  for (uint64_t seed = 171; seed < 171 + static_cast<uint64_t>(effort_of(1)); ++seed) {
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    Rng rng(seed);
    Motions motions(*place.world, rng);
    const ScenePtr scene = make_scene(place.get());
    std::vector<dsw_face_id> open;
    size_t bodies = 0;
    for (int i = 0; i < 1000 && bodies < 30; ++i) {
      const double link = std::pow(10, rng.range(-2, -0.5));
      const BodyPlan plan = long_plan(motions, rng, 2 + rng.below(9), link);
      dsw_body_id body;
      if (!std::all_of(plan.at.begin(), plan.at.end(), finite)) continue;
      if (create_body(scene.get(), plan, DSW_LEVEL_FACES, 0, {}, &body) != DSW_STATUS_OK) continue;
      ++bodies;
      const double margin = place.world->size * link * std::pow(2, rng.range(-1, 2));
      for (int round = 0; round < 8; ++round) {
        SCOPED_TRACE("seed " + std::to_string(seed) + " body " + std::to_string(i) + " round " + std::to_string(round));
        const std::vector<dsw_near_row> rows = rows_of_call(scene.get(), body, margin);
        dsw_body_id fresh;
        ASSERT_EQ(create_body(scene.get(), plan, DSW_LEVEL_FACES, 0, {}, &fresh), DSW_STATUS_OK);
        ASSERT_TRUE(are_same(rows, rows_of_call(scene.get(), fresh, margin))) << rows.size() << " rows";
        dsw_body_destroy(scene.get(), fresh);
        rows_seen += rows.size();
        const size_t before = open.size();
        change_marks(place, rows, rng, open);
        changes += open.size() != before;
      }
      dsw_body_destroy(scene.get(), body);
    }
  }
  EXPECT_GT(rows_seen, 50u);
  EXPECT_GT(changes, 5u);
}

}  // namespace
}  // namespace dsw::oracle
