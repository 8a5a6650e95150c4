/** @file particle.h
 * Particles: followed points. A particle lies in one passable volume, exactly, and moves in straight flights that end
 * at their target or at the first impassable face. A stopped particle is pulled back along its path until the move
 * from where it was to where it is has been verified free, so it is never inside or behind anything impassable.
 */
#ifndef DARTSWEEP_PARTICLE_H
#define DARTSWEEP_PARTICLE_H

#include "dartsweep/contact.h"
#include "dartsweep/query.h"
#include "dartsweep/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Creates a particle.
 * @param scene [in,out] @param position [in] as many finite doubles as there are dimensions. @param hint [in] a volume near it, or null id.
 * @param particle [out] its id.
 * @return DSW_STATUS_NON_FINITE, DSW_STATUS_STALE_ID (hint), DSW_STATUS_OUTSIDE, DSW_STATUS_IMPASSABLE,
 * DSW_STATUS_OUT_OF_MEMORY.
 * @note As dsw_environment_locate. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_particle_create(dsw_scene *scene, const double *position, dsw_volume_id hint,
                                       dsw_particle_id *particle);

/** Creates many particles, or none.
 * @param scene [in,out] @param positions [in] `count` points, stride_bytes apart (0 means 8 * dimension).
 * @param count, stride_bytes [in] @param hints [in] null, or `count` ids of which any may be null.
 * @param particles [out] `count` ids.
 * @param offender [out] may be null: on DSW_STATUS_OUTSIDE, IMPASSABLE, NON_FINITE and STALE_ID the first position at
 * fault.
 * @return as dsw_particle_create. @note Thread: writer; uses the parallel-for. @since 1.0 */
DSW_API dsw_status dsw_scene_create_particles(dsw_scene *scene, const double *positions, size_t count,
                                              size_t stride_bytes, const dsw_volume_id *hints,
                                              dsw_particle_id *particles, size_t *offender);

/** Removes a particle; its id becomes stale.
 * @param scene [in,out] @param particle [in] @return DSW_STATUS_STALE_ID. @note O(1). Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_particle_destroy(dsw_scene *scene, dsw_particle_id particle);

/** How many particles there are.
 * @param scene [in] @param count [out] @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_particle_count(const dsw_scene *scene, size_t *count);

/** Ids of the particles of a scene, by index.
 * @param scene [in] @param particles [out] `capacity` ids. @param capacity [in] its entries.
 * @param count [out] how many there are.
 * @return DSW_STATUS_BUFFER_TOO_SMALL. @note O(particles). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_particle_ids(const dsw_scene *scene, dsw_particle_id *particles, size_t capacity,
                                              size_t *count);

/** Position and volume of a particle; either may be null.
 * @param scene, particle [in] @param position [out] as many doubles as there are dimensions. @param volume [out]
 * @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_particle_get(const dsw_scene *scene, dsw_particle_id particle, double *position,
                                    dsw_volume_id *volume);

/** Positions and volumes of many particles.
 * @param scene [in] @param particles [in] `count` live ids; an id may stand many times. @param count [in]
 * @param positions [out] null, or `count` points, stride_bytes apart (0 means 8 * dimension). @param stride_bytes [in]
 * @param volumes [out] null, or `count` ids.
 * @return DSW_STATUS_STALE_ID (the message names the position), DSW_STATUS_WRONG_SIZE (stride): nothing was written.
 * @note O(count). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_particles(const dsw_scene *scene, const dsw_particle_id *particles, size_t count,
                                           double *positions, size_t stride_bytes, dsw_volume_id *volumes);

/** Moves a particle towards a target.
 * @param scene [in,out] @param particle [in]
 * @param target [in] as many finite doubles as there are dimensions; 1e300 is a move that ends next to the first wall, as any other.
 * @param options [in] null: defaults; DSW_CAST_START_KNOWN has no effect. With DSW_CAST_NO_DETAIL the report has no
 * normal and no ids of the hit; position, time and volume are always exact. @param flight [out] may be null.
 * @return DSW_STATUS_OK also when something stopped the move. DSW_STATUS_STALE_ID, DSW_STATUS_NON_FINITE.
 * @note O(volumes crossed), twice when stopped, independent of the size of the environment. Thread: writer. Certain:
 * nothing impassable was passed and the volume reported contains the position. Source: [JCD10] 3.3.
 * @since 1.0 */
DSW_API dsw_status dsw_particle_move(dsw_scene *scene, dsw_particle_id particle, const double *target,
                                     const dsw_cast_options *options, dsw_flight *flight);

/** Moves many particles, each to its own target, independently of each other.
 * @param scene [in,out] @param particles [in] `count` distinct live ids. @param count [in]
 * @param targets [in] `count` points, stride_bytes apart (0 means 8 * dimension). @param stride_bytes [in]
 * @param options [in] may be null. @param flights [out] null, or `count` reports.
 * @return DSW_STATUS_STALE_ID, DSW_STATUS_DUPLICATE_ID, DSW_STATUS_NON_FINITE (the message names the position),
 * DSW_STATUS_OUT_OF_MEMORY: nothing has moved.
 * @note Thread: writer; uses the parallel-for; the same bits for any number of threads. @since 1.0 */
DSW_API dsw_status dsw_scene_move_particles(dsw_scene *scene, const dsw_particle_id *particles, size_t count,
                                            const double *targets, size_t stride_bytes, const dsw_cast_options *options,
                                            dsw_flight *flights);

/** Casts segments from particles without moving them: segment i goes from the position of particles[i] to point i.
 * An id may stand many times (the edges of a body).
 * @param scene [in,out] @param particles, count [in] @param to [in] `count` points, stride_bytes apart (0 means 24, in the plane 16).
 * @param stride_bytes [in] @param options [in] may be null. @param flights [out] `count` reports.
 * @return as dsw_scene_move_particles, without DSW_STATUS_DUPLICATE_ID. @note Thread: writer (statistics); uses the
 * parallel-for. @since 1.0 */
DSW_API dsw_status dsw_scene_cast_from_particles(dsw_scene *scene, const dsw_particle_id *particles, size_t count,
                                                 const double *to, size_t stride_bytes, const dsw_cast_options *options,
                                                 dsw_flight *flights);

/** The volumes that the particles of the last move call entered, in the order of the batch, with DSW_FEATURE_CROSSINGS.
 * Flight i has crossings[first[i] .. first[i+1]-1].
 * @param scene [in] @param crossings, first [out] owned by the scene, valid until its next move.
 * @param flight_count [out] of that call.
 * @return DSW_STATUS_NOT_NAMED. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_crossings(const dsw_scene *scene, const dsw_crossing **crossings, const size_t **first,
                                           size_t *flight_count);

/** The particles that made the last marking call answer DSW_STATUS_OCCUPIED, or that it skipped.
 * @param scene [in] @param particles [out] owned by the scene, valid until the next marking call.
 * @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_occupants(const dsw_scene *scene, const dsw_particle_id **particles, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
