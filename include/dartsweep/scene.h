/** @file scene.h
 * A scene: an environment, and particles and bodies in it. Features that are not enabled cost
 * nothing.
 */
#ifndef DARTSWEEP_SCENE_H
#define DARTSWEEP_SCENE_H

#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Opaque. */
typedef struct dsw_scene dsw_scene;

/** Features of a scene. */
enum {
  /** Counts: see dsw_statistics. Moves of particles take about a third longer. */
  DSW_FEATURE_STATISTICS = 0x1,
  /** Moves record crossings: dsw_scene_get_crossings. */
  DSW_FEATURE_CROSSINGS = 0x2,
  /** The environment can deform (deform.h) and belongs to this scene alone: about 12 bytes a volume
   * and 4 a vertex. From then on, also without the scene, casts take hexahedra as warped. */
  DSW_FEATURE_DEFORMING = 0x4,
  /** Bodies meet each other, with DSW_BODY_SELF_CONTACTS also themselves: about 64 bytes for each
   * vertex, edge and face. */
  DSW_FEATURE_BODY_CONTACTS = 0x8,
  /** Marks and changes of the topology check only particles and bodies that are near: about 24
   * bytes a particle, the 64 bytes of DSW_FEATURE_BODY_CONTACTS once for both, up to 1 MB after
   * many changes. */
  DSW_FEATURE_LIVE_CHANGES = 0x10
};

/** Describes a scene. */
typedef struct dsw_scene_desc {
  uint32_t struct_size;
  uint32_t features; /**< DSW_FEATURE_...; 0: none. */
} dsw_scene_desc;

/** Counters since creation or reset, for any number of threads. */
typedef struct dsw_statistics {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t casts; /**< Casts, also those that verify a stop. */
  /** Volumes entered by casts or visited by sweeps. */
  uint64_t volumes_visited;
  uint64_t orientation_tests; /**< Plane and line tests of casts. */
  /** Tests that needed exact arithmetic. */
  uint64_t exact_fallbacks;
  uint64_t ties;          /**< Tests that were 0 without the shift. */
  uint64_t forecast_hits; /**< Moves that left their first volume as expected. */
  uint64_t contacts;      /**< Casts that ended at something impassable. */
  uint64_t candidates;    /**< Positions tried at stops of particles. */
  /** Particles and parts of bodies checked by successful changes. */
  uint64_t occupants_tested;
} dsw_statistics;

DSW_API void dsw_scene_desc_init(dsw_scene_desc *desc, size_t size);

/** Creates a scene.
 * @param environment retained.
 * @param desc null: no features.
 * @return DSW_STATUS_IN_USE: two scenes would share an environment that can deform.
 * @note Cost: O(1), the first time with DSW_FEATURE_DEFORMING O(n). */
DSW_API dsw_status dsw_scene_create(dsw_environment *environment, const dsw_scene_desc *desc,
                                    dsw_scene **scene);

/** Destroys a scene. Only dsw_scene_stop_recording tells whether a recording is complete.
 * @return DSW_STATUS_IN_USE: it belongs to a replay.
 * @note Thread: writer of the environment. */
DSW_API dsw_status dsw_scene_destroy(dsw_scene *scene);

/** Returns the environment of a scene.
 * @return null for a null scene. */
DSW_API dsw_environment *dsw_scene_get_environment(const dsw_scene *scene);

/** Copies the counters of DSW_FEATURE_STATISTICS. */
DSW_API dsw_status dsw_scene_get_statistics(const dsw_scene *scene, dsw_statistics *statistics);

/** Sets the counters of DSW_FEATURE_STATISTICS to zero. */
DSW_API dsw_status dsw_scene_reset_statistics(dsw_scene *scene);

/** Gives the memory of a scene in `bytes`, without its environment. */
DSW_API dsw_status dsw_scene_get_memory_bytes(const dsw_scene *scene, uint64_t *bytes);

#ifdef __cplusplus
}
#endif

#endif
