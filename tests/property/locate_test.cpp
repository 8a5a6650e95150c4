// Where is a point: with the shift (locate) and without it (classify), against exact arithmetic.
#include "support.h"

#include <gmpxx.h>

namespace dsw::oracle {
namespace {

class LocateTest : public SceneTest {};
DSW_FOR_ALL_SCENES(LocateTest);

TEST_P(LocateTest, AgreesWithBruteForceWithAndWithoutHintAndGrid) {
  for (uint32_t flags : {0u, uint32_t{DSW_ENVIRONMENT_LOCATE_TREE}, uint32_t{DSW_ENVIRONMENT_NO_LOCATE_TREE}}) {
    for (uint64_t seed = 31; seed < 31 + seeds_of(3); ++seed) {
      const Place place = make_place(GetParam(), seed, flags);
      ASSERT_PLACE(place);
      Report report;
      report.begin(GetParam(), GetParam() + " seed " + std::to_string(seed));
      Checker checker(*place.world, place.get(), report);
      Rng rng(seed);
      Motions motions(*place.world, rng);
      for (int i = 0; i < 150; ++i) {
        const Vec p = rng.chance(0.8) ? motions.site() : motions.target(motions.site());
        checker.locate(p, {0, 0});
        checker.locate(p, place.world->ids[rng.below(place.world->ids.size())]);
      }
      EXPECT_EQ(report.total.mismatches, 0u);
    }
  }
}

TEST_P(LocateTest, BatchIsTheSameAsOneByOne) {
  const Place place = make_place(GetParam(), 35, DSW_ENVIRONMENT_LOCATE_TREE);
  ASSERT_PLACE(place);
  Rng rng(35);
  Motions motions(*place.world, rng);
  std::vector<double> points;
  std::vector<dsw_volume_id> hints, volumes(300);
  std::vector<dsw_location> locations(300);
  for (int i = 0; i < at_least(300); ++i) {
    const Vec p = motions.site();
    points.insert(points.end(), {p[0], p[1], p[2], 0});
    hints.push_back(rng.chance(0.5) ? dsw_volume_id{0, 0} : place.world->ids[rng.below(place.world->ids.size())]);
  }
  ASSERT_EQ(dsw_environment_locate_points(place.get(), points.data(), 300, 32, hints.data(), volumes.data(),
                                          locations.data()),
            DSW_STATUS_OK);
  for (size_t i = 0; i < 300; ++i) {
    dsw_volume_id v;
    dsw_location where;
    ASSERT_EQ(dsw_environment_locate(place.get(), points.data() + 4 * i, hints[i], &v, &where), DSW_STATUS_OK);
    EXPECT_TRUE(same(v, volumes[i]));
    EXPECT_EQ(where, locations[i]);
  }
}

using Q3 = std::array<mpq_class, 3>;
Q3 minus(const Vec& a, const Vec& b) {
  return {mpq_class(a[0]) - mpq_class(b[0]), mpq_class(a[1]) - mpq_class(b[1]), mpq_class(a[2]) - mpq_class(b[2])};
}
Q3 cross(const Q3& a, const Q3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpq_class dot(const Q3& a, const Q3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
bool zero(const Q3& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

bool on_segment(const Vec& p, const Vec& a, const Vec& b) {
  const Q3 u = minus(b, a), v = minus(p, a);
  return zero(cross(u, v)) && dot(u, v) >= 0 && dot(u, v) <= dot(u, u);
}
bool on_triangle(const Vec& p, const Vec& a, const Vec& b, const Vec& c) {
  const Q3 n = cross(minus(b, a), minus(c, a));
  if (dot(n, minus(p, a)) != 0) return false;
  return dot(n, cross(minus(b, a), minus(p, a))) >= 0 && dot(n, cross(minus(c, b), minus(p, b))) >= 0 &&
         dot(n, cross(minus(a, c), minus(p, c))) >= 0;
}

/// The unshifted answer, over the whole environment; among several cells of one dimension any may be named.
std::vector<dsw_cell> exact_places(const World& world, const Edges& edges, const dsw_environment* environment,
                                   const Vec& p, int cell) {
  std::vector<dsw_cell> found;
  const auto point = [&](int v) -> const Vec& { return world.mesh.points[static_cast<size_t>(v)]; };
  const auto c = static_cast<size_t>(cell);
  for (const Loop& loop : world.mesh.cells[c].faces) {
    for (int v : loop) {
      if (point(v) != p) continue;
      dsw_vertex_id id;
      EXPECT_EQ(dsw_environment_get_vertex_id(environment, static_cast<uint32_t>(v), &id), DSW_STATUS_OK);
      found.push_back(cell_of(id));
      return found;
    }
  }
  for (int e : edges.of_cell[c]) {
    const auto& ends = edges.edges[static_cast<size_t>(e)].ends;
    if (on_segment(p, point(ends[0]), point(ends[1]))) {
      found.push_back(cell_of(edges.id(world, e)));
      return found;
    }
  }
  for (int t : world.cell_triangles[c]) {
    const Triangle& tri = world.triangles[static_cast<size_t>(t)];
    if (on_triangle(p, point(tri.v[0]), point(tri.v[1]), point(tri.v[2]))) {
      found.push_back(cell_of(face_id(world, tri.face)));
      return found;
    }
  }
  found.push_back(cell_of(world.ids[c]));
  return found;
}

TEST_P(LocateTest, ClassifyIsExact) {
  int kinds[5] = {0, 0, 0, 0, 0};
  for (uint64_t seed = 41; seed < 41 + seeds_of(2); ++seed) {
    const Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    const Edges edges(*place.world);
    Rng rng(seed);
    Motions motions(*place.world, rng);
    for (int i = 0; i < 200; ++i) {
      const Vec p = rng.chance(0.6) ? motions.site() : motions.start();
      const int cell = place.world->locate(place.world->body(p.data()));
      if (cell < 0) continue;
      const std::vector<dsw_cell> want = exact_places(*place.world, edges, place.get(), p, cell);
      dsw_cell got;
      ASSERT_EQ(dsw_environment_classify(place.get(), p.data(), place.world->ids[static_cast<size_t>(cell)], &got),
                DSW_STATUS_OK)
          << hex(p) << dsw_last_error_message();
      EXPECT_TRUE(same(got, want[0])) << hex(p) << " in " << cell << ": " << got << " for " << want[0];
      ++kinds[got.kind];
    }
  }
  EXPECT_GT(kinds[DSW_CELL_VERTEX], 0);
  EXPECT_GT(kinds[DSW_CELL_VOLUME], 0);
}

TEST_P(LocateTest, ClassifyRefusesAPointThatTheVolumeDoesNotHold) {
  const Place place = make_place(GetParam(), 43);
  ASSERT_PLACE(place);
  Vec far;
  for (size_t k = 0; k < 3; ++k) far[k] = place.world->upper[k] + place.world->size;
  dsw_cell got;
  for (dsw_volume_id id : place.world->ids) {
    EXPECT_EQ(dsw_environment_classify(place.get(), far.data(), id, &got), DSW_STATUS_OUTSIDE);
  }
}

}  // namespace
}  // namespace dsw::oracle
