/** @file together.h
 * Moves of bodies in which all vertices move at once. Each vertex goes straight and steadily from
 * where it is to its target. So a body that is carried along never meets itself only because some
 * of its vertices went first. A result does not depend on how vertices or bodies are numbered.
 * More: bindings/docs/moving_together.md.
 *
 * What the level of a body covers is swept on its whole way: at DSW_LEVEL_EDGES edges, too. A touch
 * of two bodies is a contact, with DSW_FEATURE_BODY_CONTACTS and if their masks say so. So is a
 * touch of a body with itself, with DSW_BODY_SELF_CONTACTS. A touch with the environment is a
 * contact if it remains one under the shift (base.h): an edge that rests exactly on a wall may move
 * along it, or away.
 *
 * `time`, `from` and `to` of a contact are those of the way on which it was found. This can be a
 * part of the motion. A body with DSW_BODY_RIGID keeps its shape only if its targets do, and if
 * none of its vertices stops alone.
 *
 * At a contact vertices stop at positions just before it, which are rounded. The ways to these
 * positions are swept again. After the call all that the levels cover is free, and nothing was
 * passed.
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
  /** The vertices of the parts that touch. Their new targets are just before the touch. All
   * vertices still go steadily and at the same time. So this is repeated, up to `max_rounds` times,
   * until nothing is touched. If something still is, the island stops as a whole. */
  DSW_TOGETHER_STOP_FEATURE = 2,
  DSW_TOGETHER_STOP_FORCE_INT32 = 0x7fffffff /**< Unused. */
} dsw_together_stop;

/** Options of dsw_scene_move_together. */
typedef struct dsw_together_options {
  uint32_t struct_size;   /**< sizeof(dsw_together_options). */
  uint32_t flags;         /**< 0. */
  dsw_together_stop stop; /**< Default DSW_TOGETHER_STOP_ALL. */
  uint32_t max_rounds;    /**< Of DSW_TOGETHER_STOP_FEATURE, up to 65536; 0 means 64. */
  /** Work limit for exact integers: products of 64-bit words, in thousands for each vertex slot of
   * what moves together (with STOP_ALL all bodies, else an island); 0 means 8192, about 0.02 s.
   * Only coordinates of very different magnitude need as many. At the limit these bodies stay where
   * they are, free; `vertices_limited` counts their vertices that have other targets. */
  uint32_t max_work;
} dsw_together_options;

/** Writes the defaults. @since 2.1 */
DSW_API void dsw_together_options_init(dsw_together_options *options, size_t size);

/** Moves all vertices of some bodies to their targets, all at once. Bodies of the call that could
 * meet each other on their ways, directly or through others, are an island.
 * @param bodies distinct. Other bodies stand still, and are met.
 * @param targets `target_count` points, body after body, one for each vertex slot; those of free
 * slots are not read.
 * @param reports may be null; `fraction`: part of the motion up to the first contact that stopped a
 * vertex of the body's island, rounded. `vertices_moved`: all living vertices. `edges_swept`,
 * `edges_skipped`: of the whole island, in the report of its first body. Members on edits are 0.
 * @return DSW_STATUS_DUPLICATE_ID; UNSUPPORTED: a body has a radius, or can meet one that has.
 * @note dsw_body_get_contacts gives the contacts of each body. All that touch at the same exact
 * time are listed; of an edge or face and its corner that touch walls, the corner. `fixed` has the
 * other ends at that time.
 * @note Cost: O(volumes met + pairs of parts whose ways come near each other), for each contact
 * anew; see `max_work`. Thread: one. @since 2.1 */
DSW_API dsw_status dsw_scene_move_together(dsw_scene *scene, const dsw_body_id *bodies,
                                           size_t count, const double *targets, size_t target_count,
                                           size_t stride_bytes, const dsw_together_options *options,
                                           dsw_move_report *reports);

/** Takes the environment of a scene with DSW_FEATURE_DEFORMING to new positions and bodies to their
 * targets, all at once. Each vertex of the environment goes straight and steadily, too. All other
 * bodies and particles stand still. At the first contact of anything everything stops. Then
 * dsw_scene_move_together can take the bodies on.
 *
 * A volume that a body or particle is in, or comes near, has to stay valid on the whole way. If one
 * does not, all ways end at 1/2, 1/4, ... of the way to the targets.
 * @param next `point_count` points, one for each vertex; retained until the next deformation or the
 * end of the environment, unless REFUSED. Overwritten if the outcome is FRACTION. The array before
 * is free again.
 * @param bodies distinct.
 * @param targets `target_count` points, as in dsw_scene_move_together.
 * @param options may be null; only `point_room` counts, all else is ignored.
 * @param report may be null; `outcome`: DONE, FRACTION, REFUSED, or LIMITED: the default of
 * `max_work` was reached, and nothing has moved. Its contacts are those with the
 * environment; `from` and `to` are those of the vertex `moving`, and `response` is DSW_WALL_STOP.
 * @param reports may be null.
 * @return DSW_STATUS_NOT_ENABLED; DUPLICATE_ID; IN_USE: `next` is the present array; WRONG_SIZE:
 * point_count, target_count, point_room; NON_FINITE: of `next` only near bodies and particles;
 * UNSUPPORTED: a body of the scene has a radius.
 * @note Cost: O(bodies + particles + volumes met + pairs of parts whose ways come near each other);
 * O(n) for each time that
 * all ways are shortened, at most 53 times. Threads: writes the environment, too. @since 2.1 */
DSW_API dsw_status dsw_scene_deform(dsw_scene *scene, double *next, size_t point_count,
                                    const dsw_body_id *bodies, size_t count, const double *targets,
                                    size_t target_count, size_t stride_bytes,
                                    const dsw_deform_options *options, dsw_deform_report *report,
                                    dsw_move_report *reports);

#ifdef __cplusplus
}
#endif

#endif
