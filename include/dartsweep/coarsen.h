/** @file coarsen.h
 * Coarsening: the passable tetrahedra of a static environment become few large volumes, so that a long edge crosses a
 * handful of volumes where it crossed dozens. Of space alone: in the plane DSW_STATUS_UNSUPPORTED.
 */
#ifndef DARTSWEEP_COARSEN_H
#define DARTSWEEP_COARSEN_H

#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is merged. */
typedef struct dsw_coarsen_options {
  uint32_t struct_size; /**< sizeof(dsw_coarsen_options). */
  /** Most faces of a merged volume: 4 .. 28; 0 means 16. Up to 16 there are so few ways to join them that volumes share the tables of
   * their form, and the result takes about a quarter more memory than the source; beyond it several times as much. */
  uint32_t max_faces;
  /** Work limit: most unions looked at, each in time that grows with max_faces alone; 0: no limit. Within it the best are merged. */
  uint64_t max_trials;
} dsw_coarsen_options;

/** What coarsening did. Pairs are before and after. */
typedef struct dsw_coarsen_report {
  uint32_t struct_size;     /**< Set by the caller: sizeof(dsw_coarsen_report). */
  uint32_t complete;        /**< 0: the work limit ended it. */
  uint32_t volume_count[2]; /**< Volumes. */
  uint32_t face_count[2];   /**< A face between two volumes counts once. */
  uint64_t memory_bytes[2]; /**< As in dsw_environment_info. */
  double passable_area
      [2];         /**< Of the faces that can be passed. How many faces a random segment crosses is in proportion to
                                  it. Squared scene units. */
  uint64_t trials; /**< Unions looked at. */
} dsw_coarsen_report;

/** Writes the defaults into at most `size` bytes and sets struct_size.
 * @param options [out] may be null. @param size [in] sizeof(dsw_coarsen_options). @note Thread: any. @since 1.0 */
DSW_API void dsw_coarsen_options_init(dsw_coarsen_options *options, size_t size);

/** Creates an environment that is what `source` is, with passable tetrahedra merged: pair by pair, those first that share most of the
 * smaller one's surface, for as long as the union is a valid volume. Merged volumes are polyhedra of triangles; most are not convex,
 * since unions of tetrahedra seldom are. Regions, tags, marks and everything impassable stay: nothing is merged across a face that is
 * impassable, has other regions or tags on its two sides, or has a marked edge or vertex. Volumes of other types stay as they are.
 * Vertices keep their indices, those inside of merged volumes belong to none.
 * DSW_ENVIRONMENT_LOCATE_GRID and DSW_ENVIRONMENT_NO_LOCATE_GRID hold as for the source. The source
 * is not changed, and nothing of it is retained.
 * @param source [in] its points must not have moved (deform.h).
 * @param options [in] null: defaults.
 * @param environment [out] owned by the caller; made with the context of the source.
 * @param volume_map [out] may be null; for each index of a volume of the source the index of the volume that holds it now,
 * UINT32_MAX where there is none.
 * @param capacity [in] entries of volume_map: at least volume_index_count of the source, unless volume_map is null.
 * @param report [in,out] may be null.
 * @return DSW_STATUS_NULL_ARGUMENT, BAD_STRUCT_SIZE, OUT_OF_RANGE, UNSUPPORTED (points have moved), BUFFER_TOO_SMALL, TOO_LARGE,
 * OUT_OF_MEMORY.
 * @note O(n log n). Thread: reader of the source. Certain: every volume is exactly valid, before any merge and after it; and a cast or
 * sweep meets the same face (by its vertices) at the same time as in the source. A normal may differ in its last bits, since
 * vertices of a face can come in another turn, and where two marked faces are met at one time the lower id decides, which
 * merging renumbers. Where bodies stop follows the size of their volume unless a stand-off is set (move.h). Source: [JCD10] 3.2. @since 1.0 */
DSW_API dsw_status dsw_environment_coarsen(const dsw_environment *source, const dsw_coarsen_options *options,
                                           dsw_environment **environment, uint32_t *volume_map, size_t capacity,
                                           dsw_coarsen_report *report);

#ifdef __cplusplus
}
#endif

#endif
