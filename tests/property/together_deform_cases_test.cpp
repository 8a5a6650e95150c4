// An environment bends while bodies move: bad input, memory that runs out, and single cases that are known.
#include "host_memory.h"
#include "together_deform_support.h"

#include <cmath>
#include <limits>

namespace dsw::oracle {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class TogetherDeformMoreTest : public MemoryTest {
 protected:
  void SetUp() override {
    MemoryTest::SetUp();
    begin(DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
  }
  void begin(uint32_t features) {
    scene_.reset();
    scene_ = make_scene(place_.get(), features);
    const double* points = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_environment_get_points(place_.get(), &points, &count), DSW_STATUS_OK);
    rest_.assign(points, points + 3 * count);
    next_ = rest_;
    body_ = make(tetrahedron({1.2, 1.2, 1.2}, 0.5), DSW_LEVEL_FACES,
                 features & DSW_FEATURE_BODY_CONTACTS ? DSW_BODY_SELF_CONTACTS : 0);
    still_ = make(segment({2.3, 1.2, 1.5}, {2.7, 2.8, 1.6}));
    const double at[3] = {1.5, 2.5, 1.5};
    ASSERT_EQ(dsw_particle_create(scene(), at, {0, 0}, &particle_), DSW_STATUS_OK);
    targets_ = read(body_).at;
  }
  void TearDown() override {
    scene_.reset();
    place_.environment.reset();  // before what it reads
    MemoryTest::TearDown();
  }
  dsw_status deform(dsw_deform_report* report = nullptr, dsw_move_report* of_body = nullptr) {
    return dsw_scene_deform(scene(), next_.data(), next_.size() / 3, &body_, 1, targets_[0].data(), targets_.size(), 0,
                            nullptr, report, of_body);
  }
  /// All that the interface tells.
  std::string everything() {
    const double* points = nullptr;
    size_t count = 0, walls_count = 0, contacts_count = 0;
    const dsw_wall_contact* walls = nullptr;
    EXPECT_EQ(dsw_environment_get_points(place_.get(), &points, &count), DSW_STATUS_OK);
    EXPECT_EQ(dsw_environment_get_wall_contacts(place_.get(), &walls, &walls_count), DSW_STATUS_OK);
    std::string all = bits_of(read(body_)) + bits_of(read(still_));
    double at[3];
    dsw_volume_id volume;
    EXPECT_EQ(dsw_particle_get_position(scene(), particle_, at, &volume), DSW_STATUS_OK);
    all.append(reinterpret_cast<const char*>(at), sizeof at);
    all += std::to_string(volume.index) + (points == next_.data() ? "next" : "old");
    all.append(reinterpret_cast<const char*>(points), 24 * count);
    all.append(reinterpret_cast<const char*>(next_.data()), 8 * next_.size());
    all.append(reinterpret_cast<const char*>(walls), walls_count * sizeof *walls);
    for (const dsw_body_id id : {body_, still_}) {
      const dsw_body_contact* contacts = nullptr;
      EXPECT_EQ(dsw_body_get_contacts(scene(), id, &contacts, &contacts_count), DSW_STATUS_OK);
      all.append(reinterpret_cast<const char*>(contacts), contacts_count * sizeof *contacts);
    }
    return all;
  }
  /// Bends all that lies between the outer sides.
  void bend(double by) {
    for (size_t v = 0; v < rest_.size() / 3; ++v) {
      const double* const p = &rest_[3 * v];
      if (p[0] == 0 || p[0] == 4 || p[1] == 0 || p[1] == 4 || p[2] == 0 || p[2] == 3) continue;
      next_[3 * v] = p[0] + by * std::sin(3 * p[1] + p[2]);
      next_[3 * v + 1] = p[1] + by * std::sin(2 * p[0]);
    }
  }
  std::vector<double> points_now() {
    const double* points = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_environment_get_points(place_.get(), &points, &count), DSW_STATUS_OK);
    return std::vector<double>(points, points + 3 * count);
  }
  void move_target(double x, double y, double z) {
    for (Vec& p : targets_) p = {p[0] + x, p[1] + y, p[2] + z};
  }
  bool is_unchanged(const std::string& before, const dsw_deform_report& report, const dsw_move_report& of_body) {
    const auto untouched = [](const auto& r) {
      const auto* const bytes = reinterpret_cast<const unsigned char*>(&r);
      return std::all_of(bytes, bytes + sizeof r, [](unsigned char byte) { return byte == 0x55; });
    };
    return everything() == before && untouched(report) && untouched(of_body);
  }

  std::vector<double> rest_, next_;
  std::vector<Vec> targets_;
  dsw_body_id body_, still_;
  dsw_particle_id particle_;
};

TEST_F(TogetherDeformMoreTest, BadInputChangesNothing) {
  bend(0.05);
  std::vector<double> first = next_;  // the environment reads these
  ASSERT_EQ(
      dsw_scene_deform(scene(), first.data(), first.size() / 3, nullptr, 0, nullptr, 0, 0, nullptr, nullptr, nullptr),
      DSW_STATUS_OK);
  bend(0.1);
  move_target(0.1, 0, 0);
  const std::string before = everything();
  dsw_deform_report report;
  dsw_move_report reports[2];
  const size_t points = next_.size() / 3, count = targets_.size();
  dsw_scene_deform_options options = defaults(dsw_scene_deform_options_init);
  const auto refused = [&](dsw_status expected, dsw_scene* of, double* next, size_t point_count,
                           const dsw_body_id* bodies, size_t body_count, const double* targets, size_t target_count,
                           size_t stride, const dsw_scene_deform_options* o, int line) {
    std::memset(&report, 0x55, sizeof report);
    std::memset(reports, 0x55, sizeof reports);
    EXPECT_EQ(
        dsw_scene_deform(of, next, point_count, bodies, body_count, targets, target_count, stride, o, &report, reports),
        expected)
        << "line " << line << ": " << dsw_last_error_message();
    EXPECT_TRUE(is_unchanged(before, report, reports[0])) << "line " << line;
  };
  double* const next = next_.data();
  const double* const to = targets_[0].data();
  refused(DSW_STATUS_NULL_ARGUMENT, nullptr, next, points, &body_, 1, to, count, 0, nullptr, __LINE__);
  refused(DSW_STATUS_NULL_ARGUMENT, scene(), nullptr, points, &body_, 1, to, count, 0, nullptr, __LINE__);
  refused(DSW_STATUS_NULL_ARGUMENT, scene(), next, points, nullptr, 1, to, count, 0, nullptr, __LINE__);
  refused(DSW_STATUS_NULL_ARGUMENT, scene(), next, points, &body_, 1, nullptr, count, 0, nullptr, __LINE__);
  refused(DSW_STATUS_WRONG_SIZE, scene(), next, points - 1, &body_, 1, to, count, 0, nullptr, __LINE__);
  refused(DSW_STATUS_WRONG_SIZE, scene(), next, points + 1, &body_, 1, to, count, 0, nullptr, __LINE__);
  refused(DSW_STATUS_WRONG_SIZE, scene(), next, points, &body_, 1, to, count - 1, 0, nullptr, __LINE__);
  refused(DSW_STATUS_WRONG_SIZE, scene(), next, points, nullptr, 0, to, count, 0, nullptr, __LINE__);
  refused(DSW_STATUS_WRONG_SIZE, scene(), next, points, &body_, 1, to, count, 16, nullptr, __LINE__);
  refused(DSW_STATUS_WRONG_SIZE, scene(), next, points, &body_, 1, to, count, 25, nullptr, __LINE__);
  const dsw_body_id twice[2] = {body_, body_}, stale[2] = {body_, {still_.index, still_.generation + 1}};
  std::vector<Vec> more = targets_;
  more.insert(more.end(), targets_.begin(), targets_.end());
  refused(DSW_STATUS_DUPLICATE_ID, scene(), next, points, twice, 2, more[0].data(), more.size(), 0, nullptr, __LINE__);
  refused(DSW_STATUS_STALE_ID, scene(), next, points, stale, 2, more[0].data(), more.size(), 0, nullptr, __LINE__);
  refused(DSW_STATUS_IN_USE, scene(), first.data(), points, &body_, 1, to, count, 0, nullptr, __LINE__);
  options.point_room = points - 1;
  refused(DSW_STATUS_WRONG_SIZE, scene(), next, points, &body_, 1, to, count, 0, &options, __LINE__);
  options = defaults(dsw_scene_deform_options_init);
  options.flags = 1;
  refused(DSW_STATUS_UNSUPPORTED, scene(), next, points, &body_, 1, to, count, 0, &options, __LINE__);
  options = defaults(dsw_scene_deform_options_init);
  options.struct_size = 3;
  refused(DSW_STATUS_BAD_STRUCT_SIZE, scene(), next, points, &body_, 1, to, count, 0, &options, __LINE__);
  for (const double bad : {kNaN, HUGE_VAL, -HUGE_VAL}) {
    more = targets_;
    more[2][1] = bad;
    refused(DSW_STATUS_NON_FINITE, scene(), next, points, &body_, 1, more[0].data(), count, 0, nullptr, __LINE__);
  }
  // Vertex (1, 1, 1) is a corner of the body's volume.
  const double good = next_[3 * point(1, 1, 1)];
  for (const double bad : {kNaN, HUGE_VAL}) {
    next_[3 * point(1, 1, 1)] = bad;
    const std::string bytes(reinterpret_cast<const char*>(next_.data()), 8 * next_.size());
    const std::string now = everything();
    EXPECT_EQ(deform(), DSW_STATUS_NON_FINITE);
    EXPECT_EQ(everything(), now);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(next_.data()), 8 * next_.size()), bytes);
  }
  next_[3 * point(1, 1, 1)] = good;
  EXPECT_EQ(everything(), before);
  next_[3 * point(4, 4, 3)] = kNaN;  // far from all
  ASSERT_EQ(deform(&report), DSW_STATUS_OK);
  EXPECT_EQ(report.outcome, DSW_DEFORM_DONE);
  EXPECT_TRUE(std::isnan(next_[3 * point(4, 4, 3)]));
  EXPECT_EQ(read(body_).at, targets_);
  scene_.reset();
  place_.environment.reset();
}

TEST_F(TogetherDeformMoreTest, ScenesThatDoNotDeformAreRefused) {
  begin(DSW_FEATURE_BODY_CONTACTS);
  EXPECT_EQ(deform(), DSW_STATUS_NOT_ENABLED);
}

TEST_F(TogetherDeformMoreTest, AnEmptySceneBends) {
  scene_.reset();
  scene_ = make_scene(place_.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
  bend(0.3);
  dsw_deform_report report;
  ASSERT_EQ(
      dsw_scene_deform(scene(), next_.data(), next_.size() / 3, nullptr, 0, nullptr, 0, 0, nullptr, &report, nullptr),
      DSW_STATUS_OK);
  EXPECT_EQ(report.outcome, DSW_DEFORM_DONE);
  EXPECT_EQ(report.contact_count + report.invalid_count + report.held_count, 0u);
}

TEST_F(TogetherDeformMoreTest, AWallThatRestsOnABodyDoesNotComeNearer) {
  mark_wall(1, 1, 1);
  const dsw_body_id resting = make(segment({2, 1.25, 1.25}, {2, 1.75, 1.75}));
  for (uint32_t y = 1; y < 3; ++y) {
    for (uint32_t z = 1; z < 3; ++z) next_[3 * point(2, y, z)] += 0.25;
  }
  const std::string before = everything() + bits_of(read(resting));
  dsw_deform_report report;
  dsw_move_report of_body;
  ASSERT_EQ(deform(&report, &of_body), DSW_STATUS_OK);
  if (report.fraction != 0) return;  // the shift keeps the body on that side
  EXPECT_EQ(report.outcome, DSW_DEFORM_REFUSED);
  EXPECT_GT(report.contact_count, 0u);
  EXPECT_EQ(of_body.fraction, 0);
  const dsw_wall_contact* walls = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_environment_get_wall_contacts(place_.get(), &walls, &count), DSW_STATUS_OK);
  EXPECT_EQ(walls[0].body.index, resting.index);
  EXPECT_EQ(walls[0].time, 0);
}

/// A vertex slides along an oblique wall, and out of the box of its way. What turns over beside the new way, where nothing goes, is
/// no concern of it.
TEST(TogetherDeformRooms, WhatTurnsOverBesideAWayDoesNotShortenIt) {
  constexpr double kSize = 1.0 / 32;
  std::vector<double> along, across;
  for (int i = -10; i <= 40; ++i) along.push_back(kSize * i);
  for (int i = -1; i <= 24; ++i) across.push_back(kSize * i);
  Mesh mesh = hex_grid(along, across, {0, kSize, 2 * kSize});
  size_t turning = mesh.points.size();
  for (size_t i = 0; i < mesh.points.size(); ++i) {
    Vec& p = mesh.points[i];
    if (p == Vec{18 * kSize, 5 * kSize, kSize}) turning = i;
    p = {p[0] - p[1], p[0] + p[1], p[2]};  // the wall goes where both grow
  }
  ASSERT_LT(turning, mesh.points.size());
  std::vector<Vec> ends;
  for (const bool turns : {false, true}) {
    const Place place = place_of(mesh);
    ASSERT_PLACE(place);
    ScenePtr scene = make_scene(place.get(), DSW_FEATURE_DEFORMING);
    dsw_body_id body;
    const Vec start = {0.001, 0.002, 1.4 * kSize}, target = {1, 0.002, 1.4 * kSize};
    ASSERT_EQ(create_body(scene.get(), {{start}, {}, {}}, DSW_LEVEL_POINTS, 0, {}, &body), DSW_STATUS_OK)
        << dsw_last_error_message();
    std::vector<double> next;
    for (const Vec& p : mesh.points) next.insert(next.end(), p.begin(), p.end());
    if (turns) {
      for (const size_t k : {0u, 1u}) next[3 * turning + k] += 3 * kSize;
    }
    dsw_scene_deform_options options = defaults(dsw_scene_deform_options_init);
    options.stop = DSW_TOGETHER_STOP_FEATURE;
    options.response = DSW_TOGETHER_RESPONSE_SLIDE;
    dsw_deform_report report;
    ASSERT_EQ(dsw_scene_deform(scene.get(), next.data(), mesh.points.size(), &body, 1, target.data(), 1, 0, &options,
                               &report, nullptr),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    EXPECT_EQ(report.fraction, 1);
    EXPECT_EQ(report.outcome, DSW_DEFORM_DONE);
    EXPECT_EQ(report.invalid_count, 0u);
    BodyState state;
    ASSERT_EQ(read_body(scene.get(), body, state), "");
    ends.push_back(state.at[0]);
  }
  EXPECT_GT(ends[0][1], 0.4);  // it has slid, farther than the room beside its way
  EXPECT_EQ(ends[0], ends[1]);
}

TEST_F(TogetherDeformMoreTest, HugeWaysAreAnswered) {
  Rng rng(4);
  std::deque<std::vector<double>> arrays;
  size_t refused = 0;
  for (int round = 0; round < 6; ++round) {
    std::vector<double>& array = arrays.emplace_back(points_now());
    const double size = std::ldexp(1, 20 + 160 * round);
    for (double& x : array) {
      if (rng.chance(0.1)) x = std::min(1.7e308, size) * rng.range(-1, 1);
    }
    for (Vec& p : targets_ = read(body_).at) {
      for (double& x : p) x = round % 2 == 0 ? x : std::min(1.7e308, size) * rng.range(-1, 1);
    }
    dsw_deform_report report;
    dsw_move_report of_body;
    ASSERT_EQ(dsw_scene_deform(scene(), array.data(), array.size() / 3, &body_, 1, targets_[0].data(), targets_.size(),
                               0, nullptr, &report, &of_body),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    EXPECT_EQ(report.fraction, of_body.fraction) << round;
    refused += report.outcome == DSW_DEFORM_REFUSED ? 1 : 0;
    const BodyState state = read(body_);
    for (const dsw_volume_id volume : state.volumes) {
      int valid = 0;
      ASSERT_EQ(dsw_environment_is_valid(place_.get(), volume, &valid), DSW_STATUS_OK);
      EXPECT_EQ(valid, 1) << round;
    }
    EXPECT_EQ(dsw_body_set_level(scene(), body_, DSW_LEVEL_POINTS), DSW_STATUS_OK);
    EXPECT_EQ(dsw_body_set_level(scene(), body_, DSW_LEVEL_FACES), DSW_STATUS_OK) << round;
  }
  EXPECT_GT(refused, 0u);
  scene_.reset();
  place_.environment.reset();
}

TEST_F(TogetherDeformMoreTest, MemoryThatRunsOutChangesNothing) {
  struct Case {
    const char* name;
    double bend, x;
    dsw_deform_outcome outcome;
    bool touches, halves, has_wall;
  };
  for (const Case& each : {Case{"arrives", 0.05, 0.2, DSW_DEFORM_DONE, false, false, false},
                           Case{"touches", 0.05, 1.2, DSW_DEFORM_FRACTION, true, false, false},
                           Case{"touches a wall", 0.05, 0.6, DSW_DEFORM_FRACTION, true, false, true},
                           Case{"halves", 0.6, 0.1, DSW_DEFORM_FRACTION, false, true, false}}) {
    scene_.reset();
    place_.environment.reset();
    context_.reset();
    EXPECT_EQ(memory_.alive, 0u);
    memory_ = Memory();
    MemoryTest::SetUp();
    begin(DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_LIVE_CHANGES);
    if (each.has_wall) mark_wall(1, 1, 1);
    bend(each.bend);
    move_target(each.x, 0, 0);
    const std::string before = everything();
    dsw_deform_report report;
    dsw_move_report of_body;
    std::memset(&report, 0x55, sizeof report);
    std::memset(&of_body, 0x55, sizeof of_body);
    const size_t refusals = until_it_succeeds([&] { return deform(&report, &of_body); },
                                              [&] { return is_unchanged(before, report, of_body); });
    std::printf("%s: %zu refusals, fraction %g, %u contacts, %u invalid\n", each.name, refusals, report.fraction,
                report.contact_count, report.invalid_count);
    EXPECT_GT(refusals, 20u) << each.name;
    EXPECT_EQ(report.outcome, each.outcome) << each.name;
    EXPECT_EQ(report.invalid_count != 0, each.halves) << each.name;
    EXPECT_EQ(report.contact_count != 0, each.has_wall) << each.name;
    const dsw_body_contact* contacts = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_body_get_contacts(scene(), body_, &contacts, &count), DSW_STATUS_OK);
    EXPECT_EQ(count != 0, each.touches) << each.name;
  }
}

int append(void* user, const void* bytes, size_t size) {
  static_cast<std::string*>(user)->append(static_cast<const char*>(bytes), size);
  return 0;
}

TEST_F(TogetherDeformMoreTest, ARecordingIsMadeAgain) {
  begin(DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
  std::string recording;
  dsw_recording_desc desc = defaults(dsw_recording_desc_init);
  desc.write = append;
  desc.user = &recording;
  desc.flags = DSW_RECORDING_STATES;
  ASSERT_EQ(dsw_scene_start_recording(scene(), &desc), DSW_STATUS_OK);
  Rng rng(8);
  std::deque<std::vector<double>> arrays;
  size_t calls = 0, stops = 0, halved = 0, failed = 0;
  for (int round = 0; round < at_least(60); ++round) {
    std::vector<double>& array = arrays.emplace_back(points_now());
    const double reach = round % 3 == 0 ? 0.4 : 0.05;
    for (size_t v = 0; v < array.size() / 3; ++v) {
      for (size_t k = 0; k < 3 && rng.chance(0.5); ++k) array[3 * v + k] += rng.range(-reach, reach);
    }
    targets_ = read(body_).at;
    move_target(rng.range(-0.5, 0.5), rng.range(-0.5, 0.5), rng.range(-0.5, 0.5));
    const bool fails = round % 10 == 9;
    if (fails) array[3 * read(body_).volumes[0].index] = kNaN;
    dsw_deform_report report;
    const dsw_status status = dsw_scene_deform(scene(), array.data(), array.size() / 3, &body_, 1, targets_[0].data(),
                                               targets_.size(), 0, nullptr, &report, nullptr);
    ++calls;
    failed += status != DSW_STATUS_OK ? 1 : 0;
    stops += status == DSW_STATUS_OK && report.outcome != DSW_DEFORM_DONE ? 1 : 0;
    halved += status == DSW_STATUS_OK && report.invalid_count != 0 ? 1 : 0;
  }
  ASSERT_EQ(dsw_scene_stop_recording(scene()), DSW_STATUS_OK);
  for (const bool validated : {false, true}) {
    dsw_replay* replay = nullptr;
    ASSERT_EQ(dsw_replay_create(nullptr, recording.data(), recording.size(), &replay), DSW_STATUS_OK);
    size_t same = 0, wrong = 0;
    dsw_replay_report step = {};
    do {
      dsw_validation validation = {};
      validation.struct_size = sizeof validation;
      ASSERT_EQ(validated ? dsw_replay_step_validated(replay, &step, &validation) : dsw_replay_step(replay, &step),
                DSW_STATUS_OK)
          << dsw_last_error_message();
      same += step.outcome == DSW_REPLAY_SAME ? 1 : 0;
      if (validated && step.outcome == DSW_REPLAY_SAME && validation.is_right != 1) {
        ++wrong;
        ADD_FAILURE() << "call " << step.call << ": " << validation.text;
      }
    } while (step.outcome == DSW_REPLAY_SAME);
    EXPECT_EQ(step.outcome, DSW_REPLAY_END);
    EXPECT_EQ(same, calls);
    EXPECT_EQ(dsw_replay_destroy(replay), DSW_STATUS_OK);
  }
  std::printf("%zu calls, %zu stops, %zu halved, %zu fail\n", calls, stops, halved, failed);
  scene_.reset();
  place_.environment.reset();
}

}  // namespace
}  // namespace dsw::oracle
