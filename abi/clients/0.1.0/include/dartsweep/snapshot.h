/** @file snapshot.h
 * An environment, its labels, tags and marks as one block of memory: versioned, checked, the same bytes on every
 * machine (little endian).
 */
#ifndef DARTSWEEP_SNAPSHOT_H
#define DARTSWEEP_SNAPSHOT_H

#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Writes a snapshot.
 * @param block [out] null if capacity is 0. @param capacity_bytes [in] its size. @param size_bytes [out] size needed.
 * @return DSW_STATUS_BUFFER_TOO_SMALL when 0 < capacity_bytes < *size_bytes; capacity 0 is a query. DSW_STATUS_INVALID_CELL: a volume of a
 * deformed environment is not valid. DSW_STATUS_UNSUPPORTED once the topology has changed (topology.h): the format does not keep that yet.
 * @note O(n). Thread: reader. Borrowed points are written too. @since 0.1 */
DSW_API dsw_status dsw_environment_save(const dsw_environment *environment, void *block, size_t capacity_bytes,
                                        size_t *size_bytes);

/** Reads a snapshot. Ids of the saved environment name the same cells in the loaded one, and every query gives the
 * same bits. The block is not trusted: lengths, checksum, links and the validity of every cell are checked.
 * @param context [in] as for dsw_environment_create. @param block [in] any alignment.
 * @param environment [out] owned by the caller.
 * @return DSW_STATUS_TRUNCATED, DSW_STATUS_BAD_VERSION, DSW_STATUS_CORRUPT, DSW_STATUS_OUT_OF_MEMORY.
 * @note O(n). Thread: any. @since 0.1 */
DSW_API dsw_status dsw_environment_load(dsw_context *context, const void *block, size_t size_bytes,
                                        dsw_environment **environment);

#ifdef __cplusplus
}
#endif

#endif
