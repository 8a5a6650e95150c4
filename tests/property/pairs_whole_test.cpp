// A body that meets itself and moves as a whole finds once what can come near what; one vertex alone asks the grids of
// boxes. Both ways must give the same bits, with all responses that a vertex has on its own.
#include "proximity/near_edges.h"
#include "two_bodies.h"

#include <set>

namespace dsw::oracle {
namespace {

struct Tangle {
  const char* name;
  dsw_level level;
  int shape;     // 0 a rope, 1 a tree, 2 a strip of triangles, 3 a closed rope, 4 a rope with an edge much longer
  double reach;  // of a move
  bool lattice;  // all is a multiple of an eighth
  int exponent = 0;
};
std::ostream& operator<<(std::ostream& out, const Tangle& each) { return out << each.name; }

class WholeTest : public testing::TestWithParam<Tangle> {
 protected:
  static constexpr size_t kCount = 48;

  void SetUp() override {
    scale_ = std::ldexp(1.0, GetParam().exponent);
    place_ = place_of(hex_grid(axis(4, scale_), axis(4, scale_), axis(4, scale_)));
    ASSERT_PLACE(place_);
  }

  double step(double reach) {
    return scale_ * (GetParam().lattice ? 0.125 * rng_.between(-1, 1) * std::max(1.0, std::round(8 * reach))
                                        : rng_.range(-reach, reach));
  }
  Vec beside(const Vec& p, double reach) {
    Vec q = p;
    for (double& x : q) x = std::max(0.25 * scale_, std::min(3.75 * scale_, x + step(reach)));
    return q;
  }

  /// A walk; on a lattice it goes along one axis to where it has not been.
  BodyPlan plan() {
    BodyPlan plan;
    std::set<std::array<double, 3>> taken;
    const int shape = GetParam().shape;
    plan.at.push_back({2 * scale_, 2 * scale_, 2 * scale_});
    taken.insert(plan.at[0]);
    for (int tries = 0; plan.at.size() < kCount && tries < 10000; ++tries) {
      const uint32_t last = static_cast<uint32_t>(plan.at.size()) - 1;
      const uint32_t from = shape == 1 && rng_.below(3) == 0 ? rng_.below(plan.at.size()) : last;
      Vec next = plan.at[from];
      if (GetParam().lattice) {
        next[rng_.below(3)] += 0.125 * scale_ * (rng_.below(2) == 0 ? 1 : -1);
        if (!taken.insert(next).second) continue;
      } else {
        next = beside(next, shape == 4 && last == 3 ? 1.5 : 0.3);
      }
      if (shape != 2) plan.edges.push_back({from, last + 1});
      plan.at.push_back(next);
    }
    const uint32_t count = static_cast<uint32_t>(plan.at.size());
    for (uint32_t i = 2; shape == 2 && i < count; ++i) {
      plan.faces.push_back(i % 2 == 0 ? std::vector<uint32_t>{i - 2, i - 1, i}
                                      : std::vector<uint32_t>{i - 1, i - 2, i});
    }
    if (shape == 3 && !GetParam().lattice) plan.edges.push_back({count - 1, 0});
    return plan;
  }
  /// A strip that does not touch itself.
  BodyPlan strip() const {
    BodyPlan plan;
    for (size_t i = 0; i < kCount; ++i) {
      const double angle = 0.35 * static_cast<double>(i / 2), radius = 0.5 + 0.05 * angle;
      plan.at.push_back({scale_ * (2 + radius * std::cos(angle)), scale_ * (2 + radius * std::sin(angle)),
                         scale_ * (1.7 + (i % 2 == 0 ? 0.0 : 0.3))});
    }
    for (uint32_t i = 2; i < kCount; ++i) {
      plan.faces.push_back(i % 2 == 0 ? std::vector<uint32_t>{i - 2, i - 1, i}
                                      : std::vector<uint32_t>{i - 1, i - 2, i});
    }
    return plan;
  }

  /// The bits of what moves say, and how many contacts are with the body itself.
  struct Told {
    std::string contacts, edits;
    size_t self = 0;
  };

  /// The bits of what a contact says that does not depend on the call before.
  static void add_contacts(dsw_scene* scene, dsw_body_id body, Told& told) {
    const dsw_body_contact* contacts = nullptr;
    const dsw_contact_partner* partners = nullptr;
    const dsw_body_edit* edits = nullptr;
    size_t count = 0, edit_count = 0;
    ASSERT_EQ(dsw_body_get_contacts(scene, body, &contacts, &count), DSW_STATUS_OK);
    ASSERT_EQ(dsw_body_get_contact_partners(scene, body, &partners, &count), DSW_STATUS_OK);
    for (size_t i = 0; i < count; ++i) {
      dsw_body_contact each = contacts[i];
      each.history = DSW_HISTORY_NEW;
      told.contacts.append(reinterpret_cast<const char*>(&each), sizeof each);
      told.contacts.append(reinterpret_cast<const char*>(partners + i), sizeof *partners);
      told.self += partners[i].body.index == body.index && partners[i].body.generation == body.generation ? 1 : 0;
    }
    ASSERT_EQ(dsw_body_get_edits(scene, body, &edits, &edit_count), DSW_STATUS_OK);
    told.edits.append(reinterpret_cast<const char*>(edits), edit_count * sizeof *edits);
  }

  static void move(dsw_scene* scene, dsw_body_id body, const BodyState& from, const std::vector<Vec>& targets,
                   bool whole, dsw_move_options options, Told& told) {
    std::vector<uint32_t> living;
    for (uint32_t v = 0; v < from.at.size(); ++v) {
      if (from.vertices[v].generation != 0) living.push_back(v);
    }
    BodyState now = from;
    for (size_t k = 0; k < (whole ? 1 : living.size()); ++k) {
      std::vector<Vec> all = targets;
      all.resize(now.at.size(), Vec{0, 0, 0});
      options.order = living.data() + k;
      options.order_count = whole ? living.size() : 1;
      ASSERT_EQ(dsw_body_move(scene, body, all[0].data(), all.size(), sizeof(Vec), &options, nullptr), DSW_STATUS_OK)
          << dsw_last_error_message();
      ASSERT_NO_FATAL_FAILURE(add_contacts(scene, body, told));
      ASSERT_EQ(read_body(scene, body, now), "");
    }
  }

  Rng rng_{7};
  double scale_ = 1;
  Place place_;
};

TEST_P(WholeTest, AMoveOfAllVerticesHasTheBitsOfOneAfterTheOther) {
  struct Answer {
    dsw_response vertex, edge;
  };
  constexpr Answer kAnswers[] = {{DSW_RESPONSE_STOP, DSW_RESPONSE_STOP},
                                 {DSW_RESPONSE_SLIDE, DSW_RESPONSE_SLIDE},
                                 {DSW_RESPONSE_STOP, DSW_RESPONSE_ADAPTIVE_ONE},
                                 {DSW_RESPONSE_SLIDE, DSW_RESPONSE_ADAPTIVE_SLIDE},
                                 {DSW_RESPONSE_SLIDE, DSW_RESPONSE_ADAPTIVE_MANY}};
  const auto wanted = static_cast<size_t>(std::max(10, effort_of(25)));  // twice each answer
  size_t contacts = 0, inserted = 0, bodies = 0;
  for (int round = 0; round < 60 && bodies < wanted; ++round) {
    BodyPlan made = GetParam().shape == 2 ? strip() : plan();
    // Two edges that stay in corners, so that one vertex may slide as far as all of them.
    const uint32_t corners = static_cast<uint32_t>(made.at.size());
    for (const double x : {0.02, 0.03, 3.97, 3.98}) made.at.push_back({x * scale_, x * scale_, x * scale_});
    made.edges.insert(made.edges.end(), {{corners, corners + 1}, {corners + 2, corners + 3}});
    ScenePtr scenes[2] = {make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS),
                          make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS)};
    dsw_body_id body = {0, 0};
    bool fits = true;
    BodyPlan beside_it = segment(beside(made.at[0], 1), beside(made.at[1], 1));
    for (const ScenePtr& scene : scenes) {
      fits =
          fits && create_body(scene.get(), made, GetParam().level, DSW_BODY_SELF_CONTACTS, {}, &body) == DSW_STATUS_OK;
      dsw_body_id other;
      if (fits) create_body(scene.get(), beside_it, DSW_LEVEL_EDGES, 0, {}, &other);
    }
    if (!fits) continue;
    ++bodies;
    dsw_move_options options = defaults(dsw_move_options_init);
    const Answer& answer = kAnswers[bodies % std::size(kAnswers)];
    options.vertex_response = answer.vertex;
    options.edge_response = answer.edge;
    for (int step = 0; step < 4; ++step) {
      BodyState before;
      ASSERT_EQ(read_body(scenes[0].get(), body, before), "");
      options.stand_off = step % 2 == 0 || GetParam().reach > 0.5 ? 0 : 0.3 * scale_;  // slides then leave their ways
      std::vector<Vec> targets;
      for (size_t v = 0; v < before.at.size(); ++v) {
        const bool stays = corners <= v && v < corners + 4;
        targets.push_back(stays ? before.at[v] : beside(before.at[v], GetParam().reach));
      }
      Told told[2];
      std::string after[2];
      for (int k = 0; k < 2; ++k) {
        ASSERT_NO_FATAL_FAILURE(move(scenes[k].get(), body, before, targets, k == 0, options, told[k]));
        BodyState state;
        ASSERT_EQ(read_body(scenes[k].get(), body, state), "");
        after[k] = bits_of(state);
        inserted += k == 0 ? state.at.size() - before.at.size() : 0;
      }
      ASSERT_TRUE(told[0].contacts == told[1].contacts && told[0].edits == told[1].edits)
          << "body " << bodies << ", step " << step;
      ASSERT_EQ(after[0], after[1]) << "body " << bodies << ", step " << step;
      contacts += told[0].self;
    }
  }
  EXPECT_GT(bodies, 9u);
  EXPECT_GT(contacts, wanted * 6 / 5);
  EXPECT_GT(inserted, wanted / 8);
}

INSTANTIATE_TEST_SUITE_P(Bodies, WholeTest,
                         testing::ValuesIn(drawn_for("WholeTest",
                                                     std::vector<Tangle>{
                                                         {"Rope", DSW_LEVEL_EDGES, 0, 0.1, false},
                                                         {"FastRope", DSW_LEVEL_EDGES_SWEPT, 0, 0.8, false},
                                                         {"SlowRope", DSW_LEVEL_EDGES, 0, 0.02, false},
                                                         {"LatticeRope", DSW_LEVEL_EDGES, 0, 0.125, true},
                                                         {"FastLatticeRope", DSW_LEVEL_EDGES_SWEPT, 0, 0.25, true},
                                                         {"Tree", DSW_LEVEL_EDGES, 1, 0.1, false},
                                                         {"LatticeTree", DSW_LEVEL_EDGES_SWEPT, 1, 0.125, true},
                                                         {"ClosedRope", DSW_LEVEL_EDGES, 3, 0.1, false},
                                                         {"UnevenRope", DSW_LEVEL_EDGES, 4, 0.1, false},
                                                         {"Strip", DSW_LEVEL_EDGES, 2, 0.2, false},
                                                         {"Surface", DSW_LEVEL_FACES, 2, 0.2, false},
                                                         {"TinyRope", DSW_LEVEL_EDGES, 0, 0.1, false, -300},
                                                         {"LargeRope", DSW_LEVEL_EDGES, 0, 0.1, false, 300}},
                                                     8)),
                         testing::PrintToStringParamName());

/// Random edges, of which some have a vertex in common.
class NearEdgesTest : public testing::Test {
 protected:
  NearEdgesTest() {
    constexpr size_t kEdges = 150;
    keep_boxes(body_);
    reserve(body_, 2 * kEdges, 2 * kEdges, 0);
    for (size_t e = 0; e < kEdges; ++e) {
      const bool joined = e > 0 && rng_.below(2) == 0;
      const uint32_t from = joined ? rng_.below(body_.vertices.size()) : add(random());
      add_edge(body_, from, add(near(body_.position(from), 0.6)));
    }
    for (uint32_t v = 0; v < body_.vertices.size(); ++v) targets_.push_back(near(body_.position(v), 0.2));
  }

  Vec random() { return {rng_.range(0, 3), rng_.range(0, 3), rng_.range(0, 3)}; }
  Vec near(const double* p, double reach) {
    return {p[0] + rng_.range(-reach, reach), p[1] + rng_.range(-reach, reach), p[2] + rng_.range(-reach, reach)};
  }
  uint32_t add(const Vec& at) { return add_vertex(body_, at.data(), dsw::Cell{8}); }
  void put(uint32_t v, const Vec& at) {
    put_vertex(body_, v, at.data(), dsw::Cell{8});
    near_.follow(body_, v);
  }

  /// Whether every edge that keeps to its box when an end moves on to its target visits all edges whose boxes overlap
  /// what it sweeps.
  bool visits_all(int& kept) {
    kept = 0;
    for (uint32_t e = 0; e < body_.edges.size(); ++e) {
      for (const uint32_t v : body_.edges[e].ends) {
        const double* const to = v < targets_.size() ? targets_[v].data() : body_.position(v);
        if (!near_.keeps(e, to)) continue;
        ++kept;
        dsw::Box<3> swept = box(e);
        swept.add(to);
        std::set<uint32_t> visited;
        near_.visit(e, [&](uint32_t x) { return visited.insert(x), true; });
        for (uint32_t x = 0; x < body_.edges.size(); ++x) {
          if (!share_vertex(e, x) && swept.overlaps(box(x)) && visited.count(x) == 0) return false;
        }
      }
    }
    return true;
  }
  dsw::Box<3> box(uint32_t e) const {
    dsw::Box<3> box;
    for (const uint32_t v : body_.edges[e].ends) box.add(body_.position(v));
    return box;
  }
  bool share_vertex(uint32_t e, uint32_t x) const {
    const uint32_t(&a)[2] = body_.edges[e].ends, (&b)[2] = body_.edges[x].ends;
    return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
  }

  Rng rng_{3};
  dsw::Body<3> body_{nullptr};
  std::vector<Vec> targets_;
  dsw::NearEdges near_{nullptr};
};

TEST_F(NearEdgesTest, VisitsAllThatCanComeNearWhereverVerticesGo) {
  int kept = 0, kept_at_first = 0;
  near_.start(body_, false, [&](uint32_t v) { return targets_[v].data(); });
  ASSERT_TRUE(near_.active());
  EXPECT_TRUE(visits_all(kept_at_first));
  EXPECT_EQ(kept_at_first, 300);
  for (uint32_t v = 0; v < 100; ++v) put(v, v % 20 == 0 ? random() : targets_[v]);  // the others leave their ways
  EXPECT_TRUE(visits_all(kept));
  EXPECT_TRUE(150 < kept && kept < 300) << kept;
  const uint32_t middle = add(near(body_.position(body_.edges[40].ends[0]), 0.1));
  split_edge(body_, 40, middle);
  for_each_edge(body_, middle, [&](uint32_t e) { return near_.make_stray(e), true; });
  EXPECT_TRUE(visits_all(kept));
  for (uint32_t v = 100; v < 200 && near_.active(); ++v) put(v, random());
  EXPECT_FALSE(near_.active());  // too many have left
  EXPECT_FALSE(near_.keeps(0, body_.position(body_.edges[0].ends[0])));
}

TEST_F(NearEdgesTest, LeavesToTheGridsWhatDoesNotFitIntoCells) {
  const uint32_t far = add({1e6, 1e6, 1e6});
  add_edge(body_, far, 0);
  targets_.push_back({1e6, 1e6, 1e6});
  near_.start(body_, false, [&](uint32_t v) { return targets_[v].data(); });
  EXPECT_FALSE(near_.active());
}

class WholeMemoryTest : public TwoBodies {
 protected:
  WholeMemoryTest() : TwoBodies(DSW_LEVEL_EDGES) {}
  void SetUp() override {
    MemoryTest::SetUp();
    scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS);
  }
};

TEST_F(WholeMemoryTest, AWholeMoveThatRunsOutOfMemoryPutsTheBodyBack) {
  BodyPlan plan;
  for (size_t i = 0; i < 40; ++i) {
    const double angle = 0.7 * static_cast<double>(i);
    plan.at.push_back({2 + std::cos(angle), 2 + std::sin(angle), 0.5 + 0.04 * static_cast<double>(i)});
    if (i > 0) plan.edges.push_back({static_cast<uint32_t>(i) - 1, static_cast<uint32_t>(i)});
  }
  const dsw_body_id body = make(plan, DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS);
  std::vector<Vec> targets;
  for (size_t i = 0; i < plan.at.size(); ++i) {
    targets.push_back({plan.at[i][0], plan.at[i][1], plan.at[i][2] + (i % 3 == 0 ? 0.5 : -0.1)});
  }
  dsw_move_options options = defaults(dsw_move_options_init);
  options.vertex_response = DSW_RESPONSE_SLIDE;
  options.edge_response = DSW_RESPONSE_ADAPTIVE_SLIDE;
  const std::string before = bits_of(read(body));
  until_it_succeeds(
      [&] { return dsw_body_move(scene(), body, targets[0].data(), targets.size(), sizeof(Vec), &options, nullptr); },
      [&] { return bits_of(read(body)) == before; });
  EXPECT_NE(bits_of(read(body)), before);
  const dsw_body_contact* contacts = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_body_get_contacts(scene(), body, &contacts, &count), DSW_STATUS_OK);
  EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace dsw::oracle
