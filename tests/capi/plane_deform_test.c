/* Environments of the plane that bend: what deform_test.c does not say of both dimensions. */
#include <math.h>
#include <string.h>

#include "bending.h"
#include "check.h"

/* A lone impassable point comes through an edge: it is seen from EDGES_SWEPT on. */
static void a_lone_point_is_met_by_swept_edges(void) {
  static const double positions[4] = {1.2, 2.1, 2.8, 2.1};
  static const dsw_level levels[3] = {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT};
  int i;
  for (i = 0; i < 3; ++i) {
    const int meets = levels[i] == DSW_LEVEL_EDGES_SWEPT;
    const dsw_wall_contact *c = NULL;
    dsw_deform_report report;
    size_t count = 0;
    begin(DSW_FEATURE_DEFORMING);
    CHECK_OK(set_vertex_mark(g_env, vertex(2, 0, 2), DSW_MARK_IMPASSABLE));
    make_line(positions, 2, levels[i]);
    point(2, 0, 2)[1] += 0.4;
    report = deform(NULL);
    CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == (meets ? 1u : 0u));
    CHECK_OK(dsw_environment_get_wall_contacts(g_env, &c, &count));
    if (meets)
      CHECK(c->contact.wall.generation == 0 && c->contact.tag == 0 && c->moving.index == vertex(2, 0, 2) &&
            c->contact.normal[1] == 1);
    end();
  }
}

/* Bodies that meet each other are not pushed through one another. */
static void a_body_in_the_way_holds_the_wall(void) {
  static const double low[4] = {1.2, 2.1, 2.8, 2.1}, high[4] = {1.9, 2.3, 2.2, 2.3};
  int meets;
  for (meets = 0; meets < 2; ++meets) {
    dsw_deform_report report;
    dsw_body_id body;
    double now[4];
    size_t count = 0;
    begin(DSW_FEATURE_DEFORMING | (meets ? (uint32_t)DSW_FEATURE_BODY_CONTACTS : 0));
    mark_floor(1);
    body = make_line(low, 2, DSW_LEVEL_EDGES);
    make_line(high, 2, DSW_LEVEL_EDGES);
    raise_row(2, 0.3);
    report = deform(NULL);
    CHECK(report.outcome == (meets ? DSW_DEFORM_HELD : DSW_DEFORM_DONE));
    CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 0, NULL, &count));
    CHECK(now[1] >= 2.1 && now[3] >= 2.1);
    if (meets) CHECK(now[1] + (now[3] - now[1]) * (1.9 - now[0]) / (now[2] - now[0]) < 2.3);
    end();
  }
}

/* A polygon that holds something may take it to a neighbour that was invalid until that same moment: nobody can tell
   the way then, though all are valid afterwards. A refusal says where. */
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
  point(3, 0, 1)[0] = 2.15;
  point(3, 0, 1)[1] = 1.5;
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE);
  CHECK_OK(dsw_environment_is_valid(g_env, volume_at(cell(2, 0, 1)), &valid));
  CHECK(valid == 0);
  point(2, 0, 2)[0] = 1.4;
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_REFUSED && report.invalid_count == 4);
  CHECK_OK(dsw_environment_get_invalid_volumes(g_env, &volumes, &count));
  CHECK(count == 4 && volumes[0].index == cell(1, 0, 1) && volumes[1].index == cell(2, 0, 1) &&
        volumes[2].index == cell(1, 0, 2) && volumes[3].index == cell(2, 0, 2));
  /* By itself the new shape is fine: it is the way there that cannot be told. */
  CHECK_OK(dsw_particle_destroy(g_scene, particle));
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  end();
}

/* Two squares that share one point alone: it goes into either, and what lies there is pushed. Round a point of the
   boundary all polygons are found, from whichever. */
static void points_of_the_boundary(void) {
  static const double at[4][2] = {{0.9, 0.9}, {1.1, 1.1}, {1.95, 1.3}, {2.05, 1.3}};
  /* Polygons 0 1 share a point with 2; 2, 3 and 4 meet at a point of the boundary. */
  static const double start[20] = {0, 0, 1, 0, 1, 1, 0, 1, 2, 1, 2, 2, 1, 2, 3, 1, 3, 2, 2.5, 0};
  static const int64_t cells[14] = {0, 1, 2, 3, 2, 4, 5, 6, 4, 8, 5, 4, 7, 8}, offsets[5] = {0, 4, 8, 11, 14};
  static const uint8_t types[4] = {DSW_CELL_TYPE_QUAD, DSW_CELL_TYPE_QUAD, DSW_CELL_TYPE_TRIANGLE,
                                   DSW_CELL_TYPE_TRIANGLE};
  double points[2][20];
  dsw_environment_desc d;
  dsw_environment *environment = NULL;
  dsw_scene *scene;
  dsw_particle_id particles[4];
  int i, turn;
  memcpy(points[0], start, sizeof start);
  memcpy(points[1], start, sizeof start);
  dsw_environment_desc_init(&d, sizeof d);
  d.dimension = 2;
  d.points = points[0];
  d.point_count = 10;
  d.cell_types = types;
  d.offsets = offsets;
  d.connectivity = cells;
  d.connectivity_count = 14;
  d.volume_count = 4;
  CHECK_OK(dsw_environment_create(NULL, &d, &environment, NULL));
  scene = make_scene(environment, DSW_FEATURE_DEFORMING);
  for (i = 0; i < 4; ++i) CHECK_OK(dsw_particle_create(scene, at[i], no_volume, &particles[i]));
  for (turn = 0; turn < 4; ++turn) {
    dsw_deform_report report;
    double *const next = points[turn % 2 == 0 ? 1 : 0];
    next[4] = next[5] = turn % 2 == 0 ? 0.75 : 1.25;
    next[8] = turn % 2 == 0 ? 1.8 : 2.2; /* over the particles at it, which no wall meets, but their polygons change */
    next[9] = 1.05;
    CHECK_OK(dsw_environment_deform(dsw_scene_get_environment(scene), next, 10, NULL, &report));
    CHECK(report.outcome == DSW_DEFORM_DONE && report.held_count == 0);
    for (i = 0; i < 4; ++i) {
      double now[2];
      dsw_volume_id volume, found;
      CHECK_OK(dsw_particle_get_position(scene, particles[i], now, &volume));
      CHECK_OK(dsw_environment_locate(environment, now, no_volume, &found, NULL));
      CHECK(volume.index == found.index && (i == 0) == (volume.index == 0));
      if (i >= 2) CHECK(now[0] == at[i][0]);
    }
  }
  end_scene(scene);
}

int main(void) {
  use_dimension(2);
  a_lone_point_is_met_by_swept_edges();
  a_body_in_the_way_holds_the_wall();
  refused_where_all_would_be_valid();
  points_of_the_boundary();
  return check_result();
}
