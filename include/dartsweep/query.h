/** @file query.h
 * Questions to an environment that need neither scene nor particle: where is a point, what does a segment hit, what
 * is near. Thread: reader, all of them; batches are shared out over the context's parallel-for with the same bits
 * for any number of threads.
 *
 * Every point asked about is thought of as shifted by an infinitesimal (e, e^2, e^3), in the plane (e, e^2), so that it lies in exactly one
 * volume and a segment pierces exactly one triangle, in the plane one side, at a time; dsw_environment_classify tells what lies exactly
 * where. [JCD10] 3.3 does not treat these ties.
 */
#ifndef DARTSWEEP_QUERY_H
#define DARTSWEEP_QUERY_H

#include "dartsweep/contact.h"
#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Answer of a locate. */
typedef enum dsw_place {
  DSW_PLACE_NONE = 0,                /**< Not looked for. */
  DSW_PLACE_PASSABLE = 1,            /**< In a passable volume. */
  DSW_PLACE_IMPASSABLE = 2,          /**< In an impassable volume. */
  DSW_PLACE_OUTSIDE = 3,             /**< In no volume. */
  DSW_PLACE_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_place;

/** Flags of a cast. */
enum {
  /** `start` is known to contain the first point (it came from a locate or an earlier cast): the check is skipped. If
   * it does not, the answer is meaningless, though never unsafe. Without the flag `start` is a hint. */
  DSW_CAST_START_KNOWN = 0x1,
  /** Leave out time, position, normal and ids of the hit: outcome, volume and cells_visited only. */
  DSW_CAST_NO_DETAIL = 0x2
};

/** Options of a flight; null means all defaults. */
typedef struct dsw_cast_options {
  uint32_t struct_size; /**< sizeof(dsw_cast_options). */
  uint32_t flags;       /**< DSW_CAST_... */
  uint32_t max_cells;   /**< Work limit: volumes entered before DSW_OUTCOME_WORK_LIMIT; 0: none. */
  uint32_t reserved;    /**< 0. */
} dsw_cast_options;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param options [out] may be null. @param size [in] sizeof(dsw_cast_options). @note Thread: any. @since 1.0 */
DSW_API void dsw_cast_options_init(dsw_cast_options *options, size_t size);

/** Finds the volume that contains a point, exactly.
 * @param environment [in] @param point [in] as many finite doubles as there are dimensions.
 * @param hint [in] a live volume to walk from, or null id. @param volume [out] null id when outside.
 * @param place [out] may be null.
 * @return DSW_STATUS_NON_FINITE, DSW_STATUS_STALE_ID.
 * @note With a hint: O(volumes between). Without, or when the walk leaves the environment:
 * expected O(log volumes), by a search structure. The first few such calls look at all volumes,
 * and one of the next builds the structure. The first call after a deformation fits the structure
 * to the new positions, which takes about twice as long as looking at all volumes. See
 * DSW_ENVIRONMENT_LOCATE_GRID and DSW_ENVIRONMENT_NO_LOCATE_GRID. Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_locate(const dsw_environment *environment, const double *point, dsw_volume_id hint,
                                          dsw_volume_id *volume, dsw_place *place);

/** Locates many points.
 * @param environment [in] @param points [in] `count` points, finite. @param count [in]
 * @param stride_bytes [in] distance of two points; 0 means 8 * dimension.
 * @param hints [in] null, or `count` ids of which any may be null. @param volumes [out] `count` ids.
 * @param places [out] null, or `count` values.
 * @return as dsw_environment_locate; DSW_STATUS_WRONG_SIZE (stride_bytes).
 * @note Thread: reader; uses the parallel-for. @since 1.0 */
DSW_API dsw_status dsw_environment_locate_points(const dsw_environment *environment, const double *points, size_t count,
                                                 size_t stride_bytes, const dsw_volume_id *hints,
                                                 dsw_volume_id *volumes, dsw_place *places);

/** Tells on what a point lies exactly, without the shift: a vertex, an edge, the inside of a face or of a volume.
 * @param environment [in] @param point [in] as many finite doubles as there are dimensions.
 * @param volume [in] the volume that contains the point, as dsw_environment_locate gave it.
 * @param cell [out] canonical id of the cell of lowest dimension that holds the point.
 * @return DSW_STATUS_OUTSIDE if the point is not in the closure of `volume`. @note O(faces of the volume).
 * Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_classify(const dsw_environment *environment, const double *point,
                                            dsw_volume_id volume, dsw_cell *cell);

/** Casts one segment without a particle.
 * @param environment [in] @param start [in] null id: located without hint; else a hint, see DSW_CAST_START_KNOWN.
 * @param from, to [in] as many finite doubles as there are dimensions. @param options [in] may be null. @param flight [out] the report.
 * @return DSW_STATUS_NON_FINITE, DSW_STATUS_STALE_ID, DSW_STATUS_UNSUPPORTED (flags).
 * @note O(volumes crossed). Thread: reader. Certain: the first impassable face, exactly. Source: [JCD10] 3.3.
 * @since 1.0 */
DSW_API dsw_status dsw_environment_cast(const dsw_environment *environment, dsw_volume_id start, const double *from,
                                        const double *to, const dsw_cast_options *options, dsw_flight *flight);

/** Casts many segments.
 * @param environment, count [in] @param starts [in] null, or `count` ids.
 * @param from, to [in] `count` points each, spaced by stride_bytes (0 means 8 * dimension). @param stride_bytes [in]
 * @param options [in] may be null. @param flights [out] `count` reports.
 * @return as dsw_environment_cast; DSW_STATUS_WRONG_SIZE (stride_bytes).
 * @note Thread: reader; uses the parallel-for. @since 1.0 */
DSW_API dsw_status dsw_environment_cast_segments(const dsw_environment *environment, size_t count,
                                                 const dsw_volume_id *starts, const double *from, const double *to,
                                                 size_t stride_bytes, const dsw_cast_options *options,
                                                 dsw_flight *flights);

/** Casts one segment and lists every volume it enters, in order, with times.
 * @param environment [in] @param start, from, to, options [in] as for dsw_environment_cast.
 * @param crossings [out] null if capacity is 0. @param capacity [in] entries of `crossings`.
 * @param count [out] how many there are. @param flight [out] may be null.
 * @return as dsw_environment_cast, and DSW_STATUS_BUFFER_TOO_SMALL when 0 < capacity < *count.
 * @note Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_cast_path(const dsw_environment *environment, dsw_volume_id start,
                                             const double *from, const double *to, const dsw_cast_options *options,
                                             dsw_crossing *crossings, size_t capacity, size_t *count,
                                             dsw_flight *flight);

/** The nearest impassable thing. */
typedef struct dsw_nearest {
  double distance;        /**< Scene units, rounded; infinity when nothing lies within the radius. */
  double point[3];        /**< The nearest point of it, rounded. */
  double normal[3];       /**< Unit, from `point` towards the asked point; zero when the distance is 0 or infinite. */
  dsw_cell cell;          /**< The impassable face, wire (edge) or vertex; kind DSW_CELL_NONE when there is none. */
  uint32_t tag;           /**< As in dsw_flight, for a face. */
  uint32_t cells_visited; /**< Volumes looked at. */
} dsw_nearest;

/** Finds the nearest impassable face, wire or vertex within a radius that can be seen through passable volumes.
 * Ties: the lower canonical cell.
 * @param environment [in] @param point [in] as many finite doubles as there are dimensions.
 * @param volume [in] the volume that contains it, or null id (located).
 * @param radius [in] at least 0, scene units; infinity is allowed. @param nearest [out] the answer.
 * @return DSW_STATUS_NON_FINITE, DSW_STATUS_OUT_OF_RANGE (radius), DSW_STATUS_STALE_ID, DSW_STATUS_OUTSIDE,
 * DSW_STATUS_IMPASSABLE, DSW_STATUS_OUT_OF_MEMORY.
 * @note O(volumes within the distance). Distances carry rounding error of a few units in the last place. Thread:
 * reader. @since 1.0 */
DSW_API dsw_status dsw_environment_find_nearest(const dsw_environment *environment, const double *point,
                                                dsw_volume_id volume, double radius, dsw_nearest *nearest);

#ifdef __cplusplus
}
#endif

#endif
