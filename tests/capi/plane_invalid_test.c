/* Planar environments that bend until their polygons are invalid. */
#include <string.h>

#include "bending_squares.h"
#include "check.h"

static void steps_are_halved_where_cells_would_fold(void) {
  const double at[2] = {2.5, 2.5};
  dsw_particle_id particle;
  dsw_deform_report report;
  dsw_volume_id volume;
  size_t i;
  begin(DSW_FEATURE_DEFORMING);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  for (i = 0; i < POINTS; ++i) g_points[g_next][2 * i] += 1.5; /* each vertex further than a square is wide */
  report = deform(NULL);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.steps > 1 && report.contact_count == 0);
  CHECK_OK(dsw_particle_get(g_scene, particle, NULL, &volume));
  CHECK(volume.index == square(1, 2) || volume.index == square(0, 2));
  end();
}

static void invalid_polygons(void) {
  const double at[2] = {2.5, 2.5}, from[2] = {2.5, 2.5}, to[2] = {2.5, 0.5};
  dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
  const dsw_volume_id start = volume_at(square(2, 2));
  const dsw_volume_id *invalid = NULL;
  dsw_particle_id particle;
  dsw_deform_report report;
  dsw_flight flight;
  double before[2 * POINTS];
  size_t count = 0;
  int valid = -1, impassable = 0;
  begin(DSW_FEATURE_DEFORMING);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  /* Far from the particle: it goes through, and counts as impassable. */
  point(2, 1)[1] = 2.6;
  o.invalid = DSW_INVALID_REFUSE;
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.invalid_count == 0);
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(square(2, 2)), &valid));
  CHECK(valid == 1);
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(square(2, 1)), &valid));
  CHECK(valid == 0);
  CHECK_FAILS(DSW_STATUS_INVALID_CELL, dsw_environment_check(g_env, NULL));
  CHECK_OK(dsw_environment_cast_segments(g_env, 1, &start, from, to, 0, NULL, &flight));
  CHECK(flight.outcome == DSW_OUTCOME_CONTACT && flight.behind.index == square(2, 1) &&
        flight.obstacle == DSW_CELL_VOLUME && flight.position[1] >= 2);
  CHECK_OK(dsw_environment_is_impassable(g_env, cell_at(DSW_CELL_VOLUME, square(2, 1), 0), &impassable));
  CHECK(impassable == 1);
  point(2, 1)[1] = 1;
  report = deform(&o);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  /* Through the particle's own square: refused, or held. */
  point(2, 2)[1] = 3.5;
  memcpy(before, g_points[g_next], sizeof before);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_REFUSED && report.fraction == 0 && report.invalid_count >= 1);
  CHECK(memcmp(before, g_points[g_next], sizeof before) == 0);
  CHECK_OK(dsw_scene_get_invalid_volumes(g_scene, &invalid, &count));
  CHECK(count == report.invalid_count && invalid[0].generation == 1);
  o.invalid = DSW_INVALID_HOLD;
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_HELD && report.held_count == 1 && point(2, 2)[1] < 3.5);
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(square(2, 2)), &valid));
  CHECK(valid == 1);
  end();
}

/* A polygon that holds something may take it to a neighbour that was invalid until that same moment: nobody can tell the way then, though all
   are valid afterwards. A refusal says where. */
static void refused_where_all_would_be_valid(void) {
  const double at[2] = {1.75, 1.7};
  dsw_deform_options o = deform_options_of(DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
  const dsw_volume_id *volumes = NULL;
  dsw_particle_id particle;
  dsw_deform_report report;
  size_t count = 0;
  int valid = -1;
  begin(DSW_FEATURE_DEFORMING);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &particle));
  o.invalid = DSW_INVALID_REFUSE;
  o.most_halvings = 1;
  point(3, 1)[0] = 2.15;
  point(3, 1)[1] = 1.5;
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE);
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(square(2, 1)), &valid));
  CHECK(valid == 0);
  point(2, 2)[0] = 1.4;
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_REFUSED && report.invalid_count == 4);
  CHECK_OK(dsw_scene_get_invalid_volumes(g_scene, &volumes, &count));
  CHECK(count == 4 && volumes[0].index == square(1, 1) && volumes[1].index == square(2, 1) &&
        volumes[2].index == square(1, 2) && volumes[3].index == square(2, 2));
  /* By itself the new shape is fine: it is the way there that cannot be told. */
  CHECK_OK(dsw_particle_destroy(g_scene, particle));
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  end();
}

int main(void) {
  steps_are_halved_where_cells_would_fold();
  invalid_polygons();
  refused_where_all_would_be_valid();
  return check_result();
}
