/** @file scene.h
 * A scene: one environment and what moves in it. A scene names the features it wants; what it does not name costs no
 * memory and no time.
 */
#ifndef DARTSWEEP_SCENE_H
#define DARTSWEEP_SCENE_H

#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Opaque. Owned by the caller from dsw_scene_create to dsw_scene_destroy. */
typedef struct dsw_scene dsw_scene;

/** Features of a scene. */
enum {
  /** Counters, see dsw_statistics. */
  DSW_FEATURE_STATISTICS = 0x1,
  /** Moves record every volume crossed, see dsw_scene_get_crossings. */
  DSW_FEATURE_CROSSINGS = 0x2,
  /** The environment can be bent, see deform.h: it belongs to this scene alone. Costs some 12 bytes a volume and 4 a vertex, and walks
   * through hexahedra take them for warped, in the plane those through polygons with more than three corners take them for ones that
   * need not be convex, also after the scene. */
  DSW_FEATURE_DEFORMING = 0x4,
  /** Bodies meet each other, and themselves where DSW_BODY_SELF_CONTACTS says so: see dsw_body_desc. Costs some 64 bytes for each
   * vertex, edge and face. */
  DSW_FEATURE_BODY_CONTACTS = 0x8,
  /** Marks and changes of the topology find who is in their way in time that follows what they touch, where they look at all particles
   * and bodies of the scene without it; no answer depends on it. Costs some 24 bytes for each particle, 64 for each vertex, edge and
   * face of bodies (once, where DSW_FEATURE_BODY_CONTACTS is named, too) and up to 1 MB after many changes of the topology; moves
   * note what has come to another place. */
  DSW_FEATURE_LIVE_CHANGES = 0x10
};

/** Describes a scene. */
typedef struct dsw_scene_desc {
  uint32_t struct_size; /**< sizeof(dsw_scene_desc). */
  uint32_t features;    /**< DSW_FEATURE_...; 0: none. */
} dsw_scene_desc;

/** Counters since creation or the last reset; exact and the same for any number of threads. */
typedef struct dsw_statistics {
  uint32_t struct_size;   /**< Set by the caller: sizeof(dsw_statistics). */
  uint32_t reserved;      /**< 0. */
  uint64_t casts;         /**< Flights, those that verify a stop included. */
  uint64_t cells_visited; /**< Volumes entered, the first of each cast included, and those that floods looked at. */
  uint64_t
      orientation_tests; /**< Plane and line tests of casts, whatever their form; those of floods and kept sequences are not counted. */
  uint64_t exact_fallbacks; /**< Of these: decided by exact arithmetic because the filter could not. */
  uint64_t ties;            /**< Of these: exactly zero, decided by the shift. */
  uint64_t forecast_hits;   /**< Moves that left their first volume through the face the particle aimed at. */
  uint64_t contacts;        /**< Flights stopped by something impassable. */
  uint64_t candidates;      /**< Positions tried when pulling stopped particles back. */
  uint64_t
      occupants_tested; /**< Particles, and vertices, edges and faces of bodies, that marking and changes of the topology
                                 have looked at; those of calls that failed are not counted. */
} dsw_statistics;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_scene_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_scene_desc_init(dsw_scene_desc *desc, size_t size);

/** Creates a scene.
 * @param environment [in] retained until the scene is destroyed; may be shared with other scenes.
 * @param desc [in] null: no features. @param scene [out] owned by the caller.
 * @return DSW_STATUS_NULL_ARGUMENT, DSW_STATUS_BAD_STRUCT_SIZE, DSW_STATUS_UNSUPPORTED, DSW_STATUS_OUT_OF_MEMORY,
 * DSW_STATUS_IN_USE: one of two scenes of an environment is to deform it.
 * @note O(1); the first with DSW_FEATURE_DEFORMING O(volumes). Thread: writer of the environment. @since 1.0 */
DSW_API dsw_status dsw_scene_create(dsw_environment *environment, const dsw_scene_desc *desc, dsw_scene **scene);

/** Destroys a scene with all it holds, its recording included: dsw_scene_stop_recording tells whether that is whole. @param scene [in] null is allowed. @return DSW_STATUS_IN_USE: it belongs to a replay.
 * @note Thread: writer of the environment. @since 1.0 */
DSW_API dsw_status dsw_scene_destroy(dsw_scene *scene);

/** The environment of a scene. @param scene [in] @return null for a null scene. @note Thread: reader. @since 1.0 */
DSW_API dsw_environment *dsw_scene_get_environment(const dsw_scene *scene);

/** Copies the counters.
 * @param scene [in] @param statistics [in,out] its struct_size set.
 * @return DSW_STATUS_NOT_NAMED without DSW_FEATURE_STATISTICS. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_statistics(const dsw_scene *scene, dsw_statistics *statistics);

/** Sets the counters to zero.
 * @param scene [in,out]
 * @return DSW_STATUS_NOT_NAMED without DSW_FEATURE_STATISTICS. @note Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_scene_reset_statistics(dsw_scene *scene);

/** Memory the scene holds, its environment excluded.
 * @param scene [in] @param bytes [out] @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_memory_bytes(const dsw_scene *scene, uint64_t *bytes);

#ifdef __cplusplus
}
#endif

#endif
