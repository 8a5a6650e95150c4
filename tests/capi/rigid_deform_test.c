/* Rigid bodies that move while walls do: in space and in the plane. */
#include <math.h>
#include <string.h>

#include "bending.h"
#include "check.h"

static const double kRod[6] = {1.2, 1.4, 2.25, 2.7, 1.4, 2.25}; /* over the floor at height 2 */

static dsw_body_id make_rod(double *at) {
  memcpy(at, kRod, sizeof kRod);
  return make_line(flat(at, 2), 2, DSW_LEVEL_EDGES_SWEPT);
}

/* About the upright axis through an end of the rod; in the plane about that end. */
static dsw_rigid_motion turn(double degrees, double up) {
  dsw_rigid_motion m;
  memset(&m, 0, sizeof m);
  m.rotation[2] = sin(degrees * 0.00872664625997165);
  m.rotation[3] = cos(degrees * 0.00872664625997165);
  m.centre[0] = kRod[0];
  m.centre[1] = g_dimension == 3 ? kRod[1] : kRod[2];
  m.centre[2] = g_dimension == 3 ? kRod[2] : 0;
  m.translation[g_up] = up;
  return m;
}

static dsw_deform_report deform_with(const dsw_body_id *body, const dsw_rigid_motion *motion, dsw_move_report *moved) {
  double *const to = next_points();
  dsw_deform_report report;
  memset(&report, 9, sizeof report);
  CHECK_OK(
      dsw_scene_deform_rigid(g_scene, to, g_point_count, body, body != NULL ? 1 : 0, motion, NULL, &report, moved));
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

static void get_positions(dsw_body_id body, double *now) {
  size_t count = 0;
  CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 0, NULL, &count));
  CHECK(count == 2);
}

/* The floor rises by 0.5 below a rod that turns in its height: they meet half of the way. */
static void a_floor_meets_a_rod_that_turns(void) {
  const dsw_wall_contact *walls = NULL;
  const dsw_body_contact *contacts = NULL;
  dsw_rigid_motion left, motion = turn(g_dimension == 3 ? 120 : 0, 0);
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  double at[6], now[6];
  size_t count = 0, i;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  body = make_rod(at);
  raise_row(2, 0.5);
  report = deform_with(&body, &motion, &moved);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction < 0.5 && report.fraction > 0.4999999);
  CHECK(moved.fraction == report.fraction && moved.vertices_stopped == 2 && report.invalid_count == 0);
  CHECK_OK(dsw_environment_get_wall_contacts(g_env, &walls, &count));
  CHECK(count > 0 && count == report.contact_count);
  for (i = 0; i < count; ++i) {
    CHECK(walls[i].time == 0.5 && walls[i].response == DSW_WALL_STOP && walls[i].body.index == body.index);
    CHECK(walls[i].from[g_up] == 2 && walls[i].to[g_up] == 2.5 && fabs(walls[i].contact.normal[g_up] - 1) < 1e-9);
  }
  CHECK_OK(dsw_body_get_contacts(g_scene, body, &contacts, &count));
  CHECK(count == moved.contact_count);
  for (i = 0; i < count; ++i) CHECK(contacts[i].time == 0.5);
  get_positions(body, now);
  CHECK(fabs(now[g_up] - 2.25) < 1e-12 && memcmp(now, at, sizeof *now) == 0);
  CHECK_OK(dsw_body_get_motion_left(g_scene, body, &left));
  CHECK(g_dimension == 2 || fabs(left.rotation[3] - cos(1.0471975511965976 / 2)) < 1e-6);
  end();
}

/* A thick rod is met a radius earlier, and goes up again from where it lies. */
static void a_thick_rod_keeps_its_radius(void) {
  dsw_rigid_motion motion = turn(g_dimension == 3 ? 120 : 0, 0);
  const dsw_wall_contact *walls = NULL;
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  double at[6], now[6], gap = 0;
  size_t count = 0, i;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  body = make_rod(at);
  CHECK_OK(dsw_body_set_radius(g_scene, body, 0.125));
  raise_row(2, 0.5);
  report = deform_with(&body, &motion, &moved);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && fabs(report.fraction - 0.25) < 1e-9);
  CHECK(moved.fraction == report.fraction && moved.vertices_stopped == 2);
  CHECK_OK(dsw_environment_get_wall_contacts(g_env, &walls, &count));
  CHECK(count > 0 && count == report.contact_count);
  for (i = 0; i < count; ++i) CHECK(walls[i].body.index == body.index && walls[i].contact.normal[g_up] > 1 - 1e-9);
  CHECK_OK(dsw_body_find_least_gap(g_scene, body, 1, &gap));
  CHECK(fabs(gap) < 1e-9);
  /* Up with the floor, in which it keeps its distance, and away from it. */
  motion = turn(g_dimension == 3 ? 30 : 0, 0.25);
  raise_row(2, 0.25);
  report = deform_with(&body, &motion, &moved);
  CHECK(report.fraction == 1 && report.contact_count == 0 && moved.contact_count == 0);
  motion = turn(g_dimension == 3 ? 60 : 20, 0.25);
  report = deform_with(&body, &motion, &moved);
  CHECK(report.fraction == 1 && moved.contact_count == 0);
  get_positions(body, now);
  CHECK(now[g_up] > 2.625 - 1e-9 && now[g_dimension + g_up] > 2.625 - 1e-9);
  CHECK_OK(dsw_body_find_least_gap(g_scene, body, 1, &gap));
  CHECK(gap > -1e-10);
  end();
}

/* A floor that rises takes a rod along that slides on it, and a ceiling stops both. */
static void a_floor_pushes_a_rod(double radius) {
  dsw_scene_deform_options o;
  dsw_rigid_motion motion;
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  double at[6], now[6], gap;
  size_t i;
  dsw_scene_deform_options_init(&o, sizeof o);
  o.stop = DSW_TOGETHER_STOP_FEATURE;
  o.response = DSW_TOGETHER_RESPONSE_SLIDE;
  begin(DSW_FEATURE_DEFORMING);
  motion = turn(0, 0);
  motion.translation[0] = 0.5;
  mark_floor(1);
  body = make_rod(at);
  CHECK_OK(dsw_body_set_radius(g_scene, body, radius));
  raise_row(2, 0.5);
  CHECK_OK(dsw_scene_deform_rigid(g_scene, next_points(), g_point_count, &body, 1, &motion, &o, &report, &moved));
  g_next = 1 - g_next;
  memcpy(next_points(), g_points[1 - g_next], g_dimension * g_point_count * sizeof(double));
  CHECK(report.outcome == DSW_DEFORM_DONE && report.fraction == 1 && report.contact_count > 0);
  CHECK(fabs(moved.fraction - (0.25 - radius) / 0.5) < 1e-9 && moved.vertices_stopped == 2);
  get_positions(body, now);
  for (i = 0; i < 2; ++i) {
    CHECK(fabs(now[g_dimension * i] - (at[g_dimension * i] + 0.5)) < 1e-8);
    CHECK(now[g_dimension * i + g_up] >= 2.5 && fabs(now[g_dimension * i + g_up] - 2.5 - radius) < 1e-8);
  }
  CHECK_OK(dsw_body_find_least_gap(g_scene, body, 1, &gap));
  CHECK(gap > -1e-10 && gap < 1e-8);
  end();
}

/* What goes up with the floor is free, and so is what stands beside. The points are those of the call, to the bit. */
static void a_rod_rises_with_the_floor(void) {
  dsw_rigid_motion motion;
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  double at[6], now[6];
  begin(DSW_FEATURE_DEFORMING);
  motion = turn(g_dimension == 3 ? 75 : 10, 0.5);
  mark_floor(1);
  body = make_rod(at);
  raise_row(2, 0.5);
  report = deform_with(&body, &motion, &moved);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.fraction == 1 && report.contact_count == 0);
  CHECK(moved.fraction == 1 && moved.vertices_stopped == 0 && moved.contact_count == 0);
  get_positions(body, now);
  CHECK(now[g_up] == 2.75 && next_points()[g_dimension * vertex(1, 1, 2) + g_up] == 2.5);
  end();
}

/* Whoever stands stops all: a particle, and a body that the call does not move. */
static void what_stands_is_met(int is_particle) {
  const dsw_wall_contact *walls = NULL;
  dsw_rigid_motion motion;
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_particle_id particle = {0, 0};
  dsw_body_id body, other = {0, 0};
  double at[6], still[6] = {3.3, 1.4, 2.125, 3.6, 1.4, 2.125};
  size_t count = 0;
  begin(DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
  motion = turn(g_dimension == 3 ? 75 : 10, 0.5);
  mark_floor(1);
  body = make_rod(at);
  flat(still, 2);
  if (is_particle) {
    CHECK_OK(dsw_particle_create(g_scene, still, no_volume, &particle));
  } else {
    other = make_line(still, 2, DSW_LEVEL_EDGES_SWEPT);
  }
  raise_row(2, 0.5);
  report = deform_with(&body, &motion, &moved);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction < 0.25 && report.fraction > 0.2499999);
  CHECK(moved.fraction == report.fraction && moved.contact_count == 0);
  CHECK_OK(dsw_environment_get_wall_contacts(g_env, &walls, &count));
  CHECK(count > 0 && walls[0].time == 0.25 && walls[0].particle.generation == particle.generation);
  CHECK(walls[0].body.index == other.index && walls[0].body.generation == other.generation);
  /* Nobody else moves: the floor is there already. */
  report = deform_with(NULL, NULL, NULL);
  CHECK(report.fraction == 1);
  end();
}

/* Nothing is impassable. A corner goes through the volume that the rod comes by. */
static void volumes_that_are_met_stay_valid(void) {
  dsw_rigid_motion motion;
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  double at[6];
  begin(DSW_FEATURE_DEFORMING);
  motion = turn(5, 0);
  body = make_rod(at);
  point(2, 2, 2)[0] += 1.75;
  point(2, 2, 2)[g_up] += 1.75;
  report = deform_with(&body, &motion, &moved);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction <= 0.5 && report.invalid_count >= 1);
  CHECK(moved.fraction == report.fraction && moved.contact_count == 0);
  end();
}

static void bad_arguments(void) {
  dsw_rigid_motion motions[2];
  dsw_scene_deform_options o;
  dsw_deform_report report, before;
  dsw_move_report moved[2];
  dsw_body_id bodies[2];
  double at[6], *next;
#define DEFORM(scene, next, points, count, motions, o) \
  dsw_scene_deform_rigid(scene, next, points, bodies, count, motions, o, &report, moved)
  dsw_scene_deform_options_init(&o, sizeof o);
  memset(&report, 0x55, sizeof report);
  before = report;
  begin(0);
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, DEFORM(g_scene, next_points(), g_point_count, 0, NULL, NULL));
  end();
  begin(DSW_FEATURE_DEFORMING);
  bodies[0] = bodies[1] = make_rod(at);
  motions[0] = motions[1] = turn(5, 0);
  next = next_points();
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, DEFORM(NULL, next, g_point_count, 0, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, DEFORM(g_scene, NULL, g_point_count, 0, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, DEFORM(g_scene, next, g_point_count, 1, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, DEFORM(g_scene, next, g_point_count - 1, 0, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, DEFORM(g_scene, next, g_point_count, 2, motions, NULL));
  bodies[1].generation += 7;
  CHECK_FAILS(DSW_STATUS_STALE_ID, DEFORM(g_scene, next, g_point_count, 2, motions, NULL));
  motions[0].translation[0] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, DEFORM(g_scene, next, g_point_count, 1, motions, NULL));
  CHECK_MESSAGE("motions[0].centre[0]");
  motions[0].translation[0] = 1.7e308;
  motions[0].centre[0] = 1.7e308;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, DEFORM(g_scene, next, g_point_count, 1, motions, NULL));
  motions[0] = turn(5, 0);
  o.stop = DSW_TOGETHER_STOP_FEATURE;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, DEFORM(g_scene, next, g_point_count, 1, motions, &o));
  CHECK_MESSAGE("response");
  o.response = DSW_TOGETHER_RESPONSE_CARRY;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, DEFORM(g_scene, next, g_point_count, 1, motions, &o));
  CHECK_MESSAGE("response");
  o.response = DSW_TOGETHER_RESPONSE_STOP;
  o.stop = DSW_TOGETHER_STOP_ISLAND;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, DEFORM(g_scene, next, g_point_count, 1, motions, &o));
  o.stop = DSW_TOGETHER_STOP_ALL;
  o.response = DSW_TOGETHER_RESPONSE_SLIDE;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, DEFORM(g_scene, next, g_point_count, 1, motions, &o));
  o.response = DSW_TOGETHER_RESPONSE_STOP;
  o.point_room = 1;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, DEFORM(g_scene, next, g_point_count, 1, motions, &o));
  point(2, 2, 2)[1] = NAN; /* near the body */
  CHECK_FAILS(DSW_STATUS_NON_FINITE, DEFORM(g_scene, next, g_point_count, 1, motions, NULL));
  point(2, 2, 2)[1] = 2;
  CHECK(memcmp(&before, &report, sizeof report) == 0);
  CHECK_OK(DEFORM(g_scene, next, g_point_count, 1, motions, NULL));
  CHECK(report.outcome == DSW_DEFORM_DONE);
  CHECK_FAILS(DSW_STATUS_IN_USE, DEFORM(g_scene, next, g_point_count, 1, motions, NULL));
#undef DEFORM
  end();
}

/* An end of a rod falls on the end of another one. Integers are long where the least double stands beside 1. */
static void too_much_work_leaves_all_where_it_is(void) {
  const double least = 5e-324;
  double at[6] = {2, 1.4, 2.75, 1, 1.4, 2.5}, other[6] = {1, 1.4, 1.5, least, 1.4, 1.25}, now[6];
  static double before[3 * MOST_POINTS];
  const double *read = NULL, *points = NULL;
  dsw_scene_deform_options o;
  dsw_rigid_motion motion;
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  size_t count = 0, bytes;
  dsw_scene_deform_options_init(&o, sizeof o);
  begin(DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
  body = make_line(flat(at, 2), 2, DSW_LEVEL_EDGES_SWEPT);
  make_line(flat(other, 2), 2, DSW_LEVEL_EDGES_SWEPT);
  motion = turn(0, -1.25);
  raise_row(4, 0.25);
  bytes = g_dimension * g_point_count * sizeof *before;
  memcpy(before, next_points(), bytes);
  CHECK_OK(dsw_environment_get_points(g_env, &points, &count));
  o.max_work = 1;
  CHECK_OK(dsw_scene_deform_rigid(g_scene, next_points(), g_point_count, &body, 1, &motion, &o, &report, &moved));
  CHECK(report.outcome == DSW_DEFORM_LIMITED && report.fraction == 0 && report.contact_count == 0);
  CHECK(moved.fraction == 0 && moved.vertices_moved == 2 && moved.vertices_limited == 2 && moved.contact_count == 0);
  get_positions(body, now);
  CHECK(memcmp(now, at, 2 * g_dimension * sizeof *at) == 0);
  CHECK_OK(dsw_environment_get_points(g_env, &read, &count));
  CHECK(read == points && memcmp(next_points(), before, bytes) == 0);
  end();
}

/* Every allocation is refused in turn: then nothing has moved, and the host's array is as it was. */
static void memory_runs_out(void) {
  static double arrays[2][3 * MOST_POINTS];
  double at[6], now[6];
  const double *points = NULL;
  host h;
  dsw_context *context = make_context(&h);
  const dsw_rigid_motion motion = turn(g_dimension == 3 ? 40 : 5, 0);
  dsw_deform_report report;
  dsw_move_report moved;
  dsw_body_id body;
  size_t n = 0, count = 0, bytes, i;
  g_env = g_dimension == 3 ? make_environment(context, N, N, N) : make_squares(context, N, N);
  g_scene = make_scene(g_env, DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
  mark_floor(1);
  body = make_rod(at);
  CHECK_OK(dsw_environment_get_points(g_env, &points, &count));
  bytes = g_dimension * count * sizeof *points;
  memcpy(arrays[0], points, bytes);
  for (i = vertex(0, 0, 2); i < vertex(0, 0, 3); ++i) arrays[0][g_dimension * i + g_up] += 0.5;
  memcpy(arrays[1], arrays[0], bytes);
  while (n < 5000 &&
         RUNS_OUT(&h, n, dsw_scene_deform_rigid(g_scene, arrays[0], count, &body, 1, &motion, NULL, &report, &moved))) {
    const double *read = NULL;
    size_t read_count = 0;
    CHECK_OK(dsw_environment_get_points(g_env, &read, &read_count));
    CHECK(read == points && memcmp(arrays[0], arrays[1], bytes) == 0);
    get_positions(body, now);
    CHECK(memcmp(now, at, 2 * g_dimension * sizeof *at) == 0);
    ++n;
  }
  CHECK(n > 10 && report.outcome == DSW_DEFORM_FRACTION && moved.fraction == report.fraction);
  end();
  end_context(context, &h);
}

/* A recorded call is made again with the same results. */
static void is_recorded(void) {
  static tape recorded;
  const dsw_recording_desc desc = to_tape(&recorded);
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  dsw_rigid_motion motion;
  dsw_move_report moved;
  dsw_body_id body;
  double at[6];
  int found = 0;
  begin(DSW_FEATURE_DEFORMING);
  motion = turn(g_dimension == 3 ? 120 : 5, 0);
  mark_floor(1);
  CHECK_OK(dsw_scene_start_recording(g_scene, &desc));
  body = make_rod(at);
  raise_row(2, 0.5);
  CHECK(deform_with(&body, &motion, &moved).outcome == DSW_DEFORM_FRACTION);
  CHECK_OK(dsw_scene_stop_recording(g_scene));
  CHECK_OK(dsw_replay_create(NULL, recorded.bytes, recorded.size, &replay));
  for (;;) {
    CHECK_OK(dsw_replay_step(replay, &report));
    if (report.outcome == DSW_REPLAY_END) break;
    CHECK(report.outcome == DSW_REPLAY_SAME);
    found |= strcmp(report.function, "dsw_scene_deform_rigid") == 0;
  }
  CHECK(found);
  CHECK_OK(dsw_replay_destroy(replay));
  end();
}

static void nobody_is_there(void) {
  begin(DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
  raise_row(2, 0.25);
  CHECK(deform_with(NULL, NULL, NULL).outcome == DSW_DEFORM_DONE);
  end();
}

int main(void) {
  unsigned dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    use_dimension(dimension);
    a_floor_meets_a_rod_that_turns();
    a_thick_rod_keeps_its_radius();
    a_floor_pushes_a_rod(0);
    a_floor_pushes_a_rod(0.0625);
    a_rod_rises_with_the_floor();
    what_stands_is_met(0);
    what_stands_is_met(1);
    volumes_that_are_met_stay_valid();
    nobody_is_there();
    bad_arguments();
    if (dimension == 3) too_much_work_leaves_all_where_it_is(); /* in the plane the numbers are too short */
    memory_runs_out();
    is_recorded();
  }
  return check_result();
}
