// A thick wire is pushed along a bent vessel that beats, and aside, all at once: it always keeps its radius, slides on, and no wall has to
// wait for it. Figures are printed.
#include "thick_checks.h"

#include <algorithm>
#include <ctime>
#include <deque>

namespace dsw::oracle {
namespace {

constexpr int kCells = 24, kEdges = 60;
constexpr double kRadius = 0.08;

/// Where a point of the vessel is: u and v in [-1, 1] across, z along.
Vec place_in_vessel(double u, double v, double z, double time) {
  const double beat = 1 + 0.12 * std::sin(2 * M_PI * time + z / 3), sway = 0.05 * std::sin(2 * M_PI * time);
  return {beat * u * std::sqrt(1 - v * v / 2) + 0.8 * std::sin(z / 4), beat * v * std::sqrt(1 - u * u / 2) + sway, z};
}

class BeatingVessel {
 public:
  explicit BeatingVessel(dsw_together_response response) : response_(response) {
    Mesh mesh = hex_grid(axis(3, 2.0 / 3), axis(3, 2.0 / 3), axis(kCells, 1));
    for (const Vec& p : mesh.points) rest_.push_back({p[0] - 1, p[1] - 1, p[2]});
    for (size_t i = 0; i < rest_.size(); ++i)
      mesh.points[i] = place_in_vessel(rest_[i][0], rest_[i][1], rest_[i][2], 0);
    place_ = place_of(mesh);
    handle_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_DEFORMING);
    scene_ = std::make_unique<ThickScene>(handle_.get(), true);
    BodyPlan plan;
    for (uint32_t i = 0; i <= kEdges; ++i) {
      plan.at.push_back(place_in_vessel(0, 0, 1 + 0.12 * i, 0));
      if (i > 0) plan.edges.push_back({i - 1, i});
    }
    EXPECT_EQ(scene_->create(plan, DSW_LEVEL_EDGES_SWEPT, kRadius), DSW_STATUS_OK);
  }
  ~BeatingVessel() {
    handle_.reset();
    place_.environment.reset();  // before the points that it reads
  }

  void step(double time) {
    std::vector<double>& next = lent_.emplace_back();
    for (const Vec& p : rest_) {
      const Vec to = place_in_vessel(p[0], p[1], p[2], time);
      next.insert(next.end(), to.begin(), to.end());
    }
    const std::vector<Vec>& at = scene_->bodies[0].state.at;
    std::vector<Vec> targets = at;
    for (size_t i = 0; i < at.size(); ++i) {
      for (size_t k = 0; k < 3 && i > 0 && i + 1 < at.size(); ++k) {
        targets[i][k] += 0.3 * (at[i - 1][k] - 2 * at[i][k] + at[i + 1][k]);
      }
      targets[i][0] += 0.03 * std::cos(3 * time);
      targets[i][1] += 0.03 * std::sin(3 * time);
      targets[i][2] += 0.003;
    }
    dsw_scene_deform_options options = defaults(dsw_scene_deform_options_init);
    options.stop = DSW_TOGETHER_STOP_FEATURE;
    options.response = response_;
    dsw_deform_report report = {};
    dsw_move_report moved = {};
    const std::clock_t begin = std::clock();
    ASSERT_EQ(dsw_scene_deform(handle_.get(), next.data(), next.size() / 3, &scene_->bodies[0].id, 1, targets[0].data(),
                               targets.size(), sizeof(Vec), &options, &report, &moved),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    milliseconds.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    ++steps;
    touching += moved.contact_count > 0 ? 1 : 0;
    held += report.held_count > 0 ? 1 : 0;
    shortened += report.fraction < 1 ? 1 : 0;
    scene_->read_all();
    scene_->read_obstacles();
    const std::string found = steps % 15 == 0 ? scene_->too_near(0) : "";
    EXPECT_EQ(found, "") << "after " << steps << " steps";
    too_near += found.empty() ? 0 : 1;
  }
  double front() const { return scene_->bodies[0].state.at.back()[2]; }

  size_t steps = 0, touching = 0, held = 0, shortened = 0, too_near = 0;
  std::vector<double> milliseconds;

 private:
  dsw_together_response response_;
  std::vector<Vec> rest_;
  std::deque<std::vector<double>> lent_;
  Place place_;
  ScenePtr handle_;
  std::unique_ptr<ThickScene> scene_;
};

TEST(ThickBeating, AWireSlidesInAVesselThatBeats) {
  for (const auto response : {DSW_TOGETHER_RESPONSE_SLIDE, DSW_TOGETHER_RESPONSE_CARRY}) {
    BeatingVessel vessel(response);
    const double before = vessel.front();
    const int wanted = std::max(effort_of(60), 60);  // it touches from about the 28th on
    for (int i = 1; i <= wanted && !testing::Test::HasFailure(); ++i) vessel.step(0.005 * i);
    std::vector<double>& ms = vessel.milliseconds;
    ASSERT_FALSE(testing::Test::HasFailure());
    std::sort(ms.begin(), ms.end());
    std::printf(
        "%s: %zu steps, %zu touching, %zu with walls held, %zu shortened, %zu too near, %g along; ms median %.2f, "
        "longest %.2f\n",
        response == DSW_TOGETHER_RESPONSE_SLIDE ? "slide" : "carry", vessel.steps, vessel.touching, vessel.held,
        vessel.shortened, vessel.too_near, vessel.front() - before, ms[ms.size() / 2], ms.back());
    EXPECT_EQ(vessel.too_near + vessel.held + vessel.shortened, 0u);
    EXPECT_GT(vessel.touching, vessel.steps / 2);
  }
}

}  // namespace
}  // namespace dsw::oracle
