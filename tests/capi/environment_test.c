/* Creation, its defects, and destruction. What an environment answers is in cells_test.c. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static const double unit_tet[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};

static dsw_build_report new_report(void) {
  dsw_build_report r;
  memset(&r, 0x55, sizeof r);
  r.struct_size = sizeof r;
  return r;
}

/* Tetrahedra over `points`; the environment is gone again. */
static dsw_status build_tets(const double *points, size_t point_count, const int32_t *cells, size_t cell_count,
                             uint32_t flags, dsw_build_report *report) {
  dsw_environment_desc d;
  dsw_environment *environment = NULL;
  dsw_status status;
  dsw_environment_desc_init(&d, sizeof d);
  d.flags = flags;
  d.index_bytes = 4;
  d.points = points;
  d.point_count = point_count;
  d.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  d.volume_count = cell_count;
  d.connectivity = cells;
  d.connectivity_count = 4 * cell_count;
  status = dsw_environment_create(NULL, &d, &environment, report);
  CHECK((environment != NULL) == (status == DSW_STATUS_OK));
  CHECK_OK(dsw_environment_destroy(environment));
  return status;
}

static void init_writes_the_defaults(void) {
  dsw_environment_desc d;
  memset(&d, 0xff, sizeof d);
  dsw_environment_desc_init(&d, sizeof d);
  CHECK(d.struct_size == sizeof d && d.dimension == 3 && d.flags == 0 && d.index_bytes == 8);
  CHECK(d.uniform_cell_type == DSW_CELL_TYPE_HEXAHEDRON && d.points == NULL && d.reserved == 0);
  dsw_environment_desc_init(NULL, sizeof d);
}

static void a_grid_is_created_and_reported(void) {
  grid g = grid_create(2, 3, 4);
  const dsw_environment_desc d = grid_desc(&g);
  dsw_build_report r = new_report();
  dsw_environment *environment = NULL;
  CHECK_OK(dsw_environment_create(NULL, &d, &environment, &r));
  CHECK(r.struct_size == sizeof r && r.status == DSW_STATUS_OK && r.offender_count == 0);
  CHECK(r.part_count == 1 && r.unused_point_count == 0 && r.reoriented_count == 0);
  CHECK(r.boundary_face_count == 2 * (6 + 8 + 12) && r.convex_volume_count == 24);
  CHECK_OK(dsw_environment_destroy(environment));
  grid_destroy(&g);
}

static void null_arguments_are_refused(void) {
  grid g = grid_create(1, 1, 1);
  dsw_environment_desc d = grid_desc(&g);
  dsw_environment *environment = NULL;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_create(NULL, NULL, &environment, NULL));
  CHECK_MESSAGE("desc is null");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_create(NULL, &d, NULL, NULL));
  d.points = NULL;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_create(NULL, &d, &environment, NULL));
  CHECK_MESSAGE("desc->points is null");
  d = grid_desc(&g);
  d.connectivity = NULL;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_create(NULL, &d, &environment, NULL));
  CHECK(environment == NULL);
  CHECK_OK(dsw_environment_destroy(NULL));
  grid_destroy(&g);
}

typedef struct newer_desc {
  dsw_environment_desc known;
  uint64_t unknown;
} newer_desc;
typedef struct newer_report {
  dsw_build_report known;
  uint64_t unknown;
} newer_report;

static void sizes_are_understood(void) {
  grid g = grid_create(1, 1, 1);
  newer_desc d;
  newer_report r;
  dsw_build_report old;
  dsw_environment *environment = NULL;
  d.known = grid_desc(&g);
  d.known.struct_size = offsetof(dsw_environment_desc, merge_distance) - 1; /* less than the first release had */
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_create(NULL, &d.known, &environment, NULL));
  d.known.struct_size = sizeof d;
  d.unknown = (uint64_t)1 << 63;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_create(NULL, &d.known, &environment, NULL));
  d.unknown = 0;
  memset(&old, 0, sizeof old);
  old.struct_size = offsetof(dsw_build_report, reoriented_face_count) - 1;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_create(NULL, &d.known, &environment, &old));
  CHECK_MESSAGE("report->struct_size");
  CHECK(environment == NULL);
  memset(&r, 0x55, sizeof r);
  r.known.struct_size = sizeof r;
  CHECK_OK(dsw_environment_create(NULL, &d.known, &environment, &r.known));
  CHECK(r.known.struct_size == sizeof r && r.known.status == DSW_STATUS_OK && r.unknown == 0);
  CHECK_OK(dsw_environment_destroy(environment));
  grid_destroy(&g);
}

#define CREATE dsw_environment_create(NULL, &bad, &environment, NULL)

static void unknown_values_are_refused(void) {
  grid g = grid_create(1, 1, 1);
  const dsw_environment_desc d = grid_desc(&g);
  dsw_environment_desc bad;
  dsw_environment *environment = NULL;
  CHECK_REFUSES(DSW_STATUS_BAD_CELL_TYPE, d, dimension, 2, CREATE);
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, dimension, 4, CREATE);
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, d, flags, 0x200, CREATE);
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, d, reserved, 1, CREATE);
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, index_bytes, 2, CREATE);
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, volume_count, 0, CREATE);
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, point_count, 0, CREATE);
  CHECK_REFUSES(DSW_STATUS_TOO_LARGE, d, point_count, (size_t)1 << 28, CREATE);
  CHECK_REFUSES(DSW_STATUS_BAD_CELL_TYPE, d, uniform_cell_type, DSW_CELL_TYPE_POLYHEDRON, CREATE);
  CHECK(environment == NULL);
  grid_destroy(&g);
}

static void sizes_of_arrays_must_agree(void) {
  grid g = grid_create(1, 1, 1);
  const dsw_environment_desc d = grid_desc(&g);
  dsw_environment_desc bad;
  dsw_environment *environment = NULL;
  CHECK_REFUSES(DSW_STATUS_WRONG_SIZE, d, connectivity_count, 7, CREATE);
  CHECK_REFUSES(DSW_STATUS_WRONG_SIZE, d, point_stride_bytes, 16, CREATE);
  CHECK_REFUSES(DSW_STATUS_WRONG_SIZE, d, point_stride_bytes, 28, CREATE);
  bad.point_stride_bytes = 32;
  CHECK_REFUSES(DSW_STATUS_WRONG_SIZE, bad, flags, DSW_ENVIRONMENT_BORROW_POINTS, CREATE);
  bad = d, bad.faces = g.cells;
  CHECK_REFUSES(DSW_STATUS_WRONG_SIZE, bad, faces_count, 8, CREATE);
  CHECK(environment == NULL);
  grid_destroy(&g);
}

static void points_may_be_spaced_out(void) {
  double points[4][5];
  int32_t cell[4] = {0, 1, 2, 3};
  dsw_environment_desc d;
  dsw_environment *environment = NULL;
  double xyz[3];
  int i;
  memset(points, 0xff, sizeof points); /* NaN in between must not be read */
  for (i = 0; i < 4; ++i) memcpy(points[i], unit_tet + 3 * i, 3 * sizeof(double));
  dsw_environment_desc_init(&d, sizeof d);
  d.index_bytes = 4;
  d.points = points[0];
  d.point_count = 4;
  d.point_stride_bytes = sizeof points[0];
  d.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  d.volume_count = 1;
  d.connectivity = cell;
  d.connectivity_count = 4;
  CHECK_OK(dsw_environment_create(NULL, &d, &environment, NULL));
  CHECK_OK(dsw_environment_get_vertex_position(environment, vertex_at(3), xyz));
  CHECK(xyz[0] == 0 && xyz[1] == 0 && xyz[2] == 1);
  CHECK_OK(dsw_environment_destroy(environment));
}

static void borrowed_points_are_read_in_place(void) {
  grid g = grid_create(2, 2, 2);
  dsw_environment_desc d = grid_desc(&g);
  dsw_environment *copied = NULL, *borrowed = NULL;
  dsw_environment_info a, b;
  memset(&a, 0, sizeof a);
  memset(&b, 0, sizeof b);
  a.struct_size = b.struct_size = sizeof a;
  CHECK_OK(dsw_environment_create(NULL, &d, &copied, NULL));
  d.flags = DSW_ENVIRONMENT_BORROW_POINTS;
  CHECK_OK(dsw_environment_create(NULL, &d, &borrowed, NULL));
  CHECK_OK(dsw_environment_get_info(copied, &a));
  CHECK_OK(dsw_environment_get_info(borrowed, &b));
  CHECK(a.memory_bytes == b.memory_bytes); /* borrowed points are counted too */
  CHECK_OK(dsw_environment_destroy(copied));
  CHECK_OK(dsw_environment_destroy(borrowed));
  grid_destroy(&g);
}

static void every_defect_has_its_status_and_names_its_cells(void) {
  dsw_build_report r = new_report();
  double points[18];
  int32_t cells[12] = {0, 1, 2, 3, 0, 2, 1, 3};
  memset(points, 0, sizeof points);
  memcpy(points, unit_tet, sizeof unit_tet);
  points[14] = -1; /* 4: below the face 0 1 2 */

  CHECK(build_tets(points, 5, cells, 1, 0, &r) == DSW_STATUS_OK && r.unused_point_count == 1);

  points[13] = NAN;
  r = new_report();
  CHECK(build_tets(points, 5, cells, 1, 0, &r) == DSW_STATUS_NON_FINITE);
  CHECK(r.status == DSW_STATUS_NON_FINITE && r.offender_count == 1 && r.offenders[0] == 4);
  CHECK_MESSAGE("dsw_environment_create: ");
  CHECK_MESSAGE("point 4");
  points[13] = 0;

  cells[3] = 5;
  r = new_report();
  CHECK(build_tets(points, 5, cells, 1, 0, &r) == DSW_STATUS_INDEX_OUT_OF_RANGE);
  CHECK(r.offender_count == 1 && r.offenders[0] == 0);
  cells[3] = -1;
  CHECK(build_tets(points, 5, cells, 1, 0, &r) == DSW_STATUS_INDEX_OUT_OF_RANGE);

  cells[3] = 2;
  r = new_report();
  CHECK(build_tets(points, 5, cells, 1, 0, &r) == DSW_STATUS_BAD_CELL);
  CHECK(r.status == DSW_STATUS_BAD_CELL && r.offender_count == 1);
  cells[3] = 3;

  r = new_report();
  CHECK(build_tets(points, 5, cells + 4, 1, 0, &r) == DSW_STATUS_INVERTED_CELL);
  CHECK(r.status == DSW_STATUS_INVERTED_CELL && r.offender_count == 1 && r.offenders[0] == 0);
  r = new_report();
  CHECK(build_tets(points, 5, cells + 4, 1, DSW_ENVIRONMENT_REORIENT, &r) == DSW_STATUS_OK);
  CHECK(r.reoriented_count == 1);

  memcpy(cells + 4, cells, 4 * sizeof cells[0]);
  r = new_report();
  CHECK(build_tets(points, 5, cells, 2, 0, &r) == DSW_STATUS_DUPLICATE_CELL);
  CHECK(r.offender_count == 2 && r.offenders[0] == 0 && r.offenders[1] == 1);

  points[14] = 0; /* 4 = 0, so a cell over both is flat */
  cells[4] = 0;
  cells[5] = 1;
  cells[6] = 2;
  cells[7] = 4;
  r = new_report();
  CHECK(build_tets(points, 5, cells + 4, 1, 0, &r) == DSW_STATUS_INVALID_CELL);
  CHECK(r.offender_count == 1 && r.offenders[0] == 0);
}

static void a_face_of_three_cells_is_refused(void) {
  const double points[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 2};
  const int32_t cells[12] = {0, 1, 2, 3, 0, 2, 1, 4, 0, 1, 2, 5};
  dsw_build_report r = new_report();
  const dsw_status status = build_tets(points, 6, cells, 3, 0, &r);
  CHECK(status == DSW_STATUS_SHARED_FACE);
  CHECK(r.status == status && r.offender_count >= 2 && r.offenders[0] == 0);
}

static void an_unknown_cell_type_is_refused(void) {
  const int64_t cell[4] = {0, 1, 2, 3}, offsets[2] = {0, 4};
  uint8_t type = 11;
  dsw_environment_desc d;
  dsw_build_report r = new_report();
  dsw_environment *environment = NULL;
  dsw_environment_desc_init(&d, sizeof d);
  d.points = unit_tet;
  d.point_count = 4;
  d.cell_types = &type;
  d.volume_count = 1;
  d.offsets = offsets;
  d.connectivity = cell;
  d.connectivity_count = 4;
  CHECK_FAILS(DSW_STATUS_BAD_CELL_TYPE, dsw_environment_create(NULL, &d, &environment, &r));
  CHECK(r.offender_count == 1);
  type = DSW_CELL_TYPE_TETRA;
  d.offsets = NULL;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_create(NULL, &d, &environment, &r));
  d.offsets = offsets;
  CHECK_OK(dsw_environment_create(NULL, &d, &environment, &r));
  CHECK_OK(dsw_environment_destroy(environment));
}

/* Four entries a cell without a type: hexahedra are expected, and the message says what to set. */
static void a_missing_cell_type_is_named(void) {
  const int64_t cells[8] = {0, 1, 2, 3, 0, 1, 2, 3};
  dsw_environment_desc d;
  dsw_build_report r = new_report();
  dsw_environment *environment = NULL;
  dsw_environment_desc_init(&d, sizeof d);
  d.points = unit_tet;
  d.point_count = 4;
  d.volume_count = 2;
  d.connectivity = cells;
  d.connectivity_count = 8;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_create(NULL, &d, &environment, &r));
  CHECK(strstr(dsw_last_error_message(), "8 entries for 2 cells, 4 a cell") != NULL);
  CHECK(strstr(dsw_last_error_message(), "uniform_cell_type 12 have 8 each") != NULL);
  CHECK(strstr(dsw_last_error_message(), "set uniform_cell_type, or pass cell_types and offsets") != NULL);
  CHECK(r.offender_count == 1 && r.offenders[0] == 1);
  d.connectivity_count = 7;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_create(NULL, &d, &environment, &r));
  CHECK(strstr(dsw_last_error_message(), "7 entries for 2 cells, but") != NULL);
  d.connectivity_count = 4;
  d.volume_count = 1;
  d.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  CHECK_OK(dsw_environment_create(NULL, &d, &environment, &r));
  CHECK_OK(dsw_environment_destroy(environment));
}

/* Whatever is said of the search structure, the answers are the same; what is never built takes no memory. */
static void the_search_structure_changes_no_answer(void) {
  const uint32_t flags[] = {0, DSW_ENVIRONMENT_LOCATE_TREE, DSW_ENVIRONMENT_NO_LOCATE_TREE};
  grid g = grid_create(5, 5, 5);
  uint64_t bytes[3];
  size_t i, k;
  for (i = 0; i < 3; ++i) {
    dsw_environment_desc d = grid_desc(&g);
    dsw_environment *environment = NULL;
    dsw_environment_info info;
    d.flags = flags[i];
    CHECK_OK(dsw_environment_create(NULL, &d, &environment, NULL));
    for (k = 0; k < 125; ++k) {
      const double on_three_faces[3] = {(double)(k % 5), (double)(k / 5 % 5), (double)(k / 25)};
      const double outside[3] = {-0.5, on_three_faces[1], on_three_faces[2]};
      const dsw_volume_id none = {0, 0};
      dsw_volume_id volume = {0, 0};
      CHECK_OK(dsw_environment_locate(environment, on_three_faces, none, &volume, NULL));
      CHECK(volume.index == k && volume.generation == 1);
      CHECK_OK(dsw_environment_locate(environment, outside, none, &volume, NULL));
      CHECK(volume.generation == 0);
    }
    info.struct_size = sizeof info;
    CHECK_OK(dsw_environment_get_info(environment, &info));
    bytes[i] = info.memory_bytes;
    CHECK_OK(dsw_environment_destroy(environment));
  }
  CHECK(bytes[2] < bytes[0] && bytes[0] <= bytes[1]);
  grid_destroy(&g);
}

static void a_boundary_that_crosses_is_found_on_request(void) {
  /* Two tetrahedra that share nothing and overlap. */
  const double points[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, .1, .1, -.1, 1.1, .1, -.1, .1, 1.1, -.1, .1, .1, .9};
  const int32_t cells[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  dsw_build_report r = new_report();
  CHECK(build_tets(points, 8, cells, 2, 0, &r) == DSW_STATUS_OK && r.part_count == 2);
  r = new_report();
  CHECK(build_tets(points, 8, cells, 2, DSW_ENVIRONMENT_CHECK_BOUNDARY, &r) == DSW_STATUS_BOUNDARY_CROSSES);
  CHECK(r.status == DSW_STATUS_BOUNDARY_CROSSES && r.offender_count >= 1);
}

static void an_environment_can_be_checked_again(void) {
  dsw_environment *const environment = make_environment(NULL, 3, 2, 2);
  dsw_build_report r = new_report();
  CHECK_OK(dsw_environment_check(environment, &r));
  CHECK(r.status == DSW_STATUS_OK && r.part_count == 1 && r.convex_volume_count == 12);
  CHECK_OK(dsw_environment_check(environment, NULL));
  r.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_check(environment, &r));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_check(NULL, NULL));
  CHECK_OK(dsw_environment_destroy(environment));
}

static void an_environment_in_use_stays(void) {
  dsw_environment *const environment = make_environment(NULL, 1, 1, 1);
  dsw_scene *const scene = make_scene(environment, 0);
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_environment_destroy(environment));
  CHECK_MESSAGE("1 scenes");
  end_scene(scene);
}

static void a_wrong_handle_is_refused(void) {
  dsw_scene *const scene = make_scene(make_environment(NULL, 1, 1, 1), 0);
  grid g = grid_create(1, 1, 1);
  const dsw_environment_desc d = grid_desc(&g);
  dsw_environment *other = NULL;
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_destroy((dsw_environment *)(void *)scene));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_create((dsw_context *)(void *)scene, &d, &other, NULL));
  end_scene(scene);
  grid_destroy(&g);
}

int main(void) {
  init_writes_the_defaults();
  a_grid_is_created_and_reported();
  null_arguments_are_refused();
  sizes_are_understood();
  unknown_values_are_refused();
  sizes_of_arrays_must_agree();
  points_may_be_spaced_out();
  borrowed_points_are_read_in_place();
  every_defect_has_its_status_and_names_its_cells();
  a_face_of_three_cells_is_refused();
  an_unknown_cell_type_is_refused();
  a_missing_cell_type_is_named();
  the_search_structure_changes_no_answer();
  a_boundary_that_crosses_is_found_on_request();
  an_environment_can_be_checked_again();
  an_environment_in_use_stays();
  a_wrong_handle_is_refused();
  return check_result();
}
