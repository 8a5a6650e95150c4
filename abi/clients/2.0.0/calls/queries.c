/* Queries without a scene: places, casts, paths, what is near, sweeps, and geometry for viewers. */
#include <string.h>

#include "calls.h"

static const double start[3] = {0.5, 0.5, 0.5}, inside[3] = {2.5, 1.25, 1.5}, far_away[3] = {9, 0.5, 0.5};

static void places(const dsw_environment *environment) {
  static const double points[12] = {0.5, 0.5, 0.5, 1.5, 1.5, 1.5, 9, 9, 9, 1, 0.5, 0.5};
  dsw_volume_id volume, volumes[4];
  dsw_location location = DSW_LOCATION_NONE, locations[4];
  dsw_cell cell;
  size_t i;
  TRY(dsw_environment_locate(environment, start, no_volume, &volume, &location));
  say("  volume %u, location %d", volume.index, (int)location);
  TRY(dsw_environment_locate(environment, far_away, volume, &volume, &location));
  say("  %s, location %d", volume.generation == 0 ? "null" : "there", (int)location);
  TRY(dsw_environment_locate(NULL, start, no_volume, &volume, &location));
  TRY(dsw_environment_locate_points(environment, points, 4, 0, NULL, volumes, locations));
  for (i = 0; i < 4; ++i) say("  volume %u %s, location %d", volumes[i].index, volumes[i].generation == 0 ? "null" : "there", (int)locations[i]);
  TRY(dsw_environment_locate_points(environment, points, 4, 20, NULL, volumes, locations));
  for (i = 0; i < 4; i += 3) {
    TRY(dsw_environment_classify(environment, points + 3 * i, volumes[i], &cell));
    say("  kind %d", (int)cell.kind);
  }
  TRY(dsw_environment_classify(environment, far_away, volume_at(environment, 0), &cell));
}

static void casts(const dsw_environment *environment) {
  dsw_flight flight, flights[2];
  dsw_cast_options options;
  double from[6], to[6];
  TRY(dsw_environment_cast(environment, no_volume, start, inside, NULL, &flight));
  say_flight("  inside", &flight);
  TRY(dsw_environment_cast(environment, no_volume, start, far_away, NULL, &flight));
  say_flight("  away", &flight);
  TRY(dsw_environment_cast(environment, no_volume, far_away, start, NULL, &flight));
  say_flight("  from outside", &flight);
  dsw_cast_options_init(&options, sizeof options);
  options.max_volumes = 1;
  TRY(dsw_environment_cast(environment, no_volume, start, far_away, &options, &flight));
  say("  outcome %d", (int)flight.outcome);
  options.flags = 0x100;
  TRY(dsw_environment_cast(environment, no_volume, start, far_away, &options, &flight));
  options.flags = DSW_CAST_NO_DETAIL, options.max_volumes = 0;
  TRY(dsw_environment_cast(environment, no_volume, start, far_away, &options, &flight));
  say("  outcome %d, volume %u", (int)flight.outcome, flight.volume.index);
  memcpy(from, start, sizeof start), memcpy(from + 3, inside, sizeof inside);
  memcpy(to, far_away, sizeof far_away), memcpy(to + 3, start, sizeof start);
  TRY(dsw_environment_cast_segments(environment, 2, NULL, from, to, 0, NULL, flights));
  say_flight("  first", &flights[0]);
  say_flight("  second", &flights[1]);
  TRY(dsw_environment_cast_segments(environment, 2, NULL, from, NULL, 0, NULL, flights));
}

static void paths(const dsw_environment *environment) {
  dsw_crossing crossings[8];
  dsw_flight flight;
  size_t count = 99, i;
  TRY(dsw_environment_cast_path(environment, no_volume, start, inside, NULL, crossings, 1, &count, &flight));
  say("  needs %u", (unsigned)count);
  TRY(dsw_environment_cast_path(environment, no_volume, start, inside, NULL, crossings, 8, &count, &flight));
  for (i = 0; i < count && i < 8; ++i) {
    say("  volume %u, face of %u", crossings[i].volume.index, crossings[i].face.volume);
    say_numbers("  time", &crossings[i].time, 1);
  }
}

static void nearest(const dsw_environment *environment) {
  static const double point[3] = {0.5, 0.5, 0.2};
  dsw_nearest found;
  TRY(dsw_environment_find_nearest(environment, point, no_volume, 0.5, &found));
  say_numbers("  distance", &found.distance, 1);
  say_numbers("  point", found.point, 3);
  say_numbers("  normal", found.normal, 3);
  say("  kind %d, tag %u", (int)found.cell.kind, found.tag);
  TRY(dsw_environment_find_nearest(environment, point, no_volume, 0.1, &found));
  say_numbers("  distance", &found.distance, 1);
  say("  kind %d", (int)found.cell.kind);
  TRY(dsw_environment_find_nearest(environment, point, no_volume, -1, &found));
  TRY(dsw_environment_find_nearest(environment, far_away, no_volume, 1, &found));
}

static void sweeps(dsw_environment *environment) {
  static const double from[3] = {0.25, 0.25, 0.25}, to[3] = {0.25, 0.25, 1.75}, fixed[3] = {2.75, 1.75, 0.25};
  const dsw_volume_id column = volume_at(environment, 7);
  dsw_sweep_options options;
  dsw_sweep sweep;
  int level;
  TRY(dsw_environment_mark_volumes(environment, &column, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  dsw_sweep_options_init(&options, sizeof options);
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_FACES; ++level) {
    options.level = (dsw_level)level;
    TRY(dsw_environment_sweep_edges(environment, 1, NULL, from, to, fixed, 0, &options, &sweep));
    say("  level %d, outcome %d, volume %u", level, (int)sweep.outcome, sweep.volume.index);
    say_numbers("  time", &sweep.time, 1);
    if (sweep.outcome != DSW_OUTCOME_CONTACT) continue;
    say_numbers("  point", sweep.point, 3);
    say_numbers("  parameter", &sweep.edge_parameter, 1);
    say_contact(&sweep.contact);
  }
  TRY(dsw_environment_sweep_edges(environment, 1, NULL, from, to, fixed, 0, NULL, &sweep));
  say_numbers("  by default", &sweep.time, 1);
  options.level = (dsw_level)0;
  TRY(dsw_environment_sweep_edges(environment, 1, NULL, from, to, fixed, 0, &options, &sweep));
}

static void say_trace(const dsw_trace *trace) {
  dsw_trace_data data;
  size_t i;
  memset(&data, 0, sizeof data);
  data.struct_size = sizeof data;
  TRY(dsw_trace_get_data(trace, &data));
  say("  %u points, %u dots, %u segments, %u triangles", (unsigned)data.point_count, (unsigned)data.vertex_count,
      (unsigned)data.segment_count, (unsigned)data.triangle_count);
  for (i = 0; i < data.vertex_count; ++i) say_numbers("  dot", data.points + 3 * data.vertices[i], 3);
  for (i = 0; i < data.segment_count; ++i) say("  segment with label %u", data.segment_labels[i]);
}

static void traces(const dsw_environment *environment) {
  const dsw_volume_id first = volume_at(environment, 0);
  dsw_trace *trace = NULL;
  dsw_flight flight;
  TRY(dsw_trace_create(NULL, &trace));
  TRY(dsw_trace_add_volumes(trace, environment, &first, 1, 3));
  say_trace(trace);
  TRY(dsw_trace_clear(trace));
  TRY(dsw_trace_add_impassable(trace, environment, 0, 4));
  say_trace(trace);
  TRY(dsw_trace_add_impassable(trace, environment, 1, 4));
  say_trace(trace);
  TRY(dsw_trace_clear(trace));
  TRY(dsw_trace_add_walk(trace, environment, no_volume, start, far_away, NULL, 0.5, 5));
  say_trace(trace);
  TRY(dsw_trace_clear(trace));
  TRY(dsw_environment_cast(environment, no_volume, start, far_away, NULL, &flight));
  TRY(dsw_trace_add_contact(trace, &flight, 0.5, 6));
  say_trace(trace);
  TRY(dsw_trace_add_contact(NULL, &flight, 0.5, 6));
  TRY(dsw_trace_destroy(trace));
  TRY(dsw_trace_destroy(NULL));
}

void call_queries(void) {
  dsw_environment *const environment = make_block(NULL, 3, 2, 2, 0);
  say("* queries");
  places(environment);
  casts(environment);
  paths(environment);
  nearest(environment);
  sweeps(environment);
  traces(environment);
  TRY(dsw_environment_destroy(environment));
}
