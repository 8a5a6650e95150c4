/* Bodies with a radius: what a caller gets, arguments that are refused, what is too near, where a move stops, gaps. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "check.h"
#include "stage.h"

/* What a distance may lack, as a share of the radii. */
static const double SHARE = 0x1p-31;

/* Along y, 1 from the outer boundary at x = 0 and more from the rest. */
static const double g_rod[6] = {1, 1.5, 1.5, 1, 2.5, 1.5};

/* A stage whose bodies can meet each other. */
static void begin_meeting(unsigned dimension) {
  begin_stage(dimension);
  end_scene(g_scene);
  g_env = dimension == 3 ? make_environment(NULL, N, N, 3) : make_squares(NULL, N, N);
  g_scene = make_scene(g_env, DSW_FEATURE_BODY_CONTACTS);
}

static dsw_body_desc thick_desc(const double *positions, size_t count, double radius) {
  dsw_body_desc d = line_desc(positions, count, 0, DSW_LEVEL_EDGES_SWEPT);
  d.stride_bytes = g_stride;
  d.radius = radius;
  return d;
}

static dsw_body_id make_thick(const double *positions, size_t count, double radius) {
  const dsw_body_desc d = thick_desc(positions, count, radius);
  dsw_body_id body = {0, 0};
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  return body;
}

static double radius_of(const dsw_scene *scene, dsw_body_id body) {
  double radius = -1;
  CHECK_OK(dsw_body_get_radius(scene, body, &radius));
  return radius;
}

static double gap_of(dsw_body_id body, double limit) {
  double gap = -99;
  CHECK_OK(dsw_body_find_least_gap(g_scene, body, limit, &gap));
  CHECK(gap <= limit);
  return gap;
}

/* A lower bound that is close to the gap itself. */
static int is_gap(double found, double gap, double radii) {
  return found <= gap && found >= gap - 4 * SHARE * (gap + radii);
}

/* The one edge that was too near. */
static int is_offending(uint32_t a, uint32_t b) {
  const uint32_t *pairs = NULL;
  size_t count = 99;
  CHECK_OK(dsw_scene_get_offending_edges(g_scene, &pairs, &count));
  return count == 1 && pairs[0] == a && pairs[1] == b;
}

static void a_radius_is_read_and_changed(unsigned dimension) {
  dsw_body_id rod;
  begin_stage(dimension);
  rod = make_thick(g_rod, 2, 0.25);
  CHECK(radius_of(g_scene, rod) == 0.25);
  CHECK(is_gap(gap_of(rod, 2), 0.75, 0.25));
  CHECK(gap_of(rod, 0.5) == 0.5);
  CHECK_OK(dsw_body_set_radius(g_scene, rod, 0.5));
  CHECK(radius_of(g_scene, rod) == 0.5 && is_gap(gap_of(rod, 2), 0.5, 0.5));
  CHECK_OK(dsw_body_set_radius(g_scene, rod, 1)); /* the distance to the wall */
  CHECK(is_gap(gap_of(rod, 2), 0, 1));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_radius(g_scene, rod, 1.0001));
  CHECK(radius_of(g_scene, rod) == 1 && is_offending(0, 1));
  CHECK_OK(dsw_body_set_radius(g_scene, rod, 0));
  CHECK(radius_of(g_scene, rod) == 0 && is_gap(gap_of(rod, 2), 1, 0));
  end_stage();
}

static void a_body_too_near_is_not_created(unsigned dimension) {
  const double bent[9] = {1, 1.5, 1.5, 1.5, 1.5, 1.5, 3.875, 1.5, 1.5}, alone[3] = {3.875, 1.5, 1.5};
  dsw_body_desc d;
  begin_stage(dimension);
  d = thick_desc(bent, 3, 0.25);
  refuses(DSW_STATUS_OCCUPIED, &d, "");
  CHECK(is_offending(1, 2));
  d = thick_desc(alone, 1, 0.25);
  refuses(DSW_STATUS_OCCUPIED, &d, "");
  CHECK(is_offending(0, 0));
  d = thick_desc(bent, 3, 0.125); /* at its distance it may be */
  make_thick(bent, 3, d.radius);
  CHECK(is_offending(0, 0) == 0);
  end_stage();
}

/* A level covers parts, and these are thick. */
static void only_parts_of_the_level_are_thick(unsigned dimension) {
  const double beside[6] = {1.25, 1.5, 1.5, 2.5, 2.75, 1.5}; /* the pillar's corner (2, 2) is 0.18 away */
  dsw_body_desc d;
  dsw_body_id body;
  begin_stage(dimension);
  mark_pillar(DSW_MARK_IMPASSABLE);
  d = thick_desc(beside, 2, 0.25);
  refuses(DSW_STATUS_OCCUPIED, &d, "");
  CHECK(is_offending(0, 1));
  d.level = DSW_LEVEL_POINTS;
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES));
  CHECK(is_offending(0, 1));
  end_stage();
}

static void a_move_stops_at_the_radius(unsigned dimension) {
  const double radius = 0.25, to[6] = {3.9375, 1.5, 1.5, 3.9375, 2.5, 1.5}, on[6] = {3.5, 1.5, 1.5, 3.5, 2.5, 1.5};
  double p[6];
  dsw_body_id rod;
  dsw_move_report r;
  int i;
  begin_stage(dimension);
  rod = make_thick(g_rod, 2, radius);
  r = move(rod, on, 2, NULL);
  CHECK(r.vertices_stopped == 0 && r.contact_count == 0 && is_at(rod, on, 2));
  CHECK(is_gap(gap_of(rod, 1), 0.25, radius));
  r = move(rod, to, 2, NULL);
  CHECK(r.vertices_stopped == 2 && r.contact_count != 0);
  CHECK(positions_of(rod, p, 2) == 2);
  for (i = 0; i < 6; i += 3) CHECK(p[i] > 3.74 && 4 - p[i] >= radius * (1 - SHARE));
  CHECK(gap_of(rod, radius) >= -SHARE * radius && gap_of(rod, radius) < 0.01);
  r = move(rod, g_rod, 2, NULL); /* and away again */
  CHECK(r.vertices_stopped == 0 && is_at(rod, g_rod, 2));
  end_stage();
}

/* The pillar is in the way of the edge, not of its ends. */
static void a_move_stops_at_a_corner(unsigned dimension) {
  const double from[6] = {0.5, 0.5, 1.5, 0.5, 2.5, 1.5}, to[6] = {2.75, 0.5, 1.5, 2.75, 2.5, 1.5};
  double p[6];
  dsw_body_id rod;
  dsw_move_report r;
  begin_stage(dimension);
  mark_pillar(DSW_MARK_IMPASSABLE);
  rod = make_thick(from, 2, 0.25);
  r = move(rod, to, 2, NULL);
  CHECK(r.vertices_stopped != 0 && r.contact_count != 0);
  CHECK(gap_of(rod, 0.25) >= -SHARE * 0.25);
  CHECK(positions_of(rod, p, 2) == 2 && p[0] > 0.5 && p[3] < 2);
  end_stage();
}

static void both_radii_count(unsigned dimension) {
  const double first[6] = {1, 1.5, 1.5, 2, 1.5, 1.5}, second[6] = {1, 2, 1.5, 2, 2, 1.5};
  const double to[6] = {1, 1.25, 1.5, 2, 1.25, 1.5};
  double p[6];
  dsw_body_desc d;
  dsw_body_id bodies[2];
  begin_meeting(dimension);
  bodies[0] = make_thick(first, 2, 0.125);
  d = thick_desc(second, 2, 0.4375);
  refuses(DSW_STATUS_OCCUPIED, &d, "");
  CHECK(is_offending(0, 1));
  bodies[1] = make_thick(second, 2, 0.25);
  CHECK(is_gap(gap_of(bodies[0], 1), 0.125, 0.375) && is_gap(gap_of(bodies[1], 1), 0.125, 0.375));
  CHECK_OK(dsw_body_set_radius(g_scene, bodies[0], 0.25));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_radius(g_scene, bodies[0], 0.3125));
  CHECK_OK(dsw_body_set_radius(g_scene, bodies[0], 0.125));
  move(bodies[1], to, 2, NULL);
  CHECK(gap_of(bodies[1], 0.375) >= -SHARE * 0.375 && gap_of(bodies[1], 0.375) < 0.01);
  CHECK(positions_of(bodies[1], p, 2) == 2 && p[1] >= 1.5 + 0.375 * (1 - SHARE));
  /* Bodies that do not see each other may be anywhere. */
  CHECK_OK(dsw_body_set_filter(g_scene, bodies[1], 1, 2));
  CHECK_OK(dsw_body_set_radius(g_scene, bodies[0], 0.5));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_filter(g_scene, bodies[1], 0, 0));
  end_stage();
}

/* Parts that a way of at most 4 radii joins may be nearer than 2 radii. */
static void a_body_is_thick_for_itself(unsigned dimension) {
  const double hook[18] = {0.75, 1, 1.5, 1.75, 1, 1.5, 3.2, 0.7, 1.5, 3.2, 1.8, 1.5, 1.75, 1.5, 1.5, 0.75, 1.5, 1.5};
  const double fine[15] = {1, 1, 1.5, 1.125, 1, 1.5, 1.25, 1, 1.5, 1.375, 1, 1.5, 1.5, 1, 1.5};
  dsw_body_desc d;
  dsw_body_id body;
  begin_meeting(dimension);
  d = thick_desc(hook, 6, 0.3125);
  CHECK_OK(dsw_body_create(g_scene, &d, &body)); /* it does not meet itself */
  CHECK_OK(dsw_body_destroy(g_scene, body));
  d.flags = DSW_BODY_SELF_CONTACTS;
  refuses(DSW_STATUS_OCCUPIED, &d, "");
  d.radius = 0.25;
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  CHECK(is_gap(gap_of(body, 1), 0, 0.5));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_radius(g_scene, body, 0.26));
  CHECK_OK(dsw_body_destroy(g_scene, body));
  d = thick_desc(fine, 5, 0.25);
  d.flags = DSW_BODY_SELF_CONTACTS;
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  end_stage();
}

static size_t find(dsw_body_id body, const dsw_near_options *o, const dsw_near_row **rows) {
  size_t found = 98, count = 99;
  CHECK_OK(dsw_body_find_near_rows(g_scene, body, o, &found));
  CHECK_OK(dsw_body_get_near_rows(g_scene, body, rows, &count));
  CHECK(found == count);
  return count;
}

/* Near rows know the radii. */
static void rows_have_both_radii(void) {
  const double first[6] = {1, 1.5, 1.5, 2, 1.5, 1.5}, second[6] = {1.5, 1, 2, 1.5, 2, 2};
  const double beside[6] = {3.75, 1.5, 1.5, 3.5, 2.5, 1.5};
  const dsw_near_row *rows = NULL;
  dsw_near_options o;
  dsw_body_id bodies[2];
  begin_meeting(3);
  bodies[0] = make_thick(first, 2, 0.0625);
  bodies[1] = make_thick(second, 2, 0.1875);
  dsw_near_options_init(&o, sizeof o);
  o.margin = 0.25;
  CHECK(find(bodies[0], &o, &rows) == 1 && rows[0].distance == 0.5 && rows[0].gap == 0.25 &&
        rows[0].body.index == bodies[1].index);
  CHECK(find(bodies[1], &o, &rows) == 1 && rows[0].gap == 0.25);
  o.margin = 0.1875;
  CHECK(find(bodies[0], &o, &rows) == 0 && find(bodies[1], &o, &rows) == 0);
  o.radius = 0.0625; /* added to that of the body */
  CHECK(find(bodies[0], &o, &rows) == 1 && rows[0].gap == 0.1875);
  CHECK_OK(dsw_body_destroy(g_scene, bodies[0]));
  bodies[0] = make_thick(beside, 2, 0.125);
  CHECK(find(bodies[0], &o, &rows) == 1 && rows[0].distance == 0.25 && rows[0].gap == 0.0625);
  o.radius = 0;
  CHECK(find(bodies[0], &o, &rows) == 1 && rows[0].gap == 0.125);
  o.margin = 0.0625;
  CHECK(find(bodies[0], &o, &rows) == 0);
  end_stage();
}

static void rows_of_a_body_with_itself_have_its_radius_twice(void) {
  const double hook[12] = {1.25, 1.25, 1.5, 2.75, 1.25, 1.5, 2.75, 1.75, 1.5, 2, 1.5, 1.5};
  const dsw_near_row *rows = NULL;
  dsw_near_options o;
  dsw_body_desc d;
  dsw_body_id body;
  begin_meeting(3);
  d = thick_desc(hook, 4, 0.03125);
  d.flags = DSW_BODY_SELF_CONTACTS;
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  dsw_near_options_init(&o, sizeof o);
  o.margin = 0.1875;
  CHECK(find(body, &o, &rows) == 1 && rows[0].distance == 0.25 && rows[0].gap == 0.1875);
  o.margin = 0.125;
  o.radius = 0.03125;
  CHECK(find(body, &o, &rows) == 1 && rows[0].gap == 0.125);
  end_stage();
}

static void without_a_radius_all_is_as_before(unsigned dimension) {
  const double to[6] = {5, 1.5, 1.5, 5, 2.5, 1.5};
  double p[6];
  dsw_body_desc d;
  dsw_body_id rod;
  dsw_move_report r;
  begin_stage(dimension);
  d = thick_desc(g_rod, 2, 0.25);
  d.struct_size = (uint32_t)offsetof(dsw_body_desc, radius); /* of a program that does not know the member */
  CHECK_OK(dsw_body_create(g_scene, &d, &rod));
  CHECK(radius_of(g_scene, rod) == 0);
  r = move(rod, to, 2, NULL);
  CHECK(r.vertices_stopped == 2 && positions_of(rod, p, 2) == 2);
  CHECK(p[0] < 4 && p[0] > 3.9999 && p[3] < 4 && p[3] > 3.9999);
  CHECK(gap_of(rod, 1) >= 0 && gap_of(rod, 1) < 0.0001 && gap_of(rod, 0) == 0);
  end_stage();
}

static void a_radius_is_saved(unsigned dimension) {
  dsw_scene *loaded = NULL;
  dsw_body_id rod;
  void *block;
  size_t size = 0;
  begin_stage(dimension);
  rod = make_thick(g_rod, 2, 0.3125);
  CHECK_OK(dsw_scene_save(g_scene, NULL, 0, &size));
  block = malloc(size);
  CHECK_OK(dsw_scene_save(g_scene, block, size, &size));
  CHECK_OK(dsw_scene_load(g_env, block, size, &loaded));
  CHECK(radius_of(loaded, rod) == 0.3125);
  free(block);
  CHECK_OK(dsw_scene_destroy(loaded));
  end_stage();
}

static void arguments_that_are_refused(unsigned dimension) {
  static const double bad[] = {-0.5, NAN, INFINITY};
  dsw_body_id rod, stale, null_body = {0, 0};
  double out = 99;
  size_t i;
  begin_stage(dimension);
  rod = make_thick(g_rod, 2, 0.25);
  stale = rod;
  ++stale.generation;
  for (i = 0; i < sizeof bad / sizeof *bad; ++i) {
    const dsw_body_desc d = thick_desc(g_rod, 2, bad[i]);
    refuses(DSW_STATUS_OUT_OF_RANGE, &d, "desc->radius is ");
    CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_set_radius(g_scene, rod, bad[i]));
    CHECK_MESSAGE("dsw_body_set_radius: radius is ");
    CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_find_least_gap(g_scene, rod, bad[i], &out));
    CHECK_MESSAGE("limit is ");
  }
  CHECK(radius_of(g_scene, rod) == 0.25);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_set_radius(NULL, rod, 0.5));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_radius(NULL, rod, &out));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_radius(g_scene, rod, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_find_least_gap(NULL, rod, 1, &out));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_find_least_gap(g_scene, rod, 1, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_set_radius(g_scene, stale, 0.5));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_radius(g_scene, stale, &out));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_find_least_gap(g_scene, stale, 1, &out));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_set_radius(g_scene, null_body, 0.5));
  CHECK(out == 99 && radius_of(g_scene, rod) == 0.25);
  CHECK_OK(dsw_body_destroy(g_scene, rod));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_radius(g_scene, rod, &out));
  end_stage();
}

int main(void) {
  unsigned dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    a_radius_is_read_and_changed(dimension);
    a_body_too_near_is_not_created(dimension);
    only_parts_of_the_level_are_thick(dimension);
    a_move_stops_at_the_radius(dimension);
    a_move_stops_at_a_corner(dimension);
    both_radii_count(dimension);
    a_body_is_thick_for_itself(dimension);
    without_a_radius_all_is_as_before(dimension);
    a_radius_is_saved(dimension);
    arguments_that_are_refused(dimension);
  }
  rows_have_both_radii();
  rows_of_a_body_with_itself_have_its_radius_twice();
  return check_result();
}
