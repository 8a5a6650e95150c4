#include "bending_squares.h"

#include <string.h>

#include "check.h"

dsw_environment *g_env;
dsw_scene *g_scene;
double g_points[2][2 * POINTS];
int g_next;

uint32_t square(uint32_t x, uint32_t y) { return x + N * y; }
uint32_t vertex(uint32_t x, uint32_t y) { return x + (N + 1) * y; }
double *point(uint32_t x, uint32_t y) { return g_points[g_next] + 2 * (size_t)vertex(x, y); }

void begin(uint32_t features) {
  const double *points = NULL;
  size_t count = 0;
  g_env = make_squares(NULL, N, N);
  g_scene = make_scene(g_env, features);
  CHECK_OK(dsw_environment_get_points(g_env, &points, &count));
  CHECK(count == POINTS && points[2] == 1 && points[3] == 0 && points[2 * (N + 1) + 1] == 1);
  memcpy(g_points[0], points, sizeof g_points[0]);
  memcpy(g_points[1], points, sizeof g_points[1]);
  g_next = 0;
}

void end(void) {
  CHECK_OK(dsw_scene_destroy(g_scene));
  CHECK_OK(dsw_environment_destroy(g_env));
}

void mark_floor(uint32_t row) {
  uint32_t x;
  for (x = 0; x < N; ++x) CHECK_OK(set_face_mark(g_env, square(x, row), SIDE_UP, DSW_MARK_IMPASSABLE));
}

void raise_row(uint32_t y, double by) {
  uint32_t x;
  for (x = 0; x <= N; ++x) point(x, y)[1] += by;
}

dsw_body_id make_line(const double *positions, size_t count, dsw_level level) {
  const dsw_body_desc d = line_desc(positions, count, 0, level);
  dsw_body_id body = {0, 0};
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  return body;
}

dsw_deform_report deform(const dsw_deform_options *o) {
  return deform_to_next(g_scene, g_points[0], POINTS, 2, &g_next, o);
}
