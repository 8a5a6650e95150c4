#include "rod_contacts.h"

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

void RodContacts::start(const NearRows& rows, bool again) {
  if (again) {
    return;
  }
  impulses_.assign(rows.size(), Vector3::Zero());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].previous < last_impulses_.size()) {
      impulses_[i] = last_impulses_[rows[i].previous];
    }
  }
}

void RodContacts::prepare(const NearRows& rows, const std::vector<char>& held, double dt,
                          const RodContactOptions& options) {
  const std::size_t pairs = held.size() - 1;
  first_.assign(pairs + 1, 0);
  const auto pair_of = [pairs](const NearRow& row) {
    const std::uint32_t low = row.count > 1 ? std::min(row.vertices[0], row.vertices[1]) : row.vertices[0];
    return std::min<std::size_t>(low, pairs - 1);
  };
  for (const NearRow& row : rows) {
    ++first_[pair_of(row) + 1];
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    first_[i + 1] += first_[i];
  }
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  rows_.resize(rows.size());
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    const NearRow& from = rows[i];
    const std::size_t pair = pair_of(from);
    Row& row = rows_[next[pair]++];
    row.number = i;
    row.pair = static_cast<std::uint32_t>(pair);
    row.weight[0] = row.weight[1] = 0;
    for (std::uint32_t k = 0; k < from.count; ++k) {
      row.weight[from.vertices[k] - pair] += from.weights[k];
    }
    for (std::size_t k = 0; k < 2; ++k) {
      row.push[k] = held[pair + k] != 0 ? 0 : row.weight[k];
    }
    const ChainMatrix::Column& z = inverse_.columns[pair];
    Eigen::Matrix<double, 8, 3> response;
    response.topRows<4>() = row.push[0] * z.diagonal.leftCols<3>() + row.push[1] * z.next.transpose().leftCols<3>();
    response.bottomRows<4>() =
        row.push[0] * z.next.leftCols<3>() + row.push[1] * inverse_.columns[pair + 1].diagonal.leftCols<3>();
    const Eigen::Matrix3d compliance = row.push[0] * response.topRows<3>() + row.push[1] * response.middleRows<3>(4);
    row.frame = frame_of(from.normal, compliance);
    row.compliance = row.frame.transpose() * compliance * row.frame;
    row.response = response * row.frame;
    row.wanted = row.frame.transpose() * from.obstacle_velocity;
    row.wanted[0] -= (from.gap > 0 ? from.gap : options.recovery * from.gap) / dt;
    row.impulse = row.frame.transpose() * impulses_[i];
    row.impulse[0] = std::max(row.impulse[0], 0.0);
  }
}

// Block Gauss-Seidel: the normal first, then friction as the point of the disc that dissipates most. Returns the
// row's change of velocity.
double RodContacts::update(double friction, const Vector3& velocity, Row* row) const {
  const Eigen::Matrix3d& c = row->compliance;
  if (!(c(0, 0) > 0 && c(1, 1) > 0 && c(2, 2) > 0)) {
    return 0;  // all of it is held
  }
  const Vector3 before = row->impulse;
  row->impulse[0] = std::max(0.0, before[0] - (velocity[0] - row->wanted[0]) / c(0, 0));
  const Eigen::Vector2d diagonal(c(1, 1), c(2, 2));
  const Eigen::Vector2d slip = (velocity - row->wanted + c.col(0) * (row->impulse[0] - before[0])).tail<2>();
  row->impulse.tail<2>() =
      nearest_in_disc(before.tail<2>() - slip.cwiseQuotient(diagonal), diagonal, friction * row->impulse[0]);
  return (c * (row->impulse - before)).norm();
}

double RodContacts::visit_pair(std::size_t pair, const BlockVector& velocity, double friction, bool changes) {
  if (first_[pair] == first_[pair + 1]) {
    return 0;
  }
  double change = 0;
  const Vector8 outer = from_first_[pair] + from_last_[pair];
  const Vector3 first = velocity[pair].head<3>() + outer.head<3>();
  const Vector3 second = velocity[pair + 1].head<3>() + outer.segment<3>(4);
  Vector8& own = own_[pair];
  for (std::uint32_t i = first_[pair]; i < first_[pair + 1]; ++i) {
    Row& row = rows_[i];
    if (!changes) {
      own.noalias() += row.response * row.impulse;
      continue;
    }
    const Vector3 now = row.weight[0] * (first + own.head<3>()) + row.weight[1] * (second + own.segment<3>(4));
    if (row.impulse[0] == 0 && row.frame.col(0).dot(now) >= row.wanted[0]) {
      continue;  // most rows do not press
    }
    const Vector3 before = row.impulse;
    change = std::max(change, update(friction, row.frame.transpose() * now, &row));
    own.noalias() += row.response * (row.impulse - before);
  }
  return change;
}

double RodContacts::sweep_to_last(const BlockVector& velocity, double friction) {
  double change = 0;
  from_first_[0].setZero();
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) {
    change = std::max(change, visit_pair(i, velocity, friction, true));
    if (i + 2 < first_.size()) {
      const Vector8 sum = from_first_[i] + own_[i];
      const Transfer& transfer = towards_last_[i + 2];
      from_first_[i + 1].head<4>() = sum.tail<4>();
      from_first_[i + 1].tail<4>().noalias() = -(transfer.near * sum.tail<4>());
      from_first_[i + 1].tail<4>().noalias() -= transfer.far * sum.head<4>();
    }
  }
  return change;
}

double RodContacts::sweep_to_first(const BlockVector& velocity, double friction, bool changes) {
  double change = 0;
  from_last_[first_.size() - 2].setZero();
  for (std::size_t i = first_.size() - 1; i-- > 0;) {
    change = std::max(change, visit_pair(i, velocity, friction, changes));
    if (i > 0) {
      const Vector8 sum = from_last_[i] + own_[i];
      const Transfer& transfer = forward_->towards_first()[i - 1];
      from_last_[i - 1].tail<4>() = sum.head<4>();
      from_last_[i - 1].head<4>().noalias() = -(transfer.near * sum.head<4>());
      from_last_[i - 1].head<4>().noalias() -= transfer.far * sum.tail<4>();
    }
  }
  return change;
}

RodContactReport RodContacts::solve(const NearRows& rows, const ChainMatrix& matrix, const ChainFactor& factor,
                                    const std::vector<char>& held, const BlockVector& velocity, double dt, bool again,
                                    const RodContactOptions& options) {
  RodContactReport report;
  start(rows, again);
  rows_.clear();
  if (rows.empty()) {
    return report;
  }
  forward_ = &factor;
  factor.invert(&inverse_);
  find_transfers_towards_last(matrix, &scratch_, &backward_, &towards_last_);
  prepare(rows, held, dt, options);
  const std::size_t pairs = held.size() - 1;
  from_first_.assign(pairs, Vector8::Zero());
  from_last_.assign(pairs, Vector8::Zero());
  own_.assign(pairs, Vector8::Zero());
  sweep_to_first(velocity, options.friction, false);
  do {
    const bool to_last = report.sweeps % 2 == 0;
    report.last_change =
        dt * (to_last ? sweep_to_last(velocity, options.friction) : sweep_to_first(velocity, options.friction, true));
    ++report.sweeps;
  } while (report.last_change > options.tolerance && report.sweeps < options.most_sweeps);
  for (const Row& row : rows_) {
    impulses_[row.number] = row.frame * row.impulse;
    report.pressing += row.impulse[0] > 0 ? 1 : 0;
  }
  return report;
}

void RodContacts::add_impulses(BlockVector* sum) const {
  for (const Row& row : rows_) {
    for (std::size_t k = 0; k < 2; ++k) {
      (*sum)[row.pair + k].head<3>() += row.push[k] * impulses_[row.number];
    }
  }
}

}  // namespace physics
