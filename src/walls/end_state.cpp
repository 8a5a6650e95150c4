#include "walls/end_state.h"

#include "base/points.h"
#include "base/search.h"
#include "contact/names.h"
#include "environment/moving.h"
#include "motion/place_on_way.h"
#include "motion/points_way.h"
#include "walk/move.h"
#include "walk/prefetch.h"
#include "walls/describe.h"

namespace dsw {

template <int D>
EndState<D>::EndState(Environment<D>& env, Occupants<D>& all)
    : env_(env), all_(all), probe_(env, Obstacle::kCells), thick_(env), repair_(env, all) {}

template <int D>
void EndState<D>::run(double* next, const WallSettings& settings, WallRecord& record) {
  PointsWay<D> points(env_);
  points.begin(next);
  const auto take_back = [&] { points.read_start(); };
  const auto try_way = [&](double way) {
    if (way != 1) points.shorten(way, point_on_way<D>);
    points.read_next();
    const Went went = try_state(settings, record);
    if (went != Went::kInvalid) return went;
    return settings.refuses_invalid ? Went::kRefused : Went::kStopped;
  };
  try {
    points_.reserve(kPacket);
    repair_.begin(points.starts());
    if (!find_way(all_, settings.response == DSW_WALL_INSERT, record, try_way, take_back))
      return points.restore_targets();
    record.outcome = record.fraction == 1 ? DSW_DEFORM_DONE : DSW_DEFORM_FRACTION;
    release_owned_points(env_);
  } catch (...) {
    points.restore_targets();
    take_back();
    all_.restore();
    throw;
  }
}

template <int D>
Went EndState<D>::try_state(const WallSettings& settings, WallRecord& record) {
  Went went = Went::kThrough;
  const auto add = [&](const Feature& point) {
    points_.push_back(point);
    if (points_.size() == kPacket) went = run_packet(settings, record);
    return went == Went::kThrough;
  };
  points_.clear();
  struck_.clear();
  for (uint32_t i = 0; i < all_.particle_count; ++i) {
    if (all_.particles[i].cell.valid() && !add({Feature::kParticle, 0, i})) return went;
  }
  for (uint32_t owner = 0; owner < all_.bodies.size(); ++owner) {
    if (all_.bodies[owner].body == nullptr) continue;
    const Body<D>& body = *all_.bodies[owner].body;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (body.has_vertex(v) && !add({Feature::kVertex, owner, v})) return went;
    }
  }
  went = run_packet(settings, record);
  if (went != Went::kThrough) return went;
  return repair(settings, record) ? Went::kThrough : Went::kStopped;
}

/** Whether all bodies are free where the environment has gone, after what is done about those that are not. */
template <int D>
bool EndState<D>::repair(const WallSettings& settings, WallRecord& record) {
  const auto stop = [](uint32_t, uint32_t) { return false; };
  const auto is_apart = [&](const Body<D>& body) {
    return all_.partners == nullptr || is_body_apart(*all_.partners, body, body.level, stop);
  };
  auto struck = struck_.begin();
  for (uint32_t owner = 0; owner < all_.bodies.size(); ++owner) {
    const auto first = struck;
    while (struck != struck_.end() && struck->owner == owner) ++struck;
    const Body<D>* const body = all_.bodies[owner].body;
    if (body == nullptr || settings.response == DSW_WALL_STOP) continue;
    const bool is_struck = first != struck;
    if (!is_struck && probe_.is_free(*body, {})) continue;
    if (body->is_rigid()) {
      const Feature* const points = is_struck ? &*first : nullptr;
      if (!repair_.move(owner, points, static_cast<size_t>(struck - first), record)) return false;
    } else if (settings.response == DSW_WALL_INSERT) {
      repair_.bend(owner, settings.min_part, record);
    }
  }
  const auto is_free = [&](const typename Occupants<D>::Owner& owner) {
    return owner.body == nullptr || (probe_.is_free(*owner.body, {}) && is_apart(*owner.body) &&
                                     thick_.keep_at_rest(all_.partners, *owner.body));
  };
  return dsw::all_of(all_.bodies.begin(), all_.bodies.end(), is_free);
}

/** Follows points from the centres of their cells, side by side. */
template <int D>
Went EndState<D>::run_packet(const WallSettings& settings, WallRecord& record) {
  uint8_t place[kPacket];  // of their cells
  cells_.clear();
  for (size_t i = 0; i < points_.size(); ++i) {
    const Cell c = cell_of(all_, points_[i]);
    prefetch_record(env_, c);
    place[i] = static_cast<uint8_t>(cells_.insert(c));
  }
  for (uint32_t k = 0; k < cells_.count(); ++k) prefetch_moving(env_, cells_[k]);
  for (uint32_t k = 0; k < cells_.count(); ++k) {
    const Cell c = cells_[k];
    if (!admits_with_centre(env_, c, centres_[k])) {
      for (uint32_t i = 0, corners = env_.map.vertices_of(c); i < corners; ++i) {
        const uint32_t v = env_.map.vertex(c, i);
        if (!is_finite<D>(env_.point(v))) fail_non_finite({env_.points, D}, v, D, {"next", true});
      }
      record.invalid.push_back(volume_id(env_.map, c));
      return Went::kInvalid;
    }
  }
  packet_.clear();
  for (size_t i = 0; i < points_.size(); ++i) {
    const Cell c = cells_[place[i]];
    const double* const from = centres_[place[i]];
    // That of a sliver can round to a point outside, from where no walk may start.
    const double* const at = position(all_, points_[i]);
    const bool thin = env_.map.form(c) == Form::kSimplex && !contains(env_, c, from);
    if (thin && !contains(env_, c, at)) return Went::kStopped;
    packet_.add(env_, c, thin ? at : from, at);
  }
  packet_.run(env_, nullptr);
  const dsw_wall_response done = settings.response == DSW_WALL_INSERT ? DSW_WALL_PUSH : settings.response;
  for (uint32_t i = 0; i < packet_.count(); ++i) {
    const CastResult& flight = packet_.result(i);
    if (flight.end == CastEnd::kReached) {
      if (flight.volumes_visited != 1) set_location(all_, points_[i], position(all_, points_[i]), flight.cell);
    } else if (!put_before(packet_.request(i), flight, points_[i], done, record) ||
               settings.response == DSW_WALL_STOP) {
      return Went::kStopped;
    }
  }
  points_.clear();
  return Went::kThrough;
}

/** Puts a point that lies beyond a wall to where the way from its cell's centre meets that; false if an invalid cell is
 * met. */
template <int D>
bool EndState<D>::put_before(const CastRequest& request, const CastResult& flight, const Feature& point,
                             dsw_wall_response done, WallRecord& record) {
  const HalfFacet o = env_.map.opposite(flight.facet);
  if (o.valid() && !admits(env_, env_.map.cell_of(o))) {
    record.invalid.push_back(volume_id(env_.map, env_.map.cell_of(o)));
    return false;
  }
  // One of a rigid body waits for the others.
  const bool waits = point.kind == Feature::kVertex && all_.bodies[point.owner].body->is_rigid();
  if (waits && done == DSW_WALL_INSERT) done = DSW_WALL_PUSH;
  const MoveResult<D> move = finish_move(env_, request, flight, true, nullptr);
  dsw_wall_contact contact{};
  std::copy_n(request.from, D, contact.from);
  std::copy_n(request.to, D, contact.to);
  contact.time = move.time;
  std::copy_n(move.position, D, contact.point);
  std::copy_n(move.normal, D, contact.contact.normal);
  contact.response = done;
  name_wall(env_, flight.facet, contact.contact);
  name_feature(all_, point, contact);
  record.contacts.push_back(contact);
  if (waits) {
    struck_.push_back(point);
    return true;
  }
  set_location(all_, point, move.position, move.cell);
  ++record.pushed;
  return true;
}

template class EndState<2>;
template class EndState<3>;

}  // namespace dsw
