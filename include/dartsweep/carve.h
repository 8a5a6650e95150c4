/** @file carve.h
 * Material removed inside of a shape, and vessels tied. (To remove volumes by list is to mark them passable, see marking.h.) Each is one
 * change, made of a cut and of marks; what surgery.h says of cuts and topology.h of ids, labels, particles, bodies, threads and cost holds
 * here, and the same getters tell what became of what: dsw_environment_get_volume_changes, dsw_environment_get_cut_vertices,
 * dsw_environment_get_cut_faces, dsw_environment_get_whole_volumes.
 *
 * Both surfaces are triangles, thought of as shifted by one infinitesimal, so that every answer to what they cross and hold is exact and
 * none is degenerate. They may pass through vertices, along edges and faces, through themselves, and leave the environment. Volumes of a
 * bent environment that are invalid then count as impassable, and are neither carved nor looked through.
 *
 * In the plane both are lines of segments; what surgery.h says of the blade there holds for them. A shape is bounded by closed lines, and a vessel is
 * tied along a line that leads from wall to wall.
 */
#ifndef DARTSWEEP_CARVE_H
#define DARTSWEEP_CARVE_H

#include "dartsweep/surgery.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Flags of dsw_carve_desc. */
typedef enum dsw_carve_flag {
  /** Nothing is split: volumes are carved as they are, or not. */
  DSW_CARVE_WHOLE = 1
} dsw_carve_flag;

/** Describes a shape by its closed surface. Arrays are read in place, once; nothing is retained. A point is inside of the shape if the
 * surface turns round it, once or more, in any sense (its winding number is not 0). */
typedef struct dsw_carve_desc {
  uint32_t struct_size;      /**< sizeof(dsw_carve_desc). */
  uint32_t flags;            /**< DSW_CARVE_... */
  const double *points;      /**< 3 doubles each (in the plane 2), scene units, finite. */
  size_t point_count;        /**< Below 2^28. */
  size_t point_stride_bytes; /**< Distance of two points; 0 means 24, in the plane 16. */
  const uint32_t
      *triangles;        /**< 3 different indices of points each; the front is where they are counter-clockwise. Each
                                  side is shared with another triangle, which runs along it the other way. Triangles may be flat.
                                  In the plane segments, 2 different indices each: where one ends another begins. */
  size_t triangle_count; /**< Below 2^28; in the plane of the segments. */
  dsw_volume_id
      start;   /**< Null: the whole environment is looked through. Else only volumes are split and carved that hang
                            together, through volumes that are inside or that the surface crosses, with this one; or, if it is
                            neither, with the first that is crossed, searched as by dsw_environment_cut. */
  double snap; /**< As in dsw_cut_desc. */
} dsw_carve_desc;

/** What a carving did. */
typedef struct dsw_carve_report {
  dsw_cut_report cut;      /**< Of the cut along the surface. */
  uint32_t volumes_carved; /**< See dsw_environment_get_carved_volumes. */
  uint32_t reserved;       /**< 0. */
} dsw_carve_report;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_carve_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_carve_desc_init(dsw_carve_desc *desc, size_t size);

/** Makes volumes passable that are inside of a shape. First impassable volumes that its surface crosses are split along it, as
 * dsw_environment_cut splits them (those that it could not split stay whole, and so do passable ones, and those of which both parts or
 * neither would be inside). Then each impassable volume with its centre inside of the shape becomes passable; exactly, that of dsw_environment_get_centre after the call. Others keep their marks,
 * and so do faces, edges and vertices.
 * @param environment [in,out] @param desc [in] see dsw_carve_desc.
 * @param report [out] may be null. That nothing is carved is a result, too.
 * @return besides those of topology.h: DSW_STATUS_BAD_STRUCT_SIZE, UNSUPPORTED (flags), OUT_OF_RANGE (snap, no triangles), WRONG_SIZE
 * (point_stride_bytes), NON_FINITE, INDEX_OUT_OF_RANGE (triangles), STALE_ID (start), BORROWED (vertices have to be added, and the
 * points are the host's); BAD_TOPOLOGY: the surface is not closed, or a triangle names a point twice. INVALID_CELL and BAD_CELL do not
 * occur: such volumes stay whole. OCCUPIED: a wall would move by a rounding into a body or over a particle.
 * @note O(volumes that are crossed or inside), with a search in a tree of the triangles for each of these and of those beside them; without
 * `start` one for every volume in the surface's box, and O(volumes). @since 1.0 */
DSW_API dsw_status dsw_environment_carve(dsw_environment *environment, const dsw_carve_desc *desc,
                                         dsw_carve_report *report);

/** Volumes that the last successful carving made passable. Ids are those from right after it; those that were passable before are not
 * among them.
 * @param environment [in] @param volumes [out] owned by the environment, valid until its next carving.
 * @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_carved_volumes(const dsw_environment *environment, const dsw_volume_id **volumes,
                                                      size_t *count);

/** Describes a ligature: a closed loop of points round a vessel, and the surface that it spans, triangles between two neighbouring points
 * and the loop's centre, the mean of its points. Its front is where the loop is counter-clockwise. The array is read in place, once;
 * nothing is retained. In the plane it is a line across the vessel, of segments between neighbouring points, with its front on the right. */
typedef struct dsw_tie_desc {
  uint32_t struct_size; /**< sizeof(dsw_tie_desc). */
  uint32_t flags;       /**< 0. */
  const double
      *points; /**< 3 doubles each, scene units, finite; the last is joined with the first. In the plane 2 doubles
                                  each, from the line's one end to the other. */
  size_t point_count;        /**< At least 3 (in the plane 2), below 2^28. */
  size_t point_stride_bytes; /**< Distance of two points; 0 means 24, in the plane 16. */
  dsw_volume_id
      start;   /**< Null: the whole environment is looked through. Else what hangs together with the first volume that
                            the surface meets, searched as by dsw_environment_cut, is closed. */
  double snap; /**< As in dsw_cut_desc. */
} dsw_tie_desc;

/** What a tie did. */
typedef struct dsw_tie_report {
  dsw_cut_report cut; /**< Of the cut along the surface; volumes_whole have become impassable. */
  uint32_t
      is_closed; /**< 1: the surface meets passable volumes, and the loop (in the plane the line's ends) lies in none, so that it
                            goes all round what is closed. 0: one can get past the loop. */
  uint32_t reserved; /**< 0. */
} dsw_tie_report;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_tie_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_tie_desc_init(dsw_tie_desc *desc, size_t size);

/** Closes what is passable over a loop. Passable volumes that the surface crosses are split along it and the faces of the cut are unsewn, as
 * by dsw_environment_cut with DSW_CUT_UNSEW; those that it crosses and that stay whole become impassable, and so does what holds
 * the loop itself. Impassable volumes are not split.
 * Afterwards nothing gets through the surface: what begins and ends in volumes that it did not meet, on a way that crosses it once, is
 * stopped. (Where the cut is not on the surface itself, up to the reported distance, both sides of the surface are on one side of the cut.)
 * A loop that lies in passable volumes is a result, not an error: see is_closed.
 * To undo it, sew the faces of dsw_environment_get_cut_faces (dsw_environment_sew_faces) and mark the volumes of
 * dsw_environment_get_whole_volumes passable; volumes that were split stay so.
 * @param environment [in,out] @param desc [in] see dsw_tie_desc. @param report [out] may be null.
 * @return besides those of topology.h: DSW_STATUS_BAD_STRUCT_SIZE, UNSUPPORTED (flags), OUT_OF_RANGE (point_count, snap), WRONG_SIZE
 * (point_stride_bytes), NON_FINITE, STALE_ID (start), BORROWED. INVALID_CELL and BAD_CELL do not occur. OCCUPIED: a particle or a body
 * is in a volume that would become impassable, or a body crosses the cut.
 * @note Cost as that of dsw_environment_cut; without `start` a search in a tree of the triangles for every volume. @since 1.0 */
DSW_API dsw_status dsw_environment_tie(dsw_environment *environment, const dsw_tie_desc *desc, dsw_tie_report *report);

#ifdef __cplusplus
}
#endif

#endif
