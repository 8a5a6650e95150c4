#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* Two unit squares side by side, the right one cut into two triangles, and a pentagon on top of both:
 *
 *        6
 *      /   \
 *     3--4--5
 *     |  |\ |
 *     |0 | \|     the diagonal runs from 4 to 2
 *     0--1--2
 */
static const double g_points[7][2] = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {1, 3}};
static const int64_t g_cells[] = {0, 1, 4, 3, 1, 2, 4, 2, 5, 4, 3, 4, 5, 6};
static const int64_t g_offsets[] = {0, 4, 7, 10, 14};
static const uint8_t g_types[] = {DSW_CELL_TYPE_QUAD, DSW_CELL_TYPE_TRIANGLE, DSW_CELL_TYPE_TRIANGLE,
                                  DSW_CELL_TYPE_POLYGON};
static const int32_t g_regions[] = {1, 2, 2, 3};
static const uint32_t g_tags[] = {10, 11, 12, 13};

static dsw_environment_desc plane_desc(void) {
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.dimension = 2;
  desc.points = g_points[0];
  desc.point_count = 7;
  desc.cell_types = g_types;
  desc.volume_count = 4;
  desc.offsets = g_offsets;
  desc.connectivity = g_cells;
  desc.connectivity_count = 14;
  desc.regions = g_regions;
  desc.tags = g_tags;
  desc.flags = DSW_ENVIRONMENT_CHECK_BOUNDARY;
  return desc;
}

static dsw_environment *make_plane(void) {
  const dsw_environment_desc desc = plane_desc();
  dsw_environment *environment = NULL;
  CHECK_OK(dsw_environment_create(NULL, &desc, &environment, NULL));
  if (environment == NULL) exit(1);
  return environment;
}

static int is_volume(dsw_volume_id id, uint32_t index) { return id.index == index && id.generation == 1; }

static void environments_are_created_and_described(void) {
  dsw_environment_desc desc = plane_desc();
  dsw_environment *environment = NULL;
  dsw_environment_info info;
  dsw_build_report report = {0};
  dsw_cell_type type;
  uint32_t vertices, edges, faces;
  dsw_vertex_id corners[8];
  dsw_volume_id near_side, far_side;
  dsw_face_id face;
  double xy[3] = {7, 7, 7};
  size_t count;
  int flag;
  report.struct_size = sizeof report;
  CHECK_OK(dsw_environment_create(NULL, &desc, &environment, &report));
  CHECK(report.boundary_face_count == 6 && report.part_count == 1 && report.convex_volume_count == 4);
  info = info_of(environment);
  CHECK(info.dimension == 2 && info.vertex_count == 7 && info.volume_count == 4 && info.face_count == 10);
  CHECK(info.lower[0] == 0 && info.upper[0] == 2 && info.upper[1] == 3 && info.upper[2] == 0);
  CHECK_OK(dsw_environment_check(environment, NULL));
  CHECK_OK(dsw_environment_get_volume_counts(environment, volume_at(3), &type, &vertices, &edges, &faces));
  CHECK(type == DSW_CELL_TYPE_POLYGON && vertices == 4 && edges == 0 && faces == 4);
  CHECK_OK(dsw_environment_get_volume_counts(environment, volume_at(0), &type, NULL, NULL, NULL));
  CHECK(type == DSW_CELL_TYPE_QUAD);
  CHECK_OK(dsw_environment_get_volume_counts(environment, volume_at(1), &type, NULL, NULL, NULL));
  CHECK(type == DSW_CELL_TYPE_TRIANGLE);
  CHECK_OK(dsw_environment_get_vertex_position(environment, vertex_at(6), xy));
  CHECK(xy[0] == 1 && xy[1] == 3 && xy[2] == 7);
  CHECK_OK(dsw_environment_get_centre(environment, volume_at(0), xy));
  CHECK(xy[0] == 0.5 && xy[1] == 0.5 && xy[2] == 7);
  /* Side 2 of cell 1 is side 1 of cell 0 seen from the other side. */
  CHECK_OK(dsw_environment_get_face_id(environment, volume_at(1), 2, &face));
  CHECK(face.volume == 0 && face.local == 1);
  CHECK_OK(dsw_environment_copy_vertices(environment, cell_at(DSW_CELL_FACE, 1, 2), corners, 8, &count));
  CHECK(count == 2 && corners[0].index == 4 && corners[1].index == 1);
  CHECK_OK(dsw_environment_copy_vertices(environment, cell_at(DSW_CELL_VOLUME, 3, 0), corners, 8, &count));
  CHECK(count == 4 && corners[3].index == 6);
  CHECK_OK(dsw_environment_get_face_volumes(environment, face, &near_side, &far_side));
  CHECK(is_volume(near_side, 0) && is_volume(far_side, 1));
  CHECK_OK(dsw_environment_get_neighbour(environment, volume_at(0), 0, &far_side, &flag));
  CHECK(far_side.generation == 0 && flag == 1);
  CHECK_OK(dsw_environment_destroy(environment));
}

static void faces_are_found_by_their_vertices(void) {
  dsw_environment *const environment = make_plane();
  const size_t offsets[] = {0, 2, 4};
  const uint32_t indices[] = {2, 4, 0, 4};
  dsw_face_id faces[2];
  dsw_edge_id edge;
  size_t missing;
  CHECK_OK(dsw_environment_find_faces(environment, 2, offsets, indices, faces, &missing));
  CHECK(missing == 1 && faces[0].volume == 1 && faces[0].local == 1 && faces[1].generation == 0);
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_find_edges(environment, 1, indices, &edge, NULL));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_get_edge_id(environment, volume_at(0), 0, &edge));
  CHECK_OK(dsw_environment_destroy(environment));
}

static void descriptions_are_checked(void) {
  dsw_environment *environment = NULL;
  dsw_environment_desc desc = plane_desc();
  int64_t cells[14];
  double points[7][2];
  dsw_build_report report = {0};
  report.struct_size = sizeof report;
  desc.point_stride_bytes = 8;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_create(NULL, &desc, &environment, NULL));
  desc = plane_desc();
  desc.point_stride_bytes = 24;
  desc.flags = DSW_ENVIRONMENT_BORROW_POINTS;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_create(NULL, &desc, &environment, NULL));
  CHECK_MESSAGE("0 or 16");
  desc = plane_desc();
  desc.dimension = 4;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_create(NULL, &desc, &environment, NULL));
  desc = plane_desc();
  desc.cell_types = NULL;
  desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  CHECK_FAILS(DSW_STATUS_BAD_CELL_TYPE, dsw_environment_create(NULL, &desc, &environment, NULL));
  CHECK_MESSAGE("5 or 9");
  desc = plane_desc();
  desc.dimension = 3;
  desc.points = NULL;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_create(NULL, &desc, &environment, NULL));
  /* A cell that turns clockwise is mirrored on request. */
  memcpy(cells, g_cells, sizeof cells);
  cells[4] = 2;
  cells[5] = 1;
  desc = plane_desc();
  desc.connectivity = cells;
  CHECK_FAILS(DSW_STATUS_INVERTED_CELL, dsw_environment_create(NULL, &desc, &environment, &report));
  CHECK(report.offender_count == 1 && report.offenders[0] == 1);
  desc.flags |= DSW_ENVIRONMENT_REORIENT;
  CHECK_OK(dsw_environment_create(NULL, &desc, &environment, &report));
  CHECK(report.reoriented_count == 1 && report.part_count == 1);
  CHECK_OK(dsw_environment_destroy(environment));
  /* The tip of the polygon comes down to its base. */
  memcpy(points, g_points, sizeof points);
  points[6][0] = 5;
  points[6][1] = 1;
  desc = plane_desc();
  desc.points = points[0];
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_create(NULL, &desc, &environment, &report));
  CHECK(report.offender_count == 1 && report.offenders[0] == 3);
  points[0][1] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_create(NULL, &desc, &environment, NULL));
}

static void boundaries_that_cross_are_found(void) {
  /* Cells without a common side: the second triangle lies over the first, or touches it in a point of a side. */
  static const double over[6][2] = {{0, 0}, {4, 0}, {0, 4}, {1, 1}, {9, 9}, {0, 9}};
  static const double touching[6][2] = {{0, 0}, {4, 0}, {0, 4}, {2, 2}, {9, 9}, {0, 9}};
  static const double within[6][2] = {{0, 0}, {9, 0}, {0, 9}, {1, 1}, {2, 1}, {1, 2}};
  static const int64_t two[] = {0, 1, 2, 3, 4, 5};
  dsw_environment *environment = NULL;
  dsw_environment_desc desc = polygons_desc(over[0], 6, DSW_CELL_TYPE_TRIANGLE, two, 2);
  desc.flags = DSW_ENVIRONMENT_CHECK_BOUNDARY;
  CHECK_FAILS(DSW_STATUS_BOUNDARY_CROSSES, dsw_environment_create(NULL, &desc, &environment, NULL));
  desc.points = within[0];
  CHECK_FAILS(DSW_STATUS_BOUNDARY_CROSSES, dsw_environment_create(NULL, &desc, &environment, NULL));
  desc.points = touching[0];
  CHECK_OK(dsw_environment_create(NULL, &desc, &environment, NULL));
  CHECK_OK(dsw_environment_check(environment, NULL));
  CHECK_OK(dsw_environment_destroy(environment));
}

static void points_are_located_and_classified(void) {
  dsw_environment *const environment = make_plane();
  const double points[4][3] = {{0.5, 0.5, 9}, {1.9, 0.5, 9}, {1, 2, 9}, {5, 5, 9}};
  const double corner[2] = {1, 1}, on_side[2] = {1, 0.25}, bad[2] = {0, INFINITY};
  dsw_volume_id volumes[4], volume;
  dsw_location locations[4];
  dsw_cell cell;
  CHECK_OK(dsw_environment_locate_points(environment, points[0], 4, 24, NULL, volumes, locations));
  CHECK(is_volume(volumes[0], 0) && is_volume(volumes[1], 2) && is_volume(volumes[2], 3) && volumes[3].generation == 0);
  CHECK(locations[0] == DSW_LOCATION_PASSABLE && locations[3] == DSW_LOCATION_OUTSIDE);
  CHECK_OK(dsw_environment_locate(environment, points[1], volume_at(0), &volume, NULL));
  CHECK(is_volume(volume, 2));
  CHECK_OK(dsw_environment_classify(environment, corner, volume_at(3), &cell));
  CHECK(cell.kind == DSW_CELL_VERTEX && cell.index == 4);
  CHECK_OK(dsw_environment_classify(environment, on_side, volume_at(1), &cell));
  CHECK(cell.kind == DSW_CELL_FACE && cell.index == 0 && cell.local == 1);
  CHECK_OK(dsw_environment_classify(environment, points[2], volume_at(3), &cell));
  CHECK(cell.kind == DSW_CELL_VOLUME && cell.index == 3);
  CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_environment_classify(environment, points[2], volume_at(0), &cell));
  CHECK_MESSAGE("(1, 2)");
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_locate(environment, bad, no_volume, &volume, NULL));
  CHECK_OK(dsw_environment_destroy(environment));
}

static void segments_are_cast(void) {
  dsw_environment *const environment = make_plane();
  const double from[2][2] = {{0.25, 0.5}, {1, 2}}, to[2][2] = {{3.25, 0.5}, {0.25, 0.25}};
  dsw_flight flights[2], one;
  dsw_crossing crossings[8];
  size_t count;
  CHECK_OK(dsw_environment_cast_segments(environment, 2, NULL, from[0], to[0], 0, NULL, flights));
  CHECK(flights[0].outcome == DSW_OUTCOME_CONTACT && flights[0].contact.kind == DSW_CONTACT_PLANE);
  CHECK(flights[0].contact.marked_kind == DSW_CELL_FACE && flights[0].volumes_visited == 3 &&
        flights[0].contact.tag == 12);
  CHECK(flights[0].contact.wall.volume == 2 && flights[0].contact.wall.local == 0 &&
        flights[0].contact.behind.generation == 0);
  CHECK(fabs(flights[0].time - 1.75 / 3) < 1e-15 && fabs(flights[0].position[0] - 2) < 1e-12);
  CHECK(flights[0].contact.normal[0] == -1 && flights[0].contact.normal[1] == 0 && flights[0].contact.normal[2] == 0);
  CHECK(flights[1].outcome == DSW_OUTCOME_REACHED && flights[1].position[1] == 0.25 && is_volume(flights[1].volume, 0));
  CHECK_OK(dsw_environment_cast(environment, volume_at(0), from[0], to[0], NULL, &one));
  CHECK(memcmp(&one, &flights[0], sizeof one) == 0);
  CHECK_OK(dsw_environment_cast_path(environment, no_volume, from[0], to[0], NULL, crossings, 8, &count, NULL));
  CHECK(count == 3 && is_volume(crossings[1].volume, 1) && crossings[1].face.volume == 0 && crossings[1].time == 0.25);
  CHECK_OK(dsw_environment_destroy(environment));
}

static void the_nearest_wall_is_found(void) {
  dsw_environment *const environment = make_plane();
  const double point[2] = {0.25, 0.5};
  const dsw_face_id wall = face_at(0, 1);
  dsw_nearest nearest;
  CHECK_OK(dsw_environment_find_nearest(environment, point, no_volume, 10, &nearest));
  CHECK(nearest.distance == 0.25 && nearest.point[0] == 0 && nearest.point[2] == 0 && nearest.normal[0] == 1);
  CHECK(nearest.cell.kind == DSW_CELL_FACE && nearest.cell.index == 0 && nearest.cell.local == 3 && nearest.tag == 10);
  CHECK_OK(dsw_environment_find_nearest(environment, point, no_volume, 0.1, &nearest));
  CHECK(nearest.cell.kind == DSW_CELL_NONE);
  {
    const double beside[2] = {0.9, 0.5};
    CHECK_OK(dsw_environment_mark_faces(environment, &wall, 1, DSW_MARK_IMPASSABLE));
    CHECK_OK(dsw_environment_find_nearest(environment, beside, no_volume, 10, &nearest));
    CHECK(nearest.cell.index == 0 && nearest.cell.local == 1 && nearest.normal[0] == -1 && nearest.tag == 11);
  }
  {
    const double from[4] = {0.25, 0.5, 0.5, 0.25}, to[4] = {0.625, 0.5, 1.5, 0.25};
    dsw_segment_nearest n[2];
    CHECK_OK(dsw_environment_find_nearest_to_segments(environment, 2, NULL, from, to, 0, 10, n, NULL, NULL));
    CHECK(n[0].nearest.distance == 0.25 && n[0].nearest.cell.local == 3 && n[0].nearest.point[0] == 0);
    CHECK(n[0].nearest.normal[0] == 1 && n[0].segment_parameter == 0 && n[0].segment_point[2] == 0);
    CHECK(n[1].nearest.distance == 0 && n[1].nearest.cell.local == 1 && n[1].segment_parameter == 0.5);
    CHECK(n[1].segment_point[0] == 1 && n[1].segment_point[1] == 0.25 && n[1].nearest.tag == 11);
    CHECK_OK(dsw_environment_find_nearest_to_points(environment, from, 1, 0, NULL, 10, &nearest, NULL, NULL));
    CHECK(nearest.distance == 0.25 && nearest.cell.local == 3);
  }
  CHECK_OK(dsw_environment_destroy(environment));
}

static void cells_are_marked(void) {
  dsw_environment *const environment = make_plane();
  const dsw_face_id face = face_at(1, 2);
  const dsw_volume_id volume = volume_at(3);
  const dsw_vertex_id vertex = vertex_at(4);
  const dsw_edge_id edge = edge_at(0, 0);
  int flag;
  size_t count;
  CHECK_OK(dsw_environment_mark_faces(environment, &face, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_is_marked(environment, cell_at(DSW_CELL_FACE, 0, 1), &flag));
  CHECK(flag == 1);
  CHECK_OK(dsw_environment_mark_volumes(environment, &volume, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_is_impassable(environment, cell_at(DSW_CELL_FACE, 0, 2), &flag));
  CHECK(flag == 1);
  CHECK_OK(dsw_environment_mark_vertices(environment, &vertex, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_is_impassable(environment, cell_at(DSW_CELL_VERTEX, 4, 0), &flag));
  CHECK(flag == 1);
  CHECK_OK(dsw_environment_mark_between(environment, 2, 1, DSW_MARK_IMPASSABLE, &count));
  CHECK(count == 1);
  CHECK_OK(dsw_environment_mark_region(environment, 2, DSW_MARK_IMPASSABLE, 0, &count, NULL));
  CHECK(count == 2);
  CHECK_OK(dsw_environment_get_mark_count(environment, DSW_CELL_VOLUME, &count));
  CHECK(count == 3);
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_mark_edges(environment, &edge, 1, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_is_marked(environment, cell_at(DSW_CELL_EDGE, 0, 0), &flag));
  CHECK_MESSAGE("must be a vertex, face or volume");
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_get_mark_count(environment, DSW_CELL_EDGE, &count));
  CHECK_OK(dsw_environment_destroy(environment));
}

static void particles_move(void) {
  dsw_environment *const environment = make_plane();
  dsw_scene *const scene =
      make_scene(environment, DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS | DSW_FEATURE_LIVE_CHANGES);
  const double positions[2][2] = {{0.5, 0.5}, {0.5, 1.5}}, targets[2][2] = {{1.5, 0.75}, {0.5, -7}},
               outside[2] = {5, 5};
  const dsw_particle_id *occupants;
  const dsw_crossing *crossings;
  const size_t *first;
  const dsw_volume_id wanted = volume_at(1);
  dsw_particle_id ids[2], id;
  dsw_flight flights[2];
  dsw_statistics statistics = {0};
  dsw_volume_id volumes[2];
  double found[2][3] = {{0}};
  size_t count, offender = 9;
  statistics.struct_size = sizeof statistics;
  CHECK_OK(dsw_scene_create_particles(scene, positions[0], 2, 0, NULL, ids, NULL));
  CHECK_FAILS(DSW_STATUS_OUTSIDE, dsw_scene_create_particles(scene, outside, 1, 0, NULL, &id, &offender));
  CHECK(offender == 0);
  CHECK_OK(dsw_scene_move_particles(scene, ids, 2, targets[0], 0, NULL, flights));
  CHECK(flights[0].outcome == DSW_OUTCOME_REACHED && is_volume(flights[0].volume, 2));
  CHECK(flights[1].outcome == DSW_OUTCOME_CONTACT && flights[1].contact.normal[1] == 1 && flights[1].position[2] == 0);
  CHECK(flights[1].position[0] == 0.5 && flights[1].position[1] > 0 && flights[1].position[1] < 1e-12);
  CHECK_OK(dsw_scene_get_crossings(scene, &crossings, &first, &count));
  CHECK(count == 2 && first[2] - first[1] == 2 && is_volume(crossings[first[1]].volume, 3));
  CHECK_OK(dsw_scene_get_particle_positions(scene, ids, 2, found[0], 24, volumes));
  CHECK(found[0][0] == 1.5 && found[0][1] == 0.75 && found[0][2] == 0 && found[1][1] == flights[1].position[1]);
  CHECK(is_volume(volumes[0], 2) && is_volume(volumes[1], flights[1].volume.index));
  CHECK_OK(dsw_scene_cast_from_particles(scene, ids, 1, outside, 0, NULL, flights));
  CHECK(flights[0].outcome == DSW_OUTCOME_CONTACT);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_mark_volumes(environment, volumes, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_scene_get_occupants(scene, &occupants, &count));
  CHECK(count == 1 && occupants[0].index == ids[0].index);
  CHECK_OK(dsw_environment_mark_volumes(environment, volumes, 1, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, &count));
  CHECK(count == 1);
  CHECK_OK(dsw_environment_mark_volumes(environment, &wanted, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_particle_move(scene, ids[0], positions[0], NULL, flights));
  CHECK(flights[0].outcome == DSW_OUTCOME_CONTACT && flights[0].contact.marked_kind == DSW_CELL_VOLUME &&
        flights[0].contact.tag == 11);
  CHECK_OK(dsw_scene_get_statistics(scene, &statistics));
  CHECK(statistics.contacts == 3 && statistics.orientation_tests > 0);
  CHECK_OK(dsw_particle_destroy(scene, ids[0]));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_move(scene, ids[0], positions[0], NULL, NULL));
  end_scene(scene);
}

static void recordings_are_made_again(void) {
  static const double rope[3][2] = {{0.25, 0.25}, {0.5, 0.5}, {0.75, 0.25}};
  static const double pulled[3][2] = {{0.5, 0.25}, {2.5, 0.5}, {0.75, -3}};
  const double start[2] = {0.5, 0.75}, target[2] = {1.5, 9};
  const dsw_face_id side = face_at(0, 2);
  dsw_environment *const environment = make_plane();
  dsw_scene *const scene = make_scene(environment, DSW_FEATURE_STATISTICS);
  static tape one;
  dsw_recording_desc recording = to_tape(&one);
  dsw_body_desc body;
  dsw_body_id id;
  dsw_particle_id particle;
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  dsw_validation validation = {0};
  char text[200];
  size_t size, calls = 0;
  validation.struct_size = sizeof validation;
  recording.flags = DSW_RECORDING_STATES;
  CHECK_OK(dsw_scene_start_recording(scene, &recording));
  CHECK_OK(dsw_environment_mark_faces(environment, &side, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_particle_create(scene, start, no_volume, &particle));
  CHECK_OK(dsw_particle_move(scene, particle, target, NULL, NULL));
  body = line_desc(rope[0], 3, 0, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_body_create(scene, &body, &id));
  CHECK_OK(dsw_body_move(scene, id, pulled[0], 3, 0, NULL, NULL));
  CHECK_OK(dsw_scene_stop_recording(scene));
  CHECK_OK(dsw_replay_create(NULL, one.bytes, one.size, &replay));
  for (;; ++calls) {
    CHECK_OK(dsw_replay_describe_next(replay, text, sizeof text, &size));
    if (calls == 2) CHECK(strncmp(text, "particle 0.1 target [ 1.5 9 ]", 29) == 0);
    CHECK_OK(dsw_replay_step_validated(replay, &report, &validation));
    CHECK(validation.is_right && strcmp(validation.text, "") == 0);
    if (report.outcome != DSW_REPLAY_SAME) break;
  }
  CHECK(report.outcome == DSW_REPLAY_END && calls == 5);
  CHECK(validation.places == 4 && validation.edges == 2);
  CHECK_OK(dsw_replay_destroy(replay));
  end_scene(scene);
}

int main(void) {
  environments_are_created_and_described();
  faces_are_found_by_their_vertices();
  descriptions_are_checked();
  boundaries_that_cross_are_found();
  points_are_located_and_classified();
  segments_are_cast();
  the_nearest_wall_is_found();
  cells_are_marked();
  particles_move();
  recordings_are_made_again();
  return check_result();
}
