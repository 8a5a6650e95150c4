// Casts that follow their lines through tetrahedra end as those by planes do. The same walk is compiled twice: it
// follows lines wherever it may, and it never does.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "environment/marking.h"
#include "environment/moving.h"
#include "flown.h"
#include "locate/locate.h"
#include "small_meshes.h"
#include "walk/walk.h"

namespace dsw {
namespace lines {
#define DSW_FAR_EDGES 0
#include "walk/walk.inl"
#undef DSW_FAR_EDGES
}  // namespace lines
namespace planes {
#define DSW_FAR_EDGES 1e300
#include "walk/walk.inl"

#include "../../effort.h"
#undef DSW_FAR_EDGES
}  // namespace planes
}  // namespace dsw

namespace {

using namespace dsw;
using namespace dsw::testing_meshes;
using namespace dsw::testing_walk;

constexpr int kSize = 6;
constexpr int kCasts = 2000;  // for each of the scenes and scales below

/** What is asked of casts besides where they end. */
enum class Asks { kNothing, kSomething };

class LineWalkTest : public testing::TestWithParam<double> {
 protected:
  void compare(const Environment<3>& env, double scale, Asks asks) {
    std::mt19937 random(static_cast<uint32_t>(seed_of(5))), sizes(static_cast<uint32_t>(seed_of(6)));
    const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
    const auto place = [&](double(&p)[3], bool tie, double margin) {
      for (double& x : p) {
        const double at = -margin + (kSize + 2 * margin) * static_cast<double>(random()) / 4294967296.0;
        x = scale * (tie ? std::round(2 * at) / 2 : at);
      }
    };
    double from[kPacket][3], to[kPacket][3];
    CastRequest requests[kPacket];
    CastResult expected[kPacket], results[kPacket];
    std::vector<Crossing> expected_crossings[kPacket], crossings[kPacket];
    uint32_t count = 0, wanted = 1, full = 0;
    size_t visited = 0, hits = 0, compared = 0;
    for (int n = 0; n < at_least(kCasts); ++n) {
      place(from[count], n % 5 == 0, 0);
      place(to[count], n % 3 == 0, n % 4 == 0 ? 2 : 0);
      const Cell start = locate(env, from[count], Cell{}, nullptr).cell;
      if (!start.valid() || is_closed(env, start)) continue;
      CastRequest& request = requests[count] = CastRequest{};
      request.from = from[count];
      request.to = to[count];
      request.start = start;
      if (asks == Asks::kSomething) {
        request.through_walls = n % 6 == 0;
        request.max_volumes = n % 7 == 0 ? 1 + below(20) : 0;
        request.crossing = note;
        request.crossing_user = &expected_crossings[count];
        expected_crossings[count].clear();
        crossings[count].clear();
      }
      planes::kThisWalk<3>.plain(env, &request, 1, &expected[count]);
      const CastResult& result = expected[count];
      if (asks == Asks::kSomething && n % 2 == 0 && result.end == CastEnd::kReached) {
        request.end = result.cell;
        expected_crossings[count].clear();
        planes::kThisWalk<3>.plain(env, &request, 1, &expected[count]);
      }
      request.crossing_user = &crossings[count];
      visited += result.volumes_visited;
      hits += result.end == CastEnd::kHit ? 1u : 0u;
      if (++count < wanted) continue;
      full += count == kPacket ? 1u : 0u;
      wanted = n % 3 == 0 ? kPacket : 1 + static_cast<uint32_t>(sizes() % kPacket);  // groups of all sizes
      lines::kThisWalk<3>.plain(env, requests, count, results);
      for (uint32_t i = 0; i < count; ++i) {
        SCOPED_TRACE(testing::Message() << i << " of " << count << std::hexfloat << " from " << from[i][0] << " "
                                        << from[i][1] << " " << from[i][2] << " to " << to[i][0] << " " << to[i][1]
                                        << " " << to[i][2]);
        expect_same(results[i], expected[i]);
        EXPECT_EQ(crossings[i], expected_crossings[i]);
        if (HasFailure()) return;
      }
      compared += count;
      count = 0;
    }
    EXPECT_GT(compared, kCasts / 2u);
    EXPECT_GT(visited, 5 * compared);
    EXPECT_GT(hits, compared / 10);
    EXPECT_GT(full, 3u);
  }
};

TEST_P(LineWalkTest, EndsAsByPlanes) {
  const double scale = GetParam();
  for (const double jitter : {0.0, 0.03}) {
    SmallMesh mesh = lattice(kSize, kTetra, jitter);
    for (double& x : mesh.points) x *= scale;
    Environment<3> env(nullptr);
    build_mesh(env, mesh);
    std::mt19937 random(static_cast<uint32_t>(seed_of(7)));
    for (uint32_t i = 0; i < env.map.cell_count; ++i) {
      const Cell c = env.map.cell(i);
      if (random() % 60 == 0) set_cell_mark(env, c, true);
      if (random() % 40 == 0) set_facet_mark(env, env.map.half_facet(c, random() % 4), true);
    }
    compare(env, scale, Asks::kNothing);
    compare(env, scale, Asks::kSomething);

    // Points move, some of them so far that cells become invalid, which are walls then.
    let_points_move(env);
    std::vector<double> moved(env.points, env.points + 3 * size_t{env.map.vertex_count});
    for (double& x : moved) x += scale * 0.4 * (static_cast<double>(random() % 1001) / 500.0 - 1);
    env.points = moved.data();
    env.note_move();
    env.checked.forget_all();
    compare(env, scale, Asks::kNothing);
    compare(env, scale, Asks::kSomething);
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, LineWalkTest, testing::Values(1.0, 0x1p-40, 1e80, 1e-80, 1e-120, 1e120));

}  // namespace
