// Casts on many threads through volumes of which nobody knows yet whether they are valid.
#include "body_state.h"
#include "deform_support.h"
#include "threads.h"

#include <cstring>

namespace dsw::oracle {
namespace {

TEST(DeformThreads, FindOutTogetherWhichVolumesAreValid) {
  const Mesh mesh = hex_grid(axis(8, 1), axis(8, 1), axis(8, 1));
  std::vector<dsw_flight> flights[3];
  Rng rng(5);
  std::vector<double> from, to;
  for (int i = 0; i < at_least(3000); ++i) {
    for (int k = 0; k < 3; ++k) from.push_back(rng.range(0.5, 7.5)), to.push_back(rng.range(-1, 9));
  }
  const uint32_t threads[] = {1, 4, 4};
  for (size_t turn = 0; turn < 3; ++turn) {
    Shuffler shuffler;
    shuffler.threads = 4;
    const ContextPtr context = context_with(threads[turn], turn == 2 ? &shuffler : nullptr);
    Place place = place_of(mesh, 0, context.get());
    ASSERT_PLACE(place);
    std::vector<double> next = points_of(place.get());
    Rng folds(7);
    for (double& x : next) x += folds.chance(0.02) ? 0.9 : 0;
    ScenePtr scene = make_scene(place.get(), DSW_FEATURE_DEFORMING);
    ASSERT_EQ(
        dsw_environment_deform(dsw_scene_get_environment(scene.get()), next.data(), next.size() / 3, nullptr, nullptr),
        DSW_STATUS_OK);
    flights[turn].resize(3000);
    ASSERT_EQ(dsw_environment_cast_segments(place.get(), 3000, nullptr, from.data(), to.data(), 0, nullptr,
                                            flights[turn].data()),
              DSW_STATUS_OK);
    scene.reset();
    place.environment.reset();
  }
  for (size_t turn : {size_t{1}, size_t{2}}) {
    EXPECT_EQ(std::memcmp(flights[0].data(), flights[turn].data(), 3000 * sizeof(dsw_flight)), 0);
  }
  size_t stopped = 0;
  for (const dsw_flight& f : flights[1]) stopped += f.contact.marked_kind == DSW_CELL_VOLUME ? 1 : 0;
  EXPECT_GT(stopped, 20u);
}

/// A wall that rises under rigid tools and soft ones.
TEST(DeformThreads, PushRigidBodiesTheSameWay) {
  std::string bits[3];
  const uint32_t threads[] = {1, 4, 4};
  for (size_t turn = 0; turn < 3; ++turn) {
    Shuffler shuffler;
    shuffler.threads = 4;
    const ContextPtr context = context_with(threads[turn], turn == 2 ? &shuffler : nullptr);
    Place place = place_of(hex_grid(axis(8, 1), axis(8, 1), axis(4, 1)), 0, context.get());
    ASSERT_PLACE(place);
    ScenePtr scene = make_scene(place.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
    std::vector<dsw_body_id> bodies;
    for (int i = 0; i < 12; ++i) {
      const double x = 0.5 + 1.8 * (i % 4), y = 0.7 + 2.3 * (i / 4);
      const BodyPlan plan{{{x, y, 0.05}, {x + 1.2, y + 0.3, 0.06}, {x + 0.4, y + 0.9, 0.07}}, {{0, 1}, {1, 2}}, {}};
      bodies.push_back({0, 0});
      ASSERT_EQ(create_body(scene.get(), plan, DSW_LEVEL_EDGES_SWEPT, i % 3 == 0 ? 0u : uint32_t{DSW_BODY_RIGID}, {},
                            &bodies.back()),
                DSW_STATUS_OK);
    }
    std::vector<double> arrays[2];
    uint32_t pushed = 0;
    for (int step = 0; step < 2; ++step) {
      arrays[step] = points_of(place.get());
      for (size_t p = 0; p < 81; ++p) arrays[step][3 * p + 2] = 0.3 * (step + 1) * std::sin(static_cast<double>(p * p));
      dsw_deform_options options = defaults(dsw_deform_options_init);
      options.method = step == 0 ? DSW_DEFORM_SWEPT : DSW_DEFORM_END_STATE;
      dsw_deform_report report;
      ASSERT_EQ(dsw_environment_deform(dsw_scene_get_environment(scene.get()), arrays[step].data(),
                                       arrays[step].size() / 3, &options, &report),
                DSW_STATUS_OK);
      pushed += report.pushed_count;
    }
    EXPECT_GT(pushed, 20u);
    for (const dsw_body_id body : bodies) {
      BodyState state;
      ASSERT_EQ(read_body(scene.get(), body, state), "");
      for (const Vec& at : state.at) bits[turn] += hex(at);
    }
    scene.reset();
    place.environment.reset();  // before the arrays that it reads
  }
  EXPECT_EQ(bits[0], bits[1]);
  EXPECT_EQ(bits[0], bits[2]);
}

}  // namespace
}  // namespace dsw::oracle
