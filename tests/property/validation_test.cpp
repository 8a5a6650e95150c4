// The exact validation's claims against brute force with GMP: who is met, and first where; and in which cell a point
// is.

#include "swept_cases.h"

#include "cross_check/validation.h"
#include "locate/locate.h"

namespace dsw::swept {
namespace {

/// When the edge from p to q first meets a line while p goes to p', by GMP; `points` are p, p', q. 2: never.
double first_time(const Environment<3>& env, SweptTruth& truth, const double* const* points) {
  const Line* first = nullptr;
  for (const Line& line : truth.lines) {
    if (!truth.line_pierces(0, 1, 2, line)) continue;
    if (first == nullptr || compare(truth.edge_moment(line), truth.edge_moment(*first)) < 0) first = &line;
  }
  if (first == nullptr) return 2;
  const SweepEvent event{{points[2], env.point((*first)[0]), env.point((*first)[1])}, EventKind::kEdge};
  return event_time<3>(points[0], points[1], event);
}

struct Seen {
  int segments = 0, triangles = 0, inside = 0;
};

void check(const Environment<3>& env, SweptTruth& truth, const Vec (&x)[4], Seen& seen) {
  const double* const at[3] = {x[0].data(), x[1].data(), x[2].data()};
  truth.load(at, 3);
  Validator validator(env);
  validator.add(0, at[0], at[1]);
  validator.add(1, at[0], at[1], at[2]);
  validator.run();
  const bool is_blocked = std::any_of(truth.triangles.begin(), truth.triangles.end(),
                                      [&](const auto& triangle) { return truth.segment_pierces(0, 1, triangle); });
  ASSERT_EQ(validator.claims()[0].is_met, x[0] != x[1] && is_blocked);
  const double time = first_time(env, truth, at);
  ASSERT_EQ(validator.claims()[1].is_met, time <= 1);
  ASSERT_EQ(validator.claims()[1].time, time);
  seen.segments += is_blocked ? 1 : 0;
  seen.triangles += time <= 1 ? 1 : 0;
  const Cell home = locate(env, at[0], Cell{}, nullptr).cell;
  if (!home.valid()) return;
  for_each_cell(env.map, [&](Cell c) { ASSERT_EQ(exactly_contains(env, c, at[0]), c == home); });
  ++seen.inside;
}

TEST(ValidationTest, ClaimsAreTrueWhereExactArithmeticSaysSo) {
  Seen seen;
  for_each_ground(std::vector<Shares>(2, {0.05, 0.1, 0.05, 0}), [&](Ground& ground) {
    if (ground.env.map.cell_count > 2000) return;
    ground.draw(60, [&](const Vec(&x)[4], bool) { check(ground.env, ground.truth, x, seen); });
  });
  EXPECT_GT(seen.segments, effort_of(100));
  EXPECT_GT(seen.triangles, effort_of(100));
  EXPECT_GT(seen.inside, effort_of(400));
}

}  // namespace
}  // namespace dsw::swept
