/* topology.h: every operation once with what it returns, every way to be refused, and what bodies and particles say
   to it. What is alike in space and in the plane runs in both: on 3 x 1 x 1 unit cubes or, in the plane, 3 x 1 unit
   squares along x. */
#include <string.h>

#include "check.h"
#include "fixture.h"

enum { SIDE_RIGHT = 1, SIDE_UP = 2, SIDE_LEFT = 3 };

static unsigned g_dimension;
static dsw_environment *g_env;

static void use_dimension(unsigned dimension) {
  g_dimension = dimension;
  check_in(dimension == 3 ? "in space" : "in the plane");
}

static void begin(void) { g_env = g_dimension == 3 ? make_environment(NULL, 3, 1, 1) : make_squares(NULL, 3, 1); }

/* What changes must leave a partition of as much space as it was: `boundary` faces on the outside. */
static void end(uint32_t volumes, uint32_t boundary) {
  const dsw_environment_info info = info_of(g_env);
  CHECK(info.volume_count == volumes && info.boundary_face_count == boundary);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  CHECK_OK(dsw_environment_destroy(g_env));
}

/* In the plane z is 0. */
static uint32_t corner_index(unsigned x, unsigned y, unsigned z) { return x + 4 * (y + 2 * z); }

static dsw_vertex_id corner(unsigned x, unsigned y, unsigned z) { return vertex_at(corner_index(x, y, z)); }

/* The face with these vertices. */
static dsw_face_id find_face(unsigned count, const uint32_t *corners) {
  size_t offsets[2] = {0, 0}, missing = 9;
  dsw_face_id face = {9, 9, 9};
  offsets[1] = count;
  CHECK_OK(dsw_environment_find_faces(g_env, 1, offsets, corners, &face, &missing));
  CHECK(missing == 0);
  return face;
}

/* The face of the cells at x. */
static dsw_face_id wall(unsigned x) {
  const uint32_t corners[4] = {corner_index(x, 0, 0), corner_index(x, 1, 0), corner_index(x, 1, 1),
                               corner_index(x, 0, 1)};
  return find_face(g_dimension == 3 ? 4 : 2, corners);
}

static size_t change_count(void) { return change_of(g_env).volume_count; }

static uint32_t part_count(void) { return info_of(g_env).part_count; }

static dsw_edge_id find_edge(uint32_t a, uint32_t b) {
  uint32_t ends[2];
  size_t missing = 9;
  dsw_edge_id edge = {9, 9, 9};
  ends[0] = a, ends[1] = b;
  CHECK_OK(dsw_environment_find_edges(g_env, 1, ends, &edge, &missing));
  CHECK(missing == 0);
  return edge;
}

static dsw_face_id side_between(uint32_t a, uint32_t b) {
  const uint32_t ends[2] = {a, b};
  return find_face(2, ends);
}
/* A side as the edge that it is, back, and as a cell. */
static dsw_edge_id as_edge(dsw_face_id side) { return (dsw_edge_id){side.volume, side.generation, side.local}; }
static dsw_face_id as_side(dsw_edge_id edge) { return (dsw_face_id){edge.volume, edge.generation, edge.local}; }
static dsw_cell as_cell(dsw_face_id side) {
  return (dsw_cell){DSW_CELL_FACE, side.volume, side.generation, side.local};
}

/* In the plane it has that many sides. */
static int has_type(dsw_volume_id volume, dsw_cell_type type, uint32_t sides) {
  dsw_cell_type found = DSW_CELL_TYPE_NONE;
  uint32_t vertices = 0, edges = 9, faces = 0;
  CHECK_OK(dsw_environment_get_volume_counts(g_env, volume, &found, &vertices, &edges, &faces));
  return found == type && (g_dimension == 3 || (vertices == sides && faces == sides && edges == 0));
}

static void sewing(void) {
  dsw_face_id face, other, twice[2];
  begin();
  face = wall(1);
  other = face_at(1, g_dimension == 3 ? FACE_X0 : SIDE_LEFT);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_sew_faces(g_env, &face, &other, 1));
  CHECK_MESSAGE("not on the outer boundary");
  CHECK_OK(dsw_environment_unsew_face(g_env, face));
  CHECK(part_count() == 2 && change_count() == 0);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_unsew_face(g_env, face));
  twice[0] = twice[1] = face;
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_sew_faces(g_env, twice, twice, 2));
  twice[0] = face_at(2, FACE_X1);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_sew_faces(g_env, &face, twice, 1));
  CHECK_MESSAGE("same vertices");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_sew_faces(g_env, NULL, &other, 1));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_sew_faces(NULL, &face, &other, 1));
  if (g_dimension == 3) CHECK_OK(dsw_environment_sew_faces(g_env, &face, &other, 1));
  if (g_dimension == 2) CHECK_OK(dsw_environment_sew_faces(g_env, &other, &face, 1));
  CHECK(part_count() == 1);
  end(3, g_dimension == 3 ? 14 : 8);
}

static void bad_splits_in_space(dsw_volume_id merged) {
  dsw_vertex_id loop[4];
  dsw_volume_id parts[2];
  dsw_face_id face;
  loop[0] = corner(1, 0, 0), loop[1] = corner(1, 1, 0), loop[2] = corner(1, 1, 1), loop[3] = corner(1, 0, 1);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_split_volume(g_env, merged, loop, 2, parts, &face));
  loop[0] = corner(2, 0, 0);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_split_volume(g_env, merged, loop, 4, parts, &face));
  CHECK_MESSAGE("no edge");
}

static void bad_splits_in_the_plane(dsw_volume_id merged) {
  dsw_vertex_id loop[3];
  dsw_volume_id parts[2];
  dsw_face_id side;
  loop[0] = corner(1, 0, 0), loop[1] = corner(1, 1, 0), loop[2] = corner(0, 1, 0);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_split_volume(g_env, merged, loop, 3, parts, &side));
  CHECK_MESSAGE("in the plane it must have 2");
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_split_volume(g_env, merged, loop + 1, 2, parts, &side));
  CHECK_MESSAGE("joined already");
  loop[2] = corner(3, 0, 0);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_split_volume(g_env, merged, loop + 1, 2, parts, &side));
  CHECK_MESSAGE("does not have vertex 3");
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_split_volume(g_env, merged, loop, 1, parts, &side));
}

static void merging_and_splitting_volumes(void) {
  const double left[3] = {0.5, 0.5, 0.5};
  const dsw_volume_change *changes = NULL;
  dsw_volume_id merged = {0, 0}, parts[2];
  dsw_vertex_id loop[4];
  dsw_face_id face = {0, 0, 0};
  uint32_t tag = 0;
  const size_t corners = g_dimension == 3 ? 4 : 2;
  size_t count = 0, i;
  begin();
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY,
              dsw_environment_merge_volumes(g_env, face_at(0, g_dimension == 3 ? FACE_X0 : SIDE_LEFT), &merged));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_merge_volumes(g_env, face_at(7, 0), &merged));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_merge_volumes(g_env, face_at(0, 6), &merged));
  CHECK_OK(dsw_environment_merge_volumes(g_env, face_at(0, FACE_X1), &merged));
  CHECK(merged.index == 0 && merged.generation == 2);
  changes = change_of(g_env).volumes;
  count = change_of(g_env).volume_count;
  CHECK(count == 2 && changes[0].before.index == 0 && changes[0].before.generation == 1);
  CHECK(count == 2 && changes[1].before.index == 1 && changes[1].after.index == 0 && changes[1].after.generation == 2);
  CHECK(has_type(merged, g_dimension == 3 ? DSW_CELL_TYPE_POLYHEDRON : DSW_CELL_TYPE_POLYGON, 6));
  CHECK_OK(dsw_environment_get_tag(g_env, merged, &tag));
  CHECK(tag == 100);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_tag(g_env, volume_at(0), &tag));
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_environment_get_volume_id(g_env, 1, &parts[0]));

  if (g_dimension == 3) bad_splits_in_space(merged);
  if (g_dimension == 2) bad_splits_in_the_plane(merged);
  loop[0] = corner(1, 0, 0), loop[1] = corner(1, 1, 0);
  if (g_dimension == 3) loop[2] = corner(1, 1, 1), loop[3] = corner(1, 0, 1);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_split_volume(g_env, volume_at(0), loop, corners, parts, &face));
  CHECK_OK(dsw_environment_split_volume(g_env, merged, loop, corners, parts, &face));
  CHECK(parts[0].index == 0 && parts[0].generation == 3 && parts[1].index == 1 && parts[1].generation == 2);
  CHECK(face.volume == 0 && face.generation == 3);
  for (i = 0; i < 2; ++i)
    CHECK(has_type(parts[i], g_dimension == 3 ? DSW_CELL_TYPE_HEXAHEDRON : DSW_CELL_TYPE_QUAD, 4));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_split_volume(g_env, parts[0], NULL, corners, NULL, NULL));
  /* In the plane, what lies on the left of the way up is the first square. */
  CHECK_OK(dsw_environment_locate(g_env, left, no_volume, &merged, NULL));
  CHECK(g_dimension == 3 || merged.index == parts[0].index);
  for (i = 0; i < 2; ++i) {
    CHECK_OK(dsw_environment_mark_volumes(g_env, &parts[i], 1, DSW_MARK_IMPASSABLE, 0, NULL));
    CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_merge_volumes(g_env, face, NULL));
    CHECK_MESSAGE("marked");
    CHECK_OK(dsw_environment_mark_volumes(g_env, &parts[i], 1, DSW_MARK_PASSABLE, 0, NULL));
  }
  end(3, g_dimension == 3 ? 14 : 8);
}

/* In the plane: two corners in a row with a third between them. Nothing lies on that side. */
static void splitting_off_nothing(void) {
  dsw_volume_id volume = {0, 0};
  dsw_vertex_id loop[2];
  begin();
  loop[0] = corner(0, 0, 0), loop[1] = corner(1, 0, 0);
  CHECK_OK(dsw_environment_split_edge(g_env, as_edge(side_between(0, 1)), 0.5, NULL, NULL));
  CHECK_OK(dsw_environment_get_volume_id(g_env, 0, &volume));
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_split_volume(g_env, volume, loop, 2, NULL, NULL));
  end(3, 9);
}

static void removing_and_adding_volumes(void) {
  const int space = g_dimension == 3;
  const size_t face_corners = space ? 4 : 2; /* of a face */
  dsw_volumes_desc d;
  dsw_vertex_id old[8], fresh[4];
  dsw_volume_id middle = volume_at(1), added[2] = {{0, 0}, {0, 0}}, all[3];
  dsw_face_id sew_to[2];
  double xyz[12] = {4, 0, 0, 4, 1, 0, 4, 1, 1, 4, 0, 1}, xy[4] = {4, 0, 4, 1}, *const x = space ? xyz : xy + 2;
  int64_t cube[8] = {0, 4, 5, 1, 3, 7, 6, 2}, square[4] = {0, 2, 3, 1}, *const last = space ? cube + 7 : square + 3;
  const int64_t offsets[3] = {0, 3, 6}, fan[6] = {0, 2, 3, 0, 3, 1}, right = *last;
  int32_t regions[2] = {7, 7}, region = 0;
  unsigned i;
  begin();
  for (i = 0; i < 3; ++i) all[i] = volume_at(i);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_remove_volumes(g_env, all, 3));
  CHECK_OK(dsw_environment_remove_volumes(g_env, &middle, 1));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_remove_volumes(g_env, &middle, 1));
  CHECK(part_count() == 2 && change_count() == 1);

  dsw_volumes_desc_init(&d, sizeof d);
  for (i = 0; i < 2 * face_corners; ++i) {
    const size_t at = i % face_corners;
    old[i] = corner(1 + (i >= face_corners), at == 1 || at == 2, at >= 2);
  }
  d.vertices = old;
  d.vertex_count = d.connectivity_count = 2 * face_corners;
  d.volume_count = 1;
  d.connectivity = space ? cube : square;
  d.regions = regions;
  d.sew_to = sew_to;
  d.sew_count = 2;
  sew_to[0] = face_at(0, SIDE_RIGHT), sew_to[1] = face_at(2, space ? (uint32_t)FACE_X1 : SIDE_UP);
  if (!space) {
    CHECK_FAILS(DSW_STATUS_BAD_CELL_TYPE, dsw_environment_add_volumes(g_env, &d, added, NULL)); /* a hexahedron */
    d.uniform_cell_type = DSW_CELL_TYPE_POLYGON;
    CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_add_volumes(g_env, &d, added, NULL));
    d.uniform_cell_type = DSW_CELL_TYPE_QUAD;
  }
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_environment_add_volumes(g_env, &d, added, NULL));
  sew_to[1] = face_at(2, space ? (uint32_t)FACE_X0 : SIDE_LEFT);
  *last = 8;
  CHECK_FAILS(DSW_STATUS_INDEX_OUT_OF_RANGE, dsw_environment_add_volumes(g_env, &d, added, NULL));
  *last = 3; /* twice */
  CHECK_FAILS(DSW_STATUS_BAD_CELL, dsw_environment_add_volumes(g_env, &d, added, NULL));
  *last = right;
  if (!space) { /* clockwise: its sides run along those of the others, not against them */
    square[1] = 1, square[3] = 2;
    CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_environment_add_volumes(g_env, &d, added, NULL));
    square[1] = 2, square[3] = 1;
  }
  d.uniform_cell_type = space ? 11 : DSW_CELL_TYPE_HEXAHEDRON;
  CHECK_FAILS(DSW_STATUS_BAD_CELL_TYPE, dsw_environment_add_volumes(g_env, &d, added, NULL));
  d.uniform_cell_type = space ? DSW_CELL_TYPE_HEXAHEDRON : DSW_CELL_TYPE_QUAD;
  --d.connectivity_count;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_add_volumes(g_env, &d, added, NULL));
  ++d.connectivity_count;
  d.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_add_volumes(g_env, &d, added, NULL));
  d.struct_size = sizeof d;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_add_volumes(g_env, NULL, added, NULL));
  CHECK_OK(dsw_environment_add_volumes(g_env, &d, added, NULL));
  CHECK(added[0].index == 1 && added[0].generation == 2 && part_count() == 1);
  CHECK_OK(dsw_environment_get_region(g_env, added[0], &region));
  CHECK(region == 7);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_add_volumes(g_env, &d, added, NULL));

  /* On the right end a cube, or two triangles, which share their long side. */
  for (i = 0; i < face_corners; ++i) old[i] = corner(3, i == 1 || i == 2, i >= 2);
  d.vertex_count = d.point_count = face_corners;
  d.points = space ? xyz : xy;
  if (!space) {
    d.uniform_cell_type = DSW_CELL_TYPE_TRIANGLE;
    d.volume_count = 2;
    d.offsets = offsets;
    d.connectivity = fan;
    d.connectivity_count = 6;
  }
  sew_to[0] = face_at(2, SIDE_RIGHT);
  d.sew_count = 1;
  *x = 3;
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_add_volumes(g_env, &d, added, fresh));
  CHECK_MESSAGE(space ? "new volume 0" : "new volume 1");
  *x = 4;
  x[1] = 1e300 * 1e300;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_add_volumes(g_env, &d, added, fresh));
  x[1] = space ? 0 : 1;
  d.point_stride_bytes = 8;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_add_volumes(g_env, &d, added, fresh));
  d.point_stride_bytes = 8 * g_dimension;
  CHECK_OK(dsw_environment_add_volumes(g_env, &d, added, fresh));
  CHECK(added[0].index == 3 && fresh[0].index == (space ? 16 : 8) && fresh[face_corners - 1].index == (space ? 19 : 9));
  if (!space) CHECK(added[1].index == 4 && has_type(added[1], DSW_CELL_TYPE_TRIANGLE, 3));
  CHECK_OK(dsw_environment_remove_volumes(g_env, added, 1));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_vertex_position(g_env, fresh[0], xyz));
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_environment_get_vertex_id(g_env, fresh[0].index, &fresh[1]));
  if (space) {
    CHECK_OK(dsw_environment_add_volumes(g_env, &d, NULL, fresh));
    CHECK(fresh[0].generation == 2);
  }
  end(4, space ? 18 : 9);
}

/* In space. */
static void faces_and_edges(void) {
  dsw_face_id halves[2], whole = {0, 0, 0};
  dsw_edge_id diagonal = {0, 0, 0}, lower, parts[2], merged = {0, 0, 0};
  dsw_vertex_id middle = {0, 0};
  double xyz[3];
  begin();
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY,
              dsw_environment_split_face(g_env, wall(1), corner(1, 0, 0), corner(1, 1, 0), halves, &diagonal));
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY,
              dsw_environment_split_face(g_env, wall(1), corner(1, 0, 0), corner(2, 1, 0), halves, &diagonal));
  CHECK_OK(dsw_environment_split_face(g_env, wall(1), corner(1, 0, 0), corner(1, 1, 1), halves, &diagonal));
  CHECK(change_count() == 2 && halves[0].volume == 0 && halves[0].generation == 2);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY,
              dsw_environment_merge_faces(g_env, find_edge(corner_index(1, 0, 0), corner_index(1, 1, 0)), &whole));
  CHECK_OK(dsw_environment_merge_faces(g_env, diagonal, &whole));
  CHECK(whole.volume == 0 && whole.generation == 3);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_merge_faces(g_env, diagonal, &whole));

  lower = find_edge(corner_index(1, 0, 0), corner_index(1, 1, 0));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_split_edge(g_env, lower, 0, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_split_edge(g_env, lower, 1, NULL, NULL));
  CHECK_OK(dsw_environment_split_edge(g_env, lower, 0.25, &middle, parts));
  CHECK(middle.index == 16 && change_count() == 2);
  CHECK_OK(dsw_environment_get_vertex_position(g_env, middle, xyz));
  CHECK(xyz[0] == 1 && xyz[2] == 0 && xyz[1] == 0.25);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_merge_edges(g_env, parts[0], corner(2, 0, 0), &merged));
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY,
              dsw_environment_merge_edges(g_env, find_edge(corner_index(1, 0, 0), corner_index(1, 0, 1)),
                                          corner(1, 0, 1), &merged));
  CHECK_OK(dsw_environment_merge_edges(g_env, parts[1], middle, &merged));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_vertex_position(g_env, middle, xyz));
  /* Collapsing a long edge would take the cubes' corner off. */
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_collapse_edge(g_env, merged, corner(1, 0, 0)));
  CHECK_MESSAGE("outer boundary");
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_collapse_edge(g_env, merged, corner(3, 0, 0)));
  /* A vertex that was put on an edge goes back into its end. */
  CHECK_OK(dsw_environment_split_edge(g_env, merged, 0.5, &middle, parts));
  CHECK_OK(dsw_environment_collapse_edge(g_env, parts[0], middle));
  end(3, 14);
}

/* In the plane, as the next. */
static void sides(void) {
  dsw_edge_id parts[2], merged = {0, 0, 0};
  dsw_face_id side, mark[2], none[2];
  dsw_vertex_id middle = {0, 0}, ends[2];
  double xy[3] = {9, 9, 9};
  size_t count = 0;
  int impassable = 9;
  begin();
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED,
              dsw_environment_split_face(g_env, wall(1), corner(1, 0, 0), corner(1, 1, 0), none, NULL));
  CHECK_MESSAGE("dsw_environment_split_edge");
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_merge_faces(g_env, edge_at(0, 0), none));
  CHECK_MESSAGE("dsw_environment_merge_edges");
  mark[0] = wall(1);
  CHECK_OK(dsw_environment_mark_faces(g_env, mark, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_split_edge(g_env, as_edge(wall(1)), 1, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_split_edge(g_env, edge_at(1, 4), 0.5, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_split_edge(g_env, edge_at(7, 0), 0.5, NULL, NULL));
  /* Named by the square on its right the side runs downwards. */
  CHECK_OK(dsw_environment_split_edge(g_env, edge_at(1, SIDE_LEFT), 0.25, &middle, parts));
  CHECK(middle.index == 8 && change_count() == 2);
  CHECK_OK(dsw_environment_get_vertex_position(g_env, middle, xy));
  CHECK(xy[0] == 1 && xy[1] == 0.75 && xy[2] == 9);
  side = as_side(parts[0]);
  CHECK(side.volume == 0 && side.generation == 2);
  CHECK_OK(dsw_environment_copy_vertices(g_env, as_cell(side), ends, 2, &count));
  CHECK(count == 2 && ends[0].index == 8 && ends[1].index == 5);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_merge_edges(g_env, parts[0], corner(2, 0, 0), &merged));
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_merge_edges(g_env, parts[0], corner(1, 1, 0), &merged));
  CHECK_MESSAGE("more than two edges");
  mark[0] = side;
  CHECK_OK(dsw_environment_mark_faces(g_env, mark, 1, DSW_MARK_PASSABLE));
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_merge_edges(g_env, parts[0], middle, &merged));
  CHECK_MESSAGE("marked");
  CHECK_OK(dsw_environment_mark_faces(g_env, mark, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_merge_edges(g_env, parts[1], middle, &merged));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_vertex_position(g_env, middle, xy));
  side = as_side(merged);
  CHECK(side.volume == 0 && side.generation == 3);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_collapse_edge(g_env, merged, corner(1, 0, 0)));
  CHECK_MESSAGE("outer boundary");
  CHECK_OK(dsw_environment_split_edge(g_env, merged, 0.5, &middle, parts));
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_collapse_edge(g_env, parts[0], corner(0, 0, 0)));
  CHECK_OK(dsw_environment_collapse_edge(g_env, parts[0], middle));
  CHECK_OK(dsw_environment_is_impassable(g_env, as_cell(wall(1)), &impassable));
  CHECK(impassable == 1);
  end(3, 8);
}

/* A square fan whose middle goes; what is flat then goes with it, and two sides become one. */
static void collapsing_a_side(void) {
  static const double points[5][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 1}};
  static const int64_t fan[12] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
  static const double high[2] = {2, 3.5}, low[2] = {2, 0.5};
  const dsw_environment_desc d = polygons_desc(points[0], 5, DSW_CELL_TYPE_TRIANGLE, fan, 4);
  dsw_particle_id particles[2];
  dsw_volume_id where[2], found;
  dsw_scene *scene;
  unsigned i;
  CHECK_OK(dsw_environment_create(NULL, &d, &g_env, NULL));
  scene = make_scene(g_env, DSW_FEATURE_LIVE_CHANGES);
  CHECK_OK(dsw_particle_create(scene, high, no_volume, &particles[0]));
  CHECK_OK(dsw_particle_create(scene, low, no_volume, &particles[1]));
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_collapse_edge(g_env, as_edge(side_between(0, 4)), vertex_at(0)));
  CHECK_MESSAGE("outer boundary");
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_collapse_edge(g_env, as_edge(side_between(0, 4)), vertex_at(2)));
  CHECK_OK(dsw_environment_collapse_edge(g_env, as_edge(side_between(4, 1)), vertex_at(4)));
  CHECK(change_count() == 4);
  for (i = 0; i < 2; ++i) {
    CHECK_OK(dsw_particle_get_position(scene, particles[i], NULL, &where[i]));
    CHECK_OK(dsw_environment_locate(g_env, i == 0 ? high : low, no_volume, &found, NULL));
    CHECK(where[i].index == found.index && where[i].generation == found.generation && found.generation == 2);
  }
  CHECK(where[0].index != where[1].index);
  CHECK_OK(dsw_scene_destroy(scene));
  end(2, 4);
}

static void borrowed_points(void) {
  grid g = grid_create(3, 1, 1);
  dsw_environment_desc d = g_dimension == 3 ? grid_desc(&g) : squares_desc(&g);
  dsw_volume_id last = volume_at(2);
  double xyz[3];
  d.flags = DSW_ENVIRONMENT_BORROW_POINTS;
  CHECK_OK(dsw_environment_create(NULL, &d, &g_env, NULL));
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_split_edge(g_env, edge_at(0, 0), 0.5, NULL, NULL));
  CHECK_OK(dsw_environment_remove_volumes(g_env, &last, 1));
  CHECK_OK(dsw_environment_get_vertex_position(g_env, corner(3, 0, 0), xyz));
  if (g_dimension == 2) CHECK_OK(dsw_environment_merge_edges(g_env, edge_at(0, 0), corner(0, 0, 0), NULL));
  end(2, g_dimension == 3 ? 10 : 5);
  grid_destroy(&g);
}

/* Particles follow; what would leave one without a volume, or a body not free, is refused and named. */
static void what_is_inside(void) {
  static const double inside[3] = {1.5, 0.5, 0.5}, in_space[6] = {0.5, 0.25, 0.5, 2.5, 0.25, 0.5};
  static const double in_plane[4] = {0.5, 0.25, 2.5, 0.25};
  const dsw_particle_id *particles = NULL;
  const dsw_body_id *bodies = NULL;
  dsw_particle_id particle;
  const dsw_body_desc d = line_desc(g_dimension == 3 ? in_space : in_plane, 2, 0, DSW_LEVEL_EDGES);
  dsw_body_id body;
  dsw_volume_id middle = volume_at(1), where = {0, 0}, merged;
  dsw_scene *scene, *second;
  size_t count = 0;
  begin();
  scene = make_scene(g_env, 0);
  CHECK_OK(dsw_particle_create(scene, inside, no_volume, &particle));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_remove_volumes(g_env, &middle, 1));
  CHECK_OK(dsw_scene_get_occupants(scene, &particles, &count));
  CHECK(count == 1 && particles[0].index == particle.index);
  CHECK_OK(dsw_body_create(scene, &d, &body));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_unsew_face(g_env, wall(1)));
  CHECK_OK(dsw_scene_get_occupants(scene, &particles, &count));
  CHECK(count == 0);
  CHECK_OK(dsw_scene_get_occupant_bodies(scene, &bodies, &count));
  CHECK(count == 1 && bodies[0].index == body.index);
  CHECK(part_count() == 1);
  CHECK_OK(dsw_environment_merge_volumes(g_env, wall(1), &merged));
  CHECK_OK(dsw_particle_get_position(scene, particle, NULL, &where));
  CHECK(where.index == merged.index && where.generation == merged.generation);
  second = make_scene(g_env, 0);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_unsew_face(g_env, wall(2)));
  CHECK_OK(dsw_scene_destroy(second));
  CHECK_OK(dsw_scene_destroy(scene));
  end(2, g_dimension == 3 ? 14 : 8);
}

static void snapshots_keep_what_has_changed(void) {
  static unsigned char block[2][8192];
  dsw_environment *loaded = NULL;
  dsw_volume_id merged, ids[2];
  dsw_face_id face;
  size_t size = 0, again = 0;
  begin();
  CHECK_OK(dsw_environment_merge_volumes(g_env, wall(1), &merged));
  CHECK_OK(dsw_environment_save(g_env, block[0], sizeof block[0], &size));
  CHECK_OK(dsw_environment_load(NULL, block[0], size, &loaded));
  CHECK_OK(dsw_environment_save(loaded, block[1], sizeof block[1], &again));
  CHECK(again == size && memcmp(block[0], block[1], size) == 0);
  /* What comes next gets the same ids, and leaves the same behind. */
  face = wall(2);
  CHECK_OK(dsw_environment_merge_volumes(g_env, face, &ids[0]));
  CHECK_OK(dsw_environment_merge_volumes(loaded, face, &ids[1]));
  CHECK(ids[0].index == ids[1].index && ids[0].generation == ids[1].generation);
  CHECK_OK(dsw_environment_save(g_env, block[0], sizeof block[0], &size));
  CHECK_OK(dsw_environment_save(loaded, block[1], sizeof block[1], &again));
  CHECK(again == size && memcmp(block[0], block[1], size) == 0);
  CHECK_OK(dsw_environment_destroy(loaded));
  end(1, g_dimension == 3 ? 14 : 8);
}

static void in_both(void) {
  sewing();
  merging_and_splitting_volumes();
  removing_and_adding_volumes();
  borrowed_points();
  what_is_inside();
  snapshots_keep_what_has_changed();
}

int main(void) {
  use_dimension(2);
  in_both();
  splitting_off_nothing();
  sides();
  collapsing_a_side();
  use_dimension(3);
  in_both();
  faces_and_edges();
  return check_result();
}
