// Batches: the same bits as one call at a time, for any number of threads and any order of tasks.
#include "threads.h"

namespace dsw::oracle {
namespace {

struct Answers {
  std::vector<std::string> lines;
  dsw_statistics statistics;
};

/// Batches are shared out in chunks of 256: by the library's own threads from 2048 calls on, by a host's always. Two
/// thirds of the points are inside.
constexpr size_t kOwnThreads = 3300, kHostsThreads = 600;

template <class Answer>
std::string bytes_of(const Answer& answer) {
  return {reinterpret_cast<const char*>(&answer), sizeof answer};
}

/// Everything that goes through the parallel-for, on one environment made with `context`. Its tree of cells is made at
/// need. @param one_by_one whether each call is also made alone, which has to answer the same.
Answers answers(const std::string& name, dsw_context* context, size_t calls, bool one_by_one) {
  Answers out;
  Place place = make_place(name, 81, 0, context);
  EXPECT_NE(place.environment, nullptr);
  if (place.environment == nullptr) return out;
  World& world = *place.world;
  Rng rng(81);
  for (size_t f = 0; f < world.faces.size(); ++f) {
    if (!rng.chance(0.1)) continue;
    const dsw_face_id id = face_id(world, static_cast<int>(f));
    EXPECT_EQ(dsw_environment_mark_faces(place.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  Motions motions(world, rng);
  std::vector<double> from, to;
  for (size_t i = 0; i < calls; ++i) {
    const Vec p = motions.start(), q = motions.target(p);
    from.insert(from.end(), p.begin(), p.end());
    to.insert(to.end(), q.begin(), q.end());
  }
  std::vector<dsw_volume_id> volumes(calls);
  std::vector<dsw_location> locations(calls);
  EXPECT_EQ(
      dsw_environment_locate_points(place.get(), from.data(), calls, 0, nullptr, volumes.data(), locations.data()),
      DSW_STATUS_OK);
  for (size_t i = 0; i < calls; ++i) {
    out.lines.push_back(std::to_string(volumes[i].index) + "." + std::to_string(volumes[i].generation) + " " +
                        std::to_string(locations[i]));
  }
  std::vector<dsw_flight> flights(calls);
  EXPECT_EQ(
      dsw_environment_cast_segments(place.get(), calls, nullptr, from.data(), to.data(), 0, nullptr, flights.data()),
      DSW_STATUS_OK);
  for (size_t i = 0; i < calls; ++i) {
    out.lines.push_back(bits_of(flights[i]));
    if (!one_by_one) continue;
    dsw_flight one;
    EXPECT_EQ(dsw_environment_cast(place.get(), {0, 0}, from.data() + 3 * i, to.data() + 3 * i, nullptr, &one),
              DSW_STATUS_OK);
    EXPECT_EQ(bits_of(one), out.lines.back());
  }
  // Edges whose fixed ends are the next ones' moving ends.
  std::vector<dsw_sweep> sweeps(calls - 1);
  EXPECT_EQ(dsw_environment_sweep_edges(place.get(), calls - 1, nullptr, from.data(), to.data(), from.data() + 3, 0,
                                        nullptr, sweeps.data()),
            DSW_STATUS_OK);
  for (size_t i = 0; i + 1 < calls; ++i) {
    out.lines.push_back(bits_of(sweeps[i]));
    if (!one_by_one) continue;
    dsw_sweep one;
    EXPECT_EQ(dsw_environment_sweep_edges(place.get(), 1, nullptr, from.data() + 3 * i, to.data() + 3 * i,
                                          from.data() + 3 * i + 3, 0, nullptr, &one),
              DSW_STATUS_OK);
    EXPECT_EQ(bits_of(one), out.lines.back());
  }
  std::vector<dsw_nearest> points(calls);
  std::vector<dsw_segment_nearest> segments(calls);
  EXPECT_EQ(dsw_environment_find_nearest_to_points(place.get(), from.data(), calls, 0, nullptr, HUGE_VAL, points.data(),
                                                   nullptr, nullptr),
            DSW_STATUS_OK);
  EXPECT_EQ(dsw_environment_find_nearest_to_segments(place.get(), calls, nullptr, from.data(), to.data(), 0, HUGE_VAL,
                                                     segments.data(), nullptr, nullptr),
            DSW_STATUS_OK);
  for (size_t i = 0; i < calls; ++i) {
    points[i].volumes_visited = 0;  // depends on when the tree of obstacles is built
    out.lines.push_back(bytes_of(points[i]));
    out.lines.push_back(bytes_of(segments[i]));
  }
  const ScenePtr scene = make_scene(place.get(), DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS);
  const ScenePtr twin = make_scene(place.get(), DSW_FEATURE_STATISTICS);
  std::vector<double> inside;
  for (size_t i = 0; i < calls; ++i) {
    if (locations[i] == DSW_LOCATION_PASSABLE)
      inside.insert(inside.end(), from.begin() + 3 * static_cast<long>(i), from.begin() + 3 * static_cast<long>(i) + 3);
  }
  const size_t n = inside.size() / 3;
  EXPECT_GE(n, calls == kOwnThreads ? 2048u : 257u);
  std::vector<dsw_particle_id> particles(n), twins(n);
  EXPECT_EQ(dsw_scene_create_particles(scene.get(), inside.data(), n, 0, nullptr, particles.data(), nullptr),
            DSW_STATUS_OK);
  EXPECT_EQ(dsw_scene_create_particles(twin.get(), inside.data(), n, 0, nullptr, twins.data(), nullptr), DSW_STATUS_OK);
  for (int round = 0; round < 4; ++round) {
    std::vector<double> targets;
    for (size_t i = 0; i < n; ++i) {
      Vec p;
      EXPECT_EQ(dsw_particle_get_position(scene.get(), particles[i], p.data(), nullptr), DSW_STATUS_OK);
      const Vec q = motions.target(p);
      targets.insert(targets.end(), q.begin(), q.end());
    }
    std::vector<dsw_flight> moved(n), seen(n);
    EXPECT_EQ(dsw_scene_cast_from_particles(scene.get(), particles.data(), n, targets.data(), 0, nullptr, seen.data()),
              DSW_STATUS_OK);
    EXPECT_EQ(dsw_scene_move_particles(scene.get(), particles.data(), n, targets.data(), 0, nullptr, moved.data()),
              DSW_STATUS_OK);
    const dsw_crossing* crossings = nullptr;
    const size_t* first = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_scene_get_crossings(scene.get(), &crossings, &first, &count), DSW_STATUS_OK);
    EXPECT_EQ(count, n);
    for (size_t i = 0; i < n; ++i) {
      out.lines.push_back(bits_of(seen[i]));
      out.lines.push_back(bits_of(moved[i]));
      std::string path;
      for (size_t c = first[i]; c < first[i + 1]; ++c) {
        char text[80];
        std::snprintf(text, sizeof text, "%u/%u@%a ", crossings[c].volume.index, crossings[c].face.local,
                      crossings[c].time);
        path += text;
      }
      out.lines.push_back(path);
      if (!one_by_one) continue;
      dsw_flight one;  // in another scene
      EXPECT_EQ(dsw_particle_move(twin.get(), twins[i], targets.data() + 3 * i, nullptr, &one), DSW_STATUS_OK);
      EXPECT_EQ(bits_of(one), bits_of(moved[i]));
    }
  }
  out.statistics.struct_size = sizeof out.statistics;
  EXPECT_EQ(dsw_scene_get_statistics(scene.get(), &out.statistics), DSW_STATUS_OK);
  return out;
}

void expect_same(const Answers& a, const Answers& b) {
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (size_t i = 0; i < a.lines.size(); ++i) ASSERT_EQ(a.lines[i], b.lines[i]) << "line " << i;
  EXPECT_EQ(a.statistics.casts, b.statistics.casts);
  EXPECT_EQ(a.statistics.volumes_visited, b.statistics.volumes_visited);
  EXPECT_EQ(a.statistics.orientation_tests, b.statistics.orientation_tests);
  EXPECT_EQ(a.statistics.exact_fallbacks, b.statistics.exact_fallbacks);
  EXPECT_EQ(a.statistics.ties, b.statistics.ties);
  EXPECT_EQ(a.statistics.forecast_hits, b.statistics.forecast_hits);
  EXPECT_EQ(a.statistics.contacts, b.statistics.contacts);
  EXPECT_EQ(a.statistics.candidates, b.statistics.candidates);
}

class ThreadsTest : public SceneTest {};
INSTANTIATE_TEST_SUITE_P(Some, ThreadsTest,
                         testing::ValuesIn(drawn_for("ThreadsTest",
                                                     std::vector<std::string>{"hex", "hex_warped", "tet_random",
                                                                              "mixed", "polyhedra_warped"})),
                         [](const testing::TestParamInfo<std::string>& i) { return i.param; });

TEST_P(ThreadsTest, AnyNumberOfThreadsGivesTheSameBits) {
  const ContextPtr one = context_with(1, nullptr);
  const Answers want = answers(GetParam(), one.get(), kOwnThreads, true);
  ASSERT_FALSE(want.lines.empty());
  EXPECT_GT(want.statistics.contacts, 0u);
  std::vector<uint32_t> counts = {8, 2, 3};
  counts.resize(static_cast<size_t>(std::max(1, std::min(3, effort_of(3)))));
  for (uint32_t threads : counts) {
    SCOPED_TRACE(threads);
    const ContextPtr context = context_with(threads, nullptr);
    expect_same(answers(GetParam(), context.get(), kOwnThreads, false), want);
  }
  SCOPED_TRACE("no context");
  expect_same(answers(GetParam(), nullptr, kOwnThreads, false), want);
}

TEST_P(ThreadsTest, AHostsParallelForInAnyOrderGivesTheSameBits) {
  const ContextPtr one = context_with(1, nullptr);
  const Answers want = answers(GetParam(), one.get(), kHostsThreads, false);
  const auto seeds = static_cast<uint64_t>(std::max(1, effort_of(3)));
  for (int threads : {1, 4}) {
    for (uint64_t seed = 1; seed <= seeds; ++seed) {
      Shuffler shuffler;
      shuffler.seed = seed;
      shuffler.threads = threads;
      const ContextPtr context = context_with(0, &shuffler);
      expect_same(answers(GetParam(), context.get(), kHostsThreads, false), want);
      EXPECT_GT(shuffler.calls.load(), 0u);
    }
  }
}

TEST(ThreadsSharedTest, ManyReadersOfOneEnvironment) {
  const Place place = make_place("mixed", 83);
  ASSERT_PLACE(place);
  Rng rng(83);
  Motions motions(*place.world, rng);
  std::vector<Vec> from, to;
  std::vector<std::string> want;
  for (int i = 0; i < at_least(400); ++i) {
    from.push_back(motions.start());
    to.push_back(motions.target(from.back()));
    dsw_flight f;
    ASSERT_EQ(dsw_environment_cast(place.get(), {0, 0}, from.back().data(), to.back().data(), nullptr, &f),
              DSW_STATUS_OK);
    want.push_back(bits_of(f));
  }
  std::atomic<int> wrong{0};
  std::vector<std::thread> pool;
  for (int t = 0; t < 4; ++t) {
    pool.emplace_back([&]() {
      for (size_t i = 0; i < from.size(); ++i) {
        dsw_flight f;
        const dsw_status s = dsw_environment_cast(place.get(), {0, 0}, from[i].data(), to[i].data(), nullptr, &f);
        if (s != DSW_STATUS_OK || bits_of(f) != want[i]) ++wrong;
      }
    });
  }
  for (std::thread& t : pool) t.join();
  EXPECT_EQ(wrong.load(), 0);
}

}  // namespace
}  // namespace dsw::oracle
