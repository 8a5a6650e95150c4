/* surgery.h: cuts, tears and ties of a block of cells, what they return, every way to be refused, and what bodies say
   to it. What holds in space and in the plane alike runs in both. */
#include <math.h>
#include <string.h>

#include "block.h"
#include "check.h"

static void begin(void) { begin_block(NULL, 1, 0); }

static size_t vertex_count(const dsw_vertex_origin **vertices) {
  const dsw_change change = change_of(g_env);
  *vertices = change.vertices;
  return change.vertex_count;
}
static size_t whole_count(const dsw_volume_id **volumes) {
  const dsw_change change = change_of(g_env);
  *volumes = change.whole;
  return change.whole_count;
}

static void a_cut_right_through(void) {
  const block_numbers b = g_block;
  const dsw_vertex_origin *v = NULL;
  const dsw_volume_id *whole = NULL;
  const dsw_volume_change *changes = NULL;
  size_t i, count = 0;
  begin();
  CHECK(keep_faces() == 0 && vertex_count(&v) == 0 && whole_count(&whole) == 0);
  cut(blade_at(1.25, 5), 0);
  CHECK(g_cut.volumes_crossed == b.layer && g_cut.volumes_split == b.layer && g_cut.volumes_changed == b.layer);
  CHECK(g_cut.whole_count == 0 && whole_count(&whole) == 0 && g_cut.distance == 0);
  CHECK(g_cut.vertex_count == b.corners && vertex_count(&v) == b.corners);
  CHECK(g_cut.face_count == b.layer && keep_faces() == b.layer);
  CHECK(g_cut.volumes_visited >= b.layer && g_cut.volumes_visited <= b.layer + b.layer / 4);
  for (i = 0; i < b.corners; ++i) {
    CHECK(x_of(v[i].vertex) == 1.25 && x_of(v[i].from[0]) == 1 && x_of(v[i].from[1]) == 2); /* 1 is behind */
    CHECK(v[i].weights[0] == 0.75 && v[i].weights[1] == 0.25);
  }
  for (i = 0; i < b.layer; ++i) {
    CHECK(g_faces[i].front.volume % 4 == 1 && g_faces[i].front.volume < b.cells); /* keeps its index */
    CHECK(g_faces[i].back.volume >= b.cells);
  }
  changes = change_of(g_env).volumes;
  count = change_of(g_env).volume_count;
  CHECK(count == 2 * b.layer && changes[0].before.index == changes[1].before.index);
  CHECK(fly(0.5, 0.5, 3.5, 3.5) == 1);
  end_block(b.cells + b.layer, b.boundary + b.rim, 1);
}

static void a_crack(void) {
  const block_numbers b = g_block;
  dsw_face_id front[16], back[16];
  size_t i;
  begin();
  cut(blade_at(1.25, 5), DSW_CUT_UNSEW);
  CHECK(info_of(g_env).part_count == 2 && info_of(g_env).boundary_face_count == b.boundary + b.rim + 2 * b.layer);
  CHECK(keep_faces() == b.layer);
  CHECK(fly(0.25, 0.5, 2.25, 0.5) == 0.5);
  for (i = 0; i < b.layer; ++i) front[i] = g_faces[i].front, back[i] = g_faces[i].back;
  CHECK_OK(dsw_environment_sew_faces(g_env, front, back, b.layer));
  end_block(b.cells + b.layer, b.boundary + b.rim, 1);
}

static void along_faces(void) {
  const block_numbers b = g_block;
  size_t i;
  begin();
  cut(blade_at(2, 5), 0);
  CHECK(g_cut.volumes_split == 0 && g_cut.whole_count == 0 && g_cut.vertex_count == 0);
  CHECK(keep_faces() == b.layer);
  for (i = 0; i < b.layer; ++i) CHECK(g_faces[i].front.volume % 4 == 2 && g_faces[i].back.volume % 4 == 1);
  cut(blade_at(2.001, 5), DSW_CUT_UNSEW); /* within a hundredth of an edge */
  CHECK(g_cut.face_count == b.layer && g_cut.volumes_changed == 0 && fabs(g_cut.distance - 0.001) < 1e-12);
  end_block(b.cells, b.boundary + 2 * b.layer, 2);
}

static void up_to_the_last_volume_that_is_crossed(void) {
  const block_numbers b = g_block;
  const dsw_volume_id *whole = NULL;
  dsw_cell_type type = DSW_CELL_TYPE_NONE;
  uint32_t vertices = 0, i;
  begin();
  cut(blade_at(1.25, 2.5), 0);
  CHECK(g_cut.volumes_crossed == b.layer / 4 * 3 && g_cut.volumes_split == b.layer / 2);
  CHECK(g_cut.volumes_changed == b.layer / 4 * 3 && whole_count(&whole) == b.layer / 4);
  for (i = 0; i < b.layer / 4; ++i) {
    CHECK(whole[i].index % 4 == 1 && whole[i].index / 4 % 4 == 2 && whole[i].generation == 2);
    CHECK_OK(dsw_environment_get_volume_counts(g_env, whole[i], &type, &vertices, NULL, NULL));
    CHECK(b.dimension == 3 ? type == DSW_CELL_TYPE_POLYHEDRON : type == DSW_CELL_TYPE_POLYGON && vertices == 5);
  }
  end_block(b.cells + b.layer / 2, b.boundary + b.rim / 2, 1);
}

static void nothing_to_cut(void) {
  const block_numbers b = g_block;
  dsw_cut_desc d = blade_at(7, 5);
  unsigned i;
  begin();
  cut(d, 0);
  CHECK(g_cut.volumes_crossed == 0 && g_cut.volumes_visited == 0 && g_cut.face_count == 0);
  d.start = no_volume;
  CHECK_OK(dsw_environment_cut(g_env, &d, NULL));
  d = blade_at(1.25, 5);
  for (i = 1; i < 4; ++i) memcpy(g_blade + b.dimension * i, g_blade, b.dimension * sizeof(double)); /* one point */
  cut(d, 0);
  CHECK(g_cut.volumes_split == 0);
  for (i = 0; i < 12; ++i) g_blade[i] = 0.5; /* one point, inside */
  cut(d, 0);
  CHECK(g_cut.volumes_crossed == 1 && g_cut.whole_count == 1 && g_cut.volumes_changed == 0);
  for (i = 0; i < 12; ++i) g_blade[i] = i % 2 == 0 ? 1e300 : -1e300;
  cut(d, 0);
  end_block(b.cells, b.boundary, 1);
}

static void a_tear_replaces_what_the_cut_said(void) {
  const block_numbers b = g_block;
  const dsw_vertex_origin *vertices = NULL;
  dsw_change change = empty_change();
  begin();
  cut(blade_at(1.25, 5), 0);
  CHECK(vertex_count(&vertices) == b.corners);
  CHECK_OK(dsw_environment_tear_faces(g_env, NULL, NULL, 0, 1, &change));
  CHECK(vertex_count(&vertices) == 0 && change.vertex_count == 0 && change.distance == 0 && change.face_count == 0);
  end_block(b.cells + b.layer, b.boundary + b.rim, 1);
}

static void tears(void) {
  const block_numbers b = g_block;
  dsw_face_id faces[4];
  double loads[4] = {2, 2, 1, 9};
  dsw_change change = empty_change();
  begin();
  faces[0] = face_at(0, FACE_X1);
  faces[1] = face_at(1, b.x0); /* the same */
  faces[2] = face_at(1, FACE_X1);
  faces[3] = face_at(0, b.x0); /* on the outer boundary */
  CHECK_OK(dsw_environment_tear_faces(g_env, faces, loads, 4, 1, &change));
  CHECK(change.face_count == 1 && keep_faces() == 1 && info_of(g_env).boundary_face_count == b.boundary + 2);
  CHECK(g_faces[0].front.volume == 0 && g_faces[0].back.volume == 1);
  loads[2] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_tear_faces(g_env, faces, loads, 4, 1, &change));
  CHECK_MESSAGE("loads[2]");
  loads[2] = HUGE_VAL;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_tear_faces(g_env, faces, loads, 4, NAN, &change));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_tear_faces(g_env, NULL, loads, 4, 1, &change));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_tear_faces(g_env, faces, NULL, 4, 1, &change));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_tear_faces(NULL, faces, loads, 4, 1, &change));
  faces[3] = face_at(b.cells, b.x0);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_tear_faces(g_env, faces, loads, 4, 1, &change));
  CHECK(keep_faces() == 1);
  CHECK_OK(dsw_environment_tear_faces(g_env, faces, loads, 3, 1, NULL));
  end_block(b.cells, b.boundary + 4, 1);
}

static void bad_arguments(void) {
  dsw_cut_desc d = blade_at(1.25, 5), bad;
  dsw_change change = empty_change();
  const int plane = g_block.dimension == 2;
  begin();
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cut(NULL, &d, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cut(g_env, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_change(NULL, &change));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_change(g_env, NULL));
  change.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_get_change(g_env, &change));
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_cut(g_env, &d, &change));
  CHECK(change_of(g_env).face_count == 0 && change.face_count == 0);
  CHECK_REFUSES(DSW_STATUS_NULL_ARGUMENT, d, points, NULL, dsw_environment_cut(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_BAD_STRUCT_SIZE, d, struct_size, 8, dsw_environment_cut(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, d, flags, 2, dsw_environment_cut(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, rows, 1, dsw_environment_cut(g_env, &bad, NULL));
  CHECK_MESSAGE("desc->rows is 1");
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, columns, plane ? 2 : 0, dsw_environment_cut(g_env, &bad, NULL));
  if (plane) CHECK_MESSAGE("1 in the plane");
  bad = d, bad.rows = 1u << (plane ? 28 : 20), bad.columns = plane ? 1 : 1u << 20;
  CHECK_FAILS(DSW_STATUS_TOO_LARGE, dsw_environment_cut(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, snap, 0.26, dsw_environment_cut(g_env, &bad, NULL));
  bad.snap = NAN;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_cut(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_STALE_ID, d, start, volume_at(g_block.cells), dsw_environment_cut(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_WRONG_SIZE, d, point_stride_bytes, plane ? 8 : 20, dsw_environment_cut(g_env, &bad, NULL));
  g_blade[plane ? 3 : 7] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_cut(g_env, &d, NULL));
  CHECK_MESSAGE(plane ? "desc->points[1]" : "desc->points[2]");
  end_block(g_block.cells, g_block.boundary, 1);
}

static void borrowed_points(void) {
  dsw_cut_desc d = blade_at(1.25, 5);
  begin_block(NULL, 1, DSW_ENVIRONMENT_BORROW_POINTS);
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_cut(g_env, &d, NULL));
  cut(blade_at(2, 5), DSW_CUT_UNSEW); /* needs no vertices */
  CHECK(keep_faces() == g_block.layer);
  end_block(g_block.cells, g_block.boundary + 2 * g_block.layer, 2);
}

static void bodies(void) {
  static const double in_space[6] = {0.5, 1.5, 1.5, 2.5, 1.4, 1.6}, in_plane[4] = {0.5, 1.5, 2.5, 1.4};
  const block_numbers b = g_block;
  const dsw_body_id *blocked = NULL;
  dsw_cut_desc d = blade_at(1.25, 5);
  const dsw_face_id face = face_at(b.dimension == 3 ? 4 * (1 + 4 * 1) : 4 * 1, FACE_X1); /* in the body's way */
  dsw_scene *scene, *second;
  dsw_body_id body;
  size_t count = 0;
  double load = 1;
  begin();
  scene = make_scene(g_env, 0);
  body = make_edge_body(scene, b.dimension == 3 ? in_space : in_plane, DSW_LEVEL_EDGES_SWEPT);
  d.flags = DSW_CUT_UNSEW;
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_cut(g_env, &d, NULL));
  CHECK_OK(dsw_scene_get_occupant_bodies(scene, &blocked, &count));
  CHECK(count == 1 && blocked[0].index == body.index);
  CHECK(info_of(g_env).volume_count == b.cells);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_tear_faces(g_env, &face, &load, 1, 0, NULL));
  cut(d, 0);
  CHECK(g_cut.volumes_split == b.layer);
  second = make_scene(g_env, 0);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_cut(g_env, &d, NULL));
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_tear_faces(g_env, &face, &load, 1, 0, NULL));
  CHECK_OK(dsw_scene_destroy(second));
  CHECK_OK(dsw_scene_destroy(scene));
  end_block(b.cells + b.layer, b.boundary + b.rim, 1);
}

static void running_out_of_memory(void) {
  const block_numbers b = g_block;
  host h;
  dsw_context *const context = make_context(&h);
  const dsw_cut_desc d = blade_at(1.25, 2.5);
  size_t refusals = 0;
  begin_block(context, 1, 0);
  for (; RUNS_OUT(&h, refusals, dsw_environment_cut(g_env, &d, NULL)); ++refusals) {
    CHECK(info_of(g_env).volume_count == b.cells);
  }
  CHECK(refusals > (b.dimension == 3 ? 100u : 50u));
  end_block(b.cells + b.layer / 2, b.boundary + b.rim / 2, 1);
  end_context(context, &h);
}

/* In space. */
static void marked_edges_are_cut_in_two(void) {
  dsw_cut_desc d = blade_at(1.25, 5);
  size_t before = 0, after = 0;
  uint32_t local;
  begin();
  for (local = 0; local < 12; ++local) {
    const dsw_edge_id edge = edge_at(1, local);
    CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_IMPASSABLE));
  }
  CHECK_OK(dsw_environment_get_mark_count(g_env, DSW_CELL_EDGE, &before));
  d.start = no_volume; /* and no point of the blade is in any */
  cut(d, 0);
  CHECK(g_cut.volumes_split == 16);
  CHECK_OK(dsw_environment_get_mark_count(g_env, DSW_CELL_EDGE, &after));
  CHECK(before == 12 && after == 16);
  end_block(80, 112, 1);
}

/* In the plane, from here on: a path that turns inside of a square is cut short there; how far is told. */
static void a_bend(void) {
  dsw_cut_desc d = blade_at(1.25, 1.5);
  begin();
  g_blade[4] = 5;
  g_blade[5] = 1.5;
  d.rows = 3;
  cut(d, 0);
  CHECK(g_cut.volumes_crossed == 4 && g_cut.volumes_split == 4 && g_cut.vertex_count == 5);
  CHECK(fabs(g_cut.distance - 0.375 / hypot(0.75, 0.5)) < 1e-15);
  end_block(20, 18, 1);
}

static void ties(void) {
  static const double across[4] = {-1, 1.3, 5, 1.4}, short_of_it[4] = {0.5, 1.3, 5, 1.4};
  dsw_tie_desc d;
  dsw_change report = empty_change();
  begin();
  dsw_tie_desc_init(&d, sizeof d);
  d.points = across;
  d.point_count = 2;
  CHECK_OK(dsw_environment_tie(g_env, &d, &report));
  CHECK(report.is_closed == 1 && report.volumes_split == 4 && report.face_count == 4);
  CHECK(fly(0.5, 0.5, 0.5, 3) < 1 && fly(3.9, 3.5, 0.1, 0.1) < 1);
  end_block(20, 26, 2);
  begin();
  d.points = short_of_it;
  CHECK_OK(dsw_environment_tie(g_env, &d, &report));
  CHECK(report.is_closed == 0 && report.whole_count == 1);
  CHECK(fly(0.5, 0.5, 0.5, 3) < 1);
  d.point_count = 1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_tie(g_env, &d, &report));
  CHECK_OK(dsw_environment_check(g_env, NULL));
  drop_block();
}

static void shapes_are_carved(void) {
  static const double points[8] = {0.6, 0.6, 3.4, 0.6, 3.4, 3.4, 0.6, 3.4};
  static const uint32_t sides[8] = {0, 1, 1, 2, 2, 3, 3, 0}, open_sides[6] = {0, 1, 1, 2, 2, 3};
  dsw_carve_desc d;
  dsw_change report = empty_change();
  dsw_volume_id all[16];
  uint32_t i;
  begin();
  for (i = 0; i < 16; ++i) all[i] = volume_at(i);
  CHECK_OK(dsw_environment_mark_volumes(g_env, all, 16, DSW_MARK_IMPASSABLE, 0, NULL));
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
  CHECK(report.volumes_split == 12 && report.vertex_count == 12 && report.carved_count == 16);
  CHECK(fly(0.9, 0.9, 3.1, 3.1) == 1 && fly(2, 2, 2, 0) < 0.71);
  end_block(28, 16, 1);
}

static void recordings_make_it_again(void) {
  static const double line[4] = {-1, 1.3, 5, 1.4}, square[8] = {2.2, 2.2, 2.8, 2.2, 2.8, 2.8, 2.2, 2.8};
  static const uint32_t sides[8] = {0, 1, 1, 2, 2, 3, 3, 0};
  const dsw_volume_id wall = volume_at(10);
  const dsw_face_id side = face_at(3, 2);
  const double load = 2;
  dsw_change change = empty_change();
  uint32_t calls = 0;
  dsw_scene *scene = NULL;
  static tape one;
  dsw_recording_desc recording = to_tape(&one);
  dsw_tie_desc tie;
  dsw_carve_desc carve;
  dsw_change carved = empty_change();
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  begin();
  CHECK_OK(dsw_environment_mark_volumes(g_env, &wall, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_scene_create(g_env, NULL, &scene));
  recording.flags = DSW_RECORDING_STATES;
  CHECK_OK(dsw_scene_start_recording(scene, &recording));
  dsw_carve_desc_init(&carve, sizeof carve);
  carve.points = square, carve.point_count = 4;
  carve.triangles = sides, carve.triangle_count = 4;
  CHECK_OK(dsw_environment_carve(g_env, &carve, &carved));
  CHECK(carved.carved_count == 1);
  dsw_tie_desc_init(&tie, sizeof tie);
  tie.points = line, tie.point_count = 2;
  CHECK_OK(dsw_environment_tie(g_env, &tie, NULL));
  CHECK_OK(dsw_environment_tear_faces(g_env, &side, &load, 1, 1, &change));
  CHECK(change.face_count == 1);
  cut(blade_at(1.25, 5), 0);
  CHECK_OK(dsw_scene_stop_recording(scene));
  CHECK_OK(dsw_replay_create(NULL, one.bytes, one.size, &replay));
  do {
    CHECK_OK(dsw_replay_step(replay, &report));
    CHECK(report.outcome == (calls < 4 ? DSW_REPLAY_SAME : DSW_REPLAY_END));
  } while (report.outcome == DSW_REPLAY_SAME && ++calls <= 4);
  CHECK(calls == 4);
  CHECK_OK(dsw_replay_destroy(replay));
  end_scene(scene);
}

static void in_both(void) {
  a_cut_right_through();
  a_crack();
  along_faces();
  up_to_the_last_volume_that_is_crossed();
  nothing_to_cut();
  a_tear_replaces_what_the_cut_said();
  tears();
  bad_arguments();
  borrowed_points();
  bodies();
  running_out_of_memory();
}

int main(void) {
  use_block(3);
  in_both();
  marked_edges_are_cut_in_two();
  use_block(2);
  in_both();
  a_bend();
  ties();
  shapes_are_carved();
  recordings_make_it_again();
  return check_result();
}
