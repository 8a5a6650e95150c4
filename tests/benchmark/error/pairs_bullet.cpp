// Bullet's casts of convex shapes. Those by which it casts rays get what its rays are: a sphere of radius 0, no
// margins. Its continuous test of convex shapes works on distances and wants a margin: a sphere that is not quite a
// point. It knows no edge of which one end moves.
#include "pairs.h"

#include "../bullet_casts.h"

#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace dsw::curves {

namespace {

enum class Caster { kSubsimplex, kGjk, kContinuous };

Vec to_vec(const btVector3& p) { return {p.x(), p.y(), p.z()}; }

/** @param dial the epsilon of kSubsimplex, the radius of kContinuous. */
PairAnswer cast(const Pair& pair, Caster caster, btScalar dial) {
  const btScalar radius = caster == Caster::kContinuous ? dial : 0;
  btSphereShape point(radius);
  point.setMargin(radius);
  btTriangleShape triangle(bench::to_bullet(pair.corners[0].data()), bench::to_bullet(pair.corners[1].data()),
                           bench::to_bullet(pair.corners[2].data()));
  triangle.setMargin(0);
  btTransform from, to, rest;
  from.setIdentity();
  to.setIdentity();
  rest.setIdentity();
  from.setOrigin(bench::to_bullet(pair.from.data()));
  to.setOrigin(bench::to_bullet(pair.to.data()));
  btVoronoiSimplexSolver simplex;
  btConvexCast::CastResult result;
  result.m_fraction = 1;
  bool hit = false;
  if (caster == Caster::kSubsimplex) {
    result.m_subSimplexCastEpsilon = dial;
    btSubsimplexConvexCast convex(&point, &triangle, &simplex);
    hit = convex.calcTimeOfImpact(from, to, rest, rest, result);
  } else if (caster == Caster::kGjk) {
    btGjkConvexCast convex(&point, &triangle, &simplex);
    hit = convex.calcTimeOfImpact(from, to, rest, rest, result);
  } else {
    btGjkEpaPenetrationDepthSolver depth;
    btContinuousConvexCollision convex(&point, &triangle, &simplex, &depth);
    hit = convex.calcTimeOfImpact(from, to, rest, rest, result);
  }
  if (!hit) return {};
  return {static_cast<double>(result.m_fraction), true, to_vec(result.m_hitPoint), to_vec(result.m_normal)};
}

PairAnswer ray(const Pair& pair) {
  const btVector3 from = bench::to_bullet(pair.from.data()), to = bench::to_bullet(pair.to.data());
  btVector3 corners[3];
  for (std::size_t k = 0; k < 3; ++k) corners[k] = bench::to_bullet(pair.corners[k].data());
  bench::FirstHit hit(from, to);
  hit.processTriangle(corners, 0, 0);
  return {hit.triangle < 0 ? -1 : static_cast<double>(hit.m_hitFraction), false, {}, {}};
}

}  // namespace

void add_bullet(PairMethods& methods) {
  if (methods.pairs().kind != PairKind::kVertexFace) return;
  for (const double setting : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const auto epsilon = static_cast<btScalar>(setting);
    methods.add("Bullet subsimplex cast", text("%g", setting), "epsilon",
                [epsilon](const Pair& pair) { return cast(pair, Caster::kSubsimplex, epsilon); });
  }
  for (const double setting : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 0.0}) {
    const auto radius = static_cast<btScalar>(setting);
    methods.add("Bullet continuous convex", text("%g", setting), "radius, cells",
                [radius](const Pair& pair) { return cast(pair, Caster::kContinuous, radius); });
  }
  methods.add("Bullet GJK cast", "", "", [](const Pair& pair) { return cast(pair, Caster::kGjk, 0); });
  methods.add("Bullet ray and triangle", "", "", ray);
}

}  // namespace dsw::curves
