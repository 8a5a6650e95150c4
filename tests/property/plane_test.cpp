// Particles in a large triangulation of the plane: what a short move costs, and that threads do not matter.

#include "plane_support.h"
#include "threads.h"

#include <cmath>
#include <cstring>

namespace {

using namespace dsw::oracle;

/// Particles spread over a grid, and their walk in steps of one length.
struct Course {
  EnvironmentPtr environment;
  ScenePtr scene;
  std::vector<dsw_particle_id> particles;
  std::vector<dsw_flight> flights;
  Rng rng{7};

  Course(uint32_t n, size_t count, dsw_context* context) : environment(make_squares(n, true, context)) {
    dsw_scene_desc desc = defaults(dsw_scene_desc_init);
    desc.features = DSW_FEATURE_STATISTICS;
    dsw_scene* made = nullptr;
    EXPECT_EQ(dsw_scene_create(environment.get(), &desc, &made), DSW_STATUS_OK);
    scene.reset(made);
    std::vector<double> places;
    for (size_t i = 0; i < 2 * count; ++i) places.push_back(rng.range(0.01, n - 0.01));
    particles.resize(count);
    flights.resize(count);
    EXPECT_EQ(dsw_scene_create_particles(made, places.data(), count, 0, nullptr, particles.data(), nullptr),
              DSW_STATUS_OK);
  }

  void step(double length) {
    std::vector<double> targets(2 * particles.size());
    dsw_scene_get_particle_positions(scene.get(), particles.data(), particles.size(), targets.data(), 0, nullptr);
    for (size_t i = 0; i < targets.size(); i += 2) {
      const double angle = rng.range(0, 6.28);
      targets[i] += length * std::cos(angle);
      targets[i + 1] += length * std::sin(angle);
    }
    EXPECT_EQ(dsw_scene_move_particles(scene.get(), particles.data(), particles.size(), targets.data(), 0, nullptr,
                                       flights.data()),
              DSW_STATUS_OK);
  }

  dsw_statistics statistics() const {
    dsw_statistics s{};
    s.struct_size = sizeof s;
    EXPECT_EQ(dsw_scene_get_statistics(scene.get(), &s), DSW_STATUS_OK);
    return s;
  }
};

TEST(Plane, AShortMoveTakesFewTests) {
  Course course(60, 4000, nullptr);
  for (int i = 0; i < 5; ++i) course.step(0.2);
  const dsw_statistics s = course.statistics();
  const double tests = static_cast<double>(s.orientation_tests) / static_cast<double>(s.casts);
  const double cells = static_cast<double>(s.volumes_visited) / static_cast<double>(s.casts);
  RecordProperty("tests_per_cast", std::to_string(tests));
  RecordProperty("cells_per_cast", std::to_string(cells));
  EXPECT_LE(tests, 4) << "at " << cells << " cells";
  EXPECT_GT(cells, 1.2);
}

/// A record of 24 bytes, and half a vertex of 16; a rim has a few vertices more.
TEST(Plane, TrianglesTakeLessThanFortyBytes) {
  const EnvironmentPtr environment = make_squares(300, true);
  dsw_environment_info info{};
  info.struct_size = sizeof info;
  ASSERT_EQ(dsw_environment_get_info(environment.get(), &info), DSW_STATUS_OK);
  const uint64_t least = 24 * uint64_t{info.volume_count} + 16 * uint64_t{info.vertex_count};
  EXPECT_LE(info.memory_bytes, least + 4096) << "nothing else is kept for each triangle";
  RecordProperty("bytes_per_triangle",
                 std::to_string(static_cast<double>(info.memory_bytes) / static_cast<double>(info.volume_count)));
}

TEST(Plane, ThreadsDoNotMatter) {
  Shuffler shuffler;
  shuffler.threads = 3;
  const ContextPtr contexts[2] = {context_with(1, nullptr), context_with(3, &shuffler)};
  std::vector<dsw_flight> flights[2];
  dsw_statistics statistics[2];
  for (int k = 0; k < 2; ++k) {
    Course course(30, 5000, contexts[k].get());
    for (int i = 0; i < 3; ++i) course.step(6);
    flights[k] = course.flights;
    statistics[k] = course.statistics();
  }
  EXPECT_EQ(std::memcmp(flights[0].data(), flights[1].data(), flights[0].size() * sizeof(dsw_flight)), 0);
  EXPECT_EQ(std::memcmp(&statistics[0], &statistics[1], sizeof statistics[0]), 0);
  EXPECT_GT(shuffler.calls, 0u);
}

}  // namespace
