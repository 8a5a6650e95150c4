#include "scene/together_deform.h"

#include <utility>

#include "base/dimensions.h"
#include "environment/moving.h"
#include "motion/halving.h"
#include "motion/place_on_way.h"
#include "motion/points_way.h"
#include "scene/deformation.h"
#include "scene/meeting.h"
#include "scene/scene.h"
#include "scene/together_moves.h"
#include "together/moving_walls.h"
#include "together/settings.h"
#include "together/shortened_ways.h"
#include "together/whole_ways.h"

namespace dsw {
namespace {

/** One call. Particles are the vertices of a body that stands still and meets no other body. */
template <int D>
class Call {
 public:
  Call(Scene<D>& scene, double* next, const TogetherSettings& settings)
      : scene_(scene),
        env_(scene.deformation.get()->env),
        record_(scene.deformation.get()->next),
        points_(env_),
        particles_(scene.memory),
        still_record_(scene.memory),
        ways_(env_),
        shortened_(env_, ways_.walls, ways_.bodies, ways_.thick),
        settings_(settings) {
    points_.begin(next);
  }

  void gather(BodyRecord<D>* const* bodies, size_t count, PointArray targets);
  void run();
  void keep_results(BodyRecord<D>* const* bodies, size_t count, size_t point_room);

 private:
  void add_body(BodyRecord<D>& of, PointArray targets, MoveRecord* record);
  uint64_t most_work() const noexcept;
  bool try_way();
  void shorten_each();
  void forget_touches();
  bool arrive(double time);
  void shorten(double way);
  void take_back();
  void describe_walls();

  Scene<D>& scene_;
  Environment<D>& env_;
  WallRecord& record_;
  PointsWay<D> points_;
  Body<D> particles_;
  Array<uint32_t> slots_{scene_.memory};  // of the particles
  MoveRecord still_record_;               // of what stands still
  WholeWays<D, MovingWalls<D>> ways_;
  ShortenedWays<D, MovingWalls<D>> shortened_;
  double touch_time_ = 1;  // of the first touch on the way that is tried
  TogetherSettings settings_;
  Array<Trajectory<D>> trajectories_{scene_.memory};
  Array<PointArray> targets_{scene_.memory};          // of the trajectories, for the whole way
  Array<Array<double>> near_targets_{scene_.memory};  // the same for a shorter way
};

template <int D>
void Call<D>::add_body(BodyRecord<D>& of, PointArray targets, MoveRecord* record) {
  begin_move(scene_, of);
  const auto slot = static_cast<uint32_t>(&of - scene_.bodies.data());
  Trajectory<D>& made = trajectories_.emplace_back(scene_.memory);
  made.motion.body = &of.body;
  made.name = {&of.body, slot, scene_.body_slots.generation(slot)};
  made.motion.targets = targets;
  made.record = record;
  made.stands = record == &still_record_;
  made.is_led = !made.stands && settings_.response != TogetherResponse::kStop;
}

template <int D>
void Call<D>::gather(BodyRecord<D>* const* bodies, size_t count, PointArray targets) {
  size_t first = 0;
  for (size_t i = 0; i < count; ++i) {
    BodyRecord<D>& of = *bodies[i];
    of.next.clear();
    add_body(of, {targets.data + first * targets.step, targets.step}, &of.next);
    first += of.body.vertices.size();
  }
  for_each_other_body(scene_, bodies, count,
                      [&](BodyRecord<D>& of) { add_body(of, positions_of(of.body), &still_record_); });
  add_particles(scene_, particles_, still_record_, trajectories_);
  for (uint32_t slot = 0; slot < scene_.particles.size(); ++slot) {
    if (scene_.particles[slot].cell.valid()) slots_.push_back(slot);
  }
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
  Array<dsw_volume_id> invalid(scene_.memory);
  record_.clear();
  try {
    ways_.set_most_work(most_work());
    Halving halving;
    bool has_gone = try_way();
    while (!has_gone && halving.next()) {
      invalid.swap(record_.invalid);
      record_.invalid.clear();
      shorten(halving.way);
      has_gone = try_way();
    }
    if (has_gone) {
      record_.invalid.swap(invalid);
      record_.fraction = halving.way * ways_.time();
      touch_time_ *= halving.way;
      describe_walls();
      if (record_.fraction != 0) ways_.walls.held.add_held(record_.held);
    } else {
      forget_touches();
      record_.fraction = 0;
    }
    for (Trajectory<D>& of : trajectories_) of.record->fraction = has_gone ? touch_time_ : 0;
  } catch (const WorkOver&) {
    forget_touches();
    record_.clear();
    record_.fraction = 0;
    record_.outcome = DSW_DEFORM_LIMITED;
    for (Trajectory<D>& of : trajectories_) of.record->fraction = 0;
    take_back();
    return;
  } catch (...) {
    take_back();
    throw;
  }
  record_.outcome = record_.fraction == 0   ? DSW_DEFORM_REFUSED
                    : !record_.held.empty() ? DSW_DEFORM_HELD
                    : record_.fraction == 1 ? DSW_DEFORM_DONE
                                            : DSW_DEFORM_FRACTION;
  if (record_.fraction == 0) take_back();
}

template <int D>
void Call<D>::forget_touches() {
  for (Trajectory<D>& of : trajectories_) of.record->clear();
}

/** Goes up to the first touch, or each part up to its own, if all cells that are met stay valid. */
template <int D>
bool Call<D>::try_way() {
  forget_touches();
  ways_.walls.begin(points_, record_.invalid);
  ways_.start(trajectories_, scene_.features.contacts && !trajectories_.empty());
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
  if (time != 1) points_.shorten_further(time, place_on_way<D>);
  points_.read_next();
  if ((time != 1 && !ways_.walls.stayed_valid(points_.starts())) || !ways_.walls.find_arrivals(trajectories_)) {
    points_.read_start();
    return false;
  }
  ways_.arrive(trajectories_);
  return true;
}

/** Lets all ways end at a part of what the host wants. */
template <int D>
void Call<D>::shorten(double way) {
  points_.shorten(way, place_on_way<D>);
  near_targets_.clear();
  for (size_t t = 0; t < trajectories_.size(); ++t) {
    Trajectory<D>& of = trajectories_[t];
    const Body<D>& body = *of.motion.body;
    Array<double>& near = near_targets_.emplace_back(D * body.vertices.size(), 0.0, scene_.memory);
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (body.has_vertex(v)) place_on_way<D>(body.position(v), targets_[t][v], way, &near[size_t{D} * v]);
    }
    of.motion.targets = {near.data(), D};
  }
}

/** The host's points, the environment and the bodies are what they were before. */
template <int D>
void Call<D>::take_back() {
  points_.restore_targets();
  points_.read_start();
  for (const Trajectory<D>& of : trajectories_) {
    if (of.motion.body == &particles_) continue;
    put_vertices(*of.motion.body, scene_.bodies[of.name.index].before.data());
    restore_forecasts(*of.motion.body);
  }
}

/** Touches of the environment are named by the scene's particles. */
template <int D>
void Call<D>::describe_walls() {
  record_.contacts.assign(ways_.walls.contacts.begin(), ways_.walls.contacts.end());
  for (dsw_wall_contact& contact : record_.contacts) {
    if (contact.body.index != kNone) continue;
    const uint32_t slot = slots_[contact.vertex.index];
    contact.body = {};
    contact.vertex = {};
    contact.particle = {slot, scene_.slots.generation(slot)};
  }
}

template <int D>
void Call<D>::keep_results(BodyRecord<D>* const* bodies, size_t count, size_t point_room) {
  Deformation<D>& d = *scene_.deformation.get();
  if (env_.points == points_.nexts()) {
    release_owned_points(env_);
    env_.lent = point_room == 0 ? nullptr : points_.nexts();
    env_.point_room = point_room;
  }
  // Who stopped is told by the targets of the call, also if the way was shortened.
  for (size_t t = 0; t < trajectories_.size(); ++t) trajectories_[t].motion.targets = targets_[t];
  if (!trajectories_.empty()) ways_.finish(trajectories_);
  for (Trajectory<D>& of : trajectories_) {
    if (record_.outcome == DSW_DEFORM_LIMITED) of.record->limited = of.record->stopped;
  }
  record_.sort();
  std::swap(d.record, d.next);
  for (size_t i = 0; i < count; ++i) end_move(scene_, *bodies[i], {});
  for (const Trajectory<D>& of : trajectories_) {
    if (of.record == &still_record_ && of.motion.body != &particles_)
      refresh_body(scene_, scene_.bodies[of.name.index]);
  }
  for (uint32_t i = 0; i < slots_.size(); ++i) {
    ParticleState<D>& particle = scene_.particles[slots_[i]];
    const Cell cell = particles_.vertices[i].cell;
    if (particle.cell != cell) particle.forecast = kNoFacet;
    particle.cell = cell;
    if (scene_.features.live) note_particle(scene_, slots_[i]);
  }
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
