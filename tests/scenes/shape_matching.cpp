#include "scenes/shape_matching.h"

#include <cmath>
#include <utility>

namespace dsw::scenes {

namespace {

using Vector = std::array<double, 3>;

constexpr int kSweeps = 12;  // quadratic convergence: six reach rounding

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector times(const Matrix& a, const Vector& v) { return {dot(a[0], v), dot(a[1], v), dot(a[2], v)}; }
Vector column(const Matrix& a, std::size_t i) { return {a[0][i], a[1][i], a[2][i]}; }

/** False: the vector is zero. */
bool make_unit(Vector& v) {
  const double length = std::sqrt(dot(v, v));
  for (double& value : v) value /= length;
  return length > 0;
}

/** One Jacobi rotation: entry p, q of the symmetric b becomes zero; columns of `vectors` turn with it. */
void rotate(Matrix& b, Matrix& vectors, std::size_t p, std::size_t q) {
  if (b[p][q] == 0) return;
  const double theta = (b[q][q] - b[p][p]) / (2 * b[p][q]);
  const double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double kp = b[k][p], kq = b[k][q];
    b[k][p] = c * kp - s * kq;
    b[k][q] = s * kp + c * kq;
    const double vp = vectors[k][p], vq = vectors[k][q];
    vectors[k][p] = c * vp - s * vq;
    vectors[k][q] = s * vp + c * vq;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double pk = b[p][k], qk = b[q][k];
    b[p][k] = c * pk - s * qk;
    b[q][k] = s * pk + c * qk;
  }
  b[p][q] = b[q][p] = 0;
}

}  // namespace

Matrix nearest_rotation(const Matrix& a, const Matrix& last) {
  Matrix b{}, vectors = kIdentity;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) b[i][j] = dot(column(a, i), column(a, j));
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    rotate(b, vectors, 0, 1);
    rotate(b, vectors, 0, 2);
    rotate(b, vectors, 1, 2);
  }
  std::array<std::size_t, 3> order = {0, 1, 2};  // of the largest stretch first
  for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 2}, {0, 1}}) {
    if (b[order[i]][order[i]] < b[order[j]][order[j]]) std::swap(order[i], order[j]);
  }
  const Vector first = column(vectors, order[0]), second = column(vectors, order[1]);
  Vector u = times(a, first), v = times(a, second);
  if (!make_unit(u)) return last;
  const double along = dot(u, v);
  for (std::size_t k = 0; k < 3; ++k) v[k] -= along * u[k];
  if (!make_unit(v)) return last;
  const std::array<Vector, 3> from = {first, second, cross(first, second)}, to = {u, v, cross(u, v)};
  Matrix rotation{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      rotation[i][j] = to[0][i] * from[0][j] + to[1][i] * from[1][j] + to[2][i] * from[2][j];
    }
  }
  return rotation;
}

RestShape::RestShape(const std::vector<double>& rest, std::vector<double> weights)
    : rest_(rest), weights_(std::move(weights)) {
  Vector centre{};
  for (std::size_t i = 0; i < size(); ++i) {
    sum_ += weights_[i];
    for (std::size_t k = 0; k < 3; ++k) centre[k] += weights_[i] * rest_[3 * i + k];
  }
  for (std::size_t i = 0; i < rest_.size(); ++i) rest_[i] -= centre[i % 3] / sum_;
}

void RestShape::find_goals(const double* at, Matrix& rotation, double* goals) const {
  Vector centre{};
  for (std::size_t i = 0; i < size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) centre[k] += weights_[i] / sum_ * at[3 * i + k];
  }
  Matrix a{};
  for (std::size_t i = 0; i < size(); ++i) {
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 3; ++k) a[row][k] += weights_[i] * (at[3 * i + row] - centre[row]) * rest_[3 * i + k];
    }
  }
  rotation = nearest_rotation(a, rotation);
  for (std::size_t i = 0; i < size(); ++i) {
    const Vector turned = times(rotation, {rest_[3 * i], rest_[3 * i + 1], rest_[3 * i + 2]});
    for (std::size_t k = 0; k < 3; ++k) goals[3 * i + k] = centre[k] + turned[k];
  }
}

}  // namespace dsw::scenes
