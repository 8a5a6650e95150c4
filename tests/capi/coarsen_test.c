#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* Cubes of this side, six tetrahedra each, round their long diagonals. Region 1 is the half with low x; NULL tags. */
enum { SIDE = 4, CUBES = SIDE * SIDE * SIDE, CELLS = 6 * CUBES };

static dsw_environment *tetrahedra(dsw_context *context, double side, int borrow) {
  static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  static double points[3 * (SIDE + 1) * (SIDE + 1) * (SIDE + 1)];
  static int64_t cells[4 * CELLS];
  static int32_t regions[CELLS];
  const int steps[3] = {1, SIDE + 1, (SIDE + 1) * (SIDE + 1)};
  dsw_environment_desc desc;
  dsw_environment *env = NULL;
  size_t n = 0, r = 0;
  int x, y, z, i;
  for (z = 0; z <= SIDE; ++z) {
    for (y = 0; y <= SIDE; ++y) {
      for (x = 0; x <= SIDE; ++x) {
        double *const p = points + 3 * (x + steps[1] * y + steps[2] * z);
        p[0] = side * x, p[1] = side * y, p[2] = side * z;
      }
    }
  }
  for (i = 0; i < CELLS; ++i) {
    const int cube = i / 6, odd = i % 6 >= 3;
    const int p = cube % SIDE + steps[1] * (cube / SIDE % SIDE) + steps[2] * (cube / SIDE / SIDE);
    const int a = p + steps[orders[i % 6][0]], b = a + steps[orders[i % 6][1]], c = b + steps[orders[i % 6][2]];
    cells[n++] = p, cells[n++] = odd ? b : a, cells[n++] = odd ? a : b, cells[n++] = c;
    regions[r++] = cube % SIDE < SIDE / 2 ? 1 : 2;
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points;
  desc.point_count = sizeof points / (3 * sizeof(double));
  desc.volume_count = CELLS;
  desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  desc.connectivity = cells;
  desc.connectivity_count = 4 * CELLS;
  desc.regions = regions;
  desc.flags = borrow ? DSW_ENVIRONMENT_BORROW_POINTS : DSW_ENVIRONMENT_LOCATE_TREE;
  if (context == NULL) CHECK_OK(dsw_environment_create(NULL, &desc, &env, NULL));
  if (context != NULL) CHECK_OK(dsw_environment_create(context, &desc, &env, NULL));
  return env;
}

static dsw_environment *coarsened(const dsw_environment *env, uint32_t *map, dsw_coarsen_report *report) {
  dsw_environment *coarse = NULL;
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
  CHECK_OK(dsw_environment_coarsen(env, NULL, &coarse, map, CELLS, report));
  CHECK_OK(dsw_environment_check(coarse, NULL));
  return coarse;
}

static void cells_are_merged_within_regions(void) {
  dsw_environment *const env = tetrahedra(NULL, 1, 0);
  uint32_t map[CELLS], i;
  dsw_coarsen_report report;
  dsw_environment *const coarse = coarsened(env, map, &report);
  dsw_environment_info before, after;
  size_t marked[2] = {0, 1};
  before.struct_size = sizeof before, after.struct_size = sizeof after;
  CHECK_OK(dsw_environment_get_info(env, &before));
  CHECK_OK(dsw_environment_get_info(coarse, &after));
  CHECK(report.complete == 1 && report.trials > 0);
  CHECK(report.volume_count[0] == CELLS && report.volume_count[1] == after.volume_count);
  CHECK(report.face_count[0] == before.face_count && report.face_count[1] == after.face_count);
  CHECK(report.memory_bytes[0] == before.memory_bytes && report.memory_bytes[1] == after.memory_bytes);
  CHECK(after.volume_count * 5 <= CELLS);
  CHECK(report.passable_area[1] < 0.6 * report.passable_area[0]);
  CHECK(after.boundary_face_count == before.boundary_face_count && after.vertex_count == before.vertex_count);
  for (i = 0; i < CELLS; ++i) {
    int32_t region[2] = {0, 1};
    CHECK(map[i] < after.volume_count);
    CHECK_OK(dsw_environment_get_region(env, volume_at(i), &region[0]));
    CHECK_OK(dsw_environment_get_region(coarse, volume_at(map[i]), &region[1]));
    CHECK(region[0] == region[1]);
  }
  CHECK_OK(dsw_environment_mark_between(env, 1, 2, DSW_MARK_IMPASSABLE, &marked[0]));
  CHECK_OK(dsw_environment_mark_between(coarse, 1, 2, DSW_MARK_IMPASSABLE, &marked[1]));
  CHECK(marked[0] == 2 * SIDE * SIDE && marked[1] == marked[0]);
  CHECK_OK(dsw_environment_destroy(env)); /* nothing of it is retained */
  CHECK_OK(dsw_environment_check(coarse, NULL));
  CHECK_OK(dsw_environment_destroy(coarse));
}

static void marks_and_tags_stay(void) {
  dsw_environment *const env = tetrahedra(NULL, 1, 1);
  const dsw_volume_id volume = volume_at(50);
  const dsw_face_id face = face_at(100, 1);
  const uint32_t middle = 2 + (SIDE + 1) * 2 + (SIDE + 1) * (SIDE + 1) * 2;
  const dsw_vertex_id vertex = vertex_at(middle + 1);
  uint32_t map[CELLS], pair[2], tag = 0;
  dsw_edge_id edge, there;
  dsw_coarsen_report report;
  dsw_environment *coarse;
  size_t i, counts[2], missing = 1;
  int marked = 0;
  pair[0] = middle, pair[1] = middle + 1 + (SIDE + 1) + (SIDE + 1) * (SIDE + 1);
  CHECK_OK(dsw_environment_find_edges(env, 1, pair, &edge, &missing));
  CHECK(missing == 0);
  CHECK_OK(dsw_environment_mark_volumes(env, &volume, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_mark_faces(env, &face, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_mark_edges(env, &edge, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_mark_vertices(env, &vertex, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_set_tag(env, volume_at(7), 77));
  coarse = coarsened(env, map, &report);
  for (i = 0; i < CELLS; ++i) CHECK((map[i] == map[7]) == (i == 7) && (map[i] == map[50]) == (i == 50));
  CHECK_OK(dsw_environment_get_tag(coarse, volume_at(map[7]), &tag));
  CHECK(tag == 77);
  CHECK_OK(dsw_environment_is_marked(coarse, cell_at(DSW_CELL_VOLUME, map[50], 0), &marked));
  CHECK(marked);
  CHECK_OK(dsw_environment_find_edges(coarse, 1, pair, &there, &missing));
  CHECK(missing == 0);
  for (i = 0; i < 4; ++i) {
    static const dsw_cell_kind kinds[4] = {DSW_CELL_VERTEX, DSW_CELL_EDGE, DSW_CELL_FACE, DSW_CELL_VOLUME};
    CHECK_OK(dsw_environment_get_mark_count(env, kinds[i], &counts[0]));
    CHECK_OK(dsw_environment_get_mark_count(coarse, kinds[i], &counts[1]));
    CHECK(counts[0] == 1 && counts[1] == 1);
  }
  CHECK_OK(dsw_environment_destroy(coarse));
  CHECK_OK(dsw_environment_destroy(env));
}

static void options_are_kept(void) {
  dsw_environment *const env = tetrahedra(NULL, 1, 0);
  dsw_environment *coarse = NULL;
  dsw_coarsen_options options;
  dsw_coarsen_report report;
  uint32_t i;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  dsw_coarsen_options_init(&options, sizeof options);
  CHECK(options.struct_size == sizeof options && options.max_faces == 16 && options.max_trials == 0);
  options.max_faces = 8;
  CHECK_OK(dsw_environment_coarsen(env, &options, &coarse, NULL, 0, &report));
  for (i = 0; i < report.volume_count[1]; ++i) {
    uint32_t faces = 0;
    CHECK_OK(dsw_environment_get_volume_counts(coarse, volume_at(i), NULL, NULL, NULL, &faces));
    CHECK(faces <= 8);
  }
  CHECK_OK(dsw_environment_destroy(coarse));
  options.max_trials = 10;
  CHECK_OK(dsw_environment_coarsen(env, &options, &coarse, NULL, 0, &report));
  CHECK(report.trials == 10 && report.complete == 0 && report.volume_count[1] >= CELLS - 10);
  CHECK_OK(dsw_environment_destroy(coarse));
  options.max_faces = 4; /* nothing to merge */
  options.max_trials = 0;
  CHECK_OK(dsw_environment_coarsen(env, &options, &coarse, NULL, 0, &report));
  CHECK(report.complete == 1 && report.volume_count[1] == CELLS);
  CHECK_OK(dsw_environment_check(coarse, NULL));
  CHECK_OK(dsw_environment_destroy(coarse));
  CHECK_OK(dsw_environment_destroy(env));
}

/* Areas neither over- nor underflow on the way: the same is merged in every unit, to the bit. */
static void units_do_not_matter(void) {
  static const int exponents[4] = {-400, 400, -600, 600};
  dsw_environment *const env = tetrahedra(NULL, 1, 0);
  uint32_t map[2][CELLS];
  dsw_coarsen_report reports[2];
  size_t i;
  CHECK_OK(dsw_environment_destroy(coarsened(env, map[0], &reports[0])));
  CHECK_OK(dsw_environment_destroy(env));
  for (i = 0; i < 4; ++i) {
    dsw_environment *const other = tetrahedra(NULL, ldexp(1, exponents[i]), 0);
    size_t k;
    CHECK_OK(dsw_environment_destroy(coarsened(other, map[1], &reports[1])));
    CHECK(memcmp(map[0], map[1], sizeof map[0]) == 0);
    for (k = 0; k < 2; ++k) {
      CHECK(reports[1].passable_area[k] == ldexp(reports[0].passable_area[k], 2 * exponents[i]));
    }
    CHECK_OK(dsw_environment_destroy(other));
  }
}

/* Cells with tables of their own, and a change of the topology on top: shared tables come apart. */
static void others_stay_and_all_can_change(void) {
  dsw_environment *const cubes = make_environment(NULL, 2, 2, 2), *const env = tetrahedra(NULL, 1, 0);
  dsw_environment *coarse = NULL;
  dsw_coarsen_report report;
  uint32_t map[CELLS];
  dsw_volume_id first = volume_at(0);
  CHECK_OK(dsw_environment_coarsen(cubes, NULL, &coarse, map, CELLS, NULL));
  CHECK(map[0] == 0 && map[7] == 7);
  CHECK_OK(dsw_environment_check(coarse, NULL));
  CHECK_OK(dsw_environment_destroy(coarse));
  coarse = coarsened(env, map, &report);
  CHECK_OK(dsw_environment_remove_volumes(coarse, &first, 1));
  CHECK_OK(dsw_environment_check(coarse, NULL));
  CHECK_OK(dsw_environment_destroy(coarse));
  CHECK_OK(dsw_environment_destroy(cubes));
  CHECK_OK(dsw_environment_destroy(env));
}

static void snapshots_keep_it(void) {
  dsw_environment *const env = tetrahedra(NULL, 1, 0);
  uint32_t map[CELLS];
  dsw_coarsen_report report;
  dsw_environment *const coarse = coarsened(env, map, &report);
  dsw_environment *loaded = NULL;
  size_t size = 0;
  void *block;
  dsw_flight a, b;
  const double from[3] = {0.3, 0.4, 0.6}, to[3] = {3.7, 3.1, 3.9};
  memset(&a, 0, sizeof a);
  memset(&b, 0, sizeof b);
  CHECK_OK(dsw_environment_save(coarse, NULL, 0, &size));
  block = malloc(size);
  CHECK_OK(dsw_environment_save(coarse, block, size, &size));
  CHECK_OK(dsw_environment_load(NULL, block, size, &loaded));
  CHECK_OK(dsw_environment_check(loaded, NULL));
  CHECK_OK(dsw_environment_cast(coarse, no_volume, from, to, NULL, &a));
  CHECK_OK(dsw_environment_cast(loaded, no_volume, from, to, NULL, &b));
  CHECK(memcmp(&a, &b, sizeof a) == 0);
  free(block);
  CHECK_OK(dsw_environment_destroy(loaded));
  CHECK_OK(dsw_environment_destroy(coarse));
  CHECK_OK(dsw_environment_destroy(env));
}

static void bad_arguments_are_refused(void) {
  dsw_environment *const env = tetrahedra(NULL, 1, 0);
  dsw_environment *coarse = NULL;
  dsw_coarsen_options options;
  dsw_coarsen_report report;
  uint32_t map[CELLS];
  dsw_coarsen_options_init(&options, sizeof options);
  dsw_coarsen_options_init(NULL, 0);
  memset(&report, 0, sizeof report);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_coarsen(NULL, NULL, &coarse, NULL, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_coarsen(env, NULL, NULL, NULL, 0, NULL));
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_coarsen(env, NULL, &coarse, NULL, 0, &report));
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_environment_coarsen(env, NULL, &coarse, map, CELLS - 1, NULL));
  options.max_faces = 3;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_coarsen(env, &options, &coarse, NULL, 0, NULL));
  options.max_faces = 29;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_coarsen(env, &options, &coarse, NULL, 0, NULL));
  options.struct_size = 4;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_coarsen(env, &options, &coarse, NULL, 0, NULL));
  CHECK(coarse == NULL);
  CHECK_OK(dsw_environment_destroy(env));
}

static void refused_memory_leaves_nothing(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const env = tetrahedra(context, 1, 0);
  dsw_environment *coarse = NULL;
  uint32_t map[CELLS];
  size_t alive, failures = 0;
  alive = h.alive;
  map[0] = 12345;
  for (; RUNS_OUT(&h, failures, dsw_environment_coarsen(env, NULL, &coarse, map, CELLS, NULL)); ++failures) {
    CHECK(coarse == NULL && h.alive == alive && map[0] == 12345);
  }
  CHECK(failures > 10 && !h.broken);
  CHECK_OK(dsw_environment_destroy(coarse));
  CHECK_OK(dsw_environment_destroy(env));
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0);
}

int main(void) {
  cells_are_merged_within_regions();
  marks_and_tags_stay();
  options_are_kept();
  units_do_not_matter();
  others_stay_and_all_can_change();
  snapshots_keep_it();
  bad_arguments_are_refused();
  refused_memory_leaves_nothing();
  return check_result();
}
