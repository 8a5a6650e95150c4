#include "stability.h"

#include <algorithm>
#include <cmath>

#include "channel.h"
#include "world.h"

namespace physics {
namespace {

constexpr int kLinks = 12;
constexpr double kLength = 0.1, kMass = 1;

struct Rod {
  World world;
  SoftBody* body;

  Rod(dsw_environment* environment, const Vector3& start, Integrator integrator, double stiffness, double dt)
      : world(environment) {
    Positions line;
    for (int i = 0; i <= kLinks; ++i) {
      line.push_back(start + Vector3(kLength * i, 0, 0));
    }
    SoftBodyOptions options;
    options.integrator.method = integrator;
    // Or an unstable rod, thrown to and fro, is cut into ever more and smaller parts.
    options.move.min_length = 0.2 * kLength;
    options.most_vertices = kLinks + 8;
    body = world.add(std::make_unique<SoftBody>(world.scene(), line, kMass, options));
    const double k = stiffness * kMass / (dt * dt);
    body->springs = make_rod(line, k * kLength, 0.01 * k * kLength * kLength * kLength);
  }
};

// In [-1, 1], different for each point and direction, the same in every run.
Vector3 throw_of(std::size_t i) {
  const double n = static_cast<double>(i);
  return {std::sin(1 + 7 * n), std::sin(2 + 11 * n), std::sin(3 + 13 * n)};
}

void run_free(StabilityRow* row, int steps) {
  Channel channel;
  channel.scale = 1000;
  const Environment environment = make_channel(channel);
  Rod rod(environment.get(), Vector3(500, 500, 500), row->integrator, row->stiffness, row->dt);
  SoftBody& body = *rod.body;
  double thrown = 0;
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    body.points.velocity[i] = throw_of(i);
    thrown += kMass * throw_of(i).norm();
  }
  const Vector3 momentum = momentum_of(body.points);
  const auto energy = [&body] { return kinetic_energy_of(body.points) + body.springs.energy(body.points.position); };
  const double start = energy();
  row->energy_largest = row->kinetic_largest = 1;
  row->largest_stretch = 0;
  for (int step = 0; step < steps; ++step) {
    take_step(&rod.world, row->dt, true, &row->free);
    // Written so that what is no number stays.
    const double now = energy() / start, kinetic = kinetic_energy_of(body.points) / start;
    const double stretch = body.springs.largest_stretch(body.points.position);
    row->energy_largest = now <= row->energy_largest ? row->energy_largest : now;
    row->kinetic_largest = kinetic <= row->kinetic_largest ? row->kinetic_largest : kinetic;
    row->largest_stretch = stretch <= row->largest_stretch ? row->largest_stretch : stretch;
    row->energy_drift = now - 1;
  }
  row->momentum_change = (momentum_of(body.points) - momentum).norm() / thrown;
}

void run_contact(StabilityRow* row, int steps) {
  Channel channel;
  channel.cubes = {6, 3, 3};
  channel.scale = 0.4;
  channel.obstacles = {{1, 1, 0}, {3, 1, 0}, {4, 1, 0}};
  const Environment environment = make_channel(channel);
  // Just above the posts, so that also the smallest time step gets there.
  Rod rod(environment.get(), Vector3(0.55, 0.6, 0.4002), row->integrator, row->stiffness, row->dt);
  SoftBody& body = *rod.body;
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    body.points.velocity[i] = Vector3(0.2, 0, -1) + 0.1 * throw_of(i);
  }
  body.load.gravity = Vector3(0, 0, -9.81);
  row->contact_stretch = 0;
  for (int step = 0; step < steps; ++step) {
    take_step(&rod.world, row->dt, true, &row->contact);
    const double stretch = body.springs.largest_stretch(body.points.position);
    row->contact_stretch = stretch <= row->contact_stretch ? row->contact_stretch : stretch;
  }
}

}  // namespace

StabilityRow run_stability(Integrator integrator, double stiffness, double dt, int steps) {
  StabilityRow row = {};
  row.integrator = integrator;
  row.stiffness = stiffness;
  row.dt = dt;
  run_free(&row, steps);
  run_contact(&row, steps);
  return row;
}

}  // namespace physics
