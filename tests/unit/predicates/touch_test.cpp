// Touches of closed simplices against touch_truth.h.

#include "predicates/touch.h"

#include <gtest/gtest.h>

#include "cases.h"
#include "oracle.h"
#include "touch_truth.h"

namespace dsw {
namespace {

/** The triangle and the segment as they are. */
bool have_common_point(const double* const* t, const double* a, const double* b) {
  const TouchTruth truth = touch_truth(t[0], t[1], {t[2]}, {a, b});
  return truth.touches || truth.at_start;
}

struct Seen {
  int cases = 0, touches = 0, starts = 0;
};

void check(double found, const TouchTruth& truth, Seen& seen) {
  ++seen.cases;
  seen.starts += truth.at_start ? 1 : 0;
  if (truth.at_start) return;
  ASSERT_EQ(found != kNever, truth.touches) << found;
  if (!truth.touches) return;
  ++seen.touches;
  ASSERT_TRUE(oracle::is_time_below(found, truth.time.get_num(), truth.time.get_den()))
      << found << " " << truth.time.get_d();
}

/** Points of all families; often some stand twice or lie in one plane, line, or between others. */
class Draw {
 public:
  explicit Draw(uint64_t seed) : random_(seed) {}

  const double* const* next(bool small_lattice) {
    if (small_lattice) {
      for (auto& x : s_.x) {
        for (double& each : x) each = random_.between(-2, 2);
      }
      if (random_.below(2) == 0) flatten(random_.below(3));
      if (random_.below(4) == 0) flatten(random_.below(3));
    } else {
      draw(random_, 8, s_);
    }
    if (random_.below(4) == 0) std::copy_n(s_.x[random_.below(5)], 3, s_.x[random_.below(5)]);
    return s_.at;
  }
  int below(int n) { return random_.below(n); }

 private:
  void flatten(int axis) {
    for (auto& x : s_.x) x[axis] = 1;
  }
  Random random_;
  PointSet<3> s_;
};

class TouchTest : public testing::TestWithParam<bool> {
 protected:
  const int cases_ = static_cast<int>(case_count() / 20);
  Draw draw_{GetParam() ? 3u : 5u};
  Seen seen_;

  template <class Check>
  void for_all(Check each) {
    for (int i = 0; i < cases_; ++i) {
      SCOPED_TRACE(i);
      each(draw_.next(GetParam()));
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(seen_.touches, cases_ / 34);
  }
};
INSTANTIATE_TEST_SUITE_P(All, TouchTest, testing::Bool(),
                         [](const auto& i) { return i.param ? "SmallLattice" : "AllFamilies"; });

TEST_P(TouchTest, AVertexTouchesATriangleAtItsTime) {
  for_all([&](const double* const* x) {
    if (std::equal(x[0], x[0] + 3, x[1])) return;
    check(vertex_touch(x[0], x[1], x + 2), touch_truth(x[0], x[1], {}, {x[2], x[3], x[4]}), seen_);
  });
}

TEST_P(TouchTest, AnEdgeTouchesASegmentAtItsTime) {
  for_all([&](const double* const* x) {
    if (std::equal(x[0], x[0] + 3, x[1])) return;
    const double* const q = draw_.below(8) == 0 ? x[0] : x[2];
    const double* const b = draw_.below(8) == 0 ? x[3] : x[4];
    check(edge_touch({x[0], x[1], q}, x[3], b).time, touch_truth(x[0], x[1], {q}, {x[3], b}), seen_);
  });
}

TEST_P(TouchTest, AFaceTouchesAPointAtItsTime) {
  for_all([&](const double* const* x) {
    if (std::equal(x[0], x[0] + 3, x[1])) return;
    const double found = face_touch({x[0], x[1], x[2], x[3]}, x[4]);
    // What lies in one plane is left to the edges.
    const double by_edge =
        std::min(edge_touch({x[0], x[1], x[2]}, x[4], x[4]).time, edge_touch({x[0], x[1], x[3]}, x[4], x[4]).time);
    check(std::min(found, by_edge), touch_truth(x[0], x[1], {x[2], x[3]}, {x[4]}), seen_);
  });
}

TEST_P(TouchTest, ATriangleAndASegmentHaveACommonPointOrNot) {
  for_all([&](const double* const* x) {
    const bool touches = triangle_touches(x, x[3], x[4]);
    ASSERT_EQ(touches, have_common_point(x, x[3], x[4]));
    const double* const line[3] = {x[0], x[1], x[1]};
    ASSERT_EQ(segments_touch(x[0], x[1], x[3], x[4]), have_common_point(line, x[3], x[4]));
    seen_.touches += touches ? 1 : 0;
  });
}

}  // namespace
}  // namespace dsw
