/** @file trace.h
 * Geometry for viewers: a trace collects points, segments and triangles of cells, walks and contacts into plain
 * arrays that any viewer can draw. In the plane what else is triangles is segments, sides of polygons as they turn, and points have the third
 * coordinate 0.
 */
#ifndef DARTSWEEP_TRACE_H
#define DARTSWEEP_TRACE_H

#include "dartsweep/contact.h"
#include "dartsweep/environment.h"
#include "dartsweep/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Opaque. Owned by the caller from dsw_trace_create to dsw_trace_destroy. */
typedef struct dsw_trace dsw_trace;

/** Arrays of a trace; owned by it, valid until it is changed. Every primitive carries the 32-bit label that was given
 * when it was added. */
typedef struct dsw_trace_data {
  uint32_t struct_size;            /**< Set by the caller: sizeof(dsw_trace_data). */
  uint32_t reserved;               /**< 0. */
  const double *points;            /**< 3 doubles each, scene units. */
  size_t point_count;              /**< How many points. */
  const uint32_t *vertices;        /**< Points drawn as dots: one index each. */
  const uint32_t *vertex_labels;   /**< A label each. */
  size_t vertex_count;             /**< How many dots. */
  const uint32_t *segments;        /**< Two indices each. */
  const uint32_t *segment_labels;  /**< A label each. */
  size_t segment_count;            /**< How many segments. */
  const uint32_t *triangles;       /**< Three indices each, counter-clockwise seen from outside of the volume. */
  const uint32_t *triangle_labels; /**< A label each. */
  size_t triangle_count;           /**< How many triangles. */
} dsw_trace_data;

/** Creates an empty trace.
 * @param context [in] null: defaults; retained. @param trace [out] owned by the caller.
 * @return DSW_STATUS_OUT_OF_MEMORY. @note Thread: any. @since 1.0 */
DSW_API dsw_status dsw_trace_create(dsw_context *context, dsw_trace **trace);

/** Destroys a trace; null is allowed.
 * @param trace [in] @return DSW_STATUS_STALE_ID: it is no trace. @note Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_trace_destroy(dsw_trace *trace);

/** Empties a trace and keeps its memory.
 * @param trace [in,out] @return DSW_STATUS_NULL_ARGUMENT. @note Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_trace_clear(dsw_trace *trace);

/** Adds the boundary triangles of volumes.
 * @param trace [in,out] @param environment [in] @param volumes [in] `count` live ids. @param count, label [in]
 * @return DSW_STATUS_STALE_ID, DSW_STATUS_OUT_OF_MEMORY: nothing was added.
 * @note O(count). Thread: writer of the trace, reader of the environment. @since 1.0 */
DSW_API dsw_status dsw_trace_add_volumes(dsw_trace *trace, const dsw_environment *environment,
                                         const dsw_volume_id *volumes, size_t count, uint32_t label);

/** Adds everything impassable that borders a passable volume: triangles of faces (the outer boundary only if
 * `with_boundary` is not 0), marked edges as segments, marked vertices as dots.
 * @param trace [in,out] @param environment, with_boundary, label [in]
 * @return DSW_STATUS_OUT_OF_MEMORY: nothing was added.
 * @note O(volumes). Thread: writer of the trace, reader of the environment. @since 1.0 */
DSW_API dsw_status dsw_trace_add_impassable(dsw_trace *trace, const dsw_environment *environment, int with_boundary,
                                            uint32_t label);

/** Adds the walk of a segment: one dot where each volume is entered, the pieces between them as segments, and the
 * contact, if there is one, as dsw_trace_add_contact with normal length `normal_length` does. Arguments as
 * dsw_environment_cast_path.
 * @param trace [in,out] @param environment [in] @param start, from, to, options [in] as for dsw_environment_cast.
 * @param normal_length [in] finite, scene units. @param label [in]
 * @return as dsw_environment_cast; DSW_STATUS_OUT_OF_MEMORY: nothing was added.
 * @note Thread: writer of the trace, reader of the environment. @since 1.0 */
DSW_API dsw_status dsw_trace_add_walk(dsw_trace *trace, const dsw_environment *environment, dsw_volume_id start,
                                      const double *from, const double *to, const dsw_cast_options *options,
                                      double normal_length, uint32_t label);

/** Adds a contact: a dot at flight->position and a segment along its normal. Nothing for a flight without contact.
 * @param trace [in,out] @param flight [in] from any call. @param normal_length [in] finite, scene units.
 * @param label [in]
 * @return DSW_STATUS_NON_FINITE, OUT_OF_MEMORY: nothing was added. @note O(1) amortised. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_trace_add_contact(dsw_trace *trace, const dsw_flight *flight, double normal_length,
                                         uint32_t label);

/** Gives the arrays.
 * @param trace [in] @param data [in,out] its struct_size set.
 * @return DSW_STATUS_BAD_STRUCT_SIZE. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_trace_get(const dsw_trace *trace, dsw_trace_data *data);

#ifdef __cplusplus
}
#endif

#endif
