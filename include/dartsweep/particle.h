/** @file particle.h
 * Particles: points that are followed from volume to volume. A particle moves straight to its
 * target or to the first impassable face, and is pulled back there until a cast proves its move
 * free: no particle is ever inside or behind anything impassable.
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
 * @return DSW_STATUS_OUTSIDE, IMPASSABLE.
 * @note Cost: as dsw_environment_locate. */
DSW_API dsw_status dsw_particle_create(dsw_scene *scene, const double *position, dsw_volume_id hint,
                                       dsw_particle_id *particle);

/** Creates many particles, or none.
 * @param offender index of the first wrong position or hint.
 * @return DSW_STATUS_OUTSIDE, IMPASSABLE.
 * @note Cost: as dsw_environment_locate. Batch. */
DSW_API dsw_status dsw_scene_create_particles(dsw_scene *scene, const double *positions,
                                              size_t count, size_t stride_bytes,
                                              const dsw_volume_id *hints,
                                              dsw_particle_id *particles, size_t *offender);

/** Removes a particle. */
DSW_API dsw_status dsw_particle_destroy(dsw_scene *scene, dsw_particle_id particle);

/** Counts the particles. */
DSW_API dsw_status dsw_scene_get_particle_count(const dsw_scene *scene, size_t *count);

/** Copies the ids of all particles, by index. @note Cost: O(particles). */
DSW_API dsw_status dsw_scene_get_particle_ids(const dsw_scene *scene, dsw_particle_id *particles,
                                              size_t capacity, size_t *count);

/** Gives the position and volume of a particle.
 * @param position, volume may be null. */
DSW_API dsw_status dsw_particle_get_position(const dsw_scene *scene, dsw_particle_id particle,
                                             double *position, dsw_volume_id *volume);

/** Gives the state of a particle [JCD10] 3.3: the cell in which it lies, and the cell at which it
 * aims. A tie is decided by Simulation of Simplicity, so a particle lies in a volume, and never on a
 * face, an edge or a vertex.
 * @param cell may be null; its kind is DSW_CELL_VOLUME.
 * @param aimed_at may be null; the face (in the plane the side) of the volume that stopped the
 * particle last, until it leaves the volume or the volume changes; else the null cell. Its `index`
 * is that of the volume. In polyhedra of no common form, and in polygons, moves test it first.
 * @since 2.1 */
DSW_API dsw_status dsw_particle_get_state(const dsw_scene *scene, dsw_particle_id particle,
                                          dsw_cell *cell, dsw_cell *aimed_at);

/** Gives positions and volumes of particles. An id may occur many times.
 * @param positions, volumes may be null.
 * @note Cost: O(count). */
DSW_API dsw_status dsw_scene_get_particle_positions(const dsw_scene *scene,
                                                    const dsw_particle_id *particles, size_t count,
                                                    double *positions, size_t stride_bytes,
                                                    dsw_volume_id *volumes);

/** Moves a particle towards a target, as far as 1e300. At an exit it waits: a later move leads back, or
 * to the exit again. With DSW_CAST_LEAVE it is removed there.
 * @param options DSW_CAST_START_KNOWN has no effect; DSW_CAST_NO_DETAIL leaves out `contact`.
 * @param flight may be null; its volume contains its position.
 * @note Cost: O(volumes crossed), twice at a contact. Source: [JCD10] 3.3. */
DSW_API dsw_status dsw_particle_move(dsw_scene *scene, dsw_particle_id particle,
                                     const double *target, const dsw_cast_options *options,
                                     dsw_flight *flight);

/** Moves particles, each to its own target, or none.
 * @param particles distinct. @param flights may be null. @return DSW_STATUS_DUPLICATE_ID.
 * @note Cost: as dsw_particle_move. Batch. */
DSW_API dsw_status dsw_scene_move_particles(dsw_scene *scene, const dsw_particle_id *particles,
                                            size_t count, const double *targets,
                                            size_t stride_bytes, const dsw_cast_options *options,
                                            dsw_flight *flights);

/** Casts segments from particles to points. An id may occur many times.
 * @note Cost: as dsw_environment_cast. Batch. Changes statistics. */
DSW_API dsw_status dsw_scene_cast_from_particles(dsw_scene *scene, const dsw_particle_id *particles,
                                                 size_t count, const double *to,
                                                 size_t stride_bytes,
                                                 const dsw_cast_options *options,
                                                 dsw_flight *flights);

/** Gives the volumes that the last move call entered, with DSW_FEATURE_CROSSINGS. Flight i of
 * `flight_count` has crossings[`first`[i] .. first[i+1]-1]. */
DSW_API dsw_status dsw_scene_get_crossings(const dsw_scene *scene, const dsw_crossing **crossings,
                                           const size_t **first, size_t *flight_count);

/** Gives what came to an exit in the last move call of particles, in the order of that call. None after
 * the scene is loaded. @since 2.1 */
DSW_API dsw_status dsw_scene_get_exits(const dsw_scene *scene, const dsw_exit **exits,
                                       size_t *count);

/** Gives the particles in the way of the last marking call or change of the topology. */
DSW_API dsw_status dsw_scene_get_occupants(const dsw_scene *scene,
                                           const dsw_particle_id **particles, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
