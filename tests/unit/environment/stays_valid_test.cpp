// Whether a cell stays valid on its way, against the cell at many times of that way.
#include <gtest/gtest.h>

#include "base/dimensions.h"
#include "environment/moving.h"
#include "environment/validity.h"
#include "test_mesh.h"

namespace dsw::test {
namespace {

/** An environment whose points are put anywhere. Its cells start valid. */
template <int D>
class Moving {
 public:
  explicit Moving(const TestMesh<D>& mesh) : cell_count(static_cast<uint32_t>(mesh.types.size())), env_(mesh.build()) {
    let_points_move(*env_);
    rest.assign(env_->points, env_->points + size_t{D} * env_->map.vertex_count);
    start = end = now_ = rest;
  }
  bool stays(uint32_t cell) { return stays_valid(at(0), env_->map.cell(cell), end.data()); }
  /** Asks stays() about the way from its end to its start. */
  bool stays_backwards(uint32_t cell) { return stays_valid(at(1), env_->map.cell(cell), start.data()); }
  bool is_valid(uint32_t cell, double time) {
    const CellState state = check_cell(at(time), env_->map.cell(cell));
    return state == CellState::kValid || state == CellState::kValidConvex;
  }

  const uint32_t cell_count;
  std::vector<double> rest, start, end;

 private:
  const Environment<D>& at(double time) {
    for (size_t i = 0; i < now_.size(); ++i) now_[i] = start[i] + time * (end[i] - start[i]);
    env_->points = now_.data();
    env_->note_move();
    env_->checked.forget_all();
    return *env_;
  }
  std::unique_ptr<Environment<D>> env_;
  std::vector<double> now_;
};

constexpr int kMostTimes = 4096;

/** Small whole numbers times 4096: all times that are asked are exact, and so are most centres. */
template <int D>
void compare(const char* name, const TestMesh<D>& mesh, uint64_t seed, int count) {
  Moving<D> moving(mesh);
  Random random(seed);
  int stay = 0, leave = 0, only_between = 0, unseen = 0;
  for (int i = 0; i < count; ++i) {
    const int reach = i % 6 + 1;
    const bool turns = i % 5 == 0;  // a wide motion of all points that may come back to what is valid
    const double a = turns ? -1 - random.below(3) : 1, b = turns ? -1 - random.below(3) : 1;
    for (size_t k = 0; k < moving.rest.size(); ++k) {
      const double scale = k % D == 0 ? a : k % D == 1 ? b : 1;
      const double noise[2] = {double(random.below(2 * reach + 1) - reach),
                               double(random.below(2 * reach + 1) - reach)};
      moving.start[k] = kMostTimes * (8 * moving.rest[k] + (turns ? 0 : noise[0]));
      moving.end[k] = kMostTimes * (8 * scale * moving.rest[k] + (turns ? random.below(3) - 1 : noise[1]));
    }
    for (uint32_t c = 0; c < moving.cell_count; ++c) {
      if (!moving.is_valid(c, 0)) continue;
      const bool stays = moving.stays(c), ends_valid = moving.is_valid(c, 1);
      bool always = ends_valid;
      for (int t = 1; t < 64 && always; ++t) always = moving.is_valid(c, t / 64.0);
      if (stays) {
        ASSERT_TRUE(always) << name << " cell " << c << " move " << i;
      }
      if (ends_valid) {
        ASSERT_EQ(stays, moving.stays_backwards(c)) << name << " cell " << c << " move " << i;
      }
      (stays ? stay : leave) += 1;
      only_between += !stays && ends_valid ? 1 : 0;
      for (int t = 1; t < kMostTimes && !stays && always; ++t) always = moving.is_valid(c, double(t) / kMostTimes);
      unseen += !stays && always ? 1 : 0;
    }
  }
  std::printf("%s: %d stay valid, %d do not; of these %d are valid at both ends, %d at all times that were asked\n",
              name, stay, leave, only_between, unseen);
  EXPECT_GT(stay, count / 10);
  EXPECT_GT(only_between, 10);
  EXPECT_LT(unseen, 1 + leave / 30);  // flat at times that are no such fractions
}

TEST(StaysValid, TrueMeansValidAllTheTime) {
  Mesh3 tetrahedron;
  for (const auto& p : {std::array<double, 3>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    tetrahedron.point({p[0], p[1], p[2]});
  tetrahedron.cell(kTetra, {0, 1, 2, 3});
  compare("tetrahedron", tetrahedron, 1, 3000);
  Mesh3 box;
  add_boxes(box, 1, 1, 1);
  compare("box", box, 2, 2000);
  compare("mixed", mixed_mesh(), 3, 1000);
  Mesh2 triangles, squares;
  add_squares(triangles, 1, 1, true);
  compare("triangles", triangles, 4, 3000);
  add_squares(squares, 1, 1);
  compare("square", squares, 5, 3000);
}

TEST(StaysValid, FalseIfAVolumeTurnsOverAndBack) {
  Mesh3 mesh;
  for (const auto& p : {std::array<double, 3>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    mesh.point({p[0], p[1], p[2]});
  mesh.cell(kTetra, {0, 1, 2, 3});
  Moving<3> moving(mesh);
  // Two vertices change their sides, one after the other: the volume is (1 - 2 t) (1 - 4 t).
  moving.end = {0, 0, 0, -1, 0, 0, 0, -3, 0, 0, 0, 1};
  EXPECT_TRUE(moving.is_valid(0, 0));
  EXPECT_TRUE(moving.is_valid(0, 1));
  EXPECT_FALSE(moving.is_valid(0, 0.375));
  EXPECT_FALSE(moving.stays(0));
  // At the same time: it is flat for a moment.
  moving.end = {0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1};
  EXPECT_TRUE(moving.is_valid(0, 0.375));
  EXPECT_FALSE(moving.is_valid(0, 0.5));
  EXPECT_FALSE(moving.stays(0));
  // Flat at the very end; and just before that.
  moving.end = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0};
  EXPECT_FALSE(moving.stays(0));
  moving.end[11] = 0x1p-1070;
  EXPECT_TRUE(moving.stays(0));
}

TEST(StaysValid, IsExactAtAnySize) {
  Mesh3 mesh;
  add_boxes(mesh, 1, 1, 1);
  Moving<3> moving(mesh);
  for (const double scale : {0x1p-300, 1.0, 0x1p+300}) {
    for (size_t k = 0; k < moving.rest.size(); ++k) {
      moving.start[k] = scale * moving.rest[k];
      moving.end[k] = scale * (moving.rest[k] + 0.25 * moving.rest[(k + 1) % 3 + k / 3 * 3]);
    }
    EXPECT_TRUE(moving.stays(0)) << scale;
    for (size_t k = 0; k < moving.rest.size(); k += 3) moving.end[k] = -moving.end[k];
    EXPECT_FALSE(moving.stays(0)) << scale;
  }
}

}  // namespace
}  // namespace dsw::test
