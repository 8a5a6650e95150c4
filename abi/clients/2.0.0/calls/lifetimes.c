/* What a pointer of the library is good for: until the next call that writes the environment or the scene. Calls that
 * only read come between; what the pointer shows is compared with a copy. */
#include <string.h>

#include "calls.h"

static dsw_environment *env;
static dsw_scene *scene;
static dsw_body_id body;

/* Reads of everything, and calls on other objects. */
static void read_much(void) {
  static unsigned char block[1 << 17];
  static const double start[3] = {0.5, 0.5, 0.5}, end[3] = {3.5, 2.5, 1.5};
  dsw_environment *const other = make_block(NULL, 4, 4, 4, 0);
  dsw_scene *const other_scene = make_scene(other, DSW_FEATURE_BODY_CONTACTS);
  dsw_nearest nearest;
  dsw_flight flights[2];
  double from[6], to[6];
  size_t size = 0, i;
  memcpy(from, start, sizeof start), memcpy(from + 3, end, sizeof end);
  memcpy(to, end, sizeof end), memcpy(to + 3, start, sizeof start);
  for (i = 0; i < 50; ++i) {
    dsw_environment_cast_segments(env, 2, NULL, from, to, 0, NULL, flights);
    dsw_environment_find_nearest(env, start, no_volume, 10, &nearest);
  }
  dsw_environment_save(env, block, sizeof block, &size);
  if (scene != NULL) dsw_scene_save(scene, block, sizeof block, &size);
  dsw_environment_check(env, NULL);
  dsw_scene_destroy(other_scene);
  dsw_environment_destroy(other);
}

static void keep(const char *name, const void *pointer, size_t size_bytes) {
  unsigned char copy[4096];
  const size_t size = size_bytes < sizeof copy ? size_bytes : sizeof copy;
  if (size != 0) memcpy(copy, pointer, size);
  read_much();
  say("  %s %s%s", name, size == 0 || memcmp(copy, pointer, size) == 0 ? "stay" : "CHANGE", size_bytes == 0 ? ", none" : "");
}

#define KEEP(call, type)                        \
  do {                                          \
    const type *pointer = NULL, *again = NULL;  \
    size_t held = 0, more = 0;                  \
    (call(pointer, held));                      \
    keep(#type, pointer, held * sizeof *pointer);  \
    (call(again, more));                        \
    say("  asked again: %s", again == pointer && more == held ? "the same" : "ANOTHER"); \
  } while (0)

#define CONTACTS(p, n) TRY(dsw_body_get_contacts(scene, body, &p, &n))
#define PARTNERS(p, n) TRY(dsw_body_get_contact_partners(scene, body, &p, &n))
#define PASTS(p, n) TRY(dsw_body_get_previous_contacts(scene, body, &p, &n))
#define EDITS(p, n) TRY(dsw_body_get_edits(scene, body, &p, &n))
#define OCCUPANTS(p, n) TRY(dsw_scene_get_occupant_bodies(scene, &p, &n))
#define PARTICLES(p, n) TRY(dsw_scene_get_occupants(scene, &p, &n))
#define POINTS(p, n) TRY(dsw_environment_get_points(env, &p, &n))
#define OFFENDING(p, n) TRY(dsw_scene_get_offending_edges(scene, &p, &n))
#define WALL_CONTACTS(p, n) TRY(dsw_environment_get_wall_contacts(env, &p, &n))
#define HELD(p, n) TRY(dsw_environment_get_held_vertices(env, &p, &n))

static void of_bodies(void) {
  static const double from[6] = {0.5, 1.5, 0.5, 3.9, 1.5, 0.5}, to[6] = {0.5, 1.5, 0.5, 3.9, 1.5, 2.5};
  static const double place[3] = {3.5, 3.5, 3.5}, out[6] = {0.5, 1.5, 0.5, 9, 9, 9};
  const dsw_volume_id solid = volume_at(env, 2 + 4 * (1 + 4 * 1)), full = volume_at(env, 63), first = volume_at(env, 4);
  static const uint32_t edge[2] = {0, 1};
  dsw_move_options options;
  dsw_particle_id particle;
  dsw_body_desc desc;
  dsw_body_id none;
  scene = make_scene(env, DSW_FEATURE_BODY_CONTACTS);
  TRY(dsw_environment_mark_volumes(env, &solid, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  body = make_wire(scene, from, DSW_LEVEL_EDGES_SWEPT, 0);
  TRY(dsw_particle_create(scene, place, no_volume, &particle));
  dsw_move_options_init(&options, sizeof options);
  options.edge_response = DSW_RESPONSE_ADAPTIVE_MANY;
  TRY(dsw_body_move(scene, body, to, 2, 0, &options, NULL));
  KEEP(CONTACTS, dsw_body_contact);
  KEEP(PARTNERS, dsw_contact_partner);
  KEEP(PASTS, dsw_previous_contact);
  KEEP(EDITS, dsw_body_edit);
  KEEP(POINTS, double);
  TRY(dsw_environment_mark_volumes(env, &first, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  KEEP(OCCUPANTS, dsw_body_id);
  TRY(dsw_environment_mark_volumes(env, &full, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  KEEP(PARTICLES, dsw_particle_id);
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = out, desc.vertex_count = 2, desc.edges = edge, desc.edge_count = 1;
  TRY(dsw_body_create(scene, &desc, &none));
  KEEP(OFFENDING, uint32_t);
  TRY(dsw_scene_destroy(scene));
  scene = NULL;
}

static void of_deformations(void) {
  static double next[3 * 125];
  static const double wire[6] = {0.5, 0.5, 1.25, 1.5, 0.5, 1.25};
  const dsw_face_id wall = face_between(env, volume_at(env, 0), volume_at(env, 16));
  const double *points = NULL;
  dsw_deform_options options;
  size_t count = 0, i;
  TRY(dsw_environment_mark_faces(env, &wall, 1, DSW_MARK_IMPASSABLE));
  scene = make_scene(env, DSW_FEATURE_DEFORMING);
  body = make_wire(scene, wire, DSW_LEVEL_EDGES_SWEPT, 0);
  TRY(dsw_environment_get_points(env, &points, &count));
  memcpy(next, points, sizeof next);
  for (i = 25; i < 50; ++i) next[3 * i + 2] += 0.5;
  dsw_deform_options_init(&options, sizeof options);
  options.response = DSW_WALL_HOLD;
  TRY(dsw_environment_deform(env, next, 125, &options, NULL));
  KEEP(WALL_CONTACTS, dsw_wall_contact);
  KEEP(HELD, dsw_vertex_id);
  TRY(dsw_scene_destroy(scene));
  scene = NULL;
}

static void of_changes(void) {
  static const double blade[12] = {1.25, -1, -1, 1.25, 5, -1, 1.25, -1, 5, 1.25, 5, 5};
  dsw_change change;
  dsw_cut_desc desc;
  memset(&change, 0, sizeof change);
  change.struct_size = sizeof change;
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = blade, desc.rows = desc.columns = 2;
  TRY(dsw_environment_cut(env, &desc, &change));
  keep("volumes", change.volumes, change.volume_count * sizeof *change.volumes);
  keep("vertices", change.vertices, change.vertex_count * sizeof *change.vertices);
  keep("faces", change.faces, change.face_count * sizeof *change.faces);
}

static void of_messages(void) {
  char copy[512];
  const char *const message = dsw_last_error_message();
  strncpy(copy, message, sizeof copy - 1);
  copy[sizeof copy - 1] = 0;
  read_much();
  say("  the message %s", strncmp(copy, dsw_last_error_message(), sizeof copy - 1) == 0 ? "stays after calls that succeed" : "CHANGES");
}

void call_lifetimes(void) {
  static void (*const parts[])(void) = {of_bodies, of_deformations, of_changes};
  size_t i;
  say("* lifetimes");
  for (i = 0; i < sizeof parts / sizeof *parts; ++i) {
    env = make_block(NULL, 4, 4, 4, 0);
    parts[i]();
    TRY(dsw_environment_destroy(env));
  }
  env = make_block(NULL, 4, 4, 4, 0);
  TRY(dsw_environment_destroy(NULL));
  TRY(dsw_environment_get_points(env, NULL, NULL));
  of_messages();
  TRY(dsw_environment_destroy(env));
}
