// Collected sweeps of edges, and the way out by sequences of cells, against brute force and the plain flood.

#include "swept_cases.h"

#include "corridor/corridor.h"
#include "corridor/hop.h"
#include "corridor/sweep.h"
#include "locate/locate.h"
#include "sweep/simplex_sweep.h"
#include "walk/cast.h"

namespace dsw::swept {
namespace {

Line line_of(const Environment<3>& env, const SweepEvent& event) {
  const auto number = [&](const double* x) { return static_cast<uint32_t>((x - env.points) / 3); };
  const uint32_t a = number(event.points[1]), b = number(event.points[2]);
  return {std::min(a, b), std::max(a, b)};
}

struct Count {
  int sweeps = 0, many = 0, most = 0, full = 0;
};

void check_all(const Environment<3>& env, SweptTruth& truth, SweepFlood<3>& flood, const Vec (&x)[4], bool only_edges,
               Count& count) {
  const EdgeMotion m{x[0].data(), x[1].data(), x[2].data()};
  const double* const at[3] = {m.p, m.to, m.q};
  const Cell start = locate(env, m.p, Cell{}, nullptr).cell;
  if (!start.valid() || env.map.marked(start)) return;
  const SweepResult plain = flood.sweep(m, start, 0);
  const SweepResult result = flood.sweep(m, start, 0, true);
  ASSERT_EQ(result.end, plain.end);
  ASSERT_EQ(result.volumes_visited, plain.volumes_visited);
  truth.load(at, 3);
  std::set<Line> met;
  for (const SweepContact& c : flood.all()) {
    if (c.event.kind != EventKind::kEdge) continue;
    ASSERT_TRUE(met.insert(line_of(env, c.event)).second) << "twice";
    ASSERT_TRUE(truth.line_pierces(0, 1, 2, line_of(env, c.event)));
  }
  const Array<SweepContact>& all = flood.all();
  ASSERT_EQ(all.empty(), result.end == SweepEnd::kFree);
  for (size_t i = 1; i < all.size(); ++i) {
    ASSERT_TRUE(comes_before(env.map, m.p, m.to, all[i - 1], all[i]));
    ASSERT_FALSE(comes_before(env.map, m.p, m.to, all[i], all[i - 1]));
    if (all[i - 1].event.kind != EventKind::kEdge || all[i].event.kind != EventKind::kEdge) continue;
    ASSERT_LE(compare(truth.edge_moment(line_of(env, all[i - 1].event)), truth.edge_moment(line_of(env, all[i].event))),
              0);
  }
  if (!all.empty()) {
    ASSERT_FALSE(comes_before(env.map, m.p, m.to, all[0], plain.contact));
    ASSERT_FALSE(comes_before(env.map, m.p, m.to, plain.contact, all[0]));
  }
  ++count.sweeps;
  count.many += all.size() > 2 ? 1 : 0;
  count.most = std::max(count.most, static_cast<int>(all.size()));
  // Where only marked edges and the outer boundary are impassable and that is not met, the flood sees each of them.
  if (!only_edges || std::any_of(all.begin(), all.end(), [](const SweepContact& c) { return c.facet.valid(); })) return;
  const double* const corners[3] = {m.p, m.to, m.q};
  for (const double* corner : corners) {
    if (!locate(env, corner, Cell{}, nullptr).cell.valid()) return;
  }
  size_t pierced = 0;
  for (const Line& line : truth.lines) pierced += truth.line_pierces(0, 1, 2, line) ? 1u : 0u;
  ASSERT_EQ(met.size(), pierced);
  count.full += pierced > 1 ? 1 : 0;
}

TEST(SweptEdgeTest, AllContactsInTheirOrder) {
  Count count;
  for_each_ground({{0, 0, 0.3, 0}, {0, 0.1, 0.1, 0}, {0.1, 0.1, 0, 0}}, [&](Ground& ground) {
    SweepFlood<3> flood(ground.env);
    ground.draw(
        1000, [&](const Vec(&x)[4], bool) { check_all(ground.env, ground.truth, flood, x, ground.seed == 1, count); });
  });
  EXPECT_GT(count.sweeps, effort_of(10000));
  EXPECT_GT(count.many, effort_of(2000));
  EXPECT_GT(count.most, 20);
  EXPECT_GT(count.full, effort_of(300));
}

/** What a segment passes, if it reaches its end and passes every facet where `follows` can tell; *known says so. */
Corridor<3> facets_passed(const Environment<3>& env, const double* from, const double* to, Cell start, bool* known) {
  CorridorWriter<3> writer(nullptr);
  CastRequest request;
  request.from = from;
  request.to = to;
  request.start = start;
  writer.attach(env, request);
  const CastResult result = cast(env, request, nullptr);
  Corridor<3> sequence{Array<uint32_t>::allocator_type(nullptr)};
  writer.finish(sequence);
  *known = result.end == CastEnd::kReached && follows(env, sequence, from, to, start, result.cell);
  return sequence;
}

/** What is known of an edge's sweep from what the edge passes at first; the path of its end is free. */
Verdict settled_by(const Environment<3>& env, const double* p, Cell start, const double* to, Cell target,
                   const double* q, const Corridor<3>& before, const Corridor<3>& path) {
  Body<3> body(nullptr);
  reserve(body, 2, 1, 0);
  add_vertex(body, p, start);
  add_vertex(body, q, locate(env, q, Cell{}, nullptr).cell);
  add_edge(body, 0, 1);
  body.corridors.own(0, env.obstacle_version) = before;
  SimplexSweep<3> star(env);
  PathFacets crossed;
  if (path.facets.size() <= 2) {
    crossed.is_known = true;
    for (const uint32_t facet : path.facets) crossed.facets[crossed.count++] = {facet};
  }
  const PointWay way{p, to, start, target, crossed};
  return star.ask(body, {{Simplex::kEdge, 0}, 0, way, q, nullptr, body.vertices[1].cell, {}, true});
}

TEST(SweptEdgeTest, ALineBetweenNeighboursPassesOneFacet) {
  int passed = 0, of_neighbours = 0;
  for_each_ground(std::vector<Shares>(3, {0.05, 0.1, 0, 0}), [&](Ground& ground) {
    const Environment<3>& env = ground.env;
    ground.draw(3000, [&](const Vec(&x)[4], bool) {
      const Cell first = locate(env, x[0].data(), Cell{}, nullptr).cell;
      const Cell second = locate(env, x[1].data(), Cell{}, nullptr).cell;
      if (!first.valid() || !second.valid() || first == second || env.map.marked(first)) return;
      const CastResult path = cast(env, x[0].data(), x[1].data(), first, 0, nullptr);
      const bool one = path.end == CastEnd::kReached && path_facets(env.map, first, path).count == 1;
      of_neighbours += one ? 1 : 0;
      if (!passes_between(env, first, second, x[0].data(), x[1].data())) return;
      ++passed;
      ASSERT_TRUE(one && path.cell == second);
    });
  });
  EXPECT_GT(passed, effort_of(1000));
  EXPECT_GT(of_neighbours, passed) << "it knows of standard forms only";
}

/// What a snapshot says that an edge has touched may be any two numbers.
TEST(SweptEdgeTest, NumbersOfNoVertexAreNotTouched) {
  for_each_ground({{0.1, 0, 0, 0}}, [](Ground& ground) {
    const Environment<3>& env = ground.env;
    ground.draw(3, [&](const Vec(&x)[4], bool) {
      const Cell start = locate(env, x[0].data(), Cell{}, nullptr).cell;
      const Cell fixed = locate(env, x[2].data(), Cell{}, nullptr).cell;
      if (!start.valid() || !fixed.valid()) return;
      Body<3> body(nullptr);
      reserve(body, 2, 1, 0);
      add_vertex(body, x[0].data(), start);
      add_vertex(body, x[2].data(), fixed);
      add_edge(body, 0, 1);
      body.touched.resize(2);
      const uint32_t none = env.map.vertex_count, far = 4000000000u;
      const RidgeName lines[] = {{{far, 0}}, {{0, far}}, {{none, 0}}, {{0, none}}};
      std::copy(std::begin(lines), std::end(lines), body.touched[0].lines);
      const PointWay way{x[0].data(), x[1].data(), start, start, {}};
      EXPECT_FALSE(
          pierces_touched_line(env, body, {{Simplex::kEdge, 0}, 0, way, x[2].data(), nullptr, fixed, {}, true}));
    });
  });
}

TEST(SweptEdgeTest, WhatCorridorsDecideMeetsNothing) {
  int settled = 0, of_many_cells = 0, free_but_open = 0, kept = 0, turned = 0;
  for_each_ground({{0.1, 0, 0.3, 0}, {0, 0.2, 0.1, 0}, {0, 0.05, 0.05, 0}}, [&](Ground& ground) {
    const Environment<3>& env = ground.env;
    SweepFlood<3> flood(env);
    ground.draw(10000, [&](Vec(&x)[4], bool) {
      const double by = ground.rng.chance(0.5) ? 0.05 : 0.3;
      for (size_t k = 0; k < 3; ++k) x[1][k] = x[0][k] + by * (x[1][k] - x[0][k]);
      const Cell start = locate(env, x[0].data(), Cell{}, nullptr).cell;
      const Cell target = locate(env, x[1].data(), Cell{}, nullptr).cell;
      if (!start.valid() || !target.valid() || env.map.marked(start) || env.map.marked(target)) return;
      bool known[3];
      const auto before = facets_passed(env, x[0].data(), x[2].data(), start, &known[0]);
      const auto path = facets_passed(env, x[0].data(), x[1].data(), start, &known[1]);
      const auto after = facets_passed(env, x[1].data(), x[2].data(), target, &known[2]);
      const SweepEnd end = flood.sweep(EdgeMotion{x[0].data(), x[1].data(), x[2].data()}, start, 0).end;
      const bool strip =
          known[0] && known[1] && known[2] &&
          share_corridor(env.map, {path.facets.data(), path.facets.size()}, {after.facets.data(), after.facets.size()},
                         {before.facets.data(), before.facets.size(), true});
      if (known[0] && known[1]) {
        const auto how = settled_by(env, x[0].data(), start, x[1].data(), target, x[2].data(), before, path);
        kept += how == Verdict::kHolds ? 1 : 0;
        turned += how == Verdict::kTurned ? 1 : 0;
        ASSERT_TRUE(how == Verdict::kUnknown || end == SweepEnd::kFree);
      }
      if (strip) {
        ++settled;
        of_many_cells += before.facets.size() > 1 ? 1 : 0;
        ASSERT_EQ(end, SweepEnd::kFree);
      } else {
        free_but_open += end == SweepEnd::kFree ? 1 : 0;
      }
    });
  });
  EXPECT_GT(settled, effort_of(5000));
  EXPECT_GT(of_many_cells, effort_of(500));
  EXPECT_GT(free_but_open, effort_of(500));
  EXPECT_GT(kept, effort_of(500));
  EXPECT_GT(turned, effort_of(50));
}

}  // namespace
}  // namespace dsw::swept
