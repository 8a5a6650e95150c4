// Moves to targets far beyond the walls: however long the way, what stops is next to what it met, and free.
#include "body_check.h"
#include "body_support.h"
#include "space_arena.h"

#include <cfloat>

namespace dsw::oracle {
namespace {

constexpr double kSide = 4;

/// A box of 4 x 4 x 4 cubes. Everything outside is in the way.
class LongMoveTest : public testing::TestWithParam<Transform> {
 protected:
  void SetUp() override {
    Mesh mesh = hex_grid(axis(4, 1), axis(4, 1), axis(4, 1));
    low_ = moved({0, 0, 0});
    high_ = moved({kSide, kSide, kSide});
    mesh.tags.assign(mesh.cells.size(), 7);  // compared, too
    apply_transform(mesh, GetParam());
    place_ = place_of(std::move(mesh));
    ASSERT_PLACE(place_);
    scene_ = make_scene(place_.get());
  }

  static Vec moved(const Vec& p) {
    Mesh mesh;
    mesh.points = {p};
    apply_transform(mesh, GetParam());
    return mesh.points[0];
  }
  double side() const { return high_[0] - low_[0]; }
  /// From the nearest wall.
  double gap(const Vec& p) const {
    double least = DBL_MAX;
    for (size_t k = 0; k < 3; ++k) least = std::min({least, p[k] - low_[k], high_[k] - p[k]});
    return least;
  }
  static double apart(const Vec& a, const Vec& b) {
    double most = 0;
    for (size_t k = 0; k < 3; ++k) most = std::max(most, std::fabs(a[k] - b[k]));
    return most;
  }
  /// A few units in the last place: of the target, but of the wall where that is much nearer.
  double precision(const Vec& to) const {
    double largest = 0;
    for (double x : to) largest = std::max(largest, std::fabs(x));
    if (largest > 1024 * std::fabs(high_[0])) largest = std::fabs(high_[0]);
    return 8 * (std::nextafter(largest, INFINITY) - largest);
  }

  /// A few times as far away as the box is wide, then further and further.
  template <class Visit>
  void for_each_target(const Vec& from, const Vec& direction, Visit visit) {
    double way = 8 * side();
    for (const double next :
         {1e3, 1e6, 1e8, 1e12, 1e14, 1e15, 1e16, 1e17, 1e20, 1e50, 1e99, 1e150, 1e220, 1e300, DBL_MAX, 0.0}) {
      Vec to = from;
      for (size_t k = 0; k < 3; ++k) to[k] += way * direction[k];
      visit(to);
      way = std::max(way, next);
    }
  }
  /// Such targets in many directions.
  template <class Visit>
  void for_each_way(Visit visit) {
    const Vec directions[] = {{1, 0, 0}, {0, -1, 0}, {1, 1, 1}, {-1, 0.5, 0.25}, {0.3, -0.7, 0.9}, {1e-3, -1, 0.02}};
    for (const Vec& start : {Vec{1.5, 1.5, 1.5}, Vec{0.3, 2.7, 3.1}, Vec{1, 2, 0.125}}) {
      const Vec from = moved(start);
      for (const Vec& direction : directions) {
        std::vector<Vec> targets;
        for_each_target(from, direction, [&](const Vec& to) { targets.push_back(to); });
        SCOPED_TRACE(hex(from) + " along " + hex(direction));
        visit(from, targets);
      }
    }
  }

  Place place_;
  ScenePtr scene_;
  Vec low_, high_;
};

TEST_P(LongMoveTest, AParticleStopsNextToTheWall) {
  Report report;
  report.begin("box", "box");
  Checker checker(*place_.world, place_.get(), report);
  for_each_way([&](const Vec& from, const std::vector<Vec>& targets) {
    Vec last = from;
    for (size_t i = 0; i < targets.size(); ++i) {
      const Vec& to = targets[i];
      dsw_particle_id particle;
      ASSERT_EQ(dsw_particle_create(scene_.get(), from.data(), {0, 0}, &particle), DSW_STATUS_OK);
      checker.move(scene_.get(), particle, to, 0, false);
      Vec position;
      ASSERT_EQ(dsw_particle_get_position(scene_.get(), particle, position.data(), nullptr), DSW_STATUS_OK);
      ASSERT_EQ(dsw_particle_destroy(scene_.get(), particle), DSW_STATUS_OK);
      EXPECT_LE(gap(position), precision(to)) << "to " << hex(to);
      if (i > 0) {
        EXPECT_LE(apart(position, last), precision(to) + precision(targets[i - 1])) << "to " << hex(to);
      }
      last = position;
    }
  });
  EXPECT_EQ(report.total.mismatches + report.total.lost + report.total.stuck, 0u);
}

/// Moves the first vertex of new bodies and has the oracle judge it.
class LongBodyMoves {
 public:
  LongBodyMoves(Place& place, dsw_scene* scene, const std::vector<std::array<int, 2>>& marked_edges)
      : scene_(scene), arena_(*place.world, marked_edges), checker_(arena_, report_) {
    report_.begin("box", "box");
  }

  void move(const BodyPlan& plan, const Vec& to, dsw_level level, double stand_off, BodyAnswer& answer) {
    dsw_body_id body;
    ASSERT_EQ(create_body(scene_, plan, level, 0, {}, &body), DSW_STATUS_OK) << dsw_last_error_message();
    BodyState before;
    ASSERT_EQ(read_body(scene_, body, before), "");
    BodyMove move;
    move.order = {0};
    move.targets = plan.at;
    move.targets[0] = to;
    dsw_move_options options = defaults(dsw_move_options_init);
    options.order = move.order.data();
    options.order_count = 1;
    options.stand_off = stand_off;
    ASSERT_EQ(move_body(scene_, body, move.targets, &options, answer), "");
    checker_.replay(before, move, level, answer, "to " + hex(to));
    ASSERT_EQ(dsw_body_destroy(scene_, body), DSW_STATUS_OK);
    ASSERT_EQ(answer.contacts.size(), 1u);
    EXPECT_EQ(report_.total.faults() + report_.total.stuck, 0u);
  }

 private:
  SweepReport report_;
  dsw_scene* scene_;
  SpaceArena arena_;
  BodyChecker checker_;
};

TEST_P(LongMoveTest, ABodyStopsNextToTheWall) {
  LongBodyMoves moves(place_, scene_.get(), {});
  dsw_level level = DSW_LEVEL_POINTS;
  for_each_way([&](const Vec& from, const std::vector<Vec>& targets) {
    BodyPlan plan = {{from, from, from, from}, {}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    for (size_t k = 0; k < 3; ++k) plan.at[k + 1][k] += side() / 16;
    for (const Vec& to : targets) {
      level = static_cast<dsw_level>(level % 4 + 1);
      for (const double stand_off : {-1.0, 0.0}) {
        BodyAnswer answer;
        ASSERT_NO_FATAL_FAILURE(moves.move(plan, to, level, stand_off, answer));
        const double kept = stand_off < 0 ? 0 : 1e-9 * side() / kSide;
        EXPECT_LE(gap(answer.after.at[0]), 1.001 * kept + precision(to)) << "to " << hex(to);
        EXPECT_GE(gap(answer.after.at[0]), 0.999 * kept - precision(to)) << "to " << hex(to);
      }
    }
  });
}

TEST_P(LongMoveTest, AnEdgeStopsNextToAMarkedEdge) {
  const int ends[2] = {2 + 5 * (2 + 5 * 1), 2 + 5 * (2 + 5 * 2)};  // from (2, 2, 1) to (2, 2, 2)
  const uint32_t named[2] = {static_cast<uint32_t>(ends[0]), static_cast<uint32_t>(ends[1])};
  dsw_edge_id edge;
  ASSERT_EQ(dsw_environment_find_edges(place_.get(), 1, named, &edge, nullptr), DSW_STATUS_OK);
  ASSERT_EQ(dsw_environment_mark_edges(place_.get(), &edge, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  LongBodyMoves moves(place_, scene_.get(), {{ends[0], ends[1]}});
  const Vec from = moved({1.5, 1.25, 1.5}), fixed = moved({2.25, 2.75, 1.5});
  for_each_target(from, {1, -0.25, 0.01}, [&](const Vec& to) {
    for (dsw_level level : {DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
      BodyAnswer answer;
      ASSERT_NO_FATAL_FAILURE(moves.move(segment(from, fixed), to, level, -1, answer));
      EXPECT_EQ(answer.contacts[0].contact.kind, DSW_CONTACT_EDGE);
      // A way too long for a time has its contact at time 0, where it starts.
      if (answer.contacts[0].time < DBL_MIN) continue;
      const Vec position = {answer.contacts[0].position[0], answer.contacts[0].position[1],
                            answer.contacts[0].position[2]};
      EXPECT_LE(apart(answer.after.at[0], position), precision(to)) << "to " << hex(to);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(All, LongMoveTest,
                         testing::Values(Transform::kNone, Transform::kFar, Transform::kLarge, Transform::kSmall,
                                         Transform::kPower));

}  // namespace
}  // namespace dsw::oracle
