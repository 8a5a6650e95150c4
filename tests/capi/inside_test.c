/* Points on the boundary of passable space, where the shift puts some of them outside, and the nearest places inside. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 2 x 2 cubes, or squares */
static unsigned g_dimension;

/* Exactly on the side x = 4 of the last cell in the first row, on the corner there, on the side x = 0, in the middle of
   cell 2, and outside; in the plane without z. */
enum { COUNT = 5 };
static const double g_space[COUNT * 3] = {4, 0.5, 0.25, 4, 2, 2, 0, 0.5, 0.25, 2.5, 0.5, 0.5, 4.5, 0.5, 0.5};
static const double g_plane[COUNT * 2] = {4, 0.5, 4, 2, 0, 0.5, 2.5, 0.5, 4.5, 0.5};

static const double *points(void) { return g_dimension == 3 ? g_space : g_plane; }
static uint32_t side_x1(void) { return g_dimension == 3 ? FACE_X1 : 1; }

static void what_is_nearest_is_at_distance_0(void) {
  dsw_nearest n[COUNT], one;
  dsw_segment_nearest s;
  dsw_location locations[COUNT];
  CHECK_OK(dsw_environment_find_nearest_to_points(g_env, points(), COUNT, 0, NULL, 0.75, n, NULL, locations));
  CHECK(locations[0] == DSW_LOCATION_OUTSIDE && locations[1] == DSW_LOCATION_OUTSIDE);
  CHECK(locations[2] == DSW_LOCATION_PASSABLE && locations[4] == DSW_LOCATION_OUTSIDE);
  CHECK(n[0].distance == 0 && n[0].cell.kind == DSW_CELL_FACE && n[0].cell.index == 3 && n[0].cell.local == side_x1());
  CHECK(n[0].point[0] == 4 && n[0].point[1] == 0.5 && n[0].normal[0] == 0 && n[0].tag == 103);
  CHECK(n[1].distance == 0 && n[1].cell.index == (g_dimension == 3 ? 15u : 7u));
  CHECK(n[2].distance == 0 && n[2].cell.index == 0 && n[2].normal[0] == 0);
  CHECK(n[3].distance == 0.5 && n[4].distance == HUGE_VAL && n[4].cell.kind == DSW_CELL_NONE);
  CHECK_OK(dsw_environment_find_nearest(g_env, points(), no_volume, 0, &one));
  CHECK(memcmp(&one, &n[0], sizeof one) == 0);
  CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_environment_find_nearest(g_env, points() + 4 * g_dimension, no_volume, 1, &one));
  CHECK_MESSAGE("lies in no volume");
  CHECK_OK(dsw_environment_find_nearest_to_segments(g_env, 1, NULL, points(), points() + 3 * g_dimension, 0, 1, &s,
                                                    NULL, NULL));
  CHECK(memcmp(&s.nearest, &n[0], sizeof n[0]) == 0 && s.segment_parameter == 0 && s.segment_point[0] == 4);
}

static void the_boundary_is_named(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_volume_id wall = volume_at(3);
  const dsw_vertex_id tip = vertex_at(g_dimension == 3 ? 44 : 14);
  dsw_particle_id id;
  dsw_nearest n;
  CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_particle_create(scene, points(), no_volume, &id));
  CHECK_MESSAGE(g_dimension == 3 ? "position (4, 0.5, 0.25) is on the boundary, at face 1 of volume 3, where the shift"
                                 : "position (4, 0.5) is on the boundary, at face 1 of volume 3, where the shift");
  CHECK_MESSAGE("puts it outside; dsw_environment_find_inside");
  CHECK_OK(dsw_scene_destroy(scene));
  /* A marked vertex has the lower dimension. */
  CHECK_OK(dsw_environment_mark_vertices(g_env, &tip, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_find_nearest(g_env, points() + g_dimension, no_volume, 1, &n));
  CHECK(n.distance == 0 && n.cell.kind == DSW_CELL_VERTEX && n.cell.index == tip.index);
  CHECK_OK(dsw_environment_mark_vertices(g_env, &tip, 1, DSW_MARK_PASSABLE));
  /* Between a passable and an impassable volume. */
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  {
    const double between[3] = {3, 0.5, 0.25}, within[3] = {3.5, 0.5, 0.25}, far_side[3] = {4, 0.5, 0.25};
    CHECK_OK(dsw_environment_find_nearest(g_env, between, no_volume, 1, &n));
    CHECK(n.distance == 0 && n.cell.index == 2 && n.cell.local == side_x1() && n.tag == 103);
    CHECK_FAILS(DSW_STATUS_IMPASSABLE, dsw_environment_find_nearest(g_env, within, no_volume, 1, &n));
    CHECK_MESSAGE("lies in volume 3, which is impassable");
    CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_environment_find_nearest(g_env, far_side, no_volume, 1, &n));
  }
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_PASSABLE, 0, NULL));
}

static void places_inside_are_found(void) {
  double in[COUNT * 3];
  dsw_volume_id volumes[COUNT];
  const unsigned d = g_dimension;
  unsigned i, k;
  CHECK_OK(dsw_environment_find_inside(g_env, points(), COUNT, 0, NULL, 0.125, in, volumes));
  CHECK(in[0] == 3.875 && in[1] == 0.5 && volumes[0].index == 3);
  CHECK(in[2 * d] == 0.125 && in[2 * d + 1] == 0.5 && volumes[2].index == 0);
  CHECK(memcmp(in + 3 * d, points() + 3 * d, d * sizeof *in) == 0 && volumes[3].index == 2);
  CHECK(in[4 * d] == 3.875 && in[4 * d + 1] == 0.5 && volumes[4].index == 3);
  /* The way along a normal at a corner stays on another wall: it leads to the centre. */
  for (k = 0; k < d; ++k) CHECK(in[d + k] < (k == 0 ? 4 : 2) && in[d + k] > (k == 0 ? 3.8 : 1.8));
  /* A way of 0 is as short as rounding allows. */
  CHECK_OK(dsw_environment_find_inside(g_env, points(), COUNT, 0, volumes, 0, in, NULL));
  CHECK(in[0] < 4 && in[0] > 4 - 2e-15 && in[2 * d] > 0 && in[2 * d] < 1e-15);
  /* More than there is room for: up to the centre of the volume. */
  CHECK_OK(dsw_environment_find_inside(g_env, points(), COUNT, 0, NULL, 100, in, volumes));
  CHECK(in[0] == 3.5 && in[1] == 0.5 && volumes[0].index == 3);
  for (i = 0; i < COUNT; ++i) CHECK(volumes[i].generation == 1);
}

static void nothing_inside_is_told(void) {
  dsw_volume_id all[16], volumes[COUNT];
  double in[COUNT * 3];
  uint32_t i;
  for (i = 0; i < info_of(g_env).volume_count; ++i) all[i] = volume_at(i);
  CHECK_OK(dsw_environment_mark_volumes(g_env, all, i, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_find_inside(g_env, points(), COUNT, 0, NULL, 0.125, in, volumes));
  CHECK(memcmp(in, points(), COUNT * g_dimension * sizeof *in) == 0 && volumes[0].generation == 0);
  CHECK_OK(dsw_environment_mark_volumes(g_env, all, i, DSW_MARK_PASSABLE, 0, NULL));
}

static void bad_questions_are_refused(void) {
  double in[COUNT * 3] = {7}, bad[3] = {0, NAN, 0};
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_find_inside(g_env, points(), 1, 0, NULL, -1, in, NULL));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_find_inside(g_env, points(), 1, 0, NULL, INFINITY, in, NULL));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_find_inside(g_env, points(), 1, 0, NULL, NAN, in, NULL));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_find_inside(g_env, bad, 1, 0, NULL, 0, in, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_find_inside(g_env, points(), 1, 0, &stale_volume, 0, in, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_find_inside(g_env, points(), 2, 4, NULL, 0, in, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_inside(g_env, NULL, 1, 0, NULL, 0, in, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_inside(g_env, points(), 1, 0, NULL, 0, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_inside(NULL, points(), 1, 0, NULL, 0, in, NULL));
  CHECK_OK(dsw_environment_find_inside(g_env, NULL, 0, 0, NULL, 0, NULL, NULL));
  CHECK(in[0] == 7);
}

static void run(unsigned dimension) {
  g_dimension = dimension;
  check_in(dimension == 3 ? "in space" : "in the plane");
  g_env = dimension == 3 ? make_environment(NULL, 4, 2, 2) : make_squares(NULL, 4, 2);
  what_is_nearest_is_at_distance_0();
  the_boundary_is_named();
  places_inside_are_found();
  nothing_inside_is_told();
  bad_questions_are_refused();
  CHECK_OK(dsw_environment_destroy(g_env));
}

int main(void) {
  run(3);
  run(2);
  return check_result();
}
