#include "bending.h"

#include <string.h>

#include "check.h"

unsigned g_dimension, g_up;
dsw_environment *g_env;
dsw_scene *g_scene;
size_t g_point_count;
double g_points[2][3 * MOST_POINTS];
int g_next;

void use_dimension(unsigned dimension) {
  g_dimension = dimension;
  g_up = dimension - 1;
  check_in(dimension == 3 ? "in space" : "in the plane");
}

void begin(uint32_t features) {
  const double *points = NULL;
  g_env = g_dimension == 3 ? make_environment(NULL, N, N, N) : make_squares(NULL, N, N);
  g_scene = make_scene(g_env, features);
  CHECK_OK(dsw_environment_get_points(g_env, &points, &g_point_count));
  CHECK(g_point_count == (g_dimension == 3 ? 125 : 25) && points[g_dimension] == 1 && points[g_dimension + 1] == 0);
  memcpy(g_points[0], points, g_dimension * g_point_count * sizeof *points);
  memcpy(g_points[0] + g_dimension * g_point_count, points, g_dimension * g_point_count * sizeof *points);
  g_next = 0;
}

void end(void) { end_scene(g_scene); }

uint32_t cell(uint32_t x, uint32_t y, uint32_t h) { return g_dimension == 3 ? x + N * (y + N * h) : x + N * h; }

uint32_t vertex(uint32_t x, uint32_t y, uint32_t h) {
  return g_dimension == 3 ? x + (N + 1) * (y + (N + 1) * h) : x + (N + 1) * h;
}

double *next_points(void) { return g_points[0] + (size_t)g_next * g_dimension * g_point_count; }

double *point(uint32_t x, uint32_t y, uint32_t h) { return next_points() + g_dimension * (size_t)vertex(x, y, h); }

void raise_row(uint32_t h, double by) {
  uint32_t i, row = g_dimension == 3 ? (N + 1) * (N + 1) : N + 1;
  for (i = 0; i < row; ++i) point(0, 0, h)[g_dimension * i + g_up] += by;
}

void set_row(uint32_t h, double to) {
  uint32_t i, row = g_dimension == 3 ? (N + 1) * (N + 1) : N + 1;
  for (i = 0; i < row; ++i) point(0, 0, h)[g_dimension * i + g_up] = to;
}

void mark_floor(uint32_t row) {
  const uint32_t first = cell(0, 0, row), up = g_dimension == 3 ? (uint32_t)FACE_Z1 : SIDE_UP;
  uint32_t i;
  for (i = first; i < cell(0, 0, row + 1); ++i) CHECK_OK(set_face_mark(g_env, i, up, DSW_MARK_IMPASSABLE));
}

double *flat(double *xyz, size_t count) {
  size_t i;
  if (g_dimension == 3) return xyz;
  for (i = 0; i < count; ++i) {
    xyz[2 * i] = xyz[3 * i];
    xyz[2 * i + 1] = xyz[3 * i + 2];
  }
  return xyz;
}

dsw_body_id make_line(const double *positions, size_t count, dsw_level level) {
  const dsw_body_desc d = line_desc(positions, count, 0, level);
  dsw_body_id body = {0, 0};
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  return body;
}

dsw_deform_report deform(const dsw_deform_options *o) {
  return deform_to_next(g_scene, g_points[0], g_point_count, g_dimension, &g_next, o);
}
