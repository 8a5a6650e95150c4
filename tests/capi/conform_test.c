/* Meshes whose parts lie on each other: points that are merged, faces that are split, and what the report says of both. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* Two unit cubes side by side; the second one has points of its own. */
static const double two_cubes[48] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1,
                                     1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 0, 1, 2, 0, 1, 2, 1, 1, 1, 1, 1};
static const int64_t their_cells[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

static dsw_environment_desc cubes_desc(const double *points, uint32_t flags) {
  dsw_environment_desc d;
  dsw_environment_desc_init(&d, sizeof d);
  d.points = points, d.point_count = 16;
  d.connectivity = their_cells, d.connectivity_count = 16;
  d.volume_count = 2;
  d.flags = flags;
  return d;
}

static dsw_outcome cast_through(const dsw_environment *environment) {
  const double from[3] = {0.25, 0.5, 0.5}, to[3] = {1.375, 0.375, 0.25};
  dsw_flight flight;
  CHECK_OK(dsw_environment_cast(environment, no_volume, from, to, NULL, &flight));
  return flight.outcome;
}

static void parts_that_touch_are_counted_and_named(void) {
  dsw_environment_desc d = cubes_desc(two_cubes, DSW_ENVIRONMENT_FIND_TOUCHING);
  dsw_environment *environment;
  dsw_build_report r = create_reported(&d, &environment), checked;
  CHECK(r.status == DSW_STATUS_OK && r.part_count == 2 && r.merged_point_count == 0 && r.changed_count == 0);
  CHECK(r.touching_face_count == 2);
  CHECK(r.touching_face.volume == 0 && r.touched_face.volume == 1);
  CHECK(cast_through(environment) == DSW_OUTCOME_CONTACT);
  memset(&checked, 0, sizeof checked);
  checked.struct_size = sizeof checked;
  CHECK_OK(dsw_environment_check(environment, &checked));
  CHECK(checked.touching_face_count == 2);
  CHECK(memcmp(&checked.touching_face, &r.touching_face, sizeof r.touching_face) == 0);
  CHECK(memcmp(&checked.touched_face, &r.touched_face, sizeof r.touched_face) == 0);
  CHECK_OK(dsw_environment_destroy(environment));

  d.flags = 0; /* nobody asked */
  r = create_alone(&d);
  CHECK(r.touching_face_count == 0 && r.touching_face.generation == 0 && r.touched_face.generation == 0);
}

static void equal_points_are_merged(void) {
  const dsw_environment_desc d = cubes_desc(two_cubes, DSW_ENVIRONMENT_MERGE_POINTS | DSW_ENVIRONMENT_FIND_TOUCHING);
  dsw_environment *environment;
  const dsw_build_report r = create_reported(&d, &environment);
  dsw_vertex_id vertices[8];
  size_t count;
  CHECK(r.status == DSW_STATUS_OK && r.part_count == 1 && r.merged_point_count == 4 && r.unused_point_count == 4);
  CHECK(r.touching_face_count == 0 && r.changed_count == 0);
  CHECK(cast_through(environment) == DSW_OUTCOME_REACHED);
  CHECK_OK(dsw_environment_copy_vertices(environment, cell_at(DSW_CELL_VOLUME, 1, 0), vertices, 8, &count));
  CHECK(count == 8 && vertices[0].index == 1 && vertices[3].index == 2 && vertices[4].index == 5);
  CHECK_OK(dsw_environment_destroy(environment));
}

static void a_distance_merges_clusters_and_minus_zero_is_zero(void) {
  double points[48] = {0};
  dsw_environment_desc d = cubes_desc(points, DSW_ENVIRONMENT_MERGE_POINTS);
  memcpy(points, two_cubes, sizeof points);
  points[25] = -0.0;
  CHECK(create_alone(&d).merged_point_count == 4);
  points[24] += 1e-10;
  CHECK(create_alone(&d).part_count == 2);
  d.merge_distance = 1e-9;
  CHECK(create_alone(&d).part_count == 1);
  d.merge_distance = 1e-11;
  CHECK(create_alone(&d).part_count == 2);
}

static void a_cell_that_collapses_is_told(void) {
  dsw_environment_desc d = cubes_desc(two_cubes, DSW_ENVIRONMENT_MERGE_POINTS);
  dsw_build_report r;
  d.merge_distance = 1;
  r = create_alone(&d);
  CHECK(r.status == DSW_STATUS_BAD_CELL && r.offender_count == 2 && r.offenders[0] == 0 && r.offenders[1] == 1);
  CHECK_MESSAGE("cell 0 repeats a point once points are merged");
}

static void wrong_distances_are_refused(void) {
  const dsw_environment_desc d = cubes_desc(two_cubes, DSW_ENVIRONMENT_CONFORM);
  dsw_environment_desc bad;
  dsw_environment *environment = NULL;
  CHECK_REFUSES(DSW_STATUS_NON_FINITE, d, merge_distance, NAN, dsw_environment_create(NULL, &bad, &environment, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, merge_distance, -1, dsw_environment_create(NULL, &bad, &environment, NULL));
  CHECK_MESSAGE("desc->merge_distance is -1");
  bad = d;
  bad.flags = 0;
  bad.merge_distance = 1e-9;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_create(NULL, &bad, &environment, NULL));
  CHECK_MESSAGE("needs DSW_ENVIRONMENT_MERGE_POINTS");
  CHECK(environment == NULL);
}

/* A unit cube, and four of half its width on its side x = 1. */
static void a_large_face_is_split_by_small_ones(void) {
  double points[40 * 3];
  int64_t cells[40];
  int32_t regions[5];
  unsigned n = 0, c, k;
  dsw_environment_desc d;
  dsw_environment *environment;
  dsw_build_report r;
  dsw_cell_type type;
  uint32_t vertices, faces;
  int32_t region;
  for (c = 0; c < 5; ++c) {
    const double size = c == 0 ? 1 : 0.5, y = c == 0 ? 0 : 0.5 * ((c - 1) & 1), z = c == 0 ? 0 : 0.5 * ((c - 1) >> 1);
    for (k = 0; k < 8; ++k, ++n) {
      points[3 * n] = (c == 0 ? 0 : 1) + (((k + 1) & 2) != 0 ? size : 0);
      points[3 * n + 1] = y + ((k & 2) != 0 ? size : 0);
      points[3 * n + 2] = z + (k >= 4 ? size : 0);
      cells[n] = n;
    }
    regions[c] = 10 + (int32_t)c;
  }
  dsw_environment_desc_init(&d, sizeof d);
  d.points = points, d.point_count = n;
  d.connectivity = cells, d.connectivity_count = n;
  d.volume_count = 5;
  d.regions = regions;
  d.flags = DSW_ENVIRONMENT_FIND_TOUCHING | DSW_ENVIRONMENT_MERGE_POINTS;
  CHECK(create_alone(&d).touching_face_count == 5);
  d.flags = DSW_ENVIRONMENT_FIND_TOUCHING | DSW_ENVIRONMENT_CONFORM;
  r = create_reported(&d, &environment);
  CHECK(r.status == DSW_STATUS_OK && r.part_count == 1 && r.touching_face_count == 0);
  CHECK(r.changed_count == 1 && r.changed[0] == 0 && r.changed[1] == 0);
  CHECK(r.convex_volume_count == 5);
  CHECK_OK(dsw_environment_get_volume_counts(environment, volume_at(0), &type, &vertices, NULL, &faces));
  CHECK(type == DSW_CELL_TYPE_POLYHEDRON && vertices == 13 && faces == 9);
  CHECK_OK(dsw_environment_get_volume_counts(environment, volume_at(1), &type, NULL, NULL, NULL));
  CHECK(type == DSW_CELL_TYPE_HEXAHEDRON);
  CHECK_OK(dsw_environment_get_region(environment, volume_at(3), &region));
  CHECK(region == 13);
  CHECK(cast_through(environment) == DSW_OUTCOME_REACHED);
  CHECK_OK(dsw_environment_check(environment, NULL));
  CHECK_OK(dsw_environment_destroy(environment));
}

/* The second cube is shifted along the common face by a third of its width in both directions: edges cross where there is
   no point. */
static void faces_that_cross_are_refused_with_their_cells(void) {
  double points[48] = {0};
  dsw_environment_desc d = cubes_desc(points, DSW_ENVIRONMENT_CONFORM);
  dsw_build_report r;
  unsigned i;
  memcpy(points, two_cubes, sizeof points);
  for (i = 8; i < 16; ++i) points[3 * i + 1] += 0.25, points[3 * i + 2] += 0.25;
  r = create_alone(&d);
  CHECK(r.status == DSW_STATUS_NOT_CONFORMING && r.offender_count == 2);
  CHECK(r.offenders[0] == 0 && r.offenders[1] == 1);
  CHECK_MESSAGE("faces of cells 0 and 1 overlap");
  d.flags = DSW_ENVIRONMENT_FIND_TOUCHING;
  CHECK(create_alone(&d).touching_face_count == 2);
}

/* The faces of a pyramid as a polyhedron; bits of `turned` say which are turned round. */
static dsw_build_report create_pyramid(unsigned turned, uint32_t flags) {
  static const double points[15] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 1};
  static const int faces[5][5] = {{4, 0, 3, 2, 1}, {3, 0, 1, 4, 0}, {3, 1, 2, 4, 0}, {3, 2, 3, 4, 0}, {3, 3, 0, 4, 0}};
  int64_t stream[32] = {5}, offsets[2] = {0, 0};
  const uint8_t type = DSW_CELL_TYPE_POLYHEDRON;
  int64_t n = 1;
  int f, k;
  dsw_environment_desc d;
  for (f = 0; f < 5; ++f) {
    const int size = faces[f][0];
    stream[n++] = size;
    for (k = 0; k < size; ++k) stream[n++] = faces[f][(turned >> f & 1) != 0 ? size - k : 1 + k];
  }
  offsets[1] = n;
  dsw_environment_desc_init(&d, sizeof d);
  d.points = points, d.point_count = 5;
  d.cell_types = &type, d.offsets = offsets;
  d.connectivity = stream, d.connectivity_count = (size_t)n;
  d.volume_count = 1;
  d.flags = flags;
  return create_alone(&d);
}

static void faces_that_are_turned_are_turned_back(void) {
  unsigned turned;
  for (turned = 0; turned < 32; ++turned) {
    const dsw_build_report r = create_pyramid(turned, DSW_ENVIRONMENT_REORIENT);
    unsigned count = 0, f;
    for (f = 0; f < 5; ++f) count += turned >> f & 1;
    CHECK(r.status == DSW_STATUS_OK);
    CHECK(r.reoriented_face_count == (count <= 2 ? count : 5 - count));
    CHECK(r.reoriented_count == (turned != 0));
    CHECK(create_pyramid(turned, 0).status == (turned == 0    ? DSW_STATUS_OK
                                               : turned == 31 ? DSW_STATUS_INVERTED_CELL
                                                              : DSW_STATUS_BAD_CELL));
  }
}

static void inverted_cells_are_counted_and_the_flag_is_named(void) {
  double points[48] = {0};
  dsw_environment_desc d = cubes_desc(points, 0);
  unsigned i;
  memcpy(points, two_cubes, sizeof points);
  for (i = 0; i < 16; ++i) points[3 * i] = -points[3 * i];
  CHECK(create_alone(&d).status == DSW_STATUS_INVERTED_CELL);
  CHECK_MESSAGE("2 of 2 cells are turned inside out, first cell 0; DSW_ENVIRONMENT_REORIENT turns them back");
  d.flags = DSW_ENVIRONMENT_REORIENT;
  CHECK(create_alone(&d).reoriented_count == 2);
}

int main(void) {
  parts_that_touch_are_counted_and_named();
  equal_points_are_merged();
  a_distance_merges_clusters_and_minus_zero_is_zero();
  a_cell_that_collapses_is_told();
  wrong_distances_are_refused();
  a_large_face_is_split_by_small_ones();
  faces_that_cross_are_refused_with_their_cells();
  faces_that_are_turned_are_turned_back();
  inverted_cells_are_counted_and_the_flag_is_named();
  return check_result();
}
