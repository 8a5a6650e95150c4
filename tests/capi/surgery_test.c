/* surgery.h: cuts and tears of a grid of cubes, what they return, every way to be refused, and what bodies say to it. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 4 x 4 cubes */
static double g_blade[12];     /* in the plane x = at, from y = -1 */
static dsw_cut_report g_report;

static void begin(dsw_context *context) { g_env = make_environment(context, 4, 4, 4); }

static dsw_cut_desc blade_at(double x, double y_end) {
  dsw_cut_desc d;
  unsigned i;
  for (i = 0; i < 4; ++i) {
    g_blade[3 * i] = x;
    g_blade[3 * i + 1] = i % 2 == 0 ? -1 : y_end;
    g_blade[3 * i + 2] = i < 2 ? -1 : 5;
  }
  dsw_cut_desc_init(&d, sizeof d);
  d.points = g_blade;
  d.rows = d.columns = 2;
  d.start = volume_at(0);
  return d;
}

static dsw_environment_info info(void) {
  dsw_environment_info i;
  i.struct_size = sizeof i;
  CHECK_OK(dsw_environment_get_info(g_env, &i));
  return i;
}

static void end(uint32_t volumes, uint32_t boundary, uint32_t parts) {
  const dsw_environment_info i = info();
  CHECK(i.volume_count == volumes && i.boundary_face_count == boundary && i.part_count == parts);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  CHECK_OK(dsw_environment_destroy(g_env));
}

static size_t face_count(const dsw_cut_face **faces) {
  size_t count = 999;
  CHECK_OK(dsw_environment_get_cut_faces(g_env, faces, &count));
  return count;
}
static size_t vertex_count(const dsw_cut_vertex **vertices) {
  size_t count = 999;
  CHECK_OK(dsw_environment_get_cut_vertices(g_env, vertices, &count));
  return count;
}
static size_t whole_count(const dsw_volume_id **volumes) {
  size_t count = 999;
  CHECK_OK(dsw_environment_get_whole_volumes(g_env, volumes, &count));
  return count;
}

static void a_cut_right_through(void) {
  const dsw_cut_face *faces = NULL;
  const dsw_cut_vertex *vertices = NULL;
  const dsw_volume_id *whole = NULL;
  const dsw_volume_change *changes = NULL;
  const double *points = NULL;
  dsw_cut_desc d = blade_at(1.25, 5);
  size_t i, count = 0;
  begin(NULL);
  CHECK(face_count(&faces) == 0 && vertex_count(&vertices) == 0 && whole_count(&whole) == 0);
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK(g_report.volumes_crossed == 16 && g_report.volumes_split == 16 && g_report.volumes_changed == 16);
  CHECK(g_report.volumes_whole == 0 && whole_count(&whole) == 0 && g_report.distance == 0);
  CHECK(g_report.vertex_count == 25 && vertex_count(&vertices) == 25);
  CHECK(g_report.face_count == 16 && face_count(&faces) == 16);
  CHECK(g_report.volumes_visited >= 16 && g_report.volumes_visited <= 20);
  CHECK_OK(dsw_environment_get_points(g_env, &points, &count));
  for (i = 0; i < 25; ++i) {
    const dsw_cut_vertex *v = &vertices[i];
    CHECK(points[3 * v->vertex.index] == 1.25 && v->weights[0] + v->weights[1] == 1);
    CHECK(points[3 * v->from[0].index] * v->weights[0] + points[3 * v->from[1].index] * v->weights[1] == 1.25);
    CHECK(points[3 * v->from[0].index] == 1); /* behind the blade */
  }
  for (i = 0; i < 16; ++i) {
    CHECK(faces[i].front.volume != faces[i].back.volume);
    CHECK(faces[i].front.volume % 4 == 1 && faces[i].front.volume < 64); /* keeps its index */
    CHECK(faces[i].back.volume >= 64);
  }
  CHECK_OK(dsw_environment_get_volume_changes(g_env, &changes, &count));
  CHECK(count == 32 && changes[0].before.index == changes[1].before.index);
  end(80, 112, 1);
}

static void a_crack(void) {
  dsw_cut_desc d = blade_at(1.25, 5);
  const dsw_cut_face *faces = NULL;
  dsw_face_id a[16], b[16];
  size_t i;
  begin(NULL);
  d.flags = DSW_CUT_UNSEW;
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK(info().part_count == 2 && info().boundary_face_count == 144);
  CHECK(face_count(&faces) == 16);
  for (i = 0; i < 16; ++i) {
    a[i] = faces[i].front;
    b[i] = faces[i].back;
  }
  CHECK_OK(dsw_environment_sew_faces(g_env, a, b, 16));
  end(80, 112, 1);
}

static void along_faces(void) {
  dsw_cut_desc d = blade_at(2, 5);
  const dsw_cut_face *faces = NULL;
  size_t i;
  begin(NULL);
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK(g_report.volumes_split == 0 && g_report.volumes_whole == 0 && g_report.vertex_count == 0);
  CHECK(face_count(&faces) == 16);
  for (i = 0; i < 16; ++i) CHECK(faces[i].front.volume % 4 == 2 && faces[i].back.volume % 4 == 1);
  d.flags = DSW_CUT_UNSEW;
  d = blade_at(2.001, 5); /* within a hundredth of an edge */
  d.flags = DSW_CUT_UNSEW;
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK(g_report.face_count == 16 && g_report.volumes_changed == 0 && fabs(g_report.distance - 0.001) < 1e-12);
  end(64, 128, 2);
}

static void up_to_the_last_volume_that_is_crossed(void) {
  dsw_cut_desc d = blade_at(1.25, 2.5);
  const dsw_volume_id *whole = NULL;
  size_t i;
  dsw_cell_type type = DSW_CELL_TYPE_NONE;
  begin(NULL);
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK(g_report.volumes_crossed == 12 && g_report.volumes_split == 8 && g_report.volumes_changed == 12);
  CHECK(whole_count(&whole) == 4);
  for (i = 0; i < 4; ++i) {
    CHECK(whole[i].index % 4 == 1 && whole[i].index / 4 % 4 == 2 && whole[i].generation == 2);
    CHECK_OK(dsw_environment_get_volume_counts(g_env, whole[i], &type, NULL, NULL, NULL));
    CHECK(type == DSW_CELL_TYPE_POLYHEDRON);
  }
  end(72, 96 + 2 + 2 + 4, 1);
}

static void nothing_to_cut(void) {
  dsw_cut_desc d = blade_at(7, 5);
  unsigned i;
  begin(NULL);
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK(g_report.volumes_crossed == 0 && g_report.volumes_visited == 64 && g_report.face_count == 0);
  d.start = no_volume;
  CHECK_OK(dsw_environment_cut(g_env, &d, NULL));
  d = blade_at(1.25, 5);
  for (i = 0; i < 4; ++i) memcpy(g_blade + 3 * i, g_blade, 3 * sizeof(double)); /* one point */
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK(g_report.volumes_split == 0);
  for (i = 0; i < 12; ++i) g_blade[i] = 0.5; /* one point, inside */
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK(g_report.volumes_crossed == 1 && g_report.volumes_whole == 1 && g_report.volumes_changed == 0);
  for (i = 0; i < 12; ++i) g_blade[i] = i % 2 == 0 ? 1e300 : -1e300;
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  end(64, 96, 1);
}

static void wires_are_cut_in_two(void) {
  dsw_cut_desc d = blade_at(1.25, 5);
  size_t before = 0, after = 0;
  uint32_t local;
  begin(NULL);
  for (local = 0; local < 12; ++local) {
    dsw_edge_id edge;
    edge.volume = volume_at(1).index;
    edge.generation = volume_at(1).generation;
    edge.local = local;
    CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_IMPASSABLE));
  }
  CHECK_OK(dsw_environment_get_mark_count(g_env, DSW_CELL_EDGE, &before));
  d.start = no_volume; /* and no point of the blade is in any */
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK(g_report.volumes_split == 16);
  CHECK_OK(dsw_environment_get_mark_count(g_env, DSW_CELL_EDGE, &after));
  CHECK(before == 12 && after == 16);
  end(80, 112, 1);
}

static void a_tear_keeps_what_the_cut_said(void) {
  dsw_cut_desc d = blade_at(1.25, 5);
  const dsw_cut_vertex *vertices = NULL;
  size_t torn = 0;
  begin(NULL);
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK_OK(dsw_environment_tear_faces(g_env, NULL, NULL, 0, 1, &torn));
  CHECK(vertex_count(&vertices) == 25);
  end(80, 112, 1);
}

static void tears(void) {
  dsw_face_id faces[4];
  double loads[4] = {2, 2, 1, 9};
  const dsw_cut_face *torn = NULL;
  size_t count = 99;
  begin(NULL);
  faces[0] = face_at(0, FACE_X1);
  faces[1] = face_at(1, FACE_X0); /* the same */
  faces[2] = face_at(1, FACE_X1);
  faces[3] = face_at(0, FACE_X0); /* on the outer boundary */
  CHECK_OK(dsw_environment_tear_faces(g_env, faces, loads, 4, 1, &count));
  CHECK(count == 1 && face_count(&torn) == 1 && info().boundary_face_count == 98);
  CHECK(torn[0].front.volume == 0 && torn[0].back.volume == 1);
  loads[2] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_tear_faces(g_env, faces, loads, 4, 1, &count));
  CHECK_MESSAGE("loads[2]");
  loads[2] = HUGE_VAL;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_tear_faces(g_env, faces, loads, 4, NAN, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_tear_faces(g_env, NULL, loads, 4, 1, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_tear_faces(g_env, faces, NULL, 4, 1, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_tear_faces(NULL, faces, loads, 4, 1, &count));
  faces[3] = face_at(64, FACE_X0);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_tear_faces(g_env, faces, loads, 4, 1, &count));
  CHECK(face_count(&torn) == 1 && count == 1);
  CHECK_OK(dsw_environment_tear_faces(g_env, faces, loads, 3, 1, NULL));
  end(64, 100, 1);
}

static void bad_arguments(void) {
  dsw_cut_desc d = blade_at(1.25, 5), bad;
  dsw_cut_vertex none;
  const dsw_cut_vertex *vertices = &none;
  size_t count = 5;
  begin(NULL);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cut(NULL, &d, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cut(g_env, NULL, NULL));
  bad = d, bad.points = NULL;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.flags = 2;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.rows = 1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_cut(g_env, &bad, NULL));
  CHECK_MESSAGE("desc->rows is 1");
  bad = d, bad.columns = 0;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.rows = bad.columns = 1u << 20;
  CHECK_FAILS(DSW_STATUS_TOO_LARGE, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.snap = 0.26;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_cut(g_env, &bad, NULL));
  bad.snap = NAN;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.start = volume_at(64);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.point_stride_bytes = 20;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_cut(g_env, &bad, NULL));
  g_blade[7] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_cut(g_env, &d, NULL));
  CHECK_MESSAGE("desc->points[2]");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_cut_vertices(NULL, &vertices, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_cut_vertices(g_env, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_cut_vertices(g_env, &vertices, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_cut_faces(g_env, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_whole_volumes(g_env, NULL, &count));
  CHECK(vertices == &none && count == 5);
  end(64, 96, 1);
}

static void borrowed_points(void) {
  grid g = grid_create(4, 4, 4);
  dsw_environment_desc e = grid_desc(&g);
  dsw_cut_desc d = blade_at(1.25, 5);
  e.flags = DSW_ENVIRONMENT_BORROW_POINTS;
  CHECK_OK(dsw_environment_create(NULL, &e, &g_env, NULL));
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_cut(g_env, &d, NULL));
  d = blade_at(2, 5); /* needs no vertices */
  d.flags = DSW_CUT_UNSEW;
  CHECK_OK(dsw_environment_cut(g_env, &d, NULL));
  end(64, 128, 2);
  grid_destroy(&g);
}

static void bodies(void) {
  static const double across[6] = {0.5, 1.5, 1.5, 2.5, 1.4, 1.6};
  const dsw_body_id *blocked = NULL;
  dsw_cut_desc d = blade_at(1.25, 5);
  dsw_face_id face;
  dsw_scene *scene, *second;
  dsw_body_id body;
  size_t count = 0;
  double load = 1;
  begin(NULL);
  scene = make_scene(g_env, 0);
  body = make_edge_body(scene, across, DSW_LEVEL_EDGES_SWEPT);
  d.flags = DSW_CUT_UNSEW;
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_cut(g_env, &d, NULL));
  CHECK_OK(dsw_scene_get_occupant_bodies(scene, &blocked, &count));
  CHECK(count == 1 && blocked[0].index == body.index);
  CHECK(info().volume_count == 64);
  face = face_at(0 + 4 * (1 + 4 * 1), FACE_X1); /* in the body's way */
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_tear_faces(g_env, &face, &load, 1, 0, NULL));
  d.flags = 0;
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
  CHECK(g_report.volumes_split == 16);
  second = make_scene(g_env, 0);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_cut(g_env, &d, NULL));
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_tear_faces(g_env, &face, &load, 1, 0, NULL));
  CHECK_OK(dsw_scene_destroy(second));
  CHECK_OK(dsw_scene_destroy(scene));
  end(80, 112, 1);
}

static void running_out_of_memory(void) {
  host h;
  dsw_context *context;
  dsw_cut_desc d = blade_at(1.25, 2.5);
  dsw_status status = DSW_STATUS_OUT_OF_MEMORY;
  size_t n, refusals = 0;
  memset(&h, 0, sizeof h);
  context = make_context(&h);
  begin(context);
  for (n = 1; status == DSW_STATUS_OUT_OF_MEMORY && n < 20000; ++n) {
    h.refuse = h.calls + n;
    status = dsw_environment_cut(g_env, &d, NULL);
    h.refuse = 0;
    if (status != DSW_STATUS_OUT_OF_MEMORY) break;
    ++refusals;
    CHECK(info().volume_count == 64);
  }
  CHECK(status == DSW_STATUS_OK && refusals > 100);
  end(72, 104, 1);
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && h.broken == 0);
}

int main(void) {
  a_cut_right_through();
  a_crack();
  along_faces();
  up_to_the_last_volume_that_is_crossed();
  nothing_to_cut();
  wires_are_cut_in_two();
  a_tear_keeps_what_the_cut_said();
  tears();
  bad_arguments();
  borrowed_points();
  bodies();
  running_out_of_memory();
  return check_result();
}
