/** @file body.h
 * Bodies: vertices joined by edges and, for surfaces, by triangles. The parts that a body's level
 * covers never meet anything impassable, exactly. Calls that would break this are refused.
 *
 * With DSW_FEATURE_BODY_CONTACTS, bodies whose filters match do not touch or pass each other
 * either.
 *
 * A body may have a radius. Then it is thick: its edges are capsules, its faces plates with round
 * rims. Every distance from the parts that its level covers to anything impassable is at least the
 * radius, and to a body that it can meet at least the sum of both radii. This holds on the whole
 * way of each vertex, its edges and its faces, at every level. A distance counts as large enough if
 * a lower bound of it, rounded down, is at least 1 - 2^-34 of what it must be. The bound loses 2^-36
 * of the distance and 2^-70 of the size of both parts. What is below 2^-1022 counts as 0. The time
 * of a touch is at most 2^-48 of itself early.
 *
 * Parts of the same body (DSW_BODY_SELF_CONTACTS) keep two radii apart, unless a way of at most 4
 * radii along the body's edges joins them; then they must only not touch. The edges have the lengths
 * there that they had when the radius was set, or the edge was added. Halves of an edge share its
 * length. Parts count if no larger part covers them: faces, edges without faces, lone vertices.
 *
 * Arrays by vertex have an entry for each slot. Removed parts leave free slots. `edit` may be null.
 *
 * More: bindings/docs/moving_bodies.md.
 */
#ifndef DARTSWEEP_BODY_H
#define DARTSWEEP_BODY_H

#include "dartsweep/contact.h"
#include "dartsweep/scene.h"
#include "dartsweep/sweep.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Flags of a body. Lossless flags only save time. With lossy flags contacts on the way may be
 * missed. */
enum {
  /** Lossless. Skips edges that still cross the same faces. */
  DSW_BODY_SEQUENCES = 0x1,
  /** Lossless [JCD10] 6.1. Skips edges that sweep inside of one convex volume. */
  DSW_BODY_SKIP_BY_ENVIRONMENT = 0x2,
  /** Lossless. Skips edges that sweep inside of a ball known to be free. */
  DSW_BODY_SKIP_BY_CLEARANCE = 0x4,
  /** Lossy, at DSW_LEVEL_EDGES. Tests edges whose ends move alike (`motion_share`) at their targets
   * only. */
  DSW_BODY_SKIP_SIMILAR_MOTION = 0x8,
  /** Parts of the body without a common vertex must not touch [JCD10] 4.4. Needs
   * DSW_FEATURE_BODY_CONTACTS. */
  DSW_BODY_SELF_CONTACTS = 0x10,
  /** Lossy, at DSW_LEVEL_EDGES, for closed surfaces with faces turned outwards: back-edge
   * elimination [JCD10] 6.2. */
  DSW_BODY_SKIP_BACK_EDGES = 0x20,
  /** Walls push the body by rigid motions, or wait [JCD10] 5.1. Pushes and dsw_body_move_rigid keep
   * the shape without adding up rounding. Responses insert no vertices. */
  DSW_BODY_RIGID = 0x40
};

/** Describes a body. */
typedef struct dsw_body_desc {
  uint32_t struct_size;       /**< sizeof(dsw_body_desc). */
  uint32_t flags;             /**< DSW_BODY_... */
  dsw_level level;            /**< DSW_LEVEL_EDGES_SWEPT by default. */
  uint32_t reserved;          /**< 0. */
  const double *positions;    /**< Points, one for each vertex. */
  size_t vertex_count;        /**< At least 1. */
  size_t stride_bytes;        /**< As in base.h. */
  const dsw_volume_id *hints; /**< May be null; a hint for each vertex. */
  const uint32_t *edges;      /**< Two vertices each; not necessary for faces. */
  size_t edge_count;          /**< Edges. */
  /** Face i has the corners face_corners[face_offsets[i] .. face_offsets[i+1]-1], in order.
   * Polygons become fans of triangles round their first corner. */
  const uint32_t *face_offsets;
  const uint32_t *face_corners; /**< Vertices. */
  size_t face_count;            /**< Faces; face_offsets has one more entry. */
  size_t face_corner_count;     /**< Entries of face_corners. */
  double motion_share;          /**< For DSW_BODY_SKIP_SIMILAR_MOTION; 0 means 0.1. */
  /** Two bodies can meet if the category of each has a bit of the other's mask. 0 means 1.
   * `category` and `mask` need DSW_FEATURE_BODY_CONTACTS. */
  uint32_t category;
  uint32_t mask; /**< 0 means all bits. */
  double radius; /**< How thick the body is; finite, at least 0. Default 0. @since 2.1 */
} dsw_body_desc;

/** Numbers of parts. All indices are below the number of slots. */
typedef struct dsw_body_counts {
  uint32_t struct_size;  /**< sizeof(dsw_body_counts). */
  uint32_t vertex_count; /**< Living vertices. */
  uint32_t edge_count;   /**< Living edges. */
  uint32_t face_count;   /**< Living triangles. */
  uint32_t vertex_slots; /**< Slots of vertices. */
  uint32_t edge_slots;   /**< Slots of edges. */
  uint32_t face_slots;   /**< Slots of triangles. */
  uint32_t reserved;     /**< 0. */
} dsw_body_counts;

/** Writes the defaults. @since 2.0 */
DSW_API void dsw_body_desc_init(dsw_body_desc *desc, size_t size);

/** Creates a body. Vertices and edges keep their indices. Other edges of faces follow. Triangles of
 * faces are numbered in order.
 * @return DSW_STATUS_OUTSIDE, IMPASSABLE: a vertex; INDEX_OUT_OF_RANGE, REPEATED_VERTEX,
 * DUPLICATE_PART, NOT_ORIENTED; NOT_MANIFOLD: three triangles at an edge, several fans at a vertex;
 * OCCUPIED: not free, or too near for the radius; NOT_ENABLED: DSW_FEATURE_BODY_CONTACTS. For
 * DSW_BODY_SKIP_BACK_EDGES also NOT_CLOSED; NOT_ORIENTED: no volume inside.
 * @note Cost: O(vertices + volumes that edges cross). Batch. Source: [JCD10] 4. @since 2.0 */
DSW_API dsw_status dsw_body_create(dsw_scene *scene, const dsw_body_desc *desc, dsw_body_id *body);

/** Gives the edges that made the last dsw_body_create, dsw_body_set_level, dsw_body_set_filter or
 * dsw_body_set_radius answer DSW_STATUS_OCCUPIED.
 * @param vertices two indices for each edge, equal for a lone vertex.
 * @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_scene_get_offending_edges(const dsw_scene *scene, const uint32_t **vertices,
                                                 size_t *count);

/** Gives the bodies that were in the way of the last marking call. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_scene_get_occupant_bodies(const dsw_scene *scene, const dsw_body_id **bodies,
                                                 size_t *count);

/** Removes a body. Its ids become stale. @note Cost: O(body). @since 2.0 */
DSW_API dsw_status dsw_body_destroy(dsw_scene *scene, dsw_body_id body);

/** Counts the bodies of a scene. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_scene_get_body_count(const dsw_scene *scene, size_t *count);

/** Copies the ids of all bodies, by index. @note Cost: O(bodies). @since 2.0 */
DSW_API dsw_status dsw_scene_get_body_ids(const dsw_scene *scene, dsw_body_id *bodies,
                                          size_t capacity, size_t *count);

/** Counts the parts of a body. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_body_get_counts(const dsw_scene *scene, dsw_body_id body,
                                       dsw_body_counts *counts);

/** Gives the level of a body. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_body_get_level(const dsw_scene *scene, dsw_body_id body, dsw_level *level);

/** Changes the level of a body.
 * @return DSW_STATUS_OCCUPIED: the body is not free at that level.
 * @note Cost: O(1) to lower, as creation to raise. @since 2.0 */
DSW_API dsw_status dsw_body_set_level(dsw_scene *scene, dsw_body_id body, dsw_level level);

/** Gives `category` and `mask` of a body.
 * @return DSW_STATUS_NOT_ENABLED: DSW_FEATURE_BODY_CONTACTS.
 * @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_body_get_filter(const dsw_scene *scene, dsw_body_id body, uint32_t *category,
                                       uint32_t *mask);

/** Changes `category` and `mask` of a body.
 * @return DSW_STATUS_NOT_ENABLED; OCCUPIED: the body would touch another.
 * @note Cost: O(body). @since 2.0 */
DSW_API dsw_status dsw_body_set_filter(dsw_scene *scene, dsw_body_id body, uint32_t category,
                                       uint32_t mask);

/** Gives the `radius` of a body. @note Cost: O(1). @since 2.1 */
DSW_API dsw_status dsw_body_get_radius(const dsw_scene *scene, dsw_body_id body, double *radius);

/** Changes the radius of a body.
 * @param radius finite, at least 0.
 * @return DSW_STATUS_OUT_OF_RANGE; OCCUPIED: something is too near.
 * @note Cost: as creation. @since 2.1 */
DSW_API dsw_status dsw_body_set_radius(dsw_scene *scene, dsw_body_id body, double radius);

/** Gives a lower bound of the least gap of a body: distance less the radii, over all that it must
 * not touch. Every distance is rounded down, so the bound holds.
 * @param limit finite, at least 0. What has a larger gap is not looked at.
 * @param gap at most `limit`. Negative by at most 2^-34 of the radii.
 * @note Cost: O(volumes within the limit of the body). Threads: writes the scene. @since 2.1 */
DSW_API dsw_status dsw_body_find_least_gap(dsw_scene *scene, dsw_body_id body, double limit,
                                           double *gap);

/** Copies the positions of all vertex slots. Free slots get zeros.
 * @param volumes may be null; the volumes that hold the vertices.
 * @note Cost: O(slots). @since 2.0 */
DSW_API dsw_status dsw_body_get_positions(const dsw_scene *scene, dsw_body_id body,
                                          double *positions, size_t capacity, size_t stride_bytes,
                                          dsw_volume_id *volumes, size_t *count);

/** Copies the ids of all living vertices, by index. @note Cost: O(slots). @since 2.0 */
DSW_API dsw_status dsw_body_get_vertex_ids(const dsw_scene *scene, dsw_body_id body,
                                           dsw_body_vertex_id *vertices, size_t capacity,
                                           size_t *count);

/** Copies the ids of all living edges, by index. @note Cost: O(slots). @since 2.0 */
DSW_API dsw_status dsw_body_get_edge_ids(const dsw_scene *scene, dsw_body_id body,
                                         dsw_body_edge_id *edges, size_t capacity, size_t *count);

/** Copies the ids of all living triangles, by index. @note Cost: O(slots). @since 2.0 */
DSW_API dsw_status dsw_body_get_face_ids(const dsw_scene *scene, dsw_body_id body,
                                         dsw_body_face_id *faces, size_t capacity, size_t *count);

/** Gives the two ends of an edge. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_body_get_edge_ends(const dsw_scene *scene, dsw_body_id body,
                                          dsw_body_edge_id edge, dsw_body_vertex_id *vertices);

/** Gives the three corners of a triangle. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_body_get_face_corners(const dsw_scene *scene, dsw_body_id body,
                                             dsw_body_face_id face, dsw_body_vertex_id *vertices);

/** Gives the id of vertex `index`. The slot must not be free. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_body_get_vertex_id(const dsw_scene *scene, dsw_body_id body, uint32_t index,
                                          dsw_body_vertex_id *vertex);

/** Copies two vertex indices for each edge slot, UINT32_MAX for a free one.
 * @param vertices 2 * `capacity` numbers.
 * @note Cost: O(slots). @since 2.0 */
DSW_API dsw_status dsw_body_get_edge_indices(const dsw_scene *scene, dsw_body_id body,
                                             uint32_t *vertices, size_t capacity, size_t *count);

/** Copies three vertex indices for each triangle slot, UINT32_MAX for a free one.
 * @param vertices 3 * `capacity` numbers.
 * @note Cost: O(slots). @since 2.0 */
DSW_API dsw_status dsw_body_get_face_indices(const dsw_scene *scene, dsw_body_id body,
                                             uint32_t *vertices, size_t capacity, size_t *count);

/** Adds a vertex without edges.
 * @return as dsw_particle_create; OCCUPIED: the vertex touches a body.
 * @note Cost: as dsw_environment_locate. @since 2.0 */
DSW_API dsw_status dsw_body_add_vertex(dsw_scene *scene, dsw_body_id body, const double *position,
                                       dsw_volume_id hint, dsw_body_vertex_id *vertex);

/** Adds an edge between two vertices.
 * @return DSW_STATUS_REPEATED_VERTEX, DUPLICATE_PART; OCCUPIED: the edge is not free.
 * @note Cost: O(volumes met). @since 2.0 */
DSW_API dsw_status dsw_body_add_edge(dsw_scene *scene, dsw_body_id body, dsw_body_vertex_id a,
                                     dsw_body_vertex_id b, dsw_body_edge_id *edge);

/** Adds a triangle and its missing edges.
 * @return as dsw_body_add_edge; DSW_STATUS_NOT_MANIFOLD, NOT_ORIENTED.
 * @note Cost: O(volumes met). @since 2.0 */
DSW_API dsw_status dsw_body_add_face(dsw_scene *scene, dsw_body_id body, dsw_body_vertex_id a,
                                     dsw_body_vertex_id b, dsw_body_vertex_id c,
                                     dsw_body_face_id *face);

/** Removes a face. @note Cost: O(parts there). @since 2.0 */
DSW_API dsw_status dsw_body_remove_face(dsw_scene *scene, dsw_body_id body, dsw_body_face_id face);

/** Removes an edge and its faces.
 * @return DSW_STATUS_OCCUPIED: parts of a thick body that meets itself would be too near to each other.
 * @note Cost: O(parts there). @since 2.0 */
DSW_API dsw_status dsw_body_remove_edge(dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge);

/** Removes a vertex, its edges and its faces.
 * @return as dsw_body_remove_edge.
 * @note Cost: O(parts there). @since 2.0 */
DSW_API dsw_status dsw_body_remove_vertex(dsw_scene *scene, dsw_body_id body,
                                          dsw_body_vertex_id vertex);

/** A split of an edge at a new vertex, or a merge of a vertex into another. */
typedef struct dsw_body_edit {
  dsw_body_vertex_id vertex; /**< Split: the new vertex. Merge: the removed vertex. */
  /** Split: ends of the edge. Merge: ends[0] is the vertex that stays. */
  dsw_body_vertex_id ends[2];
  dsw_body_edge_id edge; /**< Split: the part at ends[0], id kept. Merge: the removed edge. */
  dsw_body_edge_id rest; /**< Split: the new edge at ends[1]. */
  double edge_parameter; /**< Split: where on the edge; the weight of ends[1]. */
  uint32_t inserted;     /**< 1: split; 0: merge. */
  uint32_t reserved;     /**< 0. */
} dsw_body_edit;

/** Splits an edge and its faces at ends[0] + `edge_parameter` * (ends[1] - ends[0]), rounded. The
 * parameter is in (0,1).
 * @return DSW_STATUS_OCCUPIED: a part is not free.
 * @note Cost: O(volumes met). Source: [JCD10] 4.2. @since 2.0 */
DSW_API dsw_status dsw_body_split_edge(dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge,
                                       double edge_parameter, dsw_body_edit *edit);

/** Moves `vertex` to the other end of `edge`, if the way is free, and merges the two.
 * @return DSW_STATUS_NOT_FOUND: `vertex` is no end of `edge`; NOT_MANIFOLD; OCCUPIED.
 * @note Cost: O(volumes met). @since 2.0 */
DSW_API dsw_status dsw_body_collapse_edge(dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge,
                                          dsw_body_vertex_id vertex, dsw_body_edit *edit);

#ifdef __cplusplus
}
#endif

#endif
