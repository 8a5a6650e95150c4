// Pressed bodies with further passes and with walls that are kept: free, counted, and farther on their ways.
#include "body_support.h"

#include <random>
#include <set>

namespace dsw::oracle {
namespace {

class FurtherPassesTest : public BodyTest {
 protected:
  void SetUp() override {
    BodyTest::SetUp();
    for (const auto& [x, y] : {std::pair{1u, 1u}, {2u, 1u}, {1u, 3u}, {3u, 2u}}) {
      for (uint32_t z = 0; z < 3; ++z) mark_volume(cube(x, y, z));
    }
    mark_edge(2, 3, 1);
  }

  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// A polyline of short edges from a place that is free.
  BodyPlan line() {
    BodyPlan plan;
    Vec at = {number(0, 1), number(0, 4), number(0, 3)};
    for (uint32_t v = 0; v < 8; ++v) {
      plan.at.push_back(at);
      if (v > 0) plan.edges.push_back({v - 1, v});
      for (size_t k = 0; k < 3; ++k) at[k] = std::min(std::max(at[k] + number(-0.4, 0.4), 0.01), k == 2 ? 2.99 : 3.99);
    }
    return plan;
  }

  /// Moves a body; @return what is left of all ways.
  double press(const BodyPlan& plan, dsw_level level, const std::vector<Vec>& targets,
               const dsw_move_options& options) {
    const dsw_body_id body = make(plan, level, flags_);
    BodyAnswer answer;
    EXPECT_EQ(move_body(scene(), body, targets, &options, answer), "");
    double left = 0;
    uint32_t stopped = 0;
    for (size_t v = 0; v < targets.size(); ++v) {
      double square = 0;
      for (size_t k = 0; k < 3; ++k) square += std::pow(targets[v][k] - answer.after.at[v][k], 2);
      left += std::sqrt(square);
      stopped += square > 0 ? 1 : 0;
    }
    EXPECT_EQ(answer.report.vertices_stopped, stopped);
    if (options.passes != 0) expect_no_repeats(answer.contacts);
    // To be created in the same place it has to be free.
    BodyPlan now = plan;
    now.at = answer.after.at;
    EXPECT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
    EXPECT_EQ(dsw_body_destroy(scene(), make(now, level, flags_)), DSW_STATUS_OK);
    return left;
  }

  static void expect_no_repeats(const std::vector<dsw_body_contact>& contacts) {
    std::set<std::vector<uint32_t>> seen;
    for (const dsw_body_contact& c : contacts) {
      const dsw_cell& met = c.contact.obstacle;
      const uint32_t kind = met.kind;
      if (met.kind == DSW_CELL_NONE) continue;  // with a body
      EXPECT_TRUE(seen.insert({c.vertex.index, c.edge.index, c.edge.generation, met.index, met.local, kind}).second);
    }
  }

  /// Moves random bodies with and without further passes, which leave at most `share` of what is left without.
  void press_all(double share);

  std::mt19937 random_{static_cast<uint32_t>(seed_of(20))};
  uint32_t flags_ = 0;  // of bodies
};

void FurtherPassesTest::press_all(double share) {
  dsw_move_options usual = defaults(dsw_move_options_init);
  usual.vertex_response = usual.edge_response = DSW_RESPONSE_SLIDE;
  dsw_move_options more = usual;
  more.flags = DSW_MOVE_KEEP_WALLS;
  more.passes = 8;
  double left = 0, left_with_passes = 0;
  int moves = 0;
  for (int i = 0; i < at_least(400); ++i) {
    const dsw_level level = i % 2 == 0 ? DSW_LEVEL_EDGES : DSW_LEVEL_EDGES_SWEPT;
    const BodyPlan plan = line();
    dsw_body_id probe = {0, 0};
    if (create_body(scene(), plan, level, flags_, {}, &probe) != DSW_STATUS_OK) continue;
    ASSERT_EQ(dsw_body_destroy(scene(), probe), DSW_STATUS_OK);
    const Vec way = {number(-2, 3), number(-3, 3), number(-2, 2)};
    std::vector<Vec> targets = plan.at;
    for (Vec& target : targets) {
      for (size_t k = 0; k < 3; ++k) target[k] += way[k];
    }
    left += press(plan, level, targets, usual);
    left_with_passes += press(plan, level, targets, more);
    ++moves;
  }
  EXPECT_GT(moves, 100);
  EXPECT_LT(left_with_passes, share * left);
}

TEST_F(FurtherPassesTest, BodiesAreFreeAndComeFarther) { press_all(0.95); }

TEST_F(FurtherPassesTest, BodiesThatMeetThemselvesToo) {
  scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS);
  flags_ = DSW_BODY_SELF_CONTACTS;
  press_all(0.95);
}

}  // namespace
}  // namespace dsw::oracle
