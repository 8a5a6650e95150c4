#pragma once
// A rigid body that is in the way of a wall moves as a whole [JCD10] 5.1: "for rigid objects the vertices of the
// colliding edges are moved to a correct position". One point of it has to go some way; of the rigid motions that do
// this we try a few, each verified as it is.

#include "base/vec.h"
#include "sweep/star.h"
#include "walls/neighbourhood.h"
#include "walls/wall_sweep.h"

namespace dsw {

/** How far a wall that goes a way pushes what it touches. A thick body goes a little farther, so that rounding does not
 * bring it too near. */
inline Vec push_way(const Vec& way, double radius) {
  return radius > 0 ? Vec(way + 0x1p-30 * radius * unit(way)) : way;
}

/** Rigid motions that take a point of a body, whose shape is kept, at least as far along a normal
 * as `way` leads. The first is the least one: a push along the normal of a free body, whose
 * vertices have equal masses, turns it as well. Then half of that turn and for the rest the way
 * itself, a quarter, and no turn. */
template <int D>
class RigidPushes {
 public:
  static constexpr int kCount = 4;
  RigidPushes(const Body<D>& body, const double* at, const Vec& normal, const Vec& way);

  /** Where the shape is after motion number k; false if that is the one without a turn, and not
   * the last. */
  bool get(int k, RigidMotion<D>& moved) const noexcept;

 private:
  RigidMotion<D> now_;
  Vec arm_, normal_, way_;   // arm: from the centre to the point
  Vec spin_, shift_;         // of the least motion: rotation vector, and way of the centre
  double depth_, turn_ = 0;  // turn: the part of the least motion that is tried first, 0 if there is none
};

/** Pushes rigid bodies before single vertices of a wall. */
template <int D>
class RigidPush {
 public:
  RigidPush(const Environment<D>& env, Occupants<D>& all, Neighbourhood<D>& around);

  /** Moves the body that is hit so that the walls at the vertex do not touch it on their way;
   * false, and the body where it was, if none of the motions is free at the body's level. Throws
   * std::bad_alloc, and NON_FINITE for a point of a cell that it may enter. */
  bool push(const WallHit& hit, const WallSweep<D>& walls, StarSweep<D>& sweeps, const double* from, const double* to);

  uint64_t memory_bytes() const noexcept { return array_bytes(before_) + array_bytes(targets_); }

 private:
  bool go(uint32_t owner, StarSweep<D>& sweeps);
  bool is_clear(uint32_t owner, const WallSweep<D>& walls, const double* from, const double* to) const;
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
