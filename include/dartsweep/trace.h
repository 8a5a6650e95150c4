/** @file trace.h
 * Geometry for viewers: dots, segments and triangles of cells, casts and contacts in plain arrays,
 * each with the `label` that it was added with. Normals are drawn `normal_length` long.
 */
#ifndef DARTSWEEP_TRACE_H
#define DARTSWEEP_TRACE_H

#include "dartsweep/contact.h"
#include "dartsweep/environment.h"
#include "dartsweep/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Opaque. */
typedef struct dsw_trace dsw_trace;

/** Arrays of a trace, valid until it changes: `points` of 3 doubles; dots (`vertices`), `segments`
 * and `triangles` (counter-clockwise from outside) of 1, 2 and 3 indices; a label for each in
 * `vertex_labels`, `segment_labels` and `triangle_labels`. */
typedef struct dsw_trace_data {
  uint32_t struct_size;
  uint32_t reserved;
  const double *points;
  size_t point_count;
  const uint32_t *vertices;
  const uint32_t *vertex_labels;
  size_t vertex_count;
  const uint32_t *segments;
  const uint32_t *segment_labels;
  size_t segment_count;
  const uint32_t *triangles;
  const uint32_t *triangle_labels;
  size_t triangle_count;
} dsw_trace_data;

/** Creates an empty trace. @note Thread: any. */
DSW_API dsw_status dsw_trace_create(dsw_context *context, dsw_trace **trace);

/** Destroys a trace. */
DSW_API dsw_status dsw_trace_destroy(dsw_trace *trace);

/** Empties a trace and keeps its memory. */
DSW_API dsw_status dsw_trace_clear(dsw_trace *trace);

/** Adds the boundary triangles of volumes. @note Cost: O(count). */
DSW_API dsw_status dsw_trace_add_volumes(dsw_trace *trace, const dsw_environment *environment,
                                         const dsw_volume_id *volumes, size_t count,
                                         uint32_t label);

/** Adds all that is impassable and borders a passable volume: faces as triangles, marked edges as
 * segments, marked vertices as dots.
 * @param with_boundary 0: without the outer boundary.
 * @note Cost: O(volumes). */
DSW_API dsw_status dsw_trace_add_impassable(dsw_trace *trace, const dsw_environment *environment,
                                            int with_boundary, uint32_t label);

/** Casts a segment and adds dots where volumes are entered, the segments between, and the contact
 * as dsw_trace_add_contact does.
 * @note Cost: as dsw_environment_cast. */
DSW_API dsw_status dsw_trace_add_walk(dsw_trace *trace, const dsw_environment *environment,
                                      dsw_volume_id start, const double *from, const double *to,
                                      const dsw_cast_options *options, double normal_length,
                                      uint32_t label);

/** Adds a dot at flight->position and a segment along the normal, if there was a contact. */
DSW_API dsw_status dsw_trace_add_contact(dsw_trace *trace, const dsw_flight *flight,
                                         double normal_length, uint32_t label);

/** Gives the arrays. */
DSW_API dsw_status dsw_trace_get_data(const dsw_trace *trace, dsw_trace_data *data);

#ifdef __cplusplus
}
#endif

#endif
