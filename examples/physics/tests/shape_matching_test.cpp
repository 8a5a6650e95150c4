#include "shape_matching.h"

#include <gtest/gtest.h>

#include "random_line.h"

namespace physics {
namespace {

using Matrix3 = Eigen::Matrix3d;

Matrix3 random_matrix(std::mt19937* bits) {
  Matrix3 m;
  for (int column = 0; column < 3; ++column) {
    m.col(column) = random_vector(bits);
  }
  return m;
}

Matrix3 random_rotation(std::mt19937* bits) {
  return Eigen::AngleAxisd(3 * random_vector(bits).x(), random_vector(bits).normalized()).toRotationMatrix();
}

void expect_rotation(const Matrix3& r) {
  EXPECT_LT((r * r.transpose() - Matrix3::Identity()).norm(), 1e-13);
  EXPECT_NEAR(r.determinant(), 1, 1e-13);
}

// Whether no rotation is nearer to a than r: neither random ones nor small turns of r.
void expect_nearest(const Matrix3& a, const Matrix3& r, std::mt19937* bits) {
  for (int i = 0; i < 50; ++i) {
    const Matrix3 other = random_rotation(bits);
    EXPECT_GE((other - a).norm(), (r - a).norm() - 1e-8);
    const Matrix3 turn = Eigen::AngleAxisd(1e-2, random_vector(bits).normalized()).toRotationMatrix();
    EXPECT_GE((turn * r - a).norm(), (r - a).norm() - 1e-8);
  }
}

TEST(PolarDecomposition, IsTheNearestRotation) {
  std::mt19937 bits(1);
  for (int i = 0; i < 200; ++i) {
    const Matrix3 a = random_matrix(&bits), r = rotation_of(a, random_rotation(&bits));
    expect_rotation(r);
    expect_nearest(a, r, &bits);
  }
}

// By an eigenvalue solver, which compiles in a second where a second SVD takes half a minute.
TEST(PolarDecomposition, IsAOverItsStretchWhereThereIsNoReflection) {
  std::mt19937 bits(2);
  int seen = 0;
  for (int i = 0; i < 400; ++i) {
    const Matrix3 a = random_matrix(&bits);
    if (a.determinant() < 0.05) {
      continue;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3> squared_stretch(a.transpose() * a);
    const Matrix3 r = rotation_of(a, Matrix3::Identity());
    EXPECT_LT((r - a * squared_stretch.operatorInverseSqrt()).norm(), 1e-6);
    // A = R S: S is symmetric, and no direction is turned over.
    const Matrix3 s = r.transpose() * a;
    EXPECT_LT((s - s.transpose()).norm(), 1e-6);
    ++seen;
  }
  EXPECT_GT(seen, 50);
}

// [JCD10] 7.3, Mueller et al. 2005: Jacobi rotations until A^T A is diagonal, its square root S, and R = A S^-1.
Matrix3 rotation_by_jacobi(const Matrix3& a) {
  Matrix3 squared = a.transpose() * a, axes = Matrix3::Identity();
  for (int sweep = 0; sweep < 10; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        Eigen::JacobiRotation<double> turn;
        turn.makeJacobi(squared, p, q);
        squared.applyOnTheLeft(p, q, turn.adjoint());
        squared.applyOnTheRight(p, q, turn);
        axes.applyOnTheRight(p, q, turn);
      }
    }
  }
  return a * axes * squared.diagonal().cwiseSqrt().cwiseInverse().asDiagonal() * axes.transpose();
}

TEST(PolarDecomposition, IsThatOfJacobiRotationsOfTheSquareWhereThereIsOne) {
  std::mt19937 bits(6);
  int seen = 0;
  for (int i = 0; i < 400; ++i) {
    const Matrix3 a = random_matrix(&bits);
    if (a.determinant() < 0.05) {
      continue;
    }
    EXPECT_LT((rotation_of(a, Matrix3::Identity()) - rotation_by_jacobi(a)).norm(), 1e-7);
    ++seen;
  }
  EXPECT_GT(seen, 50);
  const Matrix3 q = random_rotation(&bits), sheet = q * Vector3(2, 1, 0).asDiagonal();
  EXPECT_FALSE((rotation_by_jacobi(sheet) - q).norm() < 1e-3) << "the square of a sheet has no inverse";
  EXPECT_LT((rotation_of(sheet, Matrix3::Identity()) - q).norm(), 1e-7);
}

TEST(PolarDecomposition, OfAReflectionIsStillARotation) {
  std::mt19937 bits(3);
  for (int i = 0; i < 100; ++i) {
    const Matrix3 q = random_rotation(&bits);
    const Matrix3 mirrored = q * Vector3(3, 2, -1).asDiagonal();
    const Matrix3 r = rotation_of(mirrored, Matrix3::Identity());
    expect_rotation(r);
    EXPECT_LT((r - q).norm(), 1e-7) << "the direction of least stretch is turned over";
  }
  expect_rotation(rotation_of(-Matrix3::Identity(), Matrix3::Identity()));
}

TEST(PolarDecomposition, OfThinShapesKeepsWhatTheyDoNotSay) {
  std::mt19937 bits(4);
  for (int i = 0; i < 100; ++i) {
    const Matrix3 q = random_rotation(&bits);
    // Flat: the third direction follows from two.
    const Matrix3 flat = q * Vector3(2, 1, 0).asDiagonal();
    EXPECT_LT((rotation_of(flat, Matrix3::Identity()) - q).norm(), 1e-7);
    // A line: it goes along, and the spin about itself is the last one's.
    const Matrix3 line = q * Vector3(2, 0, 0).asDiagonal(), r = rotation_of(line, q);
    EXPECT_LT((r - q).norm(), 1e-7);
    const Matrix3 other = rotation_of(line, random_rotation(&bits));
    expect_rotation(other);
    EXPECT_LT((other.col(0) - q.col(0)).norm(), 1e-7);
    // A point: the last one.
    EXPECT_LT((rotation_of(Matrix3::Zero(), q) - q).norm(), 1e-13);
  }
}

Points cube() {
  Points points;
  for (std::size_t i = 0; i < 8; ++i) {
    points.set(i, Vector3(i & 1 ? 1 : 0, i & 2 ? 1 : 0, i & 4 ? 1 : 0), 1);
  }
  return points;
}

TEST(ShapeMatching, AMovedShapeIsWhereItWants) {
  std::mt19937 bits(5);
  const Points rest = cube();
  ShapeMatching shape(rest);
  for (int i = 0; i < 20; ++i) {
    const Matrix3 q = random_rotation(&bits);
    const Vector3 shift = 100 * random_vector(&bits);
    Positions at, goals;
    for (const Vector3& p : rest.position) {
      at.push_back(q * p + shift);
    }
    shape.find_goals(at, &goals);
    for (std::size_t k = 0; k < 8; ++k) {
      EXPECT_LT((goals[k] - at[k]).norm(), 1e-6);
    }
  }
}

TEST(ShapeMatching, GoalsKeepTheMomentumOfTheWeights) {
  const Points rest = cube();
  ShapeMatching shape(rest);
  Positions at = rest.position, goals;
  at[3] += Vector3(0.3, -0.2, 0.1);
  shape.find_goals(at, &goals);
  Vector3 sum = Vector3::Zero(), torque = Vector3::Zero();
  for (std::size_t i = 0; i < 8; ++i) {
    sum += goals[i] - at[i];
    torque += at[i].cross(goals[i] - at[i]);
  }
  EXPECT_LT(sum.norm(), 1e-14);
  EXPECT_LT(torque.norm(), 1e-7);
}

TEST(ShapeMatching, InsertedPointsRestOnTheirEdgeAndWeighOmegaSquared) {
  const Points rest = cube();
  ShapeMatching shape(rest, 0.25);
  shape.split(0, 1, 8, 0.3);
  EXPECT_LT((shape.rest(8) - Vector3(0.3, 0, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(shape.weight(8), 0.0625);
  shape.split(8, 1, 9, 0.5);
  EXPECT_LT((shape.rest(9) - Vector3(0.65, 0, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(shape.weight(9), 0.0625) << "not omega twice";
  shape.merge(8);
  EXPECT_EQ(shape.weight(8), 0);
}

TEST(ShapeMatching, AtOmegaZeroInsertedPointsHaveNoSay) {
  const Points rest = cube();
  Positions at = rest.position, without, with;
  at[5] += Vector3(0.1, 0.2, 0);
  ShapeMatching plain(rest, 0), split(rest, 0);
  split.split(0, 1, 8, 0.5);
  plain.find_goals(at, &without);
  at.push_back(Vector3(40, 50, 60));
  split.find_goals(at, &with);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(with[i], without[i]);
  }
  EXPECT_LT((with[8] - 0.5 * (with[0] + with[1])).norm(), 1e-14) << "but they have a goal";
}

TEST(ShapeMatching, InThePlaneAMirroredShapeIsNotTakenForATurnedOne) {
  Points rest;
  const Positions square = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}};
  Positions mirrored, goals;
  for (std::size_t i = 0; i < 4; ++i) {
    rest.set(i, square[i], 1);
    mirrored.emplace_back(square[i].x(), -square[i].y(), 0);
  }
  ShapeMatching plane(rest, 1, true), space(rest, 1);
  plane.find_goals(mirrored, &goals);
  EXPECT_NEAR(plane.rotation()(2, 2), 1, 1e-12);
  EXPECT_NEAR((goals[1] - goals[0]).cross(goals[3] - goals[0]).z(), 3, 1e-7);
  space.find_goals(mirrored, &goals);
  EXPECT_NEAR(space.rotation()(2, 2), -1, 1e-7) << "in space it has been turned over";
  for (double angle = 0; angle < 6; angle += 0.1) {
    Positions turned;
    for (const Vector3& at : square) {
      turned.emplace_back(Eigen::AngleAxisd(angle, Vector3::UnitZ()) * at);
    }
    plane.find_goals(turned, &goals);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LT((goals[i] - turned[i]).norm(), 1e-7);
    }
  }
}

}  // namespace
}  // namespace physics
