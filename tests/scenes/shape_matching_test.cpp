// The physics of the benchmark's hexahedra: rotations by Jacobi rotations, equation 1 of [JCD10], bodies that fly.
#include "scenes/shape_matching.h"

#include "scenes/random_turns.h"
#include "scenes/soft_hexahedra.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dsw::scenes {
namespace {

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

Matrix transposed(const Matrix& a) {
  Matrix c{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) c[i][j] = a[j][i];
  }
  return c;
}

double determinant(const Matrix& a) {
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

double distance(const Matrix& a, const Matrix& b) {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) most = std::fmax(most, std::fabs(a[i][j] - b[i][j]));
  }
  return most;
}

void expect_rotation(const Matrix& r) {
  EXPECT_LT(distance(product(r, transposed(r)), kIdentity), 1e-12);
  EXPECT_GT(determinant(r), 0.5);
}

/** V diag(stretches) V^T for a random frame V. */
Matrix symmetric(Random& random, const std::array<double, 3>& stretches) {
  const Matrix frame = random_frame(random);
  Matrix scaled = frame;
  for (std::size_t i = 0; i < 3; ++i) {
    for (double& value : scaled[i]) value *= stretches[i];
  }
  return product(transposed(frame), scaled);
}

TEST(ShapeMatching, TheRotationOfAStretchedShapeIsFound) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Matrix turn = random_frame(random);
    const Matrix stretch = symmetric(random, {random.uniform(0.1, 3), random.uniform(0.1, 3), random.uniform(0.1, 3)});
    const Matrix found = nearest_rotation(product(turn, stretch), kIdentity);
    expect_rotation(found);
    EXPECT_LT(distance(found, turn), 1e-9);
  }
}

TEST(ShapeMatching, AShapeTurnedInsideOutOrFlatGivesARotationAllTheSame) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const Matrix turn = random_frame(random);
    expect_rotation(nearest_rotation(product(turn, symmetric(random, {2, 1, -0.5})), kIdentity));
    expect_rotation(nearest_rotation(product(turn, symmetric(random, {2, 1, 0})), kIdentity));
  }
  const Matrix last = random_frame(random);
  EXPECT_EQ(nearest_rotation(Matrix{}, last), last);
}

TEST(ShapeMatching, GoalsAreTheTurnedShapeAndKeepTheWeightedCentre) {
  Random random(7);
  std::vector<double> rest, weights;
  for (int i = 0; i < 8; ++i) {
    rest.insert(rest.end(), {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    weights.push_back(random.uniform(0.1, 2));
  }
  const RestShape shape(rest, weights);
  const Matrix turn = random_frame(random);
  std::vector<double> at(rest.size()), goals(rest.size());
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const double* const point = &rest[i - i % 3];
    at[i] = turn[i % 3][0] * point[0] + turn[i % 3][1] * point[1] + turn[i % 3][2] * point[2] + 5;
  }
  Matrix rotation = kIdentity;
  shape.find_goals(at.data(), rotation, goals.data());
  EXPECT_LT(distance(rotation, turn), 1e-12);
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(goals[i], at[i], 1e-12);

  at[0] += 0.5;  // deformed: goals differ, their weighted centre does not
  shape.find_goals(at.data(), rotation, goals.data());
  double moved = 0;
  for (std::size_t i = 0; i < 8; ++i) moved += weights[i] * (goals[3 * i] - at[3 * i]);
  EXPECT_NEAR(moved, 0, 1e-12);
  EXPECT_GT(std::fabs(goals[0] - at[0]), 0.01);
}

TEST(SoftHexahedra, BodiesThatMeetNothingKeepTheirMomentumAndTheirShape) {
  HexGridOptions lattice;
  lattice.size = {30, 30, 30};
  SoftHexahedra bodies(make_hex_grid(lattice), {});
  ASSERT_EQ(bodies.body_count(), 225u);
  const auto mean = [&bodies] {
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < bodies.positions().size(); ++i) {
      sum[i % 3] += bodies.positions()[i] / static_cast<double>(bodies.positions().size() / 3);
    }
    return sum;
  };
  std::vector<std::array<double, 3>> centres = {mean()};
  for (int step = 0; step < 100; ++step) {
    bodies.reach(std::vector<double>(bodies.aim()));
    centres.push_back(mean());
    EXPECT_LT(bodies.deformation(), 0.5);
  }
  EXPECT_GT(bodies.deformation(), 0.01);  // the impulse deforms them
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(centres[100][k] - centres[99][k], centres[1][k] - centres[0][k], 1e-12);
  }
}

TEST(SoftHexahedra, AContactTurnsTheTouchingPointRound) {
  HexGridOptions lattice;
  lattice.size = {30, 30, 30};
  SoftHexahedra bodies(make_hex_grid(lattice), {});
  const std::vector<double> before = bodies.positions();
  std::vector<double> way = bodies.aim();
  double size = 0;
  std::array<double, 3> normal{};
  for (std::size_t k = 0; k < 3; ++k) {
    way[k] -= before[k];
    size += way[k] * way[k];
  }
  for (std::size_t k = 0; k < 3; ++k) normal[k] = -way[k] / std::sqrt(size);
  const double speed = bodies.speed();
  bodies.bounce(0, 0, 0.0, normal.data());
  EXPECT_NEAR(bodies.speed(), speed, 1e-12);  // reflected, nothing lost
  bodies.reach(before);
  const std::vector<double>& after = bodies.aim();
  double along = 0;
  for (std::size_t k = 0; k < 3; ++k) along += (after[k] - before[k]) * normal[k];
  EXPECT_GT(along, 0);
}

}  // namespace
}  // namespace dsw::scenes
