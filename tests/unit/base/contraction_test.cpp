// No compiler may fuse a product and a sum into one operation that rounds once: signs would depend on it.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/processor.h"
#include "contraction_probe.h"

namespace {

/** Whether code with fused instructions runs here. */
bool has_fused() {
#if defined(__x86_64__)
  return dsw::has_avx2_and_fma();
#else
  return true;  // or there are none
#endif
}

TEST(Contraction, EveryProductIsRounded) {
  if (!has_fused()) GTEST_SKIP() << "this processor, or DARTSWEEP_KERNEL, has no fused instructions";
  // The exact product, 1 - 2^-60, is rounded to 1.
  const double a = 1 + 0x1p-30, b = 1 - 0x1p-30;
  ASSERT_EQ(std::fma(a, b, -1), -0x1p-60);
  EXPECT_EQ(contraction::product_plus(a, b, -1), 0);
  EXPECT_EQ(contraction::product_minus(a, b, 1), 0);
  EXPECT_EQ(contraction::minus_product(a, b, 1), 0);
  const double u[2] = {a, a}, v[2] = {b, -b};
  EXPECT_EQ(contraction::dot(u, v), 0);
  const std::vector<double> as(37, a), bs(37, b);
  std::vector<double> sums(37, -1);
  contraction::add_products(as.data(), bs.data(), sums.data(), sums.size());
  EXPECT_EQ(sums, std::vector<double>(37, 0));
}

}  // namespace
