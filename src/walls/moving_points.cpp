#include "walls/moving_points.h"

#include <algorithm>

#include "base/error.h"
#include "base/slot_pool.h"
#include "environment/moving.h"

namespace dsw {

template <int D>
MovingPoints<D>::MovingPoints(Environment<D>& env) : env_(env) {}

template <int D>
void MovingPoints<D>::begin(double* next) {
  place_.resize(env_.map.vertex_count, kUntouched);
  start_ = env_.points;
  had_moved_ = env_.has_moved();
  version_ = env_.obstacle_version;
  next_ = next;
  env_.points = next;
  env_.note_move();
  env_.checked.close_all();
}

template <int D>
void MovingPoints<D>::finish() noexcept {
  next_ = nullptr;
  for (const uint32_t v : touched_) place_[v] = kUntouched;
  touched_.clear();
  targets_.clear();
  env_.note_move();
  release_owned_points(env_);
  env_.checked.forget_all();
}

template <int D>
void MovingPoints<D>::take_back() noexcept {
  if (next_ == nullptr) return;
  for (size_t i = 0; i < touched_.size(); ++i) {
    std::copy_n(&targets_[D * i], D, next_ + size_t{D} * touched_[i]);
    place_[touched_[i]] = kUntouched;
  }
  touched_.clear();
  targets_.clear();
  next_ = nullptr;
  env_.points = start_;
  env_.note_move();
  env_.give_back_version(version_);
  env_.checked.forget_all();
  env_.set_moved(had_moved_);
}

template <int D>
void MovingPoints<D>::touch(uint32_t v, double fraction) {
  if (is_touched(v)) return;
  const double* const target = next_ + size_t{D} * v;
  if (!is_finite<D>(target)) fail_non_finite({next_, D}, v, D, {"next", true});
  reserve_more(touched_, 1);
  targets_.insert(targets_.end(), target, target + D);
  place_[v] = static_cast<uint32_t>(touched_.size());
  touched_.push_back(v);
  double position[D];
  at(v, fraction, position);
  put(v, position);
}

template <int D>
void MovingPoints<D>::at(uint32_t v, double fraction, double* out) const noexcept {
  point_on_way<D>(start_ + size_t{D} * v, &targets_[size_t{D} * place_[v]], fraction, out);
}

template <int D>
void MovingPoints<D>::put(uint32_t v, const double* position) noexcept {
  std::copy_n(position, D, next_ + size_t{D} * v);
  env_.note_move();
}

template <int D>
void MovingPoints<D>::shorten(double fraction) noexcept {
  for (uint32_t v = 0; v < env_.map.vertex_count; ++v) {
    double* const to = next_ + size_t{D} * v;
    if (!is_touched(v)) point_on_way<D>(start_ + size_t{D} * v, to, fraction, to);
  }
}

template class MovingPoints<2>;
template class MovingPoints<3>;

}  // namespace dsw
