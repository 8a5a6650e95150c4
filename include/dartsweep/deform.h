/** @file deform.h
 * Environments that bend. The host has two arrays of positions: the environment reads one, the host
 * writes the other. More: bindings/docs/deforming.md. [JCD10] 5.1
 *
 * Volumes that hold nothing can become invalid. They count as impassable volumes.
 */
#ifndef DARTSWEEP_DEFORM_H
#define DARTSWEEP_DEFORM_H

#include "dartsweep/contact.h"
#include "dartsweep/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How bodies and particles stay in place. */
typedef enum dsw_deform_method {
  /** Vertices near bodies and particles move one at a time, by index, in 2^k steps. No wall passes
   * anything. */
  DSW_DEFORM_SWEPT = 0,
  /** An approximation: all vertices move at once; bodies and particles are located again. A wall
   * that moves farther than the thickness of a volume can pass them. Walls do not push a thick body
   * for its radius: the way is shortened. */
  DSW_DEFORM_END_STATE = 1,
  DSW_DEFORM_METHOD_FORCE_INT32 = 0x7fffffff /**< Unused. */
} dsw_deform_method;

/** What happens if a wall meets something. */
typedef enum dsw_wall_response {
  /** The touched part, or a body with DSW_BODY_RIGID, moves with the wall if its way is free; else
   * HOLD. */
  DSW_WALL_PUSH = 0,
  /** A touched edge gets a vertex, which is pushed, if both parts keep `min_part`; else PUSH. */
  DSW_WALL_INSERT = 1,
  /** The vertex of the wall stays for this step. Not with END_STATE. */
  DSW_WALL_HOLD = 2,
  /** The whole environment stops at 1/2, 1/4, ... of its way. */
  DSW_WALL_STOP = 3,
  DSW_WALL_RESPONSE_FORCE_INT32 = 0x7fffffff /**< Unused. */
} dsw_wall_response;

/** What happens if a volume that is met would become invalid. */
typedef enum dsw_invalid_response {
  DSW_INVALID_HOLD = 0,   /**< The vertex stays. With END_STATE: as DSW_WALL_STOP. */
  DSW_INVALID_REFUSE = 1, /**< Nothing moves; see dsw_environment_get_invalid_volumes. */
  /** dsw_environment_remesh repairs such volumes first; then as HOLD. */
  DSW_INVALID_REMESH = 2,
  DSW_INVALID_RESPONSE_FORCE_INT32 = 0x7fffffff /**< Unused. */
} dsw_invalid_response;

/** How a deformation ended. */
typedef enum dsw_deform_outcome {
  DSW_DEFORM_DONE = 0,     /**< All vertices arrived. */
  DSW_DEFORM_HELD = 1,     /**< All except those of dsw_environment_get_held_vertices. */
  DSW_DEFORM_FRACTION = 2, /**< All vertices made the same part of their way. */
  DSW_DEFORM_REFUSED = 3,  /**< Nothing has moved. */
  /** The work limit `max_holds` was reached: as HELD, with DSW_WALL_STOP as FRACTION 0.
   * @since 2.1 */
  DSW_DEFORM_LIMITED = 4,
  DSW_DEFORM_OUTCOME_FORCE_INT32 = 0x7fffffff /**< Unused. */
} dsw_deform_outcome;

/** Options of a deformation. */
typedef struct dsw_deform_options {
  uint32_t struct_size;         /**< sizeof(dsw_deform_options). */
  uint32_t flags;               /**< 0. */
  dsw_deform_method method;     /**< Default SWEPT. */
  dsw_wall_response response;   /**< Default PUSH. */
  dsw_invalid_response invalid; /**< Default HOLD. */
  uint32_t most_halvings;       /**< SWEPT: largest k, 1 to 10; 0 means 10. */
  /** INSERT: as in dsw_move_options. */
  double min_part;
  /** Vertices for which `next` has room, or 0. Changes of the topology write new vertices there. */
  size_t point_room;
  uint32_t remesh_radius;    /**< REMESH: `radius` of dsw_remesh_desc. */
  uint32_t remesh_max_faces; /**< REMESH: `max_faces` of dsw_remesh_desc. */
  /** SWEPT: work limit. How often a vertex may stay in its turn, in all steps together; then every
   * vertex that moves one at a time stays where it is. 0 means 16,384, which is 16 vertices that
   * stay in each of 1,024 steps. @since 2.1 */
  uint32_t max_holds;
  uint32_t reserved; /**< 0. */
} dsw_deform_options;

/** What a deformation did. */
typedef struct dsw_deform_report {
  double fraction;            /**< Part of the way made; 1 if vertices were held. */
  dsw_deform_outcome outcome; /**< The outcome. */
  uint32_t steps;             /**< SWEPT: 2^k. END_STATE: 0. */
  uint32_t near_count;        /**< SWEPT: vertices that moved one at a time. */
  uint32_t held_count;        /**< See dsw_environment_get_held_vertices. */
  uint32_t contact_count;     /**< See dsw_environment_get_wall_contacts. */
  uint32_t invalid_count;     /**< See dsw_environment_get_invalid_volumes. */
  uint32_t pushed_count;      /**< Moves made by walls. */
  uint32_t remeshed_count;    /**< REMESH: volumes replaced. */
} dsw_deform_report;

/** A vertex of the environment moved, and a wall at this vertex touched something. */
typedef struct dsw_wall_contact {
  double from[3];        /**< Start of the vertex. */
  double to[3];          /**< Its target. */
  double time;           /**< As in dsw_sweep. */
  double point[3];       /**< Where the wall touches, rounded. */
  double edge_parameter; /**< Where `point` is on the touched edge: 0 first end, 1 second end. */
  dsw_contact contact;   /**< The part of the wall that touches. */
  dsw_vertex_id moving;  /**< The vertex that moved. */
  /** Other corners of the touching triangle or edge, or null. */
  dsw_vertex_id others[2];
  dsw_particle_id particle;   /**< Touched particle, or null. */
  dsw_body_id body;           /**< Touched body, or null. */
  dsw_body_vertex_id vertex;  /**< Its touched vertex, or null. */
  dsw_body_edge_id edge;      /**< Its touched edge, or null. */
  dsw_body_face_id face;      /**< Its touched face, or null. */
  dsw_wall_response response; /**< What was done. */
  uint32_t reserved;          /**< 0. */
} dsw_wall_contact;

/** Writes the defaults. @since 2.0 */
DSW_API void dsw_deform_options_init(dsw_deform_options *options, size_t size);

/** Takes the environment of a scene with DSW_FEATURE_DEFORMING to new positions. Bodies and
 * particles move only if walls push them. All stay free.
 * @param next `point_count` points, one for each vertex; retained until the next deformation or
 * the end of the environment, unless REFUSED. The array before is free again. Written for vertices
 * that do not arrive.
 * @param report may be null.
 * @return DSW_STATUS_NOT_ENABLED; IN_USE: `next` is the present array; WRONG_SIZE: point_count,
 * point_room; NON_FINITE: only near bodies and particles.
 * @note Cost: O(bodies + particles + volumes met), for each step; up to 2^(k + 1) steps, and
 * `max_holds`. Source: [JCD10] 5.1. @since 2.0 */
DSW_API dsw_status dsw_environment_deform(dsw_environment *environment, double *next,
                                          size_t point_count, const dsw_deform_options *options,
                                          dsw_deform_report *report);

/** Gives the contacts of the last deformation, in order. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_wall_contacts(const dsw_environment *environment,
                                                     const dsw_wall_contact **contacts,
                                                     size_t *count);

/** Gives the vertices that the last deformation did not take to their targets, by index.
 * @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_held_vertices(const dsw_environment *environment,
                                                     const dsw_vertex_id **vertices, size_t *count);

/** Gives the volumes that the last deformation kept from becoming invalid, by index.
 * @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_invalid_volumes(const dsw_environment *environment,
                                                       const dsw_volume_id **volumes,
                                                       size_t *count);

/** Tells whether a volume is valid now.
 * @param valid 0 or 1.
 * @note Cost: O(faces of the volume). @since 2.0 */
DSW_API dsw_status dsw_environment_is_valid(const dsw_environment *environment,
                                            dsw_volume_id volume, int *valid);

/** Gives the positions that an environment reads, by vertex.
 * @param points owned by the environment, or the host's array.
 * @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_points(const dsw_environment *environment,
                                              const double **points, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
