/** @file pairs.h
 * Continuous collision detection of single pairs. All points of a pair move at once, each straight
 * and steadily from its start to its end. The answers are exact for all finite doubles, also where
 * points lie in one plane or line and where edges and triangles have no extent. No environment and
 * no scene is needed. More: bindings/docs/pairs.md.
 */
#ifndef DARTSWEEP_PAIRS_H
#define DARTSWEEP_PAIRS_H

#include "dartsweep/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A pair of features, and the order of its points. Edges and triangles include their ends and
 * sides. An edge whose ends are equal is a vertex. */
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
  /** Pairs of the batch that touch earlier: equal for equal times, compared exactly. Without a
   * touch, all that touch. 0 unless asked for. */
  uint32_t rank;
} dsw_pair_touch;

/** Flags of dsw_sweep_pairs. */
enum {
  /** Computes the ranks. */
  DSW_PAIRS_RANK = 0x1
};

/** Finds when each of many pairs first touches.
 * @param context may be null.
 * @param dimension 2: all pairs are of kind VERTEX_EDGE; 3: of the other kinds.
 * @param kinds dsw_pair_kind of each.
 * @param count pairs, at most 2^28.
 * @param starts where the points start: `dimension + 1` points for each pair, pair after pair.
 * @param ends where they end, likewise.
 * @param flags DSW_PAIRS_...
 * @return DSW_STATUS_OUT_OF_RANGE: dimension; TOO_LARGE: count; UNSUPPORTED: also a kind that is
 * not of the dimension. `touches` is then not written.
 * @note Cost: O(1) for each pair; ranks O(count log count). Batch. Thread: any. @since 2.1 */
DSW_API dsw_status dsw_sweep_pairs(const dsw_context *context, uint32_t dimension,
                                   const uint8_t *kinds, size_t count, const double *starts,
                                   const double *ends, size_t stride_bytes, uint32_t flags,
                                   dsw_pair_touch *touches);

#ifdef __cplusplus
}
#endif

#endif
