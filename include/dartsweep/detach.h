/** @file detach.h
 * Pieces that come off: volumes that cuts and tears have separated become a body of the scene.
 * More: bindings/docs/carving.md.
 */
#ifndef DARTSWEEP_DETACH_H
#define DARTSWEEP_DETACH_H

#include "dartsweep/scene.h"
#include "dartsweep/sweep.h"
#include "dartsweep/topology.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Describes a piece; `category`, `mask` and `motion_share` as in dsw_body_desc. */
typedef struct dsw_detach_desc {
  uint32_t struct_size;
  uint32_t flags;  /**< DSW_BODY_... of the body; not START_PENETRATING. */
  dsw_level level; /**< DSW_LEVEL_EDGES_SWEPT by default. */
  uint32_t category;
  uint32_t mask;
  uint32_t halvings; /**< Most halvings and doublings of `gap`, up to 40; 0 means 32. */
  double motion_share;
  /** First distance from walls: share of the shortest edge, up to 0.25; 0 means 0.01. */
  double gap;
  dsw_volume_id volume; /**< Any volume of the piece. */
  /** Most volumes of the piece; 0: no limit. */
  size_t max_volumes;
} dsw_detach_desc;

DSW_API void dsw_detach_desc_init(dsw_detach_desc *desc, size_t size);

/** Detaches a piece: impassable volumes that only cracks join to other impassable volumes. They
 * become passable, and cracks round them are sewn. Their surface, drawn a little off the walls,
 * becomes a closed body.
 * @return DSW_STATUS_SHARED, INVALID_CELL; BAD_TOPOLOGY: the volume is passable; TOO_LARGE: more
 * than max_volumes; NOT_ENABLED: as dsw_body_create; OCCUPIED: a vertex has no free position.
 * @note Cost: O(piece + particles + bodies) expected, or O(n). */
DSW_API dsw_status dsw_environment_detach(dsw_environment *environment, const dsw_detach_desc *desc,
                                          dsw_body_id *body, dsw_change *change);

#ifdef __cplusplus
}
#endif

#endif
