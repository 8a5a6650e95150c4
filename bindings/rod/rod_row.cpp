#include "rod_row.h"

#include <algorithm>
#include <cmath>

namespace physics {
namespace {

// The directions across `normal` in which `compliance` is diagonal, as columns 1 and 2.
Eigen::Matrix3d frame_of(const Vector3& normal, const Eigen::Matrix3d& compliance) {
  const Vector3 any = std::abs(normal.x()) < 0.6 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 u = normal.cross(any).normalized(), v = normal.cross(u);
  const Vector3 cu = compliance * u, cv = compliance * v;
  const double angle = 0.5 * std::atan2(2 * u.dot(cv), u.dot(cu) - v.dot(cv));
  const double cosine = std::cos(angle), sine = std::sin(angle);
  Eigen::Matrix3d frame;
  frame << normal, cosine * u + sine * v, cosine * v - sine * u;
  return frame;
}

// The point of a disc that is nearest to q in the norm with the weights c: Newton for the multiplier (More and
// Sorensen 1983).
Eigen::Vector2d nearest_in_disc(const Eigen::Vector2d& q, const Eigen::Vector2d& c, double radius) {
  if (q.squaredNorm() <= radius * radius || !(radius > 0)) {
    return radius > 0 ? q : Eigen::Vector2d::Zero();
  }
  constexpr int kSteps = 6;
  double multiplier = 0;
  Eigen::Vector2d point = q;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Vector2d sum = c.array() + multiplier;
    point = c.cwiseProduct(q).cwiseQuotient(sum);
    const double square = point.squaredNorm(), length = std::sqrt(square);
    if (length <= radius * (1 + 1e-9)) {
      break;
    }
    const double slope = point.cwiseAbs2().cwiseQuotient(sum).sum();
    multiplier += square / slope * (length / radius - 1);
  }
  return radius / point.norm() * point;
}

}  // namespace

void RowState::set(const Vector3& normal, const Eigen::Matrix3d& world, const Vector3& obstacle_velocity,
                   double least_normal, const Vector3& start) {
  frame = frame_of(normal, world);
  compliance = frame.transpose() * world * frame;
  wanted = frame.transpose() * obstacle_velocity;
  wanted[0] += least_normal;
  impulse = frame.transpose() * start;
  if (!(impulse[0] > 0)) {
    impulse.setZero();
  }
}

double RowState::update(double friction, const Vector3& velocity) {
  const Eigen::Matrix3d& c = compliance;
  if (!moves()) {
    return 0;
  }
  const Vector3 before = impulse;
  impulse[0] = std::max(0.0, before[0] - (velocity[0] - wanted[0]) / c(0, 0));
  const Eigen::Vector2d diagonal(c(1, 1), c(2, 2));
  const Eigen::Vector2d slip = (velocity - wanted + c.col(0) * (impulse[0] - before[0])).tail<2>();
  impulse.tail<2>() = nearest_in_disc(before.tail<2>() - slip.cwiseQuotient(diagonal), diagonal, friction * impulse[0]);
  return (c * (impulse - before)).norm();
}

}  // namespace physics
