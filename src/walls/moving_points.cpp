#include "walls/moving_points.h"

#include <algorithm>

#include "base/error.h"
#include "base/slot_pool.h"
#include "environment/moving.h"
#include "motion/place_on_way.h"

namespace dsw {

template <int D>
MovingPoints<D>::MovingPoints(Environment<D>& env) : env_(env), way_(env) {}

template <int D>
void MovingPoints<D>::begin(double* next) {
  place_.resize(env_.map.vertex_count, kUntouched);
  way_.begin(next);
  way_.read_next();
  env_.checked.close_all();
}

template <int D>
void MovingPoints<D>::finish() noexcept {
  way_.finish();
  for (const uint32_t v : touched_) place_[v] = kUntouched;
  touched_.clear();
  targets_.clear();
  env_.note_move();
  release_owned_points(env_);
  env_.checked.forget_all();
}

template <int D>
void MovingPoints<D>::take_back() noexcept {
  if (!way_.has_begun()) return;
  for (size_t i = 0; i < touched_.size(); ++i) {
    std::copy_n(targets_[i].at, D, way_.next(touched_[i]));
    place_[touched_[i]] = kUntouched;
  }
  touched_.clear();
  targets_.clear();
  way_.read_start();
  way_.finish();
}

template <int D>
void MovingPoints<D>::touch(uint32_t v, double fraction) {
  double* const place = way_.next(v);
  if (!is_finite<D>(place)) fail_non_finite({way_.nexts(), D}, v, D, {"next", true});
  Target target;
  std::copy_n(place, D, target.at);
  reserve_more(touched_, 1);
  targets_.push_back(target);
  place_[v] = static_cast<uint32_t>(touched_.size());
  touched_.push_back(v);
  point_on_way<D>(way_.start(v), target.at, fraction, place);
  env_.note_move();
}

template <int D>
void MovingPoints<D>::at(uint32_t v, double fraction, double* out) const noexcept {
  point_on_way<D>(way_.start(v), targets_[place_[v]].at, fraction, out);
}

template <int D>
void MovingPoints<D>::put(uint32_t v, const double* position) noexcept {
  std::copy_n(position, D, way_.next(v));
  env_.note_move();
}

template <int D>
void MovingPoints<D>::shorten(double fraction) noexcept {
  for (uint32_t v = 0; v < env_.map.vertex_count; ++v) {
    if (!is_touched(v)) point_on_way<D>(start(v), way_.next(v), fraction, way_.next(v));
  }
}

template class MovingPoints<2>;
template class MovingPoints<3>;

}  // namespace dsw
