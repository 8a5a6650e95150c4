/** @file body.h
 * Bodies: vertices joined by edges and, for surfaces, by triangles. The parts that a body's level
 * covers never meet anything impassable, exactly. With DSW_FEATURE_BODY_CONTACTS, bodies whose
 * filters match do not touch or pass each other either. Calls that would break this are refused.
 * Exceptions, each by its own flag: DSW_BODY_LEAVE_BACK_EDGES, DSW_BODY_START_PENETRATING.
 *
 * A body with a radius is thick. At every level, on the whole way of its vertices, edges and faces,
 * it keeps its radius from anything impassable, and the sum of both radii from a body that it can
 * meet. With DSW_BODY_SELF_CONTACTS its own parts keep two radii apart, unless a way of at most 4
 * radii along its edges joins them. All this holds up to 2^-34 of the distance.
 *
 * Arrays by vertex have an entry for each slot; removed parts leave free slots. `edit` may be null.
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

/** Flags of a body. Lossless flags only save time; lossy ones can miss contacts on the way. */
enum {
  /** Lossless. Skips edges that still cross the same faces. */
  DSW_BODY_SEQUENCES = 0x1,
  /** Lossless [JCD10] 6.1. Skips edges that sweep inside of one convex volume. */
  DSW_BODY_SKIP_BY_ENVIRONMENT = 0x2,
  /** Lossless. Skips edges that sweep inside of a free ball. */
  DSW_BODY_SKIP_BY_CLEARANCE = 0x4,
  /** Lossy, at DSW_LEVEL_EDGES. Tests edges whose ends move alike (`motion_share`) only at the
   * end. */
  DSW_BODY_SKIP_SIMILAR_MOTION = 0x8,
  /** Parts of the body without a common vertex must not touch [JCD10] 4.4. Needs
   * DSW_FEATURE_BODY_CONTACTS. */
  DSW_BODY_SELF_CONTACTS = 0x10,
  /** Lossy, at DSW_LEVEL_EDGES, for closed surfaces turned outwards: back-edge elimination [JCD10]
   * 6.2. */
  DSW_BODY_SKIP_BACK_EDGES = 0x20,
  /** Walls push the body by rigid motions, or wait [JCD10] 5.1. These and dsw_body_move_rigid add
   * up no rounding of the shape. Responses insert no vertices. */
  DSW_BODY_RIGID = 0x40,
  /** Lossless. Edges keep no sequences, which they do from DSW_LEVEL_EDGES_SWEPT on: 8 bytes for an
   * edge, and several hundred once one that passes facets is noted. Moves are slower. @since 2.1 */
  DSW_BODY_NO_SEQUENCES = 0x80,
  /** Lossy, with DSW_BODY_SKIP_BACK_EDGES, which then works as in [JCD10] 6.2 and 6.3: an edge that
   * goes inwards is not tested until it goes outwards. Meanwhile it can meet something impassable:
   * see dsw_body_get_untested_edges. @since 2.1 */
  DSW_BODY_LEAVE_BACK_EDGES = 0x100,
  /** The body is created even if it is not free, or lies outside. Then it penetrates: only
   * functions that take a const scene, dsw_body_destroy and those of penetrations accept it (others:
   * OCCUPIED), and nothing meets it, until dsw_body_depenetrate frees it. @since 2.1 */
  DSW_BODY_START_PENETRATING = 0x200
};

/** Describes a body. */
typedef struct dsw_body_desc {
  uint32_t struct_size;
  uint32_t flags;
  dsw_level level; /**< DSW_LEVEL_EDGES_SWEPT by default. */
  uint32_t reserved;
  const double *positions;    /**< Points, one for each vertex. */
  size_t vertex_count;        /**< At least 1. */
  size_t stride_bytes;        /**< From position to position; see base.h. */
  const dsw_volume_id *hints; /**< Null, or a hint for each vertex. */
  const uint32_t *edges;      /**< Two vertices each; not needed for faces. */
  size_t edge_count;
  /** Face i has the corners face_corners[face_offsets[i] .. face_offsets[i+1]-1]. Polygons become
   * fans of triangles round their first corner. */
  const uint32_t *face_offsets;
  const uint32_t *face_corners; /**< Vertices. */
  size_t face_count;            /**< Faces; face_offsets has one more entry. */
  size_t face_corner_count;
  double motion_share; /**< For DSW_BODY_SKIP_SIMILAR_MOTION; 0 means 0.1. */
  /** Two bodies can meet if the category of each has a bit of the other's mask; 0 means 1. Both
   * need DSW_FEATURE_BODY_CONTACTS. */
  uint32_t category;
  uint32_t mask; /**< 0 means all bits. */
  double radius; /**< Finite, at least 0 (default): how thick it is. @since 2.1 */
} dsw_body_desc;

/** Numbers of living parts, and of slots: `vertex_slots`, `edge_slots`, `face_slots`. */
typedef struct dsw_body_counts {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t edge_count;
  uint32_t face_count;
  uint32_t vertex_slots;
  uint32_t edge_slots;
  uint32_t face_slots;
  uint32_t reserved;
} dsw_body_counts;

DSW_API void dsw_body_desc_init(dsw_body_desc *desc, size_t size);

/** Creates a body. Vertices and edges keep their indices; other edges of faces follow.
 * @return DSW_STATUS_OUTSIDE, IMPASSABLE, INDEX_OUT_OF_RANGE, REPEATED_VERTEX, DUPLICATE_PART,
 * NOT_ORIENTED; NOT_MANIFOLD: three triangles at an edge, several fans at a vertex; OCCUPIED: not
 * free, or too near; for DSW_BODY_SKIP_BACK_EDGES NOT_CLOSED, NOT_ORIENTED: no volume inside;
 * UNSUPPORTED: DSW_BODY_LEAVE_BACK_EDGES without it, with a radius, RIGID, SKIP_SIMILAR_MOTION or
 * START_PENETRATING.
 * @note Cost: O(vertices + volumes that edges cross). Batch. Source: [JCD10] 4. */
DSW_API dsw_status dsw_body_create(dsw_scene *scene, const dsw_body_desc *desc, dsw_body_id *body);

/** Tells whether a body penetrates: created with DSW_BODY_START_PENETRATING, and not freed yet.
 * @param penetrating 1 or 0.
 * @since 2.1 */
DSW_API dsw_status dsw_body_is_penetrating(const dsw_scene *scene, dsw_body_id body,
                                           uint32_t *penetrating);

/** Finds what a penetrating body crosses where it lies: each vertex or edge that is not free, with
 * the first wall; if there is none, each face with a wall; each pair of parts of bodies that touch.
 * If all that is empty, the parts that are too near to something. Nothing for other bodies.
 * @param penetrations by vertices, edges, faces; those with walls first.
 * @note Cost: as creation. Writes the scene. @since 2.1 */
DSW_API dsw_status dsw_body_find_penetrations(dsw_scene *scene, dsw_body_id body,
                                              const dsw_penetration **penetrations, size_t *count);

/** Moves a penetrating body out, or leaves it as it is. All that its level covers is then free, by
 * the tests of dsw_body_create at the rounded places. Of walls, each connected part goes to the side
 * on which most of its vertices are that free edges join; these vertices pass no wall. Bodies that
 * don't bend, and those that cross bodies, are also tried as a whole in 26 directions (8 in the
 * plane): a convex body leaves another one by at most twice the depth. Other bodies stay. Works
 * for what is shallower than half an edge; parts that cross deeply or knot can fail.
 * @param inside null, or a volume: the side is what passable faces join with it. Needed if no
 * vertex of the body lies in a passable volume.
 * @param max_distance largest displacement of a vertex; 0: any.
 * @param freed 1, or 0: dsw_scene_get_offending_edges gives what could not be freed.
 * @param distance null, or the largest displacement of a vertex, rounded.
 * @return DSW_STATUS_IMPASSABLE: `inside`.
 * @note Cost: O(creation) for each of up to 64 rounds and 1000 tries. A free body: nothing is done.
 * @since 2.1 */
DSW_API dsw_status dsw_body_depenetrate(dsw_scene *scene, dsw_body_id body, dsw_volume_id inside,
                                        double max_distance, uint32_t *freed, double *distance);

/** Gives the edges that made the last dsw_body_create or dsw_body_set_... answer OCCUPIED.
 * @param vertices two indices for each edge, equal for a lone vertex. */
DSW_API dsw_status dsw_scene_get_offending_edges(const dsw_scene *scene, const uint32_t **vertices,
                                                 size_t *count);

/** Gives the bodies in the way of the last marking call. */
DSW_API dsw_status dsw_scene_get_occupant_bodies(const dsw_scene *scene, const dsw_body_id **bodies,
                                                 size_t *count);

/** Removes a body. @note Cost: O(body). */
DSW_API dsw_status dsw_body_destroy(dsw_scene *scene, dsw_body_id body);

/** Counts the bodies of a scene. */
DSW_API dsw_status dsw_scene_get_body_count(const dsw_scene *scene, size_t *count);

/** Copies the ids of all bodies, by index. @note Cost: O(bodies). */
DSW_API dsw_status dsw_scene_get_body_ids(const dsw_scene *scene, dsw_body_id *bodies,
                                          size_t capacity, size_t *count);

/** Counts the parts of a body. */
DSW_API dsw_status dsw_body_get_counts(const dsw_scene *scene, dsw_body_id body,
                                       dsw_body_counts *counts);

/** Gives the level of a body. */
DSW_API dsw_status dsw_body_get_level(const dsw_scene *scene, dsw_body_id body, dsw_level *level);

/** Changes the level of a body.
 * @return DSW_STATUS_OCCUPIED: not free at that level.
 * @note Cost: O(1) to lower, as creation to raise. */
DSW_API dsw_status dsw_body_set_level(dsw_scene *scene, dsw_body_id body, dsw_level level);

/** Gives `category` and `mask` of a body, with DSW_FEATURE_BODY_CONTACTS. */
DSW_API dsw_status dsw_body_get_filter(const dsw_scene *scene, dsw_body_id body, uint32_t *category,
                                       uint32_t *mask);

/** Changes `category` and `mask` of a body, with DSW_FEATURE_BODY_CONTACTS.
 * @return DSW_STATUS_OCCUPIED: the body would touch another.
 * @note Cost: O(body). */
DSW_API dsw_status dsw_body_set_filter(dsw_scene *scene, dsw_body_id body, uint32_t category,
                                       uint32_t mask);

/** Gives the `radius` of a body. @since 2.1 */
DSW_API dsw_status dsw_body_get_radius(const dsw_scene *scene, dsw_body_id body, double *radius);

/** Changes the radius of a body.
 * @param radius finite, at least 0.
 * @return DSW_STATUS_OCCUPIED: something is too near.
 * @note Cost: as creation. @since 2.1 */
DSW_API dsw_status dsw_body_set_radius(dsw_scene *scene, dsw_body_id body, double radius);

/** Gives a lower bound of the least gap of a body: distance less radii, over all that it must not
 * touch.
 * @param limit finite, at least 0; larger gaps are not looked at.
 * @param gap at most `limit`; negative by at most 2^-34 of the radii.
 * @note Cost: O(volumes within the limit). Writes the scene. @since 2.1 */
DSW_API dsw_status dsw_body_find_least_gap(dsw_scene *scene, dsw_body_id body, double limit,
                                           double *gap);

/** Copies the positions of all vertex slots, zeros for free ones.
 * @param volumes may be null; those with the vertices.
 * @note Cost: O(slots). */
DSW_API dsw_status dsw_body_get_positions(const dsw_scene *scene, dsw_body_id body,
                                          double *positions, size_t capacity, size_t stride_bytes,
                                          dsw_volume_id *volumes, size_t *count);

/** Copies the ids of all vertices, by index. @note Cost: O(slots). */
DSW_API dsw_status dsw_body_get_vertex_ids(const dsw_scene *scene, dsw_body_id body,
                                           dsw_body_vertex_id *vertices, size_t capacity,
                                           size_t *count);

/** Copies the ids of all edges, by index. @note Cost: O(slots). */
DSW_API dsw_status dsw_body_get_edge_ids(const dsw_scene *scene, dsw_body_id body,
                                         dsw_body_edge_id *edges, size_t capacity, size_t *count);

/** Copies the ids of all triangles, by index. @note Cost: O(slots). */
DSW_API dsw_status dsw_body_get_face_ids(const dsw_scene *scene, dsw_body_id body,
                                         dsw_body_face_id *faces, size_t capacity, size_t *count);

/** Copies the ids of the edges that DSW_BODY_LEAVE_BACK_EDGES has left untested where they are, by
 * index. All others are free. Other calls than dsw_body_move, dsw_scene_move_bodies and those of
 * particles test them first. While one is not free, such calls see the vertices of this body
 * alone: bindings/docs/moving_bodies.md.
 * @note Cost: O(slots). @since 2.1 */
DSW_API dsw_status dsw_body_get_untested_edges(const dsw_scene *scene, dsw_body_id body,
                                               dsw_body_edge_id *edges, size_t capacity,
                                               size_t *count);

/** Gives the two ends of an edge. */
DSW_API dsw_status dsw_body_get_edge_ends(const dsw_scene *scene, dsw_body_id body,
                                          dsw_body_edge_id edge, dsw_body_vertex_id *vertices);

/** Gives the three corners of a triangle. */
DSW_API dsw_status dsw_body_get_face_corners(const dsw_scene *scene, dsw_body_id body,
                                             dsw_body_face_id face, dsw_body_vertex_id *vertices);

/** Gives the id of vertex `index`, whose slot is not free. */
DSW_API dsw_status dsw_body_get_vertex_id(const dsw_scene *scene, dsw_body_id body, uint32_t index,
                                          dsw_body_vertex_id *vertex);

/** Copies two vertex indices for each edge slot, UINT32_MAX for a free one.
 * @param vertices 2 * `capacity` numbers.
 * @note Cost: O(slots). */
DSW_API dsw_status dsw_body_get_edge_indices(const dsw_scene *scene, dsw_body_id body,
                                             uint32_t *vertices, size_t capacity, size_t *count);

/** Copies three vertex indices for each triangle slot, UINT32_MAX for a free one.
 * @param vertices 3 * `capacity` numbers.
 * @note Cost: O(slots). */
DSW_API dsw_status dsw_body_get_face_indices(const dsw_scene *scene, dsw_body_id body,
                                             uint32_t *vertices, size_t capacity, size_t *count);

/** Adds a vertex without edges.
 * @return as dsw_particle_create; OCCUPIED: it touches a body.
 * @note Cost: as dsw_environment_locate. */
DSW_API dsw_status dsw_body_add_vertex(dsw_scene *scene, dsw_body_id body, const double *position,
                                       dsw_volume_id hint, dsw_body_vertex_id *vertex);

/** Adds an edge between two vertices.
 * @return DSW_STATUS_REPEATED_VERTEX, DUPLICATE_PART; OCCUPIED: not free.
 * @note Cost: O(volumes met). */
DSW_API dsw_status dsw_body_add_edge(dsw_scene *scene, dsw_body_id body, dsw_body_vertex_id a,
                                     dsw_body_vertex_id b, dsw_body_edge_id *edge);

/** Adds a triangle and its missing edges.
 * @return as dsw_body_add_edge; DSW_STATUS_NOT_MANIFOLD, NOT_ORIENTED.
 * @note Cost: O(volumes met). */
DSW_API dsw_status dsw_body_add_face(dsw_scene *scene, dsw_body_id body, dsw_body_vertex_id a,
                                     dsw_body_vertex_id b, dsw_body_vertex_id c,
                                     dsw_body_face_id *face);

/** Removes a face. @note Cost: O(parts there). */
DSW_API dsw_status dsw_body_remove_face(dsw_scene *scene, dsw_body_id body, dsw_body_face_id face);

/** Removes an edge and its faces.
 * @return DSW_STATUS_OCCUPIED: parts of a thick body that meets itself would be too near.
 * @note Cost: O(parts there). */
DSW_API dsw_status dsw_body_remove_edge(dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge);

/** Removes a vertex, its edges and faces.
 * @return as dsw_body_remove_edge.
 * @note Cost: O(parts there). */
DSW_API dsw_status dsw_body_remove_vertex(dsw_scene *scene, dsw_body_id body,
                                          dsw_body_vertex_id vertex);

/** A split of an edge, or a merge of a vertex into another. */
typedef struct dsw_body_edit {
  dsw_body_vertex_id vertex; /**< The new vertex, or that removed. */
  /** The edge's ends. Merge: ends[0] stays. */
  dsw_body_vertex_id ends[2];
  dsw_body_edge_id edge; /**< Split: the part at ends[0], with the old id. */
  dsw_body_edge_id rest; /**< Split: the part at ends[1]. */
  double edge_parameter; /**< Split: the weight of ends[1]. */
  uint32_t inserted;     /**< 1: split; 0: merge. */
  uint32_t reserved;
} dsw_body_edit;

/** Splits an edge and its faces at ends[0] + `edge_parameter` * (ends[1] - ends[0]), rounded; the
 * parameter is in (0,1).
 * @return DSW_STATUS_OCCUPIED: a part is not free.
 * @note Cost: O(volumes met). Source: [JCD10] 4.2. */
DSW_API dsw_status dsw_body_split_edge(dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge,
                                       double edge_parameter, dsw_body_edit *edit);

/** Moves `vertex` to the other end of `edge`, if the way is free, and merges the two.
 * @return DSW_STATUS_NOT_FOUND: `vertex` is no end of `edge`; NOT_MANIFOLD; OCCUPIED.
 * @note Cost: O(volumes met). */
DSW_API dsw_status dsw_body_collapse_edge(dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge,
                                          dsw_body_vertex_id vertex, dsw_body_edit *edit);

#ifdef __cplusplus
}
#endif

#endif
