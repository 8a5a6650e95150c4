#include "stage.h"

#include <string.h>

#include "check.h"

unsigned g_dimension;
dsw_environment *g_env;
dsw_scene *g_scene;
size_t g_stride;
uint32_t g_pillar;
const double g_left[6] = {1.25, 0.25, 1.5, 1.25, 3.75, 1.5}, g_right[6] = {3.25, 0.25, 1.5, 3.25, 3.75, 1.5};

void begin_stage(unsigned dimension) {
  const int space = dimension == 3;
  check_in(space ? "in space" : "in the plane");
  g_dimension = dimension;
  g_stride = space ? 0 : 24;
  g_pillar = 2 + N + (space ? N * N : 0);
  g_env = space ? make_environment(NULL, N, N, 3) : make_squares(NULL, N, N);
  g_scene = make_scene(g_env, 0);
}

void end_stage(void) { end_scene(g_scene); }

dsw_level top_level(void) { return g_dimension == 3 ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT; }

uint32_t point_at(uint32_t x, uint32_t y) { return x + (N + 1) * y; }

dsw_status mark_cell(uint32_t index, dsw_mark mark) { return set_volume_mark(g_env, index, mark); }

dsw_status mark_face(uint32_t volume, uint32_t local, dsw_mark mark) {
  return set_face_mark(g_env, volume, local, mark);
}

dsw_status mark_point(uint32_t x, uint32_t y, dsw_mark mark) { return set_vertex_mark(g_env, point_at(x, y), mark); }

void mark_pillar(dsw_mark mark) { CHECK_OK(mark_cell(g_pillar, mark)); }

dsw_body_id make_line(const double *positions, size_t count, dsw_level level) {
  dsw_body_desc d = line_desc(positions, count, 0, level);
  dsw_body_id body = {0, 0};
  d.stride_bytes = g_stride;
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  return body;
}

dsw_move_report move(dsw_body_id body, const double *targets, size_t count, const dsw_move_options *o) {
  dsw_move_report r;
  memset(&r, 0x55, sizeof r);
  CHECK_OK(dsw_body_move(g_scene, body, targets, count, g_stride, o, &r));
  return r;
}

size_t positions_of(dsw_body_id body, double *p, size_t capacity) {
  size_t count = 0;
  memset(p, 0, 3 * capacity * sizeof *p);
  CHECK_OK(dsw_body_get_positions(g_scene, body, p, capacity, g_stride, NULL, &count));
  return count;
}

int is_point(const double *p, const double *wanted) {
  return p[0] == wanted[0] && p[1] == wanted[1] && p[2] == (g_dimension == 3 ? wanted[2] : 0);
}

int is_at(dsw_body_id body, const double *wanted, size_t count) {
  double p[48];
  size_t i;
  if (positions_of(body, p, 16) != count) return 0;
  for (i = 0; i < count && is_point(p + 3 * i, wanted + 3 * i); ++i) continue;
  return i == count;
}

size_t contacts_of(dsw_body_id body, const dsw_body_contact **contacts) {
  size_t count = 99;
  CHECK_OK(dsw_body_get_contacts(g_scene, body, contacts, &count));
  return count;
}

size_t edits_of(dsw_body_id body, const dsw_body_edit **edits) {
  size_t count = 99;
  CHECK_OK(dsw_body_get_edits(g_scene, body, edits, &count));
  return count;
}

dsw_body_counts counts_of(dsw_body_id body) { return body_counts(g_scene, body); }

size_t body_count(void) {
  size_t count = 99;
  CHECK_OK(dsw_scene_get_body_count(g_scene, &count));
  return count;
}

void refuses(dsw_status status, const dsw_body_desc *d, const char *text) {
  dsw_body_id body = {77, 78};
  const size_t before = body_count();
  CHECK_FAILS(status, dsw_body_create(g_scene, d, &body));
  CHECK_MESSAGE("dsw_body_create: ");
  CHECK_MESSAGE(text);
  CHECK(body.index == 77 && body.generation == 78 && body_count() == before);
}

int has(dsw_body_id body, uint32_t vertices, uint32_t edges, uint32_t faces) {
  const dsw_body_counts c = counts_of(body);
  return c.vertex_count == vertices && c.edge_count == edges && c.face_count == faces;
}

dsw_body_vertex_id vertex_id(uint32_t index) {
  const dsw_body_vertex_id id = {index, 1};
  return id;
}

dsw_body_edge_id edge_id(uint32_t index) {
  const dsw_body_edge_id id = {index, 1};
  return id;
}

dsw_body_face_id face_id(uint32_t index) {
  const dsw_body_face_id id = {index, 1};
  return id;
}
