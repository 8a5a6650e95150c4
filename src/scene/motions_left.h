#pragma once
// Rigid bodies that go on after they have touched something: what they touch of walls that move pushes them, and what they touch of
// other bodies is in their way.

#include "dartsweep/deform.h"
#include "response/allowed_motion.h"
#include "scene/bodies.h"

namespace dsw {

/** What bodies of a call have touched, and the motions that this leaves them. All is a proposal: every motion is verified. */
template <int D>
class MotionsLeft {
 public:
  /** Bodies are where they begin their motions. */
  MotionsLeft(Scene<D>& scene, const Environment<D>& env, BodyRecord<D>* const* bodies, const RigidMove<D>* motions,
              size_t count);

  /** All have gone a part of their motions. */
  void follow(const RigidMove<D>* motions, double fraction);
  /** Notes what they touch there; their own contacts are those of their next records.
   * @return whether all that walls touch can be pushed: none of it stands. */
  bool note(const Array<dsw_wall_contact>& walls);
  /** Finds motions for the largest share, at most `share`, of what is left of all ways that pairs can tell of.
   * @param next where the environment's points go on the whole of what is left. */
  double propose(double share, const double* next, Array<RigidMove<D>>& motions) const;
  /** The motion from where a body is to where it should be. */
  PlainMotion left(size_t i) const noexcept;
  /** The place of a vertex at the end of the call's motion. */
  const double* target(size_t i, uint32_t v) const noexcept { return &targets_[i][D * size_t{v}]; }

 private:
  /** A part of a body, and what it has touched of the environment or of a body. */
  struct Pair {
    Simplex part, other_part;
    uint32_t other = kNone;  // the slot of the body; kNone: the environment
    uint32_t corners[3] = {kNone, kNone, kNone}, count = 0;
    Vec normal;  // from the other to the part, when it was touched
  };
  void add(size_t i, const Pair& pair);
  void add_plane(const Body<D>& body, const Pair& pair, double share, const double* next,
                 TouchedPlanes<D>& planes) const;
  Allowed propose_one(size_t i, double share, const double* next, PlainMotion* motion) const;

  Scene<D>& scene_;
  const Environment<D>& env_;
  BodyRecord<D>* const* bodies_;
  size_t count_;
  Array<RigidMotion<D>> ends_, made_;
  Array<Array<double>> targets_;
  Array<Array<Pair>> pairs_;
};

}  // namespace dsw
