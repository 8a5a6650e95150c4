/* surgery.h: cracks in a grid of cubes that open, what is told of it, every way to be refused, and what bodies say to it. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 4 x 4 cubes */
static dsw_cut_face g_faces[64];
static dsw_open_report g_report;

static void begin(dsw_context *context) { g_env = make_environment(context, 4, 4, 4); }

static dsw_environment_info info(void) {
  dsw_environment_info i;
  i.struct_size = sizeof i;
  CHECK_OK(dsw_environment_get_info(g_env, &i));
  return i;
}

static void end(uint32_t volumes, uint32_t boundary, uint32_t parts) {
  const dsw_environment_info i = info();
  CHECK(i.volume_count == volumes && i.boundary_face_count == boundary && i.part_count == parts);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  CHECK_OK(dsw_environment_destroy(g_env));
}

static dsw_open_desc open_faces(size_t count, double width) {
  dsw_open_desc d;
  dsw_open_desc_init(&d, sizeof d);
  d.faces = g_faces;
  d.face_count = count;
  d.width = width;
  d.region = 9;
  d.tag = 77;
  return d;
}

/* Cuts in the plane x = at from y = -1 to y_end; the faces of the cut, but for those at passable volumes if `marked`. */
static size_t cut(double x, double y_end, uint32_t flags, int marked) {
  static double blade[12];
  const dsw_cut_face *faces = NULL;
  dsw_cut_desc d;
  size_t i, k = 0, count = 0;
  for (i = 0; i < 4; ++i) {
    blade[3 * i] = x;
    blade[3 * i + 1] = i % 2 == 0 ? -1 : y_end;
    blade[3 * i + 2] = i < 2 ? -1 : 5;
  }
  dsw_cut_desc_init(&d, sizeof d);
  d.points = blade;
  d.rows = d.columns = 2;
  d.flags = flags;
  CHECK_OK(dsw_environment_cut(g_env, &d, NULL));
  CHECK_OK(dsw_environment_get_cut_faces(g_env, &faces, &count));
  for (i = 0; i < count; ++i) {
    int is_marked = 0;
    dsw_cell volume = cell_at(DSW_CELL_VOLUME, faces[i].front.volume, 0);
    volume.generation = faces[i].front.generation;
    if (marked) CHECK_OK(dsw_environment_is_marked(g_env, volume, &is_marked));
    if (marked == is_marked) g_faces[k++] = faces[i];
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

/* How far a flight gets. */
static double fly(double x, double y, double z, double to_x, double to_y, double to_z) {
  double from[3], to[3];
  dsw_flight flight;
  from[0] = x, from[1] = y, from[2] = z;
  to[0] = to_x, to[1] = to_y, to[2] = to_z;
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, to, NULL, &flight));
  return flight.time;
}

/* The lower half of the block becomes tissue in air. */
static void mark_lower_half(void) {
  dsw_volume_id v[32];
  uint32_t i;
  for (i = 0; i < 32; ++i) v[i] = volume_at(i);
  CHECK_OK(dsw_environment_mark_volumes(g_env, v, 32, DSW_MARK_IMPASSABLE, 0, NULL));
}

static void a_crack_right_through(void) {
  const dsw_cut_vertex *vertices = NULL;
  const dsw_cut_face *lips = NULL;
  const dsw_volume_change *changes = NULL;
  const double *points = NULL;
  dsw_open_desc d;
  size_t i, count = 0, lip_count = 0;
  begin(NULL);
  d = open_faces(cut(2, 5, DSW_CUT_UNSEW, 0), 0.5);
  CHECK(d.face_count == 16 && fly(0.5, 1.4, 1.6, 3.5, 1.4, 1.6) == 0.5);
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK(g_report.vertices_parted == 25 && g_report.vertices_shortened == 0 && g_report.faces_opened == 16);
  CHECK(g_report.smallest_width == 0.5 && g_report.largest_width == 0.5 && g_report.volumes_changed == 32);
  CHECK(fly(0.5, 1.4, 1.6, 3.5, 1.4, 1.6) == 1);
  CHECK_OK(dsw_environment_get_cut_vertices(g_env, &vertices, &count));
  CHECK(count == 50);
  CHECK_OK(dsw_environment_get_points(g_env, &points, &i));
  for (i = 0; i < count; i += 2) {
    const double x[2] = {points[3 * vertices[i].vertex.index], points[3 * vertices[i + 1].vertex.index]};
    CHECK(fabs(x[0] - 2) == 0.25 && x[0] + x[1] == 4);
    CHECK(vertices[i].from[0].index == vertices[i].from[1].index &&
          vertices[i].weights[0] + vertices[i].weights[1] == 1);
    CHECK(vertices[i].from[0].index == vertices[i + 1].from[0].index && vertices[i].from[0].generation == 1);
  }
  CHECK_OK(dsw_environment_get_cut_faces(g_env, &lips, &lip_count));
  CHECK_OK(dsw_environment_get_volume_changes(g_env, &changes, &count));
  CHECK(lip_count == 16 && count == 48);
  for (i = 0; i < lip_count; ++i) {
    const dsw_volume_id gap = changes[32 + i].after;
    dsw_volume_id beyond;
    dsw_cell_type type = DSW_CELL_TYPE_NONE;
    uint32_t tag = 0;
    int32_t region = 0;
    CHECK(changes[32 + i].before.generation == 0 && gap.index >= 64);
    beyond = beyond_face(lips[i].front);
    CHECK(beyond.index == gap.index && beyond.generation == gap.generation);
    CHECK(beyond_face(lips[i].back).index == gap.index);
    CHECK_OK(dsw_environment_get_volume_counts(g_env, gap, &type, NULL, NULL, NULL));
    CHECK_OK(dsw_environment_get_tag(g_env, gap, &tag));
    CHECK_OK(dsw_environment_get_region(g_env, gap, &region));
    CHECK(type == DSW_CELL_TYPE_HEXAHEDRON && tag == 77 && region == 9);
  }
  end(80, 112, 1);
}

static void a_cut_that_ends_inside(void) {
  dsw_open_desc d;
  begin(NULL);
  d = open_faces(cut(1.25, 2.5, DSW_CUT_UNSEW, 0), 0.25);
  CHECK(d.face_count == 8);
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK(g_report.vertices_parted == 10 && g_report.faces_opened == 8); /* those of the end stay one */
  CHECK(g_report.smallest_width == 0.25 && g_report.vertices_shortened == 0);
  CHECK(fly(1.25, 0.1, 1.4, 1.25, 1.9, 1.4) == 1);
  end(80, 112, 1);
}

static void a_tissue_opens_into_the_air(void) {
  dsw_open_desc d;
  begin(NULL);
  mark_lower_half();
  d = open_faces(cut(2, 5, 0, 1), 0.5);
  CHECK(d.face_count == 8 && fly(2, 1.4, 3.5, 2, 1.6, 0.25) < 0.5);
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK(g_report.vertices_parted == 15 && g_report.faces_opened == 8 && g_report.smallest_width == 0.5);
  CHECK(fly(2, 1.4, 3.5, 2, 1.6, 0.25) == 1 && fly(2.2, 1.4, 3.5, 1.8, 1.6, 0.25) == 1);
  CHECK(fly(2, 1.4, 1, 3, 1.4, 1) < 0.26); /* the lips are walls */
  end(72, 104, 1);
  begin(NULL);
  mark_lower_half();
  d = open_faces(cut(1.25, 2.5, 0, 1), 0.25);
  CHECK(d.face_count == 4);
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK(g_report.vertices_parted == 6 && g_report.faces_opened == 4 && g_report.smallest_width == 0.25);
  CHECK(fly(1.25, 1.5, 3.5, 1.25, 0.5, 0.25) == 1);
  CHECK(fly(1.25, 2.5, 3.5, 1.25, 2.5, 0.25) < 0.5);
  end(72 + 4, 104 - 4 + 4 + 4, 1);
}

/* The second half of a crack opens into the gap that the first half has left. */
static void gaps_join(void) {
  dsw_open_desc d;
  size_t count, i, k, missing = 0;
  uint32_t points[8][4];
  dsw_face_id faces[8];
  size_t offsets[9];
  begin(NULL);
  count = cut(2, 5, 0, 0);
  for (i = k = 0; i < count; ++i) {
    if (g_faces[i].front.volume / 4 % 4 < 2) g_faces[k++] = g_faces[i];
  }
  d = open_faces(k, 0.5);
  CHECK(k == 8);
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK(g_report.vertices_parted == 10 && g_report.faces_opened == 8);
  for (i = 0; i < 8; ++i) {
    for (k = 0; k < 4; ++k) points[i][k] = (uint32_t)(2 + 5 * (2 + i % 2 + (k == 1 || k == 2) + 5 * (i / 2 + k / 2)));
    offsets[i] = 4 * i;
  }
  offsets[8] = 32;
  CHECK_OK(dsw_environment_find_faces(g_env, 8, offsets, &points[0][0], faces, &missing));
  CHECK(missing == 0);
  for (i = 0; i < 8; ++i) g_faces[i].front = g_faces[i].back = faces[i];
  d = open_faces(8, 0.5);
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK(g_report.vertices_parted == 15 && g_report.faces_opened == 8);
  CHECK(fly(2.1, 0.5, 2.1, 2.1, 3.5, 2.1) == 1);
  end(80, 112, 1);
}

static void as_far_as_it_goes(void) {
  dsw_open_desc d;
  begin(NULL);
  d = open_faces(cut(2, 5, 0, 0), 40);
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK(g_report.vertices_parted == 25 && g_report.vertices_shortened == 25);
  CHECK(g_report.smallest_width == 40 * 127.0 / 4096 && g_report.largest_width == g_report.smallest_width);
  end(80, 112, 1);
  begin(NULL);
  d = open_faces(cut(2, 5, 0, 0), 1e300);
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK(g_report.vertices_parted == 0 && g_report.faces_opened == 0 && g_report.largest_width == 0);
  d.width = 1e-300;
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK(g_report.vertices_parted == 0 && g_report.faces_opened == 0);
  d.face_count = 0;
  CHECK_OK(dsw_environment_open(g_env, &d, NULL));
  end(64, 96, 1);
}

static void bad_arguments(void) {
  dsw_open_desc d, bad;
  begin(NULL);
  d = open_faces(cut(2, 5, 0, 0), 0.5);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_open(NULL, &d, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_open(g_env, NULL, NULL));
  bad = d, bad.faces = NULL;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_open(g_env, &bad, NULL));
  bad = d, bad.struct_size = 8;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE, dsw_environment_open(g_env, &bad, NULL));
  bad = d, bad.flags = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_open(g_env, &bad, NULL));
  bad = d, bad.width = 0;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_open(g_env, &bad, NULL));
  bad.width = -1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_open(g_env, &bad, NULL));
  CHECK_MESSAGE("desc->width is -1");
  bad.width = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_open(g_env, &bad, NULL));
  bad.width = HUGE_VAL;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_open(g_env, &bad, NULL));
  g_faces[16] = g_faces[3];
  bad = open_faces(17, 0.5);
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, dsw_environment_open(g_env, &bad, NULL));
  CHECK_MESSAGE("pair 16");
  g_faces[16].front = g_faces[16].back = face_at(0, 6);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_open(g_env, &bad, NULL));
  g_faces[16].front = face_at(0, FACE_X1), g_faces[16].back = face_at(0, FACE_Y1);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_open(g_env, &bad, NULL));
  g_faces[16].front = face_at(0, FACE_X0);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_open(g_env, &bad, NULL));
  g_faces[16].back = face_at(0, FACE_X0);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_open(g_env, &bad, NULL));
  g_faces[16].back = face_at(4, FACE_X0);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_open(g_env, &bad, NULL));
  CHECK_MESSAGE("same vertices");
  dsw_open_desc_init(NULL, 0);
  end(64, 96, 1);
}

static void borrowed_points(void) {
  grid g = grid_create(4, 4, 4);
  dsw_environment_desc e = grid_desc(&g);
  dsw_open_desc d;
  e.flags = DSW_ENVIRONMENT_BORROW_POINTS;
  CHECK_OK(dsw_environment_create(NULL, &e, &g_env, NULL));
  d = open_faces(cut(2, 5, 0, 0), 0.5);
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_open(g_env, &d, NULL));
  end(64, 96, 1);
  grid_destroy(&g);
}

static void bodies_and_particles(void) {
  static const double across[6] = {0.5, 1.5, 1.5, 2.1, 1.4, 1.6}, beside[3] = {2.1, 1.5, 1.5},
                      in_wall[3] = {2.1, 2.5, 1.5};
  const dsw_particle_id *blocked = NULL;
  dsw_particle_id particle;
  dsw_volume_id volume = {0, 0};
  dsw_open_desc d;
  dsw_scene *scene, *second;
  dsw_face_id face;
  size_t count = 0;
  begin(NULL);
  scene = make_scene(g_env, 0);
  make_edge_body(scene, across, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_particle_create(scene, beside, no_volume, &particle));
  d = open_faces(cut(2, 5, 0, 0), 0.5);
  face = g_faces[0].front;
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK(g_report.faces_opened == 16);
  CHECK_OK(dsw_particle_get(scene, particle, NULL, &volume));
  CHECK(volume.index >= 64); /* in the gap */
  second = make_scene(g_env, 0);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_open(g_env, &d, &g_report));
  CHECK_OK(dsw_scene_destroy(second));
  CHECK_OK(dsw_scene_destroy(scene));
  end(80, 112, 1);

  begin(NULL);
  scene = make_scene(g_env, 0);
  d = open_faces(cut(2, 5, 0, 0), 0.5);
  for (count = 0; count < 16; ++count) {
    face = g_faces[count].front;
    CHECK_OK(dsw_environment_mark_faces(g_env, &face, 1, DSW_MARK_IMPASSABLE));
  }
  CHECK_OK(dsw_particle_create(scene, in_wall, no_volume, &particle));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_open(g_env, &d, &g_report)); /* a wall would pass it */
  CHECK_OK(dsw_scene_get_occupants(scene, &blocked, &count));
  CHECK(count == 1 && blocked[0].index == particle.index && info().volume_count == 64);
  d.width = 0.125;
  CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
  CHECK_OK(dsw_scene_destroy(scene));
  end(80, 112, 1);
}

static void running_out_of_memory(void) {
  host h;
  dsw_context *context;
  dsw_open_desc d;
  dsw_status status = DSW_STATUS_OUT_OF_MEMORY;
  size_t n, refusals = 0;
  memset(&h, 0, sizeof h);
  context = make_context(&h);
  begin(context);
  mark_lower_half();
  d = open_faces(cut(2, 5, 0, 1), 0.5);
  for (n = 1; status == DSW_STATUS_OUT_OF_MEMORY && n < 40000; ++n) {
    h.refuse = h.calls + n;
    status = dsw_environment_open(g_env, &d, NULL);
    h.refuse = 0;
    if (status != DSW_STATUS_OUT_OF_MEMORY) break;
    ++refusals;
    CHECK(info().volume_count == 64);
  }
  CHECK(status == DSW_STATUS_OK && refusals > 100);
  end(72, 104, 1);
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && h.broken == 0);
}

/* As large and as small as doubles allow. */
static void any_size(void) {
  static const double sizes[] = {1e-200, 1e-165, 1e155, 1e200};
  size_t i, k, count = 0;
  for (i = 0; i < 4; ++i) {
    const dsw_cut_face *faces = NULL;
    grid g = grid_create(4, 4, 4);
    dsw_environment_desc e = grid_desc(&g);
    double blade[12] = {1.5, -1, -1, 1.5, 5, -1, 1.5, -1, 5, 1.5, 5, 5};
    dsw_open_desc d;
    dsw_cut_desc c;
    for (k = 0; k < 3 * g.point_count; ++k) g.points[k] *= sizes[i];
    for (k = 0; k < 12; ++k) blade[k] *= sizes[i];
    CHECK_OK(dsw_environment_create(NULL, &e, &g_env, NULL));
    dsw_cut_desc_init(&c, sizeof c);
    c.points = blade;
    c.rows = c.columns = 2;
    c.flags = DSW_CUT_UNSEW;
    CHECK_OK(dsw_environment_cut(g_env, &c, NULL));
    CHECK_OK(dsw_environment_get_cut_faces(g_env, &faces, &count));
    CHECK(count == 16);
    memcpy(g_faces, faces, count * sizeof *faces);
    d = open_faces(count, 0.25 * sizes[i]);
    CHECK_OK(dsw_environment_open(g_env, &d, &g_report));
    CHECK(g_report.faces_opened == 16 && g_report.vertices_shortened == 0);
    CHECK(fabs(g_report.smallest_width / sizes[i] - 0.25) < 1e-12);
    CHECK_OK(dsw_environment_destroy(g_env));
    grid_destroy(&g);
  }
}

int main(void) {
  a_crack_right_through();
  a_cut_that_ends_inside();
  a_tissue_opens_into_the_air();
  gaps_join();
  as_far_as_it_goes();
  bad_arguments();
  borrowed_points();
  bodies_and_particles();
  running_out_of_memory();
  any_size();
  return check_result();
}
