/* Snapshots, recordings, replays, bug reports: what is saved by this library is loaded by it. */
#include <string.h>

#include "calls.h"

typedef struct tape {
  unsigned char bytes[1 << 17];
  size_t size;
} tape;

static tape kept, report_tape, blocks[2];

static int append(void *user, const void *bytes, size_t size_bytes) {
  tape *const t = (tape *)user;
  if (t->size + size_bytes > sizeof t->bytes) return 1;
  memcpy(t->bytes + t->size, bytes, size_bytes);
  t->size += size_bytes;
  return 0;
}

static int refuse(void *user, const void *bytes, size_t size_bytes) { return user == NULL && bytes != NULL && size_bytes > 0; }

static void snapshots(dsw_environment *environment, dsw_scene *scene) {
  dsw_environment *copy = NULL;
  dsw_scene *again = NULL;
  size_t count = 99;
  TRY(dsw_environment_save(environment, blocks[0].bytes, 8, &blocks[0].size));
  TRY(dsw_environment_save(environment, blocks[0].bytes, sizeof blocks[0].bytes, &blocks[0].size));
  TRY(dsw_scene_save(scene, NULL, 0, &blocks[1].size));
  TRY(dsw_scene_save(scene, blocks[1].bytes, sizeof blocks[1].bytes, &blocks[1].size));
  TRY(dsw_environment_load(NULL, blocks[0].bytes, blocks[0].size - 1, &copy));
  blocks[0].bytes[blocks[0].size / 2] ^= 1;
  TRY(dsw_environment_load(NULL, blocks[0].bytes, blocks[0].size, &copy));
  blocks[0].bytes[blocks[0].size / 2] ^= 1;
  TRY(dsw_environment_load(NULL, blocks[0].bytes, blocks[0].size, &copy));
  say_environment(copy);
  TRY(dsw_scene_load(copy, blocks[1].bytes, blocks[1].size / 2, &again));
  TRY(dsw_scene_load(copy, blocks[1].bytes, blocks[1].size, &again));
  TRY(dsw_scene_get_particle_count(again, &count));
  say("  %u particles", (unsigned)count);
  TRY(dsw_scene_destroy(again));
  TRY(dsw_environment_destroy(copy));
}

static void record(dsw_environment *environment, dsw_scene *scene) {
  static const double wire[6] = {0.25, 0.25, 0.75, 0.75, 0.25, 0.75}, up[6] = {0.25, 0.25, 1.5, 0.75, 0.25, 0.75};
  static const double place[3] = {0.5, 0.5, 0.5}, away[3] = {9, 0.5, 0.5};
  const dsw_volume_id first = volume_at(environment, 0);
  dsw_recording_desc desc;
  dsw_particle_id particle;
  dsw_body_id body;
  dsw_recording_desc_init(&desc, sizeof desc);
  TRY(dsw_scene_start_recording(scene, &desc));
  desc.write = append, desc.user = &kept, desc.flags = DSW_RECORDING_STATES | DSW_RECORDING_LATEST;
  TRY(dsw_scene_start_recording(scene, &desc));
  desc.write = refuse, desc.user = NULL, desc.flags = 0;
  TRY(dsw_scene_start_recording(scene, &desc));
  desc.write = append, desc.user = &kept, desc.flags = DSW_RECORDING_STATES;
  TRY(dsw_scene_start_recording(scene, &desc));
  TRY(dsw_scene_start_recording(scene, &desc));
  TRY(dsw_particle_create(scene, place, no_volume, &particle));
  TRY(dsw_particle_move(scene, particle, away, NULL, NULL));
  body = make_wire(scene, wire, DSW_LEVEL_EDGES_SWEPT, 0);
  TRY(dsw_body_move(scene, body, up, 2, 0, NULL, NULL));
  TRY(dsw_environment_mark_volumes(environment, &first, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  TRY(dsw_scene_stop_recording(scene));
  TRY(dsw_scene_stop_recording(scene));
}

static void say_step(const dsw_replay_report *report) {
  say("  call %u %s: outcome %d, status %d, failed %u, differs %u", (unsigned)report->call,
      report->function == NULL ? "null" : report->function, (int)report->outcome, (int)report->status,
      report->has_failed, report->differs);
}

static void say_validation(const dsw_validation *validation) {
  say("  right %u, places %u, lost %u, crossing %u, pierced %u, missed %u, wrong %u, text '%s'", validation->is_right,
      (unsigned)validation->places, (unsigned)validation->lost, (unsigned)validation->crossing,
      (unsigned)validation->pierced, (unsigned)validation->missed, (unsigned)validation->wrong, validation->text);
}

static void replays(void) {
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  dsw_replay_info info;
  dsw_validation validation;
  dsw_scene *scene = NULL;
  char text[512];
  size_t size = 0, bodies = 99;
  TRY(dsw_replay_create(NULL, kept.bytes, 10, &replay));
  TRY(dsw_replay_create(NULL, kept.bytes, kept.size, NULL));
  TRY(dsw_replay_create(NULL, kept.bytes, kept.size, &replay));
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  TRY(dsw_replay_get_info(replay, &info));
  say("  flags %u, calls %u, note %s, validation %s", info.flags, (unsigned)info.calls, info.note == NULL ? "null" : "SET",
      info.validation == NULL ? "null" : "SET");
  memset(&validation, 0, sizeof validation);
  validation.struct_size = sizeof validation;
  TRY(dsw_replay_step_validated(replay, &report, &validation));
  say_step(&report);
  say_validation(&validation);
  do {
    TRY(dsw_replay_describe_next(replay, text, sizeof text, &size));
    say("  a text %s", size > 0 && text[0] != 0 ? "is there" : "is missing");
    if (TRY(dsw_replay_step(replay, &report)) != DSW_STATUS_OK) break;
    say_step(&report);
  } while (report.outcome != DSW_REPLAY_END);
  TRY(dsw_replay_get_scene(replay, &scene));
  TRY(dsw_scene_get_body_count(scene, &bodies));
  say("  %u bodies", (unsigned)bodies);
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_replay_destroy(replay));
  TRY(dsw_replay_destroy(NULL));
}

static void bug_reports(dsw_scene *scene) {
  static const double place[3] = {1.5, 0.5, 0.5};
  dsw_recording_desc latest;
  dsw_bug_report_desc desc;
  dsw_validation validation;
  dsw_particle_id particle;
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  dsw_replay_info info;
  dsw_recording_desc_init(&latest, sizeof latest);
  latest.flags = DSW_RECORDING_LATEST;
  TRY(dsw_scene_start_recording(scene, &latest));
  TRY(dsw_particle_create(scene, place, no_volume, &particle));
  dsw_bug_report_desc_init(&desc, sizeof desc);
  TRY(dsw_scene_write_bug_report(scene, &desc, NULL));
  desc.write = append, desc.user = &report_tape, desc.note = "a note";
  memset(&validation, 0, sizeof validation);
  validation.struct_size = sizeof validation;
  TRY(dsw_scene_write_bug_report(scene, &desc, &validation));
  say_validation(&validation);
  TRY(dsw_scene_stop_recording(scene));
  TRY(dsw_replay_create(NULL, report_tape.bytes, report_tape.size, &replay));
  TRY(dsw_replay_step(replay, &report));
  say_step(&report);
  TRY(dsw_replay_step(replay, &report));
  say_step(&report);
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  TRY(dsw_replay_get_info(replay, &info));
  say("  flags %u, note '%s', validation %s", info.flags, info.note == NULL ? "null" : info.note,
      info.validation == NULL ? "NULL" : "set");
  TRY(dsw_replay_destroy(replay));
}

void call_records(void) {
  dsw_environment *const environment = make_block(NULL, 2, 1, 1, 0);
  dsw_scene *const scene = make_scene(environment, 0);
  say("* records");
  record(environment, scene);
  snapshots(environment, scene);
  replays();
  bug_reports(scene);
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_environment_destroy(environment));
}
