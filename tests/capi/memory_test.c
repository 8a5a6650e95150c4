/* Memory that runs out, at every single point: a host refuses the first allocation of a call, then the second, and so
   on until the call succeeds. Whatever was refused, nothing has changed and nothing is lost. In space, and what says so
   in the plane, too. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* Repeats `call` with a refusal one allocation later each time, until it succeeds; `unchanged` must hold after each
   failure. Counts the failures into `refusals`. */
#define UNTIL_IT_SUCCEEDS(call, unchanged, refusals)                \
  do {                                                              \
    dsw_status status_;                                             \
    (refusals) = 0;                                                 \
    for (;;) {                                                      \
      const size_t alive_ = g_host.alive;                           \
      g_host.refuse = g_host.calls + (refusals) + 1;                \
      status_ = (call);                                             \
      if (status_ == DSW_STATUS_OK || (refusals) > 1000) break;     \
      CHECK(status_ == DSW_STATUS_OUT_OF_MEMORY && !g_host.broken); \
      CHECK_MESSAGE("allocator returned null");                     \
      CHECK(g_host.alive <= alive_ + MAY_KEEP);                     \
      CHECK(unchanged);                                             \
      ++(refusals);                                                 \
    }                                                               \
    g_host.refuse = 0;                                              \
    CHECK(status_ == DSW_STATUS_OK);                                \
  } while (0)

static host g_host;
static dsw_context *g_context;
static dsw_environment *g_env;
static dsw_scene *g_scene;

/* Cubes, or squares where nz is 0, and a scene of theirs, in memory of the host. The tree of cells is there: it would
   be made by one of many calls that locate a point, and stay. */
static void begin(unsigned nx, unsigned ny, unsigned nz, uint32_t features) {
  const double point[3] = {0.5, 0.5, 0.5};
  dsw_volume_id volume;
  int i;
  g_context = make_context(&g_host);
  g_env = nz == 0 ? make_squares(g_context, nx, ny) : make_environment(g_context, nx, ny, nz);
  for (i = 0; i < 20; ++i) CHECK_OK(dsw_environment_locate(g_env, point, no_volume, &volume, NULL));
  g_scene = make_scene(g_env, features);
}

static void end(void) {
  end_scene(g_scene);
  end_context(g_context, &g_host);
}

/* Room that a failed call made and keeps for the next one, in blocks. */
enum { MAY_KEEP = 2 };

static void creating_an_environment(int plane) {
  dsw_context *const context = make_context(&g_host);
  grid g = grid_create(3, 3, plane ? 1 : 3);
  dsw_environment_desc d = plane ? squares_desc(&g) : grid_desc(&g);
  dsw_environment *environment = NULL;
  dsw_build_report report;
  size_t refusals;
  d.flags = DSW_ENVIRONMENT_LOCATE_TREE | DSW_ENVIRONMENT_CHECK_BOUNDARY;
  report.struct_size = sizeof report;
  report.status = DSW_STATUS_OK;
  UNTIL_IT_SUCCEEDS(dsw_environment_create(context, &d, &environment, &report),
                    environment == NULL && g_host.alive == 1 && report.status == DSW_STATUS_OUT_OF_MEMORY, refusals);
  CHECK(refusals >= 3 && report.status == DSW_STATUS_OK);
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK(g_host.alive == 1);
  end_context(context, &g_host);
  grid_destroy(&g);
}

/* A cube with points of its own beside four smaller ones, the first of which is an arrow head that has to be split. */
static void creating_what_is_sewn_and_split(void) {
  dsw_context *const context = make_context(&g_host);
  double points[8 + 18][3];
  int64_t cells[5 * 8];
  dsw_environment_desc d;
  dsw_environment *environment = NULL;
  dsw_build_report report;
  size_t refusals;
  unsigned i, k;
  for (i = 0; i < 8; ++i) {
    points[i][0] = i % 4 == 1 || i % 4 == 2, points[i][1] = i % 4 >= 2, points[i][2] = i >= 4;
    cells[i] = i;
  }
  for (i = 0; i < 18; ++i) {
    double *const p = points[8 + i];
    p[0] = 1 + i % 2, p[1] = i / 2 % 3 * 0.5, p[2] = i / 6 * 0.5;
    if (i / 2 == 4) p[1] = p[2] = 0.0625;
  }
  for (i = 0; i < 4; ++i) {
    static const unsigned corners[8] = {0, 1, 3, 2, 6, 7, 9, 8};
    for (k = 0; k < 8; ++k) cells[8 + 8 * i + k] = 8 + i % 2 * 2 + i / 2 * 6 + corners[k];
  }
  dsw_environment_desc_init(&d, sizeof d);
  d.points = points[0], d.point_count = 26;
  d.connectivity = cells, d.connectivity_count = 40, d.volume_count = 5;
  d.flags = DSW_ENVIRONMENT_SPLIT | DSW_ENVIRONMENT_CONFORM | DSW_ENVIRONMENT_REORIENT | DSW_ENVIRONMENT_FIND_TOUCHING;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  UNTIL_IT_SUCCEEDS(dsw_environment_create(context, &d, &environment, &report),
                    environment == NULL && g_host.alive == 1 && report.status == DSW_STATUS_OUT_OF_MEMORY, refusals);
  CHECK(refusals >= 50 && report.status == DSW_STATUS_OK);
  CHECK(report.split_count == 1 && report.changed_count == 1 && report.part_count == 1);
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK(g_host.alive == 1);
  end_context(context, &g_host);
}

static void creating_a_scene(int plane) {
  dsw_context *const context = make_context(&g_host);
  dsw_environment *const environment = plane ? make_squares(context, 2, 2) : make_environment(context, 2, 2, 2);
  dsw_scene *scene = NULL;
  dsw_scene_desc d;
  const size_t before = g_host.alive;
  size_t refusals;
  dsw_scene_desc_init(&d, sizeof d);
  d.features = DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS;
  UNTIL_IT_SUCCEEDS(dsw_scene_create(environment, &d, &scene),
                    scene == NULL && g_host.alive == before && info_of(environment).scene_count == 0, refusals);
  CHECK(refusals >= 1);
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK(g_host.alive == before);
  CHECK_OK(dsw_environment_destroy(environment));
  end_context(context, &g_host);
}

enum { CLOUD = 600 };
static double g_positions[3 * CLOUD], g_targets[3 * CLOUD];
static dsw_particle_id g_ids[CLOUD];
static dsw_flight g_flights[CLOUD];

static size_t particle_count(dsw_scene *scene) {
  size_t count = 999;
  CHECK_OK(dsw_scene_get_particle_count(scene, &count));
  return count;
}

static int nothing_moved(dsw_scene *scene, int plane) {
  size_t i;
  for (i = 0; i < CLOUD; ++i) {
    double position[3];
    if (dsw_particle_get_position(scene, g_ids[i], position, NULL) != DSW_STATUS_OK) return 0;
    if (memcmp(position, g_positions + 3 * i, (plane ? 2 : 3) * sizeof *position) != 0) return 0;
  }
  return g_flights[0].volumes_visited == 0;
}

static dsw_statistics statistics_of(dsw_scene *scene) {
  dsw_statistics s;
  memset(&s, 0, sizeof s);
  s.struct_size = sizeof s;
  CHECK_OK(dsw_scene_get_statistics(scene, &s));
  return s;
}

static void particles_of_a_scene(int plane) {
  const dsw_crossing *list = NULL;
  const size_t *first = NULL;
  size_t refusals, i, flights = 9;
  dsw_particle_id one = {0, 0};
  for (i = 0; i < 3 * CLOUD; ++i) {
    g_positions[i] = 0.5 + (double)((i * 7) % 4);
    g_targets[i] = 0.25 + (double)((i * 5) % 6) - 1;
  }
  begin(4, 4, plane ? 0 : 4, DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS);
  memset(g_ids, 0, sizeof g_ids);
  memset(g_flights, 0, sizeof g_flights);
  UNTIL_IT_SUCCEEDS(dsw_particle_create(g_scene, g_positions, no_volume, &one),
                    one.generation == 0 && particle_count(g_scene) == 0, refusals);
  CHECK(refusals >= 1 && particle_count(g_scene) == 1);
  CHECK_OK(dsw_particle_destroy(g_scene, one));
  UNTIL_IT_SUCCEEDS(dsw_scene_create_particles(g_scene, g_positions, CLOUD, 24, NULL, g_ids, NULL),
                    g_ids[0].generation == 0 && particle_count(g_scene) == 0, refusals);
  CHECK(refusals >= 2 && particle_count(g_scene) == CLOUD);
  UNTIL_IT_SUCCEEDS(dsw_scene_move_particles(g_scene, g_ids, CLOUD, g_targets, 24, NULL, g_flights),
                    nothing_moved(g_scene, plane) && statistics_of(g_scene).casts == 0 &&
                        dsw_scene_get_crossings(g_scene, &list, &first, &flights) == DSW_STATUS_OK && flights == 0,
                    refusals);
  CHECK(refusals >= 3 && statistics_of(g_scene).casts >= CLOUD);
  end();
}

/* A body of an edge, and its move. */
static void a_body(int plane) {
  static const double at[6] = {1.25, 0.25, 1.5, 1.25, 3.75, 1.5}, to[6] = {3.25, 0.25, 1.5, 3.25, 3.75, 1.5};
  const dsw_volume_id pillar = {plane ? 6 : 22, 1};
  const dsw_body_contact *contacts = NULL;
  dsw_move_options o = move_options();
  dsw_body_desc d = line_desc(at, 2, 0, DSW_LEVEL_EDGES_SWEPT);
  dsw_body_id body = {0, 0};
  double now[6];
  size_t refusals, count = 9;
  d.stride_bytes = 24;
  memcpy(now, at, sizeof now);
  begin(4, 4, plane ? 0 : 3, 0);
  UNTIL_IT_SUCCEEDS(dsw_body_create(g_scene, &d, &body),
                    dsw_scene_get_body_count(g_scene, &count) == DSW_STATUS_OK && count == 0 && body.generation == 0,
                    refusals);
  CHECK(refusals >= 1);
  for (refusals = 0; RUNS_OUT(&g_host, refusals, dsw_body_move(g_scene, body, to, 2, 24, NULL, NULL)); ++refusals) {
    CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 24, NULL, &count));
    CHECK(memcmp(now, at, sizeof now) == 0);
  }
  CHECK(refusals >= 1);
  CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 24, NULL, &count));
  CHECK(memcmp(now, to, sizeof now) == 0);
  o.search = DSW_SEARCH_BISECTION_VERTEX; /* looks round a vertex of the wall */
  CHECK_OK(dsw_environment_mark_volumes(g_env, &pillar, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  for (refusals = 0; RUNS_OUT(&g_host, refusals, dsw_body_move(g_scene, body, at, 2, 24, &o, NULL)); ++refusals) {
    CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 24, NULL, &count));
    CHECK(memcmp(now, to, sizeof now) == 0);
  }
  CHECK(refusals >= 1 && dsw_body_get_contacts(g_scene, body, &contacts, &count) == DSW_STATUS_OK && count >= 1);
  end();
}

/* A wire and a particle leave; a refusal leaves exits, particles and bodies as they were. */
static void what_leaves(int plane) {
  static const double at[6] = {1.25, 1.25, 0.375, 3.5, 1.25, 0.375}, to[6] = {2.25, 1.25, 0.375, 9.5, 1.25, 0.375};
  const dsw_face_id face = face_at(4 + 3, plane ? 1 : FACE_X1);
  const dsw_exit *exits = NULL;
  dsw_cast_options leave;
  dsw_move_options o = move_options();
  dsw_body_desc d = line_desc(at, 2, 0, DSW_LEVEL_EDGES_SWEPT);
  dsw_particle_id particle;
  dsw_body_id body;
  size_t refusals, count = 9;
  uint32_t patch = 9;
  dsw_cast_options_init(&leave, sizeof leave);
  leave.flags = DSW_CAST_LEAVE;
  o.flags = DSW_MOVE_LEAVE;
  d.stride_bytes = 24;
  begin(4, 4, plane ? 0 : 3, 0);
  UNTIL_IT_SUCCEEDS(dsw_environment_mark_exits(g_env, &face, 1, 5),
                    dsw_environment_get_exit(g_env, face, &patch) == DSW_STATUS_OK && patch == 0, refusals);
  CHECK(refusals >= 1);
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  for (refusals = 0; RUNS_OUT(&g_host, refusals, dsw_body_move(g_scene, body, to, 2, 24, &o, NULL)); ++refusals) {
    CHECK(body_counts(g_scene, body).vertex_count == 2);
    CHECK_OK(dsw_body_get_exits(g_scene, body, &exits, &count));
    CHECK(count == 0);
  }
  CHECK(refusals >= 1 && body_counts(g_scene, body).vertex_count == 1);
  CHECK_OK(dsw_body_get_exits(g_scene, body, &exits, &count));
  CHECK(count == 1 && exits[0].patch == 5);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  UNTIL_IT_SUCCEEDS(dsw_particle_move(g_scene, particle, to + 3, &leave, NULL),
                    dsw_particle_get_position(g_scene, particle, NULL, NULL) == DSW_STATUS_OK, refusals);
  CHECK(refusals >= 1);
  CHECK_OK(dsw_scene_get_exits(g_scene, &exits, &count));
  CHECK(count == 1 && exits[0].patch == 5);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_get_position(g_scene, particle, NULL, NULL));
  end();
}

/* Rows of an edge near another one and near a wall. A refusal leaves none. */
static void near_rows(int plane) {
  static const double at[12] = {0.25, 0.25, 0.375, 3.5, 0.25, 0.375, 0.5, 0.5, 0.375, 3.75, 0.625, 0.375};
  const dsw_near_row *rows = NULL;
  const uint32_t *offsets = NULL;
  dsw_near_options o;
  dsw_body_id bodies[2];
  size_t refusals, rows_before, count = 9, found = 9, number_of_offsets = 9;
  int i;
  dsw_near_options_init(&o, sizeof o);
  o.margin = 0.5;
  o.flags = DSW_NEAR_JACOBIAN;
  begin(4, 4, plane ? 0 : 3, DSW_FEATURE_BODY_CONTACTS);
  for (i = 0; i < 2; ++i) {
    dsw_body_desc d = line_desc(at + 6 * i, 2, 0, DSW_LEVEL_EDGES_SWEPT);
    d.stride_bytes = 24;
    CHECK_OK(dsw_body_create(g_scene, &d, &bodies[i]));
  }
  CHECK_OK(dsw_body_find_near_rows(g_scene, bodies[1], &o, &rows_before));
  for (refusals = 0; RUNS_OUT(&g_host, refusals, dsw_body_find_near_rows(g_scene, bodies[0], &o, &found)); ++refusals) {
    CHECK(found == 9);
    CHECK_OK(dsw_body_get_near_rows(g_scene, bodies[0], &rows, &count));
    CHECK(count == 0);
    CHECK_OK(dsw_body_get_near_offsets(g_scene, bodies[0], &offsets, &count));
    CHECK(count == 0);
    CHECK_OK(dsw_body_get_near_rows(g_scene, bodies[1], &rows, &count));
    CHECK(count == rows_before);
  }
  CHECK(refusals >= 4 && found >= 4);
  CHECK_OK(dsw_body_get_near_rows(g_scene, bodies[0], &rows, &count));
  CHECK_OK(dsw_body_get_near_offsets(g_scene, bodies[0], &offsets, &number_of_offsets));
  CHECK(count == found && number_of_offsets == found + 1);
  end();
}

/* What the deformation of an environment by `points` would have changed. */
static int nothing_is_bent(const double *points, dsw_particle_id particle, const double *at, dsw_body_id body,
                           const double *line, size_t dimension) {
  const double *read = NULL;
  double now[3], of_body[9];
  size_t count = 0;
  CHECK_OK(dsw_particle_get_position(g_scene, particle, now, NULL));
  CHECK_OK(dsw_body_get_positions(g_scene, body, of_body, 3, 0, NULL, &count));
  CHECK(count == 2);
  CHECK_OK(dsw_environment_get_points(g_env, &read, &count));
  /* The height of the first point of the row that rises is as it was. */
  CHECK(read != points && read[dimension == 2 ? 21 : 152] == 2);
  return memcmp(now, at, dimension * sizeof *at) == 0 && memcmp(of_body, line, 2 * dimension * sizeof *line) == 0;
}

/* A floor that rises under a particle and a body. */
static void a_deformation(int plane) {
  static const double at[2][3] = {{2.3, 1.5, 2.2}, {2.3, 2.2}};
  static const double lines[2][6] = {{1.2, 1.5, 2.11, 2.8, 1.5, 2.11}, {1.2, 2.11, 2.8, 2.11}};
  static double arrays[2][3 * 125];
  const uint32_t row = plane ? 4 : 16, corners = plane ? 5 : 25, dimension = plane ? 2 : 3, up = dimension - 1;
  const dsw_body_desc d = line_desc(lines[plane], 2, 0, DSW_LEVEL_EDGES_SWEPT);
  int i;
  for (i = 0; i < 2; ++i) {
    dsw_deform_options o =
        deform_options_of(i == 0 ? DSW_DEFORM_SWEPT : DSW_DEFORM_END_STATE, i == 0 ? DSW_WALL_INSERT : DSW_WALL_PUSH);
    const double *read = NULL;
    dsw_particle_id particle;
    dsw_body_id body;
    double now[3], of_body[9];
    size_t refusals, points = 0, count = 0;
    uint32_t k;
    begin(4, 4, plane ? 0 : 4, DSW_FEATURE_DEFORMING);
    for (k = row; k < 2 * row; ++k) {
      CHECK_OK(set_face_mark(g_env, k, plane ? 2 : FACE_Z1, DSW_MARK_IMPASSABLE));
    }
    CHECK_OK(dsw_particle_create(g_scene, at[plane], no_volume, &particle));
    CHECK_OK(dsw_body_create(g_scene, &d, &body));
    CHECK_OK(dsw_environment_get_points(g_env, &read, &points));
    memcpy(arrays[0], read, dimension * points * sizeof *read);
    for (k = 2 * corners; k < 3 * corners; ++k) arrays[0][dimension * k + up] += 0.4;
    memcpy(arrays[1], arrays[0], sizeof arrays[1]);
    for (refusals = 0; RUNS_OUT(&g_host, refusals, dsw_environment_deform(g_env, arrays[0], points, &o, NULL));
         ++refusals) {
      CHECK(nothing_is_bent(arrays[0], particle, at[plane], body, lines[plane], dimension));
      CHECK(memcmp(arrays[0], arrays[1], sizeof arrays[0]) == 0);
    }
    CHECK(refusals > 3 && memcmp(arrays[0], arrays[1], sizeof arrays[0]) == 0);
    CHECK_OK(dsw_particle_get_position(g_scene, particle, now, NULL));
    CHECK_OK(dsw_body_get_positions(g_scene, body, of_body, 3, 0, NULL, &count));
    CHECK(now[up] > 2.4 && of_body[up] > 2.4);
    end();
  }
}

static size_t mark_count(dsw_environment *environment, dsw_cell_kind kind) {
  size_t count = 999;
  CHECK_OK(dsw_environment_get_mark_count(environment, kind, &count));
  return count;
}

static void marks_and_tags(void) {
  dsw_context *const context = make_context(&g_host);
  grid g = grid_create(6, 5, 5);
  dsw_environment_desc d = grid_desc(&g);
  dsw_environment *environment = NULL;
  dsw_scene *scene;
  dsw_particle_id id;
  const double position[3] = {0.5, 0.5, 0.5};
  dsw_volume_id volumes[150];
  dsw_face_id faces[150];
  dsw_edge_id edges[150];
  dsw_vertex_id vertices[150];
  uint32_t i, tag = 1;
  size_t refusals;
  for (i = 0; i < 150; ++i) {
    volumes[i] = volume_at(i);
    faces[i] = face_at(i, FACE_X1);
    edges[i] = edge_at(i, 0);
    vertices[i] = vertex_at(i);
  }
  d.tags = NULL;
  CHECK_OK(dsw_environment_create(context, &d, &environment, NULL));
  scene = make_scene(environment, 0);
  CHECK_OK(dsw_particle_create(scene, position, no_volume, &id));
  UNTIL_IT_SUCCEEDS(
      dsw_environment_mark_volumes(environment, volumes, 150, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, NULL),
      mark_count(environment, DSW_CELL_VOLUME) == 0, refusals);
  CHECK(refusals >= 1 && mark_count(environment, DSW_CELL_VOLUME) == 149);
  UNTIL_IT_SUCCEEDS(dsw_environment_mark_faces(environment, faces, 150, DSW_MARK_IMPASSABLE),
                    mark_count(environment, DSW_CELL_FACE) == 0, refusals);
  CHECK(refusals >= 1 && mark_count(environment, DSW_CELL_FACE) == 150);
  UNTIL_IT_SUCCEEDS(dsw_environment_mark_edges(environment, edges, 150, DSW_MARK_IMPASSABLE),
                    mark_count(environment, DSW_CELL_EDGE) == 0, refusals);
  CHECK(refusals >= 1 && mark_count(environment, DSW_CELL_EDGE) == 150);
  UNTIL_IT_SUCCEEDS(dsw_environment_mark_vertices(environment, vertices, 150, DSW_MARK_IMPASSABLE),
                    mark_count(environment, DSW_CELL_VERTEX) == 0, refusals);
  CHECK(refusals >= 1 && mark_count(environment, DSW_CELL_VERTEX) == 150);
  UNTIL_IT_SUCCEEDS(dsw_environment_set_tag(environment, volume_at(3), 77),
                    dsw_environment_get_tag(environment, volume_at(3), &tag) == DSW_STATUS_OK && tag == 0, refusals);
  CHECK(refusals >= 1);
  end_scene(scene);
  end_context(context, &g_host);
  grid_destroy(&g);
}

/* A surface and a line through all of a row of cubes. */
static void marks_with_bodies(void) {
  static const double positions[15] = {0.5, 0.5, 0.5, 5.5, 0.5, 0.5, 2.5, 4.5, 0.5, 0.5, 2.5, 2.5, 5.5, 2.5, 2.5};
  static const uint32_t offsets[2] = {0, 3}, corners[3] = {0, 1, 2}, edge[2] = {3, 4};
  const dsw_body_id *bodies = NULL;
  dsw_volume_id volumes[150];
  dsw_face_id faces[150];
  dsw_body_desc d;
  dsw_body_id id;
  size_t refusals, skipped = 0, count = 9, face_count = 0;
  uint32_t i;
  begin(6, 5, 5, 0);
  for (i = 0; i < 150; ++i) {
    volumes[i] = volume_at(i);
    if (i % 30 / 6 != 2 && i >= 30) faces[face_count++] = face_at(i, FACE_X1);
  }
  d = surface_desc(positions, 5, offsets, corners, 1, DSW_LEVEL_FACES);
  d.edges = edge;
  d.edge_count = 1;
  CHECK_OK(dsw_body_create(g_scene, &d, &id));
  UNTIL_IT_SUCCEEDS(dsw_environment_mark_faces(g_env, faces, face_count, DSW_MARK_IMPASSABLE),
                    mark_count(g_env, DSW_CELL_FACE) == 0, refusals);
  CHECK(refusals >= 1 && mark_count(g_env, DSW_CELL_FACE) == face_count);
  CHECK_OK(dsw_environment_mark_faces(g_env, faces, face_count, DSW_MARK_PASSABLE));
  UNTIL_IT_SUCCEEDS(
      dsw_environment_mark_volumes(g_env, volumes, 150, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, &skipped),
      mark_count(g_env, DSW_CELL_VOLUME) == 0 && skipped == 0 &&
          dsw_scene_get_occupant_bodies(g_scene, &bodies, &count) == DSW_STATUS_OK && count == 0,
      refusals);
  CHECK(refusals >= 4 && skipped > 20 && mark_count(g_env, DSW_CELL_VOLUME) == 150 - skipped);
  CHECK_OK(dsw_scene_get_occupant_bodies(g_scene, &bodies, &count));
  CHECK(count == 1);
  end();
}

static void queries(void) {
  static const uint32_t indices[6] = {1, 17, 13, 5, 0, 1};
  static const size_t offsets[2] = {0, 4};
  const double point[3] = {1.25, 0.5, 0.625};
  dsw_face_id face = {9, 9, 9};
  dsw_edge_id edge = {9, 9, 9};
  dsw_nearest nearest;
  size_t refusals, before;
  begin(3, 2, 2, 0);
  before = g_host.alive;
  UNTIL_IT_SUCCEEDS(dsw_environment_find_faces(g_env, 1, offsets, indices, &face, NULL),
                    face.volume == 9 && g_host.alive == before, refusals);
  CHECK(refusals >= 1 && face.volume == 0);
  UNTIL_IT_SUCCEEDS(dsw_environment_find_edges(g_env, 1, indices + 4, &edge, NULL),
                    edge.volume == 9 && g_host.alive == before, refusals);
  CHECK(refusals >= 1 && edge.volume == 0);
  memset(&nearest, 0x55, sizeof nearest);
  UNTIL_IT_SUCCEEDS(dsw_environment_find_nearest(g_env, point, no_volume, 1, &nearest),
                    nearest.tag == 0x55555555u && g_host.alive == before, refusals);
  CHECK(nearest.distance == 0.5);
  UNTIL_IT_SUCCEEDS(dsw_environment_check(g_env, NULL), g_host.alive == before, refusals);
  CHECK(g_host.alive == before);
  end();
}

/* Segments so long that they need memory, in a batch of two chunks. */
static void nearest_of_batches(void) {
  enum { COUNT = 300 };
  static double from[3 * COUNT], to[3 * COUNT];
  static dsw_nearest points[COUNT];
  static dsw_segment_nearest segments[COUNT];
  size_t refusals, before, i;
  begin(6, 6, 6, 0);
  for (i = 0; i < 3 * COUNT; ++i) {
    from[i] = 2.5 + (double)(i % 3) / 4;
    to[i] = 3.75 - (double)(i % 7) / 8;
  }
  before = g_host.alive;
  UNTIL_IT_SUCCEEDS(dsw_environment_find_nearest_to_segments(g_env, COUNT, NULL, from, to, 0, 9, segments, NULL, NULL),
                    g_host.alive == before, refusals);
  CHECK(refusals >= 3 && g_host.alive == before);
  UNTIL_IT_SUCCEEDS(dsw_environment_find_nearest_to_points(g_env, from, COUNT, 0, NULL, 0.75, points, NULL, NULL),
                    g_host.alive == before, refusals);
  CHECK(refusals >= 2 && g_host.alive == before);
  {
    static dsw_flight flights[COUNT];
    static double distances[COUNT];
    dsw_cast_options open;
    dsw_cast_options_init(&open, sizeof open);
    open.flags = DSW_CAST_OPEN_ENDS;
    UNTIL_IT_SUCCEEDS(dsw_environment_cast_segments(g_env, COUNT, NULL, from, to, 0, &open, flights),
                      g_host.alive == before, refusals);
    CHECK(refusals >= 2 && g_host.alive == before);
    UNTIL_IT_SUCCEEDS(dsw_environment_find_signed_distances(g_env, from, COUNT, 0, distances, NULL),
                      g_host.alive == before, refusals);
    CHECK(refusals >= 3 && g_host.alive == before && distances[0] < 0 && flights[0].outcome == DSW_OUTCOME_REACHED);
  }
  for (i = 0; i < COUNT; ++i) CHECK(points[i].distance == HUGE_VAL && segments[i].nearest.distance <= 3);
  end();
}

static void ranks_of_pairs(void) {
  enum { COUNT = 300 };
  static double from[9 * COUNT], to[9 * COUNT];
  static uint32_t indices[2 * COUNT];
  static uint8_t kinds[COUNT];
  static dsw_pair_touch touches[COUNT];
  dsw_context *const context = make_context(&g_host);
  size_t refusals, i;
  for (i = 0; i < COUNT; ++i) kinds[i] = DSW_PAIR_VERTEX_EDGE;
  UNTIL_IT_SUCCEEDS(dsw_sweep_pairs(context, 2, COUNT, kinds, from, to, 0, DSW_PAIRS_RANK, touches), g_host.alive == 1,
                    refusals);
  CHECK(refusals == 1 && touches[COUNT - 1].touches == 1);
  for (i = 0; i < 2 * COUNT; ++i) indices[i] = UINT32_MAX;
  UNTIL_IT_SUCCEEDS(
      dsw_sweep_rigid_pairs(context, 2, COUNT, kinds, from, to, 0, NULL, 0, indices, DSW_PAIRS_RANK, touches),
      g_host.alive == 1, refusals);
  CHECK(refusals == 1);
  end_context(context, &g_host);
}

/* Large triangles in a batch of two chunks. */
static void sweeps(void) {
  enum { COUNT = 300 };
  static const double from[9] = {0.25, 0.5, 0.5, 0.5, 5.5, 0.25, 5.75, 0.25, 5.5};
  static const double to[9] = {5.75, 0.25, 1.5, 5.5, 5.25, 3.75, 0.25, 0.75, 0.5};
  static const double fixed[9] = {3.25, 5.5, 5.5, 2.75, 0.5, 5.25, 3.5, 5.75, 3.25};
  static double points[3][3 * COUNT];
  static dsw_sweep reports[COUNT];
  size_t refusals, before, i;
  begin(6, 6, 6, 0);
  before = g_host.alive;
  for (i = 0; i < 3 * COUNT; ++i) {
    points[0][i] = from[i % 9];
    points[1][i] = to[i % 9];
    points[2][i] = fixed[i % 9];
  }
  UNTIL_IT_SUCCEEDS(dsw_environment_sweep_edges(g_env, COUNT, NULL, points[0], points[1], points[2], 0, NULL, reports),
                    g_host.alive == before, refusals);
  CHECK(refusals >= 4 && g_host.alive == before && g_host.parallel_calls == refusals + 1);
  for (i = 0; i < COUNT; ++i) CHECK(reports[i].outcome == DSW_OUTCOME_REACHED && reports[i].volumes_visited > 20);
  end();
}

static void saving_and_loading_a_scene(void) {
  const double ends[6] = {0.5, 0.5, 0.5, 2.5, 1.25, 1.75}, place[3] = {1.5, 1.5, 1.5};
  static unsigned char block[2][8192];
  dsw_particle_id particle;
  dsw_scene *loaded = NULL;
  size_t size = 0, again = 0, refusals, before;
  begin(3, 3, 3, 0);
  (void)make_edge_body(g_scene, ends, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_particle_create(g_scene, place, no_volume, &particle));
  block[0][0] = 0x55;
  UNTIL_IT_SUCCEEDS(dsw_scene_save(g_scene, block[0], sizeof block[0], &size), block[0][0] == 0x55 && size == 0,
                    refusals);
  CHECK(refusals >= 3);
  before = g_host.alive;
  UNTIL_IT_SUCCEEDS(dsw_scene_load(g_env, block[0], size, &loaded), loaded == NULL && g_host.alive == before, refusals);
  CHECK(refusals >= 10);
  CHECK_OK(dsw_scene_save(loaded, block[1], sizeof block[1], &again));
  CHECK(again == size && memcmp(block[0], block[1], size) == 0);
  CHECK_OK(dsw_scene_destroy(loaded));
  end();
}

int main(void) {
  int plane;
  for (plane = 0; plane < 2; ++plane) {
    check_in(plane ? "in the plane" : "in space");
    creating_an_environment(plane);
    if (!plane) creating_what_is_sewn_and_split();
    creating_a_scene(plane);
    particles_of_a_scene(plane);
    a_body(plane);
    near_rows(plane);
    what_leaves(plane);
    a_deformation(plane);
  }
  check_in("");
  saving_and_loading_a_scene();
  marks_and_tags();
  marks_with_bodies();
  queries();
  nearest_of_batches();
  ranks_of_pairs();
  sweeps();
  return check_result();
}
