// What bodies know of obstacles, after changes that were refused: it is asked inside.
#include <algorithm>
#include <limits>

#include "body_support.h"
#include "capi/scene_handle.h"
#include "deform_support.h"
#include "snapshot_support.h"

namespace dsw::oracle {
namespace {

class RefusedChangeTest : public BodyTest {
 protected:
  /// A body that has moved until there are balls round its vertices that are known to hold nothing impassable.
  dsw_body_id learn() {
    const dsw_body_id body =
        make({{{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}}, {{0, 1}}, {}}, DSW_LEVEL_EDGES, DSW_BODY_SKIP_BY_CLEARANCE);
    EXPECT_EQ(known(body), 0);
    for (int i = 0; i < 400; ++i) {
      const double by = i % 2 == 0 ? 0.01 : 0;
      const double targets[6] = {0.5 + by, 0.5, 0.5, 1.5 + by, 0.5, 0.5};
      EXPECT_EQ(dsw_body_move(scene(), body, targets, 2, 0, nullptr, nullptr), DSW_STATUS_OK);
    }
    EXPECT_GT(known(body), 0);
    return body;
  }
  std::ptrdiff_t known(dsw_body_id body) {
    const Array<Clearance<3>>& balls = dsw::capi::space(*scene()).bodies[body.index].body.clearances;
    return std::count_if(balls.begin(), balls.end(), [&](const Clearance<3>& ball) {
      return ball.radius > 0 && ball.version == dsw::capi::space(*place_.get()).obstacle_version;
    });
  }
};

/// Balls that are free around vertices are known of the obstacles there are, not of those in a call that fails.
TEST_F(RefusedChangeTest, RefusedChangesLeaveWhatBodiesKnow) {
  ASSERT_EQ(dsw_environment_unsew_face(place_.get(), face_between(2, 2, 2)), DSW_STATUS_OK);  // tables are made
  const dsw_body_id body = learn();
  const auto before = known(body);
  const dsw_volume_id volume = cube(0, 0, 0);
  const dsw_face_id face = face_between(0, 0, 0);
  EXPECT_EQ(dsw_environment_unsew_face(place_.get(), face), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(known(body), before) << "a change of the topology";
  EXPECT_EQ(dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(known(body), before) << "a mark of a face";
  EXPECT_EQ(dsw_environment_mark_volumes(place_.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr),
            DSW_STATUS_OCCUPIED);
  EXPECT_EQ(known(body), before) << "a mark of a volume";
}

/// Points that have gone back are where they were, so what was known of obstacles is known again.
class RefusedDeformationTest : public RefusedChangeTest {
 protected:
  void SetUp() override {
    RefusedChangeTest::SetUp();
    scene_.reset();
    scene_ = make_scene(place_.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
    body_ = learn();
    next_ = points_of(place_.get());
  }
  void TearDown() override {
    scene_.reset();
    place_.environment.reset();  // before the array that it may read
  }
  dsw_status deform(dsw_deform_method method, dsw_wall_response response, dsw_invalid_response invalid) {
    options_.method = method;
    options_.response = response;
    options_.invalid = invalid;
    return dsw_environment_deform(place_.get(), next_.data(), next_.size() / 3, &options_, &report_);
  }
  dsw_status deform_together(const double* targets) {
    dsw_scene_deform_options options = defaults(dsw_scene_deform_options_init);
    options.max_work = max_work_;
    return dsw_scene_deform(scene(), next_.data(), next_.size() / 3, &body_, 1, targets, 2, 0, &options, &report_,
                            nullptr);
  }
  /// Whether a call leaves both snapshots as they are, and the balls.
  template <class Call>
  void leaves_all(const char* what, Call call) {
    const Bytes before[] = {saved(scene()), saved(place_.get())};
    const std::ptrdiff_t balls = known(body_);
    call();
    EXPECT_EQ(known(body_), balls) << what;
    EXPECT_TRUE(saved(scene()) == before[0] && saved(place_.get()) == before[1]) << what;
  }

  dsw_deform_options options_ = defaults(dsw_deform_options_init);
  uint32_t max_work_ = 0;
  dsw_deform_report report_{};
  dsw_body_id body_{};
  std::vector<double> next_;  // lent
};

/// A number that is not finite is found when points have gone on their way.
TEST_F(RefusedDeformationTest, FailuresLeaveWhatBodiesKnow) {
  next_[3 * point(2, 1, 1)] = std::numeric_limits<double>::quiet_NaN();
  for (const dsw_deform_method method : {DSW_DEFORM_SWEPT, DSW_DEFORM_END_STATE}) {
    leaves_all("a deformation",
               [&] { EXPECT_EQ(deform(method, DSW_WALL_PUSH, DSW_INVALID_HOLD), DSW_STATUS_NON_FINITE); });
  }
  leaves_all("a repair",
             [&] { EXPECT_EQ(deform(DSW_DEFORM_SWEPT, DSW_WALL_PUSH, DSW_INVALID_REMESH), DSW_STATUS_NON_FINITE); });
  const double targets[6] = {0.5, 0.625, 0.5, 1.5, 0.625, 0.5};
  leaves_all("a move together", [&] { EXPECT_EQ(deform_together(targets), DSW_STATUS_NON_FINITE); });
}

/// The volume of the body would be turned inside out.
TEST_F(RefusedDeformationTest, RefusalsLeaveWhatBodiesKnow) {
  for (uint32_t z = 0; z < 2; ++z) {
    for (uint32_t y = 0; y < 2; ++y) std::swap(next_[3 * point(0, y, z)], next_[3 * point(1, y, z)]);
  }
  for (const dsw_deform_method method : {DSW_DEFORM_SWEPT, DSW_DEFORM_END_STATE}) {
    leaves_all("a deformation", [&] {
      EXPECT_EQ(deform(method, DSW_WALL_PUSH, DSW_INVALID_REFUSE), DSW_STATUS_OK);
      EXPECT_EQ(report_.outcome, DSW_DEFORM_REFUSED);
    });
  }
}

/// The walls round the body come nearer, and it moves beside the least double.
TEST_F(RefusedDeformationTest, TheWorkLimitLeavesWhatBodiesKnow) {
  for (uint32_t i = point(0, 0, 0); i < point(0, 0, 1); ++i) next_[3 * i + 2] = 0.75;
  const double targets[6] = {5e-324, 0.5, 0.5, 1, 1e-160, 0.5};
  max_work_ = 1;
  EXPECT_EQ(deform_together(targets), DSW_STATUS_OK);
  EXPECT_EQ(report_.outcome, DSW_DEFORM_LIMITED);
  EXPECT_GT(known(body_), 0);
}

}  // namespace
}  // namespace dsw::oracle
