/* remesh.h: volumes that a deformation would turn inside out are merged before or after it; every way to be refused;
   what can't be repaired; and deformations that repair. */
#include <string.h>

#include "check.h"
#include "fixture.h"

enum { N = 4, POINTS = 5 * 5 * 5 };

static dsw_environment *g_env; /* 4 x 4 x 4 cubes */
static dsw_scene *g_scene;
static grid g_grid;
static double g_next[3 * POINTS]; /* lent */
static dsw_change g_report;

/* Volumes without labels, which can be merged. */
static void begin(dsw_context *context) {
  dsw_environment_desc desc;
  g_grid = grid_create(N, N, N);
  desc = grid_desc(&g_grid);
  desc.regions = NULL;
  desc.tags = NULL;
  CHECK_OK(dsw_environment_create(context, &desc, &g_env, NULL));
  g_scene = make_scene(g_env, DSW_FEATURE_DEFORMING);
  memcpy(g_next, g_grid.points, sizeof g_next);
}

static void end(void) {
  end_scene(g_scene);
  grid_destroy(&g_grid);
}

static double *point(unsigned x, unsigned y, unsigned z) { return g_next + 3 * (size_t)grid_point(&g_grid, x, y, z); }

/* The point in the middle passes the next one. */
static void fold(void) { point(2, 2, 2)[1] += 1.1; }

static dsw_remesh_desc with_next(void) {
  dsw_remesh_desc d;
  dsw_remesh_desc_init(&d, sizeof d);
  d.next = g_next;
  d.point_count = POINTS;
  return d;
}

static int is_valid(dsw_volume_id volume) {
  int valid = -1;
  CHECK_OK(dsw_environment_is_valid(g_env, volume, &valid));
  return valid;
}

static size_t left(void) { return change_of(g_env).unrepaired_count; }

static void before_a_deformation(void) {
  dsw_remesh_desc d = with_next();
  const dsw_volume_change *changes = NULL;
  size_t count = 0, i;
  begin(NULL);
  fold();
  CHECK_OK(dsw_environment_remesh(g_env, &d, &g_report));
  CHECK(g_report.volumes_invalid > 0 &&
        g_report.volumes_invalid - g_report.unrepaired_count == g_report.volumes_invalid &&
        g_report.unrepaired_count == 0);
  CHECK(g_report.patch_count == 1 && g_report.volumes_added == 1 && g_report.volumes_removed > 1);
  CHECK(g_report.most_faces > 6 && g_report.reserved == 0 && left() == 0);
  changes = change_of(g_env).volumes;
  count = change_of(g_env).volume_count;
  CHECK(count == g_report.volumes_removed);
  for (i = 0; i < count; ++i)
    CHECK(changes[i].after.index == changes[0].after.index && changes[i].before.generation == 1);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  CHECK_OK(dsw_environment_deform(g_env, g_next, POINTS, NULL, NULL));
  CHECK(is_valid(changes[0].after) == 1);
  CHECK(info_of(g_env).volume_count == N * N * N + 1 - g_report.volumes_removed);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  end();
}

static void after_a_deformation(void) {
  const dsw_volume_id one = volume_at(2 + N * (2 + N * 2)); /* (2, 2, 2): it has the vertex */
  dsw_remesh_desc d;
  begin(NULL);
  fold();
  CHECK_OK(dsw_environment_deform(g_env, g_next, POINTS, NULL, NULL));
  CHECK(is_valid(one) == 0);
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_check(g_env, NULL));
  dsw_remesh_desc_init(&d, sizeof d);
  d.volumes = &one;
  d.volume_count = 0;
  CHECK_OK(dsw_environment_remesh(g_env, &d, &g_report)); /* none is named */
  CHECK(g_report.volumes_invalid == 0 && g_report.volumes_removed == 0 && is_valid(one) == 0);
  d.volume_count = 1;
  CHECK_OK(dsw_environment_remesh(g_env, &d, &g_report));
  CHECK(g_report.volumes_invalid == 1 && g_report.volumes_invalid - g_report.unrepaired_count == 1);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_remesh(g_env, &d, NULL));
  CHECK_OK(dsw_environment_remesh(g_env, NULL, NULL)); /* whatever is left */
  CHECK_OK(dsw_environment_remesh(g_env, NULL, &g_report));
  CHECK(g_report.volumes_invalid == 0);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  end();
}

/* The outer boundary cannot be changed, and labels are not mixed. */
static void what_is_left(void) {
  dsw_remesh_desc d = with_next();
  const dsw_volume_id *volumes = NULL;
  size_t count = 0;
  uint32_t i;
  begin(NULL);
  point(0, 2, 2)[1] += 1.1; /* in the outer face: this folds */
  CHECK_OK(dsw_environment_remesh(g_env, &d, &g_report));
  CHECK(g_report.volumes_invalid > 0 && g_report.volumes_invalid - g_report.unrepaired_count == 0 &&
        g_report.volumes_removed == 0);
  CHECK(left() == g_report.unrepaired_count && g_report.unrepaired_count == g_report.volumes_invalid);
  volumes = change_of(g_env).unrepaired;
  count = change_of(g_env).unrepaired_count;
  for (i = 0; i < count; ++i) CHECK(is_valid(volumes[i]) == 1); /* until it is bent */
  end();
  begin(NULL);
  fold();
  for (i = 0; i < N * N * N; ++i) CHECK_OK(dsw_environment_set_tag(g_env, volume_at(i), i));
  CHECK_OK(dsw_environment_remesh(g_env, &d, &g_report));
  CHECK(g_report.volumes_invalid > 0 && g_report.volumes_invalid - g_report.unrepaired_count == 0);
  end();
}

static void with_a_deformation(void) {
  const double at[3] = {1.5, 2.5, 2.5};
  dsw_particle_id particle;
  dsw_deform_options o;
  dsw_deform_report report;
  dsw_volume_id in;
  double now[3];
  int remesh;
  for (remesh = 0; remesh < 2; ++remesh) {
    begin(NULL);
    fold();
    CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
    dsw_deform_options_init(&o, sizeof o);
    CHECK(o.remesh_radius == 0 && o.remesh_max_faces == 0);
    o.invalid = remesh ? DSW_INVALID_REMESH : DSW_INVALID_HOLD;
    CHECK_OK(dsw_environment_deform(g_env, g_next, POINTS, &o, &report));
    CHECK(remesh ? report.remeshed_count > 0 : report.remeshed_count == 0);
    CHECK_OK(dsw_particle_get_position(g_scene, particle, now, &in));
    CHECK(is_valid(in) == 1 && now[0] == at[0] && now[1] == at[1]);
    CHECK(report.outcome == (remesh ? DSW_DEFORM_DONE : DSW_DEFORM_HELD));
    end();
  }
}

static void bad_arguments(void) {
  dsw_remesh_desc bad;
  dsw_remesh_desc d = with_next();
  dsw_deform_options o;
  dsw_scene *other;
  begin(NULL);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_remesh(NULL, &d, NULL));
  d.volume_count = 1;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_remesh(g_env, &d, NULL));
  CHECK_MESSAGE("desc->volumes");
  d.volumes = &stale_volume;
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_remesh(g_env, &d, NULL));
  CHECK_REFUSES(DSW_STATUS_BAD_STRUCT_SIZE, with_next(), struct_size, 8, dsw_environment_remesh(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, with_next(), flags, 1, dsw_environment_remesh(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_WRONG_SIZE, with_next(), point_count, POINTS - 1, dsw_environment_remesh(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_WRONG_SIZE, bad, next, NULL, dsw_environment_remesh(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, with_next(), radius, 9, dsw_environment_remesh(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, with_next(), max_faces, 3, dsw_environment_remesh(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, with_next(), max_faces, 129, dsw_environment_remesh(g_env, &bad, NULL));
  dsw_deform_options_init(&o, sizeof o);
  o.remesh_radius = 9;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_deform(g_env, g_next, POINTS, &o, NULL));
  o.remesh_radius = 0;
  o.remesh_max_faces = 3;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_deform(g_env, g_next, POINTS, &o, NULL));
  CHECK_OK(dsw_scene_destroy(g_scene));
  g_scene = make_scene(g_env, 0);
  other = make_scene(g_env, 0);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_remesh(g_env, NULL, NULL));
  CHECK_OK(dsw_scene_destroy(other));
  CHECK_OK(dsw_environment_remesh(g_env, NULL, &g_report)); /* nothing is invalid */
  CHECK(g_report.volumes_invalid == 0 && g_report.patch_count == 0 && left() == 0);
  end();
}

/* A vertex that is not a number is left alone. */
static void not_finite(void) {
  dsw_remesh_desc d = with_next();
  const double nought = 0;
  begin(NULL);
  point(2, 2, 2)[1] = 0 / nought;
  CHECK_OK(dsw_environment_remesh(g_env, &d, &g_report));
  CHECK(g_report.volumes_invalid == 8 && g_report.unrepaired_count == 8 && g_report.volumes_removed == 0);
  end();
}

static void without_memory(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment_info before, now;
  dsw_remesh_desc d = with_next();
  size_t n = 0;
  begin(context);
  fold();
  before = info_of(g_env);
  for (; RUNS_OUT(&h, n, dsw_environment_remesh(g_env, &d, &g_report)); ++n) {
    now = info_of(g_env);
    CHECK(now.volume_count == before.volume_count && now.face_count == before.face_count);
  }
  CHECK(n > 50 && g_report.volumes_invalid - g_report.unrepaired_count > 0);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  end();
  end_context(context, &h);
}

int main(void) {
  g_report = empty_change();
  before_a_deformation();
  after_a_deformation();
  what_is_left();
  with_a_deformation();
  bad_arguments();
  not_finite();
  without_memory();
  return check_result();
}
