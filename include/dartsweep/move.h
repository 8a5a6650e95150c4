/** @file move.h
 * Moves of bodies. A body moves one vertex at a time; contacts are exact for that order. After every call what the body's
 * level covers is free, and nothing the level sees was passed (but see DSW_BODY_SKIP_BACK_EDGES and
 * DSW_BODY_SKIP_SIMILAR_MOTION). [JCD10] 4.1, 4.2
 */
#ifndef DARTSWEEP_MOVE_H
#define DARTSWEEP_MOVE_H

#include "dartsweep/body.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How a contact is found [JCD10] 4.2. */
typedef enum dsw_search {
  DSW_SEARCH_EXACT = 0, /**< The first contact, at its exact time. */
  DSW_SEARCH_ALL =
      1, /**< All obstacles under the new edges, by time (angle); the first is that of EXACT. A face only if it is the first. */
  /** The dichotomic search. The whole way is tried; if it is not free, tries of parts of the way
   * halve what lies between a free place and one that is not, `bisection_depth` times. Each try
   * asks what the level asks: at EDGES a cast of the path and one of each edge in its new place,
   * from EDGES_SWEPT on also what is swept. No exact time is computed. The vertex is free at the
   * reported time, and at most 2^-depth of the way later it is not. At EDGES a way can be free
   * beyond a place that is not; then another contact than the first may be found. The vertex
   * stays if no tried place is free. The contact comes from the last try that was not free. Its
   * obstacle is the face which the path, or else the edge in its new place, runs into first; its
   * normal is that of the face's triangle there. If the path and the edge are both free, a small
   * obstacle lies inside of what is swept; the contact is then the first one of that sweep. Of several edges the
   * contact names the first one of the vertex, and another body only where the environment is
   * not met. */
  DSW_SEARCH_BISECTION = 2,
  DSW_SEARCH_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_search;

/** What is done about a contact [JCD10] 4.2, figure 5. Responses that insert vertices do so on a
 * touching edge, only where each part of that edge keeps `min_part` of it and what the edge
 * sweeps to its new vertex is free. A vertex that moves inserts at most 64 in one call. Where
 * nothing can be inserted they STOP; ADAPTIVE_SLIDE slides. */
typedef enum dsw_response {
  /** The vertex stops before the contact: "stop" of a vertex, "static" of an edge. */
  DSW_RESPONSE_STOP = 0,
  /** "Adaptive", one vertex: the edge gets a new vertex at the contact and the moving one goes
   * on. What the parts of the edge meet is answered in the same way again. */
  DSW_RESPONSE_ADAPTIVE_ONE = 1,
  /** "Adaptive", several vertices: the edge gets all of them at once, one at each obstacle that
   * lies under it: in the triangle between its present place, its other end and the target. The
   * first new vertex lies on the edge at the contact; the others stand at their obstacles,
   * `stand_off` away. They are inserted in the order in which obstacles are met, and one that
   * the edge cannot freely be bent to is left out. What the rest of the move meets is answered
   * in the same way. The response searches exhaustively by itself; `search` says which contacts
   * are reported. With DSW_SEARCH_BISECTION, which finds one obstacle, it is ADAPTIVE_ONE. */
  DSW_RESPONSE_ADAPTIVE_MANY = 2,
  /** "Hybrid": the edge gets one new vertex at the contact, and its parts are static: in this call
   * no edge of a new vertex gets another. */
  DSW_RESPONSE_HYBRID = 3,
  /** The rest of the move is projected on the obstacle and made there. Not in the paper. */
  DSW_RESPONSE_SLIDE = 4,
  /** ADAPTIVE_ONE where a vertex can be inserted, SLIDE where it cannot. Not in the paper. @since 1.1 */
  DSW_RESPONSE_ADAPTIVE_SLIDE = 5,
  DSW_RESPONSE_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_response;

/** Options of a move; null means all defaults. */
typedef struct dsw_move_options {
  uint32_t struct_size;         /**< sizeof(dsw_move_options). */
  uint32_t flags;               /**< 0. */
  dsw_response vertex_response; /**< When the moving vertex touches: STOP or SLIDE; STOP by default. */
  dsw_response edge_response;   /**< When an edge or face of it touches; STOP by default. */
  dsw_search search;            /**< EXACT by default. */
  uint32_t bisection_depth;     /**< Halvings of DSW_SEARCH_BISECTION, 1 to 52; 0 means 20. */
  uint32_t
      max_cells; /**< Work limit: volumes that the sweep of one vertex's path, of one edge or one face may look at; 0: none. A
                           vertex that comes to it stops there, free and without a contact; with BISECTION it stays where it was. */
  uint32_t reserved; /**< 0. */
  double min_part;   /**< Least part of an edge that a split leaves, in (0,0.5]; 0 means 0.25. */
  double min_length; /**< Least length of such a part, scene units. 0: none, then parts can get ever smaller. */
  /** Distance kept from a wall that is touched, a dial without guarantee, scene units. Negative: none. 0: 1e-9 of the size of the
   * volume in front. */
  double stand_off;
  /** Vertices inserted by a response are removed again when they stand off the line between their neighbours by no more than this
   * share of its length. 0: never. */
  double noise_share;
  const uint32_t
      *order; /**< Null: all vertices by index. Else `order_count` distinct indices: these move, in this order. */
  size_t order_count; /**< Its entries. */
} dsw_move_options;

/** What a move did. */
typedef struct dsw_move_report {
  double fraction;           /**< dsw_body_move_rigid: the part of the motion that was made; else 1. */
  uint32_t vertices_moved;   /**< Vertices that were to move. */
  uint32_t vertices_stopped; /**< Of these: not at their targets. */
  uint32_t contact_count;    /**< See dsw_body_get_contacts. */
  uint32_t edit_count;       /**< See dsw_body_get_edits. */
  uint32_t edges_swept;      /**< Sweeps of edges that a level above POINTS asks for, both ends counted. */
  uint32_t edges_skipped;    /**< Of these: left out by the body's flags. */
  uint32_t vertices_limited; /**< Of vertices_stopped: by the work limit. */
  uint32_t reserved;         /**< 0. */
} dsw_move_report;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param options [out] may be null. @param size [in] sizeof(dsw_move_options). @note Thread: any. @since 1.0 */
DSW_API void dsw_move_options_init(dsw_move_options *options, size_t size);

/** Moves the vertices of a body to their targets, one after the other.
 * @param scene [in,out] @param body [in]
 * @param targets [in] `target_count` points, stride_bytes apart (0 means 8 * dimension), by vertex index; those of free slots and
 * of vertices that `options->order` leaves out are not read. @param target_count [in] vertex slots of the body.
 * @param stride_bytes [in] @param options [in] may be null. @param report [out] may be null.
 * @return DSW_STATUS_OK also when contacts stopped it. DSW_STATUS_STALE_ID, WRONG_SIZE, NON_FINITE, OUT_OF_RANGE, DUPLICATE_ID (order),
 * UNSUPPORTED, OUT_OF_MEMORY: nothing has moved.
 * @note O(volumes met, and parts of bodies near the way), independent of the size of the environment. Thread: writer. Certain: what the
 * level covers is free, and nothing the level sees was passed. Source: [JCD10] 4. @since 1.0 */
DSW_API dsw_status dsw_body_move(dsw_scene *scene, dsw_body_id body, const double *targets, size_t target_count,
                                 size_t stride_bytes, const dsw_move_options *options, dsw_move_report *report);

/** Moves many bodies, each as dsw_body_move does. With DSW_FEATURE_BODY_CONTACTS those that can meet go one after the other, in the order
 * of `bodies`; without it bodies do not see each other.
 * @param scene [in,out] @param bodies [in] `count` distinct live ids. @param count [in]
 * @param targets [in] the targets of the bodies one after the other, `target_count` points: the sum of their vertex
 * slots. @param target_count, stride_bytes [in] @param options [in] for all; its `order` must be null.
 * @param reports [out] null, or `count` reports.
 * @return as dsw_body_move.
 * @note Thread: writer; uses the parallel-for; the same bits for any number of threads. @since 1.0 */
DSW_API dsw_status dsw_scene_move_bodies(dsw_scene *scene, const dsw_body_id *bodies, size_t count,
                                         const double *targets, size_t target_count, size_t stride_bytes,
                                         const dsw_move_options *options, dsw_move_report *reports);

/** A rigid motion: x becomes rotation * (x - centre) + centre + translation. In the plane x and y of the rotation and the third numbers of
 * centre and translation are 0. */
typedef struct dsw_rigid_motion {
  double rotation[4];    /**< Unit quaternion x, y, z, w; it is normalised, zero is refused. */
  double centre[3];      /**< Scene units. */
  double translation[3]; /**< Scene units. */
} dsw_rigid_motion;

/** Moves a body rigidly as far as it goes: a fraction of the motion is applied vertex by vertex; if
 * something is touched the body is put back and the fraction halved, up to 52 times; the last
 * fraction that was made is kept. Each position is rounded, so the shape keeps to one unit in the
 * last place of the coordinates for each call. That of a body with DSW_BODY_RIGID keeps for all calls
 * together, see there. A fraction of a rotation is that of its quaternion, normalised.
 * @param scene [in,out] @param body [in] @param motion [in] see dsw_rigid_motion.
 * @param options [in] may be null; of it only `order` is used, which must name all vertices.
 * @param report [out] may be null.
 * @return as dsw_body_move; OUT_OF_RANGE (a zero quaternion, or a motion that leads out of the plane). @note Thread: writer.
 * @since 1.0 */
DSW_API dsw_status dsw_body_move_rigid(dsw_scene *scene, dsw_body_id body, const dsw_rigid_motion *motion,
                                       const dsw_move_options *options, dsw_move_report *report);

/** Contacts of the last move of a body, in the order in which they were met.
 * @param scene, body [in] @param contacts [out] owned by the body, valid until it next moves or is edited.
 * @param count [out] how many there are.
 * @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_contacts(const dsw_scene *scene, dsw_body_id body, const dsw_contact **contacts,
                                         size_t *count);

/** The other bodies of these contacts, one entry for each contact. Contacts with bodies and with the environment are found together:
 * the earliest stops the vertex, of times that are equal as doubles that with the environment. DSW_SEARCH_ALL adds no later contacts with bodies.
 * @param scene, body [in] @param partners [out] owned by the body, valid as long as the contacts.
 * @param count [out] how many there are.
 * @return DSW_STATUS_NOT_NAMED without DSW_FEATURE_BODY_CONTACTS. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_contact_partners(const dsw_scene *scene, dsw_body_id body,
                                                 const dsw_contact_partner **partners, size_t *count);

/** What the vertices of these contacts touched before, one entry for each contact: whether they
 * rest, slide or bounce.
 * @param scene, body [in] @param pasts [out] owned by the body, valid as long as the contacts.
 * After a snapshot of 1.0.0 has been loaded, a contact that lasts counts as the second move in a
 * row, at the same place; of what is older nothing is known.
 * @param count [out] how many there are.
 * @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. Source: [JCD10] 3.1. @since 1.1 */
DSW_API dsw_status dsw_body_get_contact_pasts(const dsw_scene *scene, dsw_body_id body, const dsw_contact_past **pasts,
                                              size_t *count);

/** Vertices inserted and removed by responses in the last move of a body, in order.
 * @param scene, body [in]
 * @param edits [out] owned by the body, valid until it next moves or is edited, or the environment is deformed.
 * @param count [out] how many there are.
 * @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_body_get_edits(const dsw_scene *scene, dsw_body_id body, const dsw_body_edit **edits,
                                      size_t *count);

#ifdef __cplusplus
}
#endif

#endif
