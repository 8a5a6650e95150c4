#pragma once
// The points of an environment on their way from one array of the host's to the next.

#include "base/points.h"
#include "motion/points_way.h"

namespace dsw {

/** Points near bodies are taken along their ways step by step. All others are at the end at once: nobody looks at them
 * on the way. */
template <int D>
class MovingPoints {
 public:
  explicit MovingPoints(Environment<D>& env);

  /** From the environment's present points to those in `next`, which the environment reads, and this writes, from now
   * on. Throws std::bad_alloc. */
  void begin(double* next);
  /** Makes `next` the environment's points, as they are now. */
  void finish() noexcept;
  /** Puts everything back: also `next`. Nothing if nothing has begun. */
  void take_back() noexcept;

  bool is_touched(uint32_t v) const noexcept { return place_[v] != kUntouched; }
  /** Puts a vertex that is not touched to where it is at a fraction of the way, from where on it is moved by hand.
   * Throws std::bad_alloc, and NON_FINITE for a target that is not. */
  void touch(uint32_t v, double fraction);
  const Array<uint32_t>& touched() const noexcept { return touched_; }
  /** Place of a touched vertex in that. */
  uint32_t place(uint32_t v) const noexcept { return place_[v]; }
  /** Where a touched vertex is at a fraction of the way. */
  void at(uint32_t v, double fraction, double* out) const noexcept;
  /** Where the way of a vertex begins, and where it ends. */
  const double* start(uint32_t v) const noexcept { return way_.start(v); }
  const double* target(uint32_t v) const noexcept { return is_touched(v) ? targets_[place_[v]].at : way_.next(v); }
  void put(uint32_t v, const double* position) noexcept;
  /** Puts all that are not touched to where they are at a fraction of the way. O(points). */
  void shorten(double fraction) noexcept;

  uint64_t memory_bytes() const noexcept { return array_bytes(place_) + array_bytes(touched_) + array_bytes(targets_); }

 private:
  static constexpr uint32_t kUntouched = 0xffffffffu;
  struct Target {
    double at[D];
  };

  Environment<D>& env_;
  PointsWay<D> way_;
  Array<uint32_t> place_{env_.memory};  // by vertex: its place in touched_
  Array<uint32_t> touched_{env_.memory};
  Array<Target> targets_{env_.memory};  // of those
};

}  // namespace dsw
