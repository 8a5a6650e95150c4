#include "swing.h"

#include <cmath>

#include "curve.h"

namespace physics {
namespace {

constexpr double kSample = 0.1;  // s

Positions accelerations(const Swing& swing, const Points& points) {
  Positions force(points.size(), Vector3::Zero());
  swing.springs.add_forces(points.position, &force);
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double w = points.inverse_mass(i);
    force[i] = w > 0 ? Vector3(w * force[i] + swing.load.gravity) : Vector3::Zero();
  }
  return force;
}

void add(double factor, const Positions& what, Positions* to) {
  for (std::size_t i = 0; i < to->size(); ++i) {
    (*to)[i] += factor * what[i];
  }
}

}  // namespace

Swing::Swing(double stiffness) {
  const Vector3 link = kLink * Vector3(kTilt, 0, -1).normalized();
  for (int i = 0; i <= kLinks; ++i) {
    points.set(static_cast<std::size_t>(i), i * link, kMass);
  }
  points.held[0] = 1;
  for (std::size_t i = 0; i < kLinks; ++i) {
    springs.distances.push_back({i, i + 1, kLink, stiffness});
  }
  load.gravity = Vector3(0, 0, -kGravity);
}

double run(const Swing& swing, const IntegratorOptions& options, double dt, double seconds,
           std::vector<Positions>* trace) {
  const auto steps = std::llround(seconds / dt), every = std::llround(kSample / dt);
  Points points = swing.points, next;
  trace->clear();
  const double start = processor_seconds();
  for (long long step = 1; step <= steps; ++step) {
    integrate(points, swing.springs, swing.load, dt, options, &next);
    std::swap(points, next);
    if (step % every == 0) {
      trace->push_back(points.position);
    }
  }
  return processor_seconds() - start;
}

void run_reference(const Swing& swing, double dt, double seconds, std::vector<Positions>* trace) {
  const auto steps = std::llround(seconds / dt), every = std::llround(kSample / dt);
  Points points = swing.points;
  trace->clear();
  for (long long step = 1; step <= steps; ++step) {
    Positions velocity[4], acceleration[4];
    for (int k = 0; k < 4; ++k) {
      const double part = k == 0 ? 0 : k == 3 ? dt : dt / 2;
      Points there = points;
      velocity[k] = points.velocity;
      if (k > 0) {
        add(part, velocity[k - 1], &there.position);
        add(part, acceleration[k - 1], &velocity[k]);
      }
      acceleration[k] = accelerations(swing, there);
    }
    for (int k = 0; k < 4; ++k) {
      const double weight = dt * (k == 0 || k == 3 ? 1 : 2) / 6;
      add(weight, velocity[k], &points.position);
      add(weight, acceleration[k], &points.velocity);
    }
    if (step % every == 0) {
      trace->push_back(points.position);
    }
  }
}

double distance_of(const std::vector<Positions>& a, const std::vector<Positions>& b) {
  double largest = 0;
  for (std::size_t t = 0; t < a.size(); ++t) {
    for (std::size_t i = 0; i < a[t].size(); ++i) {
      const double distance = (a[t][i] - b[t][i]).norm();
      largest = distance <= largest ? largest : distance;
    }
  }
  return largest;
}

}  // namespace physics
