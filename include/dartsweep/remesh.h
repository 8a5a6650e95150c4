/** @file remesh.h
 * Repair: valid volumes replace invalid ones (deform.h) and a few neighbours. No vertex is moved or
 * added. What topology.h says holds here, too. More: bindings/docs/deforming.md.
 */
#ifndef DARTSWEEP_REMESH_H
#define DARTSWEEP_REMESH_H

#include "dartsweep/topology.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is repaired. */
typedef struct dsw_remesh_desc {
  uint32_t struct_size;
  uint32_t flags;
  /** Volumes to repair if invalid now or at `next`; null: all. */
  const dsw_volume_id *volumes;
  size_t volume_count;
  const double *next; /**< Null, or next positions, to repair before a deformation. */
  size_t point_count; /**< Vertices; 0 without `next`. */
  /** Rings of neighbours, by vertices, that may be replaced, 1 to 8; 0 means 1. */
  uint32_t radius;
  uint32_t max_faces; /**< Most faces of a patch, 4 to 128; 0 means 48. */
} dsw_remesh_desc;

DSW_API void dsw_remesh_desc_init(dsw_remesh_desc *desc, size_t size);

/** Repairs invalid volumes. Marks, regions and tags stay.
 * @param desc null: the defaults.
 * @return DSW_STATUS_WRONG_SIZE: point_count.
 * @note Cost: O(volumes replaced and their neighbours), or O(n) for all. Source: [JCD10] 5.2. */
DSW_API dsw_status dsw_environment_remesh(dsw_environment *environment, const dsw_remesh_desc *desc,
                                          dsw_change *change);

#ifdef __cplusplus
}
#endif

#endif
