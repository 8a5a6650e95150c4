#include "springs.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace physics {
namespace {

using Matrix3 = Eigen::Matrix3d;

// The direction of a leg of an angular spring, and its derivative by the leg's end: how it turns.
struct Leg {
  Vector3 direction = Vector3::Zero();
  Matrix3 turning = Matrix3::Zero();
  bool is_null;

  Leg(const Vector3& way, double least) : is_null(!(std::max(way.norm(), least) > 0)) {
    if (is_null) {
      return;
    }
    const double length = way.norm();
    direction = way / std::max(length, least);
    turning = Matrix3::Identity() / std::max(length, least);
    if (length >= least) {
      turning = (Matrix3::Identity() - direction * direction.transpose()) / length;
    }
  }
};

void add_block(std::size_t i, std::size_t j, const Matrix3& block, std::vector<Eigen::Triplet<double>>* entries) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      entries->emplace_back(static_cast<int>(3 * i) + row, static_cast<int>(3 * j) + column, block(row, column));
    }
  }
}

template <class List, class Use>
void for_each(const List& springs, const Positions& at, Use use) {
  for (const auto& spring : springs) {
    use(deformation_of(spring, at));
  }
}

}  // namespace

Deformation deformation_of(const DistanceSpring& spring, const Positions& at) {
  Deformation d;
  const Vector3 way = at[spring.b] - at[spring.a];
  const double length = way.norm();
  d.count = 2;
  d.point[0] = spring.a;
  d.point[1] = spring.b;
  d.gradient[1] = length > 0 ? Vector3(way / length) : Vector3::Zero();
  d.gradient[0] = -d.gradient[1];
  d.value = length - spring.rest;
  d.stiffness = spring.stiffness;
  return d;
}

Deformation deformation_of(const AngularSpring& spring, const Positions& at) {
  Deformation d;
  const Leg first(at[spring.b] - at[spring.a], spring.least), second(at[spring.c] - at[spring.b], spring.least);
  d.count = 3;
  d.point[0] = spring.a;
  d.point[1] = spring.b;
  d.point[2] = spring.c;
  for (Vector3& gradient : d.gradient) {
    gradient.setZero();
  }
  d.stiffness = spring.stiffness;
  if (first.is_null || second.is_null) {
    return d;
  }
  const Vector3 turn = second.direction - first.direction;
  d.value = turn.norm();
  if (d.value > 0) {
    const Vector3 n = turn / d.value;
    d.gradient[0] = first.turning * n;
    d.gradient[2] = second.turning * n;
    d.gradient[1] = -d.gradient[0] - d.gradient[2];
  }
  return d;
}

double Springs::energy(const Positions& at) const {
  double sum = 0;
  const auto add = [&sum](const Deformation& d) { sum += 0.5 * d.stiffness * d.value * d.value; };
  for_each(distances, at, add);
  for_each(angles, at, add);
  return sum;
}

void Springs::add_forces(const Positions& at, Positions* force) const {
  const auto add = [force](const Deformation& d) {
    for (int k = 0; k < d.count; ++k) {
      (*force)[d.point[k]] -= d.stiffness * d.value * d.gradient[k];
    }
  };
  for_each(distances, at, add);
  for_each(angles, at, add);
}

void Springs::add_stiffness(const Positions& at, double scale, std::vector<Eigen::Triplet<double>>* entries) const {
  for (const DistanceSpring& s : distances) {
    const Vector3 way = at[s.b] - at[s.a];
    const double length = way.norm();
    Matrix3 block = Matrix3::Identity();
    if (length > 0) {
      const Matrix3 along = way * way.transpose() / (length * length);
      block = along + std::max(0.0, 1 - s.rest / length) * (Matrix3::Identity() - along);
    }
    block *= scale * s.stiffness;
    add_block(s.a, s.a, block, entries);
    add_block(s.b, s.b, block, entries);
    add_block(s.a, s.b, -block, entries);
    add_block(s.b, s.a, -block, entries);
  }
  for (const AngularSpring& s : angles) {
    const Leg first(at[s.b] - at[s.a], s.least), second(at[s.c] - at[s.b], s.least);
    if (first.is_null || second.is_null) {
      continue;
    }
    // k |v - u|^2 / 2 is a square: k J^T J with J the derivative of v - u.
    Matrix3 j[3];
    j[0] = first.turning;
    j[2] = second.turning;
    j[1] = -j[0] - j[2];
    const std::size_t point[3] = {s.a, s.b, s.c};
    for (int p = 0; p < 3; ++p) {
      for (int q = 0; q < 3; ++q) {
        add_block(point[p], point[q], scale * s.stiffness * j[p].transpose() * j[q], entries);
      }
    }
  }
}

double Springs::largest_stretch(const Positions& at) const {
  double largest = 0;
  for (const DistanceSpring& s : distances) {
    const double stretch = std::abs((at[s.b] - at[s.a]).norm() / s.rest - 1);
    largest = stretch <= largest ? largest : stretch;  // a NaN is the largest
  }
  return largest;
}

void Springs::split(std::size_t a, std::size_t b, std::size_t added, double share) {
  const auto old = std::find_if(distances.begin(), distances.end(), [a, b](const DistanceSpring& s) {
    return (s.a == a && s.b == b) || (s.a == b && s.b == a);
  });
  if (old == distances.end()) {
    return;
  }
  const DistanceSpring whole = *old;
  *old = {a, added, share * whole.rest, whole.stiffness / share};
  distances.push_back({added, b, (1 - share) * whole.rest, whole.stiffness / (1 - share)});
  // Legs that ran from a to b end at the new vertex; its own angle is as stiff as the stiffest of those.
  double stiffness = 0, least = 0;
  for (AngularSpring& s : angles) {
    const bool first = (s.a == a && s.b == b) || (s.a == b && s.b == a);
    const bool second = (s.b == a && s.c == b) || (s.b == b && s.c == a);
    if (first || second) {
      (first ? s.a : s.c) = added;
      stiffness = std::max(stiffness, s.stiffness);
      least = std::max(least, s.least);
    }
  }
  if (stiffness > 0) {
    angles.push_back({a, added, b, stiffness, least});
  }
}

bool Springs::merge(std::size_t gone, std::size_t* a, std::size_t* b, double* share) {
  std::vector<DistanceSpring> at;
  const auto touches = [gone](const DistanceSpring& s) { return s.a == gone || s.b == gone; };
  std::copy_if(distances.begin(), distances.end(), std::back_inserter(at), touches);
  distances.erase(std::remove_if(distances.begin(), distances.end(), touches), distances.end());
  const auto bends = [gone](const AngularSpring& s) { return s.b == gone; };
  angles.erase(std::remove_if(angles.begin(), angles.end(), bends), angles.end());
  if (at.size() != 2) {
    const auto reaches = [gone](const AngularSpring& s) { return s.a == gone || s.c == gone; };
    angles.erase(std::remove_if(angles.begin(), angles.end(), reaches), angles.end());
    return false;
  }
  *a = at[0].a == gone ? at[0].b : at[0].a;
  *b = at[1].a == gone ? at[1].b : at[1].a;
  *share = at[0].rest / (at[0].rest + at[1].rest);
  for (AngularSpring& s : angles) {
    if (s.a == gone || s.c == gone) {
      (s.a == gone ? s.a : s.c) = s.b == *a ? *b : *a;
    }
  }
  const double k = at[0].stiffness, l = at[1].stiffness;
  distances.push_back({*a, *b, at[0].rest + at[1].rest, k * l / (k + l)});
  return true;
}

Springs make_rod(const Positions& line, double stretching, double bending) {
  Springs springs;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double length = (line[i + 1] - line[i]).norm();
    springs.distances.push_back({i, i + 1, length, stretching / length});
    if (i > 0) {
      const double before = springs.distances[i - 1].rest;
      springs.angles.push_back(
          {i - 1, i, i + 1, 2 * bending / (length + before), kPressedShare * std::min(before, length)});
    }
  }
  return springs;
}

}  // namespace physics
