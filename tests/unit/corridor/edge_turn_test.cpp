// Edges among pyramids and hexahedra that turn round an edge of these, against casts and floods.

#include "corridor/edge_turn.h"

#include <gtest/gtest.h>

#include <array>

#include "corridor/sweep.h"
#include "environment/marking.h"
#include "environment/test_mesh.h"
#include "locate/locate.h"
#include "predicates/filtered.h"

namespace {

using namespace dsw;
using namespace dsw::test;

using Point = std::array<double, 3>;

constexpr int kSize = 3;

/** Cubes, some or all of them cut into six pyramids round their centres. */
std::unique_ptr<Environment<3>> make_ground(Random& random, bool all) {
  Mesh3 boxes, mesh;
  add_boxes(boxes, kSize, kSize, kSize);
  mesh.points = boxes.points;
  for (size_t c = 0; c < boxes.types.size(); ++c) {
    const int64_t* const v = &boxes.connectivity[8 * c];
    if (!all && random.below(2) == 0) {
      mesh.cell(kHexahedron, {v, v + 8});
      continue;
    }
    Point centre{};
    for (int i = 0; i < 8; ++i) {
      for (size_t k = 0; k < 3; ++k) centre[k] += boxes.points[3 * static_cast<size_t>(v[i]) + k] / 8;
    }
    const int64_t apex = mesh.point({centre[0], centre[1], centre[2]});
    constexpr int kFaces[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
    for (const auto& f : kFaces) mesh.cell(kPyramid, {v[f[3]], v[f[2]], v[f[1]], v[f[0]], apex});
  }
  return mesh.build();
}

struct Noted {
  Corridor<3> corridor{Array<uint32_t>::allocator_type(nullptr)};
  Cell first, last;

  /** False: the edge is not free. */
  bool note(const Environment<3>& env, const double* from, const double* to) {
    CorridorWriter<3> writer(nullptr);
    CastRequest request;
    request.from = from;
    request.to = to;
    request.start = first = locate(env, from, Cell{}, nullptr).cell;
    writer.attach(env, request);
    const CastResult result = dsw::cast(env, request, nullptr);
    if (result.end != CastEnd::kReached) return false;
    last = result.cell;
    writer.finish(corridor);
    return corridor.known();
  }
};

TEST(EdgeTurn, LeadsToWhatACastPassesAndSweepsNothing) {
  int turned = 0, of_several = 0, refused = 0;
  for (int round = 0; round < at_least(60); ++round) {
    Random random(static_cast<uint64_t>(round + 1));
    const auto env = make_ground(random, round % 2 == 0);
    const Map<3>& map = env->map;
    reserve_edge_marks(*env, 400);
    for (uint32_t i = 0; round % 3 != 0 && i < map.cell_count; ++i) {
      const Cell c = map.cell(i);
      if (random.below(12) == 0) set_cell_mark(*env, c, true);
      const HalfFacet h = map.half_facet(c, static_cast<uint32_t>(random.below(4)));
      if (random.below(12) == 0 && map.opposite(h).valid()) set_facet_mark(*env, h, true);
    }
    SweepFlood<3> flood(*env);
    for (int i = 0; i < 600; ++i) {
      Point p, q, to;
      for (size_t k = 0; k < 3; ++k) {
        p[k] = kSize * random.unit();
        q[k] = p[k] + 1.2 * (2 * random.unit() - 1);
        to[k] = p[k] + 0.3 * (2 * random.unit() - 1);
      }
      const bool p_first = random.below(2) == 0;
      const double *const from = p_first ? p.data() : q.data(), *const end = p_first ? q.data() : p.data();
      const double *const new_from = p_first ? to.data() : q.data(), *const new_end = p_first ? q.data() : to.data();
      Noted noted;
      const Cell begin = locate(*env, from, Cell{}, nullptr).cell;
      if (!begin.valid() || is_closed(*env, begin) || !noted.note(*env, from, end)) continue;
      const Cell start = p_first ? noted.first : noted.last;
      if (locate(*env, to.data(), Cell{}, nullptr).cell != start) continue;
      if (!follows(*env, noted.corridor, from, end, noted.first, noted.last)) continue;
      ASSERT_TRUE(follows(*env, noted.corridor, from, end, noted.first, noted.last)) << "the place is known";
      if (!noted.corridor.facets.empty() && random.below(8) == 0) {
        const HalfFacet passed{noted.corridor.facets.front()};
        set_facet_mark(*env, passed, true);
        ASSERT_FALSE(follows(*env, noted.corridor, from, end, noted.first, noted.last)) << "a passed facet is marked";
        set_facet_mark(*env, passed, false);
        set_cell_mark(*env, noted.last, true);
        ASSERT_FALSE(follows(*env, noted.corridor, from, end, noted.first, noted.last)) << "the last cell is marked";
        set_cell_mark(*env, noted.last, false);
        ASSERT_TRUE(follows(*env, noted.corridor, from, end, noted.first, noted.last));
        ASSERT_FALSE(follows(*env, noted.corridor, from, end, noted.last, noted.first)) << "not between these cells";
      }
      if (noted.corridor.in_rows || follows(*env, noted.corridor, new_from, new_end, noted.first, noted.last)) continue;
      RidgeName pivot;
      if (!turn(*env, noted.corridor, new_from, new_end, pivot) ||
          !follows(*env, noted.corridor, new_from, new_end, noted.first, noted.last)) {
        ++refused;
        continue;
      }
      Noted cast;
      ASSERT_TRUE(cast.note(*env, new_from, new_end)) << round << "/" << i;
      ASSERT_EQ(std::vector<uint32_t>(noted.corridor.facets.begin(), noted.corridor.facets.end()),
                std::vector<uint32_t>(cast.corridor.facets.begin(), cast.corridor.facets.end()))
          << round << "/" << i;
      const double* const triangle[3] = {p.data(), to.data(), q.data()};
      if (orient<3>(triangle, env->point(pivot.vertices[0])) * orient<3>(triangle, env->point(pivot.vertices[1])) >= 0)
        continue;
      ASSERT_EQ(flood.sweep(EdgeMotion{p.data(), to.data(), q.data()}, start, 0).end, SweepEnd::kFree)
          << round << "/" << i;
      ++turned;
      of_several += noted.corridor.facets.size() > 2 ? 1 : 0;
    }
  }
  EXPECT_GT(turned, 300);
  EXPECT_GT(of_several, 50);
  EXPECT_GT(refused, 100);
}

TEST(Portal, WhoKeepsToItFollowsTheFacetsAndSweepsNothing) {
  int kept[2] = {0, 0}, left = 0;
  for (int round = 0; round < at_least(40); ++round) {
    Random random(static_cast<uint64_t>(round + 101));
    const auto env = make_ground(random, round % 2 == 0);
    SweepFlood<3> flood(*env);
    for (int i = 0; i < 600; ++i) {
      Point p, q, p_to, q_to;
      for (size_t k = 0; k < 3; ++k) {
        p[k] = kSize * random.unit();
        q[k] = p[k] + 2 * random.unit() - 1;
        p_to[k] = p[k] + 0.2 * (2 * random.unit() - 1);
        q_to[k] = q[k] + 0.2 * (2 * random.unit() - 1);
      }
      Noted noted;
      if (!locate(*env, p.data(), Cell{}, nullptr).cell.valid() || !noted.note(*env, p.data(), q.data())) continue;
      const Cell first = noted.first, last = noted.last;
      const auto is_in = [&](const Point& x, Cell c) { return locate(*env, x.data(), Cell{}, nullptr).cell == c; };
      if (noted.corridor.facets.empty() || !is_in(p_to, first) || !is_in(q_to, last)) continue;
      const Portal<3>& portal = noted.corridor.portal;
      ASSERT_EQ(portal.version, env->obstacle_version);
      ASSERT_EQ(portal.is_only(), noted.corridor.facets.size() == 1);
      ASSERT_TRUE(portal.leads(*env, first, last));
      ASSERT_FALSE(portal.leads(*env, last, first));
      const bool p_moves_first = random.below(2) == 0;
      const EdgeWay way = p_moves_first ? EdgeWay{p.data(), p_to.data(), q.data(), q_to.data(), true}
                                        : EdgeWay{q.data(), q_to.data(), p.data(), p_to.data(), false};
      if (!(portal.is_only() ? keeps_to_portal(*env, portal, way) : keeps_to_facets(*env, noted.corridor, way))) {
        ++left;
        continue;
      }
      const Point &middle_p = p_moves_first ? p_to : p, &middle_q = p_moves_first ? q : q_to;
      ASSERT_TRUE(follows(*env, noted.corridor, p.data(), q.data(), first, last)) << round << "/" << i;
      ASSERT_TRUE(follows(*env, noted.corridor, middle_p.data(), middle_q.data(), first, last)) << round << "/" << i;
      ASSERT_TRUE(follows(*env, noted.corridor, p_to.data(), q_to.data(), first, last)) << round << "/" << i;
      const HalfFacet facet{noted.corridor.facets.front()};
      set_facet_mark(*env, facet, true);
      ASSERT_NE(portal.version, env->obstacle_version) << "what is known is of another version";
      set_facet_mark(*env, facet, false);
      ASSERT_EQ(flood.sweep(EdgeMotion{p.data(), p_to.data(), middle_q.data()}, first, 0).end, SweepEnd::kFree);
      ASSERT_EQ(flood.sweep(EdgeMotion{q.data(), q_to.data(), middle_p.data()}, last, 0).end, SweepEnd::kFree);
      ++kept[portal.is_only() ? 0 : 1];
      set_cell_mark(*env, last, true);
      ASSERT_FALSE(portal.leads(*env, first, last)) << "the last cell is marked";
      set_cell_mark(*env, last, false);
    }
  }
  EXPECT_GT(kept[0], 500);
  EXPECT_GT(kept[1], 100);
  EXPECT_GT(left, 300);
}

TEST(EdgeTurn, PlacesOfBeforePointsMovedAreForgotten) {
  Mesh3 mesh;
  add_boxes(mesh, 2, 1, 1);
  const auto env = mesh.build();
  const double below[2][3] = {{0.5, 0.05, 0.5}, {1.5, 0.05, 0.5}}, middle[2][3] = {{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}};
  Noted noted;
  ASSERT_TRUE(noted.note(*env, middle[0], middle[1]));
  ASSERT_EQ(noted.corridor.facets.size(), 1u);
  const auto follows_line = [&](const double(&line)[2][3]) {
    return follows(*env, noted.corridor, line[0], line[1], noted.first, noted.last);
  };
  EXPECT_TRUE(follows_line(below));
  EXPECT_TRUE(follows_line(middle));
  for (uint32_t v = 0; v < 12; ++v) env->writable_points()[3 * v + 1] += 0.1;
  env->note_move();
  EXPECT_TRUE(follows_line(middle));
  EXPECT_FALSE(follows_line(below)) << "beside the facet now";
}

}  // namespace
