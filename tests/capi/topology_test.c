/* topology.h: every operation once with what it returns, every way to be refused, and what bodies and particles say to
   it. What is alike in space and in the plane runs in both; plane_topology_test.c has the rest of the plane. */
#include <string.h>

#include "check.h"
#include "strip.h"

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
  const dsw_volume_change *changes = NULL;
  dsw_volume_id merged = {0, 0}, parts[2];
  dsw_vertex_id loop[4];
  dsw_face_id face = {0, 0, 0};
  dsw_cell_type type = DSW_CELL_TYPE_NONE;
  uint32_t tag = 0;
  const size_t corners = g_dimension == 3 ? 4 : 2;
  uint32_t vertices = 0, edges = 9, faces = 0;
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
  CHECK_OK(dsw_environment_get_volume_counts(g_env, merged, &type, &vertices, &edges, &faces));
  CHECK(type == (g_dimension == 3 ? DSW_CELL_TYPE_POLYHEDRON : DSW_CELL_TYPE_POLYGON));
  CHECK(g_dimension == 3 || (vertices == 6 && edges == 0 && faces == 6));
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
  for (i = 0; i < 2; ++i) {
    CHECK_OK(dsw_environment_get_volume_counts(g_env, parts[i], &type, &vertices, &edges, &faces));
    CHECK(type == (g_dimension == 3 ? DSW_CELL_TYPE_HEXAHEDRON : DSW_CELL_TYPE_QUAD));
    CHECK(g_dimension == 3 || (vertices == 4 && edges == 0 && faces == 4));
  }
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_split_volume(g_env, parts[0], NULL, corners, NULL, NULL));
  CHECK_OK(dsw_environment_mark_volumes(g_env, parts, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_merge_volumes(g_env, face, NULL));
  CHECK_MESSAGE("marked");
  end(3, g_dimension == 3 ? 14 : 8);
}

/* In space, as the two that follow. */
static void removing_and_adding_volumes(void) {
  dsw_volumes_desc d;
  dsw_vertex_id old[8], fresh[4];
  dsw_volume_id middle = volume_at(1), added = {0, 0}, all[3];
  dsw_face_id sew_to[2];
  double xyz[12] = {4, 0, 0, 4, 1, 0, 4, 1, 1, 4, 0, 1};
  int64_t cube[8] = {0, 4, 5, 1, 3, 7, 6, 2};
  int32_t regions[1] = {7}, region = 0;
  unsigned i;
  begin();
  for (i = 0; i < 3; ++i) all[i] = volume_at(i);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_remove_volumes(g_env, all, 3));
  CHECK_OK(dsw_environment_remove_volumes(g_env, &middle, 1));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_remove_volumes(g_env, &middle, 1));
  CHECK(part_count() == 2 && change_count() == 1);

  dsw_volumes_desc_init(&d, sizeof d);
  for (i = 0; i < 2; ++i) {
    old[4 * i] = corner(1 + i, 0, 0), old[4 * i + 1] = corner(1 + i, 1, 0);
    old[4 * i + 2] = corner(1 + i, 1, 1), old[4 * i + 3] = corner(1 + i, 0, 1);
  }
  d.vertices = old;
  d.vertex_count = 8;
  d.volume_count = 1;
  d.connectivity = cube;
  d.connectivity_count = 8;
  d.regions = regions;
  d.sew_to = sew_to;
  d.sew_count = 2;
  sew_to[0] = face_at(0, FACE_X1), sew_to[1] = face_at(2, FACE_X1);
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_environment_add_volumes(g_env, &d, &added, NULL));
  sew_to[1] = face_at(2, FACE_X0);
  cube[7] = 8;
  CHECK_FAILS(DSW_STATUS_INDEX_OUT_OF_RANGE, dsw_environment_add_volumes(g_env, &d, &added, NULL));
  cube[7] = 3;
  CHECK_FAILS(DSW_STATUS_BAD_CELL, dsw_environment_add_volumes(g_env, &d, &added, NULL));
  cube[7] = 2;
  d.uniform_cell_type = 11;
  CHECK_FAILS(DSW_STATUS_BAD_CELL_TYPE, dsw_environment_add_volumes(g_env, &d, &added, NULL));
  d.uniform_cell_type = DSW_CELL_TYPE_HEXAHEDRON;
  d.connectivity_count = 7;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_add_volumes(g_env, &d, &added, NULL));
  d.connectivity_count = 8;
  d.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_add_volumes(g_env, &d, &added, NULL));
  d.struct_size = sizeof d;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_add_volumes(g_env, NULL, &added, NULL));
  CHECK_OK(dsw_environment_add_volumes(g_env, &d, &added, NULL));
  CHECK(added.index == 1 && added.generation == 2 && part_count() == 1);
  CHECK_OK(dsw_environment_get_region(g_env, added, &region));
  CHECK(region == 7);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_add_volumes(g_env, &d, &added, NULL));

  for (i = 0; i < 4; ++i) old[i] = corner(3, (i == 1 || i == 2) ? 1 : 0, i >= 2);
  d.vertex_count = 4;
  d.points = xyz;
  d.point_count = 4;
  sew_to[0] = face_at(2, FACE_X1);
  d.sew_count = 1;
  xyz[0] = 3;
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_add_volumes(g_env, &d, &added, fresh));
  CHECK_MESSAGE("new volume 0");
  xyz[0] = 4;
  xyz[1] = 1e300 * 1e300;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_add_volumes(g_env, &d, &added, fresh));
  xyz[1] = 0;
  CHECK_OK(dsw_environment_add_volumes(g_env, &d, &added, fresh));
  CHECK(added.index == 3 && fresh[0].index == 16 && fresh[3].index == 19);
  CHECK_OK(dsw_environment_remove_volumes(g_env, &added, 1));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_vertex_position(g_env, fresh[0], xyz));
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_environment_get_vertex_id(g_env, 16, fresh));
  CHECK_OK(dsw_environment_add_volumes(g_env, &d, NULL, fresh));
  CHECK(fresh[0].generation == 2);
  end(4, 18);
}

static void faces_and_edges(void) {
  dsw_face_id halves[2], whole = {0, 0, 0};
  dsw_edge_id diagonal = {0, 0, 0}, parts[2], merged = {0, 0, 0};
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

  CHECK_FAILS(
      DSW_STATUS_OUT_OF_RANGE,
      dsw_environment_split_edge(g_env, find_edge(corner_index(1, 0, 0), corner_index(1, 1, 0)), 0, NULL, NULL));
  CHECK_FAILS(
      DSW_STATUS_OUT_OF_RANGE,
      dsw_environment_split_edge(g_env, find_edge(corner_index(1, 0, 0), corner_index(1, 1, 0)), 1, NULL, NULL));
  CHECK_OK(
      dsw_environment_split_edge(g_env, find_edge(corner_index(1, 0, 0), corner_index(1, 1, 0)), 0.25, &middle, parts));
  CHECK(middle.index == 16 && change_count() == 2);
  CHECK_OK(dsw_environment_get_vertex_position(g_env, middle, xyz));
  CHECK(xyz[0] == 1 && xyz[2] == 0 && (xyz[1] == 0.25 || xyz[1] == 0.75));
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

static void borrowed_points(void) {
  grid g = grid_create(3, 1, 1);
  dsw_environment_desc d = grid_desc(&g);
  dsw_volume_id last = volume_at(2);
  double xyz[3];
  d.flags = DSW_ENVIRONMENT_BORROW_POINTS;
  CHECK_OK(dsw_environment_create(NULL, &d, &g_env, NULL));
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_split_edge(g_env, edge_at(0, 0), 0.5, NULL, NULL));
  CHECK_OK(dsw_environment_remove_volumes(g_env, &last, 1));
  CHECK_OK(dsw_environment_get_vertex_position(g_env, corner(3, 0, 0), xyz));
  end(2, 10);
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
  what_is_inside();
  snapshots_keep_what_has_changed();
}

int main(void) {
  use_dimension(2);
  in_both();
  use_dimension(3);
  in_both();
  removing_and_adding_volumes();
  faces_and_edges();
  borrowed_points();
  return check_result();
}
