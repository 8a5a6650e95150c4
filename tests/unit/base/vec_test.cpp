// Vectors and Eigen add and multiply in the order that results have always had, whatever the version of Eigen and the processor.
#include "base/vec.h"

#include "base/eigen.h"

#include "../../effort.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace {

using namespace dsw;

testing::AssertionResult same_bits(const double* a, const double* b, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (std::memcmp(a + i, b + i, sizeof *a) != 0)
      return testing::AssertionFailure() << i << ": " << a[i] << ", " << b[i];
  }
  return testing::AssertionSuccess();
}

TEST(Vec, IsZeroUnlessItIsGivenNumbers) {
  const Vec a, b[2] = {};
  EXPECT_TRUE(is_zero(a) && is_zero(b[1]) && is_zero(Vec{}));
  EXPECT_FALSE(is_zero({0, -5e-324, 0}));
}

TEST(Vec, HasTheBitsOfWrittenOutSums) {
  std::mt19937_64 random(seed_of(1));
  std::uniform_real_distribution<double> number(-3, 3);
  for (int i = 0; i < at_least(10000); ++i) {
    double a[3], b[3];
    for (int k = 0; k < 3; ++k) a[k] = number(random), b[k] = number(random);
    const double products[] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const Vec cross = to_vec<3>(a).cross(to_vec<3>(b));
    ASSERT_TRUE(same_bits(cross.data(), products, 3));
    const double sum = (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2], dotted = dot(to_vec<3>(a), to_vec<3>(b));
    ASSERT_TRUE(same_bits(&dotted, &sum, 1));
    const double largest = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
    double c[3], size = 0;
    for (int k = 0; k < 3; ++k) size += a[k] / largest * (a[k] / largest);
    for (int k = 0; k < 3; ++k) c[k] = a[k] / largest / std::sqrt(size);
    ASSERT_TRUE(same_bits(unit(to_vec<3>(a)).data(), c, 3));
  }
}

TEST(Quaternion, IsDividedByALengthThatIsSummedInPairs) {
  std::mt19937_64 random(seed_of(2));
  std::uniform_real_distribution<double> number(-3, 3);
  for (int i = 0; i < at_least(10000); ++i) {
    double q[4];
    for (double& each : q) each = number(random);
    Eigen::Quaterniond quaternion(q);  // x y z w
    quaternion.normalize();
    const double size = std::sqrt((q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]));
    for (double& each : q) each /= size;
    ASSERT_TRUE(same_bits(quaternion.coeffs().data(), q, 4));
  }
}

}  // namespace
