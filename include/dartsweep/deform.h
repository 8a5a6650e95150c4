/** @file deform.h
 * Environments that bend. The host lends two arrays of positions and writes the one that the environment does not read; one call takes the
 * environment to it, and keeps what lies there free. Cost follows what lies there, not the size of the environment: only
 * DSW_WALL_STOP, once something is met, passes over all of it. [JCD10] 5.1
 *
 * Volumes can become invalid (see environment.h). Those that hold bodies never do; of the others nobody knows until something is about to
 * enter them. An invalid volume counts as impassable, cause DSW_CELL_VOLUME; dsw_environment_check looks at all of them.
 *
 * In the plane volumes are polygons and walls their sides; positions are two doubles, and of three the third is 0. Only mending
 * (DSW_INVALID_REMESH) is of space alone.
 */
#ifndef DARTSWEEP_DEFORM_H
#define DARTSWEEP_DEFORM_H

#include "dartsweep/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How what lies in the environment is kept in its place. */
typedef enum dsw_deform_method {
  /** Vertices near bodies and particles move one at a time, by index, in 2^k steps until all volumes that are met stay valid. Nothing
   * passes a wall. */
  DSW_DEFORM_SWEPT = 0,
  /** All vertices move at once, and everything is looked for in its new place: a dial. It tells rightly on which side of a wall something
   * is when walls move less than a volume is thick. What is put before a wall is compared with other bodies where it ends, not on its
   * way there: bodies may pass each other. */
  DSW_DEFORM_END_STATE = 1,
  DSW_DEFORM_METHOD_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_deform_method;

/** What is done where a wall meets a body or particle. */
typedef enum dsw_wall_response {
  /** What is touched moves with the wall's vertex, as far as its own ways are free at its level; else HOLD. END_STATE: a vertex that has
   * come to lie beyond a wall is put before it; if an edge or face is not free, as STOP.
   *
   * A body with DSW_BODY_RIGID moves as a whole [JCD10] 5.1. The library tries four rigid motions
   * that take the touched point out of the wall's way. The first is the least one: a push along the
   * contact's normal moves a free body whose vertices have equal masses like that, and turns it. The
   * next ones have half of that turn, a quarter, and none. The way of each vertex, one after the
   * other by index, has to be free at the body's level, of bodies as well, and the wall has to miss
   * the body then. Else HOLD. END_STATE: by such motions the whole body is put before the walls that
   * its vertices have come to lie beyond and that its edges meet. If it is not free then, as STOP. */
  DSW_WALL_PUSH = 0,
  /** A touched edge gets a new vertex, which is pushed, where both parts keep `min_part` of it;
   * else PUSH, as always for bodies with DSW_BODY_RIGID. END_STATE: an edge that is not free
   * where the environment has gone gets new vertices before the walls that it meets, up to 64
   * for each body; else as PUSH. */
  DSW_WALL_INSERT = 1,
  /** The wall's vertex stays where it is for this step. Not with END_STATE. */
  DSW_WALL_HOLD = 2,
  /** The whole environment goes no further than the largest of 1/2, 1/4, ... of its way that meets nothing, or nowhere. O(vertices of the
   * environment). */
  DSW_WALL_STOP = 3,
  DSW_WALL_RESPONSE_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_wall_response;

/** What is done where a volume that is met would become invalid, also in the smallest steps. */
typedef enum dsw_invalid_response {
  DSW_INVALID_HOLD = 0,   /**< The vertex that would make it so stays. END_STATE: as DSW_WALL_STOP. */
  DSW_INVALID_REFUSE = 1, /**< Nothing moves; see dsw_scene_get_invalid_volumes. */
  /** Before anything moves, volumes that are met, and those at their vertices, are mended if they would be invalid at the end of the way,
   * as by dsw_environment_remesh with `next`; volumes that are invalid already stay. Then as HOLD. Not in the plane. */
  DSW_INVALID_REMESH = 2,
  DSW_INVALID_RESPONSE_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_invalid_response;

/** How a deformation ended. */
typedef enum dsw_deform_outcome {
  DSW_DEFORM_DONE = 0,                        /**< All vertices are where they should be. */
  DSW_DEFORM_HELD = 1,                        /**< All but those of dsw_scene_get_held_vertices. */
  DSW_DEFORM_FRACTION = 2,                    /**< All made the same part of their way. */
  DSW_DEFORM_REFUSED = 3,                     /**< Nothing has moved. */
  DSW_DEFORM_OUTCOME_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_deform_outcome;

/** Options of a deformation; null means all defaults. */
typedef struct dsw_deform_options {
  uint32_t struct_size;         /**< sizeof(dsw_deform_options). */
  uint32_t flags;               /**< 0. */
  dsw_deform_method method;     /**< SWEPT by default. */
  dsw_wall_response response;   /**< PUSH by default. */
  dsw_invalid_response invalid; /**< HOLD by default. */
  uint32_t most_halvings; /**< SWEPT: the largest k, 1 to 10; 0 means 10. Without a fold in the way k = 0 is enough. */
  double min_part;        /**< INSERT: least part of an edge that a split leaves, in (0,0.5]; 0 means 0.25. */
  size_t
      point_room; /**< Vertices for which `next` has room, `point_count` or more. While the environment reads `next`, operations write there
                        the positions of vertices that they add, and 0 for those that they remove; beyond the room they answer
                        DSW_STATUS_BORROWED. 0: `next` is not written by operations, and no vertex can be added. */
  uint32_t remesh_radius;    /**< REMESH: `radius` and */
  uint32_t remesh_max_faces; /**< `max_faces` of dsw_remesh_desc. */
} dsw_deform_options;

/** What a deformation did. */
typedef struct dsw_deform_report {
  double fraction;            /**< Part of the way that was made; 1 also where vertices were held. */
  dsw_deform_outcome outcome; /**< See there. */
  uint32_t steps;             /**< SWEPT: 2^k. END_STATE: 0. */
  uint32_t near_count;        /**< SWEPT: vertices that moved one at a time. */
  uint32_t held_count;        /**< See dsw_scene_get_held_vertices. */
  uint32_t contact_count;     /**< See dsw_scene_get_wall_contacts. */
  uint32_t invalid_count;     /**< See dsw_scene_get_invalid_volumes. */
  uint32_t pushed_count;      /**< Moves of body vertices and particles that walls made. */
  uint32_t remeshed_count;    /**< REMESH: volumes that went for others, listed by
                                 dsw_environment_get_volume_changes; 0 with REFUSED. */
} dsw_deform_report;

/** A wall that met something: one vertex of the environment was moved from `from` towards `to`, and a wall at it touched a vertex, edge or
 * face of a body, or a particle. END_STATE: `from` is the centre of the volume that something lay in, `to` where that lies, and `moving`
 * is null; of an edge that is not free, `from` and `to` are its ends, and `time` is `along`. */
typedef struct dsw_wall_contact {
  double from[3]; /**< Where the wall's vertex started. */
  double to[3];   /**< Where it was to go. */
  double time;    /**< Fraction of that way; the largest double not later than the exact time (its limit where the shift
                         decides). */
  double point[3];      /**< Where it is touched, rounded. */
  double normal[3];     /**< Unit, out of the wall. */
  double along;         /**< A touched edge: from its first end (0) to its second (1); else 0. */
  dsw_vertex_id moving; /**< The vertex of the environment that moved. */
  dsw_vertex_id
      others[2];    /**< With it the wall's triangle (two) or edge (one) that touches, in the plane its side (one); null
                                   beyond that. */
  dsw_face_id wall; /**< Canonical; null for a wire and a marked vertex. */
  dsw_particle_id particle;   /**< The particle that was touched; null if it was a body. */
  dsw_body_id body;           /**< The body; null if it was a particle. */
  dsw_body_vertex_id vertex;  /**< Its vertex that was touched, */
  dsw_body_edge_id edge;      /**< or its edge, */
  dsw_body_face_id face;      /**< or its face; the others are null. */
  dsw_wall_response response; /**< What was done. */
  uint32_t tag;      /**< Host tag of the volume behind `wall`, at the outer boundary of the one in front; else 0. */
  uint32_t reserved; /**< 0. */
} dsw_wall_contact;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param options [out] may be null. @param size [in] sizeof(dsw_deform_options). @note Thread: any. @since 1.0 */
DSW_API void dsw_deform_options_init(dsw_deform_options *options, size_t size);

/** Takes the environment of a scene, made with DSW_FEATURE_DEFORMING, to new positions. Bodies and particles keep theirs, but for those that
 * walls push; all stay in their cells and free at their levels. Body edits by INSERT are those of dsw_body_get_edits. SWEPT: in each step
 * vertices near bodies and particles move one at a time, by index, those that come near on the way after the others.
 * @param scene [in,out]
 * @param next [in,out] 3 doubles, in the plane 2, for each vertex of the environment, lent from now on until the next deformation or
 * the environment is destroyed: it reads positions here, and the array before is the host's again, to be written next.
 * Written where a vertex could not go all of its way. Must not be the array that the environment reads now.
 * @param point_count [in] vertices of the environment. @param options [in] may be null.
 * @param report [out] may be null.
 * @return DSW_STATUS_NOT_NAMED, IN_USE (`next` is the array that it reads), WRONG_SIZE (also point_room, if below point_count), NON_FINITE (a vertex near a body or particle; others make their volumes invalid),
 * OUT_OF_RANGE, UNSUPPORTED (also REMESH in the plane), OUT_OF_MEMORY: nothing has changed, `next` is as it was and not retained; that also holds for the
 * outcome REFUSED.
 * @note O(bodies, particles, volumes they meet); STOP, once something is met, O(vertices of the environment). Thread: writer of the
 * environment. Certain: what the levels cover is free, nothing is lost from its cell, and with SWEPT no wall passed anything. Source: [JCD10]
 * 5.1. @since 1.0 */
DSW_API dsw_status dsw_scene_deform(dsw_scene *scene, double *next, size_t point_count,
                                    const dsw_deform_options *options, dsw_deform_report *report);

/** Contacts of walls in the last deformation, in the order in which they were met.
 * @param scene [in] @param contacts [out] owned by the scene, valid until its next deformation.
 * @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_wall_contacts(const dsw_scene *scene, const dsw_wall_contact **contacts,
                                               size_t *count);

/** Vertices of the environment that the last deformation did not take to their places, by index.
 * @param scene [in] @param vertices [out] as above. @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT.
 * @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_held_vertices(const dsw_scene *scene, const dsw_vertex_id **vertices, size_t *count);

/** Volumes that the last deformation did not let become invalid, by index. Where DSW_INVALID_REFUSE found none that would be, but what
 * lies in some could not be followed into any (they overlap others, or were invalid before): all at the vertex that could not move.
 * @param scene [in] @param volumes [out] as above. @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_invalid_volumes(const dsw_scene *scene, const dsw_volume_id **volumes, size_t *count);

/** Whether a volume is valid in the present geometry.
 * @param environment, volume [in] @param valid [out] 0 or 1.
 * @return DSW_STATUS_STALE_ID. @note O(its faces), O(1) where it is known. Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_is_valid(const dsw_environment *environment, dsw_volume_id volume, int *valid);

/** The positions that an environment reads: 3 doubles, in the plane 2, for each vertex.
 * @param environment [in]
 * @param points [out] owned by the environment, or what the host has lent; valid until its next deformation or change.
 * @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_points(const dsw_environment *environment, const double **points, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
