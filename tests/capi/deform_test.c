/* Environments that bend: what lies in them stays free, or the walls do not come; in space and in the plane. */
#include <math.h>
#include <string.h>

#include "bending.h"
#include "check.h"

static int is_valid(uint32_t volume) {
  int valid = -1;
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(volume), &valid));
  return valid;
}

/* Both points of an edge. */
static void heights_of(dsw_body_id body, double *heights) {
  double now[9] = {0};
  size_t count = 0;
  CHECK_OK(dsw_body_get_positions(g_scene, body, now, 3, 0, NULL, &count));
  heights[0] = now[g_up];
  heights[1] = now[g_dimension + g_up];
}

static void a_floor_lifts_a_particle(void) {
  double at[3] = {2.3, 1.4, 2.2}, now[3];
  dsw_particle_id particle;
  dsw_deform_report report;
  const dsw_wall_contact *c = NULL;
  size_t count = 0;
  dsw_volume_id volume;
  flat(at, 1);
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  raise_row(2, 0.5);
  report = deform(NULL);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.fraction == 1 && report.held_count == 0 && report.steps == 1);
  CHECK(report.contact_count >= 1 && report.pushed_count >= 1);
  CHECK(g_dimension == 3 ? report.near_count >= 8 : report.near_count == 4);
  CHECK_OK(dsw_particle_get_position(g_scene, particle, now, &volume));
  CHECK(fabs(now[0] - at[0]) < 1e-9 && fabs(now[g_up - 1] - at[g_up - 1]) < 1e-9);
  CHECK(now[g_up] > 2.5 && now[g_up] < 2.5 + 1e-9 && volume.index == cell(2, 1, 2));
  CHECK_OK(dsw_environment_get_wall_contacts(g_env, &c, &count));
  CHECK(count == report.contact_count && c->particle.index == particle.index);
  CHECK(c->particle.generation == particle.generation && c->body.generation == 0);
  CHECK(c->contact.normal[g_up] > 0.5 && c->time > 0 && c->time < 1 && c->response == DSW_WALL_PUSH);
  CHECK(c->contact.wall.generation == 1 && c->moving.generation == 1 && c->contact.tag == 100 + cell(2, 1, 1));
  CHECK(c->point[g_up] == at[g_up]);
  if (g_dimension == 2) {
    CHECK(c->from[0] == 2 && c->from[1] == 2 && c->to[1] == 2.5 && c->from[2] == 0 && c->to[2] == 0);
    CHECK(c->moving.index == vertex(2, 0, 2) && c->others[0].index == vertex(3, 0, 2) && c->others[1].generation == 0);
    CHECK(c->point[0] == at[0] && c->point[2] == 0 && c->edge_parameter == 0 && c->contact.normal[2] == 0);
    CHECK(c->contact.wall.volume == cell(2, 0, 1) && c->contact.wall.local == SIDE_UP);
  }
  end();
}

static void an_edge_is_pushed_split_or_holds_the_wall(void) {
  static const double in_space[6] = {1.2, 2.1, 2.1, 2.7, 1.9, 2.1}, in_plane[4] = {1.2, 2.11, 2.8, 2.11};
  static const dsw_wall_response responses[4] = {DSW_WALL_PUSH, DSW_WALL_INSERT, DSW_WALL_HOLD, DSW_WALL_STOP};
  int i;
  for (i = 0; i < 4; ++i) {
    const dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, responses[i]);
    const int plane = g_dimension == 2;
    const dsw_vertex_id *held = NULL;
    const dsw_wall_contact *c = NULL;
    const dsw_body_edit *edits = NULL;
    dsw_deform_report report;
    dsw_body_id body;
    double now[9] = {0};
    size_t count = 0;
    begin(DSW_FEATURE_DEFORMING);
    mark_floor(1);
    body = make_line(plane ? in_plane : in_space, 2, plane ? DSW_LEVEL_EDGES : DSW_LEVEL_EDGES_SWEPT);
    point(2, 2, 2)[g_up] += 0.4; /* one vertex, below the middle of the edge */
    report = deform(&o);
    CHECK(report.contact_count >= 1);
    CHECK_OK(dsw_environment_get_wall_contacts(g_env, &c, &count));
    if (plane && responses[i] != DSW_WALL_STOP) {
      CHECK(fabs(c->edge_parameter - 0.5) < 1e-12 && c->point[0] == 2 && c->point[1] == 2.11);
      CHECK(c->contact.normal[0] == 0 && c->contact.normal[1] == 1 && c->contact.normal[2] == 0);
      CHECK(c->edge.generation == 1 && c->vertex.generation == 0 && c->others[0].generation == 0);
      CHECK(c->contact.wall.generation == 1 && c->contact.tag != 0 && fabs(c->time - 0.275) < 1e-12);
    }
    CHECK(body_counts(g_scene, body).vertex_count == (responses[i] == DSW_WALL_INSERT ? 3u : 2u));
    CHECK_OK(dsw_body_get_positions(g_scene, body, now, 3, 0, NULL, &count));
    CHECK_OK(dsw_environment_get_held_vertices(g_env, &held, &count));
    CHECK(count == report.held_count);
    if (responses[i] == DSW_WALL_HOLD) {
      CHECK(report.outcome == DSW_DEFORM_HELD && count == 1 && held[0].index == vertex(2, 2, 2));
      CHECK(point(2, 2, 2)[g_up] == 2);
    } else if (responses[i] == DSW_WALL_STOP) {
      CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction == 0.25);
      CHECK(point(2, 2, 2)[g_up] == 2 + 0.25 * (2.4 - 2));
    } else {
      CHECK(report.outcome == DSW_DEFORM_DONE && count == 0 && report.pushed_count >= 1);
      CHECK(point(2, 2, 2)[g_up] == 2.4);
    }
    CHECK_OK(dsw_body_get_edits(g_scene, body, &edits, &count));
    CHECK(count == (responses[i] == DSW_WALL_INSERT ? 1u : 0u));
    if (count == 1) CHECK(edits[0].inserted == 1 && now[2 * g_dimension + g_up] > (plane ? 2.4 : 2.3998));
    if (count == 1 && plane) CHECK(fabs(edits[0].edge_parameter - 0.5) < 1e-12 && now[4] == 2);
    if (plane && responses[i] == DSW_WALL_PUSH) CHECK(now[1] > 2.4 && now[3] > 2.4);
    end();
  }
}

/* A ceiling that comes down on what lies on the floor cannot push it away: it leaves less room than a push wants. */
static void what_is_squeezed_holds_the_walls(void) {
  double positions[6] = {1.2, 2.1, 2.05, 2.7, 1.9, 2.05}, now[2];
  dsw_body_id body;
  dsw_deform_report report;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  mark_floor(2);
  body = make_line(flat(positions, 2), 2, g_dimension == 3 ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT);
  set_row(3, 2 + 1e-14);
  report = deform(NULL);
  CHECK(report.outcome == DSW_DEFORM_HELD && report.held_count > 0 && report.contact_count > 0);
  heights_of(body, now);
  CHECK(now[0] > 2 && now[1] > 2);
  CHECK(point(g_dimension == 3 ? 0 : 4, 0, 3)[g_up] == 2 + 1e-14); /* far away nothing is in the way */
  end();
}

static void steps_are_halved_where_cells_would_fold(void) {
  double at[3] = {2.5, 2.5, 2.5};
  dsw_particle_id particle;
  dsw_deform_report report;
  dsw_volume_id volume;
  size_t i;
  begin(DSW_FEATURE_DEFORMING);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  for (i = 0; i < g_point_count; ++i) next_points()[g_dimension * i] += 1.5; /* further than a cell is wide */
  report = deform(NULL);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.steps > 1 && report.contact_count == 0);
  CHECK_OK(dsw_particle_get_position(g_scene, particle, NULL, &volume));
  CHECK(volume.index == cell(1, 2, 2));
  end();
}

static void invalid_volumes(void) {
  double at[3] = {2.5, 2.5, 2.5}, to[3] = {2.5, 2.5, 0.5}, before[3 * MOST_POINTS];
  const dsw_volume_id start = volume_at(cell(2, 2, 2));
  const size_t bytes = g_dimension * (size_t)vertex(0, 0, N + 1) * sizeof(double);
  dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
  const dsw_volume_id *invalid = NULL;
  dsw_particle_id particle;
  dsw_deform_report report;
  dsw_build_report built;
  dsw_flight flight;
  size_t count = 0;
  int impassable = 0;
  begin(DSW_FEATURE_DEFORMING);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  /* Far from the particle: it goes through. */
  point(2, 2, 1)[g_up] = 2.6;
  o.invalid = DSW_INVALID_REFUSE;
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.invalid_count == 0);
  CHECK(is_valid(cell(2, 2, 2)) == 1 && is_valid(cell(2, 2, 1)) == 0);
  built.struct_size = sizeof built;
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_check(g_env, &built));
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_check(g_env, NULL));
  /* It counts as impassable, for casts from outside and as a question. */
  CHECK_OK(dsw_environment_cast_segments(g_env, 1, &start, at, flat(to, 1), 0, NULL, &flight));
  CHECK(flight.outcome == DSW_OUTCOME_CONTACT && flight.contact.behind.index == cell(2, 2, 1));
  CHECK(flight.contact.marked_kind == DSW_CELL_VOLUME && flight.position[g_up] >= 2);
  CHECK_OK(dsw_environment_is_impassable(g_env, cell_at(DSW_CELL_VOLUME, cell(2, 2, 1), 0), &impassable));
  CHECK(impassable == 1);
  CHECK_OK(dsw_environment_save(g_env, NULL, 0, &count));
  point(2, 2, 1)[g_up] = 1;
  report = deform(&o);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  /* Through the particle's own cell: refused, or held. */
  point(2, 2, 2)[g_up] = 3.5;
  memcpy(before, next_points(), bytes);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_REFUSED && report.fraction == 0 && report.invalid_count >= 1);
  CHECK(memcmp(before, next_points(), bytes) == 0);
  CHECK_OK(dsw_environment_get_invalid_volumes(g_env, &invalid, &count));
  CHECK(count == report.invalid_count && invalid[0].generation == 1);
  o.invalid = DSW_INVALID_HOLD;
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_HELD && report.held_count == 1 && point(2, 2, 2)[g_up] < 3.5);
  CHECK(is_valid(cell(2, 2, 2)) == 1);
  end();
}

/* In the plane with a body, too. */
static void end_state(void) {
  static const double line[4] = {0.3, 2.3, 1.4, 2.2};
  const int plane = g_dimension == 2;
  double at[3] = {2.3, 1.4, 2.2}, now[3];
  dsw_particle_id particle;
  dsw_body_id body = {0, 0};
  dsw_deform_report report;
  dsw_deform_options o = deform_options_of(DSW_DEFORM_END_STATE, DSW_WALL_PUSH);
  dsw_volume_id volume;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(1);
  CHECK_OK(dsw_particle_create(g_scene, flat(at, 1), no_volume, &particle));
  if (plane) body = make_line(line, 2, DSW_LEVEL_EDGES_SWEPT);
  raise_row(2, 0.5);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == (plane ? 3 : 1));
  CHECK(report.pushed_count == report.contact_count);
  CHECK_OK(dsw_particle_get_position(g_scene, particle, now, &volume));
  CHECK(now[g_up] >= 2.5 && volume.index == cell(2, 1, 2));
  if (plane) {
    const dsw_wall_contact *c = NULL;
    size_t count = 0;
    heights_of(body, now);
    CHECK(now[0] >= 2.5 && now[1] >= 2.5);
    CHECK_OK(dsw_environment_get_wall_contacts(g_env, &c, &count));
    CHECK(c->moving.generation == 0 && c->from[0] == 2.5 && c->from[1] == 2.75 && c->to[0] == at[0] && c->to[2] == 0);
    CHECK(c->contact.wall.generation == 1 && c->contact.normal[1] == 1 && c->contact.normal[2] == 0);
  }
  /* Without a wall in the way it changes its volume instead. */
  o.response = DSW_WALL_STOP;
  raise_row(2, -0.6);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == 0);
  raise_row(2, 0.8);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction < 1 && report.fraction > 0);
  CHECK(point(2, 2, 2)[g_up] == 1.9 + report.fraction * (2.7 - 1.9));
  o.response = DSW_WALL_HOLD;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_deform(g_env, next_points(), g_point_count, &o, NULL));
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
  int valid = -1;
#define DEFORM(scene, points, more, o) \
  dsw_environment_deform(dsw_scene_get_environment(scene), points, g_point_count + (more), o, NULL)
  begin(0);
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, DEFORM(g_scene, next_points(), 0, NULL));
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, dsw_environment_get_wall_contacts(g_env, &contacts, &count));
  dsw_scene_desc_init(&d, sizeof d);
  d.features = DSW_FEATURE_DEFORMING;
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_scene_create(g_env, &d, &other));
  end();
  begin(DSW_FEATURE_DEFORMING);
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_scene_create(g_env, NULL, &other));
  CHECK(other == NULL);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, DEFORM(NULL, next_points(), 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, DEFORM(g_scene, NULL, 0, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, DEFORM(g_scene, next_points(), (size_t)-1, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, DEFORM(g_scene, next_points(), 1, NULL));
  o.most_halvings = 11;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, DEFORM(g_scene, next_points(), 0, &o));
  o.most_halvings = 0;
  o.min_part = 0.6;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, DEFORM(g_scene, next_points(), 0, &o));
  o.min_part = 0;
  o.flags = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, DEFORM(g_scene, next_points(), 0, &o));
  o.flags = 0;
  o.struct_size = 3;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, DEFORM(g_scene, next_points(), 0, &o));
  if (g_dimension == 2) {
    o = deform_options_of(DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
    o.invalid = DSW_INVALID_REMESH;
    CHECK_FAILS(DSW_STATUS_UNSUPPORTED, DEFORM(g_scene, next_points(), 0, &o));
    CHECK_MESSAGE("plane");
  }
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  /* Near the particle it is an error, far away its volumes become invalid. */
  point(2, 2, 2)[1] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, DEFORM(g_scene, next_points(), 0, NULL));
  CHECK_MESSAGE(g_dimension == 2 ? "next[12]" : "next[");
  o = deform_options_of(DSW_DEFORM_END_STATE, DSW_WALL_PUSH);
  CHECK_FAILS(DSW_STATUS_NON_FINITE, DEFORM(g_scene, next_points(), 0, &o));
  CHECK_OK(dsw_environment_get_points(g_env, &read, &count));
  CHECK(read != next_points());
  point(2, 2, 2)[1] = 2;
  point(0, 0, 0)[0] = INFINITY;
  (void)deform(NULL);
  g_next = 1 - g_next; /* the array that is read */
  CHECK_FAILS(DSW_STATUS_IN_USE, DEFORM(g_scene, next_points(), 0, NULL));
#undef DEFORM
  CHECK(is_valid(0) == 0);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_is_valid(g_env, stale_volume, &valid));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_is_valid(g_env, volume_at(0), NULL));
  end();
}

/* What was deformed is saved as it is, and goes on with the same bits. */
static void saved_and_loaded(void) {
  static char blocks[4][1 << 16];
  static double arrays[2][3 * MOST_POINTS];
  dsw_environment *loaded = NULL;
  dsw_scene *again = NULL;
  dsw_deform_report reports[2];
  double at[3] = {2.3, 1.4, 2.2}, line[6] = {1.2, 1.4, 2.11, 1.9, 1.4, 2.11}, now[2][6];
  dsw_particle_id particle;
  dsw_build_report built;
  dsw_body_id body;
  size_t sizes[4], count, bytes;
  int i;
  begin(DSW_FEATURE_DEFORMING);
  bytes = g_dimension * g_point_count * sizeof(double);
  mark_floor(1);
  CHECK_OK(dsw_particle_create(g_scene, flat(at, 1), no_volume, &particle));
  body = make_line(flat(line, 2), 2, DSW_LEVEL_EDGES_SWEPT);
  raise_row(2, 0.5);
  point(2, 2, 1)[0] += 0.25;
  (void)deform(NULL);
  CHECK_OK(dsw_environment_save(g_env, blocks[0], sizeof blocks[0], &sizes[0]));
  CHECK_OK(dsw_scene_save(g_scene, blocks[1], sizeof blocks[1], &sizes[1]));
  CHECK_OK(dsw_environment_load(NULL, blocks[0], sizes[0], &loaded));
  CHECK_OK(dsw_environment_get_vertex_position(g_env, vertex_at(vertex(2, 2, 1)), now[0]));
  CHECK_OK(dsw_environment_get_vertex_position(loaded, vertex_at(vertex(2, 2, 1)), now[1]));
  CHECK(now[0][0] == 2.25 && memcmp(now[0], now[1], g_dimension * sizeof(double)) == 0);
  built.struct_size = sizeof built;
  CHECK_OK(dsw_environment_check(loaded, &built));
  CHECK_OK(dsw_environment_save(loaded, NULL, 0, &count));
  CHECK(count == sizes[0]);
  CHECK_OK(dsw_scene_load(loaded, blocks[1], sizes[1], &again));
  raise_row(2, 0.3);
  for (i = 0; i < 2; ++i) memcpy(arrays[i], next_points(), bytes);
  CHECK_OK(dsw_environment_deform(g_env, arrays[0], g_point_count, NULL, &reports[0]));
  CHECK_OK(dsw_environment_deform(loaded, arrays[1], g_point_count, NULL, &reports[1]));
  CHECK(memcmp(&reports[0], &reports[1], sizeof reports[0]) == 0 && reports[0].contact_count > 0);
  CHECK(memcmp(arrays[0], arrays[1], bytes) == 0);
  CHECK_OK(dsw_particle_get_position(g_scene, particle, now[0], NULL));
  CHECK_OK(dsw_particle_get_position(again, particle, now[1], NULL));
  CHECK(memcmp(now[0], now[1], g_dimension * sizeof(double)) == 0 && now[0][g_up] > 2.8);
  CHECK_OK(dsw_body_get_positions(g_scene, body, now[0], 2, 0, NULL, &count));
  CHECK_OK(dsw_body_get_positions(again, body, now[1], 2, 0, NULL, &count));
  CHECK(memcmp(now[0], now[1], 2 * g_dimension * sizeof(double)) == 0 && now[0][g_up] > 2.8);
  CHECK_OK(dsw_scene_save(g_scene, blocks[2], sizeof blocks[2], &sizes[2]));
  CHECK_OK(dsw_scene_save(again, blocks[3], sizeof blocks[3], &sizes[3]));
  CHECK(sizes[2] == sizes[3] && memcmp(blocks[2], blocks[3], sizes[2]) == 0);
  CHECK_OK(dsw_environment_save(g_env, blocks[2], sizeof blocks[2], &sizes[2]));
  CHECK_OK(dsw_environment_save(loaded, blocks[3], sizeof blocks[3], &sizes[3]));
  CHECK(sizes[2] == sizes[3] && memcmp(blocks[2], blocks[3], sizes[2]) == 0);
  end_scene(again);
  end();
}

/* In space: two cubes that share one point alone: it goes into either, and what lies there is pushed. */
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
  d.volume_count = 2;
  CHECK_OK(dsw_environment_create(NULL, &d, &environment, NULL));
  scene = make_scene(environment, DSW_FEATURE_DEFORMING);
  for (i = 0; i < 2; ++i) CHECK_OK(dsw_particle_create(scene, at[i], no_volume, &particles[i]));
  for (turn = 0; turn < 4; ++turn) {
    dsw_deform_report report;
    double *const next = points[turn % 2 == 0 ? 1 : 0];
    for (k = 0; k < 3; ++k) next[3 * 7 + k] = turn % 2 == 0 ? 0.75 : 1.25;
    CHECK_OK(dsw_environment_deform(dsw_scene_get_environment(scene), next, 15, NULL, &report));
    CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == (turn < 2 ? 1u : 0u));
    for (i = 0; i < 2; ++i) {
      double now[3];
      dsw_volume_id volume;
      CHECK_OK(dsw_particle_get_position(scene, particles[i], now, &volume));
      CHECK(volume.index == (uint32_t)i && (i == 0 ? now[0] < 0.76 : now[0] > 1.24 || turn == 0));
    }
  }
  end_scene(scene);
}

/* The first volume invalid, and the blade's points outside: it is looked for from another volume. */
static void cut_where_the_first_volume_is_invalid(dsw_cut_desc d, dsw_deform_options o,
                                                  double (*arrays)[3 * 2 * MOST_POINTS], size_t points) {
  static const double blade[12] = {2.25, -1, -1, 2.25, 5, -1, 2.25, -1, 5, 2.25, 5, 5};
  dsw_change report = empty_change();
  size_t i;
  int valid = 1;
  arrays[1][0] = arrays[1][1] = arrays[1][2] = 0.9;
  o.point_room = 2 * MOST_POINTS;
  CHECK_OK(dsw_environment_deform(g_env, arrays[1], points, &o, NULL));
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(0), &valid));
  CHECK(!valid);
  d.points = blade;
  CHECK_OK(dsw_environment_cut(g_env, &d, &report));
  CHECK(report.volumes_crossed == 16);
  points += report.vertex_count;
  memcpy(arrays[0], arrays[1], sizeof arrays[0]);
  memset(arrays[0], 0, 3 * sizeof(double));
  CHECK_OK(dsw_environment_deform(g_env, arrays[0], points, &o, NULL));
  memcpy(arrays[1], arrays[0], sizeof arrays[0]);
  for (i = 0; i < points; ++i) arrays[1][3 * i] *= 1.125;
  o.point_room = 0;
  CHECK_OK(dsw_environment_deform(g_env, arrays[1], points, &o, NULL));
}

/* A cut in an environment that bends: its vertices are written to the array that was lent, if that has room. */
static void cut_while_bent(void) {
  static const double in_space[12] = {1.25, -1, -1, 1.25, 5, -1, 1.25, -1, 5, 1.25, 5, 5};
  static const double in_plane[4] = {1.25, -1, 1.25, 5}, at[2] = {1.5, 2.5};
  static double arrays[2][3 * 2 * MOST_POINTS];
  const int space = g_dimension == 3;
  const size_t by = g_dimension, new_points = space ? 25 : 5;
  dsw_deform_options o = deform_options_of(space ? DSW_DEFORM_END_STATE : DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
  const dsw_vertex_origin *added = NULL;
  size_t i, count = 0, points;
  dsw_change report = empty_change();
  dsw_cut_desc d;
  dsw_particle_id particle;
  begin(DSW_FEATURE_DEFORMING);
  points = g_point_count;
  if (!space) CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  dsw_cut_desc_init(&d, sizeof d);
  d.points = space ? in_space : in_plane;
  d.rows = 2;
  d.columns = space ? 2 : 1;
  if (!space) d.start = volume_at(0), d.flags = DSW_CUT_UNSEW;
  for (i = 0; i < 2; ++i) memcpy(arrays[i], g_points[0], by * points * sizeof(double));

  o.point_room = points - 1;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_deform(g_env, arrays[0], points, &o, NULL));
  o.point_room = points + new_points - 1;
  CHECK_OK(dsw_environment_deform(g_env, arrays[0], points, &o, NULL));
  for (i = by * points; i < 2 * by * points; ++i) arrays[0][i] = -7;
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_cut(g_env, &d, NULL)); /* needs one more */
  for (i = by * points; i < 2 * by * points; ++i) CHECK(arrays[0][i] == -7);
  o.point_room = 0;
  CHECK_OK(dsw_environment_deform(g_env, arrays[1], points, &o, NULL));
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_cut(g_env, &d, NULL));
  o.point_room = points + new_points;
  CHECK_OK(dsw_environment_deform(g_env, arrays[0], points, &o, NULL));
  CHECK_OK(dsw_environment_cut(g_env, &d, &report));
  CHECK(report.volumes_split == (space ? 16 : 4) && report.vertex_count == new_points);
  added = change_of(g_env).vertices;
  count = change_of(g_env).vertex_count;
  CHECK(count == new_points);
  for (i = 0; i < count; ++i) {
    CHECK(added[i].vertex.index >= points && added[i].vertex.index < points + new_points);
    CHECK(arrays[0][by * added[i].vertex.index] == 1.25);
  }
  CHECK(arrays[0][by * (points + new_points)] == -7);
  memcpy(arrays[1], arrays[0], sizeof arrays[0]);
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_deform(g_env, arrays[1], points, &o, NULL));
  points += count;
  if (space) {
    cut_where_the_first_volume_is_invalid(d, o, arrays, points);
  } else { /* both sides of the crack are walls: that on the left pushes what lies there */
    dsw_deform_report bent;
    double now[2];
    for (i = 0; i < points; ++i) arrays[1][2 * i] *= 1.25;
    CHECK_OK(dsw_environment_deform(g_env, arrays[1], points, &o, &bent));
    CHECK(bent.outcome == DSW_DEFORM_DONE && bent.contact_count > 0);
    CHECK_OK(dsw_particle_get_position(g_scene, particle, now, NULL));
    CHECK(now[0] > 1.5625 && now[1] == at[1]);
  }
  CHECK_OK(dsw_environment_check(g_env, NULL));
  end();
}

static void in_both(void) {
  a_floor_lifts_a_particle();
  an_edge_is_pushed_split_or_holds_the_wall();
  what_is_squeezed_holds_the_walls();
  steps_are_halved_where_cells_would_fold();
  invalid_volumes();
  end_state();
  bad_arguments();
  saved_and_loaded();
  cut_while_bent();
}

int main(void) {
  use_dimension(2);
  in_both();
  use_dimension(3);
  in_both();
  a_point_between_two_cubes();
  return check_result();
}
