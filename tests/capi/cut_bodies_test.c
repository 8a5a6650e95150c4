/* Threads that a blade cuts, in space and in the plane. tests/property/threads_cut_test.cpp compares which edges are cut
   with exact truth. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 2 x 2 cubes, or 4 x 2 squares */
static dsw_scene *g_scene;
static unsigned g_dimension;
static double g_blade[12];

/* A point; the height counts in space alone. */
static double *put(double *at, double x, double y, double z) {
  at[0] = x;
  at[1] = y;
  if (g_dimension == 3) at[2] = z;
  return at + g_dimension;
}

static void begin(uint32_t features) {
  g_env = g_dimension == 3 ? make_environment(NULL, 4, 2, 2) : make_squares(NULL, 4, 2);
  g_scene = make_scene(g_env, features);
}

/* A blade in the plane of x, from y = low to y = high. */
static dsw_cut_desc blade_at(double x, double low, double high) {
  dsw_cut_desc d;
  double *next = g_blade;
  dsw_cut_desc_init(&d, sizeof d);
  next = put(next, x, low, -1);
  if (g_dimension == 3) next = put(next, x, low, 3);
  next = put(next, x, high, -1);
  if (g_dimension == 3) next = put(next, x, high, 3);
  d.points = g_blade;
  d.rows = 2;
  d.columns = g_dimension - 1;
  return d;
}

/* Vertices along x from 0.5 on, `step` apart, at y. */
static dsw_body_id make_thread(size_t count, double step, double y, double radius, uint32_t flags) {
  double at[48], *next = at;
  dsw_body_desc d;
  dsw_body_id id;
  size_t i;
  for (i = 0; i < count; ++i) next = put(next, 0.5 + step * (double)i, y, 0.75);
  d = line_desc(at, count, 0, DSW_LEVEL_EDGES_SWEPT);
  d.radius = radius;
  d.flags = flags;
  CHECK_OK(dsw_body_create(g_scene, &d, &id));
  return id;
}

static size_t cut(dsw_cut_desc d, const dsw_body_id *bodies, size_t count, const dsw_body_cut **cuts) {
  size_t done = 99, listed = 98;
  CHECK_OK(dsw_scene_cut_bodies(g_scene, &d, bodies, count, &done));
  CHECK_OK(dsw_scene_get_body_cuts(g_scene, cuts, &listed));
  CHECK(done == listed);
  return listed;
}

static void position(dsw_body_id body, uint32_t vertex, double *at) {
  double all[64 * 3];
  size_t count;
  CHECK_OK(dsw_body_get_positions(g_scene, body, all, 64, 0, NULL, &count));
  CHECK(vertex < count);
  memcpy(at, all + vertex * g_dimension, g_dimension * sizeof *at);
}

static void a_thread_has_two_ends_at_the_blade(uint32_t features, uint32_t flags) {
  const dsw_body_cut *cuts;
  dsw_body_edge_id edges[8];
  dsw_body_vertex_id ends[2];
  double at[3], to[48];
  dsw_body_id thread;
  dsw_move_report r;
  dsw_body_counts c;
  size_t count, i;
  int k;
  begin(features);
  thread = make_thread(4, 1, 1.25, 0, flags);
  CHECK_OK(dsw_body_get_edge_ids(g_scene, thread, edges, 8, &count));
  CHECK(cut(blade_at(1.75, 0, 2), NULL, 0, &cuts) == 1);
  CHECK(cuts[0].body.index == thread.index && cuts[0].body.generation == thread.generation);
  CHECK(memcmp(&cuts[0].edge, &edges[1], sizeof edges[1]) == 0 && cuts[0].edge_parameter == 0.25);
  CHECK(cuts[0].ends[0].index == 1 && cuts[0].ends[1].index == 2 && cuts[0].point[0] == 1.75 &&
        cuts[0].point[1] == 1.25);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_edge_ends(g_scene, thread, edges[1], ends));
  for (k = 0; k < 2; ++k) {
    CHECK(cuts[0].vertices[k].generation != 0 && cuts[0].parts[k].generation != 0);
    CHECK_OK(dsw_body_get_edge_ends(g_scene, thread, cuts[0].parts[k], ends));
    CHECK(ends[k].index == cuts[0].ends[k].index && ends[1 - k].index == cuts[0].vertices[k].index);
    position(thread, cuts[0].vertices[k].index, at);
    CHECK(k == 0 ? at[0] < 1.75 && at[0] > 1.7499 : at[0] > 1.75 && at[0] < 1.7501);
    CHECK(at[1] == 1.25);
  }
  c = body_counts(g_scene, thread);
  CHECK(c.vertex_count == 6 && c.edge_count == 4);
  /* Each half moves by itself now. */
  CHECK_OK(dsw_body_get_positions(g_scene, thread, to, 16, 0, NULL, &count));
  for (i = 0; i < 6; ++i) to[i * g_dimension + 1] = to[i * g_dimension] < 1.75 ? 0.25 : 1.75;
  CHECK_OK(dsw_body_move(g_scene, thread, to, count, 0, NULL, &r));
  CHECK(r.vertices_stopped == 0 && r.contact_count == 0);
  /* Nothing crosses the blade now. */
  CHECK(cut(blade_at(1.75, 0, 2), &thread, 1, &cuts) == 0);
  CHECK(cut(blade_at(0.75, 0, 0.125), &thread, 1, &cuts) == 0);
  CHECK(cut(blade_at(0.75, 0, 0.5), &thread, 1, &cuts) == 1 && cuts[0].ends[0].index == 0);
  end_scene(g_scene);
}

/* The shift decides: the blade moves by an infinitesimal bit along x first. */
static void a_blade_through_a_vertex_cuts_one_edge(void) {
  const dsw_body_cut *cuts;
  dsw_body_id thread;
  double at[3];
  begin(0);
  thread = make_thread(3, 1, 1.25, 0, 0);
  CHECK(cut(blade_at(1.5, 0, 2), &thread, 1, &cuts) == 1);
  CHECK(cuts[0].ends[0].index == 1 && cuts[0].edge_parameter == 0);
  CHECK(cuts[0].vertices[0].generation == 0 && cuts[0].parts[0].generation == 0);
  CHECK(cuts[0].vertices[1].generation != 0);
  position(thread, cuts[0].vertices[1].index, at);
  CHECK(at[0] > 1.5 && at[0] < 1.5001);
  CHECK(body_counts(g_scene, thread).edge_count == 2 && body_counts(g_scene, thread).vertex_count == 4);
  end_scene(g_scene);
}

static void a_folded_blade_leaves_pieces(void) {
  const dsw_body_cut *cuts;
  double path[18], *next = path;
  dsw_cut_desc d;
  dsw_body_id thread;
  static const double x[3] = {1, 1.5, 2};
  int i;
  begin(DSW_FEATURE_BODY_CONTACTS);
  thread = make_thread(2, 2.5, 0.75, 0, DSW_BODY_SELF_CONTACTS);
  /* Up at x = 1, down towards x = 2. */
  for (i = 0; i < 3; ++i) {
    next = put(next, x[i], i == 1 ? 1.75 : 0.25, -1);
    if (g_dimension == 3) next = put(next, x[i], i == 1 ? 1.75 : 0.25, 3);
  }
  dsw_cut_desc_init(&d, sizeof d);
  d.points = path;
  d.rows = 3;
  d.columns = g_dimension - 1;
  CHECK(cut(d, NULL, 0, &cuts) == 2);
  CHECK(cuts[0].edge_parameter < cuts[1].edge_parameter && cuts[0].edge.index == cuts[1].edge.index);
  /* The piece between belongs to both cuts. */
  CHECK(cuts[0].parts[1].generation != 0 && memcmp(&cuts[0].parts[1], &cuts[1].parts[0], sizeof cuts[0].parts[0]) == 0);
  CHECK(cuts[0].vertices[1].index != cuts[1].vertices[0].index);
  CHECK(body_counts(g_scene, thread).edge_count == 3 && body_counts(g_scene, thread).vertex_count == 6);
  end_scene(g_scene);
}

static void a_thick_thread_keeps_its_distance(double step, uint32_t flags) {
  const size_t count = step < 0.5 ? 16 : 4;
  const dsw_body_cut *cuts;
  dsw_body_id thread;
  double gap = -1;
  size_t size, i;
  static unsigned char block[1 << 18];
  dsw_scene *loaded;
  begin(DSW_FEATURE_BODY_CONTACTS);
  thread = make_thread(count, step, 1.25, 0.125, flags);
  CHECK(cut(blade_at(1.03125, 0, 2), NULL, 0, &cuts) == 1);
  for (i = 0; i < 2; ++i) CHECK((cuts[0].vertices[i].generation == 0) == (cuts[0].parts[i].generation == 0));
  CHECK((cuts[0].vertices[0].generation != 0) == (step >= 0.5));
  CHECK_OK(dsw_body_find_least_gap(g_scene, thread, 10, &gap));
  CHECK(gap > -1e-10);
  CHECK_OK(dsw_scene_save(g_scene, block, sizeof block, &size));
  CHECK_OK(dsw_scene_load(g_env, block, size, &loaded));
  CHECK_OK(dsw_scene_destroy(loaded));
  end_scene(g_scene);
}

static void triangles_go_with_their_edge(void) {
  static const double at[12] = {1.25, 0.5, 0.75, 1.25, 1.5, 0.75, 2.25, 0.5, 0.75, 2.25, 1.5, 0.75};
  static const uint32_t corners[6] = {0, 2, 1, 1, 2, 3}, offsets[3] = {0, 3, 6};
  const dsw_body_cut *cuts;
  dsw_body_desc d = surface_desc(at, 4, offsets, corners, 2, DSW_LEVEL_FACES);
  dsw_body_id leaf;
  dsw_body_counts c;
  size_t i, count;
  begin(DSW_FEATURE_BODY_CONTACTS);
  CHECK_OK(dsw_body_create(g_scene, &d, &leaf));
  count = cut(blade_at(1.5, 0.25, 1.75), NULL, 0, &cuts);
  CHECK(count == 3);
  for (i = 0; i < count; ++i) CHECK(cuts[i].parts[0].generation == 0 && cuts[i].parts[1].generation == 0);
  c = body_counts(g_scene, leaf);
  CHECK(c.vertex_count == 4 && c.edge_count == 2 && c.face_count == 0);
  end_scene(g_scene);
}

static void calls_are_replayed(void) {
  static tape t;
  const dsw_body_cut *cuts;
  dsw_recording_desc d;
  dsw_replay *replay;
  dsw_replay_report report;
  dsw_body_id thread;
  uint32_t steps = 0;
  begin(0);
  thread = make_thread(4, 1, 1.25, 0, 0);
  d = to_tape(&t);
  d.flags = DSW_RECORDING_STATES;
  CHECK_OK(dsw_scene_start_recording(g_scene, &d));
  CHECK(cut(blade_at(1.75, 0, 2), NULL, 0, &cuts) == 1);
  CHECK(cut(blade_at(2.125, 0, 2), &thread, 1, &cuts) == 1);
  CHECK_OK(dsw_scene_stop_recording(g_scene));
  CHECK_OK(dsw_replay_create(NULL, t.bytes, t.size, &replay));
  for (;;) {
    CHECK_OK(dsw_replay_step(replay, &report));
    if (report.function == NULL) break;
    CHECK(strcmp(report.function, "dsw_scene_cut_bodies") == 0 && report.differs == 0);
    ++steps;
  }
  CHECK(steps == 2);
  CHECK_OK(dsw_replay_destroy(replay));
  end_scene(g_scene);
}

static void a_refusal_of_memory_leaves_threads_whole(void) {
  host h = {0};
  dsw_context *context = make_context(&h);
  const dsw_body_cut *cuts;
  dsw_body_id threads[2];
  size_t refusals, count = 99;
  const dsw_cut_desc d = blade_at(1.75, 0, 2);
  g_env = g_dimension == 3 ? make_environment(context, 4, 2, 2) : make_squares(context, 4, 2);
  g_scene = make_scene(g_env, DSW_FEATURE_BODY_CONTACTS);
  threads[0] = make_thread(4, 1, 0.25, 0, 0);
  threads[1] = make_thread(4, 1, 1.25, 0, 0);
  for (refusals = 0; RUNS_OUT(&h, refusals, dsw_scene_cut_bodies(g_scene, &d, NULL, 0, &count)); ++refusals) {
    CHECK(count == 99 && body_counts(g_scene, threads[0]).edge_count == 3);
    CHECK(body_counts(g_scene, threads[1]).edge_count == 3 && body_counts(g_scene, threads[1]).vertex_count == 4);
  }
  CHECK(refusals >= 5 && count == 2);
  CHECK_OK(dsw_scene_get_body_cuts(g_scene, &cuts, &count));
  CHECK(count == 2 && body_counts(g_scene, threads[1]).edge_count == 4);
  end_scene(g_scene);
  end_context(context, &h);
}

static void bad_arguments_change_nothing(void) {
  const dsw_body_cut *cuts = NULL;
  dsw_cut_desc d, bad;
  dsw_body_id threads[2], gone = {7, 7};
  size_t count = 99;
  begin(0);
  threads[0] = make_thread(4, 1, 1.25, 0, 0);
  threads[1] = threads[0];
  d = blade_at(1.75, 0, 2);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_cut_bodies(NULL, &d, NULL, 0, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_cut_bodies(g_scene, NULL, NULL, 0, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_cut_bodies(g_scene, &d, NULL, 1, &count));
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, dsw_scene_cut_bodies(g_scene, &d, threads, 2, &count));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_scene_cut_bodies(g_scene, &d, &gone, 1, &count));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, d, flags, DSW_CUT_UNSEW, dsw_scene_cut_bodies(g_scene, &bad, NULL, 0, &count));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, d, snap, 0.125, dsw_scene_cut_bodies(g_scene, &bad, NULL, 0, &count));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, d, start, volume_at(0), dsw_scene_cut_bodies(g_scene, &bad, NULL, 0, &count));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, rows, 1, dsw_scene_cut_bodies(g_scene, &bad, NULL, 0, &count));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, columns, 4 - g_dimension,
                dsw_scene_cut_bodies(g_scene, &bad, NULL, 0, &count));
  CHECK_REFUSES(DSW_STATUS_NULL_ARGUMENT, d, points, NULL, dsw_scene_cut_bodies(g_scene, &bad, NULL, 0, &count));
  g_blade[0] = HUGE_VAL;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_cut_bodies(g_scene, &d, NULL, 0, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_body_cuts(g_scene, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_body_cuts(NULL, &cuts, &count));
  CHECK(count == 99 && body_counts(g_scene, threads[0]).edge_count == 3);
  d = blade_at(1.75, 0, 2);
  CHECK_OK(dsw_scene_cut_bodies(g_scene, &d, threads, 1, NULL));
  CHECK_OK(dsw_scene_get_body_cuts(g_scene, &cuts, &count));
  CHECK(count == 1);
  end_scene(g_scene);
}

int main(void) {
  for (g_dimension = 2; g_dimension <= 3; ++g_dimension) {
    check_in(g_dimension == 3 ? "in space" : "in the plane");
    a_thread_has_two_ends_at_the_blade(0, 0);
    a_thread_has_two_ends_at_the_blade(DSW_FEATURE_BODY_CONTACTS, DSW_BODY_SELF_CONTACTS);
    a_thread_has_two_ends_at_the_blade(DSW_FEATURE_LIVE_CHANGES, DSW_BODY_RIGID);
    a_blade_through_a_vertex_cuts_one_edge();
    a_folded_blade_leaves_pieces();
    a_thick_thread_keeps_its_distance(1, 0);
    a_thick_thread_keeps_its_distance(1, DSW_BODY_SELF_CONTACTS);
    a_thick_thread_keeps_its_distance(0.0625, DSW_BODY_SELF_CONTACTS);
    calls_are_replayed();
    a_refusal_of_memory_leaves_threads_whole();
    bad_arguments_change_nothing();
  }
  g_dimension = 3;
  check_in("in space");
  triangles_go_with_their_edge();
  return check_result();
}
