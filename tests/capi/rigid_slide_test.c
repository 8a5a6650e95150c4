/* Rigid moves that slide as a whole: known places, never worse than stops, and what is left. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../effort.h"
#include "check.h"
#include "draw.h"
#include "fixture.h"

enum { N = 4, MOST = 8 };

static dsw_rigid_motion shift_by(double x, double y, double z) {
  dsw_rigid_motion m;
  memset(&m, 0, sizeof m);
  m.rotation[3] = 1;
  m.translation[0] = x;
  m.translation[1] = y;
  m.translation[2] = z;
  return m;
}

/* Where a motion takes a point. */
static void place(const dsw_rigid_motion *m, const double *at, unsigned dimension, double *to) {
  double q[4], from[3] = {0, 0, 0}, across[3], twice[3], size = 0;
  unsigned k;
  for (k = 0; k < 4; ++k) size += m->rotation[k] * m->rotation[k];
  for (k = 0; k < 4; ++k) q[k] = m->rotation[k] / sqrt(size);
  for (k = 0; k < dimension; ++k) from[k] = at[k] - m->centre[k];
  for (k = 0; k < 3; ++k) {
    const unsigned i = (k + 1) % 3, j = (k + 2) % 3;
    across[k] = q[i] * from[j] - q[j] * from[i];
  }
  for (k = 0; k < 3; ++k) {
    const unsigned i = (k + 1) % 3, j = (k + 2) % 3;
    twice[k] = q[i] * across[j] - q[j] * across[i];
  }
  for (k = 0; k < dimension; ++k) to[k] = at[k] + 2 * (q[3] * across[k] + twice[k]) + m->translation[k];
}

static double distance_sq(const double *a, const double *b, size_t count) {
  double sum = 0;
  size_t i;
  for (i = 0; i < count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

static dsw_move_report move(dsw_scene *scene, dsw_body_id body, const dsw_rigid_motion *m, int slides,
                            uint32_t passes) {
  dsw_move_options o = move_options();
  dsw_move_report report;
  o.flags = slides ? DSW_MOVE_SLIDE_WHOLE : 0;
  o.passes = passes;
  memset(&report, 0, sizeof report);
  CHECK_OK(dsw_body_move_rigid(scene, body, m, &o, &report));
  return report;
}

static dsw_body_id make_plate(dsw_scene *scene, uint32_t flags) {
  const double at[12] = {1, 1, 1, 2, 1, 1, 2, 2, 1, 1, 2, 1};
  const uint32_t corners[6] = {0, 1, 2, 0, 2, 3}, offsets[3] = {0, 3, 6};
  dsw_body_desc d = surface_desc(at, 4, offsets, corners, 2, DSW_LEVEL_FACES);
  dsw_body_id body;
  d.flags = flags;
  CHECK_OK(dsw_body_create(scene, &d, &body));
  return body;
}

/* A plate that falls onto the floor goes on over it, and ends in a corner where it is pressed into one. */
static void a_plate_slides(uint32_t flags) {
  dsw_scene *const scene = make_scene(make_environment(NULL, N, N, N), 0);
  dsw_body_id body = make_plate(scene, flags);
  dsw_rigid_motion m = shift_by(1.25, 0.5, -3), left;
  double now[12];
  size_t count;
  unsigned i;
  dsw_move_report report = move(scene, body, &m, 1, 0);
  const dsw_body_contact *contacts;
  CHECK(report.fraction > 0.3333 && report.fraction <= 1.0 / 3 && report.vertices_stopped == 4);
  CHECK_OK(dsw_body_get_contacts(scene, body, &contacts, &count));
  CHECK(count >= 1 && count == report.contact_count && contacts[0].time == 1.0 / 3);
  CHECK_OK(dsw_body_get_positions(scene, body, now, 4, 0, NULL, &count));
  for (i = 0; i < 4; ++i) {
    const double x = i == 1 || i == 2 ? 3.25 : 2.25, y = i >= 2 ? 2.5 : 1.5;
    CHECK(fabs(now[3 * i] - x) < 1e-9 && fabs(now[3 * i + 1] - y) < 1e-9 && now[3 * i + 2] >= 0 &&
          now[3 * i + 2] < 1e-9);
  }
  CHECK_OK(dsw_body_get_motion_left(scene, body, &left));
  CHECK(fabs(left.translation[2] + 2) < 1e-9 && fabs(left.translation[0]) < 1e-9 && fabs(left.rotation[3]) > 1 - 1e-12);
  m = shift_by(9, 9, -9);
  move(scene, body, &m, 1, 64);
  CHECK_OK(dsw_body_get_positions(scene, body, now, 4, 0, NULL, &count));
  CHECK(now[6] > 4 - 1e-9 && now[7] > 4 - 1e-9 && now[8] < 1e-9 && now[8] >= 0);
  m = shift_by(-1, -1, 1); /* a motion that is free leaves nothing */
  CHECK(move(scene, body, &m, 1, 0).fraction == 1);
  CHECK_OK(dsw_body_get_motion_left(scene, body, &left));
  CHECK(left.rotation[3] == 1 && left.translation[0] == 0 && left.translation[1] == 0 && left.translation[2] == 0);
  end_scene(scene);
}

/* A rod that turns onto the floor lies down on it. */
static void a_rod_lies_down(unsigned dimension) {
  const double rod[6] = {2, 1, 2, 2, 2, 2}, flat[4] = {2, 1, 2, 2};
  const double *const at = dimension == 2 ? flat : rod;
  dsw_scene *const scene = make_scene(dimension == 2 ? make_squares(NULL, N, N) : make_environment(NULL, N, N, N), 0);
  const dsw_body_id body = make_edge_body(scene, at, DSW_LEVEL_EDGES_SWEPT);
  dsw_rigid_motion m = shift_by(0, -2, 0);
  double now[6], target[6];
  size_t count;
  m.rotation[2] = -0.70710678118654757; /* a quarter about z, downwards */
  m.rotation[3] = 0.70710678118654757;
  m.centre[0] = 2;
  m.centre[1] = 1;
  if (dimension == 3) m.centre[2] = 2;
  place(&m, at, dimension, target);
  place(&m, at + dimension, dimension, target + dimension);
  CHECK(move(scene, body, &m, 1, 64).fraction < 1);
  CHECK_OK(dsw_body_get_positions(scene, body, now, 2, 0, NULL, &count));
  CHECK(now[1] >= 0 && now[1] < 1e-3 && now[dimension + 1] >= 0 && now[dimension + 1] < 1e-3);
  CHECK(fabs(now[0] - target[0]) < 0.01 && fabs(now[dimension] - target[dimension]) < 0.01);
  end_scene(scene);
}

static dsw_scene *make_world(unsigned dimension, uint64_t seed) {
  const uint64_t before = g_state;
  dsw_environment *const env = dimension == 2 ? make_squares(NULL, N, N) : make_environment(NULL, N, N, N);
  dsw_scene *const scene = make_scene(env, DSW_FEATURE_BODY_CONTACTS);
  int w;
  unsigned k;
  g_state = seed;
  draw_walls(env, dimension, N, 6);
  for (w = 0; w < 2; ++w) {
    double other[6];
    dsw_body_desc d;
    dsw_body_id id;
    for (k = 0; k < 2 * dimension; ++k) other[k] = between(0.2, N - 0.2);
    d = line_desc(other, 2, 0, DSW_LEVEL_EDGES_SWEPT);
    dsw_body_create(scene, &d, &id);
  }
  g_state = before;
  return scene;
}

typedef struct tally {
  size_t stops, slides, worse, not_free, taken_back, elsewhere;
  double stop_left, slide_left;
} tally;

static void beside_stops(unsigned dimension, double radius, tally *t) {
  const unsigned D = dimension;
  const uint64_t seed = g_state;
  dsw_scene *const stops = make_world(D, seed), *const slides = make_world(D, seed), *const again = make_world(D, seed),
                   *const once = make_world(D, seed);
  double at[3 * MOST], target[3 * MOST], stopped[3 * MOST], slid[3 * MOST], other[3 * MOST];
  const uint32_t corners[3] = {0, 1, 2}, offsets[2] = {0, 3};
  const int is_face = D == 3 && share() < 0.5;
  const size_t count = is_face ? 3 : 2;
  dsw_rigid_motion m, left;
  dsw_body_id body, body_again, body_once;
  dsw_body_desc d;
  dsw_move_report stop, slide;
  size_t i, k, n;
  for (k = 0; k < D * count; ++k) at[k] = k < D ? between(0.5, N - 0.5) : at[k % D] + between(-0.6, 0.6);
  d = is_face ? surface_desc(at, 3, offsets, corners, 1, DSW_LEVEL_FACES) : line_desc(at, 2, 0, DSW_LEVEL_EDGES_SWEPT);
  d.radius = radius;
  if (share() < 0.3) d.flags = DSW_BODY_RIGID;
  memset(&m, 0, sizeof m);
  for (k = 0; k < 3; ++k) m.rotation[k] = D == 3 || k == 2 ? between(-1, 1) : 0;
  m.rotation[3] = between(0, 2);
  if (share() < 0.3) memset(m.rotation, 0, 3 * sizeof *m.rotation);
  for (k = 0; k < D; ++k) {
    m.centre[k] = at[k];
    m.translation[k] = between(-2, 2);
  }
  if (dsw_body_create(stops, &d, &body) == DSW_STATUS_OK) {
    for (i = 0; i < count; ++i) place(&m, at + D * i, D, target + D * i);
    stop = move(stops, body, &m, 0, 0);
    CHECK_OK(dsw_body_get_positions(stops, body, stopped, MOST, 0, NULL, &n));
    CHECK_OK(dsw_body_get_motion_left(stops, body, &left));
    for (i = 0; i < count; ++i) {
      double to[3];
      place(&left, stopped + D * i, D, to);
      CHECK(stop.fraction == 1 || distance_sq(to, target + D * i, D) < 1e-20);
    }
    CHECK_OK(dsw_body_create(slides, &d, &body));
    slide = move(slides, body, &m, 1, 0);
    CHECK_OK(dsw_body_get_positions(slides, body, slid, MOST, 0, NULL, &n));
    CHECK(slide.fraction == stop.fraction && slide.contact_count >= stop.contact_count);
    CHECK_OK(dsw_body_get_motion_left(slides, body, &left));
    for (i = 0; i < count; ++i) {
      double to[3];
      place(&left, slid + D * i, D, to);
      CHECK(slide.fraction == 1 || distance_sq(to, target + D * i, D) < 1e-20);
    }
    for (i = 1; i < count; ++i) { /* it has kept its shape */
      for (k = 0; k < i; ++k) {
        const double was = distance_sq(at + D * i, at + D * k, D), is = distance_sq(slid + D * i, slid + D * k, D);
        CHECK(fabs(was - is) < 1e-12);
      }
    }
    { /* one more motion that does not count leaves no contacts of where it went */
      const uint32_t passes = 1 + (uint32_t)between(0, 12);
      const dsw_body_contact *contacts;
      double further[3 * MOST];
      size_t before;
      CHECK_OK(dsw_body_create(once, &d, &body_once));
      before = move(once, body_once, &m, 1, passes).contact_count;
      CHECK_OK(dsw_body_get_positions(once, body_once, other, MOST, 0, NULL, &n));
      CHECK_OK(dsw_body_destroy(once, body_once));
      CHECK_OK(dsw_body_create(once, &d, &body_once));
      move(once, body_once, &m, 1, passes + 1);
      CHECK_OK(dsw_body_get_positions(once, body_once, further, MOST, 0, NULL, &n));
      if (stop.fraction < 1 && memcmp(further, other, D * count * sizeof *other) == 0) {
        ++t->taken_back;
        CHECK_OK(dsw_body_get_contacts(once, body_once, &contacts, &n));
        while (n-- > before) {
          t->elsewhere += distance_sq(contacts[n].position, other + D * contacts[n].vertex.index, D) > 1e-12;
        }
      }
    }
    CHECK_OK(dsw_body_create(again, &d, &body_again));
    move(again, body_again, &m, 1, 0);
    CHECK_OK(dsw_body_get_positions(again, body_again, other, MOST, 0, NULL, &n));
    CHECK(memcmp(other, slid, D * count * sizeof *slid) == 0);
    if (stop.fraction == 1) {
      CHECK(memcmp(stopped, slid, D * count * sizeof *slid) == 0 && slide.vertices_stopped == 0);
    } else {
      const double before = distance_sq(stopped, target, D * count), after = distance_sq(slid, target, D * count);
      ++t->stops;
      t->slides += after < 0.999 * before;
      t->worse += after > before;
      t->stop_left += sqrt(before);
      t->slide_left += sqrt(after);
      d.positions = slid; /* free, as a new body would have to be */
      CHECK_OK(dsw_body_destroy(again, body_again));
      t->not_free += dsw_body_create(again, &d, &body_again) != DSW_STATUS_OK;
    }
  }
  end_scene(stops);
  end_scene(slides);
  end_scene(again);
  end_scene(once);
}

/* After a deformation nothing is left of a motion: the body may have been pushed. */
static void a_deformation_leaves_nothing(void) {
  grid next = grid_create(N, N, N);
  dsw_scene *const scene = make_scene(make_environment(NULL, N, N, N), DSW_FEATURE_DEFORMING);
  const dsw_body_id body = make_plate(scene, DSW_BODY_RIGID);
  dsw_rigid_motion m = shift_by(0, 0, -3), left;
  size_t i;
  move(scene, body, &m, 0, 0);
  CHECK_OK(dsw_body_get_motion_left(scene, body, &left));
  CHECK(fabs(left.translation[2] + 2) < 1e-9);
  for (i = 0; i < next.point_count; ++i) { /* the floor rises */
    if (next.points[3 * i + 2] == 0) next.points[3 * i + 2] = 0.25;
  }
  CHECK_OK(dsw_environment_deform(dsw_scene_get_environment(scene), next.points, next.point_count, NULL, NULL));
  CHECK_OK(dsw_body_get_motion_left(scene, body, &left));
  CHECK(left.rotation[3] == 1 && left.translation[2] == 0);
  end_scene(scene);
  grid_destroy(&next);
}

enum { SIDES = 12, RINGS = 5, POINTS = SIDES * RINGS + 2, TRIANGLES = 2 * SIDES * RINGS };

static void add_triangle(uint32_t *corners, size_t *count, uint32_t a, uint32_t b, uint32_t c) {
  corners[(*count)++] = a;
  corners[(*count)++] = b;
  corners[(*count)++] = c;
}

/* A ball of 120 triangles: the upper pole, rings downwards, the lower pole. */
static dsw_body_id make_ball(dsw_scene *scene, double radius, double x, double y, double z) {
  const double pi = 3.14159265358979312;
  double at[3 * POINTS];
  uint32_t corners[3 * TRIANGLES], offsets[TRIANGLES + 1], ring, k;
  size_t count = 0, i;
  dsw_body_desc d;
  dsw_body_id body;
  for (i = 0; i < POINTS; ++i) {
    const double polar = i == 0 ? 0 : i == POINTS - 1 ? pi : pi * (double)(1 + (i - 1) / SIDES) / (RINGS + 1);
    const double turn = 2 * pi * (double)((i + SIDES - 1) % SIDES) / SIDES;
    at[3 * i] = x + radius * sin(polar) * cos(turn);
    at[3 * i + 1] = y + radius * sin(polar) * sin(turn);
    at[3 * i + 2] = z + radius * cos(polar);
  }
  for (k = 0; k < SIDES; ++k) {
    const uint32_t next = (k + 1) % SIDES, last = POINTS - 1;
    add_triangle(corners, &count, 0, 1 + k, 1 + next);
    for (ring = 0; ring + 1 < RINGS; ++ring) {
      const uint32_t a = 1 + ring * SIDES, b = a + SIDES;
      add_triangle(corners, &count, a + k, b + k, b + next);
      add_triangle(corners, &count, a + k, b + next, a + next);
    }
    add_triangle(corners, &count, last, last - SIDES + next, last - SIDES + k);
  }
  for (i = 0; i <= TRIANGLES; ++i) offsets[i] = (uint32_t)(3 * i);
  d = surface_desc(at, POINTS, offsets, corners, TRIANGLES, DSW_LEVEL_FACES);
  d.flags = DSW_BODY_RIGID;
  CHECK_OK(dsw_body_create(scene, &d, &body));
  return body;
}

/* A ball that is pressed into a hole touches its edges all over, where only short chords are free: their number ends. */
static void a_ball_in_a_hole_ends(void) {
  dsw_environment *const environment = make_environment(NULL, N, N, 3);
  dsw_scene *const scene = make_scene(environment, DSW_FEATURE_STATISTICS);
  const dsw_body_id body = make_ball(scene, 0.7, 1.6, 1.53, 2);
  dsw_rigid_motion m = shift_by(0, 0, -2);
  dsw_statistics statistics;
  dsw_move_report report;
  uint32_t cell;
  for (cell = 0; cell < N * N; ++cell) {
    if (cell != N + 1) CHECK_OK(set_volume_mark(environment, cell, DSW_MARK_IMPASSABLE));
  }
  memset(&statistics, 0, sizeof statistics);
  statistics.struct_size = sizeof statistics;
  m.rotation[0] = 0.1;
  m.rotation[1] = 0.2;
  m.centre[0] = 1.6;
  m.centre[1] = 1.53;
  m.centre[2] = 2;
  report = move(scene, body, &m, 1, 0);
  CHECK(report.fraction > 0.2 && report.fraction < 0.25 && report.contact_count > 10);
  CHECK_OK(dsw_scene_get_statistics(scene, &statistics));
  CHECK(statistics.casts > 20000 && statistics.casts < 300000);
  end_scene(scene);
}

static void refused(void) {
  dsw_scene *const scene = make_scene(make_environment(NULL, N, N, N), 0);
  const dsw_body_id body = make_plate(scene, 0), none = {7, 1};
  const double targets[12] = {0};
  dsw_move_options o = move_options();
  dsw_rigid_motion m = shift_by(0, 0, 0);
  o.flags = DSW_MOVE_SLIDE_WHOLE;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_body_move(scene, body, targets, 4, 0, &o, NULL));
  o.passes = 65;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_move_rigid(scene, body, &m, &o, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_motion_left(NULL, body, &m));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_motion_left(scene, body, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_motion_left(scene, none, &m));
  end_scene(scene);
}

int main(int argc, char **argv) {
  const int some = effort_of(150), stops = some > 10 ? some : 10; /* fewer take nothing back */
  unsigned dimension;
  a_plate_slides(0);
  a_plate_slides(DSW_BODY_RIGID);
  a_deformation_leaves_nothing();
  a_ball_in_a_hole_ends();
  refused();
  for (dimension = 2; dimension <= 3; ++dimension) {
    tally t;
    int i;
    memset(&t, 0, sizeof t);
    g_state = seed_of(88172645463325252u + dimension);
    a_rod_lies_down(dimension);
    for (i = 0; i < stops; ++i) beside_stops(dimension, i % 5 == 4 ? 0.0625 : 0, &t);
    if (argc > 1 && strcmp(argv[1], "print") == 0) {
      printf(
          "dimension %u: %zu stops, %zu slides, %zu worse, %zu not free, %zu taken back, %zu contacts elsewhere; left "
          "%.3f after stops, %.3f after slides\n",
          dimension, t.stops, t.slides, t.worse, t.not_free, t.taken_back, t.elsewhere, t.stop_left, t.slide_left);
    }
    CHECK(t.stops > 0 && 2 * t.slides > t.stops && t.worse == 0 && t.not_free == 0);
    CHECK(t.taken_back > 0 && t.elsewhere == 0);
  }
  return check_result();
}
