// Many moves of thick bodies that meet, between walls that move.
#include "thick_checks.h"

namespace dsw::oracle {
namespace {

Mesh warped_box(Rng& rng) {
  Mesh mesh = hex_grid(axis(6, 1), axis(6, 1), axis(6, 1));
  for (Vec& p : mesh.points) {
    for (double& x : p) x += rng.range(-0.15, 0.15);
  }
  return mesh;
}

/// Bodies, walls that wander round where they were, and how often a distance was not kept.
class ThickCourse {
 public:
  explicit ThickCourse(uint64_t seed) : rng_(seed), place_(place_of(warped_box(rng_))) {
    mark();
    handle_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_DEFORMING);
    scene_ = std::make_unique<ThickScene>(handle_.get(), true);
    ask();
  }
  ~ThickCourse() {
    handle_.reset();
    place_.environment.reset();  // before the points that it reads
  }

  void go(uint64_t wanted) {
    for (uint64_t round = 0; moves < wanted; ++round) {
      if (round % 3 == 2) {
        move_together(round);
      } else {
        for (size_t i = 0; i < scene_->bodies.size(); ++i) move(i, round);
      }
      if (round % 8 == 7) deform();
      for (size_t i = 0; i < scene_->bodies.size(); ++i) ask(i);
      if (round % 4 == 3) check_exactly(rng_.below(scene_->bodies.size()));
    }
  }
  size_t body_count() const { return scene_->bodies.size(); }

  uint64_t moves = 0, contacts = 0, deformations = 0, pushed = 0, violations = 0, exact_checks = 0;
  double tolerance_max = 0;  // largest share of a distance that was missing, by exact distances
  double largest_depth = 0;  // by dsw_body_find_least_gap, of the radius
  std::string first;

 private:
  void mark() {
    for (const dsw_volume_id volume : place_.world->ids) {
      if (rng_.chance(0.05)) {
        EXPECT_EQ(dsw_environment_mark_volumes(place_.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr),
                  DSW_STATUS_OK);
      }
      const dsw_face_id face = {volume.index, volume.generation, rng_.below(6u)};
      if (rng_.chance(0.15)) {
        EXPECT_EQ(dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
      }
      const dsw_edge_id edge = {volume.index, volume.generation, rng_.below(12u)};
      if (rng_.chance(0.1)) {
        EXPECT_EQ(dsw_environment_mark_edges(place_.get(), &edge, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
      }
    }
    first_ = place_.mesh.points;
  }
  void ask() {
    for (int tries = 0; tries < 2000 && scene_->bodies.size() < 24; ++tries) {
      const Vec at = {rng_.range(0.3, 5.7), rng_.range(0.3, 5.7), rng_.range(0.3, 5.7)};
      const auto near = [&](double reach) {
        return Vec{at[0] + rng_.range(-reach, reach), at[1] + rng_.range(-reach, reach),
                   at[2] + rng_.range(-reach, reach)};
      };
      BodyPlan plan;
      const uint32_t kind = rng_.below(4u);
      if (kind == 0) plan = {{at}, {}, {}};
      if (kind == 1) plan = tetrahedron_at(at, rng_.range(0.1, 0.5));
      if (kind >= 2) {
        plan.at.push_back(at);
        for (uint32_t v = 1; v < 3 + 2 * kind; ++v) {
          plan.at.push_back(near(0.5));
          plan.edges.push_back({v - 1, v});
        }
      }
      const double radius = 0.01 * std::pow(2, rng_.below(5u));
      scene_->create(plan, kind == 1 ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT, tries % 7 == 0 ? 0 : radius,
                     kind == 3 ? DSW_BODY_SELF_CONTACTS : 0);
    }
  }
  static BodyPlan tetrahedron_at(const Vec& p, double size) {
    return {{p, {p[0] + size, p[1], p[2]}, {p[0], p[1] + size, p[2]}, {p[0], p[1], p[2] + size}},
            {},
            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  }

  static dsw_move_options options_of(uint64_t round) {
    dsw_move_options options = defaults(dsw_move_options_init);
    if (round % 2 == 1) options.vertex_response = options.edge_response = DSW_RESPONSE_SLIDE;
    if (round % 7 == 3) options.flags = DSW_MOVE_KEEP_WALLS;
    if (round % 5 == 4) options.passes = 2;
    return options;
  }
  void add_targets(size_t i, std::vector<Vec>& targets) {
    const double own = rng_.chance(0.5) ? 0.1 : 0;
    const Vec way = {rng_.range(-0.5, 0.5), rng_.range(-0.5, 0.5), rng_.range(-0.5, 0.5)};
    for (Vec p : scene_->bodies[i].state.at) {
      for (size_t k = 0; k < 3; ++k) p[k] += way[k] + rng_.range(-own, own);
      targets.push_back(p);
    }
  }
  void count(const dsw_move_report& report) {
    moves += report.vertices_moved;
    contacts += report.contact_count;
  }
  void move(size_t i, uint64_t round) {
    const dsw_move_options options = options_of(round);
    std::vector<Vec> targets;
    add_targets(i, targets);
    dsw_move_report report;
    ASSERT_EQ(dsw_body_move(handle_.get(), scene_->bodies[i].id, targets[0].data(), targets.size(), sizeof(Vec),
                            &options, &report),
              DSW_STATUS_OK);
    count(report);
    scene_->read(i);
  }
  void move_together(uint64_t round) {
    const dsw_move_options options = options_of(round);
    std::vector<dsw_body_id> ids;
    std::vector<Vec> targets;
    for (size_t i = 0; i < scene_->bodies.size(); ++i) {
      ids.push_back(scene_->bodies[i].id);
      add_targets(i, targets);
    }
    std::vector<dsw_move_report> reports(ids.size());
    ASSERT_EQ(dsw_scene_move_bodies(handle_.get(), ids.data(), ids.size(), targets[0].data(), targets.size(),
                                    sizeof(Vec), &options, reports.data()),
              DSW_STATUS_OK);
    for (const dsw_move_report& report : reports) count(report);
    scene_->read_all();
  }
  void deform() {
    lent_[deformations % 2].resize(3 * first_.size());
    std::vector<double>& next = lent_[deformations % 2];
    for (size_t p = 0; p < first_.size(); ++p) {
      for (size_t k = 0; k < 3; ++k) next[3 * p + k] = first_[p][k] + rng_.range(-0.08, 0.08);
    }
    dsw_deform_options options = defaults(dsw_deform_options_init);
    options.method = rng_.chance(0.8) ? DSW_DEFORM_SWEPT : DSW_DEFORM_END_STATE;
    const dsw_wall_response responses[] = {DSW_WALL_PUSH, DSW_WALL_PUSH, DSW_WALL_HOLD, DSW_WALL_STOP};
    options.response = responses[rng_.below(options.method == DSW_DEFORM_SWEPT ? 4u : 2u)];
    options.most_halvings = 4;
    dsw_deform_report report{};
    ASSERT_EQ(dsw_environment_deform(place_.get(), next.data(), first_.size(), &options, &report), DSW_STATUS_OK);
    ++deformations;
    pushed += report.pushed_count;
    scene_->read_all();
    scene_->read_obstacles();
  }
  void ask(size_t i) {
    double gap = 0;
    const double radius = scene_->bodies[i].radius;
    ASSERT_EQ(dsw_body_find_least_gap(handle_.get(), scene_->bodies[i].id, 0.1, &gap), DSW_STATUS_OK);
    if (radius == 0 || gap >= -0x1p-30 * 2 * (radius + 0.16)) return;
    largest_depth = std::max(largest_depth, -gap / radius);
    note("gap " + number(gap) + " of radius " + number(radius));
  }
  void check_exactly(size_t i) {
    ++exact_checks;
    const std::string found = scene_->too_near(i);
    if (!found.empty()) note(found);
    tolerance_max = std::max(tolerance_max, scene_->missing(i));
  }
  void note(const std::string& what) {
    if (violations++ == 0) first = "after " + std::to_string(moves) + " moves: " + what;
  }

  Rng rng_;
  Place place_;
  std::vector<Vec> first_;
  std::vector<double> lent_[2];
  ScenePtr handle_;
  std::unique_ptr<ThickScene> scene_;
};

TEST(ThickLong, ManyMovesKeepEveryDistance) {
  const uint64_t wanted = static_cast<uint64_t>(effort_of(20000));
  ThickCourse course(1);
  ASSERT_GT(course.body_count(), 12u);
  course.go(wanted);
  const std::pair<const char*, std::string> all[] = {
      {"moves", std::to_string(course.moves)},
      {"contacts", std::to_string(course.contacts)},
      {"deformations", std::to_string(course.deformations)},
      {"pushed", std::to_string(course.pushed)},
      {"exact_checks", std::to_string(course.exact_checks)},
      {"violations", std::to_string(course.violations)},
      {"tolerance_max", std::to_string(course.tolerance_max * 1e9) + "e-9"},
      {"gap_depth_max", std::to_string(course.largest_depth)}};
  for (const auto& [name, value] : all) {
    RecordProperty(name, value);
    std::printf("%s: %s\n", name, value.c_str());
  }
  EXPECT_EQ(course.violations, 0u) << course.first;
  EXPECT_LE(course.tolerance_max, 0x1p-30);
}

}  // namespace
}  // namespace dsw::oracle
