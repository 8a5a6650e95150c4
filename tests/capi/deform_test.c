/* Environments that bend: what lies in them stays free, or the walls do not come. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

enum { N = 4, POINTS = 5 * 5 * 5 };

/* 4 x 4 x 4 unit cubes and the two arrays of their points. */
static dsw_environment *g_env;
static dsw_scene *g_scene;
static double g_points[2][3 * POINTS];
static int g_next; /* the array that may be written */
static grid g_grid;
static unsigned char g_block[1 << 16];

static void begin(uint32_t features) {
  g_grid = grid_create(N, N, N);
  g_env = make_environment(NULL, N, N, N);
  g_scene = make_scene(g_env, features);
  memcpy(g_points[0], g_grid.points, sizeof g_points[0]);
  memcpy(g_points[1], g_grid.points, sizeof g_points[1]);
  g_next = 0;
}

static void end(void) {
  CHECK_OK(dsw_scene_destroy(g_scene));
  CHECK_OK(dsw_environment_destroy(g_env));
  grid_destroy(&g_grid);
}

static double *point(unsigned x, unsigned y, unsigned z) {
  return g_points[g_next] + 3 * (size_t)grid_point(&g_grid, x, y, z);
}

static uint32_t cube(uint32_t x, uint32_t y, uint32_t z) { return x + N * (y + N * z); }

/* Deforms to the array that may be written, which becomes the other one. */
static dsw_deform_report deform(const dsw_deform_options *o) {
  return deform_to_next(g_scene, g_points[0], POINTS, 3, &g_next, o);
}

/* A wall of the faces at height z = 2. */
static void mark_floor(void) {
  uint32_t x, y;
  for (y = 0; y < N; ++y) {
    for (x = 0; x < N; ++x) {
      const dsw_face_id face = face_at(cube(x, y, 1), FACE_Z1);
      CHECK_OK(dsw_environment_mark_faces(g_env, &face, 1, DSW_MARK_IMPASSABLE));
    }
  }
}

static void raise_floor(double by) {
  unsigned x, y;
  for (y = 0; y <= N; ++y) {
    for (x = 0; x <= N; ++x) point(x, y, 2)[2] += by;
  }
}

static void a_floor_lifts_a_particle(void) {
  const double at[3] = {2.3, 1.4, 2.2};
  dsw_particle_id particle;
  dsw_deform_report report;
  const dsw_wall_contact *contacts = NULL;
  size_t count = 0;
  double now[3];
  dsw_volume_id volume;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor();
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  raise_floor(0.5);
  report = deform(NULL);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.fraction == 1 && report.held_count == 0);
  CHECK(report.contact_count >= 1 && report.pushed_count >= 1 && report.near_count >= 8 && report.steps == 1);
  CHECK_OK(dsw_particle_get(g_scene, particle, now, &volume));
  CHECK(now[0] == at[0] && now[1] == at[1] && now[2] > 2.5 && volume.index == cube(2, 1, 2));
  CHECK_OK(dsw_scene_get_wall_contacts(g_scene, &contacts, &count));
  CHECK(count == report.contact_count && contacts[0].particle.index == particle.index &&
        contacts[0].particle.generation == particle.generation && contacts[0].body.generation == 0);
  CHECK(contacts[0].normal[2] > 0.5 && contacts[0].time > 0 && contacts[0].time < 1 &&
        contacts[0].response == DSW_WALL_PUSH && contacts[0].wall.generation == 1 &&
        contacts[0].moving.generation == 1);
  CHECK(contacts[0].point[2] == at[2] && contacts[0].tag == 100 + cube(2, 1, 1));
  end();
}

static void an_edge_is_pushed_split_or_holds_the_wall(void) {
  static const double positions[6] = {1.2, 2.1, 2.1, 2.7, 1.9, 2.1};
  static const dsw_wall_response responses[4] = {DSW_WALL_PUSH, DSW_WALL_INSERT, DSW_WALL_HOLD, DSW_WALL_STOP};
  int i;
  for (i = 0; i < 4; ++i) {
    dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, responses[i]);
    dsw_deform_report report;
    dsw_body_id body;
    dsw_body_counts counts;
    const dsw_vertex_id *held = NULL;
    size_t held_count = 0;
    begin(DSW_FEATURE_DEFORMING);
    mark_floor();
    body = make_edge_body(g_scene, positions, DSW_LEVEL_EDGES_SWEPT);
    point(2, 2, 2)[2] += 0.4; /* one vertex, below the middle of the edge */
    report = deform(&o);
    CHECK(report.contact_count >= 1);
    counts.struct_size = sizeof counts;
    CHECK_OK(dsw_body_get_counts(g_scene, body, &counts));
    CHECK(counts.vertex_count == (responses[i] == DSW_WALL_INSERT ? 3u : 2u));
    CHECK_OK(dsw_scene_get_held_vertices(g_scene, &held, &held_count));
    CHECK(held_count == report.held_count);
    if (responses[i] == DSW_WALL_HOLD) {
      CHECK(report.outcome == DSW_DEFORM_HELD && held_count == 1 && held[0].index == grid_point(&g_grid, 2, 2, 2));
      CHECK(point(2, 2, 2)[2] == 2);
    } else if (responses[i] == DSW_WALL_STOP) {
      CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction == 0.25);
      CHECK(point(2, 2, 2)[2] == 2 + 0.25 * (2.4 - 2));
    } else {
      CHECK(report.outcome == DSW_DEFORM_DONE && held_count == 0 && report.pushed_count >= 1);
      CHECK(point(2, 2, 2)[2] == 2.4);
    }
    if (responses[i] == DSW_WALL_INSERT) {
      const dsw_body_edit *edits = NULL;
      size_t edit_count = 0;
      CHECK_OK(dsw_body_get_edits(g_scene, body, &edits, &edit_count));
      CHECK(edit_count == 1 && edits[0].inserted == 1);
    }
    end();
  }
}

/* A ceiling that comes down on what lies on the floor cannot push it away. */
static void what_is_squeezed_holds_the_walls(void) {
  static const double positions[6] = {1.2, 2.1, 2.05, 2.7, 1.9, 2.05};
  dsw_body_id body;
  dsw_deform_report report;
  unsigned x, y;
  double now[6];
  size_t count = 0;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor();
  for (y = 0; y < N; ++y) {
    for (x = 0; x < N; ++x) {
      const dsw_face_id face = face_at(cube(x, y, 2), FACE_Z1);
      CHECK_OK(dsw_environment_mark_faces(g_env, &face, 1, DSW_MARK_IMPASSABLE));
    }
  }
  body = make_edge_body(g_scene, positions, DSW_LEVEL_FACES);
  for (y = 0; y <= N; ++y) {
    for (x = 0; x <= N; ++x) point(x, y, 3)[2] = 2.01;
  }
  report = deform(NULL);
  CHECK(report.outcome == DSW_DEFORM_HELD && report.held_count > 0 && report.contact_count > 0);
  CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 0, NULL, &count));
  CHECK(now[2] > 2 && now[5] > 2);
  CHECK(point(0, 0, 3)[2] == 2.01); /* far away nothing is in the way */
  end();
}

static void steps_are_halved_where_cells_would_fold(void) {
  const double at[3] = {2.5, 2.5, 2.5};
  dsw_particle_id particle;
  dsw_deform_report report;
  dsw_volume_id volume;
  size_t i;
  begin(DSW_FEATURE_DEFORMING);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  for (i = 0; i < POINTS; ++i) g_points[g_next][3 * i] += 1.5; /* each vertex further than a cube is wide */
  report = deform(NULL);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.steps > 1 && report.contact_count == 0);
  CHECK_OK(dsw_particle_get(g_scene, particle, NULL, &volume));
  CHECK(volume.index == cube(1, 2, 2) || volume.index == cube(0, 2, 2));
  end();
}

static void invalid_volumes(void) {
  const double at[3] = {2.5, 2.5, 2.5}, from[3] = {2.5, 2.5, 2.5}, to[3] = {2.5, 2.5, 0.5};
  dsw_particle_id particle;
  dsw_deform_report report;
  dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
  const dsw_volume_id *invalid = NULL;
  const dsw_volume_id start = volume_at(cube(2, 2, 2));
  size_t count = 0;
  dsw_flight flight;
  dsw_build_report built;
  int valid = -1;
  double before[3 * POINTS];
  begin(DSW_FEATURE_DEFORMING);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  /* Far from the particle: it goes through. */
  point(2, 2, 1)[2] = 2.6;
  memcpy(before, g_points[g_next], sizeof before);
  o.invalid = DSW_INVALID_REFUSE;
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.invalid_count == 0);
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(cube(2, 2, 2)), &valid));
  CHECK(valid == 1);
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(cube(2, 2, 1)), &valid));
  CHECK(valid == 0);
  built.struct_size = sizeof built;
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_check(g_env, &built));
  /* It counts as impassable, for casts from outside and as a question. */
  CHECK_OK(dsw_environment_cast_segments(g_env, 1, &start, from, to, 0, NULL, &flight));
  CHECK(flight.outcome == DSW_OUTCOME_CONTACT && flight.behind.index == cube(2, 2, 1) &&
        flight.obstacle == DSW_CELL_VOLUME && flight.position[2] >= 2);
  {
    int impassable = 0;
    CHECK_OK(dsw_environment_is_impassable(g_env, cell_at(DSW_CELL_VOLUME, cube(2, 2, 1), 0), &impassable));
    CHECK(impassable == 1);
  }
  CHECK_OK(dsw_environment_save(g_env, NULL, 0, &count));
  point(2, 2, 1)[2] = 1;
  report = deform(&o);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  /* Through the particle's own cube: refused, or held. */
  point(2, 2, 2)[2] = 3.5;
  memcpy(before, g_points[g_next], sizeof before);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_REFUSED && report.fraction == 0 && report.invalid_count >= 1);
  CHECK(memcmp(before, g_points[g_next], sizeof before) == 0);
  CHECK_OK(dsw_scene_get_invalid_volumes(g_scene, &invalid, &count));
  CHECK(count == report.invalid_count && invalid[0].generation == 1);
  o.invalid = DSW_INVALID_HOLD;
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_HELD && report.held_count == 1 && point(2, 2, 2)[2] < 3.5);
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(cube(2, 2, 2)), &valid));
  CHECK(valid == 1);
  end();
}

static void end_state(void) {
  const double at[3] = {2.3, 1.4, 2.2};
  dsw_particle_id particle;
  dsw_deform_report report;
  dsw_deform_options o = deform_options_of(DSW_DEFORM_END_STATE, DSW_WALL_PUSH);
  double now[3];
  dsw_volume_id volume;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor();
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  raise_floor(0.5);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == 1 && report.pushed_count == 1);
  CHECK_OK(dsw_particle_get(g_scene, particle, now, &volume));
  CHECK(now[2] >= 2.5 && volume.index == cube(2, 1, 2));
  /* Without a wall in the way it changes its volume instead. */
  o.response = DSW_WALL_STOP;
  raise_floor(-0.6);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == 0);
  raise_floor(0.8);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction < 1 && report.fraction > 0);
  o.response = DSW_WALL_HOLD;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_deform(g_scene, g_points[g_next], POINTS, &o, NULL));
  end();
}

static void bad_arguments(void) {
  const double at[3] = {2.5, 2.5, 2.5};
  dsw_particle_id particle;
  dsw_scene *other = NULL;
  dsw_scene_desc d;
  dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
  const dsw_wall_contact *contacts = NULL;
  size_t count = 0;
  const double *read = NULL;
  begin(0);
  CHECK_FAILS(DSW_STATUS_NOT_NAMED, dsw_scene_deform(g_scene, g_points[0], POINTS, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NOT_NAMED, dsw_scene_get_wall_contacts(g_scene, &contacts, &count));
  dsw_scene_desc_init(&d, sizeof d);
  d.features = DSW_FEATURE_DEFORMING;
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_scene_create(g_env, &d, &other));
  end();
  begin(DSW_FEATURE_DEFORMING);
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_scene_create(g_env, NULL, &other));
  CHECK(other == NULL);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_deform(NULL, g_points[0], POINTS, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_deform(g_scene, NULL, POINTS, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_deform(g_scene, g_points[0], POINTS - 1, NULL, NULL));
  o.most_halvings = 11;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_scene_deform(g_scene, g_points[0], POINTS, &o, NULL));
  o.most_halvings = 0;
  o.min_part = 0.6;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_scene_deform(g_scene, g_points[0], POINTS, &o, NULL));
  o.min_part = 0;
  o.flags = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_deform(g_scene, g_points[0], POINTS, &o, NULL));
  o.flags = 0;
  o.struct_size = 3;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_scene_deform(g_scene, g_points[0], POINTS, &o, NULL));
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  /* Near the particle it is an error, far away its volumes become invalid. */
  point(2, 2, 2)[1] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_deform(g_scene, g_points[0], POINTS, NULL, NULL));
  CHECK_MESSAGE("next[");
  o = deform_options_of(DSW_DEFORM_END_STATE, DSW_WALL_PUSH);
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_deform(g_scene, g_points[0], POINTS, &o, NULL));
  CHECK_OK(dsw_environment_get_points(g_env, &read, &count));
  CHECK(read != g_points[0]);
  point(2, 2, 2)[1] = 2;
  point(0, 0, 0)[0] = INFINITY;
  (void)deform(NULL);
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_scene_deform(g_scene, g_points[1 - g_next], POINTS, NULL, NULL));
  {
    int valid = -1;
    CHECK_OK(dsw_environment_is_valid(g_env, volume_at(0), &valid));
    CHECK(valid == 0);
    CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_is_valid(g_env, stale_volume, &valid));
    CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_is_valid(g_env, volume_at(0), NULL));
  }
  end();
}

/* Two cubes that share one point alone: it goes into either, and what lies there is pushed. */
static void a_point_between_two_cubes(void) {
  static const double at[2][3] = {{0.9, 0.9, 0.9}, {1.1, 1.1, 1.1}};
  double points[2][3 * 15];
  int64_t cells[16];
  dsw_environment_desc d;
  dsw_environment *environment = NULL;
  dsw_scene *scene;
  dsw_particle_id particles[2];
  int i, k, turn;
  for (i = 0; i < 15; ++i) {
    const int upper = i >= 8, corner = upper ? i - 7 : i; /* point 7 is corner 0 of the upper cube */
    for (k = 0; k < 3; ++k) points[0][3 * i + k] = ((corner >> k) & 1) + upper;
  }
  for (i = 0; i < 8; ++i) {
    const int corner = (i & 4) | (i & 2) | (((i >> 1) ^ i) & 1); /* VTK goes round, not across */
    cells[i] = corner;
    cells[8 + i] = 7 + corner;
  }
  memcpy(points[1], points[0], sizeof points[0]);
  dsw_environment_desc_init(&d, sizeof d);
  d.points = points[0];
  d.point_count = 15;
  d.connectivity = cells;
  d.connectivity_count = 16;
  d.cell_count = 2;
  CHECK_OK(dsw_environment_create(NULL, &d, &environment, NULL));
  scene = make_scene(environment, DSW_FEATURE_DEFORMING);
  for (i = 0; i < 2; ++i) CHECK_OK(dsw_particle_create(scene, at[i], no_volume, &particles[i]));
  for (turn = 0; turn < 4; ++turn) {
    dsw_deform_report report;
    double *const next = points[turn % 2 == 0 ? 1 : 0];
    for (k = 0; k < 3; ++k) next[3 * 7 + k] = turn % 2 == 0 ? 0.75 : 1.25;
    CHECK_OK(dsw_scene_deform(scene, next, 15, NULL, &report));
    CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == (turn < 2 ? 1u : 0u));
    for (i = 0; i < 2; ++i) {
      double now[3];
      dsw_volume_id volume;
      CHECK_OK(dsw_particle_get(scene, particles[i], now, &volume));
      CHECK(volume.index == (uint32_t)i && (i == 0 ? now[0] < 0.76 : now[0] > 1.24 || turn == 0));
    }
  }
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_environment_destroy(environment));
}

/* What was deformed is saved as it is, and goes on. */
static void saved_and_loaded(void) {
  size_t size = 0, again = 0;
  dsw_environment *loaded = NULL;
  double a[3], b[3];
  dsw_build_report built;
  begin(DSW_FEATURE_DEFORMING);
  point(2, 2, 2)[0] += 0.25;
  (void)deform(NULL);
  CHECK_OK(dsw_environment_save(g_env, g_block, sizeof g_block, &size));
  CHECK_OK(dsw_environment_load(NULL, g_block, size, &loaded));
  CHECK_OK(dsw_environment_get_position(g_env, vertex_at(grid_point(&g_grid, 2, 2, 2)), a));
  CHECK_OK(dsw_environment_get_position(loaded, vertex_at(grid_point(&g_grid, 2, 2, 2)), b));
  CHECK(a[0] == 2.25 && memcmp(a, b, sizeof a) == 0);
  built.struct_size = sizeof built;
  CHECK_OK(dsw_environment_check(loaded, &built));
  CHECK_OK(dsw_environment_save(loaded, NULL, 0, &again));
  CHECK(again == size);
  CHECK_OK(dsw_environment_destroy(loaded));
  end();
}

/* A cut in an environment that bends: its vertices are written to the array that was lent, if that has room. */
static void cut_while_bent(void) {
  static const double blade[12] = {1.25, -1, -1, 1.25, 5, -1, 1.25, -1, 5, 1.25, 5, 5};
  static const double other_blade[12] = {2.25, -1, -1, 2.25, 5, -1, 2.25, -1, 5, 2.25, 5, 5};
  static double arrays[2][3 * 2 * POINTS];
  dsw_deform_options o = deform_options_of(DSW_DEFORM_END_STATE, DSW_WALL_PUSH);
  const dsw_cut_vertex *added = NULL;
  size_t i, count = 0, points = POINTS;
  dsw_cut_report report;
  dsw_cut_desc d;
  int turn, valid = 1;
  begin(DSW_FEATURE_DEFORMING);
  dsw_cut_desc_init(&d, sizeof d);
  d.points = blade;
  d.rows = d.columns = 2;
  for (turn = 0; turn < 2; ++turn) memcpy(arrays[turn], g_grid.points, sizeof g_points[0]);

  o.point_room = POINTS - 1;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_deform(g_scene, arrays[0], POINTS, &o, NULL));
  o.point_room = POINTS + 24;
  CHECK_OK(dsw_scene_deform(g_scene, arrays[0], POINTS, &o, NULL));
  for (i = 3 * POINTS; i < 6 * POINTS; ++i) arrays[0][i] = -7;
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_cut(g_env, &d, NULL)); /* needs 25 */
  for (i = 3 * POINTS; i < 6 * POINTS; ++i) CHECK(arrays[0][i] == -7);
  o.point_room = 0;
  CHECK_OK(dsw_scene_deform(g_scene, arrays[1], POINTS, &o, NULL));
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_cut(g_env, &d, NULL));
  o.point_room = POINTS + 25;
  CHECK_OK(dsw_scene_deform(g_scene, arrays[0], POINTS, &o, NULL));
  CHECK_OK(dsw_environment_cut(g_env, &d, &report));
  CHECK(report.volumes_split == 16 && report.vertex_count == 25);
  CHECK_OK(dsw_environment_get_cut_vertices(g_env, &added, &count));
  CHECK(count == 25);
  for (i = 0; i < count; ++i) {
    CHECK(added[i].vertex.index >= POINTS && added[i].vertex.index < POINTS + 25);
    CHECK(arrays[0][3 * added[i].vertex.index] == 1.25);
    memcpy(arrays[1] + 3 * added[i].vertex.index, arrays[0] + 3 * added[i].vertex.index, 3 * sizeof(double));
  }
  CHECK(arrays[0][3 * (POINTS + 25)] == -7);
  points += count;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_deform(g_scene, arrays[1], POINTS, &o, NULL));
  /* The first volume invalid, and the blade's points outside: it is looked for from another volume. */
  memcpy(arrays[1], arrays[0], sizeof arrays[0]);
  arrays[1][0] = arrays[1][1] = arrays[1][2] = 0.9;
  o.point_room = 2 * POINTS;
  CHECK_OK(dsw_scene_deform(g_scene, arrays[1], points, &o, NULL));
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(0), &valid));
  CHECK(!valid);
  d.points = other_blade;
  CHECK_OK(dsw_environment_cut(g_env, &d, &report));
  CHECK(report.volumes_crossed == 16);
  points += report.vertex_count;
  memcpy(arrays[0], arrays[1], sizeof arrays[0]);
  memset(arrays[0], 0, 3 * sizeof(double));
  CHECK_OK(dsw_scene_deform(g_scene, arrays[0], points, &o, NULL));
  memcpy(arrays[1], arrays[0], sizeof arrays[0]);
  for (i = 0; i < points; ++i) arrays[1][3 * i] *= 1.125;
  o.point_room = 0;
  CHECK_OK(dsw_scene_deform(g_scene, arrays[1], points, &o, NULL));
  CHECK_OK(dsw_environment_check(g_env, NULL));
  end();
}

int main(void) {
  a_floor_lifts_a_particle();
  an_edge_is_pushed_split_or_holds_the_wall();
  what_is_squeezed_holds_the_walls();
  steps_are_halved_where_cells_would_fold();
  invalid_volumes();
  end_state();
  a_point_between_two_cubes();
  bad_arguments();
  saved_and_loaded();
  cut_while_bent();
  return check_result();
}
