// An environment bends while thick bodies turn: the distances that bodies have to keep, all along their arcs. Figures are printed.
#include "rigid_motions_support.h"
#include "thick_truth.h"

namespace dsw::oracle {
namespace {

/// Where points are at a part of a call's motion: they go straight, or turn.
class Course {
 public:
  Course(const std::vector<Vec>& from, const std::vector<Vec>& to) : from_(from), to_(to) {
    for (size_t i = 0; i < from.size(); ++i) speed_ = std::max(speed_, size_of(minus(to[i], from[i])));
  }
  /// @param numbers see numbers_of.
  Course(const std::vector<Vec>& from, const std::vector<double>& numbers) : from_(from), n_(numbers) {
    double radius = 0;
    for (const Vec& p : from) radius = std::max(radius, size_of(minus(p, {n_[8], n_[9], n_[10]})));
    // The angular velocity is at most 2 sin h / n, and n at least (1 + cos h) / 2.
    speed_ = 4 * size_of({n_[4], n_[5], n_[6]}) / (1 + n_[7]) * radius +
             size_of({n_[14] - n_[11], n_[15] - n_[12], n_[16] - n_[13]});
    speed_ *= 1.001;
  }
  double speed() const { return speed_; }
  Vec at(uint32_t v, double time) const {
    if (n_.empty()) {
      Vec p;
      for (size_t k = 0; k < 3; ++k) p[k] = (1 - time) * from_[v][k] + time * to_[v][k];
      return p;
    }
    const Vec q = {time * n_[4], time * n_[5], time * n_[6]}, r = minus(from_[v], {n_[8], n_[9], n_[10]});
    const double w = (1 - time) + time * n_[7], square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + w * w;
    const Vec once = cross(q, r), twice = cross(q, once);
    Vec p;
    for (size_t k = 0; k < 3; ++k) {
      p[k] = r[k] + 2 * (w * once[k] + twice[k]) / square + (1 - time) * n_[11 + k] + time * n_[14 + k];
    }
    return p;
  }
  Hull hull(const std::vector<uint32_t>& part, double time) const {
    Hull all;
    for (const uint32_t v : part) all.push_back(at(v, time));
    return all;
  }

 private:
  static Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static Vec cross(const Vec& a, const Vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static double size_of(const Vec& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

  std::vector<Vec> from_, to_;
  std::vector<double> n_;
  double speed_ = 0;
};

/// Two parts on their courses, and how far they stay apart.
struct Distance {
  const Course *a, *b;
  std::vector<uint32_t> part, other;
  double wanted;

  Apart at(double time) const { return apart(a->hull(part, time), b->hull(other, time)); }
  /// Whether they certainly come nearer than they may up to a time. The way is halved where it can't be told; what goes along with a
  /// wall at its distance would be halved for ever, so there is a limit.
  bool breaks(double until) const {
    constexpr size_t kMostPieces = 2048;
    const double keep = wanted * (1 - 0x1p-34), speed = a->speed() + b->speed();
    std::vector<std::pair<double, double>> pieces = {{0, until}};
    for (size_t i = 0; i < pieces.size() && i < kMostPieces; ++i) {
      const auto [begin, end] = pieces[i];
      const double middle = 0.5 * (begin + end);
      const Apart now = at(middle);
      if (now.high < keep) return true;
      if (now.low - speed * 0.5 * (end - begin) >= keep) continue;
      pieces.emplace_back(begin, middle);
      pieces.emplace_back(middle, end);
    }
    return false;
  }
};

class ThickRigidDeformTest : public RigidMotionsTest {
 protected:
  ThickRigidDeformTest() : RigidMotionsTest(72) {}

  /// Gives bodies a radius where there is room for one.
  std::vector<double> thicken(dsw_scene* scene, const std::vector<Walker>& walkers) {
    std::vector<double> radii;
    for (const Walker& each : walkers) {
      double radius = each.alone || rng_.chance(0.2) ? 0 : rng_.range(0.01, 0.1);
      while (radius > 1e-3 && dsw_body_set_radius(scene, each.id, radius) != DSW_STATUS_OK) radius *= 0.5;
      radii.push_back(radius > 1e-3 ? radius : 0);
    }
    return radii;
  }
  static std::vector<std::vector<uint32_t>> all_parts(const Walker& of) {
    std::vector<std::vector<uint32_t>> all;
    for (size_t corners = 1; corners <= 3; ++corners) {
      const auto parts = of.parts(corners);
      all.insert(all.end(), parts.begin(), parts.end());
    }
    return all;
  }
  /// How many distances at the end are certainly smaller than they may be.
  size_t count_broken(const Stage& stage, const std::vector<double>& radii) {
    const Course still(stage.ground.points, stage.ground.points);
    std::vector<Course> now;
    for (const Walker& each : stage.walkers) now.emplace_back(each.state.at, each.state.at);
    size_t broken = 0;
    for (const Distance& each : distances(stage.ground, stage.walkers, radii, still, now)) {
      const Limit limit(mpq_class(each.wanted), less_by(34));
      broken += is_nearer(each.a->hull(each.part, 0), each.b->hull(each.other, 0), limit) ? 1 : 0;
    }
    return broken;
  }
  /// All that has a distance to keep.
  std::vector<Distance> distances(const Ground& ground, const std::vector<Walker>& walkers,
                                  const std::vector<double>& radii, const Course& points,
                                  const std::vector<Course>& courses) {
    std::vector<Distance> all;
    for (size_t i = 0; i < walkers.size(); ++i) {
      const auto parts = all_parts(walkers[i]);
      for (const auto& part : parts) {
        for (const auto* const walls : {&ground.walls, &ground.thin}) {
          for (const auto& wall : *walls) {
            if (radii[i] > 0) all.push_back({&courses[i], &points, part, wall, radii[i]});
          }
        }
        for (size_t j = 0; j < i; ++j) {
          if (walkers[i].alone || walkers[j].alone || !(radii[i] + radii[j] > 0)) continue;
          for (const auto& other : all_parts(walkers[j])) {
            all.push_back({&courses[i], &courses[j], part, other, radii[i] + radii[j]});
          }
        }
      }
    }
    return all;
  }
};

TEST_P(ThickRigidDeformTest, KeepsAllDistancesOnTheWay) {
  size_t moves = 0, stops = 0, whole = 0, thick = 0, broken = 0, broken_after = 0, occupied = 0, silent = 0, wide = 0;
  double widest = 0;
  // In the plane a step that is taken back, with something that stands, comes once in about 40 rounds.
  const int rounds = effort_of(std::string(GetParam().name) == "PlaneEdges" ? 45 : 6);
  for (int round = 0; round < rounds && !HasFailure(); ++round) {
    Stage stage(make(rng_), DSW_FEATURE_BODY_CONTACTS);
    ASSERT_NE(stage.ground.environment, nullptr);
    stage.walkers = make_walkers(stage.scene.get(), 1 + rng_.below(3u), rng_.below(2u));
    const std::vector<double> radii = thicken(stage.scene.get(), stage.walkers);
    for (const double each : radii) thick += each > 0 ? 1 : 0;
    for (int i = 0; i < kSteps && !HasFailure(); ++i) {
      const Step step = make_step(stage, false);
      const dsw_deform_report& report = step.report;
      size_t contacts = report.contact_count;
      for (const dsw_move_report& each : step.reports) contacts += each.contact_count;
      ++moves;
      whole += report.fraction == 1 ? 1 : 0;
      stops += contacts != 0 ? 1 : 0;
      silent += step.valid && report.fraction < 1 && contacts == 0 && report.invalid_count == 0 ? 1 : 0;
      const Course points(step.from, step.to);
      std::vector<Course> courses;
      for (size_t k = 0; k < step.walkers.size(); ++k) {
        const Walker& each = step.walkers[k];
        courses.push_back(each.stands ? Course(each.state.at, each.state.at)
                                      : Course(each.state.at, numbers_of(step.motions[k])));
      }
      // What a volume that turns over brings near is another matter.
      const std::vector<Distance> all =
          step.valid ? distances(stage.ground, step.walkers, radii, points, courses) : std::vector<Distance>();
      double least = 1e9;
      for (const Distance& each : all) {
        broken += each.breaks(report.fraction) ? 1 : 0;
        least = std::min(least, each.at(report.fraction).high / each.wanted - 1);
      }
      broken_after += step.valid ? count_broken(stage, radii) : 0;
      EXPECT_EQ(broken + broken_after + silent, 0u)
          << "round " << round << " step " << i << " fraction " << report.fraction << " contacts " << contacts;
      // A stop of thin parts is no matter of distances.
      if (contacts != 0 && least < 1e8) {
        widest = std::max(widest, least);
        wide += least > 1e-6 ? 1 : 0;
      }
      occupied += misplaced(stage.ground, step.after, step.valid) + not_free(stage.scene.get(), stage.walkers);
      if (!step.valid) break;  // what has turned over stays so
    }
  }
  std::printf(
      "%s: %zu moves, %zu whole, %zu stops, %zu thick bodies; broken %zu, broken after it %zu, not free %zu, without a "
      "contact %zu, stops wider than a millionth of the distance %zu (at most %.2e)\n",
      GetParam().name, moves, whole, stops, thick, broken, broken_after, occupied, silent, wide, widest);
  EXPECT_EQ(broken + broken_after + occupied + silent, 0u);
  EXPECT_GT(thick, 0u);
  EXPECT_TRUE(moves < 30 || stops > moves / 20);
}

/// How much the distances of a body's vertices have changed at most.
double bent_by(const BodyState& before, const BodyState& after) {
  double most = 0;
  const auto length = [](const BodyState& of, size_t i, size_t k) {
    const Vec &a = of.at[i], &b = of.at[k];
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  for (size_t i = 0; i < before.at.size(); ++i) {
    for (size_t k = 0; k < i; ++k) most = std::max(most, std::fabs(length(before, i, k) - length(after, i, k)));
  }
  return most;
}

TEST_P(ThickRigidDeformTest, BodiesThatGoOnStayFreeAndRigid) {
  size_t moves = 0, stops = 0, went_on = 0, arrived = 0, broken = 0, occupied = 0, bent = 0, faults = 0;
  double gained = 0;
  // In the plane a thick body that goes along a wall in hundreds of steps, and loses a little of its distance in each, comes once in about
  // 30 rounds.
  const int rounds = std::max(effort_of(std::string(GetParam().name) == "PlaneEdgesSwept" ? 30 : 6), 2);
  for (int round = 0; round < rounds && !HasFailure(); ++round) {
    Stage stage(make(rng_), DSW_FEATURE_BODY_CONTACTS);
    ASSERT_NE(stage.ground.environment, nullptr);
    stage.walkers = make_walkers(stage.scene.get(), 1 + rng_.below(2u), 0);
    const std::vector<double> radii =
        round % 2 == 0 ? std::vector<double>(stage.walkers.size()) : thicken(stage.scene.get(), stage.walkers);
    for (int i = 0; i < kSteps && !HasFailure(); ++i) {
      dsw_scene_deform_options options = defaults(dsw_scene_deform_options_init);
      options.stop = DSW_TOGETHER_STOP_FEATURE;
      options.response = DSW_TOGETHER_RESPONSE_SLIDE;
      const Step step = make_step(stage, false, &options);
      const dsw_deform_report& report = step.report;
      ++moves;
      const double first = step.reports[0].fraction;
      for (const dsw_move_report& each : step.reports) faults += each.fraction != first ? 1 : 0;
      faults += report.fraction < first || (first == 1 && report.contact_count != 0) ? 1 : 0;
      stops += first < 1 ? 1 : 0;
      went_on += report.fraction > first ? 1 : 0;
      arrived += first < 1 && report.fraction == 1 ? 1 : 0;
      gained += first < 1 ? (report.fraction - first) / (1 - first) : 0;
      for (size_t k = 0; k < step.walkers.size(); ++k) {
        bent += bent_by(step.walkers[k].state, step.after[k]) > 1e-12 ? 1 : 0;
      }
      broken += step.valid ? count_broken(stage, radii) : 0;
      occupied += misplaced(stage.ground, step.after, step.valid) + not_free(stage.scene.get(), stage.walkers);
      EXPECT_EQ(broken + occupied + bent + faults, 0u)
          << "round " << round << " step " << i << " fraction " << report.fraction << " after " << first;
      if (!step.valid) break;  // what has turned over stays so
    }
  }
  std::printf(
      "%s: %zu moves, %zu stops, %zu went on, %zu to the end (%.2f of what was left); broken %zu, not free %zu, bent "
      "%zu, faults %zu\n",
      GetParam().name, moves, stops, went_on, arrived, stops == 0 ? 0 : gained / static_cast<double>(stops), broken,
      occupied, bent, faults);
  EXPECT_EQ(broken + occupied + bent + faults, 0u);
  EXPECT_TRUE(moves < 30 || went_on > stops / 4);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ThickRigidDeformTest, testing::ValuesIn(kAllKinds),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace dsw::oracle
