#include "shape_matching.h"

#include <algorithm>

namespace physics {
namespace {

// How much of the last rotation is mixed in, relative to the size of A: enough to decide what rounding would decide, too little to see.
constexpr double kMemory = 1e-9;

}  // namespace

Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& a, const Eigen::Matrix3d& last) {
  const double size = a.norm();
  const Eigen::Matrix3d mixed = size > 0 ? Eigen::Matrix3d(a / size + kMemory * last) : last;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(mixed, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3 signs = Vector3::Ones();
  signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

ShapeMatching::ShapeMatching(const Points& rest, double omega, bool in_plane) : omega_(omega), in_plane_(in_plane) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < rest.size(); ++i) {
    points_.push_back({rest.position[i], rest.mass[i], rest.mass[i]});
    sum += rest.position[i];
  }
  for (const Point& point : points_) {
    radius_ = std::max(radius_, (point.rest - sum / static_cast<double>(points_.size())).norm());
  }
}

void ShapeMatching::split(std::size_t a, std::size_t b, std::size_t added, double share) {
  const Vector3 rest = (1 - share) * points_[a].rest + share * points_[b].rest;
  const double full = (1 - share) * points_[a].full + share * points_[b].full;
  if (added >= points_.size()) {
    points_.resize(added + 1, {Vector3::Zero(), 0, 0});
  }
  points_[added] = {rest, omega_ * omega_ * full, full};
}

void ShapeMatching::merge(std::size_t gone) { points_[gone] = {Vector3::Zero(), 0, 0}; }

double ShapeMatching::share_between(std::size_t a, std::size_t b, std::size_t point) const {
  const Vector3 way = rest(b) - rest(a);
  const double size = way.squaredNorm();
  return size > 0 ? std::min(1.0, std::max(0.0, way.dot(rest(point) - rest(a)) / size)) : 0;
}

void ShapeMatching::find_goals(const Positions& at, Positions* goals) {
  Vector3 here = Vector3::Zero(), there = Vector3::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    here += points_[i].weight * at[i];
    there += points_[i].weight * points_[i].rest;
    sum += points_[i].weight;
  }
  here /= sum;
  there /= sum;
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    a += points_[i].weight * (at[i] - here) * (points_[i].rest - there).transpose();
  }
  if (in_plane_) {
    a(2, 2) = a.norm();  // the third axis is stretched most: it is never the one that is turned over
  }
  rotation_ = rotation_of(a, rotation_);
  goals->assign(points_.size(), Vector3::Zero());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (points_[i].full > 0) {
      (*goals)[i] = here + rotation_ * (points_[i].rest - there);
    }
  }
}

}  // namespace physics
