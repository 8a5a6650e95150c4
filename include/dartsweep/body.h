/** @file body.h
 * Bodies: vertices joined by edges and, where they are surfaces, by triangles. At its level a body never meets anything
 * impassable, exactly: creating, raising the level and every edit check that or change nothing.
 *
 * In a scene with DSW_FEATURE_BODY_CONTACTS bodies do not touch each other either: what their levels cover, vertices, edges from
 * DSW_LEVEL_EDGES on, faces at DSW_LEVEL_FACES, has no point in common, and passed through nothing on its way (but see DSW_DEFORM_END_STATE). Here touching is a
 * contact; also at DSW_LEVEL_EDGES the whole way of an edge counts. Bodies whose filters keep them apart ignore each other.
 *
 * In the plane bodies are polylines, closed curves, or any other vertices and edges. They have no faces, and no level for them: asking
 * for either answers DSW_STATUS_UNSUPPORTED.
 *
 * Vertices, edges and faces are named by ids whose index is stable; a removed one leaves a free index that a later one may take
 * with a higher generation. Arrays by vertex (positions, targets) have one entry for each index below the number of slots.
 */
#ifndef DARTSWEEP_BODY_H
#define DARTSWEEP_BODY_H

#include "dartsweep/contact.h"
#include "dartsweep/scene.h"
#include "dartsweep/sweep.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Flags of a body: ways to leave out work. Those marked lossless change no result by a bit, unless
 * DSW_BODY_SKIP_SIMILAR_MOTION or DSW_BODY_SKIP_BACK_EDGES is set as well. */
enum {
  /** Edges keep the faces that they cross, 4 bytes for each, of tetrahedra 76, of convex polygons in the plane 36: a sweep that crosses
   * the same ones is done [lossless]. From DSW_LEVEL_EDGES_SWEPT on they do so anyway; the flag says it for DSW_LEVEL_EDGES. */
  DSW_BODY_SEQUENCES = 0x1,
  /** Skip edges that sweep inside of one volume [JCD10] 6.1: an exactly convex one, or a hexahedron, in the plane any polygon, that is
   * seen whole from where they end [lossless]. */
  DSW_BODY_SKIP_BY_ENVIRONMENT = 0x2,
  /** Skip edges that sweep inside of a ball known to hold nothing impassable [lossless]. */
  DSW_BODY_SKIP_BY_CLEARANCE = 0x4,
  /** Similar motion, at DSW_LEVEL_EDGES: an edge is tested once a move, where the edge arrives, if both ends move less than the
   * length of the edge, by vectors that differ by less than `motion_share` of that length. A contact that only exists on the way
   * there is missed. Where the edge arrives is exactly free all the same. The name is since 1.1. */
  DSW_BODY_SKIP_SIMILAR_MOTION = 0x8,
  /** The name of DSW_BODY_SKIP_SIMILAR_MOTION in 1.0. */
  DSW_BODY_SKIP_BY_MOTION = 0x8,
  /** The body also meets itself [JCD10] 4.4: no two of its parts without a common vertex may touch. The two ends of an edge are such
   * parts. Edits and responses keep this rule for new parts. Needs DSW_FEATURE_BODY_CONTACTS. */
  DSW_BODY_SELF_CONTACTS = 0x10,
  /** Back-edge elimination [JCD10] 6.2, at DSW_LEVEL_EDGES, for closed surfaces whose faces are turned outwards: the edges at a
   * vertex are not tested when that vertex moves towards the inside of the body, against the normals of all its faces. The normals
   * are those at the beginning of the move. An edge that was not tested where it arrives is cast there once, so the body is exactly
   * free after the move. A contact that only exists on the way there is missed. With DSW_BODY_SKIP_BY_ENVIRONMENT this is the
   * hybrid elimination of 6.3. At other levels, and in dsw_body_move_rigid, the flag changes nothing. An edge without two faces is
   * always tested. Since 1.1. */
  DSW_BODY_SKIP_BACK_EDGES = 0x20,
  /** Walls that push the body move it as a whole, by a rigid motion, or wait [JCD10] 5.1; see
   * DSW_WALL_PUSH. The library takes the shape when the body is created, and anew after
   * dsw_body_move or an edit has changed the body. From then on pushes and dsw_body_move_rigid add
   * up to one motion, and each position is its place in the shape, moved and rounded once. So the
   * distance of any two vertices keeps to 8 units in the last place of the largest coordinate that
   * the body has had since, after any number of pushes. Responses of dsw_body_move insert no
   * vertices: ADAPTIVE_SLIDE slides, the others stop. Since 1.1. */
  DSW_BODY_RIGID = 0x40
};

/** Describes a body. */
typedef struct dsw_body_desc {
  uint32_t struct_size; /**< sizeof(dsw_body_desc). */
  uint32_t flags;       /**< DSW_BODY_... */
  dsw_level level;      /**< DSW_LEVEL_EDGES_SWEPT by default. */
  uint32_t reserved;    /**< 0. */
  const double
      *positions;      /**< `vertex_count` points, stride_bytes apart, finite. Borrowed for the call, as all arrays. */
  size_t vertex_count; /**< At least 1. */
  size_t stride_bytes; /**< 0 means 8 * dimension. */
  const dsw_volume_id *hints; /**< Null, or `vertex_count` ids of which any may be null. */
  const uint32_t *edges;      /**< Two vertices each; an edge that a face has may be given or left out. */
  size_t edge_count;          /**< How many. */
  /** Faces: corners of face i are face_corners[face_offsets[i] .. face_offsets[i+1]-1], in order. Polygons become fans of
   * triangles round their first corner; the diagonals become edges. None in the plane. */
  const uint32_t *face_offsets;
  const uint32_t *face_corners; /**< Vertices, as said. */
  size_t face_count;            /**< face_offsets has one more entry. */
  size_t face_corner_count;     /**< Entries of face_corners: the last of face_offsets. */
  double motion_share;          /**< For DSW_BODY_SKIP_SIMILAR_MOTION; 0 means 0.1. */
  /** Two bodies meet if the category of each has a bit in common with the other's mask. 0 means 1. These two need
   * DSW_FEATURE_BODY_CONTACTS. */
  uint32_t category;
  uint32_t mask; /**< 0 means all bits. To meet nobody, name a bit that no category has. */
} dsw_body_desc;

/** How many vertices, edges and triangles a body has, and below which number their indices are. */
typedef struct dsw_body_counts {
  uint32_t struct_size;  /**< Set by the caller: sizeof(dsw_body_counts). */
  uint32_t vertex_count; /**< Vertices that there are. */
  uint32_t edge_count;   /**< Edges. */
  uint32_t face_count;   /**< Triangles. */
  uint32_t vertex_slots; /**< Indices of vertices are below. */
  uint32_t edge_slots;   /**< Likewise of edges, */
  uint32_t face_slots;   /**< and of triangles. */
  uint32_t reserved;     /**< 0. */
} dsw_body_counts;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_body_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_body_desc_init(dsw_body_desc *desc, size_t size);

/** Creates a body: locates every vertex and checks that it is free at its level. Index i of vertices and edges is the i-th
 * given; edges that only faces have follow, then faces triangle by triangle.
 * @param scene [in,out] @param desc [in] see dsw_body_desc. @param body [out] its id.
 * @return DSW_STATUS_NON_FINITE, STALE_ID (hints), OUTSIDE, IMPASSABLE (a vertex; the message names it), INDEX_OUT_OF_RANGE,
 * BAD_CELL (an edge or face names a vertex twice), DUPLICATE_CELL (an edge or triangle stands twice), SHARED_FACE (an edge of three
 * triangles, or a vertex whose triangles form more than one fan), INVERTED_CELL (neighbouring triangles are turned against
 * each other; DSW_BODY_SKIP_BACK_EDGES: the volume that they hold is not positive), NOT_CLOSED
 * (DSW_BODY_SKIP_BACK_EDGES: an edge has not two faces, or a vertex has no edge), OCCUPIED (edges or
 * faces meet something impassable, or touch a body: see dsw_scene_get_offending_edges), NOT_NAMED
 * (category, mask or DSW_BODY_SELF_CONTACTS without the feature), UNSUPPORTED (in the plane also
 * faces and DSW_BODY_SKIP_BACK_EDGES), WRONG_SIZE, OUT_OF_MEMORY: nothing was created.
 * @note O(vertices + volumes that edges cross), and the locating. Thread: writer; uses the parallel-for. Certain: what the level
 * covers is free. Source: [JCD10] 4. @since 1.0 */
DSW_API dsw_status dsw_body_create(dsw_scene *scene, const dsw_body_desc *desc, dsw_body_id *body);

/** Pairs of vertices (indices of the description, or of the body) of the edges that made the last dsw_body_create,
 * dsw_body_set_level or dsw_body_set_filter answer DSW_STATUS_OCCUPIED; of a vertex without edges twice the same.
 * @param scene [in] @param vertices [out] 2 * `count` numbers, owned by the scene, valid until the next such call.
 * @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_offending_edges(const dsw_scene *scene, const uint32_t **vertices, size_t *count);

/** The bodies that made the last marking call answer DSW_STATUS_OCCUPIED, or that occupy volumes it left out; each once.
 * @param scene [in] @param bodies [out] owned by the scene, valid until the next marking call.
 * @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_occupant_bodies(const dsw_scene *scene, const dsw_body_id **bodies, size_t *count);

/** Removes a body; its ids become stale.
 * @param scene [in,out] @param body [in] @return DSW_STATUS_STALE_ID. @note O(its size). Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_body_destroy(dsw_scene *scene, dsw_body_id body);

/** How many bodies there are.
 * @param scene [in] @param count [out] @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_body_count(const dsw_scene *scene, size_t *count);

/** Ids of the bodies of a scene, by index.
 * @param scene [in] @param bodies [out] `capacity` ids. @param capacity [in] its entries.
 * @param count [out] how many there are.
 * @return DSW_STATUS_BUFFER_TOO_SMALL. @note O(bodies). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_bodies(const dsw_scene *scene, dsw_body_id *bodies, size_t capacity, size_t *count);

/** How many parts a body has.
 * @param scene, body [in] @param counts [in,out] its struct_size set.
 * @return DSW_STATUS_STALE_ID, BAD_STRUCT_SIZE. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_counts(const dsw_scene *scene, dsw_body_id body, dsw_body_counts *counts);

/** Level of a body.
 * @param scene, body [in] @param level [out] @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_level(const dsw_scene *scene, dsw_body_id body, dsw_level *level);

/** Changes the level. Raising it checks that the body is free there.
 * @param scene [in,out] @param body, level [in]
 * @return DSW_STATUS_OCCUPIED: it is not, the level stays; see dsw_scene_get_offending_edges. DSW_STATUS_UNSUPPORTED.
 * @note Lowering: O(1). Raising: as creation. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_body_set_level(dsw_scene *scene, dsw_body_id body, dsw_level level);

/** Which bodies it meets, see dsw_body_desc.
 * @param scene, body [in] @param category, mask [out]
 * @return DSW_STATUS_NOT_NAMED without DSW_FEATURE_BODY_CONTACTS. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_filter(const dsw_scene *scene, dsw_body_id body, uint32_t *category, uint32_t *mask);

/** Changes that; 0 as in dsw_body_desc.
 * @param scene [in,out] @param body, category, mask [in]
 * @return DSW_STATUS_NOT_NAMED; DSW_STATUS_OCCUPIED: it touches a body that it would meet, the filter stays; see
 * dsw_scene_get_offending_edges. @note O(its size). Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_body_set_filter(dsw_scene *scene, dsw_body_id body, uint32_t category, uint32_t mask);

/** Positions of all vertices, by index; free slots get zeros.
 * @param scene, body [in] @param positions [out] `capacity` points, stride_bytes apart (0 means 8 * dimension).
 * @param capacity, stride_bytes [in] @param volumes [out] null, or `capacity` ids. @param count [out] vertex slots.
 * @return DSW_STATUS_BUFFER_TOO_SMALL: only `count` was set. @note O(slots). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_positions(const dsw_scene *scene, dsw_body_id body, double *positions, size_t capacity,
                                          size_t stride_bytes, dsw_volume_id *volumes, size_t *count);

/** Ids of all living vertices, in the order of their indices.
 * @param scene, body [in] @param vertices [out] `capacity` ids. @param capacity [in]
 * @param count [out] how many there are.
 * @return DSW_STATUS_BUFFER_TOO_SMALL: only `count` was set. @note O(slots). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_vertices(const dsw_scene *scene, dsw_body_id body, dsw_body_vertex_id *vertices,
                                         size_t capacity, size_t *count);
/** Ids of all living edges, likewise.
 * @param scene, body [in] @param edges [out] `capacity` ids. @param capacity [in] @param count [out] how many there are.
 * @return as dsw_body_get_vertices. @note O(slots). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_edges(const dsw_scene *scene, dsw_body_id body, dsw_body_edge_id *edges,
                                      size_t capacity, size_t *count);
/** Ids of all living triangles, likewise.
 * @param scene, body [in] @param faces [out] `capacity` ids. @param capacity [in] @param count [out] how many there are.
 * @return as dsw_body_get_vertices. @note O(slots). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_faces(const dsw_scene *scene, dsw_body_id body, dsw_body_face_id *faces,
                                      size_t capacity, size_t *count);

/** Ends of an edge.
 * @param scene, body, edge [in] @param vertices [out] 2 ids.
 * @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_edge(const dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge,
                                     dsw_body_vertex_id *vertices);
/** Corners of a triangle.
 * @param scene, body, face [in] @param vertices [out] 3 ids.
 * @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_face(const dsw_scene *scene, dsw_body_id body, dsw_body_face_id face,
                                     dsw_body_vertex_id *vertices);

/** Id of the vertex with an index.
 * @param scene, body, index [in] @param vertex [out]
 * @return DSW_STATUS_OUT_OF_RANGE (not below the slots, or free). @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_vertex(const dsw_scene *scene, dsw_body_id body, uint32_t index,
                                       dsw_body_vertex_id *vertex);
/** Ends of all edges at once, by index: two vertex indices each, UINT32_MAX in free slots.
 * @param scene, body [in] @param vertices [out] 2 * `capacity` numbers.
 * @param capacity [in] edges that it has room for. @param count [out] edge slots.
 * @return DSW_STATUS_BUFFER_TOO_SMALL: only `count` was set. @note O(slots). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_edge_vertices(const dsw_scene *scene, dsw_body_id body, uint32_t *vertices,
                                              size_t capacity, size_t *count);
/** Corners of all triangles, likewise: three vertex indices each.
 * @param scene, body [in] @param vertices [out] 3 * `capacity` numbers.
 * @param capacity [in] triangles that it has room for. @param count [out] face slots.
 * @return DSW_STATUS_BUFFER_TOO_SMALL: only `count` was set. @note O(slots). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_face_vertices(const dsw_scene *scene, dsw_body_id body, uint32_t *vertices,
                                              size_t capacity, size_t *count);

/** Adds a vertex without edges.
 * @param scene [in,out] @param body [in] @param position [in] as many finite doubles as there are dimensions.
 * @param hint [in] a volume near it, or null id. @param vertex [out] its id.
 * @return as dsw_particle_create; OCCUPIED: it touches a body that it would meet. @note Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_body_add_vertex(dsw_scene *scene, dsw_body_id body, const double *position, dsw_volume_id hint,
                                       dsw_body_vertex_id *vertex);
/** Adds an edge between two vertices.
 * @param scene [in,out] @param body, a, b [in] @param edge [out] its id.
 * @return DSW_STATUS_STALE_ID, BAD_CELL (a == b), DUPLICATE_CELL, OCCUPIED (it is not free): nothing has changed.
 * @note O(volumes it crosses). Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_body_add_edge(dsw_scene *scene, dsw_body_id body, dsw_body_vertex_id a, dsw_body_vertex_id b,
                                     dsw_body_edge_id *edge);
/** Adds a triangle, with those of its edges that are missing.
 * @param scene [in,out] @param body [in] @param a, b, c [in] its corners, in their order round it.
 * @param face [out] its id.
 * @return as dsw_body_add_edge; SHARED_FACE and INVERTED_CELL as dsw_body_create; UNSUPPORTED in the plane. @note Thread:
 * writer. @since 1.0 */
DSW_API dsw_status dsw_body_add_face(dsw_scene *scene, dsw_body_id body, dsw_body_vertex_id a, dsw_body_vertex_id b,
                                     dsw_body_vertex_id c, dsw_body_face_id *face);
/** Removes a face. Always possible, also where the faces left at a vertex form several fans then.
 * @param scene [in,out] @param body, face [in]
 * @return DSW_STATUS_STALE_ID. @note O(what is round it). Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_body_remove_face(dsw_scene *scene, dsw_body_id body, dsw_body_face_id face);
/** Removes an edge with its faces, likewise.
 * @param scene [in,out] @param body, edge [in]
 * @return DSW_STATUS_STALE_ID. @note O(what is round it). Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_body_remove_edge(dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge);
/** Removes a vertex with its edges and faces, likewise.
 * @param scene [in,out] @param body, vertex [in]
 * @return DSW_STATUS_STALE_ID. @note O(what is round it). Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_body_remove_vertex(dsw_scene *scene, dsw_body_id body, dsw_body_vertex_id vertex);

/** What became of an edge that was split at a new vertex, or of a vertex that was merged into another. Attributes of a new vertex
 * are (1 - share) * those of ends[0] + share * those of ends[1]. */
typedef struct dsw_body_edit {
  dsw_body_vertex_id vertex;  /**< The new vertex, or the one that is gone. */
  dsw_body_vertex_id ends[2]; /**< Split: of the edge. Merge: ends[0] is the vertex it was merged into. */
  dsw_body_edge_id edge;      /**< Split: keeps ends[0], and its id. Merge: the edge that is gone. */
  dsw_body_edge_id rest;      /**< Split: the new edge at ends[1]. */
  double share;               /**< Split: place on the edge, in (0,1). */
  uint32_t inserted;          /**< 1: split, 0: merge. */
  uint32_t reserved;          /**< 0. */
} dsw_body_edit;

/** Splits an edge at ends[0] + share * (ends[1] - ends[0]), rounded, and its faces with it. What the rounding sweeps is checked.
 * @param scene [in,out] @param body, edge [in] @param share [in] in (0,1). @param edit [out] may be null.
 * @return DSW_STATUS_STALE_ID, OUT_OF_RANGE (share), OCCUPIED (a part is not free): nothing has changed.
 * @note Thread: writer. Source: [JCD10] 4.2. @since 1.0 */
DSW_API dsw_status dsw_body_split_edge(dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge, double share,
                                       dsw_body_edit *edit);
/** Moves `vertex` to the other end of `edge`, swept at the body's level, and merges it there.
 * @param scene [in,out] @param body, edge, vertex [in] @param edit [out] may be null.
 * @return DSW_STATUS_STALE_ID, NOT_FOUND (`vertex` is no end of `edge`), BAD_CELL (the body would not stay a manifold), OCCUPIED
 * (the way is not free): nothing has changed. @note Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_body_collapse_edge(dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge,
                                          dsw_body_vertex_id vertex, dsw_body_edit *edit);

#ifdef __cplusplus
}
#endif

#endif
