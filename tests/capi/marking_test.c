#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 3 x 2 x 2 cubes, regions 0, 1, 2 along x */

static size_t mark_count(dsw_cell_kind kind) {
  size_t count = 999;
  CHECK_OK(dsw_environment_get_mark_count(g_env, kind, &count));
  return count;
}

static int marked(dsw_cell cell) {
  int answer = -1;
  CHECK_OK(dsw_environment_is_marked(g_env, cell, &answer));
  return answer;
}

static int impassable(dsw_cell cell) {
  int answer = -1;
  CHECK_OK(dsw_environment_is_impassable(g_env, cell, &answer));
  return answer;
}

static void nothing_is_marked_at_first(void) {
  CHECK(mark_count(DSW_CELL_VERTEX) == 0 && mark_count(DSW_CELL_EDGE) == 0);
  CHECK(mark_count(DSW_CELL_FACE) == 0 && mark_count(DSW_CELL_VOLUME) == 0);
  CHECK(!marked(cell_at(DSW_CELL_VOLUME, 0, 0)) && !impassable(cell_at(DSW_CELL_VOLUME, 0, 0)));
  CHECK(!impassable(cell_at(DSW_CELL_FACE, 0, FACE_X1)));
}

static void the_outer_boundary_is_impassable_and_not_marked(void) {
  CHECK(impassable(cell_at(DSW_CELL_FACE, 0, FACE_X0)) && !marked(cell_at(DSW_CELL_FACE, 0, FACE_X0)));
  CHECK(impassable(cell_at(DSW_CELL_EDGE, 0, 0)) && impassable(cell_at(DSW_CELL_VERTEX, 0, 0)));
}

static void volumes_are_marked_and_their_closure_follows(void) {
  const dsw_volume_id twice[3] = {{4, 1}, {4, 1}, {5, 1}};
  size_t skipped = 7;
  CHECK_OK(dsw_environment_mark_volumes(g_env, twice, 3, DSW_MARK_IMPASSABLE, 0, &skipped));
  CHECK(skipped == 0 && mark_count(DSW_CELL_VOLUME) == 2 && mark_count(DSW_CELL_FACE) == 0);
  CHECK(marked(cell_at(DSW_CELL_VOLUME, 4, 0)) && impassable(cell_at(DSW_CELL_VOLUME, 4, 0)));
  CHECK(impassable(cell_at(DSW_CELL_FACE, 4, FACE_X0)) && !marked(cell_at(DSW_CELL_FACE, 4, FACE_X0)));
  CHECK(impassable(cell_at(DSW_CELL_FACE, 3, FACE_X1))); /* the same face, named from its other side */
  CHECK_OK(dsw_environment_mark_volumes(g_env, twice, 2, DSW_MARK_PASSABLE, 0, NULL));
  CHECK(mark_count(DSW_CELL_VOLUME) == 1 && !impassable(cell_at(DSW_CELL_FACE, 4, FACE_X0)));
  CHECK_OK(dsw_environment_mark_volumes(g_env, twice, 3, DSW_MARK_PASSABLE, 0, NULL));
  CHECK(mark_count(DSW_CELL_VOLUME) == 0);
}

static void a_face_has_one_mark_seen_from_both_sides(void) {
  const dsw_face_id both[2] = {{0, 1, FACE_X1}, {1, 1, FACE_X0}}, boundary = {0, 1, FACE_X0};
  CHECK_OK(dsw_environment_mark_faces(g_env, both, 2, DSW_MARK_IMPASSABLE));
  CHECK(mark_count(DSW_CELL_FACE) == 1);
  CHECK(marked(cell_at(DSW_CELL_FACE, 0, FACE_X1)) && marked(cell_at(DSW_CELL_FACE, 1, FACE_X0)));
  CHECK(impassable(cell_at(DSW_CELL_FACE, 1, FACE_X0)) && !impassable(cell_at(DSW_CELL_VOLUME, 0, 0)));
  CHECK_OK(dsw_environment_mark_faces(g_env, &boundary, 1, DSW_MARK_IMPASSABLE));
  CHECK(mark_count(DSW_CELL_FACE) == 2 && marked(cell_at(DSW_CELL_FACE, 0, FACE_X0)));
  CHECK_OK(dsw_environment_mark_faces(g_env, &boundary, 1, DSW_MARK_PASSABLE));
  CHECK(impassable(cell_at(DSW_CELL_FACE, 0, FACE_X0)));
  CHECK_OK(dsw_environment_mark_faces(g_env, both + 1, 1, DSW_MARK_PASSABLE));
  CHECK(mark_count(DSW_CELL_FACE) == 0 && !marked(cell_at(DSW_CELL_FACE, 0, FACE_X1)));
}

/* The one edge that no face of the outer boundary touches: from (1,1,1) to (2,1,1). */
static dsw_edge_id inner_edge(void) {
  const uint32_t ends[2] = {17, 18};
  dsw_edge_id edge;
  size_t missing = 9;
  CHECK_OK(dsw_environment_find_edges(g_env, 1, ends, &edge, &missing));
  CHECK(missing == 0);
  return edge;
}

static void edges_are_marked_by_any_of_their_names(void) {
  const dsw_edge_id edge = inner_edge();
  const dsw_cell cell = cell_at(DSW_CELL_EDGE, edge.volume, edge.local);
  uint32_t local;
  CHECK(!marked(cell) && !impassable(cell));
  CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_IMPASSABLE));
  CHECK(mark_count(DSW_CELL_EDGE) == 1 && marked(cell) && impassable(cell));
  for (local = 0; local < 12; ++local) { /* the name that volume 10, at (1,1,1), has for it */
    dsw_edge_id canonical;
    CHECK_OK(dsw_environment_get_edge_id(g_env, volume_at(10), local, &canonical));
    CHECK(marked(cell_at(DSW_CELL_EDGE, 10, local)) ==
          (canonical.volume == edge.volume && canonical.local == edge.local));
  }
  CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_PASSABLE));
  CHECK(mark_count(DSW_CELL_EDGE) == 0 && !marked(cell));
}

static void an_edge_or_vertex_of_an_impassable_face_is_impassable(void) {
  const dsw_edge_id edge = inner_edge();
  const dsw_face_id face = {1, 1, FACE_Y1}; /* z 0..1: has the edge on its rim */
  const dsw_volume_id volume = {10, 1};
  const dsw_cell cell = cell_at(DSW_CELL_EDGE, edge.volume, edge.local);
  CHECK_OK(dsw_environment_mark_faces(g_env, &face, 1, DSW_MARK_IMPASSABLE));
  CHECK(impassable(cell) && !marked(cell));
  CHECK_OK(dsw_environment_mark_faces(g_env, &face, 1, DSW_MARK_PASSABLE));
  CHECK(!impassable(cell));
  CHECK_OK(dsw_environment_mark_volumes(g_env, &volume, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK(impassable(cell));
  CHECK_OK(dsw_environment_mark_volumes(g_env, &volume, 1, DSW_MARK_PASSABLE, 0, NULL));
  CHECK(!impassable(cell));
}

static void vertices_carry_marks(void) {
  dsw_environment *const env = make_environment(NULL, 2, 2, 2);
  const dsw_vertex_id middle = vertex_at(13), rim = vertex_at(0);
  const dsw_face_id face = {0, 1, FACE_X1};
  int answer = -1;
  size_t count = 0;
  CHECK_OK(dsw_environment_is_impassable(env, cell_at(DSW_CELL_VERTEX, 13, 0), &answer));
  CHECK(answer == 0);
  CHECK_OK(dsw_environment_mark_vertices(env, &middle, 1, DSW_MARK_PASSABLE)); /* nothing to take back */
  CHECK_OK(dsw_environment_mark_vertices(env, &middle, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_mark_vertices(env, &middle, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_mark_vertices(env, &rim, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_get_mark_count(env, DSW_CELL_VERTEX, &count));
  CHECK(count == 2);
  CHECK_OK(dsw_environment_is_marked(env, cell_at(DSW_CELL_VERTEX, 13, 0), &answer));
  CHECK(answer == 1);
  CHECK_OK(dsw_environment_is_marked(env, cell_at(DSW_CELL_VERTEX, 12, 0), &answer));
  CHECK(answer == 0);
  CHECK_OK(dsw_environment_mark_vertices(env, &middle, 1, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_environment_is_impassable(env, cell_at(DSW_CELL_VERTEX, 13, 0), &answer));
  CHECK(answer == 0);
  CHECK_OK(dsw_environment_mark_faces(env, &face, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_is_impassable(env, cell_at(DSW_CELL_VERTEX, 13, 0), &answer));
  CHECK(answer == 1);
  CHECK_OK(dsw_environment_destroy(env));
}

static void regions_are_marked_as_a_whole(void) {
  size_t all = 99, skipped = 99;
  CHECK_OK(dsw_environment_mark_region(g_env, 1, DSW_MARK_IMPASSABLE, 0, &all, &skipped));
  CHECK(all == 4 && skipped == 0 && mark_count(DSW_CELL_VOLUME) == 4);
  CHECK(impassable(cell_at(DSW_CELL_VOLUME, 1, 0)) && !impassable(cell_at(DSW_CELL_VOLUME, 0, 0)));
  CHECK_OK(dsw_environment_mark_region(g_env, 77, DSW_MARK_IMPASSABLE, 0, &all, NULL));
  CHECK(all == 0);
  CHECK_OK(dsw_environment_mark_region(g_env, 1, DSW_MARK_PASSABLE, 0, NULL, NULL));
  CHECK(mark_count(DSW_CELL_VOLUME) == 0);
}

static void faces_between_regions_are_marked(void) {
  size_t all = 99;
  CHECK_OK(dsw_environment_mark_between(g_env, 2, 1, DSW_MARK_IMPASSABLE, &all));
  CHECK(all == 4 && mark_count(DSW_CELL_FACE) == 4);
  CHECK(marked(cell_at(DSW_CELL_FACE, 1, FACE_X1)) && !marked(cell_at(DSW_CELL_FACE, 0, FACE_X1)));
  CHECK_OK(dsw_environment_mark_between(g_env, 1, 2, DSW_MARK_IMPASSABLE, &all));
  CHECK(all == 4 && mark_count(DSW_CELL_FACE) == 4);
  CHECK_OK(dsw_environment_mark_between(g_env, 0, 2, DSW_MARK_IMPASSABLE, &all));
  CHECK(all == 0);
  CHECK_OK(dsw_environment_mark_between(g_env, 1, 1, DSW_MARK_IMPASSABLE, &all)); /* inside one region */
  CHECK(all == 4 && mark_count(DSW_CELL_FACE) == 8);
  CHECK_OK(dsw_environment_mark_between(g_env, 1, 1, DSW_MARK_PASSABLE, NULL));
  CHECK_OK(dsw_environment_mark_between(g_env, 1, 2, DSW_MARK_PASSABLE, NULL));
  CHECK(mark_count(DSW_CELL_FACE) == 0);
}

static dsw_particle_id particle_in(dsw_scene *scene, double x, double y, double z) {
  const double at[3] = {x, y, z};
  dsw_particle_id id = {0, 0};
  CHECK_OK(dsw_particle_create(scene, at, no_volume, &id));
  return id;
}

static void an_occupied_volume_is_not_marked(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id first = particle_in(scene, 0.5, 0.5, 0.5), second = particle_in(scene, 1.5, 0.5, 0.5);
  const dsw_particle_id third = particle_in(scene, 1.25, 0.5, 0.5);
  const dsw_volume_id volumes[3] = {{2, 1}, {1, 1}, {5, 1}};
  const dsw_particle_id *occupants = NULL;
  size_t skipped = 99, count = 99;
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_mark_volumes(g_env, volumes, 3, DSW_MARK_IMPASSABLE, 0, &skipped));
  CHECK_MESSAGE("2 particles are in the way; the first is {index 1, generation 1} in volume 1");
  CHECK(skipped == 99 && mark_count(DSW_CELL_VOLUME) == 0);
  CHECK_OK(dsw_scene_get_occupants(scene, &occupants, &count));
  CHECK(count == 2 && occupants[0].index == second.index && occupants[1].index == third.index);
  CHECK(occupants[0].generation == second.generation);
  CHECK_OK(dsw_environment_mark_volumes(g_env, volumes, 3, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, &skipped));
  CHECK(skipped == 1 && mark_count(DSW_CELL_VOLUME) == 2 && !marked(cell_at(DSW_CELL_VOLUME, 1, 0)));
  CHECK(marked(cell_at(DSW_CELL_VOLUME, 2, 0)) && marked(cell_at(DSW_CELL_VOLUME, 5, 0)));
  CHECK_OK(dsw_scene_get_occupants(scene, &occupants, &count));
  CHECK(count == 2);
  CHECK_OK(dsw_environment_mark_volumes(g_env, volumes, 3, DSW_MARK_PASSABLE, 0, &skipped));
  CHECK(skipped == 0 && mark_count(DSW_CELL_VOLUME) == 0);
  CHECK_OK(dsw_scene_get_occupants(scene, &occupants, &count));
  CHECK(count == 0); /* the last marking call had none */
  CHECK_OK(dsw_particle_destroy(scene, second));
  CHECK_OK(dsw_particle_destroy(scene, third));
  CHECK_OK(dsw_environment_mark_volumes(g_env, volumes, 3, DSW_MARK_IMPASSABLE, 0, &skipped));
  CHECK(skipped == 0 && mark_count(DSW_CELL_VOLUME) == 3);
  CHECK_OK(dsw_environment_mark_volumes(g_env, volumes, 3, DSW_MARK_PASSABLE, 0, NULL));
  CHECK_OK(dsw_particle_destroy(scene, first));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void occupied_regions_are_left_out(void) {
  dsw_scene *const scene = make_scene(g_env, 0);
  const dsw_particle_id id = particle_in(scene, 1.5, 1.5, 0.5);
  size_t all = 99, skipped = 99;
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_mark_region(g_env, 1, DSW_MARK_IMPASSABLE, 0, &all, &skipped));
  CHECK(all == 99 && skipped == 99 && mark_count(DSW_CELL_VOLUME) == 0);
  CHECK_OK(dsw_environment_mark_region(g_env, 1, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, &all, &skipped));
  CHECK(all == 3 && skipped == 1 && !marked(cell_at(DSW_CELL_VOLUME, 4, 0)));
  CHECK_OK(dsw_environment_mark_region(g_env, 1, DSW_MARK_PASSABLE, 0, &all, &skipped));
  CHECK(all == 4 && skipped == 0);
  CHECK_OK(dsw_particle_destroy(scene, id));
  CHECK_OK(dsw_scene_destroy(scene));
}

static void many_volumes_are_checked_too(void) {
  dsw_environment *const env = make_environment(NULL, 20, 20, 1);
  dsw_scene *const scene = make_scene(env, 0);
  dsw_volume_id volumes[400];
  const dsw_particle_id id = particle_in(scene, 7.5, 13.5, 0.5);
  const dsw_particle_id *occupants = NULL;
  size_t skipped = 0, count = 0, i;
  for (i = 0; i < 400; ++i) volumes[i] = volume_at(399 - (uint32_t)i);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_mark_volumes(env, volumes, 400, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_mark_volumes(env, volumes, 400, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, &skipped));
  CHECK(skipped == 1);
  CHECK_OK(dsw_scene_get_occupants(scene, &occupants, &count));
  CHECK(count == 1 && occupants[0].index == id.index);
  CHECK_OK(dsw_environment_get_mark_count(env, DSW_CELL_VOLUME, &count));
  CHECK(count == 399);
  end_scene(scene);
}

static void a_shared_environment_is_not_changed(void) {
  dsw_scene *const first = make_scene(g_env, 0), *const second = make_scene(g_env, 0);
  const dsw_volume_id volume = volume_at(0);
  const dsw_face_id face = face_at(0, 0);
  const dsw_edge_id edge = edge_at(0, 0);
  const dsw_vertex_id vertex = vertex_at(0);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_mark_volumes(g_env, &volume, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_MESSAGE("2 scenes");
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_mark_faces(g_env, &face, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_mark_vertices(g_env, &vertex, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_mark_region(g_env, 0, DSW_MARK_IMPASSABLE, 0, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_mark_between(g_env, 0, 1, DSW_MARK_IMPASSABLE, NULL));
  nothing_is_marked_at_first();
  CHECK_OK(dsw_scene_destroy(first));
  CHECK_OK(dsw_environment_mark_volumes(g_env, &volume, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_mark_volumes(g_env, &volume, 1, DSW_MARK_PASSABLE, 0, NULL));
  CHECK_OK(dsw_scene_destroy(second));
}

static void bad_arguments_change_nothing(void) {
  const dsw_volume_id volumes[3] = {{0, 1}, {1, 1}, {12, 1}};
  const dsw_face_id faces[2] = {{0, 1, 0}, {0, 1, 6}};
  const dsw_edge_id edges[2] = {{0, 1, 0}, {0, 2, 0}};
  const dsw_vertex_id vertices[2] = {{0, 1}, {36, 1}};
  int answer = 9;
  size_t count = 99;
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_mark_volumes(g_env, volumes, 3, DSW_MARK_IMPASSABLE, 0, &count));
  CHECK_MESSAGE("volumes[2] {index 12, generation 1}");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_mark_faces(g_env, faces, 2, DSW_MARK_IMPASSABLE));
  CHECK_MESSAGE("faces[1]");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_mark_edges(g_env, edges, 2, DSW_MARK_IMPASSABLE));
  CHECK_MESSAGE("edges[1]");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_mark_vertices(g_env, vertices, 2, DSW_MARK_IMPASSABLE));
  CHECK_MESSAGE("vertices[1]");
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_mark_volumes(g_env, volumes, 1, (dsw_mark)2, 0, &count));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_mark_volumes(g_env, volumes, 1, DSW_MARK_IMPASSABLE, 2, &count));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_mark_faces(g_env, faces, 1, (dsw_mark)0x7ffffffe));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_mark_edges(g_env, edges, 1, (dsw_mark)2));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_mark_vertices(g_env, vertices, 1, (dsw_mark)2));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_mark_region(g_env, 0, (dsw_mark)2, 0, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_mark_region(g_env, 0, DSW_MARK_IMPASSABLE, 4, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_mark_between(g_env, 0, 1, (dsw_mark)2, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_volumes(NULL, volumes, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_volumes(g_env, NULL, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_faces(g_env, NULL, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_faces(NULL, faces, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_edges(g_env, NULL, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_edges(NULL, edges, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_vertices(g_env, NULL, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_vertices(NULL, vertices, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_region(NULL, 0, DSW_MARK_IMPASSABLE, 0, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_between(NULL, 0, 1, DSW_MARK_IMPASSABLE, NULL));
  CHECK_OK(dsw_environment_mark_volumes(g_env, NULL, 0, DSW_MARK_IMPASSABLE, 0, &count));
  CHECK(count == 0);
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_is_marked(g_env, cell_at(DSW_CELL_NONE, 0, 0), &answer));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_is_marked(g_env, cell_at(DSW_CELL_VOLUME, 12, 0), &answer));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_is_marked(g_env, cell_at(DSW_CELL_VOLUME, 0, 0), NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_is_marked(NULL, cell_at(DSW_CELL_VOLUME, 0, 0), &answer));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_is_impassable(g_env, cell_at(DSW_CELL_NONE, 0, 0), &answer));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_is_impassable(g_env, cell_at(DSW_CELL_EDGE, 0, 12), &answer));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_is_impassable(g_env, cell_at(DSW_CELL_VOLUME, 0, 0), NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_is_impassable(NULL, cell_at(DSW_CELL_VOLUME, 0, 0), &answer));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_get_mark_count(g_env, DSW_CELL_NONE, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_mark_count(g_env, DSW_CELL_FACE, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_mark_count(NULL, DSW_CELL_FACE, &count));
  CHECK(answer == 9);
  nothing_is_marked_at_first();
}

int main(void) {
  g_env = make_environment(NULL, 3, 2, 2);
  nothing_is_marked_at_first();
  the_outer_boundary_is_impassable_and_not_marked();
  volumes_are_marked_and_their_closure_follows();
  a_face_has_one_mark_seen_from_both_sides();
  edges_are_marked_by_any_of_their_names();
  an_edge_or_vertex_of_an_impassable_face_is_impassable();
  vertices_carry_marks();
  regions_are_marked_as_a_whole();
  faces_between_regions_are_marked();
  an_occupied_volume_is_not_marked();
  occupied_regions_are_left_out();
  many_volumes_are_checked_too();
  a_shared_environment_is_not_changed();
  bad_arguments_change_nothing();
  CHECK_OK(dsw_environment_destroy(g_env));
  return check_result();
}
