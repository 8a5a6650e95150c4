/* surgery.h and carve.h in the plane: what a path of points cuts of a grid of squares, tears, ties, and shapes carved out. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

enum { kCells = 16 };

static dsw_environment *g_env; /* 4 x 4 squares, number x + 4 y */
static double g_path[6];
static dsw_cut_report g_report;
static dsw_cut_face g_faces[16];

static void begin(void) { g_env = make_squares(NULL, 4, 4); }

/* Upwards at x, from below everything; its front is on the right. */
static dsw_cut_desc path_at(double x, double y_end) {
  dsw_cut_desc d;
  g_path[0] = g_path[2] = x;
  g_path[1] = -1;
  g_path[3] = y_end;
  dsw_cut_desc_init(&d, sizeof d);
  d.points = g_path;
  d.rows = 2;
  d.columns = 1;
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

/* Keeps the faces of the last cut. */
static size_t keep_faces(void) {
  const dsw_cut_face *faces = NULL;
  size_t count = 0;
  CHECK_OK(dsw_environment_get_cut_faces(g_env, &faces, &count));
  CHECK(count <= 16);
  if (count != 0) memcpy(g_faces, faces, count * sizeof *faces);
  return count;
}

static void cut(dsw_cut_desc d, uint32_t flags) {
  d.flags = flags;
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
}

static double fly(double x, double y, double to_x, double to_y) {
  double from[2], to[2];
  dsw_flight flight;
  from[0] = x, from[1] = y;
  to[0] = to_x, to[1] = to_y;
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, to, NULL, &flight));
  return flight.outcome == DSW_OUTCOME_REACHED ? 1 : flight.time;
}

static double x_of(dsw_vertex_id v) {
  double at[2] = {0, 0};
  CHECK_OK(dsw_environment_get_position(g_env, v, at));
  return at[0];
}

static void a_cut_right_through(void) {
  const dsw_cut_vertex *vertices = NULL;
  const dsw_volume_change *changes = NULL;
  size_t i, count = 0;
  begin();
  cut(path_at(1.25, 5), 0);
  CHECK(g_report.volumes_crossed == 4 && g_report.volumes_split == 4 && g_report.volumes_changed == 4);
  CHECK(g_report.volumes_whole == 0 && g_report.distance == 0 && g_report.vertex_count == 5);
  CHECK(g_report.face_count == 4 && keep_faces() == 4 && g_report.volumes_visited <= 5);
  CHECK_OK(dsw_environment_get_cut_vertices(g_env, &vertices, &count));
  CHECK(count == 5);
  for (i = 0; i < count; ++i) {
    CHECK(x_of(vertices[i].vertex) == 1.25 && x_of(vertices[i].from[0]) == 1 && x_of(vertices[i].from[1]) == 2);
    CHECK(vertices[i].weights[0] == 0.75 && vertices[i].weights[1] == 0.25);
  }
  for (i = 0; i < 4; ++i) {
    CHECK(g_faces[i].front.volume % 4 == 1 && g_faces[i].front.volume < kCells); /* keeps its index */
    CHECK(g_faces[i].back.volume >= kCells);
  }
  CHECK_OK(dsw_environment_get_volume_changes(g_env, &changes, &count));
  CHECK(count == 8 && changes[0].before.index == changes[1].before.index);
  CHECK(fly(0.5, 0.5, 3.5, 3.5) == 1);
  end(20, 18, 1);
}

static void a_crack(void) {
  dsw_face_id a[4], b[4];
  size_t i;
  begin();
  cut(path_at(1.25, 5), DSW_CUT_UNSEW);
  CHECK(info().part_count == 2 && info().boundary_face_count == 26 && keep_faces() == 4);
  CHECK(fly(0.25, 0.5, 2.25, 0.5) == 0.5);
  for (i = 0; i < 4; ++i) {
    a[i] = g_faces[i].front;
    b[i] = g_faces[i].back;
  }
  CHECK_OK(dsw_environment_sew_faces(g_env, a, b, 4));
  end(20, 18, 1);
}

static void along_sides(void) {
  size_t i;
  begin();
  cut(path_at(2, 5), 0);
  CHECK(g_report.volumes_split == 0 && g_report.volumes_whole == 0 && g_report.vertex_count == 0);
  CHECK(keep_faces() == 4);
  for (i = 0; i < 4; ++i) CHECK(g_faces[i].front.volume % 4 == 2 && g_faces[i].back.volume % 4 == 1);
  cut(path_at(2.001, 5), DSW_CUT_UNSEW); /* within a hundredth of a side */
  CHECK(g_report.face_count == 4 && g_report.volumes_changed == 0 && fabs(g_report.distance - 0.001) < 1e-12);
  end(16, 24, 2);
}

static void up_to_the_last_volume_that_is_crossed(void) {
  const dsw_volume_id *whole = NULL;
  dsw_cell_type type = DSW_CELL_TYPE_NONE;
  uint32_t vertices = 0;
  size_t count = 0;
  begin();
  cut(path_at(1.25, 2.5), 0);
  CHECK(g_report.volumes_crossed == 3 && g_report.volumes_split == 2 && g_report.volumes_changed == 3);
  CHECK_OK(dsw_environment_get_whole_volumes(g_env, &whole, &count));
  CHECK(count == 1 && whole[0].index == 9 && whole[0].generation == 2);
  CHECK_OK(dsw_environment_get_volume_counts(g_env, whole[0], &type, &vertices, NULL, NULL));
  CHECK(type == DSW_CELL_TYPE_POLYGON && vertices == 5);
  end(18, 17, 1);
}

/* A path that turns inside of a square is cut short there; how far is told. */
static void a_bend(void) {
  dsw_cut_desc d = path_at(1.25, 1.5);
  begin();
  g_path[4] = 5;
  g_path[5] = 1.5;
  d.rows = 3;
  cut(d, 0);
  CHECK(g_report.volumes_crossed == 4 && g_report.volumes_split == 4 && g_report.vertex_count == 5);
  CHECK(fabs(g_report.distance - 0.375 / hypot(0.75, 0.5)) < 1e-15);
  end(20, 18, 1);
}

static void nothing_to_cut(void) {
  dsw_cut_desc d = path_at(7, 5);
  unsigned i;
  begin();
  cut(d, 0);
  CHECK(g_report.volumes_crossed == 0 && g_report.volumes_visited == 16 && g_report.face_count == 0);
  d.start = no_volume;
  cut(d, 0);
  g_path[0] = g_path[1] = g_path[2] = g_path[3] = 0.5; /* one point, inside */
  cut(d, 0);
  CHECK(g_report.volumes_crossed == 1 && g_report.volumes_whole == 1 && g_report.volumes_changed == 0);
  for (i = 0; i < 4; ++i) g_path[i] = i % 2 == 0 ? 1e300 : -1e300;
  cut(d, 0);
  end(16, 16, 1);
}

static void tears(void) {
  dsw_face_id faces[4];
  double loads[4] = {2, 2, 1, 9};
  size_t count = 99;
  begin();
  faces[0] = face_at(0, 1);
  faces[1] = face_at(1, 3); /* the same */
  faces[2] = face_at(1, 1);
  faces[3] = face_at(0, 3); /* on the outer boundary */
  CHECK_OK(dsw_environment_tear_faces(g_env, faces, loads, 4, 1, &count));
  CHECK(count == 1 && keep_faces() == 1 && g_faces[0].front.volume == 0 && g_faces[0].back.volume == 1);
  loads[2] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_tear_faces(g_env, faces, loads, 4, 1, &count));
  faces[3] = face_at(16, 0);
  loads[2] = 1;
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_tear_faces(g_env, faces, loads, 4, 1, &count));
  end(16, 18, 1);
}

static void ties(void) {
  static const double across[4] = {-1, 1.3, 5, 1.4}, short_of_it[4] = {0.5, 1.3, 5, 1.4};
  dsw_tie_desc d;
  dsw_tie_report report;
  begin();
  dsw_tie_desc_init(&d, sizeof d);
  d.points = across;
  d.point_count = 2;
  CHECK_OK(dsw_environment_tie(g_env, &d, &report));
  CHECK(report.is_closed == 1 && report.cut.volumes_split == 4 && report.cut.face_count == 4);
  CHECK(fly(0.5, 0.5, 0.5, 3) < 1 && fly(3.9, 3.5, 0.1, 0.1) < 1);
  end(20, 26, 2);
  begin();
  d.points = short_of_it;
  CHECK_OK(dsw_environment_tie(g_env, &d, &report));
  CHECK(report.is_closed == 0 && report.cut.volumes_whole == 1);
  CHECK(fly(0.5, 0.5, 0.5, 3) < 1);
  d.point_count = 1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_tie(g_env, &d, &report));
  CHECK_OK(dsw_environment_check(g_env, NULL));
  CHECK_OK(dsw_environment_destroy(g_env));
}

static void shapes_are_carved(void) {
  static const double points[8] = {0.6, 0.6, 3.4, 0.6, 3.4, 3.4, 0.6, 3.4};
  static const uint32_t sides[8] = {0, 1, 1, 2, 2, 3, 3, 0}, open_sides[6] = {0, 1, 1, 2, 2, 3};
  dsw_carve_desc d;
  dsw_carve_report report;
  dsw_volume_id all[kCells];
  uint32_t i;
  begin();
  for (i = 0; i < kCells; ++i) all[i] = volume_at(i);
  CHECK_OK(dsw_environment_mark_volumes(g_env, all, kCells, DSW_MARK_IMPASSABLE, 0, NULL));
  dsw_carve_desc_init(&d, sizeof d);
  d.points = points;
  d.point_count = 4;
  d.triangles = open_sides;
  d.triangle_count = 3;
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_carve(g_env, &d, &report));
  CHECK_MESSAGE("segment");
  d.triangles = sides;
  d.triangle_count = 4;
  CHECK_OK(dsw_environment_carve(g_env, &d, &report));
  CHECK(report.cut.volumes_split == 12 && report.cut.vertex_count == 12 && report.volumes_carved == 16);
  CHECK(fly(0.9, 0.9, 3.1, 3.1) == 1 && fly(2, 2, 2, 0) < 0.71);
  end(28, 16, 1);
}

static void bad_arguments(void) {
  dsw_cut_desc d = path_at(1.25, 5), bad;
  begin();
  bad = d, bad.columns = 2;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_cut(g_env, &bad, NULL));
  CHECK_MESSAGE("1 in the plane");
  bad = d, bad.rows = 1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.rows = 1u << 28;
  CHECK_FAILS(DSW_STATUS_TOO_LARGE, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.snap = 0.26;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.start = volume_at(16);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.point_stride_bytes = 8;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_cut(g_env, &bad, NULL));
  bad = d, bad.points = NULL;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cut(g_env, &bad, NULL));
  g_path[3] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_cut(g_env, &d, NULL));
  CHECK_MESSAGE("desc->points[1]");
  end(16, 16, 1);
}

static void begin_borrowed(void) {
  static double points[50];
  uint32_t cells[4 * kCells];
  dsw_environment_desc d;
  uint32_t i;
  for (i = 0; i < 25; ++i) {
    points[2 * i] = i % 5;
    points[2 * i + 1] = i / 5;
  }
  for (i = 0; i < kCells; ++i) {
    const uint32_t first = i % 4 + 5 * (i / 4), corners[4] = {0, 1, 6, 5};
    unsigned k;
    for (k = 0; k < 4; ++k) cells[4 * i + k] = first + corners[k];
  }
  dsw_environment_desc_init(&d, sizeof d);
  d.dimension = 2;
  d.points = points;
  d.point_count = 25;
  d.uniform_cell_type = DSW_CELL_TYPE_QUAD;
  d.cell_count = kCells;
  d.index_bytes = 4;
  d.connectivity = cells;
  d.connectivity_count = 4 * kCells;
  d.flags = DSW_ENVIRONMENT_BORROW_POINTS;
  CHECK_OK(dsw_environment_create(NULL, &d, &g_env, NULL));
}

static unsigned char g_tape[65536];
static size_t g_recorded;

static int write_tape(void *user, const void *bytes, size_t size) {
  (void)user;
  if (g_recorded + size > sizeof g_tape) return 1;
  memcpy(g_tape + g_recorded, bytes, size);
  g_recorded += size;
  return 0;
}

static void recordings_make_it_again(void) {
  static const double line[4] = {-1, 1.3, 5, 1.4}, square[8] = {2.2, 2.2, 2.8, 2.2, 2.8, 2.8, 2.2, 2.8};
  static const uint32_t sides[8] = {0, 1, 1, 2, 2, 3, 3, 0};
  const dsw_volume_id wall = volume_at(10);
  const dsw_face_id side = face_at(3, 2);
  const double load = 2;
  size_t torn = 0;
  uint32_t calls = 0;
  dsw_scene *scene = NULL;
  dsw_recording_desc to_tape;
  dsw_tie_desc tie;
  dsw_carve_desc carve;
  dsw_carve_report carved;
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  begin();
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_scene_create(g_env, NULL, &scene));
  dsw_recording_desc_init(&to_tape, sizeof to_tape);
  to_tape.write = write_tape;
  to_tape.flags = DSW_RECORDING_STATES;
  CHECK_OK(dsw_scene_start_recording(scene, &to_tape));
  dsw_carve_desc_init(&carve, sizeof carve);
  carve.points = square, carve.point_count = 4;
  carve.triangles = sides, carve.triangle_count = 4;
  CHECK_OK(dsw_environment_carve(g_env, &carve, &carved));
  CHECK(carved.volumes_carved == 1);
  dsw_tie_desc_init(&tie, sizeof tie);
  tie.points = line, tie.point_count = 2;
  CHECK_OK(dsw_environment_tie(g_env, &tie, NULL));
  CHECK_OK(dsw_environment_tear_faces(g_env, &side, &load, 1, 1, &torn));
  CHECK(torn == 1);
  cut(path_at(1.25, 5), 0);
  CHECK_OK(dsw_scene_stop_recording(scene));
  CHECK_OK(dsw_replay_create(NULL, g_tape, g_recorded, &replay));
  do {
    CHECK_OK(dsw_replay_step(replay, &report));
    CHECK(report.outcome == (calls < 4 ? DSW_REPLAY_SAME : DSW_REPLAY_END));
  } while (report.outcome == DSW_REPLAY_SAME && ++calls <= 4);
  CHECK(calls == 4);
  CHECK_OK(dsw_replay_destroy(replay));
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_environment_destroy(g_env));
}

static void borrowed_points(void) {
  dsw_cut_desc d = path_at(1.25, 5);
  begin_borrowed();
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_cut(g_env, &d, NULL));
  cut(path_at(2, 5), DSW_CUT_UNSEW); /* needs no vertices */
  CHECK(keep_faces() == 4);
  end(16, 24, 2);
}

int main(void) {
  a_cut_right_through();
  a_crack();
  along_sides();
  up_to_the_last_volume_that_is_crossed();
  a_bend();
  nothing_to_cut();
  tears();
  ties();
  shapes_are_carved();
  bad_arguments();
  recordings_make_it_again();
  borrowed_points();
  return check_result();
}
