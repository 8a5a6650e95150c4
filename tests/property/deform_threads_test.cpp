// Casts on many threads through volumes of which nobody knows yet whether they are valid.
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
  for (int i = 0; i < 3000; ++i) {
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
    ASSERT_EQ(dsw_scene_deform(scene.get(), next.data(), next.size() / 3, nullptr, nullptr), DSW_STATUS_OK);
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
  for (const dsw_flight& f : flights[1]) stopped += f.obstacle == DSW_CELL_VOLUME ? 1 : 0;
  EXPECT_GT(stopped, 20u);
}

}  // namespace
}  // namespace dsw::oracle
