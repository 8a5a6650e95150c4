// Snapshots of scenes: what is loaded goes on with the same bits, ids and counters; damage is an error.
#include <cmath>

#include "body_support.h"
#include "deform_support.h"
#include "snapshot_support.h"

namespace dsw::oracle {
namespace {

constexpr uint32_t kAllFlags = DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BY_CLEARANCE;

/// What a scene holds.
struct Ids {
  std::vector<dsw_body_id> bodies;
  std::vector<dsw_particle_id> particles;
};

/// Bodies at all levels and with all flags, some of them and some particles gone again.
void fill(dsw_scene* scene, const World& world, Rng& rng, Ids& ids, uint32_t more_flags = 0) {
  Motions motions(world, rng);
  for (int i = 0; i < 24; ++i) {
    BodyPlan plan;
    const double reach = world.size * (i % 3 == 0 ? 0.3 : 0.05);
    plan.at.push_back(motions.start());
    for (int v = 1; v < 4; ++v) {
      Vec p = plan.at[0];
      for (double& x : p) x += rng.range(-reach, reach);
      plan.at.push_back(p);
    }
    if (i % 2 == 0) {
      plan.faces = {{0, 1, 2}, {0, 2, 3}};
    } else {
      plan.edges = {{0, 1}, {1, 2}, {2, 3}};
    }
    dsw_body_id body;
    const dsw_level level = static_cast<dsw_level>(1 + i % 4);
    if (create_body(scene, plan, level, (i % 3 == 0 ? kAllFlags : 0) | (i % 4 < 2 ? more_flags : 0), {}, &body) ==
        DSW_STATUS_OK) {
      ids.bodies.push_back(body);
      // Where something is too near it stays thin.
      if (i % 4 == 1) dsw_body_set_radius(scene, body, world.size * 0x1p-10);
    }
    const Vec p = motions.start();
    dsw_particle_id particle;
    if (dsw_particle_create(scene, p.data(), {0, 0}, &particle) == DSW_STATUS_OK) ids.particles.push_back(particle);
  }
  for (int i = 0; i < 3 && ids.bodies.size() > 2; ++i) {
    const size_t body = rng.below(ids.bodies.size()), particle = rng.below(ids.particles.size());
    EXPECT_EQ(dsw_body_destroy(scene, ids.bodies[body]), DSW_STATUS_OK);
    EXPECT_EQ(dsw_particle_destroy(scene, ids.particles[particle]), DSW_STATUS_OK);
    ids.bodies.erase(ids.bodies.begin() + static_cast<std::ptrdiff_t>(body));
    ids.particles.erase(ids.particles.begin() + static_cast<std::ptrdiff_t>(particle));
  }
}

/// One move of every body and particle; what comes of it, as text.
std::string move_all(dsw_scene* scene, const World& world, Rng& rng, const Ids& ids) {
  std::string text;
  for (const dsw_body_id body : ids.bodies) {
    BodyState state;
    text += read_body(scene, body, state);
    const double step = world.size * (rng.chance(0.5) ? 0.01 : 0.2);
    std::vector<Vec> targets = state.at;
    for (Vec& p : targets) {
      for (double& x : p) x += rng.range(-step, step);
    }
    dsw_move_options options = defaults(dsw_move_options_init);
    options.vertex_response = rng.chance(0.5) ? DSW_RESPONSE_STOP : DSW_RESPONSE_SLIDE;
    options.edge_response = static_cast<dsw_response>(rng.below(6));
    options.noise_share = rng.chance(0.5) ? 0 : 0.05;
    BodyAnswer answer;
    text += move_body(scene, body, targets, &options, answer);
    text += bits_of(answer);
  }
  Motions motions(world, rng);
  for (const dsw_particle_id id : ids.particles) {
    const Vec to = motions.start();
    dsw_flight flight;
    EXPECT_EQ(dsw_particle_move(scene, id, to.data(), nullptr, &flight), DSW_STATUS_OK);
    text += bits_of(flight);
  }
  return text;
}

/// @param flags of some bodies.
void check_going_on(const std::string& kind, uint32_t features, uint32_t flags) {
  const Place place = make_place(kind, 91, 0, nullptr);
  ASSERT_PLACE(place);
  Rng rng(17);
  for (int i = 0; i < 3; ++i) {
    const dsw_volume_id wall = place.world->ids[rng.below(place.world->ids.size())];
    EXPECT_EQ(dsw_environment_mark_volumes(place.get(), &wall, 1, DSW_MARK_IMPASSABLE, 0, nullptr), DSW_STATUS_OK);
  }
  const ScenePtr scene = make_scene(place.get(), DSW_FEATURE_STATISTICS | features);
  Ids ids;
  fill(scene.get(), *place.world, rng, ids, flags);
  for (int i = 0; i < 8; ++i) move_all(scene.get(), *place.world, rng, ids);
  const Bytes of_environment = saved(place.get()), of_scene = saved(scene.get());
  const Loaded copy = load_both(of_environment, of_scene);
  ASSERT_NE(copy.scene, nullptr);
  EXPECT_TRUE(saved(copy.environment.get()) == of_environment);
  EXPECT_TRUE(saved(copy.scene.get()) == of_scene);
  // Whatever the alignment, and beside the first in the same environment.
  Bytes odd(of_scene.size() + 3);
  std::copy(of_scene.begin(), of_scene.end(), odd.begin() + 3);
  dsw_scene* beside = nullptr;
  ASSERT_EQ(dsw_scene_load(place.get(), odd.data() + 3, of_scene.size(), &beside), DSW_STATUS_OK);
  EXPECT_TRUE(saved(beside) == of_scene);
  dsw_scene_destroy(beside);

  Rng other = rng;
  for (int i = 0; i < 8; ++i) {
    ASSERT_EQ(move_all(scene.get(), *place.world, rng, ids), move_all(copy.scene.get(), *place.world, other, ids)) << i;
  }
  Ids others = ids;
  fill(scene.get(), *place.world, rng, ids, flags);  // new ones get the same ids
  fill(copy.scene.get(), *place.world, other, others, flags);
  EXPECT_EQ(move_all(scene.get(), *place.world, rng, ids), move_all(copy.scene.get(), *place.world, other, others));
  EXPECT_TRUE(saved(scene.get()) == saved(copy.scene.get())) << "also what is kept to do less work";
}

class SceneSnapshotTest : public SceneTest {};
DSW_FOR_ALL_SCENES(SceneSnapshotTest);

TEST_P(SceneSnapshotTest, GoesOnWithTheSameBitsIdsAndCounters) { check_going_on(GetParam(), 0, 0); }

TEST_P(SceneSnapshotTest, BodiesThatMeetGoOnWithTheSameBits) {
  check_going_on(GetParam(), DSW_FEATURE_BODY_CONTACTS, DSW_BODY_SELF_CONTACTS);
}

TEST_P(SceneSnapshotTest, EveryTruncationAndEveryDamagedByteIsAnError) {
  const Place place = make_place(GetParam(), 91, 0, nullptr);
  ASSERT_PLACE(place);
  Rng rng(23);
  const ScenePtr scene = make_scene(place.get(), DSW_FEATURE_STATISTICS);
  Ids ids;
  fill(scene.get(), *place.world, rng, ids);
  move_all(scene.get(), *place.world, rng, ids);
  const Bytes block = saved(scene.get());
  dsw_scene* const untouched = reinterpret_cast<dsw_scene*>(0x1);
  const auto refused = [&](const Bytes& damaged) {
    dsw_scene* raw = untouched;
    const dsw_status status = dsw_scene_load(place.get(), damaged.data(), damaged.size(), &raw);
    return raw == untouched &&
           (status == DSW_STATUS_TRUNCATED || status == DSW_STATUS_CORRUPT || status == DSW_STATUS_BAD_VERSION);
  };
  const size_t step = std::max<size_t>(1, block.size() / 300);
  for (size_t size = 1; size < block.size(); size += size < 256 ? 1 : step) {
    // An exact copy of the part, so that a reader past the end is seen by a checker of memory.
    ASSERT_TRUE(refused(Bytes(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(size)))) << size;
  }
  for (size_t at = 0; at < block.size(); at += at < 256 ? 1 : step) {
    Bytes damaged = block;
    damaged[at] = static_cast<unsigned char>(block[at] ^ (1u << rng.below(8)));
    ASSERT_TRUE(refused(damaged)) << "byte " << at << " of " << block.size();
  }
  EXPECT_TRUE(refused(saved(place.get()))) << "an environment is no scene";
}

class SceneInGridTest : public BodyTest {};

TEST_F(SceneInGridTest, IsRefusedWhereItWasNot) {
  const dsw_body_id body = make({{{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}}, {{0, 1}}, {}});
  const Bytes block = saved(scene());
  dsw_scene* other = nullptr;
  const EnvironmentPtr smaller = create_environment(hex_grid(axis(3, 1), axis(3, 1), axis(3, 1)));
  EXPECT_EQ(dsw_scene_load(smaller.get(), block.data(), block.size(), &other), DSW_STATUS_CORRUPT);
  const EnvironmentPtr moved = create_environment(hex_grid(axis(4, 0.25), axis(4, 1), axis(3, 1)));
  EXPECT_EQ(dsw_scene_load(moved.get(), block.data(), block.size(), &other), DSW_STATUS_CORRUPT);
  // A wall where there was none.
  ASSERT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
  mark_wall(0, 0, 0);
  EXPECT_EQ(dsw_scene_load(place_.get(), block.data(), block.size(), &other), DSW_STATUS_CORRUPT);
  EXPECT_EQ(other, nullptr);
}

/// Squares of what a clearance is measured by are no doubles there.
TEST_F(SceneInGridTest, ClearancesOfAnySizeAreLoaded) {
  for (const double size : {1e-200, 1e140, 1e155, 1e200}) {
    scene_.reset();
    place_ = place_of(hex_grid(axis(4, size), axis(4, size), axis(3, size)));
    ASSERT_NE(place_.environment, nullptr);
    scene_ = make_scene(place_.get());
    const dsw_body_id body =
        make({{{0.5 * size, 0.5 * size, 0.5 * size}, {1.5 * size, 0.5 * size, 0.5 * size}}, {{0, 1}}, {}},
             DSW_LEVEL_EDGES, DSW_BODY_SKIP_BY_CLEARANCE);
    const double targets[6] = {0.6 * size, 0.5 * size, 0.5 * size, 1.6 * size, 0.5 * size, 0.5 * size};
    ASSERT_EQ(dsw_body_move(scene(), body, targets, 2, 0, nullptr, nullptr), DSW_STATUS_OK);
    const Bytes block = saved(scene());
    dsw_scene* copy = nullptr;
    ASSERT_EQ(dsw_scene_destroy(scene_.release()), DSW_STATUS_OK);
    EXPECT_EQ(dsw_scene_load(place_.get(), block.data(), block.size(), &copy), DSW_STATUS_OK)
        << size << ": " << dsw_last_error_message();
    scene_.reset(copy);
  }
}

/// Also that nothing has moved yet, which is saved.
TEST_F(SceneInGridTest, ARefusedDeformationLeavesNothing) {
  std::vector<double> lent;
  scene_.reset();
  scene_ = make_scene(place_.get(), DSW_FEATURE_DEFORMING);
  make({{{1.6, 1.5, 1.25}, {1.9, 1.6, 1.75}}, {{0, 1}}, {}});
  const auto refuse = [&] {
    const Bytes before = saved(place_.get());
    for (const dsw_deform_method method : {DSW_DEFORM_SWEPT, DSW_DEFORM_END_STATE}) {
      dsw_deform_options options = defaults(dsw_deform_options_init);
      options.method = method;
      options.invalid = DSW_INVALID_REFUSE;
      std::vector<double> next = points_of(place_.get());
      double& x = next[3 * size_t{point(1, 1, 1)}];  // of the volume that the body is in
      x += 5;
      dsw_deform_report report{};
      EXPECT_EQ(dsw_environment_deform(place_.get(), next.data(), next.size() / 3, &options, &report), DSW_STATUS_OK);
      EXPECT_EQ(report.outcome, DSW_DEFORM_REFUSED);
      EXPECT_TRUE(saved(place_.get()) == before) << method;
      x = std::nan("");
      EXPECT_EQ(dsw_environment_deform(place_.get(), next.data(), next.size() / 3, &options, &report),
                DSW_STATUS_NON_FINITE);
      EXPECT_TRUE(saved(place_.get()) == before) << method;
    }
    return before;
  };
  const Bytes still = refuse();
  lent = points_of(place_.get());
  ASSERT_EQ(dsw_environment_deform(place_.get(), lent.data(), lent.size() / 3, nullptr, nullptr), DSW_STATUS_OK);
  EXPECT_FALSE(refuse() == still) << "points have moved, though to where they were";
  scene_.reset();
  place_.environment.reset();
}

TEST_F(SceneInGridTest, ABentEnvironmentGoesOnBending) {
  mark_wall(1, 1, 1);
  scene_.reset();
  scene_ = make_scene(place_.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_STATISTICS);
  Ids ids;
  ids.bodies.push_back(make({{{1.9, 1.5, 1.25}, {1.9, 1.6, 1.75}, {1.6, 1.5, 1.5}}, {}, {{0, 1, 2}}}, DSW_LEVEL_FACES));
  ids.bodies.push_back(make({{{2.1, 1.5, 1.25}, {3.4, 1.6, 1.75}}, {{0, 1}}, {}}, DSW_LEVEL_EDGES, kAllFlags));
  std::vector<double> arrays[2][2];  // lent, of the one and of its copy
  dsw_status status = DSW_STATUS_OK;
  const auto bend = [&](dsw_scene* scene, std::vector<double>(&lent)[2], double by) {
    dsw_environment* const environment = dsw_scene_get_environment(scene);
    const double* now = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_environment_get_points(environment, &now, &count), DSW_STATUS_OK);
    std::vector<double>& next = lent[now == lent[0].data() ? 1 : 0];
    next = bent(points_of(environment), by);
    status = dsw_environment_deform(environment, next.data(), next.size() / 3, nullptr, nullptr);
    const dsw_wall_contact* contacts = nullptr;
    EXPECT_EQ(dsw_environment_get_wall_contacts(environment, &contacts, &count), DSW_STATUS_OK);
    return std::to_string(status) + std::string(reinterpret_cast<const char*>(contacts), count * sizeof *contacts);
  };
  for (int i = 0; i < 3; ++i) {
    bend(scene(), arrays[0], 0.03);
    ASSERT_EQ(status, DSW_STATUS_OK);
  }
  // Invalid where nobody is.
  std::vector<double> next = points_of(place_.get());
  next[3 * point(0, 4, 3)] = std::nan("");
  ASSERT_EQ(dsw_environment_deform(dsw_scene_get_environment(scene()), next.data(), next.size() / 3, nullptr, nullptr),
            DSW_STATUS_OK);
  Loaded copy = load_both(saved(place_.get()), saved(scene()));
  ASSERT_NE(copy.scene, nullptr);
  EXPECT_TRUE(saved(copy.environment.get()) == saved(place_.get()));
  int valid = 1;
  EXPECT_EQ(dsw_environment_is_valid(copy.environment.get(), cube(0, 3, 2), &valid), DSW_STATUS_OK);
  EXPECT_EQ(valid, 0);
  Rng rng(5), other(5);
  for (int i = 0; i < 6; ++i) {
    ASSERT_EQ(bend(scene(), arrays[0], -0.05), bend(copy.scene.get(), arrays[1], -0.05)) << i;
    ASSERT_TRUE(status == DSW_STATUS_OK || (status == DSW_STATUS_NON_FINITE && i > 0))
        << "a body can come near the point";
    ASSERT_EQ(move_all(scene(), *place_.world, rng, ids), move_all(copy.scene.get(), *place_.world, other, ids)) << i;
  }
  EXPECT_TRUE(saved(copy.environment.get()) == saved(place_.get()));
  EXPECT_TRUE(saved(copy.scene.get()) == saved(scene()));
  // Scenes before their environments, and these before the arrays that they read.
  copy.scene.reset();
  copy.environment.reset();
  scene_.reset();
  place_.environment.reset();
}

}  // namespace
}  // namespace dsw::oracle
