/* The largest free part of steps: known fractions, islands, stacks at rest, walls that move, wrong arguments, and memory that
 * runs out. Nothing moves. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "draw.h"
#include "fixture.h"

static const double kAt[6] = {0.5, 0.5, 0.5, 0.5, 1.5, 0.5};

static dsw_status ask(dsw_scene *scene, dsw_body_id body, const double *steps, double *fraction, double *places) {
  return dsw_scene_step_fraction(scene, &body, 1, steps, 2, 0, NULL, 0, NULL, fraction, NULL, places, NULL);
}

static void expect_at(const dsw_scene *scene, dsw_body_id body, const double *at, size_t vertices) {
  double p[24];
  size_t count = 0;
  CHECK_OK(dsw_body_get_positions(scene, body, p, 8, 0, NULL, &count));
  CHECK(count == vertices && memcmp(p, at, 3 * vertices * sizeof *p) == 0);
}

/* A wall at x = 3, at 2.5 of 6. */
static void a_wall_bounds_it(void) {
  const double steps[6] = {6, 0, 0, 6, 0, 0};
  dsw_environment *environment = make_environment(NULL, 3, 2, 1);
  dsw_scene *scene = make_scene(environment, 0);
  const dsw_body_id body = make_edge_body(scene, kAt, DSW_LEVEL_EDGES_SWEPT);
  double fraction = 0, places[6];
  dsw_move_report r;
  size_t i;
  CHECK_OK(ask(scene, body, steps, &fraction, places));
  CHECK(fraction < 2.5 / 6 && fraction > 2.5 / 6 - 1e-15);
  for (i = 0; i < 6; ++i) CHECK(places[i] == kAt[i] + fraction * steps[i]);
  CHECK(places[0] < 3 && kAt[0] + nextafter(fraction, 1) * 6 >= 3);
  expect_at(scene, body, kAt, 2);
  CHECK_OK(dsw_scene_move_together(scene, &body, 1, places, 2, 0, NULL, &r));
  CHECK(r.fraction == 1 && r.vertices_stopped == 0);
  CHECK_OK(dsw_scene_step_fraction(scene, NULL, 0, NULL, 0, 0, NULL, 0, NULL, &fraction, NULL, NULL, NULL));
  CHECK(fraction == 1);
  end_scene(scene);
}

/* One body meets the wall, another one far away is free. */
static void islands_have_their_own(void) {
  const double other[6] = {0.5, 0.5, 3.5, 0.5, 1.5, 3.5};
  const double steps[12] = {5, 0, 0, 5, 0, 0, 1, 0, 0, 1, 0, 0};
  dsw_environment *environment = make_environment(NULL, 3, 2, 4);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  dsw_together_options o;
  dsw_body_id bodies[2];
  double fraction = 0, fractions[2], places[12];
  bodies[0] = make_edge_body(scene, kAt, DSW_LEVEL_EDGES_SWEPT);
  bodies[1] = make_edge_body(scene, other, DSW_LEVEL_EDGES_SWEPT);
  dsw_together_options_init(&o, sizeof o);
  CHECK_OK(dsw_scene_step_fraction(scene, bodies, 2, steps, 4, 0, NULL, 0, &o, &fraction, fractions, places, NULL));
  CHECK(fraction < 0.5 && fraction > 0.4999999 && fractions[0] == fraction && fractions[1] == 1);
  CHECK(places[6] == 0.5 + fraction);
  o.stop = DSW_TOGETHER_STOP_ISLAND;
  CHECK_OK(dsw_scene_step_fraction(scene, bodies, 2, steps, 4, 0, NULL, 0, &o, &fraction, fractions, places, NULL));
  CHECK(fraction < 0.5 && fractions[0] == fraction && fractions[1] == 1);
  CHECK(places[0] == 0.5 + fraction * 5 && places[6] == 1.5);
  end_scene(scene);
}

enum { STACK = 3, CORNERS = 8 };

/* Cubes with all faces: the lowest lies on the floor z = 0, each other one a double above the one below. */
static dsw_body_id make_cube(dsw_scene *scene, double *at, double low, uint32_t flags) {
  static const uint32_t faces[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                     2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  uint32_t offsets[13];
  dsw_body_desc d;
  dsw_body_id body = {0, 0};
  uint32_t i;
  for (i = 0; i < CORNERS; ++i) {
    at[3 * i] = 1 + (double)(i % 2);
    at[3 * i + 1] = 1 + (double)(i / 2 % 2);
    at[3 * i + 2] = low + 0.5 * (double)(i / 4);
  }
  for (i = 0; i < 13; ++i) offsets[i] = 3 * i;
  dsw_body_desc_init(&d, sizeof d);
  d.level = DSW_LEVEL_FACES;
  d.flags = flags;
  d.positions = at;
  d.vertex_count = CORNERS;
  d.face_offsets = offsets;
  d.face_corners = faces;
  d.face_count = 12;
  d.face_corner_count = 36;
  CHECK_OK(dsw_body_create(scene, &d, &body));
  return body;
}

/* Steps that slide along the floor, turn on it or leave it are free, whether or not the environment may move, too. */
static void stacks_at_rest(int with_environment) {
  dsw_environment *environment = make_environment(NULL, 3, 3, 3);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  dsw_body_id bodies[STACK];
  double at[3 * CORNERS * STACK], steps[3 * CORNERS * STACK], still[3 * 64] = {0}, fraction, low = 0;
  int round, k, c, i;
  g_state = 7;
  for (k = 0; k < STACK; ++k) {
    bodies[k] = make_cube(scene, at + 3 * CORNERS * k, low, k % 2 == 0 ? 0 : DSW_BODY_SEQUENCES);
    low = nextafter(at[3 * CORNERS * k + 3 * CORNERS - 1], 9);
  }
  for (round = 0; round < 200; ++round) {
    double up = 0;
    for (k = 0; k < STACK; ++k) {
      const double turn = 0.2 * share() - 0.1, x = 0.2 * share() - 0.1, y = 0.2 * share() - 0.1;
      double lift = up;
      for (c = 0; c < CORNERS; ++c) {
        double *const step = steps + 3 * (CORNERS * k + c);
        const double *const p = at + 3 * (CORNERS * k + c);
        step[0] = x - turn * (p[1] - 1.5);
        step[1] = y + turn * (p[0] - 1.5);
        step[2] = up;
        if (round % 3 == 1) step[2] += 0.01;                                                      /* leaves */
        if (round % 3 == 2) step[2] += 0.05 * share() * (c < 4 ? 1 : 0) + 0.05 * (c < 4 ? 0 : 1); /* and tilts */
        if (step[2] > lift) lift = step[2];
      }
      up = round % 3 == 0 ? 0 : lift + 0.1;
    }
    fraction = 0;
    CHECK_OK(dsw_scene_step_fraction(scene, bodies, STACK, steps, CORNERS * STACK, 0, with_environment ? still : NULL,
                                     with_environment ? 64 : 0, NULL, &fraction, NULL, NULL, NULL));
    CHECK(fraction == 1);
  }
  /* Down there is no way at all. */
  for (i = 0; i < 3 * CORNERS * STACK; ++i) steps[i] = i % 3 == 2 ? -0.25 : 0;
  CHECK_OK(dsw_scene_step_fraction(scene, bodies, STACK, steps, CORNERS * STACK, 0, with_environment ? still : NULL,
                                   with_environment ? 64 : 0, NULL, &fraction, NULL, NULL, NULL));
  CHECK(fraction >= 0 && fraction < 1e-15);
  for (k = 0; k < STACK; ++k) expect_at(scene, bodies[k], at + 3 * CORNERS * k, CORNERS);
  end_scene(scene);
}

/* A floor that rises to a body that stands, and a body that goes with it. */
static void walls_that_move(void) {
  const double low[6] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5};
  dsw_environment *environment = make_environment(NULL, 2, 1, 1);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  const dsw_body_id body = make_edge_body(scene, low, DSW_LEVEL_EDGES_SWEPT);
  double walls[36], places[36], steps[6] = {0}, fraction = 0;
  const double *points = NULL;
  size_t i, count = 0;
  CHECK_OK(dsw_environment_get_points(environment, &points, &count));
  for (i = 0; i < 36; ++i) walls[i] = i % 3 == 2 && points[i] == 0 ? 0.75 : 0;
  CHECK_OK(dsw_scene_step_fraction(scene, NULL, 0, NULL, 0, 0, walls, 12, NULL, &fraction, NULL, NULL, places));
  CHECK(fraction < 2.0 / 3 && fraction > 2.0 / 3 - 1e-15);
  for (i = 0; i < 36; ++i) CHECK(places[i] == points[i] + fraction * walls[i]);
  steps[2] = steps[5] = 0.375;
  CHECK_OK(dsw_scene_step_fraction(scene, &body, 1, steps, 2, 0, walls, 12, NULL, &fraction, NULL, NULL, NULL));
  CHECK(fraction == 1);
  CHECK_OK(dsw_body_set_radius(scene, body, 0.125)); /* keeps that from the floor */
  CHECK_OK(dsw_scene_step_fraction(scene, NULL, 0, NULL, 0, 0, walls, 12, NULL, &fraction, NULL, NULL, NULL));
  CHECK(fraction < 0.5 + 1e-9 && fraction > 0.5 - 1e-9);
  CHECK_OK(dsw_body_set_radius(scene, body, 0));
  walls[2] = 2; /* the volume at it turns over: that bounds the fraction as well */
  CHECK_OK(dsw_scene_step_fraction(scene, &body, 1, steps, 2, 0, walls, 12, NULL, &fraction, NULL, NULL, NULL));
  CHECK(fraction > 0 && fraction < 1);
  expect_at(scene, body, low, 2);
  end_scene(scene);
}

/* Nothing is there but the environment. */
static void nobody_is_there(void) {
  dsw_environment *environment = make_environment(NULL, 2, 1, 1);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  double walls[36] = {0}, fraction = 0;
  walls[2] = 0.25;
  CHECK_OK(dsw_scene_step_fraction(scene, NULL, 0, NULL, 0, 0, walls, 12, NULL, &fraction, NULL, NULL, NULL));
  CHECK(fraction == 1);
  end_scene(scene);
}

static void wrong_arguments(void) {
  double steps[6] = {0}, walls[108] = {0}, fraction = 7;
  dsw_environment *environment = make_environment(NULL, 2, 2, 3);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  dsw_body_id bodies[2];
  dsw_together_options o;
  bodies[0] = bodies[1] = make_edge_body(scene, kAt, DSW_LEVEL_EDGES_SWEPT);
  dsw_together_options_init(&o, sizeof o);
#define ASK(scene, bodies, n, steps, m, walls, points, fraction) \
  dsw_scene_step_fraction(scene, bodies, n, steps, m, 0, walls, points, &o, fraction, NULL, NULL, NULL)
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, ASK(NULL, bodies, 1, steps, 2, NULL, 0, &fraction));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, ASK(scene, NULL, 1, steps, 2, NULL, 0, &fraction));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, ASK(scene, bodies, 1, NULL, 2, NULL, 0, &fraction));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, ASK(scene, bodies, 1, steps, 2, NULL, 0, NULL));
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, ASK(scene, bodies, 2, steps, 4, NULL, 0, &fraction));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, ASK(scene, bodies, 1, steps, 1, NULL, 0, &fraction));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, ASK(scene, bodies, 1, steps, 2, NULL, 36, &fraction));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, ASK(scene, bodies, 1, steps, 2, walls, 35, &fraction));
  steps[4] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, ASK(scene, bodies, 1, steps, 2, NULL, 0, &fraction));
  CHECK_MESSAGE("steps[1]");
  steps[4] = 0;
  walls[3] = INFINITY;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, ASK(scene, bodies, 1, steps, 2, walls, 36, &fraction));
  CHECK_MESSAGE("environment_steps[1]");
  o.stop = DSW_TOGETHER_STOP_FEATURE;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, ASK(scene, bodies, 1, steps, 2, NULL, 0, &fraction));
  o.stop = DSW_TOGETHER_STOP_ALL;
  CHECK(fraction == 7);
  CHECK_OK(ASK(scene, bodies, 1, steps, 2, NULL, 0, &fraction));
  CHECK(fraction == 1);
  end_scene(scene);
}

static void memory_runs_out(int with_environment) {
  const double steps[6] = {6, 0, 0, 6, 0, 0}, still[72] = {0};
  host h;
  dsw_context *context = make_context(&h);
  dsw_environment *environment = make_environment(context, 3, 2, 1);
  dsw_scene *scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  const dsw_body_id body = make_edge_body(scene, kAt, DSW_LEVEL_EDGES_SWEPT);
  double fraction = 7, places[6];
  size_t n = 0;
  while (n < 1000 &&
         RUNS_OUT(&h, n,
                  dsw_scene_step_fraction(scene, &body, 1, steps, 2, 0, with_environment ? still : NULL,
                                          with_environment ? 24 : 0, NULL, &fraction, NULL, places, NULL))) {
    CHECK(fraction == 7);
    expect_at(scene, body, kAt, 2);
    ++n;
  }
  CHECK(n > 3 && n < 1000 && fraction < 2.5 / 6 && fraction > 0.41);
  end_scene(scene);
  end_context(context, &h);
}

int main(void) {
  a_wall_bounds_it();
  islands_have_their_own();
  stacks_at_rest(0);
  stacks_at_rest(1);
  walls_that_move();
  nobody_is_there();
  wrong_arguments();
  memory_runs_out(0);
  memory_runs_out(1);
  return check_result();
}
