#include "block.h"

#include <string.h>

#include "check.h"

block_numbers g_block;
dsw_environment *g_env;
double g_blade[12];
dsw_change g_cut;
dsw_cut_face g_faces[64];

static grid g_grid;

void use_block(unsigned dimension) {
  static const block_numbers plane = {2, 16, 16, 4, 5, 2, 3, 2};
  static const block_numbers space = {3, 64, 96, 16, 25, 16, FACE_X0, FACE_Y1};
  g_block = dimension == 2 ? plane : space;
  check_in(dimension == 2 ? "in the plane" : "in space");
}

void begin_block(dsw_context *context, double size, uint32_t flags) {
  dsw_environment_desc d;
  size_t i;
  g_grid = grid_create(4, 4, g_block.dimension == 2 ? 1 : 4);
  for (i = 0; i < 3 * g_grid.point_count; ++i) g_grid.points[i] *= size;
  d = g_block.dimension == 2 ? squares_desc(&g_grid) : grid_desc(&g_grid);
  d.flags = flags;
  g_cut = empty_change();
  CHECK_OK(dsw_environment_create(context, &d, &g_env, NULL));
}

void end_block(uint32_t volumes, uint32_t boundary, uint32_t parts) {
  const dsw_environment_info i = info_of(g_env);
  CHECK(i.volume_count == volumes && i.boundary_face_count == boundary && i.part_count == parts);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  drop_block();
}

void drop_block(void) {
  CHECK_OK(dsw_environment_destroy(g_env));
  grid_destroy(&g_grid);
}

dsw_cut_desc blade_at(double x, double y_end) {
  dsw_cut_desc d;
  unsigned i;
  for (i = 0; i < 4; ++i) {
    double *const p = g_blade + g_block.dimension * i;
    p[0] = x;
    p[1] = i % 2 == 0 ? -1 : y_end;
    if (g_block.dimension == 3) p[2] = i < 2 ? -1 : 5;
  }
  dsw_cut_desc_init(&d, sizeof d);
  d.points = g_blade;
  d.rows = 2;
  d.columns = g_block.dimension - 1;
  d.start = volume_at(0);
  return d;
}

void cut(dsw_cut_desc d, uint32_t flags) {
  d.flags = flags;
  g_cut = empty_change();
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_cut));
}

size_t keep_faces(void) {
  const dsw_cut_face *faces = change_of(g_env).faces;
  const size_t count = change_of(g_env).face_count;
  CHECK(count <= 64);
  if (count != 0) memcpy(g_faces, faces, count * sizeof *faces);
  return count;
}

double x_of(dsw_vertex_id vertex) {
  double at[3] = {0, 0, 0};
  CHECK_OK(dsw_environment_get_vertex_position(g_env, vertex, at));
  return at[0];
}

double fly_between(const double *from, const double *to) {
  dsw_flight flight;
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, to, NULL, &flight));
  CHECK((flight.outcome == DSW_OUTCOME_REACHED) == (flight.time == 1));
  return flight.time;
}

double fly(double x, double y, double to_x, double to_y) {
  const double from[3] = {x, y, 1.4}, to[3] = {to_x, to_y, 1.6};
  return fly_between(from, to);
}

double fly_down(double x, double height, double to_x, double to_height) {
  const double from[3] = {x, 1.4, height}, to[3] = {to_x, 1.6, to_height};
  return g_block.dimension == 2 ? fly(x, height, to_x, to_height) : fly_between(from, to);
}
