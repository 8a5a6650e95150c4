// What is read of edges from a snapshot is a forecast: it is looked at before it is used.
#include "body_support.h"
#include "capi/scene_handle.h"
#include "snapshot_support.h"

namespace dsw::oracle {
namespace {

// A snapshot may name facets that are impassable, and edges that no longer pass theirs.
TEST(SequenceSnapshotTest, SequencesAreLookedAtBeforeTheyAreUsed) {
  const Place place = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(3, 1)));
  ASSERT_PLACE(place);
  const ScenePtr scene = make_scene(place.get());
  BodyPlan plan;
  plan.at = {{0.5, 0.5, 0.5}, {2.5, 0.6, 0.5}};
  plan.edges = {{0, 1}};
  dsw_body_id body;
  ASSERT_EQ(create_body(scene.get(), plan, DSW_LEVEL_EDGES, DSW_BODY_SEQUENCES, {}, &body), DSW_STATUS_OK);
  const double targets[6] = {0.6, 0.5, 0.5, 3.5, 0.6, 0.5};
  ASSERT_EQ(dsw_body_move(scene.get(), body, targets, 2, 0, nullptr, nullptr), DSW_STATUS_OK);
  const Loaded copy = load_both(saved(place.get()), saved(scene.get()));
  ASSERT_NE(copy.scene, nullptr);
  const dsw::Corridor<3>& read = dsw::capi::space(*copy.scene).bodies[body.index].body.corridors[0];
  ASSERT_TRUE(read.known() && !read.facets.empty());
  EXPECT_EQ(read.portal.version, dsw::Portal<3>::kNever);
}

}  // namespace
}  // namespace dsw::oracle
