// Trajectories of the bodies are made as for a move, and what is asked of them is taken back. Without steps of the environment each
// island has a search of its own, and one for all bodies begins at the least of their fractions. With them all is one island.

#include "scene/step_fraction.h"

#include <algorithm>

#include "base/dimensions.h"
#include "scene/meeting.h"
#include "scene/scene.h"
#include "scene/together_moves.h"
#include "together/moving_walls.h"
#include "together/step_search.h"
#include "together/together_move.h"

namespace dsw {
namespace {

template <int D>
class StepCall {
 public:
  StepCall(Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, const StepsOfAll& steps,
           const TogetherSettings& settings)
      : scene_(scene), bodies_(bodies), count_(count), steps_(steps), settings_(settings), islands_(scene.memory) {
    for (size_t i = 0; i < count; ++i) {
      first_.push_back(slots_);
      slots_ += bodies[i]->body.vertices.size();
    }
    targets_.assign(D * slots_, 0);
    for (size_t i = 0; i < count; ++i) place(i, 1, targets_.data());
  }
  ~StepCall() {
    for (BodyRecord<D>* each : begun_) restore_forecasts(each->body);
  }
  StepCall(const StepCall&) = delete;
  StepCall& operator=(const StepCall&) = delete;

  void run(StepAnswer& answer);

 private:
  PointArray targets_of(size_t i) const { return {targets_.data() + D * first_[i], D}; }
  PointArray steps_of(size_t i) const {
    return {steps_.of_bodies.data + first_[i] * steps_.of_bodies.step, steps_.of_bodies.step};
  }
  void begin(BodyRecord<D>& of) {
    begin_move(scene_, of);
    begun_.push_back(&of);
    of.next.clear();
  }
  void add(size_t i);
  void add_still(BodyRecord<D>& of);
  template <class Walls, class Begin>
  double search(WholeWays<D, Walls>& ways, double most, Begin begin);
  bool find_drift(double* drift) const;
  double find_at_rest(size_t first, size_t end, double most);
  void find_islands_fractions(StepAnswer& answer);
  double find_moving(Array<double>& ends);
  void place(size_t i, double fraction, double* places) const;
  void place_environment(double fraction, Array<double>& places) const;

  Scene<D>& scene_;
  BodyRecord<D>* const* bodies_;
  const size_t count_;
  const StepsOfAll& steps_;
  const TogetherSettings& settings_;
  Islands<D> islands_;
  Array<size_t> first_{scene_.memory};  // slots of each body among all
  size_t slots_ = 0;
  Array<double> targets_{scene_.memory};
  Array<BodyRecord<D>*> begun_{scene_.memory};
  Array<Trajectory<D>> trajectories_{scene_.memory};
  Array<PointArray> their_steps_{scene_.memory};
  Body<D> particles_{scene_.memory};
  MoveRecord still_record_{scene_.memory};
};

template <int D>
void StepCall<D>::place(size_t i, double fraction, double* places) const {
  const Body<D>& body = bodies_[i]->body;
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (body.has_vertex(v)) place_of_step<D>(body.position(v), steps_of(i)[v], fraction, places + D * (first_[i] + v));
  }
}

template <int D>
void StepCall<D>::add(size_t i) {
  const Partners<D>* const still = scene_.features.contacts ? &islands_.partners[i] : nullptr;
  trajectories_.push_back(trajectory_of(scene_, *bodies_[i], still, targets_of(i)));
  their_steps_.push_back(steps_of(i));
}

/** The mean step, which may be left out: all vertices make the same part of their steps. False: it is no number. */
template <int D>
bool StepCall<D>::find_drift(double* drift) const {
  size_t count = 0;
  std::fill_n(drift, D, 0.0);
  for (size_t t = 0; t < trajectories_.size(); ++t) {
    const Body<D>& body = *trajectories_[t].motion.body;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      ++count;
      for (int k = 0; k < D && their_steps_[t].data != nullptr; ++k) drift[k] += their_steps_[t][v][k];
    }
  }
  for (int k = 0; k < D; ++k) drift[k] /= static_cast<double>(std::max<size_t>(count, 1));
  return is_finite<D>(drift);
}

/** Searches for the trajectories; at the work limit 0. */
template <int D>
template <class Walls, class Begin>
double StepCall<D>::search(WholeWays<D, Walls>& ways, double most, Begin begin) {
  if (trajectories_.empty()) return most;
  uint64_t vertices = 0;
  for (const Trajectory<D>& of : trajectories_) vertices += of.motion.body->vertices.size();
  ways.set_most_work(1000 * uint64_t{settings_.kilo_products} * vertices);
  StepSearch<D, Walls> search(ways, scene_.memory);
  try {
    begin();
    double drift[D];
    ways.start(trajectories_, scene_.features.contacts, find_drift(drift) ? drift : nullptr);
    search.begin(trajectories_, their_steps_);
    return search.find(most);
  } catch (const WorkOver&) {
    return 0;
  }
}

/** The fraction of some bodies, which stand in the order of the islands. */
template <int D>
double StepCall<D>::find_at_rest(size_t first, size_t end, double most) {
  trajectories_.clear();
  their_steps_.clear();
  for (size_t k = first; k < end; ++k) add(islands_.bodies[k]);
  WholeWays<D, WallWays<D>>& ways = scene_.together.get()->ways();
  ways.walls.limits_parts = false;
  return search(ways, most, [] {});
}

template <int D>
void StepCall<D>::find_islands_fractions(StepAnswer& answer) {
  find_islands(scene_, bodies_, count_, {targets_.data(), D}, first_.data(), false, islands_);
  leave_still_ones(scene_, bodies_, count_, islands_);
  if (scene_.together.get() == nullptr) scene_.together.make(scene_.env);
  scene_.together.get()->set_counters(nullptr);
  for (size_t island = 0; island < islands_.count(); ++island) {
    const double fraction = find_at_rest(islands_.first[island], islands_.first[island + 1], 1);
    answer.fraction = std::min(answer.fraction, fraction);
    for (size_t k = islands_.first[island]; k < islands_.first[island + 1]; ++k) {
      answer.fractions[islands_.bodies[k]] = fraction;
    }
  }
  // Rounded places of other islands are others at this fraction.
  if (answer.fraction == 1 || islands_.count() == 1 || settings_.stop == TogetherStop::kIsland) return;
  answer.fraction = find_at_rest(0, count_, answer.fraction);
}

/** A body that stands still while the environment moves. */
template <int D>
void StepCall<D>::add_still(BodyRecord<D>& of) {
  begin(of);
  trajectories_.push_back(trajectory_of(scene_, of, static_cast<const Partners<D>*>(nullptr), positions_of(of.body)));
  trajectories_.back().record = &still_record_;
  trajectories_.back().stands = true;
  their_steps_.push_back({});
}

/** With an environment that moves. */
template <int D>
double StepCall<D>::find_moving(Array<double>& ends) {
  for (size_t i = 0; i < count_; ++i) {
    trajectories_.push_back(
        trajectory_of(scene_, *bodies_[i], static_cast<const Partners<D>*>(nullptr), targets_of(i)));
    their_steps_.push_back(steps_of(i));
  }
  for_each_other_body(scene_, bodies_, count_, [&](BodyRecord<D>& of) { add_still(of); });
  add_particles(scene_, particles_, still_record_, trajectories_);
  their_steps_.resize(trajectories_.size());
  place_environment(1, ends);
  WholeWays<D, MovingWalls<D>> ways(scene_.env);
  Array<dsw_volume_id> invalid(scene_.memory);
  return search(ways, 1, [&] { ways.walls.begin_steps(steps_.of_environment, ends.data(), invalid); });
}

template <int D>
void StepCall<D>::place_environment(double fraction, Array<double>& places) const {
  const size_t count = scene_.env.map.vertex_count;
  places.resize(D * count);
  for (size_t v = 0; v < count; ++v) {
    place_of_step<D>(scene_.env.point(static_cast<uint32_t>(v)), steps_.of_environment + D * v, fraction,
                     &places[D * v]);
  }
}

template <int D>
void StepCall<D>::run(StepAnswer& answer) {
  answer.fractions.assign(count_, 1);
  for (size_t i = 0; i < count_; ++i) begin(*bodies_[i]);
  if (steps_.of_environment == nullptr) {
    if (count_ > 0) find_islands_fractions(answer);
  } else {
    answer.fraction = find_moving(answer.environment_places);
    answer.fractions.assign(count_, answer.fraction);
    place_environment(answer.fraction, answer.environment_places);
  }
  answer.places.assign(D * slots_, 0);
  const bool by_island = settings_.stop == TogetherStop::kIsland;
  for (size_t i = 0; i < count_; ++i) {
    const double fraction = by_island ? answer.fractions[i] : answer.fraction;
    if (fraction == 1) {
      std::copy_n(targets_.data() + D * first_[i], D * bodies_[i]->body.vertices.size(),
                  answer.places.data() + D * first_[i]);
    } else {
      place(i, fraction, answer.places.data());
    }
  }
}

}  // namespace

template <int D>
void find_step_fraction(Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, const StepsOfAll& steps,
                        const TogetherSettings& settings, StepAnswer& answer) {
  StepCall<D>(scene, bodies, count, steps, settings).run(answer);
}

DSW_INSTANTIATE(find_step_fraction);

}  // namespace dsw
