#include "query/report.h"

#include "base/dimensions.h"
#include "predicates/plane_hit.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

template <int D>
void copy_point(const double* from, double* to) noexcept {
  for (int k = 0; k < D; ++k) to[k] = from[k];
}

dsw_outcome outcome_of(CastEnd end) noexcept {
  return end == CastEnd::kReached ? DSW_OUTCOME_REACHED
         : end == CastEnd::kHit   ? DSW_OUTCOME_CONTACT
                                  : DSW_OUTCOME_WORK_LIMIT;
}

/** What every report of a free cast holds, and the rest of one that reached its target. Every member once: cleared
 * first, it takes twice as many stores. */
template <int D>
void report_arrival(const Environment<D>& env, const CastRequest& request, const CastResult& result, bool detail,
                    dsw_flight* flight) noexcept {
  for (int k = 0; k < 3; ++k) {
    flight->position[k] = detail && k < D ? request.to[k] : 0;
    flight->contact.normal[k] = 0;
  }
  flight->time = detail ? 1 : 0;
  flight->volume = volume_id(env.map, result.cell);
  flight->contact.obstacle = {DSW_CELL_NONE, 0, 0, 0};
  flight->contact.wall = {0, 0, 0};
  flight->contact.front = {0, 0};
  flight->contact.behind = {0, 0};
  flight->outcome = DSW_OUTCOME_REACHED;
  flight->contact.kind = DSW_CONTACT_NONE;
  flight->contact.marked_kind = DSW_CELL_NONE;
  flight->contact.tag = 0;
  flight->volumes_visited = result.volumes_visited;
}

/** What is different for one that met something. */
template <int D>
void report_hit(const Environment<D>& env, const CastRequest& request, const CastResult& result, const PlaneHit<D>& hit,
                dsw_flight* flight) noexcept {
  flight->time = hit.time;
  copy_point<D>(hit.normal, flight->contact.normal);
  name_wall(env, result.facet, flight->contact);
  point_at<D>(request.from, request.to, flight->time, flight->position);
}

/** What is different for one that came to its work limit. */
template <int D>
void report_limit(const Environment<D>& env, const CastRequest& request, const CastResult& result,
                  dsw_flight* flight) noexcept {
  flight->time =
      result.previous.valid() ? crossing_time(env, result.previous, result.simplex, request.from, request.to) : 0;
  point_at<D>(request.from, request.to, flight->time, flight->position);
}

}  // namespace

template <int D>
void report_cast(const Environment<D>& env, const CastRequest& request, const CastResult& result, bool detail,
                 dsw_flight* flight) noexcept {
  report_arrival(env, request, result, detail, flight);
  flight->outcome = outcome_of(result.end);
  if (!detail || result.end == CastEnd::kReached) return;
  if (result.end == CastEnd::kWorkLimit) return report_limit(env, request, result, flight);
  const double* simplex[D];
  boundary_points(env, result.cell, result.simplex, simplex);
  report_hit(env, request, result, plane_hit<D>(request.from, request.to, simplex), flight);
}

template <int D>
void report_packet(const Environment<D>& env, const Packet<D>& packet, bool detail,
                   dsw_flight* const* flights) noexcept {
  uint32_t stops[kPacket], stop_count = 0;
  for (uint32_t i = 0; i < packet.count(); ++i) {
    report_arrival(env, packet.request(i), packet.result(i), detail, flights[i]);
    stops[stop_count] = i;
    stop_count += packet.result(i).end != CastEnd::kReached ? 1 : 0;
  }
  PlaneFlight<D> paths[kPacket];
  uint32_t hits[kPacket], hit_count = 0;
  for (uint32_t k = 0; k < stop_count; ++k) {
    const uint32_t i = stops[k];
    const CastRequest& request = packet.request(i);
    const CastResult& result = packet.result(i);
    flights[i]->outcome = outcome_of(result.end);
    if (!detail) continue;
    if (result.end == CastEnd::kWorkLimit) {
      report_limit(env, request, result, flights[i]);
      continue;
    }
    paths[hit_count] = {request.from, request.to, {}};
    boundary_points(env, result.cell, result.simplex, paths[hit_count].simplex);
    hits[hit_count++] = i;
  }
  PlaneHit<D> planes[kPacket];
  plane_hits(paths, hit_count, planes);
  for (uint32_t k = 0; k < hit_count; ++k) {
    const uint32_t i = hits[k];
    report_hit(env, packet.request(i), packet.result(i), planes[k], flights[i]);
  }
}

template <int D>
void report_no_start(const Environment<D>& env, const double* from, Cell start, dsw_flight* flight) noexcept {
  clear(flight);
  copy_point<D>(from, flight->position);
  flight->volume = volume_id(env.map, start);
  flight->outcome = start.valid() ? DSW_OUTCOME_IMPASSABLE : DSW_OUTCOME_OUTSIDE;
}

template <int D>
void report_move(const Environment<D>& env, const MoveResult<D>& result, bool detail, dsw_flight* flight) noexcept {
  clear(flight);
  copy_point<D>(result.position, flight->position);
  flight->time = result.time;
  flight->volume = volume_id(env.map, result.cell);
  flight->outcome = result.work_limited ? DSW_OUTCOME_WORK_LIMIT : outcome_of(result.cast.end);
  flight->volumes_visited = result.cast.volumes_visited;
  if (!detail || flight->outcome != DSW_OUTCOME_CONTACT) return;
  copy_point<D>(result.normal, flight->contact.normal);
  name_wall(env, result.cast.facet, flight->contact);
}

template <int D>
dsw_crossing report_crossing(const Environment<D>& env, Cell from, uint32_t simplex, Cell to, const double* start,
                             const double* target) noexcept {
  const uint32_t facet = env.map.shape(from).simplex_facets(D)[simplex];
  return {volume_id(env.map, to), face_id(env.map, canonical(env.map, env.map.half_facet(from, facet))),
          crossing_time(env, from, simplex, start, target)};
}

DSW_INSTANTIATE(report_cast);
DSW_INSTANTIATE(report_packet);
DSW_INSTANTIATE(report_no_start);
DSW_INSTANTIATE(report_move);
DSW_INSTANTIATE(report_crossing);

}  // namespace dsw
