/* Bodies: creation, levels, what can be read. Edits are in body_edit_test.c, moves in
   move_test.c. What is refused is refused in the plane, too. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "stage.h"

/* A pyramid: a square at z = 0.5 with corners 0 to 3, the tip 4 at z = 1.5. */
static const double g_pyramid[15] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5, 1.5, 1.5, 0.5, 0.5, 1.5, 0.5, 1.25, 1.25, 1.5};
static const uint32_t g_offsets[6] = {0, 3, 6, 9, 12, 16};
static const uint32_t g_corners[16] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 3, 2, 1, 0};
static const uint32_t g_edge[2] = {4, 2};

/* In the plane its vertices, and one edge. */
static dsw_body_desc pyramid(void) {
  dsw_body_desc d = surface_desc(g_pyramid, 5, g_offsets, g_corners, 5, DSW_LEVEL_EDGES_SWEPT);
  d.edges = g_edge;
  d.edge_count = 1;
  if (g_dimension == 2) d.face_count = d.face_corner_count = 0, d.face_offsets = d.face_corners = NULL;
  d.stride_bytes = g_stride;
  return d;
}

/* Vertices and edges only. */
static dsw_body_desc from_edges(const double *positions, size_t vertex_count, const uint32_t *edges,
                                size_t edge_count) {
  dsw_body_desc d = body_desc(positions, vertex_count, edges, edge_count, DSW_LEVEL_EDGES_SWEPT);
  d.stride_bytes = g_stride;
  return d;
}

static dsw_body_id make(const dsw_body_desc *d) {
  dsw_body_id body = {0, 0};
  CHECK_OK(dsw_body_create(g_scene, d, &body));
  return body;
}

static void init_writes_the_defaults(void) {
  dsw_body_desc d;
  memset(&d, 0xff, sizeof d);
  dsw_body_desc_init(&d, sizeof d);
  CHECK(d.struct_size == sizeof d && d.flags == 0 && d.level == DSW_LEVEL_EDGES_SWEPT && d.reserved == 0);
  CHECK(d.positions == NULL && d.vertex_count == 0 && d.stride_bytes == 0 && d.hints == NULL && d.edges == NULL);
  CHECK(d.edge_count == 0 && d.face_offsets == NULL && d.face_corners == NULL && d.face_count == 0);
  CHECK(d.motion_share == 0);
  memset(&d, 0xff, sizeof d);
  dsw_body_desc_init(&d, 12); /* a shorter struct than ours */
  CHECK(d.struct_size == 12 && d.level == DSW_LEVEL_EDGES_SWEPT && d.reserved == 0xffffffffu);
  dsw_body_desc_init(NULL, sizeof d);
}

static void a_body_has_what_was_given(void) {
  /* The edge that was given; then those of the faces, triangle by triangle; the square's diagonal is 3 1. */
  static const uint32_t edges[9][2] = {{4, 2}, {0, 1}, {1, 4}, {4, 0}, {1, 2}, {2, 3}, {3, 4}, {3, 0}, {1, 3}};
  static const uint32_t faces[6][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {3, 2, 1}, {3, 1, 0}};
  const dsw_volume_id hints[5] = {{0, 1}, {0, 0}, {N + 1, 1}, {5, 1}, {47, 1}};
  dsw_body_desc d = pyramid();
  dsw_body_vertex_id v[5], ends[3];
  dsw_body_edge_id e[9];
  dsw_body_face_id f[6];
  dsw_volume_id volumes[5];
  dsw_body_id body;
  dsw_body_counts c;
  double p[25];
  size_t count = 0, i, k;
  int level;
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_FACES; ++level) {
    dsw_level now = (dsw_level)0;
    d.level = (dsw_level)level;
    d.hints = level % 2 != 0 ? hints : NULL;
    d.flags =
        DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BY_CLEARANCE | DSW_BODY_SKIP_SIMILAR_MOTION;
    body = make(&d);
    c = counts_of(body);
    CHECK(c.struct_size == sizeof c && c.vertex_count == 5 && c.edge_count == 9 && c.face_count == 6);
    CHECK(c.vertex_slots == 5 && c.edge_slots == 9 && c.face_slots == 6 && c.reserved == 0);
    CHECK_OK(dsw_body_get_level(g_scene, body, &now));
    CHECK((int)now == level && body_count() == 1);
    CHECK_OK(dsw_body_get_vertex_ids(g_scene, body, v, 5, &count));
    for (i = 0; i < 5; ++i) CHECK(v[i].index == i && v[i].generation == 1);
    CHECK_OK(dsw_body_get_edge_ids(g_scene, body, e, 9, &count));
    CHECK(count == 9);
    for (i = 0; i < 9; ++i) {
      CHECK_OK(dsw_body_get_edge_ends(g_scene, body, e[i], ends));
      CHECK(e[i].index == i && ends[0].generation == 1 && ends[1].generation == 1);
      CHECK(ends[0].index == edges[i][0] && ends[1].index == edges[i][1]);
    }
    CHECK_OK(dsw_body_get_face_ids(g_scene, body, f, 6, &count));
    CHECK(count == 6);
    for (i = 0; i < 6; ++i) {
      CHECK_OK(dsw_body_get_face_corners(g_scene, body, f[i], ends));
      for (k = 0; k < 3; ++k) CHECK(ends[k].index == faces[i][k] && ends[k].generation == 1);
    }
    memset(p, 0x55, sizeof p);
    CHECK_OK(dsw_body_get_positions(g_scene, body, p, 5, 40, volumes, &count));
    for (i = 0; i < 5; ++i) CHECK(memcmp(p + 5 * i, g_pyramid + 3 * i, 3 * sizeof(double)) == 0);
    CHECK(count == 5 && p[3] == p[4] && p[3] != 0); /* between the points nothing is written */
    CHECK(volumes[0].index == 0 && volumes[1].index == 1 && volumes[2].index == N + 1 && volumes[3].index == N);
    CHECK(volumes[4].index == N * N + N + 1 && volumes[4].generation == 1);
    CHECK_OK(dsw_body_destroy(g_scene, body));
    CHECK(body_count() == 0);
  }
}

static void back_edges_are_those_of_closed_surfaces_turned_outwards(void) {
  dsw_body_desc d = pyramid();
  uint32_t corners[32], i;
  d.flags = DSW_BODY_SKIP_BACK_EDGES;
  CHECK_OK(dsw_body_destroy(g_scene, make(&d)));
  d.face_count -= 1;
  d.face_corner_count = d.face_offsets[d.face_count];
  refuses(DSW_STATUS_NOT_CLOSED, &d, "closed surfaces"); /* one face is missing */
  d.face_count = d.face_corner_count = 0;
  refuses(DSW_STATUS_NOT_CLOSED, &d, "closed surfaces"); /* no face at all */
  d = pyramid(), d.flags = DSW_BODY_SKIP_BACK_EDGES;
  for (i = 0; i < d.face_corner_count; ++i) corners[i] = d.face_corners[d.face_corner_count - 1 - i];
  CHECK(d.face_corner_count <= 32);
  /* Faces the other way round: the first becomes the last, offsets change where it has more corners. */
  {
    uint32_t offsets[16];
    CHECK(d.face_count < 16);
    for (i = 0; i <= d.face_count; ++i) offsets[i] = (uint32_t)d.face_corner_count - d.face_offsets[d.face_count - i];
    d.face_offsets = offsets;
    d.face_corners = corners;
    refuses(DSW_STATUS_NOT_ORIENTED, &d, "is not positive");
    d.flags = 0;
    CHECK_OK(dsw_body_destroy(g_scene, make(&d)));
  }
}

static void bad_faces_in_the_plane(void) {
  dsw_body_desc d = pyramid();
  d.level = DSW_LEVEL_FACES;
  refuses(DSW_STATUS_UNSUPPORTED, &d, "bodies in the plane have no faces");
  d.level = DSW_LEVEL_EDGES;
  d.flags = DSW_BODY_SKIP_BACK_EDGES;
  refuses(DSW_STATUS_UNSUPPORTED, &d, "DSW_BODY_SKIP_BACK_EDGES");
  d.flags = 0;
  d.face_offsets = g_offsets;
  d.face_corners = g_corners;
  d.face_count = 1;
  d.face_corner_count = 3;
  refuses(DSW_STATUS_UNSUPPORTED, &d, "desc->face_count is 1");
}

static void bad_members_are_refused(void) {
  struct {
    dsw_body_desc known;
    uint32_t unknown;
  } newer;
  const dsw_volume_id stale[5] = {{0, 1}, {0, 0}, {0, 7}, {0, 0}, {0, 0}}, beyond[5] = {{N * N * 3, 1}};
  double bad[15], shares[3];
  dsw_body_desc d = pyramid();
  int i;
  shares[0] = -0.5;
  shares[1] = NAN;
  shares[2] = INFINITY;
  d.struct_size = 40;
  refuses(DSW_STATUS_BAD_STRUCT_SIZE, &d, "desc->struct_size is 40");
  d.struct_size = 4097;
  refuses(DSW_STATUS_UNSUPPORTED, &d, "struct_size");
  memset(&newer, 0, sizeof newer);
  newer.known = pyramid();
  newer.known.struct_size = sizeof newer;
  newer.unknown = 1;
  refuses(DSW_STATUS_UNSUPPORTED, &newer.known, "non-zero byte");
  d = pyramid(), d.flags = 0x400;
  refuses(DSW_STATUS_UNSUPPORTED, &d, "desc->flags is 0x400, this version knows 0x3ff");
  d.flags = DSW_BODY_SEQUENCES | DSW_BODY_NO_SEQUENCES;
  refuses(DSW_STATUS_OUT_OF_RANGE, &d, "exclude each other");
  d.flags = 0;
  d.reserved = 1;
  refuses(DSW_STATUS_UNSUPPORTED, &d, "desc->reserved is 1");
  d.reserved = 0;
  for (i = 0; i < 2; ++i) {
    d.level = (dsw_level)(5 * i);
    refuses(DSW_STATUS_UNSUPPORTED, &d, "desc->level is ");
    if (g_dimension == 3) CHECK_MESSAGE("must be 1 .. 4");
  }
  for (i = 0; i < 3; ++i) {
    d = pyramid();
    d.motion_share = shares[i];
    refuses(DSW_STATUS_OUT_OF_RANGE, &d, "desc->motion_share");
  }
  d = pyramid(), d.vertex_count = 0;
  refuses(DSW_STATUS_WRONG_SIZE, &d, "desc->vertex_count is 0");
  d.vertex_count = 5;
  d.stride_bytes = 8 * g_dimension - 8;
  refuses(DSW_STATUS_WRONG_SIZE, &d, g_dimension == 3 ? "stride_bytes is 16" : "stride_bytes is 8");
  CHECK_MESSAGE(g_dimension == 3 ? "from 24 on" : "from 16 on");
  d.stride_bytes = 28;
  refuses(DSW_STATUS_WRONG_SIZE, &d, "stride_bytes is 28");
  d.stride_bytes = 24;
  d.vertex_count = SIZE_MAX / 16;
  refuses(DSW_STATUS_WRONG_SIZE, &d, "desc->positions cannot have");
  d = pyramid(), d.positions = NULL;
  refuses(DSW_STATUS_NULL_ARGUMENT, &d, "desc->positions is null");
  d = pyramid(), d.edges = NULL;
  refuses(DSW_STATUS_NULL_ARGUMENT, &d, "desc->edges is null");
  if (g_dimension == 3) {
    d = pyramid(), d.face_offsets = NULL;
    refuses(DSW_STATUS_NULL_ARGUMENT, &d, "desc->face_offsets is null");
    d = pyramid(), d.face_corners = NULL;
    refuses(DSW_STATUS_NULL_ARGUMENT, &d, "desc->face_corners is null");
  } else {
    bad_faces_in_the_plane();
  }
  d = pyramid(), d.hints = stale;
  refuses(DSW_STATUS_STALE_ID, &d, "desc->hints[2] {index 0, generation 7}");
  d.hints = beyond;
  refuses(DSW_STATUS_STALE_ID, &d, "desc->hints[0] {index 48, generation 1}");
  d = pyramid(), d.positions = bad;
  memcpy(bad, g_pyramid, sizeof bad);
  bad[7] = NAN;
  refuses(DSW_STATUS_NON_FINITE, &d, "[2][1] is nan");
  bad[7] = -INFINITY;
  refuses(DSW_STATUS_NON_FINITE, &d, "[2][1] is -inf");
  bad[7] = -1;
  refuses(DSW_STATUS_OUTSIDE, &d, "[2]");
  bad[7] = 1e300;
  refuses(DSW_STATUS_OUTSIDE, &d, "[2]");
  d = pyramid();
  CHECK_OK(mark_cell(g_pillar - 1, DSW_MARK_IMPASSABLE));
  refuses(DSW_STATUS_IMPASSABLE, &d, g_dimension == 3 ? "[4]" : "[2]");
  CHECK_MESSAGE("which is impassable");
  CHECK_OK(mark_cell(g_pillar - 1, DSW_MARK_PASSABLE));
}

static void bad_topology_is_refused(void) {
  static const struct {
    dsw_status status;
    const char *text;
    uint32_t edge_count, edges[4], face_count, offsets[4], corners[12];
  } kBad[] = {
      {DSW_STATUS_INDEX_OUT_OF_RANGE, "desc->edges[2] is 5, there are 5 vertices", 2, {0, 1, 5, 1}, 0, {0}, {0}},
      {DSW_STATUS_INDEX_OUT_OF_RANGE, "desc->edges[3] is 4294967295", 2, {0, 1, 2, 0xffffffffu}, 0, {0}, {0}},
      {DSW_STATUS_REPEATED_VERTEX, "edge 1 joins vertex 2 with itself", 2, {0, 1, 2, 2}, 0, {0}, {0}},
      {DSW_STATUS_DUPLICATE_PART, "edge 1 between vertices 1 and 0 occurs twice", 2, {0, 1, 1, 0}, 0, {0}, {0}},
      {DSW_STATUS_INDEX_OUT_OF_RANGE, "desc->face_corners[4] is 9", 0, {0}, 2, {0, 3, 6}, {0, 1, 2, 0, 9, 3}},
      {DSW_STATUS_WRONG_SIZE, "must go from 0 to face_corner_count", 0, {0}, 1, {3, 6}, {0, 1, 2, 0, 1, 2}},
      {DSW_STATUS_WRONG_SIZE, "face 1 has corners 3 to 5", 0, {0}, 2, {0, 3, 5}, {0, 1, 2, 0, 2}},
      {DSW_STATUS_WRONG_SIZE, "face 0 has corners 0 to 6 of 3", 0, {0}, 2, {0, 6, 3}, {0, 1, 2, 3, 4, 0}},
      {DSW_STATUS_REPEATED_VERTEX, "names a vertex twice", 0, {0}, 1, {0, 3}, {0, 1, 0}},
      {DSW_STATUS_REPEATED_VERTEX, "names a vertex twice", 0, {0}, 1, {0, 4}, {0, 1, 2, 0}},
      {DSW_STATUS_DUPLICATE_PART, "occurs twice", 0, {0}, 2, {0, 3, 6}, {0, 1, 2, 1, 2, 0}},
      {DSW_STATUS_DUPLICATE_PART, "occurs twice", 0, {0}, 2, {0, 3, 6}, {0, 1, 2, 0, 2, 1}}, /* turned */
      {DSW_STATUS_NOT_MANIFOLD, "two triangles already", 0, {0}, 3, {0, 3, 6, 9}, {0, 1, 2, 1, 0, 3, 0, 1, 4}},
      {DSW_STATUS_NOT_MANIFOLD, "vertex 0 form more than one fan", 0, {0}, 2, {0, 3, 6}, {0, 1, 2, 0, 3, 4}},
      {DSW_STATUS_NOT_ORIENTED, "is turned against a neighbour", 0, {0}, 2, {0, 3, 6}, {0, 1, 2, 0, 1, 3}},
  };
  size_t i;
  for (i = 0; i < sizeof kBad / sizeof kBad[0]; ++i) {
    dsw_body_desc d = from_edges(g_pyramid, 5, kBad[i].edges, kBad[i].edge_count);
    if (g_dimension == 2 && kBad[i].face_count != 0) continue;
    d.face_offsets = kBad[i].offsets;
    d.face_corners = kBad[i].corners;
    d.face_count = kBad[i].face_count;
    d.face_corner_count = kBad[i].offsets[kBad[i].face_count];
    refuses(kBad[i].status, &d, kBad[i].text);
  }
}

static void one_that_is_not_free_is_refused(void) {
  const double line[9] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5, 2.5, 0.5, 0.5};
  const uint32_t edges[4] = {0, 1, 2, 1};
  const uint32_t *offending = NULL;
  dsw_body_desc d = from_edges(line, 3, edges, 2);
  dsw_body_id body;
  dsw_level level;
  size_t count = 99;
  CHECK_OK(mark_face(1, FACE_X1, DSW_MARK_IMPASSABLE));
  d.level = DSW_LEVEL_EDGES;
  refuses(DSW_STATUS_OCCUPIED, &d, "1 edges meet something impassable; the first joins vertices ");
  CHECK_OK(dsw_scene_get_offending_edges(g_scene, &offending, &count));
  CHECK(count == 1 && offending[0] + offending[1] == 3 && offending[0] * offending[1] == 2);
  d.level = DSW_LEVEL_POINTS; /* points do not care */
  body = make(&d);
  CHECK_OK(dsw_scene_get_offending_edges(g_scene, &offending, &count));
  CHECK(count == 0);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES_SWEPT));
  CHECK_OK(dsw_body_get_level(g_scene, body, &level));
  CHECK(level == DSW_LEVEL_POINTS);
  CHECK_OK(dsw_scene_get_offending_edges(g_scene, &offending, &count));
  CHECK(count == 1);
  CHECK_OK(mark_face(1, FACE_X1, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES_SWEPT));
  CHECK_OK(dsw_body_set_level(g_scene, body, top_level()));
  CHECK_OK(dsw_body_set_level(g_scene, body, top_level()));
  if (g_dimension == 2) {
    CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_body_set_level(g_scene, body, DSW_LEVEL_FACES));
    CHECK_MESSAGE("level is DSW_LEVEL_FACES: bodies in the plane have no faces");
  }
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_face(1, FACE_X1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES));
  CHECK_OK(dsw_body_get_level(g_scene, body, &level));
  CHECK(level == DSW_LEVEL_EDGES);
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_body_set_level(g_scene, body, (dsw_level)0));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_body_set_level(g_scene, body, (dsw_level)5));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* In space: a marked edge through the inside of a face is seen by faces only. */
static void a_face_is_not_free_of_a_marked_edge(void) {
  const uint32_t triangle[3] = {0, 1, 2}, all[2] = {0, 3};
  const double wide[9] = {0.25, 1.5, 0.25, 3.75, 1.25, 0.25, 3.75, 1.75, 2.75};
  const uint32_t *offending = NULL;
  dsw_body_desc d = from_edges(wide, 3, NULL, 0);
  dsw_edge_id marked;
  uint32_t ends[2];
  dsw_body_id body;
  size_t count = 99;
  d.face_offsets = all;
  d.face_corners = triangle;
  d.face_count = 1;
  d.face_corner_count = 3;
  ends[0] = 2 + (N + 1) * (1 + (N + 1));
  ends[1] = ends[0] + N + 1;
  CHECK_OK(dsw_environment_find_edges(g_env, 1, ends, &marked, NULL));
  CHECK_OK(dsw_environment_mark_edges(g_env, &marked, 1, DSW_MARK_IMPASSABLE));
  body = make(&d);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_level(g_scene, body, DSW_LEVEL_FACES));
  CHECK_OK(dsw_scene_get_offending_edges(g_scene, &offending, &count));
  CHECK(count == 1 && offending[0] < 3 && offending[1] < 3 && offending[0] != offending[1]);
  CHECK_OK(dsw_body_destroy(g_scene, body));
  d.level = DSW_LEVEL_FACES;
  refuses(DSW_STATUS_OCCUPIED, &d, "edges meet something impassable");
  CHECK_OK(dsw_environment_mark_edges(g_env, &marked, 1, DSW_MARK_PASSABLE));
}

static void capacities_are_asked_for(void) {
  const dsw_body_desc d = pyramid();
  const dsw_body_id body = make(&d);
  dsw_body_vertex_id v[5];
  dsw_body_edge_id e[9];
  dsw_body_face_id f[6];
  double p[15], before[15];
  size_t count = 0;
  memset(p, 0x55, sizeof p);
  memcpy(before, p, sizeof p);
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_body_get_positions(g_scene, body, NULL, 0, 0, NULL, &count));
  CHECK(count == 5);
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_body_get_positions(g_scene, body, p, 4, 0, NULL, &count));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_body_get_positions(g_scene, body, p, 5, 8, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_positions(g_scene, body, NULL, 5, 0, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_positions(g_scene, body, p, 5, 0, NULL, NULL));
  CHECK(memcmp(p, before, sizeof p) == 0);
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_body_get_vertex_ids(g_scene, body, v, 4, &count));
  CHECK(count == 5);
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_body_get_edge_ids(g_scene, body, e, 8, &count));
  CHECK(count == 9);
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_body_get_face_ids(g_scene, body, NULL, 0, &count));
  CHECK(count == 6);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_vertex_ids(g_scene, body, NULL, 5, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_edge_ids(g_scene, body, e, 9, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_face_ids(g_scene, body, f, 6, NULL));
  CHECK_OK(dsw_body_get_positions(g_scene, body, p, 5, 0, NULL, &count));
  CHECK(memcmp(p, g_pyramid, sizeof p) == 0);
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* What every function that only reads says to a scene that is null and to a body that is gone. */
static void handles_are_checked(dsw_scene *scene, dsw_body_id body, dsw_status status) {
  const dsw_body_edge_id edge = {0, 1};
  const dsw_body_face_id face = {0, 1};
  dsw_body_vertex_id v[5];
  dsw_body_edge_id e[9];
  dsw_body_face_id f[6];
  dsw_body_counts c;
  dsw_level level = DSW_LEVEL_FACES;
  double p[15];
  size_t count = 99;
  c.struct_size = sizeof c;
  CHECK_FAILS(status, dsw_body_get_counts(scene, body, &c));
  CHECK_FAILS(status, dsw_body_get_level(scene, body, &level));
  CHECK_FAILS(status, dsw_body_set_level(scene, body, DSW_LEVEL_POINTS));
  CHECK_FAILS(status, dsw_body_get_positions(scene, body, p, 5, 0, NULL, &count));
  CHECK_FAILS(status, dsw_body_get_vertex_ids(scene, body, v, 5, &count));
  CHECK_FAILS(status, dsw_body_get_edge_ids(scene, body, e, 9, &count));
  CHECK_FAILS(status, dsw_body_get_face_ids(scene, body, f, 6, &count));
  CHECK_FAILS(status, dsw_body_get_edge_ends(scene, body, edge, v));
  CHECK_FAILS(status, dsw_body_get_face_corners(scene, body, face, v));
  CHECK_FAILS(status, dsw_body_destroy(scene, body));
  CHECK(count == 99 && level == DSW_LEVEL_FACES);
}

static void bad_handles_are_refused(void) {
  const dsw_body_desc d = pyramid();
  dsw_body_id body = make(&d), older = {0, 0}, nobody = {0, 0}, next;
  const dsw_body_edge_id stale_edge = {0, 2}, no_edge = {9, 1};
  const dsw_body_face_id stale_face = {5, 7}, no_face = {6, 1};
  dsw_body_vertex_id v[3];
  dsw_body_counts c;
  const uint32_t *offending = NULL;
  size_t count = 0;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_create(NULL, &d, &next));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_create(g_scene, NULL, &next));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_create(g_scene, &d, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_body_count(NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_body_count(g_scene, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_offending_edges(NULL, &offending, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_offending_edges(g_scene, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_offending_edges(g_scene, &offending, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_counts(g_scene, body, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_level(g_scene, body, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_edge_ends(g_scene, body, (dsw_body_edge_id){0, 1}, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_face_corners(g_scene, body, (dsw_body_face_id){0, 1}, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_edge_ends(g_scene, body, stale_edge, v));
  CHECK_MESSAGE("edge {index 0, generation 2} names no edge of the body");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_edge_ends(g_scene, body, no_edge, v));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_face_corners(g_scene, body, stale_face, v));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_face_corners(g_scene, body, no_face, v));
  c.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_body_get_counts(g_scene, body, &c));
  handles_are_checked(NULL, body, DSW_STATUS_NULL_ARGUMENT);
  handles_are_checked(g_scene, nobody, DSW_STATUS_STALE_ID);
  CHECK_MESSAGE("dsw_body_destroy: body {index 0, generation 0} names no body");
  older = body;
  CHECK_OK(dsw_body_destroy(g_scene, body));
  handles_are_checked(g_scene, older, DSW_STATUS_STALE_ID);
  next = make(&d); /* the same slot, another generation */
  CHECK(next.index == older.index && next.generation > older.generation && body_count() == 1);
  handles_are_checked(g_scene, older, DSW_STATUS_STALE_ID);
  CHECK_OK(dsw_body_destroy(g_scene, next));
}

/* A scene takes its bodies with it; what they take is told. */
static void memory_is_told(void) {
  dsw_scene *scene = make_scene(g_env, 0);
  const dsw_body_desc d = pyramid();
  dsw_body_id body;
  uint64_t before = 0, with = 0;
  CHECK_OK(dsw_scene_get_memory_bytes(scene, &before));
  CHECK_OK(dsw_body_create(scene, &d, &body));
  CHECK_OK(dsw_scene_get_memory_bytes(scene, &with));
  CHECK(with >= before + 5 * 32 + 9 * 16 + 6 * 12);
  CHECK_OK(dsw_scene_destroy(scene));
}

/* The bytes that a square of 40 by 40 vertices takes in a scene. */
static double bytes_a_vertex(dsw_level level, uint32_t flags) {
  enum { SIDE = 40, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };
  static double at[3 * VERTICES];
  static uint32_t offsets[TRIANGLES + 1], corners[3 * TRIANGLES];
  dsw_scene *scene = make_scene(g_env, 0);
  dsw_body_desc d;
  dsw_body_id body;
  uint64_t before = 0, with = 0;
  uint32_t i, k, count = 0;
  for (i = 0; i < VERTICES; ++i) {
    at[3 * i] = 0.1 + (i % SIDE) * 0.045;
    at[3 * i + 1] = 0.1 + (i / SIDE) * 0.045;
    at[3 * i + 2] = 0.4;
  }
  for (i = 0; i < VERTICES - SIDE; ++i) {
    const uint32_t square[6] = {i, i + 1, i + SIDE, i + 1, i + SIDE + 1, i + SIDE};
    if (i % SIDE == SIDE - 1) continue;
    for (k = 0; k < 6; ++k) corners[count++] = square[k];
  }
  CHECK(count == 3 * TRIANGLES);
  for (i = 0; i <= TRIANGLES; ++i) offsets[i] = 3 * i;
  dsw_body_desc_init(&d, sizeof d);
  d.level = level;
  d.flags = flags;
  d.positions = at;
  d.vertex_count = VERTICES;
  d.stride_bytes = 3 * sizeof(double);
  d.face_offsets = offsets;
  d.face_corners = corners;
  d.face_count = TRIANGLES;
  d.face_corner_count = 3 * TRIANGLES;
  CHECK_OK(dsw_scene_get_memory_bytes(scene, &before));
  CHECK_OK(dsw_body_create(scene, &d, &body));
  CHECK_OK(dsw_scene_get_memory_bytes(scene, &with));
  CHECK_OK(dsw_scene_destroy(scene));
  return (double)(with - before) / VERTICES;
}

static void sequences_that_are_left_out_take_no_memory(void) {
  const double edges = bytes_a_vertex(DSW_LEVEL_EDGES, 0);
  const double without = bytes_a_vertex(DSW_LEVEL_EDGES_SWEPT, DSW_BODY_NO_SEQUENCES);
  CHECK(without == edges && without <= 160);
  CHECK(bytes_a_vertex(DSW_LEVEL_EDGES_SWEPT, 0) > without);
  CHECK(bytes_a_vertex(DSW_LEVEL_EDGES_SWEPT, 0) <= 250);
  CHECK(bytes_a_vertex(DSW_LEVEL_EDGES, DSW_BODY_NO_SEQUENCES) == edges);
}

static void in_both(void) {
  bad_members_are_refused();
  bad_topology_is_refused();
  one_that_is_not_free_is_refused();
}

int main(void) {
  begin_stage(2);
  in_both();
  end_stage();
  begin_stage(3);
  in_both();
  init_writes_the_defaults();
  a_body_has_what_was_given();
  back_edges_are_those_of_closed_surfaces_turned_outwards();
  a_face_is_not_free_of_a_marked_edge();
  capacities_are_asked_for();
  bad_handles_are_refused();
  memory_is_told();
  sequences_that_are_left_out_take_no_memory();
  end_stage();
  return check_result();
}
