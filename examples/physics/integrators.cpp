#include "integrators.h"

#include <Eigen/SparseCholesky>
#include <cmath>

namespace physics {
namespace {

// Newton steps shorter than this share of the step before the first are rounding.
constexpr double kConverged = 1e-10;
constexpr int kHalvings = 12;

// Velocities at the end of the step if there were no springs.
void apply_load(const Load& load, double dt, Points* points) {
  for (std::size_t i = 0; i < points->size(); ++i) {
    const double w = points->inverse_mass(i);
    if (w > 0) {
      Vector3 acceleration = load.gravity;
      if (i < load.force.size()) {
        acceleration += w * load.force[i];
      }
      points->velocity[i] = (points->velocity[i] + dt * acceleration) / (1 + load.drag * dt);
    }
  }
}

void fly(double dt, Points* points) {
  for (std::size_t i = 0; i < points->size(); ++i) {
    points->position[i] += dt * points->velocity[i];
  }
}

void set_velocities(const Points& before, double dt, Points* after) {
  for (std::size_t i = 0; i < after->size(); ++i) {
    if (after->inverse_mass(i) > 0) {
      after->velocity[i] = (after->position[i] - before.position[i]) / dt;
    }
  }
}

void symplectic_euler(const Springs& springs, double dt, Points* points) {
  Positions force(points->size(), Vector3::Zero());
  springs.add_forces(points->position, &force);
  for (std::size_t i = 0; i < points->size(); ++i) {
    points->velocity[i] += dt * points->inverse_mass(i) * force[i];
  }
  fly(dt, points);
}

// The incremental potential times dt^2, so that no division by a small step is left.
class Potential {
 public:
  Potential(const Points& points, const Springs& springs, const Positions& inertial, double dt)
      : points_(points), springs_(springs), inertial_(inertial), dt_(dt) {}

  double value(const Positions& x) const {
    double sum = dt_ * dt_ * springs_.energy(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      sum += points_.inverse_mass(i) > 0 ? 0.5 * points_.mass[i] * (x[i] - inertial_[i]).squaredNorm() : 0;
    }
    return sum;
  }

  // The Newton step; false where the matrix could not be factorised (numbers too large).
  bool newton_step(const Positions& x, Positions* step) const {
    const std::size_t n = x.size();
    Positions force(n, Vector3::Zero());
    springs_.add_forces(x, &force);
    std::vector<Eigen::Triplet<double>> entries, kept;
    springs_.add_stiffness(x, dt_ * dt_, &entries);
    const auto is_free = [this](int row) { return points_.inverse_mass(static_cast<std::size_t>(row / 3)) > 0; };
    for (const auto& entry : entries) {
      if (is_free(entry.row()) && is_free(entry.col())) {
        kept.push_back(entry);
      }
    }
    Eigen::VectorXd right(3 * static_cast<Eigen::Index>(n));
    for (std::size_t i = 0; i < n; ++i) {
      const bool moves = points_.inverse_mass(i) > 0;
      const Vector3 r = dt_ * dt_ * force[i] - points_.mass[i] * (x[i] - inertial_[i]);
      for (int k = 0; k < 3; ++k) {
        const int row = static_cast<int>(3 * i) + k;
        kept.emplace_back(row, row, moves ? points_.mass[i] : 1);
        right[row] = moves ? r[k] : 0;
      }
    }
    Eigen::SparseMatrix<double> matrix(right.size(), right.size());
    matrix.setFromTriplets(kept.begin(), kept.end());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    if (solver.info() != Eigen::Success) {
      return false;
    }
    const Eigen::VectorXd solution = solver.solve(right);
    for (std::size_t i = 0; i < n; ++i) {
      (*step)[i] = solution.segment<3>(3 * static_cast<Eigen::Index>(i));
    }
    return solution.allFinite();
  }

 private:
  const Points& points_;
  const Springs& springs_;
  const Positions& inertial_;
  double dt_;
};

double longest(const Positions& way) {
  double length = 0;
  for (const Vector3& w : way) {
    length = std::max(length, w.norm());
  }
  return length;
}

void implicit_euler(const Springs& springs, double dt, int newton_steps, Points* points) {
  Positions inertial = points->position;
  for (std::size_t i = 0; i < points->size(); ++i) {
    inertial[i] += dt * points->velocity[i];
  }
  const Potential potential(*points, springs, inertial, dt);
  Positions x = points->position, step(x.size()), candidate(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = points->inverse_mass(i) > 0 ? x[i] : inertial[i];  // hands go where they go
  }
  double value = potential.value(x), first = 0;
  if (!std::isfinite(value)) {
    points->position = inertial;  // nothing to minimise: what the forces are worth is for the library to say
    return;
  }
  for (int round = 0; round < newton_steps && potential.newton_step(x, &step); ++round) {
    const double length = longest(step);
    first = round == 0 ? length : first;
    if (length <= kConverged * first) {
      break;
    }
    double part = 1, reached = value;
    for (int halving = 0; halving <= kHalvings; ++halving, part *= 0.5) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        candidate[i] = x[i] + part * step[i];
      }
      reached = potential.value(candidate);
      if (reached < value) {
        break;
      }
    }
    if (!(reached < value)) {
      break;
    }
    x = candidate;
    value = reached;
  }
  points->position = x;
}

void relax(const Deformation& d, double dt, double* multiplier, Points* points) {
  const double compliance = 1 / (d.stiffness * dt * dt);
  double weight = compliance;
  for (int k = 0; k < d.count; ++k) {
    weight += points->inverse_mass(d.point[k]) * d.gradient[k].squaredNorm();
  }
  if (!(weight > compliance)) {
    return;
  }
  const double change = -(d.value + compliance * *multiplier) / weight;
  *multiplier += change;
  for (int k = 0; k < d.count; ++k) {
    points->position[d.point[k]] += points->inverse_mass(d.point[k]) * change * d.gradient[k];
  }
}

void xpbd(const Springs& springs, double dt, int sweeps, Points* points) {
  fly(dt, points);
  std::vector<double> lengths(springs.distances.size(), 0), angles(springs.angles.size(), 0);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t i = 0; i < angles.size(); ++i) {
      relax(deformation_of(springs.angles[i], points->position), dt, &angles[i], points);
    }
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      relax(deformation_of(springs.distances[i], points->position), dt, &lengths[i], points);
    }
  }
}

}  // namespace

const char* name_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::kSymplecticEuler:
      return "symplectic_euler";
    case Integrator::kImplicitEuler:
      return "implicit_euler";
    case Integrator::kXpbd:
      return "xpbd";
  }
  return "unknown";
}

void integrate(const Points& now, const Springs& springs, const Load& load, double dt, const IntegratorOptions& options,
               Points* next) {
  *next = now;
  apply_load(load, dt, next);
  if (options.method == Integrator::kSymplecticEuler) {
    symplectic_euler(springs, dt, next);
    return;
  }
  if (options.method == Integrator::kImplicitEuler) {
    implicit_euler(springs, dt, options.newton_steps, next);
  } else {
    xpbd(springs, dt, options.sweeps, next);
  }
  set_velocities(now, dt, next);
}

}  // namespace physics
