// Long edges whose ends go on and on, each move from where the last one led: what is said to meet nothing touches nothing,
// says first_touch of the edge and each feature of each wall, and what is kept of an edge is what a cast from end to end
// passes. Figures are printed.
#include "corridor/moving_corridors.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "../../effort.h"
#include "edge_of_ground.h"

namespace dsw::test {
namespace {

/** Boxes in a row: an end that comes from one of them or goes to it makes the corridor longer or shorter. */
TEST(MovingCorridors, KeepToBoxes) {
  Mesh3 mesh;
  add_boxes(mesh, 4, 1, 1);
  const auto env = mesh.build();
  MovingCorridors<3> corridors(*env);
  for (const int first : {0, 1}) {
    for (const bool back : {false, true}) {
      for (int to = 0; to < 4; ++to) {
        if (std::abs(to - 1) > 1) continue;  // from box 1, the other end stays in box 3
        Body<3> body(nullptr);
        reserve(body, 2, 1, 0);
        double places[4] = {1.5, 3.5, to + 0.5, 3.4};
        if (back) std::swap(places[0], places[2]);
        const int cells[4] = {back ? to : 1, 3, back ? 1 : to, 3};
        PointWay ends[2];
        double at[2][3], end[2][3];
        for (int i = 0; i < 2; ++i) {
          const int k = i ^ first;
          for (double(*each)[3] : {&at[i], &end[i]}) {
            const bool starts = each == &at[i];
            (*each)[0] = places[starts ? k : k + 2];
            (*each)[1] = starts ? 0.41 : 0.4;
            (*each)[2] = starts ? 0.62 : 0.6;
          }
          const Cell start = env->map.cell(static_cast<uint32_t>(cells[k]));
          add_vertex(body, at[i], start);
          const CastResult path = cast(*env, at[i], end[i], start);
          ends[i] = {at[i], end[i], start, path.cell, path_facets(env->map, start, path)};
        }
        add_edge(body, 0, 1);
        ASSERT_EQ(corridors.ask(body.corridors.own(0, env->obstacle_version), body.call, ends, {end[0], end[1]}, true),
                  Verdict::kHolds)
            << first << back << to;
        const Corridor<3>& kept = body.corridors[0];
        EXPECT_EQ(kept.facets.size(), static_cast<size_t>(3 - cells[2]));
        EXPECT_TRUE(kept.portal.front == ends[0].arrival && kept.portal.back == ends[1].arrival);
      }
    }
  }
}

/** Edges along a row of boxes, by the places of their ends before and after. */
TEST(MovingCorridors, KeepToTheOnlyFacetBetweenTwoCells) {
  struct Case {
    double from[2], to[2];
    bool keeps;
  };
  const Case cases[] = {{{1.5, 2.5}, {1.6, 2.4}, true},    // both ends stay
                        {{1.5, 2.5}, {2.2, 2.5}, true},    // one goes through the facet
                        {{1.5, 2.5}, {1.5, 1.8}, true},    // the other one does
                        {{1.5, 1.2}, {2.2, 1.2}, true},    // from the same box
                        {{2.5, 2.2}, {2.5, 1.8}, true},    // the other one
                        {{1.5, 1.2}, {2.2, 2.1}, false},   // both go through it
                        {{1.5, 2.5}, {0.5, 2.5}, false},   // an end goes elsewhere
                        {{1.5, 3.5}, {1.6, 3.4}, false},   // there is a box between them
                        {{1.5, 1.6}, {1.4, 1.7}, false},   // one box
                        {{1.5, 2.5}, {1.6, 9.0}, false}};  // a path leaves the row
  Mesh3 mesh;
  add_boxes(mesh, 4, 1, 1);
  const auto env = mesh.build();
  MovingCorridors<3> corridors(*env);
  for (const Case& each : cases) {
    double at[2][3], end[2][3];
    PointWay ends[2];
    for (int i = 0; i < 2; ++i) {
      const double x[2] = {each.from[i], each.to[i]};
      for (double(*point)[3] : {&at[i], &end[i]}) {
        (*point)[0] = x[point == &at[i] ? 0 : 1];
        (*point)[1] = 0.41;
        (*point)[2] = 0.62;
      }
      const Cell start = env->map.cell(static_cast<uint32_t>(each.from[i]));
      const CastResult path = cast(*env, at[i], end[i], start);
      ends[i] = {at[i], end[i], start, path.end == CastEnd::kReached ? path.cell : Cell{},
                 path_facets(env->map, start, path)};
    }
    EXPECT_EQ(corridors.keeps_to_facet(ends), each.keeps) << each.from[0] << ' ' << each.to[0] << ' ' << each.to[1];
    ends[0].end = at[0];  // a line that does not pass it
    at[0][1] = 40;
    EXPECT_FALSE(corridors.keeps_to_facet(ends));
  }
}

/** An end comes into a polygon that is not convex, and is blocked there. */
TEST(MovingCorridors, KnowNothingOfAPathThatEndsInACellThatIsNotConvex) {
  Mesh2 mesh;
  for (const double y : {0.0, 1.0, 2.0}) {
    for (const double x : {-2.0, 0.0, 1.0, 2.0}) mesh.point({x, y});
  }
  mesh.cell(kQuad, {4, 5, 9, 8});
  mesh.cell(kPolygon, {1, 2, 3, 7, 6, 10, 9, 5});
  const auto env = mesh.build();
  MovingCorridors<2> corridors(*env);
  for (const double end : {0.6, 1.6}) {
    Body<2> body(nullptr);
    reserve(body, 2, 1, 0);
    const double at[2][2] = {{-0.5, 1.5}, {-1.5, 1.4}}, to[2] = {end, 1.5};
    const Cell start = env->map.cell(0);
    for (uint32_t i = 0; i < 2; ++i) {
      add_vertex(body, at[i], start);
    }
    add_edge(body, 0, 1);
    const CastResult path = cast(*env, at[0], to, start);
    const Cell arrival = path.end == CastEnd::kReached ? path.cell : Cell{};
    const PointWay ends[2] = {{at[0], to, start, arrival, path_facets(env->map, start, path)},
                              {at[1], at[1], start, start, {}}};
    ASSERT_EQ(arrival.valid(), end < 1);
    ASSERT_EQ(ends[0].crossed.count, 1u);
    EXPECT_EQ(corridors.ask(body.corridors.own(0, env->obstacle_version), body.call, ends, {to, at[1]}, true),
              Verdict::kUnknown);
  }
}

class MovingCorridorsTest : public testing::TestWithParam<Kind> {
 protected:
  template <int D>
  void run(Counts& counts) {
    for (int round = 0; round < effort_of(10) && !HasFatalFailure(); ++round) {
      EdgeOfGround<D>(GetParam(), 1000 + static_cast<uint64_t>(round), counts).run(40, 10);
    }
  }
};

TEST_P(MovingCorridorsTest, WhatIsKnownToMeetNothingTouchesNothing) {
  const Kind& kind = GetParam();
  Counts n;
  if (kind.dimension == 2) run<2>(n);
  if (kind.dimension == 3) run<3>(n);
  std::printf(
      "%s: %zu ways, %zu touch nothing, %zu by rings alone, %zu are known to, %zu of these begin or end exactly on "
      "something; what %zu others touch first was found; where %zu end, %.1f facets (at most %zu), %zu corridors "
      "known, %zu by one facet; %zu changes\n",
      kind.name, n.asked, n.free, n.by_rings, n.known, n.at_ends, n.first_found, n.clear,
      static_cast<double>(n.facets) / static_cast<double>(n.clear), n.most, n.followed, n.at_facet, n.changes);
  EXPECT_GE(static_cast<double>(n.known - n.at_ends), kind.least_known * static_cast<double>(n.free));
  EXPECT_GE(static_cast<double>(n.followed), kind.least_followed * static_cast<double>(n.clear));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, MovingCorridorsTest,
    testing::Values(Kind{"Free", 3, {14, 4, 4}, false, Points::kJittered, 0, 0, 0, 0, 0.7, 0.65},
                    Kind{"FreeLattice", 3, {14, 4, 4}, false, Points::kOnLattice, 0, 0, 0, 0, 0.35, 0.6},
                    Kind{"FreeSheared", 3, {14, 4, 4}, false, Points::kSheared, 0, 0, 0, 0, 0.7, 0.65},
                    Kind{"FreeMoved", 3, {8, 3, 3}, false, Points::kMoved, 0, 0, 0, 0, 0.7, 0.65},
                    Kind{"Long", 3, {40, 3, 3}, false, Points::kJittered, 0, 0, 0, 0, 0.7, 0.65},
                    Kind{"LongCells", 3, {40, 3, 3}, false, Points::kJittered, 0.01, 0, 0, 0, 0.35, 0.65},
                    Kind{"Cells", 3, {10, 4, 4}, false, Points::kJittered, 0.02, 0, 0, 0, 0.4, 0.65},
                    Kind{"CellsLattice", 3, {10, 4, 4}, false, Points::kOnLattice, 0.02, 0, 0, 0, 0.2, 0.6},
                    Kind{"CellsSheared", 3, {10, 4, 4}, false, Points::kSheared, 0.02, 0, 0, 0, 0.4, 0.65},
                    Kind{"CellsMoved", 3, {8, 3, 3}, false, Points::kMoved, 0.02, 0, 0, 0, 0.4, 0.65},
                    Kind{"Pinched", 3, {8, 4, 4}, false, Points::kOnLattice, 0.3, 0, 0, 0, 0.4, 0.6},
                    Kind{"Facets", 3, {10, 4, 4}, false, Points::kJittered, 0, 0.01, 0, 0, 0.4, 0.65},
                    Kind{"FacetsLattice", 3, {10, 4, 4}, false, Points::kOnLattice, 0, 0.01, 0, 0, 0.3, 0.6},
                    Kind{"Edges", 3, {10, 4, 4}, false, Points::kJittered, 0, 0, 0.01, 0, 0.4, 0.65},
                    Kind{"EdgesLattice", 3, {10, 4, 4}, false, Points::kOnLattice, 0, 0, 0.01, 0, 0.3, 0.6},
                    Kind{"MixedLattice", 3, {10, 4, 4}, true, Points::kOnLattice, 0.02, 0.01, 0.01, 0.02, 0.2, 0.5},
                    Kind{"MixedJittered", 3, {10, 4, 4}, true, Points::kJittered, 0.02, 0.01, 0.01, 0.02, 0.2, 0.65},
                    Kind{"PlaneFree", 2, {30, 8}, false, Points::kJittered, 0, 0, 0, 0, 0.7, 0.75},
                    Kind{"PlaneLong", 2, {80, 6}, false, Points::kJittered, 0.005, 0, 0, 0, 0.4, 0.75},
                    Kind{"PlaneMoved", 2, {20, 8}, false, Points::kMoved, 0.02, 0, 0, 0, 0.45, 0.75},
                    Kind{"PlaneCells", 2, {20, 8}, false, Points::kJittered, 0.02, 0, 0, 0, 0.45, 0.75},
                    Kind{"PlaneLattice", 2, {20, 8}, false, Points::kOnLattice, 0.02, 0.01, 0, 0.01, 0.4, 0.75},
                    Kind{"PlaneSheared", 2, {20, 8}, false, Points::kSheared, 0.02, 0.01, 0, 0.01, 0.45, 0.75},
                    Kind{"PlanePinched", 2, {20, 8}, false, Points::kOnLattice, 0.3, 0, 0, 0, 0.45, 0.75},
                    Kind{"PlaneVertices", 2, {20, 8}, false, Points::kJittered, 0, 0, 0, 0.05, 0.45, 0.75},
                    Kind{"PlanePolygons", 2, {20, 8}, true, Points::kOnLattice, 0.02, 0.01, 0, 0.01, 0.15, 0.75},
                    Kind{"PlanePolygonsJittered", 2, {20, 8}, true, Points::kJittered, 0.02, 0.01, 0, 0.03, 0.1, 0.75}),
    [](const testing::TestParamInfo<Kind>& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dsw::test
