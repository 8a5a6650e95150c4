/** @file snapshot.h
 * An environment as one block of memory, and what is in a scene as another: versioned, checked, the same bytes on every machine (little
 * endian). What is loaded goes on exactly like what was saved.
 */
#ifndef DARTSWEEP_SNAPSHOT_H
#define DARTSWEEP_SNAPSHOT_H

#include "dartsweep/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Writes a snapshot of an environment: cells with their ids and generations, points where they are now, labels, tags and marks. Not the
 * record of its last change (topology.h).
 * @param environment [in] @param block [out] null if capacity is 0. @param capacity_bytes [in] its size.
 * @param size_bytes [out] size needed.
 * @return DSW_STATUS_BUFFER_TOO_SMALL when 0 < capacity_bytes < *size_bytes; capacity 0 is a query.
 * @note O(n). Thread: reader. Borrowed and lent points are written too. @since 1.0 */
DSW_API dsw_status dsw_environment_save(const dsw_environment *environment, void *block, size_t capacity_bytes,
                                        size_t *size_bytes);

/** Reads a snapshot. Ids of the saved environment name the same cells in the loaded one, and every query, change and deformation gives the
 * same bits and the same new ids. Its points are its own, also where the saved one had borrowed them. The block is not trusted: lengths,
 * checksum, links and the validity of every cell are checked; of an environment that has been deformed cells may be invalid.
 * @param context [in] as for dsw_environment_create. @param block [in] any alignment. @param size_bytes [in] its size.
 * @param environment [out] owned by the caller.
 * @return DSW_STATUS_TRUNCATED, DSW_STATUS_BAD_VERSION, DSW_STATUS_CORRUPT, DSW_STATUS_OUT_OF_MEMORY.
 * @note O(n). Thread: any. @since 1.0 */
DSW_API dsw_status dsw_environment_load(dsw_context *context, const void *block, size_t size_bytes,
                                        dsw_environment **environment);

/** Writes a snapshot of what is in a scene: its features and statistics, particles and bodies with their ids and generations, the
 * contacts of each body's last move, and what bodies keep to do less work. Not what else is valid until the next call, and not the
 * environment, which has a snapshot of its own.
 * @param scene [in] @param block [out] null if capacity is 0. @param capacity_bytes [in] its size.
 * @param size_bytes [out] size needed.
 * @return As dsw_environment_save; DSW_STATUS_OUT_OF_MEMORY. @note O(what is in the scene). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_save(const dsw_scene *scene, void *block, size_t capacity_bytes, size_t *size_bytes);

/** Reads a snapshot of a scene into an environment: the one it was saved in, unchanged since, or one loaded from a snapshot of that. Ids are
 * those of the saved scene, and every move has the same results, bit for bit, and the same counters. The block is not trusted: every
 * particle has to be in its volume, every body free at its level.
 * @param environment [in] as for dsw_scene_create. @param block [in] any alignment. @param size_bytes [in] its size.
 * @param scene [out] owned by the caller.
 * @return As dsw_environment_load; DSW_STATUS_CORRUPT also if it was saved in another environment. DSW_STATUS_IN_USE as dsw_scene_create.
 * @note O(what is in the scene); each clearance (DSW_BODY_SKIP_BY_CLEARANCE) is measured again. Thread: writer of the environment.
 * @since 1.0 */
DSW_API dsw_status dsw_scene_load(dsw_environment *environment, const void *block, size_t size_bytes,
                                  dsw_scene **scene);

#ifdef __cplusplus
}
#endif

#endif
