/* Modes of floating-point arithmetic: whatever mode the host is in, the same calls give the same bits, and leave the
   host in its mode. */
#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* The register that says how a thread rounds, what it does with denormal numbers and what it traps. */
#if defined(__x86_64__) || defined(_M_X64)
#include <xmmintrin.h>
typedef unsigned int control;
enum { DEFAULT = 0x1f80, UPWARDS = 0x4000, DENORMALS = 0x8040, TRAPS = 0x1f80, FLAGS = 0x3f, INEXACT = 0x20 };
static control get_control(void) { return _mm_getcsr(); }
static void set_control(control c) { _mm_setcsr(c); }
#elif defined(__aarch64__)
typedef unsigned long long control;
enum { DEFAULT = 0, UPWARDS = 1 << 22, DENORMALS = 3 << 24, TRAPS = 0x1f00, FLAGS = 0, INEXACT = 0 };
static control get_control(void) {
  control c;
  __asm__ volatile("mrs %0, fpcr" : "=r"(c));
  return c;
}
static void set_control(control c) { __asm__ volatile("msr fpcr, %0" : : "r"(c) : "memory"); }
#else /* one mode, or none that the library knows */
typedef unsigned int control;
enum { DEFAULT = 0, UPWARDS = 0, DENORMALS = 0, TRAPS = 0, FLAGS = 0, INEXACT = 0 };
static control get_control(void) { return 0; }
static void set_control(control c) { (void)c; }
#endif

/* Batches of 256 are one piece of work; those below 2048 get no threads of the library's own. */
enum { SIDE = 4, BATCH = 2500, SMALL_BATCH = 300, LINE = 5 };

/* The host's mode, and how often it was another one after a call, or a callback was not in the default one. */
static control g_host;
static size_t g_changed, g_callbacks, g_wrong_callbacks;

/* All results of a scenario, one behind the other. */
typedef struct output {
  unsigned char *bytes;
  size_t size, room, failed, hits;
} output;

static void put(output *o, const void *bytes, size_t size) {
  if (o->size + size > o->room) {
    o->room = 2 * (o->size + size);
    o->bytes = realloc(o->bytes, o->room);
  }
  memcpy(o->bytes + o->size, bytes, size);
  o->size += size;
}

/* What a call returned, in the mode in which it left the host. */
static void after(output *o, dsw_status status) {
  g_changed += (get_control() & ~(control)(g_host == DEFAULT ? FLAGS : 0)) != g_host ? 1u : 0u;
  o->failed += status != DSW_STATUS_OK ? 1u : 0u;
  put(o, &status, sizeof status);
}

static void in_callback(void) {
  ++g_callbacks;
  g_wrong_callbacks += (get_control() & ~(control)FLAGS) != DEFAULT ? 1u : 0u;
}

static void *host_allocate(void *user, size_t size, size_t alignment) {
  unsigned char *const block = malloc(size + alignment + sizeof(void *)), *at = block + sizeof(void *);
  (void)user;
  in_callback();
  at += alignment - (size_t)at % alignment;
  memcpy(at - sizeof(void *), &block, sizeof block);
  return at;
}

static void host_release(void *user, void *memory, size_t size, size_t alignment) {
  unsigned char *block;
  (void)user, (void)size, (void)alignment;
  in_callback();
  memcpy(&block, (unsigned char *)memory - sizeof(void *), sizeof block);
  free(block);
}

/* A pool whose threads are in the host's mode. */
static void host_parallel_for(void *user, dsw_task_fn task, void *task_data, size_t task_count) {
  const control mine = get_control();
  (void)user;
  in_callback();
  for (; task_count != 0; --task_count) {
    set_control(g_host);
    task(task_data, task_count - 1);
    g_changed += (get_control() & ~(control)(g_host == DEFAULT ? FLAGS : 0)) != g_host ? 1u : 0u;
  }
  set_control(mine);
}

/* What a scenario gets: made in the default mode, for the host that rounds otherwise can't compute it. */
typedef struct input {
  grid cubes;
  double *bend, *next; /* where the vertices of the cubes are to go; and a copy that the library has */
  double from[BATCH][3], to[BATCH][3], fixed[BATCH][3];
  double line[LINE][3], targets[LINE][3];
  dsw_rigid_motion turn;
  double radius, limit, thickness;
} input;

static double random_number(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) * 0x1p-53;
}

/* Warped cubes, of which the last in x will be impassable, and ways among them, `unit` long. */
static void make_input(input *in, double unit) {
  uint64_t state = 7;
  size_t i, k;
  in->cubes = grid_create(SIDE, SIDE, SIDE);
  in->bend = malloc(3 * in->cubes.point_count * sizeof *in->bend);
  in->next = malloc(3 * in->cubes.point_count * sizeof *in->next);
  for (i = 0; i < 3 * in->cubes.point_count; ++i) {
    in->cubes.points[i] = (in->cubes.points[i] + 0.1 * random_number(&state)) * unit;
    in->bend[i] = in->cubes.points[i] + 0.05 * random_number(&state) * unit;
  }
  for (i = 0; i < BATCH; ++i) {
    for (k = 0; k < 3; ++k) {
      in->from[i][k] = (0.2 + (k == 0 ? 2.7 : 3.6) * random_number(&state)) * unit;
      in->to[i][k] = in->from[i][k] + (random_number(&state) - 0.5) * unit;
      in->fixed[i][k] = in->from[i][k] + 0.2 * random_number(&state) * unit;
    }
  }
  for (i = 0; i < LINE; ++i) {
    static const double start[3] = {0.35, 0.55, 1.45}, step[3] = {0.11, 0.61, 0.07}, way[3] = {3.1, 0.17, 0.23};
    for (k = 0; k < 3; ++k) {
      in->line[i][k] = (start[k] + (double)i * step[k]) * unit;
      in->targets[i][k] = in->line[i][k] + way[k] * unit;
    }
  }
  memset(&in->turn, 0, sizeof in->turn);
  in->turn.rotation[2] = 0.1;
  in->turn.rotation[3] = 0.9;
  for (k = 0; k < 3; ++k) in->turn.centre[k] = in->line[2][k];
  in->radius = 1.3 * unit;
  in->limit = 0.7 * unit;
  in->thickness = 0.01 * unit;
}

static void free_input(input *in) {
  grid_destroy(&in->cubes);
  free(in->bend);
  free(in->next);
}

static void ask_the_environment(output *o, const dsw_environment *e, const input *in) {
  dsw_flight *const flights = calloc(BATCH, sizeof *flights);
  dsw_nearest *const nearest = calloc(SMALL_BATCH, sizeof *nearest);
  dsw_segment_nearest *const segments = calloc(SMALL_BATCH, sizeof *segments);
  dsw_sweep *const sweeps = calloc(SMALL_BATCH, sizeof *sweeps);
  dsw_sweep_options options;
  size_t i;
  for (i = 0; i < 40; ++i) {
    after(o, dsw_environment_cast(e, no_volume, in->from[i], in->to[i], NULL, flights + i));
    after(o, dsw_environment_find_nearest(e, in->from[i], no_volume, in->radius, nearest + i));
    nearest[i].volumes_visited = 0; /* depends on threads */
  }
  put(o, flights, 40 * sizeof *flights);
  put(o, nearest, 40 * sizeof *nearest);
  after(o, dsw_environment_cast_segments(e, BATCH, NULL, in->from[0], in->to[0], 0, NULL, flights));
  for (i = 0; i < BATCH; ++i) o->hits += flights[i].outcome == DSW_OUTCOME_CONTACT ? 1u : 0u;
  put(o, flights, BATCH * sizeof *flights);
  after(o,
        dsw_environment_find_nearest_to_points(e, in->from[0], SMALL_BATCH, 0, NULL, in->radius, nearest, NULL, NULL));
  for (i = 0; i < SMALL_BATCH; ++i) nearest[i].volumes_visited = 0;
  put(o, nearest, SMALL_BATCH * sizeof *nearest);
  after(o, dsw_environment_find_nearest_to_segments(e, SMALL_BATCH, NULL, in->from[0], in->to[0], 0, in->radius,
                                                    segments, NULL, NULL));
  for (i = 0; i < SMALL_BATCH; ++i) segments[i].nearest.volumes_visited = 0;
  put(o, segments, SMALL_BATCH * sizeof *segments);
  dsw_sweep_options_init(&options, sizeof options);
  after(o,
        dsw_environment_sweep_edges(e, SMALL_BATCH, NULL, in->from[0], in->to[0], in->fixed[0], 0, &options, sweeps));
  put(o, sweeps, SMALL_BATCH * sizeof *sweeps);
  free(flights);
  free(nearest);
  free(segments);
  free(sweeps);
}

static void sweep_pairs(output *o, const dsw_context *context, const input *in) {
  enum { PAIRS = BATCH / 4 };
  dsw_pair_touch *const touches = calloc(PAIRS, sizeof *touches);
  uint8_t kinds[PAIRS];
  size_t i;
  for (i = 0; i < PAIRS; ++i) kinds[i] = (uint8_t)(i % 2);
  after(o, dsw_sweep_pairs(context, 3, PAIRS, kinds, in->from[0], in->to[0], 0, DSW_PAIRS_RANK, touches));
  for (i = 0; i < PAIRS; ++i) o->hits += touches[i].touches;
  put(o, touches, PAIRS * sizeof *touches);
  free(touches);
}

static void move_things(output *o, dsw_scene *scene, const input *in) {
  dsw_body_desc d = line_desc(in->line[0], LINE, 0, DSW_LEVEL_FACES);
  dsw_move_options options = move_options();
  dsw_near_options near_options;
  const dsw_body_contact *contacts = NULL;
  const dsw_near_row *rows = NULL;
  dsw_particle_id *const particles = calloc(BATCH, sizeof *particles);
  dsw_flight *const flights = calloc(BATCH, sizeof *flights);
  dsw_move_report report;
  dsw_body_edit edit;
  dsw_body_id body = {0, 0};
  size_t count = 0;
  const dsw_body_edge_id edge = {1, 1};
  memset(&report, 0, sizeof report);
  memset(&edit, 0, sizeof edit);
  options.vertex_response = DSW_RESPONSE_SLIDE;
  options.edge_response = DSW_RESPONSE_ADAPTIVE_SLIDE;
  options.passes = 2;
  after(o, dsw_scene_create_particles(scene, in->from[0], BATCH, 0, NULL, particles, NULL));
  after(o, dsw_scene_move_particles(scene, particles, BATCH, in->to[0], 0, NULL, flights));
  put(o, flights, BATCH * sizeof *flights);
  after(o, dsw_particle_move(scene, particles[0], in->to[1], NULL, flights));
  put(o, flights, sizeof *flights);
  after(o, dsw_body_create(scene, &d, &body));
  after(o, dsw_body_set_radius(scene, body, in->thickness));
  after(o, dsw_body_split_edge(scene, body, edge, 0.3, &edit));
  put(o, &edit, sizeof edit);
  after(o, dsw_body_move_rigid(scene, body, &in->turn, NULL, &report));
  put(o, &report, sizeof report);
  after(o, dsw_body_destroy(scene, body));
  after(o, dsw_body_create(scene, &d, &body));
  after(o, dsw_scene_move_together(scene, &body, 1, in->targets[0], LINE, 0, NULL, &report));
  put(o, &report, sizeof report);
  after(o, dsw_body_move(scene, body, in->targets[0], LINE, 0, &options, &report));
  put(o, &report, sizeof report);
  after(o, dsw_body_get_contacts(scene, body, &contacts, &count));
  put(o, contacts, count * sizeof *contacts);
  o->hits += count;
  dsw_near_options_init(&near_options, sizeof near_options);
  near_options.margin = in->limit;
  after(o, dsw_body_find_near_rows(scene, body, &near_options, NULL));
  after(o, dsw_body_get_near_rows(scene, body, &rows, &count));
  put(o, rows, count * sizeof *rows);
  free(particles);
  free(flights);
}

static void put_states(output *o, const dsw_environment *environment, const dsw_scene *scene) {
  size_t size = 0;
  unsigned char *block;
  after(o, dsw_environment_save(environment, NULL, 0, &size));
  block = malloc(size);
  after(o, dsw_environment_save(environment, block, size, &size));
  put(o, block, size);
  free(block);
  after(o, dsw_scene_save(scene, NULL, 0, &size));
  block = malloc(size);
  after(o, dsw_scene_save(scene, block, size, &size));
  put(o, block, size);
  free(block);
}

/* Everything in the host's mode, from the first call on. */
static output run(const dsw_context_desc *context_desc, const input *in, control value) {
  output o = {NULL, 0, 0, 0, 0};
  dsw_environment_desc d = grid_desc(&in->cubes);
  dsw_scene_desc scene_desc;
  dsw_context *context = NULL;
  dsw_environment *environment = NULL;
  dsw_scene *scene = NULL;
  dsw_deform_report report;
  const size_t bytes = 3 * in->cubes.point_count * sizeof *in->next;
  double *const back = malloc(bytes);
  uint32_t cell;
  memset(&report, 0, sizeof report);
  memcpy(in->next, in->bend, bytes);
  memcpy(back, in->cubes.points, bytes);
  dsw_scene_desc_init(&scene_desc, sizeof scene_desc);
  scene_desc.features = DSW_FEATURE_DEFORMING;
  g_host = value;
  set_control(value);
  after(&o, dsw_context_create(context_desc, &context));
  after(&o, dsw_environment_create(context, &d, &environment, NULL));
  for (cell = 3; cell < SIDE * SIDE * SIDE; cell += SIDE) {
    after(&o, set_volume_mark(environment, cell, DSW_MARK_IMPASSABLE));
    if (cell % 3 == 0) after(&o, set_face_mark(environment, cell - 2, FACE_X1, DSW_MARK_IMPASSABLE));
  }
  ask_the_environment(&o, environment, in);
  sweep_pairs(&o, context, in);
  after(&o, dsw_scene_create(environment, &scene_desc, &scene));
  move_things(&o, scene, in);
  after(&o, dsw_environment_deform(environment, in->next, in->cubes.point_count, NULL, &report));
  put(&o, &report, sizeof report);
  after(&o, dsw_scene_deform(scene, back, in->cubes.point_count, NULL, 0, NULL, 0, 0, NULL, &report, NULL));
  put(&o, &report, sizeof report);
  put_states(&o, environment, scene);
  after(&o, dsw_scene_destroy(scene));
  after(&o, dsw_environment_destroy(environment));
  after(&o, dsw_context_destroy(context));
  set_control(DEFAULT);
  free(back);
  return o;
}

typedef struct mode {
  const char *name;
  control value;
} mode;

/* All modes but the default one. */
static size_t list_modes(mode *modes) {
  static const struct {
    const char *name;
    int rounding;
  } roundings[] = {
#ifdef FE_UPWARD
      {"upwards", FE_UPWARD},
#endif
#ifdef FE_DOWNWARD
      {"downwards", FE_DOWNWARD},
#endif
#ifdef FE_TOWARDZERO
      {"towards zero", FE_TOWARDZERO},
#endif
      {"to nearest", FE_TONEAREST},
  };
  mode all[8];
  size_t i, n = 0, count = 0;
  for (i = 0; i < sizeof roundings / sizeof *roundings; ++i, ++n) {
    CHECK(fesetround(roundings[i].rounding) == 0);
    all[n].name = roundings[i].name;
    all[n].value = get_control() & ~(control)FLAGS;
  }
  CHECK(fesetround(FE_TONEAREST) == 0);
  all[n].name = "without denormal numbers", all[n++].value = DEFAULT | DENORMALS;
  all[n].name = "with traps", all[n++].value = DEFAULT ^ TRAPS;
  all[n].name = "with everything", all[n++].value = (DEFAULT ^ TRAPS) | DENORMALS | UPWARDS | INEXACT;
  for (i = 0; i < n; ++i) {
    control has;
    set_control(all[i].value);
    has = get_control(); /* a processor may have no traps */
    set_control(DEFAULT);
    if (has == DEFAULT) {
      printf("not here, or the default: %s\n", all[i].name);
    } else {
      modes[count] = all[i];
      modes[count++].value = has;
    }
  }
  return count;
}

static void every_mode_gives_the_same_bits(double unit, int with_pool) {
  static input in;
  mode modes[8];
  const size_t count = list_modes(modes);
  dsw_context_desc d;
  output expected;
  size_t i;
  dsw_context_desc_init(&d, sizeof d);
  d.thread_count = 2;
  if (with_pool) d.allocate = host_allocate, d.release = host_release, d.parallel_for = host_parallel_for;
  make_input(&in, unit);
  expected = run(&d, &in, DEFAULT);
  CHECK(expected.failed == 0 && expected.hits > BATCH / 20);
  for (i = 0; i < count; ++i) {
    output o;
    check_in(modes[i].name);
    g_changed = g_callbacks = g_wrong_callbacks = 0;
    o = run(&d, &in, modes[i].value);
    CHECK(o.size == expected.size && memcmp(o.bytes, expected.bytes, o.size) == 0);
    CHECK(o.failed == 0);
    CHECK(g_changed == 0);
    CHECK(g_wrong_callbacks == 0);
    CHECK((g_callbacks > 0) == (with_pool != 0));
    free(o.bytes);
  }
  check_in("");
  free(expected.bytes);
  free_input(&in);
}

/* Whatever else fesetround changes stays as well. */
static void a_host_goes_on_rounding_as_before(void) {
#ifdef FE_UPWARD
  dsw_environment *const environment = make_environment(NULL, 1, 1, 1);
  const double from[3] = {0.1, 0.2, 0.3}, to[3] = {0.7, 0.6, 0.5};
  dsw_flight flight;
  dsw_status status;
  int set, rounding;
  CHECK(fesetround(FE_UPWARD) == 0);
  set = fegetround(); /* of WebAssembly it stays the default */
  status = dsw_environment_cast(environment, no_volume, from, to, NULL, &flight);
  rounding = fegetround();
  CHECK(fesetround(FE_TONEAREST) == 0);
  CHECK(status == DSW_STATUS_OK && rounding == set);
#if defined(__x86_64__) || defined(__aarch64__)
  CHECK(set == FE_UPWARD);
#endif
  CHECK_OK(dsw_environment_destroy(environment));
#endif
}

int main(void) {
  every_mode_gives_the_same_bits(1, 0);
  every_mode_gives_the_same_bits(1, 1);
  every_mode_gives_the_same_bits(0x1p-537, 1);  /* products of coordinates are denormal numbers */
  every_mode_gives_the_same_bits(0x1p-1030, 0); /* coordinates are */
  a_host_goes_on_rounding_as_before();
  return check_result();
}
