#include "rod_shape.h"

#include <algorithm>
#include <cmath>

namespace physics {
namespace {

constexpr double kFold = 0.06;      // least 1 + cos of the angle between edges
constexpr double kOpposite = 1e-9;  // of the same, for transport
constexpr double kTurn = 2 * 3.14159265358979323846;
constexpr double kLeastLength = 1e-100;

}  // namespace

Vector3 transported(const Vector3& vector, const Vector3& from, const Vector3& to) {
  const double scale = 1 + from.dot(to);
  if (!(scale > kOpposite)) {
    return vector;
  }
  const Vector3 axis = from.cross(to);
  return vector + axis.cross(vector) + axis.cross(axis.cross(vector)) / scale;
}

void RodShape::find_edges() {
  const std::size_t edges = position.size() - 1;
  tangent.resize(edges);
  length.resize(edges);
  for (std::size_t i = 0; i < edges; ++i) {
    const Vector3 edge = position[i + 1] - position[i];
    length[i] = edge.norm();
    if (length[i] > kLeastLength) {
      tangent[i] = edge / length[i];
    }  // else it keeps its direction
  }
}

void RodShape::advance(const Positions& to, const std::vector<double>& turn) {
  const Positions before = tangent;
  position = to;
  find_edges();
  for (std::size_t i = 0; i < tangent.size(); ++i) {
    Vector3 d = transported(director[i], before[i], tangent[i]);
    d = std::cos(turn[i]) * d + std::sin(turn[i]) * tangent[i].cross(d);
    director[i] = (d - d.dot(tangent[i]) * tangent[i]).normalized();
  }
  for (std::size_t i = 1; i < tangent.size(); ++i) {
    const Vector3 u = transported(director[i - 1], tangent[i - 1], tangent[i]);
    const double angle = std::atan2(tangent[i].dot(u.cross(director[i])), u.dot(director[i]));
    const double expected = twist[i] + turn[i] - turn[i - 1];
    twist[i] = angle + kTurn * std::round((expected - angle) / kTurn);
  }
}

RodBend bend_of(const RodShape& shape, std::size_t vertex) {
  const Vector3 &e = shape.tangent[vertex - 1], &f = shape.tangent[vertex];
  const Vector3 &e1 = shape.director[vertex - 1], &f1 = shape.director[vertex];
  const Vector3 e2 = e.cross(e1), f2 = f.cross(f1);
  const double by_e = 1 / std::max(shape.length[vertex - 1], kLeastLength);
  const double by_f = 1 / std::max(shape.length[vertex], kLeastLength);
  const double chi = std::max(1 + e.dot(f), kFold);
  const Vector3 binormal = 2 / chi * e.cross(f);
  const Vector3 tangent = (e + f) / chi, first = (e1 + f1) / chi, second = (e2 + f2) / chi;
  RodBend bend;
  bend.curvature = {0.5 * chi * binormal.dot(second), -0.5 * chi * binormal.dot(first)};
  bend.twist = shape.twist[vertex];
  Eigen::Matrix3d by_first_edge, by_second_edge;
  by_first_edge.col(0) = by_e * (f.cross(second) - bend.curvature[0] * tangent);
  by_first_edge.col(1) = by_e * (-f.cross(first) - bend.curvature[1] * tangent);
  by_first_edge.col(2) = 0.5 * by_e * binormal;
  by_second_edge.col(0) = by_f * (-e.cross(second) - bend.curvature[0] * tangent);
  by_second_edge.col(1) = by_f * (e.cross(first) - bend.curvature[1] * tangent);
  by_second_edge.col(2) = 0.5 * by_f * binormal;
  bend.gradient[0].topRows<3>() = -by_first_edge;
  bend.gradient[1].topRows<3>() = by_first_edge - by_second_edge;
  bend.gradient[2].topRows<3>() = by_second_edge;
  bend.gradient[0].row(3) << -0.5 * binormal.dot(e1), -0.5 * binormal.dot(e2), -1;
  bend.gradient[1].row(3) << -0.5 * binormal.dot(f1), -0.5 * binormal.dot(f2), 1;
  bend.gradient[2].row(3).setZero();
  return bend;
}

}  // namespace physics
