#include "together/room_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/describe.h"
#include "environment/validity.h"
#include "motion/place_on_way.h"
#include "together/describe.h"

namespace dsw {

template <int D>
void RoomSteps<D>::begin(const double* next, Array<dsw_volume_id>& invalid) {
  next_ = next;
  invalid_ = &invalid;
  for (Array<double>& each : points_) {
    each.resize(size_t{D} * env_.map.vertex_count);
    if (env_.points != each.data()) continue;
    starts_.assign(each.begin(), each.end());  // the steps write where they are
    env_.points = starts_.data();
  }
  start_ = env_.points;
  contacts.clear();
  least_step_ = 1;
}

/** The points at a part of the way, where the environment does not read them. */
template <int D>
double* RoomSteps<D>::fill(double fraction) {
  double* const to = points_[env_.points == points_[0].data() ? 1 : 0].data();
  for (size_t i = 0; i < points_[0].size(); i += D) place_on_way<D>(start_ + i, next_ + i, fraction, to + i);
  return to;
}

template <int D>
const double* RoomSteps<D>::look_to(double until) {
  step_.begin(fill(until));
  met_invalid_.clear();
  return step_.nexts();
}

template <int D>
bool RoomSteps<D>::stay_valid(const CellQueue& cells, double unit) {
  const size_t before = met_invalid_.size();
  for (size_t i = 0; i < cells.size(); ++i) {
    const Cell c = cells[i];
    env_.map.for_each_vertex(c, [&](uint32_t v) {
      const double *const from = env_.point(v), *const to = next_ + size_t{D} * v;
      if (!is_finite<D>(to)) fail_non_finite({next_, D}, v, D, {"next", true});
      double way = 0;
      for (int k = 0; k < D; ++k) way += std::fabs(to[k] - from[k]);
      if (way > 0) least_step_ = std::min(least_step_, std::max(0x1p-53, unit / way));
    });
    if (!stays_valid(env_, c, step_.nexts())) met_invalid_.push_back(volume_id(env_.map, c));
  }
  return met_invalid_.size() == before;
}

template <int D>
bool RoomSteps<D>::find_first(FirstTouch& first) {
  standing_touched_.clear();
  if (standing.empty()) return true;
  ways_.walls.begin(step_, met_invalid_);
  ways_.start(standing, false);
  if (!ways_.walls.stay_valid()) return false;
  ways_.walls.set_next(next_);
  if (!ways_.find_touches(standing)) return true;
  if (first.touches && first.time < ways_.touch_time()) return true;
  first = {true, ways_.touch_time()};
  least_step_ = std::min(least_step_, std::max(0x1p-53, ways_.step_from_touch()));
  ways_.describe(standing);
  standing_touched_.assign(ways_.walls.contacts.begin(), ways_.walls.contacts.end());
  return true;
}

template <int D>
void RoomSteps<D>::join(Array<Trajectory<D>>& trajectories) {
  for (Trajectory<D>& each : standing) trajectories.push_back(std::move(each));
  standing.clear();
}

template <int D>
bool RoomSteps<D>::go_to(Array<Trajectory<D>>& trajectories, double fraction, bool bodies_meet,
                         const TogetherSettings& settings, bool keeps) {
  uint64_t vertices = 0;
  for (const Trajectory<D>& of : trajectories) vertices += of.motion.body->vertices.size();
  ways_.set_most_work(1000 * uint64_t{settings.kilo_products} * vertices);
  step_.begin(fill(fraction));
  met_invalid_.clear();
  ways_.walls.begin(step_, met_invalid_);
  ways_.start(trajectories, bodies_meet);
  if (!ways_.walls.stay_valid()) return false;
  if (ways_.find_touches(trajectories)) {
    if (keeps) {
      ways_.describe(trajectories);
      contacts.assign(ways_.walls.contacts.begin(), ways_.walls.contacts.end());
    }
    return false;
  }
  step_.read_next();
  if (!ways_.walls.find_arrivals(trajectories, step_.starts())) {
    step_.read_start();
    return false;
  }
  ways_.arrive(trajectories);
  return true;
}

template <int D>
void RoomSteps<D>::take_back(Array<Trajectory<D>>& trajectories) noexcept {
  step_.read_start();
  for (Trajectory<D>& of : trajectories) {
    Array<BodyVertex<D>>& vertices = of.motion.body->vertices;
    for (uint32_t v = 0; of.stands && v < vertices.size(); ++v) {
      if (of.motion.body->has_vertex(v)) vertices[v].cell = of.motion.ways[v].from;
    }
  }
}

template <int D>
void RoomSteps<D>::keep_wall(const Trajectory<D>& of, const Simplex& part, const uint32_t* corners, uint32_t count) {
  const dsw_body_contact& known = of.record->contacts.back();
  WallFeature wall{};
  wall.count = count;
  std::copy_n(corners, count, wall.vertices);
  Touch touch;
  std::copy_n(known.point, D, touch.point);
  touch.other = known.contact;
  touch.along = known.edge_parameter;
  const double* const at = env_.point(corners[0]);
  dsw_wall_contact& contact = contacts.emplace_back(describe(env_, wall, at, at, touch, DSW_WALL_STOP));
  contact.body = {of.name.index, of.name.generation};
  name_part(*of.motion.body, part, contact);
}

template <int D>
void RoomSteps<D>::set_time(double time) noexcept {
  for (dsw_wall_contact& contact : contacts) {
    const size_t at = size_t{D} * contact.moving.index;
    contact.time = time;
    std::copy_n(start_ + at, D, contact.from);
    std::copy_n(next_ + at, D, contact.to);
  }
}

template class RoomSteps<2>;
template class RoomSteps<3>;

}  // namespace dsw
