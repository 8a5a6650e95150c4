/* Bodies that are created where they are not free, in space and in the plane. tests/property/penetrations_test.cpp
   compares what they cross, and what they are once they are freed, with exact truth. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 2 x 2 cubes, or 4 x 2 squares */
static dsw_scene *g_scene;
static unsigned g_dimension;

static void begin(uint32_t features) {
  g_env = g_dimension == 3 ? make_environment(NULL, 4, 2, 2) : make_squares(NULL, 4, 2);
  g_scene = make_scene(g_env, features);
}

/* Vertices from x and y; the height counts in space alone. */
static void put_all(double *at, const double *xy, size_t count) {
  size_t i;
  for (i = 0; i < count; ++i) {
    at[i * g_dimension] = xy[2 * i];
    at[i * g_dimension + 1] = xy[2 * i + 1];
    if (g_dimension == 3) at[i * g_dimension + 2] = 0.75;
  }
}

static dsw_status create_wire(const double *xy, size_t count, uint32_t flags, double radius, dsw_body_id *body) {
  static double at[48];
  dsw_body_desc d;
  put_all(at, xy, count);
  d = line_desc(at, count, 0, DSW_LEVEL_EDGES_SWEPT);
  d.flags = flags;
  d.radius = radius;
  return dsw_body_create(g_scene, &d, body);
}

static dsw_body_id make_wire(const double *xy, size_t count, uint32_t flags) {
  dsw_body_id body = {0, 0};
  CHECK_OK(create_wire(xy, count, flags | DSW_BODY_START_PENETRATING, 0, &body));
  return body;
}

static uint32_t penetrates(dsw_body_id body) {
  uint32_t answer = 9;
  CHECK_OK(dsw_body_is_penetrating(g_scene, body, &answer));
  return answer;
}

static size_t list(dsw_body_id body, const dsw_penetration **all) {
  size_t count = 99;
  CHECK_OK(dsw_body_find_penetrations(g_scene, body, all, &count));
  return count;
}

static uint32_t free_body(dsw_body_id body, dsw_volume_id inside, double most, double *distance) {
  uint32_t freed = 9;
  CHECK_OK(dsw_body_depenetrate(g_scene, body, inside, most, &freed, distance));
  CHECK(penetrates(body) == 1 - freed);
  return freed;
}

static void positions(dsw_body_id body, double *at) {
  size_t count = 0;
  CHECK_OK(dsw_body_get_positions(g_scene, body, at, 16, 0, NULL, &count));
}

/* The last vertex is 0.25 above the top, y = 2. */
static const double g_poking[6] = {1.5, 0.5, 1.5, 1.25, 1.625, 2.25};

static void a_wire_that_pokes_through_the_wall(uint32_t features, uint32_t flags) {
  const dsw_penetration *all;
  double before[48], after[48], distance = -1;
  dsw_body_id body = {7, 7};
  dsw_body_counts c;
  dsw_body_vertex_id vertex;
  begin(features);
  CHECK_FAILS(DSW_STATUS_OUTSIDE, create_wire(g_poking, 3, flags, 0, &body));
  body = make_wire(g_poking, 3, flags);
  CHECK(penetrates(body) == 1);
  c = body_counts(g_scene, body);
  CHECK(c.vertex_count == 3 && c.edge_count == 2);
  CHECK_OK(dsw_body_get_vertex_id(g_scene, body, 2, &vertex));
  positions(body, before);
  CHECK(before[2 * g_dimension + 1] == 2.25);
  CHECK(list(body, &all) == 1);
  CHECK(all[0].part.edge.index == 1 && all[0].part.edge.generation == 1 && all[0].part.body.index == body.index);
  CHECK(all[0].wall.generation != 0 && all[0].other.body.generation == 0 && fabs(all[0].point[1] - 2) < 1e-12);
  CHECK(free_body(body, no_volume, 0.1, &distance) == 0 && distance == 0);
  positions(body, after);
  CHECK(memcmp(before, after, 3 * g_dimension * sizeof *before) == 0);
  CHECK(free_body(body, no_volume, 0, &distance) == 1);
  CHECK(distance >= 0.25 && distance <= 0.5);
  positions(body, after);
  CHECK(after[2 * g_dimension + 1] <= 2);
  CHECK((memcmp(before, after, 2 * g_dimension * sizeof *before) == 0) == ((flags & DSW_BODY_RIGID) == 0));
  CHECK(list(body, &all) == 0);
  CHECK(free_body(body, no_volume, 0, &distance) == 1 && distance == 0);
  CHECK_OK(dsw_body_move(g_scene, body, before, 3, 0, NULL, NULL));
  positions(body, after);
  CHECK(after[2 * g_dimension + 1] <= 2);
  end_scene(g_scene);
}

static void a_free_body_is_one_at_once(void) {
  const double wire[4] = {0.5, 0.5, 1.5, 0.5};
  const dsw_penetration *all;
  dsw_body_id body;
  begin(0);
  body = make_wire(wire, 2, 0);
  CHECK(penetrates(body) == 0 && list(body, &all) == 0);
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES));
  end_scene(g_scene);
}

static void nothing_meets_it_until_it_is_free(void) {
  double at[48], far_away[3] = {1.5, 1.5, 0.75}, start[3] = {1.25, 1, 0.75}, end[3] = {1.75, 1, 0.75}, gap;
  const double wire[4] = {1.25, 1, 1.75, 1};
  dsw_body_id body, other;
  dsw_body_vertex_id vertex = {0, 1};
  dsw_flight flight;
  dsw_contact_partner partner;
  size_t count = 0;
  begin(DSW_FEATURE_BODY_CONTACTS);
  body = make_wire(g_poking, 3, 0);
  positions(body, at);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_move(g_scene, body, at, 3, 0, NULL, NULL));
  CHECK_MESSAGE("dsw_body_depenetrate");
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_scene_move_bodies(g_scene, &body, 1, at, 3, 0, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_radius(g_scene, body, 0.1));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_find_least_gap(g_scene, body, 1, &gap));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_add_vertex(g_scene, body, far_away, no_volume, &vertex));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_remove_vertex(g_scene, body, vertex));
  CHECK_OK(dsw_scene_get_body_count(g_scene, &count));
  CHECK(count == 1);
  CHECK_OK(dsw_scene_cast(g_scene, 1, NULL, start, end, 0, NULL, &flight, &partner));
  CHECK(flight.outcome == DSW_OUTCOME_REACHED);
  CHECK_OK(set_volume_mark(g_env, 5, DSW_MARK_IMPASSABLE));
  CHECK_OK(set_volume_mark(g_env, 5, DSW_MARK_PASSABLE));
  CHECK_OK(create_wire(wire, 2, 0, 0, &other));
  CHECK_OK(dsw_body_destroy(g_scene, other));
  CHECK(free_body(body, no_volume, 0, NULL) == 1);
  CHECK_OK(dsw_scene_cast(g_scene, 1, NULL, start, end, 0, NULL, &flight, &partner));
  CHECK((flight.outcome == DSW_OUTCOME_CONTACT && partner.body.generation == body.generation));
  CHECK(set_volume_mark(g_env, 5, DSW_MARK_IMPASSABLE) == DSW_STATUS_OCCUPIED);
  CHECK_OK(dsw_body_destroy(g_scene, body));
  body = make_wire(g_poking, 3, 0);
  CHECK_OK(dsw_body_destroy(g_scene, body));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_find_least_gap(g_scene, body, 1, &gap));
  end_scene(g_scene);
}

/* The side of a thin wall at x = 2 is that of most vertices, or that of a volume. */
static void a_side_is_chosen(void) {
  const double wire[10] = {0.5, 0.5, 1, 0.5, 1.5, 0.5, 1.875, 0.5, 2.25, 0.5};
  double at[48], distance;
  const dsw_penetration *all;
  dsw_body_id body;
  uint32_t y, z;
  begin(0);
  for (y = 0; y < 2; ++y) {
    for (z = 0; z < g_dimension - 1; ++z)
      CHECK_OK(set_face_mark(g_env, 1 + 4 * (y + 2 * z), g_dimension == 3 ? FACE_X1 : 1, DSW_MARK_IMPASSABLE));
  }
  body = make_wire(wire, 5, 0);
  CHECK(list(body, &all) == 1 && all[0].wall.generation != 0 && all[0].part.edge.index == 3);
  CHECK(free_body(body, no_volume, 0, &distance) == 1 && distance >= 0.25 && distance < 0.3);
  positions(body, at);
  CHECK(at[4 * g_dimension] < 2 && at[3 * g_dimension] == 1.875);
  CHECK_OK(dsw_body_destroy(g_scene, body));
  body = make_wire(wire, 5, 0);
  CHECK(free_body(body, volume_at(2), 0, &distance) == 1);
  positions(body, at);
  CHECK(at[0] > 2 && at[4 * g_dimension] == 2.25);
  end_scene(g_scene);
}

static void a_body_behind_walls_needs_a_volume(void) {
  const double wire[4] = {1.25, 2.25, 1.75, 2.25};
  const uint32_t *left;
  const dsw_penetration *all;
  double at[48];
  size_t count;
  dsw_body_id body;
  begin(0);
  body = make_wire(wire, 2, 0);
  CHECK(list(body, &all) == 1 && all[0].wall.generation == 0 && all[0].part.edge.generation == 1);
  CHECK(free_body(body, no_volume, 0, NULL) == 0);
  CHECK_OK(dsw_scene_get_offending_edges(g_scene, &left, &count));
  CHECK(count == 1 && left[0] == 0 && left[1] == 1);
  CHECK(free_body(body, volume_at(5), 0, NULL) == 1);
  positions(body, at);
  CHECK(at[1] < 2 && at[g_dimension + 1] < 2 && at[1] > 1.9);
  end_scene(g_scene);
}

static const double g_corners[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};

/* A cube or a square of one unit, or a smaller one. */
static dsw_body_id make_box(double x, double y, double size, uint32_t flags) {
  static const uint32_t offsets[7] = {0, 4, 8, 12, 16, 20, 24},
                        corners[24] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
  double at[24];
  dsw_body_desc d;
  dsw_body_id body = {0, 0};
  size_t i;
  for (i = 0; i < (g_dimension == 3 ? 8u : 4u); ++i) {
    at[i * g_dimension] = x + size * g_corners[3 * i];
    at[i * g_dimension + 1] = y + size * g_corners[3 * i + 1];
    if (g_dimension == 3) at[i * g_dimension + 2] = 0.5 + size * g_corners[3 * i + 2];
  }
  d = g_dimension == 3 ? surface_desc(at, 8, offsets, corners, 6, DSW_LEVEL_FACES)
                       : line_desc(at, 4, 1, DSW_LEVEL_EDGES_SWEPT);
  d.flags = flags;
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  return body;
}

/* Two boxes that share a slab of a width leave each other by at most twice the width, whether they bend or not. */
static void boxes_leave_each_other(double width, uint32_t flags) {
  const dsw_penetration *all;
  dsw_body_id fixed, body;
  double distance = -1, before[24], after[24];
  size_t i, count;
  begin(DSW_FEATURE_BODY_CONTACTS);
  fixed = make_box(0.5, 0.5, 1, 0);
  body = make_box(1.5 - width, 0.5625, 0.75, flags | DSW_BODY_START_PENETRATING);
  CHECK(penetrates(body) == 1 && penetrates(fixed) == 0);
  count = list(body, &all);
  CHECK(count > 0);
  for (i = 0; i < count; ++i) CHECK(all[i].other.body.index == fixed.index && all[i].wall.generation == 0);
  positions(fixed, before);
  CHECK(free_body(body, no_volume, 0, &distance) == 1);
  CHECK(distance >= width && distance <= 2 * width);
  positions(fixed, after);
  CHECK(memcmp(before, after, (g_dimension == 3 ? 24 : 8) * sizeof *before) == 0);
  end_scene(g_scene);
}

static void a_thick_wire_keeps_off(void) {
  const double wire[6] = {0.5, 1.95, 1.5, 1.95, 2.5, 1.95};
  const dsw_penetration *all;
  dsw_body_id body;
  double gap = -1;
  begin(0);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, create_wire(wire, 3, 0, 0.125, &body));
  CHECK_OK(create_wire(wire, 3, DSW_BODY_START_PENETRATING, 0.125, &body));
  CHECK(list(body, &all) == 2 && all[0].wall.generation == 0);
  CHECK(free_body(body, no_volume, 0, NULL) == 1);
  CHECK_OK(dsw_body_find_least_gap(g_scene, body, 1, &gap));
  CHECK(gap > -1e-10);
  end_scene(g_scene);
}

static void snapshots_and_recordings_have_it(void) {
  static unsigned char block[1 << 18], again[1 << 18];
  static tape t;
  dsw_recording_desc d;
  dsw_replay *replay;
  dsw_replay_report report;
  dsw_scene *loaded, *first;
  size_t size = 0, other = 0, i;
  dsw_body_id body;
  double one[48], two[48];
  begin(DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_LIVE_CHANGES);
  body = make_wire(g_poking, 3, DSW_BODY_SELF_CONTACTS | DSW_BODY_SKIP_BY_CLEARANCE);
  CHECK_OK(dsw_scene_save(g_scene, block, sizeof block, &size));
  CHECK_OK(dsw_scene_load(g_env, block, size, &loaded));
  CHECK_OK(dsw_scene_save(loaded, again, sizeof again, &other));
  CHECK(size == other && memcmp(block, again, size) == 0);
  d = to_tape(&t);
  CHECK_OK(dsw_scene_start_recording(g_scene, &d));
  CHECK(free_body(body, no_volume, 0, NULL) == 1);
  positions(body, one);
  body = make_wire(g_poking, 3, 0);
  CHECK(free_body(body, no_volume, 0.125, NULL) == 0);
  CHECK_OK(dsw_scene_stop_recording(g_scene));
  first = g_scene;
  g_scene = loaded;
  body.index = 0;
  CHECK(free_body(body, no_volume, 0, NULL) == 1);
  positions(body, two);
  CHECK(memcmp(one, two, 3 * g_dimension * sizeof *one) == 0);
  g_scene = first;
  CHECK_OK(dsw_scene_destroy(loaded));
  CHECK_OK(dsw_replay_create(NULL, t.bytes, t.size, &replay));
  for (i = 0; i < 3; ++i) {
    CHECK_OK(dsw_replay_step(replay, &report));
    CHECK(report.outcome == DSW_REPLAY_SAME);
    CHECK(strcmp(report.function, i == 1 ? "dsw_body_create" : "dsw_body_depenetrate") == 0);
  }
  CHECK_OK(dsw_replay_destroy(replay));
  for (i = 0; i < size; i += 8) { /* damaged blocks are refused, or load: nothing else */
    memcpy(again, block, size);
    again[i] ^= 1;
    if (dsw_scene_load(g_env, again, size, &loaded) == DSW_STATUS_OK) CHECK_OK(dsw_scene_destroy(loaded));
  }
  end_scene(g_scene);
}

static void walls_may_move_meanwhile(void) {
  static double points[45 * 3];
  const dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
  const dsw_penetration *all;
  const double *now;
  dsw_body_id body;
  size_t count, i;
  begin(DSW_FEATURE_DEFORMING);
  body = make_wire(g_poking, 3, 0);
  CHECK_OK(dsw_environment_get_points(g_env, &now, &count));
  memcpy(points, now, count * g_dimension * sizeof *points);
  for (i = 0; i < count; ++i) points[i * g_dimension + 1] *= 1.25; /* the top goes up to 2.5 */
  CHECK_OK(dsw_environment_deform(g_env, points, count, &o, NULL));
  CHECK(penetrates(body) == 1 && list(body, &all) == 0);
  CHECK(free_body(body, no_volume, 0, NULL) == 1);
  end_scene(g_scene);
}

static void a_refusal_of_memory_leaves_the_body(void) {
  host h = {0};
  dsw_context *context = make_context(&h);
  dsw_body_id body;
  double before[48], after[48];
  uint32_t freed = 9;
  size_t n, refusals = 0;
  g_env = g_dimension == 3 ? make_environment(context, 4, 2, 2) : make_squares(context, 4, 2);
  g_scene = make_scene(g_env, DSW_FEATURE_BODY_CONTACTS);
  body = make_wire(g_poking, 3, DSW_BODY_SELF_CONTACTS);
  positions(body, before);
  for (n = 0; RUNS_OUT(&h, n, dsw_body_depenetrate(g_scene, body, no_volume, 0, &freed, NULL)); ++n) {
    ++refusals;
    CHECK(penetrates(body) == 1);
    positions(body, after);
    CHECK(memcmp(before, after, 3 * g_dimension * sizeof *before) == 0);
  }
  CHECK(refusals > 5 && freed == 1 && penetrates(body) == 0);
  end_scene(g_scene);
  end_context(context, &h);
}

static void bad_arguments_change_nothing(void) {
  const uint32_t left = DSW_BODY_SKIP_BACK_EDGES | DSW_BODY_LEAVE_BACK_EDGES | DSW_BODY_START_PENETRATING;
  const double odd[4] = {1.5, HUGE_VAL, 1.5, 1};
  const dsw_penetration *all = NULL;
  dsw_body_id body, gone = {7, 7};
  uint32_t freed = 9, answer;
  double distance = -1;
  size_t count = 99;
  begin(0);
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, create_wire(g_poking, 3, left, 0, &gone));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, create_wire(odd, 2, DSW_BODY_START_PENETRATING, 0, &gone));
  body = make_wire(g_poking, 3, 0);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_is_penetrating(NULL, body, &answer));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_is_penetrating(g_scene, body, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_is_penetrating(g_scene, gone, &answer));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_find_penetrations(NULL, body, &all, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_find_penetrations(g_scene, body, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_find_penetrations(g_scene, body, &all, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_find_penetrations(g_scene, gone, &all, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_depenetrate(NULL, body, no_volume, 0, &freed, &distance));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_depenetrate(g_scene, body, no_volume, 0, NULL, &distance));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_depenetrate(g_scene, gone, no_volume, 0, &freed, &distance));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_depenetrate(g_scene, body, stale_volume, 0, &freed, &distance));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_depenetrate(g_scene, body, no_volume, -1, &freed, &distance));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_depenetrate(g_scene, body, no_volume, HUGE_VAL, &freed, &distance));
  CHECK_OK(set_volume_mark(g_env, 0, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_IMPASSABLE, dsw_body_depenetrate(g_scene, body, volume_at(0), 0, &freed, &distance));
  CHECK(freed == 9 && distance == -1 && all == NULL && count == 99 && penetrates(body) == 1);
  end_scene(g_scene);
}

int main(void) {
  for (g_dimension = 2; g_dimension <= 3; ++g_dimension) {
    check_in(g_dimension == 3 ? "in space" : "in the plane");
    a_wire_that_pokes_through_the_wall(0, 0);
    a_wire_that_pokes_through_the_wall(DSW_FEATURE_BODY_CONTACTS, DSW_BODY_SELF_CONTACTS);
    a_wire_that_pokes_through_the_wall(DSW_FEATURE_LIVE_CHANGES, DSW_BODY_RIGID);
    a_free_body_is_one_at_once();
    nothing_meets_it_until_it_is_free();
    a_side_is_chosen();
    a_body_behind_walls_needs_a_volume();
    boxes_leave_each_other(0.125, 0);
    boxes_leave_each_other(0.375, 0);
    boxes_leave_each_other(0.375, DSW_BODY_RIGID);
    a_thick_wire_keeps_off();
    snapshots_and_recordings_have_it();
    walls_may_move_meanwhile();
    a_refusal_of_memory_leaves_the_body();
    bad_arguments_change_nothing();
  }
  return check_result();
}
