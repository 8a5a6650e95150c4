// Contacts that are found from what a body remembers have the bits of those of a body without memory, also where the
// environment has changed since.
#include "body_scenes.h"
#include "body_support.h"
#include "plane_arena.h"
#include "plane_scenes.h"
#include "sweep_scenes.h"

#include <algorithm>
#include <array>
#include <set>

namespace dsw::oracle {
namespace {

/// Without ids' generations and without history, which only the body that has lived longer has.
std::string bits_of_answer(const BodyAnswer& a) {
  std::string text;
  char line[400];
  for (const dsw_body_contact& c : a.contacts) {
    text += hex(c.from) + hex(c.to) + hex(c.fixed[0]) + hex(c.fixed[1]) + hex(c.position) + hex(c.point);
    std::snprintf(line, sizeof line, " t %a e %a d %a v %u e %u %d f %u %d", c.time, c.edge_parameter, c.distance_left,
                  c.vertex.index, c.edge.index, c.edge.generation != 0, c.face.index, c.face.generation != 0);
    text += line + bits_of(c.contact) + "\n";
  }
  for (size_t v = 0; v < a.after.at.size(); ++v) {
    text += hex(a.after.at[v]) + std::to_string(a.after.volumes[v].index) + "." +
            std::to_string(a.after.volumes[v].generation) + "\n";
  }
  for (const auto& e : a.after.edges) text += std::to_string(e[0]) + "-" + std::to_string(e[1]) + " ";
  std::snprintf(line, sizeof line, "moved %u stopped %u edits %u", a.report.vertices_moved, a.report.vertices_stopped,
                a.report.edit_count);
  return text + line;
}

bool is_living(const BodyState& s) {
  return std::all_of(s.vertices.begin(), s.vertices.end(), [](const auto& v) { return v.generation != 0; });
}

BodyPlan plan_of(const BodyState& s) {
  BodyPlan plan{s.at, s.edges, {}};
  for (const auto& f : s.faces) plan.faces.emplace_back(f.begin(), f.end());
  return plan;
}

enum class Change { kNone, kMarks, kShape, kTopology };

/// One environment, bodies in it, and what they are sent through.
class Course {
 public:
  Course(Arena& arena, Places& places, dsw_environment* environment, Rng& rng)
      : arena_(arena), places_(places), environment_(environment), rng_(rng) {}

  /// One body, step after step, with and without memory.
  void run(dsw_level level, Change change, int steps);

  size_t contacts = 0, at_edges = 0, repeated = 0, inserted = 0, changed = 0, bodies = 0;
  std::string name;

 private:
  using Met = std::set<std::array<uint32_t, 5>>;  // by vertex and edge of the body, what was met

  std::vector<Vec> next_targets(const BodyState& now);
  dsw_move_options next_options(dsw_level level);
  void compare(dsw_scene* deforming, const BodyState& before, dsw_level level, uint32_t flags, uint32_t max_volumes,
               const std::vector<Vec>& targets, dsw_move_options options, const std::string& bits,
               const std::string& how);
  Met names_of(const std::vector<dsw_body_contact>& found) const;
  void change_environment(Change change, const std::vector<dsw_body_contact>& last);
  void change_marks(const dsw_body_contact& near);
  void change_topology(const dsw_body_contact& near);
  void deform();

  Arena& arena_;
  Places& places_;
  dsw_environment* environment_;
  Rng& rng_;
  Vec way_ = {0, 0, 0};
  std::vector<double> lent_[2];
  int lends_ = 0;
  bool as_made_ = true;  // the arena still is what the environment is
  bool broken_ = false;  // far from bodies a deformation need not leave volumes valid
};

std::vector<Vec> Course::next_targets(const BodyState& now) {
  std::vector<Vec> targets = now.at;
  const double size = arena_.size();
  if (rng_.chance(0.12)) {  // into another wall
    const Vec site = places_.site();
    static const double reaches[] = {0.01, 0.03, 0.1, 0.3, 1};
    const double reach = reaches[rng_.below(5u)];
    for (size_t k = 0; k < arena_.dimension; ++k) way_[k] = reach * (site[k] - now.at[0][k]);
  }
  static const double jitters[] = {0, 0, 0.001, 0.01, 0.05};
  const double jitter = jitters[rng_.below(5u)];
  const bool alone = rng_.chance(0.3);
  const uint32_t one = rng_.below(targets.size());
  for (uint32_t v = 0; v < targets.size(); ++v) {
    if (alone && v != one) continue;
    for (size_t k = 0; k < arena_.dimension; ++k) {
      targets[v][k] += way_[k] + jitter * size * rng_.range(-1, 1);
      if (!std::isfinite(targets[v][k])) targets[v][k] = now.at[v][k];
    }
  }
  return targets;
}

dsw_move_options Course::next_options(dsw_level level) {
  dsw_move_options options = defaults(dsw_move_options_init);
  static const dsw_response edges[] = {
      DSW_RESPONSE_STOP,         DSW_RESPONSE_STOP,           DSW_RESPONSE_SLIDE,         DSW_RESPONSE_SLIDE,
      DSW_RESPONSE_ADAPTIVE_ONE, DSW_RESPONSE_ADAPTIVE_SLIDE, DSW_RESPONSE_ADAPTIVE_MANY, DSW_RESPONSE_HYBRID};
  options.vertex_response = rng_.chance(0.5) ? DSW_RESPONSE_STOP : DSW_RESPONSE_SLIDE;
  options.edge_response = edges[rng_.below(level == DSW_LEVEL_FACES ? 5u : 8u)];
  if (rng_.chance(0.4)) options.flags = DSW_MOVE_KEEP_WALLS;
  if (rng_.chance(0.15)) options.passes = 3;
  if (rng_.chance(0.1)) options.search = DSW_SEARCH_EXHAUSTIVE;
  if (rng_.chance(0.3)) options.stand_off = -1;
  return options;
}

Course::Met Course::names_of(const std::vector<dsw_body_contact>& found) const {
  Met met;
  for (const dsw_body_contact& c : found) {
    if (c.edge.generation == 0 || c.contact.obstacle.kind == DSW_CELL_NONE) continue;
    met.insert({c.vertex.index, c.edge.index, c.contact.obstacle.index, c.contact.obstacle.local,
                static_cast<uint32_t>(c.contact.obstacle.kind)});
  }
  return met;
}

void Course::compare(dsw_scene* deforming, const BodyState& before, dsw_level level, uint32_t flags,
                     uint32_t max_volumes, const std::vector<Vec>& targets, dsw_move_options options,
                     const std::string& bits, const std::string& how) {
  // An environment that is deformed has one scene.
  const ScenePtr own = deforming != nullptr ? nullptr : make_scene(environment_);
  dsw_scene* const scene = deforming != nullptr ? deforming : own.get();
  dsw_body_id fresh = {0, 0};
  ASSERT_EQ(create_body(scene, plan_of(before), level, flags, before.volumes, &fresh), DSW_STATUS_OK)
      << how << " " << dsw_last_error_message();
  options.max_volumes = max_volumes;
  BodyAnswer answer;
  ASSERT_EQ(move_body(scene, fresh, targets, &options, answer), "") << how;
  ASSERT_EQ(bits, bits_of_answer(answer)) << how;
  ASSERT_EQ(dsw_body_destroy(scene, fresh), DSW_STATUS_OK);
}

void Course::change_marks(const dsw_body_contact& near) {
  const dsw_contact& c = near.contact;
  const dsw_mark mark = rng_.chance(0.5) ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE;
  dsw_status status = DSW_STATUS_OK;
  if (rng_.chance(0.4)) {  // what was touched is gone, or what stands behind it is
    if (c.wall.generation != 0 && rng_.chance(0.8)) {
      status = dsw_environment_mark_faces(environment_, &c.wall, 1, DSW_MARK_PASSABLE);
    }
    if (status == DSW_STATUS_OK && c.behind.generation != 0) {
      status = dsw_environment_mark_volumes(environment_, &c.behind, 1, DSW_MARK_PASSABLE, 0, nullptr);
    }
    changed += status == DSW_STATUS_OK ? 1 : 0;
    return;
  }
  switch (rng_.below(arena_.dimension == 3 ? 5u : 4u)) {
    case 0:
      status = dsw_environment_mark_volumes(environment_, &c.front, 1, DSW_MARK_IMPASSABLE, 0, nullptr);
      break;
    case 1:
      if (c.behind.generation == 0) return;
      status = dsw_environment_mark_volumes(environment_, &c.behind, 1, mark, 0, nullptr);
      break;
    case 2:
      if (c.wall.generation == 0) return;
      status = dsw_environment_mark_faces(environment_, &c.wall, 1, mark);
      break;
    case 3: {
      const dsw_face_id face = {c.front.index, c.front.generation, rng_.below(4u)};
      status = dsw_environment_mark_faces(environment_, &face, 1, mark);
      break;
    }
    default: {
      const dsw_edge_id edge = c.obstacle.kind == DSW_CELL_EDGE
                                   ? dsw_edge_id{c.obstacle.index, c.obstacle.generation, c.obstacle.local}
                                   : dsw_edge_id{c.front.index, c.front.generation, rng_.below(6u)};
      status = dsw_environment_mark_edges(environment_, &edge, 1, mark);
    }
  }
  changed += status == DSW_STATUS_OK ? 1 : 0;
}

void Course::change_topology(const dsw_body_contact& near) {
  const dsw_contact& c = near.contact;
  dsw_status status = DSW_STATUS_OK;
  switch (rng_.below(5u)) {
    case 0: {
      if (c.obstacle.kind != DSW_CELL_EDGE) return;
      dsw_vertex_id vertex;
      dsw_edge_id parts[2];
      status = dsw_environment_split_edge(environment_, {c.obstacle.index, c.obstacle.generation, c.obstacle.local},
                                          rng_.range(0.2, 0.8), &vertex, parts);
      break;
    }
    case 1: {
      if (c.front.generation == 0) return;
      status = dsw_environment_unsew_face(environment_, {c.front.index, c.front.generation, rng_.below(4u)});
      break;
    }
    case 2: {
      const dsw_face_id face = {c.front.index, c.front.generation, rng_.below(4u)};
      const dsw_cut_face crack = {face, face};
      dsw_open_crack_desc desc = defaults(dsw_open_crack_desc_init);
      desc.faces = &crack;
      desc.face_count = 1;
      desc.width = 0.01 * arena_.size();
      status = dsw_environment_open_crack(environment_, &desc, nullptr);
      break;
    }
    default: {
      const double size = arena_.size() * rng_.range(0.05, 0.3);
      double blade[12];
      Vec at, a, b;
      for (size_t k = 0; k < 3; ++k) {
        at[k] = near.point[k] + 0.1 * size * rng_.range(-1, 1);
        a[k] = size * rng_.range(-1, 1);
        b[k] = size * rng_.range(-1, 1);
      }
      for (size_t k = 0; k < 3; ++k) {
        blade[k] = at[k] - a[k] - b[k];
        blade[3 + k] = at[k] + a[k] - b[k];
        blade[6 + k] = at[k] - a[k] + b[k];
        blade[9 + k] = at[k] + a[k] + b[k];
      }
      dsw_cut_desc desc = defaults(dsw_cut_desc_init);
      desc.flags = rng_.chance(0.6) ? DSW_CUT_UNSEW : 0;
      desc.points = blade;
      desc.rows = desc.columns = 2;
      status = dsw_environment_cut(environment_, &desc, nullptr);
    }
  }
  as_made_ = as_made_ && status != DSW_STATUS_OK;
  changed += status == DSW_STATUS_OK ? 1 : 0;
}

void Course::deform() {
  const double* points = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_environment_get_points(environment_, &points, &count), DSW_STATUS_OK);
  std::vector<double>& next = lent_[lends_ % 2];
  next.assign(points, points + arena_.dimension * count);
  static const double shares[] = {1e-6, 1e-4, 1e-3, 1e-2};
  const double by = arena_.size() * shares[rng_.below(4u)];
  for (double& x : next) {
    if (rng_.chance(0.3)) x += by * rng_.range(-1, 1);
  }
  dsw_deform_report report;
  const dsw_status status = dsw_environment_deform(environment_, next.data(), count, nullptr, &report);
  ASSERT_EQ(status, DSW_STATUS_OK) << dsw_last_error_message();
  if (report.outcome != DSW_DEFORM_REFUSED) ++lends_;
  as_made_ = false;
  broken_ = broken_ || dsw_environment_check(environment_, nullptr) != DSW_STATUS_OK;
  ++changed;
}

void Course::change_environment(Change change, const std::vector<dsw_body_contact>& last) {
  if (last.empty()) return;
  const dsw_body_contact& near = last[rng_.below(last.size())];
  if (change == Change::kMarks) change_marks(near);
  if (change == Change::kTopology) change_topology(near);
  if (change == Change::kShape) deform();
}

void Course::run(dsw_level level, Change change, int steps) {
  if (broken_) return;
  Bodies source(arena_, places_, rng_, level);
  const ScenePtr scene = make_scene(environment_, change == Change::kShape ? DSW_FEATURE_DEFORMING : 0);
  static const uint32_t kinds[] = {0, DSW_BODY_SEQUENCES, DSW_BODY_NO_SEQUENCES,
                                   DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BY_CLEARANCE};
  const uint32_t flags = kinds[rng_.below(4u)];
  dsw_body_id body = {0, 0};
  dsw_status made = DSW_STATUS_INTERNAL;
  for (int tries = 0; tries < 6 && made != DSW_STATUS_OK; ++tries) {
    made = create_body(scene.get(), source.next(), level, flags, {}, &body);
  }
  if (made != DSW_STATUS_OK) return;
  ++bodies;
  BodyState now;
  ASSERT_EQ(read_body(scene.get(), body, now), "");
  dsw_scene* const deforming = change == Change::kShape ? scene.get() : nullptr;
  Met met;
  std::vector<dsw_body_contact> last;
  const bool wild = rng_.chance(0.3);
  bool remade = false;
  for (int step = 0; step < steps; ++step) {
    if (change != Change::kNone && rng_.chance(0.3)) {
      ASSERT_NO_FATAL_FAILURE(change_environment(change, last));
      ASSERT_EQ(read_body(scene.get(), body, now), "");
    }
    if (broken_ || now.at.size() > 60 || !is_living(now)) return;
    if (remade) {
      // Round a vertex the edges of a body that was edited have another order.
      ASSERT_EQ(dsw_body_destroy(scene.get(), body), DSW_STATUS_OK);
      ASSERT_EQ(create_body(scene.get(), plan_of(now), level, flags, now.volumes, &body), DSW_STATUS_OK) << name;
      ASSERT_EQ(read_body(scene.get(), body, now), "");
    }
    dsw_move_options options = next_options(level);
    const std::vector<Vec> targets =
        wild && as_made_ && rng_.chance(0.4) ? source.move(now).targets : next_targets(now);
    BodyAnswer answer;
    ASSERT_EQ(move_body(scene.get(), body, targets, &options, answer), "") << name;
    const std::string bits = bits_of_answer(answer);
    const std::string how = name + " level " + std::to_string(level) + " flags " + std::to_string(flags) + " change " +
                            std::to_string(static_cast<int>(change)) + " body " + std::to_string(bodies) + " step " +
                            std::to_string(step);
    // The work limit is never met: it only makes every sweep a flood.
    ASSERT_NO_FATAL_FAILURE(compare(deforming, now, level, 0, 1u << 30, targets, options, bits, how + " (floods)"));
    if (rng_.chance(0.3)) {
      ASSERT_NO_FATAL_FAILURE(compare(deforming, now, level, flags, 0, targets, options, bits, how + " (fresh)"));
    }
    contacts += answer.contacts.size();
    const Met names = names_of(answer.contacts);
    at_edges += names.size();
    for (const auto& each : names) repeated += met.count(each);
    met = names;
    inserted += answer.after.at.size() - now.at.size();
    last = answer.contacts;
    remade = answer.report.edit_count != 0;
    now = answer.after;
  }
}

struct Ways {
  const char* name;
  std::vector<const char*> scenes;
};

std::ostream& operator<<(std::ostream& out, const Ways& ways) { return out << ways.name; }

class WarmContactsTest : public testing::TestWithParam<Ways> {};

constexpr dsw_level kLevels[] = {DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT,
                                 DSW_LEVEL_FACES};

TEST_P(WarmContactsTest, HaveTheBitsOfFloods) {
  const auto rounds = static_cast<uint64_t>(std::max(2, effort_of(5)));
  const int steps = std::clamp(effort_of(12), 8, 12);
  size_t contacts = 0, at_edges = 0, repeated = 0, changed = 0, bodies = 0;
  for (const char* const scene : GetParam().scenes) {
    const std::vector<SweepTurn> turns = sweep_turns(scene);
    for (uint64_t seed = 1; seed <= rounds; ++seed) {
      Rng rng(seed);
      SweepReport report;
      const std::unique_ptr<Stage> stage = make_stage(turns[rng.below(turns.size())], seed, rng, report);
      if (stage == nullptr) continue;
      stage->mark_vertices(rng, report);
      SpaceArena arena(stage->world, stage->marked_edges, stage->marked_vertices);
      StagePlaces places(*stage, rng);
      Course course(arena, places, stage->environment.get(), rng);
      course.name = std::string(scene) + " seed " + std::to_string(seed);
      // An environment that has been deformed has points of the test: its topology can no longer grow.
      const Change last = rng.chance(0.5) ? Change::kShape : Change::kTopology;
      for (const Change change : {Change::kNone, Change::kNone, Change::kMarks, last}) {
        for (const dsw_level level : kLevels) {
          ASSERT_NO_FATAL_FAILURE(course.run(level, change, steps));
        }
      }
      contacts += course.contacts;
      at_edges += course.at_edges;
      repeated += course.repeated;
      changed += course.changed;
      bodies += course.bodies;
    }
  }
  EXPECT_GT(bodies, 10 * rounds);
  const uint64_t dozens = rounds * static_cast<uint64_t>(steps) / 12;
  EXPECT_GT(at_edges, 100 * dozens);
  EXPECT_GT(repeated, 20 * dozens) << "of " << contacts << " contacts";
  EXPECT_GT(changed, 10 * dozens);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, WarmContactsTest,
    testing::ValuesIn(drawn_for("WarmContactsTest",
                                std::vector<Ways>{{"Delaunay", {"wide_delaunay", "tet_random"}},
                                                  {"Lattice", {"tet_lattice", "tet_kuhn"}},
                                                  {"Slivers", {"tet_slivers", "waist_slivers"}},
                                                  {"Hexahedra", {"hex", "wide_hexes"}},
                                                  {"Warped", {"hex_warped", "wide_warped", "hex_warped_lattice"}},
                                                  {"Others", {"pyramids", "prisms", "polyhedra", "voronoi", "mixed"}}},
                                8)),
    [](const auto& each) { return std::string(each.param.name); });

/// An edge touches the rim of a column of marked tetrahedra; then some of these are opened, and it goes on.
TEST(WarmContactsOfTetrahedraTest, WhatWasOpenedStopsNobody) {
  static const int paths[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  const Mesh cubes = hex_grid(axis(4, 1), axis(4, 1), axis(3, 1));
  size_t touched = 0, freed = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    Mesh mesh;
    mesh.points = cubes.points;
    for (const Cell& c : cubes.cells) {
      for (const auto& path : paths) {
        std::vector<int> v;
        for (const int i : path) v.push_back(c.vertices[static_cast<size_t>(i)]);
        mesh.add_standard(DSW_CELL_TYPE_TETRA, v);
      }
    }
    const Place place = place_of(std::move(mesh));
    ASSERT_PLACE(place);
    std::vector<dsw_volume_id> column, opened;
    for (size_t z = 0; z < 3; ++z) {
      const auto first = place.world->ids.begin() + static_cast<std::ptrdiff_t>(6 * (2 + 4 * (2 + 4 * z)));
      column.insert(column.end(), first, first + 6);
    }
    const auto mark = [&](const std::vector<dsw_volume_id>& ids, dsw_mark as) {
      return dsw_environment_mark_volumes(place.get(), ids.data(), ids.size(), as, 0, nullptr);
    };
    ASSERT_EQ(mark(column, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    const auto near = [&](double x, double y, double z) {
      return Vec{x + rng.range(-0.05, 0.05), y + rng.range(-0.05, 0.05), z + rng.range(-0.3, 0.3)};
    };
    const BodyPlan plan = segment(near(1.2, 2.5, 1.5), near(2.6, 1.15, 1.5));
    const std::vector<Vec> targets = {near(1.75, 2.9, 1.5), plan.at[1]};
    const ScenePtr scene = make_scene(place.get());
    dsw_body_id body = {0, 0};
    ASSERT_EQ(create_body(scene.get(), plan, DSW_LEVEL_EDGES_SWEPT, 0, {}, &body), DSW_STATUS_OK);
    const dsw_move_options options = defaults(dsw_move_options_init);
    BodyAnswer answer;
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(move_body(scene.get(), body, targets, &options, answer), "");
      touched += answer.contacts.empty() ? 0 : 1;
    }
    for (const dsw_volume_id id : column) {
      if (seed % 3 == 0 || rng.chance(0.7)) opened.push_back(id);
    }
    ASSERT_EQ(mark(opened, DSW_MARK_PASSABLE), DSW_STATUS_OK);
    const ScenePtr other = make_scene(place.get());
    dsw_body_id fresh = {0, 0};
    BodyPlan now = plan;
    now.at = answer.after.at;
    ASSERT_EQ(create_body(other.get(), now, DSW_LEVEL_EDGES_SWEPT, 0, answer.after.volumes, &fresh), DSW_STATUS_OK);
    BodyAnswer expected;
    ASSERT_EQ(move_body(other.get(), fresh, targets, &options, expected), "");
    ASSERT_EQ(move_body(scene.get(), body, targets, &options, answer), "");
    EXPECT_EQ(bits_of_answer(answer), bits_of_answer(expected)) << "seed " << seed;
    freed += answer.contacts.empty() ? 1 : 0;
  }
  EXPECT_EQ(touched, 180u);
  EXPECT_GT(freed, 15u);
}

TEST(WarmContactsInThePlaneTest, HaveTheBitsOfFloods) {
  const auto rounds = seeds_of(30);
  const std::vector<plane::Turn> turns = plane::turns("");
  size_t contacts = 0, repeated = 0;
  for (uint64_t seed = 1; seed <= rounds; ++seed) {
    Rng rng(seed);
    const plane::Turn& turn = turns[rng.below(turns.size())];
    plane::World world = plane::make_world(turn, rng);
    const EnvironmentPtr environment = plane::make_environment(turn, world, rng);
    if (environment == nullptr) continue;
    std::vector<int> marked;
    ASSERT_EQ(plane::mark(world, environment.get(), {0.1, 0.1, 0.05}, rng, marked), "");
    PlaneArena arena(world, marked);
    PlanePlaces places(world, arena, marked, rng);
    Course course(arena, places, environment.get(), rng);
    course.name = turn.name() + " seed " + std::to_string(seed);
    for (const Change change : {Change::kNone, Change::kMarks, Change::kShape}) {
      for (const dsw_level level : {DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT}) {
        ASSERT_NO_FATAL_FAILURE(course.run(level, change, 12));
      }
    }
    contacts += course.contacts;
    repeated += course.repeated;
  }
  EXPECT_GT(contacts, 50 * rounds);
  EXPECT_GT(repeated, 2 * rounds);
}

}  // namespace
}  // namespace dsw::oracle
