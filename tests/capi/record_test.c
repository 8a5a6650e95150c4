#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static tape one, other;

static void record_latest(dsw_scene *scene) {
  dsw_recording_desc latest;
  dsw_recording_desc_init(&latest, sizeof latest);
  latest.flags = DSW_RECORDING_LATEST;
  CHECK_OK(dsw_scene_start_recording(scene, &latest));
}

/* Makes the replay of what is on a tape. */
static dsw_replay *replay_of(const tape *t) {
  dsw_replay *replay = NULL;
  CHECK_OK(dsw_replay_create(NULL, t->bytes, t->size, &replay));
  return replay;
}

/* The next call is made again with the same results. */
static void step(dsw_replay *replay) {
  dsw_replay_report report;
  CHECK_OK(dsw_replay_step(replay, &report));
  CHECK(report.outcome == DSW_REPLAY_SAME);
}

static void calls_are_made_again_by_name(void) {
  static const char *const names[] = {"dsw_particle_create",     "dsw_particle_move", "dsw_environment_mark_volumes",
                                      "dsw_environment_set_tag", "dsw_body_create",   "dsw_environment_mark_volumes"};
  dsw_environment *const env = make_environment(NULL, 3, 2, 2);
  dsw_scene *const scene = make_scene(env, 0), *again = NULL;
  const dsw_recording_desc desc = to_tape(&one);
  const dsw_volume_id wall = volume_at(1), occupied = volume_at(2);
  const double from[3] = {0.5, 0.5, 0.5}, to[3] = {0.75, 0.5, 0.5}, nan_point[3] = {0, 0, NAN},
               line[6] = {2.5, 0.25, 0.5, 2.5, 0.75, 0.5};
  dsw_particle_id particle;
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  double position[3] = {0, 0, 0};
  uint32_t tag = 0;
  size_t i;
  CHECK_OK(dsw_scene_start_recording(scene, &desc));
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_scene_start_recording(scene, &desc));
  CHECK_OK(dsw_particle_create(scene, from, no_volume, &particle));
  CHECK_OK(dsw_particle_move(scene, particle, to, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_move(scene, stale_particle, to, NULL, NULL)); /* not recorded */
  CHECK_OK(dsw_environment_mark_volumes(env, &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_set_tag(env, wall, 77));
  make_edge_body(scene, line, DSW_LEVEL_EDGES_SWEPT);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_mark_volumes(env, &occupied, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_scene_stop_recording(scene));
  CHECK_OK(dsw_scene_stop_recording(scene));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_particle_move(scene, particle, nan_point, NULL, NULL));
  replay = replay_of(&one);
  for (i = 0; i < sizeof names / sizeof *names; ++i) {
    memset(&report, 0xff, sizeof report);
    CHECK_OK(dsw_replay_step(replay, &report));
    CHECK(report.call == i && report.outcome == DSW_REPLAY_SAME && strcmp(report.function, names[i]) == 0);
    CHECK(report.has_failed == (i == 5) && report.status == (i == 5 ? DSW_STATUS_OCCUPIED : DSW_STATUS_OK));
  }
  CHECK_OK(dsw_replay_step(replay, &report));
  CHECK(report.outcome == DSW_REPLAY_END && report.call == 6 && report.function == NULL);
  CHECK_OK(dsw_replay_get_scene(replay, &again));
  CHECK_OK(dsw_particle_get_position(again, particle, position, NULL));
  CHECK(memcmp(position, to, sizeof to) == 0);
  CHECK_OK(dsw_environment_get_tag(dsw_scene_get_environment(again), wall, &tag));
  CHECK(tag == 77);
  CHECK_OK(dsw_replay_destroy(replay));
  end_scene(scene);
}

/* A step of a replay is recorded itself: a recording of one call, for whoever has to look at it. */
static void one_call_can_be_taken_out(void) {
  dsw_environment *const env = make_environment(NULL, 2, 1, 1);
  dsw_scene *const scene = make_scene(env, 0);
  dsw_scene *again = NULL;
  dsw_recording_desc desc = to_tape(&one);
  const double from[3] = {0.5, 0.5, 0.5}, to[3] = {1.5, 0.5, 0.25}, back[3] = {0.25, 0.25, 0.25};
  dsw_particle_id particle;
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  CHECK_OK(dsw_particle_create(scene, from, no_volume, &particle));
  CHECK_OK(dsw_scene_start_recording(scene, &desc));
  CHECK_OK(dsw_particle_move(scene, particle, to, NULL, NULL));
  CHECK_OK(dsw_particle_move(scene, particle, back, NULL, NULL));
  CHECK_OK(dsw_scene_destroy(scene)); /* ends the recording */
  CHECK_OK(dsw_environment_destroy(env));
  replay = replay_of(&one);
  CHECK_OK(dsw_replay_step(replay, &report));
  CHECK_OK(dsw_replay_get_scene(replay, &again));
  desc = to_tape(&other);
  CHECK_OK(dsw_scene_start_recording(again, &desc));
  CHECK_OK(dsw_replay_step(replay, &report));
  CHECK_OK(dsw_scene_stop_recording(again));
  CHECK(report.call == 1 && report.outcome == DSW_REPLAY_SAME);
  CHECK_OK(dsw_replay_destroy(replay));
  replay = replay_of(&other);
  CHECK_OK(dsw_replay_step(replay, &report));
  CHECK(report.call == 0 && report.outcome == DSW_REPLAY_SAME && report.status == DSW_STATUS_OK);
  CHECK_OK(dsw_replay_step(replay, &report));
  CHECK(report.outcome == DSW_REPLAY_END);
  CHECK_OK(dsw_replay_destroy(replay));
}

static void a_scene_in_other_hands_differs(void) {
  dsw_environment *const env = make_environment(NULL, 2, 1, 1);
  dsw_scene *const scene = make_scene(env, 0), *again = NULL, *guest;
  const dsw_recording_desc desc = to_tape(&one);
  const double from[3] = {0.5, 0.5, 0.5}, to[3] = {1.5, 0.5, 0.25};
  const dsw_volume_id wall = volume_at(1);
  dsw_particle_id particle;
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  CHECK_OK(dsw_particle_create(scene, from, no_volume, &particle));
  CHECK_OK(dsw_scene_start_recording(scene, &desc));
  CHECK_OK(dsw_particle_move(scene, particle, to, NULL, NULL));
  CHECK_OK(dsw_scene_stop_recording(scene));
  replay = replay_of(&one);
  CHECK_OK(dsw_replay_get_scene(replay, &again));
  CHECK_OK(dsw_environment_mark_volumes(dsw_scene_get_environment(again), &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_replay_step(replay, &report));
  CHECK(report.outcome == DSW_REPLAY_DIFFERENT && report.status == DSW_STATUS_OK && report.has_failed == 0);
  guest = make_scene(dsw_scene_get_environment(again), 0);
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_replay_destroy(replay));
  CHECK_OK(dsw_scene_destroy(guest));
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_scene_destroy(again));
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_environment_destroy(dsw_scene_get_environment(again)));
  CHECK_OK(dsw_replay_destroy(replay));
  end_scene(scene);
}

/* What is recorded as the state after a call has what the call did. */
static void states_are_those_after_the_call(void) {
  dsw_environment *const env = make_environment(NULL, 2, 1, 1);
  dsw_scene *const scene = make_scene(env, 0);
  dsw_scene *again = NULL;
  dsw_recording_desc desc = to_tape(&one);
  const dsw_volume_id volume = volume_at(1);
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  desc.flags = DSW_RECORDING_STATES;
  CHECK_OK(dsw_scene_start_recording(scene, &desc));
  CHECK_OK(dsw_environment_set_tag(env, volume, 77));
  end_scene(scene);
  replay = replay_of(&one);
  CHECK_OK(dsw_replay_get_scene(replay, &again));
  CHECK_OK(dsw_environment_set_tag(dsw_scene_get_environment(again), volume, 77)); /* it is there then anyway */
  CHECK_OK(dsw_replay_step(replay, &report));
  CHECK(report.outcome == DSW_REPLAY_SAME && report.differs == 0);
  CHECK_OK(dsw_replay_destroy(replay));
}

/* A recording that can't be written never fails a call. */
static void writing_may_fail(void) {
  dsw_scene *const scene = make_scene(make_environment(NULL, 2, 1, 1), 0);
  const double from[3] = {0.5, 0.5, 0.5};
  dsw_particle_id particle;
  size_t refuse, starts;
  dsw_recording_desc desc = to_tape(&one);
  CHECK_OK(dsw_scene_start_recording(scene, &desc));
  starts = one.writes;
  CHECK_OK(dsw_scene_stop_recording(scene));
  for (refuse = 1; refuse <= starts + 3; ++refuse) {
    desc = to_tape(&one);
    one.refuse = refuse;
    if (refuse <= starts) {
      CHECK_FAILS(DSW_STATUS_WRITE_FAILED, dsw_scene_start_recording(scene, &desc));
      CHECK_OK(dsw_scene_stop_recording(scene)); /* there is none */
      continue;
    }
    CHECK_OK(dsw_scene_start_recording(scene, &desc));
    CHECK_OK(dsw_particle_create(scene, from, no_volume, &particle));
    if (refuse <= starts + 2) {
      CHECK_FAILS(DSW_STATUS_WRITE_FAILED, dsw_scene_stop_recording(scene));
      CHECK(one.writes == refuse);
    } else {
      CHECK_OK(dsw_scene_stop_recording(scene));
    }
  }
  end_scene(scene);
}

/* An empty answer is the same for the first time and where there was something before the recording began. */
static void empty_answers_are_alike(void) {
  grid g = grid_create(2, 1, 1);
  dsw_environment_desc d = grid_desc(&g);
  dsw_environment *env = NULL;
  dsw_scene *scene;
  const double from[3] = {0.1, 0.5, 0.5};
  double *next[2];
  const double *points = NULL;
  dsw_deform_options options;
  dsw_deform_report bent;
  dsw_particle_id particle;
  dsw_replay *replay = NULL;
  dsw_recording_desc desc;
  size_t i, k, count = 0;
  for (k = 0; k < 2; ++k) {
    next[k] = (double *)malloc(g.point_count * 3 * sizeof(double));
    CHECK(next[k] != NULL);
  }
  CHECK_OK(dsw_environment_create(NULL, &d, &env, NULL));
  scene = make_scene(env, DSW_FEATURE_DEFORMING);
  CHECK_OK(dsw_particle_create(scene, from, no_volume, &particle));
  dsw_deform_options_init(&options, sizeof options);
  options.response = DSW_WALL_HOLD;
  for (k = 0; k < 3; ++k) {
    CHECK_OK(dsw_environment_get_points(env, &points, &count));
    memcpy(next[k % 2], points, count * 3 * sizeof(double));
    for (i = 0; k < 2 && i < count; ++i) next[k % 2][3 * i] += points[3 * i] < 0.5 ? 0.2 : 0;
    if (k == 2) {
      desc = to_tape(&one);
      CHECK_OK(dsw_scene_start_recording(scene, &desc));
    }
    CHECK_OK(dsw_environment_deform(dsw_scene_get_environment(scene), next[k % 2], count, &options, &bent));
    CHECK((bent.held_count != 0) == (k < 2));
  }
  CHECK_OK(dsw_scene_create_particles(scene, from, 0, 0, NULL, &particle, NULL));
  CHECK_OK(dsw_scene_stop_recording(scene));
  replay = replay_of(&one);
  for (k = 0; k < 2; ++k) {
    step(replay);
  }
  CHECK_OK(dsw_replay_destroy(replay));
  end_scene(scene);
  for (k = 0; k < 2; ++k) free(next[k]);
  grid_destroy(&g);
}

static void bad_arguments(void) {
  dsw_scene *const scene = make_scene(make_environment(NULL, 1, 1, 1), 0);
  dsw_recording_desc desc = to_tape(&one);
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_start_recording(NULL, &desc));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_start_recording(scene, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_stop_recording(NULL));
  desc.path = "x";
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_start_recording(scene, &desc));
  desc.write = NULL;
  desc.path = "no/such/folder/recording";
  CHECK_FAILS(DSW_STATUS_WRITE_FAILED, dsw_scene_start_recording(scene, &desc));
  CHECK_MESSAGE("no/such/folder");
  desc.path = NULL;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_start_recording(scene, &desc));
  desc = to_tape(&one);
  desc.flags = 1u << 30;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_start_recording(scene, &desc));
  desc = to_tape(&one);
  desc.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_scene_start_recording(scene, &desc));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_replay_create(NULL, NULL, 8, &replay));
  CHECK_FAILS(DSW_STATUS_TRUNCATED, dsw_replay_create(NULL, "", 0, &replay));
  CHECK_FAILS(DSW_STATUS_CORRUPT, dsw_replay_create(NULL, "not a recording at all", 22, &replay));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_replay_step(NULL, &report));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_replay_get_scene(NULL, NULL));
  CHECK_OK(dsw_replay_destroy(NULL));
  desc = to_tape(&one);
  CHECK_OK(dsw_scene_start_recording(scene, &desc));
  CHECK_OK(dsw_scene_stop_recording(scene));
  one.bytes[8] = 99; /* format */
  CHECK_FAILS(DSW_STATUS_BAD_VERSION, dsw_replay_create(NULL, one.bytes, one.size, &replay));
  one.bytes[8] = 1;
  one.bytes[13] ^= 1; /* order of bytes */
  CHECK_FAILS(DSW_STATUS_BAD_VERSION, dsw_replay_create(NULL, one.bytes, one.size, &replay));
  CHECK_MESSAGE("endian");
  one.bytes[13] ^= 1;
  CHECK_FAILS(DSW_STATUS_TRUNCATED, dsw_replay_create(NULL, one.bytes, one.size - 8, &replay));
  CHECK(replay == NULL);
  end_scene(scene);
}

static void bug_reports_take_bad_arguments_and_full_disks(void) {
  dsw_scene *const scene = make_scene(make_environment(NULL, 2, 1, 1), 0);
  const double from[3] = {0.5, 0.5, 0.5}, to[3] = {1.5, 0.5, 0.25};
  dsw_bug_report_desc desc;
  dsw_validation validation;
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  dsw_replay_info info;
  dsw_particle_id particle;
  size_t writes, refuse;
  record_latest(scene);
  CHECK_OK(dsw_particle_create(scene, from, no_volume, &particle));
  CHECK_OK(dsw_particle_move(scene, particle, to, NULL, NULL));
  dsw_bug_report_desc_init(&desc, sizeof desc);
  validation.struct_size = sizeof validation;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_write_bug_report(NULL, &desc, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_write_bug_report(scene, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_write_bug_report(scene, &desc, &validation));
  desc.write = to_tape(&one).write;
  desc.user = &one;
  desc.path = "x";
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_write_bug_report(scene, &desc, &validation));
  desc.path = NULL;
  desc.flags = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_write_bug_report(scene, &desc, &validation));
  desc.flags = 0;
  validation.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_scene_write_bug_report(scene, &desc, &validation));
  validation.struct_size = sizeof validation;
  desc.note = "strange";
  CHECK_OK(dsw_scene_write_bug_report(scene, &desc, &validation));
  CHECK(validation.is_right == 1 && validation.places == 1 && validation.ways == 1 && validation.text[0] == 0);
  writes = one.writes;
  for (refuse = 1; refuse <= writes; ++refuse) {
    memset(&other, 0, sizeof other);
    other.refuse = refuse;
    desc.user = &other;
    CHECK_FAILS(DSW_STATUS_WRITE_FAILED, dsw_scene_write_bug_report(scene, &desc, NULL));
  }
  replay = replay_of(&one);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_replay_step_validated(replay, &report, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_replay_step_validated(replay, NULL, &validation));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_replay_step_validated(NULL, &report, &validation));
  CHECK_OK(dsw_replay_step_validated(replay, &report, &validation));
  CHECK(report.outcome == DSW_REPLAY_SAME && strcmp(report.function, "dsw_particle_move") == 0 && validation.ways == 1);
  CHECK_OK(dsw_replay_step(replay, &report));
  info.struct_size = 4;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_replay_get_info(replay, &info));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_replay_get_info(replay, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_replay_get_info(NULL, &info));
  info.struct_size = sizeof info;
  CHECK_OK(dsw_replay_get_info(replay, &info));
  CHECK(info.calls == 1 && info.version == dsw_version() && info.bytes_left == 0 && strcmp(info.note, "strange") == 0);
  CHECK_OK(dsw_replay_destroy(replay));
  end_scene(scene);
}

/* A recording in memory begins anew now and then; the report has the last call all the same. */
static void reports_always_have_their_call(void) {
  enum { kParticles = 500, kCalls = 80 };
  static double targets[kParticles][3];
  static dsw_particle_id particles[kParticles];
  dsw_scene *const scene = make_scene(make_environment(NULL, 1, 1, 1), 0);
  dsw_bug_report_desc desc;
  dsw_replay *replay = NULL;
  unsigned call, i;
  for (i = 0; i < kParticles; ++i) targets[i][0] = targets[i][1] = targets[i][2] = 0.25 + i * 0.001;
  CHECK_OK(dsw_scene_create_particles(scene, targets[0], kParticles, 0, NULL, particles, NULL));
  record_latest(scene);
  dsw_bug_report_desc_init(&desc, sizeof desc);
  desc.write = to_tape(&one).write;
  desc.user = &one;
  for (call = 0; call < kCalls; ++call) { /* 16 kB each */
    for (i = 0; i < kParticles; ++i) targets[i][1] = 0.25 + call * 0.001;
    CHECK_OK(dsw_scene_move_particles(scene, particles, kParticles, targets[0], 0, NULL, NULL));
    memset(&one, 0, sizeof one);
    CHECK_OK(dsw_scene_write_bug_report(scene, &desc, NULL));
    replay = replay_of(&one);
    step(replay);
    CHECK_OK(dsw_replay_destroy(replay));
  }
  end_scene(scene);
}

/* Somebody else writes to the file that a scene is recorded into. */
static void recordings_may_be_spoilt(void) {
  static const char *const path = "record_test.dswrec";
  dsw_scene *const scene = make_scene(make_environment(NULL, 1, 1, 1), 0);
  dsw_recording_desc to;
  dsw_bug_report_desc desc;
  FILE *file;
  dsw_recording_desc_init(&to, sizeof to);
  to.path = path;
  CHECK_OK(dsw_scene_start_recording(scene, &to));
  dsw_bug_report_desc_init(&desc, sizeof desc);
  desc.write = to_tape(&one).write;
  desc.user = &one;
  CHECK_OK(dsw_scene_write_bug_report(scene, &desc, NULL));
  file = fopen(path, "wb");
  CHECK(file != NULL);
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_scene_write_bug_report(scene, &desc, NULL));
  if (file != NULL) {
    CHECK(fwrite(one.bytes, 1, 24, file) == 24);
    fclose(file);
  }
  CHECK_FAILS(DSW_STATUS_CORRUPT, dsw_scene_write_bug_report(scene, &desc, NULL));
  end_scene(scene);
  remove(path);
}

/* Where an environment is folded a particle passes, in its own cell, through a face of others: nothing is wrong with
   that. */
static void folds_are_not_validated(void) {
  dsw_environment *const env = make_environment(NULL, 3, 1, 1);
  dsw_scene *const scene = make_scene(env, DSW_FEATURE_DEFORMING);
  const double from[3] = {0.2, 0.45, 0.55}, to[3] = {0.8, 0.45, 0.55};
  const dsw_face_id wall = face_at(1, FACE_X1);
  double next[16][3], position[3];
  const double *points = NULL;
  dsw_bug_report_desc desc;
  dsw_validation validation;
  dsw_particle_id particle;
  size_t i, count = 0;
  CHECK_OK(dsw_environment_mark_faces(env, &wall, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_particle_create(scene, from, no_volume, &particle));
  CHECK_OK(dsw_environment_get_points(env, &points, &count));
  CHECK(count == 16);
  memcpy(next, points, sizeof next);
  for (i = 0; i < 16; ++i) next[i][0] -= next[i][0] == 2 ? 1.5 : 0;
  CHECK_OK(dsw_environment_deform(dsw_scene_get_environment(scene), next[0], count, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_check(env, NULL));
  record_latest(scene);
  CHECK_OK(dsw_particle_move(scene, particle, to, NULL, NULL));
  CHECK_OK(dsw_particle_get_position(scene, particle, position, NULL));
  CHECK(memcmp(position, to, sizeof to) == 0);
  dsw_bug_report_desc_init(&desc, sizeof desc);
  desc.write = to_tape(&one).write;
  desc.user = &one;
  validation.struct_size = sizeof validation;
  CHECK_OK(dsw_scene_write_bug_report(scene, &desc, &validation));
  CHECK(validation.is_right == 1 && validation.ways == 1 && validation.missed == 0 && validation.not_validated == 1);
  end_scene(scene);
}

/* Every allocation of a replay refused in turn: a status, and everything is given back. */
static void memory_may_run_out(void) {
  host h;
  size_t refuse;
  int done = 0;
  dsw_scene *const scene = make_scene(make_environment(NULL, 2, 2, 1), 0);
  const dsw_recording_desc desc = to_tape(&one);
  const double from[3] = {0.5, 0.5, 0.5};
  dsw_particle_id particle;
  CHECK_OK(dsw_scene_start_recording(scene, &desc));
  CHECK_OK(dsw_particle_create(scene, from, no_volume, &particle));
  CHECK_OK(dsw_scene_stop_recording(scene));
  for (refuse = 1; !done && refuse < 1000; ++refuse) {
    dsw_context *context;
    dsw_replay *replay = NULL;
    dsw_status status;
    memset(&h, 0, sizeof h);
    context = make_context(&h);
    h.calls = 0;
    h.refuse = refuse;
    status = dsw_replay_create(context, one.bytes, one.size, &replay);
    if (status == DSW_STATUS_OK) {
      dsw_replay_report report;
      status = dsw_replay_step(replay, &report);
      if (status == DSW_STATUS_OK) {
        CHECK(report.status == (h.calls < refuse ? DSW_STATUS_OK : DSW_STATUS_OUT_OF_MEMORY));
        CHECK(report.outcome == (report.status == DSW_STATUS_OK ? DSW_REPLAY_SAME : DSW_REPLAY_DIFFERENT));
        done = report.status == DSW_STATUS_OK && h.calls < refuse;
      }
      CHECK_OK(dsw_replay_destroy(replay));
    }
    CHECK(status == DSW_STATUS_OK || (status == DSW_STATUS_OUT_OF_MEMORY && h.calls >= refuse));
    h.refuse = 0;
    end_context(context, &h);
  }
  CHECK(done);
  end_scene(scene);
}

/* A recording's own buffers say that nothing was written. */
static int is_refusal(dsw_status status) {
  return status == DSW_STATUS_OUT_OF_MEMORY || status == DSW_STATUS_WRITE_FAILED;
}

/* Every allocation of a recording in memory and of a report refused in turn: calls are made all the same, the report is
   written or not. */
static void reports_may_run_out_of_memory(void) {
  const double from[3] = {0.5, 0.5, 0.5}, to[3] = {1.5, 0.5, 0.25};
  size_t refuse, before, reports = 0;
  int done = 0;
  for (refuse = 1; !done && refuse < 2000; ++refuse) {
    host h;
    dsw_context *context;
    dsw_environment *env;
    dsw_scene *scene;
    dsw_recording_desc latest;
    dsw_bug_report_desc desc;
    dsw_particle_id particle;
    dsw_status status;
    double position[3];
    memset(&h, 0, sizeof h);
    context = make_context(&h);
    env = make_environment(context, 2, 1, 1);
    scene = make_scene(env, 0);
    CHECK_OK(dsw_particle_create(scene, from, no_volume, &particle));
    CHECK_OK(dsw_particle_move(scene, particle, from, NULL, NULL)); /* what moves need is there */
    dsw_recording_desc_init(&latest, sizeof latest);
    latest.flags = DSW_RECORDING_LATEST | DSW_RECORDING_STATES;
    dsw_bug_report_desc_init(&desc, sizeof desc);
    desc.write = to_tape(&one).write;
    desc.user = &one;
    h.calls = 0;
    h.refuse = refuse;
    status = dsw_scene_start_recording(scene, &latest);
    CHECK(h.calls < refuse ? status == DSW_STATUS_OK : is_refusal(status));
    CHECK_OK(dsw_particle_move(scene, particle, to, NULL, NULL));
    before = h.calls;
    status = dsw_scene_write_bug_report(scene, &desc, NULL);
    CHECK(status == DSW_STATUS_OK || (before < refuse && h.calls >= refuse && is_refusal(status)));
    reports += status == DSW_STATUS_OK ? 1u : 0u;
    done = h.calls < refuse;
    h.refuse = 0;
    CHECK_OK(dsw_particle_get_position(scene, particle, position, NULL));
    CHECK(memcmp(position, to, sizeof to) == 0);
    end_scene(scene);
    end_context(context, &h);
  }
  CHECK(done && reports > 1);
}

int main(void) {
  calls_are_made_again_by_name();
  one_call_can_be_taken_out();
  a_scene_in_other_hands_differs();
  states_are_those_after_the_call();
  writing_may_fail();
  empty_answers_are_alike();
  bad_arguments();
  bug_reports_take_bad_arguments_and_full_disks();
  reports_always_have_their_call();
  recordings_may_be_spoilt();
  folds_are_not_validated();
  memory_may_run_out();
  reports_may_run_out_of_memory();
  return check_result();
}
