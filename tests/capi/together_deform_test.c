/* Walls and bodies move at once: in space and in the plane. */
#include <math.h>
#include <string.h>

#include "bending.h"
#include "check.h"

static const double kLine[6] = {1.2, 1.4, 2.25, 2.7, 1.6, 2.25}; /* over the floor at height 2 */

/* To the array that may be written, which becomes the other one. Targets: two points of one body, or null. */
static dsw_deform_report deform_with(const dsw_body_id *body, const double *targets, dsw_move_report *moved) {
  double *const to = next_points();
  dsw_deform_report report;
  memset(&report, 9, sizeof report);
  CHECK_OK(dsw_scene_deform(g_scene, to, g_point_count, body, body != NULL ? 1 : 0, targets, body != NULL ? 2 : 0, 0,
                            NULL, &report, moved));
  if (report.outcome != DSW_DEFORM_REFUSED) {
    const double *read = NULL;
    size_t count = 0;
    CHECK_OK(dsw_environment_get_points(g_env, &read, &count));
    CHECK(read == to && count == g_point_count);
    g_next = 1 - g_next;
    memcpy(next_points(), to, g_dimension * g_point_count * sizeof *to);
  }
  return report;
}

static dsw_body_id make_rod(double *positions) {
  memcpy(positions, kLine, sizeof kLine);
  return make_line(flat(positions, 2), 2, DSW_LEVEL_EDGES_SWEPT);
}

static void get_positions(dsw_body_id body, double *now) {
  size_t count = 0;
  CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 0, NULL, &count));
  CHECK(count == 2);
}

/* Moves both ends up. */
static double *raised(double *positions, double by) {
  positions[g_up] += by;
  positions[g_dimension + g_up] += by;
  return positions;
}

/* The floor comes up by 0.5. It meets the body half of the way. */
static void a_floor_stops_before_a_body_that_rests(void) {
  double at[6], now[6];
  const dsw_wall_contact *c = NULL;
  dsw_deform_report report;
  dsw_body_id body;
  size_t count = 0, i;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  body = make_rod(at);
  raise_row(2, 0.5);
  report = deform_with(NULL, NULL, NULL);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction < 0.5 && report.fraction > 0.4999999);
  CHECK(report.contact_count >= 2 && report.invalid_count == 0 && report.pushed_count == 0 && report.held_count == 0);
  get_positions(body, now);
  CHECK(memcmp(now, at, 2 * g_dimension * sizeof *at) == 0);
  CHECK(point(2, 1, 2)[g_up] < 2.25 && point(2, 1, 2)[g_up] > 2.2499999 && point(0, 0, 4)[g_up] == 4);
  CHECK_OK(dsw_environment_get_wall_contacts(g_env, &c, &count));
  CHECK(count == report.contact_count);
  for (i = 0; i < count; ++i) {
    CHECK(c[i].time == 0.5 && c[i].body.index == body.index && c[i].particle.generation == 0);
    CHECK(c[i].response == DSW_WALL_STOP && c[i].point[g_up] == 2.25 && c[i].contact.normal[g_up] > 0.99);
    CHECK(c[i].moving.generation == 1 && c[i].from[g_up] == 2 && c[i].to[g_up] == 2.5);
  }
  end();
}

/* The body goes up with the floor. The same targets, one after the other, would not do: the floor would come first. */
static void a_body_goes_with_the_floor(void) {
  double at[6], now[6];
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  body = make_rod(at);
  raised(at, 0.5);
  raise_row(2, 0.5);
  report = deform_with(&body, at, &moved);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.fraction == 1 && report.contact_count == 0);
  CHECK(moved.fraction == 1 && moved.vertices_moved == 2 && moved.vertices_stopped == 0 && moved.contact_count == 0);
  get_positions(body, now);
  CHECK(memcmp(now, at, 2 * g_dimension * sizeof *at) == 0 && point(2, 1, 2)[g_up] == 2.5);
  end();
}

/* The floor rises by 0.5, the body goes down by 0.25: they meet after a third of the way. */
static void both_meet_and_the_body_goes_on(void) {
  double at[6], now[6], targets[6];
  const dsw_body_contact *c = NULL;
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  size_t count = 0;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  body = make_rod(at);
  memcpy(targets, at, sizeof at);
  raised(targets, -0.25);
  raise_row(2, 0.5);
  report = deform_with(&body, targets, &moved);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && fabs(report.fraction - 1.0 / 3) < 1e-9 && report.contact_count >= 1);
  CHECK(moved.fraction == report.fraction && moved.vertices_stopped == 2 && moved.contact_count >= 1);
  CHECK_OK(dsw_body_get_contacts(g_scene, body, &c, &count));
  CHECK(count == moved.contact_count && fabs(c->time - 1.0 / 3) < 1e-15 && c->contact.normal[g_up] > 0.99);
  get_positions(body, now);
  CHECK(now[g_up] > point(2, 1, 2)[g_up] && now[g_up] - point(2, 1, 2)[g_up] < 1e-9);
  memcpy(targets, now, sizeof now);
  targets[0] += 0.25;
  targets[g_dimension] += 0.25;
  CHECK_OK(dsw_scene_move_together(g_scene, &body, 1, targets, 2, 0, NULL, &moved));
  CHECK(moved.fraction == 1);
  end();
}

/* The floor comes up by 0.5. Its vertices below the body stop half of the way, the others arrive. */
static void parts_that_touch_stop_alone(void) {
  double at[6], now[6];
  const dsw_vertex_id *held = NULL;
  const double *read = NULL;
  dsw_scene_deform_options o;
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  size_t count = 0, points = 0, i;
  dsw_scene_deform_options_init(&o, sizeof o);
  o.stop = DSW_TOGETHER_STOP_FEATURE;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  body = make_rod(at);
  raise_row(2, 0.5);
  CHECK_OK(dsw_scene_deform(g_scene, next_points(), g_point_count, &body, 1, at, 2, 0, &o, &report, &moved));
  CHECK(report.outcome == DSW_DEFORM_HELD && report.fraction == 1 && report.contact_count >= 2);
  CHECK(moved.fraction == 0.5 && moved.vertices_stopped == 0 && report.invalid_count == 0);
  CHECK_OK(dsw_environment_get_held_vertices(g_env, &held, &count));
  CHECK(count == report.held_count && count >= 2 && count < g_point_count);
  CHECK_OK(dsw_environment_get_points(g_env, &read, &points));
  CHECK(read == next_points());
  for (i = 0; i < count; ++i) {
    const double height = read[g_dimension * held[i].index + g_up];
    CHECK(height < 2.25 && height > 2.2499999);
  }
  CHECK(read[g_dimension * vertex(0, 0, 2) + g_up] == 2.5 && read[g_dimension * vertex(2, 1, 2) + g_up] < 2.25);
  get_positions(body, now);
  CHECK(memcmp(now, at, 2 * g_dimension * sizeof *at) == 0);
  end();
}

/* The floor comes up by 0.5 and goes 0.25 along x. It pushes the body, which is 0.25 above it, by what is left of that, or takes it along. */
static void a_floor_pushes_or_carries(dsw_together_response response, double radius) {
  const double met = 2 * (0.25 - radius), along = response == DSW_TOGETHER_RESPONSE_CARRY ? 0.25 * (1 - met) : 0;
  double at[6], now[6];
  const double *left = NULL;
  dsw_scene_deform_options o;
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  size_t count = 0, i;
  dsw_scene_deform_options_init(&o, sizeof o);
  o.stop = DSW_TOGETHER_STOP_FEATURE;
  o.response = response;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  body = make_rod(at);
  CHECK_OK(dsw_body_set_radius(g_scene, body, radius));
  raise_row(2, 0.5);
  for (i = vertex(0, 0, 2); i < vertex(0, 0, 3); ++i) next_points()[g_dimension * i] += 0.25;
  CHECK_OK(dsw_scene_deform(g_scene, next_points(), g_point_count, &body, 1, at, 2, 0, &o, &report, &moved));
  CHECK(report.outcome == DSW_DEFORM_DONE && report.held_count == 0);
  CHECK(report.contact_count >= (radius == 0 ? 2u : 1u));
  CHECK(fabs(moved.fraction - met) < (radius == 0 ? 0 : 1e-9) + 1e-300 && moved.vertices_stopped == 2);
  get_positions(body, now);
  CHECK_OK(dsw_body_get_ways_left(g_scene, body, &left, &count));
  CHECK(count == 2);
  for (i = 0; i < 2; ++i) {
    const double *const p = now + g_dimension * i, *const wanted = at + g_dimension * i;
    CHECK(p[g_up] > 2.5 + radius * (1 - 1e-10) && p[g_up] < 2.5000001 + radius * (1 + 0x1p-19));
    CHECK(fabs(p[0] - wanted[0] - along) < (radius == 0 ? 1e-12 : 1e-9));
    CHECK(left[g_dimension * i + g_up] == wanted[g_up] - p[g_up]);
  }
  end();
}

/* A thick body stops the floor, then leaves it, and goes beside it. */
static void a_thick_body_keeps_its_radius_from_the_floor(void) {
  double at[6], now[6];
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  body = make_rod(at);
  CHECK_OK(dsw_body_set_radius(g_scene, body, 0.125));
  raise_row(2, 0.5);
  report = deform_with(&body, at, &moved);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && fabs(report.fraction - 0.25) < 1e-9 && report.contact_count >= 1);
  CHECK(point(2, 1, 2)[g_up] < 2.125 + 1e-10 && point(2, 1, 2)[g_up] > 2.125 - 1e-9);
  at[0] += 0.25, at[g_dimension] += 0.25;
  report = deform_with(&body, at, &moved);
  CHECK(report.outcome == DSW_DEFORM_DONE && moved.fraction == 1);
  raised(at, 0.25);
  raise_row(2, 0.25);
  report = deform_with(&body, at, &moved);
  CHECK(report.outcome == DSW_DEFORM_DONE && moved.fraction == 1);
  raise_row(2, -0.25);
  report = deform_with(&body, at, &moved);
  CHECK(report.outcome == DSW_DEFORM_DONE && moved.fraction == 1);
  get_positions(body, now);
  CHECK(memcmp(now, at, 2 * g_dimension * sizeof *at) == 0);
  end();
}

/* A vertex falls on the floor, slides along it, and comes to a wall that is far from its straight way. */
static void what_slides_meets_walls_beside_its_way(double radius) {
  const double beyond = radius * 0x1p-16 + 1e-9; /* what is pushed ends that much farther away */
  double at[3] = {1.2, 1.5, 2.4}, to[3] = {2.2, 1.5, 1};
  dsw_scene_deform_options o;
  dsw_deform_report report;
  dsw_body_id body;
  size_t count = 0;
  dsw_scene_deform_options_init(&o, sizeof o);
  o.stop = DSW_TOGETHER_STOP_FEATURE;
  o.response = DSW_TOGETHER_RESPONSE_SLIDE;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  CHECK_OK(set_face_mark(g_env, cell(1, 1, 2), g_dimension == 3 ? (uint32_t)FACE_X1 : 1, DSW_MARK_IMPASSABLE));
  body = make_line(flat(at, 1), 1, DSW_LEVEL_POINTS);
  CHECK_OK(dsw_body_set_radius(g_scene, body, radius));
  CHECK_OK(dsw_scene_deform(g_scene, next_points(), g_point_count, &body, 1, flat(to, 1), 1, 0, &o, &report, NULL));
  CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == 2);
  CHECK_OK(dsw_body_get_positions(g_scene, body, at, 1, 0, NULL, &count));
  CHECK(at[0] <= 2 - radius && at[0] > 2 - radius - beyond && at[g_up] >= 2 + radius && at[g_up] < 2 + radius + beyond);
  end();
}

static void a_particle_stops_the_floor(void) {
  double at[3] = {2.3, 1.4, 2.25}, now[3];
  const dsw_wall_contact *c = NULL;
  dsw_particle_id particle;
  dsw_deform_report report;
  size_t count = 0;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  CHECK_OK(dsw_particle_create(g_scene, flat(at, 1), no_volume, &particle));
  raise_row(2, 0.5);
  report = deform_with(NULL, NULL, NULL);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction < 0.5 && report.fraction > 0.4999999);
  CHECK_OK(dsw_environment_get_wall_contacts(g_env, &c, &count));
  CHECK(count >= 1 && c->time == 0.5 && c->particle.index == particle.index && c->body.generation == 0);
  CHECK_OK(dsw_particle_get_position(g_scene, particle, now, NULL));
  CHECK(memcmp(now, at, g_dimension * sizeof *now) == 0);
  end();
}

/* Nothing is impassable. The corner of the particle's volume goes through the opposite one. */
static void ways_end_where_a_volume_stays_valid(void) {
  double at[3] = {2.9, 2.9, 2.9};
  const dsw_volume_id *invalid = NULL;
  dsw_particle_id particle;
  dsw_deform_report report;
  size_t count = 0;
  begin(DSW_FEATURE_DEFORMING);
  CHECK_OK(dsw_particle_create(g_scene, flat(at, 1), no_volume, &particle));
  point(2, 2, 2)[0] += 1.25;
  point(2, 2, 2)[g_up] += 1.25;
  report = deform_with(NULL, NULL, NULL);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction <= 0.5 && report.invalid_count >= 1);
  CHECK_OK(dsw_environment_get_invalid_volumes(g_env, &invalid, &count));
  CHECK(count == report.invalid_count);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  end();
}

static void bad_arguments(void) {
  double at[6], targets[12];
  dsw_scene_deform_options o;
  dsw_deform_report report, before;
  dsw_move_report moved[2], moved_before[2];
  dsw_body_id bodies[2];
  double *next;
#define DEFORM(scene, next, points, count, targets, target_count, stride, o) \
  dsw_scene_deform(scene, next, points, bodies, count, targets, target_count, stride, o, &report, moved)
  dsw_scene_deform_options_init(&o, sizeof o);
  memset(&report, 0x55, sizeof report);
  memset(moved, 0x55, sizeof moved);
  before = report;
  memcpy(moved_before, moved, sizeof moved);
  begin(0);
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, DEFORM(g_scene, next_points(), g_point_count, 0, NULL, 0, 0, NULL));
  CHECK_MESSAGE("DSW_FEATURE_DEFORMING");
  end();
  begin(DSW_FEATURE_DEFORMING);
  bodies[0] = make_rod(at);
  memcpy(targets, at, sizeof at);
  memcpy(targets + 2 * g_dimension, at, sizeof at);
  bodies[1] = bodies[0];
  next = next_points();
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, DEFORM(NULL, next, g_point_count, 0, NULL, 0, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, DEFORM(g_scene, NULL, g_point_count, 0, NULL, 0, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, DEFORM(g_scene, next, g_point_count, 1, NULL, 2, 0, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, DEFORM(g_scene, next, g_point_count + 1, 0, NULL, 0, 0, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, DEFORM(g_scene, next, g_point_count, 1, targets, 3, 0, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, DEFORM(g_scene, next, g_point_count, 1, targets, 2, 12, NULL));
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, DEFORM(g_scene, next, g_point_count, 2, targets, 4, 0, NULL));
  bodies[1].generation += 7;
  CHECK_FAILS(DSW_STATUS_STALE_ID, DEFORM(g_scene, next, g_point_count, 2, targets, 4, 0, NULL));
  CHECK_MESSAGE("bodies[1]");
  targets[1] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, DEFORM(g_scene, next, g_point_count, 1, targets, 2, 0, NULL));
  CHECK_MESSAGE("targets");
  targets[1] = at[1];
  o.point_room = g_point_count - 1;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, DEFORM(g_scene, next, g_point_count, 1, targets, 2, 0, &o));
  o.point_room = 0;
  o.flags = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, DEFORM(g_scene, next, g_point_count, 1, targets, 2, 0, &o));
  o.flags = DSW_MOVE_LEAVE; /* nothing leaves while the environment deforms */
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, DEFORM(g_scene, next, g_point_count, 1, targets, 2, 0, &o));
  o.flags = 0;
  o.stop = DSW_TOGETHER_STOP_ISLAND;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, DEFORM(g_scene, next, g_point_count, 1, targets, 2, 0, &o));
  CHECK_MESSAGE("ISLAND");
  o.stop = (dsw_together_stop)3;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, DEFORM(g_scene, next, g_point_count, 1, targets, 2, 0, &o));
  CHECK_MESSAGE("stop");
  o.stop = DSW_TOGETHER_STOP_ALL;
  o.struct_size = 3;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, DEFORM(g_scene, next, g_point_count, 1, targets, 2, 0, &o));
  point(2, 2, 2)[1] = NAN; /* near the body */
  CHECK_FAILS(DSW_STATUS_NON_FINITE, DEFORM(g_scene, next, g_point_count, 1, targets, 2, 0, NULL));
  point(2, 2, 2)[1] = 2;
  CHECK(memcmp(&before, &report, sizeof report) == 0 && memcmp(moved_before, moved, sizeof moved) == 0);
  point(0, 0, 0)[0] = INFINITY; /* far away: the volume there becomes invalid */
  CHECK_OK(DEFORM(g_scene, next, g_point_count, 1, targets, 2, 0, NULL));
  CHECK(report.outcome == DSW_DEFORM_DONE);
  CHECK_FAILS(DSW_STATUS_IN_USE, DEFORM(g_scene, next, g_point_count, 1, targets, 2, 0, NULL));
#undef DEFORM
  end();
}

/* A rod falls on another one. Integers are long where the least double stands beside 1. */
static void too_much_work_leaves_all_where_it_is(void) {
  const double least = 5e-324, third = 1.0 / 3;
  double in_plane[3][6] = {
      {2, 0, 1.75, least, 0, 1.75}, {0.5, 0, 1e-160, 1e-160, 0, 1e-300}, {1.5, 0, 1e-160, 1, 0, 1.5}};
  double in_space[3][6] = {{0.7, 1.5, 0.5, least, 0.7, 1e-300},
                           {1e-200, least, 2, 2, 1e-200, 1e-100},
                           {1, third, 1e-100, 1.1, third, least}};
  double *const at = g_dimension == 3 ? in_space[0] : in_plane[0], *const targets = at + 6, *const other = at + 12;
  double now[6];
  static double before[3 * MOST_POINTS];
  const double *read = NULL, *points = NULL;
  dsw_scene_deform_options o;
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  size_t count = 0, bytes;
  dsw_scene_deform_options_init(&o, sizeof o);
  begin(DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
  body = make_line(flat(at, 2), 2, DSW_LEVEL_EDGES_SWEPT);
  make_line(flat(other, 2), 2, DSW_LEVEL_EDGES_SWEPT);
  flat(targets, 2);
  raise_row(4, 0.25);
  bytes = g_dimension * g_point_count * sizeof *before;
  memcpy(before, next_points(), bytes);
  CHECK_OK(dsw_environment_get_points(g_env, &points, &count));
  o.max_work = 1;
  CHECK_OK(dsw_scene_deform(g_scene, next_points(), g_point_count, &body, 1, targets, 2, 0, &o, &report, &moved));
  CHECK(report.outcome == DSW_DEFORM_LIMITED && report.fraction == 0 && report.contact_count == 0);
  CHECK(moved.fraction == 0 && moved.vertices_moved == 2 && moved.vertices_stopped == 2);
  CHECK(moved.vertices_limited == 2 && moved.contact_count == 0);
  get_positions(body, now);
  CHECK(memcmp(now, at, 2 * g_dimension * sizeof *at) == 0);
  CHECK_OK(dsw_environment_get_points(g_env, &read, &count));
  CHECK(read == points && memcmp(next_points(), before, bytes) == 0);
  report = deform_with(&body, targets, &moved); /* it is free, and the default is enough */
  CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction > 0 && report.fraction < 0.75);
  CHECK(moved.vertices_limited == 0 && moved.vertices_stopped == 2 && moved.contact_count == 1);
  end();
}

/* Every allocation is refused in turn: then nothing has moved, and the host's array is as it was. */
static void memory_runs_out(void) {
  const int space = g_dimension == 3;
  static double arrays[2][3 * MOST_POINTS];
  double at[6], targets[6], now[6];
  const double *points = NULL;
  host h;
  dsw_context *context = make_context(&h);
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  size_t n = 0, count = 0, bytes, i;
  memset(&report, 0, sizeof report);
  g_env = space ? make_environment(context, N, N, N) : make_squares(context, N, N);
  g_scene = make_scene(g_env, DSW_FEATURE_DEFORMING);
  mark_floor(1);
  body = make_rod(at);
  memcpy(targets, at, sizeof at);
  raised(targets, -0.125);
  CHECK_OK(dsw_environment_get_points(g_env, &points, &count));
  bytes = g_dimension * count * sizeof *points;
  memcpy(arrays[0], points, bytes);
  for (i = vertex(0, 0, 2); i < vertex(0, 0, 3); ++i) arrays[0][g_dimension * i + g_up] += 0.25;
  memcpy(arrays[1], arrays[0], bytes);
  while (n < 2000 &&
         RUNS_OUT(&h, n, dsw_scene_deform(g_scene, arrays[0], count, &body, 1, targets, 2, 0, NULL, &report, &moved))) {
    const double *read = NULL;
    size_t read_count = 0;
    CHECK_OK(dsw_environment_get_points(g_env, &read, &read_count));
    CHECK(read == points && memcmp(arrays[0], arrays[1], bytes) == 0);
    get_positions(body, now);
    CHECK(memcmp(now, at, 2 * g_dimension * sizeof *at) == 0);
    ++n;
  }
  CHECK(n > 3 && n < 2000 && report.outcome == DSW_DEFORM_FRACTION && report.contact_count > 0);
  end();
  end_context(context, &h);
}

static void in_both(void) {
  a_floor_stops_before_a_body_that_rests();
  a_body_goes_with_the_floor();
  both_meet_and_the_body_goes_on();
  parts_that_touch_stop_alone();
  a_floor_pushes_or_carries(DSW_TOGETHER_RESPONSE_SLIDE, 0);
  a_floor_pushes_or_carries(DSW_TOGETHER_RESPONSE_SLIDE, 0.125);
  a_floor_pushes_or_carries(DSW_TOGETHER_RESPONSE_CARRY, 0);
  a_floor_pushes_or_carries(DSW_TOGETHER_RESPONSE_CARRY, 0.125);
  a_thick_body_keeps_its_radius_from_the_floor();
  what_slides_meets_walls_beside_its_way(0);
  what_slides_meets_walls_beside_its_way(0.125);
  a_particle_stops_the_floor();
  ways_end_where_a_volume_stays_valid();
  bad_arguments();
  too_much_work_leaves_all_where_it_is();
  memory_runs_out();
}

/* A vertex leaves the wall on which it lies exactly, faster than the wall follows: it touches nothing, however the points
   are numbered. */
static void a_vertex_leaves_a_wall_that_follows(void) {
  static const double places[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 1}, {0.25, 0.25, -1}};
  static const double up[3] = {0.0625, 0.125, 0.03125};
  static const uint32_t orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  int i, k;
  for (i = 0; i < 18; ++i) {
    const uint32_t *const at = orders[i % 6];
    const uint32_t moving = (uint32_t)i / 6; /* which corner of the wall */
    const double from[3] = {0.25, 0.25, 0}, to[3] = {0.25, 0.25, 0.25};
    double points[15], next[15];
    int64_t cells[8];
    dsw_environment_desc d;
    dsw_environment *env = NULL;
    dsw_scene *scene;
    dsw_body_desc desc = body_desc(from, 1, NULL, 0, DSW_LEVEL_POINTS);
    dsw_body_id body;
    dsw_scene_deform_options o;
    dsw_deform_report report;
    dsw_move_report moved;
    for (k = 0; k < 15; ++k) points[3 * (k / 3 < 3 ? (int)at[k / 3] : k / 3) + k % 3] = places[k / 3][k % 3];
    for (k = 0; k < 3; ++k) cells[k] = cells[4 + (3 - k) % 3] = at[k];
    cells[3] = 3;
    cells[7] = 4;
    dsw_environment_desc_init(&d, sizeof d);
    d.points = points;
    d.point_count = 5;
    d.volume_count = 2;
    d.connectivity = cells;
    d.connectivity_count = 8;
    d.uniform_cell_type = DSW_CELL_TYPE_TETRA;
    CHECK_OK(dsw_environment_create(NULL, &d, &env, NULL));
    scene = make_scene(env, DSW_FEATURE_DEFORMING);
    CHECK_OK(set_volume_mark(env, 1, DSW_MARK_IMPASSABLE));
    CHECK_OK(dsw_body_create(scene, &desc, &body));
    memcpy(next, points, sizeof next);
    for (k = 0; k < 3; ++k) next[3 * at[moving] + (uint32_t)k] += up[k];
    dsw_scene_deform_options_init(&o, sizeof o);
    o.stop = DSW_TOGETHER_STOP_FEATURE;
    CHECK_OK(dsw_scene_deform(scene, next, 5, &body, 1, to, 1, 0, &o, &report, &moved));
    CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == 0 && moved.vertices_stopped == 0);
    end_scene(scene);
  }
}

int main(void) {
  use_dimension(2);
  in_both();
  use_dimension(3);
  in_both();
  a_vertex_leaves_a_wall_that_follows();
  return check_result();
}
