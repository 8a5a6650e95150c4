#pragma once
// A rigid body that is in the way of a wall moves as a whole [JCD10] 5.1: "for rigid objects the vertices of the
// colliding edges are moved to a correct position". One point of it has to go some way; of the rigid motions that do
// this we try a few, each verified as it is.

#include "base/vec.h"
#include "sweep/star.h"
#include "walls/neighbourhood.h"
#include "walls/wall_sweep.h"

namespace dsw {

/** The way that takes what a wall touches out of the wall's way: as far as the touched point of the wall still goes,
 * and a little out of the wall, for rounding: 2^-31 of the vertex's way, 2^-30 of the radius of a thick body, and two
 * units in the last place. After `pushes` that have not been enough the units are more. */
template <int D>
Vec way_out(const WallHit& touch, const double* from, const double* to, double radius, int pushes) noexcept;

/** Rigid motions that take a point of a body, whose shape is kept, at least as far along a normal
 * as `way` leads; if it `sticks` they take it just that way. The first has no turn. The second is the least one: a push along
 * the normal of a free body, whose vertices have equal masses, turns it as well. Then half of that turn and for the rest the way
 * itself, and a quarter. */
template <int D>
class RigidPushes {
 public:
  static constexpr int kCount = 4;
  RigidPushes(const Body<D>& body, const double* at, const Vec& normal, const Vec& way, bool sticks);

  /** Where the shape is after motion number k; false if that has no turn, and is not the first. */
  bool get(int k, RigidMotion<D>& moved) const noexcept;

 private:
  RigidMotion<D> now_;
  Vec arm_, normal_, way_;   // arm: from the centre to the point
  Vec spin_, shift_;         // of the least motion: rotation vector, and way of the centre
  double depth_, turn_ = 0;  // turn: the part of the least motion that is tried first, 0 if there is none
  bool sticks_;
};

/** Pushes rigid bodies before single vertices of a wall. */
template <int D>
class RigidPush {
 public:
  RigidPush(const Environment<D>& env, Occupants<D>& all, Neighbourhood<D>& around);

  /** Moves the body that is hit so that the walls at the vertex do not touch it on their way. Where one push leaves
   * another part of the body in the way, it is pushed there as well. False, and the body where it was, if none of the
   * motions is free at the body's level. Throws std::bad_alloc, and NON_FINITE for a point of a cell that it may
   * enter. */
  bool push(const WallHit& hit, const WallSweep<D>& walls, StarSweep<D>& sweeps, const double* from, const double* to);

  uint64_t memory_bytes() const noexcept { return array_bytes(before_) + array_bytes(targets_); }

 private:
  bool go(uint32_t owner, StarSweep<D>& sweeps);
  bool go_out(const WallHit& first, int kind, const WallSweep<D>& walls, StarSweep<D>& sweeps, const double* from,
              const double* to);
  bool find_first(uint32_t owner, const WallSweep<D>& walls, const double* from, const double* to,
                  WallHit* first) const;
  bool open_ways(uint32_t owner);

  const Environment<D>& env_;
  Occupants<D>& all_;
  Neighbourhood<D>& around_;
  Array<BodyVertex<D>> before_{env_.memory};
  Array<double> targets_{env_.memory};
};

/** Where a motion takes all vertices of a body from its rest places; false if one would be no
 * number. */
template <int D>
bool find_places(const Body<D>& body, const RigidMotion<D>& moved, Array<double>& places);

}  // namespace dsw
