#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 2 x 2 cubes */

static void init_writes_the_defaults(void) {
  dsw_cast_options o;
  memset(&o, 0xff, sizeof o);
  dsw_cast_options_init(&o, sizeof o);
  CHECK(o.struct_size == sizeof o && o.flags == 0 && o.max_volumes == 0 && o.reserved == 0);
  dsw_cast_options_init(NULL, sizeof o);
}

static void a_point_is_located(void) {
  const double inside[3] = {2.5, 0.5, 0.5}, outside[3] = {4.5, 0.5, 0.5}, bad[3] = {0.5, -INFINITY, 0.5};
  dsw_volume_id volume = {9, 9};
  dsw_location location = DSW_LOCATION_NONE;
  CHECK_OK(dsw_environment_locate(g_env, inside, no_volume, &volume, &location));
  CHECK(volume.index == 2 && volume.generation == 1 && location == DSW_LOCATION_PASSABLE);
  CHECK_OK(dsw_environment_locate(g_env, inside, volume_at(15), &volume, NULL));
  CHECK(volume.index == 2);
  CHECK_OK(dsw_environment_locate(g_env, outside, volume_at(0), &volume, &location));
  CHECK(volume.index == 0 && volume.generation == 0 && location == DSW_LOCATION_OUTSIDE);
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_locate(g_env, bad, no_volume, &volume, &location));
  CHECK_MESSAGE("dsw_environment_locate: point[1] is -inf, must be finite");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_locate(g_env, inside, stale_volume, &volume, &location));
  CHECK_MESSAGE("hint {index 0, generation 7}");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_locate(NULL, inside, no_volume, &volume, &location));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_locate(g_env, NULL, no_volume, &volume, &location));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_locate(g_env, inside, no_volume, NULL, &location));
}

static void a_point_in_an_impassable_volume_says_so(void) {
  const double point[3] = {2.5, 0.5, 0.5};
  const dsw_volume_id marked = volume_at(2);
  dsw_volume_id volume;
  dsw_location location = DSW_LOCATION_NONE;
  CHECK_OK(dsw_environment_mark_volumes(g_env, &marked, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_locate(g_env, point, no_volume, &volume, &location));
  CHECK(volume.index == 2 && location == DSW_LOCATION_IMPASSABLE);
  CHECK_OK(dsw_environment_mark_volumes(g_env, &marked, 1, DSW_MARK_PASSABLE, 0, NULL));
}

static void many_points_are_located(void) {
  const double points[12] = {0.5, 0.5, 0.5, 0, 9, 9, 9, 0, 3.5, 1.5, 1.5, 0};
  const dsw_volume_id hints[3] = {{0, 0}, {3, 1}, {0, 1}};
  const dsw_volume_id bad_hints[3] = {{0, 0}, {3, 1}, {16, 1}};
  dsw_volume_id volumes[3];
  dsw_location locations[3];
  CHECK_OK(dsw_environment_locate_points(g_env, points, 3, 32, hints, volumes, locations));
  CHECK(volumes[0].index == 0 && volumes[0].generation == 1 && locations[0] == DSW_LOCATION_PASSABLE);
  CHECK(volumes[1].generation == 0 && locations[1] == DSW_LOCATION_OUTSIDE);
  CHECK(volumes[2].index == 15 && locations[2] == DSW_LOCATION_PASSABLE);
  CHECK_OK(dsw_environment_locate_points(g_env, points, 1, 0, NULL, volumes, NULL));
  CHECK_OK(dsw_environment_locate_points(g_env, NULL, 0, 0, NULL, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_locate_points(g_env, points, 3, 32, bad_hints, volumes, locations));
  CHECK_MESSAGE("hints[2] {index 16, generation 1}");
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_locate_points(g_env, points, 3, 16, NULL, volumes, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_locate_points(g_env, points, 3, 33, NULL, volumes, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE,
              dsw_environment_locate_points(g_env, points, SIZE_MAX / 16, 24, NULL, volumes, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_locate_points(g_env, NULL, 3, 0, NULL, volumes, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_locate_points(g_env, points, 3, 0, NULL, NULL, NULL));
}

static void a_non_finite_point_of_many_is_named(void) {
  double points[60];
  dsw_volume_id volumes[20];
  size_t i;
  memset(volumes, 0x55, sizeof volumes);
  for (i = 0; i < 60; ++i) points[i] = 0.5;
  points[3 * 17 + 2] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_locate_points(g_env, points, 20, 0, NULL, volumes, NULL));
  CHECK_MESSAGE("points[17][2] is nan, must be finite");
  CHECK(volumes[0].index == 0x55555555u);
  CHECK_OK(dsw_environment_locate_points(g_env, points, 10, 48, NULL, volumes, NULL)); /* skips every second point */
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_locate_points(g_env, points + 3, 9, 48, NULL, volumes, NULL));
  CHECK_MESSAGE("points[8][2] is nan");
}

static void what_a_point_lies_on_is_told(void) {
  const double inside[3] = {0.5, 0.5, 0.5}, on_face[3] = {1, 0.5, 0.5}, on_edge[3] = {1, 1, 0.5},
               on_vertex[3] = {1, 1, 1}, away[3] = {1.5, 0.5, 0.5}, bad[3] = {NAN, 0, 0};
  dsw_cell cell;
  CHECK_OK(dsw_environment_classify(g_env, inside, volume_at(0), &cell));
  CHECK(cell.kind == DSW_CELL_VOLUME && cell.index == 0 && cell.generation == 1 && cell.local == 0);
  CHECK_OK(dsw_environment_classify(g_env, on_face, volume_at(1), &cell));
  CHECK(cell.kind == DSW_CELL_FACE && cell.index == 0 && cell.local == FACE_X1);
  CHECK_OK(dsw_environment_classify(g_env, on_edge, volume_at(5), &cell));
  CHECK(cell.kind == DSW_CELL_EDGE && cell.index == 0 && cell.generation == 1);
  CHECK_OK(dsw_environment_classify(g_env, on_vertex, volume_at(5), &cell));
  CHECK(cell.kind == DSW_CELL_VERTEX && cell.index == 1 + 5 * (1 + 3) && cell.local == 0);
  CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_environment_classify(g_env, away, volume_at(0), &cell));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_classify(g_env, bad, volume_at(0), &cell));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_classify(g_env, inside, no_volume, &cell));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_classify(g_env, NULL, volume_at(0), &cell));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_classify(g_env, inside, volume_at(0), NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_classify(NULL, inside, volume_at(0), &cell));
}

static const double g_from[3] = {0.5, 0.5, 0.5};

static int is_null_contact(const dsw_flight *f) {
  return f->contact.normal[0] == 0 && f->contact.normal[1] == 0 && f->contact.normal[2] == 0 &&
         f->contact.wall.generation == 0 && f->contact.behind.generation == 0 && f->contact.kind == DSW_CONTACT_NONE &&
         f->contact.marked_kind == DSW_CELL_NONE && f->contact.tag == 0;
}

static void a_free_cast_reaches_its_target(void) {
  const double to[3] = {3.25, 0.75, 0.5};
  dsw_flight f;
  CHECK_OK(dsw_environment_cast(g_env, no_volume, g_from, to, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_REACHED && f.time == 1 && f.volume.index == 3 && f.volumes_visited == 4);
  CHECK(memcmp(f.position, to, sizeof to) == 0 && is_null_contact(&f));
}

static void a_cast_stops_at_the_outer_boundary(void) {
  const double to[3] = {8.5, 0.5, 0.5};
  dsw_flight f;
  CHECK_OK(dsw_environment_cast(g_env, volume_at(0), g_from, to, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.contact.kind == DSW_CONTACT_PLANE &&
        f.contact.marked_kind == DSW_CELL_FACE);
  CHECK(f.time == 0.4375 && f.position[0] == 4 && f.position[1] == 0.5);
  CHECK(f.contact.normal[0] == -1 && f.contact.normal[1] == 0 && f.contact.normal[2] == 0);
  CHECK(f.volume.index == 3 && f.contact.wall.volume == 3 && f.contact.wall.local == FACE_X1 &&
        f.contact.wall.generation == 1);
  CHECK(f.contact.behind.generation == 0 && f.contact.tag == 103 && f.volumes_visited == 4);
}

static void a_cast_tells_what_makes_a_face_impassable(void) {
  const double to[3] = {3.5, 0.5, 0.5};
  const dsw_volume_id wall = volume_at(2);
  const dsw_face_id face = face_at(2, FACE_X0);
  dsw_flight f;
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_cast(g_env, volume_at(0), g_from, to, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.contact.marked_kind == DSW_CELL_VOLUME && f.contact.behind.index == 2 &&
        f.contact.tag == 102);
  CHECK(f.contact.wall.volume == 1 && f.contact.wall.local == FACE_X1 && f.volume.index == 1 && f.time == 0.5);
  CHECK_OK(dsw_environment_mark_faces(g_env, &face, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_cast(g_env, volume_at(0), g_from, to, NULL, &f));
  CHECK(f.contact.marked_kind == DSW_CELL_FACE && f.contact.behind.index == 2);
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_PASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_cast(g_env, volume_at(0), g_from, to, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.contact.marked_kind == DSW_CELL_FACE);
  CHECK_OK(dsw_environment_mark_faces(g_env, &face, 1, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_environment_cast(g_env, volume_at(0), g_from, to, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_REACHED);
}

static void a_cast_without_a_start_says_so(void) {
  const double outside[3] = {-1, 0.5, 0.5};
  const dsw_volume_id wall = volume_at(0);
  dsw_cast_options known;
  dsw_flight f;
  dsw_cast_options_init(&known, sizeof known);
  known.flags = DSW_CAST_START_KNOWN;
  CHECK_OK(dsw_environment_cast(g_env, no_volume, outside, g_from, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_OUTSIDE && f.volume.generation == 0 && f.volumes_visited == 0 && f.time == 0);
  CHECK(memcmp(f.position, outside, sizeof outside) == 0);
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_cast(g_env, no_volume, g_from, outside, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_IMPASSABLE && f.volume.index == 0 && f.volume.generation == 1);
  CHECK_OK(dsw_environment_cast(g_env, volume_at(0), g_from, outside, &known, &f));
  CHECK(f.outcome == DSW_OUTCOME_IMPASSABLE);
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_PASSABLE, 0, NULL));
}

static void options_are_obeyed(void) {
  const double to[3] = {8.5, 0.5, 0.5};
  dsw_cast_options o;
  dsw_flight f;
  dsw_cast_options_init(&o, sizeof o);
  o.max_volumes = 3;
  CHECK_OK(dsw_environment_cast(g_env, volume_at(0), g_from, to, &o, &f));
  CHECK(f.outcome == DSW_OUTCOME_WORK_LIMIT && f.volumes_visited == 3 && f.volume.index == 2);
  CHECK(f.time == 0.1875 && f.position[0] == 2 && is_null_contact(&f));
  o.max_volumes = 1;
  CHECK_OK(dsw_environment_cast(g_env, volume_at(0), g_from, to, &o, &f));
  CHECK(f.outcome == DSW_OUTCOME_WORK_LIMIT && f.time == 0 && memcmp(f.position, g_from, sizeof g_from) == 0);
  o.max_volumes = 0;
  o.flags = DSW_CAST_NO_DETAIL | DSW_CAST_START_KNOWN;
  memset(&f, 0x55, sizeof f);
  CHECK_OK(dsw_environment_cast(g_env, volume_at(0), g_from, to, &o, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.volume.index == 3 && f.volumes_visited == 4);
  CHECK(f.time == 0 && f.position[0] == 0 && is_null_contact(&f));
  o.flags = 0x10;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_cast(g_env, volume_at(0), g_from, to, &o, &f));
  CHECK_MESSAGE("options->flags is 0x10");
  o.flags = 0;
  o.reserved = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_cast(g_env, volume_at(0), g_from, to, &o, &f));
  o.reserved = 0;
  o.struct_size = sizeof o - 4;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_cast(g_env, volume_at(0), g_from, to, &o, &f));
}

static void options_of_a_newer_header_are_understood(void) {
  struct {
    dsw_cast_options known;
    uint32_t unknown;
  } o;
  dsw_flight f;
  memset(&o, 0, sizeof o);
  o.known.struct_size = sizeof o;
  CHECK_OK(dsw_environment_cast(g_env, volume_at(0), g_from, g_from, &o.known, &f));
  o.unknown = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_cast(g_env, volume_at(0), g_from, g_from, &o.known, &f));
  CHECK_MESSAGE("non-zero byte at 16");
}

static void bad_casts_change_nothing(void) {
  const double bad[3] = {0, NAN, 0};
  dsw_flight f, before;
  memset(&f, 0x55, sizeof f);
  before = f;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_cast(g_env, no_volume, bad, g_from, NULL, &f));
  CHECK_MESSAGE("from[1] is nan");
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_cast(g_env, no_volume, g_from, bad, NULL, &f));
  CHECK_MESSAGE("to[1] is nan");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_cast(g_env, stale_volume, g_from, g_from, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cast(NULL, no_volume, g_from, g_from, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cast(g_env, no_volume, NULL, g_from, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cast(g_env, no_volume, g_from, NULL, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cast(g_env, no_volume, g_from, g_from, NULL, NULL));
  CHECK(memcmp(&f, &before, sizeof f) == 0);
}

static void far_targets_are_values(void) {
  const double far_away[3] = {1e300, -1e300, 1e300}, from[3] = {0.5, 0.5, 0.5};
  dsw_flight f;
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, far_away, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.time >= 0 && f.time < 1e-299);
  CHECK(f.position[0] >= 0 && f.position[0] <= 4 && f.position[1] >= 0 && f.position[1] <= 2);
}

/* Segments that cross the environment in many ways, casts shared out in several ways. */
static void batches_are_the_same_for_any_sharing(void) {
  enum { COUNT = 5000 };
  dsw_context_desc d;
  dsw_context *threads = NULL;
  host h;
  dsw_context *const own = make_context(&h);
  dsw_environment *env[3];
  double *const from = (double *)malloc(COUNT * 3 * sizeof(double)), *const to =
                                                                         (double *)malloc(COUNT * 3 * sizeof(double));
  dsw_flight *const flights = (dsw_flight *)malloc(2 * COUNT * sizeof(dsw_flight));
  dsw_volume_id *const starts = (dsw_volume_id *)malloc(COUNT * sizeof(dsw_volume_id));
  uint32_t random = 12345;
  size_t i, k;
  for (i = 0; i < 3 * COUNT; ++i) {
    random = random * 1664525u + 1013904223u;
    from[i] = (random >> 16) % 128 / (i % 3 == 0 ? 32.0 : 64.0);
    random = random * 1664525u + 1013904223u;
    to[i] = (random >> 16) % 256 / 32.0 - 2;
  }
  memset(flights, 0, 2 * COUNT * sizeof(dsw_flight));
  dsw_context_desc_init(&d, sizeof d);
  d.thread_count = 4;
  CHECK_OK(dsw_context_create(&d, &threads));
  env[0] = g_env;
  env[1] = make_environment(threads, 4, 2, 2);
  env[2] = make_environment(own, 4, 2, 2);
  for (k = 0; k < 3; ++k) {
    CHECK_OK(dsw_environment_cast_segments(env[k], COUNT, NULL, from, to, 0, NULL, flights + (k == 0 ? 0 : COUNT)));
    if (k != 0) CHECK(memcmp(flights, flights + COUNT, COUNT * sizeof(dsw_flight)) == 0);
  }
  CHECK(h.parallel_calls == 1 && h.tasks > 1);
  for (i = 0; i < COUNT; i += 101) { /* and the same as one by one */
    dsw_flight one;
    memset(&one, 0, sizeof one);
    CHECK_OK(dsw_environment_cast(g_env, no_volume, from + 3 * i, to + 3 * i, NULL, &one));
    CHECK(memcmp(&one, flights + i, sizeof one) == 0);
  }
  CHECK_OK(dsw_environment_locate_points(g_env, from, COUNT, 0, NULL, starts, NULL));
  memset(flights + COUNT, 0, COUNT * sizeof(dsw_flight));
  CHECK_OK(dsw_environment_cast_segments(env[1], COUNT, starts, from, to, 0, NULL, flights + COUNT));
  CHECK(memcmp(flights, flights + COUNT, COUNT * sizeof(dsw_flight)) == 0);
  CHECK_OK(dsw_environment_destroy(env[1]));
  CHECK_OK(dsw_environment_destroy(env[2]));
  CHECK_OK(dsw_context_destroy(threads));
  CHECK_OK(dsw_context_destroy(own));
  free(from);
  free(to);
  free(flights);
  free(starts);
}

static void bad_batches_change_nothing(void) {
  const double points[6] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5};
  const double bad[6] = {0.5, 0.5, 0.5, 1.5, 0.5, NAN};
  const dsw_volume_id starts[2] = {{0, 1}, {16, 1}};
  dsw_flight f[2], before[2];
  memset(f, 0x55, sizeof f);
  memcpy(before, f, sizeof f);
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_cast_segments(g_env, 2, NULL, bad, points, 0, NULL, f));
  CHECK_MESSAGE("from[1][2] is nan");
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_cast_segments(g_env, 2, NULL, points, bad, 0, NULL, f));
  CHECK_MESSAGE("to[1][2] is nan");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_cast_segments(g_env, 2, starts, points, points, 0, NULL, f));
  CHECK_MESSAGE("starts[1] {index 16, generation 1}");
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_cast_segments(g_env, 2, NULL, points, points, 8, NULL, f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cast_segments(NULL, 2, NULL, points, points, 0, NULL, f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cast_segments(g_env, 2, NULL, NULL, points, 0, NULL, f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cast_segments(g_env, 2, NULL, points, NULL, 0, NULL, f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cast_segments(g_env, 2, NULL, points, points, 0, NULL, NULL));
  CHECK(memcmp(f, before, sizeof f) == 0);
  CHECK_OK(dsw_environment_cast_segments(g_env, 0, NULL, NULL, NULL, 0, NULL, NULL));
}

static void a_path_lists_the_volumes_in_order(void) {
  const double to[3] = {8.5, 0.5, 0.5};
  dsw_crossing path[4];
  dsw_flight f;
  size_t count = 0, i;
  CHECK_OK(dsw_environment_cast_path(g_env, no_volume, g_from, to, NULL, NULL, 0, &count, &f));
  CHECK(count == 4 && f.outcome == DSW_OUTCOME_CONTACT);
  CHECK_OK(dsw_environment_cast_path(g_env, no_volume, g_from, to, NULL, path, 4, &count, NULL));
  CHECK(count == 4 && path[0].volume.index == 0 && path[0].face.generation == 0 && path[0].time == 0);
  for (i = 1; i < 4; ++i) {
    CHECK(path[i].volume.index == i && path[i].volume.generation == 1);
    CHECK(path[i].face.volume == i - 1 && path[i].face.local == FACE_X1 && path[i].time == ((double)i - 0.5) / 8);
  }
  memset(path, 0x55, sizeof path);
  memset(&f, 0x55, sizeof f);
  count = 0;
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL,
              dsw_environment_cast_path(g_env, no_volume, g_from, to, NULL, path, 3, &count, &f));
  CHECK(count == 4 && path[0].volume.index == 0x55555555u && f.volumes_visited == 0x55555555u);
}

static void a_path_without_a_start_is_empty(void) {
  const double outside[3] = {-1, 0.5, 0.5};
  dsw_crossing path[4];
  dsw_flight f;
  size_t count = 9;
  CHECK_OK(dsw_environment_cast_path(g_env, no_volume, outside, g_from, NULL, path, 4, &count, &f));
  CHECK(count == 0 && f.outcome == DSW_OUTCOME_OUTSIDE);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT,
              dsw_environment_cast_path(g_env, no_volume, g_from, g_from, NULL, NULL, 1, &count, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT,
              dsw_environment_cast_path(g_env, no_volume, g_from, g_from, NULL, path, 4, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT,
              dsw_environment_cast_path(NULL, no_volume, g_from, g_from, NULL, path, 4, &count, &f));
  CHECK_FAILS(DSW_STATUS_STALE_ID,
              dsw_environment_cast_path(g_env, stale_volume, g_from, g_from, NULL, path, 4, &count, &f));
}

static void the_nearest_impassable_thing_is_found(void) {
  const double point[3] = {1.25, 0.5, 0.625}, outside[3] = {-1, 0, 0}, bad[3] = {0, 0, INFINITY};
  const dsw_face_id wall = face_at(1, FACE_X0);
  const dsw_volume_id solid = volume_at(1);
  dsw_nearest n;
  CHECK_OK(dsw_environment_find_nearest(g_env, point, no_volume, INFINITY, &n));
  CHECK(n.distance == 0.5 && n.cell.kind == DSW_CELL_FACE && n.cell.index == 1 && n.cell.local == FACE_Y0);
  CHECK(n.point[0] == 1.25 && n.point[1] == 0 && n.point[2] == 0.625 && n.normal[1] == 1 && n.tag == 101);
  CHECK_OK(dsw_environment_mark_faces(g_env, &wall, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_find_nearest(g_env, point, volume_at(1), 0.25, &n));
  CHECK(n.distance == 0.25 && n.cell.index == 0 && n.cell.local == FACE_X1 && n.normal[0] == 1);
  CHECK(n.volumes_visited >= 1);
  CHECK_OK(dsw_environment_find_nearest(g_env, point, volume_at(1), 0.125, &n));
  CHECK(n.distance == HUGE_VAL && n.cell.kind == DSW_CELL_NONE && n.normal[0] == 0);
  CHECK_OK(dsw_environment_mark_faces(g_env, &wall, 1, DSW_MARK_PASSABLE));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_find_nearest(g_env, point, no_volume, -1, &n));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_find_nearest(g_env, point, no_volume, NAN, &n));
  CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_environment_find_nearest(g_env, outside, no_volume, 1, &n));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_find_nearest(g_env, bad, no_volume, 1, &n));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_find_nearest(g_env, point, stale_volume, 1, &n));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_nearest(g_env, NULL, no_volume, 1, &n));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_nearest(g_env, point, no_volume, 1, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_nearest(NULL, point, no_volume, 1, &n));
  CHECK_OK(dsw_environment_mark_volumes(g_env, &solid, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_FAILS(DSW_STATUS_IMPASSABLE, dsw_environment_find_nearest(g_env, point, no_volume, 1, &n));
  CHECK_OK(dsw_environment_mark_volumes(g_env, &solid, 1, DSW_MARK_PASSABLE, 0, NULL));
}

static void what_is_nearest_to_many_points_is_found(void) {
  const double points[16] = {1.25, 0.5, 0.625, 9, 9, 9, 9, 9, 2.5, 0.5, 0.5, 9, 1.25, 0.75, 0.625, 9};
  const dsw_volume_id solid = volume_at(2);
  dsw_volume_id volumes[4] = {{0, 0}, {3, 1}, {0, 1}, {0, 0}};
  dsw_location locations[4];
  dsw_nearest n[4], one;
  CHECK_OK(dsw_environment_mark_volumes(g_env, &solid, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_find_nearest_to_points(g_env, points, 4, 32, volumes, INFINITY, n, volumes, locations));
  CHECK(n[0].distance == 0.5 && n[0].cell.index == 1 && n[0].cell.local == FACE_Y0 && n[0].tag == 101);
  CHECK(volumes[0].index == 1 && locations[0] == DSW_LOCATION_PASSABLE);
  CHECK(n[1].distance == HUGE_VAL && n[1].cell.kind == DSW_CELL_NONE && n[1].volumes_visited == 0);
  CHECK(volumes[1].generation == 0 && locations[1] == DSW_LOCATION_OUTSIDE);
  CHECK(n[2].distance == HUGE_VAL && n[2].cell.kind == DSW_CELL_NONE && n[2].normal[0] == 0);
  CHECK(volumes[2].index == 2 && locations[2] == DSW_LOCATION_IMPASSABLE);
  CHECK_OK(dsw_environment_find_nearest(g_env, points + 12, volumes[3], INFINITY, &one));
  CHECK(memcmp(&one, &n[3], sizeof one) == 0);
  CHECK_OK(dsw_environment_find_nearest_to_points(g_env, points, 1, 0, NULL, 0.25, n, NULL, NULL));
  CHECK(n[0].distance == HUGE_VAL);
  CHECK_OK(dsw_environment_mark_volumes(g_env, &solid, 1, DSW_MARK_PASSABLE, 0, NULL));
}

/* Between the walls y = 0 and y = 2 and along them, through a wall and behind it. */
static void what_is_nearest_to_segments_is_found(void) {
  const double from[12] = {1.25, 0.25, 0.75, 0.5, 0.75, 1, 0.5, 0.75, 1, 9, 9, 9};
  const double to[12] = {1.75, 0.5, 0.75, 0.75, 0.75, 1, 1.5, 0.75, 1, 0.5, 0.5, 0.5};
  const dsw_face_id wall = face_at(0, FACE_X1);
  dsw_volume_id volumes[4];
  dsw_location locations[4];
  dsw_segment_nearest n[4];
  size_t i;
  CHECK_OK(dsw_environment_find_nearest_to_segments(g_env, 4, NULL, from, to, 0, INFINITY, n, volumes, locations));
  CHECK(n[0].nearest.distance == 0.25 && n[0].nearest.cell.index == 1 && n[0].nearest.cell.local == FACE_Y0);
  CHECK(n[0].segment_parameter == 0 && n[0].segment_point[0] == 1.25 && n[0].segment_point[1] == 0.25);
  CHECK(n[0].nearest.point[0] == 1.25 && n[0].nearest.point[1] == 0 && n[0].nearest.normal[1] == 1);
  CHECK(n[0].nearest.tag == 101 && volumes[0].index == 1 && locations[0] == DSW_LOCATION_PASSABLE);
  CHECK(n[1].nearest.distance == 0.5 && n[1].nearest.cell.local == FACE_X0 && n[1].segment_parameter == 0);
  CHECK(n[2].nearest.distance == 0.5);
  CHECK(n[3].nearest.distance == HUGE_VAL && n[3].nearest.cell.kind == DSW_CELL_NONE && n[3].segment_parameter == 0);
  CHECK(n[3].segment_point[0] == 0 && volumes[3].generation == 0 && locations[3] == DSW_LOCATION_OUTSIDE);
  CHECK_OK(dsw_environment_mark_faces(g_env, &wall, 1, DSW_MARK_IMPASSABLE));
  for (i = 0; i < 2; ++i) { /* a radius of 0 finds what is passed, too */
    CHECK_OK(dsw_environment_find_nearest_to_segments(g_env, 2, NULL, from + 3, to + 3, 0, i == 0 ? INFINITY : 0.25, n,
                                                      NULL, NULL));
    CHECK(n[0].nearest.distance == 0.25 && n[0].nearest.cell.local == FACE_X1 && n[0].segment_parameter == 1);
    CHECK(n[0].nearest.normal[0] == -1 && n[0].segment_point[0] == 0.75 && n[0].nearest.point[0] == 1);
  }
  CHECK_OK(dsw_environment_find_nearest_to_segments(g_env, 1, NULL, from + 6, to + 6, 0, 0, n, NULL, NULL));
  CHECK(n[0].nearest.distance == 0 && n[0].segment_parameter == 0.5 && n[0].segment_point[0] == 1);
  CHECK(n[0].nearest.normal[0] == 0 && n[0].nearest.point[0] == 1 && n[0].nearest.cell.kind == DSW_CELL_FACE);
  CHECK_OK(dsw_environment_mark_faces(g_env, &wall, 1, DSW_MARK_PASSABLE));
}

static void bad_questions_for_what_is_nearest_change_nothing(void) {
  const double points[6] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5}, bad[6] = {0.5, 0.5, 0.5, 1.5, 0.5, NAN};
  const dsw_volume_id hints[2] = {{0, 1}, {16, 1}};
  dsw_nearest p[2], before_p[2];
  dsw_segment_nearest s[2], before_s[2];
  memset(p, 0x55, sizeof p);
  memset(s, 0x55, sizeof s);
  memcpy(before_p, p, sizeof p);
  memcpy(before_s, s, sizeof s);
#define POINTS(env, array, stride, ids, radius, out) \
  dsw_environment_find_nearest_to_points(env, array, 2, stride, ids, radius, out, NULL, NULL)
  CHECK_FAILS(DSW_STATUS_NON_FINITE, POINTS(g_env, bad, 0, NULL, 1, p));
  CHECK_MESSAGE("points[1][2] is nan");
  CHECK_FAILS(DSW_STATUS_STALE_ID, POINTS(g_env, points, 0, hints, 1, p));
  CHECK_MESSAGE("hints[1] {index 16, generation 1}");
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, POINTS(g_env, points, 0, NULL, -1, p));
  CHECK_MESSAGE("radius is -1, must be at least 0");
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, POINTS(g_env, points, 0, NULL, NAN, p));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, POINTS(g_env, points, 8, NULL, 1, p));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, POINTS(NULL, points, 0, NULL, 1, p));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, POINTS(g_env, NULL, 0, NULL, 1, p));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, POINTS(g_env, points, 0, NULL, 1, NULL));
#undef POINTS
#define SEGMENTS(env, from, to, stride, ids, radius, out) \
  dsw_environment_find_nearest_to_segments(env, 2, ids, from, to, stride, radius, out, NULL, NULL)
  CHECK_FAILS(DSW_STATUS_NON_FINITE, SEGMENTS(g_env, bad, points, 0, NULL, 1, s));
  CHECK_MESSAGE("from[1][2] is nan");
  CHECK_FAILS(DSW_STATUS_NON_FINITE, SEGMENTS(g_env, points, bad, 0, NULL, 1, s));
  CHECK_MESSAGE("to[1][2] is nan");
  CHECK_FAILS(DSW_STATUS_STALE_ID, SEGMENTS(g_env, points, points, 0, hints, 1, s));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, SEGMENTS(g_env, points, points, 0, NULL, -1, s));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, SEGMENTS(g_env, points, points, 0, NULL, NAN, s));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, SEGMENTS(g_env, points, points, 8, NULL, 1, s));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SEGMENTS(NULL, points, points, 0, NULL, 1, s));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SEGMENTS(g_env, NULL, points, 0, NULL, 1, s));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SEGMENTS(g_env, points, NULL, 0, NULL, 1, s));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SEGMENTS(g_env, points, points, 0, NULL, 1, NULL));
#undef SEGMENTS
  CHECK(memcmp(p, before_p, sizeof p) == 0 && memcmp(s, before_s, sizeof s) == 0);
  CHECK_OK(dsw_environment_find_nearest_to_points(g_env, NULL, 0, 0, NULL, 1, NULL, NULL, NULL));
  CHECK_OK(dsw_environment_find_nearest_to_segments(g_env, 0, NULL, NULL, NULL, 0, 1, NULL, NULL, NULL));
}

static void signed_distances_are_negative_inside(void) {
  dsw_environment *const e = make_environment(NULL, 4, 2, 2);
  static double many[3 * 64], signs[64];
  const double at[12] = {1.75, 1, 1.5, 5, 1, 1, 5, 3, 3, 4, 1, 1}, tiny[6] = {-1e-170, 1, 1, 1, 5e-324, 1};
  double d[4] = {7, 7, 7, 7}, bad[3] = {0, NAN, 0};
  dsw_nearest n[4];
  unsigned i;
  CHECK_OK(set_volume_mark(e, 0, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_find_signed_distances(e, at, 4, 0, d, n));
  CHECK(d[0] == -0.5 && d[1] == 1 && d[2] == sqrt(3.0) && d[3] == 0);
  CHECK(n[0].distance == 0.5 && n[0].point[2] == 2 && n[0].cell.kind == DSW_CELL_FACE && n[0].normal[2] == -1);
  CHECK(n[1].point[0] == 4 && n[1].normal[0] == 1 && n[1].tag == 103 && n[3].normal[0] == 0);
  /* Enough points for a tree, and points without one, have the same answers. */
  for (i = 0; i < 3 * 64; ++i) many[i] = (double)(i * 37 % 101) / 16 - 1;
  CHECK_OK(dsw_environment_find_signed_distances(e, many, 64, 0, signs, NULL));
  for (i = 0; i < 64; ++i) {
    CHECK_OK(dsw_environment_find_signed_distances(e, many + 3 * i, 1, 0, d, NULL));
    CHECK(d[0] == signs[i]);
  }
  CHECK_OK(dsw_environment_find_signed_distances(e, tiny, 2, 0, d, n)); /* their squares are no doubles */
  CHECK(d[0] == 1e-170 && n[0].normal[0] == -1 && d[1] == -5e-324 && n[1].normal[1] == 1 && n[1].distance == 5e-324);
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_find_signed_distances(e, bad, 1, 0, d, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_signed_distances(e, at, 1, 0, NULL, n));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_signed_distances(NULL, at, 1, 0, d, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_find_signed_distances(e, at, 2, 4, d, NULL));
  CHECK_OK(dsw_environment_find_signed_distances(e, NULL, 0, 0, NULL, NULL));
  CHECK_OK(dsw_environment_destroy(e));
}

/* Most points of a slanted side are rounded off it. The way back is rounded, too, often to nothing. */
static void what_is_rounded_off_a_slanted_side_has_its_normal(void) {
  static const double points[6] = {0.1, 0.2, 1.3, 0.9, 0.3, 1.1};
  static const int64_t cell[3] = {0, 1, 2};
  const dsw_environment_desc desc = polygons_desc(points, 3, DSW_CELL_TYPE_TRIANGLE, cell, 1);
  const double size = sqrt(1.2 * 1.2 + 0.7 * 0.7);
  dsw_environment *e = NULL;
  unsigned i, off = 0;
  CHECK(create_reported(&desc, &e).status == DSW_STATUS_OK);
  for (i = 1; i < 256; ++i) {
    const double at[2] = {0.1 + i / 256.0 * 1.2, 0.2 + i / 256.0 * 0.7};
    double d = 7;
    dsw_nearest n;
    CHECK_OK(dsw_environment_find_signed_distances(e, at, 1, 0, &d, &n));
    if (d == 0) continue;
    CHECK(fabs(d) < 1e-15 && n.distance == fabs(d));
    CHECK(fabs(n.normal[0] * size - (d > 0 ? 0.7 : -0.7)) < 1e-14);
    CHECK(fabs(n.normal[1] * size - (d > 0 ? -1.2 : 1.2)) < 1e-14);
    ++off;
  }
  CHECK(off > 0);
  CHECK_OK(dsw_environment_destroy(e));
}

/* Volumes that hold nothing may lose their points. */
static void nothing_is_near_a_boundary_without_places(void) {
  dsw_environment *const e = make_squares(NULL, 2, 1);
  dsw_scene *const scene = make_scene(e, DSW_FEATURE_DEFORMING);
  const double at[2] = {0.5, 0.5};
  double next[12], d = 7;
  dsw_nearest n;
  unsigned i;
  for (i = 0; i < 12; ++i) next[i] = NAN;
  CHECK_OK(dsw_environment_deform(e, next, 6, NULL, NULL));
  CHECK_OK(dsw_environment_find_signed_distances(e, at, 1, 0, &d, &n));
  CHECK(d == HUGE_VAL && n.distance == HUGE_VAL && n.cell.kind == DSW_CELL_NONE && n.normal[0] == 0);
  end_scene(scene);
}

static void signed_distances_in_the_plane(void) {
  dsw_environment *const e = make_squares(NULL, 4, 2);
  const double at[8] = {1.75, 1.5, 5, 1, 5, 3, 4, 1};
  double d[4];
  CHECK_OK(dsw_environment_find_signed_distances(e, at, 4, 0, d, NULL));
  CHECK(d[0] == -0.5 && d[1] == 1 && d[2] == sqrt(2.0) && d[3] == 0);
  CHECK_OK(dsw_environment_destroy(e));
}

int main(void) {
  g_env = make_environment(NULL, 4, 2, 2);
  init_writes_the_defaults();
  a_point_is_located();
  a_point_in_an_impassable_volume_says_so();
  many_points_are_located();
  a_non_finite_point_of_many_is_named();
  what_a_point_lies_on_is_told();
  a_free_cast_reaches_its_target();
  a_cast_stops_at_the_outer_boundary();
  a_cast_tells_what_makes_a_face_impassable();
  a_cast_without_a_start_says_so();
  options_are_obeyed();
  options_of_a_newer_header_are_understood();
  bad_casts_change_nothing();
  far_targets_are_values();
  batches_are_the_same_for_any_sharing();
  bad_batches_change_nothing();
  a_path_lists_the_volumes_in_order();
  a_path_without_a_start_is_empty();
  the_nearest_impassable_thing_is_found();
  what_is_nearest_to_many_points_is_found();
  what_is_nearest_to_segments_is_found();
  bad_questions_for_what_is_nearest_change_nothing();
  CHECK_OK(dsw_environment_destroy(g_env));
  signed_distances_are_negative_inside();
  signed_distances_in_the_plane();
  nothing_is_near_a_boundary_without_places();
  what_is_rounded_off_a_slanted_side_has_its_normal();
  return check_result();
}
