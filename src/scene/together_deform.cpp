#include "scene/together_deform.h"

#include <utility>

#include "base/dimensions.h"
#include "environment/moving.h"
#include "scene/deformation.h"
#include "scene/meeting.h"
#include "scene/scene.h"
#include "together/moving_walls.h"
#include "together/place_on_way.h"
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
        next_(next),
        start_(env_.points),
        had_moved_(env_.has_moved()),
        version_(env_.obstacle_version),
        particles_(scene.memory),
        still_record_(scene.memory),
        ways_(env_),
        settings_(settings) {}

  void gather(BodyRecord<D>* const* bodies, size_t count, PointArray targets);
  void run();
  void keep_results(BodyRecord<D>* const* bodies, size_t count, size_t point_room);

 private:
  static constexpr int kMostHalvings = 52;

  void add_body(BodyRecord<D>& of, PointArray targets, MoveRecord* record);
  uint64_t most_work() const noexcept;
  void add_particles();
  bool try_way();
  void forget_touches();
  bool arrive(double time);
  void shorten(double way);
  void put_points(double time);
  void read_points(const double* points);
  void go_back_to_start();
  void take_back();
  void describe_walls();

  Scene<D>& scene_;
  Environment<D>& env_;
  WallRecord& record_;
  double* next_;
  const double* start_;
  bool had_moved_;
  uint64_t version_;  // of the environment
  Body<D> particles_;
  Array<uint32_t> slots_{scene_.memory};  // of the particles
  MoveRecord still_record_;               // of what stands still
  WholeWays<D, MovingWalls<D>> ways_;
  TogetherSettings settings_;
  Array<Traveller<D>> travellers_{scene_.memory};
  Array<PointArray> targets_{scene_.memory};          // of the travellers, for the whole way
  Array<Array<double>> near_targets_{scene_.memory};  // the same for a shorter way
  Array<double> next_targets_{scene_.memory};         // what the host wrote to next_, if that is changed
};

/** Where the vertices of a body are. */
template <int D>
PointArray positions_of(const Body<D>& body) {
  static_assert(sizeof(BodyVertex<D>) % sizeof(double) == 0);
  return {body.vertices.empty() ? nullptr : body.vertices[0].position, sizeof(BodyVertex<D>) / sizeof(double)};
}

template <int D>
void Call<D>::add_body(BodyRecord<D>& of, PointArray targets, MoveRecord* record) {
  begin_move(scene_, of);
  const auto slot = static_cast<uint32_t>(&of - scene_.bodies.data());
  Traveller<D>& made = travellers_.emplace_back(scene_.memory);
  made.body = &of.body;
  made.name = {&of.body, slot, scene_.body_slots.generation(slot)};
  made.targets = targets;
  made.record = record;
}

template <int D>
void Call<D>::gather(BodyRecord<D>* const* bodies, size_t count, PointArray targets) {
  Array<bool> moves(scene_.bodies.size(), false, scene_.memory);
  size_t first = 0;
  for (size_t i = 0; i < count; ++i) {
    BodyRecord<D>& of = *bodies[i];
    moves[static_cast<size_t>(&of - scene_.bodies.data())] = true;
    of.next.clear();
    add_body(of, {targets.data + first * targets.step, targets.step}, &of.next);
    first += of.body.vertices.size();
  }
  for (uint32_t slot = 0; slot < scene_.bodies.size(); ++slot) {
    BodyRecord<D>& of = scene_.bodies[slot];
    if (!scene_.body_slots.alive(slot, scene_.body_slots.generation(slot))) continue;
    if (of.body.radius > 0) fail(DSW_STATUS_UNSUPPORTED, "a body of the scene has a radius");
    if (moves[slot]) continue;
    add_body(of, positions_of(of.body), &still_record_);
  }
  add_particles();
  for (const Traveller<D>& of : travellers_) targets_.push_back(of.targets);
}

template <int D>
void Call<D>::add_particles() {
  particles_.level = SweepLevel::kPoints;
  particles_.filter = {0, 0, false};
  reserve(particles_, scene_.particles.size(), 0, 0);
  for (uint32_t slot = 0; slot < scene_.particles.size(); ++slot) {
    const ParticleState<D>& particle = scene_.particles[slot];
    if (!particle.cell.valid()) continue;
    add_vertex(particles_, particle.position, particle.cell);
    slots_.push_back(slot);
  }
  if (slots_.empty()) return;
  Traveller<D>& made = travellers_.emplace_back(scene_.memory);
  made.body = &particles_;
  made.name = {&particles_, kNone, 0};
  made.targets = positions_of(particles_);
  made.record = &still_record_;
}

/** That of all vertices, in all halvings together. */
template <int D>
uint64_t Call<D>::most_work() const noexcept {
  uint64_t vertices = 0;
  for (const Traveller<D>& of : travellers_) vertices += of.body->vertices.size();
  return 1000 * uint64_t{settings_.kilo_products} * vertices;
}

/** Tries the whole way. While a cell on it does not stay valid, halves the way. */
template <int D>
void Call<D>::run() {
  Array<dsw_volume_id> invalid(scene_.memory);
  record_.clear();
  try {
    ways_.set_most_work(most_work());
    double way = 1;
    bool has_gone = try_way();
    for (int halvings = 0; !has_gone && halvings < kMostHalvings; ++halvings) {
      invalid.swap(record_.invalid);
      record_.invalid.clear();
      way /= 2;
      shorten(way);
      has_gone = try_way();
    }
    if (has_gone) {
      record_.invalid.swap(invalid);
      record_.fraction = way * ways_.time();
      describe_walls();
    } else {
      forget_touches();
      record_.fraction = 0;
    }
    for (Traveller<D>& of : travellers_) of.record->fraction = record_.fraction;
  } catch (const WorkOver&) {
    forget_touches();
    record_.clear();
    record_.fraction = 0;
    record_.outcome = DSW_DEFORM_LIMITED;
    for (Traveller<D>& of : travellers_) of.record->fraction = 0;
    take_back();
    return;
  } catch (...) {
    take_back();
    throw;
  }
  record_.outcome = record_.fraction == 1   ? DSW_DEFORM_DONE
                    : record_.fraction == 0 ? DSW_DEFORM_REFUSED
                                            : DSW_DEFORM_FRACTION;
  if (record_.fraction == 0) take_back();
}

template <int D>
void Call<D>::forget_touches() {
  for (Traveller<D>& of : travellers_) of.record->clear();
}

/** Goes up to the first touch, if all cells that are met stay valid. */
template <int D>
bool Call<D>::try_way() {
  forget_touches();
  ways_.walls.begin(next_, record_.invalid);
  ways_.start(travellers_, scene_.features.contacts && !travellers_.empty());
  if (!ways_.walls.stay_valid()) return false;
  if (ways_.find_touches(travellers_)) ways_.stop(travellers_);
  return ways_.time() == 0 || arrive(ways_.time());
}

/** All goes to the ends of its way; false if that does not lead into valid cells, and then nothing has gone. */
template <int D>
bool Call<D>::arrive(double time) {
  if (time != 1) put_points(time);
  read_points(next_);
  if ((time != 1 && !ways_.walls.stayed_valid(start_)) || !ways_.walls.find_arrivals(travellers_)) {
    go_back_to_start();
    return false;
  }
  ways_.arrive(travellers_);
  return true;
}

template <int D>
void Call<D>::read_points(const double* points) {
  env_.points = points;
  env_.note_move();
  env_.checked.forget_all();
}

/** The environment is what it was before, and so is what is known of its obstacles. */
template <int D>
void Call<D>::go_back_to_start() {
  read_points(start_);
  env_.give_back_version(version_);
  env_.set_moved(had_moved_);
}

/** Puts the environment's next points to where they are at a time of their way. */
template <int D>
void Call<D>::put_points(double time) {
  const size_t count = env_.map.vertex_count;
  if (next_targets_.empty()) next_targets_.assign(next_, next_ + D * count);
  for (size_t v = 0; v < count; ++v) place_on_way<D>(start_ + D * v, next_ + D * v, time, next_ + D * v);
}

/** Lets all ways end at a part of what the host wants. */
template <int D>
void Call<D>::shorten(double way) {
  if (!next_targets_.empty()) std::copy(next_targets_.begin(), next_targets_.end(), next_);
  put_points(way);
  near_targets_.clear();
  for (size_t t = 0; t < travellers_.size(); ++t) {
    Traveller<D>& of = travellers_[t];
    const Body<D>& body = *of.body;
    Array<double>& near = near_targets_.emplace_back(D * body.vertices.size(), 0.0, scene_.memory);
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (body.has_vertex(v)) place_on_way<D>(body.position(v), targets_[t][v], way, &near[size_t{D} * v]);
    }
    of.targets = {near.data(), D};
  }
}

/** The host's points, the environment and the bodies are what they were before. */
template <int D>
void Call<D>::take_back() {
  std::copy(next_targets_.begin(), next_targets_.end(), next_);
  if (env_.points != start_) go_back_to_start();
  for (const Traveller<D>& of : travellers_) {
    if (of.body == &particles_) continue;
    put_vertices(*of.body, scene_.bodies[of.name.index].before.data());
    restore_forecasts(*of.body);
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
  if (env_.points == next_) {
    release_owned_points(env_);
    env_.lent = point_room == 0 ? nullptr : next_;
    env_.point_room = point_room;
  }
  // Who stopped is told by the targets of the call, also if the way was shortened.
  for (size_t t = 0; t < travellers_.size(); ++t) travellers_[t].targets = targets_[t];
  if (!travellers_.empty()) ways_.finish(travellers_);
  for (Traveller<D>& of : travellers_) {
    if (record_.outcome == DSW_DEFORM_LIMITED) of.record->limited = of.record->stopped;
  }
  record_.sort();
  std::swap(d.record, d.next);
  for (size_t i = 0; i < count; ++i) end_move(scene_, *bodies[i], {});
  for (const Traveller<D>& of : travellers_) {
    if (of.record == &still_record_ && of.body != &particles_) settle_body(scene_, scene_.bodies[of.name.index]);
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
