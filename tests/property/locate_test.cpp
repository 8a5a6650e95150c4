// Where is a point: with the shift (locate) and without it (classify), against exact arithmetic.
#include "exact_places.h"
#include "support.h"

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
    if (exact::on_segment(p, point(ends[0]), point(ends[1]))) {
      found.push_back(cell_of(edges.id(world, e)));
      return found;
    }
  }
  for (int t : world.cell_triangles[c]) {
    const Triangle& tri = world.triangles[static_cast<size_t>(t)];
    if (exact::on_triangle(p, point(tri.v[0]), point(tri.v[1]), point(tri.v[2]))) {
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

/** Corners of the outer boundary have the distance 0, wherever the shift puts them. */
void check_at_corner(const Place& place, const double* corner, dsw_volume_id volume, double least) {
  dsw_nearest nearest;
  ASSERT_EQ(dsw_environment_find_nearest(place.get(), corner, {0, 0}, 1, &nearest), DSW_STATUS_OK);
  EXPECT_EQ(nearest.distance, 0);
  EXPECT_GT(least, 0);
  EXPECT_NE(volume.generation, 0u);
}

TEST_P(LocateTest, APlaceInsideIsFreeAndStaysAsItIs) {
  for (uint32_t flags : {uint32_t{DSW_ENVIRONMENT_LOCATE_TREE}, uint32_t{DSW_ENVIRONMENT_NO_LOCATE_TREE}}) {
    const Place place = make_place(GetParam(), 47, flags);
    ASSERT_PLACE(place);
    Rng rng(47);
    Motions motions(*place.world, rng);
    std::vector<Vec> points;
    for (int i = 0; i < 40; ++i) points.push_back(i % 2 == 0 ? motions.site() : motions.target(motions.site()));
    size_t corners = 0;
    for (uint32_t c = 0; c < place.world->ids.size() && corners < 40; ++c) {
      for (uint32_t f = 0; f < 4; ++f) {
        dsw_volume_id behind;
        const dsw_volume_id id = place.world->ids[c];
        ASSERT_EQ(dsw_environment_get_neighbour(place.get(), id, f, &behind, nullptr), DSW_STATUS_OK);
        dsw_face_id face;
        ASSERT_EQ(dsw_environment_get_face_id(place.get(), id, f, &face), DSW_STATUS_OK);
        dsw_vertex_id corner[64];
        size_t count = 0;
        const dsw_cell cell{DSW_CELL_FACE, face.volume, face.generation, face.local};
        ASSERT_EQ(dsw_environment_copy_vertices(place.get(), cell, corner, 64, &count), DSW_STATUS_OK);
        Vec at;
        ASSERT_EQ(dsw_environment_get_vertex_position(place.get(), corner[0], at.data()), DSW_STATUS_OK);
        if (behind.generation == 0) points.insert(points.begin() + static_cast<std::ptrdiff_t>(corners++), at);
      }
    }
    std::vector<double> in(3 * points.size()), again(in.size());
    std::vector<dsw_volume_id> volumes(points.size());
    for (const double by : {0.0, place.world->size / 64}) {
      ASSERT_EQ(dsw_environment_find_inside(place.get(), points[0].data(), points.size(), 0, nullptr, by, in.data(),
                                            volumes.data()),
                DSW_STATUS_OK);
      ASSERT_EQ(dsw_environment_find_inside(place.get(), in.data(), points.size(), 0, volumes.data(), by, again.data(),
                                            nullptr),
                DSW_STATUS_OK);
      EXPECT_EQ(in, again);
      for (size_t i = 0; i < points.size(); ++i) {
        dsw_volume_id volume;
        dsw_location where;
        ASSERT_EQ(dsw_environment_locate(place.get(), &in[3 * i], {0, 0}, &volume, &where), DSW_STATUS_OK);
        EXPECT_EQ(where, DSW_LOCATION_PASSABLE) << hex(points[i]);
        EXPECT_TRUE(same(volume, volumes[i]));
        double way = 0;
        for (size_t k = 0; k < 3; ++k) way += std::fabs(in[3 * i + k] - points[i][k]);
        if (i < corners) check_at_corner(place, points[i].data(), volumes[i], way);
      }
    }
  }
}

}  // namespace
}  // namespace dsw::oracle
