#include "springs.h"

#include <gtest/gtest.h>
#include <Eigen/SparseCore>

#include "random_line.h"

namespace physics {
namespace {

Springs rod_through(const Positions& line) { return make_rod(line, 3, 0.7); }

TEST(Springs, ForcesAreTheSlopeOfTheEnergy) {
  Positions at = random_line(6, 1);
  const Springs springs = rod_through(random_line(6, 2));
  Positions force(at.size(), Vector3::Zero());
  springs.add_forces(at, &force);
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const double here = at[i][k], h = 1e-5;
      at[i][k] = here + h;
      const double above = springs.energy(at);
      at[i][k] = here - h;
      const double below = springs.energy(at);
      at[i][k] = here;
      EXPECT_NEAR(force[i][k], (below - above) / (2 * h), 1e-7);
    }
  }
}

// A leg of no length has no direction, but its torque is finite, and still the slope of the energy.
TEST(Springs, ALegThatIsPressedTogetherTurnsSoftly) {
  Positions at = {{0, 0, 0}, {1e-9, 2e-9, 0}, {0, 1, 0}};
  Springs springs = make_rod({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 3, 0.7);
  springs.distances.clear();
  Positions force(at.size(), Vector3::Zero());
  springs.add_forces(at, &force);
  for (std::size_t i = 0; i < at.size(); ++i) {
    EXPECT_LT(force[i].norm(), 20);
    for (int k = 0; k < 3; ++k) {
      const double here = at[i][k], h = 1e-6;
      at[i][k] = here + h;
      const double above = springs.energy(at);
      at[i][k] = here - h;
      const double below = springs.energy(at);
      at[i][k] = here;
      EXPECT_NEAR(force[i][k], (below - above) / (2 * h), 1e-6);
    }
  }
}

TEST(Springs, InternalForcesHaveNeitherSumNorTorque) {
  const Positions at = random_line(9, 3);
  Positions force(at.size(), Vector3::Zero());
  rod_through(random_line(9, 4)).add_forces(at, &force);
  Vector3 sum = Vector3::Zero(), torque = Vector3::Zero();
  double largest = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    sum += force[i];
    torque += at[i].cross(force[i]);
    largest = std::max(largest, force[i].norm());
  }
  EXPECT_GT(largest, 0.1);
  EXPECT_LT(sum.norm(), 1e-13 * largest);
  EXPECT_LT(torque.norm(), 1e-12 * largest);
}

TEST(Springs, TheStiffnessMatrixIsSymmetricAndNeverIndefinite) {
  const Positions at = random_line(5, 5);
  std::vector<Eigen::Triplet<double>> entries;
  rod_through(random_line(5, 6)).add_stiffness(at, 1, &entries);
  Eigen::SparseMatrix<double> sparse(15, 15);
  sparse.setFromTriplets(entries.begin(), entries.end());
  const Eigen::MatrixXd matrix(sparse);
  EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-13 * matrix.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues()[0], -1e-12 * matrix.norm());
}

TEST(Springs, AtRestTheStiffnessMatrixIsTheSecondDerivative) {
  const Positions at = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3.5, 0, 0}};
  const Springs springs = rod_through(at);
  std::vector<Eigen::Triplet<double>> entries;
  springs.add_stiffness(at, 1, &entries);
  Eigen::SparseMatrix<double> matrix(12, 12);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const double h = 1e-6;
  for (int column = 0; column < 12; ++column) {
    Positions there = at, force(4, Vector3::Zero());
    there[static_cast<std::size_t>(column / 3)][column % 3] += h;
    springs.add_forces(there, &force);
    for (int row = 0; row < 12; ++row) {
      EXPECT_NEAR(matrix.coeff(row, column), -force[static_cast<std::size_t>(row / 3)][row % 3] / h, 2e-5);
    }
  }
}

TEST(Springs, ASplitSpringIsAsStiffAsBefore) {
  const Positions line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  Springs springs = rod_through(line);
  springs.split(1, 0, 3, 0.25);  // given from b to a
  ASSERT_EQ(springs.distances.size(), 3u);
  ASSERT_EQ(springs.angles.size(), 2u);
  // Stretched by a tenth as a whole: each part takes its share, and the force is the same everywhere.
  const Positions at = {{-0.1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1 - 0.25 * 1.1, 0, 0}};
  Positions force(4, Vector3::Zero());
  springs.add_forces(at, &force);
  EXPECT_NEAR(force[0].x(), 0.1 * 3, 1e-14);
  EXPECT_LT(force[3].norm(), 1e-14);
  EXPECT_NEAR(springs.energy(at), 0.5 * 3 * 0.01, 1e-15);
}

TEST(Springs, MergingUndoesSplits) {
  const Positions line = random_line(5, 7);
  Springs springs = rod_through(line);
  const Springs before = springs;
  springs.split(1, 2, 5, 0.3);
  springs.split(5, 2, 6, 0.5);
  springs.split(2, 3, 7, 0.9);
  std::size_t a = 0, b = 0;
  double share = 0;
  EXPECT_TRUE(springs.merge(5, &a, &b, &share));
  EXPECT_TRUE(springs.merge(7, &a, &b, &share));
  EXPECT_TRUE(springs.merge(6, &a, &b, &share));
  EXPECT_EQ(std::min(a, b), 1u);
  EXPECT_EQ(std::max(a, b), 2u);
  ASSERT_EQ(springs.distances.size(), before.distances.size());
  ASSERT_EQ(springs.angles.size(), before.angles.size());
  const Positions elsewhere = random_line(5, 8);
  EXPECT_NEAR(springs.energy(elsewhere), before.energy(elsewhere), 1e-12);
}

}  // namespace
}  // namespace physics
