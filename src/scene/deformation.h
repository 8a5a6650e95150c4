#pragma once
// What a scene keeps to deform its environment.

#include "topology/repair.h"
#include "walls/end_state.h"
#include "walls/wall_motion.h"

namespace dsw {

template <int D>
struct Scene;

template <int D>
struct Deformation {
  Environment<D>& env;
  Occupants<D> all;
  Partners<D> partners;  // all bodies, if they meet each other
  WallMotion<D> swept;
  EndState<D> end_state;
  WallRecord record;  // of the last call
  WallRecord next;    // of one under way

  explicit Deformation(Environment<D>& environment);
  uint64_t memory_bytes() const noexcept;
};

/** Takes a scene's environment to the points `next`. Throws std::bad_alloc and NON_FINITE: then nothing has changed. */
template <int D>
void deform(Scene<D>& scene, double* next, const WallSettings& settings);

/** Wants those cells repaired that hold something, and those at their vertices. Throws std::bad_alloc. */
void want_near(Scene<3>& scene, Repair& repair);
/** What the last deformation left names cells as they are called now; for a change of the topology. */
void renew_ids(Deformation<3>& deformation) noexcept;

}  // namespace dsw
