// Lines against facets: what is certain is exact, and the same for every instruction set.

#include "corridor/facet_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/compiler.h"

#include "../../effort.h"

namespace {

using namespace dsw;

TEST(FacetPass, IsExactAndTheSameForAllInstructionSets) {
#if DSW_X86_64
  const bool has_lanes = DSW_CPU_HAS("avx2");
#endif
  std::mt19937 random(static_cast<uint32_t>(seed_of(11)));
  int passed = 0, tied = 0;
  for (int i = 0; i < at_least(200000); ++i) {
    // Few places, so that lines meet ridges; many; or coordinates that no filter knows.
    const int kind = static_cast<int>(random() % 4), exponent = kind == 3 ? static_cast<int>(random() % 1400) - 700 : 0;
    const auto coordinate = [&] {
      const double x = kind == 0 ? static_cast<double>(random() % 3) - 1 : static_cast<double>(random()) * 0x1p-31 - 1;
      return std::ldexp(x, exponent);
    };
    double at[4][3], line[2][3];
    for (int k = 0; k < 4; ++k) {
      at[k][0] = coordinate() + std::ldexp(k == 1 || k == 2 ? 1 : -1, exponent);
      at[k][1] = coordinate() + std::ldexp(k < 2 ? -1 : 1, exponent);
      at[k][2] = coordinate();
    }
    for (int k = 0; k < 2; ++k) {
      for (int axis = 0; axis < 2; ++axis) line[k][axis] = coordinate();
      line[k][2] = coordinate() + std::ldexp(k == 0 ? -2 : 2, exponent);
    }
    const bool triangle = random() % 2 == 0;
    const double* const corners[4] = {at[0], at[1], at[2], triangle ? at[2] : at[3]};
    const bool passes = passes_facet(corners, line[0], line[1]);
#if DSW_X86_64
    if (has_lanes) {
      ASSERT_EQ(passes_facet_avx2(corners, line[0], line[1]), passes) << i;
    }
#endif
    bool all = true, tie = false;
    for (int k = 0; k < (triangle ? 3 : 4); ++k) {
      const double* const ridge[2] = {corners[k], corners[triangle ? (k + 1) % 3 : (k + 1) % 4]};
      const ShiftedSign sign = exact::line_side<3>(line[0], line[1], ridge);
      all = all && sign.sign > 0;
      tie = tie || sign.tie;
    }
    ASSERT_TRUE(!passes || (all && !tie)) << i;
    passed += passes ? 1 : 0;
    tied += all && tie ? 1 : 0;
    ASSERT_TRUE(kind != 1 || passes == all) << i << " is far from a tie";
  }
  EXPECT_GT(passed, 10000);
  EXPECT_GT(tied, 100);
}

TEST(FacetPass, KeepsWhereAllLinesPass) {
#if DSW_X86_64
  const bool has_lanes = DSW_CPU_HAS("avx2");
#endif
  std::mt19937 random(static_cast<uint32_t>(seed_of(12)));
  int kept = 0, missed = 0, by_last = 0;
  for (int i = 0; i < at_least(200000); ++i) {
    const int kind = static_cast<int>(random() % 4), exponent = kind == 3 ? static_cast<int>(random() % 1400) - 700 : 0;
    const auto coordinate = [&] {
      const double x = kind == 0 ? static_cast<double>(random() % 3) - 1 : static_cast<double>(random()) * 0x1p-31 - 1;
      return std::ldexp(x, exponent);
    };
    double at[4][3], ends[4][3];
    for (int k = 0; k < 4; ++k) {
      at[k][0] = coordinate() + std::ldexp(k == 1 || k == 2 ? 2 : -2, exponent);
      at[k][1] = coordinate() + std::ldexp(k < 2 ? -2 : 2, exponent);
      at[k][2] = coordinate() / 4;
    }
    const bool from_first = random() % 2 == 0, triangle = random() % 2 == 0, at_once = random() % 2 == 0;
    for (int k = 0; k < 4; ++k) {  // before and after the move of the first end, then those of the other one
      for (int axis = 0; axis < 2; ++axis) ends[k][axis] = coordinate() / 2;
      ends[k][2] = coordinate() / 4 + std::ldexp((k < 2) == from_first ? -2 : 2, exponent);
    }
    const double* const corners[4] = {at[0], at[1], at[2], triangle ? at[2] : at[3]};
    const EdgeWay way{ends[0], ends[1], ends[2], ends[3], from_first, at_once};
    const bool keeps = keeps_to_facet(corners, way);
#if DSW_X86_64
    if (has_lanes) {
      ASSERT_EQ(keeps_to_facet_avx2(corners, way), keeps) << i;
    }
#endif
    bool all = true, all_but_last = true, tie = false;
    constexpr int kLines[4][2] = {{0, 2}, {1, 2}, {1, 3}, {0, 3}};
    for (int n = 0; n < (at_once ? 4 : 3); ++n) {
      const int(&line)[2] = kLines[n];
      all_but_last = all;
      const double *const from = ends[line[from_first ? 0 : 1]], *const to = ends[line[from_first ? 1 : 0]];
      for (int k = 0; k < (triangle ? 3 : 4); ++k) {
        const double* const ridge[2] = {corners[k], corners[triangle ? (k + 1) % 3 : (k + 1) % 4]};
        const ShiftedSign sign = exact::line_side<3>(from, to, ridge);
        all = all && sign.sign > 0;
        tie = tie || sign.tie;
      }
    }
    ASSERT_TRUE(!keeps || (all && !tie)) << i;
    ASSERT_TRUE(kind != 1 || keeps == all) << i << " is far from a tie";
    by_last += at_once && all_but_last && !all ? 1 : 0;
    kept += keeps ? 1 : 0;
    missed += all ? 0 : 1;
  }
  EXPECT_GT(kept, 10000);
  EXPECT_GT(missed, 10000);
  EXPECT_GT(by_last, 1000);
}

}  // namespace
