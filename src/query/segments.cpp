#include "query/segments.h"

#include "base/batch.h"
#include "base/dimensions.h"
#include "contact/names.h"
#include "locate/locate.h"
#include "locate/open_segment.h"
#include "predicates/plane_hit.h"
#include "query/segment_range.h"
#include "walk/packet.h"

namespace dsw {

template <int D>
void cast_range(const Environment<D>& env, Starts<D> starts, PointArray from, PointArray to, SegmentOptions options,
                size_t begin, size_t end, dsw_flight* flights) noexcept {
  Packet<D> packet;
  dsw_flight* reports[kPacket];
  while (begin < end) {
    for (packet.clear(); begin < end && !packet.full(); ++begin) {
      if (begin + kRecordAhead < end) starts.prefetch(begin + kRecordAhead);
      const Cell cell = starts.find(begin, from[begin]);
      if (is_passable(env, cell)) {
        reports[packet.count()] = flights + begin;
        packet.add(env, cell, from[begin], to[begin]).max_volumes = options.max_volumes;
      } else {
        report_no_start(env, from[begin], cell, flights + begin);
      }
    }
    packet.run(env, nullptr);
    report_packet(env, packet, options.detail, reports);
  }
}

namespace {

template <int D>
void report_open(const Environment<D>& env, const double* from, const double* to, const OpenSegmentResult& found,
                 Cell start, bool detail, dsw_flight* flight) noexcept {
  if (found.end == OpenEnd::kOutside || found.end == OpenEnd::kImpassable)
    return report_no_start(env, from, start, flight);
  clear(flight);
  flight->volumes_visited = found.volumes_visited;
  flight->outcome = found.end == OpenEnd::kFree  ? DSW_OUTCOME_REACHED
                    : found.end == OpenEnd::kMet ? DSW_OUTCOME_CONTACT
                                                 : DSW_OUTCOME_WORK_LIMIT;
  if (!detail) return;
  flight->time = found.end == OpenEnd::kFree ? 1 : found.time;
  point_at<D>(from, to, flight->time, flight->position);
  if (found.end != OpenEnd::kMet) return;
  name_wall(env, found.facet, flight->contact);
  const Cell front = env.map.cell_of(found.facet);
  const double* simplex[D];
  simplex_points(env, front, env.map.shape(front), found.simplex, simplex);
  unit_normal<D>(simplex, flight->contact.normal);
  for (int k = 0; k < D; ++k) flight->contact.normal[k] = 0 - flight->contact.normal[k];
}

template <int D>
void cast_open_range(const Environment<D>& env, Starts<D> starts, PointArray from, PointArray to,
                     SegmentOptions options, size_t begin, size_t end, dsw_flight* flights) {
  OpenSegments<D> open(env);
  for (size_t i = begin; i < end; ++i) {
    const Cell start = starts.find(i, from[i]);
    const OpenSegmentResult found = open.ask(from[i], to[i], start, options.max_volumes);
    report_open(env, from[i], to[i], found, start, options.detail, flights + i);
  }
}

}  // namespace

template <int D>
Cell locate_point(const Environment<D>& env, const double* point, dsw_volume_id hint) noexcept {
  return locate(env, point, is_null(hint) ? Cell{} : env.map.cell(hint.index), nullptr).cell;
}

template <int D>
void cast_segments(const Environment<D>& env, const Parallel& parallel, size_t count, const dsw_volume_id* starts,
                   PointArray from, PointArray to, const SegmentOptions& options, dsw_flight* flights) {
  const Starts<D> where(env, starts, options.start_known);
  if (starts == nullptr) env.index.prepare(env, parallel, count);
  if (options.open_ends) {
    return share_or_throw(
        [&](auto& chunk) { share_out(parallel, count, chunk); },
        [&](size_t begin, size_t end) { cast_open_range(env, where, from, to, options, begin, end, flights); });
  }
  auto body = [&](size_t begin, size_t end) noexcept {
    cast_range(env, where, from, to, options, begin, end, flights);
  };
  share_out(parallel, count, body);
}

template <int D>
void cast_path(const Environment<D>& env, dsw_volume_id start, const double* from, const double* to,
               const SegmentOptions& options, dsw_crossing* crossings, size_t capacity, size_t* count,
               dsw_flight* flight) noexcept {
  CastRequest request;
  request.from = from;
  request.to = to;
  request.start = Starts<D>(env, &start, options.start_known).find(0, from);
  request.max_volumes = options.max_volumes;
  *count = 0;
  if (!is_passable(env, request.start)) return report_no_start(env, from, request.start, flight);
  CastResult result = cast(env, request, nullptr);
  report_cast(env, request, result, options.detail, flight);
  *count = result.volumes_visited;
  if (capacity < *count) return;
  // Cast again, now that the room is known to be enough: a buffer that is too small stays untouched.
  CrossingWriter<D> writer;
  writer.attach(env, request, crossings, crossings + *count);
  cast(env, request, nullptr);
}

template <int D>
void locate_points(const Environment<D>& env, const Parallel& parallel, PointArray points, size_t count,
                   const dsw_volume_id* hints, dsw_volume_id* volumes) {
  if (hints == nullptr) env.index.prepare(env, parallel, count);
  auto body = [&](size_t begin, size_t end) noexcept {
    for (size_t i = begin; i < end; ++i) {
      volumes[i] = volume_id(env.map, locate_point(env, points[i], hints == nullptr ? dsw_volume_id{0, 0} : hints[i]));
    }
  };
  share_out(parallel, count, body);
}

DSW_INSTANTIATE(cast_range);
DSW_INSTANTIATE(locate_point);
DSW_INSTANTIATE(cast_segments);
DSW_INSTANTIATE(cast_path);
DSW_INSTANTIATE(locate_points);

}  // namespace dsw
