// Thick bodies of which all vertices move at once, between walls that stand or move, with every response: every distance is kept at
// every time of the way, and what stops is as near to something as it may be. Figures are printed.
#include "thick_checks.h"
#include "thick_reach.h"

#include <deque>

namespace dsw::oracle {
namespace {

class ThickTogether {
 public:
  explicit ThickTogether(uint64_t seed) : rng_(seed), place_(make_place(rng_)) {
    mark();
    handle_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_DEFORMING);
    scene_ = std::make_unique<ThickScene>(handle_.get(), true);
    reach_ = std::make_unique<ThickReach>(place_.get(), scene_->points());
    make_bodies();
  }
  ~ThickTogether() {
    handle_.reset();
    place_.environment.reset();  // before the points that it reads
  }

  void go(uint64_t wanted) {
    for (uint64_t round = 0; moves < wanted; ++round) {
      ThickScene before = *scene_;
      targets_.clear();
      ids_.clear();
      for (size_t i = 0; i < scene_->bodies.size(); ++i) {
        if (rng_.chance(0.1)) continue;
        ids_.push_back(scene_->bodies[i].id);
        add_targets(i);
      }
      if (ids_.empty()) continue;
      next_.clear();
      if (rng_.chance(0.5)) choose_next();
      reach_->start();
      if (round % 4 == 1) ask_step(before);
      next_.empty() ? move() : deform();
      reach_->read();
      scene_->read_all();
      scene_->read_obstacles();
      check_way(before, *scene_);
      check_stop(before);
    }
  }
  size_t body_count() const { return scene_->bodies.size(); }

  uint64_t moves = 0, deformations = 0, contacts = 0, steps = 0, times = 0, violations = 0, arrived = 0, at_once = 0,
           stops = 0, false_stops = 0, there = 0, refused = 0, seen = 0;
  std::string first;

 private:
  static Place make_place(Rng& rng) {
    Mesh mesh = hex_grid(axis(5, 1), axis(5, 1), axis(5, 1));
    for (Vec& p : mesh.points) {
      for (double& x : p) x += rng.range(-0.15, 0.15);
    }
    return place_of(mesh);
  }
  void mark() {
    for (const dsw_volume_id volume : place_.world->ids) {
      const dsw_face_id face = {volume.index, volume.generation, rng_.below(6u)};
      if (rng_.chance(0.2)) {
        EXPECT_EQ(dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
      }
    }
  }
  void make_bodies() {
    for (int tries = 0; tries < 2000 && scene_->bodies.size() < 14; ++tries) {
      const Vec at = {rng_.range(0.3, 4.7), rng_.range(0.3, 4.7), rng_.range(0.3, 4.7)};
      const auto near = [&](double reach) {
        return Vec{at[0] + rng_.range(-reach, reach), at[1] + rng_.range(-reach, reach),
                   at[2] + rng_.range(-reach, reach)};
      };
      BodyPlan plan;
      const uint32_t kind = rng_.below(4u);
      plan.at.push_back(at);
      for (uint32_t v = 1; kind > 0 && v < 2 + 3 * kind; ++v) {
        plan.at.push_back(near(0.6));
        if (kind != 1) plan.edges.push_back({v - 1, v});
        if (kind == 1 && v >= 2)
          plan.faces.push_back(v % 2 == 0 ? std::vector<uint32_t>{v - 2, v - 1, v}
                                          : std::vector<uint32_t>{v - 1, v - 2, v});
      }
      const double radius = 0.01 * std::pow(2, rng_.below(5u));
      scene_->create(plan, kind == 1 ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT, tries % 7 == 0 ? 0 : radius,
                     kind >= 2 ? DSW_BODY_SELF_CONTACTS : 0);
    }
  }
  void add_targets(size_t i) {
    const double size = rng_.chance(0.5) ? 0.3 : 0.03, own = rng_.chance(0.5) ? 0.3 * size : 0;
    const Vec way = {rng_.range(-size, size), rng_.range(-size, size), rng_.range(-size, size)};
    for (Vec p : scene_->bodies[i].state.at) {
      for (size_t k = 0; k < 3; ++k) p[k] += way[k] + rng_.range(-own, own);
      targets_.push_back(p);
    }
  }
  void move() {
    what_ = "a move";
    dsw_together_options options = defaults(dsw_together_options_init);
    options.stop = static_cast<dsw_together_stop>(rng_.below(3u));
    if (options.stop == DSW_TOGETHER_STOP_FEATURE)
      options.response = static_cast<dsw_together_response>(rng_.below(3u));
    std::vector<dsw_move_report> reports(ids_.size());
    ASSERT_EQ(dsw_scene_move_together(handle_.get(), ids_.data(), ids_.size(), targets_[0].data(), targets_.size(),
                                      sizeof(Vec), &options, reports.data()),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    whole_ = options.stop != DSW_TOGETHER_STOP_FEATURE;
    count(reports);
  }
  /// Points that tremble, or go on, or come to a body.
  void choose_next() {
    const double* points = nullptr;
    size_t n = 0;
    ASSERT_EQ(dsw_environment_get_points(place_.get(), &points, &n), DSW_STATUS_OK);
    next_.assign(points, points + 3 * n);
    const double by = std::pow(10, rng_.range(-2.5, -0.8));
    const Vec way = {rng_.range(-by, by), rng_.range(-by, by), rng_.range(-by, by)};
    const bool together = rng_.chance(0.3);
    for (size_t i = 0; i < next_.size(); ++i) next_[i] += together ? way[i % 3] : rng_.range(-by, by);
  }
  void deform() {
    what_ = "a deformation";
    dsw_scene_deform_options options = defaults(dsw_scene_deform_options_init);
    options.stop = rng_.chance(0.3) ? DSW_TOGETHER_STOP_ALL : DSW_TOGETHER_STOP_FEATURE;
    if (options.stop == DSW_TOGETHER_STOP_FEATURE)
      options.response = static_cast<dsw_together_response>(rng_.below(3u));
    std::vector<double>& lent = lent_.emplace_back(next_);
    std::vector<dsw_move_report> reports(ids_.size());
    dsw_deform_report report = {};
    ASSERT_EQ(dsw_scene_deform(handle_.get(), lent.data(), lent.size() / 3, ids_.data(), ids_.size(),
                               targets_[0].data(), targets_.size(), sizeof(Vec), &options, &report, reports.data()),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    ++deformations;
    refused += report.fraction == 0 ? 1 : 0;
    whole_ = options.stop == DSW_TOGETHER_STOP_ALL && report.invalid_count == 0;
    count(reports);
  }
  /// Where all stop together, something is as near as it may be, and seen; in a folded environment it may not be seen.
  void check_stop(const ThickScene& before) {
    bool is_there = true;
    size_t at = 0;
    for (const dsw_body_id id : ids_) {
      for (const Vec& p : body_of(*scene_, id).state.at) {
        const bool same = p == targets_[at++];
        there += same ? 1 : 0;
        is_there = is_there && same;
      }
    }
    if (is_there || !whole_) return;
    ++stops;
    ThickScene now = *scene_;
    now.place_obstacles(before, *scene_, 1);
    if (!reach_->has_folded()) {
      now.counts = [&before, this](size_t body, const ThickPart& part, const Hull& obstacle) {
        const bool is_seen = reach_->sees(before, *scene_, 1, body, part, obstacle);
        seen += is_seen ? 1 : 0;
        return is_seen;
      };
    }
    for (size_t i = 0; i < now.bodies.size(); ++i) {
      if (now.is_tight(i)) return;
    }
    if (touches_thin()) return;
    ++false_stops;
    if (first.empty()) first = std::string(what_) + " stops for nothing after " + std::to_string(moves) + " moves";
  }
  /// Whether a body without a radius touches: one that moves, or one that stands and that a wall comes to.
  bool touches_thin() {
    for (const dsw_body_id id : ids_) {
      const dsw_body_contact* all = nullptr;
      size_t n = 0;
      EXPECT_EQ(dsw_body_get_contacts(handle_.get(), id, &all, &n), DSW_STATUS_OK);
      if (n != 0 && body_of(*scene_, id).radius == 0) return true;
    }
    if (next_.empty()) return false;  // nothing was deformed
    const dsw_wall_contact* all = nullptr;
    size_t n = 0;
    EXPECT_EQ(dsw_environment_get_wall_contacts(place_.get(), &all, &n), DSW_STATUS_OK);
    return std::any_of(all, all + n, [&](const dsw_wall_contact& each) {
      return each.body.generation != 0 && body_of(*scene_, each.body).radius == 0;
    });
  }
  void count(const std::vector<dsw_move_report>& reports) {
    for (const dsw_move_report& each : reports) {
      ++moves;
      contacts += each.contact_count;
      arrived += each.fraction == 1 ? 1 : 0;
      at_once += each.fraction == 0 ? 1 : 0;
    }
  }
  /// The places of a step keep all distances, too, though nothing goes there.
  void ask_step(const ThickScene& before) {
    what_ = "a step";
    std::vector<Vec> ways;
    size_t at = 0;
    for (const dsw_body_id id : ids_) {
      for (const Vec& p : body_of(before, id).state.at) {
        const Vec& to = targets_[at++];
        ways.push_back({to[0] - p[0], to[1] - p[1], to[2] - p[2]});
      }
    }
    std::vector<Vec> places(ways.size());
    double fraction = 0;
    ASSERT_EQ(dsw_scene_step_fraction(handle_.get(), ids_.data(), ids_.size(), ways[0].data(), ways.size(), sizeof(Vec),
                                      nullptr, 0, nullptr, &fraction, nullptr, places[0].data(), nullptr),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    ++steps;
    ThickScene after = before;
    at = 0;
    for (const dsw_body_id id : ids_) {
      for (Vec& p : body_of(after, id).state.at) p = places[at++];
    }
    check_way(before, after);
  }
  static ThickBody& body_of(ThickScene& scene, dsw_body_id id) {
    return *std::find_if(scene.bodies.begin(), scene.bodies.end(),
                         [&](const ThickBody& each) { return each.id.index == id.index; });
  }
  static const ThickBody& body_of(const ThickScene& scene, dsw_body_id id) {
    return body_of(const_cast<ThickScene&>(scene), id);
  }
  /// What counts when a share of the way from one scene to the other is made.
  void set_counts(ThickScene& now, const ThickScene& before, const ThickScene& after, double share) const {
    now.counts = [&before, &after, share, this](size_t body, const ThickPart& part, const Hull& obstacle) {
      return reach_->sees(before, after, share, body, part, obstacle);
    };
  }
  void check_way(const ThickScene& before, const ThickScene& after) {
    ThickScene now = before;
    for (const double time : {rng_.range(0, 1), rng_.range(0, 1), 1.0}) {
      now.place_obstacles(before, after, time);
      if (reach_->has_folded()) set_counts(now, before, after, time);
      for (size_t i = 0; i < now.bodies.size(); ++i) {
        std::vector<Vec>& at = now.bodies[i].state.at;
        for (size_t v = 0; v < at.size(); ++v) {
          at[v] = ThickScene::between(before.bodies[i].state.at[v], after.bodies[i].state.at[v], time);
        }
      }
      ++times;
      for (int n = 0; n < 4; ++n) {
        const std::string found = now.too_near(rng_.below(now.bodies.size()));
        if (!found.empty() && violations++ == 0)
          first = std::string(what_) + " after " + std::to_string(moves) + " moves: " + found;
      }
    }
  }

  const char* what_ = "";  // the last call
  bool whole_ = false;     // it stops all together
  std::vector<double> next_;
  Rng rng_;
  std::deque<std::vector<double>> lent_;
  Place place_;
  std::vector<Vec> targets_;
  std::vector<dsw_body_id> ids_;
  ScenePtr handle_;
  std::unique_ptr<ThickScene> scene_;
  std::unique_ptr<ThickReach> reach_;
};

TEST(ThickTogether, EveryDistanceIsKeptOnTheWholeWay) {
  const auto wanted = static_cast<uint64_t>(effort_of(1000));
  uint64_t violations = 0, seen = 0;
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    ThickTogether course(seed);
    ASSERT_GT(course.body_count(), 6u);
    course.go(wanted / 4);
    std::printf(
        "%zu moves, %zu deformations, %zu refused, %zu arrived, %zu stop at once, %zu contacts, %zu steps, %zu stops "
        "of all, %zu "
        "times, %zu walls seen; violations %zu, false stops %zu\n",
        size_t(course.moves), size_t(course.deformations), size_t(course.refused), size_t(course.arrived),
        size_t(course.at_once), size_t(course.contacts), size_t(course.steps), size_t(course.stops),
        size_t(course.times), size_t(course.seen), size_t(course.violations), size_t(course.false_stops));
    EXPECT_EQ(course.violations + course.false_stops, 0u) << course.first;
    EXPECT_GT(course.contacts, 0u);
    EXPECT_LT(course.at_once, course.moves / 2);
    violations += course.violations;
    seen += course.seen;
  }
  EXPECT_GT(seen, 0u);
  RecordProperty("together.thick_violations", std::to_string(violations));
}

}  // namespace
}  // namespace dsw::oracle
