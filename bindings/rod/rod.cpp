#include "rod.h"

#include <algorithm>
#include <cmath>

namespace physics {
namespace {

constexpr double kStopped =
    1e-9;  // share of a move by which a vertex may be short of its target and still counts as there

// Masses below this share of the stiffness times dt^2 would drown in rounding; they count as so much.
constexpr double kLeastMass = 1e-14;

// A unit vector across another.
Vector3 unit_across(const Vector3& tangent) {
  const Vector3 any = std::abs(tangent.x()) < 0.6 ? Vector3::UnitX() : Vector3::UnitY();
  return tangent.cross(any).normalized();
}

}  // namespace

Rod::Rod(const Positions& line, const std::vector<RodEdge>& of_edges) {
  shape.position = {line.front()};
  velocity = load = {Vector3::Zero()};
  rest_curvature = {Vector2::Zero()};
  rest_twist = shape.twist = {0};
  mass = {0};
  held = {0};
  for (std::size_t i = 0; i < of_edges.size(); ++i) {
    add_vertex(line[i + 1], of_edges[i]);
  }
}

void Rod::add_vertex(const Vector3& at, const RodEdge& edge) {
  shape.position.push_back(at);
  shape.find_edges();
  const std::size_t last = edges.size();
  const Vector3& tangent = shape.tangent[last];
  shape.director.push_back(last == 0 ? unit_across(tangent)
                                     : transported(shape.director[last - 1], shape.tangent[last - 1], tangent));
  edges.push_back(edge);
  mass.back() += 0.5 * edge.mass;
  mass.push_back(0.5 * edge.mass);
  velocity.push_back(Vector3::Zero());
  load.push_back(Vector3::Zero());
  spin.push_back(0);
  held.push_back(0);
  held_turn.push_back(0);
  rest_curvature.push_back(Vector2::Zero());
  rest_twist.push_back(0);
  shape.twist.push_back(0);
}

double Rod::inertia_of(std::size_t edge) const {
  return 0.5 * edges[edge].mass * edges[edge].radius * edges[edge].radius;
}

double Rod::half_length_at(std::size_t vertex) const { return 0.5 * (edges[vertex - 1].length + edges[vertex].length); }

double Rod::tension(std::size_t edge) const {
  return edges[edge].stretching * (shape.length[edge] / edges[edge].length - 1);
}

void Rod::add_elasticity(const RodShape& at, double scale, BlockVector* force, ChainMatrix* matrix) const {
  const auto count = edges.size();
  for (std::size_t i = 0; i < count; ++i) {
    const RodEdge& edge = edges[i];
    const Vector3& t = at.tangent[i];
    const double pull = edge.stretching * (at.length[i] / edge.length - 1);
    (*force)[i].head<3>() += pull * t;
    (*force)[i + 1].head<3>() -= pull * t;
    if (matrix != nullptr) {
      const double along = scale * edge.stretching / edge.length;
      const double sideways = scale * std::max(pull, 0.0) / at.length[i];
      Eigen::Matrix3d k = ((along - sideways) * t) * t.transpose();
      k.diagonal().array() += sideways;
      matrix->columns[i].diagonal.topLeftCorner<3, 3>() += k;
      matrix->columns[i + 1].diagonal.topLeftCorner<3, 3>() += k;
      matrix->columns[i].next.topLeftCorner<3, 3>() -= k;
    }
  }
  for (std::size_t i = 1; i < count; ++i) {
    const RodBend bend = bend_of(at, i);
    const double by_length = 1 / half_length_at(i);
    const double bending = 0.5 * (edges[i - 1].bending + edges[i].bending) * by_length;
    const double twisting = 0.5 * (edges[i - 1].twisting + edges[i].twisting) * by_length;
    const Vector3 stiffness(bending, bending, twisting);
    Vector3 strain;
    strain << bend.curvature - rest_curvature[i], bend.twist - rest_twist[i];
    const Vector3 stress = stiffness.cwiseProduct(strain);
    for (std::size_t k = 0; k < 3; ++k) {
      (*force)[i - 1 + k].noalias() -= bend.gradient[k] * stress;
    }
    if (matrix != nullptr) {
      const Eigen::Matrix<double, 3, 4> first = (scale * stiffness).asDiagonal() * bend.gradient[0].transpose();
      const Eigen::Matrix<double, 3, 4> second = (scale * stiffness).asDiagonal() * bend.gradient[1].transpose();
      const Eigen::Matrix<double, 3, 4> third = (scale * stiffness).asDiagonal() * bend.gradient[2].transpose();
      ChainMatrix::Column* column = &matrix->columns[i - 1];
      column[0].diagonal.noalias() += bend.gradient[0] * first;
      column[0].next.noalias() += bend.gradient[1] * first;
      column[0].after.noalias() += bend.gradient[2] * first;
      column[1].diagonal.noalias() += bend.gradient[1] * second;
      column[1].next.noalias() += bend.gradient[2] * second;
      column[2].diagonal.noalias() += bend.gradient[2] * third;
    }
  }
}

// Held entries keep the velocity that they have: their columns go to the right side.
void Rod::prescribe(const BlockVector& now, BlockVector* right_side) {
  const std::size_t count = size();
  for (std::size_t i = 0; i < count; ++i) {
    for (int d = 0; d < 4; ++d) {
      const bool is_held = d < 3 ? held[i] != 0 : i + 1 == count || held_turn[i] != 0;
      if (!is_held) {
        continue;
      }
      const double value = now[i][d];
      ChainMatrix::Column* column = &matrix_.columns[i];
      const double diagonal = column->diagonal(d, d);
      (*right_side)[i].noalias() -= value * column->diagonal.col(d);
      column->diagonal.col(d).setZero();
      column->diagonal.row(d).setZero();
      column->diagonal(d, d) = diagonal;
      if (i + 1 < count) {
        (*right_side)[i + 1].noalias() -= value * column->next.col(d);
        column->next.col(d).setZero();
      }
      if (i + 2 < count) {
        (*right_side)[i + 2].noalias() -= value * column->after.col(d);
        column->after.col(d).setZero();
      }
      if (i >= 1) {
        (*right_side)[i - 1].noalias() -= value * column[-1].next.row(d).transpose();
        column[-1].next.row(d).setZero();
      }
      if (i >= 2) {
        (*right_side)[i - 2].noalias() -= value * column[-2].after.row(d).transpose();
        column[-2].after.row(d).setZero();
      }
      (*right_side)[i][d] = diagonal * value;
    }
  }
}

BlockVector Rod::velocities() const {
  BlockVector now(size());
  for (std::size_t i = 0; i < size(); ++i) {
    now[i] << velocity[i], i + 1 < size() ? spin[i] : 0;
  }
  return now;
}

// A v' = M v + dt (f(trial) + load) + dt^2 K guess, where A = M (1 + dt drag) + (dt^2 + dt damping) K.
void Rod::linearise(const RodShape& trial, double dt, const BlockVector* guess) {
  const std::size_t count = size();
  const BlockVector now = velocities();
  const double scale = dt * dt + dt * options.damping;
  right_side_.assign(count, Eigen::Vector4d::Zero());
  matrix_.set_zero(count);
  add_elasticity(trial, scale, &right_side_, &matrix_);
  const BlockVector stiff = guess == nullptr ? BlockVector() : matrix_.times(*guess);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector4d stiffest = kLeastMass * matrix_.columns[i].diagonal.diagonal();
    Eigen::Vector4d masses = Eigen::Vector4d::Constant(std::max(mass[i], stiffest.head<3>().maxCoeff()));
    masses[3] = i + 1 < count ? std::max(inertia_of(i), stiffest[3]) : 1;
    right_side_[i].head<3>() += load[i];
    right_side_[i] = dt * right_side_[i] + masses.cwiseProduct(now[i]);
    if (guess != nullptr) {
      right_side_[i] += dt * dt / scale * stiff[i];
    }
    matrix_.columns[i].diagonal.diagonal() += (1 + dt * options.drag) * masses;
  }
  prescribe(now, &right_side_);
  factor_.factor(matrix_);
}

// `velocities` are those of the next time step.
void Rod::take(const BlockVector& velocities, double dt) {
  targets_.resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    targets_[i] = shape.position[i] + dt * velocities[i].head<3>();
    velocity[i] = velocities[i].head<3>();
    if (i + 1 < size()) {
      spin[i] = velocities[i][3];
    }
  }
  contacts_.end_step();
}

RodContactReport Rod::step(double dt, const NearRows& rows) {
  const std::size_t count = size();
  RodShape trial = shape;
  RodContactReport report;
  for (int k = 0; k < options.linearisations; ++k) {
    const BlockVector before = guess_;
    linearise(trial, dt, k > 0 ? &before : nullptr);
    guess_ = right_side_;
    factor_.solve(&guess_);
    report = contacts_.solve(rows, matrix_, factor_, held, guess_, dt, k > 0, options.contact);
    if (!rows.empty()) {
      guess_ = right_side_;
      contacts_.add_impulses(&guess_);
      factor_.solve(&guess_);
    }
    if (k + 1 < options.linearisations) {
      Positions to(count);
      std::vector<double> turn(edges.size());
      for (std::size_t i = 0; i < count; ++i) {
        to[i] = shape.position[i] + dt * guess_[i].head<3>();
        if (i + 1 < count) {
          turn[i] = dt * guess_[i][3];
        }
      }
      trial = shape;
      trial.advance(to, turn);
    }
  }
  take(guess_, dt);
  return report;
}

const BlockVector& Rod::predict(double dt) {
  linearise(shape, dt, nullptr);
  guess_ = right_side_;
  factor_.solve(&guess_);
  return guess_;
}

void Rod::finish(double dt, const BlockVector& impulses) {
  guess_ = right_side_;
  for (std::size_t i = 0; i < size(); ++i) {
    guess_[i] += impulses[i];
  }
  factor_.solve(&guess_);
  take(guess_, dt);
}

void Rod::accept(const Positions& actual, double dt) {
  for (std::size_t i = 0; i < size(); ++i) {
    const double wanted = (targets_[i] - shape.position[i]).norm();
    if (held[i] == 0 && (actual[i] - targets_[i]).norm() > kStopped * wanted) {
      const Vector3 way = actual[i] - shape.position[i];
      velocity[i] = std::min(1.0, wanted / way.norm()) * way / dt;
    }
  }
  std::vector<double> turn(edges.size());
  std::transform(spin.begin(), spin.end(), turn.begin(), [dt](double rate) { return dt * rate; });
  shape.advance(actual, turn);
}

void Rod::rest() {
  std::fill(velocity.begin(), velocity.end(), Vector3::Zero());
  std::fill(spin.begin(), spin.end(), 0);
}

double Rod::elastic_energy() const {
  double energy = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double strain = shape.length[i] / edges[i].length - 1;
    energy += 0.5 * edges[i].stretching * edges[i].length * strain * strain;
  }
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const RodBend bend = bend_of(shape, i);
    const double twist = bend.twist - rest_twist[i];
    energy += 0.25 *
              ((edges[i - 1].bending + edges[i].bending) * (bend.curvature - rest_curvature[i]).squaredNorm() +
               (edges[i - 1].twisting + edges[i].twisting) * twist * twist) /
              half_length_at(i);
  }
  return energy;
}

double Rod::kinetic_energy() const {
  double energy = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    energy += 0.5 * mass[i] * velocity[i].squaredNorm();
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    energy += 0.5 * inertia_of(i) * spin[i] * spin[i];
  }
  return energy;
}

BlockVector Rod::forces() const {
  BlockVector force(size(), Eigen::Vector4d::Zero());
  add_elasticity(shape, 0, &force, nullptr);
  return force;
}

ChainMatrix Rod::stiffness() const {
  BlockVector force(size(), Eigen::Vector4d::Zero());
  ChainMatrix matrix;
  matrix.set_zero(size());
  add_elasticity(shape, 1, &force, &matrix);
  return matrix;
}

double Rod::largest_stretch() const {
  double largest = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    largest = std::max(largest, std::abs(shape.length[i] / edges[i].length - 1));
  }
  return largest;
}

}  // namespace physics
