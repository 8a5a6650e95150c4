// Walls part the cells at an edge into fans, and cells that overlap have walls in each other: what counts for a row is what
// can be reached on its way, and nothing else that happens to be listed.
#include "near_check.h"
#include "plane_support.h"

namespace dsw::oracle {
namespace {

/// Wedges round an edge of length 8, vertices 0 and 1, and as many again beyond its upper end. Some wedges have angles so
/// small that doubles see no difference between the two walls at them. A way from one side of these walls to the other
/// leads round through the upper wedges.
class WedgesTest : public testing::Test {
 protected:
  static constexpr double kThin = 1e-20;
  /// @param ring where the wedges meet, counter-clockwise, in the plane.
  /// @param first which wedge has the lowest number.
  void make(const std::vector<std::array<double, 2>>& ring, size_t first) {
    Mesh mesh;
    const auto count = static_cast<int>(ring.size());
    for (const double z : {0.0, 8.0, 9.0}) {
      mesh.points.push_back({0, 0, z});
      for (const auto& at : ring) mesh.points.push_back({at[0], at[1], z});
    }
    for (int layer = 0; layer < 2; ++layer) {
      for (int k = 0; k < count; ++k) {
        const int low = layer * (count + 1), high = low + count + 1;
        const int a = 1 + (k + static_cast<int>(first)) % count, b = 1 + a % count;
        mesh.add_polyhedron({{low, low + b, low + a},
                             {high, high + a, high + b},
                             {low, low + a, high + a, high},
                             {low, high, high + b, low + b},
                             {low + a, low + b, high + b, high + a}});
      }
    }
    place_ = place_of(mesh);
    ASSERT_PLACE(place_);
    scene_ = make_scene(place_.get());
    count_ = count;
  }
  /// Makes the face from the lower edge to a vertex of the ring a wall.
  void close(int ring_vertex) {
    const std::set<int> corners = {0, ring_vertex + 1, count_ + 1, ring_vertex + 2 + count_};
    int closed = 0;
    for (size_t f = 0; f < place_.world->faces.size(); ++f) {
      const Face& face = place_.world->faces[f];
      if (std::set<int>(face.loop.begin(), face.loop.end()) != corners) continue;
      const dsw_face_id id = face_id(*place_.world, static_cast<int>(f));
      ASSERT_EQ(dsw_environment_mark_faces(place_.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
      ++closed;
    }
    ASSERT_EQ(closed, 1);
  }
  /// The row of a point with the edge, when all within a margin are listed.
  dsw_near_row row_of_edge(const Vec& at, double margin) {
    dsw_body_id body{0, 0};
    EXPECT_EQ(create_body(scene_.get(), {{at}, {}, {}}, DSW_LEVEL_POINTS, 0, {}, &body), DSW_STATUS_OK);
    dsw_near_row found{};
    int count = 0;
    for (const dsw_near_row& row : find_rows(scene_.get(), body, margin, 0)) {
      if (used(row.obstacle_vertices) != std::vector{0, count_ + 1}) continue;
      found = row;
      ++count;
    }
    EXPECT_EQ(count, 1);
    EXPECT_EQ(dsw_body_destroy(scene_.get(), body), DSW_STATUS_OK);
    return found;
  }
  /// Which vertices of the ring a wall ends at.
  std::vector<int> ring_of(dsw_face_id wall) const {
    std::vector<int> ring;
    for (const dsw_vertex_id& v : vertices_of(place_.get(), cell_of(wall))) {
      const int at = static_cast<int>(v.index) % (count_ + 1);
      if (at != 0 && std::find(ring.begin(), ring.end(), at - 1) == ring.end()) ring.push_back(at - 1);
    }
    return ring;
  }

  Place place_;
  ScenePtr scene_;
  int count_ = 0;
};

/// The wedge between the vertices 0 and 4 of the ring is thin. From the point the inner side of the wall at 0 is seen, and
/// the outer side of that at 4. Of these two walls the one at 0 is the lower one, but only its outer side bounds where the
/// point is.
TEST_F(WedgesTest, TheWallIsOfTheFanThatIsSeen) {
  make({{1, kThin}, {0, 1}, {-1, 0}, {0, -1}, {1, -kThin}}, 0);
  close(0);
  close(4);
  for (const double margin : {1.0, 30.0}) {
    const dsw_near_row row = row_of_edge({-0.5, -0.25, 1}, margin);
    EXPECT_EQ(ring_of(row.wall), std::vector{4}) << "margin " << margin;
  }
  for (const double margin : {1.0, 30.0}) {
    const dsw_near_row row = row_of_edge({-0.5, 0.25, 1}, margin);
    EXPECT_EQ(ring_of(row.wall), std::vector{0}) << "margin " << margin;
  }
}

/// A wall in the middle of the thin wedge, too: it is as near in angle, and in no fan that the point sees.
TEST_F(WedgesTest, AWallBehindTheFanIsNoWallOfTheRow) {
  make({{1, kThin}, {0, 1}, {-1, 0}, {0, -1}, {1, -kThin}, {1, 0}}, 4);
  for (const int vertex : {0, 4, 5}) close(vertex);
  for (const double y : {-0.25, 0.25}) {
    for (const double margin : {1.0, 30.0}) {
      const dsw_near_row row = row_of_edge({-0.5, y, 1}, margin);
      EXPECT_EQ(ring_of(row.wall), std::vector{y < 0 ? 4 : 0}) << "margin " << margin << " y " << y;
    }
  }
}

/// Two polygons that have the side from vertex 0 to 1 in common. The lower one has a side from 0 to 6 that lies inside of the
/// upper one, which it overlaps.
class OverlapTest : public testing::Test {
 protected:
  void SetUp() override {
    points_ = {0, 0, 1, 0, 1, 1, -1.5, 1, -0.75, -0.75, 1, -1, -1, -0.5, -0.75, -1.5};
    const std::vector<int32_t> corners = {0, 1, 2, 3, 4, 0, 6, 7, 5, 1}, offsets = {0, 5, 10};
    dsw_environment_desc desc = uniform_desc(2, DSW_CELL_TYPE_TRIANGLE, 3, points_, corners);
    const std::vector<uint8_t> types(2, DSW_CELL_TYPE_POLYGON);
    desc.cell_types = types.data();
    desc.volume_count = types.size();
    desc.offsets = offsets.data();
    environment_ = create_from(desc);
    ASSERT_NE(environment_, nullptr);
    scene_ = make_scene(environment_.get());
  }

  std::vector<double> points_;
  EnvironmentPtr environment_;
  ScenePtr scene_;
};

TEST_F(OverlapTest, AWallOfAVolumeThatIsNotOnTheWayHidesNothing) {
  dsw_body_desc desc = defaults(dsw_body_desc_init);
  const double at[2] = {-0.2, -0.08}, beyond[2] = {-0.145, -0.135};
  desc.positions = at;
  desc.vertex_count = 1;
  dsw_body_id body;
  ASSERT_EQ(dsw_body_create(scene_.get(), &desc, &body), DSW_STATUS_OK) << dsw_last_error_message();
  std::set<std::vector<int>> obstacles;
  for (const dsw_near_row& row : find_rows(scene_.get(), body, 0.5, 0)) obstacles.insert(used(row.obstacle_vertices));
  EXPECT_EQ(obstacles, (std::set<std::vector<int>>{{0, 4}})) << "it is in the upper polygon, whose wall this is";
  // The point passes the other wall on its way, too.
  ASSERT_EQ(dsw_body_move(scene_.get(), body, beyond, 1, 0, nullptr, nullptr), DSW_STATUS_OK);
  double now[2] = {};
  size_t count = 0;
  ASSERT_EQ(dsw_body_get_positions(scene_.get(), body, now, 1, 0, nullptr, &count), DSW_STATUS_OK);
  EXPECT_EQ(now[0], beyond[0]);
  EXPECT_EQ(now[1], beyond[1]);
  obstacles.clear();
  for (const dsw_near_row& row : find_rows(scene_.get(), body, 0.5, 0)) obstacles.insert(used(row.obstacle_vertices));
  EXPECT_EQ(obstacles, (std::set<std::vector<int>>{{0, 4}}));
}

/// Two polygons that overlap at vertex 0, from where a wall leads past vertex 1 to vertex 8. Beyond it a way leads from one side to
/// the other. So if the margin is large, the side of the lower polygon is listed that lies in the upper one, and comes closer to
/// the point than vertex 0.
TEST(NearFansOfPlaneTest, NothingComesCloserOfAnotherFan) {
  const std::vector<double> points = {0,     0,    1,  0, 1,  1, -1.5, 1,  -0.75, -0.75, 1,  -1, -1, -0.5,
                                      -0.75, -1.5, 20, 0, 20, 1, 20,   -1, 21,    0,     21, 1,  21, -1};
  const std::vector<int32_t> corners = {0, 1, 2,  3, 4, 0, 6,  7,  5, 1,  1,  8,  9,
                                        2, 5, 10, 8, 1, 8, 11, 12, 9, 10, 13, 11, 8},
                             offsets = {0, 5, 10, 14, 18, 22, 26};
  dsw_environment_desc desc = uniform_desc(2, DSW_CELL_TYPE_TRIANGLE, 3, points, corners);
  const std::vector<uint8_t> types(6, DSW_CELL_TYPE_POLYGON);
  desc.cell_types = types.data();
  desc.volume_count = types.size();
  desc.offsets = offsets.data();
  const EnvironmentPtr environment = create_from(desc);
  ASSERT_NE(environment, nullptr);
  for (const uint32_t above : {0u, 2u}) {
    dsw_volume_id volume;
    ASSERT_EQ(dsw_environment_get_volume_id(environment.get(), above, &volume), DSW_STATUS_OK);
    const dsw_face_id wall{volume.index, volume.generation, 0};
    ASSERT_EQ(dsw_environment_mark_faces(environment.get(), &wall, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  const ScenePtr scene = make_scene(environment.get());
  const double at[2] = {-0.2, 0.3};
  for (const double margin : {0.5, 40.0}) {
    dsw_body_desc point = defaults(dsw_body_desc_init);
    point.positions = at;
    point.vertex_count = 1;
    dsw_body_id body;
    ASSERT_EQ(dsw_body_create(scene.get(), &point, &body), DSW_STATUS_OK) << dsw_last_error_message();
    std::set<std::vector<int>> obstacles;
    for (const dsw_near_row& row : find_rows(scene.get(), body, margin, 0))
      obstacles.insert(used(row.obstacle_vertices));
    EXPECT_EQ(obstacles.count({0}), 1u) << "margin " << margin;
    EXPECT_EQ(obstacles.count({0, 6}), 0u) << "margin " << margin;
  }
}

}  // namespace
}  // namespace dsw::oracle
