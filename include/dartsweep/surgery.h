/** @file surgery.h
 * Cuts along the surface that a blade sweeps, tears, cracks that open. topology.h holds here, too.
 * The blade is exact under the shift, and may lie anywhere: along edges and faces, folded, outside.
 * Volumes that it crosses completely are split, passable or not; others stay whole, and can get
 * vertices and edges from neighbours. More: bindings/docs/cutting.md.
 */
#ifndef DARTSWEEP_SURGERY_H
#define DARTSWEEP_SURGERY_H

#include "dartsweep/scene.h"
#include "dartsweep/topology.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Flags of dsw_cut_desc. */
typedef enum dsw_cut_flag {
  /** Unsews the faces of the cut: a crack without width, which nothing passes. */
  DSW_CUT_UNSEW = 1
} dsw_cut_flag;

/** Describes a cut of the volumes connected with the first one that the blade meets. Two
 * neighbouring points of two neighbouring rows span triangles {00, 01, 11} and {00, 11, 10} (row,
 * point), counter-clockwise seen from the blade's front. */
typedef struct dsw_cut_desc {
  uint32_t struct_size;
  uint32_t flags;
  /** Rows of points: the edge of the blade at one moment each. */
  const double *points;
  size_t point_stride_bytes;
  uint32_t rows;    /**< At least 2; rows * columns is less than 2^28. */
  uint32_t columns; /**< At least 2. */
  /** Null, or where the search begins: best, a volume that the blade crosses. */
  dsw_volume_id start;
  /** Crossings of an edge nearer to an end than this share of it count as at that end. At most
   * 0.25; 0 means 0.01. */
  double snap;
} dsw_cut_desc;

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
  uint32_t flags;
  /** The crack, as in dsw_change: pairs of faces of the outer boundary that lie on each other, or
   * faces between two volumes, by any id. */
  const dsw_cut_face *faces;
  size_t face_count;
  double width; /**< Above 0: distance of a vertex's copies. */
  /** Region label of the gap. If not 0, passable volumes with this label also count as space to
   * open into. */
  int32_t region;
  uint32_t tag; /**< Host tag of the gap. */
} dsw_open_crack_desc;

/** Writes the defaults; `width` has none. */
DSW_API void dsw_open_crack_desc_init(dsw_open_crack_desc *desc, size_t size);

/** Opens a crack [JCD10] 5.2. Its lips move apart, and a passable volume for each face that opens
 * fills the gap, sewn to its neighbours and to lips without marks. A vertex comes apart where the
 * crack divides the volumes round it into two sets, and less where a volume would become invalid.
 * Faces between impassable volumes alone open into passable ones at the rim.
 * @return DSW_STATUS_DUPLICATE_ID, BORROWED; BAD_TOPOLOGY: a pair's faces do not lie on each other,
 * are of one volume, or not on the outer boundary.
 * @note Cost: O(volumes at the crack), and local. */
DSW_API dsw_status dsw_environment_open_crack(dsw_environment *environment,
                                              const dsw_open_crack_desc *desc, dsw_change *change);

/** One place where a blade has cut an edge of a `body`. @since 2.1 */
typedef struct dsw_body_cut {
  double point[3];       /**< Where the blade crosses the edge, rounded. */
  double edge_parameter; /**< Its place on the edge, rounded: the weight of ends[1]. */
  dsw_body_id body;
  dsw_body_edge_id edge;      /**< The edge that was cut; its id is stale. */
  dsw_body_vertex_id ends[2]; /**< Ends of that edge, which stay. */
  /** The free ends at the cut, on the side of each of `ends`. Null: no part is left between the cut
   * and the next one, or the end of the edge. */
  dsw_body_vertex_id vertices[2];
  dsw_body_edge_id parts[2]; /**< The edges that end there, or null. */
} dsw_body_cut;

/** Cuts edges of bodies along the surface that a blade sweeps: exactly those which cross it, by the
 * shift (base.h), with the blade as the body. Both sides of a cut get an end of their own, next to the
 * blade, on their own side of it. A part for which there is no free place goes. An edge of triangles
 * goes with its triangles, without parts. A thick body with DSW_BODY_SELF_CONTACTS also loses what would
 * be nearer to the other side than 2 radii. The environment stays: see dsw_environment_cut.
 * @param desc the blade; `flags`, `start` and `snap` must be 0.
 * @param bodies distinct; null, with `count` 0: all.
 * @param cut_count may be null; see dsw_scene_get_body_cuts.
 * @return DSW_STATUS_DUPLICATE_ID; OCCUPIED: parts of a thick body would be too near to each other.
 * @note Cost: O(edges of the bodies * log triangles), and for each cut as dsw_body_add_edge.
 * @since 2.1 */
DSW_API dsw_status dsw_scene_cut_bodies(dsw_scene *scene, const dsw_cut_desc *desc,
                                        const dsw_body_id *bodies, size_t count, size_t *cut_count);

/** Gives the cuts of the last dsw_scene_cut_bodies: in the order of the bodies and edges, along each
 * edge from ends[0]. @since 2.1 */
DSW_API dsw_status dsw_scene_get_body_cuts(const dsw_scene *scene, const dsw_body_cut **cuts,
                                           size_t *count);

#ifdef __cplusplus
}
#endif

#endif
