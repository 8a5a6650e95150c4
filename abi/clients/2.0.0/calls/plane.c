/* The plane: what serves it answers as in space. Functions for space alone are not called: a later version may serve the plane, too. */
#include <string.h>

#include "calls.h"

static dsw_environment *env; /* 3 x 2 squares of side 1 */

static dsw_environment *make_squares(void) {
  static double points[24];
  static int64_t cells[24];
  static int32_t regions[6];
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  int i;
  for (i = 0; i < 12; ++i) points[2 * i] = i % 4, points[2 * i + 1] = i / 4;
  for (i = 0; i < 6; ++i) {
    const int64_t p = i % 3 + 4 * (i / 3);
    cells[4 * i] = p, cells[4 * i + 1] = p + 1, cells[4 * i + 2] = p + 5, cells[4 * i + 3] = p + 4;
    regions[i] = i % 3;
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.dimension = 2;
  desc.points = points, desc.point_count = 12;
  desc.volume_count = 6, desc.connectivity = cells, desc.connectivity_count = 24;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  desc.uniform_cell_type = DSW_CELL_TYPE_QUAD, desc.regions = regions;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  return environment;
}

static void queries(void) {
  static const double inside[2] = {0.5, 0.5}, away[2] = {9, 0.75}, other[2] = {2.5, 1.25};
  dsw_cell_type type = DSW_CELL_TYPE_NONE;
  uint32_t counts[3] = {9, 9, 9};
  dsw_location location = DSW_LOCATION_NONE;
  dsw_crossing crossings[8];
  dsw_volume_id volume;
  dsw_nearest nearest;
  dsw_flight flight;
  dsw_cell cell;
  size_t count = 99;
  double centre[2];
  say_environment(env);
  TRY(dsw_environment_get_volume_counts(env, volume_at(env, 0), &type, &counts[0], &counts[1], &counts[2]));
  say("  type %d: %u vertices, %u edges, %u faces", (int)type, counts[0], counts[1], counts[2]);
  TRY(dsw_environment_get_centre(env, volume_at(env, 5), centre));
  say_numbers("  centre", centre, 2);
  TRY(dsw_environment_locate(env, inside, no_volume, &volume, &location));
  say("  volume %u, location %d", volume.index, (int)location);
  TRY(dsw_environment_classify(env, inside, volume, &cell));
  say("  kind %d", (int)cell.kind);
  TRY(dsw_environment_cast(env, no_volume, inside, away, NULL, &flight));
  say_flight("  away", &flight);
  TRY(dsw_environment_cast_path(env, no_volume, inside, other, NULL, crossings, 8, &count, &flight));
  say("  enters %u volumes", (unsigned)count);
  TRY(dsw_environment_find_nearest(env, inside, no_volume, 1, &nearest));
  say_numbers("  distance", &nearest.distance, 1);
  say("  kind %d", (int)nearest.cell.kind);
}

static void marks(void) {
  const dsw_volume_id second = volume_at(env, 1);
  const dsw_vertex_id vertex = vertex_at(env, 5);
  const dsw_cell corner = {DSW_CELL_VERTEX, vertex.index, vertex.generation, 0};
  int impassable = 9;
  size_t marked = 99;
  TRY(dsw_environment_mark_volumes(env, &second, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  TRY(dsw_environment_is_impassable(env, corner, &impassable));
  say("  impassable %d", impassable);
  TRY(dsw_environment_mark_volumes(env, &second, 1, DSW_MARK_PASSABLE, 0, NULL));
  TRY(dsw_environment_mark_vertices(env, &vertex, 1, DSW_MARK_IMPASSABLE));
  TRY(dsw_environment_is_marked(env, corner, &impassable));
  say("  marked %d", impassable);
  TRY(dsw_environment_mark_vertices(env, &vertex, 1, DSW_MARK_PASSABLE));
  TRY(dsw_environment_mark_between(env, 1, 2, DSW_MARK_IMPASSABLE, &marked));
  say("  marked %u", (unsigned)marked);
  TRY(dsw_environment_mark_between(env, 1, 2, DSW_MARK_PASSABLE, NULL));
}

/* The square (1, 1) is impassable; an edge from (0.25, 0.5) whose other end rises meets its corner (2, 1). */
static void moves(void) {
  static const double from[4] = {0.25, 0.5, 2.75, 0.5}, to[4] = {0.25, 0.5, 2.75, 1.75};
  const dsw_volume_id solid = volume_at(env, 4);
  dsw_scene *const scene = make_scene(env, 0);
  const dsw_body_contact *contacts = NULL;
  dsw_move_options options;
  dsw_move_report report;
  double positions[8];
  size_t count = 99;
  dsw_sweep sweep;
  int response;
  TRY(dsw_environment_mark_volumes(env, &solid, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  TRY(dsw_environment_sweep_edges(env, 1, NULL, from + 2, to + 2, from, 0, NULL, &sweep));
  say_numbers("  time", &sweep.time, 1);
  say_numbers("  point", sweep.point, 2);
  say_contact(&sweep.contact);
  for (response = DSW_RESPONSE_STOP; response <= DSW_RESPONSE_ADAPTIVE_MANY; ++response) {
    const dsw_body_id body = make_wire(scene, from, DSW_LEVEL_EDGES_SWEPT, 0);
    dsw_move_options_init(&options, sizeof options);
    options.edge_response = (dsw_response)response;
    TRY(dsw_body_move(scene, body, to, 2, 0, &options, &report));
    say("  response %d: stopped %u, contacts %u, edits %u", response, report.vertices_stopped, report.contact_count,
        report.edit_count);
    TRY(dsw_body_get_contacts(scene, body, &contacts, &count));
    say_numbers("  time", &contacts[0].time, 1);
    say_contact(&contacts[0].contact);
    TRY(dsw_body_get_positions(scene, body, positions, 4, 0, NULL, &count));
    say_numbers("  positions", positions, 2 * (count < 4 ? count : 4));
    TRY(dsw_body_destroy(scene, body));
  }
  TRY(dsw_scene_destroy(scene));
  TRY(dsw_environment_mark_volumes(env, &solid, 1, DSW_MARK_PASSABLE, 0, NULL));
}

static void bending(void) {
  static const double wire[4] = {0.25, 1.5, 2.75, 1.5};
  static double next[24];
  dsw_scene *const scene = make_scene(env, DSW_FEATURE_DEFORMING);
  const double *points = NULL;
  dsw_deform_report report;
  size_t count = 99;
  int i;
  make_wire(scene, wire, DSW_LEVEL_EDGES_SWEPT, 0);
  TRY(dsw_environment_get_points(env, &points, &count));
  say("  %u points", (unsigned)count);
  memcpy(next, points, sizeof next);
  for (i = 4; i < 8; ++i) next[2 * i + 1] += 0.25;
  TRY(dsw_environment_deform(env, next, 12, NULL, &report));
  say("  outcome %d", (int)report.outcome);
  say_numbers("  fraction", &report.fraction, 1);
  TRY(dsw_scene_destroy(scene));
}

static void changes(void) {
  static const double blade[4] = {1.25, -1, 1.25, 3};
  dsw_volume_id merged, parts[2];
  dsw_vertex_id ends[2];
  dsw_change change;
  dsw_cut_desc desc;
  const dsw_face_id side = face_between(env, volume_at(env, 0), volume_at(env, 3));
  size_t count = 99;
  TRY(dsw_environment_copy_vertices(env, face_cell(side), ends, 2, &count));
  TRY(dsw_environment_merge_volumes(env, side, &merged));
  TRY(dsw_environment_split_volume(env, merged, ends, 2, parts, NULL));
  memset(&change, 0, sizeof change);
  change.struct_size = sizeof change;
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = blade, desc.rows = 2, desc.columns = 1;
  TRY(dsw_environment_cut(env, &desc, &change));
  say("  crossed %u, split %u, vertices %u, faces %u", change.volumes_crossed, change.volumes_split,
      (unsigned)change.vertex_count, (unsigned)change.face_count);
  say_environment(env);
}

void call_plane(void) {
  static void (*const parts[])(void) = {queries, marks, moves, bending, changes};
  size_t i;
  say("* the plane");
  for (i = 0; i < sizeof parts / sizeof *parts; ++i) {
    env = make_squares();
    parts[i]();
    TRY(dsw_environment_destroy(env));
  }
}
