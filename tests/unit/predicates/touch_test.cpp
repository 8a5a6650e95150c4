// Touches of closed simplices against all corners, over GMP, of the set of points that what is swept and what stays have in common.

#include "predicates/touch.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "cases.h"
#include "oracle.h"

namespace dsw {
namespace {

struct Truth {
  bool touches = false, at_start = false;
  mpq_class time;
};

/** The one solution of sum x_i column_i = (0, 0, 0, 1, 1) over the columns of `chosen`, if there is one and only one. */
bool solve(const std::vector<std::array<mpq_class, 5>>& columns, unsigned chosen, std::vector<mpq_class>& x) {
  std::vector<size_t> names;
  for (size_t i = 0; i < columns.size(); ++i) {
    if ((chosen >> i & 1u) != 0) names.push_back(i);
  }
  std::vector<std::vector<mpq_class>> rows(5, std::vector<mpq_class>(names.size() + 1));
  for (size_t r = 0; r < 5; ++r) {
    for (size_t c = 0; c < names.size(); ++c) rows[r][c] = columns[names[c]][r];
    rows[r][names.size()] = r >= 3 ? 1 : 0;
  }
  for (size_t c = 0; c < names.size(); ++c) {
    size_t pivot = c;
    while (pivot < 5 && sgn(rows[pivot][c]) == 0) ++pivot;
    if (pivot == 5) return false;
    std::swap(rows[c], rows[pivot]);
    for (size_t r = 0; r < 5; ++r) {
      if (r == c || sgn(rows[r][c]) == 0) continue;
      const mpq_class factor = rows[r][c] / rows[c][c];
      for (size_t k = c; k <= names.size(); ++k) rows[r][k] -= factor * rows[c][k];
    }
  }
  for (size_t r = names.size(); r < 5; ++r) {
    if (sgn(rows[r][names.size()]) != 0) return false;
  }
  x.assign(columns.size(), 0);
  for (size_t c = 0; c < names.size(); ++c) x[names[c]] = rows[c][names.size()] / rows[c][c];
  return true;
}

/** When conv(p(t), others) first meets conv(still): of a p + b p' + ... = ..., where a p + b p' is (a + b) p(b / (a + b)). */
Truth truth_of(const double* p, const double* to, const std::vector<const double*>& others,
               const std::vector<const double*>& still) {
  std::vector<std::array<mpq_class, 5>> columns;
  const auto add = [&](const double* x, bool moving) {
    std::array<mpq_class, 5> column;
    for (size_t k = 0; k < 3; ++k) column[k] = moving ? oracle::integer(x[k]) : -oracle::integer(x[k]);
    column[moving ? 3 : 4] = 1;
    columns.push_back(column);
  };
  add(p, true);
  add(to, true);
  for (const double* x : others) add(x, true);
  for (const double* x : still) add(x, false);
  Truth truth;
  std::vector<mpq_class> x;
  for (unsigned chosen = 1; chosen < 1u << columns.size(); ++chosen) {
    if (!solve(columns, chosen, x)) continue;
    bool inside = true;
    for (const mpq_class& each : x) inside = inside && sgn(each) >= 0;
    if (!inside) continue;
    truth.at_start = truth.at_start || sgn(x[1]) == 0;
    if (sgn(x[1]) == 0) continue;
    const mpq_class time = x[1] / (x[0] + x[1]);
    if (!truth.touches || time < truth.time) truth.time = time;
    truth.touches = true;
  }
  return truth;
}

/** The triangle and the segment as they are. */
bool have_common_point(const double* const* t, const double* a, const double* b) {
  const Truth truth = truth_of(t[0], t[1], {t[2]}, {a, b});
  return truth.touches || truth.at_start;
}

struct Seen {
  int cases = 0, touches = 0, starts = 0;
};

void check(double found, const Truth& truth, Seen& seen) {
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
  static constexpr int kCases = 5000;
  Draw draw_{GetParam() ? 3u : 5u};
  Seen seen_;

  template <class Check>
  void for_all(Check each) {
    for (int i = 0; i < kCases; ++i) {
      SCOPED_TRACE(i);
      each(draw_.next(GetParam()));
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(seen_.touches, 150);
  }
};
INSTANTIATE_TEST_SUITE_P(All, TouchTest, testing::Bool(),
                         [](const auto& i) { return i.param ? "SmallLattice" : "AllFamilies"; });

TEST_P(TouchTest, AVertexTouchesATriangleAtItsTime) {
  for_all([&](const double* const* x) {
    if (std::equal(x[0], x[0] + 3, x[1])) return;
    check(vertex_touch(x[0], x[1], x + 2), truth_of(x[0], x[1], {}, {x[2], x[3], x[4]}), seen_);
  });
}

TEST_P(TouchTest, AnEdgeTouchesASegmentAtItsTime) {
  for_all([&](const double* const* x) {
    if (std::equal(x[0], x[0] + 3, x[1])) return;
    const double* const q = draw_.below(8) == 0 ? x[0] : x[2];
    const double* const b = draw_.below(8) == 0 ? x[3] : x[4];
    check(edge_touch({x[0], x[1], q}, x[3], b).time, truth_of(x[0], x[1], {q}, {x[3], b}), seen_);
  });
}

TEST_P(TouchTest, AFaceTouchesAPointAtItsTime) {
  for_all([&](const double* const* x) {
    if (std::equal(x[0], x[0] + 3, x[1])) return;
    const double found = face_touch({x[0], x[1], x[2], x[3]}, x[4]);
    // What lies in one plane is left to the edges.
    const double by_edge =
        std::min(edge_touch({x[0], x[1], x[2]}, x[4], x[4]).time, edge_touch({x[0], x[1], x[3]}, x[4], x[4]).time);
    check(std::min(found, by_edge), truth_of(x[0], x[1], {x[2], x[3]}, {x[4]}), seen_);
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
