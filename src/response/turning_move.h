#pragma once
// A body moved rigidly: as far as its rigid way is free.

#include "response/body_move.h"
#include "response/rigid_steps.h"
#include "response/rigid_touches.h"

namespace dsw {

/** Keeps its memory from call to call; one for each thread. */
template <int D>
class TurningMove {
 public:
  static constexpr int kMostTries = 4000;

  explicit TurningMove(const Environment<D>& env)
      : env_(env), touches_(env), way_(env.memory), here_(env.memory), reversed_(env.memory) {}

  /** Moves a body. `place` and `user` say where its vertices are at a fraction, rounded. Throws std::bad_alloc with the body
   * as it was; the record is cleared first. */
  void move(BodyMove<D>& steps, Body<D>& body, const RigidMove<D>& motion, PlaceFn place, const void* user,
            MoveOrder order, const Partners<D>* partners, MoveRecord& record);

  /** After about so many chords a body stops, free. Where it touches much, chords are short. */
  void set_most_tries(int most) noexcept { most_tries_ = most; }
  /** The chords that the last move tried. */
  int tries() const noexcept { return tries_; }

 private:
  struct Steps;
  void reverse(const Body<D>& body, MoveOrder order);
  RigidSteps<Steps> along(Steps& steps) const noexcept;
  bool go_thick(Steps& steps, double touch, double most_step);
  void approach(Steps& steps, double touch);
  bool is_at_touch(const Body<D>& body, double distance) const;
  void record_contact(Steps& steps, const Partners<D>* partners, double touch, MoveRecord& record);

  const Environment<D>& env_;
  RigidTouches<D> touches_;
  RigidWay<D> way_;
  Array<BodyVertex<D>> here_;
  Array<uint32_t> reversed_;  // the order of the call, backwards
  int most_tries_ = kMostTries, tries_ = 0;
};

}  // namespace dsw
