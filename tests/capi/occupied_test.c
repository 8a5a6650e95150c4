/* Marking with bodies in the way. */
#include <stdio.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 5 x 5 x 3 cubes, regions 0 to 4 along x */
static dsw_scene *g_scene;

static uint32_t cube(uint32_t x, uint32_t y, uint32_t z) { return x + 5 * (y + 5 * z); }

static size_t mark_count(void) {
  static const dsw_cell_kind kinds[4] = {DSW_CELL_VERTEX, DSW_CELL_EDGE, DSW_CELL_FACE, DSW_CELL_VOLUME};
  size_t all = 0, k;
  for (k = 0; k < 4; ++k) {
    size_t count = 999;
    CHECK_OK(dsw_environment_get_mark_count(g_env, kinds[k], &count));
    all += count;
  }
  return all;
}

static int marked(uint32_t volume) {
  int answer = -1;
  CHECK_OK(dsw_environment_is_marked(g_env, cell_at(DSW_CELL_VOLUME, volume, 0), &answer));
  return answer;
}

/* Whether `body` alone is named as being in the way; the null id: whether nothing is. */
static int named(dsw_body_id body) {
  const dsw_body_id *bodies = NULL;
  size_t count = 99;
  CHECK_OK(dsw_scene_get_occupant_bodies(g_scene, &bodies, &count));
  if (body.generation == 0) return count == 0;
  return count == 1 && bodies[0].index == body.index && bodies[0].generation == body.generation;
}

static const dsw_body_id nobody = {0, 0};

/* From (0.5, 2.5, 1.5) to (2.5, 2.5, 1.5): through three cubes. */
static dsw_body_id edge_body(dsw_level level) {
  static const double positions[6] = {0.5, 2.5, 1.5, 2.5, 2.5, 1.5};
  return make_edge_body(g_scene, positions, level);
}

/* A triangle at z = 1.5 round cube (2, 1, 1), which its edges do not cross. */
static dsw_body_id face_body(dsw_level level) {
  static const double positions[9] = {0.1, 0.1, 1.5, 4.9, 0.1, 1.5, 2.5, 4.9, 1.5};
  static const uint32_t offsets[2] = {0, 3}, corners[3] = {0, 1, 2};
  const dsw_body_desc d = surface_desc(positions, 3, offsets, corners, 1, level);
  dsw_body_id id = {9, 9};
  CHECK_OK(dsw_body_create(g_scene, &d, &id));
  return id;
}

static dsw_status mark_cube(uint32_t volume, dsw_mark mark) {
  const dsw_volume_id id = volume_at(volume);
  return dsw_environment_mark_volumes(g_env, &id, 1, mark, 0, NULL);
}

static dsw_status mark_face(uint32_t volume, uint32_t local, dsw_mark mark) {
  const dsw_face_id id = face_at(volume, local);
  return dsw_environment_mark_faces(g_env, &id, 1, mark);
}

/* The edge along z at (x, y), from z = 1 to z = 2. */
static dsw_status mark_edge(uint32_t x, uint32_t y, dsw_mark mark) {
  const uint32_t ends[2] = {x + 6 * (y + 6), x + 6 * (y + 12)};
  dsw_edge_id edge;
  size_t missing = 9;
  CHECK_OK(dsw_environment_find_edges(g_env, 1, ends, &edge, &missing));
  CHECK(missing == 0);
  return dsw_environment_mark_edges(g_env, &edge, 1, mark);
}

static void a_vertex_holds_its_volume_at_every_level(void) {
  static const dsw_level levels[4] = {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES};
  size_t i;
  for (i = 0; i < 4; ++i) {
    const dsw_body_id body = edge_body(levels[i]);
    char text[100];
    CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cube(cube(0, 2, 1), DSW_MARK_IMPASSABLE));
    sprintf(text, "1 bodies are in the way; the first is {index %u, generation %u}", body.index, body.generation);
    CHECK_MESSAGE(text);
    CHECK(named(body) && mark_count() == 0);
    CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cube(cube(2, 2, 1), DSW_MARK_IMPASSABLE));
    CHECK_OK(mark_cube(cube(3, 2, 1), DSW_MARK_IMPASSABLE)); /* beside it */
    CHECK(named(nobody));
    CHECK_OK(mark_cube(cube(3, 2, 1), DSW_MARK_PASSABLE));
    CHECK_OK(dsw_body_destroy(g_scene, body));
    CHECK_OK(mark_cube(cube(0, 2, 1), DSW_MARK_IMPASSABLE));
    CHECK_OK(mark_cube(cube(0, 2, 1), DSW_MARK_PASSABLE));
  }
}

static void an_edge_holds_what_it_crosses_from_its_level_on(void) {
  const dsw_body_id body = edge_body(DSW_LEVEL_EDGES);
  size_t all = 99;
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cube(cube(1, 2, 1), DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_face(cube(1, 2, 1), FACE_X0, DSW_MARK_IMPASSABLE));
  CHECK(named(body));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_face(cube(1, 2, 1), FACE_X1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_mark_between(g_env, 1, 0, DSW_MARK_IMPASSABLE, &all));
  CHECK(all == 99 && mark_count() == 0 && named(body));
  CHECK_OK(dsw_environment_mark_between(g_env, 2, 3, DSW_MARK_IMPASSABLE, &all));
  CHECK(all == 15 && named(nobody));
  CHECK_OK(mark_face(cube(1, 2, 1), FACE_Y0, DSW_MARK_IMPASSABLE)); /* along it */
  CHECK_OK(mark_edge(1, 2, DSW_MARK_IMPASSABLE));
  CHECK(mark_count() == 17);
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_POINTS));
  CHECK_OK(mark_cube(cube(1, 2, 1), DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES));
  CHECK_OK(mark_cube(cube(1, 2, 1), DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES));
  CHECK_OK(dsw_environment_mark_between(g_env, 2, 3, DSW_MARK_PASSABLE, NULL));
  CHECK_OK(mark_face(cube(1, 2, 1), FACE_Y0, DSW_MARK_PASSABLE));
  CHECK_OK(mark_edge(1, 2, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_destroy(g_scene, body));
  CHECK(mark_count() == 0);
}

static void a_face_holds_what_pierces_it_at_its_level(void) {
  const dsw_body_id body = face_body(DSW_LEVEL_FACES);
  const dsw_vertex_id vertex = vertex_at(2 + 6 * (1 + 6));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cube(cube(2, 1, 1), DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_face(cube(2, 1, 1), FACE_X0, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_edge(2, 1, DSW_MARK_IMPASSABLE));
  CHECK(named(body) && mark_count() == 0);
  CHECK_OK(mark_cube(cube(2, 1, 2), DSW_MARK_IMPASSABLE)); /* above it */
  CHECK_OK(mark_face(cube(2, 1, 1), FACE_Z0, DSW_MARK_IMPASSABLE));
  CHECK_OK(mark_edge(1, 4, DSW_MARK_IMPASSABLE)); /* outside of it */
  CHECK_OK(dsw_environment_mark_vertices(g_env, &vertex, 1, DSW_MARK_IMPASSABLE));
  CHECK(named(nobody) && mark_count() == 4);
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES_SWEPT));
  CHECK_OK(mark_edge(2, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_level(g_scene, body, DSW_LEVEL_FACES));
  CHECK_OK(mark_cube(cube(2, 1, 1), DSW_MARK_IMPASSABLE));
  CHECK_OK(mark_edge(2, 1, DSW_MARK_PASSABLE));
  CHECK_OK(mark_edge(1, 4, DSW_MARK_PASSABLE));
  CHECK_OK(mark_cube(cube(2, 1, 1), DSW_MARK_PASSABLE));
  CHECK_OK(mark_cube(cube(2, 1, 2), DSW_MARK_PASSABLE));
  CHECK_OK(mark_face(cube(2, 1, 1), FACE_Z0, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_environment_mark_vertices(g_env, &vertex, 1, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_destroy(g_scene, body));
  CHECK(mark_count() == 0);
}

static void what_bodies_occupy_is_left_out(void) {
  const dsw_body_id edge = edge_body(DSW_LEVEL_EDGES_SWEPT), face = face_body(DSW_LEVEL_FACES);
  const double at[3] = {3.5, 4.5, 0.5};
  dsw_particle_id particle;
  const dsw_body_id *bodies = NULL;
  const dsw_particle_id *particles = NULL;
  size_t all = 99, skipped = 99, count = 99;
  uint32_t x, y;
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  /* x from 1 to 2: the edge, the face's rim and what it spans. */
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_mark_region(g_env, 1, DSW_MARK_IMPASSABLE, 0, &all, &skipped));
  CHECK(all == 99 && skipped == 99 && mark_count() == 0);
  CHECK_OK(dsw_environment_mark_region(g_env, 1, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, &all, &skipped));
  CHECK(all == 11 && skipped == 4 && mark_count() == 11);
  for (y = 0; y < 5; ++y) CHECK(marked(cube(1, y, 1)) == (y == 4));
  CHECK_OK(dsw_scene_get_occupant_bodies(g_scene, &bodies, &count));
  CHECK(count == 2 && bodies[0].index == edge.index && bodies[1].index == face.index);
  /* Again: only what is left to mark is in the way. */
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_mark_region(g_env, 1, DSW_MARK_IMPASSABLE, 0, &all, &skipped));
  CHECK(mark_count() == 11);
  CHECK_OK(dsw_environment_mark_region(g_env, 1, DSW_MARK_PASSABLE, DSW_MARK_SKIP_OCCUPIED, &all, &skipped));
  CHECK(all == 15 && skipped == 0 && mark_count() == 0 && named(nobody));
  /* Everything, twice, with a particle. */
  {
    dsw_volume_id volumes[150];
    for (x = 0; x < 150; ++x) volumes[x] = volume_at(x % 75);
    CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_mark_volumes(g_env, volumes, 150, DSW_MARK_IMPASSABLE, 0, NULL));
    CHECK_MESSAGE("1 particles are in the way");
    CHECK_MESSAGE("so are 2 bodies");
    CHECK(mark_count() == 0);
    CHECK_OK(dsw_environment_mark_volumes(g_env, volumes, 150, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, &skipped));
    CHECK(mark_count() == 75 - skipped && !marked(cube(3, 4, 0)) && !marked(cube(2, 1, 1)) && marked(cube(0, 4, 1)));
    CHECK_OK(dsw_scene_get_occupant_bodies(g_scene, &bodies, &count));
    CHECK(count == 2);
    CHECK_OK(dsw_scene_get_occupants(g_scene, &particles, &count));
    CHECK(count == 1 && particles[0].index == particle.index);
    CHECK_OK(dsw_body_destroy(g_scene, edge));
    CHECK_OK(dsw_body_destroy(g_scene, face));
    CHECK_OK(dsw_particle_destroy(g_scene, particle));
    CHECK_OK(dsw_environment_mark_volumes(g_env, volumes, 150, DSW_MARK_IMPASSABLE, 0, &skipped));
    CHECK(skipped == 0 && mark_count() == 75 && named(nobody));
    CHECK_OK(dsw_environment_mark_volumes(g_env, volumes, 150, DSW_MARK_PASSABLE, 0, NULL));
  }
}

static void a_refused_call_keeps_what_was_marked_before(void) {
  const dsw_body_id body = edge_body(DSW_LEVEL_EDGES);
  const dsw_volume_id volumes[3] = {{cube(4, 0, 0), 1}, {cube(1, 2, 1), 1}, {cube(3, 0, 0), 1}};
  CHECK_OK(mark_cube(cube(4, 0, 0), DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_mark_volumes(g_env, volumes, 3, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK(marked(cube(4, 0, 0)) && !marked(cube(1, 2, 1)) && !marked(cube(3, 0, 0)));
  CHECK_OK(mark_cube(cube(4, 0, 0), DSW_MARK_IMPASSABLE)); /* changes nothing */
  CHECK(named(nobody));
  CHECK_OK(mark_cube(cube(4, 0, 0), DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void what_was_removed_is_not_in_the_way(void) {
  const dsw_body_id body = face_body(DSW_LEVEL_FACES);
  const dsw_body_face_id face = {0, 1};
  const dsw_body_edge_id edge = {0, 1};     /* y = 0.1 */
  const dsw_body_vertex_id vertex = {1, 1}; /* (4.9, 0.1, 1.5) */
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cube(cube(2, 1, 1), DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_body_remove_face(g_scene, body, face));
  CHECK_OK(mark_cube(cube(2, 1, 1), DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cube(cube(2, 0, 1), DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_body_remove_edge(g_scene, body, edge));
  CHECK_OK(mark_cube(cube(2, 0, 1), DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cube(cube(4, 0, 1), DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_body_remove_vertex(g_scene, body, vertex));
  CHECK_OK(mark_cube(cube(4, 0, 1), DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cube(cube(0, 0, 1), DSW_MARK_IMPASSABLE));
  CHECK(named(body) && mark_count() == 3);
  CHECK_OK(mark_cube(cube(2, 1, 1), DSW_MARK_PASSABLE));
  CHECK_OK(mark_cube(cube(2, 0, 1), DSW_MARK_PASSABLE));
  CHECK_OK(mark_cube(cube(4, 0, 1), DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void every_marking_call_forgets_the_last_ones_occupants(void) {
  const dsw_body_id body = face_body(DSW_LEVEL_FACES);
  const dsw_vertex_id vertex = vertex_at(0);
  int call;
  for (call = 0; call < 5; ++call) {
    CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cube(cube(2, 1, 1), DSW_MARK_IMPASSABLE));
    CHECK(named(body));
    if (call == 0) CHECK_OK(mark_face(0, FACE_X0, DSW_MARK_PASSABLE));
    if (call == 1) CHECK_OK(mark_edge(1, 1, DSW_MARK_PASSABLE));
    if (call == 2) CHECK_OK(dsw_environment_mark_vertices(g_env, &vertex, 1, DSW_MARK_PASSABLE));
    if (call == 3) CHECK_OK(dsw_environment_mark_region(g_env, 0, DSW_MARK_PASSABLE, 0, NULL, NULL));
    if (call == 4) CHECK_OK(dsw_environment_mark_between(g_env, 0, 1, DSW_MARK_PASSABLE, NULL));
    CHECK(named(nobody));
  }
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* What making one cube impassable and splitting a face of it look at, with a particle and an edge in each of `count`
   other cubes, and in a neighbour. */
static uint64_t looked_at(uint32_t features, unsigned count) {
  dsw_environment *environment = make_environment(NULL, 10, 10, 3);
  dsw_scene *scene = make_scene(environment, features | DSW_FEATURE_STATISTICS);
  const dsw_volume_id middle = volume_at(0), none = {0, 0};
  const dsw_face_id top = face_at(0, FACE_Z1);
  const dsw_vertex_id corners[2] = {vertex_at(0 + 11 * 11), vertex_at(1 + 11 * (1 + 11))};
  dsw_statistics s;
  unsigned i;
  for (i = 0; i < count; ++i) {
    const unsigned at = i == 0 ? 1 : 299 - i;
    const double x = at % 10 + 0.5, y = at / 10 % 10 + 0.5, z = at / 100 + 0.5;
    const double ends[6] = {x, y, z, x + 0.2, y, z};
    dsw_particle_id particle;
    make_edge_body(scene, ends, DSW_LEVEL_EDGES);
    CHECK_OK(dsw_particle_create(scene, ends, none, &particle));
  }
  CHECK_OK(dsw_environment_mark_volumes(environment, &middle, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_split_face(environment, top, corners[0], corners[1], NULL, NULL));
  s.struct_size = sizeof s;
  CHECK_OK(dsw_scene_get_statistics(scene, &s));
  end_scene(scene);
  return s.occupants_tested;
}

static void what_is_looked_at_does_not_grow_with_the_bodies(void) {
  CHECK(looked_at(0, 100) > 9 * looked_at(0, 10));
  CHECK(looked_at(DSW_FEATURE_LIVE_CHANGES, 100) == looked_at(DSW_FEATURE_LIVE_CHANGES, 10));
  CHECK(looked_at(DSW_FEATURE_LIVE_CHANGES, 10) < looked_at(0, 10) / 2);
}

static void the_getter_checks_its_arguments(void) {
  const dsw_body_id *bodies = NULL;
  size_t count = 9;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_occupant_bodies(NULL, &bodies, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_occupant_bodies(g_scene, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_occupant_bodies(g_scene, &bodies, NULL));
  CHECK(count == 9);
}

int main(void) {
  g_env = make_environment(NULL, 5, 5, 3);
  g_scene = make_scene(g_env, 0);
  CHECK(named(nobody));
  a_vertex_holds_its_volume_at_every_level();
  an_edge_holds_what_it_crosses_from_its_level_on();
  a_face_holds_what_pierces_it_at_its_level();
  what_bodies_occupy_is_left_out();
  a_refused_call_keeps_what_was_marked_before();
  what_was_removed_is_not_in_the_way();
  every_marking_call_forgets_the_last_ones_occupants();
  what_is_looked_at_does_not_grow_with_the_bodies();
  the_getter_checks_its_arguments();
  end_scene(g_scene);
  return check_result();
}
