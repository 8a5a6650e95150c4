/* Moves of bodies: contacts, responses, searches, what 0 means in options, histories, partners, rigid motions. */
#include <string.h>

#include "calls.h"

/* A block of 4 x 4 x 4 whose volume (2, 1, 1) is impassable, and wires below it. */
static dsw_environment *make_obstacle(void) {
  dsw_environment *const environment = make_block(NULL, 4, 4, 4, 0);
  const dsw_volume_id solid = volume_at(environment, 2 + 4 * (1 + 4 * 1));
  TRY(dsw_environment_mark_volumes(environment, &solid, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  return environment;
}

static void say_report(const dsw_move_report *report) {
  say("  moved %u, stopped %u, contacts %u, edits %u, limited %u, reserved %u", report->vertices_moved,
      report->vertices_stopped, report->contact_count, report->edit_count, report->vertices_limited, report->reserved);
  say_numbers("  fraction", &report->fraction, 1);
}

static void say_body(const dsw_scene *scene, dsw_body_id body) {
  double positions[3 * 8];
  size_t count = 0, i;
  TRY(dsw_body_get_positions(scene, body, positions, 8, 0, NULL, &count));
  for (i = 0; i < count && i < 8; ++i) say_numbers("  vertex", positions + 3 * i, 3);
}

static void say_contacts(const dsw_scene *scene, dsw_body_id body) {
  const dsw_body_contact *contacts = NULL;
  size_t count = 99, i;
  TRY(dsw_body_get_contacts(scene, body, &contacts, &count));
  for (i = 0; i < count; ++i) {
    say("  vertex %u, edge %s, face %s, history %d", contacts[i].vertex.index, contacts[i].edge.generation == 0 ? "null" : "there",
        contacts[i].face.generation == 0 ? "null" : "there", (int)contacts[i].history);
    say_numbers("  time", &contacts[i].time, 1);
    say_numbers("  point", contacts[i].point, 3);
    say_numbers("  parameter", &contacts[i].edge_parameter, 1);
    say_numbers("  distance left", &contacts[i].distance_left, 1);
    say_contact(&contacts[i].contact);
  }
}

/* An edge along x whose second end rises beside the cube, so that the edge meets the cube's edge at x = 3, z = 1. */
static const double from[6] = {0.5, 1.5, 0.5, 3.9, 1.5, 0.5}, to[6] = {0.5, 1.5, 0.5, 3.9, 1.5, 2.5};

static void move_with(const char *name, const dsw_move_options *options, dsw_level level) {
  dsw_environment *const environment = make_obstacle();
  dsw_scene *const scene = make_scene(environment, 0);
  const dsw_body_id body = make_wire(scene, from, level, 0);
  const dsw_body_edit *edits = NULL;
  dsw_move_report report;
  size_t count = 99, i;
  say("  %s", name);
  TRY(dsw_body_move(scene, body, to, 2, 0, options, &report));
  say_report(&report);
  say_contacts(scene, body);
  TRY(dsw_body_get_edits(scene, body, &edits, &count));
  for (i = 0; i < count; ++i) {
    say("  inserted %u", edits[i].inserted);
    say_numbers("  at", &edits[i].edge_parameter, 1);
  }
  say_body(scene, body);
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_environment_destroy(environment));
}

static void responses(void) {
  static const char *const names[6] = {"stop", "one", "many", "hybrid", "slide", "adaptive slide"};
  static const char *const searches[3] = {"exact", "exhaustive", "bisection"};
  dsw_move_options options;
  int i;
  for (i = 0; i < 6; ++i) {
    dsw_move_options_init(&options, sizeof options);
    options.edge_response = (dsw_response)i;
    if (i == DSW_RESPONSE_SLIDE) options.vertex_response = DSW_RESPONSE_SLIDE;
    move_with(names[i], &options, DSW_LEVEL_EDGES_SWEPT);
  }
  for (i = 0; i < 3; ++i) {
    dsw_move_options_init(&options, sizeof options);
    options.search = (dsw_search)i;
    move_with(searches[i], &options, DSW_LEVEL_EDGES);
  }
  move_with("by default", NULL, DSW_LEVEL_EDGES_SWEPT);
}

/* An edge whose moving end is at x = 3.5 meets the cube at x = 3, which is at this share of the edge. */
static void insert_at(double share, double min_part) {
  dsw_environment *const environment = make_obstacle();
  dsw_scene *const scene = make_scene(environment, 0);
  double ends[6] = {3.5, 1.5, 0.5, 0, 1.5, 0.5}, targets[6];
  dsw_move_options options;
  dsw_move_report report;
  dsw_body_id body;
  ends[3] = 3.5 - 0.5 / share;
  memcpy(targets, ends, sizeof ends);
  targets[2] = 1.75;
  body = make_wire(scene, ends, DSW_LEVEL_EDGES_SWEPT, 0);
  dsw_move_options_init(&options, sizeof options);
  options.edge_response = DSW_RESPONSE_ADAPTIVE_MANY;
  options.min_part = min_part;
  TRY(dsw_body_move(scene, body, targets, 2, 0, &options, &report));
  say("  share %g, min_part %g: %u edits", share, min_part, report.edit_count);
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_environment_destroy(environment));
}

static void what_0_means(void) {
  dsw_move_options options;
  insert_at(0.24, 0), insert_at(0.24, 0.25), insert_at(0.24, 0.2);
  insert_at(0.26, 0), insert_at(0.26, 0.25), insert_at(0.26, 0.3);
  dsw_move_options_init(&options, sizeof options);
  options.search = DSW_SEARCH_BISECTION;
  move_with("depth 0", &options, DSW_LEVEL_EDGES);
  options.bisection_depth = 4;
  move_with("depth 4", &options, DSW_LEVEL_EDGES);
}

static void refused(dsw_scene *scene, dsw_body_id body) {
  static const uint32_t twice[2] = {0, 0};
  const double bad[6] = {0, 0, 0, 0, 0, 1e300 * 1e300};
  dsw_move_options options;
  TRY(dsw_body_move(scene, body, to, 1, 0, NULL, NULL));
  TRY(dsw_body_move(scene, body, bad, 2, 0, NULL, NULL));
  TRY(dsw_body_move(scene, body, NULL, 2, 0, NULL, NULL));
  dsw_move_options_init(&options, sizeof options);
  options.order = twice, options.order_count = 2;
  TRY(dsw_body_move(scene, body, to, 2, 0, &options, NULL));
  dsw_move_options_init(&options, sizeof options);
  options.vertex_response = DSW_RESPONSE_HYBRID;
  TRY(dsw_body_move(scene, body, to, 2, 0, &options, NULL));
  dsw_move_options_init(&options, sizeof options);
  options.min_part = 0.6;
  TRY(dsw_body_move(scene, body, to, 2, 0, &options, NULL));
  dsw_move_options_init(&options, sizeof options);
  options.bisection_depth = 53;
  TRY(dsw_body_move(scene, body, to, 2, 0, &options, NULL));
}

/* One contact in three moves lasts; after a move away it is new again. */
static void histories(dsw_scene *scene, dsw_body_id body) {
  const dsw_previous_contact *pasts = NULL;
  dsw_move_report report;
  size_t count = 99;
  int i;
  for (i = 0; i < 3; ++i) {
    TRY(dsw_body_move(scene, body, to, 2, 0, NULL, &report));
    TRY(dsw_body_get_previous_contacts(scene, body, &pasts, &count));
    say("  %u before, since %u, moves %u, touching %u, obstacle %d", (unsigned)count, pasts[0].since, pasts[0].moves,
        pasts[0].touching, (int)pasts[0].obstacle.kind);
    say_numbers("  point", pasts[0].point, 3);
    say_contacts(scene, body);
  }
  TRY(dsw_body_move(scene, body, from, 2, 0, NULL, &report));
  say_report(&report);
  TRY(dsw_body_move(scene, body, to, 2, 0, NULL, &report));
  say_contacts(scene, body);
}

static void meeting(dsw_scene *scene, dsw_body_id body) {
  static const double other[6] = {1, 0.5, 1, 1, 2.5, 1}, down[6] = {1, 0.5, 0.25, 1, 2.5, 0.25};
  const dsw_contact_partner *partners = NULL;
  const dsw_body_id wire = make_wire(scene, other, DSW_LEVEL_EDGES_SWEPT, 0);
  dsw_body_id both[2];
  double targets[12];
  dsw_move_report reports[2];
  size_t count = 99;
  both[0] = wire, both[1] = body;
  memcpy(targets, down, sizeof down);
  memcpy(targets + 6, from, sizeof from);
  TRY(dsw_scene_move_bodies(scene, both, 2, targets, 4, 0, NULL, reports));
  say_report(&reports[0]);
  say_report(&reports[1]);
  say_contacts(scene, wire);
  TRY(dsw_body_get_contact_partners(scene, wire, &partners, &count));
  say("  %u partners, the first %s", (unsigned)count, count > 0 && partners[0].body.index == body.index ? "is the body" : "is NOT the body");
  both[1] = wire;
  TRY(dsw_scene_move_bodies(scene, both, 2, targets, 4, 0, NULL, reports));
  TRY(dsw_scene_move_bodies(scene, both, 1, targets, 3, 0, NULL, reports));
  TRY(dsw_body_destroy(scene, wire));
}

/* How far a body goes before it touches may differ between versions: 2.0 halved its motion. */
static void rigid(dsw_scene *scene, dsw_body_id body) {
  dsw_rigid_motion motion = {{0, 0, 0, 1}, {0, 0, 0}, {0, 0, 1}};
  dsw_move_report report;
  TRY(dsw_body_move_rigid(scene, body, &motion, NULL, &report));
  say("  moved %u, stopped %u, contacts %u, a part of the way: %s", report.vertices_moved, report.vertices_stopped,
      report.contact_count, report.fraction > 0 && report.fraction < 1 ? "yes" : "NO");
  motion.translation[2] = -0.25;
  TRY(dsw_body_move_rigid(scene, body, &motion, NULL, &report));
  say_report(&report);
  motion.rotation[3] = 0;
  TRY(dsw_body_move_rigid(scene, body, &motion, NULL, &report));
}

/* What libccd says is compared elsewhere: a build may be without it. */
static void second_opinion(dsw_environment *environment, dsw_scene *scene, dsw_body_id body) {
  const dsw_body_contact *contacts = NULL;
  dsw_cross_check result;
  dsw_status status;
  size_t count = 0;
  TRY(dsw_body_move(scene, body, to, 2, 0, NULL, NULL));
  TRY(dsw_body_get_contacts(scene, body, &contacts, &count));
  status = dsw_environment_cross_check(environment, contacts, &result);
  say("  cross check %s", status == DSW_STATUS_OK || status == DSW_STATUS_NOT_BUILT ? "answers" : dsw_status_string(status));
  status = dsw_environment_cross_check(environment, NULL, &result);
  say("  cross check of none %s", status == DSW_STATUS_NULL_ARGUMENT || status == DSW_STATUS_NOT_BUILT ? "answers" : dsw_status_string(status));
}

void call_moves(void) {
  const dsw_contact_partner *partners = NULL;
  dsw_environment *environment;
  dsw_scene *scene;
  dsw_body_id body;
  size_t count = 0;
  say("* moves");
  responses();
  what_0_means();
  environment = make_obstacle();
  scene = make_scene(environment, 0);
  body = make_wire(scene, from, DSW_LEVEL_EDGES_SWEPT, 0);
  refused(scene, body);
  histories(scene, body);
  second_opinion(environment, scene, body);
  TRY(dsw_body_get_contact_partners(scene, body, &partners, &count));
  TRY(dsw_scene_destroy(scene));
  scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  body = make_wire(scene, from, DSW_LEVEL_EDGES_SWEPT, 0);
  meeting(scene, body);
  rigid(scene, body);
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_environment_destroy(environment));
}
