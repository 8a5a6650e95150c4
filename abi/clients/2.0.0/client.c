/* A host as it was written for 1.0.0. It is compiled with the headers beside it, never changed, and must run with
 * every later library: two hexahedra, marks, casts, a particle, a body, a sweep, a cut, a recording, snapshots. What
 * lies behind its structs is watched: a later library knows larger ones.
 * usage: client               does all this
 *        client write FOLDER  and keeps what the library of its day has saved and recorded
 *        client read FOLDER   and opens that */
#include <stdio.h>
#include <string.h>

#include "dartsweep/dartsweep.h"

static int failures = 0;

static void expect(int holds, const char *what) {
  printf("%s: %s\n", holds ? "ok" : "FAILED", what);
  if (!holds) {
    printf("  last error: %s\n", dsw_last_error_message());
    ++failures;
  }
}

#define GUARD 64
static int is_untouched(const unsigned char *guard) {
  int i;
  for (i = 0; i < GUARD; ++i) {
    if (guard[i] != 0x5a) return 0;
  }
  return 1;
}

static dsw_environment *create_two_boxes(dsw_context *context) {
  static const double points[12][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1},
                                       {1, 1, 1}, {0, 1, 1}, {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  static const int32_t cells[16] = {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11};
  static const int32_t regions[2] = {1, 2};
  dsw_environment_desc desc;
  struct {
    dsw_build_report known;
    unsigned char guard[GUARD];
  } report;
  dsw_environment *environment = NULL;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = &points[0][0];
  desc.point_count = 12;
  desc.uniform_cell_type = DSW_CELL_TYPE_HEXAHEDRON;
  desc.volume_count = 2;
  desc.connectivity = cells;
  desc.connectivity_count = 16;
  desc.regions = regions;
  memset(&report, 0x5a, sizeof report);
  report.known.struct_size = sizeof report.known;
  expect(dsw_environment_create(context, &desc, &environment, &report.known) == DSW_STATUS_OK,
         "create two hexahedra");
  expect(report.known.status == DSW_STATUS_OK && report.known.part_count == 1 &&
             report.known.boundary_face_count == 10 && is_untouched(report.guard),
         "one part with ten outer faces");
  return environment;
}

static void cast(const dsw_environment *environment, dsw_volume_id start) {
  const double from[3] = {0.25, 0.5, 0.25}, near_target[3] = {0.75, 0.5, 0.5}, far_target[3] = {0.25, 0.5, 4.25};
  dsw_cast_options options;
  dsw_flight flight;
  dsw_cast_options_init(&options, sizeof options);
  expect(dsw_environment_cast(environment, start, from, near_target, &options, &flight) == DSW_STATUS_OK &&
             flight.outcome == DSW_OUTCOME_REACHED && flight.time == 1.0,
         "a cast inside of one volume reaches its target");
  expect(dsw_environment_cast(environment, start, from, far_target, NULL, &flight) == DSW_STATUS_OK &&
             flight.outcome == DSW_OUTCOME_CONTACT && flight.time == 0.4375 && flight.contact.normal[2] == -1.0 &&
             flight.volumes_visited == 2 && flight.contact.marked_kind == DSW_CELL_FACE && flight.volume.index == 1,
         "a cast through the roof stops at 7/16 in the second volume");
}

static void move_a_particle(dsw_environment *environment) {
  const double start[3] = {0.5, 0.5, 0.5}, target[3] = {0.5, 0.5, 1.5};
  const dsw_volume_id nowhere = {0, 0};
  dsw_volume_id volume;
  dsw_particle_id particle;
  dsw_scene_desc desc;
  dsw_scene *scene = NULL;
  dsw_flight flight;
  double position[3];
  size_t marked = 0;
  expect(dsw_environment_mark_between(environment, 1, 2, DSW_MARK_IMPASSABLE, &marked) == DSW_STATUS_OK && marked == 1,
         "one face lies between the two regions");
  dsw_scene_desc_init(&desc, sizeof desc);
  expect(dsw_scene_create(environment, &desc, &scene) == DSW_STATUS_OK, "create a scene");
  expect(dsw_particle_create(scene, start, nowhere, &particle) == DSW_STATUS_OK, "create a particle");
  expect(dsw_particle_move(scene, particle, target, NULL, &flight) == DSW_STATUS_OK &&
             flight.outcome == DSW_OUTCOME_CONTACT && flight.time == 0.5 && flight.contact.behind.index == 1,
         "the particle stops at the marked face");
  expect(dsw_particle_get_position(scene, particle, position, &volume) == DSW_STATUS_OK && position[2] <= 1.0 &&
             position[2] > 0.999 && volume.index == 0,
         "it rests on its own side");
  expect(dsw_environment_destroy(environment) == DSW_STATUS_IN_USE, "a used environment is kept");
  expect(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroy the scene");
}

/* What is kept: snapshots of the environment and of a scene, and that scene's recording. */
enum { ENVIRONMENT, SCENE, RECORDING, KEPT };
static const char *const names[KEPT] = {"environment.snapshot", "scene.snapshot", "scene.recording"};
static struct block {
  unsigned char bytes[1 << 16];
  size_t size;
} kept[KEPT];

static FILE *open_kept(const char *folder, int what, const char *mode) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", folder, names[what]);
  return fopen(path, mode);
}

static int append(void *user, const void *bytes, size_t size_bytes) {
  struct block *const block = (struct block *)user;
  if (block->size + size_bytes > sizeof block->bytes) return 1;
  memcpy(block->bytes + block->size, bytes, size_bytes);
  block->size += size_bytes;
  return 0;
}

/* Between the two boxes lies an impassable face, z = 1. */
static void move_a_body(dsw_environment *environment) {
  static const double start[6] = {0.25, 0.5, 0.5, 0.75, 0.5, 0.5}, target[6] = {0.25, 0.5, 1.5, 0.75, 0.5, 0.75};
  static const uint32_t edge[2] = {0, 1};
  size_t count = 0;
  const dsw_body_contact *contacts = NULL;
  dsw_scene_desc desc;
  dsw_recording_desc recording;
  dsw_body_desc shape;
  dsw_move_options options;
  dsw_move_report report;
  dsw_body_id body;
  dsw_scene *scene = NULL;
  struct {
    dsw_statistics known;
    unsigned char guard[GUARD];
  } statistics;
  struct {
    dsw_body_counts known;
    unsigned char guard[GUARD];
  } counts;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_STATISTICS;
  expect(dsw_scene_create(environment, &desc, &scene) == DSW_STATUS_OK, "create a scene that counts");
  dsw_recording_desc_init(&recording, sizeof recording);
  recording.write = append;
  recording.user = &kept[RECORDING];
  expect(dsw_scene_start_recording(scene, &recording) == DSW_STATUS_OK, "record it");
  dsw_body_desc_init(&shape, sizeof shape);
  shape.positions = start;
  shape.vertex_count = 2;
  shape.edges = edge;
  shape.edge_count = 1;
  expect(dsw_body_create(scene, &shape, &body) == DSW_STATUS_OK, "create a body of one edge");
  memset(&counts, 0x5a, sizeof counts);
  counts.known.struct_size = sizeof counts.known;
  expect(dsw_body_get_counts(scene, body, &counts.known) == DSW_STATUS_OK && counts.known.vertex_count == 2 &&
             counts.known.edge_count == 1 && is_untouched(counts.guard),
         "it has two vertices");
  dsw_move_options_init(&options, sizeof options);
  expect(dsw_body_move(scene, body, target, 2, 0, &options, &report) == DSW_STATUS_OK, "move it");
  expect(dsw_body_get_contacts(scene, body, &contacts, &count) == DSW_STATUS_OK && count == 1 &&
             contacts[0].time == 0.5 && contacts[0].contact.normal[2] == -1.0,
         "its first vertex stops at the face");
  memset(&statistics, 0x5a, sizeof statistics);
  statistics.known.struct_size = sizeof statistics.known;
  expect(dsw_scene_get_statistics(scene, &statistics.known) == DSW_STATUS_OK && statistics.known.casts > 0 &&
             is_untouched(statistics.guard),
         "casts were counted");
  expect(dsw_scene_stop_recording(scene) == DSW_STATUS_OK && kept[RECORDING].size > 0, "something was recorded");
  expect(dsw_scene_save(scene, kept[SCENE].bytes, sizeof kept[SCENE].bytes, &kept[SCENE].size) == DSW_STATUS_OK,
         "save the scene");
  expect(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroy the scene");
}

static void sweep_and_cut(dsw_environment *environment) {
  static const double from[3] = {0.25, 0.5, 0.5}, to[3] = {0.25, 0.5, 1.5}, fixed[3] = {0.75, 0.5, 0.5};
  static const double blade[12] = {0.5, -1, -1, 0.5, 2, -1, 0.5, -1, 3, 0.5, 2, 3};
  dsw_sweep_options options;
  dsw_sweep sweep;
  dsw_cut_desc cut;
  struct {
    dsw_change known;
    unsigned char guard[GUARD];
  } change;
  dsw_sweep_options_init(&options, sizeof options);
  expect(dsw_environment_sweep_edges(environment, 1, NULL, from, to, fixed, 0, &options, &sweep) == DSW_STATUS_OK &&
             sweep.outcome == DSW_OUTCOME_CONTACT && sweep.time == 0.5,
         "a swept edge meets the face");
  dsw_cut_desc_init(&cut, sizeof cut);
  cut.points = blade;
  cut.rows = cut.columns = 2;
  memset(&change, 0x5a, sizeof change);
  change.known.struct_size = sizeof change.known;
  expect(dsw_environment_cut(environment, &cut, &change.known) == DSW_STATUS_OK && change.known.volumes_split == 2 &&
             change.known.volume_count == 4 && is_untouched(change.guard),
         "a blade cuts both boxes");
}

static dsw_environment *load_environment(const struct block *block) {
  dsw_environment *copy = NULL;
  struct {
    dsw_environment_info known;
    unsigned char guard[GUARD];
  } info;
  expect(dsw_environment_load(NULL, block->bytes, block->size, &copy) == DSW_STATUS_OK, "load an environment");
  memset(&info, 0x5a, sizeof info);
  info.known.struct_size = sizeof info.known;
  expect(dsw_environment_get_info(copy, &info.known) == DSW_STATUS_OK && info.known.volume_count == 2 &&
             info.known.face_count == 11 && is_untouched(info.guard),
         "it has two volumes and eleven faces");
  return copy;
}

static void check_scene(const struct block *block, dsw_environment *environment) {
  dsw_scene *scene = NULL;
  size_t count = 0;
  expect(dsw_scene_load(environment, block->bytes, block->size, &scene) == DSW_STATUS_OK, "load a scene");
  expect(dsw_scene_get_body_count(scene, &count) == DSW_STATUS_OK && count == 1, "it has a body");
  expect(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroy the scene");
}

/* A later library may do the same in another way: that is told, and no failure. */
static void check_recording(const struct block *block) {
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  int calls = 0;
  expect(dsw_replay_create(NULL, block->bytes, block->size, &replay) == DSW_STATUS_OK, "open a recording");
  while (dsw_replay_step(replay, &report) == DSW_STATUS_OK && report.outcome != DSW_REPLAY_END) {
    expect(report.status == DSW_STATUS_OK && report.outcome != DSW_REPLAY_UNFINISHED, report.function);
    ++calls;
  }
  expect(calls == 2 && report.outcome == DSW_REPLAY_END, "a body was created and moved");
  expect(dsw_replay_destroy(replay) == DSW_STATUS_OK, "close it");
}

static void check_all(const struct block *blocks) {
  dsw_environment *const environment = load_environment(&blocks[ENVIRONMENT]);
  check_scene(&blocks[SCENE], environment);
  expect(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroy the environment");
  check_recording(&blocks[RECORDING]);
}

static void write_all(const char *folder) {
  int i;
  for (i = 0; i < KEPT; ++i) {
    FILE *const file = open_kept(folder, i, "wb");
    expect(file != NULL && fwrite(kept[i].bytes, 1, kept[i].size, file) == kept[i].size, names[i]);
    if (file != NULL) expect(fclose(file) == 0, names[i]);
  }
}

static void read_all(const char *folder) {
  static struct block old[KEPT];
  int i;
  for (i = 0; i < KEPT; ++i) {
    FILE *const file = open_kept(folder, i, "rb");
    expect(file != NULL, names[i]);
    if (file == NULL) return;
    old[i].size = fread(old[i].bytes, 1, sizeof old[i].bytes, file);
    fclose(file);
  }
  check_all(old);
}

int main(int argument_count, char **arguments) {
  dsw_context *context = NULL;
  dsw_context_desc desc;
  dsw_environment *environment;
  dsw_volume_id first = {0, 0};
  dsw_context_desc_init(&desc, sizeof desc);
  desc.thread_count = 2;
  expect(dsw_context_create(&desc, &context) == DSW_STATUS_OK, "create a context");
  environment = create_two_boxes(context);
  if (environment == NULL) return 1;
  expect(dsw_environment_get_volume_id(environment, 0, &first) == DSW_STATUS_OK, "name the first volume");
  expect(dsw_environment_get_volume_id(environment, 2, &first) == DSW_STATUS_OUT_OF_RANGE, "there is no third volume");
  cast(environment, first);
  move_a_particle(environment);
  move_a_body(environment);
  expect(dsw_environment_save(environment, kept[ENVIRONMENT].bytes, sizeof kept[ENVIRONMENT].bytes,
                              &kept[ENVIRONMENT].size) == DSW_STATUS_OK,
         "save the environment");
  check_all(kept);
  if (argument_count == 3 && strcmp(arguments[1], "write") == 0) write_all(arguments[2]);
  if (argument_count == 3 && strcmp(arguments[1], "read") == 0) read_all(arguments[2]);
  sweep_and_cut(environment);
  expect(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroy the environment");
  expect(dsw_context_destroy(context) == DSW_STATUS_OK, "destroy the context");
  expect(strcmp(dsw_status_string(DSW_STATUS_OUTSIDE), "DSW_STATUS_OUTSIDE") == 0, "statuses keep their names");
  printf("%d failures\n", failures);
  return failures != 0;
}
