// Cuts right through environments of every kind: what a cut leaves lies on one side of the blade or on the other.
#include <cmath>
#include <set>

#include "environment/validity.h"
#include "map/integrity.h"
#include "predicates/filtered.h"
#include "random_edits.h"

namespace dsw::oracle {
namespace {

class CutTest : public SceneTest {
 protected:
  /// A plane far beyond the environment, through a point near its middle.
  void make_blade(Rng& rng) {
    const Environment<3>& e = dsw::capi::space(*place_.get());
    double u[3], v[3];
    for (int k = 0; k < 3; ++k) {
      u[k] = rng.range(-1, 1);
      v[k] = rng.range(-1, 1);
    }
    const double reach = 10 * place_.world->size;
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) {
        for (int k = 0; k < 3; ++k) {
          const double middle = 0.52 * e.lower[k] + 0.48 * e.upper[k];
          blade_[6 * row + 3 * column + k] = middle + reach * ((2 * row - 1) * u[k] + (2 * column - 1) * v[k]);
        }
      }
    }
    dsw_cut_desc_init(&desc_, sizeof desc_);
    desc_.points = blade_;
    desc_.rows = desc_.columns = 2;
  }
  void cut(uint64_t seed) {
    place_ = make_place(GetParam(), seed);
    if (place_.environment == nullptr) return;
    Rng rng(seed);
    make_blade(rng);
    desc_.start = volume_id(dsw::capi::space(*place_.get()).map, dsw::capi::space(*place_.get()).map.cell(0));
    ASSERT_EQ(dsw_environment_cut(place_.get(), &desc_, &report_), DSW_STATUS_OK) << dsw_last_error_message();
  }
  std::vector<dsw_cut_face> faces() const {
    const dsw_cut_face* faces = change_of(place_.get()).faces;
    const size_t count = change_of(place_.get()).face_count;
    return {faces, faces + count};
  }
  /// Signed height of a point over the blade's plane.
  double height(const double* p) const {
    double a[3], b[3], w[3];
    for (int k = 0; k < 3; ++k) {
      a[k] = blade_[3 + k] - blade_[k];
      b[k] = blade_[9 + k] - blade_[k];
      w[k] = p[k] - blade_[k];
    }
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return (n[0] * w[0] + n[1] * w[1] + n[2] * w[2]) / std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }
  /// Adds the volumes that the last cut left whole.
  void add_whole(std::set<uint32_t>& is_whole) const {
    const dsw_volume_id* ids = change_of(place_.get()).whole;
    const size_t count = change_of(place_.get()).whole_count;
    EXPECT_EQ(count, report_.whole_count);
    for (size_t i = 0; i < count; ++i) {
      is_whole.insert(ids[i].index);
      EXPECT_TRUE(dsw::capi::space(*place_.get()).map.is_alive(ids[i].index, ids[i].generation));
    }
  }
  /// Volumes with vertices farther from the plane than `slack` on both of its sides, but for those known to be whole.
  std::vector<dsw::Cell> crossed(double slack, const std::set<uint32_t>& is_whole) const {
    const Environment<3>& e = dsw::capi::space(*place_.get());
    std::vector<dsw::Cell> cells;
    for_each_cell(e.map, [&](dsw::Cell c) {
      bool before = false, behind = false;
      for (uint32_t k = 0; k < e.map.vertices_of(c); ++k) {
        before = before || height(e.point(c, k)) > slack;
        behind = behind || height(e.point(c, k)) < -slack;
      }
      if (before && behind && is_whole.count(e.map.index(c)) == 0) cells.push_back(c);
    });
    return cells;
  }
  /// The faces of the last cut lie between volumes on its two sides.
  void check_faces() const {
    const Environment<3>& e = dsw::capi::space(*place_.get());
    for (const dsw_cut_face& f : faces()) {
      const dsw::Cell front = e.map.cell(f.front.volume), back = e.map.cell(f.back.volume);
      ASSERT_TRUE(e.map.is_alive(f.front.volume, f.front.generation) &&
                  e.map.is_alive(f.back.volume, f.back.generation));
      EXPECT_TRUE(e.map.opposite(e.map.half_facet(front, f.front.local)) == e.map.half_facet(back, f.back.local));
      double of_front[3], of_back[3];
      centre(e, front, of_front);
      centre(e, back, of_back);
      EXPECT_GT(height(of_front), height(of_back));
    }
  }

  Place place_;
  double blade_[12] = {};
  dsw_cut_desc desc_{};
  dsw_change report_ = empty_change();
};
DSW_FOR_ALL_SCENES(CutTest);

TEST_P(CutTest, NothingIsOnBothSidesOfThePlaneButWhatStayedWhole) {
  size_t split = 0, whole = 0;
  for (uint64_t seed = 1; seed <= seeds_of(12); ++seed) {
    cut(seed);
    if (place_.environment == nullptr) continue;
    ASSERT_FALSE(HasFatalFailure());
    const Environment<3>& e = dsw::capi::space(*place_.get());
    std::set<uint32_t> is_whole;
    double slack = 1e-12 * place_.world->size;
    std::vector<dsw::Cell> left;
    do {
      ASSERT_EQ(check_integrity(e.map), nullptr);
      for_each_cell(e.map, [&](dsw::Cell c) {
        EXPECT_TRUE(check_cell(e, c) == CellState::kValid || check_cell(e, c) == CellState::kValidConvex);
      });
      check_faces();
      split += report_.volumes_split;
      whole += report_.whole_count;
      EXPECT_LE(report_.distance, 0.1 * place_.world->size);
      slack = std::max(slack, 1.01 * report_.distance);
      add_whole(is_whole);
      left = crossed(slack, is_whole);
      if (left.empty()) break;
      // The plane meets an environment that is not convex in several parts; each is a cut of its own.
      desc_.start = volume_id(e.map, left[0]);
      ASSERT_EQ(dsw_environment_cut(place_.get(), &desc_, &report_), DSW_STATUS_OK) << dsw_last_error_message();
    } while (report_.volumes_split + report_.whole_count > 0);
    EXPECT_TRUE(left.empty()) << "volume " << e.map.index(left[0]) << ", seed " << seed;
  }
  RecordProperty("split", static_cast<int>(split));
  RecordProperty("whole", static_cast<int>(whole));
  EXPECT_GT(split, 0u);
}

}  // namespace
}  // namespace dsw::oracle
