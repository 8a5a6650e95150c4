#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 1 x 1 cubes */

static void init_writes_the_defaults(void) {
  dsw_scene_desc d;
  memset(&d, 0xff, sizeof d);
  dsw_scene_desc_init(&d, sizeof d);
  CHECK(d.struct_size == sizeof d && d.features == 0);
  dsw_scene_desc_init(NULL, sizeof d);
}

static void a_scene_lives_from_create_to_destroy(void) {
  dsw_scene *scene = NULL;
  size_t count = 9;
  uint64_t bytes = 0;
  CHECK_OK(dsw_scene_create(g_env, NULL, &scene));
  CHECK(dsw_scene_get_environment(scene) == g_env && dsw_scene_get_environment(NULL) == NULL);
  CHECK_OK(dsw_scene_get_particle_count(scene, &count));
  CHECK(count == 0);
  CHECK_OK(dsw_scene_get_memory_bytes(scene, &bytes));
  CHECK(bytes > 0 && bytes < 2048);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_memory_bytes(scene, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_memory_bytes(NULL, &bytes));
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_scene_destroy(NULL));
}

static void bad_descriptions_are_refused(void) {
  struct {
    dsw_scene_desc known;
    uint32_t unknown;
  } d;
  dsw_scene *scene = NULL;
  memset(&d, 0, sizeof d);
  d.known.struct_size = sizeof d.known - 1;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_scene_create(g_env, &d.known, &scene));
  d.known.struct_size = sizeof d;
  d.unknown = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_create(g_env, &d.known, &scene));
  d.unknown = 0;
  d.known.features = 0x100;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_create(g_env, &d.known, &scene));
  CHECK_MESSAGE("desc->features is 0x100");
  d.known.features = 0;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_create(NULL, &d.known, &scene));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_create(g_env, &d.known, NULL));
  CHECK(scene == NULL);
  CHECK_OK(dsw_scene_create(g_env, &d.known, &scene));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_scene_destroy((dsw_scene *)(void *)g_env));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void scenes_come_and_go_in_any_order(void) {
  dsw_scene *scenes[3];
  int k;
  static const int order[3] = {1, 0, 2};
  for (k = 0; k < 3; ++k) scenes[k] = make_scene(g_env, 0);
  for (k = 0; k < 3; ++k) {
    CHECK(info_of(g_env).scene_count == 3 - (uint32_t)k);
    CHECK_OK(dsw_scene_destroy(scenes[order[k]]));
  }
  CHECK(info_of(g_env).scene_count == 0);
}

static dsw_statistics statistics_of(dsw_scene *scene) {
  dsw_statistics s;
  memset(&s, 0x55, sizeof s);
  s.struct_size = sizeof s;
  CHECK_OK(dsw_scene_get_statistics(scene, &s));
  CHECK(s.struct_size == sizeof s && s.reserved == 0);
  return s;
}

static void statistics_count_what_was_done(void) {
  dsw_scene *const scene = make_scene(g_env, DSW_FEATURE_STATISTICS);
  const double start[3] = {0.5, 0.5, 0.5}, free_target[3] = {1.5, 0.25, 0.75}, wall[3] = {1.5, 0.25, 3};
  dsw_particle_id p;
  dsw_flight flight;
  dsw_statistics s;
  CHECK_OK(dsw_particle_create(scene, start, no_volume, &p));
  s = statistics_of(scene);
  CHECK(s.casts == 0 && s.orientation_tests == 0); /* locating is not a flight */
  CHECK_OK(dsw_particle_move(scene, p, free_target, NULL, NULL));
  s = statistics_of(scene);
  CHECK(s.casts == 1 && s.volumes_visited == 2 && s.contacts == 0 && s.candidates == 0 && s.orientation_tests >= 6);
  CHECK_OK(dsw_particle_move(scene, p, wall, NULL, NULL));
  s = statistics_of(scene);
  CHECK(s.contacts == 1 && s.candidates >= 1 && s.casts == 2 + s.candidates);
  CHECK(s.volumes_visited == 3 + s.candidates);
  CHECK_OK(dsw_scene_reset_statistics(scene));
  s = statistics_of(scene);
  CHECK(s.casts == 0 && s.volumes_visited == 0 && s.contacts == 0 && s.candidates == 0 && s.orientation_tests == 0);
  CHECK_OK(dsw_scene_cast_from_particles(scene, &p, 1, wall, 0, NULL, &flight));
  s = statistics_of(scene);
  CHECK(s.casts == 1 && s.contacts == 1 && s.candidates == 0);
  CHECK_OK(dsw_scene_destroy(scene));
}

static void statistics_must_be_enabled(void) {
  dsw_scene *const scene = make_scene(g_env, 0), *const counting = make_scene(g_env, DSW_FEATURE_STATISTICS);
  dsw_statistics s;
  s.struct_size = sizeof s;
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, dsw_scene_get_statistics(scene, &s));
  CHECK_MESSAGE("DSW_FEATURE_STATISTICS");
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, dsw_scene_reset_statistics(scene));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_statistics(NULL, &s));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_reset_statistics(NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_statistics(counting, NULL));
  s.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_scene_get_statistics(counting, &s));
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_scene_destroy(counting));
}

int main(void) {
  g_env = make_environment(NULL, 4, 1, 1);
  init_writes_the_defaults();
  a_scene_lives_from_create_to_destroy();
  bad_descriptions_are_refused();
  scenes_come_and_go_in_any_order();
  statistics_count_what_was_done();
  statistics_must_be_enabled();
  CHECK_OK(dsw_environment_destroy(g_env));
  return check_result();
}
