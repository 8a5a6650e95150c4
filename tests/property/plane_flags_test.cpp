// What the flags of a body leave out changes no bit, in the plane as in space: long edges, many cells, small obstacles.

#include "plane_support.h"

#include <cmath>
#include <cstddef>

namespace {

using namespace dsw::oracle;

constexpr uint32_t kSize = 24;
constexpr uint32_t kFlags[] = {0,
                               DSW_BODY_SEQUENCES,
                               DSW_BODY_NO_SEQUENCES,
                               DSW_BODY_SKIP_BY_ENVIRONMENT,
                               DSW_BODY_SKIP_BY_CLEARANCE,
                               DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BY_CLEARANCE};

struct Case {
  bool cut, deforming;
  dsw_level level;
  dsw_response response;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << (c.cut ? "triangles" : "quadrilaterals") << (c.deforming ? " of moving points" : "") << ", level "
             << c.level << ", response " << c.response;
}

/// Bodies that are the same but for their flags, and random moves for all.
class PlaneFlags : public testing::TestWithParam<Case> {
 protected:
  PlaneFlags() : environment_(make_squares(kSize, GetParam().cut)) { mark(); }

  void mark() {
    const uint32_t count = GetParam().cut ? 2 * kSize * kSize : kSize * kSize;
    for (uint32_t c = 0; c < count; ++c) {
      const dsw_volume_id volume = {c, 1};
      if (rng_.chance(0.01)) {
        dsw_environment_mark_volumes(environment_.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr);
      }
      const dsw_face_id side = {c, 1, rng_.below(3u)};
      if (rng_.chance(0.01)) dsw_environment_mark_faces(environment_.get(), &side, 1, DSW_MARK_IMPASSABLE);
    }
    for (uint32_t v = 0; v < (kSize + 1) * (kSize + 1); ++v) {
      const dsw_vertex_id vertex = {v, 1};
      if (rng_.chance(0.02)) dsw_environment_mark_vertices(environment_.get(), &vertex, 1, DSW_MARK_IMPASSABLE);
    }
  }

  /// A chain, or a closed curve. False where it is not free.
  bool make_bodies(dsw_scene* scene) {
    const uint32_t count = 3 + rng_.below(6u);
    const bool closed = rng_.chance(0.5);
    const double length = rng_.range(0.5, 5), turn = closed ? 6.283185307179586 / count : 0.4;
    std::vector<double> points = {rng_.range(0.1, kSize - 0.1), rng_.range(0.1, kSize - 0.1)};
    std::vector<uint32_t> edges;
    double angle = rng_.range(0, 6.28);
    for (uint32_t i = 1; i < count; ++i) {
      points.push_back(points[2 * i - 2] + length * std::cos(angle));
      points.push_back(points[2 * i - 1] + length * std::sin(angle));
      angle += closed ? turn : rng_.range(-turn, turn);
      edges.insert(edges.end(), {i - 1, i});
    }
    if (closed) edges.insert(edges.end(), {count - 1, 0});
    dsw_body_desc d = defaults(dsw_body_desc_init);
    d.level = GetParam().level;
    d.positions = points.data();
    d.vertex_count = count;
    d.edges = edges.data();
    d.edge_count = edges.size() / 2;
    for (size_t i = 0; i < std::size(kFlags); ++i) {
      d.flags = kFlags[i];
      const dsw_status status = dsw_body_create(scene, &d, &bodies_[i]);
      if (status == DSW_STATUS_OK) continue;
      EXPECT_EQ(i, 0u) << dsw_last_error_message();
      return false;
    }
    return true;
  }

  std::vector<double> positions(dsw_scene* scene, dsw_body_id body, std::vector<dsw_volume_id>* volumes = nullptr) {
    size_t count = 0;
    dsw_body_get_positions(scene, body, nullptr, 0, 0, nullptr, &count);
    std::vector<double> points(2 * count);
    if (volumes != nullptr) volumes->resize(count);
    dsw_volume_id* const cells = volumes == nullptr ? nullptr : volumes->data();
    EXPECT_EQ(dsw_body_get_positions(scene, body, points.data(), count, 0, cells, &count), DSW_STATUS_OK);
    return points;
  }

  /// Moves all alike; what each of them then is and says has the same bits.
  void move(dsw_scene* scene) {
    std::vector<double> targets = positions(scene, bodies_[0]);
    const double step = std::pow(10, rng_.range(-3, 0.3)), x = rng_.range(-step, step), y = rng_.range(-step, step);
    for (size_t i = 0; i < targets.size(); i += 2) {
      targets[i] += x + rng_.range(-step, step) / 4;
      targets[i + 1] += y + rng_.range(-step, step) / 4;
    }
    dsw_move_options options = defaults(dsw_move_options_init);
    options.edge_response = GetParam().response;
    options.vertex_response = GetParam().response == DSW_RESPONSE_STOP ? DSW_RESPONSE_STOP : DSW_RESPONSE_SLIDE;
    options.min_length = 0.05;
    dsw_move_report first{};
    std::string bits;
    for (size_t i = 0; i < std::size(kFlags); ++i) {
      dsw_move_report report{};
      ASSERT_EQ(dsw_body_move(scene, bodies_[i], targets.data(), targets.size() / 2, 0, &options, &report),
                DSW_STATUS_OK)
          << dsw_last_error_message();
      skipped_[i] += report.edges_skipped;
      const dsw_body_contact* contacts = nullptr;
      size_t count = 0;
      dsw_body_get_contacts(scene, bodies_[i], &contacts, &count);
      std::vector<dsw_volume_id> volumes;
      const std::vector<double> at = positions(scene, bodies_[i], &volumes);
      std::string own(reinterpret_cast<const char*>(at.data()), at.size() * sizeof(double));
      own.append(reinterpret_cast<const char*>(volumes.data()), volumes.size() * sizeof volumes[0]);
      for (size_t c = 0; c < count; ++c) {
        own.append(reinterpret_cast<const char*>(contacts + c),
                   offsetof(dsw_body_contact, history) + sizeof contacts[c].history);
      }
      if (i == 0) {
        bits = own;
        first = report;
        contacts_ += count;
      }
      ASSERT_EQ(own, bits) << "flags " << kFlags[i];
      ASSERT_EQ(report.vertices_stopped, first.vertices_stopped);
    }
    swept_ += first.edges_swept;
  }

  Rng rng_{11};
  EnvironmentPtr environment_;
  dsw_body_id bodies_[std::size(kFlags)] = {};
  size_t contacts_ = 0, swept_ = 0, skipped_[std::size(kFlags)] = {};
};

TEST_P(PlaneFlags, ChangeNoBit) {
  const ScenePtr scene = make_scene(environment_.get(), GetParam().deforming ? uint32_t{DSW_FEATURE_DEFORMING} : 0);
  ASSERT_NE(scene, nullptr);
  int made = 0;
  for (int tries = 0; made < 25 && tries < 1000 && !HasFatalFailure(); ++tries) {
    if (!make_bodies(scene.get())) continue;
    ++made;
    for (int i = 0; i < 40 && !HasFatalFailure(); ++i) move(scene.get());
    for (const dsw_body_id body : bodies_) dsw_body_destroy(scene.get(), body);
  }
  EXPECT_EQ(made, 25);
  EXPECT_GT(contacts_, 50u);
  EXPECT_EQ(skipped_[0], 0u);
  for (size_t i = 1; i < std::size(kFlags); ++i) {
    const double share = static_cast<double>(skipped_[i]) / static_cast<double>(swept_);
    RecordProperty("skipped_" + std::to_string(kFlags[i]), std::to_string(share));
  }
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const bool cut : {false, true}) {
    for (const bool deforming : {false, true}) {
      for (const dsw_level level : {DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT}) {
        for (const dsw_response response : {DSW_RESPONSE_STOP, DSW_RESPONSE_ADAPTIVE_SLIDE}) {
          cases.push_back({cut, deforming, level, response});
        }
      }
    }
  }
  return cases;
}
INSTANTIATE_TEST_SUITE_P(All, PlaneFlags, testing::ValuesIn(drawn_for("PlaneFlags", all_cases(), 8)));

}  // namespace
