/* Rays and nearest places among walls and bodies: what a caller gets, and arguments that are refused.
   tests/property/rays_test.cpp compares both, and the line of sight, with exact truth. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static dsw_environment *g_env; /* 4 x 2 x 2 cubes, or 4 x 2 squares */
static dsw_scene *g_scene;
static unsigned g_dimension;

/* A point; the height counts in space alone. */
static double *put(double *at, double x, double y, double z) {
  at[0] = x;
  at[1] = y;
  if (g_dimension == 3) at[2] = z;
  return at + g_dimension;
}

static dsw_body_id make_wire(dsw_level level, double radius) {
  static const uint32_t edges[2] = {0, 1};
  double ends[6];
  dsw_body_desc d;
  dsw_body_id id;
  put(put(ends, 2, 0.5, 1), 2, 1.5, 1);
  d = body_desc(ends, 2, edges, 1, level);
  d.radius = radius;
  CHECK_OK(dsw_body_create(g_scene, &d, &id));
  return id;
}

static dsw_cast_options flags_of(uint32_t flags) {
  dsw_cast_options o;
  dsw_cast_options_init(&o, sizeof o);
  o.flags = flags;
  return o;
}

static void a_body_is_met_before_a_wall(uint32_t features) {
  double from[6], to[6];
  dsw_flight f[2], wall;
  dsw_contact_partner p[2];
  const dsw_cast_options plain = flags_of(DSW_CAST_NO_DETAIL);
  dsw_body_id wire;
  g_scene = make_scene(g_env, features);
  wire = make_wire(DSW_LEVEL_EDGES_SWEPT, 0);
  put(put(from, 0.5, 1, 1), 0.5, 1.75, 1);
  put(put(to, 4.5, 1, 1), 4.5, 1.75, 1);
  CHECK_OK(dsw_scene_cast(g_scene, 2, NULL, from, to, 0, NULL, f, p));
  CHECK(f[0].outcome == DSW_OUTCOME_CONTACT && f[0].time == 0.375 && f[0].position[0] == 2 && f[0].position[1] == 1);
  CHECK(f[0].contact.kind == DSW_CONTACT_EDGE && f[0].contact.obstacle.kind == DSW_CELL_NONE);
  CHECK(f[0].contact.normal[0] == -1 && f[0].contact.normal[1] == 0 && f[0].contact.front.generation == 1);
  CHECK(f[0].volume.generation == 1 && f[0].volume.index == f[0].contact.front.index && f[0].volumes_visited >= 2);
  CHECK(p[0].body.index == wire.index && p[0].body.generation == wire.generation && p[0].edge.generation == 1);
  CHECK(p[0].vertex.generation == 0 && p[0].face.generation == 0);
  /* The other one passes the wire, and ends at the side x = 4. */
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from + g_dimension, to + g_dimension, NULL, &wall));
  CHECK(memcmp(&f[1], &wall, sizeof wall) == 0 && p[1].body.generation == 0 && wall.time == 0.875);
  CHECK_OK(dsw_scene_cast(g_scene, 1, NULL, from, to, 0, &plain, f, p));
  CHECK(f[0].outcome == DSW_OUTCOME_CONTACT && f[0].time == 0 && f[0].contact.kind == DSW_CONTACT_NONE);
  CHECK(f[0].volume.generation == 1 && p[0].edge.generation == 1);
  CHECK_OK(dsw_body_set_level(g_scene, wire, DSW_LEVEL_POINTS));
  CHECK_OK(dsw_scene_cast(g_scene, 1, NULL, from, to, 0, NULL, f, p));
  CHECK(p[0].body.generation == 0 && f[0].time == 0.875);
  CHECK_OK(dsw_scene_destroy(g_scene));
}

static void ends_that_touch_do_not_count(void) {
  double from[3], to[3];
  dsw_flight f;
  dsw_contact_partner p;
  const dsw_cast_options open = flags_of(DSW_CAST_OPEN_ENDS);
  g_scene = make_scene(g_env, DSW_FEATURE_BODY_CONTACTS);
  make_wire(DSW_LEVEL_EDGES_SWEPT, 0);
  /* From the wire to the wall at x = 4. */
  put(from, 2, 1, 1);
  put(to, 4, 1, 1);
  CHECK_OK(dsw_scene_cast(g_scene, 1, NULL, from, to, 0, NULL, &f, &p));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.time == 0 && p.edge.generation == 1);
  CHECK_OK(dsw_scene_cast(g_scene, 1, NULL, from, to, 0, &open, &f, &p));
  CHECK(f.outcome == DSW_OUTCOME_REACHED && f.time == 1 && p.body.generation == 0 && f.volume.generation == 0);
  /* From wall to wall: free until the wire. */
  put(from, 0, 1, 1);
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, to, &open, &f));
  CHECK(f.outcome == DSW_OUTCOME_REACHED);
  CHECK_OK(dsw_scene_cast(g_scene, 1, NULL, from, to, 0, &open, &f, &p));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.time == 0.5 && p.edge.generation == 1);
  /* Along a wall, and away from the environment. */
  put(to, 0, 0.25, 1);
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, to, &open, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.time == 0 && f.contact.normal[0] == 1 && f.contact.wall.generation == 1);
  put(to, -1, 1, 1);
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, to, &open, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && f.time == 0 && f.contact.kind == DSW_CONTACT_PLANE);
  put(from, -1, 1, 1);
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, to, &open, &f));
  CHECK(f.outcome == DSW_OUTCOME_OUTSIDE);
  CHECK_OK(dsw_scene_destroy(g_scene));
}

static void a_thick_body_is_met_at_its_radius(void) {
  double from[3], to[3];
  dsw_flight f;
  dsw_nearest n;
  dsw_contact_partner p;
  g_scene = make_scene(g_env, DSW_FEATURE_BODY_CONTACTS);
  make_wire(DSW_LEVEL_EDGES_SWEPT, 0.25);
  put(from, 1, 1, 1);
  put(to, 3, 1, 1);
  CHECK_OK(dsw_scene_cast(g_scene, 1, NULL, from, to, 0, NULL, &f, &p));
  CHECK(p.edge.generation == 1 && f.time <= 0.375 && f.time > 0.375 - 1e-9 && fabs(f.contact.normal[0] + 1) < 1e-9);
  CHECK_OK(dsw_scene_find_nearest(g_scene, from, 1, 0, NULL, HUGE_VAL, &n, &p, NULL, NULL));
  CHECK(p.edge.generation == 1 && n.distance == 0.75 && n.point[0] == 1.75 && n.normal[0] == -1);
  put(from, 1.875, 1, 1);
  CHECK_OK(dsw_scene_find_nearest(g_scene, from, 1, 0, NULL, 0, &n, &p, NULL, NULL));
  CHECK(p.edge.generation == 1 && n.distance == -0.125 && n.point[0] == 1.75);
  CHECK_OK(dsw_scene_destroy(g_scene));
}

/* Less the radius, the distance from the middle of a thick wire has few digits; the normal has all. */
static void a_normal_within_a_thick_body_is_unit(void) {
  double ends[6], at[3];
  dsw_body_desc d;
  dsw_body_id id;
  dsw_nearest n;
  dsw_contact_partner p;
  g_scene = make_scene(g_env, DSW_FEATURE_BODY_CONTACTS);
  put(put(ends, 1.75, 0.75, 1), 2.25, 1.25, 1);
  d = line_desc(ends, 2, 0, DSW_LEVEL_EDGES_SWEPT);
  d.radius = 0.3;
  CHECK_OK(dsw_body_create(g_scene, &d, &id));
  put(at, 2 + 4 * DBL_EPSILON, 1, 1);
  CHECK_OK(dsw_scene_find_nearest(g_scene, at, 1, 0, NULL, HUGE_VAL, &n, &p, NULL, NULL));
  CHECK(p.edge.generation == 1 && fabs(n.distance + 0.3) < 1e-14);
  CHECK(fabs(n.normal[0] - sqrt(0.5)) < 1e-14 && fabs(n.normal[1] + sqrt(0.5)) < 1e-14 && n.normal[2] == 0);
  CHECK(fabs(n.point[0] - 2 - 0.3 * sqrt(0.5)) < 1e-14);
  CHECK_OK(dsw_scene_destroy(g_scene));
}

static void what_is_nearest_is_a_wall_or_a_body(void) {
  double at[9];
  dsw_nearest n[3];
  dsw_contact_partner p[3];
  dsw_volume_id volumes[3];
  dsw_location locations[3];
  g_scene = make_scene(g_env, DSW_FEATURE_LIVE_CHANGES);
  make_wire(DSW_LEVEL_EDGES_SWEPT, 0);
  put(put(put(at, 1.75, 1, 1), 0.25, 1, 1), 9, 1, 1);
  CHECK_OK(dsw_scene_find_nearest(g_scene, at, 3, 0, NULL, HUGE_VAL, n, p, volumes, locations));
  CHECK(n[0].distance == 0.25 && n[0].point[0] == 2 && n[0].normal[0] == -1 && n[0].cell.kind == DSW_CELL_NONE);
  CHECK(p[0].edge.generation == 1 && p[1].body.generation == 0 && p[2].body.generation == 0);
  CHECK(n[1].distance == 0.25 && n[1].cell.kind == DSW_CELL_FACE && n[2].distance == HUGE_VAL);
  CHECK(locations[2] == DSW_LOCATION_OUTSIDE && volumes[0].generation == 1);
  CHECK_OK(dsw_scene_find_nearest(g_scene, at, 1, 0, volumes, 0.125, n, p, NULL, NULL));
  CHECK(n[0].distance == HUGE_VAL && p[0].body.generation == 0);
  CHECK_OK(dsw_scene_find_nearest(g_scene, at, 1, 0, NULL, 0.25, n, p, NULL, NULL));
  CHECK(n[0].distance == 0.25 && p[0].edge.generation == 1);
  CHECK_OK(dsw_scene_destroy(g_scene));
}

static void bad_questions_are_refused(void) {
  double at[3] = {1, 1, 1}, bad[3] = {0, NAN, 0};
  dsw_cast_options o = flags_of(0x8);
  dsw_flight f;
  dsw_nearest n;
  dsw_contact_partner p;
  dsw_particle_id id;
  memset(&f, 0x55, sizeof f);
  memset(&n, 0x55, sizeof n);
  g_scene = make_scene(g_env, 0);
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_cast(g_scene, 1, NULL, at, at, 0, &o, &f, &p));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_cast(g_scene, 1, NULL, bad, at, 0, NULL, &f, &p));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_cast(g_scene, 1, NULL, at, bad, 0, NULL, &f, &p));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_scene_cast(g_scene, 1, &stale_volume, at, at, 0, NULL, &f, &p));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_cast(g_scene, 1, NULL, at, at, 0, NULL, NULL, &p));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_cast(g_scene, 1, NULL, at, at, 0, NULL, &f, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_cast(NULL, 1, NULL, at, at, 0, NULL, &f, &p));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_scene_find_nearest(g_scene, at, 1, 0, NULL, -1, &n, &p, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_scene_find_nearest(g_scene, at, 1, 0, NULL, NAN, &n, &p, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_find_nearest(g_scene, bad, 1, 0, NULL, 1, &n, &p, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_scene_find_nearest(g_scene, at, 1, 0, &stale_volume, 1, &n, &p, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_find_nearest(g_scene, at, 1, 0, NULL, 1, &n, NULL, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_find_nearest(g_scene, at, 1, 0, NULL, 1, NULL, &p, NULL, NULL));
  CHECK(((unsigned char *)&f)[0] == 0x55 && ((unsigned char *)&n)[0] == 0x55);
  CHECK_OK(dsw_scene_cast(g_scene, 0, NULL, NULL, NULL, 0, NULL, NULL, NULL));
  CHECK_OK(dsw_scene_find_nearest(g_scene, NULL, 0, 0, NULL, 1, NULL, NULL, NULL, NULL));
  /* Particles have no ends that could be open. */
  o = flags_of(DSW_CAST_OPEN_ENDS);
  put(at, 1.25, 1.25, 1.25);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &id));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_particle_move(g_scene, id, at, &o, &f));
  CHECK_OK(dsw_scene_destroy(g_scene));
}

static void run(unsigned dimension) {
  g_dimension = dimension;
  check_in(dimension == 3 ? "in space" : "in the plane");
  g_env = dimension == 3 ? make_environment(NULL, 4, 2, 2) : make_squares(NULL, 4, 2);
  a_body_is_met_before_a_wall(0);
  a_body_is_met_before_a_wall(DSW_FEATURE_BODY_CONTACTS);
  ends_that_touch_do_not_count();
  a_thick_body_is_met_at_its_radius();
  a_normal_within_a_thick_body_is_unit();
  what_is_nearest_is_a_wall_or_a_body();
  bad_questions_are_refused();
  CHECK_OK(dsw_environment_destroy(g_env));
}

int main(void) {
  run(3);
  run(2);
  return check_result();
}
