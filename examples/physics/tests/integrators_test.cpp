#include "integrators.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random_line.h"

namespace physics {
namespace {

constexpr Integrator kAll[] = {Integrator::kSymplecticEuler, Integrator::kImplicitEuler, Integrator::kXpbd};

// A spring between two masses, stretched along its line: one oscillator.
struct Oscillator {
  Points points;
  Springs springs;
  double frequency;

  Oscillator(double stiffness, double stretch) : frequency(std::sqrt(stiffness * (1 / 2.0 + 1 / 3.0))) {
    points.set(0, Vector3(0, 0, 0), 2);
    points.set(1, Vector3(1 + stretch, 0, 0), 3);
    springs.distances.push_back({0, 1, 1, stiffness});
  }
  double energy() const { return kinetic_energy_of(points) + springs.energy(points.position); }
  void step(Integrator method, double dt) {
    Points next;
    IntegratorOptions options;
    options.method = method;
    integrate(points, springs, Load(), dt, options, &next);
    points = next;
  }
};

TEST(SymplecticEuler, EnergyStaysWithinItsBound) {
  // What is conserved exactly is E - dt k x v / 2 (of the oscillator), and |k x v| <= frequency * E: so E never leaves these bounds.
  Oscillator o(40, 0.01);
  const double dt = 0.03, a = 0.5 * o.frequency * dt, start = o.energy();
  ASSERT_LT(a, 1);
  double least = start, most = start;
  for (int i = 0; i < 20000; ++i) {
    o.step(Integrator::kSymplecticEuler, dt);
    least = std::min(least, o.energy());
    most = std::max(most, o.energy());
  }
  EXPECT_GE(least, start * (1 - a) / (1 + a) * (1 - 1e-9));
  EXPECT_LE(most, start * (1 + a) / (1 - a) * (1 + 1e-9));
  EXPECT_GT(most, start * (1 + 0.5 * a)) << "the bound is no accident: energy swings";
}

TEST(SymplecticEuler, BeyondItsLimitEnergyGrows) {
  Oscillator o(40, 0.01);
  const double start = o.energy();
  for (int i = 0; i < 100; ++i) {
    o.step(Integrator::kSymplecticEuler, 2.1 / o.frequency);
  }
  EXPECT_GT(o.energy(), 1e3 * start);
}

TEST(ImplicitEuler, LosesWhatTheTheorySays) {
  // For an oscillator each step divides amplitudes by sqrt(1 + (frequency dt)^2).
  Oscillator o(40, 0.01);
  const double dt = 0.03, start = o.energy(), w = o.frequency * dt;
  for (int i = 0; i < 50; ++i) {
    o.step(Integrator::kImplicitEuler, dt);
  }
  EXPECT_NEAR(o.energy() / start, std::pow(1 + w * w, -50), 1e-3 * std::pow(1 + w * w, -50));
}

TEST(Integrators, AgreeOnASmallStep) {
  for (const Integrator method : kAll) {
    Oscillator o(40, 0.01);
    const double end = 1, dt = 1e-4;
    for (int i = 0; i < 10000; ++i) {
      o.step(method, dt);
    }
    const double stretch = (o.points.position[1] - o.points.position[0]).norm() - 1;
    EXPECT_NEAR(stretch, 0.01 * std::cos(o.frequency * end), 1e-4) << name_of(method);
  }
}

// A rod that tumbles, with stiffness in units of mass / dt^2.
void tumble(Integrator method, double stiffness, double dt, int steps, double* energy_ratio, double* stretch,
            double* momentum_change) {
  const double length = 0.1;
  Positions line;
  for (int i = 0; i < 10; ++i) {
    line.push_back(Vector3(length * i, 0, 0));
  }
  const double k = stiffness / (dt * dt);
  const Springs springs = make_rod(line, k * length, 0.01 * k * length * length * length);
  Points points, next;
  std::mt19937 bits(11);
  for (std::size_t i = 0; i < line.size(); ++i) {
    points.set(i, line[i], 1);
    points.velocity[i] = random_vector(&bits);
  }
  const Vector3 momentum = momentum_of(points);
  const double start = kinetic_energy_of(points);
  IntegratorOptions options;
  options.method = method;
  *energy_ratio = *stretch = 0;
  for (int i = 0; i < steps; ++i) {
    integrate(points, springs, Load(), dt, options, &next);
    points = next;
    ASSERT_TRUE(is_finite(points));
    *energy_ratio = std::max(*energy_ratio, (kinetic_energy_of(points) + springs.energy(points.position)) / start);
    *stretch = std::max(*stretch, springs.largest_stretch(points.position));
  }
  *momentum_change = (momentum_of(points) - momentum).norm() / momentum.norm();
}

TEST(ImplicitEuler, IsStableAtStiffness1e12) {
  for (const double dt : {1e-5, 1e-3, 1e-1}) {
    for (const double stiffness : {1.0, 1e4, 1e8, 1e12}) {
      double energy = 0, stretch = 0, momentum = 0;
      tumble(Integrator::kImplicitEuler, stiffness, dt, 100, &energy, &stretch, &momentum);
      EXPECT_LE(energy, 1 + 1e-6) << stiffness << ' ' << dt;
      EXPECT_LT(stretch, stiffness > 1 ? 0.02 : 2) << stiffness << ' ' << dt;
    }
  }
}

TEST(Integrators, InternalForcesKeepMomentum) {
  for (const Integrator method : kAll) {
    double energy = 0, stretch = 0, momentum = 0;
    tumble(method, 0.1, 1e-3, 200, &energy, &stretch, &momentum);
    EXPECT_LT(momentum, 1e-9) << name_of(method);
  }
}

TEST(Integrators, HeldPointsGoWhereTheHandGoes) {
  for (const Integrator method : kAll) {
    Oscillator o(40, 0.1);
    o.points.held[0] = 1;
    o.points.velocity[0] = Vector3(0, 2, 0);
    o.step(method, 0.01);
    EXPECT_EQ(o.points.position[0], Vector3(0, 0.02, 0)) << name_of(method);
    EXPECT_EQ(o.points.velocity[0], Vector3(0, 2, 0)) << name_of(method);
    EXPECT_LT(o.points.velocity[1].x(), 0) << name_of(method);
  }
}

TEST(Integrators, GravityAndDragActOnFreePoints) {
  for (const Integrator method : kAll) {
    Points points, next;
    points.set(0, Vector3::Zero(), 2);
    Load load;
    load.gravity = Vector3(0, 0, -10);
    load.drag = 5;
    IntegratorOptions options;
    options.method = method;
    for (int i = 0; i < 2000; ++i) {
      integrate(points, Springs(), load, 0.01, options, &next);
      points = next;
    }
    EXPECT_NEAR(points.velocity[0].z(), -2, 1e-9) << name_of(method) << ": gravity / drag";
  }
}

}  // namespace
}  // namespace physics
