/* Near rows: what a caller gets, arguments that are refused, obstacles of each kind, keys and the Jacobian.
   tests/property/near_rows_test.cpp compares rows with their definition. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "stage.h"

static const uint32_t NONE = 0xffffffffu;

static dsw_near_options options(double margin, double radius, uint32_t flags) {
  dsw_near_options o;
  memset(&o, 0x55, sizeof o);
  dsw_near_options_init(&o, sizeof o);
  CHECK(o.struct_size == sizeof o && o.flags == 0 && o.margin == 0 && o.radius == 0);
  o.margin = margin;
  o.radius = radius;
  o.flags = flags;
  return o;
}

static size_t rows_of(dsw_body_id body, const dsw_near_row **rows) {
  size_t count = 99;
  CHECK_OK(dsw_body_get_near_rows(g_scene, body, rows, &count));
  return count;
}

/* Finds rows and hands them out. */
static size_t find(dsw_body_id body, double margin, double radius, const dsw_near_row **rows) {
  const dsw_near_options o = options(margin, radius, 0);
  size_t found = 98, count;
  CHECK_OK(dsw_body_find_near_rows(g_scene, body, &o, &found));
  count = rows_of(body, rows);
  CHECK(found == count);
  return count;
}

static int is_vector(const double *v, double x, double y, double z) {
  const double bound = 1e-15;
  return fabs(v[0] - x) <= bound && fabs(v[1] - y) <= bound && fabs(v[2] - z) <= bound;
}

/* A zero without a sign, as normals of contacts have it. */
static int is_plain(double x) { return x != 0 || copysign(1, x) > 0; }

static double weighted(const double *weights, const uint32_t *vertices, const double *positions, uint32_t axis) {
  double sum = 0;
  int i;
  for (i = 0; i < 3 && vertices[i] != NONE; ++i) sum += weights[i] * positions[3 * vertices[i] + axis];
  return sum;
}

/* A wire past the corner of the pillar, whose ends are near the outer boundary at x = 0 and y = 0. */
static const double g_wire[6] = {0.25, 1.75, 1.375, 2.5, 0.25, 1.375};

static dsw_body_id make_wire(void) {
  mark_pillar(DSW_MARK_IMPASSABLE);
  return make_line(g_wire, 2, DSW_LEVEL_EDGES_SWEPT);
}

/* The foot of the corner (2, 1) on the wire, as a part of it. */
static double foot(void) { return (1.75 * 2.25 + 0.75 * 1.5) / (2.25 * 2.25 + 1.5 * 1.5); }

static void a_wire_near_walls_and_an_edge(unsigned dimension) {
  const dsw_near_row *r = NULL;
  dsw_body_id wire;
  const double way = 1.75 * 1.5 - 0.75 * 2.25, length = sqrt(2.25 * 2.25 + 1.5 * 1.5);
  int k;
  begin_stage(dimension);
  wire = make_wire();
  CHECK(find(wire, 0.375, 0, &r) == 3);
  /* Rows are sorted by their keys: vertices come before edges. */
  CHECK(r[0].vertices[0] == 0 && r[0].vertices[1] == NONE && r[0].vertices[2] == NONE);
  CHECK(r[0].distance == 0.25 && r[0].gap == 0.25 && is_vector(r[0].normal, 1, 0, 0) && r[0].weights[0] == 1);
  CHECK(r[0].point[0] == 0.25 && r[0].obstacle_point[0] == 0 && r[0].obstacle_point[1] == 1.75);
  CHECK(r[0].obstacle.kind == DSW_CELL_FACE && r[0].wall.generation == 1 && r[0].body.generation == 0);
  CHECK(r[0].tag == 100 + g_pillar - 2);
  CHECK(r[1].vertices[0] == 1 && r[1].distance == 0.25 && is_vector(r[1].normal, 0, 1, 0));
  CHECK(r[1].tag == 100 + g_pillar - N);
  CHECK(r[2].vertices[0] == 0 && r[2].vertices[1] == 1 && r[2].vertices[2] == NONE);
  CHECK(fabs(r[2].distance - way / length) < 1e-15 && is_vector(r[2].normal, -1.5 / length, -2.25 / length, 0));
  CHECK(fabs(r[2].weights[1] - foot()) < 1e-15 && r[2].weights[2] == 0);
  CHECK(is_vector(r[2].obstacle_point, 2, 1, dimension == 3 ? 1.375 : 0) && r[2].tag == 100 + g_pillar);
  CHECK(r[2].obstacle.kind == (dimension == 3 ? DSW_CELL_EDGE : DSW_CELL_VERTEX));
  CHECK((r[2].obstacle_vertices[1] == NONE) == (dimension == 2) && r[2].obstacle_vertices[2] == NONE);
  for (k = 0; k < 3; ++k) {
    const double sum = r[k].weights[0] + r[k].weights[1] + r[k].weights[2];
    CHECK(fabs(sum - 1) < 1e-15 && r[k].reserved == 0 && r[k].previous == NONE && r[k].key[1] == 0);
    CHECK(is_plain(r[k].normal[0]) && is_plain(r[k].normal[1]) && is_plain(r[k].normal[2]));
    CHECK(fabs(weighted(r[k].weights, r[k].vertices, g_wire, 0) - r[k].point[0]) < 1e-15);
    CHECK(fabs(r[k].obstacle_weights[0] + r[k].obstacle_weights[1] + r[k].obstacle_weights[2] - 1) < 1e-15);
  }
  end_stage();
}

static void margin_and_radius_add_up(unsigned dimension) {
  const dsw_near_row *r = NULL;
  dsw_body_id wire;
  begin_stage(dimension);
  wire = make_wire();
  CHECK(find(wire, 0.25, 0, &r) == 2); /* the margin itself counts */
  CHECK(find(wire, nextafter(0.25, 0), 0, &r) == 0);
  CHECK(find(wire, 0.24, 0, &r) == 0);
  CHECK(find(wire, 0.25, 0.125, &r) == 3 && r[0].gap == 0.125 && r[0].distance == 0.25);
  CHECK(find(wire, 0, 0.375, &r) == 3 && r[0].gap == -0.125);
  CHECK_OK(dsw_body_find_near_rows(g_scene, wire, NULL, NULL));
  CHECK(rows_of(wire, &r) == 0);
  end_stage();
}

static void rows_are_followed(unsigned dimension) {
  const dsw_near_row *r = NULL;
  dsw_near_row before[3];
  double to[6];
  dsw_body_id wire;
  int i;
  begin_stage(dimension);
  wire = make_wire();
  CHECK(find(wire, 0.375, 0, &r) == 3);
  memcpy(before, r, sizeof before);
  memcpy(to, g_wire, sizeof to);
  to[0] = 0.5; /* too far from the wall, which has no row then */
  move(wire, to, 2, NULL);
  CHECK(rows_of(wire, &r) == 3); /* until they are found again */
  CHECK(find(wire, 0.375, 0, &r) == 2);
  for (i = 0; i < 2; ++i) {
    CHECK(memcmp(r[i].key, before[i + 1].key, sizeof r[i].key) == 0 && r[i].previous == (uint32_t)i + 1);
  }
  move(wire, g_wire, 2, NULL);
  CHECK(find(wire, 0.375, 0, &r) == 3);
  for (i = 0; i < 3; ++i) CHECK(memcmp(r[i].key, before[i].key, sizeof r[i].key) == 0);
  CHECK(r[0].previous == NONE && r[1].previous == 0 && r[2].previous == 1);
  for (i = 0; i < 3; ++i) CHECK(r[i].distance == before[i].distance);
  end_stage();
}

/* A vertex that slides along a wall from cell to cell: another key, and the row of before. */
static void a_row_of_the_next_cell_takes_over(unsigned dimension) {
  const double from[6] = {0.75, 0.25, 1.375, 0.75, 1.5, 1.375}, to[6] = {1.25, 0.25, 1.375, 1.25, 1.5, 1.375};
  const dsw_near_row *r = NULL;
  uint32_t key[4];
  dsw_body_id line;
  begin_stage(dimension);
  line = make_line(from, 2, DSW_LEVEL_EDGES_SWEPT);
  CHECK(find(line, 0.375, 0, &r) == 1 && r[0].previous == NONE);
  memcpy(key, r[0].key, sizeof key);
  move(line, to, 2, NULL);
  CHECK(find(line, 0.375, 0, &r) == 1 && r[0].previous == 0 && memcmp(r[0].key, key, sizeof key) != 0);
  end_stage();
}

static void the_jacobian_has_weights_times_normals(unsigned dimension) {
  const dsw_near_options o = options(0.375, 0, DSW_NEAR_JACOBIAN);
  const uint32_t *offsets = NULL, *columns = NULL;
  const double *values = NULL;
  const dsw_near_row *r = NULL;
  size_t count = 99, entries = 0, v, k, at = 0;
  dsw_body_id wire;
  begin_stage(dimension);
  wire = make_wire();
  CHECK_OK(dsw_body_find_near_rows(g_scene, wire, &o, NULL));
  CHECK(rows_of(wire, &r) == 3);
  CHECK_OK(dsw_body_get_near_offsets(g_scene, wire, &offsets, &count));
  CHECK(count == 4 && offsets[0] == 0 && offsets[1] == dimension && offsets[2] == 2 * dimension);
  CHECK_OK(dsw_body_get_near_columns(g_scene, wire, &columns, &entries));
  CHECK_OK(dsw_body_get_near_values(g_scene, wire, &values, &count));
  CHECK(offsets[3] == 4 * dimension && entries == 4 * dimension && count == entries);
  for (v = 0; v < 2; ++v) {
    for (k = 0; k < dimension; ++k, ++at) {
      CHECK(columns[at] == dimension * v + k && values[at] == r[v].normal[k]);
      CHECK(columns[2 * dimension + at] == columns[at]);
      CHECK(values[2 * dimension + at] == r[2].weights[v] * r[2].normal[k]);
    }
  }
  /* Without the flag there is none. */
  CHECK(find(wire, 0.375, 0, &r) == 3);
  CHECK_OK(dsw_body_get_near_offsets(g_scene, wire, &offsets, &count));
  CHECK(count == 0);
  CHECK_OK(dsw_body_get_near_columns(g_scene, wire, &columns, &count));
  CHECK(count == 0);
  CHECK_OK(dsw_body_get_near_values(g_scene, wire, &values, &count));
  CHECK(count == 0);
  end_stage();
}

/* Without rows the matrix has no rows. */
static void an_empty_jacobian_has_one_offset(unsigned dimension) {
  const dsw_near_options o = options(0.0625, 0, DSW_NEAR_JACOBIAN);
  const uint32_t *offsets = NULL;
  size_t count = 99;
  dsw_body_id wire;
  begin_stage(dimension);
  wire = make_wire();
  CHECK_OK(dsw_body_find_near_rows(g_scene, wire, &o, &count));
  CHECK(count == 0);
  CHECK_OK(dsw_body_get_near_offsets(g_scene, wire, &offsets, &count));
  CHECK(count == 1 && offsets[0] == 0);
  end_stage();
}

/* In the corner of the outer boundary there is a row for each wall. */
static void a_body_rests_in_a_corner(unsigned dimension) {
  const double corner[6] = {0.125, 0.0625, 0.03125, 1.5, 1.5, 1.5};
  const double beyond[6] = {-0.125, -0.0625, -0.03125, 1.5, 1.5, 1.5};
  const dsw_near_row *r = NULL;
  dsw_body_id line;
  size_t count, i;
  begin_stage(dimension);
  line = make_line(corner, 2, DSW_LEVEL_EDGES_SWEPT);
  count = find(line, 0.25, 0, &r);
  CHECK(count == dimension);
  for (i = 0; i < count; ++i) {
    const double x = fabs(r[i].normal[0]), y = fabs(r[i].normal[1]);
    CHECK(r[i].vertices[0] == 0 && r[i].vertices[1] == NONE);
    CHECK(r[i].distance == (x == 1 ? 0.125 : y == 1 ? 0.0625 : 0.03125));
  }
  move(line, beyond, 2, NULL); /* the vertex stops in front of the corner and rests there */
  count = find(line, 0.25, 0, &r);
  CHECK(count == dimension);
  for (i = 0; i < count; ++i) CHECK(r[i].distance > 0 && r[i].distance < 1e-6 && r[i].previous == i);
  end_stage();
}

/* The edge x = y = 2 from z = 1 to 2 between four passable cubes. */
static dsw_edge_id inner_edge(void) {
  const uint32_t layer = (N + 1) * (N + 1);
  const uint32_t ends[2] = {layer + point_at(2, 2), 2 * layer + point_at(2, 2)};
  dsw_edge_id edge = {0, 0, 0};
  CHECK_OK(dsw_environment_find_edges(g_env, 1, ends, &edge, NULL));
  return edge;
}

static void marked_edges_and_vertices_are_obstacles(void) {
  const double line[6] = {1.25, 1.5, 1.5, 2.75, 1.5, 1.375};
  const double reach = 0.51;
  dsw_edge_id edge;
  const dsw_near_row *r = NULL;
  dsw_body_id body;
  begin_stage(3);
  edge = inner_edge();
  body = make_line(line, 2, DSW_LEVEL_EDGES_SWEPT);
  CHECK(find(body, reach, 0, &r) == 0);
  CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_IMPASSABLE));
  CHECK(find(body, reach, 0, &r) == 1);
  CHECK(r[0].obstacle.kind == DSW_CELL_EDGE && r[0].obstacle.index == edge.volume && r[0].obstacle.local == edge.local);
  CHECK(r[0].wall.generation == 0 && r[0].distance == 0.5 && is_vector(r[0].normal, 0, -1, 0));
  CHECK(r[0].weights[0] == 0.5 && r[0].weights[1] == 0.5 && r[0].obstacle_vertices[2] == NONE);
  CHECK(is_vector(r[0].obstacle_point, 2, 2, 1.4375));
  CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_PASSABLE));
  CHECK(find(body, reach, 0, &r) == 0);
  end_stage();

  begin_stage(2);
  body = make_line(line, 2, DSW_LEVEL_EDGES_SWEPT);
  CHECK(find(body, reach, 0, &r) == 0);
  CHECK_OK(mark_point(2, 2, DSW_MARK_IMPASSABLE));
  CHECK(find(body, reach, 0, &r) == 1);
  CHECK(r[0].obstacle.kind == DSW_CELL_VERTEX && r[0].obstacle.index == point_at(2, 2));
  CHECK(r[0].wall.generation == 0 && r[0].distance == 0.5 && r[0].obstacle_vertices[0] == point_at(2, 2));
  CHECK(r[0].obstacle_weights[0] == 1 && r[0].obstacle_vertices[1] == NONE);
  end_stage();

  begin_stage(3); /* a vertex in space */
  body = make_line(line, 2, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(set_vertex_mark(g_env, (N + 1) * (N + 1) + point_at(2, 2), DSW_MARK_IMPASSABLE));
  CHECK(find(body, 0.75, 0, &r) == 1 && r[0].vertices[1] == 1 && r[0].wall.generation == 0);
  CHECK(r[0].obstacle.kind == DSW_CELL_VERTEX && r[0].obstacle.index == (N + 1) * (N + 1) + point_at(2, 2));
  end_stage();
}

/* What is behind a wall has no row. */
static void a_wall_hides_what_is_behind(void) {
  const double line[6] = {1.75, 0.5, 1.375, 1.75, 0.75, 1.375};
  const dsw_near_row *r = NULL;
  dsw_body_id body;
  begin_stage(3);
  body = make_line(line, 2, DSW_LEVEL_EDGES_SWEPT);
  /* The faces x = 2 and x = 3 of the same row; the second one is behind the first. */
  CHECK_OK(mark_face(1 + N * N, FACE_X1, DSW_MARK_IMPASSABLE));
  CHECK(find(body, 0.375, 0, &r) == 2 && r[0].distance == 0.25 && r[1].distance == 0.25);
  CHECK_OK(mark_face(2 + N * N, FACE_X1, DSW_MARK_IMPASSABLE));
  CHECK(find(body, 1.375, 0, &r) > 2);
  {
    size_t i, count = rows_of(body, &r);
    for (i = 0; i < count; ++i) CHECK(r[i].obstacle_point[0] <= 2);
  }
  end_stage();
}

static void only_parts_of_the_level_have_rows(unsigned dimension) {
  const dsw_near_row *r = NULL;
  dsw_body_id wire;
  size_t count, i;
  begin_stage(dimension);
  mark_pillar(DSW_MARK_IMPASSABLE);
  wire = make_line(g_wire, 2, DSW_LEVEL_POINTS);
  count = find(wire, 0.375, 0, &r);
  CHECK(count == 2);
  for (i = 0; i < count; ++i) CHECK(r[i].vertices[0] == i && r[i].vertices[1] == NONE);
  CHECK_OK(dsw_body_set_level(g_scene, wire, DSW_LEVEL_EDGES));
  CHECK(find(wire, 0.375, 0, &r) == 3);
  end_stage();
}

/* Two crossed lines of two bodies, and parts of one body. */
static void other_bodies_are_near(void) {
  const double first[6] = {1, 1.5, 1.5, 2, 1.5, 1.5}, second[6] = {1.5, 1, 1.75, 1.5, 2, 1.75};
  const double hook[12] = {1.25, 1.25, 1.5, 2.75, 1.25, 1.5, 2.75, 1.75, 1.5, 2, 1.5, 1.5};
  const dsw_near_options o = options(0.3125, 0.0625, DSW_NEAR_JACOBIAN);
  const dsw_near_row *r = NULL;
  const uint32_t *offsets = NULL, *columns = NULL;
  const double *values = NULL;
  dsw_body_desc d;
  dsw_body_id bodies[2], own;
  size_t count = 99, i;
  double sum = 0;
  begin_stage(3);
  end_scene(g_scene);
  g_env = make_environment(NULL, N, N, 3);
  g_scene = make_scene(g_env, DSW_FEATURE_BODY_CONTACTS);
  bodies[0] = make_line(first, 2, DSW_LEVEL_EDGES_SWEPT);
  bodies[1] = make_line(second, 2, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_body_find_near_rows(g_scene, bodies[0], &o, &count));
  CHECK(count == 1 && rows_of(bodies[0], &r) == 1);
  CHECK(r[0].body.index == bodies[1].index && r[0].body.generation == bodies[1].generation);
  CHECK(r[0].obstacle.kind == DSW_CELL_NONE && r[0].wall.generation == 0 && r[0].tag == 0);
  CHECK(r[0].distance == 0.25 && r[0].gap == 0.1875 && is_vector(r[0].normal, 0, 0, -1));
  CHECK(r[0].obstacle_vertices[0] == 0 && r[0].obstacle_vertices[1] == 1 && r[0].obstacle_weights[0] == 0.5);
  CHECK_OK(dsw_body_get_near_values(g_scene, bodies[0], &values, &count));
  CHECK(count == 6); /* of this body alone */
  CHECK_OK(dsw_body_set_filter(g_scene, bodies[0], 1, 2));
  CHECK_OK(dsw_body_set_filter(g_scene, bodies[1], 1, 2));
  CHECK(find(bodies[0], 0.3125, 0, &r) == 0);
  CHECK_OK(dsw_body_destroy(g_scene, bodies[0]));
  CHECK_OK(dsw_body_destroy(g_scene, bodies[1]));

  d = line_desc(hook, 4, 0, DSW_LEVEL_EDGES_SWEPT);
  d.flags = DSW_BODY_SELF_CONTACTS;
  CHECK_OK(dsw_body_create(g_scene, &d, &own));
  CHECK_OK(dsw_body_find_near_rows(g_scene, own, &o, &count));
  CHECK(count == 1 && rows_of(own, &r) == 1);
  CHECK(r[0].body.index == own.index && r[0].gap == r[0].distance - 0.125 && r[0].distance == 0.25);
  CHECK_OK(dsw_body_get_near_offsets(g_scene, own, &offsets, &count));
  CHECK_OK(dsw_body_get_near_columns(g_scene, own, &columns, &count));
  CHECK_OK(dsw_body_get_near_values(g_scene, own, &values, &count));
  CHECK(count == 9 && offsets[1] == 9);
  for (i = 0; i < count; ++i) {
    CHECK(is_plain(values[i]));
    sum += values[i]; /* moved as a whole the body keeps its gaps */
    CHECK(i == 0 || columns[i - 1] < columns[i]);
  }
  CHECK(fabs(sum) < 1e-15);
  end_stage();
}

static void a_deformed_environment_is_seen_anew(void) {
  static double arrays[2][3 * 100];
  const dsw_near_row *r = NULL;
  const double *points = NULL;
  const double line[6] = {0.25, 0.5, 1.375, 0.25, 0.75, 1.375};
  dsw_body_id body;
  size_t count = 0, i;
  begin_stage(3);
  end_scene(g_scene);
  g_env = make_environment(NULL, N, N, 3);
  g_scene = make_scene(g_env, DSW_FEATURE_DEFORMING);
  body = make_line(line, 2, DSW_LEVEL_EDGES_SWEPT);
  CHECK(find(body, 0.375, 0, &r) == 2 && r[0].distance == 0.25);
  CHECK_OK(dsw_environment_get_points(g_env, &points, &count));
  CHECK(count == 100);
  memcpy(arrays[0], points, sizeof arrays[0]);
  for (i = 0; i < count; ++i) {
    if (arrays[0][3 * i] == 0) arrays[0][3 * i] = 0.125;
  }
  CHECK_OK(dsw_environment_deform(g_env, arrays[0], count, NULL, NULL));
  CHECK(find(body, 0.375, 0, &r) == 2 && r[0].distance == 0.125 && r[0].previous == 0);
  end_stage();
}

static void arguments_that_are_refused(unsigned dimension) {
  const dsw_body_id null_body = {0, 0};
  const dsw_near_options good = options(0.375, 0, 0);
  const dsw_near_row *r = NULL;
  const uint32_t *numbers = NULL;
  const double *values = NULL;
  dsw_near_options bad;
  dsw_body_id wire, stale;
  size_t count = 99;
  begin_stage(dimension);
  wire = make_wire();
  stale = wire;
  ++stale.generation;
  /* Before the first call there are none. */
  CHECK(rows_of(wire, &r) == 0);
  CHECK_OK(dsw_body_get_near_offsets(g_scene, wire, &numbers, &count));
  CHECK(count == 0);
  CHECK_OK(dsw_body_get_near_columns(g_scene, wire, &numbers, &count));
  CHECK(count == 0);
  CHECK_OK(dsw_body_get_near_values(g_scene, wire, &values, &count));
  CHECK(count == 0);

  CHECK(find(wire, 0.375, 0, &r) == 3);
#define FIND(o) dsw_body_find_near_rows(g_scene, wire, o, &count)
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, good, margin, NAN, FIND(&bad));
  CHECK_MESSAGE("options->margin is");
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, good, margin, INFINITY, FIND(&bad));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, good, margin, -0.5, FIND(&bad));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, good, radius, NAN, FIND(&bad));
  CHECK_MESSAGE("options->radius is");
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, good, radius, INFINITY, FIND(&bad));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, good, radius, -1, FIND(&bad));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, good, radius, 1e308, FIND(&bad));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, good, flags, 2, FIND(&bad));
  CHECK_REFUSES(DSW_STATUS_BAD_STRUCT_SIZE, good, struct_size, 3, FIND(&bad));
#undef FIND
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_find_near_rows(NULL, wire, &good, &count));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_find_near_rows(g_scene, stale, &good, &count));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_find_near_rows(g_scene, null_body, &good, &count));
  /* A refused call keeps the rows and writes no count. */
  CHECK(count == 0 && rows_of(wire, &r) == 3);

#define READ(function, out)                                                     \
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, function(NULL, wire, out, &count));     \
  CHECK_FAILS(DSW_STATUS_STALE_ID, function(g_scene, stale, out, &count));      \
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, function(g_scene, wire, NULL, &count)); \
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, function(g_scene, wire, out, NULL))
  READ(dsw_body_get_near_rows, &r);
  READ(dsw_body_get_near_offsets, &numbers);
  READ(dsw_body_get_near_columns, &numbers);
  READ(dsw_body_get_near_values, &values);
#undef READ
  CHECK_OK(dsw_body_destroy(g_scene, wire));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_near_rows(g_scene, wire, &r, &count));
  end_stage();
}

/* A new body in the slot of one that had rows has none. */
static void rows_go_with_their_body(void) {
  const dsw_near_row *r = NULL;
  dsw_body_id wire;
  begin_stage(3);
  wire = make_wire();
  CHECK(find(wire, 0.375, 0, &r) == 3);
  CHECK_OK(dsw_body_destroy(g_scene, wire));
  wire = make_line(g_wire, 2, DSW_LEVEL_EDGES_SWEPT);
  CHECK(rows_of(wire, &r) == 0);
  CHECK(find(wire, 0.375, 0, &r) == 3 && r[0].previous == NONE);
  end_stage();
}

int main(void) {
  unsigned dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    a_wire_near_walls_and_an_edge(dimension);
    margin_and_radius_add_up(dimension);
    rows_are_followed(dimension);
    a_row_of_the_next_cell_takes_over(dimension);
    the_jacobian_has_weights_times_normals(dimension);
    an_empty_jacobian_has_one_offset(dimension);
    a_body_rests_in_a_corner(dimension);
    only_parts_of_the_level_have_rows(dimension);
    arguments_that_are_refused(dimension);
  }
  marked_edges_and_vertices_are_obstacles();
  a_wall_hides_what_is_behind();
  other_bodies_are_near();
  a_deformed_environment_is_seen_anew();
  rows_go_with_their_body();
  return check_result();
}
