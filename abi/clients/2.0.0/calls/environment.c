/* Environments: creation and what is refused, cells and their neighbours, labels, marks. */
#include <string.h>

#include "calls.h"

static const double cube[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
static const int64_t corners[8] = {0, 1, 2, 3, 4, 5, 6, 7};
static const int64_t flipped[8] = {4, 5, 6, 7, 0, 1, 2, 3};

static dsw_environment_desc one_cube(void) {
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = cube;
  desc.point_count = 8;
  desc.uniform_cell_type = DSW_CELL_TYPE_HEXAHEDRON;
  desc.volume_count = 1;
  desc.connectivity = corners;
  desc.connectivity_count = 8;
  return desc;
}

static void refused(void) {
  static const int64_t beyond[8] = {0, 1, 2, 3, 4, 5, 6, 8}, twice[16] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
  static const int64_t same[8] = {0, 1, 2, 3, 4, 5, 6, 6};
  dsw_environment *environment = NULL;
  dsw_environment_desc desc = one_cube();
  double points[24];
  TRY(dsw_environment_create(NULL, NULL, &environment, NULL));
  TRY(dsw_environment_create(NULL, &desc, NULL, NULL));
  desc.connectivity = flipped;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  desc.flags = DSW_ENVIRONMENT_REORIENT;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  TRY(dsw_environment_destroy(environment));
  desc = one_cube(), desc.connectivity = beyond;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  desc.connectivity = same;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  desc.connectivity = twice, desc.volume_count = 2, desc.connectivity_count = 16;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  desc = one_cube(), desc.connectivity_count = 7;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  desc = one_cube(), desc.uniform_cell_type = 11;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  desc = one_cube(), desc.flags = 0x80000000u;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  desc = one_cube(), desc.dimension = 4;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  desc = one_cube(), desc.struct_size = 5000;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  memcpy(points, cube, sizeof points);
  points[5] = 1e300 * 1e300;
  desc = one_cube(), desc.points = points;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
}

static void made(void) {
  dsw_environment *environment = NULL;
  dsw_environment_desc desc = one_cube();
  dsw_build_report report;
  memset(&report, 0x5a, sizeof report);
  report.struct_size = sizeof report;
  TRY(dsw_environment_create(NULL, &desc, &environment, &report));
  say("  status %d, %u offenders, %u turned, %u parts, %u unused points, %u outside, %u convex", (int)report.status,
      report.offender_count, report.reoriented_count, report.part_count, report.unused_point_count,
      report.boundary_face_count, report.convex_volume_count);
  report.struct_size = sizeof report;
  TRY(dsw_environment_check(environment, &report));
  say_environment(environment);
  TRY(dsw_environment_check(NULL, NULL));
  TRY(dsw_environment_destroy(environment));
  TRY(dsw_environment_destroy(NULL));
}

static void cells(const dsw_environment *environment) {
  const dsw_volume_id first = volume_at(environment, 0), last = volume_at(environment, 7), stale = {0, 9};
  dsw_cell_type type = DSW_CELL_TYPE_NONE;
  dsw_face_id face;
  dsw_edge_id edge;
  dsw_vertex_id vertex;
  dsw_vertex_id vertices[8];
  uint32_t counts[3];
  size_t count = 0, i;
  double xyz[3];
  TRY(dsw_environment_get_volume_counts(environment, first, &type, &counts[0], &counts[1], &counts[2]));
  say("  type %d: %u vertices, %u edges, %u faces", (int)type, counts[0], counts[1], counts[2]);
  TRY(dsw_environment_get_volume_counts(environment, stale, &type, NULL, NULL, NULL));
  TRY(dsw_environment_get_volume_counts(environment, no_volume, &type, NULL, NULL, NULL));
  TRY(dsw_environment_copy_vertices(environment, volume_cell(last), vertices, 4, &count));
  TRY(dsw_environment_copy_vertices(environment, volume_cell(last), vertices, 8, &count));
  for (i = 0; i < count && i < 8; ++i) {
    TRY(dsw_environment_get_vertex_position(environment, vertices[i], xyz));
    say_numbers("  at", xyz, 3);
  }
  TRY(dsw_environment_get_face_id(environment, first, 5, &face));
  TRY(dsw_environment_get_face_id(environment, first, 6, &face));
  TRY(dsw_environment_get_edge_id(environment, first, 11, &edge));
  TRY(dsw_environment_get_edge_id(environment, first, 12, &edge));
  TRY(dsw_environment_get_vertex_id(environment, 26, &vertex));
  TRY(dsw_environment_get_vertex_id(environment, 27, &vertex));
  TRY(dsw_environment_get_volume_id(environment, 8, NULL));
  TRY(dsw_environment_get_centre(environment, last, xyz));
  say_numbers("  centre", xyz, 3);
}

static void neighbours(const dsw_environment *environment) {
  const dsw_volume_id first = volume_at(environment, 0), second = volume_at(environment, 1);
  const dsw_face_id face = face_between(environment, first, second);
  dsw_volume_id sides[2], other;
  uint32_t local;
  int impassable = 9;
  TRY(dsw_environment_get_face_volumes(environment, face, &sides[0], &sides[1]));
  say("  from %u to %u", sides[0].index, sides[1].index);
  for (local = 0; local < 6; ++local) {
    TRY(dsw_environment_get_neighbour(environment, first, local, &other, &impassable));
    say("  %u: volume %u, %s, impassable %d", local, other.index, other.generation == 0 ? "null" : "there", impassable);
  }
  TRY(dsw_environment_get_neighbour(environment, first, 6, &other, &impassable));
}

static void find(const dsw_environment *environment) {
  static const size_t offsets[3] = {0, 4, 8};
  static const uint32_t wanted[8] = {1, 4, 13, 10, 0, 1, 2, 3}, ends[4] = {0, 1, 0, 26}, bad[2] = {0, 27};
  dsw_face_id faces[2];
  dsw_edge_id edges[2];
  size_t missing = 9;
  TRY(dsw_environment_find_faces(environment, 2, offsets, wanted, faces, &missing));
  say("  %u missing, the first %s, the second %s", (unsigned)missing, faces[0].generation != 0 ? "found" : "null",
      faces[1].generation != 0 ? "found" : "null");
  TRY(dsw_environment_find_edges(environment, 2, ends, edges, &missing));
  say("  %u missing, the first %s, the second %s", (unsigned)missing, edges[0].generation != 0 ? "found" : "null",
      edges[1].generation != 0 ? "found" : "null");
  TRY(dsw_environment_find_edges(environment, 1, bad, edges, &missing));
  TRY(dsw_environment_find_faces(environment, 2, offsets, NULL, faces, &missing));
}

static void labels(dsw_environment *environment) {
  const dsw_volume_id second = volume_at(environment, 1);
  int32_t region = -1;
  uint32_t tag = 0;
  TRY(dsw_environment_get_region(environment, second, &region));
  TRY(dsw_environment_get_tag(environment, second, &tag));
  say("  region %d, tag %u", (int)region, tag);
  TRY(dsw_environment_set_tag(environment, second, 7));
  TRY(dsw_environment_get_tag(environment, second, &tag));
  say("  tag %u", tag);
  TRY(dsw_environment_get_tag(environment, no_volume, &tag));
  TRY(dsw_environment_set_tag(NULL, second, 7));
}

static void say_marks(const dsw_environment *environment, dsw_cell cell) {
  int marked = 9, impassable = 9;
  size_t counts[5] = {0, 9, 9, 9, 9};
  int kind;
  TRY(dsw_environment_is_marked(environment, cell, &marked));
  TRY(dsw_environment_is_impassable(environment, cell, &impassable));
  for (kind = DSW_CELL_VERTEX; kind <= DSW_CELL_VOLUME; ++kind) {
    TRY(dsw_environment_get_mark_count(environment, (dsw_cell_kind)kind, &counts[kind]));
  }
  say("  marked %d, impassable %d; %u vertices, %u edges, %u faces, %u volumes", marked, impassable, (unsigned)counts[1],
      (unsigned)counts[2], (unsigned)counts[3], (unsigned)counts[4]);
}

static void marks(dsw_environment *environment) {
  const dsw_volume_id first = volume_at(environment, 0), second = volume_at(environment, 1);
  const dsw_face_id face = face_between(environment, first, second);
  const dsw_vertex_id vertex = vertex_at(environment, 13);
  const dsw_cell corner = {DSW_CELL_VERTEX, vertex.index, vertex.generation, 0};
  dsw_edge_id edge;
  dsw_cell edge_cell = {DSW_CELL_EDGE, 0, 0, 0};
  size_t skipped = 9, marked = 9;
  TRY(dsw_environment_get_edge_id(environment, first, 0, &edge));
  edge_cell.index = edge.volume, edge_cell.generation = edge.generation, edge_cell.local = edge.local;
  TRY(dsw_environment_mark_volumes(environment, &second, 1, DSW_MARK_IMPASSABLE, 0, &skipped));
  say("  skipped %u", (unsigned)skipped);
  say_marks(environment, face_cell(face));
  TRY(dsw_environment_mark_volumes(environment, &second, 1, DSW_MARK_PASSABLE, 0, &skipped));
  TRY(dsw_environment_mark_faces(environment, &face, 1, DSW_MARK_IMPASSABLE));
  say_marks(environment, face_cell(face));
  TRY(dsw_environment_mark_edges(environment, &edge, 1, DSW_MARK_IMPASSABLE));
  say_marks(environment, edge_cell);
  TRY(dsw_environment_mark_vertices(environment, &vertex, 1, DSW_MARK_IMPASSABLE));
  say_marks(environment, corner);
  TRY(dsw_environment_mark_region(environment, 1, DSW_MARK_IMPASSABLE, 0, &marked, &skipped));
  say("  marked %u, skipped %u", (unsigned)marked, (unsigned)skipped);
  TRY(dsw_environment_mark_region(environment, 1, DSW_MARK_PASSABLE, 0, &marked, NULL));
  TRY(dsw_environment_mark_between(environment, 0, 1, DSW_MARK_IMPASSABLE, &marked));
  say("  marked %u", (unsigned)marked);
  TRY(dsw_environment_mark_between(environment, 0, 1, DSW_MARK_PASSABLE, NULL));
  TRY(dsw_environment_mark_edges(environment, &edge, 1, DSW_MARK_PASSABLE));
  TRY(dsw_environment_mark_vertices(environment, &vertex, 1, DSW_MARK_PASSABLE));
  say_marks(environment, face_cell(face));
  TRY(dsw_environment_mark_volumes(environment, &no_volume, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  TRY(dsw_environment_mark_volumes(environment, &second, 1, (dsw_mark)7, 0, NULL));
  TRY(dsw_environment_mark_volumes(environment, &second, 1, DSW_MARK_IMPASSABLE, 0x80, NULL));
}

void call_environment(void) {
  dsw_environment *environment;
  say("* environments");
  refused();
  made();
  environment = make_block(NULL, 2, 2, 2, 0);
  say_environment(environment);
  cells(environment);
  neighbours(environment);
  find(environment);
  labels(environment);
  marks(environment);
  TRY(dsw_environment_destroy(environment));
}
