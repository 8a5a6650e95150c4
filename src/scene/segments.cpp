#include "scene/segments.h"

#include "motion/locate.h"
#include "motion/prefetch.h"
#include "scene/batch.h"

namespace dsw {
namespace {

constexpr dsw_volume_id kNull{0, 0};

/** Where a cast starts: known, or located with or without a hint. */
template <int D>
Cell start_cell(const Environment<D>& env, dsw_volume_id start, const double* from, bool known) noexcept {
  return known && !is_null(start) ? env.map.cell(start.index) : locate_point(env, from, start);
}

template <int D>
bool can_start(const Environment<D>& env, Cell start) noexcept {
  return start.valid() && !env.map.marked(start);
}

/** Casts segments begin .. end-1. The loop that queries live in: a request is filled once, and most casts end in the
 * volume they began in, whose id is at hand. */
template <int D>
void cast_range(const Environment<D>& env, const dsw_volume_id* starts, PointArray from, PointArray to,
                const SegmentOptions& options, size_t begin, size_t end, dsw_flight* flights) noexcept {
  CastRequest request;
  request.max_cells = options.max_cells;
  const bool detail = options.detail, known = starts != nullptr && options.start_known;
  for (size_t i = begin; i < end; ++i) {
    if (known) {
      prefetch_ahead(env, i, end, [&](size_t k) { return env.map.cell(is_null(starts[k]) ? 0 : starts[k].index); });
    }
    const dsw_volume_id start = starts == nullptr ? kNull : starts[i];
    request.from = from[i];
    request.to = to[i];
    request.start = start_cell(env, start, request.from, known);
    if (!can_start(env, request.start)) {
      report_no_start(env, request.from, request.start, flights + i);
      continue;
    }
    const CastResult result = cast(env, request, nullptr);
    if (result.end == CastEnd::kReached && result.cells_visited == 1 && known && !is_null(start)) {
      report_reached<D>(request.to, start, 1, detail, flights + i);
    } else {
      report_cast(env, request, result, detail, flights + i);
    }
  }
}

template <int D>
struct PathWriter {
  const Environment<D>* env;
  const double* from;
  const double* to;
  dsw_crossing* next;

  static void write(void* user, Cell from_cell, uint32_t simplex, Cell to_cell) {
    PathWriter& w = *static_cast<PathWriter*>(user);
    *w.next++ = report_crossing(*w.env, from_cell, simplex, to_cell, w.from, w.to);
  }
};

}  // namespace

template <int D>
Cell locate_point(const Environment<D>& env, const double* point, dsw_volume_id hint) noexcept {
  return locate(env, point, is_null(hint) ? Cell{} : env.map.cell(hint.index), nullptr).cell;
}

template <int D>
void cast_segments(const Environment<D>& env, const Parallel& parallel, size_t count, const dsw_volume_id* starts,
                   PointArray from, PointArray to, const SegmentOptions& options, dsw_flight* flights) {
  auto body = [&](size_t begin, size_t end) noexcept {
    cast_range(env, starts, from, to, options, begin, end, flights);
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
  request.start = start_cell(env, start, from, options.start_known);
  request.max_cells = options.max_cells;
  *count = 0;
  if (!can_start(env, request.start)) return report_no_start(env, from, request.start, flight);
  CastResult result = cast(env, request, nullptr);
  report_cast(env, request, result, options.detail, flight);
  *count = result.cells_visited;
  if (capacity < *count) return;
  // Cast again, now that the room is known to be enough: a buffer that is too small stays untouched.
  PathWriter<D> writer{&env, from, to, crossings};
  *writer.next++ = {volume_id(env.map, request.start), {0, 0, 0}, 0};
  request.crossing = PathWriter<D>::write;
  request.crossing_user = &writer;
  cast(env, request, nullptr);
}

template <int D>
void locate_points(const Environment<D>& env, const Parallel& parallel, PointArray points, size_t count,
                   const dsw_volume_id* hints, dsw_volume_id* volumes) {
  auto body = [&](size_t begin, size_t end) noexcept {
    for (size_t i = begin; i < end; ++i) {
      volumes[i] = volume_id(env.map, locate_point(env, points[i], hints == nullptr ? kNull : hints[i]));
    }
  };
  share_out(parallel, count, body);
}

template Cell locate_point<3>(const Environment<3>&, const double*, dsw_volume_id) noexcept;
template void cast_segments<3>(const Environment<3>&, const Parallel&, size_t, const dsw_volume_id*, PointArray,
                               PointArray, const SegmentOptions&, dsw_flight*);
template void cast_path<3>(const Environment<3>&, dsw_volume_id, const double*, const double*, const SegmentOptions&,
                           dsw_crossing*, size_t, size_t*, dsw_flight*) noexcept;
template void locate_points<3>(const Environment<3>&, const Parallel&, PointArray, size_t, const dsw_volume_id*,
                               dsw_volume_id*);

}  // namespace dsw
