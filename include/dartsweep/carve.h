/** @file carve.h
 * Carving removes the material inside of a shape; a ligature closes a vessel. surgery.h and
 * topology.h hold here, too. More: bindings/docs/carving.md.
 */
#ifndef DARTSWEEP_CARVE_H
#define DARTSWEEP_CARVE_H

#include "dartsweep/surgery.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Flags of dsw_carve_desc. */
typedef enum dsw_carve_flag {
  DSW_CARVE_WHOLE = 1, /**< Splits no volume. */
  /** Splits no volume along the surface, and also makes those passable that the surface crosses. So
   * nothing impassable is left inside, but for invalid volumes. @since 2.1 */
  DSW_CARVE_COVER = 2
} dsw_carve_flag;

/** A shape by its closed surface, `triangles` of `points`. A point is inside if its winding number
 * is not 0. `snap` as in dsw_cut_desc. */
typedef struct dsw_carve_desc {
  uint32_t struct_size;
  uint32_t flags;
  const double *points;
  size_t point_count; /**< Below 2^28. */
  size_t point_stride_bytes;
  /** 3 indices each; neighbours are turned alike. */
  const uint32_t *triangles;
  size_t triangle_count; /**< Below 2^28. */
  /** Null: all volumes are searched; else from here through volumes inside or crossed. */
  dsw_volume_id start;
  double snap;
  /** 0: volumes are split along the surface. Above 0: impassable volumes that the surface crosses are
   * halved across their longest extent instead, and their halves again, until none that it crosses
   * is longer than this, or was halved 24 times. Volumes beside them can come to be crossed where a
   * warped face gets vertices, or by rounding, and stay. Not in the plane. @since 2.1 */
  double finest;
} dsw_carve_desc;

DSW_API void dsw_carve_desc_init(dsw_carve_desc *desc, size_t size);

/** Splits impassable volumes that the surface crosses, as dsw_environment_cut does, then makes
 * volumes with their centre inside passable.
 * @return DSW_STATUS_INDEX_OUT_OF_RANGE, BORROWED; BAD_TOPOLOGY: the surface is not closed, or a
 * triangle repeats a point; UNSUPPORTED: `finest` in the plane.
 * @note Cost: O(volumes crossed or inside, and that come of them, * log triangles); without `start`
 * also O(n). */
DSW_API dsw_status dsw_environment_carve(dsw_environment *environment, const dsw_carve_desc *desc,
                                         dsw_change *change);

/** A closed loop of `points` round a vessel, counter-clockwise from the front. Its surface has a
 * triangle for each two neighbouring points and the mean of all. `snap` as in dsw_cut_desc. */
typedef struct dsw_tie_desc {
  uint32_t struct_size;
  uint32_t flags;
  const double *points;
  size_t point_count; /**< At least 3, below 2^28. */
  size_t point_stride_bytes;
  /** Null: all volumes are searched; else from the first volume met on the way from here. */
  dsw_volume_id start;
  double snap;
} dsw_tie_desc;

DSW_API void dsw_tie_desc_init(dsw_tie_desc *desc, size_t size);

/** Closes passable space along the surface of a loop. Passable volumes that it crosses are split
 * and unsewn, as by DSW_CUT_UNSEW; those that stay whole or hold the loop become impassable.
 * @return DSW_STATUS_BORROWED.
 * @note Cost: as dsw_environment_cut; without `start` O(n log triangles). */
DSW_API dsw_status dsw_environment_tie(dsw_environment *environment, const dsw_tie_desc *desc,
                                       dsw_change *change);

#ifdef __cplusplus
}
#endif

#endif
