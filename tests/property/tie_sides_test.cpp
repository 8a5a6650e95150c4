// A cell that a tie does not meet, with nothing but vertices that stand for crossings, stays on its side: in the plane,
// and with everything drawn out to prisms in space.
#include "support.h"

namespace dsw::oracle {
namespace {

struct Sheet {
  std::vector<std::array<double, 2>> points;
  std::vector<std::array<int32_t, 3>> triangles;
};

EnvironmentPtr make_environment(const Sheet& sheet, uint32_t dimension) {
  const bool space = dimension == 3;
  std::vector<double> points;
  std::vector<int32_t> corners;
  for (int layer = 0; layer < (space ? 2 : 1); ++layer) {
    for (const auto& p : sheet.points) {
      points.insert(points.end(), p.begin(), p.end());
      if (space) points.push_back(layer);
    }
  }
  for (const auto& triangle : sheet.triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
    for (const int32_t v : triangle) {
      if (space) corners.push_back(v + static_cast<int32_t>(sheet.points.size()));
    }
  }
  dsw_environment_desc desc =
      uniform_desc(dimension, space ? DSW_CELL_TYPE_WEDGE : DSW_CELL_TYPE_TRIANGLE, space ? 6 : 3, points, corners);
  desc.flags = DSW_ENVIRONMENT_REORIENT;
  return create_from(desc);
}

int32_t outcome(const EnvironmentPtr& environment, const double* from, const double* to) {
  dsw_flight flight;
  EXPECT_EQ(dsw_environment_cast(environment.get(), {0, 0}, from, to, nullptr, &flight), DSW_STATUS_OK);
  return static_cast<int32_t>(flight.outcome);
}

/// The dimension, and which way round the tie is.
class TieSidesOf : public testing::TestWithParam<std::tuple<uint32_t, bool>> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, TieSidesOf, testing::Combine(testing::Values(2, 3), testing::Bool()));

/// The tie is x = 0. It crosses edges from 1 and 4 near 2, 3 and 5, which are on one side of it with the last two
/// triangles.
TEST_P(TieSidesOf, WhatIsNotMetStays) {
  const auto [dimension, turned] = GetParam();
  const Sheet sheet{{{-4, 0}, {-2, 1}, {0.1, 2}, {0.1, 0}, {-2, -1}, {0.4, -1}, {2, 1}},
                    {{0, 4, 1}, {1, 3, 2}, {1, 4, 3}, {4, 5, 3}, {2, 3, 5}, {2, 5, 6}}};
  const EnvironmentPtr environment = make_environment(sheet, dimension);
  ASSERT_NE(environment, nullptr);
  const double end = turned ? 9 : -9, from[3] = {0.2, 0.4, 0.5}, to[3] = {-3, 0, 0.5};
  const double line[] = {0, -end, 0, end}, loop[] = {0, -9, end, 0, -9, -end, 0, 9, -end, 0, 9, end};
  dsw_tie_desc desc = defaults(dsw_tie_desc_init);
  desc.points = dimension == 2 ? line : loop;
  desc.point_count = dimension == 2 ? 2 : 4;
  desc.snap = 0.25;
  EXPECT_EQ(outcome(environment, from, to), DSW_OUTCOME_REACHED);
  dsw_change report = empty_change();
  ASSERT_EQ(dsw_environment_tie(environment.get(), &desc, &report), DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(report.is_closed, 1u);
  EXPECT_EQ(report.volumes_crossed, 3u);
  EXPECT_EQ(report.volumes_split + report.whole_count, 0u);
  EXPECT_EQ(report.face_count, 2u);
  EXPECT_EQ(outcome(environment, from, to), DSW_OUTCOME_CONTACT);
}

/// The line comes by below 0 and 1, which are behind it, and then close beside them, where they are before it.
TEST(TieSides, ALineThatCrossesItself) {
  const Sheet sheet{{{-1, 0}, {1, 0}, {0, 1}, {0.5, -1}, {-0.8, -1}, {-4, 0}, {4, 0}, {0, -3}},
                    {{0, 1, 2}, {0, 3, 1}, {0, 4, 3}, {0, 5, 4}, {1, 3, 6}, {2, 5, 0}, {2, 1, 6}, {4, 7, 3}}};
  const EnvironmentPtr environment = make_environment(sheet, 2);
  ASSERT_NE(environment, nullptr);
  const double line[] = {-9, -0.5, 9, -0.5, 9, 9, 1.2, 9, 1.2, -9, -1.2, -9, -1.2, 9};
  dsw_tie_desc desc = defaults(dsw_tie_desc_init);
  desc.points = line;
  desc.point_count = std::size(line) / 2;
  desc.snap = 0.25;
  const double from[] = {-0.2, 0.3}, to[] = {-0.2, -1.5};
  EXPECT_EQ(outcome(environment, from, to), DSW_OUTCOME_REACHED);
  ASSERT_EQ(dsw_environment_tie(environment.get(), &desc, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(outcome(environment, from, to), DSW_OUTCOME_CONTACT);
}

}  // namespace
}  // namespace dsw::oracle
