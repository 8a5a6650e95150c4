// Memory that runs out at every single point of a call: nothing has changed and nothing is lost.
#include "host_memory.h"

namespace dsw::oracle {
namespace {

using BodyMemoryTest = MemoryTest;

TEST_F(BodyMemoryTest, CreatingABody) {
  dsw_body_id body = {0, 0};
  const BodyPlan plan = tetrahedron({0.5, 0.5, 0.5}, 0.75);
  const size_t before = memory_.alive;
  const size_t refusals =
      until_it_succeeds([&] { return create_body(scene(), plan, DSW_LEVEL_FACES, DSW_BODY_SEQUENCES, {}, &body); },
                        [&] { return body.generation == 0 && body_count() == 0 && memory_.alive <= before + 2; });
  EXPECT_GT(refusals, 2u);
  EXPECT_EQ(read(body).faces.size(), 4u);
}

TEST_F(BodyMemoryTest, MovingABody) {
  mark_wall(1, 1, 1);
  mark_edge(2, 2, 1);
  for (uint32_t flags : {0u, 7u}) {  // none, and all that are lossless
    for (dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
      const BodyPlan plan = tetrahedron({0.5, 1.5, 1.25}, 0.75);
      const dsw_body_id body = make(plan, level, flags), twin = make(plan, level, flags);
      std::vector<Vec> targets = plan.at;
      for (Vec& p : targets) p = {p[0] + 2.25, p[1] + 0.125, p[2]};
      dsw_move_options options = defaults(dsw_move_options_init);
      options.vertex_response = DSW_RESPONSE_SLIDE;
      options.edge_response = flags == 0 ? DSW_RESPONSE_ADAPTIVE_MANY : DSW_RESPONSE_ADAPTIVE_SLIDE;
      const std::string before = bits_of(read(body));
      dsw_move_report report, untouched;
      std::memset(&report, 0x55, sizeof report);
      untouched = report;
      until_it_succeeds(
          [&] { return dsw_body_move(scene(), body, targets[0].data(), targets.size(), 0, &options, &report); },
          [&] { return bits_of(read(body)) == before && std::memcmp(&report, &untouched, sizeof report) == 0; });
      // What failed before leaves no trace in the answer.
      BodyAnswer one, other;
      EXPECT_EQ(move_body(scene(), twin, targets, &options, other), "");
      one.after = read(body);
      EXPECT_EQ(bits_of(one.after), bits_of(other.after));
      EXPECT_EQ(std::memcmp(&report, &other.report, sizeof report), 0);
    }
  }
}

/// Many edges whose ends lie in different cells are asked about side by side. What was asked when memory ran out is forgotten.
TEST_F(BodyMemoryTest, MovingALargeBody) {
  const BodyPlan plan = ball({2, 2, 1.5}, 1.2, 80);
  std::vector<Vec> targets = plan.at;
  for (Vec& p : targets) p = {p[0] + 0.01, p[1] + 0.02, p[2] - 0.03};
  for (const uint32_t flags : {0u, uint32_t{DSW_BODY_SKIP_BACK_EDGES}}) {
    std::string undisturbed;
    size_t refused = 0;
    for (bool runs_out = true; runs_out; ++refused) {
      SCOPED_TRACE("flags " + std::to_string(flags) + " refused " + std::to_string(refused));
      scene_ = make_scene(place_.get());  // keeps no room yet
      const dsw_body_id body = make(plan, DSW_LEVEL_EDGES, flags);
      ASSERT_FALSE(HasFailure());
      const auto move = [&] {
        return dsw_body_move(scene(), body, targets[0].data(), targets.size(), 0, nullptr, nullptr);
      };
      memory_.refuse = refused == 0 ? 0 : memory_.calls + refused;
      const dsw_status status = move();
      memory_.refuse = 0;
      runs_out = refused == 0 || status == DSW_STATUS_OUT_OF_MEMORY;
      ASSERT_TRUE(status == DSW_STATUS_OK || move() == DSW_STATUS_OK);
      if (refused == 0) undisturbed = bits_of(read(body));
      ASSERT_EQ(bits_of(read(body)), undisturbed);
    }
    EXPECT_GT(refused, 10u);
  }
}

TEST_F(BodyMemoryTest, EditingABody) {
  const dsw_body_id body = make(tetrahedron({0.5, 0.5, 0.5}, 0.75), DSW_LEVEL_FACES);
  std::string before = bits_of(read(body));
  const auto unchanged = [&] { return bits_of(read(body)) == before; };
  const auto edge = read(body).edge_ids[0];
  dsw_body_edit split;
  until_it_succeeds([&] { return dsw_body_split_edge(scene(), body, edge, 0.5, &split); }, unchanged);
  before = bits_of(read(body));
  until_it_succeeds([&] { return dsw_body_collapse_edge(scene(), body, split.rest, split.vertex, nullptr); },
                    unchanged);
  before = bits_of(read(body));
  dsw_body_vertex_id vertex;
  const double at[3] = {0.25, 0.25, 0.25};
  for (int i = 0; i < 20; ++i) {  // past what was kept
    until_it_succeeds([&] { return dsw_body_add_vertex(scene(), body, at, {0, 0}, &vertex); }, unchanged);
    before = bits_of(read(body));
    dsw_body_edge_id added;
    const dsw_body_vertex_id first = read(body).vertices[0];
    until_it_succeeds([&] { return dsw_body_add_edge(scene(), body, first, vertex, &added); }, unchanged);
    before = bits_of(read(body));
  }
  until_it_succeeds([&] { return dsw_body_set_level(scene(), body, DSW_LEVEL_POINTS); }, unchanged);
  until_it_succeeds([&] { return dsw_body_set_level(scene(), body, DSW_LEVEL_FACES); }, unchanged);
}

TEST_F(BodyMemoryTest, MovingManyBodies) {
  std::vector<dsw_body_id> bodies;
  std::vector<double> targets;
  std::string before;
  for (int i = 0; i < 30; ++i) {
    const BodyPlan plan = segment({0.5, 0.5, 0.03 * i + 0.1}, {1.25, 0.75, 0.03 * i + 0.1});
    bodies.push_back(make(plan));
    for (const Vec& p : plan.at) targets.insert(targets.end(), {p[0] + 1.5, p[1] + 2, p[2] + (i % 2 == 0 ? 0.5 : 5)});
    before += bits_of(read(bodies.back()));
  }
  const size_t refusals = until_it_succeeds(
      [&] {
        return dsw_scene_move_bodies(scene(), bodies.data(), bodies.size(), targets.data(), targets.size() / 3, 0,
                                     nullptr, nullptr);
      },
      [&] {
        std::string now;
        for (dsw_body_id b : bodies) now += bits_of(read(b));
        return now == before;
      });
  EXPECT_GT(refusals, 2u);
}

/// A wire through many cells goes on until something stops it.
TEST_F(BodyMemoryTest, MovingTogether) {
  for (const bool tetrahedra : {false, true}) {
    const double unit = tetrahedra ? 4 : 1;  // as large as a cell
    BodyPlan wire;
    for (uint32_t i = 0; i < 4; ++i) {
      wire.at.push_back({unit * (0.6 + 0.9 * i), unit * (1.1 + 0.3 * i), unit * (0.8 + 0.2 * i)});
      if (i > 0) wire.edges.push_back({{i - 1, i}});
    }
    if (tetrahedra) {
      scene_.reset();
      Rng rng(3);
      place_ = place_of(delaunay(rng, 400, 16), 0, context_.get());
      ASSERT_PLACE(place_);
      scene_ = make_scene(place_.get());
    } else {
      mark_wall(2, 2, 1);
    }
    for (const dsw_together_stop stop : {DSW_TOGETHER_STOP_ALL, DSW_TOGETHER_STOP_FEATURE}) {
      dsw_together_options options = defaults(dsw_together_options_init);
      options.stop = stop;
      const dsw_body_id body = make(wire), twin = make(wire);
      ASSERT_FALSE(HasFailure());
      size_t refusals = 0;
      dsw_move_report report = {};
      for (int step = 1; step <= 8; ++step) {
        std::vector<Vec> targets;
        for (const Vec& p : wire.at) {
          targets.push_back({p[0] + 0.07 * step * unit, p[1] + 0.31 * step * unit, p[2] + 0.23 * step * unit});
        }
        const auto move = [&](dsw_body_id id) {
          return dsw_scene_move_together(scene(), &id, 1, targets[0].data(), targets.size(), 0, &options, &report);
        };
        const std::string before = bits_of(read(body));
        refusals += until_it_succeeds([&] { return move(body); }, [&] { return bits_of(read(body)) == before; });
        // What failed before leaves no trace in the answer.
        ASSERT_EQ(move(twin), DSW_STATUS_OK);
        EXPECT_EQ(bits_of(read(body)), bits_of(read(twin)));
      }
      EXPECT_GT(refusals, 20u);
      EXPECT_LT(report.fraction, 1);
    }
  }
}

TEST_F(BodyMemoryTest, AMoveThatFailedLeavesContactsAndTheirHistory) {
  mark_wall(0, 0, 0);
  const dsw_body_id body = make(segment({0.5, 0.5, 0.5}, {0.75, 0.5, 0.5}));
  const std::vector<Vec> to = {{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}};
  BodyAnswer first;
  ASSERT_EQ(move_body(scene(), body, to, nullptr, first), "");
  ASSERT_EQ(first.contacts.size(), 1u);
  const dsw_body_contact* contacts = nullptr;
  size_t count = 0;
  dsw_move_options options = defaults(dsw_move_options_init);
  options.search = DSW_SEARCH_EXHAUSTIVE;
  until_it_succeeds(
      [&] { return dsw_body_move(scene(), body, to[0].data(), to.size(), 0, &options, nullptr); },
      [&] { return dsw_body_get_contacts(scene(), body, &contacts, &count) == DSW_STATUS_OK && count == 1; });
  ASSERT_EQ(dsw_body_get_contacts(scene(), body, &contacts, &count), DSW_STATUS_OK);
  ASSERT_EQ(count, 1u);
  EXPECT_EQ(contacts[0].history, DSW_HISTORY_LASTING);
}

TEST_F(BodyMemoryTest, ARigidMoveWhoseLastVertexIsStopped) {
  mark_wall(1, 0, 0);
  // The others have arrived when the memory for the contact of the last one is asked for.
  for (int tries = 0; tries < 4; ++tries) {
    const double x = 0.5 + 0.25 * tries;
    const dsw_body_id body = make({{{0.25, 0.5, 0.5}, {0.25, 0.75, 0.5}, {x, 0.5, 0.5}}, {{0, 1}, {0, 2}}, {}});
    const std::string before = bits_of(read(body));
    dsw_rigid_motion motion;
    std::memset(&motion, 0, sizeof motion);
    motion.rotation[3] = 1;
    motion.translation[0] = 1.625;
    until_it_succeeds([&] { return dsw_body_move_rigid(scene(), body, &motion, nullptr, nullptr); },
                      [&] { return bits_of(read(body)) == before; });
  }
}

TEST_F(BodyMemoryTest, ARigidMove) {
  mark_wall(1, 0, 0);
  const dsw_body_id body = make(tetrahedron({0.5, 0.5, 0.5}, 0.25), DSW_LEVEL_FACES);
  const std::string before = bits_of(read(body));
  dsw_rigid_motion motion;
  std::memset(&motion, 0, sizeof motion);
  motion.rotation[2] = motion.rotation[3] = 1;
  motion.translation[0] = 2;
  until_it_succeeds([&] { return dsw_body_move_rigid(scene(), body, &motion, nullptr, nullptr); },
                    [&] { return bits_of(read(body)) == before; });
}

// A move that fails while casts wait in its packet must not leave them to the next one, which has other targets and may
// be smaller.
TEST_F(BodyMemoryTest, AMoveThatFailedLeavesNoCastsBehind) {
  scene_ = make_scene(place_.get(), DSW_FEATURE_STATISTICS);
  const auto casts = [&] {
    dsw_statistics statistics = {};
    statistics.struct_size = sizeof statistics;
    EXPECT_EQ(dsw_scene_get_statistics(scene(), &statistics), DSW_STATUS_OK);
    return statistics.casts;
  };
  BodyPlan fan = {{{0.5, 0.5, 0.5}}, {}, {}};
  for (uint32_t i = 1; i <= 30; ++i) {
    fan.at.push_back({1.5 + 0.03125 * i, 1.5, 1.25});
    fan.edges.push_back({{0, i}});
  }
  std::vector<Vec> targets = fan.at;
  for (Vec& p : targets) p = {p[0] + 0.5, p[1] + 0.5, p[2] + 0.5};
  mark_wall(2, 2, 1);
  for (dsw_level level : {DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT}) {
    const dsw_body_id body = make(fan, level, DSW_BODY_SEQUENCES);
    const dsw_body_id small = make({{{0.5, 0.5, 0.5}}, {}, {}}, DSW_LEVEL_POINTS);
    double x = 0.5;
    size_t most = 0;
    until_it_succeeds(
        [&] { return dsw_body_move(scene(), body, targets[0].data(), targets.size(), 0, nullptr, nullptr); },
        [&] {
          const size_t before = casts();
          x = x < 0.75 ? x + 0.001 : 0.5;
          BodyAnswer answer;
          EXPECT_EQ(move_body(scene(), small, {{x, 0.5, 0.5}}, nullptr, answer), "");
          most = std::max(most, static_cast<size_t>(casts() - before));
          return casts() - before == 1;
        });
    EXPECT_LE(most, 1u);
  }
}

}  // namespace
}  // namespace dsw::oracle
