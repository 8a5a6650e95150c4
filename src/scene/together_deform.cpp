#include "scene/together_deform.h"

#include <algorithm>

#include "base/dimensions.h"
#include "motion/halving.h"
#include "motion/place_on_way.h"
#include "scene/deform_call.h"
#include "scene/scene.h"
#include "together/moving_walls.h"
#include "together/settings.h"
#include "together/shortened_ways.h"
#include "together/whole_ways.h"

namespace dsw {
namespace {

template <int D>
class Call : DeformCall<D> {
  using Base = DeformCall<D>;
  using Base::env, Base::points, Base::record, Base::scene;

 public:
  Call(Scene<D>& of, double* next, const TogetherSettings& settings)
      : Base(of, next), ways_(env), shortened_(env, ways_.walls, ways_.bodies, ways_.thick), settings_(settings) {}

  void gather(BodyRecord<D>* const* bodies, size_t count, PointArray targets);
  void run();
  void keep_results(BodyRecord<D>* const* bodies, size_t count, size_t point_room);

 private:
  uint64_t most_work() const noexcept;
  bool try_way();
  void shorten_each();
  void forget_touches();
  bool arrive(double time);
  void shorten(double way);

  WholeWays<D, MovingWalls<D>> ways_;
  ShortenedWays<D, MovingWalls<D>> shortened_;
  double touch_time_ = 1;  // of the first touch on the way that is tried
  TogetherSettings settings_;
  Array<Trajectory<D>> trajectories_{scene.memory};
  Array<PointArray> targets_{scene.memory};          // of the trajectories, for the whole way
  Array<Array<double>> near_targets_{scene.memory};  // the same for a shorter way
};

template <int D>
void Call<D>::gather(BodyRecord<D>* const* bodies, size_t count, PointArray targets) {
  size_t first = 0;
  for (size_t i = 0; i < count; ++i) {
    BodyRecord<D>& of = *bodies[i];
    of.next.clear();
    trajectories_.push_back(this->trajectory(of, {targets.data + first * targets.step, targets.step}, &of.next));
    trajectories_.back().is_led = settings_.response != TogetherResponse::kStop;
    first += of.body.vertices.size();
  }
  this->add_still(bodies, count, trajectories_);
  for (const Trajectory<D>& of : trajectories_) targets_.push_back(of.motion.targets);
}

/** That of all vertices, in all halvings together. */
template <int D>
uint64_t Call<D>::most_work() const noexcept {
  uint64_t vertices = 0;
  for (const Trajectory<D>& of : trajectories_) vertices += of.motion.body->vertices.size();
  return 1000 * uint64_t{settings_.kilo_products} * vertices;
}

/** Tries the whole way. While a cell on it does not stay valid, halves the way. */
template <int D>
void Call<D>::run() {
  Array<dsw_volume_id> invalid(scene.memory);
  record.clear();
  try {
    ways_.set_most_work(most_work());
    Halving halving;
    bool has_gone = try_way();
    while (!has_gone && halving.next()) {
      invalid.swap(record.invalid);
      record.invalid.clear();
      shorten(halving.way);
      has_gone = try_way();
    }
    if (has_gone) {
      record.invalid.swap(invalid);
      record.fraction = halving.way * ways_.time();
      touch_time_ *= halving.way;
      this->keep_contacts(ways_.walls.contacts);
      if (record.fraction != 0) ways_.walls.held.add_held(record.held);
    } else {
      forget_touches();
      record.fraction = 0;
    }
    for (Trajectory<D>& of : trajectories_) of.record->fraction = has_gone ? touch_time_ : 0;
  } catch (const WorkOver&) {
    forget_touches();
    record.clear();
    record.fraction = 0;
    record.outcome = DSW_DEFORM_LIMITED;
    for (Trajectory<D>& of : trajectories_) of.record->fraction = 0;
    this->take_back(trajectories_);
    return;
  } catch (...) {
    this->take_back(trajectories_);
    throw;
  }
  this->keep_outcome();
  if (record.fraction == 0) this->take_back(trajectories_);
}

template <int D>
void Call<D>::forget_touches() {
  for (Trajectory<D>& of : trajectories_) of.record->clear();
}

/** Goes up to the first touch, or each part up to its own, if all cells that are met stay valid. */
template <int D>
bool Call<D>::try_way() {
  forget_touches();
  ways_.walls.begin(points, record.invalid);
  ways_.start(trajectories_, scene.features.contacts && !trajectories_.empty());
  if (!ways_.walls.stay_valid()) return false;
  if (settings_.stop == TogetherStop::kFeature) {
    shorten_each();
    if (!ways_.walls.stay_valid()) return false;
  } else {
    if (ways_.find_touches(trajectories_)) ways_.stop(trajectories_);
    touch_time_ = ways_.time();
  }
  return ways_.time() == 0 || arrive(ways_.time());
}

/** Shortens the way of each part that touches. If the rounds are over before all is free, all ways end together. */
template <int D>
void Call<D>::shorten_each() {
  ways_.set_ends(trajectories_, 1);
  const auto end = shortened_.run(trajectories_, settings_, false);
  touch_time_ = shortened_.first_time();
  if (end == ShortenedWays<D, MovingWalls<D>>::End::kFree) return;
  ways_.walls.held.look_at_all();
  for (Trajectory<D>& of : trajectories_) std::fill(of.is_new.begin(), of.is_new.end(), uint8_t{1});
  if (!ways_.find_touches(trajectories_)) return;
  forget_touches();  // what stopped single parts is not what stops them all
  ways_.walls.contacts.clear();
  ways_.stop(trajectories_);
  touch_time_ = std::min(touch_time_, ways_.time());
}

/** All goes to the ends of its way; false if that does not lead into valid cells, and then nothing has gone. */
template <int D>
bool Call<D>::arrive(double time) {
  if (time != 1) points.shorten_further(time, place_on_way<D>);
  points.read_next();
  if ((time != 1 && !ways_.walls.stayed_valid(points.starts())) ||
      !ways_.walls.find_arrivals(trajectories_, points.starts())) {
    points.read_start();
    return false;
  }
  ways_.arrive(trajectories_);
  return true;
}

/** Lets all ways end at a part of what the host wants. */
template <int D>
void Call<D>::shorten(double way) {
  points.shorten(way, place_on_way<D>);
  near_targets_.clear();
  for (size_t t = 0; t < trajectories_.size(); ++t) {
    Trajectory<D>& of = trajectories_[t];
    const Body<D>& body = *of.motion.body;
    Array<double>& near = near_targets_.emplace_back(D * body.vertices.size(), 0.0, scene.memory);
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (body.has_vertex(v)) place_on_way<D>(body.position(v), targets_[t][v], way, &near[size_t{D} * v]);
    }
    of.motion.targets = {near.data(), D};
  }
}

template <int D>
void Call<D>::keep_results(BodyRecord<D>* const* bodies, size_t count, size_t point_room) {
  this->keep_points(point_room);
  // Who stopped is told by the targets of the call, also if the way was shortened.
  for (size_t t = 0; t < trajectories_.size(); ++t) trajectories_[t].motion.targets = targets_[t];
  if (!trajectories_.empty()) ways_.finish(trajectories_);
  for (Trajectory<D>& of : trajectories_) {
    if (record.outcome == DSW_DEFORM_LIMITED) of.record->limited = of.record->stopped;
  }
  this->finish(bodies, count, trajectories_);
}

}  // namespace

template <int D>
void deform_together(Scene<D>& scene, double* next, size_t point_room, BodyRecord<D>* const* bodies, size_t count,
                     PointArray targets, const TogetherSettings& settings) {
  Call<D> call(scene, next, settings);
  call.gather(bodies, count, targets);
  call.run();
  call.keep_results(bodies, count, point_room);
}

DSW_INSTANTIATE(deform_together);

}  // namespace dsw
