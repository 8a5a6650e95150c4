/* topology.h in the plane: what topology_test.c does not say of both dimensions. */
#include "check.h"
#include "strip.h"

static dsw_face_id side_between(uint32_t a, uint32_t b) {
  const uint32_t ends[2] = {a, b};
  return find_face(2, ends);
}
/* A side as the edge that it is, and back. */
static dsw_edge_id as_edge(dsw_face_id side) {
  dsw_edge_id edge;
  edge.volume = side.volume, edge.generation = side.generation, edge.local = side.local;
  return edge;
}
static dsw_face_id as_side(dsw_edge_id edge) {
  dsw_face_id side;
  side.volume = edge.volume, side.generation = edge.generation, side.local = edge.local;
  return side;
}

static int has_type(dsw_volume_id volume, dsw_cell_type type, uint32_t sides) {
  dsw_cell_type found = DSW_CELL_TYPE_NONE;
  uint32_t vertices = 0, edges = 9, faces = 0;
  CHECK_OK(dsw_environment_get_volume_counts(g_env, volume, &found, &vertices, &edges, &faces));
  return found == type && vertices == sides && faces == sides && edges == 0;
}
static uint32_t part_count(void) { return info_of(g_env).part_count; }
static dsw_cell face_cell(dsw_face_id side) {
  dsw_cell cell = cell_at(DSW_CELL_FACE, side.volume, side.local);
  cell.generation = side.generation;
  return cell;
}
static int is_impassable(dsw_face_id side) {
  int impassable = 9;
  CHECK_OK(dsw_environment_is_impassable(g_env, face_cell(side), &impassable));
  return impassable;
}

static void splitting_at_two_corners(void) {
  dsw_volume_id merged = {0, 0}, parts[2];
  dsw_vertex_id loop[2];
  dsw_face_id side = {0, 0, 0};
  begin();
  CHECK_OK(dsw_environment_merge_volumes(g_env, wall(1), &merged));
  loop[0] = corner(1, 0, 0), loop[1] = corner(1, 1, 0);
  CHECK_OK(dsw_environment_split_volume(g_env, merged, loop, 2, parts, &side));
  CHECK(parts[0].index == 0 && parts[0].generation == 3 && parts[1].index == 1 && parts[1].generation == 2);
  CHECK(side.volume == 0 && side.generation == 3);
  CHECK(has_type(parts[0], DSW_CELL_TYPE_QUAD, 4) && has_type(parts[1], DSW_CELL_TYPE_QUAD, 4));
  /* What lies on the left of the way up is the first square. */
  CHECK_OK(dsw_environment_locate(g_env, (const double[2]){0.5, 0.5}, no_volume, &merged, NULL));
  CHECK(merged.index == parts[0].index);
  /* Two corners in a row with a third between them: nothing lies on that side. */
  CHECK_OK(dsw_environment_split_edge(g_env, as_edge(side_between(0, 1)), 0.5, NULL, NULL));
  CHECK_OK(dsw_environment_get_volume_id(g_env, 0, &merged));
  loop[0] = corner(0, 0, 0), loop[1] = corner(1, 0, 0);
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_split_volume(g_env, merged, loop, 2, NULL, NULL));

  CHECK_OK(dsw_environment_get_volume_id(g_env, 1, &merged));
  CHECK_OK(dsw_environment_mark_volumes(g_env, &merged, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_merge_volumes(g_env, wall(1), NULL));
  CHECK_MESSAGE("marked");
  end(3, 9);
}

static void removing_and_adding_volumes(void) {
  dsw_volumes_desc d;
  dsw_vertex_id old[4], fresh[2];
  dsw_volume_id middle = volume_at(1), added[2], all[3];
  dsw_face_id sew_to[2];
  double xy[4] = {4, 0, 4, 1};
  int64_t quad[4] = {0, 1, 2, 3}, fan[7] = {0, 2, 3, 0, 3, 1, 0};
  const int64_t offsets[3] = {0, 3, 6};
  unsigned i;
  begin();
  for (i = 0; i < 3; ++i) all[i] = volume_at(i);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_remove_volumes(g_env, all, 3));
  CHECK_OK(dsw_environment_remove_volumes(g_env, &middle, 1));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_remove_volumes(g_env, &middle, 1));
  CHECK(part_count() == 2 && change_count() == 1);

  dsw_volumes_desc_init(&d, sizeof d);
  for (i = 0; i < 4; ++i) old[i] = corner(1 + (i == 1 || i == 2), i >= 2, 0);
  d.vertices = old;
  d.vertex_count = 4;
  d.volume_count = 1;
  d.connectivity = quad;
  d.connectivity_count = 4;
  d.sew_to = sew_to;
  d.sew_count = 2;
  sew_to[0] = face_at(0, SIDE_RIGHT), sew_to[1] = face_at(2, SIDE_UP);
  CHECK_FAILS(DSW_STATUS_BAD_CELL_TYPE, dsw_environment_add_volumes(g_env, &d, added, NULL)); /* a hexahedron */
  d.uniform_cell_type = DSW_CELL_TYPE_POLYGON;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_add_volumes(g_env, &d, added, NULL));
  d.uniform_cell_type = DSW_CELL_TYPE_QUAD;
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_environment_add_volumes(g_env, &d, added, NULL));
  sew_to[1] = face_at(2, SIDE_LEFT);
  quad[3] = 1;
  CHECK_FAILS(DSW_STATUS_BAD_CELL, dsw_environment_add_volumes(g_env, &d, added, NULL));
  quad[1] = 3, quad[3] = 1; /* clockwise: its sides run along those of the others, not against them */
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_environment_add_volumes(g_env, &d, added, NULL));
  quad[1] = 1, quad[3] = 3;
  CHECK_OK(dsw_environment_add_volumes(g_env, &d, added, NULL));
  CHECK(added[0].index == 1 && added[0].generation == 2 && part_count() == 1);

  /* Two triangles on the right end, which share their long side. */
  old[0] = corner(3, 0, 0), old[1] = corner(3, 1, 0);
  d.vertex_count = 2;
  d.points = xy;
  d.point_count = 2;
  d.uniform_cell_type = DSW_CELL_TYPE_TRIANGLE;
  d.volume_count = 2;
  d.offsets = offsets;
  d.connectivity = fan;
  d.connectivity_count = 6;
  d.sew_count = 1;
  sew_to[0] = face_at(2, SIDE_RIGHT);
  xy[2] = 3;
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_add_volumes(g_env, &d, added, fresh));
  CHECK_MESSAGE("new volume 1");
  xy[2] = 1e300 * 1e300;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_add_volumes(g_env, &d, added, fresh));
  xy[2] = 4;
  d.point_stride_bytes = 8;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_add_volumes(g_env, &d, added, fresh));
  d.point_stride_bytes = 16;
  CHECK_OK(dsw_environment_add_volumes(g_env, &d, added, fresh));
  CHECK(added[0].index == 3 && added[1].index == 4 && fresh[0].index == 8 && fresh[1].index == 9);
  CHECK(has_type(added[1], DSW_CELL_TYPE_TRIANGLE, 3));
  CHECK_OK(dsw_environment_remove_volumes(g_env, added, 1));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_vertex_position(g_env, fresh[0], xy));
  end(4, 9);
}

static void sides(void) {
  dsw_edge_id parts[2], merged = {0, 0, 0};
  dsw_face_id side, mark[2], none[2];
  dsw_vertex_id middle = {0, 0}, ends[2];
  double xy[3] = {9, 9, 9};
  size_t count = 0;
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
  CHECK_OK(dsw_environment_copy_vertices(g_env, (dsw_cell){DSW_CELL_FACE, side.volume, side.generation, side.local},
                                         ends, 2, &count));
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
  CHECK(is_impassable(wall(1)) == 1);
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
  static const double points[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  static const int64_t quad[4] = {0, 1, 2, 3};
  dsw_environment_desc d = polygons_desc(points[0], 4, DSW_CELL_TYPE_QUAD, quad, 1);
  d.flags = DSW_ENVIRONMENT_BORROW_POINTS;
  CHECK_OK(dsw_environment_create(NULL, &d, &g_env, NULL));
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_split_edge(g_env, edge_at(0, 0), 0.5, NULL, NULL));
  CHECK_OK(dsw_environment_merge_edges(g_env, edge_at(0, 0), vertex_at(0), NULL));
  end(1, 3);
}

int main(void) {
  use_dimension(2);
  splitting_at_two_corners();
  removing_and_adding_volumes();
  sides();
  collapsing_a_side();
  borrowed_points();
  return check_result();
}
