/** @file query.h
 * Queries without a scene: where a point is, what a segment meets, what is near. By the shift
 * (base.h) a point lies in at most one volume, and a segment pierces one triangle at a time.
 * Batches that run out of memory may have written some answers. More: bindings/docs/exactness.md.
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
  DSW_LOCATION_NONE = 0,       /**< Not looked for. */
  DSW_LOCATION_PASSABLE = 1,   /**< In a passable volume. */
  DSW_LOCATION_IMPASSABLE = 2, /**< In an impassable volume. */
  DSW_LOCATION_OUTSIDE = 3,    /**< In no volume. */
  DSW_LOCATION_FORCE_INT32 = 0x7fffffff
} dsw_location;

/** Flags of a cast. */
enum {
  /** `start` contains the first point; else the answer is meaningless, but safe. Without the flag
   * `start` is a hint. */
  DSW_CAST_START_KNOWN = 0x1,
  /** Only outcome, volume and volumes_visited are reported. */
  DSW_CAST_NO_DETAIL = 0x2,
  /** Line of sight, exactly and without the shift: what touches an end alone does not count. The
   * way between the ends is free if it runs in passable volumes and touches no impassable face. The
   * start may lie on the boundary. No `volume` is reported. Casts of paths and from particles
   * refuse the flag. @since 2.1 */
  DSW_CAST_OPEN_ENDS = 0x4,
  /** For moves of particles: those that come to an exit are removed. Casts refuse the flag.
   * @since 2.1 */
  DSW_CAST_LEAVE = 0x8
};

/** Options of a cast. */
typedef struct dsw_cast_options {
  uint32_t struct_size;
  uint32_t flags;
  uint32_t max_volumes; /**< Volumes entered before WORK_LIMIT; 0: no limit. */
  uint32_t reserved;
} dsw_cast_options;

DSW_API void dsw_cast_options_init(dsw_cast_options *options, size_t size);

/** Finds the volume that contains a point.
 * @param volume null if outside.
 * @note Cost: O(volumes from hint to point); without such a way O(log n) expected with the search
 * structure (DSW_ENVIRONMENT_LOCATE_TREE), O(n) before it is built and once after a deformation. */
DSW_API dsw_status dsw_environment_locate(const dsw_environment *environment, const double *point,
                                          dsw_volume_id hint, dsw_volume_id *volume,
                                          dsw_location *location);

/** Locates many points. @note Cost: as dsw_environment_locate. Batch. */
DSW_API dsw_status dsw_environment_locate_points(const dsw_environment *environment,
                                                 const double *points, size_t count,
                                                 size_t stride_bytes, const dsw_volume_id *hints,
                                                 dsw_volume_id *volumes, dsw_location *locations);

/** Gives the vertex, edge, face or volume on which a point lies exactly, without the shift.
 * @param volume from dsw_environment_locate.
 * @return DSW_STATUS_OUTSIDE: not in the closure of `volume`.
 * @note Cost: O(faces of the volume). */
DSW_API dsw_status dsw_environment_classify(const dsw_environment *environment, const double *point,
                                            dsw_volume_id volume, dsw_cell *cell);

/** Casts a segment to its end or to the first impassable face.
 * @note Cost: O(volumes crossed), and a locate without DSW_CAST_START_KNOWN. Source: [JCD10]
 * 3.3. */
DSW_API dsw_status dsw_environment_cast(const dsw_environment *environment, dsw_volume_id start,
                                        const double *from, const double *to,
                                        const dsw_cast_options *options, dsw_flight *flight);

/** Casts many segments. @note Cost: as dsw_environment_cast. Batch. */
DSW_API dsw_status dsw_environment_cast_segments(const dsw_environment *environment, size_t count,
                                                 const dsw_volume_id *starts, const double *from,
                                                 const double *to, size_t stride_bytes,
                                                 const dsw_cast_options *options,
                                                 dsw_flight *flights);

/** Casts a segment and lists the volumes that it enters, in order.
 * @param flight may be null.
 * @note Cost: as dsw_environment_cast. */
DSW_API dsw_status dsw_environment_cast_path(const dsw_environment *environment,
                                             dsw_volume_id start, const double *from,
                                             const double *to, const dsw_cast_options *options,
                                             dsw_crossing *crossings, size_t capacity,
                                             size_t *count, dsw_flight *flight);

/** The nearest impassable cell. */
typedef struct dsw_nearest {
  double distance; /**< Rounded; infinity if nothing is near. */
  double point[3]; /**< Its nearest point, rounded. */
  /** Unit, towards the given point; zero for distance 0 or infinity. */
  double normal[3];
  dsw_cell cell; /**< The face, edge or vertex, or NONE. */
  /** For a face: its tag; see dsw_contact. A marked face on which the point lies is seen from the
   * passable volume with the lower index. */
  uint32_t tag;
  uint32_t volumes_visited; /**< Volumes looked at; depends on earlier calls. */
} dsw_nearest;

/** Finds the nearest impassable face, marked edge or vertex that can be seen through passable
 * volumes; of equals, the lowest canonical one. A point exactly on the boundary of passable space
 * has distance 0: the answer is what it lies on.
 * @param volume that of the point, or null.
 * @param radius at least 0; may be infinite.
 * @return DSW_STATUS_OUTSIDE, IMPASSABLE: nor is the point on the boundary.
 * @note Cost: O(volumes within the distance). Far calls build a search structure when they have
 * taken as long; then O(log n) expected, and the volumes on the way. */
DSW_API dsw_status dsw_environment_find_nearest(const dsw_environment *environment,
                                                const double *point, dsw_volume_id volume,
                                                double radius, dsw_nearest *nearest);

/** Finds what is nearest to each of many points, as dsw_environment_find_nearest does with
 * `radius`.
 * @param nearest infinite distance and no cell where that fails. `volumes_visited` also depends on
 * threads.
 * @param volumes of the points, or null ids; may be null or `hints`.
 * @note Cost: as dsw_environment_find_nearest. Batch. @since 2.1 */
DSW_API dsw_status dsw_environment_find_nearest_to_points(
    const dsw_environment *environment, const double *points, size_t count, size_t stride_bytes,
    const dsw_volume_id *hints, double radius, dsw_nearest *nearest, dsw_volume_id *volumes,
    dsw_location *locations);

/** The impassable cell that is nearest to a segment. */
typedef struct dsw_segment_nearest {
  dsw_nearest nearest;      /**< Its normal points towards segment_point. */
  double segment_parameter; /**< Where segment_point is: 0 at `from`, 1 at `to`. */
  double segment_point[3];  /**< The nearest point of the segment; both are 0 if nothing is near. */
} dsw_segment_nearest;

/** Finds for each of many segments the nearest impassable face, marked edge or vertex that can be
 * reached from it through passable volumes that are no farther away; of equals, the lowest
 * dimension, then the lowest canonical one. An impassable face that it passes is the answer
 * exactly, with distance and normal 0, and segment_parameter is the time of the contact.
 * @param hints for `from`; not needed for a segment that begins where the last ends.
 * @param radius, nearest, volumes as in dsw_environment_find_nearest_to_points, for `from`.
 * @note Cost: O(volumes that the segment enters or that are within the distance). Batch.
 * @since 2.1 */
DSW_API dsw_status dsw_environment_find_nearest_to_segments(
    const dsw_environment *environment, size_t count, const dsw_volume_id *hints,
    const double *from, const double *to, size_t stride_bytes, double radius,
    dsw_segment_nearest *nearest, dsw_volume_id *volumes, dsw_location *locations);

/** Finds for each of many points how far it is from the outer boundary of the environment, whatever
 * is marked: negative inside. The sign is exact; distances are rounded.
 * @param distances one a point.
 * @param nearest the nearest place; its `distance` has no sign. May be null.
 * @note Cost of a point: O(log n) expected once the search structure is built, or in a batch that is
 * large enough for a tree of its own; else O(n), also far outside. Batch. @since 2.1 */
DSW_API dsw_status dsw_environment_find_signed_distances(const dsw_environment *environment,
                                                         const double *points, size_t count,
                                                         size_t stride_bytes, double *distances,
                                                         dsw_nearest *nearest);

/** Finds for each of many points the nearest place inside: in a passable volume, on nothing
 * impassable. A point inside stays. Any other goes to the nearest place of the boundary of passable
 * space (rounded), and `by` along the face's inward normal; without room, towards the centre of the
 * volume there.
 * @param by finite, at least 0; 0: as little as rounding allows.
 * @param inside `count` points without gaps; may be `points`.
 * @param volumes of the places; null: there is none, and the point stays. May be null or `hints`.
 * @note Cost: as dsw_environment_locate; beyond the boundary O(log n) expected with a search
 * structure, else O(n). Batch. @since 2.1 */
DSW_API dsw_status dsw_environment_find_inside(const dsw_environment *environment,
                                               const double *points, size_t count,
                                               size_t stride_bytes, const dsw_volume_id *hints,
                                               double by, double *inside, dsw_volume_id *volumes);

#ifdef __cplusplus
}
#endif

#endif
