#include "base/points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace dsw;

TEST(Points, EveryPlaceOfANonFiniteValueIsFound) {
  constexpr double kInf = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
  for (const size_t step : {size_t{3}, size_t{5}}) {
    for (size_t count = 1; count < 12; ++count) {
      std::vector<double> values(count * step, std::numeric_limits<double>::max());
      const PointArray points{values.data(), step};
      EXPECT_EQ(find_non_finite(points, count, 3), count);
      for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < 3; ++k) {
          for (const double bad : {kInf, -kInf, kNan}) {
            values[i * step + k] = bad;
            EXPECT_EQ(find_non_finite(points, count, 3), i);
            values[i * step + k] = -0.0;
          }
        }
      }
      if (step == 5) {
        values[3] = kNan;  // between points: not theirs
        EXPECT_EQ(find_non_finite(points, count, 3), count);
      }
    }
  }
}

TEST(Points, TheMessageNamesArgumentPositionAndValue) {
  const double values[6] = {0, 0, 0, 0, -std::numeric_limits<double>::infinity(), std::nan("")};
  try {
    check_finite({values, 3}, 2, 3, {"targets", true});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), DSW_STATUS_NON_FINITE);
    EXPECT_EQ(std::string(error.what()), "targets[1][1] is -inf, must be finite");
  }
  EXPECT_EQ(std::string(ElementName({"target", false}, 4).text), "target");
}

}  // namespace
