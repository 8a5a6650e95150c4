/* Edges that DSW_BODY_LEAVE_BACK_EDGES leaves untested: which these are, and what the other calls see of their body. */
#include <string.h>

#include "check.h"
#include "fixture.h"

enum { kSide = 4, kVertices = 8, kEdges = 18, kHexahedron = 1 + kSide * (1 + kSide) };

static dsw_environment *g_environment;
static dsw_scene *g_scene;

/* A frustum round the cube in the middle, whose sides look up. Vertices 0 to 3 are the top's; the diagonal 0 2 of the top
   passes above the cube (1, 1, 1). */
static const double g_frustum[24] = {0.75, 0.75, 2.5,  3.25, 0.75, 2.5,  3.25, 3.25, 2.5,  0.75, 3.25, 2.5,
                                     0.25, 0.25, 0.25, 3.75, 0.25, 0.25, 3.75, 3.75, 0.25, 0.25, 3.75, 0.25};
static const uint32_t g_offsets[7] = {0, 4, 8, 12, 16, 20, 24};
static const uint32_t g_corners[24] = {0, 1, 2, 3, 7, 6, 5, 4, 0, 4, 5, 1, 1, 5, 6, 2, 2, 6, 7, 3, 3, 7, 4, 0};

static const uint32_t kLeft = DSW_BODY_SKIP_BACK_EDGES | DSW_BODY_LEAVE_BACK_EDGES;

static void begin(void) {
  g_environment = make_environment(NULL, kSide, kSide, kSide);
  g_scene = make_scene(g_environment, 0);
  CHECK_OK(set_volume_mark(g_environment, kHexahedron, DSW_MARK_IMPASSABLE));
}

static void end(void) { end_scene(g_scene); }

static dsw_body_desc frustum(uint32_t flags) {
  dsw_body_desc d = surface_desc(g_frustum, kVertices, g_offsets, g_corners, 6, DSW_LEVEL_EDGES);
  d.flags = flags;
  return d;
}

static dsw_body_id make(uint32_t flags) {
  const dsw_body_desc d = frustum(flags);
  dsw_body_id body = {0, 0};
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  return body;
}

static dsw_move_report lift_top(dsw_body_id body, double height) {
  double targets[24];
  dsw_move_report report;
  size_t i;
  memcpy(targets, g_frustum, sizeof targets);
  for (i = 0; i < 4; ++i) targets[3 * i + 2] = height;
  CHECK_OK(dsw_body_move(g_scene, body, targets, kVertices, 0, NULL, &report));
  return report;
}

static size_t untested(dsw_body_id body) {
  dsw_body_edge_id edges[kEdges];
  size_t count = 0;
  CHECK_OK(dsw_body_get_untested_edges(g_scene, body, edges, kEdges, &count));
  return count;
}

/* Whether an edge between two vertices is on the list. */
static int is_untested(dsw_body_id body, uint32_t a, uint32_t b) {
  dsw_body_edge_id edges[kEdges];
  size_t count = 0, i;
  CHECK_OK(dsw_body_get_untested_edges(g_scene, body, edges, kEdges, &count));
  for (i = 0; i < count; ++i) {
    dsw_body_vertex_id ends[2];
    CHECK_OK(dsw_body_get_edge_ends(g_scene, body, edges[i], ends));
    if ((ends[0].index == a && ends[1].index == b) || (ends[0].index == b && ends[1].index == a)) return 1;
  }
  return 0;
}

static void edges_that_go_inwards_are_listed_until_they_go_outwards(void) {
  dsw_move_report report;
  dsw_body_edge_id edges[kEdges];
  size_t count = 77;
  dsw_body_id exact, left;
  begin();
  exact = make(DSW_BODY_SKIP_BACK_EDGES);
  left = make(kLeft);
  CHECK(untested(left) == 0);
  /* The diagonal would lie in the marked cube: the exact body stops. */
  CHECK(lift_top(exact, 1.5).vertices_stopped > 0 && untested(exact) == 0);
  report = lift_top(left, 1.5);
  CHECK(report.vertices_stopped == 0 && report.contact_count == 0 && report.edges_skipped > 0);
  CHECK(untested(left) >= 5 && is_untested(left, 0, 2) && !is_untested(left, 4, 5));
  CHECK(dsw_body_get_untested_edges(g_scene, left, edges, 1, &count) == DSW_STATUS_BUFFER_TOO_SMALL &&
        count == untested(left));
  CHECK(dsw_body_get_untested_edges(g_scene, left, edges, kEdges, NULL) == DSW_STATUS_NULL_ARGUMENT);
  CHECK(dsw_body_get_untested_edges(NULL, left, edges, kEdges, &count) == DSW_STATUS_NULL_ARGUMENT);
  /* A little up: the diagonal still lies in the cube, and is still listed. The others are tested and free. */
  CHECK(lift_top(left, 1.75).vertices_stopped == 0);
  CHECK(untested(left) == 1 && is_untested(left, 0, 2));
  /* Out of the cube. */
  CHECK(lift_top(left, 2.5).vertices_stopped == 0 && untested(left) == 0);
  CHECK_OK(dsw_body_destroy(g_scene, left));
  CHECK(dsw_body_get_untested_edges(g_scene, left, edges, kEdges, &count) == DSW_STATUS_STALE_ID);
  end();
}

static void edges_that_have_room_are_free_beside_edges_that_stand_still(void) {
  static const double heights[4] = {2.24, 2.245, 2.24, 2.25}; /* of the top */
  int i, k, stands;
  begin();
  CHECK_OK(set_volume_mark(g_environment, kHexahedron, DSW_MARK_PASSABLE));
  for (stands = 0; stands < 2; ++stands) {
    dsw_body_desc d = frustum(kLeft | DSW_BODY_SKIP_BY_CLEARANCE);
    dsw_body_id body = {0, 0};
    double at[24];
    for (i = 0; i < 24; ++i) at[i] = 2 + 0.05 * (g_frustum[i] - 2) + (i % 3 == 2 ? 0.25 : 0);
    d.positions = at;
    CHECK_OK(dsw_body_create(g_scene, &d, &body));
    for (k = 0; k < 4; ++k) {
      dsw_move_report report;
      for (i = 2; i < 12; i += 3) at[i] = heights[k];
      for (i = 14; i < 24; i += 3) at[i] += k == 3 && !stands ? 0.001 : 0;
      CHECK_OK(dsw_body_move(g_scene, body, at, kVertices, 0, NULL, &report));
      CHECK(report.vertices_stopped == 0 && report.edges_skipped > 0);
      CHECK(k % 2 == 0 ? untested(body) >= 5 : untested(body) == 0); /* up, what is skipped has room */
    }
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  end();
}

static void an_edge_that_is_free_stops_before_what_it_meets_outwards(void) {
  dsw_body_id body;
  dsw_move_report report;
  begin();
  body = make(kLeft);
  CHECK(lift_top(body, 2.25).vertices_stopped == 0 && untested(body) > 0);
  CHECK_OK(set_volume_mark(g_environment, 1 + kSide * (1 + kSide * 3), DSW_MARK_IMPASSABLE)); /* above the top */
  CHECK(untested(body) == 0); /* they were tested, and are free */
  report = lift_top(body, 3.5);
  CHECK(report.vertices_stopped > 0 && report.contact_count > 0);
  end();
}

static void other_calls_see_the_vertices_alone_while_an_edge_is_not_free(void) {
  const uint32_t below = 2 + kSide * 1; /* the diagonal of the bottom passes it, and no vertex lies there */
  dsw_body_id body;
  dsw_level level;
  double gap = 0;
  size_t rows = 0, listed;
  dsw_near_options near_options;
  dsw_rigid_motion still;
  begin();
  body = make(kLeft);
  lift_top(body, 1.5);
  CHECK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES_SWEPT) == DSW_STATUS_OCCUPIED && is_untested(body, 0, 2));
  CHECK_OK(dsw_body_get_level(g_scene, body, &level));
  CHECK(level == DSW_LEVEL_EDGES);
  dsw_near_options_init(&near_options, sizeof near_options);
  near_options.margin = 0.25;
  CHECK_OK(dsw_body_find_near_rows(g_scene, body, &near_options, &rows));
  CHECK_OK(dsw_body_find_least_gap(g_scene, body, 1, &gap));
  CHECK(gap > 0 && is_untested(body, 0, 2) && !is_untested(body, 4, 5)); /* to look changes nothing */
  memset(&still, 0, sizeof still);
  still.rotation[3] = 1;
  CHECK_OK(dsw_body_move_rigid(g_scene, body, &still, NULL, NULL));
  CHECK_OK(dsw_body_get_level(g_scene, body, &level));
  CHECK(level == DSW_LEVEL_EDGES && untested(body) == kEdges); /* any of them may be in something now */
  CHECK(lift_top(body, 2.5).vertices_stopped == 0 && !is_untested(body, 0, 2) && is_untested(body, 4, 5));
  /* All are free again: the next call finds that out, and sees them. If it fails, the list is as before. */
  listed = untested(body);
  CHECK(set_volume_mark(g_environment, below, DSW_MARK_IMPASSABLE) == DSW_STATUS_OCCUPIED);
  CHECK(listed > 0 && untested(body) == listed && is_untested(body, 4, 5));
  CHECK_OK(set_volume_mark(g_environment, 1 + kSide * kSide * (kSide - 1), DSW_MARK_IMPASSABLE)); /* far above */
  CHECK(untested(body) == 0);
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES_SWEPT));
  end();
}

static void a_mark_may_come_into_the_way_of_edges_that_are_not_seen(void) {
  dsw_body_id body;
  begin();
  body = make(kLeft);
  lift_top(body, 1.5);
  CHECK_OK(set_volume_mark(g_environment, 1, DSW_MARK_IMPASSABLE)); /* edges of the bottom pass it, no vertex does */
  CHECK(untested(body) == kEdges);
  CHECK(set_volume_mark(g_environment, 0, DSW_MARK_IMPASSABLE) == DSW_STATUS_OCCUPIED); /* vertices are seen */
  CHECK_OK(set_volume_mark(g_environment, 1, DSW_MARK_PASSABLE));
  lift_top(body, 2.5);
  CHECK_OK(set_volume_mark(g_environment, 2, DSW_MARK_PASSABLE));
  CHECK(untested(body) == 0);
  end();
}

static void snapshots_keep_the_list(void) {
  static unsigned char block[1 << 20], again[1 << 20];
  size_t size = 0, count = 0;
  dsw_scene *loaded = NULL;
  dsw_body_id body;
  dsw_body_edge_id edges[kEdges];
  begin();
  body = make(kLeft);
  lift_top(body, 1.5);
  CHECK_OK(dsw_scene_save(g_scene, block, sizeof block, &size));
  CHECK_OK(dsw_scene_load(g_environment, block, size, &loaded));
  CHECK_OK(dsw_body_get_untested_edges(loaded, body, edges, kEdges, &count));
  CHECK(count == untested(body) && count > 0);
  CHECK_OK(dsw_scene_save(loaded, again, sizeof again, &count));
  CHECK(count == size && memcmp(block, again, size) == 0);
  CHECK_OK(dsw_scene_destroy(loaded));
  end();
}

static void a_validation_leaves_out_what_is_listed(void) {
  static tape recording;
  const dsw_recording_desc to = to_tape(&recording);
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  dsw_validation validation;
  begin();
  CHECK_OK(dsw_scene_start_recording(g_scene, &to));
  lift_top(make(kLeft), 1.5);
  CHECK_OK(dsw_scene_stop_recording(g_scene));
  CHECK_OK(dsw_replay_create(NULL, recording.bytes, recording.size, &replay));
  memset(&validation, 0, sizeof validation);
  validation.struct_size = sizeof validation;
  CHECK_OK(dsw_replay_step_validated(replay, &report, &validation));
  CHECK(report.outcome == DSW_REPLAY_SAME && validation.is_right == 1 && validation.edges == kEdges);
  CHECK_OK(dsw_replay_step_validated(replay, &report, &validation));
  CHECK(report.outcome == DSW_REPLAY_SAME && validation.is_right == 1);
  CHECK(validation.edges > 0 && validation.edges < kEdges); /* without those of the top, which meet the cube */
  CHECK_OK(dsw_replay_destroy(replay));
  end();
}

static void what_the_flag_is_not_for(void) {
  const uint32_t wrong[4] = {DSW_BODY_LEAVE_BACK_EDGES, kLeft | DSW_BODY_RIGID, kLeft | DSW_BODY_SKIP_SIMILAR_MOTION,
                             kLeft};
  dsw_body_id body;
  int i;
  begin();
  for (i = 0; i < 4; ++i) {
    dsw_body_desc d = frustum(wrong[i]);
    if (i == 3) d.radius = 0.01;
    body.generation = 0;
    CHECK(dsw_body_create(g_scene, &d, &body) == DSW_STATUS_UNSUPPORTED && body.generation == 0);
    CHECK(strstr(dsw_last_error_message(), "DSW_BODY_LEAVE_BACK_EDGES") != NULL);
  }
  body = make(kLeft);
  CHECK(dsw_body_set_radius(g_scene, body, 0.01) == DSW_STATUS_UNSUPPORTED);
  CHECK_OK(dsw_body_set_radius(g_scene, body, 0));
  end();
}

int main(void) {
  edges_that_go_inwards_are_listed_until_they_go_outwards();
  edges_that_have_room_are_free_beside_edges_that_stand_still();
  an_edge_that_is_free_stops_before_what_it_meets_outwards();
  other_calls_see_the_vertices_alone_while_an_edge_is_not_free();
  a_mark_may_come_into_the_way_of_edges_that_are_not_seen();
  snapshots_keep_the_list();
  a_validation_leaves_out_what_is_listed();
  what_the_flag_is_not_for();
  return check_result();
}
