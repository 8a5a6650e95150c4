// Touches of closed simplices against touch_truth.h.

#include "predicates/touch.h"

#include <gtest/gtest.h>

#include "cases.h"
#include "oracle.h"
#include "touch_truth.h"

namespace dsw {
namespace {

/** The triangle and the segment as they are. */
template <int D>
bool have_common_point(const double* const* t, const double* a, const double* b) {
  const TouchTruth truth = touch_truth<D>(t[0], t[1], {t[2]}, {a, b});
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
template <int D>
class Draw {
 public:
  explicit Draw(uint64_t seed) : random_(seed) {}

  const double* const* next(bool small_lattice) {
    if (small_lattice) {
      for (auto& x : s_.x) {
        for (double& each : x) each = random_.between(-2, 2);
      }
      if (random_.below(2) == 0) flatten(random_.below(D));
      if (D == 3 && random_.below(4) == 0) flatten(random_.below(D));
    } else {
      draw(random_, 8, s_);
    }
    if (random_.below(4) == 0) std::copy_n(s_.x[random_.below(5)], D, s_.x[random_.below(5)]);
    return s_.at;
  }
  int below(int n) { return random_.below(n); }

 private:
  void flatten(int axis) {
    for (auto& x : s_.x) x[axis] = 1;
  }
  Random random_;
  PointSet<D> s_;
};

template <int D>
class TouchTest : public testing::TestWithParam<bool> {
 protected:
  const int cases_ = static_cast<int>(case_count() / 20);
  Draw<D> draw_{GetParam() ? 3u : 5u};
  Seen seen_;

  /** Cases with p = p' are used only if what stands still is asked. */
  template <class Check>
  void for_all(Check each, bool moving = true) {
    for (int i = 0; i < cases_; ++i) {
      SCOPED_TRACE(i);
      const double* const* const x = draw_.next(GetParam());
      if (moving && std::equal(x[0], x[0] + D, x[1])) continue;
      each(x);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(seen_.touches, cases_ / 34);
  }
  void a_vertex_touches_a_segment() {
    for_all([&](const double* const* x) {
      const double* const b = draw_.below(4) == 0 ? x[3] : x[4];
      check(path_touch<D>(x[0], x[1], x[3], b).time, touch_truth<D>(x[0], x[1], {}, {x[3], b}), seen_);
    });
  }
  void segments_have_a_common_point_or_not() {
    for_all(
        [&](const double* const* x) {
          const double* const line[3] = {x[0], x[1], x[1]};
          const bool touches = segments_touch<D>(x[0], x[1], x[3], x[4]);
          ASSERT_EQ(touches, have_common_point<D>(line, x[3], x[4]));
          seen_.touches += touches ? 1 : 0;
        },
        false);
  }
};
const auto name_of = [](const testing::TestParamInfo<bool>& i) { return i.param ? "SmallLattice" : "AllFamilies"; };

class SpaceTouchTest : public TouchTest<3> {};
INSTANTIATE_TEST_SUITE_P(All, SpaceTouchTest, testing::Bool(), name_of);

TEST_P(SpaceTouchTest, AVertexTouchesATriangleAtItsTime) {
  for_all([&](const double* const* x) {
    check(vertex_touch(x[0], x[1], x + 2), touch_truth<3>(x[0], x[1], {}, {x[2], x[3], x[4]}), seen_);
  });
}

TEST_P(SpaceTouchTest, AVertexTouchesASegmentAtItsTime) { a_vertex_touches_a_segment(); }

TEST_P(SpaceTouchTest, AnEdgeTouchesASegmentAtItsTime) {
  for_all([&](const double* const* x) {
    const double* const q = draw_.below(8) == 0 ? x[0] : x[2];
    const double* const b = draw_.below(8) == 0 ? x[3] : x[4];
    check(edge_touch({x[0], x[1], q}, x[3], b).time, touch_truth<3>(x[0], x[1], {q}, {x[3], b}), seen_);
  });
}

TEST_P(SpaceTouchTest, AFaceTouchesAPointAtItsTime) {
  for_all([&](const double* const* x) {
    const double found = solid_touch<3>({x[0], x[1], x[2], x[3]}, x[4]);
    // What lies in one plane is left to the edges.
    const double by_edge =
        std::min(edge_touch({x[0], x[1], x[2]}, x[4], x[4]).time, edge_touch({x[0], x[1], x[3]}, x[4], x[4]).time);
    check(std::min(found, by_edge), touch_truth<3>(x[0], x[1], {x[2], x[3]}, {x[4]}), seen_);
  });
}

TEST_P(SpaceTouchTest, ATriangleAndASegmentHaveACommonPointOrNot) {
  for_all(
      [&](const double* const* x) {
        const bool touches = triangle_touches(x, x[3], x[4]);
        ASSERT_EQ(touches, have_common_point<3>(x, x[3], x[4]));
        seen_.touches += touches ? 1 : 0;
      },
      false);
}

TEST_P(SpaceTouchTest, SegmentsHaveACommonPointOrNot) { segments_have_a_common_point_or_not(); }

class PlaneTouchTest : public TouchTest<2> {};
INSTANTIATE_TEST_SUITE_P(All, PlaneTouchTest, testing::Bool(), name_of);

TEST_P(PlaneTouchTest, AVertexTouchesASegmentAtItsTime) { a_vertex_touches_a_segment(); }

TEST_P(PlaneTouchTest, AnEdgeTouchesAPointAtItsTime) {
  for_all([&](const double* const* x) {
    const double found = solid_touch<2>({x[0], x[1], x[2]}, x[3]);
    // What lies in one line is left to the path.
    check(std::min(found, path_touch<2>(x[0], x[1], x[3], x[3]).time), touch_truth<2>(x[0], x[1], {x[2]}, {x[3]}),
          seen_);
  });
}

TEST_P(PlaneTouchTest, AnEdgeFirstTouchesASegmentWithAVertexOfEither) {
  for_all([&](const double* const* x) {
    const EdgeMotion m{x[0], x[1], x[2]};
    const double found =
        std::min({path_touch<2>(m.p, m.to, x[3], x[4]).time, solid_touch<2>(m, x[3]), solid_touch<2>(m, x[4])});
    check(found, touch_truth<2>(x[0], x[1], {x[2]}, {x[3], x[4]}), seen_);
  });
}

TEST_P(PlaneTouchTest, SegmentsHaveACommonPointOrNot) { segments_have_a_common_point_or_not(); }

}  // namespace
}  // namespace dsw
