#pragma once
// The points of an environment on their way from one array of the host's to the next.

#include "base/points.h"
#include "base/position.h"
#include "environment/environment.h"

namespace dsw {

/** Finds the point at a fraction of the way as point_at does, and gives both ends of the way to the bit. */
template <int D>
inline void point_on_way(const double* start, const double* target, double fraction, double* out) noexcept {
  if (fraction == 0 || fraction == 1) {
    std::copy_n(fraction == 0 ? start : target, D, out);
  } else {
    point_at<D>(start, target, fraction, out);
  }
}

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
  /** Puts a vertex to where it is at a fraction of the way, from where on it is moved by hand. Throws std::bad_alloc,
   * and NON_FINITE for a target that is not. */
  void touch(uint32_t v, double fraction);
  const Array<uint32_t>& touched() const noexcept { return touched_; }
  /** Place of a touched vertex in that. */
  uint32_t place(uint32_t v) const noexcept { return place_[v]; }
  /** Where a touched vertex is at a fraction of the way. */
  void at(uint32_t v, double fraction, double* out) const noexcept;
  /** Where the way of a vertex begins, and where it ends. */
  const double* start(uint32_t v) const noexcept { return start_ + size_t{D} * v; }
  const double* target(uint32_t v) const noexcept {
    return is_touched(v) ? &targets_[size_t{D} * place_[v]] : next_ + size_t{D} * v;
  }
  void put(uint32_t v, const double* position) noexcept;
  /** Puts all that are not touched to where they are at a fraction of the way. O(points). */
  void shorten(double fraction) noexcept;

  uint64_t memory_bytes() const noexcept { return array_bytes(place_) + array_bytes(touched_) + array_bytes(targets_); }

 private:
  static constexpr uint32_t kUntouched = 0xffffffffu;

  Environment<D>& env_;
  const double* start_ = nullptr;
  bool had_moved_ = false;  // before
  uint64_t version_ = 0;    // of the environment before
  double* next_ = nullptr;
  Array<uint32_t> place_{env_.memory};  // by vertex: its place in touched_
  Array<uint32_t> touched_{env_.memory};
  Array<double> targets_{env_.memory};  // of those
};

}  // namespace dsw
