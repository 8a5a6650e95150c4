/** @file remesh.h
 * Invalid volumes are mended: with a few of their neighbours they go, and valid ones take their place. Made of the basic operations of topology.h
 * (merging of volumes, flips and collapses of edges) as one change; what is said there of ids, labels, marks, particles, bodies and
 * threads holds here, and dsw_environment_get_volume_changes lists what became of what. No vertex is moved or added, so it
 * works on borrowed points as well.
 *
 * Volumes become invalid when an environment bends far (deform.h). They can be mended before: given the positions that come
 * next, everything that takes their place is valid in these and in the present ones.
 *
 * How. A patch of volumes grows round an invalid one, by the neighbour that brings it nearest to a valid one, until it can be
 * filled: by tetrahedra that all have one vertex, or by one volume. Never do more volumes come than go. A patch has one mark,
 * region label and tag; marked faces, edges and vertices stay. What cannot be mended so within a radius is left as it is: above all where
 * walls have passed through each other.
 *
 * Of space alone: in the plane DSW_STATUS_UNSUPPORTED.
 *
 * In a patch of tetrahedra each volume that comes takes the index of one that goes, and is listed with that; others that go are listed
 * as removed.
 */
#ifndef DARTSWEEP_REMESH_H
#define DARTSWEEP_REMESH_H

#include "dartsweep/topology.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Describes what is to be mended. Arrays are read in place; nothing is retained. */
typedef struct dsw_remesh_desc {
  uint32_t struct_size; /**< sizeof(dsw_remesh_desc). */
  uint32_t flags;       /**< 0. */
  const dsw_volume_id
      *volumes;        /**< Volumes to be mended if they are invalid, now or with `next`; null: all that are. */
  size_t volume_count; /**< How many. */
  const double *next; /**< 3 doubles for each vertex of the environment: positions that it is about to be bent to; null:
                         the present ones alone count. */
  size_t point_count; /**< Vertices of the environment; 0 if `next` is null. */
  uint32_t radius; /**< Rings of volumes round an invalid one that may go with it, 1 to 8; 0 means 1. Those that share a
                         vertex with it are the first ring. */
  uint32_t max_faces; /**< Faces round a patch, so also of a volume that comes: 4 to 128; 0 means 48. */
} dsw_remesh_desc;

/** What was mended. */
typedef struct dsw_remesh_report {
  uint32_t invalid_count;   /**< Volumes that were to be mended and were invalid. */
  uint32_t mended_count;    /**< Those of them that went. */
  uint32_t left_count;      /**< The others; see dsw_environment_get_unmended_volumes. */
  uint32_t patch_count;     /**< Patches. */
  uint32_t volumes_removed; /**< All volumes that went, */
  uint32_t volumes_added;   /**< and those that came. */
  uint32_t most_faces;      /**< The largest number of faces of one that came. */
  uint32_t reserved;        /**< 0. */
} dsw_remesh_report;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_remesh_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_remesh_desc_init(dsw_remesh_desc *desc, size_t size);

/** Mends invalid volumes.
 * @param environment [in,out] @param desc [in] null means all defaults.
 * @param report [out] may be null. That nothing could be mended is a result, too.
 * @return besides those of topology.h: DSW_STATUS_BAD_STRUCT_SIZE, UNSUPPORTED (flags), OUT_OF_RANGE (radius, max_faces), WRONG_SIZE
 * (point_count). BAD_TOPOLOGY, BAD_CELL and INVALID_CELL do not occur. OCCUPIED: something lies in a volume that an invalid one had come
 * to overlap, and would be in none; before a deformation, with `next`, that cannot happen. A volume with a vertex that is
 * not finite is left.
 * @note O(volumes in patches and in the rings round invalid ones), with `volumes` null O(volumes of the environment); and as topology.h
 * says. Certain: what comes is valid, exactly. Source: [JCD10] 5.2. @since 1.0 */
DSW_API dsw_status dsw_environment_remesh(dsw_environment *environment, const dsw_remesh_desc *desc,
                                          dsw_remesh_report *report);

/** Volumes that the last mending, by dsw_environment_remesh or with a deformation, left invalid, by index. Ids are those from right after
 * it.
 * @param environment [in] @param volumes [out] owned by the environment, valid until its next mending.
 * @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_unmended_volumes(const dsw_environment *environment,
                                                        const dsw_volume_id **volumes, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
