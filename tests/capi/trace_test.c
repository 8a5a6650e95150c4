#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 1 x 1 cubes */

static dsw_trace_data data_of(const dsw_trace *trace) {
  dsw_trace_data d;
  memset(&d, 0x55, sizeof d);
  d.struct_size = sizeof d;
  CHECK_OK(dsw_trace_get_data(trace, &d));
  CHECK(d.struct_size == sizeof d && d.reserved == 0);
  return d;
}

/* Every index names a point. */
static void check_indices(const dsw_trace_data *d) {
  size_t i;
  for (i = 0; i < d->vertex_count; ++i) CHECK(d->vertices[i] < d->point_count);
  for (i = 0; i < 2 * d->segment_count; ++i) CHECK(d->segments[i] < d->point_count);
  for (i = 0; i < 3 * d->triangle_count; ++i) CHECK(d->triangles[i] < d->point_count);
}

static dsw_trace *make_trace(void) {
  dsw_trace *trace = NULL;
  CHECK_OK(dsw_trace_create(NULL, &trace));
  return trace;
}

static void a_trace_is_empty_at_first(void) {
  dsw_trace *const trace = make_trace();
  dsw_trace_data d = data_of(trace);
  CHECK(d.point_count == 0 && d.vertex_count == 0 && d.segment_count == 0 && d.triangle_count == 0);
  d.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_trace_get_data(trace, &d));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_get_data(trace, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_get_data(NULL, &d));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_create(NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_clear(NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_trace_clear((dsw_trace *)(void *)g_env));
  CHECK_OK(dsw_trace_destroy(trace));
  CHECK_OK(dsw_trace_destroy(NULL));
}

static void volumes_become_triangles(void) {
  dsw_trace *const trace = make_trace();
  const dsw_volume_id good[2] = {{0, 1}, {3, 1}}, bad[2] = {{0, 1}, {4, 1}};
  dsw_trace_data d;
  size_t i;
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_trace_add_volumes(trace, g_env, bad, 2, 7));
  CHECK(data_of(trace).triangle_count == 0 && data_of(trace).point_count == 0);
  CHECK_OK(dsw_trace_add_volumes(trace, g_env, good, 2, 7));
  d = data_of(trace);
  CHECK(d.triangle_count == 24 && d.vertex_count == 0 && d.segment_count == 0);
  for (i = 0; i < d.triangle_count; ++i) CHECK(d.triangle_labels[i] == 7);
  check_indices(&d);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_volumes(NULL, g_env, good, 2, 7));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_volumes(trace, NULL, good, 2, 7));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_volumes(trace, g_env, NULL, 2, 7));
  CHECK_OK(dsw_trace_clear(trace));
  CHECK(data_of(trace).triangle_count == 0);
  CHECK_OK(dsw_trace_destroy(trace));
}

static void what_is_impassable_is_drawn(void) {
  dsw_trace *const trace = make_trace();
  const dsw_volume_id wall = volume_at(1);
  const dsw_edge_id edge = edge_at(0, 0);
  const dsw_vertex_id vertex = vertex_at(3);
  dsw_trace_data d;
  CHECK_OK(dsw_trace_add_impassable(trace, g_env, 0, 1));
  CHECK(data_of(trace).triangle_count == 0);
  CHECK_OK(dsw_trace_add_impassable(trace, g_env, 1, 1));
  CHECK(data_of(trace).triangle_count == 36);
  CHECK_OK(dsw_trace_clear(trace));
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_mark_vertices(g_env, &vertex, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_trace_add_impassable(trace, g_env, 0, 5));
  d = data_of(trace);
  CHECK(d.triangle_count == 4 && d.segment_count == 1 && d.vertex_count == 1);
  CHECK(d.triangle_labels[0] == 5 && d.segment_labels[0] == 5 && d.vertex_labels[0] == 5);
  check_indices(&d);
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_PASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_environment_mark_vertices(g_env, &vertex, 1, DSW_MARK_PASSABLE));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_impassable(NULL, g_env, 0, 5));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_impassable(trace, NULL, 0, 5));
  CHECK_OK(dsw_trace_destroy(trace));
}

static void a_walk_and_its_contact_are_drawn(void) {
  dsw_trace *const trace = make_trace();
  const double from[3] = {0.5, 0.5, 0.5}, inside[3] = {2.5, 0.5, 0.5}, beyond[3] = {8.5, 0.5, 0.5},
               bad[3] = {NAN, 0, 0};
  dsw_trace_data d;
  size_t dots;
  CHECK_OK(dsw_trace_add_walk(trace, g_env, no_volume, from, inside, NULL, 0.5, 2));
  d = data_of(trace);
  dots = d.vertex_count;
  CHECK(d.vertex_count == 3 && d.segment_count == 3 && d.triangle_count == 0);
  check_indices(&d);
  CHECK_OK(dsw_trace_add_walk(trace, g_env, no_volume, from, beyond, NULL, 0.5, 3));
  d = data_of(trace);
  CHECK(d.vertex_count == dots + 4 + 1 && d.segment_count == 3 + 4 + 1); /* with the contact's dot and normal */
  check_indices(&d);
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_trace_add_walk(trace, g_env, no_volume, bad, beyond, NULL, 0.5, 3));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_trace_add_walk(trace, g_env, no_volume, from, beyond, NULL, NAN, 3));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_trace_add_walk(trace, g_env, stale_volume, from, beyond, NULL, 0.5, 3));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_walk(trace, g_env, no_volume, NULL, beyond, NULL, 0.5, 3));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_walk(trace, g_env, no_volume, from, NULL, NULL, 0.5, 3));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_walk(NULL, g_env, no_volume, from, beyond, NULL, 0.5, 3));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_walk(trace, NULL, no_volume, from, beyond, NULL, 0.5, 3));
  CHECK(data_of(trace).vertex_count == d.vertex_count);
  CHECK_OK(dsw_trace_destroy(trace));
}

static void a_contact_is_a_dot_and_its_normal(void) {
  dsw_trace *const trace = make_trace();
  const double from[3] = {0.5, 0.5, 0.5}, beyond[3] = {8.5, 0.5, 0.5};
  dsw_flight hit, reached;
  dsw_trace_data d;
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, beyond, NULL, &hit));
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, from, NULL, &reached));
  CHECK_OK(dsw_trace_add_contact(trace, &reached, 2, 9));
  CHECK(data_of(trace).point_count == 0);
  CHECK_OK(dsw_trace_add_contact(trace, &hit, 2, 9));
  d = data_of(trace);
  CHECK(d.vertex_count == 1 && d.segment_count == 1 && d.vertex_labels[0] == 9 && d.segment_labels[0] == 9);
  CHECK(d.points[3 * d.vertices[0]] == 4 && d.points[3 * d.segments[1]] == 2);
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_trace_add_contact(trace, &hit, INFINITY, 9));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_contact(trace, NULL, 2, 9));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_trace_add_contact(NULL, &hit, 2, 9));
  CHECK_OK(dsw_trace_destroy(trace));
}

static void memory_that_runs_out_adds_nothing(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_trace *trace = NULL;
  const dsw_volume_id all[4] = {{0, 1}, {1, 1}, {2, 1}, {3, 1}};
  size_t refusals;
  h.refuse = h.calls + 1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_MEMORY, dsw_trace_create(context, &trace));
  CHECK(trace == NULL);
  h.refuse = 0;
  CHECK_OK(dsw_trace_create(context, &trace));
  for (refusals = 0; refusals < 100; ++refusals) {
    dsw_status status;
    h.refuse = h.calls + refusals + 1;
    status = dsw_trace_add_volumes(trace, g_env, all, 4, 1);
    if (status == DSW_STATUS_OK) break;
    CHECK(status == DSW_STATUS_OUT_OF_MEMORY && data_of(trace).triangle_count == 0 && data_of(trace).point_count == 0);
  }
  h.refuse = 0;
  CHECK(refusals >= 1 && refusals < 100 && data_of(trace).triangle_count == 48);
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_context_destroy(context));
  CHECK_OK(dsw_trace_destroy(trace));
  end_context(context, &h);
}

int main(void) {
  g_env = make_environment(NULL, 4, 1, 1);
  a_trace_is_empty_at_first();
  volumes_become_triangles();
  what_is_impassable_is_drawn();
  a_walk_and_its_contact_are_drawn();
  a_contact_is_a_dot_and_its_normal();
  memory_that_runs_out_adds_nothing();
  CHECK_OK(dsw_environment_destroy(g_env));
  return check_result();
}
