/* What an environment answers about its cells: the second half of environment.h. */
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 3 x 2 x 2 cubes */

static void info_counts_and_measures(void) {
  struct {
    dsw_environment_info known;
    uint64_t unknown;
  } i;
  dsw_scene *const scene = make_scene(g_env, 0);
  memset(&i, 0x55, sizeof i);
  i.known.struct_size = sizeof i;
  CHECK_OK(dsw_environment_get_info(g_env, &i.known));
  CHECK(i.known.struct_size == sizeof i && i.unknown == 0);
  CHECK(i.known.dimension == 3 && i.known.vertex_count == 36 && i.known.volume_count == 12);
  CHECK(i.known.boundary_face_count == 32 && i.known.face_count == (12 * 6 + 32) / 2);
  CHECK(i.known.part_count == 1 && i.known.scene_count == 1 && i.known.memory_bytes > 12 * 64);
  CHECK(i.known.lower[0] == 0 && i.known.upper[0] == 3 && i.known.upper[2] == 2);
  i.known.struct_size = offsetof(dsw_environment_info, volume_index_count) - 1;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_get_info(g_env, &i.known));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_info(g_env, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_info(NULL, &i.known));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void ids_come_from_indices(void) {
  dsw_volume_id volume = {9, 9};
  dsw_vertex_id vertex = {9, 9};
  double xyz[3];
  CHECK_OK(dsw_environment_get_volume_id(g_env, 11, &volume));
  CHECK(volume.index == 11 && volume.generation == 1);
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_get_volume_id(g_env, 12, &volume));
  CHECK_MESSAGE("index is 12, must be 0 .. 11");
  CHECK(volume.index == 11);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_volume_id(g_env, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_volume_id(NULL, 0, &volume));
  CHECK_OK(dsw_environment_get_vertex_id(g_env, 35, &vertex));
  CHECK_OK(dsw_environment_get_vertex_position(g_env, vertex, xyz));
  CHECK(xyz[0] == 3 && xyz[1] == 2 && xyz[2] == 2);
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_get_vertex_id(g_env, 36, &vertex));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_vertex_id(g_env, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_vertex_position(g_env, vertex, NULL));
  vertex.generation = 2;
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_vertex_position(g_env, vertex, xyz));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_vertex_position(g_env, vertex_at(36), xyz));
}

static void a_volume_counts_its_cells(void) {
  dsw_cell_type type = DSW_CELL_TYPE_NONE;
  uint32_t vertices = 0, edges = 0, faces = 0;
  CHECK_OK(dsw_environment_get_volume_counts(g_env, volume_at(5), &type, &vertices, &edges, &faces));
  CHECK(type == DSW_CELL_TYPE_HEXAHEDRON && vertices == 8 && edges == 12 && faces == 6);
  CHECK_OK(dsw_environment_get_volume_counts(g_env, volume_at(5), NULL, NULL, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_volume_counts(g_env, stale_volume, &type, NULL, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_volume_counts(g_env, no_volume, &type, NULL, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_volume_counts(g_env, volume_at(12), &type, NULL, NULL, NULL));
  CHECK_MESSAGE("volume {index 12, generation 1}");
}

static void neighbours_and_centres(void) {
  dsw_volume_id neighbour;
  double centre[3], again[3];
  int impassable = -1;
  dsw_volume_id found;
  CHECK_OK(dsw_environment_get_neighbour(g_env, volume_at(1), FACE_X1, &neighbour, &impassable));
  CHECK(neighbour.index == 2 && neighbour.generation == 1 && impassable == 0);
  CHECK_OK(dsw_environment_get_neighbour(g_env, volume_at(2), FACE_X1, &neighbour, &impassable));
  CHECK(neighbour.index == 0 && neighbour.generation == 0 && impassable == 1);
  CHECK_OK(dsw_environment_get_neighbour(g_env, volume_at(2), FACE_X1, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_get_neighbour(g_env, volume_at(1), 6, &neighbour, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_neighbour(g_env, no_volume, 0, &neighbour, NULL));
  CHECK_OK(dsw_environment_get_centre(g_env, volume_at(1), centre));
  CHECK_OK(dsw_environment_locate(g_env, centre, no_volume, &found, NULL));
  CHECK(found.index == 1);
  CHECK_OK(dsw_environment_get_centre(g_env, volume_at(1), again));
  CHECK(memcmp(centre, again, sizeof centre) == 0);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_centre(g_env, no_volume, centre));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_centre(g_env, volume_at(1), NULL));
}

static void faces_have_two_sides_and_one_canonical_name(void) {
  dsw_face_id face;
  dsw_volume_id near_side, far_side;
  CHECK_OK(dsw_environment_get_face_id(g_env, volume_at(1), FACE_X0, &face));
  CHECK(face.volume == 0 && face.local == FACE_X1 && face.generation == 1);
  CHECK_OK(dsw_environment_get_face_id(g_env, volume_at(1), FACE_X1, &face));
  CHECK(face.volume == 1 && face.local == FACE_X1);
  CHECK_OK(dsw_environment_get_face_volumes(g_env, face, &near_side, &far_side));
  CHECK(near_side.index == 1 && far_side.index == 2 && far_side.generation == 1);
  CHECK_OK(dsw_environment_get_face_volumes(g_env, face_at(2, FACE_X0), &near_side, &far_side));
  CHECK(near_side.index == 2 && far_side.index == 1);
  CHECK_OK(dsw_environment_get_face_volumes(g_env, face_at(2, FACE_X1), &near_side, &far_side));
  CHECK(near_side.index == 2 && far_side.index == 0 && far_side.generation == 0);
  CHECK_OK(dsw_environment_get_face_volumes(g_env, face, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_get_face_id(g_env, volume_at(1), 6, &face));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_face_id(g_env, no_volume, 0, &face));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_face_id(g_env, volume_at(1), 0, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_face_volumes(g_env, face_at(1, 6), NULL, NULL));
  CHECK_MESSAGE("local 6");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_face_volumes(g_env, face_at(12, 0), NULL, NULL));
}

/* The two points of an edge, lower first. */
static void edge_points(dsw_edge_id edge, uint32_t out[2]) {
  dsw_vertex_id v[2];
  size_t count = 0;
  dsw_cell cell = cell_at(DSW_CELL_EDGE, edge.volume, edge.local);
  cell.generation = edge.generation;
  CHECK_OK(dsw_environment_copy_vertices(g_env, cell, v, 2, &count));
  CHECK(count == 2);
  out[v[0].index > v[1].index] = v[0].index;
  out[v[0].index <= v[1].index] = v[1].index;
}

static void an_edge_has_one_canonical_name(void) {
  uint32_t volume, local;
  dsw_edge_id edge;
  for (volume = 0; volume < 12; ++volume) {
    for (local = 0; local < 12; ++local) {
      uint32_t named[2], canonical[2];
      dsw_edge_id again;
      CHECK_OK(dsw_environment_get_edge_id(g_env, volume_at(volume), local, &edge));
      CHECK(edge.volume <= volume && edge.generation == 1 && edge.local < 12);
      CHECK_OK(dsw_environment_get_edge_id(g_env, volume_at(edge.volume), edge.local, &again));
      CHECK(again.volume == edge.volume && again.local == edge.local);
      edge_points(edge_at(volume, local), named);
      edge_points(edge, canonical);
      CHECK(named[0] == canonical[0] && named[1] == canonical[1]);
    }
  }
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_get_edge_id(g_env, volume_at(0), 12, &edge));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_edge_id(g_env, stale_volume, 0, &edge));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_edge_id(g_env, volume_at(0), 0, NULL));
}

static void vertices_come_in_the_order_of_the_type(void) {
  static const uint32_t corners[8] = {0, 1, 5, 4, 12, 13, 17, 16};
  static const uint32_t face[4] = {0, 12, 16, 4}; /* x = 0, seen from outside */
  dsw_vertex_id v[8];
  size_t count = 0, i;
  CHECK_OK(dsw_environment_copy_vertices(g_env, cell_at(DSW_CELL_VOLUME, 0, 0), v, 8, &count));
  CHECK(count == 8);
  for (i = 0; i < 8; ++i) CHECK(v[i].index == corners[i] && v[i].generation == 1);
  CHECK_OK(dsw_environment_copy_vertices(g_env, cell_at(DSW_CELL_FACE, 0, FACE_X0), v, 8, &count));
  CHECK(count == 4);
  for (i = 0; i < 4; ++i) CHECK(v[i].index == face[i]);
  CHECK_OK(dsw_environment_copy_vertices(g_env, cell_at(DSW_CELL_VERTEX, 35, 0), v, 1, &count));
  CHECK(count == 1 && v[0].index == 35);
}

static void a_small_buffer_gets_nothing(void) {
  dsw_vertex_id v[8];
  size_t count = 0;
  memset(v, 0x55, sizeof v);
  CHECK_OK(dsw_environment_copy_vertices(g_env, cell_at(DSW_CELL_VOLUME, 0, 0), NULL, 0, &count));
  CHECK(count == 8);
  count = 0;
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL,
              dsw_environment_copy_vertices(g_env, cell_at(DSW_CELL_VOLUME, 0, 0), v, 7, &count));
  CHECK(count == 8 && v[0].index == 0x55555555u);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT,
              dsw_environment_copy_vertices(g_env, cell_at(DSW_CELL_VOLUME, 0, 0), NULL, 8, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT,
              dsw_environment_copy_vertices(g_env, cell_at(DSW_CELL_VOLUME, 0, 0), v, 8, NULL));
}

static void a_cell_of_no_kind_is_refused(void) {
  size_t count = 77;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED,
              dsw_environment_copy_vertices(g_env, cell_at(DSW_CELL_NONE, 0, 0), NULL, 0, &count));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED,
              dsw_environment_copy_vertices(g_env, cell_at((dsw_cell_kind)5, 0, 0), NULL, 0, &count));
  CHECK_FAILS(DSW_STATUS_STALE_ID,
              dsw_environment_copy_vertices(g_env, cell_at(DSW_CELL_EDGE, 0, 12), NULL, 0, &count));
  CHECK_FAILS(DSW_STATUS_STALE_ID,
              dsw_environment_copy_vertices(g_env, cell_at(DSW_CELL_FACE, 12, 0), NULL, 0, &count));
  CHECK(count == 77);
}

static void faces_are_found_by_their_points(void) {
  /* Between cells 0 and 1 in some order; a face at the boundary; no face; an index that is no point. */
  static const uint32_t indices[16] = {17, 1, 13, 5, 0, 12, 16, 4, 0, 1, 2, 3, 0, 12, 16, 99};
  static const size_t offsets[5] = {0, 4, 8, 12, 16}, descending[3] = {0, 8, 4};
  dsw_face_id faces[4];
  size_t missing = 0;
  CHECK_OK(dsw_environment_find_faces(g_env, 4, offsets, indices, faces, &missing));
  CHECK(missing == 2);
  CHECK(faces[0].volume == 0 && faces[0].local == FACE_X1 && faces[0].generation == 1);
  CHECK(faces[1].volume == 0 && faces[1].local == FACE_X0);
  CHECK(faces[2].generation == 0 && faces[3].generation == 0);
  CHECK_OK(dsw_environment_find_faces(g_env, 1, offsets, indices, faces, NULL));
  CHECK_OK(dsw_environment_find_faces(g_env, 0, NULL, NULL, NULL, &missing));
  CHECK(missing == 0);
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_find_faces(g_env, 2, descending, indices, faces, &missing));
  CHECK_MESSAGE("offsets[2] is 4");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_faces(g_env, 1, NULL, indices, faces, &missing));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_faces(g_env, 1, offsets, NULL, faces, &missing));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_faces(g_env, 1, offsets, indices, NULL, &missing));
}

static void edges_are_found_by_their_points(void) {
  static const uint32_t indices[8] = {1, 0, 5, 17, 0, 5, 3, 99};
  dsw_edge_id edges[4];
  size_t missing = 0;
  uint32_t ends[2];
  CHECK_OK(dsw_environment_find_edges(g_env, 4, indices, edges, &missing));
  CHECK(missing == 2 && edges[2].generation == 0 && edges[3].generation == 0);
  CHECK(edges[0].volume == 0 && edges[0].generation == 1);
  edge_points(edges[0], ends);
  CHECK(ends[0] == 0 && ends[1] == 1);
  CHECK(edges[1].volume == 0);
  edge_points(edges[1], ends);
  CHECK(ends[0] == 5 && ends[1] == 17);
  CHECK_OK(dsw_environment_find_edges(g_env, 0, NULL, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_edges(g_env, 1, NULL, edges, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_find_edges(g_env, 1, indices, NULL, NULL));
}

static void regions_and_tags_are_those_given(void) {
  dsw_environment *bare = NULL;
  grid g = grid_create(2, 1, 1);
  dsw_environment_desc d = grid_desc(&g);
  int32_t region = -1;
  uint32_t tag = 0;
  CHECK_OK(dsw_environment_get_region(g_env, volume_at(5), &region));
  CHECK(region == 2);
  CHECK_OK(dsw_environment_get_tag(g_env, volume_at(5), &tag));
  CHECK(tag == 105);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_region(g_env, volume_at(5), NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_tag(g_env, volume_at(5), NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_region(g_env, stale_volume, &region));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_tag(g_env, stale_volume, &tag));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_set_tag(g_env, stale_volume, 1));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_set_tag(NULL, volume_at(0), 1));
  d.regions = NULL;
  d.tags = NULL;
  CHECK_OK(dsw_environment_create(NULL, &d, &bare, NULL));
  CHECK_OK(dsw_environment_get_region(bare, volume_at(1), &region));
  CHECK_OK(dsw_environment_get_tag(bare, volume_at(1), &tag));
  CHECK(region == 0 && tag == 0);
  CHECK_OK(dsw_environment_set_tag(bare, volume_at(1), 7));
  CHECK_OK(dsw_environment_get_tag(bare, volume_at(1), &tag));
  CHECK(tag == 7);
  CHECK_OK(dsw_environment_get_tag(bare, volume_at(0), &tag));
  CHECK(tag == 0);
  CHECK_OK(dsw_environment_destroy(bare));
  grid_destroy(&g);
}

int main(void) {
  g_env = make_environment(NULL, 3, 2, 2);
  info_counts_and_measures();
  ids_come_from_indices();
  a_volume_counts_its_cells();
  neighbours_and_centres();
  faces_have_two_sides_and_one_canonical_name();
  an_edge_has_one_canonical_name();
  vertices_come_in_the_order_of_the_type();
  a_small_buffer_gets_nothing();
  a_cell_of_no_kind_is_refused();
  faces_are_found_by_their_points();
  edges_are_found_by_their_points();
  regions_and_tags_are_those_given();
  CHECK_OK(dsw_environment_destroy(g_env));
  return check_result();
}
