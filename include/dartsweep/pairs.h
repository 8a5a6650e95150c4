/** @file pairs.h
 * Continuous collision detection of single pairs, without an environment or a scene. All points of
 * a pair move at once: straight and steadily, or rigidly. Answers are exact for all finite doubles, also
 * if features are parallel or have no extent. There is no shift (base.h): features that only touch
 * do touch. More: bindings/docs/pairs.md.
 */
#ifndef DARTSWEEP_PAIRS_H
#define DARTSWEEP_PAIRS_H

#include "dartsweep/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A pair of features, and the order of its points. Edges include their ends, triangles their sides
 * and corners. Equal ends make a vertex. */
typedef enum dsw_pair_kind {
  /** In space: the vertex, then the corners of the triangle. */
  DSW_PAIR_VERTEX_FACE = 0,
  /** In space: the ends of one edge, then of the other. */
  DSW_PAIR_EDGE_EDGE = 1,
  /** In the plane: the vertex, then the ends of the edge. */
  DSW_PAIR_VERTEX_EDGE = 2,
  DSW_PAIR_KIND_FORCE_INT32 = 0x7fffffff
} dsw_pair_kind;

/** When a pair first touches. */
typedef struct dsw_pair_touch {
  /** The largest double not later than the first touch; 0 without one. */
  double time;
  uint32_t touches; /**< 1: the pair touches in [0,1]. */
  /** With DSW_PAIRS_RANK: how many pairs of the batch touch earlier, exactly; without a touch, how
   * many touch. */
  uint32_t rank;
} dsw_pair_touch;

/** Flags of both functions. */
enum {
  /** Also finds the ranks. */
  DSW_PAIRS_RANK = 0x1
};

/** Finds when each of many pairs first touches.
 * @param dimension 3, or 2 for the plane.
 * @param count pairs, at most 2^28.
 * @param kinds dsw_pair_kind of each pair.
 * @param from starts of the points: `dimension + 1` for each pair.
 * @param to ends of the points.
 * @return DSW_STATUS_UNSUPPORTED: also a kind of another dimension; TOO_LARGE: count;
 * OUT_OF_MEMORY: some answers may be written.
 * @note Cost: mostly below a microsecond a pair, with ties or extreme ranges of doubles tens of
 * microseconds, at worst a millisecond. Ranks: O(count log count). Batch. Thread: any. @since 2.1 */
DSW_API dsw_status dsw_sweep_pairs(const dsw_context *context, uint32_t dimension, size_t count,
                                   const uint8_t *kinds, const double *from, const double *to,
                                   size_t stride_bytes, uint32_t flags, dsw_pair_touch *touches);

/** dsw_sweep_pairs for features, of `kinds`, that may turn.
 * @param to null: features without a motion stand.
 * @param motions `motion_count` of 17 numbers: quaternions x, y, z, w at times 0 and 1, `centre`, its
 * places at both times. All go straight; points of `from` turn about `centre`, exactly rigidly.
 * @param indices two for each pair: motions of its features, or UINT32_MAX.
 * @return OUT_OF_RANGE: also a quaternion that vanishes, or leaves the plane. @since 2.1 */
DSW_API dsw_status dsw_sweep_rigid_pairs(const dsw_context *context, uint32_t dimension,
                                         size_t count, const uint8_t *kinds, const double *from,
                                         const double *to, size_t stride_bytes,
                                         const double *motions, size_t motion_count,
                                         const uint32_t *indices, uint32_t flags,
                                         dsw_pair_touch *touches);

#ifdef __cplusplus
}
#endif

#endif
