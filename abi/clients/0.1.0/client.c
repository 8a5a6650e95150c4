/* A host as it was written for 0.1.0. It is compiled with the headers beside it, never changed, and must run with
 * every later library: one hexahedron, marks, casts, a particle, a snapshot. */
#include <stdio.h>
#include <stdlib.h>
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

static dsw_environment *create_two_boxes(dsw_context *context) {
  static const double points[12][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1},
                                       {1, 1, 1}, {0, 1, 1}, {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  static const int32_t cells[16] = {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11};
  static const int32_t regions[2] = {1, 2};
  dsw_environment_desc desc;
  dsw_build_report report;
  dsw_environment *environment = NULL;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = &points[0][0];
  desc.point_count = 12;
  desc.uniform_cell_type = DSW_CELL_TYPE_HEXAHEDRON;
  desc.cell_count = 2;
  desc.connectivity = cells;
  desc.connectivity_count = 16;
  desc.regions = regions;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  expect(dsw_environment_create(context, &desc, &environment, &report) == DSW_STATUS_OK, "create two hexahedra");
  expect(report.status == DSW_STATUS_OK && report.part_count == 1 && report.boundary_face_count == 10,
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
             flight.outcome == DSW_OUTCOME_CONTACT && flight.time == 0.4375 && flight.normal[2] == -1.0 &&
             flight.cells_visited == 2 && flight.obstacle == DSW_CELL_FACE && flight.volume.index == 1,
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
             flight.outcome == DSW_OUTCOME_CONTACT && flight.time == 0.5 && flight.behind.index == 1,
         "the particle stops at the marked face");
  expect(dsw_particle_get(scene, particle, position, &volume) == DSW_STATUS_OK && position[2] <= 1.0 &&
             position[2] > 0.999 && volume.index == 0,
         "it rests on its own side");
  expect(dsw_environment_destroy(environment) == DSW_STATUS_IN_USE, "a used environment is kept");
  expect(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroy the scene");
}

static void save_and_load(const dsw_environment *environment) {
  size_t size = 0;
  void *block;
  dsw_environment *copy = NULL;
  dsw_environment_info info;
  expect(dsw_environment_save(environment, NULL, 0, &size) == DSW_STATUS_OK && size > 0, "ask for a snapshot's size");
  block = malloc(size);
  expect(block != NULL && dsw_environment_save(environment, block, size, &size) == DSW_STATUS_OK, "save");
  expect(dsw_environment_load(NULL, block, size, &copy) == DSW_STATUS_OK, "load");
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  expect(dsw_environment_get_info(copy, &info) == DSW_STATUS_OK && info.volume_count == 2 && info.face_count == 11,
         "the copy has two volumes and eleven faces");
  dsw_environment_destroy(copy);
  free(block);
}

int main(void) {
  dsw_context *context = NULL;
  dsw_context_desc desc;
  dsw_environment *environment;
  dsw_volume_id first = {0, 0};
  dsw_context_desc_init(&desc, sizeof desc);
  desc.thread_count = 2;
  expect(dsw_context_create(&desc, &context) == DSW_STATUS_OK, "create a context");
  environment = create_two_boxes(context);
  if (environment == NULL) return 1;
  expect(dsw_environment_get_volume(environment, 0, &first) == DSW_STATUS_OK, "name the first volume");
  expect(dsw_environment_get_volume(environment, 2, &first) == DSW_STATUS_OUT_OF_RANGE, "there is no third volume");
  cast(environment, first);
  move_a_particle(environment);
  save_and_load(environment);
  expect(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroy the environment");
  expect(dsw_context_destroy(context) == DSW_STATUS_OK, "destroy the context");
  expect(strcmp(dsw_status_string(DSW_STATUS_OUTSIDE), "DSW_STATUS_OUTSIDE") == 0, "statuses keep their names");
  printf("%d failures\n", failures);
  return failures != 0;
}
