/** @file together.h
 * Moves of bodies in which all vertices move at once, each straight and steadily to its target. No
 * result depends on how vertices or bodies are numbered. What a body's level covers is swept on its
 * whole way, at DSW_LEVEL_EDGES edges, too. Vertices stop at rounded positions just before a
 * contact, and the ways there are swept again: after the call all is free, and nothing was passed.
 *
 * Bodies with a radius keep all distances of body.h on the whole way: what would come nearer is a
 * contact.
 *
 * A touch of bodies that can meet is a contact; a touch with the environment, if it remains one
 * under the shift (base.h). Contacts are of the way on which they were found, which can be a part
 * of the motion. DSW_BODY_RIGID keeps the shape only if the targets do and no vertex stops alone.
 * More: bindings/docs/moving_together.md.
 */
#ifndef DARTSWEEP_TOGETHER_H
#define DARTSWEEP_TOGETHER_H

#include "dartsweep/deform.h"
#include "dartsweep/move.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What stops at a contact. */
typedef enum dsw_together_stop {
  DSW_TOGETHER_STOP_ALL = 0, /**< All bodies of the call. */
  /** The bodies of an island, see dsw_scene_move_together. */
  DSW_TOGETHER_STOP_ISLAND = 1,
  /** The vertices of the parts that touch, just before the touch. This is repeated, up to
   * `max_rounds` times, until nothing is touched; else the island stops. */
  DSW_TOGETHER_STOP_FEATURE = 2,
  DSW_TOGETHER_STOP_FORCE_INT32 = 0x7fffffff
} dsw_together_stop;

/** What vertices of bodies do that touch, with DSW_TOGETHER_STOP_FEATURE. All still goes straight and
 * steadily, to other ends. None inserts vertices, as the adaptive ones of move.h do. */
typedef enum dsw_together_response {
  DSW_TOGETHER_RESPONSE_STOP = 0, /**< They stop. */
  /** Without friction: they end as near to their targets as all touches allow, by the sum of
   * squares. Walls that move push them by what is left of the wall's way, bodies share it. */
  DSW_TOGETHER_RESPONSE_SLIDE = 1,
  /** They go as with SLIDE, but what touches a wall goes with it from there on. */
  DSW_TOGETHER_RESPONSE_CARRY = 2,
  DSW_TOGETHER_RESPONSE_FORCE_INT32 = 0x7fffffff
} dsw_together_response;

/** Options of dsw_scene_move_together, _move_rigid and _step_fraction. */
typedef struct dsw_together_options {
  uint32_t struct_size;
  uint32_t flags;
  dsw_together_stop stop; /**< Default ALL. */
  uint32_t max_rounds;    /**< Rounds of FEATURE, up to 65536; 0 means 64. */
  /** Work limit for exact integers: thousands of products of 64-bit words, for each vertex slot of
   * what moves together; 0 means 8192. At the limit these bodies stay, free; `vertices_limited`
   * counts vertices with other targets. */
  uint32_t max_work;
  /** Default STOP. What touches eight times, or in the last quarter of the rounds, stops. */
  dsw_together_response response;
} dsw_together_options;

/** Writes the defaults. @since 2.1 */
DSW_API void dsw_together_options_init(dsw_together_options *options, size_t size);

/** Options of dsw_scene_deform. */
typedef struct dsw_scene_deform_options {
  uint32_t struct_size;
  uint32_t flags;
  /** Default ALL. Not ISLAND. FEATURE: the environment's vertices of the parts that touch stop,
   * too, and hold those of volumes that would become invalid; the rest goes on. */
  dsw_together_stop stop;
  uint32_t max_rounds;            /**< See dsw_together_options. */
  uint32_t max_work;              /**< See dsw_together_options. At the limit nothing moves. */
  dsw_together_response response; /**< See dsw_together_options. */
  size_t point_room;              /**< See dsw_deform_options. */
} dsw_scene_deform_options;

/** Writes the defaults. @since 2.1 */
DSW_API void dsw_scene_deform_options_init(dsw_scene_deform_options *options, size_t size);

/** Gives, for each vertex slot, what is left of its way from where dsw_scene_move_together or
 * dsw_scene_deform has left it to its target. Count 0 after any other move of the body.
 * @param ways as many numbers for each as the dimension; borrowed until the body moves. @since 2.1 */
DSW_API dsw_status dsw_body_get_ways_left(const dsw_scene *scene, dsw_body_id body,
                                          const double **ways, size_t *count);

/** Moves all vertices of some bodies to their targets, all at once. Bodies of the call that could
 * meet each other on their ways, directly or through others, are an island. Other bodies stand
 * still, and are met.
 * @param bodies distinct.
 * @param targets `target_count` points as in move.h.
 * @param reports `fraction`: part of the motion up to the first contact that stopped a vertex of
 * the island, rounded; `vertices_moved`: living vertices; `edges_swept`, `edges_skipped`: those of
 * the island, for its first body.
 * @return DSW_STATUS_DUPLICATE_ID; UNSUPPORTED: `response` without FEATURE.
 * @note Contacts are all that touch at the same exact time. `fixed` has the other ends then.
 * @note Cost: O(volumes met + pairs of parts whose ways come near each other), for each contact;
 * see `max_work`. Thread: one. @since 2.1 */
DSW_API dsw_status dsw_scene_move_together(dsw_scene *scene, const dsw_body_id *bodies,
                                           size_t count, const double *targets, size_t target_count,
                                           size_t stride_bytes, const dsw_together_options *options,
                                           dsw_move_report *reports);

/** Moves some bodies at once, each on a rigid motion of its own as dsw_body_move_rigid, up to the
 * first touch: all bodies, or all of an island, stop at the same fraction. All else is as in dsw_scene_move_together.
 * @param motions one for each body.
 * @param options `stop` is ALL or ISLAND. The work limit holds for each step, so a call can take a
 * few times as much.
 * @return DSW_STATUS_DUPLICATE_ID; UNSUPPORTED: `stop` is FEATURE.
 * @note Cost: as dsw_scene_move_together for each of a few steps, and O(pairs of bodies whose ways
 * come near each other, and their parts). Thread: one. @since 2.1 */
DSW_API dsw_status dsw_scene_move_rigid(dsw_scene *scene, const dsw_body_id *bodies, size_t count,
                                        const dsw_rigid_motion *motions,
                                        const dsw_together_options *options,
                                        dsw_move_report *reports);

/** Takes bodies to their targets while the environment of a scene with DSW_FEATURE_DEFORMING goes
 * to new positions, all at once. What touches stops, or is pushed, see `stop` and `response`. Other
 * bodies and particles stand still. A volume that holds or nears a body or particle has to stay
 * valid on the whole way; else all ways end at 1/2, 1/4, ... of it.
 * @param next `point_count` points as in dsw_environment_deform; overwritten if the outcome is
 * FRACTION or HELD.
 * @param bodies distinct.
 * @param targets `target_count` points.
 * @param report `outcome`: DONE, FRACTION, HELD with FEATURE, REFUSED or LIMITED, as REFUSED;
 * `fraction`: of those not held. Contacts have `response` DSW_WALL_STOP.
 * @param reports as of dsw_scene_move_together.
 * @return as dsw_environment_deform; DSW_STATUS_DUPLICATE_ID; UNSUPPORTED: `stop` is ISLAND;
 * WRONG_SIZE: also target_count.
 * @note Cost: as dsw_scene_move_together, and O(particles); O(n) each time that all ways are
 * shortened, at most 53 times. Writes the environment, too. @since 2.1 */
DSW_API dsw_status dsw_scene_deform(dsw_scene *scene, double *next, size_t point_count,
                                    const dsw_body_id *bodies, size_t count, const double *targets,
                                    size_t target_count, size_t stride_bytes,
                                    const dsw_scene_deform_options *options,
                                    dsw_deform_report *report, dsw_move_report *reports);

/** Takes rigid bodies along their motions, as dsw_scene_move_rigid, while the environment goes to
 * new positions, as in dsw_scene_deform: all at once and steadily, up to the first touch of anything.
 * Thick bodies keep their distances at every time. After a stop, `stop` FEATURE with `response`
 * SLIDE lets bodies go on in rigid motions: along walls, and pushed by what is left of a wall's way.
 * They do not push each other, and walls stop at what stands.
 * @param next `point_count` points, see dsw_scene_deform.
 * @param motions one for each body.
 * @param options `stop` is ALL with `response` STOP, or FEATURE with SLIDE. `max_rounds` is the
 * number of further motions.
 * @param report `outcome`: DONE, FRACTION, REFUSED or LIMITED. `fraction`: of the environment's way.
 * Contacts have `response` DSW_WALL_STOP.
 * @param reports one for each body, as of dsw_scene_move_rigid. With SLIDE `fraction` is that of the
 * first stop, and `vertices_stopped` are farther from their targets than 32 roundings.
 * @return as dsw_scene_deform; UNSUPPORTED: another `stop` or `response`. CARRY is not supported.
 * @note Cost: as dsw_scene_move_rigid, and O(n + particles) for each of its steps; with SLIDE for
 * each motion. Writes the environment, too. Thread: one. @since 2.1 */
DSW_API dsw_status dsw_scene_deform_rigid(dsw_scene *scene, double *next, size_t point_count,
                                          const dsw_body_id *bodies, size_t count,
                                          const dsw_rigid_motion *motions,
                                          const dsw_scene_deform_options *options,
                                          dsw_deform_report *report, dsw_move_report *reports);

/** Finds the largest fraction f of given steps that is free, for a solver's line search. Nothing
 * moves. All vertices go at once, straight and steadily, to x + f * step, computed in doubles: the
 * ways to these rounded places are verified, as dsw_scene_move_together would, and the next double
 * is not free; where a thick body limits f, f is as large as certified distances allow.
 * @param steps `step_count` displacements, one for each vertex slot of the bodies, as targets in move.h.
 * @param environment_steps one for each of the environment's `point_count` vertices; all bodies and
 * particles of the scene are met then. NULL and 0: it stands still.
 * @param options `stop` is ALL or ISLAND: whether `places` are those of `fraction` or of `fractions`.
 * @param fraction common to all bodies of the call; 0 at the work limit.
 * @param fractions of each body's island, may be NULL; with `environment_steps` all is one island.
 * @param places `step_count` points without gaps, zeros for unused slots, may be NULL.
 * @param environment_places `point_count` points, may be NULL.
 * @return DSW_STATUS_DUPLICATE_ID; UNSUPPORTED: `stop` is FEATURE; NON_FINITE: also where a whole
 * step leads.
 * @note Cost: about two of dsw_scene_move_together. Thread: one. @since 2.1 */
DSW_API dsw_status dsw_scene_step_fraction(dsw_scene *scene, const dsw_body_id *bodies,
                                           size_t count, const double *steps, size_t step_count,
                                           size_t stride_bytes, const double *environment_steps,
                                           size_t point_count, const dsw_together_options *options,
                                           double *fraction, double *fractions, double *places,
                                           double *environment_places);

#ifdef __cplusplus
}
#endif

#endif
