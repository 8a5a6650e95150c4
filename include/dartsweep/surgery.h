/** @file surgery.h
 * Cuts along the surface that a blade sweeps, tears, cracks that open. What topology.h says holds
 * here, too. More: bindings/docs/cutting.md.
 *
 * The blade is exact under the shift, and may lie anywhere: along edges and faces, folded, outside.
 * Volumes that it crosses completely are split, passable or not. A volume stays whole if the blade
 * ends inside, crosses one of its edges twice, or would leave an invalid part. It can still get
 * vertices and edges from neighbours.
 */
#ifndef DARTSWEEP_SURGERY_H
#define DARTSWEEP_SURGERY_H

#include "dartsweep/topology.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Flags of dsw_cut_desc. */
typedef enum dsw_cut_flag {
  /** Unsews the faces of the cut: a crack without width, which nothing passes. */
  DSW_CUT_UNSEW = 1
} dsw_cut_flag;

/** Describes a cut. Two neighbouring points of two neighbouring rows span the triangles {00, 01,
 * 11} and {00, 11, 10} of the blade (row, point), counter-clockwise seen from its front. Only
 * volumes connected with the first one that the blade meets are cut. */
typedef struct dsw_cut_desc {
  uint32_t struct_size;
  uint32_t flags; /**< DSW_CUT_... */
  /** Rows of points: each row is the edge of the blade at one moment. */
  const double *points;
  size_t point_stride_bytes; /**< As every stride. */
  uint32_t rows;             /**< At least 2; rows * columns is less than 2^28. */
  uint32_t columns;          /**< At least 2. */
  /** Null, or where the search begins: at best a volume that the blade crosses. */
  dsw_volume_id start;
  /** A crossing of an edge nearer to an end than this share of the edge counts as at that end. At
   * most 0.25; 0 means 0.01. */
  double snap;
} dsw_cut_desc;

/** Writes the defaults. */
DSW_API void dsw_cut_desc_init(dsw_cut_desc *desc, size_t size);

/** Cuts an environment along a blade. In a split volume the part in front keeps the index.
 * @return DSW_STATUS_BORROWED.
 * @note Cost: O(pairs of a triangle and a volume that meet, and on the way to the blade), and
 * local. */
DSW_API dsw_status dsw_environment_cut(dsw_environment *environment, const dsw_cut_desc *desc,
                                       dsw_change *change);

/** Unsews faces with a load above a threshold. Faces of the outer boundary stay.
 * @param faces an id may occur twice.
 * @param loads, threshold in the host's unit; may be infinite.
 * @note Cost: O(count), and local. */
DSW_API dsw_status dsw_environment_tear_faces(dsw_environment *environment,
                                              const dsw_face_id *faces, const double *loads,
                                              size_t count, double threshold, dsw_change *change);

/** Describes how a crack opens. */
typedef struct dsw_open_crack_desc {
  uint32_t struct_size;
  uint32_t flags; /**< 0. */
  /** The crack, as in dsw_change: pairs of faces of the outer boundary that lie on each other, or
   * faces between two volumes, by any id. */
  const dsw_cut_face *faces;
  size_t face_count; /**< How many. */
  double width;      /**< Above 0: distance of the two copies of a vertex. */
  /** Region label of the gap. If not 0, passable volumes with this label also count as the space
   * into which the crack opens. */
  int32_t region;
  uint32_t tag; /**< Host tag of the gap. */
} dsw_open_crack_desc;

/** Writes the defaults; `width` has none. */
DSW_API void dsw_open_crack_desc_init(dsw_open_crack_desc *desc, size_t size);

/** Opens a crack. Its lips move apart, and a passable volume for each face that opens fills the
 * gap, sewn to its neighbours and to lips without marks. A vertex comes apart where the crack
 * divides the volumes round it into two sets. Its copies move less where a volume would become
 * invalid. To open into passable volumes at the rim, give only faces between impassable volumes. In
 * `change` both copies are new vertices, with the old vertex twice in `from`. Lips, and added
 * volumes at the end of `volumes`, have the order of `faces`.
 * @return DSW_STATUS_DUPLICATE_ID, BORROWED; BAD_TOPOLOGY: two faces of a pair do not lie on each
 * other, are of one volume, or are not on the outer boundary.
 * @note Cost: O(volumes at the crack), and local. Source: [JCD10] 5.2. */
DSW_API dsw_status dsw_environment_open_crack(dsw_environment *environment,
                                              const dsw_open_crack_desc *desc, dsw_change *change);

#ifdef __cplusplus
}
#endif

#endif
