#include "points.h"

namespace physics {

void Points::set(std::size_t i, Vector3 at, double point_mass) {
  if (i >= size()) {
    position.resize(i + 1, Vector3::Zero());
    velocity.resize(i + 1, Vector3::Zero());
    mass.resize(i + 1, 0);
    held.resize(i + 1, 0);
  }
  position[i] = at;
  velocity[i].setZero();
  mass[i] = point_mass;
  held[i] = 0;
}

void Points::clear(std::size_t i) { set(i, Vector3::Zero(), 0); }

void Points::split(std::size_t a, std::size_t b, std::size_t added, double share, double omega) {
  const double from_a = omega * (1 - share) * mass[a], from_b = omega * share * mass[b];
  set(added, (1 - share) * position[a] + share * position[b], from_a + from_b);
  velocity[added] = (from_a * velocity[a] + from_b * velocity[b]) / (from_a + from_b);
  mass[a] -= held[a] ? 0 : from_a;
  mass[b] -= held[b] ? 0 : from_b;
}

void Points::merge(std::size_t gone, std::size_t a, std::size_t b, double share) {
  const double part[2] = {(1 - share) * mass[gone], share * mass[gone]};
  const std::size_t end[2] = {a, b};
  for (int k = 0; k < 2; ++k) {
    if (!held[end[k]] && part[k] > 0) {
      const double sum = mass[end[k]] + part[k];
      velocity[end[k]] = (mass[end[k]] * velocity[end[k]] + part[k] * velocity[gone]) / sum;
      mass[end[k]] = sum;
    }
  }
  clear(gone);
}

void Points::share_out(const std::vector<double>& masses) {
  const auto velocity_of_centre = [this] {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      sum += held[i] ? 0 : mass[i];
    }
    return sum > 0 ? Vector3(momentum_of(*this) / sum) : Vector3(Vector3::Zero());
  };
  const Vector3 before = velocity_of_centre();
  mass = masses;
  mass.resize(position.size(), 0);
  const Vector3 change = before - velocity_of_centre();
  for (std::size_t i = 0; i < size(); ++i) {
    velocity[i] += held[i] || mass[i] == 0 ? Vector3(Vector3::Zero()) : change;
  }
}

Vector3 momentum_of(const Points& points) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points.held[i]) {
      sum += points.mass[i] * points.velocity[i];
    }
  }
  return sum;
}

Vector3 angular_momentum_of(const Points& points) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points.held[i]) {
      sum += points.mass[i] * points.position[i].cross(points.velocity[i]);
    }
  }
  return sum;
}

double kinetic_energy_of(const Points& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += points.held[i] ? 0 : 0.5 * points.mass[i] * points.velocity[i].squaredNorm();
  }
  return sum;
}

bool is_finite(const Points& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points.position[i].allFinite() || !points.velocity[i].allFinite()) {
      return false;
    }
  }
  return true;
}

}  // namespace physics
