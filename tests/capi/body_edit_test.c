/* Changes of bodies while they live: the second half of body.h. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "stage.h"

/* The face x = 2 of the cube (1, 1, 0) is marked where something has to be in the way. */
enum { WALL = 1 + N };

static const dsw_body_vertex_id g_gone = {0, 9}, g_nothing = {0, 0};

/* A square of two triangles, 0 1 2 and 0 2 3, at z = 0.5, and a vertex 4 above. Edges: 0 1, 1 2, 2 0, 2 3, 3 0. */
static dsw_body_id make_square(dsw_level level) {
  static const double positions[15] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5, 1.5, 1.5, 0.5, 0.5, 1.5, 0.5, 1.25, 0.75, 1.5};
  static const uint32_t offsets[2] = {0, 4}, corners[4] = {0, 1, 2, 3};
  const dsw_body_desc d = surface_desc(positions, 5, offsets, corners, 1, level);
  dsw_body_id body = {0, 0};
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  return body;
}

static void position_of(dsw_body_id body, uint32_t index, double *xyz) {
  double p[3 * 16];
  size_t count = 0;
  CHECK_OK(dsw_body_get_positions(g_scene, body, p, 16, 0, NULL, &count));
  CHECK(index < count);
  memcpy(xyz, p + 3 * (size_t)index, 3 * sizeof(double));
}

static void mark_wall(dsw_mark mark) { CHECK_OK(mark_face(WALL, FACE_X1, mark)); }

static void vertices_come_and_go(void) {
  const double position[3] = {2.5, 1.5, 0.5}, outside[3] = {-1, 0, 0}, nan_point[3] = {0, NAN, 0};
  const double in_solid[3] = {3.5, 3.5, 2.5};
  dsw_body_id body = make_square(DSW_LEVEL_FACES);
  dsw_body_vertex_id v = {55, 66}, again;
  dsw_volume_id volumes[6];
  dsw_body_counts c;
  double p[18];
  size_t count = 0, i;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_add_vertex(NULL, body, position, no_volume, &v));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_add_vertex(g_scene, body, NULL, no_volume, &v));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_add_vertex(g_scene, body, position, no_volume, NULL));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_body_add_vertex(g_scene, body, nan_point, no_volume, &v));
  CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_body_add_vertex(g_scene, body, outside, no_volume, &v));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_add_vertex(g_scene, body, position, stale_volume, &v));
  CHECK_OK(mark_cell(47, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_IMPASSABLE, dsw_body_add_vertex(g_scene, body, in_solid, no_volume, &v));
  CHECK_OK(mark_cell(47, DSW_MARK_PASSABLE));
  CHECK(v.index == 55 && v.generation == 66 && has(body, 5, 5, 2));
  CHECK_OK(dsw_body_add_vertex(g_scene, body, position, volume_at(3), &v));
  CHECK(v.index == 5 && v.generation == 1 && has(body, 6, 5, 2));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_remove_vertex(g_scene, body, g_gone));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_remove_vertex(g_scene, body, g_nothing));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_remove_vertex(g_scene, body, vertex_id(6)));
  CHECK_OK(dsw_body_remove_vertex(g_scene, body, vertex_id(2))); /* with three edges and both faces */
  CHECK(has(body, 5, 2, 0));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_remove_vertex(g_scene, body, vertex_id(2)));
  c = counts_of(body);
  CHECK(c.vertex_slots == 6 && c.edge_slots == 5 && c.face_slots == 2);
  /* A free slot reads as zeros. */
  memset(p, 0x55, sizeof p);
  CHECK_OK(dsw_body_get_positions(g_scene, body, p, 6, 0, volumes, &count));
  CHECK(count == 6 && p[6] == 0 && p[7] == 0 && p[8] == 0 && volumes[2].index == 0 && volumes[2].generation == 0);
  for (i = 0; i < 6; ++i) CHECK(i == 2 || volumes[i].generation == 1);
  CHECK_OK(dsw_body_add_vertex(g_scene, body, position, no_volume, &again));
  CHECK(again.index == 2 && again.generation == 2 && has(body, 6, 2, 0));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_remove_vertex(g_scene, body, vertex_id(2)));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void edges_come_and_go(void) {
  const double behind[3] = {2.5, 1.5, 0.5};
  dsw_body_id body = make_square(DSW_LEVEL_EDGES);
  dsw_body_vertex_id far;
  dsw_body_edge_id e = {55, 66};
  CHECK_OK(dsw_body_add_vertex(g_scene, body, behind, no_volume, &far));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_add_edge(NULL, body, vertex_id(0), vertex_id(4), &e));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_add_edge(g_scene, body, vertex_id(0), vertex_id(4), NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_add_edge(g_scene, body, g_gone, vertex_id(4), &e));
  CHECK_MESSAGE("a {index 0, generation 9} names no vertex");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_add_edge(g_scene, body, vertex_id(0), g_nothing, &e));
  CHECK_FAILS(DSW_STATUS_REPEATED_VERTEX, dsw_body_add_edge(g_scene, body, vertex_id(4), vertex_id(4), &e));
  CHECK_FAILS(DSW_STATUS_DUPLICATE_PART, dsw_body_add_edge(g_scene, body, vertex_id(1), vertex_id(0), &e));
  mark_wall(DSW_MARK_IMPASSABLE);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_add_edge(g_scene, body, vertex_id(2), far, &e));
  CHECK_MESSAGE("the edge between vertices 2 and 5");
  CHECK(e.index == 55 && e.generation == 66 && has(body, 6, 5, 2));
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_POINTS)); /* no edge is asked about */
  CHECK_OK(dsw_body_add_edge(g_scene, body, vertex_id(2), far, &e));
  CHECK(e.index == 5 && e.generation == 1 && has(body, 6, 6, 2));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES));
  CHECK_OK(dsw_body_remove_edge(g_scene, body, e));
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES));
  mark_wall(DSW_MARK_PASSABLE);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_remove_edge(g_scene, body, e));
  CHECK_OK(dsw_body_remove_edge(g_scene, body, edge_id(2))); /* the diagonal, with both faces */
  CHECK(has(body, 6, 4, 0));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void faces_come_and_go(void) {
  const double tip[3] = {1, 1, 1.5};
  dsw_body_id body = make_square(DSW_LEVEL_FACES);
  dsw_body_face_id f = {55, 66};
  dsw_body_vertex_id v[3], sixth;
  dsw_body_edge_id lone_edge;
  dsw_edge_id marked;
  uint32_t ends[2];
#define ADD(a, b, c) dsw_body_add_face(g_scene, body, vertex_id(a), vertex_id(b), vertex_id(c), &f)
  CHECK_OK(dsw_body_add_vertex(g_scene, body, tip, no_volume, &sixth));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT,
              dsw_body_add_face(g_scene, body, vertex_id(1), vertex_id(0), vertex_id(4), NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_add_face(g_scene, body, vertex_id(1), vertex_id(0), g_gone, &f));
  CHECK_MESSAGE("c {index 0, generation 9}");
  CHECK_FAILS(DSW_STATUS_REPEATED_VERTEX, ADD(1, 0, 1));
  CHECK_FAILS(DSW_STATUS_DUPLICATE_PART, ADD(1, 2, 0));
  CHECK_FAILS(DSW_STATUS_NOT_MANIFOLD, ADD(0, 2, 4));
  CHECK_FAILS(DSW_STATUS_NOT_ORIENTED, ADD(0, 1, 4));
  CHECK(f.index == 55 && f.generation == 66 && has(body, 6, 5, 2));
  CHECK_OK(ADD(1, 0, 4)); /* two edges come with it */
  CHECK(f.index == 2 && f.generation == 1 && has(body, 6, 7, 3));
  CHECK_OK(dsw_body_get_face_corners(g_scene, body, f, v));
  CHECK(v[0].index == 1 && v[1].index == 0 && v[2].index == 4);
  CHECK_OK(dsw_body_remove_face(g_scene, body, f)); /* its edges stay */
  CHECK(has(body, 6, 7, 2));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_remove_face(g_scene, body, f));
  CHECK_OK(dsw_body_remove_edge(g_scene, body, edge_id(5)));
  CHECK_OK(dsw_body_remove_edge(g_scene, body, edge_id(6)));
  /* A marked edge along y at (1, y, 1) would go through the new triangle, but not through its edges. */
  ends[0] = 1 + (N + 1) * (0 + (N + 1));
  ends[1] = ends[0] + N + 1;
  CHECK_OK(dsw_environment_find_edges(g_env, 1, ends, &marked, NULL));
  CHECK_OK(dsw_environment_mark_edges(g_env, &marked, 1, DSW_MARK_IMPASSABLE));
  f.index = 55;
  CHECK_FAILS(DSW_STATUS_OCCUPIED, ADD(1, 0, 5));
  CHECK_MESSAGE("triangle (1, 0, 5)");
  CHECK(f.index == 55 && has(body, 6, 5, 2));
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES_SWEPT));
  CHECK_OK(ADD(1, 0, 5));
  CHECK_OK(dsw_environment_mark_edges(g_env, &marked, 1, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_add_edge(g_scene, body, vertex_id(4), sixth, &lone_edge)); /* an edge without a face */
#undef ADD
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void edges_are_split(void) {
  static const double kShares[5] = {0, 1, -0.5, 1.5, 0};
  const double middle[3] = {0.75, 0.75, 0.5};
  dsw_body_id body = make_square(DSW_LEVEL_FACES);
  dsw_body_vertex_id ends[2];
  dsw_body_edit edit, before;
  double p[3];
  int i;
  memset(&edit, 0x55, sizeof edit);
  before = edit;
  for (i = 0; i < 5; ++i) {
    CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE,
                dsw_body_split_edge(g_scene, body, edge_id(2), i == 4 ? (double)NAN : kShares[i], &edit));
    CHECK_MESSAGE("edge_parameter is ");
  }
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_split_edge(g_scene, body, edge_id(7), 0.5, &edit));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_split_edge(NULL, body, edge_id(2), 0.5, &edit));
  CHECK(memcmp(&edit, &before, sizeof edit) == 0 && has(body, 5, 5, 2));
  CHECK_OK(dsw_body_split_edge(g_scene, body, edge_id(2), 0.75, &edit)); /* 2 0: two faces become four */
  CHECK(edit.vertex.index == 5 && edit.vertex.generation == 1 && edit.inserted == 1 && edit.reserved == 0);
  CHECK(edit.ends[0].index == 2 && edit.ends[1].index == 0 && edit.edge_parameter == 0.75 && edit.edge.index == 2);
  CHECK(edit.edge.generation == 1 && edit.rest.generation == 1 && has(body, 6, 8, 4));
  CHECK_OK(dsw_body_get_edge_ends(g_scene, body, edit.edge, ends));
  CHECK(ends[0].index + ends[1].index == 7); /* 2 and 5 */
  CHECK_OK(dsw_body_get_edge_ends(g_scene, body, edit.rest, ends));
  CHECK(ends[0].index + ends[1].index == 5); /* 5 and 0 */
  position_of(body, 5, p);
  CHECK(memcmp(p, middle, sizeof p) == 0);
  CHECK_OK(dsw_body_split_edge(g_scene, body, edge_id(0), 0.5, NULL)); /* at the rim: one face more */
  CHECK(has(body, 7, 10, 5));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void edges_are_collapsed(void) {
  const double behind[3] = {2.5, 1.5, 0.5};
  dsw_body_id body = make_square(DSW_LEVEL_FACES);
  dsw_body_vertex_id far, v[3];
  dsw_body_edge_id e;
  dsw_body_edit edit, before;
  memset(&edit, 0x55, sizeof edit);
  before = edit;
  CHECK_OK(dsw_body_add_vertex(g_scene, body, behind, no_volume, &far));
  CHECK_OK(dsw_body_add_edge(g_scene, body, vertex_id(1), far, &e));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_collapse_edge(NULL, body, e, far, &edit));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_collapse_edge(g_scene, body, edge_id(8), far, &edit));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_collapse_edge(g_scene, body, e, g_gone, &edit));
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_body_collapse_edge(g_scene, body, e, vertex_id(2), &edit));
  CHECK_MESSAGE("vertex 2 is no end of edge");
  CHECK_FAILS(DSW_STATUS_NOT_MANIFOLD, dsw_body_collapse_edge(g_scene, body, edge_id(2), vertex_id(2), &edit));
  CHECK_MESSAGE("would leave no manifold"); /* an inner edge between two vertices of the rim */
  CHECK_OK(dsw_body_add_edge(g_scene, body, vertex_id(4), far, &e));
  CHECK(has(body, 6, 7, 2) && memcmp(&edit, &before, sizeof edit) == 0);
  CHECK_OK(dsw_body_collapse_edge(g_scene, body, e, far, &edit));
  CHECK(edit.vertex.index == far.index && edit.vertex.generation == far.generation && edit.ends[0].index == 4);
  CHECK(edit.edge.index == e.index && edit.inserted == 0 && edit.reserved == 0 && edit.edge_parameter == 0);
  CHECK(edit.ends[1].generation == 0 && edit.rest.generation == 0);
  CHECK(has(body, 5, 6, 2)); /* 1 4 is what became of 1 5 */
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_remove_vertex(g_scene, body, far));
  CHECK_OK(dsw_body_collapse_edge(g_scene, body, edge_id(0), vertex_id(0), NULL)); /* the face 0 1 2 goes with it */
  CHECK(has(body, 4, 4, 1));
  CHECK_OK(dsw_body_get_face_corners(g_scene, body, face_id(1), v));
  CHECK(v[0].index + v[1].index + v[2].index == 6); /* 1 2 3 */
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* The way of 0 to 1 is free; but on it the edge 0 2 meets the wall. */
static void a_collapse_is_swept(void) {
  const double positions[9] = {0.5, 0.5, 0.5, 3.5, 0.5, 0.5, 1.5, 3.5, 0.5};
  const uint32_t edges[4] = {0, 1, 0, 2};
  dsw_body_edit edit, before;
  dsw_body_desc d = line_desc(positions, 3, 0, DSW_LEVEL_EDGES_SWEPT);
  dsw_body_id body = {0, 0};
  double p[3];
  memset(&edit, 0x55, sizeof edit);
  before = edit;
  d.edges = edges;
  mark_wall(DSW_MARK_IMPASSABLE);
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_collapse_edge(g_scene, body, edge_id(0), vertex_id(0), &edit));
  CHECK_MESSAGE("the path from vertex 0 to vertex 1 is not free");
  CHECK(memcmp(&edit, &before, sizeof edit) == 0 && has(body, 3, 2, 0));
  position_of(body, 0, p);
  CHECK(memcmp(p, positions, sizeof p) == 0);
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_POINTS));
  CHECK_OK(dsw_body_collapse_edge(g_scene, body, edge_id(0), vertex_id(0), &edit));
  CHECK(has(body, 2, 1, 0));
  mark_wall(DSW_MARK_PASSABLE);
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void all_is_read_at_once(void) {
  const dsw_body_id body = make_square(DSW_LEVEL_FACES), stale = {99, 1};
  dsw_body_vertex_id v = {7, 7};
  uint32_t pairs[10], triples[6], none = 77;
  size_t count = 55;
  CHECK_OK(dsw_body_get_vertex_id(g_scene, body, 4, &v));
  CHECK(v.index == 4 && v.generation == 1);
  v = g_gone;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_get_vertex_id(g_scene, body, 5, &v));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_get_vertex_id(g_scene, body, 0xffffffffu, &v));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_vertex_id(g_scene, body, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_vertex_id(NULL, body, 0, &v));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_vertex_id(g_scene, stale, 0, &v));
  CHECK(v.index == g_gone.index && v.generation == g_gone.generation);

  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_body_get_edge_indices(g_scene, body, &none, 0, &count));
  CHECK(count == 5 && none == 77);
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_body_get_face_indices(g_scene, body, &none, 1, &count));
  CHECK(count == 2 && none == 77);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_edge_indices(g_scene, body, NULL, 5, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_face_indices(g_scene, body, triples, 2, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_edge_indices(g_scene, stale, pairs, 5, &count));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_face_indices(g_scene, stale, triples, 2, &count));
  CHECK_OK(dsw_body_get_edge_indices(g_scene, body, pairs, 5, &count));
  CHECK(count == 5 && pairs[0] == 0 && pairs[1] == 1 && pairs[8] == 3 && pairs[9] == 0);
  CHECK_OK(dsw_body_get_face_indices(g_scene, body, triples, 2, &count));
  CHECK(count == 2 && triples[0] == 0 && triples[1] == 1 && triples[2] == 2 && triples[5] == 3);

  CHECK_OK(dsw_body_remove_edge(g_scene, body, edge_id(0))); /* and face 0 with it */
  CHECK_OK(dsw_body_get_edge_indices(g_scene, body, pairs, 5, &count));
  CHECK(count == 5 && pairs[0] == 0xffffffffu && pairs[1] == 0xffffffffu && pairs[2] == 1);
  CHECK_OK(dsw_body_get_face_indices(g_scene, body, triples, 2, &count));
  CHECK(triples[0] == 0xffffffffu && triples[2] == 0xffffffffu && triples[3] == 0);
  CHECK_OK(dsw_body_remove_vertex(g_scene, body, vertex_id(4)));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_get_vertex_id(g_scene, body, 4, &v));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

int main(void) {
  begin_stage(3);
  vertices_come_and_go();
  edges_come_and_go();
  faces_come_and_go();
  edges_are_split();
  edges_are_collapsed();
  a_collapse_is_swept();
  all_is_read_at_once();
  end_stage();
  return check_result();
}
