/* Walls that move hold each other up: in space and in the plane. */
#include "bending.h"
#include "check.h"

static void raise_all(uint32_t x, uint32_t h, double by) {
  uint32_t y;
  for (y = 0; y <= (g_dimension == 3 ? N : 0u); ++y) point(x, y, h)[g_up] += by;
}

static double height_of(const double *points, uint32_t x) { return points[g_dimension * vertex(x, 2, 1) + g_up]; }

/* A bar lies over two ridges of the floor, which both rise beyond it. What rests below it holds the first, which would come first.
   The second meets the bar all the same. */
static void a_ridge_that_is_held_hides_no_other(uint32_t first, uint32_t second) {
  const double x = first;
  double bar[6] = {0.5, 2.5, 1.5, 3.5, 2.5, 1.5}, below[6] = {x - 0.125, 2.5, 1.25, x + 0.125, 2.5, 1.25};
  const double *read = NULL;
  size_t count = 0;
  dsw_scene_deform_options o;
  dsw_deform_report report;
  dsw_scene_deform_options_init(&o, sizeof o);
  o.stop = DSW_TOGETHER_STOP_FEATURE;
  begin(DSW_FEATURE_DEFORMING);
  mark_floor(0);
  make_line(flat(bar, 2), 2, DSW_LEVEL_EDGES_SWEPT);
  make_line(flat(below, 2), 2, DSW_LEVEL_EDGES_SWEPT);
  raise_all(first, 1, 0.75);
  raise_all(second, 1, 0.625);
  CHECK_OK(dsw_scene_deform(g_scene, next_points(), g_point_count, NULL, 0, NULL, 0, 0, &o, &report, NULL));
  CHECK(report.outcome == DSW_DEFORM_HELD && report.fraction == 1);
  CHECK_OK(dsw_environment_get_points(g_env, &read, &count));
  CHECK(height_of(read, first) < 1.25 && height_of(read, first) > 1.2499);
  CHECK(height_of(read, second) < 1.5 && height_of(read, second) > 1.4999);
  end();
}

static void in_both(void) {
  a_ridge_that_is_held_hides_no_other(1, 3);
  a_ridge_that_is_held_hides_no_other(3, 1);
}

int main(void) {
  use_dimension(2);
  in_both();
  use_dimension(3);
  in_both();
  return check_result();
}
