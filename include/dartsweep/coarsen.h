/** @file coarsen.h
 * Coarsening merges passable tetrahedra into few large volumes: long edges then cross few. More:
 * bindings/docs/coarsening.md.
 */
#ifndef DARTSWEEP_COARSEN_H
#define DARTSWEEP_COARSEN_H

#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is merged. */
typedef struct dsw_coarsen_options {
  uint32_t struct_size;
  /** Most faces of a merged volume, 4 to 28; 0 means 16. Above 16 takes much memory. */
  uint32_t max_faces;
  uint64_t max_trials; /**< Work limit: unions looked at, best first; 0: none. */
} dsw_coarsen_options;

/** What coarsening did; pairs are before and after. `memory_bytes` as in dsw_environment_info. */
typedef struct dsw_coarsen_report {
  uint32_t struct_size;
  uint32_t complete; /**< 0: the work limit ended it. */
  uint32_t volume_count[2];
  uint32_t face_count[2];
  uint64_t memory_bytes[2];
  /** Area of passable faces, rounded; infinity above DBL_MAX. */
  double passable_area[2];
  uint64_t trials; /**< Unions looked at. */
} dsw_coarsen_report;

DSW_API void dsw_coarsen_options_init(dsw_coarsen_options *options, size_t size);

/** Creates a coarser copy of an environment, with merged volumes that are valid polyhedra. Casts
 * and sweeps meet the same faces, by their vertices, at the same times. Regions, tags, marks and
 * vertex indices stay.
 * @param source must never have been deformed.
 * @param environment has its context.
 * @param volume_map may be null; new indices by old ones, or UINT32_MAX.
 * @param capacity volume_index_count of the source.
 * @return DSW_STATUS_TOO_LARGE.
 * @note Cost: O(n log n). Source: [JCD10] 3.2. */
DSW_API dsw_status dsw_environment_coarsen(const dsw_environment *source,
                                           const dsw_coarsen_options *options,
                                           dsw_environment **environment, uint32_t *volume_map,
                                           size_t capacity, dsw_coarsen_report *report);

#ifdef __cplusplus
}
#endif

#endif
