#include "rod_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace physics {
namespace {

// The direct solution: each row has a stiff spring, and rounding is taken back in so many rounds.
constexpr double kSoft = 0.1;       // share of the tolerance by which the springs of rows give way
constexpr double kStiffest = 1e10;  // a spring over the stiffness of its row
constexpr int kRounds = 3;          // at most: a round that changes the motion by less than kRounded of it is the last
constexpr double kRounded = 1e-9;
constexpr int kSets = 8, kFewSets = 3;  // of rows that press, at most: few where the last direct solution did not help
constexpr double kRounding = 1e-12;
constexpr double kInside = 1 - 1e-9;  // friction of less than this share of the cone sticks
constexpr double kHelps = 0.5;        // a direct solution that leaves more than this share of the change did not help
constexpr int kLongestWait = 8;       // sweeps: they drift where nothing is solved directly

}  // namespace

void RodContacts::Row::add_push(const Vector3& impulse_in_space, BlockVector* sum) const {
  for (std::size_t k = 0; k < 2; ++k) {
    (*sum)[pair + k].head<3>() += push[k] * impulse_in_space;
  }
}

Vector3 RodContacts::Row::taken(const BlockVector& motion) const {
  return frame.transpose() * (push[0] * motion[pair].head<3>() + push[1] * motion[pair + 1].head<3>());
}

Vector3 RodContacts::Row::gripped(const Vector3& in_frame) const {
  return grip == kSticks ? in_frame : Vector3(in_frame[0], 0, 0);
}

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
  std::size_t count = 0;
  for (const NearRow& row : rows) {
    if (row.is_at_wall()) {
      ++first_[pair_of(row) + 1];
      ++count;
    }
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    first_[i + 1] += first_[i];
  }
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  rows_.resize(count);
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    const NearRow& from = rows[i];
    if (!from.is_at_wall()) {
      continue;
    }
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
    row.set(from.normal, compliance, from.obstacle_velocity, least_velocity(from.gap, options.recovery, dt),
            impulses_[i]);
    row.response = response * row.frame;
  }
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
    change = std::max(change, row.update(friction, row.frame.transpose() * now));
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

// What the impulses do, for a sweep that begins at the first pair.
void RodContacts::carry_impulses(const BlockVector& velocity) {
  std::fill(own_.begin(), own_.end(), Vector8::Zero());
  sweep_to_first(velocity, 0, false);
}

// Changes of impulses, in frames, after which no row that presses moves along its normal, and no row that sticks moves
// at all: A moved = J^T change and J moved + change / spring = - off, refined as rounding wants it.
void RodContacts::solve_pressing(const Positions& off, Positions* change, BlockVector* moved) {
  scratch_ = *matrix_;
  for (const Row& row : rows_) {
    if (row.grip != kLoose) {
      const Eigen::Matrix3d stiffness =
          row.grip == kSticks ? Eigen::Matrix3d(row.spring * Eigen::Matrix3d::Identity())
                              : Eigen::Matrix3d(row.spring * row.frame.col(0) * row.frame.col(0).transpose());
      ChainMatrix::Column* column = &scratch_.columns[row.pair];
      column[0].diagonal.topLeftCorner<3, 3>() += row.push[0] * row.push[0] * stiffness;
      column[0].next.topLeftCorner<3, 3>() += row.push[0] * row.push[1] * stiffness;
      column[1].diagonal.topLeftCorner<3, 3>() += row.push[1] * row.push[1] * stiffness;
    }
  }
  penalised_.factor(scratch_);
  change->assign(rows_.size(), Vector3::Zero());
  moved->assign(matrix_->columns.size(), Eigen::Vector4d::Zero());
  Positions left(rows_.size());
  for (int round = 0; round < kRounds; ++round) {
    BlockVector more = matrix_->times(*moved);
    for (Eigen::Vector4d& entry : more) {
      entry = -entry;
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Row& row = rows_[i];
      if (row.grip != kLoose) {
        left[i] = row.gripped(-off[i] - row.taken(*moved) - (*change)[i] / row.spring);
        row.add_push(row.frame * ((*change)[i] + row.spring * left[i]), &more);
      }
    }
    penalised_.solve(&more);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Row& row = rows_[i];
      if (row.grip != kLoose) {
        (*change)[i] += row.spring * row.gripped(left[i] - row.taken(more));
      }
    }
    double added = 0, all = 0;
    for (std::size_t i = 0; i < more.size(); ++i) {
      (*moved)[i] += more[i];
      added = std::max(added, more[i].cwiseAbs().maxCoeff());
      all = std::max(all, (*moved)[i].cwiseAbs().maxCoeff());
    }
    if (added <= kRounded * all) {
      return;
    }
  }
}

// Velocities of the rows less those that they want.
Positions RodContacts::slips(const BlockVector& velocity) const {
  BlockVector now(velocity.size(), Eigen::Vector4d::Zero());
  for (const Row& row : rows_) {
    row.add_push(row.frame * row.impulse, &now);
  }
  forward_->solve(&now);
  Positions off(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const Vector3 first = velocity[row.pair].head<3>() + now[row.pair].head<3>();
    const Vector3 second = velocity[row.pair + 1].head<3>() + now[row.pair + 1].head<3>();
    off[i] = row.frame.transpose() * (row.weight[0] * first + row.weight[1] * second) - row.wanted;
  }
  return off;
}

// Solves the rows that press at once, and where `sticking`, holds those that have room in their cone and vertices of
// their own, since several rows that hold one vertex would contradict each other. The impulses go
// there as far as no row pulls; rows that would pull are let go, those that would leave the cone slide, and the others
// are solved again (Lawson and Hanson 1974). Tells whether that has come to an end.
bool RodContacts::press(const BlockVector& velocity, const RodContactOptions& options, bool sticking) {
  double largest = 0;
  for (const Row& row : rows_) {
    largest = std::max(largest, row.impulse[0]);
  }
  std::vector<int> pressing(matrix_->columns.size(), 0);  // rows by vertex
  for (const Row& row : rows_) {
    for (std::size_t k = 0; k < 2 && row.impulse[0] > 0; ++k) {
      pressing[row.pair + k] += row.weight[k] != 0 ? 1 : 0;
    }
  }
  for (Row& row : rows_) {
    row.spring = std::min(largest * dt_ / (kSoft * options.tolerance), kStiffest / row.compliance(0, 0));
    const bool is_inside = row.impulse.tail<2>().norm() < kInside * options.friction * row.impulse[0];
    const bool is_alone =
        (row.weight[0] == 0 || pressing[row.pair] == 1) && (row.weight[1] == 0 || pressing[row.pair + 1] == 1);
    row.grip = !(row.impulse[0] > 0 && row.moves()) ? kLoose : sticking && is_inside && is_alone ? kSticks : kSlides;
  }
  Positions change;
  BlockVector moved;
  const int most_sets = wait_ > options.together ? kFewSets : kSets;
  for (int set = 0; set < most_sets; ++set) {
    solve_pressing(slips(velocity), &change, &moved);
    double share = 1;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].grip != kLoose && rows_[i].impulse[0] + change[i][0] < 0) {
        share = std::min(share, -rows_[i].impulse[0] / change[i][0]);
      }
    }
    bool is_whole = share == 1;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      Row& row = rows_[i];
      if (row.grip == kLoose) {
        continue;
      }
      row.impulse += share * change[i];
      if (row.impulse[0] <= kRounding * largest) {
        row.impulse.setZero();
        row.grip = kLoose;
        is_whole = false;
      } else if (row.grip == kSticks && row.impulse.tail<2>().norm() > options.friction * row.impulse[0]) {
        row.impulse.tail<2>() *= options.friction * row.impulse[0] / row.impulse.tail<2>().norm();
        row.grip = kSlides;
        is_whole = false;
      }
    }
    if (is_whole) {
      return true;
    }
  }
  return false;
}

// Sweeps are slow where many rows press on a stiff rod, so now and then these rows are solved at once. Where
// sticking does not end, friction stays as it is. Sweeps find rows that begin to press.
void RodContacts::press_together(const BlockVector& velocity, const RodContactOptions& options) {
  const std::vector<Row> before = rows_;
  if (slides_ || !press(velocity, options, true)) {
    slides_ = true;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i].impulse = before[i].impulse;
    }
    press(velocity, options, false);
  }
  carry_impulses(velocity);
}

void RodContacts::begin(const NearRows& rows, const ChainMatrix& matrix, const ChainFactor& factor,
                        const std::vector<char>& held, const BlockVector& velocity, double dt, bool again,
                        const RodContactOptions& options) {
  start(rows, again);
  rows_.clear();
  if (std::none_of(rows.begin(), rows.end(), [](const NearRow& row) { return row.is_at_wall(); })) {
    return;
  }
  matrix_ = &matrix;
  dt_ = dt;
  slides_ = false;
  next_together_ = wait_ = options.together;
  change_before_ = std::numeric_limits<double>::infinity();
  forward_ = &factor;
  factor.invert(&inverse_);
  find_transfers_towards_last(matrix, &scratch_, &backward_, &towards_last_);
  prepare(rows, held, dt, options);
  const std::size_t pairs = held.size() - 1;
  from_first_.assign(pairs, Vector8::Zero());
  from_last_.assign(pairs, Vector8::Zero());
  own_.assign(pairs, Vector8::Zero());
  sweep_to_first(velocity, options.friction, false);
}

double RodContacts::sweep(int sweep, const BlockVector& velocity, const RodContactOptions& options) {
  if (rows_.empty()) {
    return 0;
  }
  if (options.together > 0 && sweep > 0 && sweep == next_together_) {
    const bool helped = change_ <= kHelps * change_before_;
    wait_ = helped ? options.together : std::max(options.together, std::min(2 * wait_, kLongestWait));
    next_together_ += wait_;
    change_before_ = change_;
    press_together(velocity, options);
  }
  change_ =
      sweep % 2 == 0 ? sweep_to_last(velocity, options.friction) : sweep_to_first(velocity, options.friction, true);
  return change_;
}

std::size_t RodContacts::end() {
  std::size_t pressing = 0;
  for (const Row& row : rows_) {
    impulses_[row.number] = row.frame * row.impulse;
    pressing += row.impulse[0] > 0 ? 1 : 0;
  }
  return pressing;
}

RodContactReport RodContacts::solve(const NearRows& rows, const ChainMatrix& matrix, const ChainFactor& factor,
                                    const std::vector<char>& held, const BlockVector& velocity, double dt, bool again,
                                    const RodContactOptions& options) {
  RodContactReport report;
  begin(rows, matrix, factor, held, velocity, dt, again, options);
  if (rows_.empty()) {
    return report;
  }
  do {
    report.last_change = dt * sweep(report.sweeps, velocity, options);
    ++report.sweeps;
  } while (report.last_change > options.tolerance && report.sweeps < options.most_sweeps);
  report.pressing = end();
  return report;
}

void RodContacts::add_impulses(BlockVector* sum) const {
  for (const Row& row : rows_) {
    row.add_push(impulses_[row.number], sum);
  }
}

}  // namespace physics
