// Moves and casts of particles, one and many. Everything that can fail comes first; then particles are independent, so
// their states and reports are written in place, chunk by chunk, with counters that are added up in the chunks' order.

#include <algorithm>

#include "base/batch.h"
#include "base/dimensions.h"
#include "scene/scene.h"
#include "walk/packet.h"

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
      fail(DSW_STATUS_DUPLICATE_ID, "particles[%zu] {index %u, generation %u} occurs twice", i, ids[i].index,
           ids[i].generation);
    }
    stamp = scene.stamp;
  }
}

/** The facet a particle keeps aiming at: the wall that stopped it, or that of before if it stayed in its cell. */
template <int D>
uint32_t next_forecast(const Environment<D>& env, const ParticleState<D>& state, const MoveResult<D>& result) noexcept {
  if (result.cast.end == CastEnd::kHit && result.cell == result.cast.cell) {
    return env.map.local_of(result.cast.facet, result.cell);
  }
  return result.cell == state.cell ? state.forecast : kNoFacet;
}

/** Notes that a particle came to an exit, if it did. */
template <int D>
void note_exit(const Environment<D>& env, const CastRequest& request, const MoveResult<D>& result,
               dsw_exit* exit) noexcept {
  exit->patch = result.cast.end == CastEnd::kHit ? exit_patch(env, result.cast.facet) : 0;
  if (exit->patch == 0) return;
  point_at<D>(request.from, request.to, result.time, exit->point);
  exit->time = result.time;
  exit->face = face_id(env.map, result.cast.facet);
}

/** What follows the cast of a move: the verified position, the particle's new state, the report, the exit. */
template <int D>
void finish_one(const Scene<D>& scene, ParticleState<D>& state, const CastRequest& request, const CastResult& flight,
                bool detail, dsw_flight* report, dsw_exit* exit, SceneStatistics* statistics) noexcept {
  const MoveResult<D> result = finish_move(scene.env, request, flight, detail && report != nullptr,
                                           statistics == nullptr ? nullptr : &statistics->cast);
  if (statistics != nullptr) {
    const bool left = result.cast.volumes_visited > 1;
    statistics->forecast_hits += left && result.cast.first_facet == state.forecast ? 1 : 0;
    statistics->contacts += result.cast.end == CastEnd::kHit ? 1 : 0;
    statistics->candidates += result.candidates;
  }
  if (exit != nullptr) note_exit(scene.env, request, result, exit);
  state.forecast = next_forecast(scene.env, state, result);
  state.cell = result.cell;
  std::copy(result.position, result.position + D, state.position);
  if (report == nullptr) return;
  report_move(scene.env, result, detail, report);
  if (exit != nullptr && exit->patch != 0) report->outcome = DSW_OUTCOME_EXIT;
}

/** Casts of particles' moves, a packet at a time; `done(first, packet)` is called for each, in their order. */
template <int D, class Done>
void cast_particles(Scene<D>& scene, const dsw_particle_id* ids, PointArray targets, uint32_t max_volumes,
                    bool with_crossings, size_t begin, size_t end, CastCounters* counters, const Done& done) noexcept {
  Packet<D> packet;
  CrossingWriter<D> writers[kPacket];
  while (begin < end) {
    const size_t first = begin;
    for (packet.clear(); begin < end && !packet.full(); ++begin) {
      if (begin + kRecordAhead < end) prefetch_record(scene.env, scene.particles[ids[begin + kRecordAhead].index].cell);
      const ParticleState<D>& state = scene.particles[ids[begin].index];
      CrossingWriter<D>& writer = writers[packet.count()];
      CastRequest& request = packet.add(scene.env, state.cell, state.position, targets[begin]);
      request.max_volumes = max_volumes;
      request.forecast = state.forecast;
      if (with_crossings) {
        dsw_crossing* const all = scene.crossings.data();
        writer.attach(scene.env, request, all + scene.crossing_first[begin], all + scene.crossing_first[begin + 1]);
      }
    }
    packet.run(scene.env, counters);
    done(first, packet);
  }
}

/** Counts the cells of every flight and makes room for them, so that recording them later cannot fail. Costs a second
 * cast, but only where crossings are asked for, and no memory beyond the answer. */
template <int D>
void prepare_crossings(Scene<D>& scene, const dsw_particle_id* ids, size_t count, PointArray targets,
                       uint32_t max_volumes) {
  Array<size_t> first(count + 1, size_t{0}, scene.crossing_first.get_allocator());
  auto body = [&](size_t begin, size_t end) noexcept {
    cast_particles(scene, ids, targets, max_volumes, false, begin, end, nullptr,
                   [&](size_t at, const Packet<D>& packet) {
                     for (uint32_t i = 0; i < packet.count(); ++i) first[at + i + 1] = packet.result(i).volumes_visited;
                   });
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
  if (count <= kChunk) return body(size_t{0}, count, scene.features.statistics ? &scene.statistics : nullptr);
  auto chunk = [&](size_t begin, size_t end) noexcept {
    if (!scene.features.statistics) return body(begin, end, nullptr);
    SceneStatistics part;  // on this thread's stack: neighbours in the array share cache lines
    body(begin, end, &part);
    scene.chunk_statistics[begin / kChunk] = part;
  };
  share_out(scene.parallel, count, chunk);
  if (!scene.features.statistics) return;
  for (const SceneStatistics& part : scene.chunk_statistics) scene.statistics.add(part);
}

/** Room for the counters of every chunk; a batch of one needs none. */
template <int D>
void prepare_statistics(Scene<D>& scene, size_t count) {
  if (scene.features.statistics && count > kChunk) scene.chunk_statistics.assign(chunk_count(count), SceneStatistics{});
}

/** Leaves the particles that have come to an exit, in their order, and removes them if they leave. */
template <int D>
void gather_exits(Scene<D>& scene, const dsw_particle_id* ids, bool leave) noexcept {
  Array<dsw_exit>& exits = scene.exits;
  size_t kept = 0;
  for (size_t i = 0; i < exits.size(); ++i) {
    if (exits[i].patch == 0) continue;
    exits[kept] = exits[i];
    exits[kept++].particle = ids[i];
    if (leave) destroy_particle(scene, ids[i].index);
  }
  exits.erase(exits.begin() + static_cast<ptrdiff_t>(kept), exits.end());
}

/** Moves particles whose ids and targets are in order. */
template <int D>
void move_checked(Scene<D>& scene, const dsw_particle_id* ids, size_t count, PointArray targets,
                  const FlightOptions& options, dsw_flight* flights) {
  prepare_statistics(scene, count);
  Array<dsw_exit> room(scene.env.exits.empty() ? 0 : count, dsw_exit{}, scene.memory);
  if (scene.features.crossings) prepare_crossings(scene, ids, count, targets, options.max_volumes);
  scene.exits.swap(room);  // of each particle, until they are gathered
  dsw_exit* const exits = scene.exits.empty() ? nullptr : scene.exits.data();
  run_batch(scene, count, [&](size_t begin, size_t end, SceneStatistics* statistics) noexcept {
    cast_particles(scene, ids, targets, options.max_volumes, scene.features.crossings, begin, end,
                   statistics == nullptr ? nullptr : &statistics->cast, [&](size_t first, const Packet<D>& packet) {
                     for (uint32_t i = 0; i < packet.count(); ++i) {
                       finish_one(scene, scene.particles[ids[first + i].index], packet.request(i), packet.result(i),
                                  options.detail, flights == nullptr ? nullptr : flights + first + i,
                                  exits == nullptr ? nullptr : exits + first + i, statistics);
                     }
                   });
  });
  for (size_t i = 0; scene.features.live && i < count; ++i) note_particle(scene, ids[i].index);
  gather_exits(scene, ids, options.leave);
}

}  // namespace

template <int D>
void check_particle(const Scene<D>& scene, dsw_particle_id id) {
  if (!scene.slots.alive(id.index, id.generation)) fail_stale(id, "particle", 0);
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
  check_finite({target, D}, 1, D, "target");
  move_checked(scene, &id, 1, {target, D}, options, flight);
}

template <int D>
void move_particles(Scene<D>& scene, const dsw_particle_id* ids, size_t count, PointArray targets,
                    const FlightOptions& options, dsw_flight* flights) {
  check_distinct_ids(scene, ids, count);
  check_finite(targets, count, D, {"targets", true});
  move_checked(scene, ids, count, targets, options, flights);
}

template <int D>
void cast_from_particles(Scene<D>& scene, const dsw_particle_id* ids, size_t count, PointArray to,
                         const FlightOptions& options, dsw_flight* flights) {
  check_particles(scene, ids, count);
  check_finite(to, count, D, {"to", true});
  prepare_statistics(scene, count);
  run_batch(scene, count, [&](size_t begin, size_t end, SceneStatistics* statistics) noexcept {
    cast_particles(scene, ids, to, options.max_volumes, false, begin, end,
                   statistics == nullptr ? nullptr : &statistics->cast, [&](size_t first, const Packet<D>& packet) {
                     dsw_flight* reports[kPacket];
                     for (uint32_t i = 0; i < packet.count(); ++i) {
                       reports[i] = flights + first + i;
                       if (statistics != nullptr && packet.result(i).end == CastEnd::kHit) ++statistics->contacts;
                     }
                     report_packet(scene.env, packet, options.detail, reports);
                   });
  });
}

DSW_INSTANTIATE(check_particle);
DSW_INSTANTIATE(check_particles);
DSW_INSTANTIATE(move_particle);
DSW_INSTANTIATE(move_particles);
DSW_INSTANTIATE(cast_from_particles);

}  // namespace dsw
