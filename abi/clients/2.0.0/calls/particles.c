/* Scenes and particles. */
#include <string.h>

#include "calls.h"

static void say_statistics(const dsw_scene *scene) {
  dsw_statistics statistics;
  memset(&statistics, 0, sizeof statistics);
  statistics.struct_size = sizeof statistics;
  TRY(dsw_scene_get_statistics(scene, &statistics));
  say("  casts %s, contacts %s, tests %s", statistics.casts > 0 ? "some" : "0", statistics.contacts > 0 ? "some" : "0",
      statistics.orientation_tests > 0 ? "some" : "0");
}

static void scenes(dsw_environment *environment) {
  dsw_scene *scene = NULL;
  dsw_scene_desc desc;
  dsw_statistics statistics;
  uint64_t bytes = 0;
  memset(&statistics, 0, sizeof statistics);
  statistics.struct_size = sizeof statistics;
  TRY(dsw_scene_create(NULL, NULL, &scene));
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = 0x40000000u;
  TRY(dsw_scene_create(environment, &desc, &scene));
  TRY(dsw_scene_create(environment, NULL, &scene));
  say("  its environment %s", dsw_scene_get_environment(scene) == environment ? "is the one" : "is ANOTHER");
  say("  that of none %s", dsw_scene_get_environment(NULL) == NULL ? "is null" : "is SET");
  TRY(dsw_scene_get_statistics(scene, &statistics));
  TRY(dsw_scene_reset_statistics(scene));
  TRY(dsw_scene_get_memory_bytes(scene, &bytes));
  say("  memory %s", bytes > 0 ? "some" : "none");
  TRY(dsw_environment_destroy(environment));
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_scene_destroy(NULL));
}

static void particles(dsw_scene *scene) {
  static const double places[9] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5, 2.5, 0.5, 0.5}, outside[6] = {0.5, 0.5, 0.5, 9, 9, 9};
  static const double targets[9] = {0.75, 0.5, 0.5, 1.5, 9, 0.5, 0.5, 0.5, 0.5};
  dsw_particle_id ids[3], listed[3], lone;
  dsw_flight flight, flights[3];
  dsw_volume_id volumes[3], volume;
  double positions[9], position[3];
  size_t count = 99, offender = 99, i;
  TRY(dsw_particle_create(scene, outside + 3, no_volume, &lone));
  TRY(dsw_particle_create(scene, places, no_volume, &lone));
  TRY(dsw_scene_create_particles(scene, outside, 2, 0, NULL, ids, &offender));
  say("  offender %u", (unsigned)offender);
  TRY(dsw_scene_create_particles(scene, places, 3, 0, NULL, ids, &offender));
  TRY(dsw_particle_destroy(scene, lone));
  TRY(dsw_particle_destroy(scene, lone));
  TRY(dsw_scene_get_particle_count(scene, &count));
  say("  count %u", (unsigned)count);
  TRY(dsw_scene_get_particle_ids(scene, listed, 1, &count));
  TRY(dsw_scene_get_particle_ids(scene, listed, 3, &count));
  say("  count %u", (unsigned)count);
  TRY(dsw_particle_move(scene, ids[0], targets, NULL, &flight));
  say_flight("  one", &flight);
  TRY(dsw_scene_move_particles(scene, ids, 3, targets, 0, NULL, flights));
  for (i = 0; i < 3; ++i) say_flight("  many", &flights[i]);
  TRY(dsw_scene_cast_from_particles(scene, ids, 3, places, 0, NULL, flights));
  for (i = 0; i < 3; ++i) say("  outcome %d", (int)flights[i].outcome);
  TRY(dsw_scene_get_particle_positions(scene, ids, 3, positions, 0, volumes));
  say_numbers("  positions", positions, 9);
  say("  volumes %u %u %u", volumes[0].index, volumes[1].index, volumes[2].index);
  TRY(dsw_particle_get_position(scene, ids[1], position, &volume));
  TRY(dsw_particle_get_position(scene, lone, position, &volume));
  TRY(dsw_particle_move(scene, ids[0], NULL, NULL, &flight));
  ids[1] = ids[0];
  TRY(dsw_scene_move_particles(scene, ids, 3, targets, 0, NULL, flights));
  say_statistics(scene);
  TRY(dsw_scene_reset_statistics(scene));
  say_statistics(scene);
}

static void crossings(dsw_scene *scene) {
  static const double target[3] = {2.5, 0.5, 0.5};
  const dsw_crossing *crossed = NULL;
  const size_t *first = NULL;
  dsw_particle_id ids[3];
  dsw_flight flight;
  size_t count = 99, i;
  TRY(dsw_scene_get_particle_ids(scene, NULL, 0, &count));
  TRY(dsw_scene_get_particle_ids(scene, ids, 3, &count));
  TRY(dsw_particle_move(scene, ids[0], target, NULL, &flight));
  TRY(dsw_scene_get_crossings(scene, &crossed, &first, &count));
  say("  %u flights, %u crossings", (unsigned)count, (unsigned)(first[1] - first[0]));
  for (i = first[0]; i < first[1]; ++i) {
    say("  into %u", crossed[i].volume.index);
    say_numbers("  time", &crossed[i].time, 1);
  }
}

static void occupied(dsw_environment *environment, dsw_scene *scene) {
  const dsw_volume_id volumes[2] = {volume_at(environment, 2), volume_at(environment, 1)};
  const dsw_particle_id *who = NULL;
  size_t count = 99, skipped = 99;
  TRY(dsw_environment_mark_volumes(environment, volumes, 2, DSW_MARK_IMPASSABLE, 0, &skipped));
  TRY(dsw_scene_get_occupants(scene, &who, &count));
  say("  %u occupants", (unsigned)count);
  TRY(dsw_environment_mark_volumes(environment, volumes, 1, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, &skipped));
  say("  skipped %u", (unsigned)skipped);
}

void call_particles(void) {
  dsw_environment *const environment = make_block(NULL, 3, 1, 1, 0);
  dsw_scene *scene, *bare;
  const dsw_crossing *crossed = NULL;
  const size_t *first = NULL;
  const dsw_particle_id one = {0, 1};
  const double away[3] = {2.5, 0.5, 0.5};
  dsw_flight flight;
  size_t count = 0;
  say("* particles");
  scenes(environment);
  scene = make_scene(environment, DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS);
  particles(scene);
  crossings(scene);
  occupied(environment, scene);
  bare = make_scene(environment, 0);
  TRY(dsw_scene_get_crossings(bare, &crossed, &first, &count));
  TRY(dsw_particle_move(bare, one, away, NULL, &flight));
  TRY(dsw_environment_mark_region(environment, 0, DSW_MARK_IMPASSABLE, 0, NULL, NULL));
  TRY(dsw_scene_destroy(bare));
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_environment_destroy(environment));
}
