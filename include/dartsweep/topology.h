/** @file topology.h
 * The basic changes of the topology [JCD10] 5.2: volumes are added and removed, faces sewn and
 * unsewn, volumes, faces and edges split and merged, edges collapsed. Particles and bodies follow.
 * When each is refused: bindings/docs/topology.md. Pointers for new ids may be null, and so may
 * `change`, except in dsw_environment_get_change.
 *
 * Each new volume is exactly valid, and new volumes fill the space of the old ones, unless a
 * comment says that the outer boundary moves; then dsw_environment_check tells whether it crosses
 * itself. A volume that changes keeps index, region label, tag and mark; its id, and those of its
 * faces and edges, become stale. dsw_environment_get_change gives the new ids.
 *
 * Any change can answer DSW_STATUS_SHARED, OCCUPIED (a particle or vertex of a body would be in no
 * passable volume, or a body not free), BAD_TOPOLOGY, BAD_CELL, INVALID_CELL, TOO_LARGE.
 *
 * "Local" cost: O(faces of the volumes that change), and a pass over particles and bodies (with
 * DSW_FEATURE_LIVE_CHANGES only those near). The first change makes tables: 24 bytes a volume, 12 a
 * vertex.
 */
#ifndef DARTSWEEP_TOPOLOGY_H
#define DARTSWEEP_TOPOLOGY_H

#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What became of a volume: `before` is null if it was added, `after` if it was removed. A split
 * gives two with one `before`, a merge two with one `after`. */
typedef struct dsw_volume_change {
  dsw_volume_id before;
  dsw_volume_id after;
} dsw_volume_change;

/** Origin of a new vertex: weights[0] from[0] + weights[1] from[1], rounded. */
typedef struct dsw_vertex_origin {
  dsw_vertex_id vertex;  /**< The new vertex; null in a body. */
  dsw_vertex_id from[2]; /**< Old vertices; equal for a copy. */
  double weights[2];     /**< Their sum is 1. */
} dsw_vertex_origin;

/** A face of a cut, with its ids from the volumes in `front` of the blade and in its `back`: one
 * face, or two that lie on each other. */
typedef struct dsw_cut_face {
  dsw_face_id front;
  dsw_face_id back;
} dsw_cut_face;

/** Origin of a face of a detached body. */
typedef struct dsw_face_origin {
  dsw_face_id face;     /**< The face with the triangle. */
  dsw_volume_id volume; /**< The piece's volume there. */
} dsw_face_origin;

/** What the last successful change of the topology did. All ids but `before` and `from` are those
 * after it. What does not apply is 0 or empty. */
typedef struct dsw_change {
  uint32_t struct_size;
  uint32_t is_closed; /**< Ligature: 0 if a way leads past the loop. */
  /** Cut: largest distance between blade and cut. Detached body: of a vertex from its origin. */
  double distance;
  double smallest_width;       /**< Crack: smallest opening, or 0. */
  double largest_width;        /**< Crack: largest opening. */
  uint32_t volumes_visited;    /**< Cut: also on the way from `start` to the blade. */
  uint32_t volumes_crossed;    /**< Cut: met by the blade. */
  uint32_t volumes_split;      /**< Cut: split by the blade. */
  uint32_t volumes_changed;    /**< Cut: split, or with a new vertex or edge. Crack: at its rim. */
  uint32_t vertices_parted;    /**< Crack: that came apart. */
  uint32_t vertices_shortened; /**< Crack: by less than `width`. */
  uint32_t faces_sewn;         /**< Piece: pairs of faces made one. */
  uint32_t faces_unsewn;       /**< Piece: faces left on the boundary. */
  uint32_t volumes_invalid;    /**< Repair: found invalid. */
  uint32_t volumes_removed;    /**< Repair: replaced. */
  uint32_t volumes_added;      /**< Repair: their replacements. */
  uint32_t patch_count;
  uint32_t most_faces; /**< Repair: of an added volume. */
  uint32_t reserved;
  const dsw_volume_change *volumes; /**< What became of each volume. */
  size_t volume_count;
  const dsw_vertex_origin *vertices; /**< New vertices of a cut or crack. */
  size_t vertex_count;
  const dsw_cut_face *faces; /**< Faces of a cut or tear; lips of a crack. */
  size_t face_count;
  const dsw_volume_id *whole; /**< Cut: volumes entered but not split. */
  size_t whole_count;
  const dsw_volume_id *carved; /**< Carving: volumes made passable. */
  size_t carved_count;
  const dsw_volume_id *unrepaired; /**< Repair: volumes left invalid, by index. */
  size_t unrepaired_count;
  const dsw_volume_id *detached; /**< Volumes of the detached piece. */
  size_t detached_count;
  const dsw_vertex_origin *body_vertices; /**< The detached body's, by index. */
  size_t body_vertex_count;
  const dsw_face_origin *body_faces; /**< The detached body's, by index. */
  size_t body_face_count;
} dsw_change;

/** Gives the last change. */
DSW_API dsw_status dsw_environment_get_change(const dsw_environment *environment,
                                              dsw_change *change);

/** Sews `faces_a`[i] and `faces_b`[i], faces of the outer boundary with the same vertices, into one
 * face, marked if either was. If their triangles differ, one of the two volumes changes; other ids
 * stay valid.
 * @return DSW_STATUS_DUPLICATE_ID.
 * @note Cost: local. */
DSW_API dsw_status dsw_environment_sew_faces(dsw_environment *environment,
                                             const dsw_face_id *faces_a, const dsw_face_id *faces_b,
                                             size_t count);

/** Unsews a face between two volumes into two faces of the outer boundary, with its mark. All ids
 * stay valid.
 * @note Cost: local. */
DSW_API dsw_status dsw_environment_unsew_face(dsw_environment *environment, dsw_face_id face);

/** Describes new volumes; `index_bytes`, `cell_types`, `offsets`, `connectivity`, `regions`, `tags`
 * and `uniform_cell_type` as in dsw_environment_desc. */
typedef struct dsw_volumes_desc {
  uint32_t struct_size;
  uint32_t index_bytes;
  /** Old vertices, 0 .. vertex_count-1 in connectivity. */
  const dsw_vertex_id *vertices;
  size_t vertex_count;
  const double *points; /**< New vertices, from vertex_count on in connectivity. */
  size_t point_count;   /**< 0 if borrowed points have no room (deform.h). */
  size_t point_stride_bytes;
  const uint8_t *cell_types;
  size_t volume_count;
  const void *offsets;
  const void *connectivity;
  size_t connectivity_count;
  const int32_t *regions;
  const uint32_t *tags;
  /** Faces of the outer boundary to sew to new faces. Others stay apart. */
  const dsw_face_id *sew_to;
  size_t sew_count;
  uint32_t uniform_cell_type;
  uint32_t reserved;
} dsw_volumes_desc;

/** Writes the defaults: hexahedra, 8-byte indices. */
DSW_API void dsw_volumes_desc_init(dsw_volumes_desc *desc, size_t size);

/** Adds passable volumes, sewn to each other where they share faces. They must overlap nothing
 * (dsw_environment_check).
 * @return DSW_STATUS_BAD_CELL_TYPE, INDEX_OUT_OF_RANGE, DUPLICATE_CELL, SHARED_FACE, BORROWED;
 * NOT_FOUND: no new volume has a face of sew_to.
 * @note Cost: local. */
DSW_API dsw_status dsw_environment_add_volumes(dsw_environment *environment,
                                               const dsw_volumes_desc *desc, dsw_volume_id *volumes,
                                               dsw_vertex_id *vertices);

/** Removes volumes, but not all. An id may occur twice. @note Cost: local. */
DSW_API dsw_status dsw_environment_remove_volumes(dsw_environment *environment,
                                                  const dsw_volume_id *volumes, size_t count);

/** Merges two volumes, both marked or both not. All faces between them go.
 * @param face one of these; its id names the volume whose index, region label and tag stay.
 * @note Cost: local. */
DSW_API dsw_status dsw_environment_merge_volumes(dsw_environment *environment, dsw_face_id face,
                                                 dsw_volume_id *volume);

/** Splits a volume by a new face, cut into triangles, along a closed loop of its edges.
 * @param loop 3 or more different vertices.
 * @param volumes 2 ids: the part left of the loop seen from outside, with the old index, and the
 * other.
 * @note Cost: local. */
DSW_API dsw_status dsw_environment_split_volume(dsw_environment *environment, dsw_volume_id volume,
                                                const dsw_vertex_id *loop, size_t count,
                                                dsw_volume_id *volumes, dsw_face_id *face);

/** Merges the two faces of an edge that has no others, both marked or both not. Their triangles
 * stay.
 * @note Cost: local. */
DSW_API dsw_status dsw_environment_merge_faces(dsw_environment *environment, dsw_edge_id edge,
                                               dsw_face_id *face);

/** Splits a face by a new edge. A warped face can get other triangles, which changes the space of
 * its volumes or the outer boundary.
 * @param a, b vertices of the face that no edge joins.
 * @param faces 2 ids: the part from a to b, seen from outside of the id's volume, and the other.
 * @note Cost: local. */
DSW_API dsw_status dsw_environment_split_face(dsw_environment *environment, dsw_face_id face,
                                              dsw_vertex_id a, dsw_vertex_id b, dsw_face_id *faces,
                                              dsw_edge_id *edge);

/** Splits an edge by a new vertex. The vertex is rounded, and the outer boundary moves with it.
 * @param edge_parameter in (0,1), from the first to the second vertex
 * (dsw_environment_copy_vertices).
 * @param edges 2 ids: at each of these.
 * @return DSW_STATUS_BORROWED.
 * @note Cost: local. */
DSW_API dsw_status dsw_environment_split_edge(dsw_environment *environment, dsw_edge_id edge,
                                              double edge_parameter, dsw_vertex_id *vertex,
                                              dsw_edge_id *edges);

/** Merges the two edges of a vertex that has no others. The new edge runs straight, and the outer
 * boundary moves with it.
 * @param vertex the end of `edge` that goes.
 * @note Cost: local. */
DSW_API dsw_status dsw_environment_merge_edges(dsw_environment *environment, dsw_edge_id edge,
                                               dsw_vertex_id vertex, dsw_edge_id *merged);

/** Merges one end of an edge into the other, if the outer boundary keeps its form. Tetrahedra at
 * the edge vanish with their marks; their two other faces become one, marked if either was.
 * @param vertex the end that goes.
 * @note Cost: local. */
DSW_API dsw_status dsw_environment_collapse_edge(dsw_environment *environment, dsw_edge_id edge,
                                                 dsw_vertex_id vertex);

#ifdef __cplusplus
}
#endif

#endif
