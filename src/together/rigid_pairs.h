#pragma once
// What two bodies that turn, each on a motion of its own, touch of each other first.

#include "body/simplices.h"
#include "response/rigid_way.h"

namespace dsw {

/** Keeps its memory from call to call. Throws std::bad_alloc. */
template <int D>
class RigidPairs {
 public:
  explicit RigidPairs(const Memory* memory) : parts_{Array<Part>(memory), Array<Part>(memory)} {}

  /** Finds the first touch after time 0, or `earlier` if it is not later. */
  FirstTouch find_first(const Body<D>& a, const RigidWay<D>& way_a, const Body<D>& b, const RigidWay<D>& way_b,
                        const FirstTouch& earlier);
  /** Whether find_first has found pairs that touch at time 0. */
  bool touches_at_start() const noexcept { return touches_at_start_; }
  /** The parts of `a` and `b` that touch first. Null: none before `earlier`. */
  const Simplex* touched() const noexcept { return is_earlier_ ? touched_ : nullptr; }

 private:
  static constexpr uint32_t kSlices = RigidWay<D>::kMostPieces;
  struct Part {
    Simplex name;
    SimplexCorners<D> corners;
    Box<D> boxes[kSlices];  // of its way, by time
  };
  void collect(const Body<D>& body, const RigidWay<D>& way, const RigidWay<D>& other, Array<Part>& parts);
  bool ask(const Part& a, const RigidWay<D>& way_a, const Part& b, const RigidWay<D>& way_b);

  Array<Part> parts_[2];
  FirstTouch first_{};
  Simplex touched_[2];
  bool is_earlier_ = false, touches_at_start_ = false;
};

}  // namespace dsw
