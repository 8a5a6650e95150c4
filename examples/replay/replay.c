/* Opens a recording (record.h), makes its calls again and tells what they did:
 *
 *   dartsweep_replay FILE [--to N [--take FILE]] [--validate] [--quiet] [--draw FOLDER]
 *
 * README.md tells what it prints. Exit code 1: a call did something else than was recorded, or the validation is that something is wrong; 2: the
 * file or an option can't be used. */
#include <dartsweep/dartsweep.h>
#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base.h"
#include "output.h"

typedef struct options {
  const char *file, *take, *draw;
  uint64_t to;
  int quiet, validate;
} options;

static int usage(void) {
  fprintf(stderr, "usage: dartsweep_replay FILE [--to N [--take FILE]] [--validate] [--quiet] [--draw FOLDER]\n");
  return kBadInput;
}

static int read_options(int argc, char **argv, options *o) {
  static const struct option known[] = {{"to", required_argument, NULL, 't'},   {"quiet", no_argument, NULL, 'q'},
                                        {"validate", no_argument, NULL, 'j'},   {"take", required_argument, NULL, 'k'},
                                        {"draw", required_argument, NULL, 'd'}, {NULL, 0, NULL, 0}};
  int letter;
  memset(o, 0, sizeof *o);
  o->to = UINT64_MAX;
  while ((letter = getopt_long(argc, argv, "", known, NULL)) != -1) {
    char *end = NULL;
    if (letter == 't') {
      o->to = strtoull(optarg, &end, 10);
      if (*optarg < '0' || *optarg > '9' || *end != 0) return usage();
    } else if (letter == 'q') {
      o->quiet = 1;
    } else if (letter == 'j') {
      o->validate = 1;
    } else if (letter == 'k') {
      o->take = optarg;
    } else if (letter == 'd') {
      o->draw = optarg;
    } else {
      return usage();
    }
  }
  if (optind + 1 != argc || (o->take != NULL && o->to == UINT64_MAX)) return usage();
  o->file = argv[optind];
  return 0;
}

static void *room_for(size_t count, size_t size) {
  void *const room = calloc(count == 0 ? 1 : count, size);
  if (room == NULL) {
    fprintf(stderr, "replay: not enough memory\n");
    exit(kFailed);
  }
  return room;
}

/* All bytes of a file; the caller frees them. */
static unsigned char *read_file(const char *name, size_t *size) {
  FILE *const file = fopen(name, "rb");
  unsigned char *bytes = NULL;
  size_t room = 0, got = 1;
  *size = 0;
  while (file != NULL && got > 0) {
    if (*size == room) {
      room = room == 0 ? 1 << 16 : 2 * room;
      bytes = (unsigned char *)realloc(bytes, room);
      if (bytes == NULL) break;
    }
    got = fread(bytes + *size, 1, room - *size, file);
    *size += got;
  }
  if (file == NULL || bytes == NULL || ferror(file)) {
    fprintf(stderr, "replay: cannot read '%s'\n", name);
    exit(kBadInput);
  }
  fclose(file);
  return bytes;
}

static const char *outcome_name(dsw_replay_outcome outcome) {
  return outcome == DSW_REPLAY_SAME        ? "same"
         : outcome == DSW_REPLAY_DIFFERENT ? "DIFFERENT"
                                           : "unfinished: the recording ends in it";
}

static dsw_replay_info info_of(const dsw_replay *replay) {
  dsw_replay_info info;
  info.struct_size = sizeof info;
  require(dsw_replay_get_info(replay, &info), "reading about the recording", kFailed);
  return info;
}

static void print_beginning(const dsw_replay *replay, const dsw_scene *scene, size_t size) {
  const dsw_replay_info info = info_of(replay);
  dsw_environment_info environment;
  size_t particles = 0, bodies = 0;
  environment.struct_size = sizeof environment;
  require(dsw_environment_get_info(dsw_scene_get_environment(scene), &environment), "reading the environment", kFailed);
  require(dsw_scene_get_particle_count(scene, &particles), "counting", kFailed);
  require(dsw_scene_get_body_count(scene, &bodies), "counting", kFailed);
  printf("%s made by version %u.%u.%u%s\n", (info.flags & DSW_RECORDING_BUG_REPORT) ? "bug report" : "recording",
         info.version / 1000000, info.version / 1000 % 1000, info.version % 1000,
         (info.flags & DSW_RECORDING_STATES) ? ", with the state after each call" : "");
  printf("at its beginning %lu volumes, %lu particles, %lu bodies\n", (unsigned long)environment.volume_count,
         (unsigned long)particles, (unsigned long)bodies);
  printf("its beginning takes %" PRIu64 " bytes\n", (uint64_t)size - info.bytes_left);
}

static void print_step(const dsw_replay_report *report) {
  printf("%8" PRIu64 "  %-34s %-24s %s\n", report->call, report->function, dsw_status_string(report->status),
         outcome_name(report->outcome));
  if (report->status != DSW_STATUS_OK) printf("          %s\n", dsw_last_error_message());
  if (report->outcome != DSW_REPLAY_DIFFERENT) return;
  if (report->differs & DSW_DIFFERS_STATUS)
    printf("          the recorded call %s\n", report->has_failed ? "failed" : "did not fail");
  if (report->differs & DSW_DIFFERS_RESULTS) printf("          it answered something else\n");
  if (report->differs & DSW_DIFFERS_STATE) printf("          what is there after it is something else\n");
}

/* Returns 1 if all is right. */
static int print_validation(const dsw_validation *v) {
  printf("exact validation: %s%s\n", v->is_right ? "right" : "WRONG: ", v->text);
  printf("  in their volumes  %" PRIu64 " particles and vertices, but for %" PRIu64 "\n", v->places, v->lost);
  printf("  free              %" PRIu64 " edges, but for %" PRIu64 "; %" PRIu64 " faces, but for %" PRIu64 "\n",
         v->edges, v->crossing, v->faces, v->pierced);
  if (v->ways + v->contacts + v->not_validated == 0) return v->is_right != 0;
  printf("  the call          %" PRIu64 " ways that nothing is in, but for %" PRIu64 "; %" PRIu64
         " contacts at their time, but for %" PRIu64 "; %" PRIu64 " not validated\n",
         v->ways, v->missed, v->contacts, v->wrong, v->not_validated);
  return v->is_right != 0;
}

/* Arguments of the next call; the caller frees them. */
static char *describe_next(dsw_replay *replay) {
  size_t size = 0;
  char *text;
  require(dsw_replay_describe_next(replay, NULL, 0, &size), "reading a call", kBadInput);
  text = (char *)room_for(size, 1);
  require(dsw_replay_describe_next(replay, text, size, &size), "reading a call", kBadInput);
  return text;
}

/* The next step, told. `good` becomes 0 where the validation is that something is wrong. */
static dsw_replay_outcome step(dsw_replay *replay, const options *o, int *good) {
  dsw_replay_report report;
  dsw_validation validation;
  char *arguments = NULL;
  const int validate = o->validate || (info_of(replay).flags & DSW_RECORDING_BUG_REPORT) != 0;
  validation.struct_size = sizeof validation;
  validation.is_right = 1;
  if (validate) arguments = describe_next(replay);
  require(validate ? dsw_replay_step_validated(replay, &report, &validation) : dsw_replay_step(replay, &report),
          "making the next call", kBadInput);
  if (report.outcome != DSW_REPLAY_END && (!o->quiet || report.outcome != DSW_REPLAY_SAME || !validation.is_right)) {
    print_step(&report);
    if (validate) printf("          %s\n", arguments);
    if (validate) print_validation(&validation);
  }
  free(arguments);
  if (!validation.is_right) *good = 0;
  return report.outcome;
}

/* On what is there: an environment and a scene that are loaded from their snapshots are checked as a whole, bodies against each other included.
 * Returns 1 if all is well. */
static int print_end(dsw_scene *scene) {
  dsw_environment *const environment = dsw_scene_get_environment(scene);
  dsw_environment *copy = NULL;
  dsw_scene *again = NULL;
  size_t sizes[2] = {0, 0}, particles = 0, bodies = 0;
  unsigned char *blocks[2];
  dsw_status is_partition, is_free;
  require(dsw_environment_save(environment, NULL, 0, &sizes[0]), "saving", kFailed);
  require(dsw_scene_save(scene, NULL, 0, &sizes[1]), "saving", kFailed);
  blocks[0] = (unsigned char *)room_for(sizes[0], 1);
  blocks[1] = (unsigned char *)room_for(sizes[1], 1);
  require(dsw_environment_save(environment, blocks[0], sizes[0], &sizes[0]), "saving", kFailed);
  require(dsw_scene_save(scene, blocks[1], sizes[1], &sizes[1]), "saving", kFailed);
  require(dsw_scene_get_particle_count(scene, &particles), "counting", kFailed);
  require(dsw_scene_get_body_count(scene, &bodies), "counting", kFailed);
  is_partition = dsw_environment_check(environment, NULL);
  printf("environment: %s\n",
         is_partition == DSW_STATUS_OK ? "every volume is valid, no two overlap" : dsw_last_error_message());
  is_free = dsw_environment_load(NULL, blocks[0], sizes[0], &copy);
  if (is_free == DSW_STATUS_OK) is_free = dsw_scene_load(copy, blocks[1], sizes[1], &again);
  printf("scene: %lu particles, %lu bodies: %s\n", (unsigned long)particles, (unsigned long)bodies,
         is_free == DSW_STATUS_OK ? "all in their volumes, all free" : dsw_last_error_message());
  dsw_scene_destroy(again);
  dsw_environment_destroy(copy);
  free(blocks[0]);
  free(blocks[1]);
  return is_free == DSW_STATUS_OK;
}

static dsw_replay_outcome take_call(dsw_replay *replay, dsw_scene *scene, const options *o, int *good) {
  dsw_replay_outcome outcome;
  dsw_recording_desc desc;
  dsw_recording_desc_init(&desc, sizeof desc);
  desc.path = o->take;
  desc.flags = DSW_RECORDING_STATES;
  require(dsw_scene_start_recording(scene, &desc), "writing the call", kBadInput);
  outcome = step(replay, o, good);
  require(dsw_scene_stop_recording(scene), "writing the call", kBadInput);
  return outcome;
}

/* The edges of a body, and what it touched in its last move. */
static int draw_body(const dsw_scene *scene, dsw_body_id body, const char *folder, const char *when) {
  dsw_body_counts counts;
  const dsw_body_contact *contacts = NULL;
  double *positions, *touches;
  uint32_t *ends;
  size_t got = 0, i, count = 0;
  char name[64];
  int code;
  counts.struct_size = sizeof counts;
  require(dsw_body_get_counts(scene, body, &counts), "reading a body", kFailed);
  positions = (double *)room_for(3 * (size_t)counts.vertex_slots, sizeof *positions);
  ends = (uint32_t *)room_for(2 * (size_t)counts.edge_slots, sizeof *ends);
  require(dsw_body_get_positions(scene, body, positions, counts.vertex_slots, 0, NULL, &got), "reading a body",
          kFailed);
  require(dsw_body_get_edge_indices(scene, body, ends, counts.edge_slots, &got), "reading a body", kFailed);
  for (i = 0; i < counts.edge_slots; ++i) {
    if (ends[2 * i] == UINT32_MAX) continue; /* a free slot */
    ends[2 * count] = ends[2 * i];
    ends[2 * count + 1] = ends[2 * i + 1];
    ++count;
  }
  snprintf(name, sizeof name, "%sbody_%u.vtu", when, body.index);
  code = vtu_write(folder, name, positions, counts.vertex_slots, ends, 2, count, NULL, 0);
  free(positions);
  free(ends);
  require(dsw_body_get_contacts(scene, body, &contacts, &count), "reading contacts", kFailed);
  touches = (double *)room_for(6 * count, sizeof *touches);
  for (i = 0; i < count; ++i) {
    memcpy(touches + 3 * i, contacts[i].point, sizeof contacts[i].point);
    memcpy(touches + 3 * (count + i), contacts[i].contact.normal, sizeof contacts[i].contact.normal);
  }
  snprintf(name, sizeof name, "%scontacts_%u.vtu", when, body.index);
  if (code == 0 && count != 0) code = write_touches(folder, name, touches, touches + 3 * count, count);
  free(touches);
  return code;
}

static int draw_particles(const dsw_scene *scene, const char *folder, const char *when) {
  size_t count = 0;
  dsw_particle_id *particles;
  double *positions;
  char name[64];
  int code = 0;
  require(dsw_scene_get_particle_count(scene, &count), "counting", kFailed);
  particles = (dsw_particle_id *)room_for(count, sizeof *particles);
  positions = (double *)room_for(3 * count, sizeof *positions);
  require(dsw_scene_get_particle_ids(scene, particles, count, &count), "reading particles", kFailed);
  require(dsw_scene_get_particle_positions(scene, particles, count, positions, 0, NULL), "reading particles", kFailed);
  snprintf(name, sizeof name, "%sparticles.vtu", when);
  if (count != 0) code = vtu_write(folder, name, positions, count, NULL, 0, 0, NULL, 0);
  free(particles);
  free(positions);
  return code;
}

/* What is in the scene; names begin with `when`. */
static int draw(const dsw_scene *scene, const char *folder, const char *when) {
  size_t count = 0, i;
  dsw_body_id *bodies;
  int code = draw_particles(scene, folder, when);
  require(dsw_scene_get_body_count(scene, &count), "counting", kFailed);
  bodies = (dsw_body_id *)room_for(count, sizeof *bodies);
  require(dsw_scene_get_body_ids(scene, bodies, count, &count), "reading bodies", kFailed);
  for (i = 0; i < count && code == 0; ++i) code = draw_body(scene, bodies[i], folder, when);
  free(bodies);
  return code;
}

int main(int argc, char **argv) {
  options o;
  size_t size = 0;
  unsigned char *bytes;
  dsw_replay *replay = NULL;
  dsw_scene *scene = NULL;
  uint64_t call = 0;
  dsw_replay_outcome last = DSW_REPLAY_SAME;
  dsw_replay_info info;
  int good = 1;
  if (read_options(argc, argv, &o) != 0) return kBadInput;
  bytes = read_file(o.file, &size);
  require(dsw_replay_create(NULL, bytes, size, &replay), "opening the recording", kBadInput);
  require(dsw_replay_get_scene(replay, &scene), "opening the recording", kBadInput);
  print_beginning(replay, scene, size);
  if (o.draw != NULL && draw(scene, o.draw, "before_") != 0) return kBadInput;
  while (call < o.to && (last = step(replay, &o, &good)) == DSW_REPLAY_SAME) ++call;
  if (o.take != NULL && call == o.to) last = take_call(replay, scene, &o, &good);
  if (o.take != NULL && (call < o.to || last == DSW_REPLAY_END)) {
    fprintf(stderr, "replay: no call %" PRIu64 " to be taken after calls that did what was recorded\n", o.to);
    return kBadInput;
  }
  info = info_of(replay);
  printf("%" PRIu64 " calls did what was recorded\n", call);
  if (last == DSW_REPLAY_END || last == DSW_REPLAY_UNFINISHED)
    printf("the recording ends here%s, with %" PRIu64 " bytes of an entry that is not whole\n",
           last == DSW_REPLAY_UNFINISHED ? " in a call" : "", info.bytes_left);
  if (*info.note != 0) printf("note: %s\n", info.note);
  if (info.validation != NULL)
    printf("validation when it was written: %s%s\n",
           info.validation->is_right ? "right" : "WRONG: ", info.validation->text);
  if (!print_end(scene)) good = 0;
  if (o.draw != NULL &&
      (draw(scene, o.draw, "") != 0 || write_trace(dsw_scene_get_environment(scene), o.draw, "walls.vtu", 1) != 0))
    return kBadInput;
  require(dsw_replay_destroy(replay), "closing", kFailed);
  free(bytes);
  return last == DSW_REPLAY_DIFFERENT || !good ? kFailed : 0;
}
