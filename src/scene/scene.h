#pragma once
// A scene: what moves in one environment. A plain struct and functions over it; the environment is lent. What a cast
// reads of a particle lies in one compact array, apart from the bookkeeping of ids.
//
// Functions that throw do so before they change anything.

#include <cstdint>

#include "base/owned.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/slot_pool.h"
#include "dartsweep/surgery.h"
#include "environment/environment.h"
#include "query/report.h"
#include "scene/bodies.h"
#include "walk/move.h"
#include "walk/particle_state.h"

namespace dsw {

struct SceneStatistics {
  CastCounters cast;
  uint64_t forecast_hits = 0, contacts = 0, candidates = 0;
  uint64_t looked_at = 0;  // by changes of marks and topology
  void add(const SceneStatistics& o) {
    cast.add(o.cast);
    forecast_hits += o.forecast_hits;
    contacts += o.contacts;
    candidates += o.candidates;
    looked_at += o.looked_at;
  }
};

struct SceneFeatures {
  bool statistics = false, crossings = false, deforming = false, contacts = false, live = false;
};

template <int D>
class BodyMove;
template <int D>
class TogetherMove;
template <int D>
class TurningMove;
template <int D>
class TurningTogether;
template <int D>
struct Deformation;
template <int D>
struct LiveRegister;

template <int D>
struct Scene {
  static constexpr int kDimension = D;

  const Environment<D>& env;
  const Memory* memory;
  Parallel parallel;
  SceneFeatures features;
  Array<ParticleState<D>> particles{memory};  // by slot
  SlotPool slots{memory};
  Array<uint32_t> stamps{memory};  // by slot: the last batch a particle moved in, to find ids that stand twice
  uint32_t stamp = 0;
  SceneStatistics statistics;
  Array<SceneStatistics> chunk_statistics{memory};  // scratch of a batch
  Array<dsw_crossing> crossings{memory};            // of the last move
  Array<size_t> crossing_first{memory};             // flight -> start in crossings; one more at the end
  Array<dsw_exit> exits{memory};                    // of particles, of their last move
  Array<dsw_particle_id> occupants{memory};         // of the last marking call
  Array<dsw_body_id> occupant_bodies{memory};       // likewise
  Array<BodyRecord<D>> bodies{memory};              // by slot
  SlotPool body_slots{memory};
  uint32_t leaving = 0;           // bodies whose back edges are left: see scene/untested.h
  BoxGrid<D> body_boxes{memory};  // by slot, if bodies keep boxes
  // Engines that are made when they are needed first. Sources that use one include its header.
  Owned<BodyMove<D>> mover{memory};                    // what moves of single bodies keep from call to call
  Owned<TurningMove<D>> turning{memory};               // what rigid moves keep from call to call
  Owned<TurningTogether<D>> turning_together{memory};  // what rigid moves at once keep
  Owned<TogetherMove<D>> together{memory};             // what moves of all vertices at once keep from call to call
  Array<dsw_body_cut> body_cuts{memory};               // of the last cut of bodies
  Array<dsw_penetration> penetrations{memory};         // that were found last
  Array<uint32_t> offending{memory};                   // pairs of vertices of edges that were found not free
  Owned<Deformation<D>> deformation{memory};           // if enabled
  Owned<LiveRegister<D>> live{memory};                 // if enabled

  Scene(const Environment<D>& environment, const Memory* source, const Parallel& sharing, SceneFeatures wanted);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /** Whether the boxes of bodies and their parts are kept. */
  bool keeps_boxes() const { return features.contacts || features.live; }
  uint64_t memory_bytes() const;
};

struct FlightOptions {
  uint32_t max_volumes = 0;
  bool detail = true;
  bool leave = false;  // particles that come to an exit are removed
};

/** Finds the cells of `count` points and throws unless each is in a passable one; arguments as those of
 * create_particles. */
template <int D>
void place_points(const Scene<D>& scene, PointArray positions, size_t count, const dsw_volume_id* hints, bool indexed,
                  Cell* cells, size_t* offender);

/** Creates particles, all or none. `hints` may be null; `indexed` chooses how messages name the arguments
 * (positions[i], hints[i], or position, hint). `offender` is set when a position or hint is at fault. */
template <int D>
void create_particles(Scene<D>& scene, PointArray positions, size_t count, const dsw_volume_id* hints, bool indexed,
                      dsw_particle_id* ids, size_t* offender);

template <int D>
void destroy_particle(Scene<D>& scene, uint32_t slot) noexcept;

/** Throws unless the id is alive. */
template <int D>
void check_particle(const Scene<D>& scene, dsw_particle_id id);
/** Throws unless all ids are alive; the message names the position of the first that is not. */
template <int D>
void check_particles(const Scene<D>& scene, const dsw_particle_id* ids, size_t count);

/** Moves one particle that is alive; allocates nothing unless crossings are recorded or there are exits. */
template <int D>
void move_particle(Scene<D>& scene, dsw_particle_id id, const double* target, const FlightOptions& options,
                   dsw_flight* flight);

/** Moves particles, all or none; `flights` may be null. */
template <int D>
void move_particles(Scene<D>& scene, const dsw_particle_id* ids, size_t count, PointArray targets,
                    const FlightOptions& options, dsw_flight* flights);

/** Casts from particles without moving them. */
template <int D>
void cast_from_particles(Scene<D>& scene, const dsw_particle_id* ids, size_t count, PointArray to,
                         const FlightOptions& options, dsw_flight* flights);

/** Notes the cell of a particle that has been put there, if that is kept. */
template <int D>
void note_particle(Scene<D>& scene, uint32_t slot) noexcept;

/** Collects into scene.occupants the particles whose cell is among `cells`. Returns how many were looked at. */
template <int D>
size_t find_occupants(Scene<D>& scene, const Cell* cells, size_t count);
/** Collects into scene.occupants the particles in all cells with a region label. Returns how many were looked at. */
template <int D>
size_t find_occupants_of_region(Scene<D>& scene, int32_t region);

}  // namespace dsw
