/* All vertices of bodies at once: bad arguments, the plane, a wall, and memory that runs out. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static const double kAt[6] = {0.5, 0.5, 0.5, 0.5, 1.5, 0.5};

static dsw_together_options together_options(void) {
  dsw_together_options o;
  dsw_together_options_init(&o, sizeof o);
  return o;
}

static dsw_status move_one(dsw_scene *scene, dsw_body_id body, const double *targets, const dsw_together_options *o,
                           dsw_move_report *report) {
  return dsw_scene_move_together(scene, &body, 1, targets, 2, 0, o, report);
}

static void bad_arguments_are_refused(void) {
  const double good[12] = {1.5, 0.5, 0.5, 1.5, 1.5, 0.5, 1.5, 0.5, 1.5, 1.5, 1.5, 1.5};
  double bad[6];
  dsw_environment *environment = make_environment(NULL, 3, 3, 3);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  dsw_body_id bodies[2], stale[2];
  dsw_together_options o = together_options();
  dsw_move_report reports[2], before[2];
  double p[6];
  size_t count = 0, i;
  bodies[0] = make_edge_body(scene, kAt, DSW_LEVEL_EDGES_SWEPT);
  memcpy(bad, kAt, sizeof bad);
  for (i = 0; i < 2; ++i) bad[3 * i + 2] = 1.5;
  bodies[1] = make_edge_body(scene, bad, DSW_LEVEL_EDGES_SWEPT);
  memset(reports, 0x55, sizeof reports);
  memcpy(before, reports, sizeof reports);
  CHECK(o.struct_size == sizeof o && o.flags == 0 && o.stop == DSW_TOGETHER_STOP_ALL);
  CHECK(o.max_rounds == 0 && o.max_work == 0);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_move_together(NULL, bodies, 2, good, 4, 0, &o, reports));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_move_together(scene, NULL, 2, good, 4, 0, &o, reports));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_move_together(scene, bodies, 2, NULL, 4, 0, &o, reports));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_move_together(scene, bodies, 2, good, 3, 0, &o, reports));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_move_together(scene, bodies, 2, good, 4, 12, &o, reports));
  stale[0] = stale[1] = bodies[0];
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, dsw_scene_move_together(scene, stale, 2, good, 4, 0, &o, reports));
  stale[1].generation += 7;
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_scene_move_together(scene, stale, 2, good, 4, 0, &o, reports));
  CHECK_MESSAGE("bodies[1]");
  for (i = 0; i < 6; ++i) {
    memcpy(bad, good, sizeof bad);
    bad[i] = i % 2 == 0 ? NAN : -INFINITY;
    CHECK_FAILS(DSW_STATUS_NON_FINITE, move_one(scene, bodies[0], bad, &o, reports));
    CHECK_MESSAGE("targets");
  }
  o.flags = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, move_one(scene, bodies[0], good, &o, reports));
  o.flags = DSW_MOVE_LEAVE; /* of one body alone */
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, move_one(scene, bodies[0], good, &o, reports));
  o = together_options();
  o.stop = (dsw_together_stop)3;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, move_one(scene, bodies[0], good, &o, reports));
  CHECK_MESSAGE("options->stop");
  o = together_options();
  o.max_rounds = 65537;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, move_one(scene, bodies[0], good, &o, reports));
  o = together_options();
  o.struct_size = 3;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, move_one(scene, bodies[0], good, &o, reports));
  CHECK(memcmp(before, reports, sizeof reports) == 0);
  CHECK_OK(dsw_body_get_positions(scene, bodies[0], p, 2, 0, NULL, &count));
  CHECK(count == 2 && memcmp(p, kAt, sizeof p) == 0);
  CHECK_OK(dsw_scene_move_together(scene, bodies, 2, good, 4, 0, NULL, reports));
  CHECK(reports[0].fraction == 1 && reports[0].vertices_moved == 2 && reports[0].vertices_stopped == 0 &&
        reports[1].fraction == 1);
  CHECK_OK(dsw_scene_move_together(scene, NULL, 0, NULL, 0, 0, NULL, NULL));
  end_scene(scene);
}

/* A wall at x = 2, a quarter of the way. */
static void a_wall_stops_it(void) {
  const double targets[6] = {6.5, 0.5, 0.5, 6.5, 1.5, 0.5};
  dsw_environment *environment = make_environment(NULL, 3, 2, 1);
  dsw_scene *scene = make_scene(environment, 0);
  dsw_body_id body = make_edge_body(scene, kAt, DSW_LEVEL_EDGES_SWEPT);
  const dsw_body_contact *c = NULL;
  dsw_move_report r;
  double p[6];
  size_t count = 0, i;
  CHECK_OK(set_volume_mark(environment, 2, DSW_MARK_IMPASSABLE));
  CHECK_OK(set_volume_mark(environment, 5, DSW_MARK_IMPASSABLE));
  CHECK_OK(move_one(scene, body, targets, NULL, &r));
  CHECK(r.fraction < 0.25 && r.fraction > 0.2499999 && r.vertices_stopped == 2 && r.contact_count == 2);
  CHECK_OK(dsw_body_get_contacts(scene, body, &c, &count));
  CHECK(count == 2);
  for (i = 0; i < count; ++i) {
    CHECK(c[i].time == 0.25 && c[i].vertex.index == i && c[i].contact.normal[0] == -1 && c[i].point[0] == 2 &&
          c[i].contact.kind == DSW_CONTACT_PLANE && c[i].contact.tag == 102 + 3 * i && c[i].edge.generation == 0 &&
          c[i].history == DSW_HISTORY_NEW && fabs(c[i].distance_left - 4.5) < 1e-9);
  }
  CHECK_OK(dsw_body_get_positions(scene, body, p, 2, 0, NULL, &count));
  CHECK(p[0] < 2 && p[0] > 1.9999999 && p[0] == p[3] && p[1] == 0.5 && p[4] == 1.5);
  end_scene(scene);
}

/* The wall at x = 2 again: it stops the way to it alone. */
static void a_wall_lets_it_slide(void) {
  const double targets[6] = {2.5, 0.25, 0.75, 2.5, 1.25, 0.75};
  const dsw_body_id none = {7, 7};
  dsw_environment *environment = make_environment(NULL, 3, 2, 1);
  dsw_scene *scene = make_scene(environment, 0);
  dsw_body_id body = make_edge_body(scene, kAt, DSW_LEVEL_EDGES_SWEPT);
  dsw_together_options o = together_options();
  const double *left = NULL;
  dsw_move_report r;
  double p[6];
  size_t count = 9, i, k;
  CHECK_OK(dsw_body_get_ways_left(scene, body, &left, &count));
  CHECK(count == 0 && left == NULL);
  CHECK_OK(set_volume_mark(environment, 2, DSW_MARK_IMPASSABLE));
  CHECK_OK(set_volume_mark(environment, 5, DSW_MARK_IMPASSABLE));
  o.response = DSW_TOGETHER_RESPONSE_SLIDE;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, move_one(scene, body, targets, &o, &r));
  CHECK_MESSAGE("response");
  o.stop = DSW_TOGETHER_STOP_FEATURE;
  o.response = (dsw_together_response)3;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, move_one(scene, body, targets, &o, &r));
  CHECK_MESSAGE("response");
  o.response = DSW_TOGETHER_RESPONSE_SLIDE;
  CHECK_OK(move_one(scene, body, targets, &o, &r));
  CHECK(r.fraction == 0.75 && r.vertices_stopped == 2 && r.contact_count == 2);
  CHECK_OK(dsw_body_get_positions(scene, body, p, 2, 0, NULL, &count));
  CHECK_OK(dsw_body_get_ways_left(scene, body, &left, &count));
  CHECK(count == 2);
  for (i = 0; i < 2; ++i) {
    CHECK(p[3 * i] < 2 && p[3 * i] > 1.9999999 && p[3 * i + 1] == targets[3 * i + 1] && p[3 * i + 2] == 0.75);
    for (k = 0; k < 3; ++k) CHECK(left[3 * i + k] == targets[3 * i + k] - p[3 * i + k]);
  }
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_ways_left(NULL, body, &left, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_ways_left(scene, body, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_ways_left(scene, body, &left, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_ways_left(scene, none, &left, &count));
  CHECK_OK(dsw_body_move(scene, body, p, 2, 0, NULL, NULL));
  CHECK_OK(dsw_body_get_ways_left(scene, body, &left, &count));
  CHECK(count == 0);
  end_scene(scene);
}

/* Walls lead its ends aside of their straight ways, but not out of the boxes of these, past an obstacle that is not near the ways. */
static void what_lies_beside_the_way_stops_a_slide(void) {
  const double at[2][6] = {{5.1875, 2.1875, 0.6875, 1.4375, 1.0625, 0.8125},
                           {4.0625, 1.3125, 0.5625, 4.5625, 2.1875, 0.9375}},
               targets[2][6] = {{-74.5625, -120.188, 20.5625, -83.4375, -91.8125, 15.9375},
                                {-1.9375, -15.3125, 2.0625, 1.3125, -15.1875, 3.0625}};
  int k;
  for (k = 0; k < 2; ++k) {
    dsw_environment *environment = make_environment(NULL, 6, 3, 3);
    dsw_scene *scene = make_scene(environment, 0);
    dsw_together_options o = together_options();
    dsw_body_id body;
    dsw_flight flight;
    dsw_volume_id volumes[2];
    dsw_move_report r;
    double p[6];
    size_t count = 0;
    CHECK_OK(set_volume_mark(environment, 37, DSW_MARK_IMPASSABLE));
    if (k == 1) CHECK_OK(set_volume_mark(environment, 44, DSW_MARK_IMPASSABLE));
    body = make_edge_body(scene, at[k], DSW_LEVEL_EDGES_SWEPT);
    o.stop = DSW_TOGETHER_STOP_FEATURE;
    o.response = DSW_TOGETHER_RESPONSE_SLIDE;
    CHECK_OK(move_one(scene, body, targets[k], &o, &r));
    CHECK_OK(dsw_body_get_positions(scene, body, p, 2, 0, volumes, &count));
    CHECK_OK(dsw_environment_cast_segments(environment, 1, volumes, p, p + 3, 0, NULL, &flight));
    CHECK(flight.outcome == DSW_OUTCOME_REACHED && flight.volume.index == volumes[1].index && r.contact_count > 0);
    end_scene(scene);
  }
}

/* A wall at x = 3, and another body: distances are kept by all at once, and by what a step is asked for. */
static void thick_bodies_keep_their_distance(void) {
  const double ahead[6] = {1.5, 0.5, 0.5, 1.5, 1.5, 0.5},
               carried[12] = {1, 0.5, 0.5, 1, 1.5, 0.5, 2, 0.5, 0.5, 2, 1.5, 0.5},
               apart[12] = {4, 0.5, 0.5, 4, 1.5, 0.5, 2, 0.5, 0.5, 2, 1.5, 0.5};
  double steps[12], p[6], fraction = 0;
  dsw_environment *environment = make_environment(NULL, 3, 2, 1);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  dsw_body_id bodies[2];
  const dsw_body_contact *c = NULL;
  dsw_move_report r[2];
  size_t count = 0, i;
  bodies[0] = make_edge_body(scene, kAt, DSW_LEVEL_EDGES_SWEPT);
  bodies[1] = make_edge_body(scene, ahead, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_body_set_radius(scene, bodies[0], 0.25));
  CHECK_OK(dsw_body_set_radius(scene, bodies[1], 0.25));
  CHECK_OK(dsw_scene_move_together(scene, bodies, 2, carried, 4, 0, NULL, r));
  CHECK(r[0].fraction == 1 && r[1].fraction == 1);
  for (i = 0; i < 12; ++i) steps[i] = apart[i] - carried[i];
  CHECK_OK(dsw_scene_step_fraction(scene, bodies, 2, steps, 4, 0, NULL, 0, NULL, &fraction, NULL, NULL, NULL));
  CHECK(fraction <= 0.5 / 3 * (1 + 1e-9) && fraction > 0.5 / 3 * (1 - 1e-9));
  CHECK_OK(dsw_scene_move_together(scene, bodies, 2, apart, 4, 0, NULL, r));
  CHECK(r[0].fraction <= 0.5 / 3 * (1 + 1e-9) && r[0].fraction > 0.5 / 3 * (1 - 1e-9));
  CHECK_OK(dsw_body_get_contacts(scene, bodies[0], &c, &count));
  CHECK(count == 1 && c->contact.normal[0] == -1 && fabs(c->point[0] - 2) < 1e-9);
  CHECK_OK(dsw_body_get_positions(scene, bodies[0], p, 2, 0, NULL, &count));
  CHECK(p[0] <= 1.5 + 1e-10 && p[0] > 1.5 - 1e-9);
  for (i = 0; i < 12; ++i) steps[i] = i % 3 == 0 ? 2 : 0;
  CHECK_OK(dsw_scene_step_fraction(scene, bodies, 2, steps, 4, 0, NULL, 0, NULL, &fraction, NULL, NULL, NULL));
  CHECK(fraction <= 0.375 * (1 + 1e-9) && fraction > 0.375 * (1 - 1e-9));
  end_scene(scene);
}

static void two_segments_meet_in_the_plane(void) {
  const double a[4] = {0.5, 0.5, 0.5, 1.5}, b[4] = {2.5, 1, 1.5, 1};
  const double targets[8] = {1, 0.5, 1, 1.5, 2, 1, 1, 1};
  dsw_environment *environment = make_squares(NULL, 3, 2);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  dsw_body_id bodies[2];
  const dsw_body_contact *c = NULL;
  const dsw_contact_partner *partner = NULL;
  dsw_move_report r[2];
  size_t count = 0;
  bodies[0] = make_edge_body(scene, a, DSW_LEVEL_EDGES_SWEPT);
  bodies[1] = make_edge_body(scene, b, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_scene_move_together(scene, bodies, 2, targets, 4, 0, NULL, r));
  CHECK(r[0].fraction > 0.999 && r[0].fraction < 1 && r[1].fraction == r[0].fraction);
  CHECK_OK(dsw_body_get_contacts(scene, bodies[0], &c, &count));
  CHECK(count == 1 && c->time == 1 && c->edge.generation != 0 && c->contact.normal[0] == -1 && c->point[0] == 1 &&
        c->point[1] == 1 && c->edge_parameter == 0.5 && c->contact.kind == DSW_CONTACT_VERTEX);
  CHECK_OK(dsw_body_get_contact_partners(scene, bodies[0], &partner, &count));
  CHECK(count == 1 && partner->body.index == bodies[1].index && partner->vertex.index == 1);
  CHECK_OK(dsw_body_get_contacts(scene, bodies[1], &c, &count));
  CHECK(count == 1 && c->vertex.index == 1 && c->edge.generation == 0 && c->contact.normal[0] == 1 &&
        c->contact.kind == DSW_CONTACT_EDGE);
  end_scene(scene);
}

/* Every allocation is refused in turn: then nothing has moved. */
static void memory_runs_out(dsw_together_stop stop) {
  const double b[6] = {2.5, 1, 0.25, 2.5, 1, 0.75},
               targets[12] = {1, 0.5, 0.5, 1, 1.5, 0.5, 0.5, 1, 0.25, 0.5, 1, 0.75};
  host h;
  dsw_context *context = make_context(&h);
  dsw_environment *environment = make_environment(context, 3, 2, 1);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  dsw_body_id bodies[2];
  dsw_together_options o = together_options();
  dsw_move_report r[2];
  double p[6];
  size_t n = 0, count = 0;
  o.stop = stop;
  bodies[0] = make_edge_body(scene, kAt, DSW_LEVEL_EDGES_SWEPT);
  bodies[1] = make_edge_body(scene, b, DSW_LEVEL_EDGES_SWEPT);
  while (n < 1000 && RUNS_OUT(&h, n, dsw_scene_move_together(scene, bodies, 2, targets, 4, 0, &o, r))) {
    CHECK_OK(dsw_body_get_positions(scene, bodies[0], p, 2, 0, NULL, &count));
    CHECK(memcmp(p, kAt, sizeof p) == 0);
    CHECK_OK(dsw_body_get_positions(scene, bodies[1], p, 2, 0, NULL, &count));
    CHECK(memcmp(p, b, sizeof p) == 0);
    ++n;
  }
  CHECK(n > 3 && n < 1000 && r[0].fraction < 1 && r[0].contact_count == 1);
  end_scene(scene);
  end_context(context, &h);
}

/* What nearly touches needs integers, and these are long where the least double stands beside 1. */
static void too_much_work_leaves_all_where_it_is(void) {
  const double least = 5e-324, at[6] = {1e-300, 1.0 / 3, 1e-160, 1e-100, 1e-200, least},
               targets[6] = {1e-160, 0.7, 0.5, 1, 1, least}, other[6] = {least, 1e-300, 1.1, 0.5, 0.5, 1e-160};
  dsw_environment *environment = make_environment(NULL, 3, 3, 3);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  const dsw_body_id body = make_edge_body(scene, at, DSW_LEVEL_EDGES_SWEPT);
  dsw_together_options o = together_options();
  dsw_move_report report;
  double p[6];
  size_t count = 0;
  int stop;
  make_edge_body(scene, other, DSW_LEVEL_EDGES_SWEPT);
  o.max_work = 1;
  for (stop = DSW_TOGETHER_STOP_ALL; stop <= DSW_TOGETHER_STOP_FEATURE; ++stop) {
    o.stop = (dsw_together_stop)stop;
    CHECK_OK(move_one(scene, body, targets, &o, &report));
    CHECK(report.fraction == 0 && report.vertices_moved == 2 && report.vertices_stopped == 2);
    CHECK(report.vertices_limited == 2 && report.contact_count == 0);
    CHECK_OK(dsw_body_get_positions(scene, body, p, 2, 0, NULL, &count));
    CHECK(memcmp(p, at, sizeof p) == 0);
  }
  CHECK_OK(move_one(scene, body, targets, NULL, &report));
  CHECK(report.vertices_limited == 0 && report.vertices_stopped == 2 && report.contact_count == 1);
  CHECK(report.fraction > 0.499 && report.fraction <= 0.5);
  end_scene(scene);
}

int main(void) {
  bad_arguments_are_refused();
  a_wall_stops_it();
  a_wall_lets_it_slide();
  what_lies_beside_the_way_stops_a_slide();
  thick_bodies_keep_their_distance();
  two_segments_meet_in_the_plane();
  memory_runs_out(DSW_TOGETHER_STOP_ALL);
  memory_runs_out(DSW_TOGETHER_STOP_FEATURE);
  too_much_work_leaves_all_where_it_is();
  return check_result();
}
