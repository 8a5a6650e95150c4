/** @file deform.h
 * Environments that bend [JCD10] 5.1. The host has two arrays of positions: the environment reads
 * one, the host writes the other. Volumes that hold nothing can become invalid, and then count as
 * impassable. More: bindings/docs/deforming.md.
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
   * that moves farther than a volume is thick can pass them. */
  DSW_DEFORM_END_STATE = 1,
  DSW_DEFORM_METHOD_FORCE_INT32 = 0x7fffffff
} dsw_deform_method;

/** What happens if a wall meets something. */
typedef enum dsw_wall_response {
  /** The touched part, or body with DSW_BODY_RIGID, goes as far as the wall's touched point still
   * does; if it can't, HOLD. */
  DSW_WALL_PUSH = 0,
  /** A touched edge gets a vertex, which is pushed, if both parts keep `min_part`; else PUSH. */
  DSW_WALL_INSERT = 1,
  /** The wall's vertex stays for this step. Not with END_STATE. */
  DSW_WALL_HOLD = 2,
  /** The environment stops at 1/2, 1/4, ... of its way. */
  DSW_WALL_STOP = 3,
  DSW_WALL_RESPONSE_FORCE_INT32 = 0x7fffffff
} dsw_wall_response;

/** What happens if a volume would become invalid. */
typedef enum dsw_invalid_response {
  DSW_INVALID_HOLD = 0,   /**< The vertex stays; END_STATE: as DSW_WALL_STOP. */
  DSW_INVALID_REFUSE = 1, /**< Nothing moves. */
  /** dsw_environment_remesh repairs such volumes first; then as HOLD. */
  DSW_INVALID_REMESH = 2,
  DSW_INVALID_RESPONSE_FORCE_INT32 = 0x7fffffff
} dsw_invalid_response;

/** How a deformation ended. */
typedef enum dsw_deform_outcome {
  DSW_DEFORM_DONE = 0,     /**< All vertices arrived. */
  DSW_DEFORM_HELD = 1,     /**< All but held vertices. */
  DSW_DEFORM_FRACTION = 2, /**< All made the same part of their way. */
  DSW_DEFORM_REFUSED = 3,  /**< Nothing has moved. */
  /** A work limit was reached: as HELD, with DSW_WALL_STOP as FRACTION 0.
   * @since 2.1 */
  DSW_DEFORM_LIMITED = 4,
  DSW_DEFORM_OUTCOME_FORCE_INT32 = 0x7fffffff
} dsw_deform_outcome;

/** Options of a deformation. */
typedef struct dsw_deform_options {
  uint32_t struct_size;
  uint32_t flags;
  dsw_deform_method method;     /**< Default SWEPT. */
  dsw_wall_response response;   /**< Default PUSH. */
  dsw_invalid_response invalid; /**< Default HOLD. */
  uint32_t most_halvings;       /**< SWEPT: largest k, 1 to 10; 0 means 10. */
  /** INSERT: see dsw_move_options. */
  double min_part;
  /** Vertices for which `next` has room, or 0. Changes of the topology write new ones there. */
  size_t point_room;
  uint32_t remesh_radius;    /**< REMESH: see dsw_remesh_desc. */
  uint32_t remesh_max_faces; /**< REMESH: see dsw_remesh_desc. */
  /** SWEPT: work limit: how often a vertex may stay in its turn, in all steps; then all that move
   * one at a time stay. 0 means 16,384. @since 2.1 */
  uint32_t max_holds;
  uint32_t reserved; /**< 0. @since 2.1 */
} dsw_deform_options;

/** What a deformation did, with its `outcome`. */
typedef struct dsw_deform_report {
  double fraction; /**< Part of the way made; 1 if vertices were held. */
  dsw_deform_outcome outcome;
  uint32_t steps;          /**< SWEPT: 2^k. END_STATE: 0. */
  uint32_t near_count;     /**< SWEPT: vertices moved one at a time. */
  uint32_t held_count;     /**< See dsw_environment_get_held_vertices. */
  uint32_t contact_count;  /**< See dsw_environment_get_wall_contacts. */
  uint32_t invalid_count;  /**< See dsw_environment_get_invalid_volumes. */
  uint32_t pushed_count;   /**< Moves made by walls. */
  uint32_t remeshed_count; /**< REMESH: volumes replaced. */
} dsw_deform_report;

/** A wall at a moving vertex of the environment touched something: a `particle`, or a `body` and
 * its `vertex`, `edge` or `face`; the others are null. */
typedef struct dsw_wall_contact {
  double from[3];        /**< Start of the vertex. */
  double to[3];          /**< Its target. */
  double time;           /**< See dsw_flight. */
  double point[3];       /**< Where the wall touches, rounded. */
  double edge_parameter; /**< Place of `point` on the touched edge: 0 first end, 1 second. */
  dsw_contact contact;   /**< The part of the wall that touches. */
  dsw_vertex_id moving;  /**< The vertex that moved. */
  /** Other corners of the touching triangle or edge, or null. */
  dsw_vertex_id others[2];
  dsw_particle_id particle;
  dsw_body_id body;
  dsw_body_vertex_id vertex;
  dsw_body_edge_id edge;
  dsw_body_face_id face;
  dsw_wall_response response; /**< What was done. */
  uint32_t reserved;
} dsw_wall_contact;

DSW_API void dsw_deform_options_init(dsw_deform_options *options, size_t size);

/** Takes the environment of a scene with DSW_FEATURE_DEFORMING to new positions. Bodies and
 * particles move only if walls push them, and stay free.
 * @param next `point_count` points, one for each vertex; retained until the next deformation or the
 * end of the environment, unless REFUSED. The array before is free again. Written for vertices that
 * do not arrive.
 * @return DSW_STATUS_IN_USE: `next` is the present array; WRONG_SIZE: point_count, point_room;
 * NON_FINITE: only near bodies and particles.
 * @note Cost: O(bodies + particles + volumes met), for each step; up to 2^(k + 1) steps, and
 * `max_holds`. */
DSW_API dsw_status dsw_environment_deform(dsw_environment *environment, double *next,
                                          size_t point_count, const dsw_deform_options *options,
                                          dsw_deform_report *report);

/** Gives the contacts of the last deformation, in order. */
DSW_API dsw_status dsw_environment_get_wall_contacts(const dsw_environment *environment,
                                                     const dsw_wall_contact **contacts,
                                                     size_t *count);

/** Gives vertices that the last deformation held, by index. */
DSW_API dsw_status dsw_environment_get_held_vertices(const dsw_environment *environment,
                                                     const dsw_vertex_id **vertices, size_t *count);

/** Gives volumes that the last deformation kept from becoming invalid, by index. */
DSW_API dsw_status dsw_environment_get_invalid_volumes(const dsw_environment *environment,
                                                       const dsw_volume_id **volumes,
                                                       size_t *count);

/** Tells by `valid`, 0 or 1, whether a volume is valid. @note Cost: O(faces of the volume). */
DSW_API dsw_status dsw_environment_is_valid(const dsw_environment *environment,
                                            dsw_volume_id volume, int *valid);

/** Gives the positions that an environment reads, by vertex: its own, or the host's. */
DSW_API dsw_status dsw_environment_get_points(const dsw_environment *environment,
                                              const double **points, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
