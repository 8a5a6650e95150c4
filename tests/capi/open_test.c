/* surgery.h: cracks in a block of cells that open, into the air beside a tissue or into the outside, what is told of
   it, every way to be refused, and what bodies and particles say to it. What holds in space and in the plane alike runs
   in both. */
#include <math.h>

#include "block.h"
#include "check.h"

static dsw_change g_opened;

static void begin(void) { begin_block(NULL, 1, 0); }

static dsw_open_crack_desc open_faces(size_t count, double width) {
  dsw_open_crack_desc d;
  dsw_open_crack_desc_init(&d, sizeof d);
  d.faces = g_faces;
  d.face_count = count;
  d.width = width;
  d.region = 9;
  d.tag = 77;
  return d;
}

static void open_them(size_t count, double width) {
  const dsw_open_crack_desc d = open_faces(count, width);
  CHECK_OK(dsw_environment_open_crack(g_env, &d, &g_opened));
}

/* Cuts at x up to y_end and keeps the faces of the cut. */
static size_t cut_at(double x, double y_end, uint32_t flags) {
  cut(blade_at(x, y_end), flags);
  return keep_faces();
}

/* The lower half of the block becomes tissue in air. */
static void mark_lower_half(void) {
  dsw_volume_id v[32];
  uint32_t i;
  for (i = 0; i < g_block.cells / 2; ++i) v[i] = volume_at(i);
  CHECK_OK(dsw_environment_mark_volumes(g_env, v, g_block.cells / 2, DSW_MARK_IMPASSABLE, 0, NULL));
}

/* Keeps those faces of a cut that lie at marked volumes. */
static size_t cut_tissue(double x, double y_end) {
  const size_t count = cut_at(x, y_end, 0);
  size_t i, k = 0;
  for (i = 0; i < count; ++i) {
    int is_marked = 0;
    dsw_cell volume = cell_at(DSW_CELL_VOLUME, g_faces[i].front.volume, 0);
    volume.generation = g_faces[i].front.generation;
    CHECK_OK(dsw_environment_is_marked(g_env, volume, &is_marked));
    if (is_marked) g_faces[k++] = g_faces[i];
  }
  return k;
}

static dsw_volume_id beyond_face(dsw_face_id face) {
  dsw_volume_id volume, beyond = {0, 0};
  volume.index = face.volume;
  volume.generation = face.generation;
  CHECK_OK(dsw_environment_get_neighbour(g_env, volume, face.local, &beyond, NULL));
  return beyond;
}

static void a_crack_right_through(void) {
  const block_numbers b = g_block;
  const dsw_vertex_origin *v = NULL;
  const dsw_volume_change *changes = NULL;
  size_t i, count = 0;
  begin();
  CHECK(cut_at(2, 5, DSW_CUT_UNSEW) == b.layer && fly_down(0.5, 1.6, 3.5, 1.6) == 0.5);
  open_them(b.layer, 0.5);
  CHECK(g_opened.vertices_parted == b.corners && g_opened.vertices_shortened == 0 && g_opened.face_count == b.layer);
  CHECK(g_opened.smallest_width == 0.5 && g_opened.largest_width == 0.5 && g_opened.volumes_changed == 2 * b.layer);
  CHECK(fly_down(0.5, 1.6, 3.5, 1.6) == 1 && fly(2, 0.1, 2, 3.9) == 1 && fly(0.5, 0.1, 3.5, 3.9) == 1);
  v = change_of(g_env).vertices;
  count = change_of(g_env).vertex_count;
  CHECK(count == 2 * b.corners);
  for (i = 0; i < count; i += 2) {
    CHECK(fabs(x_of(v[i].vertex) - 2) == 0.25 && x_of(v[i].vertex) + x_of(v[i + 1].vertex) == 4);
    CHECK(v[i].from[0].index == v[i].from[1].index && v[i].weights[0] + v[i].weights[1] == 1);
    CHECK(v[i].from[0].index == v[i + 1].from[0].index && v[i].from[0].generation == 1);
  }
  changes = change_of(g_env).volumes;
  count = change_of(g_env).volume_count;
  CHECK(keep_faces() == b.layer && count == 3 * b.layer);
  for (i = 0; i < b.layer; ++i) {
    const dsw_volume_id gap = changes[2 * b.layer + i].after, beyond = beyond_face(g_faces[i].front);
    dsw_cell_type type = DSW_CELL_TYPE_NONE;
    uint32_t tag = 0;
    int32_t region = 0;
    CHECK(changes[2 * b.layer + i].before.generation == 0 && gap.index >= b.cells);
    CHECK(beyond.index == gap.index && beyond.generation == gap.generation);
    CHECK(beyond_face(g_faces[i].back).index == gap.index);
    CHECK_OK(dsw_environment_get_volume_counts(g_env, gap, &type, NULL, NULL, NULL));
    CHECK_OK(dsw_environment_get_tag(g_env, gap, &tag));
    CHECK_OK(dsw_environment_get_region(g_env, gap, &region));
    CHECK(type == (b.dimension == 3 ? DSW_CELL_TYPE_HEXAHEDRON : DSW_CELL_TYPE_QUAD) && tag == 77 && region == 9);
  }
  end_block(b.cells + b.layer, b.boundary + b.rim, 1);
}

/* The end of a crack that ends inside stays one. */
static void a_wedge(void) {
  const block_numbers b = g_block;
  begin();
  CHECK(cut_at(1.25, 2.5, DSW_CUT_UNSEW) == b.layer / 2);
  open_them(b.layer / 2, 0.25);
  CHECK(g_opened.vertices_parted == b.corners / 5 * 2 && g_opened.face_count == b.layer / 2);
  CHECK(g_opened.smallest_width == 0.25 && g_opened.vertices_shortened == 0);
  CHECK(fly(1.25, 0.1, 1.25, 1.9) == 1);
  end_block(b.cells + b.layer, b.boundary + b.rim, 1);
}

static void a_tissue_opens_into_the_air(void) {
  const block_numbers b = g_block;
  const dsw_volume_change *changes = NULL;
  size_t i, k = 0, count = 0;
  begin();
  mark_lower_half();
  CHECK(cut_tissue(2, 5) == b.layer / 2 && fly_down(2, 3.5, 2.0001, 0.25) < 0.5);
  open_them(b.layer / 2, 0.5);
  CHECK(g_opened.vertices_parted == b.corners / 5 * 3 && g_opened.face_count == b.layer / 2);
  CHECK(g_opened.smallest_width == 0.5);
  CHECK(fly_down(2, 3.5, 2, 0.25) == 1 && fly_down(2.2, 3.5, 1.8, 0.25) == 1);
  CHECK(fly_down(2, 1, 3, 1) < 0.26); /* the lips are walls */
  changes = change_of(g_env).volumes;
  count = change_of(g_env).volume_count;
  for (i = 0; i < count; ++i) {
    dsw_cell_type type = DSW_CELL_TYPE_NONE;
    if (changes[i].before.generation == 0) continue;
    CHECK_OK(dsw_environment_get_volume_counts(g_env, changes[i].after, &type, NULL, NULL, NULL));
    k += type == DSW_CELL_TYPE_POLYGON || type == DSW_CELL_TYPE_POLYHEDRON ? 1 : 0;
  }
  CHECK(k == b.layer / 4); /* cells of the air at which the gap ends have a face more */
  end_block(b.cells + b.layer / 2, b.boundary + b.rim / 2, 1);
}

/* From the surface of the tissue down to a tip inside. */
static void a_tissue_opens_in_part(void) {
  static const double high[2][3] = {{1.25, 1.5, 3.5}, {1.25, 2.5, 3.5}};
  static const double low[2][3] = {{1.25, 0.5, 0.25}, {1.25, 2.5, 0.25}};
  begin();
  mark_lower_half();
  if (g_block.dimension == 3) {
    CHECK(cut_tissue(1.25, 2.5) == 4);
    open_them(4, 0.25);
    CHECK(g_opened.vertices_parted == 6 && g_opened.face_count == 4 && g_opened.smallest_width == 0.25);
    CHECK(fly_between(high[0], low[0]) == 1 && fly_between(high[1], low[1]) < 0.5);
    end_block(72 + 4, 104 - 4 + 4 + 4, 1);
  } else {
    g_faces[0].front = g_faces[0].back = face_at(5, FACE_X1);
    open_them(1, 0.5);
    CHECK(g_opened.vertices_parted == 1 && g_opened.face_count == 1);
    CHECK(fly(2, 3.5, 2, 1.25) == 1);
    end_block(17, 16, 1);
  }
}

/* In space: the second half of a crack opens into the gap that the first half has left. */
static void gaps_join(void) {
  static const double from[3] = {2.1, 0.5, 2.1}, to[3] = {2.1, 3.5, 2.1};
  size_t count, i, k, missing = 0;
  uint32_t points[8][4];
  dsw_face_id faces[8];
  size_t offsets[9];
  begin();
  count = cut_at(2, 5, 0);
  for (i = k = 0; i < count; ++i) {
    if (g_faces[i].front.volume / 4 % 4 < 2) g_faces[k++] = g_faces[i];
  }
  CHECK(k == 8);
  open_them(k, 0.5);
  CHECK(g_opened.vertices_parted == 10 && g_opened.face_count == 8);
  for (i = 0; i < 8; ++i) {
    for (k = 0; k < 4; ++k) points[i][k] = (uint32_t)(2 + 5 * (2 + i % 2 + (k == 1 || k == 2) + 5 * (i / 2 + k / 2)));
    offsets[i] = 4 * i;
  }
  offsets[8] = 32;
  CHECK_OK(dsw_environment_find_faces(g_env, 8, offsets, &points[0][0], faces, &missing));
  CHECK(missing == 0);
  for (i = 0; i < 8; ++i) g_faces[i].front = g_faces[i].back = faces[i];
  open_them(8, 0.5);
  CHECK(g_opened.vertices_parted == 15 && g_opened.face_count == 8);
  CHECK(fly_between(from, to) == 1);
  end_block(80, 112, 1);
}

static void as_far_as_it_goes(void) {
  const block_numbers b = g_block;
  begin();
  open_them(cut_at(2, 5, 0), 40);
  CHECK(g_opened.vertices_parted == b.corners && g_opened.vertices_shortened == b.corners);
  CHECK(g_opened.smallest_width > 1 && g_opened.largest_width < 4);
  if (b.dimension == 3) CHECK(g_opened.smallest_width == 40 * 127.0 / 4096);
  if (b.dimension == 3) CHECK(g_opened.largest_width == g_opened.smallest_width);
  end_block(b.cells + b.layer, b.boundary + b.rim, 1);
  begin();
  open_them(cut_at(2, 5, 0), 1e300);
  CHECK(g_opened.vertices_parted == 0 && g_opened.face_count == 0 && g_opened.largest_width == 0);
  open_them(b.layer, 1e-300);
  CHECK(g_opened.vertices_parted == 0 && g_opened.face_count == 0);
  open_them(0, 1);
  end_block(b.cells, b.boundary, 1);
}

static void bad_arguments(void) {
  const uint32_t n = g_block.layer;
  dsw_open_crack_desc d, bad;
  begin();
  CHECK(cut_at(2, 5, 0) == n);
  d = open_faces(n, 0.5);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_open_crack(NULL, &d, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_open_crack(g_env, NULL, NULL));
  CHECK_REFUSES(DSW_STATUS_NULL_ARGUMENT, d, faces, NULL, dsw_environment_open_crack(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_BAD_STRUCT_SIZE, d, struct_size, 8, dsw_environment_open_crack(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, d, flags, 1, dsw_environment_open_crack(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, width, 0, dsw_environment_open_crack(g_env, &bad, NULL));
  bad.width = -1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_open_crack(g_env, &bad, NULL));
  CHECK_MESSAGE("desc->width is -1");
  bad.width = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_open_crack(g_env, &bad, NULL));
  bad.width = HUGE_VAL;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_open_crack(g_env, &bad, NULL));
  g_faces[n] = g_faces[3];
  bad = open_faces(n + 1, 0.5);
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, dsw_environment_open_crack(g_env, &bad, NULL));
  CHECK_MESSAGE(n == 16 ? "pair 16" : "pair 4");
  g_faces[n].front = g_faces[n].back = face_at(0, 6);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_open_crack(g_env, &bad, NULL));
  g_faces[n].front = face_at(0, FACE_X1), g_faces[n].back = face_at(0, g_block.y1);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_open_crack(g_env, &bad, NULL));
  g_faces[n].front = face_at(0, g_block.x0);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_open_crack(g_env, &bad, NULL));
  g_faces[n].back = face_at(0, g_block.x0);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_open_crack(g_env, &bad, NULL));
  g_faces[n].back = face_at(4, g_block.x0);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_open_crack(g_env, &bad, NULL));
  CHECK_MESSAGE("same vertices");
  dsw_open_crack_desc_init(NULL, 0);
  end_block(g_block.cells, g_block.boundary, 1);
}

static void borrowed_points(void) {
  dsw_open_crack_desc d;
  begin_block(NULL, 1, DSW_ENVIRONMENT_BORROW_POINTS);
  d = open_faces(cut_at(2, 5, 0), 0.5);
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_open_crack(g_env, &d, NULL));
  end_block(g_block.cells, g_block.boundary, 1);
}

/* They follow cuts and gaps. */
static void particles_follow(void) {
  static const double beside[3] = {2.1, 1.5, 1.5}, left[3] = {1.1, 0.5, 0.5};
  const block_numbers b = g_block;
  const dsw_cut_desc d = blade_at(3.5, 5);
  const dsw_open_crack_desc o = open_faces(0, 0.5);
  dsw_particle_id particle, other;
  dsw_volume_id volume = {0, 0};
  dsw_scene *scene, *second;
  begin();
  scene = make_scene(g_env, 0);
  CHECK_OK(dsw_particle_create(scene, beside, no_volume, &particle));
  CHECK_OK(dsw_particle_create(scene, left, no_volume, &other));
  cut_at(1.25, 5, 0);
  CHECK_OK(dsw_particle_get_position(scene, other, NULL, &volume));
  CHECK(volume.index >= b.cells); /* behind the path */
  open_them(cut_at(2, 5, DSW_CUT_UNSEW), 0.5);
  CHECK(g_opened.face_count == b.layer);
  CHECK_OK(dsw_particle_get_position(scene, particle, NULL, &volume));
  CHECK(volume.index >= b.cells); /* in the gap */
  second = make_scene(g_env, 0);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_cut(g_env, &d, NULL));
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_open_crack(g_env, &o, NULL));
  CHECK_OK(dsw_scene_destroy(second));
  CHECK_OK(dsw_scene_destroy(scene));
  end_block(b.cells + 2 * b.layer, b.boundary + 2 * b.rim, 1);
}

/* A body across the gap is not in the way. */
static void a_body_and_a_particle(void) {
  static const double in_space[6] = {0.5, 1.5, 1.5, 2.1, 1.4, 1.6}, in_plane[4] = {0.5, 1.5, 2.1, 1.4};
  static const double beside[3] = {2.1, 1.5, 1.5};
  const block_numbers b = g_block;
  dsw_particle_id particle;
  dsw_volume_id volume = {0, 0};
  dsw_scene *scene;
  begin();
  scene = make_scene(g_env, 0);
  make_edge_body(scene, b.dimension == 3 ? in_space : in_plane, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_particle_create(scene, beside, no_volume, &particle));
  open_them(cut_at(2, 5, 0), 0.5);
  CHECK(g_opened.face_count == b.layer);
  CHECK_OK(dsw_particle_get_position(scene, particle, NULL, &volume));
  CHECK(volume.index >= b.cells); /* in the gap */
  CHECK_OK(dsw_scene_destroy(scene));
  end_block(b.cells + b.layer, b.boundary + b.rim, 1);
}

static void a_particle_that_a_wall_would_pass(void) {
  static const double at[3] = {2.1, 2.5, 1.5};
  const block_numbers b = g_block;
  const dsw_particle_id *blocked = NULL;
  dsw_particle_id particle;
  dsw_open_crack_desc d;
  dsw_scene *scene;
  size_t count = 0;
  begin();
  scene = make_scene(g_env, 0);
  d = open_faces(cut_at(2, 5, 0), 0.5);
  for (; count < b.layer; ++count) {
    CHECK_OK(dsw_environment_mark_faces(g_env, &g_faces[count].front, 1, DSW_MARK_IMPASSABLE));
  }
  CHECK_OK(dsw_particle_create(scene, at, no_volume, &particle));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_open_crack(g_env, &d, &g_opened));
  CHECK_OK(dsw_scene_get_occupants(scene, &blocked, &count));
  CHECK(count == 1 && blocked[0].index == particle.index && info_of(g_env).volume_count == b.cells);
  open_them(b.layer, 0.125);
  CHECK(g_opened.face_count == b.layer);
  CHECK_OK(dsw_scene_destroy(scene));
  end_block(b.cells + b.layer, b.boundary + b.rim, 1);
}

static void running_out_of_memory(void) {
  const block_numbers b = g_block;
  host h;
  dsw_context *const context = make_context(&h);
  dsw_open_crack_desc d;
  size_t refusals = 0;
  begin_block(context, 1, 0);
  mark_lower_half();
  d = open_faces(cut_tissue(2, 5), 0.5);
  for (; RUNS_OUT(&h, refusals, dsw_environment_open_crack(g_env, &d, NULL)); ++refusals) {
    CHECK(info_of(g_env).volume_count == b.cells);
  }
  CHECK(refusals > (b.dimension == 3 ? 100u : 50u));
  end_block(b.cells + b.layer / 2, b.boundary + b.rim / 2, 1);
  end_context(context, &h);
}

/* A block is cut and opened at sizes as large and as small as doubles allow. */
static void any_size(void) {
  static const double sizes[] = {1e-200, 1e-165, 1e155, 1e200};
  const block_numbers b = g_block;
  size_t i, k;
  for (i = 0; i < 4; ++i) {
    dsw_cut_desc d = blade_at(1.5, 5);
    for (k = 0; k < 12; ++k) g_blade[k] *= sizes[i];
    d.start = no_volume;
    begin_block(NULL, sizes[i], 0);
    cut(d, DSW_CUT_UNSEW);
    CHECK(g_cut.volumes_split == b.layer && keep_faces() == b.layer);
    open_them(b.layer, 0.25 * sizes[i]);
    CHECK(g_opened.face_count == b.layer && g_opened.vertices_shortened == 0);
    CHECK(fabs(g_opened.smallest_width / sizes[i] - 0.25) < 1e-12);
    end_block(b.cells + 2 * b.layer, b.boundary + 2 * b.rim, 1);
  }
}

static void in_both(void) {
  a_crack_right_through();
  a_wedge();
  a_tissue_opens_into_the_air();
  a_tissue_opens_in_part();
  as_far_as_it_goes();
  bad_arguments();
  borrowed_points();
  particles_follow();
  a_body_and_a_particle();
  a_particle_that_a_wall_would_pass();
  running_out_of_memory();
  any_size();
}

int main(void) {
  g_opened = empty_change();
  use_block(2);
  in_both();
  use_block(3);
  in_both();
  gaps_join();
  return check_result();
}
