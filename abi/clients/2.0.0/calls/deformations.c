/* Environments that bend: methods, responses, what is held, what is refused. */
#include <string.h>

#include "calls.h"

enum { POINTS = 27 };

/* Two layers of 2 x 2 cubes; a wire lies in the upper layer, above the face between the layers, which is a wall. */
typedef struct stage {
  dsw_environment *environment;
  dsw_scene *scene;
  dsw_body_id body;
  double next[3 * POINTS];
} stage;

static void begin(stage *s, double height) {
  double wire[6] = {0.5, 0.5, 0, 1.5, 0.5, 0};
  const double *points = NULL;
  size_t count = 0;
  s->environment = make_block(NULL, 2, 2, 2, 0);
  s->scene = make_scene(s->environment, DSW_FEATURE_DEFORMING);
  {
    const dsw_face_id walls[2] = {face_between(s->environment, volume_at(s->environment, 0), volume_at(s->environment, 4)),
                                  face_between(s->environment, volume_at(s->environment, 1), volume_at(s->environment, 5))};
    TRY(dsw_environment_mark_faces(s->environment, walls, 2, DSW_MARK_IMPASSABLE));
  }
  wire[2] = wire[5] = height;
  s->body = make_wire(s->scene, wire, DSW_LEVEL_EDGES_SWEPT, 0);
  TRY(dsw_environment_get_points(s->environment, &points, &count));
  say("  %u points", (unsigned)count);
  memcpy(s->next, points, sizeof s->next);
}

static void end(stage *s) {
  TRY(dsw_scene_destroy(s->scene));
  TRY(dsw_environment_destroy(s->environment));
}

static void raise_wall(stage *s, double by) {
  int i;
  for (i = 9; i < 18; ++i) s->next[3 * i + 2] += by;
}

/* A later version may find a way to go on where 2.0 held a vertex of the wall. */
static void say_outcome(const stage *s, const dsw_deform_report *report, int may_hold) {
  const dsw_wall_contact *contacts = NULL;
  const dsw_vertex_id *held = NULL;
  const dsw_volume_id *invalid = NULL;
  double positions[3 * 8];
  size_t counts[3] = {99, 99, 99}, count = 0;
  if (report->outcome == DSW_DEFORM_DONE || report->outcome == DSW_DEFORM_HELD) {
    say("  %s, held vertices %s", may_hold ? "done or held" : report->outcome == DSW_DEFORM_DONE ? "done" : "held",
        (report->held_count > 0) == (report->outcome == DSW_DEFORM_HELD) ? "as the outcome says" : "NOT as the outcome says");
  } else {
    say("  outcome %d, held %u", (int)report->outcome, report->held_count);
  }
  say("  invalid %u, remeshed %u, contacts %s", report->invalid_count, report->remeshed_count,
      report->contact_count > 0 ? "some" : "0");
  say_numbers("  fraction", &report->fraction, 1);
  TRY(dsw_environment_get_wall_contacts(s->environment, &contacts, &counts[0]));
  TRY(dsw_environment_get_held_vertices(s->environment, &held, &counts[1]));
  TRY(dsw_environment_get_invalid_volumes(s->environment, &invalid, &counts[2]));
  say("  lists %s", counts[0] == report->contact_count && counts[1] == report->held_count && counts[2] == report->invalid_count
                        ? "as the report says" : "NOT as the report says");
  if (counts[0] > 0) {
    say("  response %d, kind %d, edge %s, reserved %u", (int)contacts[0].response, (int)contacts[0].contact.kind,
        contacts[0].edge.generation == 0 ? "null" : "there", contacts[0].reserved);
  }
  TRY(dsw_body_get_positions(s->scene, s->body, positions, 8, 0, NULL, &count));
  say("  %u vertices, the first %s the wall", (unsigned)count, positions[2] > s->next[3 * 9 + 2] ? "above" : "NOT above");
}

static void responses(void) {
  static stage s;
  dsw_deform_options options;
  dsw_deform_report report;
  int method, response;
  for (method = DSW_DEFORM_SWEPT; method <= DSW_DEFORM_END_STATE; ++method) {
    for (response = DSW_WALL_PUSH; response <= DSW_WALL_STOP; ++response) {
      begin(&s, 1.25);
      dsw_deform_options_init(&options, sizeof options);
      options.method = (dsw_deform_method)method, options.response = (dsw_wall_response)response;
      raise_wall(&s, 0.5);
      say("  method %d, response %d", method, response);
      if (TRY(dsw_environment_deform(s.environment, s.next, POINTS, &options, &report)) == DSW_STATUS_OK) {
        say_outcome(&s, &report, response == DSW_WALL_INSERT);
      }
      end(&s);
    }
  }
}

static void simple(void) {
  static stage s;
  static double other[3 * POINTS];
  const double *points = NULL;
  dsw_deform_report report;
  size_t count = 0;
  int valid = 9;
  begin(&s, 1.75);
  raise_wall(&s, 0.25);
  TRY(dsw_environment_deform(s.environment, s.next, POINTS, NULL, &report));
  say_outcome(&s, &report, 0);
  TRY(dsw_environment_get_points(s.environment, &points, &count));
  say("  the array %s", points == s.next ? "is the host's" : "is ANOTHER");
  TRY(dsw_environment_deform(s.environment, s.next, POINTS, NULL, &report));
  memcpy(other, s.next, sizeof other);
  TRY(dsw_environment_deform(s.environment, other, POINTS - 1, NULL, &report));
  TRY(dsw_environment_deform(s.environment, NULL, POINTS, NULL, &report));
  TRY(dsw_environment_deform(s.environment, other, POINTS, NULL, NULL));
  TRY(dsw_environment_is_valid(s.environment, volume_at(s.environment, 0), &valid));
  say("  valid %d", valid);
  TRY(dsw_environment_is_valid(s.environment, no_volume, &valid));
  end(&s);
}

/* A vertex of a volume that the wire crosses passes another. */
static void invalid(void) {
  static stage s;
  dsw_deform_options options;
  dsw_deform_report report;
  int k, valid = 9;
  for (k = DSW_INVALID_HOLD; k <= DSW_INVALID_REFUSE; ++k) {
    begin(&s, 1.75);
    dsw_deform_options_init(&options, sizeof options);
    options.invalid = (dsw_invalid_response)k;
    s.next[3 * 22] = 2.5;
    TRY(dsw_environment_deform(s.environment, s.next, POINTS, &options, &report));
    say_outcome(&s, &report, 0);
    TRY(dsw_environment_is_valid(s.environment, volume_at(s.environment, 5), &valid));
    say("  valid %d", valid);
    end(&s);
  }
}

static void refused(void) {
  static double next[3 * POINTS];
  dsw_environment *const environment = make_block(NULL, 2, 2, 2, 0);
  dsw_scene *scene = make_scene(environment, 0), *second = NULL;
  dsw_deform_options options;
  dsw_scene_desc desc;
  const double *points = NULL;
  size_t count = 0;
  TRY(dsw_environment_get_points(environment, &points, &count));
  memcpy(next, points, sizeof next);
  TRY(dsw_environment_deform(environment, next, POINTS, NULL, NULL));
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  TRY(dsw_scene_create(environment, &desc, &second));
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_scene_create(environment, &desc, &scene));
  TRY(dsw_scene_create(environment, NULL, &second));
  dsw_deform_options_init(&options, sizeof options);
  options.most_halvings = 11;
  TRY(dsw_environment_deform(environment, next, POINTS, &options, NULL));
  options.most_halvings = 0, options.method = (dsw_deform_method)2;
  TRY(dsw_environment_deform(environment, next, POINTS, &options, NULL));
  options.method = DSW_DEFORM_SWEPT, options.point_room = POINTS - 1;
  TRY(dsw_environment_deform(environment, next, POINTS, &options, NULL));
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_environment_destroy(environment));
}

void call_deformations(void) {
  say("* deformations");
  simple();
  responses();
  invalid();
  refused();
}
