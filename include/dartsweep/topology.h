/** @file topology.h
 * The basic operations of an environment's topology: faces are sewn and unsewn; volumes, faces and edges are split and merged; volumes
 * are added and removed; edges are collapsed. Marking and unmarking are in marking.h.
 *
 * An operation changes a few volumes and leaves all others, and their ids, alone. A volume that changes keeps its index and gets the
 * next generation, because the numbers of its faces and edges change: its old id, and those of faces and edges that name it, answer
 * DSW_STATUS_STALE_ID from then on. What comes out as a tetrahedron, pyramid, wedge or hexahedron is one, with vertices and faces in the
 * order of that type; any other volume is a polyhedron. dsw_environment_get_volume_changes lists what became of what. Region label, tag and mark of
 * a volume are those of the volume it comes from. Marks of faces, edges and vertices stay where these do.
 * With points of its own, or lent with room (deform.h), an environment removes a vertex with its last volume, and may give its index to a
 * later one with the next generation; other borrowed points keep their ids for ever.
 *
 * What is guaranteed: a call that fails changes nothing. Every new volume is valid, exactly, as at creation. The volumes that come
 * fill the same space as those that go (so that all volumes stay a partition), but for what a function says of the outer boundary:
 * whether that then crosses itself elsewhere is not looked at (see dsw_environment_check). Particles and vertices of bodies in
 * volumes that go are then in the new volume that contains them, exactly. While exactly one scene uses the environment, changes are
 * checked against what it holds; with several scenes they answer DSW_STATUS_SHARED. What would leave a particle or a vertex of a body
 * in no passable volume, or a body not free at its level, answers DSW_STATUS_OCCUPIED; dsw_scene_get_occupants and
 * dsw_scene_get_occupant_bodies tell what is in the way.
 *
 * Cost: the first call on an environment makes tables of about 24 bytes a volume and 12 a vertex, once. Every call costs
 * O(faces of the volumes that change), plus amortised growth of arrays, one pass over the particles and the vertices of bodies of the
 * scene (with DSW_FEATURE_LIVE_CHANGES only over those near), and a cast or sweep for each edge and face of a body in the box of
 * what changes; never the size of the environment.
 * The search structure for locating points (DSW_ENVIRONMENT_LOCATE_GRID) keeps a list of the
 * volumes that are made. The structure is built anew when looking at that list has taken longer
 * than building takes.
 *
 * Every function here returns, besides what it says: DSW_STATUS_NULL_ARGUMENT, DSW_STATUS_STALE_ID, DSW_STATUS_SHARED,
 * DSW_STATUS_OCCUPIED, DSW_STATUS_TOO_LARGE (more than 2^28 records or vertices, or volumes with more than 65534 corners of
 * faces), DSW_STATUS_OUT_OF_MEMORY; DSW_STATUS_BAD_TOPOLOGY: the cells are not arranged as the operation needs them;
 * DSW_STATUS_BAD_CELL: the faces of a new volume would not close a sphere; DSW_STATUS_INVALID_CELL: a new volume would be flat, folded,
 * inside out, or cover a part of itself twice. The message says which.
 * Thread: writer of the environment and of its scene. Source: [JCD10] 5.2.
 *
 * In the plane (see ids.h) volumes are polygons and faces their sides, and all of this holds. Sides are the edges, too: where a function
 * here takes an edge id it takes the numbers of a side's face id, and gives ids of edges back as such. What comes out with three or four
 * corners is a triangle or a quad, anything else a polygon, its corners counter-clockwise; new polygons have to be stars of the mean of their
 * corners.
 */
#ifndef DARTSWEEP_TOPOLOGY_H
#define DARTSWEEP_TOPOLOGY_H

#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What became of a volume. A volume that was split stands in two of these, one that was merged in two as well. */
typedef struct dsw_volume_change {
  dsw_volume_id before; /**< Null: the volume was added. */
  dsw_volume_id after;  /**< Null: the volume was removed. */
} dsw_volume_change;

/** Sews faces: faces_a[i] and faces_b[i], both on the outer boundary, with the same vertices, become one face between their volumes.
 * It is marked if one of them was. Where the two are cut into different triangles, one of the volumes is cut anew.
 * @param environment [in,out] @param faces_a, faces_b [in] `count` live ids each. @param count [in]
 * @return DSW_STATUS_BAD_TOPOLOGY: a face is not on the outer boundary, or vertices differ, or both are of one volume;
 * DSW_STATUS_DUPLICATE_ID: a face stands twice; DSW_STATUS_INVALID_CELL: neither volume can be cut anew.
 * @note Ids stay valid but those of volumes that are cut anew. @since 1.0 */
DSW_API dsw_status dsw_environment_sew_faces(dsw_environment *environment, const dsw_face_id *faces_a,
                                             const dsw_face_id *faces_b, size_t count);

/** Unsews a face: one face between two volumes becomes two on the outer boundary, which nothing passes. Both are marked if it was.
 * @param environment [in,out] @param face [in]
 * @return DSW_STATUS_BAD_TOPOLOGY: it is on the outer boundary already. @note All ids stay valid. @since 1.0 */
DSW_API dsw_status dsw_environment_unsew_face(dsw_environment *environment, dsw_face_id face);

/** Describes volumes to be added. All arrays are read in place, once; nothing is retained. */
typedef struct dsw_volumes_desc {
  uint32_t struct_size;          /**< sizeof(dsw_volumes_desc). */
  uint32_t index_bytes;          /**< Size of the signed integers in offsets and connectivity: 4 or 8; 0 means 8. */
  const dsw_vertex_id *vertices; /**< Vertices that the environment has: 0 .. vertex_count-1 in connectivity. */
  size_t vertex_count;           /**< How many. */
  const double *points;      /**< New vertices, 3 doubles each (in the plane 2), finite: vertex_count and following in
                                connectivity. */
  size_t point_count;        /**< 0 where the points of the environment are borrowed without room (deform.h). */
  size_t point_stride_bytes; /**< Distance of two points; 0 means 24, in the plane 16. */
  const uint8_t *cell_types; /**< dsw_cell_type of each volume; null: all are uniform_cell_type. */
  size_t cell_count;         /**< At least 1. */
  const void *offsets;       /**< As in dsw_environment_desc; null is allowed with uniform_cell_type. */
  const void *connectivity;  /**< Indices as above; for a polyhedron its face stream. */
  size_t connectivity_count; /**< Number of integers in connectivity. */
  const int32_t *regions;    /**< Null, or a label for each volume. */
  const uint32_t *tags;      /**< Null, or a host tag for each volume. */
  const dsw_face_id
      *sew_to;      /**< Faces on the outer boundary to which the new volumes are sewn; each has the vertices of a
                                   face of one of these. Others stay apart, also where they have the same vertices. */
  size_t sew_count; /**< How many. */
  uint32_t uniform_cell_type; /**< dsw_cell_type of all volumes when cell_types is null; not polyhedron or polygon. */
  uint32_t reserved;          /**< 0. */
} dsw_volumes_desc;

/** Writes the defaults (hexahedra, 8-byte indices) into at most `size` bytes and sets struct_size.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_volumes_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_volumes_desc_init(dsw_volumes_desc *desc, size_t size);

/** Adds volumes. They are passable, joined with each other where they share faces, and sewn to the given faces of the outer boundary,
 * whose marks stay. That they overlap nothing is the caller's to see to: dsw_environment_check tells.
 * @param environment [in,out] @param desc [in] see dsw_volumes_desc.
 * @param volumes [out] desc->cell_count ids, may be null.
 * @param vertices [out] desc->point_count ids of the new vertices, may be null.
 * @return DSW_STATUS_BAD_STRUCT_SIZE, UNSUPPORTED, WRONG_SIZE, OUT_OF_RANGE, NON_FINITE, BAD_CELL_TYPE, INDEX_OUT_OF_RANGE, BORROWED
 * (new points where they are the host's without room for them, see dsw_deform_options), DUPLICATE_CELL, SHARED_FACE (among the new volumes), NOT_FOUND (a face in sew_to that no new
 * volume has), BAD_TOPOLOGY (one that is not on the outer boundary). The message names the volume by its place in desc.
 * @since 1.0 */
DSW_API dsw_status dsw_environment_add_volumes(dsw_environment *environment, const dsw_volumes_desc *desc,
                                               dsw_volume_id *volumes, dsw_vertex_id *vertices);

/** Removes volumes; faces that they share with others are on the outer boundary then. An id may stand twice.
 * @param environment [in,out] @param volumes [in] `count` live ids. @param count [in]
 * @return DSW_STATUS_BAD_TOPOLOGY: no volume would be left. @since 1.0 */
DSW_API dsw_status dsw_environment_remove_volumes(dsw_environment *environment, const dsw_volume_id *volumes,
                                                  size_t count);

/** Merges the two volumes of a face: it goes, with all other faces that the two share, and with edges and vertices that only those had.
 * In the plane the sides that the two share have to be one chain.
 * @param environment [in,out] @param face [in]
 * @param volume [out] the volume that they become, with region, tag and index of the one that `face` names; may be
 * null.
 * @return DSW_STATUS_BAD_TOPOLOGY: the face has one volume, or one of the two is marked and the other is not. @since 1.0 */
DSW_API dsw_status dsw_environment_merge_volumes(dsw_environment *environment, dsw_face_id face, dsw_volume_id *volume);

/** Splits a volume: inserts a face along a closed loop of its edges. It is cut into triangles that leave both parts valid, if there
 * are such. In the plane it inserts a side from one corner of a polygon to another.
 * @param environment [in,out] @param volume [in]
 * @param loop [in] `count` >= 3 different vertices, each joined with the next by an edge of the volume, the last with
 * the first. In the plane two corners that no side joins. @param count [in] in the plane 2.
 * @param volumes [out] 2 ids, may be null: the part to the left of the loop, seen from outside (in the plane of the way from the first
 * corner to the second), which keeps the index; the other. @param face [out] the new face; may be null.
 * @return DSW_STATUS_BAD_TOPOLOGY, DSW_STATUS_BAD_CELL (the loop is that of a face), DSW_STATUS_INVALID_CELL. @since 1.0 */
DSW_API dsw_status dsw_environment_split_volume(dsw_environment *environment, dsw_volume_id volume,
                                                const dsw_vertex_id *loop, size_t count, dsw_volume_id *volumes,
                                                dsw_face_id *face);

/** Merges the two faces of an edge that has no others: the edge goes. The triangles stay, and so the space of every volume. Not in the
 * plane, where dsw_environment_merge_edges does this to sides: DSW_STATUS_UNSUPPORTED.
 * @param environment [in,out] @param edge [in] @param face [out] the face that they become; may be null.
 * @return DSW_STATUS_BAD_TOPOLOGY: the edge has more faces, or one of the two is marked and the other is not; DSW_STATUS_BAD_CELL:
 * the two faces share more than this edge. @since 1.0 */
DSW_API dsw_status dsw_environment_merge_faces(dsw_environment *environment, dsw_edge_id edge, dsw_face_id *face);

/** Splits a face, on both of its sides: inserts an edge between two of its vertices. Where the edge crosses the triangles of a face that
 * is not flat, both parts are cut anew, and the space of its volumes (on the outer boundary that of the environment) changes
 * between the old triangles and the new ones. Not in the plane, where dsw_environment_split_edge does this to sides:
 * DSW_STATUS_UNSUPPORTED.
 * @param environment [in,out] @param face [in] @param a, b [in] vertices of the face that no edge of it joins.
 * @param faces [out] 2 ids, may be null: the part from a to b, seen from outside of the volume that `face` names; the
 * other. @param edge [out] the new edge; may be null.
 * @return DSW_STATUS_BAD_TOPOLOGY: `a` or `b` is no vertex of the face, or an edge joins them;
 * DSW_STATUS_INVALID_CELL: its parts can't be cut so that its volumes stay valid. @since 1.0 */
DSW_API dsw_status dsw_environment_split_face(dsw_environment *environment, dsw_face_id face, dsw_vertex_id a,
                                              dsw_vertex_id b, dsw_face_id *faces, dsw_edge_id *edge);

/** Splits an edge: inserts a vertex at the rounded place `share` of the way from the first to the second of its vertices (in the order of
 * dsw_environment_copy_vertices), in all of its volumes. On the outer boundary the surface moves by that rounding. In the plane it splits a side, whose mark both parts get;
 * the first of its vertices is where it begins in the polygon that `edge` names.
 * @param environment [in,out] @param edge [in] @param share [in] 0 < share < 1.
 * @param vertex [out] the new vertex; may be null.
 * @param edges [out] 2 ids, may be null: the parts at the first and at the second vertex.
 * @return DSW_STATUS_OUT_OF_RANGE for share, DSW_STATUS_BORROWED: the points are the host's, without room. @since 1.0 */
DSW_API dsw_status dsw_environment_split_edge(dsw_environment *environment, dsw_edge_id edge, double share,
                                              dsw_vertex_id *vertex, dsw_edge_id *edges);

/** Merges the two edges of a vertex that has no others: the vertex goes, the edge then runs straight between the two others, and so
 * does the outer boundary there. In the plane these are sides, both marked or both not, and none of their polygons is a triangle.
 * @param environment [in,out] @param edge [in] one of the two. @param vertex [in] the end of it that goes.
 * @param merged [out] the edge that they become; may be null.
 * @return DSW_STATUS_BAD_TOPOLOGY: the vertex is no end of the edge, has other edges or other volumes, or a triangle there would come to
 * nothing. @since 1.0 */
DSW_API dsw_status dsw_environment_merge_edges(dsw_environment *environment, dsw_edge_id edge, dsw_vertex_id vertex,
                                               dsw_edge_id *merged);

/** Collapses an edge: one of its ends is merged into the other. Volumes that come to nothing (tetrahedra at the edge, triangles in the
 * plane) go, with their marks; their two faces that are left become one, marked if one of them was. The outer boundary keeps its form exactly, or the
 * call is refused.
 * @param environment [in,out] @param edge [in] @param vertex [in] the end that goes.
 * @return DSW_STATUS_BAD_TOPOLOGY: the vertex is no end of the edge, or has volumes that are not joined through its faces, or lies on
 * the outer boundary so that this would change. @since 1.0 */
DSW_API dsw_status dsw_environment_collapse_edge(dsw_environment *environment, dsw_edge_id edge, dsw_vertex_id vertex);

/** What became of the volumes that the last successful call above changed.
 * @param environment [in] @param changes [out] owned by the environment, valid until the next such call.
 * @param count [out] how many; 0 before the first call, and after those that change no volume.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_volume_changes(const dsw_environment *environment,
                                                      const dsw_volume_change **changes, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
