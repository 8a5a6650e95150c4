/** @file snapshot.h
 * Environments and scenes as blocks of bytes, the same on every machine. What is loaded goes on
 * with the ids and bits of what was saved. A `block` of `size_bytes` needs no alignment, and is not
 * trusted: lengths, checksum, links, cells, particles and bodies are checked.
 */
#ifndef DARTSWEEP_SNAPSHOT_H
#define DARTSWEEP_SNAPSHOT_H

#include "dartsweep/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Saves an environment without its last change. @note Cost: O(n). */
DSW_API dsw_status dsw_environment_save(const dsw_environment *environment, void *block,
                                        size_t capacity_bytes, size_t *size_bytes);

/** Loads an environment, which owns its points. Cells may be invalid only if it had been deformed.
 * @return DSW_STATUS_TRUNCATED, BAD_VERSION, CORRUPT.
 * @note Cost: O(n). Thread: any. */
DSW_API dsw_status dsw_environment_load(dsw_context *context, const void *block, size_t size_bytes,
                                        dsw_environment **environment);

/** Saves a scene without its environment; of earlier results only the contacts of each body's last
 * move.
 * @note Cost: O(contents of the scene). */
DSW_API dsw_status dsw_scene_save(const dsw_scene *scene, void *block, size_t capacity_bytes,
                                  size_t *size_bytes);

/** Loads a scene into its environment, unchanged since then, or loaded from a snapshot of that.
 * @param environment retained.
 * @return DSW_STATUS_TRUNCATED, BAD_VERSION; CORRUPT: also another environment; IN_USE: as
 * dsw_scene_create.
 * @note Cost: O(contents of the scene); clearances are measured again. */
DSW_API dsw_status dsw_scene_load(dsw_environment *environment, const void *block,
                                  size_t size_bytes, dsw_scene **scene);

#ifdef __cplusplus
}
#endif

#endif
