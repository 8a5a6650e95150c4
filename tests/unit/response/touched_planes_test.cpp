// What planes allow of a rigid motion: feasible, and by no feasible motion nearby the vertices come nearer to where they should be.
#include "response/touched_planes.h"

#include <gtest/gtest.h>

#include <random>

namespace dsw {
namespace {

template <int D>
struct Drawn {
  std::mt19937_64 random;
  Body<D> body{nullptr};

  explicit Drawn(uint64_t seed) : random(seed) {}
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec vector(double size) { return Vec(number(-size, size), number(-size, size), D == 3 ? number(-size, size) : 0); }
  Vec direction() {
    for (;;) {
      const Vec v = vector(1);
      if (length(v) > 0.1) return unit(v);
    }
  }
  void add_vertices(int count) {
    reserve(body, static_cast<size_t>(count), 0, 0);
    for (int i = 0; i < count; ++i) {
      double at[D];
      store<D>(vector(1), at);
      add_vertex(body, at, Cell{0});
    }
  }
  Twist twist(double size) {
    Twist twist;
    twist.shift = vector(size);
    twist.turn = D == 3 ? vector(size) : Vec(0, 0, number(-size, size));
    return twist;
  }
  Vec place(uint32_t v) const { return to_vec<D>(body.position(v)); }
};

struct Plane {
  Vec normal, point;
};

Vec way(const Twist& twist, const Vec& arm) { return twist.shift + twist.turn.cross(arm); }

/** The sum of the squares of what vertices miss, with the small balls of Inertia. */
template <int D>
double missed(const Drawn<D>& drawn, const Inertia<D>& inertia, const Twist& a, const Twist& b) {
  double sum = 0;
  for (uint32_t v = 0; v < drawn.body.vertices.size(); ++v) {
    const Vec arm = drawn.place(v) - inertia.middle, d = way(a, arm) - way(b, arm);
    sum += dot(d, d);
  }
  const Vec turn = (a.turn - b.turn) * inertia.size;
  return sum + 0x1p-10 * static_cast<double>(drawn.body.vertices.size()) * dot(turn, turn);
}

template <int D>
void check_allowed(uint64_t seed) {
  Drawn<D> drawn(seed);
  drawn.add_vertices(1 + static_cast<int>(drawn.number(0, 6)));
  const Inertia<D> inertia(drawn.body);
  TouchedPlanes<D> planes;
  std::vector<Plane> all(static_cast<size_t>(drawn.number(1, 6)));
  for (Plane& plane : all) {
    const auto v = static_cast<uint32_t>(drawn.number(0, 0.999) * static_cast<double>(drawn.body.vertices.size()));
    plane = {drawn.direction(), drawn.place(v)};
    planes.add(plane.normal, plane.point);
  }
  const Twist wanted = drawn.twist(1e-6);  // so small that no point bends off its way
  Twist allowed;
  const bool is_any = planes.allow(inertia, wanted, 0, &allowed);
  if (!is_any) allowed = Twist();
  const auto worst = [&](const Twist& twist) {
    double least = 0;
    for (const Plane& plane : all) {
      least = std::min(least, dot(plane.normal, way(twist, plane.point - inertia.middle)));
    }
    return least;
  };
  EXPECT_GE(worst(allowed), -1e-11) << seed;
  const double reached = missed(drawn, inertia, allowed, wanted), zero = missed(drawn, inertia, Twist(), wanted);
  EXPECT_LE(reached, zero * (1 + 1e-9)) << seed;
  for (int i = 0; i < 400; ++i) {
    Twist other = drawn.twist(1e-6);
    const double share = drawn.number(0, 1) * drawn.number(0, 1);
    other.shift = allowed.shift + share * other.shift;
    other.turn = allowed.turn + share * other.turn;
    if (worst(other) < 0) continue;
    EXPECT_GE(missed(drawn, inertia, other, wanted), reached * (1 - 1e-4) - 1e-9 * zero) << seed;
  }
}

TEST(TouchedPlanes, AllowTheNearestMotion) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    check_allowed<2>(seed);
    check_allowed<3>(seed);
  }
}

TEST(TouchedPlanes, WithoutPlanesAllIsAllowed) {
  Drawn<3> drawn(1);
  drawn.add_vertices(4);
  const Twist wanted = drawn.twist(0.1);
  Twist allowed;
  ASSERT_TRUE(TouchedPlanes<3>().allow(Inertia<3>(drawn.body), wanted, 0, &allowed));
  EXPECT_NEAR(length(wanted.shift - allowed.shift), 0, 1e-15);
  EXPECT_NEAR(length(wanted.turn - allowed.turn), 0, 1e-14);
}

TEST(TouchedPlanes, WhatPressesIntoAWallAlongItsNormalIsAllowedNothing) {
  Drawn<3> drawn(2);
  drawn.add_vertices(4);
  TouchedPlanes<3> planes;
  for (uint32_t v = 0; v < 4; ++v) planes.add(Vec(0, 0, 1), drawn.place(v));
  Twist wanted, allowed;
  wanted.shift = Vec(0, 0, -1);
  EXPECT_FALSE(planes.allow(Inertia<3>(drawn.body), wanted, 0, &allowed));
}

/** Whoever wants to stay is pushed as far as the planes go, and more where it turns along planes that turn. */
TEST(TouchedPlanes, PlanesThatComeNearerPush) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    Drawn<3> drawn(seed);
    drawn.add_vertices(4);
    const Inertia<3> inertia(drawn.body);
    TouchedPlanes<3> planes;
    const Vec up(0, 0, 1), push(drawn.number(-0.1, 0.1), 0, drawn.number(0.001, 0.1));
    const uint32_t count = seed % 2 == 0 ? 4 : 1;
    for (uint32_t v = 0; v < count; ++v) planes.add_moving(up, drawn.place(v), drawn.place(v), push, 0.01);
    Twist allowed;
    ASSERT_TRUE(planes.allow(inertia, Twist(), 0, &allowed));
    for (uint32_t v = 0; v < count; ++v) {
      const double rise = way(allowed, drawn.place(v) - inertia.middle).z();
      EXPECT_GE(rise, push.z() * (1 - 1e-9)) << seed;
      EXPECT_LE(rise, push.z() + 0.05) << seed;
    }
  }
}

TEST(TouchedPlanes, PlanesThatGoAwayDoNotPull) {
  Drawn<3> drawn(3);
  drawn.add_vertices(4);
  TouchedPlanes<3> planes;
  planes.add_moving(Vec(0, 0, 1), drawn.place(0), drawn.place(0), Vec(0, 0, -1), 0);
  Twist wanted, allowed;
  wanted.shift = Vec(0, 0, -0.5);
  ASSERT_TRUE(planes.allow(Inertia<3>(drawn.body), wanted, 0, &allowed));
  EXPECT_NEAR(length(wanted.shift - allowed.shift), 0, 1e-15);
}

}  // namespace
}  // namespace dsw
