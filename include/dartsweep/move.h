/** @file move.h
 * Moves of bodies, one vertex at a time. Contacts are exact for that order. After each call the
 * parts that the level covers are free, and without lossy flags they have passed nothing that the
 * level sees. `targets`: `target_count` points, body after body, one for each vertex slot; those of
 * free slots are not read. More: bindings/docs/moving_bodies.md. Source: [JCD10] 4.1, 4.2.
 */
#ifndef DARTSWEEP_MOVE_H
#define DARTSWEEP_MOVE_H

#include "dartsweep/body.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How a contact is found [JCD10] 4.2. */
typedef enum dsw_search {
  DSW_SEARCH_EXACT = 0, /**< The first contact. */
  /** All obstacles on the whole way, by time. */
  DSW_SEARCH_EXHAUSTIVE = 1,
  /** Dichotomic: halves the way between a free position and one that is not. At DSW_LEVEL_EDGES
   * another contact may come first. */
  DSW_SEARCH_BISECTION = 2,
  /** Dichotomic, with the normal of the paper: that of the nearest vertex of the touched wall, which
   * is the mean of the unit normals of the walls there. @since 2.1 */
  DSW_SEARCH_BISECTION_VERTEX = 3,
  DSW_SEARCH_FORCE_INT32 = 0x7fffffff
} dsw_search;

/** What happens at a contact [JCD10] 4.2, figure 5. A moving vertex inserts at most 64 vertices,
 * and stops if it can insert none. */
typedef enum dsw_response {
  /** The vertex stops before the contact. */
  DSW_RESPONSE_STOP = 0,
  /** "Adaptive": the edge gets a vertex at each contact in turn. */
  DSW_RESPONSE_ADAPTIVE_ONE = 1,
  /** "Adaptive": a vertex at each obstacle under the edge at once. */
  DSW_RESPONSE_ADAPTIVE_MANY = 2,
  /** "Hybrid": one vertex; the edge's parts are static. */
  DSW_RESPONSE_HYBRID = 3,
  /** The vertex moves on along the obstacle. */
  DSW_RESPONSE_SLIDE = 4,
  /** ADAPTIVE_ONE, or SLIDE where that is impossible. */
  DSW_RESPONSE_ADAPTIVE_SLIDE = 5,
  DSW_RESPONSE_FORCE_INT32 = 0x7fffffff
} dsw_response;

/** Flags of a move. */
enum {
  /** Slides stay before the last six walls touched in this move, and end in a corner; without the
   * flag, before the last two. */
  DSW_MOVE_KEEP_WALLS = 0x1,
  /** For dsw_body_move_rigid: after the first touch the body slides as a whole, in at most `passes`
   * further motions (0: 32). @since 2.1 */
  DSW_MOVE_SLIDE_WHOLE = 0x2,
  /** For dsw_body_move and dsw_scene_move_bodies: vertices that come to an exit
   * (dsw_environment_mark_exits) stop there, whatever the response. When all have moved they are
   * removed with their edges and faces, and so make way for the next ones. A thick vertex comes to an
   * exit when it is as near as the radius, also if walls are as near. Thick bodies with
   * DSW_BODY_SELF_CONTACTS refuse the flag, and all other calls do. @since 2.1 */
  DSW_MOVE_LEAVE = 0x4
};

/** Options of a move. */
typedef struct dsw_move_options {
  uint32_t struct_size;
  uint32_t flags;
  dsw_response vertex_response; /**< For the moving vertex: STOP (default) or SLIDE. */
  dsw_response edge_response;   /**< For its edges and faces; default STOP. */
  dsw_search search;            /**< Default EXACT. */
  uint32_t bisection_depth;     /**< Halvings, 1 to 52; 0 means 20. */
  /** Work limit: volumes that one sweep may visit before the vertex stops, free; 0: none. */
  uint32_t max_volumes;
  /** Further passes over vertices that have stopped and may get farther, 0 to 64. */
  uint32_t passes;
  double min_part;   /**< Least share of an edge in a part; up to 0.5, 0 means 0.25. */
  double min_length; /**< Least length of a part; 0: none. */
  /** Distance to keep from a touched wall, not guaranteed; 0 means 1e-9 of the size of the volume
   * there; negative: none. */
  double stand_off;
  /** An inserted vertex is removed if its distance from the line between its neighbours is at most
   * this share of the line. 0: never. */
  double noise_share;
  /** Distinct indices of the vertices that move, in order; null: all, by index. The pulled end of a
   * string goes first. */
  const uint32_t *order;
  size_t order_count;
} dsw_move_options;

/** What a move did. */
typedef struct dsw_move_report {
  /** Part of the motion made by dsw_body_move_rigid or together.h; else 1. */
  double fraction;
  uint32_t vertices_moved;   /**< Vertices that had to move. */
  uint32_t vertices_stopped; /**< Vertices not at their targets. */
  uint32_t contact_count;    /**< See dsw_body_get_contacts. */
  uint32_t edit_count;       /**< See dsw_body_get_edits. */
  uint32_t edges_swept;      /**< Sweeps of edges, from both ends; depends on earlier moves. */
  uint32_t edges_skipped;    /**< Sweeps saved by flags. */
  uint32_t vertices_limited; /**< Stopped by the work limit. */
  uint32_t reserved;
} dsw_move_report;

DSW_API void dsw_move_options_init(dsw_move_options *options, size_t size);

/** Moves the vertices of a body to their targets, one after the other. Only targets of moving
 * vertices are read.
 * @return DSW_STATUS_DUPLICATE_ID: in `order`.
 * @note Cost: O(volumes met + bodies near the way). In each pass a vertex searches at most 73
 * times: once, and for each slide and new vertex. */
DSW_API dsw_status dsw_body_move(dsw_scene *scene, dsw_body_id body, const double *targets,
                                 size_t target_count, size_t stride_bytes,
                                 const dsw_move_options *options, dsw_move_report *report);

/** Moves many bodies, each as dsw_body_move. Bodies that can meet move in the order of `bodies`.
 * @param bodies distinct.
 * @param options `order` must be null.
 * @note Cost: as dsw_body_move. Batch. */
DSW_API dsw_status dsw_scene_move_bodies(dsw_scene *scene, const dsw_body_id *bodies, size_t count,
                                         const double *targets, size_t target_count,
                                         size_t stride_bytes, const dsw_move_options *options,
                                         dsw_move_report *reports);

/** A rigid motion: x becomes `rotation` * (x - `centre`) + `centre` + `translation`, the rotation a
 * quaternion x, y, z, w that is not 0. */
typedef struct dsw_rigid_motion {
  double rotation[4];
  double centre[3];
  double translation[3];
} dsw_rigid_motion;

/** Moves a body rigidly, on its arc, up to the first touch (dsw_sweep_rigid_pairs). With
 * DSW_MOVE_SLIDE_WHOLE it goes on in rigid motions, as far as the touched walls allow. Each of these
 * motions ends nearer to the target. `fraction` is that of the motion up to the first touch; `time`
 * of a contact is a fraction of its own motion; `vertices_stopped` are not at their targets.
 * @param options Only `order` is read, which must name all vertices, and `passes` with
 * DSW_MOVE_SLIDE_WHOLE.
 * @note Cost: as dsw_body_move, and cells in its box, for each motion. */
DSW_API dsw_status dsw_body_move_rigid(dsw_scene *scene, dsw_body_id body,
                                       const dsw_rigid_motion *motion,
                                       const dsw_move_options *options, dsw_move_report *report);

/** How far a body could go along a path. @since 2.1 */
typedef struct dsw_free_fraction {
  /** The part of the path that is free. All pieces count alike. 1 only if the whole path is free. */
  double fraction;
  /** The fraction of `piece` at which dsw_body_move_rigid would stop; 0 if all are free. */
  double piece_fraction;
  /** The first piece that is not wholly free. If all are free, the number of pieces. */
  uint32_t piece;
  uint32_t starts_free; /**< 0: The first pose is not free, and fractions are 0. */
} dsw_free_fraction;

/** Finds how far a body could go along many paths, each from pose to pose as
 * dsw_body_move_rigid, up to rounding. Nothing moves. A path of one pose only asks whether the pose is free.
 * @param centre D numbers: a point where the body is now. Poses turn about it.
 * @param poses `pose_count` of 7 numbers: a quaternion x, y, z, w that is not 0, and a translation,
 * both from where the body is now.
 * @param indices of poses, path after path.
 * @param offsets `path_count + 1`, where paths begin in `indices`; null: two poses a path.
 * @param contacts null, or `path_count`: what stops each path, or zeros; `time` is of the piece.
 * @return WRONG_SIZE: a path without poses; OUT_OF_RANGE: an index.
 * @note Cost: for each path as creation of the body, for each piece as dsw_body_move_rigid. Batch.
 * @since 2.1 */
DSW_API dsw_status dsw_body_find_free_fractions(const dsw_scene *scene, dsw_body_id body,
                                                const double *centre, const double *poses,
                                                size_t pose_count, const uint32_t *indices,
                                                const uint32_t *offsets, size_t path_count,
                                                dsw_free_fraction *fractions,
                                                dsw_body_contact *contacts);

/** Gives the motion from where dsw_body_move_rigid or dsw_scene_move_rigid has left a body to where
 * it should be. The identity after a motion made whole, any other move, dsw_environment_deform, or
 * loading. @since 2.1 */
DSW_API dsw_status dsw_body_get_motion_left(const dsw_scene *scene, dsw_body_id body,
                                            dsw_rigid_motion *motion);

/** Gives the contacts of the last move of a body, in order. */
DSW_API dsw_status dsw_body_get_contacts(const dsw_scene *scene, dsw_body_id body,
                                         const dsw_body_contact **contacts, size_t *count);

/** Gives the other body of each contact, with DSW_FEATURE_BODY_CONTACTS. */
DSW_API dsw_status dsw_body_get_contact_partners(const dsw_scene *scene, dsw_body_id body,
                                                 const dsw_contact_partner **partners,
                                                 size_t *count);

/** Gives what the vertex of each contact touched before. @note Source: [JCD10] 3.1. */
DSW_API dsw_status dsw_body_get_previous_contacts(const dsw_scene *scene, dsw_body_id body,
                                                  const dsw_previous_contact **pasts,
                                                  size_t *count);

/** Gives the vertices that the last move of a body inserted and removed, in order. */
DSW_API dsw_status dsw_body_get_edits(const dsw_scene *scene, dsw_body_id body,
                                      const dsw_body_edit **edits, size_t *count);

/** Gives the vertices that left in the last move of a body (DSW_MOVE_LEAVE), in the order in which
 * they came to an exit. Their ids are stale. @since 2.1 */
DSW_API dsw_status dsw_body_get_exits(const dsw_scene *scene, dsw_body_id body,
                                      const dsw_exit **exits, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
