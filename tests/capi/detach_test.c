/* dsw_environment_detach: cubes that come off a grid of cubes, what is told of them, and every way to be refused. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 4 x 4 cubes */
static dsw_scene *g_scene;
static dsw_detach_desc g_desc;
static dsw_change g_report;
static dsw_body_id g_body;

static uint32_t cube(uint32_t x, uint32_t y, uint32_t z) { return x + 4 * (y + 4 * z); }

static void mark(uint32_t volume) { CHECK_OK(set_volume_mark(g_env, volume, DSW_MARK_IMPASSABLE)); }

/* Impassable: cubes (1, 1, 1) and (2, 1, 1), the piece, and (2, 2, 1), from which it is parted. */
static void mark_piece(void) {
  mark(cube(1, 1, 1));
  mark(cube(2, 1, 1));
  mark(cube(2, 2, 1));
  CHECK_OK(dsw_environment_unsew_face(g_env, face_at(cube(2, 1, 1), FACE_Y1)));
  dsw_detach_desc_init(&g_desc, sizeof g_desc);
  g_desc.volume = volume_at(cube(1, 1, 1));
}
static void begin(dsw_context *context, uint32_t features) {
  g_env = make_environment(context, 4, 4, 4);
  g_scene = make_scene(g_env, features);
  mark_piece();
}
static size_t marks(dsw_cell_kind kind) {
  size_t count = 999;
  CHECK_OK(dsw_environment_get_mark_count(g_env, kind, &count));
  return count;
}
static size_t bodies(void) {
  size_t count = 999;
  CHECK_OK(dsw_scene_get_body_count(g_scene, &count));
  return count;
}
static void end(uint32_t boundary) {
  CHECK(info_of(g_env).volume_count == 64 && info_of(g_env).boundary_face_count == boundary);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  end_scene(g_scene);
}

static void two_cubes(void) {
  const dsw_volume_id *volumes = NULL;
  const dsw_vertex_origin *vertices = NULL;
  const dsw_face_origin *faces = NULL;
  double positions[36], xyz[3];
  size_t i, k, count = 99;
  begin(NULL, 0);
  CHECK(change_of(g_env).detached_count == 0);
  CHECK_OK(dsw_environment_detach(g_env, &g_desc, &g_body, &g_report));
  CHECK(g_report.detached_count == 2 && g_report.body_vertex_count == 12 && g_report.body_face_count == 20);
  CHECK(g_report.faces_sewn == 1 && g_report.faces_unsewn == 0);
  CHECK(fabs(g_report.distance - 0.01) < 1e-12);
  CHECK(marks(DSW_CELL_VOLUME) == 1);
  CHECK(body_counts(g_scene, g_body).vertex_count == 12 && body_counts(g_scene, g_body).edge_count == 30 &&
        body_counts(g_scene, g_body).face_count == 20);
  volumes = change_of(g_env).detached;
  count = change_of(g_env).detached_count;
  CHECK(count == 2 && volumes[0].index == cube(1, 1, 1) && volumes[1].index == cube(2, 1, 1));
  vertices = change_of(g_env).body_vertices;
  count = change_of(g_env).body_vertex_count;
  CHECK(count == 12);
  CHECK_OK(dsw_body_get_positions(g_scene, g_body, positions, 12, 0, NULL, &count));
  for (i = 0; i < 12; ++i) {
    double square = 0;
    CHECK(vertices[i].weights[0] == 1 && vertices[i].weights[1] == 0);
    CHECK(vertices[i].from[0].index == vertices[i].from[1].index);
    CHECK_OK(dsw_environment_get_vertex_position(g_env, vertices[i].from[0], xyz));
    for (k = 0; k < 3; ++k) square += (positions[3 * i + k] - xyz[k]) * (positions[3 * i + k] - xyz[k]);
    CHECK(square > 0 && square < 1.01e-4);
    for (k = 0; k < 3; ++k) CHECK(positions[3 * i + k] > 1 && positions[3 * i + k] < (k == 0 ? 3 : 2));
  }
  faces = change_of(g_env).body_faces;
  count = change_of(g_env).body_face_count;
  CHECK(count == 20);
  for (i = 0; i < 20; ++i) {
    CHECK(faces[i].volume.index == cube(i < 10 ? 1 : 2, 1, 1));
    CHECK(faces[i].volume.generation == 1);
  }
  CHECK(change_of(g_env).volume_count == 0);
  end(96);
}

static void marks_go_with_it(void) {
  const dsw_face_id faces[2] = {face_at(cube(1, 1, 1), FACE_X1), face_at(cube(1, 1, 1), FACE_X0)};
  const dsw_face_id other = face_at(cube(2, 2, 1), FACE_Z1);
  dsw_vertex_id corner;
  uint32_t local;
  grid g = grid_create(4, 4, 4);
  begin(NULL, 0);
  mark(cube(1, 2, 1)); /* so that an edge and no more lies inside: that of these and (1, 1, 2), (1, 2, 2) */
  mark(cube(1, 1, 2));
  mark(cube(1, 2, 2));
  CHECK_OK(dsw_environment_unsew_face(g_env, face_at(cube(1, 2, 1), FACE_X1)));
  CHECK_OK(dsw_environment_mark_faces(g_env, faces, 2, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_mark_faces(g_env, &other, 1, DSW_MARK_IMPASSABLE));
  for (local = 0; local < 12; ++local) {
    const dsw_edge_id edge = edge_at(cube(1, 1, 1), local);
    CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_IMPASSABLE));
  }
  corner = vertex_at(grid_point(&g, 1, 1, 1));
  CHECK_OK(dsw_environment_mark_vertices(g_env, &corner, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_detach(g_env, &g_desc, &g_body, &g_report));
  CHECK(g_report.detached_count == 5 && g_report.faces_sewn == 2);
  CHECK(marks(DSW_CELL_FACE) == 1 && marks(DSW_CELL_EDGE) == 11 && marks(DSW_CELL_VERTEX) == 1);
  end(96);
  grid_destroy(&g);
}

/* All 3 x 3 x 3 cubes in a corner: on the outer boundary, with an edge and a vertex inside, and a crack. */
static void in_a_corner(void) {
  uint32_t x, y, z, local;
  dsw_vertex_id inside;
  grid g = grid_create(4, 4, 4);
  begin(NULL, DSW_FEATURE_BODY_CONTACTS);
  CHECK_OK(dsw_environment_sew_faces(g_env, (dsw_face_id[]){face_at(cube(2, 1, 1), FACE_Y1)},
                                     (dsw_face_id[]){face_at(cube(2, 2, 1), FACE_Y0)}, 1));
  for (z = 0; z < 3; ++z) {
    for (y = 0; y < 3; ++y) {
      for (x = 0; x < 3; ++x) mark(cube(x, y, z));
    }
  }
  CHECK_OK(dsw_environment_unsew_face(g_env, face_at(cube(1, 1, 1), FACE_X1)));
  inside = vertex_at(grid_point(&g, 1, 1, 1));
  CHECK_OK(dsw_environment_mark_vertices(g_env, &inside, 1, DSW_MARK_IMPASSABLE));
  for (local = 0; local < 12; ++local) {
    const dsw_edge_id edge = edge_at(cube(1, 1, 1), local);
    CHECK_OK(dsw_environment_mark_edges(g_env, &edge, 1, DSW_MARK_IMPASSABLE));
  }
  g_desc.flags = DSW_BODY_SELF_CONTACTS;
  g_desc.level = DSW_LEVEL_FACES;
  CHECK_OK(dsw_environment_detach(g_env, &g_desc, &g_body, &g_report));
  CHECK(g_report.detached_count == 27 && g_report.faces_sewn == 1 && g_report.faces_unsewn == 27);
  CHECK(g_report.body_vertex_count == 56 && g_report.body_face_count == 108);
  CHECK(marks(DSW_CELL_EDGE) == 0 && marks(DSW_CELL_VERTEX) == 0 && marks(DSW_CELL_VOLUME) == 0);
  end(96);
  grid_destroy(&g);
}

/* Two cubes that have an edge in common, joined round a hole: that edge is there twice, between the same vertices. */
static void an_edge_twice(void) {
  static const uint32_t ring[][3] = {{1, 1, 1}, {2, 2, 1}, {1, 1, 0}, {2, 2, 0},
                                     {2, 1, 0}, {1, 1, 2}, {2, 2, 2}, {1, 2, 2}};
  const dsw_vertex_origin *vertices = NULL;
  size_t i, split = 0, count = 0;
  g_env = make_environment(NULL, 4, 4, 4);
  g_scene = make_scene(g_env, 0);
  for (i = 0; i < sizeof ring / sizeof *ring; ++i) mark(cube(ring[i][0], ring[i][1], ring[i][2]));
  dsw_detach_desc_init(&g_desc, sizeof g_desc);
  g_desc.volume = volume_at(cube(1, 1, 1));
  CHECK_OK(dsw_environment_detach(g_env, &g_desc, &g_body, &g_report));
  CHECK(g_report.detached_count == 8);
  vertices = change_of(g_env).body_vertices;
  count = change_of(g_env).body_vertex_count;
  for (i = 0; i < count; ++i) {
    if (vertices[i].from[0].index == vertices[i].from[1].index) continue;
    CHECK(vertices[i].weights[0] == 0.5 && vertices[i].weights[1] == 0.5);
    ++split;
  }
  CHECK(split == 1);
  end(96);
}

static void not_off(void) {
  begin(NULL, 0);
  CHECK_OK(dsw_environment_sew_faces(g_env, (dsw_face_id[]){face_at(cube(2, 1, 1), FACE_Y1)},
                                     (dsw_face_id[]){face_at(cube(2, 2, 1), FACE_Y0)}, 1));
  g_desc.max_volumes = 2;
  CHECK_FAILS(DSW_STATUS_TOO_LARGE, dsw_environment_detach(g_env, &g_desc, &g_body, NULL));
  CHECK_MESSAGE("more than 2");
  g_desc.max_volumes = 3;
  CHECK_OK(dsw_environment_detach(g_env, &g_desc, &g_body, NULL));
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_detach(g_env, &g_desc, &g_body, NULL));
  CHECK_MESSAGE("passable");
  end(96);
}

static void bad_arguments(void) {
  dsw_detach_desc bad;
  dsw_scene *second;
  dsw_body_id body = {7, 7};
  begin(NULL, 0);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_detach(NULL, &g_desc, &body, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_detach(g_env, NULL, &body, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_detach(g_env, &g_desc, NULL, NULL));
  CHECK_REFUSES(DSW_STATUS_BAD_STRUCT_SIZE, g_desc, struct_size, 8, dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, g_desc, flags, 0x100, dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, g_desc, flags, DSW_BODY_START_PENETRATING,
                dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_REFUSES(DSW_STATUS_UNSUPPORTED, g_desc, level, (dsw_level)9, dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, g_desc, gap, 0.26, dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_MESSAGE("desc->gap");
  bad.gap = -1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_detach(g_env, &bad, &body, NULL));
  bad.gap = NAN;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, g_desc, halvings, 41, dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_REFUSES(DSW_STATUS_OUT_OF_RANGE, g_desc, motion_share, -1, dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_REFUSES(DSW_STATUS_NOT_ENABLED, g_desc, category, 2, dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_REFUSES(DSW_STATUS_STALE_ID, g_desc, volume, volume_at(64), dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_MESSAGE("desc->volume");
  CHECK_REFUSES(DSW_STATUS_STALE_ID, g_desc, volume, no_volume, dsw_environment_detach(g_env, &bad, &body, NULL));
  CHECK_REFUSES(DSW_STATUS_BAD_TOPOLOGY, g_desc, volume, volume_at(0),
                dsw_environment_detach(g_env, &bad, &body, NULL));
  second = make_scene(g_env, 0);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_detach(g_env, &g_desc, &body, NULL));
  CHECK_OK(dsw_scene_destroy(second));
  CHECK(body.index == 7 && bodies() == 0 && marks(DSW_CELL_VOLUME) == 3);
  end(98);
}

static void borrowed_points(void) {
  grid g = grid_create(4, 4, 4);
  dsw_environment_desc e = grid_desc(&g);
  e.flags = DSW_ENVIRONMENT_BORROW_POINTS;
  CHECK_OK(dsw_environment_create(NULL, &e, &g_env, NULL));
  g_scene = make_scene(g_env, 0);
  mark_piece();
  CHECK_OK(dsw_environment_detach(g_env, &g_desc, &g_body, NULL));
  end(96);
  grid_destroy(&g);
}

static void running_out_of_memory(void) {
  host h;
  dsw_context *const context = make_context(&h);
  size_t refusals = 0;
  begin(context, DSW_FEATURE_BODY_CONTACTS);
  for (; RUNS_OUT(&h, refusals, dsw_environment_detach(g_env, &g_desc, &g_body, &g_report)); ++refusals) {
    CHECK(bodies() == 0 && marks(DSW_CELL_VOLUME) == 3 && info_of(g_env).boundary_face_count == 98);
    CHECK(change_of(g_env).detached_count == 0);
  }
  CHECK(refusals > 50 && bodies() == 1);
  end(96);
  end_context(context, &h);
}

int main(void) {
  g_report = empty_change();
  two_cubes();
  marks_go_with_it();
  in_a_corner();
  an_edge_twice();
  not_off();
  bad_arguments();
  borrowed_points();
  running_out_of_memory();
  return check_result();
}
