/* Planar environments that bend: what lies in them stays free, or the walls do not come. */
#include <math.h>
#include <string.h>

#include "bending_squares.h"
#include "check.h"

static void a_floor_lifts_a_particle(void) {
  const double at[2] = {2.3, 2.2};
  dsw_particle_id particle;
  dsw_deform_report report;
  const dsw_wall_contact *c = NULL;
  size_t count = 0;
  double now[3];
  dsw_volume_id volume;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  raise_row(2, 0.5);
  report = deform(NULL);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.fraction == 1 && report.held_count == 0 && report.steps == 1);
  CHECK(report.contact_count >= 1 && report.pushed_count >= 1 && report.near_count == 4);
  CHECK_OK(dsw_particle_get(g_scene, particle, now, &volume));
  CHECK(now[0] == at[0] && now[1] > 2.5 && volume.index == square(2, 2));
  CHECK_OK(dsw_scene_get_wall_contacts(g_scene, &c, &count));
  CHECK(count == report.contact_count && c->particle.index == particle.index && c->particle.generation == 1 &&
        c->body.generation == 0);
  CHECK(c->from[0] == 2 && c->from[1] == 2 && c->to[1] == 2.5 && c->from[2] == 0 && c->to[2] == 0);
  CHECK(c->normal[1] > 0.5 && c->normal[2] == 0 && c->time > 0 && c->time < 1 && c->response == DSW_WALL_PUSH);
  CHECK(c->moving.index == vertex(2, 2) && c->others[0].index == vertex(3, 2) && c->others[1].generation == 0);
  CHECK(c->point[0] == at[0] && c->point[1] == at[1] && c->point[2] == 0 && c->along == 0);
  CHECK(c->wall.volume == square(2, 1) && c->wall.local == SIDE_UP && c->tag == 100 + square(2, 1));
  end();
}

static void an_edge_is_pushed_split_or_holds_the_wall(void) {
  static const double positions[4] = {1.2, 2.11, 2.8, 2.11};
  static const dsw_wall_response responses[4] = {DSW_WALL_PUSH, DSW_WALL_INSERT, DSW_WALL_HOLD, DSW_WALL_STOP};
  int i;
  for (i = 0; i < 4; ++i) {
    const dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, responses[i]);
    const dsw_vertex_id *held = NULL;
    const dsw_wall_contact *c = NULL;
    const dsw_body_edit *edits = NULL;
    dsw_deform_report report;
    dsw_body_counts counts;
    dsw_body_id body;
    double now[6] = {0};
    size_t count = 0;
    begin(DSW_FEATURE_DEFORMING);
    mark_floor(1);
    body = make_line(positions, 2, DSW_LEVEL_EDGES);
    point(2, 2)[1] += 0.4; /* one vertex, below the middle of the edge */
    report = deform(&o);
    CHECK(report.contact_count >= 1);
    CHECK_OK(dsw_scene_get_wall_contacts(g_scene, &c, &count));
    if (responses[i] != DSW_WALL_STOP) {
      CHECK(fabs(c->along - 0.5) < 1e-12 && c->point[0] == 2 && c->point[1] == 2.11);
      CHECK(c->normal[0] == 0 && c->normal[1] == 1 && c->normal[2] == 0);
      CHECK(c->edge.generation == 1 && c->vertex.generation == 0 && c->others[0].generation == 0);
      CHECK(c->wall.generation == 1 && c->tag != 0 && fabs(c->time - 0.275) < 1e-12);
    }
    counts.struct_size = sizeof counts;
    CHECK_OK(dsw_body_get_counts(g_scene, body, &counts));
    CHECK(counts.vertex_count == (responses[i] == DSW_WALL_INSERT ? 3u : 2u));
    CHECK_OK(dsw_body_get_positions(g_scene, body, now, 3, 0, NULL, &count));
    CHECK_OK(dsw_scene_get_held_vertices(g_scene, &held, &count));
    CHECK(count == report.held_count);
    if (responses[i] == DSW_WALL_HOLD) {
      CHECK(report.outcome == DSW_DEFORM_HELD && count == 1 && held[0].index == vertex(2, 2));
      CHECK(point(2, 2)[1] == 2);
    } else if (responses[i] == DSW_WALL_STOP) {
      CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction == 0.25);
      CHECK(point(2, 2)[1] == 2 + 0.25 * (2.4 - 2));
    } else {
      CHECK(report.outcome == DSW_DEFORM_DONE && count == 0 && report.pushed_count >= 1);
      CHECK(point(2, 2)[1] == 2.4);
    }
    CHECK_OK(dsw_body_get_edits(g_scene, body, &edits, &count));
    CHECK(count == (responses[i] == DSW_WALL_INSERT ? 1u : 0u));
    if (count == 1) CHECK(edits[0].inserted == 1 && fabs(edits[0].share - 0.5) < 1e-12 && now[4] == 2 && now[5] > 2.4);
    if (responses[i] == DSW_WALL_PUSH) CHECK(now[1] > 2.4 && now[3] > 2.4);
    end();
  }
}

/* A lone impassable point comes through an edge: it is seen from EDGES_SWEPT on. */
static void a_lone_point_is_met_by_swept_edges(void) {
  static const double positions[4] = {1.2, 2.1, 2.8, 2.1};
  static const dsw_level levels[3] = {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT};
  int i;
  for (i = 0; i < 3; ++i) {
    const int meets = levels[i] == DSW_LEVEL_EDGES_SWEPT;
    const dsw_wall_contact *c = NULL;
    dsw_deform_report report;
    size_t count = 0;
    begin(DSW_FEATURE_DEFORMING);
    CHECK_OK(set_vertex_mark(g_env, vertex(2, 2), DSW_MARK_IMPASSABLE));
    make_line(positions, 2, levels[i]);
    point(2, 2)[1] += 0.4;
    report = deform(NULL);
    CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == (meets ? 1u : 0u));
    CHECK_OK(dsw_scene_get_wall_contacts(g_scene, &c, &count));
    if (meets) CHECK(c->wall.generation == 0 && c->tag == 0 && c->moving.index == vertex(2, 2) && c->normal[1] == 1);
    end();
  }
}

/* A ceiling that comes down on what lies on the floor cannot push it away. */
static void what_is_squeezed_holds_the_walls(void) {
  static const double positions[4] = {1.2, 2.05, 2.7, 2.05};
  dsw_body_id body;
  dsw_deform_report report;
  double now[4];
  size_t count = 0;
  uint32_t x;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  mark_floor(2);
  body = make_line(positions, 2, DSW_LEVEL_EDGES_SWEPT);
  for (x = 0; x <= N; ++x) point(x, 3)[1] = 2.01;
  report = deform(NULL);
  CHECK(report.outcome == DSW_DEFORM_HELD && report.held_count > 0 && report.contact_count > 0);
  CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 0, NULL, &count));
  CHECK(now[1] > 2 && now[3] > 2);
  CHECK(point(4, 3)[1] == 2.01); /* far away nothing is in the way */
  end();
}

/* Bodies that meet each other are not pushed through one another. */
static void a_body_in_the_way_holds_the_wall(void) {
  static const double low[4] = {1.2, 2.1, 2.8, 2.1}, high[4] = {1.9, 2.3, 2.2, 2.3};
  int meets;
  for (meets = 0; meets < 2; ++meets) {
    dsw_deform_report report;
    dsw_body_id body;
    double now[4];
    size_t count = 0;
    begin(DSW_FEATURE_DEFORMING | (meets ? (uint32_t)DSW_FEATURE_BODY_CONTACTS : 0));
    mark_floor(1);
    body = make_line(low, 2, DSW_LEVEL_EDGES);
    make_line(high, 2, DSW_LEVEL_EDGES);
    raise_row(2, 0.3);
    report = deform(NULL);
    CHECK(report.outcome == (meets ? DSW_DEFORM_HELD : DSW_DEFORM_DONE));
    CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 0, NULL, &count));
    CHECK(now[1] >= 2.1 && now[3] >= 2.1);
    if (meets) CHECK(now[1] + (now[3] - now[1]) * (1.9 - now[0]) / (now[2] - now[0]) < 2.3);
    end();
  }
}

static void end_state(void) {
  const double at[2] = {2.3, 2.2}, line[4] = {0.3, 2.3, 1.4, 2.2};
  dsw_deform_options o = deform_options_of(DSW_DEFORM_END_STATE, DSW_WALL_PUSH);
  const dsw_wall_contact *c = NULL;
  dsw_particle_id particle;
  dsw_body_id body;
  dsw_deform_report report;
  double now[4];
  size_t count = 0;
  dsw_volume_id volume;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  body = make_line(line, 2, DSW_LEVEL_EDGES_SWEPT);
  raise_row(2, 0.5);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == 3 && report.pushed_count == 3);
  CHECK_OK(dsw_particle_get(g_scene, particle, now, &volume));
  CHECK(now[1] >= 2.5 && volume.index == square(2, 2));
  CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 0, NULL, &count));
  CHECK(now[1] >= 2.5 && now[3] >= 2.5);
  CHECK_OK(dsw_scene_get_wall_contacts(g_scene, &c, &count));
  CHECK(c->moving.generation == 0 && c->from[0] == 2.5 && c->from[1] == 2.75 && c->to[0] == at[0] && c->to[2] == 0);
  CHECK(c->wall.generation == 1 && c->normal[1] == 1 && c->normal[2] == 0);
  /* Without a wall in the way it changes its polygon instead. */
  o.response = DSW_WALL_STOP;
  raise_row(2, -0.6);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == 0);
  raise_row(2, 0.8);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction < 1 && report.fraction > 0);
  CHECK(point(2, 2)[1] == 1.9 + report.fraction * (2.7 - 1.9));
  o.response = DSW_WALL_HOLD;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_deform(g_scene, g_points[g_next], POINTS, &o, NULL));
  end();
}

/* Two squares that share one point alone: it goes into either, and what lies there is pushed. Round a point of the boundary all polygons are
   found, from whichever. */
static void points_of_the_boundary(void) {
  static const double at[4][2] = {{0.9, 0.9}, {1.1, 1.1}, {1.95, 1.3}, {2.05, 1.3}};
  /* Polygons 0 1 share a point with 2; 2, 3 and 4 meet at a point of the boundary. */
  static const double start[20] = {0, 0, 1, 0, 1, 1, 0, 1, 2, 1, 2, 2, 1, 2, 3, 1, 3, 2, 2.5, 0};
  static const int64_t cells[14] = {0, 1, 2, 3, 2, 4, 5, 6, 4, 8, 5, 4, 7, 8}, offsets[5] = {0, 4, 8, 11, 14};
  static const uint8_t types[4] = {DSW_CELL_TYPE_QUAD, DSW_CELL_TYPE_QUAD, DSW_CELL_TYPE_TRIANGLE,
                                   DSW_CELL_TYPE_TRIANGLE};
  double points[2][20];
  dsw_environment_desc d;
  dsw_environment *environment = NULL;
  dsw_scene *scene;
  dsw_particle_id particles[4];
  int i, turn;
  memcpy(points[0], start, sizeof start);
  memcpy(points[1], start, sizeof start);
  dsw_environment_desc_init(&d, sizeof d);
  d.dimension = 2;
  d.points = points[0];
  d.point_count = 10;
  d.cell_types = types;
  d.offsets = offsets;
  d.connectivity = cells;
  d.connectivity_count = 14;
  d.cell_count = 4;
  CHECK_OK(dsw_environment_create(NULL, &d, &environment, NULL));
  scene = make_scene(environment, DSW_FEATURE_DEFORMING);
  for (i = 0; i < 4; ++i) CHECK_OK(dsw_particle_create(scene, at[i], no_volume, &particles[i]));
  for (turn = 0; turn < 4; ++turn) {
    dsw_deform_report report;
    double *const next = points[turn % 2 == 0 ? 1 : 0];
    next[4] = next[5] = turn % 2 == 0 ? 0.75 : 1.25;
    next[8] = turn % 2 == 0 ? 1.8 : 2.2; /* over the particles at it, which no wall meets, but their polygons change */
    next[9] = 1.05;
    CHECK_OK(dsw_scene_deform(scene, next, 10, NULL, &report));
    CHECK(report.outcome == DSW_DEFORM_DONE && report.held_count == 0);
    for (i = 0; i < 4; ++i) {
      double now[2];
      dsw_volume_id volume, found;
      CHECK_OK(dsw_particle_get(scene, particles[i], now, &volume));
      CHECK_OK(dsw_environment_locate(environment, now, no_volume, &found, NULL));
      CHECK(volume.index == found.index && (i == 0) == (volume.index == 0));
      if (i >= 2) CHECK(now[0] == at[i][0]);
    }
  }
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_environment_destroy(environment));
}

static void bad_arguments(void) {
  const double at[2] = {2.5, 2.5};
  dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
  const dsw_wall_contact *contacts = NULL;
  const double *read = NULL;
  dsw_particle_id particle;
  dsw_scene *other = NULL;
  size_t count = 0;
  int valid = -1;
  begin(0);
  CHECK_FAILS(DSW_STATUS_NOT_NAMED, dsw_scene_deform(g_scene, g_points[0], POINTS, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NOT_NAMED, dsw_scene_get_wall_contacts(g_scene, &contacts, &count));
  end();
  begin(DSW_FEATURE_DEFORMING);
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_scene_create(g_env, NULL, &other));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_deform(g_scene, NULL, POINTS, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_deform(g_scene, g_points[0], POINTS + 1, NULL, NULL));
  o.invalid = DSW_INVALID_REMESH;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_deform(g_scene, g_points[0], POINTS, &o, NULL));
  CHECK_MESSAGE("plane");
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  /* Near the particle it is an error, far away its polygons become invalid. */
  point(2, 2)[1] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_deform(g_scene, g_points[0], POINTS, NULL, NULL));
  CHECK_MESSAGE("next[12]");
  o = deform_options_of(DSW_DEFORM_END_STATE, DSW_WALL_PUSH);
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_deform(g_scene, g_points[0], POINTS, &o, NULL));
  CHECK_OK(dsw_environment_get_points(g_env, &read, &count));
  CHECK(read != g_points[0]);
  point(2, 2)[1] = 2;
  point(0, 0)[0] = INFINITY;
  (void)deform(NULL);
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_scene_deform(g_scene, g_points[1 - g_next], POINTS, NULL, NULL));
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(0), &valid));
  CHECK(valid == 0);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_is_valid(g_env, stale_volume, &valid));
  end();
}

/* What was deformed is saved as it is, and goes on with the same bits. */
static void saved_and_loaded(void) {
  static const double at[2] = {2.3, 2.2};
  static char blocks[4][1 << 14];
  static double arrays[2][2 * POINTS];
  dsw_environment *loaded = NULL;
  dsw_scene *again = NULL;
  dsw_deform_report reports[2];
  static const double line[4] = {1.2, 2.11, 1.9, 2.11};
  dsw_particle_id particle;
  dsw_body_id body;
  double now[2][4];
  size_t sizes[4], count;
  int i;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  body = make_line(line, 2, DSW_LEVEL_EDGES_SWEPT);
  raise_row(2, 0.5);
  (void)deform(NULL);
  CHECK_OK(dsw_environment_save(g_env, blocks[0], sizeof blocks[0], &sizes[0]));
  CHECK_OK(dsw_scene_save(g_scene, blocks[1], sizeof blocks[1], &sizes[1]));
  CHECK_OK(dsw_environment_load(NULL, blocks[0], sizes[0], &loaded));
  CHECK_OK(dsw_scene_load(loaded, blocks[1], sizes[1], &again));
  raise_row(2, 0.3);
  for (i = 0; i < 2; ++i) memcpy(arrays[i], g_points[g_next], sizeof arrays[i]);
  CHECK_OK(dsw_scene_deform(g_scene, arrays[0], POINTS, NULL, &reports[0]));
  CHECK_OK(dsw_scene_deform(again, arrays[1], POINTS, NULL, &reports[1]));
  CHECK(memcmp(&reports[0], &reports[1], sizeof reports[0]) == 0 && reports[0].contact_count > 0);
  CHECK(memcmp(arrays[0], arrays[1], sizeof arrays[0]) == 0);
  CHECK_OK(dsw_particle_get(g_scene, particle, now[0], NULL));
  CHECK_OK(dsw_particle_get(again, particle, now[1], NULL));
  CHECK(memcmp(now[0], now[1], 2 * sizeof(double)) == 0 && now[0][1] > 2.8);
  CHECK_OK(dsw_body_get_positions(g_scene, body, now[0], 2, 0, NULL, &count));
  CHECK_OK(dsw_body_get_positions(again, body, now[1], 2, 0, NULL, &count));
  CHECK(memcmp(now[0], now[1], sizeof now[0]) == 0 && now[0][1] > 2.8);
  CHECK_OK(dsw_scene_save(g_scene, blocks[2], sizeof blocks[2], &sizes[2]));
  CHECK_OK(dsw_scene_save(again, blocks[3], sizeof blocks[3], &sizes[3]));
  CHECK(sizes[2] == sizes[3] && memcmp(blocks[2], blocks[3], sizes[2]) == 0);
  CHECK_OK(dsw_environment_save(g_env, blocks[2], sizeof blocks[2], &sizes[2]));
  CHECK_OK(dsw_environment_save(loaded, blocks[3], sizeof blocks[3], &sizes[3]));
  CHECK(sizes[2] == sizes[3] && memcmp(blocks[2], blocks[3], sizes[2]) == 0);
  CHECK_OK(dsw_scene_destroy(again));
  CHECK_OK(dsw_environment_destroy(loaded));
  end();
}

/* A cut in an environment that bends: its vertices are written to the array that was lent, if that has room. */
static void cut_while_bent(void) {
  static const double blade[4] = {1.25, -1, 1.25, 5}, at[2] = {1.5, 2.5};
  static double arrays[2][4 * POINTS];
  dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
  const dsw_cut_vertex *added = NULL;
  dsw_cut_report report;
  dsw_deform_report bent;
  dsw_cut_desc d;
  dsw_particle_id particle;
  size_t i, count = 0;
  double now[2];
  begin(DSW_FEATURE_DEFORMING);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  dsw_cut_desc_init(&d, sizeof d);
  d.points = blade;
  d.rows = 2;
  d.columns = 1;
  d.start = volume_at(0);
  d.flags = DSW_CUT_UNSEW;
  for (i = 0; i < 2; ++i) memcpy(arrays[i], g_points[0], sizeof g_points[0]);
  o.point_room = POINTS + 4;
  CHECK_OK(dsw_scene_deform(g_scene, arrays[0], POINTS, &o, NULL));
  for (i = 2 * POINTS; i < 4 * POINTS; ++i) arrays[0][i] = -7;
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_cut(g_env, &d, NULL)); /* needs 5 */
  for (i = 2 * POINTS; i < 4 * POINTS; ++i) CHECK(arrays[0][i] == -7);
  o.point_room = POINTS + 5;
  CHECK_OK(dsw_scene_deform(g_scene, arrays[1], POINTS, &o, NULL));
  for (i = 2 * POINTS; i < 4 * POINTS; ++i) arrays[1][i] = -7;
  CHECK_OK(dsw_environment_cut(g_env, &d, &report));
  CHECK(report.volumes_split == 4);
  CHECK_OK(dsw_environment_get_cut_vertices(g_env, &added, &count));
  for (i = 0; i < count; ++i) CHECK(arrays[1][2 * added[i].vertex.index] == 1.25);
  CHECK(arrays[1][2 * (POINTS + 5)] == -7);
  /* Both sides of the crack are walls: that on the left pushes what lies there. */
  memcpy(arrays[0], arrays[1], sizeof arrays[0]);
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_deform(g_scene, arrays[0], POINTS, &o, NULL));
  for (i = 0; i < (size_t)POINTS + 5; ++i) arrays[0][2 * i] *= 1.25;
  CHECK_OK(dsw_scene_deform(g_scene, arrays[0], POINTS + 5, &o, &bent));
  CHECK(bent.outcome == DSW_DEFORM_DONE && bent.contact_count > 0);
  CHECK_OK(dsw_particle_get(g_scene, particle, now, NULL));
  CHECK(now[0] > 1.5625 && now[1] == at[1]);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  end();
}

/* With the n-th allocation refused: nothing has changed, then it goes through. */
static void refused_memory_changes_nothing(void) {
  static const double at[2] = {2.3, 2.2}, line[4] = {1.2, 2.11, 2.8, 2.11};
  static const dsw_wall_response responses[2] = {DSW_WALL_INSERT, DSW_WALL_PUSH};
  int i;
  for (i = 0; i < 2; ++i) {
    dsw_deform_options o = deform_options_of(i == 0 ? DSW_DEFORM_SWEPT : DSW_DEFORM_END_STATE, responses[i]);
    dsw_status status = DSW_STATUS_OUT_OF_MEMORY;
    size_t n;
    for (n = 1; n < 300 && status != DSW_STATUS_OK; ++n) {
      static double arrays[2][2 * POINTS];
      host h = {0};
      dsw_context *const context = make_context(&h);
      const dsw_body_desc d = line_desc(line, 2, 0, DSW_LEVEL_EDGES_SWEPT);
      const double *read = NULL;
      dsw_particle_id particle;
      dsw_body_id body;
      double now[4], of_body[6];
      size_t count = 0;
      uint32_t x;
      g_env = make_squares(context, N, N);
      g_scene = make_scene(g_env, DSW_FEATURE_DEFORMING);
      mark_floor(1);
      CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
      CHECK_OK(dsw_body_create(g_scene, &d, &body));
      CHECK_OK(dsw_environment_get_points(g_env, &read, &count));
      memcpy(arrays[0], read, sizeof arrays[0]);
      for (x = 0; x <= N; ++x) arrays[0][2 * vertex(x, 2) + 1] += 0.4;
      memcpy(arrays[1], arrays[0], sizeof arrays[1]);
      h.calls = 0;
      h.refuse = n;
      status = dsw_scene_deform(g_scene, arrays[0], POINTS, &o, NULL);
      h.refuse = 0;
      CHECK(status == DSW_STATUS_OK || status == DSW_STATUS_OUT_OF_MEMORY);
      CHECK(memcmp(arrays[0], arrays[1], sizeof arrays[0]) == 0);
      CHECK_OK(dsw_particle_get(g_scene, particle, now, NULL));
      CHECK_OK(dsw_body_get_positions(g_scene, body, of_body, 3, 0, NULL, &count));
      if (status == DSW_STATUS_OK) {
        CHECK(now[1] > 2.4 && of_body[1] > 2.4);
      } else {
        CHECK(memcmp(now, at, sizeof at) == 0 && count == 2 && memcmp(of_body, line, sizeof line) == 0);
        CHECK_OK(dsw_environment_get_points(g_env, &read, &count));
        CHECK(read != arrays[0] && read[2 * vertex(1, 2) + 1] == 2);
      }
      CHECK_OK(dsw_scene_destroy(g_scene));
      CHECK_OK(dsw_environment_destroy(g_env));
      CHECK_OK(dsw_context_destroy(context));
      CHECK(h.alive == 0 && h.broken == 0);
    }
    CHECK(status == DSW_STATUS_OK && n > 5);
  }
}

int main(void) {
  a_floor_lifts_a_particle();
  an_edge_is_pushed_split_or_holds_the_wall();
  a_lone_point_is_met_by_swept_edges();
  what_is_squeezed_holds_the_walls();
  a_body_in_the_way_holds_the_wall();
  end_state();
  points_of_the_boundary();
  bad_arguments();
  saved_and_loaded();
  cut_while_bent();
  refused_memory_changes_nothing();
  return check_result();
}
