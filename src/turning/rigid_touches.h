#pragma once
// What a body that turns touches first, exactly: walls, marked edges and vertices, and bodies that stand.

#include "proximity/near_lists.h"
#include "proximity/partners.h"
#include "turning/rigid_way.h"

namespace dsw {

/** Keeps its memory from call to call; one for each thread. Throws std::bad_alloc. */
template <int D>
class RigidTouches {
 public:
  explicit RigidTouches(const Environment<D>& env) : env_(env), lists_(env, false) {}

  /** Finds the first touch after time 0. */
  FirstTouch find_first(const Body<D>& body, const RigidWay<D>& way, const Partners<D>* partners);
  /** Whether find_first has found pairs that touch at time 0. What they do later it does not know. */
  bool touches_at_start() const noexcept { return touches_at_start_; }

 private:
  void meet(const Body<D>& body, const RigidWay<D>& way, const double* const* points, uint32_t count);
  void meet_body(const Body<D>& body, const RigidWay<D>& way, const Body<D>& other);
  void touch(const SimplexCorners<D>& part, const RigidWay<D>& way, const double* const* points, uint32_t count);
  void ask(const TurningPair<D>& pair);
  uint32_t last_piece(const RigidWay<D>& way) const noexcept;

  const Environment<D>& env_;
  NearLists<D> lists_;
  FirstTouch first_{};
  bool touches_at_start_ = false;
};

}  // namespace dsw
