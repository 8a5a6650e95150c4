#pragma once
// What a body that turns touches first, exactly: walls, marked edges and vertices, and bodies that stand.

#include "proximity/near_lists.h"
#include "proximity/partners.h"
#include "response/rigid_way.h"

namespace dsw {

/** A part of the body, and what it enters first. */
template <int D>
struct RigidTouch {
  Simplex part{};
  // The corners of what is touched; of the environment they have names.
  const double* points[3] = {};
  uint32_t vertices[3] = {kNone, kNone, kNone};
  uint32_t count = 0;
  HalfFacet facet;  // as in WallFeature
  Cell cell;
  uint32_t partner = kNone;  // the number of the body that is touched; kNone: the environment
  Simplex other{};           // its part
};

/** Keeps its memory from call to call; one for each thread. Throws std::bad_alloc. */
template <int D>
class RigidTouches {
 public:
  explicit RigidTouches(const Environment<D>& env)
      : env_(env), lists_(env, false), vertex_boxes_(env.memory), part_boxes_(env.memory) {}

  /** Finds when the body first enters something: a wall under the shift, or another body as soon as they touch. */
  FirstTouch find_first(const Body<D>& body, const RigidWay<D>& way, const Partners<D>* partners);
  /** Whether find_first has found pairs that touch at time 0 and does not know what they do then. */
  bool is_open_at_start() const noexcept { return is_open_; }
  /** What find_first has found, if it enters anything. */
  const RigidTouch<D>& touched() const noexcept { return touched_; }

 private:
  void meet(const Body<D>& body, const RigidWay<D>& way, const RigidTouch<D>& other);
  void meet_body(const Body<D>& body, const RigidWay<D>& way, const Partners<D>& partners, uint32_t number);
  void touch(const SimplexCorners<D>& part, const RigidWay<D>& way, const RigidTouch<D>& touch);
  void ask(const TurningPair<D>& pair, const RigidTouch<D>& touch);
  void find_part_boxes(const Body<D>& body, const RigidWay<D>& way);
  uint32_t last_piece(const RigidWay<D>& way) const noexcept;

  const Environment<D>& env_;
  NearLists<D> lists_;
  Array<Box<D>> vertex_boxes_, part_boxes_;  // around the whole ways; parts in the order of for_each_simplex
  bool has_part_boxes_ = false;
  FirstTouch first_{};
  RigidTouch<D> touched_;
  bool is_open_ = false;
};

}  // namespace dsw
