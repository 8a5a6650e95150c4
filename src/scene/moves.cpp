// Moves and casts of particles, one and many. Everything that can fail comes first; then particles are independent, so
// their states and reports are written in place, chunk by chunk, with counters that are added up in the chunks' order.

#include <algorithm>

#include "motion/prefetch.h"
#include "scene/batch.h"
#include "scene/scene.h"

namespace dsw {
namespace {

[[noreturn]] void fail_stale(dsw_particle_id id, ArgumentName argument, size_t index) {
  fail(DSW_STATUS_STALE_ID, "%s {index %u, generation %u} names no particle", ElementName(argument, index).text,
       id.index, id.generation);
}

/** Also stamps every particle with the number of this batch: one that already has it stands twice. */
template <int D>
void check_distinct_ids(Scene<D>& scene, const dsw_particle_id* ids, size_t count) {
  if (scene.stamps.size() < scene.slots.slot_count()) {
    reserve_more(scene.stamps, scene.slots.slot_count() - scene.stamps.size());
    scene.stamps.resize(scene.slots.slot_count(), 0u);
  }
  if (++scene.stamp == 0) {
    std::fill(scene.stamps.begin(), scene.stamps.end(), 0u);
    scene.stamp = 1;
  }
  for (size_t i = 0; i < count; ++i) {
    if (!scene.slots.alive(ids[i].index, ids[i].generation)) fail_stale(ids[i], {"particles", true}, i);
    uint32_t& stamp = scene.stamps[ids[i].index];
    if (stamp == scene.stamp) {
      fail(DSW_STATUS_DUPLICATE_ID, "particles[%zu] {index %u, generation %u} stands twice", i, ids[i].index,
           ids[i].generation);
    }
    stamp = scene.stamp;
  }
}

/** Writes the crossings of one flight into the room that was counted for it. */
template <int D>
struct CrossingWriter {
  const Environment<D>* env;
  const double* from;
  const double* to;
  dsw_crossing* next;
  dsw_crossing* end;

  static void write(void* user, Cell from_cell, uint32_t simplex, Cell to_cell) {
    CrossingWriter& w = *static_cast<CrossingWriter*>(user);
    DSW_ASSERT(w.next != w.end);
    if (w.next != w.end) *w.next++ = report_crossing(*w.env, from_cell, simplex, to_cell, w.from, w.to);
  }
};

template <int D>
CastRequest request_of(const ParticleState<D>& state, const double* target, uint32_t max_cells) noexcept {
  CastRequest request;
  request.from = state.position;
  request.to = target;
  request.start = state.cell;
  request.max_cells = max_cells;
  request.forecast = state.forecast;
  return request;
}

/** The facet a particle keeps aiming at: the wall that stopped it, or what it aimed at before if it stayed in its
 * cell. */
template <int D>
uint32_t next_forecast(const Environment<D>& env, const ParticleState<D>& state, const MoveResult<D>& result) noexcept {
  if (result.cast.end == CastEnd::kHit && result.cell == result.cast.cell) {
    return env.map.local_of(result.cast.facet, result.cell);
  }
  return result.cell == state.cell ? state.forecast : kNoFacet;
}

template <int D>
void move_one(const Scene<D>& scene, ParticleState<D>& state, const double* target, const FlightOptions& options,
              dsw_crossing* crossings, dsw_crossing* crossings_end, dsw_flight* flight,
              SceneStatistics* statistics) noexcept {
  CastRequest request = request_of(state, target, options.max_cells);
  CrossingWriter<D> writer{&scene.env, state.position, target, crossings, crossings_end};
  if (crossings != nullptr) {
    *writer.next++ = {volume_id(scene.env.map, state.cell), {0, 0, 0}, 0};
    request.crossing = CrossingWriter<D>::write;
    request.crossing_user = &writer;
  }
  const MoveResult<D> result = move_point(scene.env, request, options.detail && flight != nullptr,
                                          statistics == nullptr ? nullptr : &statistics->cast);
  if (statistics != nullptr) {
    const bool left = result.cast.cells_visited > 1;
    statistics->forecast_hits += left && result.cast.first_facet == state.forecast ? 1 : 0;
    statistics->contacts += result.cast.end == CastEnd::kHit ? 1 : 0;
    statistics->candidates += result.candidates;
  }
  state.forecast = next_forecast(scene.env, state, result);
  state.cell = result.cell;
  std::copy(result.position, result.position + D, state.position);
  if (flight != nullptr) report_move(scene.env, result, options.detail, flight);
}

/** Counts the cells of every flight and makes room for them, so that recording them later cannot fail. Costs a second
 * cast, but only where crossings are asked for, and no memory beyond the answer. */
template <int D>
void prepare_crossings(Scene<D>& scene, const dsw_particle_id* ids, size_t count, PointArray targets,
                       uint32_t max_cells) {
  Array<size_t> first(count + 1, size_t{0}, scene.crossing_first.get_allocator());
  auto body = [&](size_t begin, size_t end) noexcept {
    for (size_t i = begin; i < end; ++i) {
      first[i + 1] =
          cast(scene.env, request_of(scene.particles[ids[i].index], targets[i], max_cells), nullptr).cells_visited;
    }
  };
  share_out(scene.parallel, count, body);
  for (size_t i = 0; i < count; ++i) first[i + 1] += first[i];
  if (first[count] > scene.crossings.size()) reserve_more(scene.crossings, first[count] - scene.crossings.size());
  scene.crossings.resize(first[count]);
  scene.crossing_first.swap(first);
}

/** Runs body(begin, end, statistics) over a batch; statistics is null unless the scene counts. */
template <int D, class Body>
void run_batch(Scene<D>& scene, size_t count, const Body& body) noexcept {
  auto chunk = [&](size_t begin, size_t end) noexcept {
    if (!scene.features.statistics) return body(begin, end, nullptr);
    SceneStatistics part;  // on this thread's stack: neighbours in the array share cache lines
    body(begin, end, &part);
    scene.chunk_statistics[begin / kChunk] = part;
  };
  share_out(scene.parallel, count, chunk);
  for (const SceneStatistics& part : scene.chunk_statistics) scene.statistics.add(part);
}

template <int D>
void prepare_statistics(Scene<D>& scene, size_t count) {
  if (scene.features.statistics) scene.chunk_statistics.assign(chunk_count(count), SceneStatistics{});
}

}  // namespace

template <int D>
void check_particle(const Scene<D>& scene, dsw_particle_id id) {
  if (!scene.slots.alive(id.index, id.generation)) fail_stale(id, {"particle", false}, 0);
}

template <int D>
void check_particles(const Scene<D>& scene, const dsw_particle_id* ids, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (!scene.slots.alive(ids[i].index, ids[i].generation)) fail_stale(ids[i], {"particles", true}, i);
  }
}

template <int D>
void move_particle(Scene<D>& scene, dsw_particle_id id, const double* target, const FlightOptions& options,
                   dsw_flight* flight) {
  check_particle(scene, id);
  check_finite({target, D}, 1, D, {"target", false});
  if (scene.features.crossings) prepare_crossings(scene, &id, 1, {target, D}, options.max_cells);
  dsw_crossing* const crossings = scene.features.crossings ? scene.crossings.data() : nullptr;
  move_one(scene, scene.particles[id.index], target, options, crossings, crossings + scene.crossings.size(), flight,
           scene.features.statistics ? &scene.statistics : nullptr);
}

template <int D>
void move_particles(Scene<D>& scene, const dsw_particle_id* ids, size_t count, PointArray targets,
                    const FlightOptions& options, dsw_flight* flights) {
  check_distinct_ids(scene, ids, count);
  check_finite(targets, count, D, {"targets", true});
  prepare_statistics(scene, count);
  if (scene.features.crossings) prepare_crossings(scene, ids, count, targets, options.max_cells);
  run_batch(scene, count, [&](size_t begin, size_t end, SceneStatistics* statistics) noexcept {
    for (size_t i = begin; i < end; ++i) {
      prefetch_ahead(scene.env, i, end, [&](size_t k) { return scene.particles[ids[k].index].cell; });
      dsw_crossing *first = nullptr, *last = nullptr;
      if (scene.features.crossings) {
        first = scene.crossings.data() + scene.crossing_first[i];
        last = scene.crossings.data() + scene.crossing_first[i + 1];
      }
      move_one(scene, scene.particles[ids[i].index], targets[i], options, first, last,
               flights == nullptr ? nullptr : flights + i, statistics);
    }
  });
}

template <int D>
void cast_from_particles(Scene<D>& scene, const dsw_particle_id* ids, size_t count, PointArray to,
                         const FlightOptions& options, dsw_flight* flights) {
  check_particles(scene, ids, count);
  check_finite(to, count, D, {"to", true});
  prepare_statistics(scene, count);
  run_batch(scene, count, [&](size_t begin, size_t end, SceneStatistics* statistics) noexcept {
    for (size_t i = begin; i < end; ++i) {
      prefetch_ahead(scene.env, i, end, [&](size_t k) { return scene.particles[ids[k].index].cell; });
      const CastRequest request = request_of(scene.particles[ids[i].index], to[i], options.max_cells);
      const CastResult result = cast(scene.env, request, statistics == nullptr ? nullptr : &statistics->cast);
      if (statistics != nullptr) statistics->contacts += result.end == CastEnd::kHit ? 1 : 0;
      report_cast(scene.env, request, result, options.detail, flights + i);
    }
  });
}

template void check_particle<3>(const Scene<3>&, dsw_particle_id);
template void check_particles<3>(const Scene<3>&, const dsw_particle_id*, size_t);
template void move_particle<3>(Scene<3>&, dsw_particle_id, const double*, const FlightOptions&, dsw_flight*);
template void move_particles<3>(Scene<3>&, const dsw_particle_id*, size_t, PointArray, const FlightOptions&,
                                dsw_flight*);
template void cast_from_particles<3>(Scene<3>&, const dsw_particle_id*, size_t, PointArray, const FlightOptions&,
                                     dsw_flight*);

}  // namespace dsw
