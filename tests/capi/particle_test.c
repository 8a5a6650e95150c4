#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 4 x 4 cubes */

static const double g_middle[3] = {1.5, 1.5, 1.5};

static dsw_particle_id particle_at(dsw_scene *scene, const double *position) {
  dsw_particle_id id = {0, 0};
  CHECK_OK(dsw_particle_create(scene, position, no_volume, &id));
  return id;
}

static size_t particle_count(const dsw_scene *scene) {
  size_t count = 999;
  CHECK_OK(dsw_scene_get_particle_count(scene, &count));
  return count;
}

static void positions_come_in_bulk(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  dsw_particle_id ids[3];
  double positions[3][4] = {{0}}, one[3];
  dsw_volume_id volumes[3], volume;
  size_t i;
  ids[0] = particle_at(scene, g_middle);
  ids[1] = particle_at(scene, g_middle);
  ids[2] = ids[0]; /* an id may stand many times */
  positions[0][3] = positions[2][3] = 7;
  CHECK_OK(dsw_scene_get_particle_positions(scene, ids, 3, positions[0], sizeof positions[0], volumes));
  for (i = 0; i < 3; ++i) {
    CHECK_OK(dsw_particle_get_position(scene, ids[i], one, &volume));
    CHECK(memcmp(one, positions[i], sizeof one) == 0 && memcmp(&volume, &volumes[i], sizeof volume) == 0);
  }
  CHECK(positions[0][3] == 7 && positions[2][3] == 7);
  CHECK_OK(dsw_scene_get_particle_positions(scene, ids, 3, NULL, 0, NULL));
  CHECK_OK(dsw_scene_get_particle_positions(scene, NULL, 0, NULL, 0, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_get_particle_positions(scene, ids, 3, positions[0], 20, volumes));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_particle_positions(scene, NULL, 1, positions[0], 0, volumes));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_particle_positions(NULL, ids, 3, positions[0], 0, volumes));
  CHECK_OK(dsw_particle_destroy(scene, ids[1]));
  positions[0][0] = -1;
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_scene_get_particle_positions(scene, ids, 3, positions[0], 0, volumes));
  CHECK_MESSAGE("particles[1]");
  CHECK(positions[0][0] == -1);
  CHECK_OK(dsw_scene_destroy(scene));
}

static void particles_come_and_go(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id first = particle_at(scene, g_middle), second = particle_at(scene, g_middle);
  dsw_particle_id third;
  dsw_volume_id volume;
  double position[3];
  CHECK(first.index == 0 && first.generation == 1 && second.index == 1 && particle_count(scene) == 2);
  CHECK_OK(dsw_particle_get_position(scene, first, position, &volume));
  CHECK(memcmp(position, g_middle, sizeof position) == 0 && volume.index == 1 + 4 * (1 + 4 * 1) &&
        volume.generation == 1);
  CHECK_OK(dsw_particle_get_position(scene, first, NULL, NULL));
  CHECK_OK(dsw_particle_destroy(scene, first));
  CHECK(particle_count(scene) == 1);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_get_position(scene, first, position, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_destroy(scene, first));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_move(scene, first, g_middle, NULL, NULL));
  CHECK_MESSAGE("particle {index 0, generation 1} names no particle");
  third = particle_at(scene, g_middle);
  CHECK(third.index == 0 && third.generation == 2 && particle_count(scene) == 2);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_get_position(scene, first, position, NULL));
  CHECK_OK(dsw_scene_destroy(scene)); /* with all it holds */
}

static void ids_that_were_never_given_out_are_stale(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id id = particle_at(scene, g_middle);
  dsw_particle_id forged[5] = {{0, 0}, {0, 2}, {1, 1}, {0xffffffffu, 1}, {0, 0x80000001u}};
  size_t i;
  for (i = 0; i < 5; ++i) CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_get_position(scene, forged[i], NULL, NULL));
  CHECK_OK(dsw_particle_destroy(scene, id));
  for (i = 0; i < 5; ++i) CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_get_position(scene, forged[i], NULL, NULL));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void a_bad_particle_is_refused(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const double outside[3] = {-1, 0.5, 0.5}, bad[3] = {0.5, 0.5, NAN};
  const dsw_volume_id wall = volume_at(0);
  const double in_wall[3] = {0.5, 0.5, 0.5};
  dsw_particle_id id = {7, 7};
  CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_particle_create(scene, outside, no_volume, &id));
  CHECK_MESSAGE("position (-1, 0.5, 0.5) lies in no volume");
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_particle_create(scene, bad, no_volume, &id));
  CHECK_MESSAGE("position[2] is nan, must be finite");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_create(scene, g_middle, stale_volume, &id));
  CHECK_MESSAGE("hint {index 0, generation 7}");
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_FAILS(DSW_STATUS_IMPASSABLE, dsw_particle_create(scene, in_wall, no_volume, &id));
  CHECK_MESSAGE("volume 0, which is impassable");
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_PASSABLE, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_particle_create(NULL, g_middle, no_volume, &id));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_particle_create(scene, NULL, no_volume, &id));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_particle_create(scene, g_middle, no_volume, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_create((dsw_scene *)(void *)g_env, g_middle, no_volume, &id));
  CHECK(id.index == 7 && particle_count(scene) == 0);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_particle_destroy(NULL, id));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_particle_get_position(NULL, id, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_particle_count(scene, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_particle_count(NULL, NULL));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void many_are_created_or_none(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  double positions[12] = {0.5, 0.5, 0.5, 0, 1.5, 0.5, 0.5, 0, 2.5, 0.5, 0.5, 0};
  dsw_volume_id hints[3] = {{0, 1}, {0, 0}, {64, 1}};
  dsw_particle_id ids[3];
  size_t offender = 99;
  memset(ids, 0x55, sizeof ids);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_scene_create_particles(scene, positions, 3, 32, hints, ids, &offender));
  CHECK_MESSAGE("hints[2]");
  CHECK(offender == 2);
  hints[2].index = 63;
  positions[5] = 9;
  CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_scene_create_particles(scene, positions, 3, 32, hints, ids, &offender));
  CHECK_MESSAGE("positions[1] (1.5, 9, 0.5)");
  CHECK(offender == 1);
  CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_scene_create_particles(scene, positions, 3, 32, hints, ids, NULL));
  positions[5] = INFINITY;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_create_particles(scene, positions, 3, 32, hints, ids, &offender));
  CHECK_MESSAGE("positions[1][1] is inf");
  positions[5] = 0.5;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_create_particles(scene, positions, 3, 20, hints, ids, &offender));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_create_particles(NULL, positions, 3, 32, hints, ids, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_create_particles(scene, NULL, 3, 32, hints, ids, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_create_particles(scene, positions, 3, 32, hints, NULL, NULL));
  CHECK(particle_count(scene) == 0 && ids[0].index == 0x55555555u);
  CHECK_OK(dsw_scene_create_particles(scene, positions, 3, 32, hints, ids, &offender));
  CHECK(particle_count(scene) == 3 && ids[0].index == 0 && ids[2].index == 2 && ids[2].generation == 1);
  CHECK_OK(dsw_scene_create_particles(scene, positions, 3, 32, NULL, ids, NULL));
  CHECK(particle_count(scene) == 6);
  CHECK_OK(dsw_scene_create_particles(scene, NULL, 0, 0, NULL, NULL, NULL));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void a_move_reaches_its_target(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id id = particle_at(scene, g_middle);
  const double to[3] = {3.25, 2.75, 0.125};
  double position[3];
  dsw_volume_id volume;
  dsw_flight f;
  CHECK_OK(dsw_particle_move(scene, id, to, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_REACHED && f.time == 1 && memcmp(f.position, to, sizeof to) == 0);
  CHECK(f.volume.index == 3 + 4 * 2 && f.contact.kind == DSW_CONTACT_NONE && f.contact.wall.generation == 0 &&
        f.volumes_visited == 5);
  CHECK_OK(dsw_particle_get_position(scene, id, position, &volume));
  CHECK(memcmp(position, to, sizeof to) == 0 && volume.index == f.volume.index);
  CHECK_OK(dsw_scene_destroy(scene));
}

static void a_stopped_particle_stays_on_this_side(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id id = particle_at(scene, g_middle);
  const double to[3] = {1.5, 1.5, 9.5};
  const dsw_volume_id wall = volume_at(1 + 4 * (1 + 4 * 3));
  double position[3];
  dsw_volume_id volume;
  dsw_flight f;
  int again;
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_particle_move(scene, id, to, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.time == 0.1875 && f.contact.kind == DSW_CONTACT_PLANE);
  CHECK(f.contact.normal[2] == -1 && f.contact.behind.index == wall.index && f.contact.marked_kind == DSW_CELL_VOLUME);
  CHECK(f.contact.tag == 100 + wall.index && f.contact.wall.volume == wall.index - 16 &&
        f.contact.wall.local == FACE_Z1);
  CHECK(f.position[2] < 3 && f.position[2] > 2.999999 && f.volumes_visited == 2);
  CHECK_OK(dsw_particle_get_position(scene, id, position, &volume));
  CHECK(memcmp(position, f.position, sizeof position) == 0 && volume.index == f.volume.index);
  for (again = 0; again < 3; ++again) {
    CHECK_OK(dsw_particle_move(scene, id, to, NULL, &f));
    CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.position[2] < 3);
  }
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_PASSABLE, 0, NULL));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void the_state_names_the_wall_that_stopped_it(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id id = particle_at(scene, g_middle);
  const double up[3] = {1.5, 1.5, 9.5}, aside[3] = {1.75, 1.5, 3.5}, away[3] = {1.5, 1.5, 0.5};
  const uint32_t top = 1 + 4 * (1 + 4 * 3), start = 1 + 4 * (1 + 4 * 1);
  dsw_cell cell, aim = cell_at(DSW_CELL_EDGE, 7, 7);
  CHECK_OK(dsw_particle_get_state(scene, id, &cell, &aim));
  CHECK(cell.kind == DSW_CELL_VOLUME && cell.index == start && cell.generation == 1 && cell.local == 0);
  CHECK(aim.kind == DSW_CELL_NONE && aim.generation == 0); /* it has not moved */
  CHECK_OK(dsw_particle_move(scene, id, up, NULL, NULL));
  CHECK_OK(dsw_particle_get_state(scene, id, &cell, &aim));
  CHECK(cell.index == top && aim.kind == DSW_CELL_FACE && aim.index == top && aim.generation == 1 &&
        aim.local == FACE_Z1);
  CHECK_OK(dsw_particle_move(scene, id, aside, NULL, NULL)); /* in its volume */
  CHECK_OK(dsw_particle_get_state(scene, id, NULL, &aim));
  CHECK(aim.kind == DSW_CELL_FACE && aim.local == FACE_Z1);
  CHECK_OK(dsw_particle_move(scene, id, away, NULL, NULL));
  CHECK_OK(dsw_particle_get_state(scene, id, NULL, &aim));
  CHECK(aim.kind == DSW_CELL_NONE);
  CHECK_OK(dsw_particle_get_state(scene, id, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_get_state(scene, stale_particle, &cell, &aim));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_particle_get_state(NULL, id, &cell, &aim));
  CHECK(cell.index == top); /* failures write nothing */
  CHECK_OK(dsw_scene_destroy(scene));
}

static void options_are_obeyed(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id id = particle_at(scene, g_middle);
  const double to[3] = {1.5, 1.5, 9.5};
  dsw_cast_options o;
  dsw_flight f;
  dsw_cast_options_init(&o, sizeof o);
  o.max_volumes = 1;
  CHECK_OK(dsw_particle_move(scene, id, to, &o, &f));
  CHECK(f.outcome == DSW_OUTCOME_WORK_LIMIT && f.volumes_visited == 1 && f.position[2] >= 1.5 && f.position[2] < 2);
  CHECK(f.contact.kind == DSW_CONTACT_NONE && f.contact.wall.generation == 0);
  o.max_volumes = 0;
  o.flags = DSW_CAST_NO_DETAIL;
  memset(&f, 0x55, sizeof f);
  CHECK_OK(dsw_particle_move(scene, id, to, &o, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.position[2] < 4 && f.position[2] > 3.9 && f.time > 0 && f.time < 1);
  CHECK(f.contact.normal[2] == 0 && f.contact.wall.generation == 0 && f.contact.behind.generation == 0);
  o.flags = DSW_CAST_START_KNOWN; /* no effect */
  CHECK_OK(dsw_particle_move(scene, id, g_middle, &o, &f));
  o.flags = 0x4;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_particle_move(scene, id, to, &o, &f));
  o.flags = 0;
  o.struct_size = 4;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_particle_move(scene, id, to, &o, &f));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void a_bad_move_changes_nothing(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id id = particle_at(scene, g_middle);
  const double bad[3] = {0.5, NAN, 0.5};
  double position[3];
  dsw_flight f;
  memset(&f, 0x55, sizeof f);
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_particle_move(scene, id, bad, NULL, &f));
  CHECK_MESSAGE("dsw_particle_move: target[1] is nan, must be finite");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_move(scene, stale_particle, g_middle, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_particle_move(scene, id, NULL, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_particle_move(NULL, id, g_middle, NULL, &f));
  CHECK(f.volumes_visited == 0x55555555u);
  CHECK_OK(dsw_particle_get_position(scene, id, position, NULL));
  CHECK(memcmp(position, g_middle, sizeof position) == 0);
  CHECK_OK(dsw_scene_destroy(scene));
}

static void far_targets_are_values(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id id = particle_at(scene, g_middle);
  const double far_away[3] = {1e300, 1e300, -1e300}, tiny[3] = {1e-310, 1e-310, 1e-310};
  dsw_flight f;
  CHECK_OK(dsw_particle_move(scene, id, far_away, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.position[0] >= 0 && f.position[0] <= 4 && f.position[2] >= 0);
  CHECK_OK(dsw_particle_move(scene, id, tiny, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_REACHED && f.volume.index == 0);
  CHECK_OK(dsw_scene_destroy(scene));
}

/* ---- batches ---- */

enum { BATCH = 3000 };
typedef struct cloud {
  double *positions, *targets;
  dsw_particle_id *ids;
  dsw_flight *flights;
} cloud;

static cloud cloud_create(void) {
  cloud c;
  uint32_t random = 99;
  size_t i;
  c.positions = (double *)malloc(BATCH * 3 * sizeof(double));
  c.targets = (double *)malloc(BATCH * 3 * sizeof(double));
  c.ids = (dsw_particle_id *)malloc(BATCH * sizeof(dsw_particle_id));
  c.flights = (dsw_flight *)calloc(BATCH, sizeof(dsw_flight));
  for (i = 0; i < 3 * BATCH; ++i) {
    random = random * 1664525u + 1013904223u;
    c.positions[i] = (random >> 16) % 128 / 32.0; /* many on faces, edges and vertices */
    random = random * 1664525u + 1013904223u;
    c.targets[i] = (random >> 16) % 256 / 32.0 - 2;
  }
  return c;
}

static void cloud_destroy(cloud *c) {
  free(c->positions);
  free(c->targets);
  free(c->ids);
  free(c->flights);
}

/* Two moves of the cloud in a scene of its own; the flights of the second, and the counters of both. */
static dsw_statistics run_cloud(dsw_context *context, cloud *c, size_t *crossings) {
  dsw_environment *const env = make_environment(context, 4, 4, 4);
  const dsw_volume_id walls[3] = {{21, 1}, {38, 1}, {50, 1}};
  dsw_scene *const scene = make_scene(env, DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS);
  dsw_statistics s;
  const dsw_crossing *list = NULL;
  const size_t *first = NULL;
  size_t i, flights = 0, offender = 0;
  dsw_particle_id probe;
  CHECK_OK(dsw_environment_mark_volumes(env, walls, 3, DSW_MARK_IMPASSABLE, 0, NULL));
  for (i = 0; i < BATCH; ++i) { /* out of the walls */
    double *const p = c->positions + 3 * i;
    while (dsw_particle_create(scene, p, no_volume, &probe) != DSW_STATUS_OK) p[0] = p[0] >= 1 ? p[0] - 1 : p[0] + 3;
    CHECK_OK(dsw_particle_destroy(scene, probe));
  }
  CHECK_OK(dsw_scene_create_particles(scene, c->positions, BATCH, 0, NULL, c->ids, &offender));
  CHECK_OK(dsw_scene_move_particles(scene, c->ids, BATCH, c->targets, 0, NULL, NULL));
  CHECK_OK(dsw_scene_move_particles(scene, c->ids, BATCH, c->positions, 0, NULL, c->flights));
  CHECK_OK(dsw_scene_get_crossings(scene, &list, &first, &flights));
  CHECK(flights == BATCH && first[0] == 0);
  for (i = 0; i < BATCH; ++i) {
    size_t k;
    CHECK(first[i + 1] - first[i] == c->flights[i].volumes_visited);
    CHECK(list[first[i]].face.generation == 0 && list[first[i]].time == 0);
    for (k = first[i] + 1; k < first[i + 1]; ++k)
      CHECK(list[k].time >= list[k - 1].time && list[k].face.generation == 1);
  }
  *crossings = first[BATCH];
  s.struct_size = sizeof s;
  CHECK_OK(dsw_scene_get_statistics(scene, &s));
  end_scene(scene);
  return s;
}

static void batches_are_the_same_for_any_sharing(void) {
  dsw_context_desc d;
  dsw_context *one = NULL, *four = NULL;
  host h;
  dsw_context *const own = make_context(&h);
  dsw_context *contexts[3];
  cloud c = cloud_create();
  dsw_flight *const wanted = (dsw_flight *)malloc(BATCH * sizeof(dsw_flight));
  dsw_statistics first, s;
  size_t first_crossings = 0, crossings = 0, k;
  dsw_context_desc_init(&d, sizeof d);
  d.thread_count = 1;
  CHECK_OK(dsw_context_create(&d, &one));
  d.thread_count = 4;
  CHECK_OK(dsw_context_create(&d, &four));
  contexts[0] = one;
  contexts[1] = four;
  contexts[2] = own;
  for (k = 0; k < 3; ++k) {
    s = run_cloud(contexts[k], &c, &crossings);
    if (k == 0) {
      first = s;
      first_crossings = crossings;
      memcpy(wanted, c.flights, BATCH * sizeof(dsw_flight));
      CHECK(s.contacts > 100 && s.contacts < 2 * BATCH && s.casts == 2 * BATCH + s.candidates);
    } else {
      CHECK(memcmp(wanted, c.flights, BATCH * sizeof(dsw_flight)) == 0);
      CHECK(memcmp(&first, &s, sizeof s) == 0 && crossings == first_crossings);
    }
  }
  CHECK(h.parallel_calls > 0 && h.tasks > h.parallel_calls);
  CHECK_OK(dsw_context_destroy(one));
  CHECK_OK(dsw_context_destroy(four));
  end_context(own, &h);
  free(wanted);
  cloud_destroy(&c);
}

static void small_batches_stay_on_this_thread(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_scene *const scene = make_scene(make_environment(context, 4, 4, 4), 0);
  dsw_particle_id ids[100];
  double positions[300];
  size_t i;
  for (i = 0; i < 300; ++i) positions[i] = 0.5 + (double)(i % 4);
  CHECK_OK(dsw_scene_create_particles(scene, positions, 100, 0, NULL, ids, NULL));
  CHECK_OK(dsw_scene_move_particles(scene, ids, 100, positions, 0, NULL, NULL));
  CHECK(h.parallel_calls == 0);
  end_scene(scene);
  CHECK_OK(dsw_context_destroy(context));
}

static void a_single_move_allocates_nothing(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const env = make_environment(context, 4, 4, 4);
  dsw_scene *const scene = make_scene(env, DSW_FEATURE_STATISTICS);
  const dsw_particle_id id = particle_at(scene, g_middle);
  const double to[3] = {9, 9, 9};
  const size_t calls = h.calls;
  dsw_flight f;
  CHECK_OK(dsw_particle_move(scene, id, to, NULL, &f));
  CHECK_OK(dsw_environment_cast(env, no_volume, g_middle, to, NULL, &f));
  CHECK(h.calls == calls);
  end_scene(scene);
  CHECK_OK(dsw_context_destroy(context));
}

static void bad_batches_move_nothing(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  dsw_particle_id ids[3];
  double targets[9] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5}, position[3];
  dsw_flight f[3];
  size_t i;
  for (i = 0; i < 3; ++i) ids[i] = particle_at(scene, g_middle);
  memset(f, 0x55, sizeof f);
  targets[8] = -INFINITY;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_move_particles(scene, ids, 3, targets, 0, NULL, f));
  CHECK_MESSAGE("targets[2][2] is -inf");
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_cast_from_particles(scene, ids, 3, targets, 0, NULL, f));
  CHECK_MESSAGE("to[2][2] is -inf");
  targets[8] = 0.5;
  ids[2] = ids[0];
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, dsw_scene_move_particles(scene, ids, 3, targets, 0, NULL, f));
  CHECK_MESSAGE("particles[2] {index 0, generation 1} occurs twice");
  ids[2] = stale_particle;
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_scene_move_particles(scene, ids, 3, targets, 0, NULL, f));
  CHECK_MESSAGE("particles[2] {index 0, generation 7}");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_scene_cast_from_particles(scene, ids, 3, targets, 0, NULL, f));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_move_particles(scene, ids, 2, targets, 4, NULL, f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_move_particles(NULL, ids, 2, targets, 0, NULL, f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_move_particles(scene, NULL, 2, targets, 0, NULL, f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_move_particles(scene, ids, 2, NULL, 0, NULL, f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_cast_from_particles(NULL, ids, 2, targets, 0, NULL, f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_cast_from_particles(scene, ids, 2, targets, 0, NULL, NULL));
  CHECK(f[0].volumes_visited == 0x55555555u);
  for (i = 0; i < 2; ++i) {
    CHECK_OK(dsw_particle_get_position(scene, ids[i], position, NULL));
    CHECK(memcmp(position, g_middle, sizeof position) == 0);
  }
  CHECK_OK(dsw_scene_move_particles(scene, ids, 2, targets, 0, NULL, f)); /* a failed batch leaves no stamp behind */
  CHECK_OK(dsw_scene_move_particles(scene, NULL, 0, NULL, 0, NULL, NULL));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void casts_from_particles_leave_them_where_they_are(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id id = particle_at(scene, g_middle);
  const dsw_particle_id ids[2] = {id, id};
  const double to[8] = {3.5, 1.5, 1.5, 0, 9.5, 1.5, 1.5, 0};
  double position[3];
  dsw_flight f[2];
  CHECK_OK(dsw_scene_cast_from_particles(scene, ids, 2, to, 32, NULL, f));
  CHECK(f[0].outcome == DSW_OUTCOME_REACHED && f[0].position[0] == 3.5);
  CHECK(f[1].outcome == DSW_OUTCOME_CONTACT && f[1].time == 0.3125 && f[1].position[0] == 4 &&
        f[1].contact.normal[0] == -1);
  CHECK_OK(dsw_particle_get_position(scene, id, position, NULL));
  CHECK(memcmp(position, g_middle, sizeof position) == 0);
  CHECK_OK(dsw_scene_destroy(scene));
}

static void crossings_tell_the_way(void) {
  dsw_scene *const scene = make_scene(g_env, DSW_FEATURE_CROSSINGS), *const plain = make_scene(g_env, 0);
  const dsw_particle_id id = particle_at(scene, g_middle);
  const double to[3] = {3.5, 1.5, 1.5};
  const dsw_crossing *list = NULL;
  const size_t *first = NULL;
  size_t flights = 9;
  CHECK_OK(dsw_scene_get_crossings(scene, &list, &first, &flights));
  CHECK(flights == 0 && first[0] == 0);
  CHECK_OK(dsw_particle_move(scene, id, to, NULL, NULL));
  CHECK_OK(dsw_scene_get_crossings(scene, &list, &first, &flights));
  CHECK(flights == 1 && first[0] == 0 && first[1] == 3);
  CHECK(list[0].volume.index == 21 && list[0].face.generation == 0 && list[0].time == 0);
  CHECK(list[1].volume.index == 22 && list[1].face.volume == 21 && list[1].face.local == FACE_X1 &&
        list[1].time == 0.25);
  CHECK(list[2].volume.index == 23 && list[2].time == 0.75);
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, dsw_scene_get_crossings(plain, &list, &first, &flights));
  CHECK_MESSAGE("DSW_FEATURE_CROSSINGS");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_crossings(NULL, &list, &first, &flights));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_crossings(scene, NULL, &first, &flights));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_crossings(scene, &list, NULL, &flights));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_crossings(scene, &list, &first, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_occupants(scene, NULL, &flights));
  CHECK_OK(dsw_scene_destroy(plain));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void occupants_are_none_at_first(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id *occupants = NULL;
  size_t count = 9;
  CHECK_OK(dsw_scene_get_occupants(scene, &occupants, &count));
  CHECK(count == 0);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_occupants(NULL, &occupants, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_occupants(scene, &occupants, NULL));
  CHECK_OK(dsw_scene_destroy(scene));
}

int main(void) {
  g_env = make_environment(NULL, 4, 4, 4);
  particles_come_and_go();
  positions_come_in_bulk();
  ids_that_were_never_given_out_are_stale();
  a_bad_particle_is_refused();
  many_are_created_or_none();
  a_move_reaches_its_target();
  a_stopped_particle_stays_on_this_side();
  the_state_names_the_wall_that_stopped_it();
  options_are_obeyed();
  a_bad_move_changes_nothing();
  far_targets_are_values();
  batches_are_the_same_for_any_sharing();
  small_batches_stay_on_this_thread();
  a_single_move_allocates_nothing();
  bad_batches_move_nothing();
  casts_from_particles_leave_them_where_they_are();
  crossings_tell_the_way();
  occupants_are_none_at_first();
  CHECK_OK(dsw_environment_destroy(g_env));
  return check_result();
}
