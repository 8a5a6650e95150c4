#pragma once
// The points of an environment on their way from one array of the host's to the next.

#include "environment/environment.h"

namespace dsw {

/** The environment reads one of the two arrays; the other is left alone or written here. */
template <int D>
class PointsWay {
 public:
  explicit PointsWay(Environment<D>& env) : env_(env), targets_(env.memory) {}

  /** From the environment's present points to those in `next`, which is written from now on. It is not read yet. */
  void begin(double* next) noexcept {
    start_ = env_.points;
    had_moved_ = env_.has_moved();
    version_ = env_.obstacle_version;
    next_ = next;
    targets_.clear();
  }
  bool has_begun() const noexcept { return next_ != nullptr; }
  const double* start(uint32_t v) const noexcept { return start_ + size_t{D} * v; }
  double* next(uint32_t v) const noexcept { return next_ + size_t{D} * v; }
  const double* starts() const noexcept { return start_; }
  double* nexts() const noexcept { return next_; }

  void read_next() noexcept { read(next_); }
  /** The environment has not moved, and what was known of its obstacles still holds. `next` may have changed. */
  void read_start() noexcept {
    if (env_.points != start_) {
      read(start_);
      env_.give_back_version(version_);
    }
    env_.set_moved(had_moved_);
  }
  void finish() noexcept { next_ = nullptr; }
  /** Puts all of `next` where they are at a part of the way: calls place(start, target, way, out) for each. What the host wrote
   * there is kept. Throws std::bad_alloc. */
  template <class Place>
  void shorten(double way, Place place) {
    keep_targets();
    for (size_t i = 0; i < targets_.size(); i += D) place(start_ + i, &targets_[i], way, next_ + i);
  }
  /** Puts all of `next` where they are at a part of the way to where they are now. */
  template <class Place>
  void shorten_further(double way, Place place) {
    keep_targets();
    for (size_t i = 0; i < targets_.size(); i += D) place(start_ + i, next_ + i, way, next_ + i);
  }
  void keep_targets() {
    if (targets_.empty()) targets_.assign(next_, next_ + D * size_t{env_.map.vertex_count});
  }
  /** `next` is what the host wrote there. */
  void restore_targets() noexcept { std::copy(targets_.begin(), targets_.end(), next_); }

 private:
  void read(const double* points) noexcept {
    env_.points = points;
    env_.note_move();
    env_.checked.forget_all();
  }

  Environment<D>& env_;
  const double* start_ = nullptr;
  double* next_ = nullptr;
  bool had_moved_ = false;  // before
  uint64_t version_ = 0;    // of the environment before
  Array<double> targets_;   // all of them, if a part of the way has been tried
};

}  // namespace dsw
