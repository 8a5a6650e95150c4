// Random rigid motions of bodies while an environment bends.
#pragma once

#include "together_deform_kinds.h"

namespace dsw::oracle {

class RigidMotionsTest : public BendingTest {
 protected:
  explicit RigidMotionsTest(uint64_t seed) : BendingTest(seed) {}

  dsw_rigid_motion motion_of(const Walker& of) {
    const double sizes[] = {3, 3, 1, 0.1, 1e-3, 1e-6};
    const double half = sizes[rng_.below(6u)] * rng_.range(0.05, 0.5), reach = rng_.chance(0.5) ? 0.3 : 0.01;
    Vec axis = dimension() == 2 ? Vec{0, 0, rng_.chance(0.5) ? 1.0 : -1.0} : beside({0, 0, 0}, 1);
    const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    dsw_rigid_motion motion = {};
    for (size_t k = 0; k < 3; ++k) motion.rotation[k] = axis[k] / length * std::sin(half);
    motion.rotation[3] = std::cos(half);
    const Vec centre = beside(of.state.at[0], 0.3), way = beside({0, 0, 0}, reach);
    std::copy(centre.begin(), centre.end(), motion.centre);
    std::copy(way.begin(), way.end(), motion.translation);
    return motion;
  }
  /// A ground with what is in it. The arrays are read by the library as long as it is there.
  struct Stage {
    Stage(Ground made, uint32_t features)
        : ground(std::move(made)), scene(make_scene(ground.environment.get(), DSW_FEATURE_DEFORMING | features)) {}

    std::deque<std::vector<double>> arrays;
    Ground ground;
    ScenePtr scene;
    std::vector<Walker> walkers;
  };
  /// What a call was given, and what it told and left.
  struct Step {
    std::vector<Vec> from, to;              // of the ground's points
    std::vector<Walker> walkers;            // before it
    std::vector<dsw_rigid_motion> motions;  // of all walkers; of those that stand it does not count
    bool valid = false;                     // all volumes stay so on their way
    dsw_deform_report report = {};
    std::vector<dsw_move_report> reports;  // of those that do not stand
    std::vector<BodyState> after;
  };
  /// Bends the ground while the walkers turn that do not stand, and reads all back.
  /// @param options null: particles do not turn, nor do those that choose_ends lets stand. Else all do.
  Step make_step(Stage& stage, bool exact, const dsw_scene_deform_options* options = nullptr) {
    Step step;
    Ground& ground = stage.ground;
    choose_ends(ground, stage.walkers);
    std::vector<dsw_rigid_motion> called;
    std::vector<dsw_body_id> ids;
    for (Walker& each : stage.walkers) {
      each.stands = options == nullptr && (each.stands || each.alone);
      step.motions.push_back(motion_of(each));
      if (each.stands) continue;
      ids.push_back(each.id);
      called.push_back(step.motions.back());
    }
    step.walkers = stage.walkers;
    step.valid = all_stay_valid(ground, exact);
    std::vector<double>& array = stage.arrays.emplace_back();
    for (const Vec& p : ground.next) array.insert(array.end(), p.begin(), p.begin() + dimension());
    step.reports.resize(ids.size());
    EXPECT_EQ(dsw_scene_deform_rigid(stage.scene.get(), array.data(), ground.next.size(), ids.data(), ids.size(),
                                     called.data(), options, &step.report, step.reports.data()),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    step.from = std::exchange(ground.points, points_read(ground.environment.get(), dimension()));
    step.to = std::exchange(ground.next, {});
    for (Walker& each : stage.walkers) {
      read_walker(stage.scene.get(), each, each.state);
      each.end = each.state.at;
      step.after.push_back(each.state);
    }
    return step;
  }
  /// The motion in the numbers of dsw_sweep_rigid_pairs, normalised as the library does it.
  static std::vector<double> numbers_of(const dsw_rigid_motion& motion) {
    std::vector<double> n(17);
    double largest = 0;
    n[3] = 1;
    for (const double x : motion.rotation) largest = std::max(largest, std::fabs(x));
    for (size_t k = 0; k < 4; ++k) n[4 + k] = motion.rotation[k] / largest;
    const double size = std::sqrt((n[4] * n[4] + n[5] * n[5]) + (n[6] * n[6] + n[7] * n[7]));
    for (size_t k = 4; k < 8; ++k) n[k] /= size;
    for (size_t k = 0; k < 3; ++k) {
      n[8 + k] = n[11 + k] = motion.centre[k];
      n[14 + k] = motion.centre[k] + motion.translation[k];
    }
    return n;
  }
};

}  // namespace dsw::oracle
