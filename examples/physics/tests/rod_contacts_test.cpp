// The rod with contacts, against Coulomb's law.
#include "rod/rod_contacts.h"

#include <gtest/gtest.h>

#include "rod/rod_system.h"
#include "rods.h"

namespace physics {
namespace {

constexpr double kContactStep = 1e-3, kEarthGravity = 9810;

// A plane through the origin under every vertex.
NearRows rows_on_plane(const Rod& rod, const Vector3& normal, const NearRows& before) {
  NearRows rows;
  for (std::uint32_t i = 0; i < rod.size(); ++i) {
    NearRow row;
    row.vertices[0] = i;
    row.normal = normal;
    row.gap = rod.shape.position[i].dot(normal);
    row.previous = before.empty() ? kNoRow : i;
    rows.push_back(row);
  }
  return rows;
}

void load_with_weight(Rod* rod, const Vector3& gravity) {
  const double mass = rod->edges[0].mass;
  for (std::size_t i = 0; i < rod->size(); ++i) {
    rod->load[i] = (i == 0 || i + 1 == rod->size() ? 0.5 : 1) * mass * gravity;
  }
}

Vector3 total(const Positions& impulses) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& impulse : impulses) {
    sum += impulse;
  }
  return sum;
}

// One second or so on a plane that is `slope` steep; returns the velocity of the middle.
Vector3 slide(Rod* rod, const Vector3& normal, double friction, int steps, NearRows* rows) {
  rod->options.contact.friction = friction;
  rod->options.contact.tolerance = 1e-9;
  rod->options.contact.most_sweeps = 200;
  for (int step = 0; step < steps; ++step) {
    *rows = rows_on_plane(*rod, normal, *rows);
    rod->step(kContactStep, *rows);
    rod->accept(rod->targets(), kContactStep);
  }
  return rod->velocity[rod->size() / 2];
}

TEST(RodContacts, APlaneCarriesTheWeight) {
  Rod rod = straight_rod(20, 1);
  for (Vector3& at : rod.shape.position) {
    at.z() = 0.5;
  }
  load_with_weight(&rod, Vector3(0, 0, -kEarthGravity));
  NearRows rows;
  const Vector3 velocity = slide(&rod, Vector3::UnitZ(), 0.1, 300, &rows);
  EXPECT_LT(velocity.norm(), 1e-6);
  const double weight = 20 * kEarthGravity * kContactStep;
  const Vector3 impulse = total(rod.contacts().impulses());
  EXPECT_NEAR(impulse.z(), weight, 1e-6 * weight);
  EXPECT_LT(impulse.head<2>().norm(), 1e-6 * weight);
  for (const Vector3& at : rod.shape.position) {
    EXPECT_GT(at.z(), -1e-8);
    EXPECT_LT(at.z(), 1e-6);
  }
}

// The rod lies along the slope, across it, and in between.
TEST(RodContacts, FrictionHoldsBelowItsAngleAndBrakesAboveIt) {
  constexpr double kFriction = 0.3;
  const double angle = 0.4;
  const Vector3 normal(-std::sin(angle), 0, std::cos(angle));
  const Vector3 down(-std::cos(angle), 0, -std::sin(angle)), level = Vector3::UnitY();
  const Vector3 gravity(0, 0, -kEarthGravity);
  for (const double turn : {0.0, 0.7, 1.5708}) {
    Rod rod = straight_rod(12, 1);
    const Vector3 along = std::cos(turn) * down + std::sin(turn) * level;
    Positions line = rod.shape.position;
    for (std::size_t i = 0; i < line.size(); ++i) {
      line[i] = static_cast<double>(i) * along;
    }
    rod = Rod(line, rod.edges);
    load_with_weight(&rod, gravity);
    NearRows rows;
    Rod stuck = rod;
    EXPECT_LT(slide(&stuck, normal, 1.05 * std::tan(angle), 100, &rows).norm(), 1e-5);
    EXPECT_LT((stuck.shape.position[6] - line[6]).norm(), 1e-5);
    rows.clear();
    const Vector3 velocity = slide(&rod, normal, kFriction, 100, &rows);
    const double expected = kEarthGravity * (std::sin(angle) - kFriction * std::cos(angle)) * 0.1;
    EXPECT_LT((velocity - expected * down).norm(), 1e-3 * expected) << turn;
  }
}

TEST(RodContacts, ASlidingRodStopsWhereCoulombSays) {
  for (const double turn : {0.0, 0.5, 1.0}) {
    Rod rod = straight_rod(12, 1);
    load_with_weight(&rod, Vector3(0, 0, -kEarthGravity));
    const double speed = 500, friction = 0.2;
    std::fill(rod.velocity.begin(), rod.velocity.end(), speed * Vector3(std::cos(turn), std::sin(turn), 0));
    const Vector3 start = rod.shape.position[6];
    NearRows rows;
    EXPECT_LT(slide(&rod, Vector3::UnitZ(), friction, 400, &rows).norm(), 1e-6);
    const double way = speed * speed / (2 * friction * kEarthGravity);
    // Implicit Euler makes half a step less.
    EXPECT_NEAR((rod.shape.position[6] - start).norm(), way, speed * kContactStep) << turn;
  }
}

// Signorini and Coulomb hold at every row of a crooked rod between two planes, with rows on vertices and in edges.
TEST(RodContacts, ImpulsesAndVelocitiesComplementEachOther) {
  Rod rod = crooked_rod();
  rod.held.back() = 1;
  rod.velocity.back() = Vector3(20, 0, -30);
  NearRows rows;
  for (std::uint32_t i = 0; i < rod.size(); ++i) {
    NearRow row;
    row.vertices[0] = i;
    if (i % 2 == 1 && i + 1 < rod.size()) {
      row.count = 2;
      row.vertices[1] = i + 1;
      row.weights[0] = 0.3;
      row.weights[1] = 0.7;
    }
    row.normal = (i % 3 == 0 ? Vector3(0.1, 0, -1) : Vector3(0, 0.2, 1)).normalized();
    row.gap = 0.002 * i;
    row.obstacle_velocity = Vector3(1, 2, 3);
    rows.push_back(row);
  }
  std::fill(rod.load.begin(), rod.load.end(), Vector3(3e6, 0, -3e6));
  rod.options.contact = {0.4, 0.2, 4000, 1e-12};
  const RodContactReport report = rod.step(kContactStep, rows);
  EXPECT_LT(report.last_change, 1e-8);
  EXPECT_GT(report.pressing, 2u);
  EXPECT_LT(report.pressing, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Vector3 velocity = -rows[i].obstacle_velocity;
    for (std::uint32_t k = 0; k < rows[i].count; ++k) {
      velocity += rows[i].weights[k] * rod.velocity[rows[i].vertices[k]];
    }
    if (rows[i].count == 1 && rod.held[rows[i].vertices[0]] != 0) {
      continue;
    }
    const Vector3 impulse = rod.contacts().impulses()[i];
    const double push = impulse.dot(rows[i].normal), gap = rows[i].gap + kContactStep * velocity.dot(rows[i].normal);
    EXPECT_GE(push, 0);
    EXPECT_GT(gap, -1e-7);
    EXPECT_TRUE(push == 0 || gap < 1e-7) << push << ' ' << gap;
    const Vector3 rubs = impulse - push * rows[i].normal;
    const Vector3 slips = velocity - velocity.dot(rows[i].normal) * rows[i].normal;
    EXPECT_LE(rubs.norm(), 0.4 * push * (1 + 1e-9));
    EXPECT_LE(rubs.dot(slips), 1e-9);
    EXPECT_TRUE(slips.norm() < 1e-6 || rubs.norm() >= 0.4 * push * (1 - 1e-6)) << slips.norm();
  }
}

// A rod that the library stopped half way has the speed of the way that it made.
TEST(RodContacts, AStoppedRodGainsNoSpeed) {
  Rod rod = straight_rod(10, 1);
  std::fill(rod.velocity.begin(), rod.velocity.end(), Vector3(0, 0, -100));
  rod.step(kContactStep, {});
  Positions stopped = rod.targets();
  const double before = rod.kinetic_energy();
  stopped[3] = 0.5 * (stopped[3] + rod.shape.position[3]);
  stopped[4] += Vector3(10, 0, 0);  // no response does that
  rod.accept(stopped, kContactStep);
  EXPECT_NEAR(rod.velocity[3].z(), -50, 1e-6);
  EXPECT_NEAR(rod.velocity[4].norm(), 100, 1e-6);
  EXPECT_NEAR(rod.velocity[5].z(), -100, 1e-6);
  EXPECT_LT(rod.kinetic_energy(), before);
  EXPECT_EQ(rod.shape.position[3], stopped[3]);
}

// Many rows press on a stiff rod: sweeps alone are far from the end, and the direct solution is there.
TEST(RodContacts, RowsThatPressAreSolvedAtOnce) {
  double off[2];
  for (const int together : {0, 2}) {
    Rod rod = straight_rod(60, 1);
    for (RodEdge& edge : rod.edges) {
      edge.bending = 1e12;
    }
    for (std::size_t i = 0; i < rod.size(); ++i) {
      rod.shape.position[i].z() = 1e-4 * static_cast<double>(i % 3);
    }
    load_with_weight(&rod, Vector3(300, 0, -kEarthGravity));
    rod.options.contact.friction = 0.5;
    rod.options.contact.tolerance = 1e-10;
    rod.options.contact.most_sweeps = 30;
    rod.options.contact.together = together;
    NearRows rows;
    RodContactReport report;
    for (int step = 0; step < 40; ++step) {
      rows = rows_on_plane(rod, Vector3::UnitZ(), rows);
      report = rod.step(kContactStep, rows);
      rod.accept(rod.targets(), kContactStep);
    }
    off[together == 0 ? 0 : 1] = report.last_change;
    if (together != 0) {
      EXPECT_LT(report.sweeps, 30);
      EXPECT_NEAR(total(rod.contacts().impulses()).z(), 60 * kEarthGravity * kContactStep, 1e-3);
      EXPECT_LT(rod.velocity[30].norm(), 1e-6);
    }
  }
  EXPECT_LE(off[1], 1e-10);
  EXPECT_GT(off[0], off[1]);
}

// A row between rod 0 and rod 1, whose vertices `a` and `b` are above each other.
NearRow row_between(const RodSystem& system, std::uint32_t a, std::uint32_t b, double radii) {
  NearRow row;
  row.vertices[0] = a;
  row.rod = 1;
  row.rod_vertices[0] = row.rod_vertices[1] = b;
  const Vector3 way = system.rods[0].shape.position[a] - system.rods[1].shape.position[b];
  row.normal = way.normalized();
  row.gap = way.norm() - radii;
  return row;
}

TEST(RodSystem, RodsThatCrossShareTheirMomentum) {
  RodSystem system;
  system.rods = {straight_rod(10, 1), straight_rod(10, 1)};
  for (std::size_t i = 0; i <= 10; ++i) {
    system.rods[0].shape.position[i] = Vector3(5, static_cast<double>(i) - 5, 1.05);
    system.rods[0].velocity[i] = Vector3(0, 0, -100);
  }
  system.rods[0].shape.find_edges();
  for (Rod& rod : system.rods) {
    rod.options.contact.friction = 0.3;
    rod.options.contact.tolerance = 1e-9;
  }
  const auto momentum = [&] {
    Vector3 sum = Vector3::Zero();
    for (const Rod& rod : system.rods) {
      for (std::size_t i = 0; i < rod.size(); ++i) {
        sum += rod.mass[i] * rod.velocity[i];
      }
    }
    return sum;
  };
  const Vector3 before = momentum();
  std::vector<NearRows> rows(2);
  double least = 1;
  for (int step = 0; step < 50; ++step) {
    rows[0] = {row_between(system, 5, 5, 1)};
    for (Rod& rod : system.rods) {
      rod.contacts().impulses().assign(1, Vector3::Zero());
      rod.predict(kContactStep);
    }
    system.finish(kContactStep, rows);
    for (Rod& rod : system.rods) {
      rod.accept(rod.targets(), kContactStep);
    }
    least = std::min(least, (system.rods[0].shape.position[5] - system.rods[1].shape.position[5]).norm());
  }
  EXPECT_GT(least, 1 - 1e-6);
  EXPECT_LT((momentum() - before).norm(), 1e-6 * before.norm());
  EXPECT_LT(system.rods[1].velocity[5].z(), -10);
}

}  // namespace
}  // namespace physics
