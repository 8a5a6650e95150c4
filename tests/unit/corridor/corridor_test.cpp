// Corridors of sides in the plane. Those of facets in space are looked at where bodies sweep, see tests/property.

#include "corridor/corridor.h"

#include <gtest/gtest.h>

#include "environment/marking.h"
#include "environment/moving.h"
#include "environment/test_mesh.h"
#include "locate/locate.h"

namespace {

using namespace dsw;
using namespace dsw::test;

class PlaneCorridor : public testing::TestWithParam<bool> {
 protected:
  static constexpr uint32_t kWidth = 6, kHeight = 3;

  PlaneCorridor() {
    add_squares(mesh_, kWidth, kHeight, GetParam());
    env_ = mesh_.build();
  }
  Cell at(double x, double y) const {
    const double point[2] = {x, y};
    return locate(*env_, point, Cell{}, nullptr).cell;
  }
  HalfFacet between(Cell from, Cell to) const {
    const Map<2>& map = env_->map;
    for (uint32_t f = 0; f < map.facets_of(from); ++f) {
      const HalfFacet h = map.half_facet(from, f), o = map.opposite(h);
      if (o.valid() && map.cell_of(o) == to) return h;
    }
    return {};
  }
  bool follows(const double (&p)[2], const double (&q)[2]) {
    return dsw::follows(*env_, corridor_, p, q, at(p[0], p[1]), at(q[0], q[1]));
  }
  void assign(const double (&p)[2], const double (&q)[2]) {
    CorridorWriter<2> writer(nullptr);
    CastRequest request;
    request.from = p;
    request.to = q;
    request.start = at(p[0], p[1]);
    writer.attach(*env_, request);
    ASSERT_EQ(cast(*env_, request, nullptr).end, CastEnd::kReached);
    writer.finish(corridor_);
  }
  bool turn(const double (&p)[2], const double (&q)[2]) { return dsw::turn(*env_, corridor_, p, q, pivot_); }
  static uint32_t vertex(uint32_t x, uint32_t y) { return x + (kWidth + 1) * y; }

  Mesh2 mesh_;
  std::unique_ptr<Environment<2>> env_;
  Corridor<2> corridor_{Array<uint32_t>::allocator_type(nullptr)};
  RidgeName pivot_;
};
INSTANTIATE_TEST_SUITE_P(Cut, PlaneCorridor, testing::Bool());

TEST_P(PlaneCorridor, IsFollowedByLinesThatPassBetweenTheSameVertices) {
  const double p[2] = {0.3, 1.5}, q[2] = {5.8, 1.4};
  assign(p, q);
  EXPECT_EQ(corridor_.facets.size(), GetParam() ? 11u : 5u);
  EXPECT_TRUE(follows(p, q));
  EXPECT_TRUE(follows({0.1, 1.6}, {5.9, 1.3}));
  EXPECT_FALSE(follows(q, p)) << "the other way round";
  EXPECT_FALSE(follows({0.3, 2.5}, q)) << "from another cell";
  EXPECT_FALSE(follows(p, {5.8, 0.4})) << "to another cell";
  EXPECT_FALSE(follows({0.3, 1.95}, {0.4, 1.95})) << "it ends before";
}

TEST_P(PlaneCorridor, IsNotFollowedThroughWhatIsImpassable) {
  const double p[2] = {0.3, 1.5}, q[2] = {5.8, 1.4};
  assign(p, q);
  const HalfFacet side = between(at(2.9, 1.45), at(3.1, 1.5));
  ASSERT_TRUE(side.valid());
  set_facet_mark(*env_, side, true);
  EXPECT_FALSE(follows(p, q));
  set_facet_mark(*env_, side, false);
  EXPECT_TRUE(follows(p, q));
  for (const double x : {0.3, 2.5, 5.8}) {
    set_cell_mark(*env_, at(x, 1.45), true);
    EXPECT_FALSE(follows(p, q)) << x;
    set_cell_mark(*env_, at(x, 1.45), false);
  }
  EXPECT_TRUE(follows(p, q));
}

TEST_P(PlaneCorridor, KnowsTheLastTwoPlacesUntilSomethingChanges) {
  const double p[2] = {0.3, 1.5}, q[2] = {5.8, 1.4}, next[2] = {0.1, 1.6}, third[2] = {0.2, 1.6};
  const Cell first = at(p[0], p[1]), last = at(q[0], q[1]);
  const auto knows = [&](const double(&from)[2]) {
    return corridor_.has_place(env_->obstacle_version, from, q, first, last);
  };
  assign(p, q);
  EXPECT_FALSE(knows(p));
  ASSERT_TRUE(follows(p, q) && follows(next, q));
  EXPECT_TRUE(knows(p) && knows(next));
  EXPECT_FALSE(corridor_.has_place(env_->obstacle_version, q, p, last, first)) << "the other way round";
  EXPECT_FALSE(corridor_.has_place(env_->obstacle_version, p, q, first, first)) << "another cell";
  ASSERT_TRUE(follows(third, q));
  EXPECT_TRUE(knows(next) && knows(third));
  EXPECT_FALSE(knows(p)) << "two are kept";
  const HalfFacet side = between(at(2.9, 1.45), at(3.1, 1.5));
  set_facet_mark(*env_, side, true);
  EXPECT_FALSE(knows(next) || knows(third));
  set_facet_mark(*env_, side, false);
  ASSERT_TRUE(follows(p, q));
  EXPECT_TRUE(knows(p));
  EXPECT_FALSE(knows(third)) << "of another version";
  corridor_.remove(*env_, true);
  EXPECT_FALSE(knows(p));
}

TEST_P(PlaneCorridor, IsKeptBeforeBetweenAndAfterTheMovesOfBothEnds) {
  const double p[2] = {0.3, 1.5}, q[2] = {5.8, 1.4}, p_to[2] = {0.1, 1.6}, q_to[2] = {5.9, 1.3};
  assign(p, q);
  ASSERT_TRUE(follows(p, q));
  const auto keeps = [&](const EdgeWay& way, bool swept = true) { return keeps_to_rows(corridor_, way, swept); };
  EXPECT_TRUE(keeps({p, p_to, q, q_to, true}));
  EXPECT_TRUE(keeps({q, q_to, p, p_to, false}));
  EXPECT_TRUE(keeps({p, p_to, q, q, true})) << "one end stays";
  const Cell first = at(p[0], p[1]), last = at(q[0], q[1]);
  EXPECT_TRUE(corridor_.has_place(env_->obstacle_version, p_to, q, first, last)) << "where it arrives";
  // Each of the three lines counts, that before only where what is swept does.
  const double low[2] = {0.5, 1.01}, far[2] = {5.5, 0.01}, near_far[2] = {5.5, 1.01};
  EXPECT_FALSE(keeps({p, p_to, q, far, true}));
  EXPECT_FALSE(keeps({q, far, p, p_to, false}));
  EXPECT_FALSE(keeps({p, p_to, far, near_far, true}));
  EXPECT_FALSE(keeps({far, q, low, p, false}));
  EXPECT_TRUE(keeps({far, q, p, p_to, false}, false));
}

TEST_P(PlaneCorridor, IsNotFollowedThroughAVertex) {
  assign({0.25, 0.5}, {1.75, 1.75});
  EXPECT_TRUE(follows({0.25, 0.5}, {1.75, 1.75}));
  EXPECT_FALSE(follows({0.25, 0.25}, {1.75, 1.75})) << "no filter can tell";
}

TEST_P(PlaneCorridor, TurnsRoundAVertex) {
  const double p[2] = {1.6, 0.5}, to[2] = {1.75, 0.4}, q[2] = {2.4, 1.7};
  assign(p, q);
  const Array<uint32_t> before = corridor_.facets;
  ASSERT_FALSE(follows(to, q));
  assign(to, q);
  const Array<uint32_t> after = corridor_.facets;
  ASSERT_TRUE(before != after);
  corridor_.assign(*env_, before);
  ASSERT_TRUE(turn(to, q));
  EXPECT_EQ(pivot_.vertices[0], vertex(2, 1));
  EXPECT_TRUE(corridor_.facets == after);
  EXPECT_TRUE(follows(to, q));
  ASSERT_TRUE(turn(p, q));
  EXPECT_TRUE(corridor_.facets == before);
  EXPECT_FALSE(turn(p, q)) << "it is followed";
}

TEST_P(PlaneCorridor, DoesNotTurnOverWhatIsImpassable) {
  const double p[2] = {1.6, 0.5}, to[2] = {1.75, 0.4}, q[2] = {2.4, 1.7};
  assign(to, q);
  const Array<uint32_t> after = corridor_.facets;
  assign(p, q);
  const Array<uint32_t> before = corridor_.facets;
  const auto stays = [&] {
    ASSERT_TRUE(follows(p, q));
    EXPECT_FALSE(turn(to, q));
    EXPECT_TRUE(corridor_.facets == before);
  };
  for (const uint32_t facet : after) {
    if (std::find(before.begin(), before.end(), facet) != before.end()) continue;
    set_facet_mark(*env_, {facet}, true);
    stays();
    set_facet_mark(*env_, {facet}, false);
  }
  set_cell_mark(*env_, at(2.1, 0.8), true);
  stays();
}

TEST_P(PlaneCorridor, DoesNotTurnRoundTheRim) {
  assign({0.5, 1.1}, {0.5, 2.9});
  EXPECT_TRUE(follows({0.5, 1.1}, {0.5, 2.9}));
  EXPECT_FALSE(turn({0.5, 1.1}, {-0.7, 2.9}));
}

/** After points have moved, only triangles are known to be convex. */
TEST_P(PlaneCorridor, IsForgottenByPolygonsThatMove) {
  const double p[2] = {0.3, 1.5}, q[2] = {5.8, 1.4};
  assign(p, q);
  let_points_move(*env_);
  EXPECT_TRUE(follows(p, q));
  env_->note_move();
  EXPECT_EQ(follows(p, q), GetParam());
}

/** Side by side two sides in a row belong to the same cells: nobody knows which of them a path of three cells met. */
TEST(PlanePath, NamesASecondSideOnlyIfThereIsOne) {
  Mesh2 mesh;
  for (int y = 0; y <= 3; ++y) {
    for (int x = 0; x <= 2; ++x) mesh.point({x * 1.0, y * 1.0});
  }
  for (int64_t y = 0; y < 3; ++y) {
    const int64_t a = 3 * y;
    if (y == 0) mesh.cell(kPolygon, {a, a + 2, a + 5, a + 4, a + 3});
    if (y == 1) mesh.cell(kPolygon, {a, a + 1, a + 2, a + 5, a + 4, a + 3});
    if (y == 2) mesh.cell(kPolygon, {a, a + 1, a + 2, a + 5, a + 3});
  }
  const auto env = mesh.build();
  const Cell first = env->map.cell(0);
  const double p[2] = {0.5, 0.5}, middle[2] = {0.5, 1.5}, q[2] = {0.6, 2.5};
  EXPECT_EQ(path_facets(env->map, first, cast(*env, p, middle, first)).count, 1u);
  EXPECT_EQ(path_facets(env->map, first, cast(*env, p, q, first)).count, 0u);
  Mesh2 plain;
  add_squares(plain, 1, 3);
  const auto squares = plain.build();
  const PathFacets both = path_facets(squares->map, first, cast(*squares, p, q, first));
  ASSERT_EQ(both.count, 2u);
  EXPECT_EQ(squares->map.cell_of(both.facets[0]), first);
  EXPECT_EQ(squares->map.cell_of(squares->map.opposite(both.facets[1])), squares->map.cell(2));
}

}  // namespace
