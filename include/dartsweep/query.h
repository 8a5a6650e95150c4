/** @file query.h
 * Queries without a scene: where a point is, what a segment meets, what is near.
 *
 * By the shift (base.h) each point lies in one volume at most, and a segment pierces one triangle
 * at a time.
 */
#ifndef DARTSWEEP_QUERY_H
#define DARTSWEEP_QUERY_H

#include "dartsweep/contact.h"
#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Where a point is. */
typedef enum dsw_location {
  DSW_LOCATION_NONE = 0,                /**< Not looked for. */
  DSW_LOCATION_PASSABLE = 1,            /**< In a passable volume. */
  DSW_LOCATION_IMPASSABLE = 2,          /**< In an impassable volume. */
  DSW_LOCATION_OUTSIDE = 3,             /**< In no volume. */
  DSW_LOCATION_FORCE_INT32 = 0x7fffffff /**< Unused. */
} dsw_location;

/** Flags of a cast. */
enum {
  /** `start` contains the first point. If not, the answer is meaningless, but the call is safe.
   * Without the flag `start` is a hint. */
  DSW_CAST_START_KNOWN = 0x1,
  /** Only outcome, volume and volumes_visited are reported. */
  DSW_CAST_NO_DETAIL = 0x2
};

/** Options of a cast. */
typedef struct dsw_cast_options {
  uint32_t struct_size; /**< sizeof(dsw_cast_options). */
  uint32_t flags;       /**< DSW_CAST_... */
  uint32_t max_volumes; /**< Volumes entered before DSW_OUTCOME_WORK_LIMIT; 0: no limit. */
  uint32_t reserved;    /**< 0. */
} dsw_cast_options;

/** Writes the defaults. @since 2.0 */
DSW_API void dsw_cast_options_init(dsw_cast_options *options, size_t size);

/** Finds the volume that contains a point.
 * @param volume null if outside. @param location may be null.
 * @note Cost: O(volumes from hint to point). Without hint, or if that way leaves the environment:
 * O(log n) expected with the search structure (DSW_ENVIRONMENT_LOCATE_TREE); O(n) before it is
 * built, and once after a deformation. @since 2.0 */
DSW_API dsw_status dsw_environment_locate(const dsw_environment *environment, const double *point,
                                          dsw_volume_id hint, dsw_volume_id *volume,
                                          dsw_location *location);

/** Locates many points.
 * @param hints, locations may be null.
 * @note Cost: as dsw_environment_locate. Batch. @since 2.0 */
DSW_API dsw_status dsw_environment_locate_points(const dsw_environment *environment,
                                                 const double *points, size_t count,
                                                 size_t stride_bytes, const dsw_volume_id *hints,
                                                 dsw_volume_id *volumes, dsw_location *locations);

/** Gives the vertex, edge, face or volume on which a point lies exactly, without the shift.
 * @param volume from dsw_environment_locate.
 * @return DSW_STATUS_OUTSIDE: not in the closure of `volume`.
 * @note Cost: O(faces of the volume). @since 2.0 */
DSW_API dsw_status dsw_environment_classify(const dsw_environment *environment, const double *point,
                                            dsw_volume_id volume, dsw_cell *cell);

/** Casts a segment to its end or to the first impassable face.
 * @param start a hint, see DSW_CAST_START_KNOWN.
 * @note Cost: O(volumes crossed), and a locate. Source: [JCD10] 3.3. @since 2.0 */
DSW_API dsw_status dsw_environment_cast(const dsw_environment *environment, dsw_volume_id start,
                                        const double *from, const double *to,
                                        const dsw_cast_options *options, dsw_flight *flight);

/** Casts many segments.
 * @param starts may be null.
 * @note Cost: as dsw_environment_cast. Batch. @since 2.0 */
DSW_API dsw_status dsw_environment_cast_segments(const dsw_environment *environment, size_t count,
                                                 const dsw_volume_id *starts, const double *from,
                                                 const double *to, size_t stride_bytes,
                                                 const dsw_cast_options *options,
                                                 dsw_flight *flights);

/** Casts a segment and lists the volumes that it enters, in order.
 * @param start as for dsw_environment_cast. @param flight may be null.
 * @note Cost: as dsw_environment_cast. @since 2.0 */
DSW_API dsw_status dsw_environment_cast_path(const dsw_environment *environment,
                                             dsw_volume_id start, const double *from,
                                             const double *to, const dsw_cast_options *options,
                                             dsw_crossing *crossings, size_t capacity,
                                             size_t *count, dsw_flight *flight);

/** The nearest impassable cell. */
typedef struct dsw_nearest {
  double distance; /**< Rounded; infinity if nothing is within the radius. */
  double point[3]; /**< Its nearest point, rounded. */
  /** Unit, towards the given point; zero for distance 0 or infinity. */
  double normal[3];
  dsw_cell cell;            /**< The face, edge or vertex; DSW_CELL_NONE if nothing. */
  uint32_t tag;             /**< As in dsw_contact, for a face. */
  uint32_t volumes_visited; /**< Volumes looked at; depends on earlier calls. */
} dsw_nearest;

/** Finds the nearest impassable face, marked edge or vertex that can be seen through passable
 * volumes; if several, the lowest canonical one.
 *
 * A point exactly on the boundary of passable space has the distance 0, also where the shift puts
 * it outside. Then the answer is what it lies on: the lowest dimension, then the lowest canonical
 * cell. This is decided exactly. Elsewhere, too, a distance may round to 0.
 * @param volume that of the point, or null. @param radius at least 0; may be infinite.
 * @return DSW_STATUS_OUTSIDE, DSW_STATUS_IMPASSABLE: the point is not on the boundary either.
 * @note Cost: O(volumes within the distance). Far calls build a search structure when they have
 * taken as long, unless DSW_ENVIRONMENT_NO_LOCATE_TREE forbids; then O(log n) expected, and the
 * volumes on the way. Rounding: a few units in the last place. @since 2.0 */
DSW_API dsw_status dsw_environment_find_nearest(const dsw_environment *environment,
                                                const double *point, dsw_volume_id volume,
                                                double radius, dsw_nearest *nearest);

/** Finds what is nearest to each of many points, as dsw_environment_find_nearest.
 * @param hints may be null. Each entry is a volume near its point, or the null id.
 * @param radius at least 0; may be infinite.
 * @param nearest if a point lies outside, or in an impassable volume, and not on its boundary:
 * infinite distance, no cell. `volumes_visited` also depends on threads.
 * @param volumes those of the points, null outside; may be null, and may be `hints`.
 * @param locations may be null.
 * @return DSW_STATUS_OUT_OF_MEMORY: some answers may be written.
 * @note Cost, rounding: as dsw_environment_find_nearest. Batch. @since 2.1 */
DSW_API dsw_status dsw_environment_find_nearest_to_points(
    const dsw_environment *environment, const double *points, size_t count, size_t stride_bytes,
    const dsw_volume_id *hints, double radius, dsw_nearest *nearest, dsw_volume_id *volumes,
    dsw_location *locations);

/** The impassable cell that is nearest to a segment. */
typedef struct dsw_segment_nearest {
  dsw_nearest nearest;      /**< Its normal points towards segment_point. */
  double segment_parameter; /**< Of the segment's nearest point: 0 at `from`, 1 at `to`. */
  double segment_point[3];  /**< This point, rounded. Zero, as the parameter, if nothing is near. */
} dsw_segment_nearest;

/** Finds for each of many segments the nearest impassable face, marked edge or vertex within the
 * radius. Only volumes count that can be reached from the segment through passable ones that are
 * no farther away. If several have the same rounded distance, the answer is the one of the lowest
 * dimension, then the lowest canonical one.
 *
 * If the segment passes an impassable face, the first one on its way is the answer, exactly as for
 * dsw_environment_cast: the distance and the normal are 0, and segment_parameter is the time of the
 * contact. What lies behind that face is not looked at. An end exactly on the boundary of passable
 * space, or on a marked edge or vertex, is at distance 0, too.
 *
 * Where cells do not overlap, the distance is that of the nearest of these cells, up to rounding.
 * Take the largest difference of a coordinate between `from` and `to`, the cell that is named, or
 * the cell that is nearest: in tests against exact arithmetic no error exceeded 2^-49 of it.
 * @param hints as for dsw_environment_find_nearest_to_points, for `from`. Without a hint, a segment
 * that begins where the one before ends is not searched for.
 * @param radius, nearest, volumes, locations as there, for `from`.
 * @return DSW_STATUS_OUT_OF_MEMORY: some answers may be written.
 * @note Cost: O(volumes that the segment enters, and volumes within the distance), independent of
 * the size of the environment. Batch. @since 2.1 */
DSW_API dsw_status dsw_environment_find_nearest_to_segments(
    const dsw_environment *environment, size_t count, const dsw_volume_id *hints,
    const double *from, const double *to, size_t stride_bytes, double radius,
    dsw_segment_nearest *nearest, dsw_volume_id *volumes, dsw_location *locations);

/** Finds for each of many points the nearest place that is inside: in a passable volume, and on
 * nothing impassable. A point that is inside stays as it is. A point on the boundary of passable
 * space, or beyond the boundary, goes to the nearest place of the boundary (rounded), and from there
 * `by` farther along the face's inward normal. If the volumes there leave no room for that, the
 * point goes towards the centre of the volume at the face instead, at most to the centre. A body
 * that begins on an inlet needs this.
 * @param hints may be null. Each entry is a volume near its point, or the null id.
 * @param by finite, at least 0; 0: as little as rounding allows.
 * @param inside `count` points without gaps; may be `points` if these have no gaps.
 * @param volumes those of the places, null where there is none: then the point stays as it is.
 * May be null, and may be `hints`.
 * @note Cost: as dsw_environment_locate, and for a point beyond the boundary O(log n) expected with
 * a search structure, else O(n). Batch. @since 2.1 */
DSW_API dsw_status dsw_environment_find_inside(const dsw_environment *environment,
                                               const double *points, size_t count,
                                               size_t stride_bytes, const dsw_volume_id *hints,
                                               double by, double *inside, dsw_volume_id *volumes);

#ifdef __cplusplus
}
#endif

#endif
