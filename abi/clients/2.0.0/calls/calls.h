/* A host of 2.0 that calls every function of its headers. Each part prints what it has asked and what was answered; the
 * lines are compared with those that the library of 2.0.0 printed. What may differ between versions is not printed: ids
 * of what is new, counters, bytes, texts, last bits of numbers. */
#ifndef DARTSWEEP_CALLS_H
#define DARTSWEEP_CALLS_H

#include "dartsweep/dartsweep.h"

/* A line. */
void say(const char *format, ...);

/* A line with a call and its status. */
#define TRY(call) tried(#call, call)
dsw_status tried(const char *call, dsw_status status);

/* Lines with numbers, six digits of each. */
void say_numbers(const char *name, const double *numbers, size_t count);
void say_contact(const dsw_contact *contact);
void say_flight(const char *name, const dsw_flight *flight);

/* Lines about an environment: its size, and whether it is valid. */
void say_environment(const dsw_environment *environment);

/* x * y * z hexahedra of side 1, volume (i, j, k) at i + x * (j + y * k), in region i, with tag 100 + index. */
dsw_environment *make_block(dsw_context *context, uint32_t x, uint32_t y, uint32_t z, uint32_t flags);
dsw_environment *make_block_without_labels(uint32_t x, uint32_t y, uint32_t z);
dsw_scene *make_scene(dsw_environment *environment, uint32_t features);

dsw_volume_id volume_at(const dsw_environment *environment, uint32_t index);
dsw_vertex_id vertex_at(const dsw_environment *environment, uint32_t index);
dsw_cell volume_cell(dsw_volume_id volume);
dsw_cell face_cell(dsw_face_id face);

/* The face between two volumes of a block. */
dsw_face_id face_between(const dsw_environment *environment, dsw_volume_id a, dsw_volume_id b);

/* A body of one edge. */
dsw_body_id make_wire(dsw_scene *scene, const double *ends, dsw_level level, uint32_t flags);

extern const dsw_volume_id no_volume;

void call_defaults(void);
void call_context(void);
void call_environment(void);
void call_queries(void);
void call_particles(void);
void call_bodies(void);
void call_moves(void);
void call_deformations(void);
void call_topology(void);
void call_surgery(void);
void call_records(void);
void call_lifetimes(void);
void call_plane(void);

#endif
