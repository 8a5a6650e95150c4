/* carve.h: shapes carved out of a grid of cubes, vessels tied in it, what they return, every way to be refused, and
   what bodies and particles say to it. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 4 x 4 cubes */
static double g_points[8 * 3];
static dsw_change g_carved;
static dsw_change g_tied;

static const uint32_t g_box[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

static size_t marked_count(void) {
  size_t count = 999;
  CHECK_OK(dsw_environment_get_mark_count(g_env, DSW_CELL_VOLUME, &count));
  return count;
}

/* Cubes with region x from here to there become impassable. */
static void mark_columns(int32_t first, int32_t last) {
  for (; first <= last; ++first) {
    CHECK_OK(dsw_environment_mark_region(g_env, first, DSW_MARK_IMPASSABLE, 0, NULL, NULL));
  }
}

static void begin_block(dsw_context *context) {
  g_env = make_environment(context, 4, 4, 4);
  mark_columns(0, 3);
}

/* A tube along x, two cubes wide, through the middle. */
static void begin_tube(dsw_context *context) {
  unsigned x, y, z;
  begin_block(context);
  for (z = 1; z < 3; ++z) {
    for (y = 1; y < 3; ++y) {
      for (x = 0; x < 4; ++x) {
        const dsw_volume_id v = volume_at(x + 4 * (y + 4 * z));
        CHECK_OK(dsw_environment_mark_volumes(g_env, &v, 1, DSW_MARK_PASSABLE, 0, NULL));
      }
    }
  }
}

static void end(void) {
  CHECK_OK(dsw_environment_check(g_env, NULL));
  CHECK_OK(dsw_environment_destroy(g_env));
}

static dsw_carve_desc box(double low, double high) {
  dsw_carve_desc d;
  unsigned i;
  for (i = 0; i < 24; ++i) g_points[i] = (i / 3 >> i % 3 & 1) != 0 ? high : low;
  dsw_carve_desc_init(&d, sizeof d);
  d.points = g_points;
  d.point_count = 8;
  d.triangles = g_box;
  d.triangle_count = 12;
  return d;
}

/* A square in the plane x = at, with its middle in that of the tube. */
static dsw_tie_desc loop(double at, double reach) {
  static const double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  dsw_tie_desc d;
  unsigned i;
  for (i = 0; i < 4; ++i) {
    g_points[3 * i] = at;
    g_points[3 * i + 1] = 2 + reach * corners[i][0];
    g_points[3 * i + 2] = 2 + reach * corners[i][1];
  }
  dsw_tie_desc_init(&d, sizeof d);
  d.points = g_points;
  d.point_count = 4;
  return d;
}

static size_t carved_count(const dsw_volume_id **volumes) {
  const dsw_change change = change_of(g_env);
  *volumes = change.carved;
  return change.carved_count;
}

static double fly(double y, double z) {
  double from[3] = {0.3, 0, 0}, to[3] = {3.7, 0, 0};
  dsw_flight flight;
  from[1] = to[1] = y;
  from[2] = to[2] = z;
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, to, NULL, &flight));
  return flight.time;
}

static void along_the_grid(void) {
  dsw_carve_desc d = box(1, 3);
  const dsw_volume_id *volumes = NULL;
  size_t i;
  begin_block(NULL);
  CHECK(carved_count(&volumes) == 0);
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 8 && g_carved.volumes_split == 0 && g_carved.volumes_changed == 0);
  CHECK(marked_count() == 56);
  CHECK(carved_count(&volumes) == 8);
  for (i = 0; i < 8; ++i) CHECK((volumes[i].index % 4 + 1) / 2 == 1 && volumes[i].generation == 1);
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved)); /* nothing is left to carve */
  CHECK(g_carved.carved_count == 0 && carved_count(&volumes) == 0 && marked_count() == 56);
  end();
}

static void through_cubes(void) {
  dsw_carve_desc d = box(0.75, 3.25);
  begin_block(NULL);
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.volumes_crossed == 56 && g_carved.volumes_split == 56 && g_carved.whole_count == 0);
  CHECK(g_carved.carved_count == 64 && marked_count() == 56 && info_of(g_env).volume_count == 120);
  CHECK(g_carved.vertex_count == 3 * 9 * 2);
  CHECK(g_carved.volume_count == 112 && change_of(g_env).volume_count == 112);
  end();
}

static void whole_volumes(void) {
  dsw_carve_desc d = box(0.4, 2.6);
  begin_block(NULL);
  d.flags = DSW_CARVE_WHOLE;
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 27 && g_carved.volumes_changed == 0 && info_of(g_env).volume_count == 64);
  CHECK(g_carved.whole_count == 26 && g_carved.volumes_crossed == 26);
  d = box(2.5, 3.6); /* the surface's lower sides pass through centres: it is shifted beyond them */
  d.flags = DSW_CARVE_WHOLE;
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 1 && marked_count() == 36);
  end();
}

/* A box inside of one cube: eight halves of halves, each of which is halved thrice towards a corner of the box. */
static void halves(void) {
  dsw_carve_desc d = box(2.3, 2.7);
  dsw_edge_id edge;
  dsw_change change;
  size_t i, count = 0;
  begin_block(NULL);
  edge = edge_at(2 + 4 * (2 + 4 * 2), 0);
  CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_IMPASSABLE));
  d.finest = 0.25;
  d.flags = DSW_CARVE_COVER;
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.volumes_crossed == 1 && g_carved.volumes_split == 1 && g_carved.whole_count == 0);
  CHECK(g_carved.volumes_changed == 19 && g_carved.carved_count == 8);
  CHECK(info_of(g_env).volume_count == 64 + 31 && marked_count() == 64 + 31 - 8);
  CHECK_OK(dsw_environment_get_mark_count(g_env, DSW_CELL_EDGE, &count));
  CHECK(count == 4);
  change = change_of(g_env);
  CHECK(change.volume_count == 32 + 18 && change.vertex_count > 0 && change.face_count == 0);
  for (i = 0; i < change.vertex_count; ++i) {
    const dsw_vertex_origin v = change.vertices[i];
    double at[3], from[2][3];
    unsigned k;
    CHECK_OK(dsw_environment_get_vertex_position(g_env, v.vertex, at));
    CHECK_OK(dsw_environment_get_vertex_position(g_env, v.from[0], from[0]));
    CHECK_OK(dsw_environment_get_vertex_position(g_env, v.from[1], from[1]));
    for (k = 0; k < 3; ++k) CHECK(at[k] == v.weights[0] * from[0][k] + v.weights[1] * from[1][k]);
  }
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved)); /* nothing is left to do */
  CHECK(g_carved.carved_count == 0 && g_carved.volumes_changed == 0 && g_carved.volumes_crossed == 0);
  d.finest = 0;
  d.flags = 0;
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 0);
  end();
}

/* What no surface goes round is not carved, and what it crosses only with DSW_CARVE_COVER. */
static void covered_volumes(void) {
  dsw_carve_desc d = box(2.3, 2.4);
  begin_block(NULL);
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 0);
  d.flags = DSW_CARVE_COVER;
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 1 && g_carved.volumes_changed == 0 && marked_count() == 63);
  d = box(0.5, 2.5);
  d.flags = DSW_CARVE_COVER | DSW_CARVE_WHOLE;
  d.start = volume_at(0);
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 26 && g_carved.volumes_changed == 0 && marked_count() == 37);
  end();
}

/* Squares that are crossed are carved, too; they cannot be halved. */
static void in_the_plane(void) {
  static const double corners[6] = {0.2, 0.2, 1.5, 0.2, 0.2, 0.8};
  static const uint32_t segments[6] = {0, 1, 1, 2, 2, 0};
  dsw_carve_desc d;
  g_env = make_squares(NULL, 4, 4);
  mark_columns(0, 3);
  dsw_carve_desc_init(&d, sizeof d);
  d.points = corners;
  d.point_count = 3;
  d.triangles = segments;
  d.triangle_count = 3;
  d.finest = 0.5;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_carve(g_env, &d, NULL));
  CHECK_MESSAGE("in the plane");
  d.finest = 0;
  d.flags = DSW_CARVE_COVER;
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 2 && g_carved.volumes_changed == 0 && marked_count() == 14);
  end();
}

static void all_and_nothing(void) {
  dsw_carve_desc d = box(5, 7);
  begin_block(NULL);
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 0 && g_carved.volumes_crossed == 0);
  d.start = volume_at(9);
  CHECK_OK(dsw_environment_carve(g_env, &d, NULL));
  d = box(1.5, 1.5); /* a point */
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 0 && g_carved.volumes_split == 0);
  d = box(-1e300, 1e300);
  d.start = volume_at(9);
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 64 && g_carved.volumes_crossed == 0 && marked_count() == 0);
  end();
}

static void what_hangs_together(void) {
  dsw_face_id faces[16];
  double loads[16];
  dsw_carve_desc d = box(-1, 5);
  unsigned i;
  begin_block(NULL);
  for (i = 0; i < 16; ++i) {
    faces[i] = face_at(1 + 4 * i, FACE_X1);
    loads[i] = 1;
  }
  CHECK_OK(dsw_environment_tear_faces(g_env, faces, loads, 16, 0, NULL));
  d.start = volume_at(0);
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 32);
  d.start = no_volume;
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 32 && marked_count() == 0);
  end();
}

static void bad_shapes(void) {
  dsw_carve_desc d = box(0.75, 3.25), bad;
  uint32_t triangles[36];
  begin_block(NULL);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_carve(NULL, &d, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_carve(g_env, NULL, NULL));
  CHECK_REFUSES(DSW_STATUS_NULL_ARGUMENT, d, points, NULL, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_NULL_ARGUMENT, d, triangles, NULL, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_BAD_STRUCT_SIZE, d, struct_size, 8, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, d, flags, 4, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_NON_FINITE, d, finest, NAN, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_NON_FINITE, d, finest, HUGE_VAL, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, finest, -0.5, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_MESSAGE("desc->finest is -0.5");
  bad = d, bad.flags = DSW_CARVE_WHOLE;
  bad.finest = 0.5;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, point_count, 0, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, triangle_count, 0, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_TOO_LARGE, d, triangle_count, (size_t)1 << 28, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_INDEX_OUT_OF_RANGE, d, point_count, 7, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_MESSAGE("desc->triangles[10] is 7");
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, snap, 0.26, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_STALE_ID, d, start, volume_at(64), dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_WRONG_SIZE, d, point_stride_bytes, 20, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_BAD_TOPOLOGY, d, triangle_count, 11, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_MESSAGE("not closed");
  memcpy(triangles, g_box, sizeof triangles);
  bad = d, bad.triangles = triangles;
  triangles[33] = 5, triangles[34] = 7, triangles[35] = 3; /* seen from behind */
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_carve(g_env, &bad, NULL));
  triangles[4] = 1;
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_carve(g_env, &bad, NULL));
  CHECK_MESSAGE("triangle 1 of desc->triangles");
  g_points[7] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_carve(g_env, &d, NULL));
  CHECK_MESSAGE("desc->points[2]");
  CHECK(marked_count() == 64);
  end();
}

static void a_tube(void) {
  dsw_tie_desc d = loop(1.25, 1.5);
  const dsw_cut_face *faces = NULL;
  dsw_face_id a[4], b[4];
  size_t i, count = 0;
  begin_tube(NULL);
  CHECK(fly(1.7, 2.4) == 1);
  CHECK_OK(dsw_environment_tie(g_env, &d, &g_tied));
  CHECK(g_tied.is_closed == 1 && g_tied.volumes_split == 4 && g_tied.whole_count == 0);
  CHECK(info_of(g_env).volume_count == 68 && marked_count() == 48);
  CHECK(fabs(fly(1.7, 2.4) - (1.25 - 0.3) / 3.4) < 1e-12);
  faces = change_of(g_env).faces;
  count = change_of(g_env).face_count;
  CHECK(count == 4);
  for (i = 0; i < 4; ++i) {
    a[i] = faces[i].front;
    b[i] = faces[i].back;
  }
  CHECK_OK(dsw_environment_sew_faces(g_env, a, b, 4)); /* undone */
  CHECK(fly(1.7, 2.4) == 1);
  end();
}

static void along_faces(void) {
  dsw_tie_desc d = loop(2, 1.5);
  begin_tube(NULL);
  CHECK_OK(dsw_environment_tie(g_env, &d, &g_tied));
  CHECK(g_tied.is_closed == 1 && g_tied.volumes_split == 0 && g_tied.whole_count == 0);
  CHECK(g_tied.face_count == 4 && g_tied.volumes_changed == 0 && fabs(fly(1.7, 2.4) - 0.5) < 1e-12);
  end();
}

static void a_loop_in_the_tube(void) {
  dsw_tie_desc d = loop(1.25, 0.5);
  const dsw_volume_id *whole = NULL;
  size_t count = 0;
  begin_tube(NULL);
  d.start = volume_at(0);
  CHECK_OK(dsw_environment_tie(g_env, &d, &g_tied));
  CHECK(g_tied.is_closed == 0 && g_tied.volumes_split == 0 && g_tied.whole_count == 4);
  CHECK(marked_count() == 52 && fly(1.7, 2.4) < 0.3);
  whole = change_of(g_env).whole;
  count = change_of(g_env).whole_count;
  CHECK_OK(dsw_environment_mark_volumes(g_env, whole, count, DSW_MARK_PASSABLE, 0, NULL));
  CHECK(fly(1.7, 2.4) == 1);
  d = loop(9, 0.5); /* nowhere */
  CHECK_OK(dsw_environment_tie(g_env, &d, &g_tied));
  CHECK(g_tied.is_closed == 0 && g_tied.volumes_crossed == 0 && fly(1.7, 2.4) == 1);
  d = loop(9, 0); /* a point */
  CHECK_OK(dsw_environment_tie(g_env, &d, NULL));
  end();
}

/* What a tie relies on: a tip that enters a cube through a face and crosses no edge of the cube leaves it whole. */
static void a_fold_of_the_blade(void) {
  static const double at[5] = {-1, 2.4, 2.5, 2.6, 5};
  double points[75];
  const dsw_volume_id *whole = NULL;
  size_t i, count = 0;
  dsw_cut_desc d;
  dsw_change report = empty_change();
  g_env = make_environment(NULL, 4, 4, 4);
  for (i = 0; i < 25; ++i) {
    points[3 * i] = i == 12 ? 1.2 : 0.9;
    points[3 * i + 1] = at[i / 5];
    points[3 * i + 2] = at[i % 5];
  }
  dsw_cut_desc_init(&d, sizeof d);
  d.points = points;
  d.rows = d.columns = 5;
  CHECK_OK(dsw_environment_cut(g_env, &d, &report));
  CHECK(report.volumes_crossed == 17 && report.volumes_split == 16 && report.whole_count == 1);
  whole = change_of(g_env).whole;
  count = change_of(g_env).whole_count;
  CHECK(count == 1 && whole[0].index == 1 + 4 * (2 + 4 * 2));
  end();
}

static void bad_loops(void) {
  dsw_tie_desc d = loop(1.25, 1.5), bad;
  begin_tube(NULL);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_tie(NULL, &d, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_tie(g_env, NULL, NULL));
  CHECK_REFUSES(DSW_STATUS_NULL_ARGUMENT, d, points, NULL, dsw_environment_tie(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_BAD_STRUCT_SIZE, d, struct_size, 8, dsw_environment_tie(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, d, flags, 1, dsw_environment_tie(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, point_count, 2, dsw_environment_tie(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_TOO_LARGE, d, point_count, (size_t)1 << 28, dsw_environment_tie(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, d, snap, -1, dsw_environment_tie(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_STALE_ID, d, start, volume_at(64), dsw_environment_tie(g_env, &bad, NULL));
  CHECK_REFUSES(DSW_STATUS_WRONG_SIZE, d, point_stride_bytes, 4, dsw_environment_tie(g_env, &bad, NULL));
  g_points[7] = HUGE_VAL;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_tie(g_env, &d, NULL));
  CHECK(marked_count() == 48 && info_of(g_env).volume_count == 64);
  end();
}

static void borrowed_points(void) {
  grid g = grid_create(4, 4, 4);
  dsw_environment_desc e = grid_desc(&g);
  dsw_carve_desc d = box(0.75, 3.25);
  e.flags = DSW_ENVIRONMENT_BORROW_POINTS;
  CHECK_OK(dsw_environment_create(NULL, &e, &g_env, NULL));
  mark_columns(0, 3);
  CHECK_FAILS(DSW_STATUS_BORROWED, dsw_environment_carve(g_env, &d, NULL));
  d.flags = DSW_CARVE_WHOLE; /* needs no vertices */
  CHECK_OK(dsw_environment_carve(g_env, &d, &g_carved));
  CHECK(g_carved.carved_count == 8 && marked_count() == 56);
  end();
  grid_destroy(&g);
}

static void bodies_and_particles(void) {
  static const double across[6] = {0.5, 1.5, 1.5, 2.5, 1.4, 1.6}, at[3] = {1.5, 1.4, 1.6}, to[3] = {3.5, 1.4, 1.6};
  const dsw_body_id *bodies = NULL;
  const dsw_particle_id *particles = NULL;
  dsw_scene *scene, *second;
  dsw_particle_id particle;
  dsw_flight flight;
  dsw_body_id body;
  dsw_carve_desc shape;
  dsw_tie_desc d;
  size_t count = 0;
  begin_tube(NULL);
  scene = make_scene(g_env, 0);
  body = make_edge_body(scene, across, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_particle_create(scene, at, no_volume, &particle));
  d = loop(1.25, 1.5);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_tie(g_env, &d, NULL));
  CHECK_OK(dsw_scene_get_occupant_bodies(scene, &bodies, &count));
  CHECK(count == 1 && bodies[0].index == body.index && info_of(g_env).volume_count == 64);
  d = loop(1.25, 0.5); /* volumes stay whole: the particle is in one of them, an end of the body in another */
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_tie(g_env, &d, NULL));
  CHECK_OK(dsw_scene_get_occupants(scene, &particles, &count));
  CHECK(count == 1 && particles[0].index == particle.index && marked_count() == 48);
  CHECK_OK(dsw_particle_destroy(scene, particle));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_tie(g_env, &d, NULL));
  CHECK_OK(dsw_scene_get_occupant_bodies(scene, &bodies, &count));
  CHECK(count == 1 && bodies[0].index == body.index && marked_count() == 48);
  CHECK_OK(dsw_body_destroy(scene, body));

  CHECK_OK(dsw_particle_create(scene, at, no_volume, &particle));
  d = loop(1.75, 1.5);
  CHECK_OK(dsw_environment_tie(g_env, &d, &g_tied));
  CHECK_OK(dsw_particle_move(scene, particle, to, NULL, &flight));
  CHECK(flight.outcome == DSW_OUTCOME_CONTACT && flight.position[0] <= 1.75 && flight.position[0] > 1.74);
  second = make_scene(g_env, 0);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_tie(g_env, &d, NULL));
  shape = box(0.75, 3.25);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_carve(g_env, &shape, NULL));
  CHECK_OK(dsw_scene_destroy(second));
  CHECK_OK(dsw_scene_destroy(scene));
  end();
}

/* A burr, an octahedron, goes through four cubes in steps, before each of which what is in its way is carved. */
static void a_drill(void) {
  static const double axes[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  static const uint32_t corners[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  static const uint32_t offsets[9] = {0, 3, 6, 9, 12, 15, 18, 21, 24};
  double points[18];
  dsw_body_desc b;
  dsw_body_id body;
  dsw_carve_desc d;
  dsw_move_report report;
  dsw_scene *scene;
  unsigned step, i;
  begin_block(NULL);
  d = box(0.4, 1.9); /* the burr begins in a hole */
  d.finest = 0.25;
  CHECK_OK(dsw_environment_carve(g_env, &d, NULL));
  for (i = 0; i < 18; ++i) points[i] = (i % 3 == 0 ? 1.1 : 1.2) + 0.5 * axes[i / 3][i % 3];
  scene = make_scene(g_env, DSW_FEATURE_LIVE_CHANGES);
  dsw_body_desc_init(&b, sizeof b);
  b.positions = points;
  b.vertex_count = 6;
  b.face_offsets = offsets;
  b.face_corners = corners;
  b.face_count = 8;
  b.face_corner_count = 24;
  b.level = DSW_LEVEL_FACES;
  CHECK_OK(dsw_body_create(scene, &b, &body));
  dsw_carve_desc_init(&d, sizeof d);
  d.points = points;
  d.point_count = 6;
  d.triangles = corners;
  d.triangle_count = 8;
  d.finest = 0.25;
  d.flags = DSW_CARVE_COVER;
  for (step = 0; step < 30; ++step) {
    for (i = 0; i < 18; i += 3) points[i] += 0.075;
    CHECK_OK(dsw_environment_carve(g_env, &d, NULL));
    CHECK_OK(dsw_body_move(scene, body, points, 6, 0, NULL, &report));
    CHECK(report.vertices_stopped == 0);
  }
  for (i = 1; i < 18; i += 3) points[i] += 0.6; /* without carving it is stopped */
  CHECK_OK(dsw_body_move(scene, body, points, 6, 0, NULL, &report));
  CHECK(report.vertices_stopped > 0);
  CHECK_OK(dsw_scene_destroy(scene));
  end();
}

static void running_out_of_memory(void) {
  host h;
  size_t n, refusals = 0;
  int kind;
  for (kind = 0; kind < 3; ++kind) {
    dsw_context *const context = make_context(&h);
    const dsw_tie_desc t = loop(1.25, 0.8);
    dsw_carve_desc c;
    dsw_carve_desc_init(&c, sizeof c);
    if (kind != 0) c = box(0.75, 1.4); /* in the place of the loop */
    c.finest = kind == 2 ? 0.5 : 0;
    begin_tube(context);
#define CALL (kind == 0 ? dsw_environment_tie(g_env, &t, &g_tied) : dsw_environment_carve(g_env, &c, &g_carved))
    for (n = 0; RUNS_OUT(&h, n, CALL); n += 1 + n / 64, ++refusals) {
      CHECK(info_of(g_env).volume_count == 64 && marked_count() == 48);
    }
#undef CALL
    CHECK(refusals > 50);
    end();
    end_context(context, &h);
  }
}

int main(void) {
  g_carved = g_tied = empty_change();
  along_the_grid();
  through_cubes();
  whole_volumes();
  halves();
  covered_volumes();
  in_the_plane();
  a_drill();
  all_and_nothing();
  what_hangs_together();
  bad_shapes();
  a_tube();
  along_faces();
  a_loop_in_the_tube();
  a_fold_of_the_blade();
  bad_loops();
  borrowed_points();
  bodies_and_particles();
  running_out_of_memory();
  return check_result();
}
