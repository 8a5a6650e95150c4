/* A scene is recorded while a particle and a wall meet; the recording, read from a file as after a crash, is made again call by call and
 * ends with the same bytes. One call of it becomes a recording of its own, and the last one a bug report with the exact validation on it. The files
 * stay: dartsweep_replay (replay/replay.c) opens them. */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

/* Three cubes in a row. */
static dsw_environment *create_row(void) {
  static double points[16][3];
  static const int32_t cells[3][8] = {
      {0, 1, 5, 4, 8, 9, 13, 12}, {1, 2, 6, 5, 9, 10, 14, 13}, {2, 3, 7, 6, 10, 11, 15, 14}};
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  int i;
  for (i = 0; i < 16; ++i) {
    points[i][0] = i % 4;
    points[i][1] = i / 4 % 2;
    points[i][2] = i / 8;
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = &points[0][0];
  desc.point_count = 16;
  desc.connectivity = &cells[0][0];
  desc.connectivity_count = 24;
  desc.volume_count = 3;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  return environment;
}

static unsigned char *read_file(const char *name, size_t *size) {
  static unsigned char bytes[1 << 16];
  FILE *const file = fopen(name, "rb");
  check(file != NULL, "opening");
  *size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  return bytes;
}

static size_t save(const dsw_scene *scene, unsigned char *block, size_t capacity) {
  size_t size = 0;
  check(dsw_scene_save(scene, block, capacity, &size) == DSW_STATUS_OK, "saving");
  return size;
}

int main(void) {
  const char *const name = "14_recording.rec", *const part = "14_recording_one.rec";
  static unsigned char before[4096], after[4096];
  dsw_environment *const environment = create_row();
  dsw_scene *scene = NULL, *again = NULL;
  dsw_recording_desc desc;
  dsw_volume_id wall, null_volume = {0, 0};
  dsw_particle_id particle;
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  const double start[3] = {0.5, 0.5, 0.5}, target[3] = {2.75, 0.5, 0.25};
  dsw_bug_report_desc report_desc;
  dsw_validation validation;
  size_t size = 0, saved;
  unsigned char *bytes;

  check(dsw_scene_create(environment, NULL, &scene) == DSW_STATUS_OK, "a scene");
  dsw_recording_desc_init(&desc, sizeof desc);
  desc.path = name;
  check(dsw_scene_start_recording(scene, &desc) == DSW_STATUS_OK, "recording");
  check(dsw_particle_create(scene, start, null_volume, &particle) == DSW_STATUS_OK, "a particle");
  check(dsw_environment_get_volume_id(environment, 2, &wall) == DSW_STATUS_OK, "the wall");
  check(dsw_environment_mark_volumes(environment, &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL) == DSW_STATUS_OK, "marking");
  check(dsw_particle_move(scene, particle, target, NULL, NULL) == DSW_STATUS_OK, "moving");
  saved = save(scene, before, sizeof before);
  dsw_bug_report_desc_init(&report_desc, sizeof report_desc);
  report_desc.path = "14_report.dswrec";
  report_desc.note = "the particle stops early";
  validation.struct_size = sizeof validation;
  check(dsw_scene_write_bug_report(scene, &report_desc, &validation) == DSW_STATUS_OK, "a bug report");
  printf("the last call was %s\n", validation.is_right ? "right: there is a wall in the way" : validation.text);
  check(validation.is_right == 1 && validation.contacts == 1, "the validation");
  /* No dsw_scene_stop_recording: as if the process had died here. Every call is in the file. */

  bytes = read_file(name, &size);
  check(dsw_replay_create(NULL, bytes, size, &replay) == DSW_STATUS_OK, "opening the recording");
  check(dsw_replay_get_scene(replay, &again) == DSW_STATUS_OK, "its scene");
  desc.path = part;
  while (dsw_replay_step(replay, &report) == DSW_STATUS_OK && report.outcome == DSW_REPLAY_SAME) {
    printf("call %d: %s, %s\n", (int)report.call, report.function, dsw_status_string(report.status));
    if (report.call == 1) check(dsw_scene_start_recording(again, &desc) == DSW_STATUS_OK, "taking the next call out");
  }
  check(dsw_scene_stop_recording(again) == DSW_STATUS_OK, "taking it out");
  check(report.outcome == DSW_REPLAY_END && report.call == 3, "three calls, all the same");
  check(save(again, after, sizeof after) == saved && memcmp(before, after, saved) == 0, "the same bytes");
  check(dsw_replay_destroy(replay) == DSW_STATUS_OK, "closing");

  bytes = read_file(part, &size);
  check(dsw_replay_create(NULL, bytes, size, &replay) == DSW_STATUS_OK, "opening the one call");
  check(dsw_replay_step(replay, &report) == DSW_STATUS_OK && report.outcome == DSW_REPLAY_SAME, "making it");
  printf("%s alone: %d bytes\n", report.function, (int)size);
  check(strcmp(report.function, "dsw_particle_move") == 0, "the move");
  check(dsw_replay_destroy(replay) == DSW_STATUS_OK, "closing");

  check(dsw_scene_destroy(scene) == DSW_STATUS_OK, "the scene's end");
  check(dsw_environment_destroy(environment) == DSW_STATUS_OK, "the environment's end");
  return 0;
}
