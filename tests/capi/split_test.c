/* Cells that are split: their parts and parents, what neighbours become, snapshots, changes, and what can't be split. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static uint32_t volume_count(const dsw_environment *environment) {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  CHECK_OK(dsw_environment_get_info(environment, &info));
  return info.volume_count;
}

static uint32_t parent_of(const dsw_environment *environment, uint32_t index) {
  uint32_t parent = 12345;
  dsw_volume_id volume;
  CHECK_OK(dsw_environment_get_volume_id(environment, index, &volume));
  CHECK_OK(dsw_environment_get_parent(environment, volume, &parent));
  return parent;
}

/* The quads of a grid of 2 by 2, above each other hexahedra; the middle is at (q, q) of 0 .. 4, so that the first cell is an
   arrow head. */
static double grid_points[18 * 3], plane_points[9 * 2];
static const int64_t grid_quads[16] = {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 7};
static int64_t grid_cells[32];
static const uint32_t grid_tags[4] = {5, 6, 7, 8};

static dsw_environment_desc grid_of(uint32_t dimension, double q, uint32_t flags) {
  dsw_environment_desc d;
  unsigned i, k;
  for (i = 0; i < 9; ++i) {
    const double x = i == 4 ? q : 2 * (i % 3), y = i == 4 ? q : 2 * (i / 3);
    plane_points[2 * i] = x, plane_points[2 * i + 1] = y;
    for (k = 0; k < 2; ++k) {
      double *const p = grid_points + 3 * (i + 9 * k);
      p[0] = x, p[1] = y, p[2] = k;
    }
  }
  for (i = 0; i < 32; ++i) grid_cells[i] = grid_quads[i / 8 * 4 + i % 4] + (i % 8 < 4 ? 0 : 9);
  dsw_environment_desc_init(&d, sizeof d);
  d.dimension = dimension;
  d.points = dimension == 2 ? plane_points : grid_points;
  d.point_count = dimension == 2 ? 9 : 18;
  d.connectivity = dimension == 2 ? grid_quads : grid_cells;
  d.connectivity_count = dimension == 2 ? 16 : 32;
  d.uniform_cell_type = dimension == 2 ? DSW_CELL_TYPE_QUAD : DSW_CELL_TYPE_HEXAHEDRON;
  d.volume_count = 4;
  d.tags = grid_tags;
  d.flags = flags;
  return d;
}

static void without_the_flag_a_cell_is_refused_and_the_flag_is_named(void) {
  uint32_t dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    const dsw_environment_desc d = grid_of(dimension, 0.5, 0);
    const dsw_build_report r = create_alone(&d);
    CHECK(r.status == DSW_STATUS_INVALID_CELL && r.offender_count == 1 && r.offenders[0] == 0);
    CHECK_MESSAGE("DSW_ENVIRONMENT_SPLIT");
  }
}

static void a_cell_is_split_and_its_parts_know_it(void) {
  uint32_t dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    const dsw_environment_desc d = grid_of(dimension, 0.5, DSW_ENVIRONMENT_SPLIT);
    dsw_environment *environment;
    const dsw_build_report r = create_reported(&d, &environment);
    const double from[3] = {0.0625, 1.5, 0.5}, to[3] = {3.5, 0.25, 0.25};
    dsw_flight flight;
    dsw_environment_info info;
    uint32_t i, parts = 0;
    CHECK(r.status == DSW_STATUS_OK && r.split_count == 1 && r.added_point_count == 0 && r.part_count == 1);
    info.struct_size = sizeof info;
    CHECK_OK(dsw_environment_get_info(environment, &info));
    CHECK(info.volume_count > 4 && info.vertex_count == d.point_count);
    for (i = 0; i < info.volume_count; ++i) {
      const uint32_t parent = parent_of(environment, i);
      uint32_t tag;
      CHECK(i < 4 ? parent == i : parent == 0);
      parts += parent == 0 ? 1 : 0;
      CHECK_OK(dsw_environment_get_tag(environment, volume_at(i), &tag));
      CHECK(tag == grid_tags[parent]);
    }
    CHECK(parts == info.volume_count - 3);
    CHECK_OK(dsw_environment_check(environment, NULL));
    CHECK_OK(dsw_environment_cast(environment, no_volume, from, to, NULL, &flight));
    CHECK(flight.outcome == DSW_OUTCOME_REACHED && parent_of(environment, flight.volume.index) == 1);
    CHECK_OK(dsw_environment_destroy(environment));
  }
}

static void what_is_valid_stays_as_it_was(void) {
  uint32_t dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    dsw_environment_desc d = grid_of(dimension, 1.75, 0);
    dsw_environment *plain, *split;
    dsw_build_report r = create_reported(&d, &plain);
    size_t sizes[2] = {0, 0};
    void *blocks[2];
    uint32_t i;
    CHECK(r.status == DSW_STATUS_OK);
    d.flags = DSW_ENVIRONMENT_SPLIT;
    r = create_reported(&d, &split);
    CHECK(r.status == DSW_STATUS_OK && r.split_count == 0);
    CHECK_OK(dsw_environment_save(plain, NULL, 0, &sizes[0]));
    CHECK_OK(dsw_environment_save(split, NULL, 0, &sizes[1]));
    CHECK(sizes[0] == sizes[1]);
    blocks[0] = malloc(sizes[0]), blocks[1] = malloc(sizes[1]);
    CHECK_OK(dsw_environment_save(plain, blocks[0], sizes[0], &sizes[0]));
    CHECK_OK(dsw_environment_save(split, blocks[1], sizes[1], &sizes[1]));
    CHECK(memcmp(blocks[0], blocks[1], sizes[0]) == 0);
    for (i = 0; i < 4; ++i) CHECK(parent_of(plain, i) == i && parent_of(split, i) == i);
    free(blocks[0]), free(blocks[1]);
    CHECK_OK(dsw_environment_destroy(plain));
    CHECK_OK(dsw_environment_destroy(split));
  }
}

static void parents_are_kept_in_snapshots(void) {
  uint32_t dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    const dsw_environment_desc d = grid_of(dimension, 0.5, DSW_ENVIRONMENT_SPLIT);
    dsw_environment *environment, *loaded = NULL;
    size_t size = 0, again = 0;
    unsigned char *block, *copy;
    uint32_t i;
    create_reported(&d, &environment);
    CHECK_OK(dsw_environment_save(environment, NULL, 0, &size));
    block = malloc(size), copy = malloc(size);
    CHECK_OK(dsw_environment_save(environment, block, size, &size));
    CHECK_OK(dsw_environment_load(NULL, block, size, &loaded));
    CHECK(volume_count(loaded) == volume_count(environment));
    for (i = 0; i < volume_count(loaded); ++i) CHECK(parent_of(loaded, i) == parent_of(environment, i));
    CHECK_OK(dsw_environment_save(loaded, copy, size, &again));
    CHECK(again == size && memcmp(block, copy, size) == 0);
    free(block), free(copy);
    CHECK_OK(dsw_environment_destroy(loaded));
    CHECK_OK(dsw_environment_destroy(environment));
  }
}

static void wrong_ids_are_refused(void) {
  const dsw_environment_desc d = grid_of(3, 0.5, DSW_ENVIRONMENT_SPLIT);
  dsw_environment *environment;
  uint32_t parent = 77;
  create_reported(&d, &environment);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_parent(environment, stale_volume, &parent));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_parent(environment, volume_at(0), NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_parent(NULL, volume_at(0), &parent));
  CHECK(parent == 77);
  CHECK_OK(dsw_environment_destroy(environment));
}

/* Hexahedra with repeated corners: a wedge, a pyramid, a tetrahedron; one that is flat. */
static void repeated_corners_are_what_is_left(void) {
  static const double points[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  static const int64_t cells[4][8] = {
      {0, 1, 2, 2, 4, 5, 6, 6}, {0, 1, 2, 3, 4, 4, 4, 4}, {0, 1, 2, 2, 4, 4, 4, 4}, {0, 1, 2, 3, 0, 1, 2, 3}};
  static const uint32_t faces[3] = {5, 5, 4}, vertices[3] = {6, 5, 4};
  dsw_environment_desc d;
  unsigned i;
  dsw_environment_desc_init(&d, sizeof d);
  d.points = points, d.point_count = 8;
  d.connectivity_count = 8, d.volume_count = 1;
  for (i = 0; i < 4; ++i) {
    dsw_environment *environment;
    dsw_build_report r;
    uint32_t vertex_count, face_count;
    d.connectivity = cells[i];
    d.flags = 0;
    CHECK(create_alone(&d).status == DSW_STATUS_BAD_CELL);
    d.flags = DSW_ENVIRONMENT_SPLIT;
    r = create_reported(&d, &environment);
    if (i == 3) {
      CHECK(r.status == DSW_STATUS_BAD_CELL && environment == NULL);
      CHECK_MESSAGE("cell 0 has nothing left");
      continue;
    }
    CHECK(r.status == DSW_STATUS_OK && r.split_count == 0 && r.convex_volume_count == 1);
    CHECK_OK(dsw_environment_get_volume_counts(environment, volume_at(0), NULL, &vertex_count, NULL, &face_count));
    CHECK(vertex_count == vertices[i] && face_count == faces[i]);
    CHECK_OK(dsw_environment_destroy(environment));
  }
}

/* Polygons: a bow tie meets itself; a turned arrow head is inside out unless it is turned back; a repeated corner. */
static void what_cannot_be_split_is_told(void) {
  static const double points[10] = {0, 0, 4, 0, 4, 4, 1, 0.5, 0, 4};
  static const int64_t bow[4] = {0, 2, 1, 4}, turned[4] = {0, 3, 2, 1}, repeated[4] = {0, 1, 1, 2};
  dsw_environment_desc d;
  dsw_build_report r;
  dsw_environment_desc_init(&d, sizeof d);
  d.dimension = 2;
  d.uniform_cell_type = DSW_CELL_TYPE_QUAD;
  d.points = points, d.point_count = 5;
  d.connectivity_count = 4, d.volume_count = 1;
  d.flags = DSW_ENVIRONMENT_SPLIT;
  d.connectivity = repeated;
  CHECK(create_alone(&d).status == DSW_STATUS_OK);
  d.connectivity = bow;
  r = create_alone(&d);
  CHECK(r.status == DSW_STATUS_INVALID_CELL && r.offender_count == 1 && r.offenders[0] == 0);
  CHECK_MESSAGE("cell 0 can't be split: its boundary touches itself or passes through itself");
  d.connectivity = turned;
  CHECK(create_alone(&d).status == DSW_STATUS_INVERTED_CELL);
  CHECK_MESSAGE("DSW_ENVIRONMENT_REORIENT");
  d.flags |= DSW_ENVIRONMENT_REORIENT;
  r = create_alone(&d);
  CHECK(r.status == DSW_STATUS_OK && r.reoriented_count == 1 && r.split_count == 1);
}

/* Polygons that lose corners take less room than they were given for: what follows them must be found. */
static void polygons_lose_corners(void) {
  static const double points[18] = {0, 0, 1, 0, 2, 0, 3, 0, 3, 1, 0, 1, 0, 2, 3, 2, 1, 0};
  static const int64_t cells[15] = {0, 1, 8, 1, 2, 2, 3, 3, 4, 4, 5, 5, 4, 7, 6};
  static const int64_t offsets[3] = {0, 11, 15};
  static const uint8_t types[2] = {DSW_CELL_TYPE_POLYGON, DSW_CELL_TYPE_QUAD};
  dsw_environment_desc d;
  dsw_environment *environment;
  dsw_build_report r;
  dsw_environment_desc_init(&d, sizeof d);
  d.dimension = 2;
  d.points = points, d.point_count = 9;
  d.cell_types = types, d.offsets = offsets;
  d.connectivity = cells, d.connectivity_count = 15, d.volume_count = 2;
  d.flags = DSW_ENVIRONMENT_SPLIT | DSW_ENVIRONMENT_MERGE_POINTS;
  r = create_reported(&d, &environment);
  CHECK(r.status == DSW_STATUS_OK && r.part_count == 1 && r.merged_point_count == 1);
  CHECK_OK(dsw_environment_check(environment, NULL));
  CHECK_OK(dsw_environment_destroy(environment));
}

/* What changes make of a volume keeps its parent; a volume that is added has none. */
static void changes_keep_parents(void) {
  const dsw_environment_desc d = grid_of(3, 0.5, DSW_ENVIRONMENT_SPLIT);
  static const double apart[12] = {9, 0, 0, 10, 0, 0, 9, 1, 0, 9, 0, 1};
  static const int64_t tetrahedron[4] = {0, 1, 2, 3};
  dsw_environment *environment, *loaded = NULL;
  dsw_volumes_desc more;
  dsw_volume_id added, removed = volume_at(2), back;
  dsw_edge_id edge, halves[2];
  dsw_vertex_id middle;
  unsigned char block[20000];
  size_t size;
  uint32_t parent = 77, i, count;
  create_reported(&d, &environment);
  count = volume_count(environment);
  CHECK_OK(dsw_environment_get_edge_id(environment, volume_at(0), 0, &edge));
  CHECK_OK(dsw_environment_split_edge(environment, edge, 0.5, &middle, halves));
  for (i = 0; i < count; ++i) CHECK(parent_of(environment, i) == (i < 4 ? i : 0));
  CHECK_OK(dsw_environment_remove_volumes(environment, &removed, 1));
  dsw_volumes_desc_init(&more, sizeof more);
  more.points = apart, more.point_count = 4;
  more.connectivity = tetrahedron, more.connectivity_count = 4;
  more.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  more.volume_count = 1;
  CHECK_OK(dsw_environment_add_volumes(environment, &more, &added, NULL));
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_environment_get_parent(environment, added, &parent));
  CHECK_MESSAGE("was added later");
  CHECK(parent == 77);
  CHECK_OK(dsw_environment_save(environment, block, sizeof block, &size));
  CHECK_OK(dsw_environment_load(NULL, block, size, &loaded));
  CHECK_FAILS(DSW_STATUS_NOT_FOUND, dsw_environment_get_parent(loaded, added, &parent));
  CHECK_OK(dsw_environment_get_volume_id(loaded, 3, &back));
  CHECK(parent_of(loaded, 3) == 3);
  CHECK_OK(dsw_environment_destroy(loaded));
  CHECK_OK(dsw_environment_destroy(environment));
}

/* The corner that made an arrow head goes back, and parts bend with it, under way of a recording that does the same again. */
static void parts_bend_and_are_recorded(void) {
  static tape one;
  dsw_environment_desc d = grid_of(3, 0.5, DSW_ENVIRONMENT_SPLIT);
  dsw_environment *environment;
  dsw_recording_desc to = to_tape(&one);
  const double start[3] = {3, 1, 0.5}, target[3] = {0.25, 1.5, 0.75};
  double next[18 * 3];
  dsw_scene *scene;
  dsw_particle_id particle;
  dsw_deform_report deformed;
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  unsigned i, calls = 0;
  create_reported(&d, &environment);
  scene = make_scene(environment, DSW_FEATURE_DEFORMING);
  to.flags = DSW_RECORDING_STATES;
  CHECK_OK(dsw_scene_start_recording(scene, &to));
  CHECK_OK(dsw_particle_create(scene, start, no_volume, &particle));
  memcpy(next, grid_points, sizeof next);
  for (i = 4; i < 18; i += 9) next[3 * i] = next[3 * i + 1] = 0.75;
  CHECK_OK(dsw_environment_deform(environment, next, 18, NULL, &deformed));
  CHECK(deformed.outcome == DSW_DEFORM_DONE && deformed.invalid_count == 0);
  CHECK_OK(dsw_particle_move(scene, particle, target, NULL, NULL));
  CHECK_OK(dsw_scene_stop_recording(scene));
  CHECK_OK(dsw_replay_create(NULL, one.bytes, one.size, &replay));
  for (;;) {
    CHECK_OK(dsw_replay_step(replay, &report));
    if (report.outcome == DSW_REPLAY_END) break;
    CHECK(report.outcome == DSW_REPLAY_SAME);
    if (++calls > 10) break;
  }
  CHECK(calls == 3);
  CHECK_OK(dsw_replay_destroy(replay));
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_environment_destroy(environment));
}

int main(void) {
  without_the_flag_a_cell_is_refused_and_the_flag_is_named();
  a_cell_is_split_and_its_parts_know_it();
  what_is_valid_stays_as_it_was();
  parents_are_kept_in_snapshots();
  wrong_ids_are_refused();
  repeated_corners_are_what_is_left();
  polygons_lose_corners();
  what_cannot_be_split_is_told();
  changes_keep_parents();
  parts_bend_and_are_recorded();
  return check_result();
}
