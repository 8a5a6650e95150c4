/** @file sweep.h
 * Edges swept through an environment without a body: one end moves, the other stays.
 */
#ifndef DARTSWEEP_SWEEP_H
#define DARTSWEEP_SWEEP_H

#include "dartsweep/base.h"
#include "dartsweep/contact.h"
#include "dartsweep/environment.h"
#include "dartsweep/ids.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How much of what an edge sweeps is looked at when its end p moves to p' while its other end q stays. */
typedef enum dsw_level {
  /** The path p p' of the moving end; the edge p q where it is has to be free, see DSW_SWEEP_START_FREE. */
  DSW_LEVEL_POINTS = 1,
  /** That and the edge in its new place, p' q [JCD10] 4.1. What lies inside of the triangle only is missed. When one of
   * the two hits, the contact is that of EDGES_SWEPT. */
  DSW_LEVEL_EDGES = 2,
  /** The whole triangle p p' q: impassable faces, and marked edges that belong to no impassable face; in the plane marked vertices. */
  DSW_LEVEL_EDGES_SWEPT = 3,
  /** Bodies only: also the tetrahedron that a triangle p q r sweeps, so that an obstacle which enters through the inside of a body
   * face is found, and marked vertices. Not in the plane. */
  DSW_LEVEL_FACES = 4,
  DSW_LEVEL_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_level;

/** Flags of a sweep. */
enum {
  /** `starts` are known to contain the moving ends (under the shift); see DSW_CAST_START_KNOWN. */
  DSW_SWEEP_START_KNOWN = 0x1,
  /** The edges p q are known to be free where they start; without it each is cast first. If one is not, a contact may
   * be missed. */
  DSW_SWEEP_START_FREE = 0x2
};

/** Options of a sweep; null means all defaults. */
typedef struct dsw_sweep_options {
  uint32_t struct_size; /**< sizeof(dsw_sweep_options). */
  uint32_t flags;       /**< DSW_SWEEP_... */
  dsw_level level;      /**< DSW_LEVEL_EDGES_SWEPT by default. */
  uint32_t max_cells;   /**< Work limit: volumes looked at before DSW_OUTCOME_WORK_LIMIT; 0: none. */
} dsw_sweep_options;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param options [out] may be null. @param size [in] sizeof(dsw_sweep_options). @note Thread: any. @since 1.0 */
DSW_API void dsw_sweep_options_init(dsw_sweep_options *options, size_t size);

/** Sweeps edges: end p of each moves to p', end q stays. Exact under the shift: at DSW_LEVEL_EDGES_SWEPT a contact is reported
 * if and only if the triangle meets something impassable.
 * @param environment, count [in]
 * @param starts [in] null, or `count` ids of the volumes that hold the moving ends, see DSW_SWEEP_START_KNOWN.
 * @param from, to, fixed [in] p, p' and q: `count` points each, spaced by stride_bytes (0 means 8 * dimension).
 * @param stride_bytes [in] @param options [in] may be null.
 * @param sweeps [out] `count` reports, undefined after an error; every edge is swept as if alone.
 * @return DSW_STATUS_NON_FINITE, DSW_STATUS_STALE_ID, DSW_STATUS_UNSUPPORTED (flags, level), DSW_STATUS_OUT_OF_MEMORY.
 * @note O(volumes that the triangle meets). Thread: reader; uses the parallel-for. Source: [JCD10] 4.1. @since 1.0 */
DSW_API dsw_status dsw_environment_sweep_edges(const dsw_environment *environment, size_t count,
                                               const dsw_volume_id *starts, const double *from, const double *to,
                                               const double *fixed, size_t stride_bytes,
                                               const dsw_sweep_options *options, dsw_sweep *sweeps);

#ifdef __cplusplus
}
#endif

#endif
