/** @file pairs.h
 * Continuous collision detection of single pairs: a vertex and a triangle, two edges, or in the
 * plane a vertex and an edge. All points of a pair move at once, each straight and steadily from
 * its start to its end. The answers are exact for all finite doubles, also where points lie in one
 * plane or line and where edges and triangles have no extent. No shift (base.h) is made: features
 * that only touch do touch. No environment and no scene is needed. More: bindings/docs/pairs.md.
 */
#ifndef DARTSWEEP_PAIRS_H
#define DARTSWEEP_PAIRS_H

#include "dartsweep/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A pair of features, and the order of its points. An edge includes its ends, and a
 * triangle its sides and corners. An edge whose ends are equal is a vertex. */
typedef enum dsw_pair_kind {
  /** In space, 4 points: the vertex, and the corners of the triangle. */
  DSW_PAIR_VERTEX_FACE = 0,
  /** In space, 4 points: the ends of one edge, and the ends of the other. */
  DSW_PAIR_EDGE_EDGE = 1,
  /** In the plane, 3 points: the vertex, and the ends of the edge. */
  DSW_PAIR_VERTEX_EDGE = 2,
  DSW_PAIR_KIND_FORCE_INT32 = 0x7fffffff /**< Unused. */
} dsw_pair_kind;

/** When a pair first touches. */
typedef struct dsw_pair_touch {
  /** The largest double that is not later than the first time of touch; 0 without a touch. */
  double time;
  uint32_t touches; /**< 1 if the pair touches at a time in [0,1], else 0. */
  /** How many pairs of the batch touch earlier. Times are compared exactly, and pairs with equal
   * times have equal ranks. Without a touch: how many pairs touch. 0 without DSW_PAIRS_RANK. */
  uint32_t rank;
} dsw_pair_touch;

/** Flags of dsw_sweep_pairs. */
enum {
  /** Also finds the ranks. */
  DSW_PAIRS_RANK = 0x1
};

/** Finds when each of many pairs first touches.
 * @param context may be null.
 * @param dimension 3, or 2 for the plane.
 * @param count pairs, at most 2^28.
 * @param kinds the dsw_pair_kind of each pair. In the plane all are DSW_PAIR_VERTEX_EDGE.
 * @param from where the points start: `dimension + 1` points for each pair, pair after pair.
 * @param to where they end, likewise.
 * @param flags DSW_PAIRS_...
 * @return DSW_STATUS_UNSUPPORTED: also a kind that the dimension does not have.
 * DSW_STATUS_TOO_LARGE: count. DSW_STATUS_OUT_OF_MEMORY: some answers may be written.
 * @note Cost: most pairs take less than a microsecond, and ties some microseconds. A pair that
 * mixes the largest doubles with the smallest can take half a second. Ranks: O(count log count).
 * Batch. Thread: any. @since 2.1 */
DSW_API dsw_status dsw_sweep_pairs(const dsw_context *context, uint32_t dimension, size_t count,
                                   const uint8_t *kinds, const double *from, const double *to,
                                   size_t stride_bytes, uint32_t flags, dsw_pair_touch *touches);

#ifdef __cplusplus
}
#endif

#endif
