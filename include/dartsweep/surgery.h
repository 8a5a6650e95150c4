/** @file surgery.h
 * What a surgeon or an engineer asks of an environment: a cut along the surface that a blade sweeps, tears, and cracks that open. (Shapes
 * carved out and vessels tied are in carve.h, pieces that come off in detach.h.) Each is made of the basic operations of topology.h as one
 * change; what is said there of ids, labels, marks, particles, bodies and threads holds here, and dsw_environment_get_volume_changes lists
 * what became of what.
 *
 * The blade is thought of as shifted by one infinitesimal, as bodies are, so that every answer to what it crosses is exact and
 * none is degenerate: it may pass through vertices, along edges and faces, fold, come to nothing, or lie outside. It cuts volumes that are
 * passable and impassable alike.
 *
 * What a cut does. Where the blade crosses an edge, once, this is split at the crossing, rounded; or if an end of it is
 * nearer than `snap` of its length, that vertex is taken to be on the blade, with all crossings of its edges. Faces with two such
 * points are split between them, and volumes along the loop of these lines. A volume stays whole where the blade ends inside, where
 * it crosses one of the volume's edges more than once, where the loop is not one or not clear, or where nothing valid would
 * come of it; so a cut reaches up to the last volume that is crossed completely. Such volumes can still get vertices on their edges and
 * edges on their faces, from their neighbours. On the outer boundary, the lips of earlier cracks included, the surface moves by the
 * rounding of vertices, and where a face is not flat between its old triangles and the new ones.
 *
 * In the plane (see ids.h) volumes are polygons, faces their sides, and the blade is the path of a point, segment after segment. Where it crosses a
 * side, once, this is split at the crossing, or an end that is near is on the path. A polygon with two such points is split between them;
 * it stays whole where the path ends inside, where it has other than two points, or where nothing valid would come of it.
 *
 * Cost: O(volumes that the blade meets, once for each of the blade's triangles that meets it), with what topology.h says of every
 * change; O(blade's triangles) for each volume between `start` and the blade, which are all if it meets none; never the size of the
 * environment otherwise.
 */
#ifndef DARTSWEEP_SURGERY_H
#define DARTSWEEP_SURGERY_H

#include "dartsweep/topology.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Flags of dsw_cut_desc. */
typedef enum dsw_cut_flag {
  /** The faces of the cut are unsewn: a crack without width, which nothing passes. Without it both sides stay one face. */
  DSW_CUT_UNSEW = 1
} dsw_cut_flag;

/** Describes a cut. The array is read in place, once; nothing is retained.
 * Of each four neighbouring points, 0 and 1 of two rows, {00, 01, 11} and {00, 11, 10} are triangles of the blade; its front is where these
 * are counter-clockwise. In the plane each two neighbouring places of the point are a segment of the blade; its front is on the right of the way.
 * What hangs together with the first volume that the blade meets is cut. */
typedef struct dsw_cut_desc {
  uint32_t struct_size;      /**< sizeof(dsw_cut_desc). */
  uint32_t flags;            /**< DSW_CUT_... */
  const double *points;      /**< The blade's edge, a chain of `columns` points, at `rows` places one after the other: 3
                                  doubles each (in the plane 2), scene units, finite. */
  size_t point_stride_bytes; /**< Distance of two points; 0 means 24, in the plane 16. */
  uint32_t rows;             /**< At least 2; rows * columns is less than 2^28. */
  uint32_t columns;          /**< At least 2; in the plane 1: the blade's edge is one point. */
  dsw_volume_id start; /**< A volume from which the blade is searched, always on from the volume nearest to it; at best
                                  one that it crosses. Null: the volume of the first point of the blade that is in any,
                                  found as by dsw_environment_locate without a hint; else any volume. */
  double snap;         /**< Share of an edge's length, above 0 and at most 0.25; 0 means 0.01. */
} dsw_cut_desc;

/** What a cut did. */
typedef struct dsw_cut_report {
  double distance; /**< Largest distance, rounded, of a vertex of the cut from the blade, and in volumes that were
                                 split, of the blade from the cut. Scene units. */
  uint32_t volumes_crossed; /**< Volumes that the blade met; 0: it was not met from `start`. */
  uint32_t volumes_split;   /**< Of these those that were split. */
  uint32_t volumes_whole;   /**< See dsw_environment_get_whole_volumes. */
  uint32_t volumes_changed; /**< Volumes that went: those split, and neighbours that got vertices or edges. */
  uint32_t volumes_visited; /**< Volumes that were looked at, those between `start` and the blade included. */
  uint32_t vertex_count;    /**< See dsw_environment_get_cut_vertices. */
  uint32_t face_count;      /**< See dsw_environment_get_cut_faces. */
  uint32_t reserved;        /**< 0. */
} dsw_cut_report;

/** A vertex that came, between two that there were: at weights[0] from[0] + weights[1] from[1], rounded. */
typedef struct dsw_cut_vertex {
  dsw_vertex_id vertex;  /**< The one that came. */
  dsw_vertex_id from[2]; /**< The two that there were. */
  double weights[2];     /**< Above 0; their sum is 1. */
} dsw_cut_vertex;

/** A face of the cut, named from both of its sides: one face, or two with DSW_CUT_UNSEW. */
typedef struct dsw_cut_face {
  dsw_face_id front; /**< That of the volume before the blade. */
  dsw_face_id back;  /**< That of the volume behind it. */
} dsw_cut_face;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_cut_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_cut_desc_init(dsw_cut_desc *desc, size_t size);

/** Cuts an environment along a blade. The part before the blade keeps the index of a volume that is split.
 * @param environment [in,out] @param desc [in] see dsw_cut_desc.
 * @param report [out] may be null. That nothing is cut is a result, too.
 * @return besides those of topology.h: DSW_STATUS_BAD_STRUCT_SIZE, UNSUPPORTED (flags), OUT_OF_RANGE (rows, columns, snap), WRONG_SIZE
 * (point_stride_bytes), NON_FINITE, STALE_ID (start), BORROWED (vertices have to be added, and the points are the host's without room for them, see dsw_deform_options). INVALID_CELL and BAD_CELL do not occur: such volumes stay whole.
 * OCCUPIED: with DSW_CUT_UNSEW an edge or face of a body crosses the cut, or the outer boundary would move by a rounding into a body.
 * @since 1.0 */
DSW_API dsw_status dsw_environment_cut(dsw_environment *environment, const dsw_cut_desc *desc, dsw_cut_report *report);

/** Tears faces: those with a load above a threshold, each between two volumes, are unsewn at once. A crack without width is left, which
 * nothing passes. Others, and faces that are on the outer boundary already, stay. dsw_environment_get_cut_faces lists what was torn.
 * @param environment [in,out] @param faces [in] `count` live ids; one may stand twice.
 * @param loads [in] as many numbers, in the host's unit. @param count [in] @param threshold [in] in that unit.
 * @param torn [out] how many faces were torn; may be null.
 * @return besides those of topology.h: DSW_STATUS_NON_FINITE (a load or the threshold is not a number; infinite ones are).
 * @note O(count), and as topology.h says. @since 1.0 */
DSW_API dsw_status dsw_environment_tear_faces(dsw_environment *environment, const dsw_face_id *faces,
                                              const double *loads, size_t count, double threshold, size_t *torn);

/** Vertices that the last successful cut or opening added.
 * @param environment [in] @param vertices [out] owned by the environment, valid until the next of these.
 * @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT.
 * @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_cut_vertices(const dsw_environment *environment, const dsw_cut_vertex **vertices,
                                                    size_t *count);

/** Faces of the last successful cut or tear, lips of the last opening. Ids are those from right after it.
 * @param environment [in] @param faces [out] as above. @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_cut_faces(const dsw_environment *environment, const dsw_cut_face **faces,
                                                 size_t *count);

/** Volumes that the blade crossed in the last successful cut and that stayed whole. Ids are those from right after it.
 * @param environment [in] @param volumes [out] as above. @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_whole_volumes(const dsw_environment *environment, const dsw_volume_id **volumes,
                                                     size_t *count);

/** Describes how a crack opens. The array is read in place, once; nothing is retained. */
typedef struct dsw_open_desc {
  uint32_t struct_size;      /**< sizeof(dsw_open_desc). */
  uint32_t flags;            /**< 0. */
  const dsw_cut_face *faces; /**< The crack, as dsw_environment_get_cut_faces gives it: two faces on the outer boundary
                                  that lie on each other, of two volumes; or an inner face, named from any sides. */
  size_t face_count;         /**< How many. */
  double width;              /**< Above 0: how far the two copies of a vertex come apart. Scene units. */
  int32_t region; /**< Label of the volumes in the gap. Not 0: other passable volumes with this label are space into
                       which the crack opens, as passable ones beside impassable lips always are. */
  uint32_t tag;   /**< Host tag of the volumes in the gap. */
} dsw_open_desc;

/** What opening a crack did. Widths are distances of the two copies of a vertex, rounded, in scene units; 0 if none came apart. */
typedef struct dsw_open_report {
  double smallest_width;       /**< Of those that came apart. */
  double largest_width;        /**< Likewise. */
  uint32_t vertices_parted;    /**< Vertices that came apart. */
  uint32_t vertices_shortened; /**< Of these those that came apart by less than the width asked for. */
  uint32_t faces_opened;       /**< Faces that opened, which is how many volumes were added. */
  uint32_t volumes_changed;    /**< Volumes at vertices that came apart. */
} dsw_open_report;

/** Writes the defaults and struct_size into at most `size` bytes; there is none for `width`.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_open_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_open_desc_init(dsw_open_desc *desc, size_t size);

/** Opens a crack, so that something can enter: its lips move apart, and the gap is filled with passable volumes, one for each face that opens,
 * sewn to both lips, unless the faces are marked, and to each other. Gap volumes are wedges, pyramids and tetrahedra where the gap ends;
 * in the plane quadrilaterals, and triangles where it ends.
 *
 * A vertex of the crack comes apart where the crack leaves the volumes round it in two; it does not where the crack ends inside of the material,
 * where three cracks meet, or where other volumes touch it that are joined with none of these through faces. Its copies go half of `width`
 * each, along the crack's mean normal there and against it; where volumes would not be valid then, exactly, or the outer boundary would fold, half as far, again
 * and again, and the other copy goes further. Where both come to nothing (1/4096 of their ways) the vertex stays one. A face with no
 * vertex that comes apart stays as it was. At the outer boundary the gap is open to the outside, and the boundary moves with its
 * vertices.
 *
 * Where a crack between impassable volumes ends at passable ones (tissue in air, or an earlier gap), the gap opens into these: the volumes at
 * the rim's vertices are parted there by a line of edges between the two copies, and one volume at each edge of the rim gets a face in its
 * place, sewn to the gap. Name for that the faces between impassable volumes only, else the crack goes on in the air, and opens there
 * as well. In the plane the rim is a vertex, and one volume there gets a side between its two copies.
 *
 * Both copies are new vertices; the old one goes with its last volume. dsw_environment_get_cut_vertices lists them, two for each vertex that came
 * apart, with that one as both of `from`, by the id that it had. dsw_environment_get_cut_faces lists the lips in the order of `faces`, those that did
 * not open left out; dsw_environment_get_volume_changes has the added volumes last, in the same order.
 * @param environment [in,out] @param desc [in] see dsw_open_desc.
 * @param report [out] may be null. That nothing opens is a result, too.
 * @return besides those of topology.h: DSW_STATUS_BAD_STRUCT_SIZE, UNSUPPORTED (flags), NON_FINITE and OUT_OF_RANGE (width), DUPLICATE_ID (a face
 * stands twice), BAD_TOPOLOGY (two faces that do not lie on each other, or are of one volume, or of which one is not on the outer
 * boundary), BORROWED (vertices have to be added, and the points are the host's). OCCUPIED: a wall would move over a particle or a body.
 * @note O(volumes at the vertices of the crack) each time that ways are halved, and as topology.h says. @since 1.0 */
DSW_API dsw_status dsw_environment_open(dsw_environment *environment, const dsw_open_desc *desc,
                                        dsw_open_report *report);

#ifdef __cplusplus
}
#endif

#endif
