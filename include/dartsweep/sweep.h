/** @file sweep.h
 * Edges that sweep without a body: the end p of an edge moves to p', the end q stays.
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

/** What is checked when one end of an edge moves. */
typedef enum dsw_level {
  /** The path p p'. The edge p q must be free at the start, see DSW_SWEEP_START_FREE. */
  DSW_LEVEL_POINTS = 1,
  /** Also the edge in its new place, p' q [JCD10] 4.1. Misses obstacles inside the triangle. Any
   * contact is that of EDGES_SWEPT. */
  DSW_LEVEL_EDGES = 2,
  /** The whole triangle p p' q: impassable faces, and marked edges without one. */
  DSW_LEVEL_EDGES_SWEPT = 3,
  /** For bodies: also the tetrahedra that faces p q r sweep, and marked vertices. */
  DSW_LEVEL_FACES = 4,
  DSW_LEVEL_FORCE_INT32 = 0x7fffffff
} dsw_level;

/** Flags of a sweep. */
enum {
  /** `starts` contain the moving ends; see DSW_CAST_START_KNOWN. */
  DSW_SWEEP_START_KNOWN = 0x1,
  /** The edges p q are known to be free. If one is not, a contact may be missed. */
  DSW_SWEEP_START_FREE = 0x2
};

/** Options of a sweep. */
typedef struct dsw_sweep_options {
  uint32_t struct_size;
  uint32_t flags;
  dsw_level level;      /**< Default DSW_LEVEL_EDGES_SWEPT. */
  uint32_t max_volumes; /**< Volumes visited before WORK_LIMIT; 0: no limit. */
} dsw_sweep_options;

DSW_API void dsw_sweep_options_init(dsw_sweep_options *options, size_t size);

/** Sweeps edges, each as if alone. At DSW_LEVEL_EDGES_SWEPT a contact is reported if and only if
 * the triangle, under the shift, meets something impassable.
 * @param starts of the moving ends.
 * @param from, to, fixed p, p' and q.
 * @param sweeps undefined on failure.
 * @note Cost: O(volumes that the triangle meets). Batch. Source: [JCD10] 4.1. */
DSW_API dsw_status dsw_environment_sweep_edges(const dsw_environment *environment, size_t count,
                                               const dsw_volume_id *starts, const double *from,
                                               const double *to, const double *fixed,
                                               size_t stride_bytes,
                                               const dsw_sweep_options *options, dsw_sweep *sweeps);

#ifdef __cplusplus
}
#endif

#endif
