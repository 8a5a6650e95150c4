// The rod without contacts, against beam theory.
#include "rod/rod.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rods.h"

namespace physics {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A step so long that inertia does nothing: what is left is a descent to the shape at rest.
void settle(Rod* rod, int steps, double dt = 1e3) {
  for (int i = 0; i < steps; ++i) {
    rod->rest();
    rod->step(dt, {});
    rod->accept(rod->targets(), dt);
  }
}

void clamp_last(Rod* rod) {
  rod->held[rod->size() - 1] = rod->held[rod->size() - 2] = 1;
  rod->held_turn.back() = 1;
}

// A random move of one entry of one block.
void nudge(Rod* rod, std::size_t block, int entry, double by) {
  Positions to = rod->shape.position;
  std::vector<double> turn(rod->edges.size(), 0);
  if (entry < 3) {
    to[block][entry] += by;
  } else {
    turn[block] = by;
  }
  rod->shape.advance(to, turn);
}

bool is_turn_of_no_edge(const Rod& rod, std::size_t block, int entry) { return entry == 3 && block + 1 == rod.size(); }

TEST(Rod, ForcesAreTheGradientOfTheEnergy) {
  const Rod rod = crooked_rod();
  const BlockVector force = rod.forces();
  double largest = 0;
  for (const Eigen::Vector4d& f : force) {
    largest = std::max(largest, f.norm());
  }
  for (std::size_t i = 0; i < rod.size(); ++i) {
    for (int d = 0; d < 4; ++d) {
      if (is_turn_of_no_edge(rod, i, d)) {
        continue;
      }
      constexpr double kNudge = 1e-6;
      Rod plus = rod, minus = rod;
      nudge(&plus, i, d, kNudge);
      nudge(&minus, i, d, -kNudge);
      EXPECT_NEAR(-(plus.elastic_energy() - minus.elastic_energy()) / (2 * kNudge), force[i][d], 1e-6 * largest)
          << i << ' ' << d;
    }
  }
}

TEST(Rod, StiffnessIsTheSecondDerivativeAtRest) {
  const Rod rod = curved_rod_at_rest();
  const ChainMatrix stiffness = rod.stiffness();
  double largest = 0;
  for (const ChainMatrix::Column& column : stiffness.columns) {
    largest = std::max(largest, column.diagonal.norm());
  }
  for (std::size_t i = 0; i < rod.size(); ++i) {
    for (int d = 0; d < 4; ++d) {
      if (is_turn_of_no_edge(rod, i, d)) {
        continue;
      }
      constexpr double kNudge = 1e-6;
      BlockVector unit(rod.size(), Eigen::Vector4d::Zero());
      unit[i][d] = 1;
      const BlockVector column = stiffness.times(unit);
      Rod plus = rod, minus = rod;
      nudge(&plus, i, d, kNudge);
      nudge(&minus, i, d, -kNudge);
      const BlockVector after = plus.forces(), before = minus.forces();
      for (std::size_t k = 0; k < rod.size(); ++k) {
        EXPECT_LT((column[k] + (after[k] - before[k]) / (2 * kNudge)).norm(), 1e-6 * largest)
            << i << ' ' << d << ' ' << k;
      }
    }
  }
}

// x K x is never negative, however the rod is bent, pressed and twisted.
TEST(Rod, StiffnessIsPositiveSemidefinite) {
  const Rod rod = crooked_rod();
  const ChainMatrix stiffness = rod.stiffness();
  BlockVector x(rod.size());
  for (int trial = 0; trial < 1000; ++trial) {
    double product = 0, largest = 0;
    for (Eigen::Vector4d& block : x) {
      block.setRandom();
    }
    const BlockVector force = stiffness.times(x);
    for (std::size_t i = 0; i < rod.size(); ++i) {
      product += force[i].dot(x[i]);
      largest = std::max(largest, force[i].norm());
    }
    ASSERT_GT(product, -1e-12 * largest);
  }
}

// Bisshopp and Drucker 1945: share of the length by which the tip of a cantilever sinks and comes closer. The load is
// P L^2 / EI.
TEST(Rod, ACantileverBendsAsTheElastica) {
  struct Case {
    double load, sinks, closer, tolerance;
  };
  for (const Case& c :
       {Case{1e-3, 1e-3 / 3, 0, 0.01}, Case{1, 0.30172, 0.05643, 0.01}, Case{5, 0.71379, 0.38763, 0.01}}) {
    constexpr std::size_t kEdges = 100;
    Rod rod = straight_rod(kEdges + 1, 1);
    clamp_last(&rod);
    const double length = kEdges + 0.5;  // the clamp begins in the middle of the bend at its vertex
    rod.load.front() = Vector3(0, 0, -c.load * rod.edges[0].bending / (length * length));
    const Vector3 start = rod.shape.position.front();
    settle(&rod, 60);
    const Vector3 way = rod.shape.position.front() - start;
    EXPECT_NEAR(-way.z() / length, c.sinks, c.tolerance * c.sinks) << c.load;
    EXPECT_NEAR(way.x() / length, c.closer, c.tolerance * (c.closer + c.sinks)) << c.load;
    EXPECT_NEAR(way.y(), 0, 1e-6);
  }
}

// Euler: a column that is clamped below buckles at pi^2 EI / (4 L^2).
TEST(Rod, AColumnBucklesAtEulersLoad) {
  for (const double share : {0.98, 1.02}) {
    constexpr std::size_t kEdges = 100;
    Rod rod = straight_rod(kEdges + 1, 1);
    clamp_last(&rod);
    const double length = kEdges + 0.5;
    const double critical = kPi * kPi * rod.edges[0].bending / (4 * length * length);
    rod.load.front() = Vector3(share * critical, 0, 1e-6 * critical);
    settle(&rod, 10);
    const double before = std::abs(rod.shape.position.front().z());
    rod.load.front().z() = 0;
    settle(&rod, 200);
    const double after = std::abs(rod.shape.position.front().z());
    EXPECT_EQ(after > 5 * before, share > 1) << share << ": " << before << " became " << after;
    EXPECT_EQ(after < 0.2 * before, share < 1);
  }
}

Rod twisted_rod(double turns, double unevenness) {
  constexpr std::size_t kEdges = 60;
  Rod rod = straight_rod(kEdges, 1);
  clamp_last(&rod);
  rod.held[0] = rod.held[1] = 1;
  rod.held_turn[0] = 1;
  std::vector<double> turn(kEdges, 0);
  turn.back() = 2 * kPi * turns;
  Positions to = rod.shape.position;
  for (std::size_t i = 2; i + 2 < to.size(); ++i) {
    to[i].z() = unevenness * std::sin(kPi * static_cast<double>(i) / kEdges);
  }
  rod.shape.advance(to, turn);
  return rod;
}

TEST(Rod, TwistSpreadsEvenly) {
  Rod rod = twisted_rod(3, 0);
  settle(&rod, 20);
  const double bends = static_cast<double>(rod.edges.size() - 1);
  for (std::size_t i = 1; i < rod.edges.size(); ++i) {
    EXPECT_NEAR(rod.shape.twist[i], 6 * kPi / bends, 1e-9);
    EXPECT_LT(rod.shape.position[i].tail<2>().norm(), 1e-9);
  }
}

// Greenhill 1883: a straight rod that is clamped at both ends buckles at the torque 8.987 EI / L.
TEST(Rod, ATwistedRodBucklesAtGreenhillsTorque) {
  for (const double share : {0.97, 1.03}) {
    const Rod straight = straight_rod(60, 1);
    const double bends = 59, free = 58 + 1;  // half a bend at each clamp
    const double torque = share * 8.9868 * straight.edges[0].bending / free;
    Rod rod = twisted_rod(torque / straight.edges[0].twisting * bends / (2 * kPi), 1e-3);
    settle(&rod, 40);
    const double before = rod.shape.position[30].tail<2>().norm();
    settle(&rod, 100);
    const double after = rod.shape.position[30].tail<2>().norm();
    EXPECT_EQ(after > 2 * before, share > 1) << share << ": " << before << " became " << after;
    EXPECT_EQ(after < 0.5 * before, share < 1);
  }
}

TEST(Rod, TheLengthOfASteelWireStays) {
  Rod rod = straight_rod(100, 1);
  clamp_last(&rod);
  rod.load.front() = Vector3(0, 0, 1e4);
  for (int step = 0; step < 300; ++step) {
    rod.step(1e-3, {});
    rod.accept(rod.targets(), 1e-3);
    ASSERT_LT(rod.largest_stretch(), 0.01) << step;
  }
}

// An edge that turns in a step gets longer; a second linearisation sees it.
TEST(Rod, ASecondLinearisationStretchesLess) {
  double stretch[2] = {0, 0};
  for (int linearisations = 1; linearisations <= 2; ++linearisations) {
    Rod rod = straight_rod(20, 1);
    rod.options.linearisations = linearisations;
    rod.held.back() = 1;
    for (std::size_t i = 0; i < rod.size(); ++i) {
      rod.velocity[i] = Vector3(0, 100 * (20.0 - static_cast<double>(i)), 0);  // 0.1 in a step
    }
    for (int step = 0; step < 20; ++step) {
      rod.step(1e-3, {});
      rod.accept(rod.targets(), 1e-3);
      stretch[linearisations - 1] = std::max(stretch[linearisations - 1], rod.largest_stretch());
    }
  }
  EXPECT_LT(stretch[1], 0.4 * stretch[0]) << stretch[0];
  EXPECT_LT(stretch[0], 0.01);
}

TEST(Rod, EnergyDoesNotGrow) {
  for (const double stiffer : {1e-3, 1.0, 1e3, 1e6}) {
    for (const double dt : {1e-4, 1e-3, 1e-2}) {
      Rod rod = crooked_rod();
      for (RodEdge& edge : rod.edges) {
        edge.stretching *= stiffer;
        edge.bending *= stiffer;
        edge.twisting *= stiffer;
      }
      for (std::size_t i = 0; i < rod.size(); ++i) {
        rod.velocity[i] = 100 * Vector3::Random();
      }
      const double start = rod.elastic_energy() + rod.kinetic_energy();
      double most = 0, energy = start;
      for (int step = 0; step < 400; ++step) {
        rod.step(dt, {});
        rod.accept(rod.targets(), dt);
        energy = rod.elastic_energy() + rod.kinetic_energy();
        most = std::max(most, energy);
      }
      EXPECT_LE(most, (1 + 1e-9) * start) << stiffer << ' ' << dt;
      EXPECT_LT(energy, 0.9 * start) << stiffer << ' ' << dt;
    }
  }
}

TEST(Rod, AnyStiffnessStaysFinite) {
  for (const double share : {1e-12, 1.0, 1e6, 1e12, 1e15, 1e18}) {
    Rod rod = crooked_rod();
    const double dt = 1e-3, stiffness = share * rod.edges[0].mass / (dt * dt);
    for (RodEdge& edge : rod.edges) {
      edge.stretching = edge.bending = edge.twisting = stiffness;
    }
    for (int step = 0; step < 200; ++step) {
      rod.step(dt, {});
      rod.accept(rod.targets(), dt);
    }
    for (std::size_t i = 0; i < rod.size(); ++i) {
      ASSERT_TRUE(rod.shape.position[i].allFinite() && rod.velocity[i].allFinite()) << share;
      ASSERT_LT(rod.velocity[i].norm(), 1e6) << share;
    }
  }
}

}  // namespace
}  // namespace physics
