// Deformations: memory that runs out at every single point, and the same bits twice.
#include "deform_support.h"
#include "host_memory.h"
#include "snapshot_support.h"

namespace dsw::oracle {
namespace {

class DeformTest : public BodyTest {
 protected:
  void SetUp() override {
    BodyTest::SetUp();
    scene_.reset();
    scene_ = make_scene(place_.get(), DSW_FEATURE_DEFORMING);
    mark_wall(1, 1, 1);
    mark_wall(1, 2, 1);
    mark_edge(2, 2, 1);
  }
  void TearDown() override {
    scene_.reset();
    place_.environment.reset();  // before what it reads
  }

  std::vector<double> arrays_[2];  // lent
};

TEST_F(DeformTest, GivesTheSameBitsTwice) {
  std::string bits[2];
  for (std::string& each : bits) {
    scene_.reset();
    place_ = Place();
    SetUp();
    const dsw_body_id body = make(tetrahedron({2.05, 1.5, 1.25}, 0.5), DSW_LEVEL_FACES, DSW_BODY_SEQUENCES);
    const dsw_body_id tool = make(tetrahedron({2.05, 1.1, 1.25}, 0.3), DSW_LEVEL_FACES, DSW_BODY_RIGID);
    std::vector<double> next = bent(points_of(place_.get()), 0.2);
    ASSERT_EQ(
        dsw_environment_deform(dsw_scene_get_environment(scene()), next.data(), next.size() / 3, nullptr, nullptr),
        DSW_STATUS_OK);
    const dsw_wall_contact* contacts = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_environment_get_wall_contacts(dsw_scene_get_environment(scene()), &contacts, &count), DSW_STATUS_OK);
    each = bits_of(read(body)) + bits_of(read(tool)) +
           std::string(reinterpret_cast<const char*>(next.data()), 8 * next.size()) +
           std::string(reinterpret_cast<const char*>(contacts), count * sizeof *contacts);
    scene_.reset();
    place_.environment.reset();  // before the array that it reads
  }
  EXPECT_EQ(bits[0], bits[1]);
}

TEST_F(DeformTest, KeepsAFaceWithItsCornersInOneLine) {
  const BodyPlan plan{{{0.25, 0.5, 0.5}, {0.75, 2.5, 0.5}, {0.5, 1.5, 0.5}}, {}, {{0, 1, 2}}};
  const dsw_body_id body = make(plan, DSW_LEVEL_FACES);
  for (const dsw_deform_method method : {DSW_DEFORM_SWEPT, DSW_DEFORM_END_STATE}) {
    dsw_deform_options options = defaults(dsw_deform_options_init);
    options.method = method;
    const std::vector<double> now = points_of(place_.get());
    std::vector<double>& next = arrays_[method == DSW_DEFORM_SWEPT ? 0 : 1];
    next = bent(now, 0.05);
    dsw_deform_report report;
    ASSERT_EQ(
        dsw_environment_deform(dsw_scene_get_environment(scene()), next.data(), next.size() / 3, &options, &report),
        DSW_STATUS_OK);
    EXPECT_EQ(report.outcome, DSW_DEFORM_DONE) << method;
    EXPECT_EQ(report.steps, method == DSW_DEFORM_SWEPT ? 1u : 0u);
  }
  EXPECT_EQ(read(body).at, plan.at);
}

/// The floor rises from 0 to 0.3. What lies lower comes to lie on it, wherever it lay, and is not tilted.
TEST_F(DeformTest, AFloorTakesThingsAsFarAsItGoesAfterTheTouch) {
  constexpr double kTop = 0.3, kRoom = 1e-9 * kTop + 8 * 0x1p-52 * 4;
  for (const double height : {1e-3, 0.1, 0.25, 0.299}) {
    TearDown();
    SetUp();
    const double at[3] = {3.25, 2.5, height};
    dsw_particle_id particle;
    ASSERT_EQ(dsw_particle_create(scene(), at, {0, 0}, &particle), DSW_STATUS_OK);
    const BodyPlan edge = segment({0.3, 0.4, height}, {2.2, 0.7, height});
    const BodyPlan face{{{0.3, 1.2, height}, {1.8, 1.4, height}, {0.9, 1.9, height}}, {}, {{0, 1, 2}}};
    const dsw_body_id soft[] = {make(edge), make(face, DSW_LEVEL_FACES), make({{{2.5, 2.5, height}}, {}, {}})};
    const dsw_body_id rigid[] = {
        make(segment({0.2, 2.4, height}, {1.9, 2.7, height}), DSW_LEVEL_EDGES, DSW_BODY_RIGID),
        make(tetrahedron({2.4, 3.1, height}, 0.4), DSW_LEVEL_FACES, DSW_BODY_RIGID),
        make(segment({0.3, 3.1, height}, {1.7, 3.6, height + 0.05}), DSW_LEVEL_EDGES, DSW_BODY_RIGID)};
    std::vector<std::vector<Vec>> before;
    for (const dsw_body_id body : rigid) before.push_back(read(body).at);
    std::vector<double>& next = arrays_[0];
    next = points_of(place_.get());
    for (size_t i = 2; i < next.size(); i += 3) next[i] = std::max(next[i], kTop);
    dsw_deform_report report;
    ASSERT_EQ(
        dsw_environment_deform(dsw_scene_get_environment(scene()), next.data(), next.size() / 3, nullptr, &report),
        DSW_STATUS_OK);
    EXPECT_EQ(report.outcome, DSW_DEFORM_DONE);
    EXPECT_EQ(report.steps, 1u);
    double now[3];
    ASSERT_EQ(dsw_particle_get_position(scene(), particle, now, nullptr), DSW_STATUS_OK);
    EXPECT_TRUE(now[2] >= kTop && now[2] <= kTop + kRoom) << height << " " << now[2] - kTop;
    for (const dsw_body_id body : soft) {
      for (const Vec& p : read(body).at) EXPECT_TRUE(p[2] >= kTop && p[2] <= kTop + kRoom) << p[2] - kTop;
    }
    for (size_t i = 0; i < before.size(); ++i) {
      double lowest = 3;
      const std::vector<Vec> now_at = read(rigid[i]).at;
      for (const Vec& p : now_at) lowest = std::min(lowest, p[2]);
      EXPECT_TRUE(lowest >= kTop && lowest <= kTop + kRoom) << height << " " << lowest - kTop;
      for (size_t v = 1; v < now_at.size(); ++v) {
        const double was = before[i][v][2] - before[i][0][2], is = now_at[v][2] - now_at[0][2];
        EXPECT_TRUE(was == 0 ? is == 0 : std::fabs(is - was) <= 0x1p-52) << height << " " << is - was;
      }
    }
  }
}

/// One thing can be pushed, and another one in the way of the same vertex can't: neither goes, and the vertex waits.
TEST_F(DeformTest, WhatIsPushedForAWallThatWaitsIsPutBack) {
  const double at[2][3] = {{0.8, 0.8, 0.1}, {1.2, 1.2, 0.99}};
  dsw_particle_id particles[2];
  for (int i = 0; i < 2; ++i) ASSERT_EQ(dsw_particle_create(scene(), at[i], {0, 0}, &particles[i]), DSW_STATUS_OK);
  dsw_face_id above{cube(1, 1, 0).index, cube(1, 1, 0).generation, 5};
  ASSERT_EQ(dsw_environment_mark_faces(place_.get(), &above, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  std::vector<double>& next = arrays_[0];
  next = points_of(place_.get());
  next[3 * point(1, 1, 0) + 2] = 1.5;
  dsw_deform_options options = defaults(dsw_deform_options_init);
  options.most_halvings = 1;
  dsw_deform_report report;
  ASSERT_EQ(dsw_environment_deform(dsw_scene_get_environment(scene()), next.data(), next.size() / 3, &options, &report),
            DSW_STATUS_OK);
  EXPECT_EQ(report.outcome, DSW_DEFORM_HELD);
  EXPECT_EQ(report.pushed_count, 0u);
  for (int i = 0; i < 2; ++i) {
    double now[3];
    ASSERT_EQ(dsw_particle_get_position(scene(), particles[i], now, nullptr), DSW_STATUS_OK);
    EXPECT_TRUE(std::equal(now, now + 3, at[i])) << i << " " << now[2];
  }
  const dsw_wall_contact* contacts = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_environment_get_wall_contacts(dsw_scene_get_environment(scene()), &contacts, &count), DSW_STATUS_OK);
  for (size_t i = 0; i < count; ++i) EXPECT_EQ(contacts[i].response, DSW_WALL_HOLD);
  EXPECT_GT(count, 0u);
}

TEST_F(DeformTest, CostsNothingWhereNothingLies) {
  std::vector<double> next = bent(points_of(place_.get()), 0.2);
  dsw_deform_report report;
  ASSERT_EQ(dsw_environment_deform(dsw_scene_get_environment(scene()), next.data(), next.size() / 3, nullptr, &report),
            DSW_STATUS_OK);
  EXPECT_EQ(report.near_count, 0u);
  EXPECT_EQ(report.outcome, DSW_DEFORM_DONE);
  EXPECT_EQ(points_of(place_.get()), next);
}

/// Cells with a body are folded over: their vertices stay, however small the steps are.
TEST_F(DeformTest, StopsAtTheWorkLimit) {
  dsw_environment* const environment = dsw_scene_get_environment(scene());
  const dsw_body_id body = make(tetrahedron({2.05, 1.5, 1.25}, 0.5), DSW_LEVEL_FACES);
  const auto before = read(body).at;
  const std::vector<double> from = points_of(place_.get());
  const auto fold = [&](std::vector<double>& next, uint32_t max_holds) {
    next = from;
    for (size_t i = 2; i < next.size(); i += 3) next[i] = 3 - next[i];  // all cells are turned inside out
    dsw_deform_options options = defaults(dsw_deform_options_init);
    options.response = DSW_WALL_HOLD;
    options.max_holds = max_holds;
    dsw_deform_report report;
    EXPECT_EQ(dsw_environment_deform(environment, next.data(), next.size() / 3, &options, &report), DSW_STATUS_OK);
    EXPECT_GT(report.held_count, 0u);
    EXPECT_EQ(read(body).at, before);
    load_both(saved(environment), saved(scene()));  // which looks whether all is free
    return report;
  };
  std::vector<double> next[2], back[2] = {from, from};
  for (int limited = 0; limited < 2; ++limited) {
    const dsw_deform_report report = fold(next[limited], limited == 0 ? 0 : 5);
    EXPECT_EQ(report.outcome, limited == 0 ? DSW_DEFORM_HELD : DSW_DEFORM_LIMITED);
    EXPECT_EQ(report.steps, limited == 0 ? 1024u : report.steps);
    if (limited != 0) {
      EXPECT_LE(report.contact_count, 5u);  // each is a hold
    }
    ASSERT_EQ(dsw_environment_deform(environment, back[limited].data(), from.size() / 3, nullptr, nullptr),
              DSW_STATUS_OK);
  }
}

class DeformMemoryTest : public MemoryTest {
 protected:
  void SetUp() override {
    MemoryTest::SetUp();
    scene_.reset();
    scene_ = make_scene(place_.get(), DSW_FEATURE_DEFORMING);
  }
};

TEST_F(DeformMemoryTest, NamingTheFeature) {
  scene_.reset();
  place_ = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(3, 1)), 0, context_.get());
  const size_t before = memory_.alive;
  dsw_scene_desc desc = defaults(dsw_scene_desc_init);
  desc.features = DSW_FEATURE_DEFORMING;
  dsw_scene* made = nullptr;
  const size_t refusals = until_it_succeeds([&] { return dsw_scene_create(place_.get(), &desc, &made); },
                                            [&] { return made == nullptr && memory_.alive == before; });
  EXPECT_GT(refusals, 2u);
  scene_.reset(made);
}

TEST_F(DeformMemoryTest, Deforming) {
  mark_wall(1, 1, 1);
  mark_wall(1, 2, 1);
  mark_edge(2, 2, 1);
  const double at[3] = {2.25, 1.5, 1.5};
  dsw_particle_id particle;
  ASSERT_EQ(dsw_particle_create(scene(), at, {0, 0}, &particle), DSW_STATUS_OK);
  const dsw_body_id body = make(tetrahedron({2.05, 1.5, 1.25}, 0.5), DSW_LEVEL_FACES, DSW_BODY_SEQUENCES);
  const dsw_body_id other = make(tetrahedron({0.25, 0.25, 0.25}, 0.5), DSW_LEVEL_EDGES);
  make(tetrahedron({2.05, 2.25, 1.25}, 0.5), DSW_LEVEL_FACES, DSW_BODY_RIGID);
  std::vector<std::vector<double>> arrays;  // all lent
  for (int method : {DSW_DEFORM_SWEPT, DSW_DEFORM_END_STATE}) {
    for (int response : {DSW_WALL_PUSH, DSW_WALL_INSERT, DSW_WALL_HOLD, DSW_WALL_STOP}) {
      if (method == DSW_DEFORM_END_STATE && response == DSW_WALL_HOLD) continue;
      dsw_deform_options options = defaults(dsw_deform_options_init);
      options.method = static_cast<dsw_deform_method>(method);
      options.response = static_cast<dsw_wall_response>(response);
      const std::vector<double> before = points_of(place_.get());
      // More than there was the time before, so that there is not yet room for it.
      for (int i = 0; i < 40; ++i) {
        dsw_particle_id another;
        const double free[3] = {0.5 + 0.01 * i, 3.5, 2.5};
        ASSERT_EQ(dsw_particle_create(scene(), free, {0, 0}, &another), DSW_STATUS_OK);
      }
      const std::string bits = bits_of(read(body)) + bits_of(read(other));
      arrays.push_back(bent(before, response % 2 == 0 ? 0.2 : -0.2));
      std::vector<double>& next = arrays.back();
      const std::vector<double> asked = next;
      double where[3];
      dsw_particle_get_position(scene(), particle, where, nullptr);
      const auto unchanged = [&] {
        double now[3];
        return dsw_particle_get_position(scene(), particle, now, nullptr) == DSW_STATUS_OK &&
               std::equal(now, now + 3, where) && next == asked && points_of(place_.get()) == before &&
               bits_of(read(body)) + bits_of(read(other)) == bits;
      };
      const size_t refusals = until_it_succeeds(
          [&] {
            return dsw_environment_deform(dsw_scene_get_environment(scene()), next.data(), next.size() / 3, &options,
                                          nullptr);
          },
          unchanged);
      EXPECT_GE(refusals, arrays.size() == 1 ? 5u : 0u);
    }
  }
  scene_.reset();
  place_.environment.reset();  // before the arrays that it reads
}

/// One particle is pushed, and a wall that squeezes another one is held: what is held is listed last, when all else is
/// done. A new scene for each refusal, since arrays that a refused call has grown stay so, and hide allocations from
/// the next one.
TEST_F(DeformMemoryTest, RunningOutOfMemoryAtTheEndPutsBackWhatWasPushed) {
  const double at[2][3] = {{2.05, 1.5, 1.5}, {2.05, 3.5, 1.5}};
  dsw_status status = DSW_STATUS_OUT_OF_MEMORY;
  size_t refusals = 0;
  for (; status != DSW_STATUS_OK && refusals < 500; ++refusals) {
    scene_.reset();
    place_ = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(3, 1)), 0, context_.get());
    scene_ = make_scene(place_.get(), DSW_FEATURE_DEFORMING);
    mark_wall(1, 1, 1);
    mark_wall(1, 3, 1);
    mark_wall(2, 3, 1);
    dsw_particle_id particles[2];
    for (int i = 0; i < 2; ++i) ASSERT_EQ(dsw_particle_create(scene(), at[i], {0, 0}, &particles[i]), DSW_STATUS_OK);
    const std::vector<double> before = points_of(place_.get());
    std::vector<double> next = before;  // lent
    for (uint32_t z = 1; z <= 2; ++z) {
      for (uint32_t y = 1; y <= 4; ++y) next[3 * point(2, y, z)] += 0.2;
      for (uint32_t y = 3; y <= 4; ++y) next[3 * point(3, y, z)] -= 0.9;
    }
    const std::vector<double> asked = next;
    dsw_deform_report report{};
    memory_.refuse = memory_.calls + refusals + 1;
    status = dsw_environment_deform(dsw_scene_get_environment(scene()), next.data(), next.size() / 3, nullptr, &report);
    memory_.refuse = 0;
    double now[2][3];
    for (int i = 0; i < 2; ++i)
      ASSERT_EQ(dsw_particle_get_position(scene(), particles[i], now[i], nullptr), DSW_STATUS_OK);
    const bool is_pushed = now[0][0] != at[0][0];
    if (status == DSW_STATUS_OK) {
      EXPECT_TRUE(is_pushed && report.held_count > 0);
    } else {
      ASSERT_EQ(status, DSW_STATUS_OUT_OF_MEMORY);
      ASSERT_TRUE(!is_pushed && now[1][0] == at[1][0]) << "after refusal " << refusals;
      ASSERT_TRUE(next == asked && points_of(place_.get()) == before) << "after refusal " << refusals;
    }
    scene_.reset();
    place_.environment.reset();  // before the array that it reads
  }
  EXPECT_EQ(status, DSW_STATUS_OK);
  EXPECT_GT(refusals, 20u);
}

/// What one deformation has pushed is not put back by the failure of the next one, of the other method.
TEST_F(DeformMemoryTest, AFailureLeavesWhatTheOneBeforeHasDone) {
  mark_wall(1, 1, 1);
  const double at[3] = {2.05, 1.5, 1.5};
  dsw_particle_id particle;
  ASSERT_EQ(dsw_particle_create(scene(), at, {0, 0}, &particle), DSW_STATUS_OK);
  std::vector<double> arrays[3];  // lent
  arrays[0] = points_of(place_.get());
  for (uint32_t y = 1; y <= 2; ++y) {
    for (uint32_t z = 1; z <= 2; ++z) arrays[0][3 * point(2, y, z)] += 0.2;
  }
  ASSERT_EQ(dsw_environment_deform(dsw_scene_get_environment(scene()), arrays[0].data(), arrays[0].size() / 3, nullptr,
                                   nullptr),
            DSW_STATUS_OK);
  double pushed[3];
  ASSERT_EQ(dsw_particle_get_position(scene(), particle, pushed, nullptr), DSW_STATUS_OK);
  ASSERT_GT(pushed[0], 2.1);
  const dsw_body_id body = make(tetrahedron({3.25, 1.5, 1.25}, 0.3), DSW_LEVEL_FACES);
  const std::string bits = bits_of(read(body));
  dsw_deform_options options = defaults(dsw_deform_options_init);
  options.method = DSW_DEFORM_END_STATE;
  arrays[1] = arrays[0];
  const size_t refusals = until_it_succeeds(
      [&] {
        return dsw_environment_deform(dsw_scene_get_environment(scene()), arrays[1].data(), arrays[1].size() / 3,
                                      &options, nullptr);
      },
      [&] {
        double now[3];
        return dsw_particle_get_position(scene(), particle, now, nullptr) == DSW_STATUS_OK &&
               std::equal(now, now + 3, pushed) && bits_of(read(body)) == bits;
      });
  EXPECT_GT(refusals, 0u);
  scene_.reset();
  place_.environment.reset();  // before the arrays that it reads
}

}  // namespace
}  // namespace dsw::oracle
