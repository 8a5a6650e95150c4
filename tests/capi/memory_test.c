/* Memory that runs out, at every single point: a host refuses the first allocation of a call, then the second, and so
   on until the call succeeds. Whatever was refused, nothing has changed and nothing is lost. */
#include <string.h>

#include "check.h"
#include "fixture.h"

/* Repeats `call` with a refusal one allocation later each time, until it succeeds; `unchanged` must hold after each
   failure. Counts the failures into `refusals`. */
#define UNTIL_IT_SUCCEEDS(h, call, unchanged, refusals)          \
  do {                                                           \
    dsw_status status_;                                          \
    (refusals) = 0;                                              \
    for (;;) {                                                   \
      const size_t alive_ = (h).alive;                           \
      (h).refuse = (h).calls + (refusals) + 1;                   \
      status_ = (call);                                          \
      if (status_ == DSW_STATUS_OK || (refusals) > 1000) break;  \
      CHECK(status_ == DSW_STATUS_OUT_OF_MEMORY && !(h).broken); \
      CHECK_MESSAGE("allocator returned null");                  \
      CHECK((h).alive <= alive_ + MAY_KEEP);                     \
      CHECK(unchanged);                                          \
      ++(refusals);                                              \
    }                                                            \
    (h).refuse = 0;                                              \
    CHECK(status_ == DSW_STATUS_OK);                             \
  } while (0)

/* Room that a failed call made and keeps for the next one, in blocks. */
enum { MAY_KEEP = 2 };

static void creating_an_environment(void) {
  host h;
  dsw_context *const context = make_context(&h);
  grid g = grid_create(3, 3, 3);
  dsw_environment_desc d = grid_desc(&g);
  dsw_environment *environment = NULL;
  dsw_build_report report;
  size_t refusals;
  d.flags = DSW_ENVIRONMENT_LOCATE_GRID | DSW_ENVIRONMENT_CHECK_BOUNDARY;
  report.struct_size = sizeof report;
  report.status = DSW_STATUS_OK;
  UNTIL_IT_SUCCEEDS(h, dsw_environment_create(context, &d, &environment, &report),
                    environment == NULL && h.alive == 1 && report.status == DSW_STATUS_OUT_OF_MEMORY, refusals);
  CHECK(refusals >= 3 && report.status == DSW_STATUS_OK);
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK(h.alive == 1);
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && h.alive_bytes == 0 && !h.broken);
  grid_destroy(&g);
}

static void creating_a_scene(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const environment = make_environment(context, 2, 2, 2);
  dsw_scene *scene = NULL;
  dsw_scene_desc d;
  dsw_environment_info info;
  const size_t before = h.alive;
  size_t refusals;
  dsw_scene_desc_init(&d, sizeof d);
  d.features = DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS;
  info.struct_size = sizeof info;
  UNTIL_IT_SUCCEEDS(h, dsw_scene_create(environment, &d, &scene),
                    scene == NULL && h.alive == before &&
                        dsw_environment_get_info(environment, &info) == DSW_STATUS_OK && info.scene_count == 0,
                    refusals);
  CHECK(refusals >= 1);
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK(h.alive == before);
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && !h.broken);
}

enum { CLOUD = 600 };
static double g_positions[3 * CLOUD], g_targets[3 * CLOUD];
static dsw_particle_id g_ids[CLOUD];
static dsw_flight g_flights[CLOUD];

static size_t particle_count(dsw_scene *scene) {
  size_t count = 999;
  CHECK_OK(dsw_scene_get_particle_count(scene, &count));
  return count;
}

static int nothing_moved(dsw_scene *scene) {
  size_t i;
  for (i = 0; i < CLOUD; ++i) {
    double position[3];
    if (dsw_particle_get(scene, g_ids[i], position, NULL) != DSW_STATUS_OK) return 0;
    if (memcmp(position, g_positions + 3 * i, sizeof position) != 0) return 0;
  }
  return g_flights[0].cells_visited == 0;
}

static dsw_statistics statistics_of(dsw_scene *scene) {
  dsw_statistics s;
  memset(&s, 0, sizeof s);
  s.struct_size = sizeof s;
  CHECK_OK(dsw_scene_get_statistics(scene, &s));
  return s;
}

static void particles_of_a_scene(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const environment = make_environment(context, 4, 4, 4);
  dsw_scene *const scene = make_scene(environment, DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS);
  const dsw_crossing *list = NULL;
  const size_t *first = NULL;
  size_t refusals, i, flights = 9;
  dsw_particle_id one = {0, 0};
  for (i = 0; i < 3 * CLOUD; ++i) {
    g_positions[i] = 0.5 + (double)((i * 7) % 4);
    g_targets[i] = 0.25 + (double)((i * 5) % 6) - 1;
  }
  memset(g_flights, 0, sizeof g_flights);
  UNTIL_IT_SUCCEEDS(h, dsw_particle_create(scene, g_positions, no_volume, &one),
                    one.generation == 0 && particle_count(scene) == 0, refusals);
  CHECK(refusals >= 1 && particle_count(scene) == 1);
  CHECK_OK(dsw_particle_destroy(scene, one));
  UNTIL_IT_SUCCEEDS(h, dsw_scene_create_particles(scene, g_positions, CLOUD, 0, NULL, g_ids, NULL),
                    g_ids[0].generation == 0 && particle_count(scene) == 0, refusals);
  CHECK(refusals >= 2 && particle_count(scene) == CLOUD);
  UNTIL_IT_SUCCEEDS(h, dsw_scene_move_particles(scene, g_ids, CLOUD, g_targets, 0, NULL, g_flights),
                    nothing_moved(scene) && statistics_of(scene).casts == 0 &&
                        dsw_scene_get_crossings(scene, &list, &first, &flights) == DSW_STATUS_OK && flights == 0,
                    refusals);
  CHECK(refusals >= 3 && statistics_of(scene).casts >= CLOUD);
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && !h.broken);
}

static size_t mark_count(dsw_environment *environment, dsw_cell_kind kind) {
  size_t count = 999;
  CHECK_OK(dsw_environment_get_mark_count(environment, kind, &count));
  return count;
}

static void marks_and_tags(void) {
  host h;
  dsw_context *const context = make_context(&h);
  grid g = grid_create(6, 5, 5);
  dsw_environment_desc d = grid_desc(&g);
  dsw_environment *environment = NULL;
  dsw_scene *scene;
  dsw_particle_id id;
  const double position[3] = {0.5, 0.5, 0.5};
  dsw_volume_id volumes[150];
  dsw_face_id faces[150];
  dsw_edge_id edges[150];
  dsw_vertex_id vertices[150];
  uint32_t i, tag = 1;
  size_t refusals;
  for (i = 0; i < 150; ++i) {
    volumes[i] = volume_at(i);
    faces[i] = face_at(i, FACE_X1);
    edges[i] = edge_at(i, 0);
    vertices[i] = vertex_at(i);
  }
  d.tags = NULL;
  CHECK_OK(dsw_environment_create(context, &d, &environment, NULL));
  scene = make_scene(environment, 0);
  CHECK_OK(dsw_particle_create(scene, position, no_volume, &id));
  UNTIL_IT_SUCCEEDS(
      h, dsw_environment_mark_volumes(environment, volumes, 150, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, NULL),
      mark_count(environment, DSW_CELL_VOLUME) == 0, refusals);
  CHECK(refusals >= 1 && mark_count(environment, DSW_CELL_VOLUME) == 149);
  UNTIL_IT_SUCCEEDS(h, dsw_environment_mark_faces(environment, faces, 150, DSW_MARK_IMPASSABLE),
                    mark_count(environment, DSW_CELL_FACE) == 0, refusals);
  CHECK(refusals >= 1 && mark_count(environment, DSW_CELL_FACE) == 150);
  UNTIL_IT_SUCCEEDS(h, dsw_environment_mark_edges(environment, edges, 150, DSW_MARK_IMPASSABLE),
                    mark_count(environment, DSW_CELL_EDGE) == 0, refusals);
  CHECK(refusals >= 1 && mark_count(environment, DSW_CELL_EDGE) == 150);
  UNTIL_IT_SUCCEEDS(h, dsw_environment_mark_vertices(environment, vertices, 150, DSW_MARK_IMPASSABLE),
                    mark_count(environment, DSW_CELL_VERTEX) == 0, refusals);
  CHECK(refusals >= 1 && mark_count(environment, DSW_CELL_VERTEX) == 150);
  UNTIL_IT_SUCCEEDS(h, dsw_environment_set_tag(environment, volume_at(3), 77),
                    dsw_environment_get_tag(environment, volume_at(3), &tag) == DSW_STATUS_OK && tag == 0, refusals);
  CHECK(refusals >= 1);
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && !h.broken);
  grid_destroy(&g);
}

/* A surface and a line through all of a row of cubes. */
static void marks_with_bodies(void) {
  static const double positions[15] = {0.5, 0.5, 0.5, 5.5, 0.5, 0.5, 2.5, 4.5, 0.5, 0.5, 2.5, 2.5, 5.5, 2.5, 2.5};
  static const uint32_t offsets[2] = {0, 3}, corners[3] = {0, 1, 2}, edge[2] = {3, 4};
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const environment = make_environment(context, 6, 5, 5);
  dsw_scene *const scene = make_scene(environment, 0);
  const dsw_body_id *bodies = NULL;
  dsw_volume_id volumes[150];
  dsw_face_id faces[150];
  dsw_body_desc d;
  dsw_body_id id;
  size_t refusals, skipped = 0, count = 9, face_count = 0;
  uint32_t i;
  for (i = 0; i < 150; ++i) {
    volumes[i] = volume_at(i);
    if (i % 30 / 6 != 2 && i >= 30) faces[face_count++] = face_at(i, FACE_X1);
  }
  dsw_body_desc_init(&d, sizeof d);
  d.level = DSW_LEVEL_FACES;
  d.positions = positions;
  d.vertex_count = 5;
  d.edges = edge;
  d.edge_count = 1;
  d.face_offsets = offsets;
  d.face_corners = corners;
  d.face_count = 1;
  d.face_corner_count = 3;
  CHECK_OK(dsw_body_create(scene, &d, &id));
  UNTIL_IT_SUCCEEDS(h, dsw_environment_mark_faces(environment, faces, face_count, DSW_MARK_IMPASSABLE),
                    mark_count(environment, DSW_CELL_FACE) == 0, refusals);
  CHECK(refusals >= 1 && mark_count(environment, DSW_CELL_FACE) == face_count);
  CHECK_OK(dsw_environment_mark_faces(environment, faces, face_count, DSW_MARK_PASSABLE));
  UNTIL_IT_SUCCEEDS(
      h, dsw_environment_mark_volumes(environment, volumes, 150, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, &skipped),
      mark_count(environment, DSW_CELL_VOLUME) == 0 && skipped == 0 &&
          dsw_scene_get_occupant_bodies(scene, &bodies, &count) == DSW_STATUS_OK && count == 0,
      refusals);
  CHECK(refusals >= 4 && skipped > 20 && mark_count(environment, DSW_CELL_VOLUME) == 150 - skipped);
  CHECK_OK(dsw_scene_get_occupant_bodies(scene, &bodies, &count));
  CHECK(count == 1);
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && !h.broken);
}

static void queries(void) {
  static const uint32_t indices[6] = {1, 17, 13, 5, 0, 1};
  static const size_t offsets[2] = {0, 4};
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const environment = make_environment(context, 3, 2, 2);
  const double point[3] = {1.25, 0.5, 0.625};
  const size_t before = h.alive;
  dsw_face_id face = {9, 9, 9};
  dsw_edge_id edge = {9, 9, 9};
  dsw_nearest nearest;
  size_t refusals;
  UNTIL_IT_SUCCEEDS(h, dsw_environment_find_faces(environment, 1, offsets, indices, &face, NULL),
                    face.volume == 9 && h.alive == before, refusals);
  CHECK(refusals >= 1 && face.volume == 0);
  UNTIL_IT_SUCCEEDS(h, dsw_environment_find_edges(environment, 1, indices + 4, &edge, NULL),
                    edge.volume == 9 && h.alive == before, refusals);
  CHECK(refusals >= 1 && edge.volume == 0);
  memset(&nearest, 0x55, sizeof nearest);
  UNTIL_IT_SUCCEEDS(h, dsw_environment_find_nearest(environment, point, no_volume, 1, &nearest),
                    nearest.tag == 0x55555555u && h.alive == before, refusals);
  CHECK(nearest.distance == 0.5);
  UNTIL_IT_SUCCEEDS(h, dsw_environment_check(environment, NULL), h.alive == before, refusals);
  CHECK(h.alive == before);
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && !h.broken);
}

/* Large triangles in a batch of two chunks. */
static void sweeps(void) {
  enum { COUNT = 300 };
  static const double from[9] = {0.25, 0.5, 0.5, 0.5, 5.5, 0.25, 5.75, 0.25, 5.5};
  static const double to[9] = {5.75, 0.25, 1.5, 5.5, 5.25, 3.75, 0.25, 0.75, 0.5};
  static const double fixed[9] = {3.25, 5.5, 5.5, 2.75, 0.5, 5.25, 3.5, 5.75, 3.25};
  static double points[3][3 * COUNT];
  static dsw_sweep reports[COUNT];
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const environment = make_environment(context, 6, 6, 6);
  size_t before, refusals, i;
  for (i = 0; i < 20; ++i) { /* until there is a search structure for points, which stays */
    const dsw_volume_id none = {0, 0};
    dsw_volume_id volume;
    CHECK_OK(dsw_environment_locate(environment, from, none, &volume, NULL));
  }
  before = h.alive;
  for (i = 0; i < 3 * COUNT; ++i) {
    points[0][i] = from[i % 9];
    points[1][i] = to[i % 9];
    points[2][i] = fixed[i % 9];
  }
  UNTIL_IT_SUCCEEDS(
      h, dsw_environment_sweep_edges(environment, COUNT, NULL, points[0], points[1], points[2], 0, NULL, reports),
      h.alive == before, refusals);
  CHECK(refusals >= 4 && h.alive == before && h.parallel_calls == refusals + 1);
  for (i = 0; i < COUNT; ++i) CHECK(reports[i].outcome == DSW_OUTCOME_REACHED && reports[i].cells_visited > 20);
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && !h.broken);
}

static void saving_and_loading_a_scene(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const environment = make_environment(context, 3, 3, 3);
  dsw_scene *const scene = make_scene(environment, 0);
  const double ends[6] = {0.5, 0.5, 0.5, 2.5, 1.25, 1.75}, place[3] = {1.5, 1.5, 1.5};
  static unsigned char block[2][8192];
  dsw_particle_id particle;
  dsw_scene *loaded = NULL;
  size_t size = 0, again = 0, refusals, before;
  (void)make_edge_body(scene, ends, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_particle_create(scene, place, no_volume, &particle));
  block[0][0] = 0x55;
  UNTIL_IT_SUCCEEDS(h, dsw_scene_save(scene, block[0], sizeof block[0], &size), block[0][0] == 0x55 && size == 0,
                    refusals);
  CHECK(refusals >= 3);
  before = h.alive;
  UNTIL_IT_SUCCEEDS(h, dsw_scene_load(environment, block[0], size, &loaded), loaded == NULL && h.alive == before,
                    refusals);
  CHECK(refusals >= 10);
  CHECK_OK(dsw_scene_save(loaded, block[1], sizeof block[1], &again));
  CHECK(again == size && memcmp(block[0], block[1], size) == 0);
  CHECK_OK(dsw_scene_destroy(loaded));
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_environment_destroy(environment));
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && h.alive_bytes == 0 && !h.broken);
}

int main(void) {
  saving_and_loading_a_scene();
  creating_an_environment();
  creating_a_scene();
  particles_of_a_scene();
  marks_and_tags();
  marks_with_bodies();
  queries();
  sweeps();
  return check_result();
}
