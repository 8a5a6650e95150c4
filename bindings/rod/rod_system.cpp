#include "rod_system.h"

#include <algorithm>
#include <cmath>

namespace physics {
namespace {

constexpr int kInnerSweeps = 4;

void add(const BlockVector& from, double factor, BlockVector* to) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    (*to)[i] += factor * from[i];
  }
}

}  // namespace

RodSystem::Side RodSystem::side_of(std::uint32_t rod, const std::uint32_t* vertices, const double* weights,
                                   std::uint32_t count, double sign) const {
  Side side = {rod, {vertices[0], vertices[0]}, {0, 0}, {0, 0}};
  for (std::uint32_t k = 0; k < count; ++k) {
    side.vertices[k] = vertices[k];
    side.weight[k] = sign * weights[k];
    side.push[k] = rods[rod].held[vertices[k]] != 0 ? 0 : side.weight[k];
  }
  return side;
}

Vector3 RodSystem::velocity_of(const Row& row, const std::vector<BlockVector>& velocity) const {
  Vector3 sum = Vector3::Zero();
  for (const Side& side : row.sides) {
    for (std::size_t k = 0; k < 2; ++k) {
      sum += side.weight[k] * velocity[side.rod][side.vertices[k]].head<3>();
    }
  }
  return sum;
}

void RodSystem::prepare(double dt, const std::vector<NearRows>& rows) {
  rows_.clear();
  for (std::uint32_t rod = 0; rod < rods.size(); ++rod) {
    for (std::uint32_t i = 0; i < rows[rod].size(); ++i) {
      const NearRow& from = rows[rod][i];
      if (!from.is_at_rod()) {
        continue;
      }
      rows_.emplace_back();
      Row& row = rows_.back();
      row.owner = rod;
      row.number = i;
      row.friction = std::sqrt(rods[rod].options.contact.friction * rods[from.rod].options.contact.friction);
      row.sides[0] = side_of(rod, from.vertices, from.weights, from.count, 1);
      row.sides[1] = side_of(from.rod, from.rod_vertices, from.rod_weights, 2, -1);
      row.rods = {rod};
      if (from.rod != rod) {
        row.rods.push_back(from.rod);
      }
      Eigen::Matrix3d world = Eigen::Matrix3d::Zero();
      std::vector<BlockVector> in_space;
      for (const std::uint32_t moved : row.rods) {
        for (int d = 0; d < 3; ++d) {
          BlockVector response(rods[moved].size(), Eigen::Vector4d::Zero());
          for (const Side& side : row.sides) {
            for (std::size_t k = 0; k < 2 && side.rod == moved; ++k) {
              response[side.vertices[k]][d] += side.push[k];
            }
          }
          rods[moved].factor().solve(&response);
          for (const Side& side : row.sides) {
            for (std::size_t k = 0; k < 2 && side.rod == moved; ++k) {
              world.col(d) += side.push[k] * response[side.vertices[k]].head<3>();
            }
          }
          in_space.push_back(std::move(response));
        }
      }
      row.set(from.normal, world, Vector3::Zero(), least_velocity(from.gap, rods[rod].options.contact.recovery, dt),
              rods[rod].contacts().impulses()[i]);
      for (std::size_t r = 0; r < row.rods.size(); ++r) {
        for (int d = 0; d < 3; ++d) {
          BlockVector response(in_space[3 * r].size(), Eigen::Vector4d::Zero());
          for (int e = 0; e < 3; ++e) {
            add(in_space[3 * r + static_cast<std::size_t>(e)], row.frame(e, d), &response);
          }
          row.response.push_back(std::move(response));
        }
      }
    }
  }
}

void RodSystem::couple() {
  compliance_.assign(rows_.size() * rows_.size(), Eigen::Matrix3d::Zero());
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const Row& pushed = rows_[j];
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
      for (const Side& side : rows_[i].sides) {
        for (std::size_t r = 0; r < pushed.rods.size(); ++r) {
          for (std::size_t k = 0; k < 2 && pushed.rods[r] == side.rod; ++k) {
            for (std::size_t d = 0; d < 3; ++d) {
              sum.col(static_cast<int>(d)) += side.weight[k] * pushed.response[3 * r + d][side.vertices[k]].head<3>();
            }
          }
        }
      }
      compliance_[i * rows_.size() + j] = rows_[i].frame.transpose() * sum;
    }
  }
}

// Some sweeps over the rows between rods, while the impulses of walls stay as they are.
double RodSystem::sweep() {
  std::vector<BlockVector> now = base_;
  for (std::size_t rod = 0; rod < rods.size(); ++rod) {
    if (rods[rod].contacts().has_rows()) {
      BlockVector moved(rods[rod].size(), Eigen::Vector4d::Zero());
      rods[rod].contacts().end();
      rods[rod].contacts().add_impulses(&moved);
      rods[rod].factor().solve(&moved);
      add(moved, 1, &now[rod]);
    }
  }
  std::vector<Vector3> before;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    slip_[i] = rows_[i].frame.transpose() * velocity_of(rows_[i], now);
    before.push_back(rows_[i].impulse);
  }
  double change = 0;
  for (int inner = 0; inner < kInnerSweeps; ++inner) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      Row& row = rows_[i];
      const Vector3 old = row.impulse;
      change = std::max(change, row.update(row.friction, slip_[i]));
      const Vector3 step = row.impulse - old;
      for (std::size_t k = 0; k < rows_.size() && !step.isZero(0); ++k) {
        slip_[k] += compliance_[k * rows_.size() + i] * step;
      }
    }
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    for (std::size_t k = 0; k < row.response.size(); ++k) {
      const auto d = static_cast<int>(k % 3);
      add(row.response[k], row.impulse[d] - before[i][d], &base_[row.rods[k / 3]]);
    }
  }
  return change;
}

RodContactReport RodSystem::finish(double dt, const std::vector<NearRows>& rows) {
  RodContactReport report;
  int most_sweeps = 0;
  double tolerance = rods.front().options.contact.tolerance;
  base_.clear();
  for (std::size_t rod = 0; rod < rods.size(); ++rod) {
    Rod& each = rods[rod];
    base_.push_back(each.predicted());
    each.contacts().begin(rows[rod], each.matrix(), each.factor(), each.held, base_[rod], dt, true,
                          each.options.contact);
    most_sweeps = std::max(most_sweeps, each.options.contact.most_sweeps);
    tolerance = std::min(tolerance, each.options.contact.tolerance);
  }
  prepare(dt, rows);
  couple();
  slip_.resize(rows_.size());
  for (const Row& row : rows_) {  // they start from the impulses of the step before
    for (std::size_t k = 0; k < row.response.size(); ++k) {
      add(row.response[k], row.impulse[static_cast<int>(k % 3)], &base_[row.rods[k / 3]]);
    }
  }
  const bool has_rows =
      !rows_.empty() || std::any_of(rods.begin(), rods.end(), [](Rod& rod) { return rod.contacts().has_rows(); });
  while (has_rows && report.sweeps < most_sweeps && (report.sweeps == 0 || report.last_change > tolerance)) {
    double change = 0;
    for (std::size_t rod = 0; rod < rods.size(); ++rod) {
      change = std::max(change, rods[rod].contacts().sweep(report.sweeps, base_[rod], rods[rod].options.contact));
    }
    if (!rows_.empty()) {
      change = std::max(change, sweep());
    }
    report.last_change = dt * change;
    ++report.sweeps;
  }
  std::vector<BlockVector> impulses;
  for (Rod& rod : rods) {
    impulses.emplace_back(rod.size(), Eigen::Vector4d::Zero());
    report.pressing += rod.contacts().end();
    rod.contacts().add_impulses(&impulses.back());
  }
  for (const Row& row : rows_) {
    const Vector3 impulse = row.frame * row.impulse;
    rods[row.owner].contacts().impulses()[row.number] = impulse;
    report.pressing += row.impulse[0] > 0 ? 1 : 0;
    for (const Side& side : row.sides) {
      for (std::size_t k = 0; k < 2; ++k) {
        impulses[side.rod][side.vertices[k]].head<3>() += side.push[k] * impulse;
      }
    }
  }
  for (std::size_t rod = 0; rod < rods.size(); ++rod) {
    rods[rod].finish(dt, impulses[rod]);
  }
  return report;
}

}  // namespace physics
