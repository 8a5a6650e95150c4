// Walls that move against thick bodies: after each deformation every distance is kept.
#include "thick_checks.h"

namespace dsw::oracle {
namespace {

/// Points that bend, tremble, or go towards a body.
std::vector<double> next_points(const ThickScene& scene, ThickGround& ground, Rng& rng) {
  const double* points = nullptr;
  size_t count = 0;
  EXPECT_EQ(dsw_environment_get_points(scene.environment(), &points, &count), DSW_STATUS_OK);
  const size_t d = ground.dimension;
  std::vector<double> next(points, points + d * count);
  const double by = ground.cell() * std::pow(10, rng.range(-2, -0.4));
  switch (rng.below(4u)) {
    case 0:
      for (size_t i = 0; i < next.size(); ++i) {
        const size_t v = i / d, k = i % d;
        next[i] += by * std::sin(3 * points[d * v + (k + 1) % d] / ground.size + static_cast<double>(k));
      }
      return next;
    case 1:
      for (double& x : next) x += 0.3 * by * rng.range(-1, 1);
      return next;
    case 2: {
      const double way[3] = {rng.range(-1, 1), rng.range(-1, 1), rng.range(-1, 1)};
      for (size_t i = 0; i < next.size(); ++i) next[i] += by * way[i % d];
      return next;
    }
    default:
      break;
  }
  for (uint32_t n = 1 + rng.below(4u); n > 0 && !scene.bodies.empty(); --n) {
    const BodyState& s = scene.bodies[rng.below(scene.bodies.size())].state;
    const uint32_t v = rng.below(s.at.size());
    if (s.vertices[v].generation == 0) continue;
    const auto corners = vertices_of(scene.environment(), cell_of(s.volumes[v]));
    const size_t corner = corners[rng.below(corners.size())].index;
    const double share = rng.range(0.1, 1.2);
    for (size_t k = 0; k < d; ++k) next[d * corner + k] += share * (s.at[v][k] - next[d * corner + k]);
  }
  return next;
}

struct DeformTally {
  uint64_t deformations = 0, whole = 0, contacts = 0, pushed = 0, held = 0, moved = 0;
};

void deform(ThickGround& ground, Rng& rng, DeformTally& tally) {
  const bool meets = rng.chance(0.5);
  ScenePtr handle = make_scene(ground.environment(), DSW_FEATURE_DEFORMING | (meets ? DSW_FEATURE_BODY_CONTACTS : 0));
  ThickScene scene(handle.get(), meets);
  ask(scene, ground, rng, 3);
  ask(scene, ground, rng, 2, DSW_BODY_RIGID);
  ThickChecks checks(scene, ground, rng);
  std::vector<std::vector<double>> lent;
  for (int round = 0; round < at_least(14) && !testing::Test::HasFailure(); ++round) {
    lent.push_back(next_points(scene, ground, rng));
    dsw_deform_options options = defaults(dsw_deform_options_init);
    options.method = rng.chance(0.7) ? DSW_DEFORM_SWEPT : DSW_DEFORM_END_STATE;
    options.response = static_cast<dsw_wall_response>(rng.below(4u));
    if (options.method == DSW_DEFORM_END_STATE && options.response == DSW_WALL_HOLD) {
      options.response = DSW_WALL_STOP;
    }
    options.invalid = rng.chance(0.7) ? DSW_INVALID_HOLD : DSW_INVALID_REFUSE;
    options.most_halvings = 1 + rng.below(5u);
    dsw_deform_report report{};
    const std::vector<ThickBody> before = scene.bodies;
    ASSERT_EQ(dsw_environment_deform(scene.environment(), lent.back().data(), lent.back().size() / ground.dimension,
                                     &options, &report),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    ++tally.deformations;
    tally.contacts += report.contact_count;
    tally.pushed += report.pushed_count;
    tally.held += report.held_count;
    scene.read_all();
    for (size_t i = 0; i < before.size(); ++i) tally.moved += before[i].state.at != scene.bodies[i].state.at ? 1 : 0;
    // Where cells are folded over, one that is far away may lie over everything.
    if (dsw_environment_check(scene.environment(), nullptr) != DSW_STATUS_OK) break;
    ++tally.whole;
    scene.read_obstacles();
    SCOPED_TRACE("round " + std::to_string(round));
    EXPECT_EQ(scene.too_near(), "") << "method " << options.method << " response " << options.response << " invalid "
                                    << options.invalid << " halvings " << options.most_halvings << " outcome "
                                    << report.outcome;
    for (size_t i = 0; i < scene.bodies.size() && !testing::Test::HasFailure(); ++i) {
      checks.check_gap(i);
      if (round % 2 == 1 && !scene.bodies[i].rigid) checks.move_all(i);
    }
  }
  handle.reset();
  ground.destroy();  // before the arrays that it reads
}

void record(const DeformTally& tally) {
  const std::pair<const char*, uint64_t> all[] = {{"deformations", tally.deformations},
                                                  {"whole", tally.whole},
                                                  {"contacts", tally.contacts},
                                                  {"pushed", tally.pushed},
                                                  {"held", tally.held},
                                                  {"moved", tally.moved}};
  for (const auto& [name, value] : all) testing::Test::RecordProperty(name, std::to_string(value));
}

class ThickDeformTest : public testing::TestWithParam<std::string> {};
DSW_FOR_ALL_SWEEP_SCENES(ThickDeformTest);

TEST_P(ThickDeformTest, WallsKeepEveryDistance) {
  DeformTally tally;
  for (uint64_t seed = 1; seed <= last_thick_seed(6) && !HasFailure(); ++seed) {
    Rng rng(seed + 2000);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto ground = space_ground(GetParam(), seed % 4 == 2 ? Transform::kSmall : Transform::kNone, rng);
    if (ground != nullptr) deform(*ground, rng, tally);
  }
  record(tally);
  EXPECT_GT(tally.deformations, 2u);
}

class ThickPlaneDeformTest : public testing::TestWithParam<std::string> {};
DSW_FOR_ALL_PLANE_SCENES(ThickPlaneDeformTest);

TEST_P(ThickPlaneDeformTest, WallsKeepEveryDistance) {
  DeformTally tally;
  for (uint64_t seed = 1; seed <= last_thick_seed(6) && !HasFailure(); ++seed) {
    Rng rng(seed + 2000);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto ground = plane_ground(GetParam(), seed, rng);
    if (ground != nullptr) deform(*ground, rng, tally);
  }
  record(tally);
  EXPECT_GT(tally.deformations, 2u);
}

}  // namespace
}  // namespace dsw::oracle
