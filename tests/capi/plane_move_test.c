/* Moves of bodies in the plane: what is not so in space, or has other arguments there. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "stage.h"

/* A marked vertex inside of what the edge sweeps, and the pillar there alone: from EDGES_SWEPT on. */
static void small_obstacles_are_met_when_swept(void) {
  static const double from[6] = {0.5, 0.25, 0, 3.75, 1.75, 0}, to[6] = {0.5, 3.75, 0, 3.75, 1.75, 0};
  const uint32_t first = 0;
  int level, small;
  for (small = 0; small < 2; ++small) {
    for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
      const dsw_body_id body = make_line(from, 2, (dsw_level)level);
      dsw_move_options o = move_options();
      dsw_move_report r;
      const dsw_body_contact *c = NULL;
      o.order = &first;
      o.order_count = 1;
      CHECK_OK(small != 0 ? mark_point(2, 2, DSW_MARK_IMPASSABLE) : mark_cell(g_pillar + N, DSW_MARK_IMPASSABLE));
      r = move(body, to, 2, &o);
      if (level != DSW_LEVEL_EDGES_SWEPT && (small != 0 || level == DSW_LEVEL_POINTS)) {
        CHECK(r.vertices_stopped == 0 && r.contact_count == 0 && is_at(body, to, 2));
      } else if (level == DSW_LEVEL_EDGES_SWEPT) {
        CHECK(r.vertices_stopped == 1 && r.contact_count == 1 && contacts_of(body, &c) == 1);
        CHECK(c->contact.kind == DSW_CONTACT_VERTEX && c->contact.obstacle.kind == DSW_CELL_VERTEX);
        CHECK(c->contact.obstacle.index == point_at(2, 2));
        CHECK(c->contact.marked_kind == (small != 0 ? DSW_CELL_VERTEX : DSW_CELL_VOLUME));
        CHECK((c->contact.wall.generation == 0) == (small != 0) && (c->contact.tag == 0) == (small != 0));
        CHECK(c->contact.normal[1] < 0 && c->contact.normal[2] == 0 && c->edge.generation == 1);
      }
      CHECK_OK(dsw_body_destroy(g_scene, body));
      CHECK_OK(small != 0 ? mark_point(2, 2, DSW_MARK_PASSABLE) : mark_cell(g_pillar + N, DSW_MARK_PASSABLE));
    }
  }
}

static void strides_are_those_of_the_plane(void) {
  static const double targets[4] = {3.25, 0.25, 3.25, 3.75}, bad[4] = {3.25, 0.25, NAN, 3.75};
  const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT);
  dsw_move_report r;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_body_move(g_scene, body, targets, 2, 8, NULL, &r));
  CHECK_MESSAGE("from 16 on");
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_body_move(g_scene, body, bad, 2, 0, NULL, &r));
  CHECK_MESSAGE("targets[1][0] is nan");
  CHECK_OK(dsw_body_move(g_scene, body, targets, 2, 0, NULL, &r));
  CHECK(is_at(body, g_right, 2));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void many_bodies_move(void) {
  const double from[6] = {1.5, 1.25, NAN, 0.5, 0.5, NAN},
               to[12] = {2.5, 1.75, NAN, 0.5, 3.5, NAN, 1.25, 1.5, NAN, 1.25, 3, NAN};
  dsw_body_id bodies[3];
  dsw_move_report reports[3];
  double p[6];
  int k;
  mark_pillar(DSW_MARK_IMPASSABLE);
  for (k = 0; k < 2; ++k) bodies[k] = make_line(from + 3 * k, 1, DSW_LEVEL_POINTS);
  bodies[2] = make_line(g_left, 2, DSW_LEVEL_EDGES);
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_move_bodies(g_scene, bodies, 3, to, 3, 24, NULL, reports));
  CHECK_OK(dsw_scene_move_bodies(g_scene, bodies, 3, to, 4, 24, NULL, reports));
  CHECK(reports[0].vertices_stopped == 1 && reports[1].vertices_stopped == 0 && reports[2].vertices_stopped == 0);
  CHECK(positions_of(bodies[1], p, 1) == 1 && p[0] == 0.5 && p[1] == 3.5);
  CHECK(positions_of(bodies[2], p, 2) == 2 && p[1] == 1.5 && p[4] == 3);
  for (k = 0; k < 3; ++k) CHECK_OK(dsw_body_destroy(g_scene, bodies[k]));
  mark_pillar(DSW_MARK_PASSABLE);
}

static void rigid_motions_stay_in_the_plane(void) {
  const double points[6] = {1.5, 1.5, 0, 1.5, 3.5, 0}, turned[6] = {1.5, 1.5, 0, 3.5, 1.5, 0};
  const double wall = 0.78539816339744830962; /* the angle at which the edge meets (2, 2) */
  const dsw_body_id body = make_line(points, 2, DSW_LEVEL_EDGES_SWEPT);
  dsw_rigid_motion m, bad[5];
  dsw_move_report r;
  double p[6];
  int k;
  memset(&m, 0, sizeof m);
  m.rotation[2] = -1; /* a quarter turn to the right */
  m.rotation[3] = 1;
  m.centre[0] = m.centre[1] = 1.5;
  for (k = 0; k < 5; ++k) bad[k] = m;
  bad[0].rotation[0] = 1e-300;
  bad[1].rotation[1] = -1;
  bad[2].translation[2] = 0.5;
  bad[3].centre[2] = 1;
  bad[4].rotation[2] = bad[4].rotation[3] = 0;
  for (k = 0; k < 5; ++k) CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_move_rigid(g_scene, body, &bad[k], NULL, NULL));
  bad[0] = m;
  bad[0].centre[2] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_body_move_rigid(g_scene, body, &bad[0], NULL, NULL));
  CHECK(is_at(body, points, 2));
  CHECK_OK(dsw_body_move_rigid(g_scene, body, &m, NULL, &r));
  CHECK(r.fraction == 1 && r.vertices_stopped == 0 && positions_of(body, p, 2) == 2);
  for (k = 0; k < 6; ++k) CHECK(fabs(p[k] - turned[k]) < 1e-15);
  m.rotation[2] = 1;
  CHECK_OK(dsw_body_move_rigid(g_scene, body, &m, NULL, &r));
  mark_pillar(DSW_MARK_IMPASSABLE);
  m.rotation[2] = -1;
  CHECK_OK(dsw_body_move_rigid(g_scene, body, &m, NULL, &r));
  CHECK(r.fraction < 1 && r.fraction > 0 && r.contact_count >= 1 && positions_of(body, p, 2) == 2);
  CHECK(fabs(hypot(p[3] - p[0], p[4] - p[1]) - 2) < 1e-14 && atan2(p[3] - p[0], p[4] - p[1]) <= wall);
  CHECK(wall - atan2(p[3] - p[0], p[4] - p[1]) < 1e-15);
  memset(&m, 0, sizeof m);
  m.rotation[3] = 1;
  m.translation[0] = -0.25;
  CHECK_OK(dsw_body_move_rigid(g_scene, body, &m, NULL, &r));
  CHECK(r.fraction == 1);
  mark_pillar(DSW_MARK_PASSABLE);
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

int main(void) {
  begin_stage(2);
  small_obstacles_are_met_when_swept();
  strides_are_those_of_the_plane();
  many_bodies_move();
  rigid_motions_stay_in_the_plane();
  end_stage();
  return check_result();
}
