// What bodies know of obstacles, after changes that were refused: it is asked inside.
#include <algorithm>

#include "body_support.h"
#include "capi/scene_handle.h"

namespace dsw::oracle {
namespace {

class RefusedChangeTest : public BodyTest {};

/// Balls that are free around vertices are known of the obstacles there are, not of those in a call that fails.
TEST_F(RefusedChangeTest, RefusedChangesLeaveWhatBodiesKnow) {
  const dsw_body_id body =
      make({{{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}}, {{0, 1}}, {}}, DSW_LEVEL_EDGES, DSW_BODY_SKIP_BY_CLEARANCE);
  const auto learn = [&] {
    for (int i = 0; i < 400; ++i) {
      const double by = i % 2 == 0 ? 0.01 : 0;
      const double targets[6] = {0.5 + by, 0.5, 0.5, 1.5 + by, 0.5, 0.5};
      ASSERT_EQ(dsw_body_move(scene(), body, targets, 2, 0, nullptr, nullptr), DSW_STATUS_OK);
    }
  };
  const auto known = [&] {
    const Array<Clearance<3>>& balls = dsw::capi::space(*scene()).bodies[body.index].body.clearances;
    return std::count_if(balls.begin(), balls.end(), [&](const Clearance<3>& ball) {
      return ball.radius > 0 && ball.version == dsw::capi::space(*place_.get()).obstacle_version;
    });
  };
  ASSERT_EQ(dsw_environment_unsew_face(place_.get(), face_between(2, 2, 2)), DSW_STATUS_OK);  // tables are made
  ASSERT_EQ(known(), 0);
  learn();
  const auto before = known();
  ASSERT_GT(before, 0);
  const dsw_volume_id volume = cube(0, 0, 0);
  const dsw_face_id face = face_between(0, 0, 0);
  EXPECT_EQ(dsw_environment_unsew_face(place_.get(), face), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(known(), before) << "a change of the topology";
  EXPECT_EQ(dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(known(), before) << "a mark of a face";
  EXPECT_EQ(dsw_environment_mark_volumes(place_.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr),
            DSW_STATUS_OCCUPIED);
  EXPECT_EQ(known(), before) << "a mark of a volume";
}

}  // namespace
}  // namespace dsw::oracle
