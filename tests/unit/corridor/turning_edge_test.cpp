// A second motion of an edge beside the straight one: it turns. Both are asked of the corridor through the same interface, in pieces:
// a motion says how many pieces it has, and where a point is at the begin of each.
#include <gtest/gtest.h>

#include "corridor/moving_corridors.h"
#include "edge_ground.h"
#include "locate/locate.h"
#include "response/rigid_move.h"
#include "response/rigid_touches.h"

namespace dsw::test {
namespace {

/** Both ends go straight, in as many pieces as asked for. */
struct StraightWay {
  uint32_t count;
  std::vector<Point<3>> places;  // by piece and end

  StraightWay(const Body<3>& body, const Point<3> (&to)[2], uint32_t pieces_of_it) : count(pieces_of_it) {
    for (uint32_t piece = 0; piece <= count; ++piece) {
      for (uint32_t v = 0; v < 2; ++v) {
        Point<3>& at = places.emplace_back();
        point_at<3>(body.position(v), to[v].data(), static_cast<double>(piece) / count, at.data());
      }
    }
  }
  uint32_t pieces() const { return count; }
  const double* place(uint32_t piece, uint32_t v) const { return places[2 * piece + v].data(); }
};

class TurningEdgeTest : public testing::Test {
 protected:
  TurningEdgeTest() {
    Mesh3 mesh;
    Random random(1);
    fill(mesh, 10, 4, 4, false, random);
    env_ = mesh.build();
  }
  Cell cell_at(const Point<3>& at) const { return locate(*env_, at.data(), Cell{}, nullptr).cell; }
  Body<3> edge(const Point<3>& a, const Point<3>& b) const {
    Body<3> body(nullptr);
    body.level = SweepLevel::kEdgesSwept;
    reserve(body, 2, 1, 0);
    for (const Point<3>* each : {&a, &b}) add_vertex(body, each->data(), cell_at(*each));
    add_edge(body, 0, 1);
    return body;
  }
  /** How many pieces of a motion are known to be free, one after the other. The edge goes there. */
  template <class Motion>
  uint32_t follow(Body<3>& body, const Motion& motion) {
    MovingCorridors<3> corridors(*env_);
    CorridorWriter<3> writer(nullptr);
    for (uint32_t piece = 0; piece < motion.pieces(); ++piece) {
      PointWay ends[2];
      for (uint32_t v = 0; v < 2; ++v) {
        const double *const from = motion.place(piece, v), *const to = motion.place(piece + 1, v);
        const Cell cell = body.vertices[v].cell;
        const CastResult path = cast(*env_, from, to, cell);
        ends[v] = {from, to, cell, path.end == CastEnd::kReached ? path.cell : Cell{},
                   path_facets(env_->map, cell, path)};
      }
      Corridor<3>& corridor = body.corridors.own(0, env_->obstacle_version);
      if (corridors.ask(corridor, ++body.call, ends, {ends[0].end, ends[1].end}, true) != Verdict::kHolds) return piece;
      for (uint32_t v = 0; v < 2; ++v) put_vertex(body, v, ends[v].end, ends[v].arrival);
      // What is kept is what a cast passes, or too many turns off, and noted anew when it is needed.
      const auto is_kept = [&] {
        return follows(*env_, corridor, ends[0].end, ends[1].end, ends[0].arrival, ends[1].arrival);
      };
      if (!is_kept()) continue;
      ++kept_;
      bool is_noted = false;
      for (int tries = 0; tries < 8 && !is_noted; ++tries) {
        EXPECT_TRUE(writer.cast_segment(*env_, ends[0].end, ends[1].end, ends[0].arrival, ends[1].arrival, nullptr));
        is_noted = writer.had_room();
      }
      EXPECT_EQ(corridor.facets, writer.passed()) << piece;
    }
    return motion.pieces();
  }
  /** A sixth of a turn about the middle. */
  static RigidMove<3> turn() {
    const double quaternion[4] = {0, 0, std::sin(0.5235987755982988), std::cos(0.5235987755982988)};
    const double centre[3] = {5.03, 2.02, 2.04}, translation[3] = {0, 0, 0};
    return {quaternion, centre, translation};
  }

  const Point<3> a_{3.13, 2.11, 1.91}, b_{6.87, 2.07, 2.23};
  std::unique_ptr<Environment<3>> env_;
  uint32_t kept_ = 0;  // pieces after which the corridor was that of the edge
};

TEST_F(TurningEdgeTest, StraightAndTurningEdgesAreAskedAlike) {
  Body<3> straight = edge(a_, b_);
  const Point<3> to[2] = {{2.3, 3.1, 1.4}, {7.1, 0.6, 3.2}};
  EXPECT_EQ(follow(straight, StraightWay(straight, to, 8)), 8u);
  Body<3> turning = edge(a_, b_);
  RigidWay<3> way(nullptr);
  way.start(turning, turn());
  ASSERT_TRUE(way.turns());
  EXPECT_FALSE(RigidTouches<3>(*env_).find_first(turning, way, nullptr).touches);
  kept_ = 0;
  EXPECT_EQ(follow(turning, way), way.pieces());
  EXPECT_GT(kept_, 0u);
  EXPECT_GT(distance_squared<3>(turning.position(0), a_.data()), 1);
}

TEST_F(TurningEdgeTest, ATurningEdgeIsFreeUntilThePieceInWhichItTouches) {
  const Point<3> beyond{5.03 + 1.7 * std::cos(0.98), 2.02 + 1.7 * std::sin(0.98), 2.15};
  ASSERT_TRUE(set_cell_mark(*env_, cell_at(beyond), true));
  Body<3> turning = edge(a_, b_);
  RigidWay<3> way(nullptr);
  way.start(turning, turn());
  const FirstTouch first = RigidTouches<3>(*env_).find_first(turning, way, nullptr);
  ASSERT_TRUE(first.touches);
  const double at = first.time * way.pieces();  // chords are a little beside arcs
  const uint32_t free = follow(turning, way);
  EXPECT_GT(free, 0u);
  EXPECT_LE(free, at + 0.2);
  EXPECT_GT(free + 1.2, at);
}

}  // namespace
}  // namespace dsw::test
