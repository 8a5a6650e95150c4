/* Rigid bodies at once: known fractions, beside all pairs (dsw_sweep_rigid_pairs), and that no numbering matters. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../effort.h"
#include "check.h"
#include "draw.h"
#include "fixture.h"

enum { N = 4, BODIES = 3, MOST_PAIRS = 8192 };

static unsigned D;
static dsw_scene *make_room(void) {
  return make_scene(D == 2 ? make_squares(NULL, N, N) : make_environment(NULL, N, N, N), DSW_FEATURE_BODY_CONTACTS);
}

static dsw_rigid_motion turn_about_z(double degrees, double x, double y) {
  dsw_rigid_motion m;
  memset(&m, 0, sizeof m);
  m.rotation[2] = sin(degrees * 0.00872664625997165);
  m.rotation[3] = cos(degrees * 0.00872664625997165);
  m.centre[0] = x;
  m.centre[1] = y;
  return m;
}

/* Two rods side by side turn in step. Towards each other they meet in the middle, and behind each other they do not. */
static void rods_turn_in_step(void) {
  const double left[6] = {1, 2, 2, 1.875, 2, 2}, right[6] = {2, 2, 2, 2.875, 2, 2};
  const double flat_left[4] = {1, 2, 1.875, 2}, flat_right[4] = {2, 2, 2.875, 2};
  dsw_scene *const scene = make_room();
  dsw_body_id bodies[2];
  dsw_rigid_motion motions[2], left_over;
  dsw_move_report reports[2];
  dsw_together_options o;
  const dsw_body_contact *contacts;
  size_t count;
  dsw_together_options_init(&o, sizeof o);
  bodies[0] = make_edge_body(scene, D == 2 ? flat_left : left, DSW_LEVEL_EDGES_SWEPT);
  bodies[1] = make_edge_body(scene, D == 2 ? flat_right : right, DSW_LEVEL_EDGES_SWEPT);
  motions[0] = turn_about_z(179, 1, 2);
  motions[1] = turn_about_z(179, 2, 2);
  motions[0].translation[1] = motions[1].translation[1] = 0.5;
  CHECK_OK(dsw_scene_move_rigid(scene, bodies, 2, motions, NULL, reports));
  CHECK(reports[0].fraction == 1 && reports[1].fraction == 1 && reports[0].contact_count == 0);
  CHECK_OK(dsw_scene_move_rigid(scene, bodies, 2, motions, &o, NULL));
  o.stop = DSW_TOGETHER_STOP_FEATURE;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_move_rigid(scene, bodies, 2, motions, &o, reports));
  bodies[1] = bodies[0];
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, dsw_scene_move_rigid(scene, bodies, 2, motions, NULL, reports));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_move_rigid(scene, bodies, 1, NULL, NULL, reports));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_move_rigid(NULL, bodies, 1, motions, NULL, reports));
  motions[0].rotation[3] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_scene_move_rigid(scene, bodies, 1, motions, NULL, reports));
  CHECK(strstr(dsw_last_error_message(), "motions[0].rotation[3]") != NULL);
  CHECK_OK(dsw_scene_move_rigid(scene, NULL, 0, NULL, NULL, NULL));
  end_scene(scene);
  { /* towards each other: they meet in the middle */
    dsw_scene *const other = make_room();
    bodies[0] = make_edge_body(other, D == 2 ? flat_left : left, DSW_LEVEL_EDGES_SWEPT);
    bodies[1] = make_edge_body(other, D == 2 ? flat_right : right, DSW_LEVEL_EDGES_SWEPT);
    motions[0] = turn_about_z(0, 0, 0);
    motions[1] = turn_about_z(0, 0, 0);
    motions[0].translation[0] = 1;
    motions[1].translation[0] = -1;
    CHECK_OK(dsw_scene_move_rigid(other, bodies, 2, motions, NULL, reports));
    CHECK(reports[0].fraction < 0.0625 && reports[0].fraction > 0.0625 - 1e-12);
    CHECK(reports[1].fraction == reports[0].fraction && reports[0].vertices_stopped == 2);
    CHECK_OK(dsw_body_get_contacts(other, bodies[0], &contacts, &count));
    CHECK(count > 0 && count == reports[0].contact_count && fabs(contacts[0].time - 0.0625) < 1e-15);
    CHECK(contacts[0].distance_left > 0.9 && reports[1].contact_count > 0);
    CHECK_OK(dsw_body_get_motion_left(other, bodies[0], &left_over));
    CHECK(fabs(left_over.translation[0] - 0.9375) < 1e-9);
    motions[1].translation[0] = 1; /* and behind each other they do not */
    CHECK_OK(dsw_scene_move_rigid(other, bodies, 2, motions, NULL, reports));
    CHECK(reports[0].fraction == 1 && reports[1].fraction == 1 && reports[0].contact_count == 0);
    end_scene(other);
  }
}

/* The end of a rod passes the end of another rod, or its side, on an arc that is hardly further out: a stop has a contact. */
static void rods_graze(void) {
  size_t stops = 0;
  int i;
  for (i = 0; i < effort_of(200); ++i) {
    const double angle = between(0, 6.28), x = cos(angle), y = sin(angle), begin = angle - between(0.2, 1);
    const double rod[6] = {2, 2, 2, 2 + cos(begin), 2 + sin(begin), 2},
                 post[6] = {2 + x, 2 + y, 1.5, 2 + x, 2 + y, 2.5};
    const double flat[4] = {2, 2, rod[3], rod[4]}, flat_post[4] = {2 + x, 2 + y, 2 + 1.25 * x, 2 + 1.25 * y};
    dsw_scene *const scene = make_room();
    const int moves = i % 2;
    dsw_body_id bodies[2];
    dsw_rigid_motion motions[2];
    dsw_move_report reports[2];
    const dsw_body_contact *contacts;
    const dsw_contact_partner *partners;
    size_t count, k, n = 0;
    bodies[moves] = make_edge_body(scene, D == 2 ? flat_post : post, DSW_LEVEL_EDGES_SWEPT);
    bodies[1 - moves] = make_edge_body(scene, D == 2 ? flat : rod, DSW_LEVEL_EDGES_SWEPT);
    motions[1 - moves] = turn_about_z(120, 2, 2);
    motions[moves] = turn_about_z(0, 0, 0);
    if (moves == 0) {
      const dsw_body_id post_id = bodies[0];
      bodies[0] = bodies[1];
      bodies[1] = post_id;
      motions[0] = motions[1];
    }
    CHECK_OK(dsw_scene_move_rigid(scene, bodies, 1 + (size_t)moves, motions, NULL, reports));
    if (reports[0].fraction < 1) {
      ++stops;
      for (k = 0; k < 2; ++k) {
        size_t c;
        if (k == 1 && moves == 0) break;
        CHECK_OK(dsw_body_get_contacts(scene, bodies[k], &contacts, &count));
        CHECK_OK(dsw_body_get_contact_partners(scene, bodies[k], &partners, &count));
        for (c = 0; c < count; ++c, ++n) {
          CHECK(partners[c].body.index == bodies[1 - k].index && contacts[c].time >= reports[0].fraction);
          CHECK(fabs(contacts[c].point[0] - 2 - x) < 1e-6 && fabs(contacts[c].point[1] - 2 - y) < 1e-6);
        }
      }
      CHECK(n > 0);
    }
    end_scene(scene);
  }
  CHECK(stops > 0);
}

static uint8_t g_kinds[MOST_PAIRS];
static uint32_t g_indices[2 * MOST_PAIRS];
static double g_from[12 * MOST_PAIRS];
static size_t g_pairs;

static void add_pair(uint8_t kind, const double *a, size_t count, uint32_t motion_a, const double *b,
                     uint32_t motion_b) {
  double *const to = g_from + (D + 1) * D * g_pairs;
  memcpy(to, a, count * D * sizeof *to);
  memcpy(to + count * D, b, (D + 1 - count) * D * sizeof *to);
  g_kinds[g_pairs] = kind;
  g_indices[2 * g_pairs] = motion_a;
  g_indices[2 * g_pairs + 1] = motion_b;
  CHECK(g_pairs + 1 < MOST_PAIRS);
  ++g_pairs;
}

/* Two edges, or an edge and a part of a wall. */
static void add_edges(const double *a, uint32_t motion_a, const double *b, uint32_t motion_b) {
  unsigned i;
  if (D == 3) {
    add_pair(DSW_PAIR_EDGE_EDGE, a, 2, motion_a, b, motion_b);
    return;
  }
  for (i = 0; i < 2; ++i) {
    add_pair(DSW_PAIR_VERTEX_EDGE, a + D * i, 1, motion_a, b, motion_b);
    add_pair(DSW_PAIR_VERTEX_EDGE, b + D * i, 1, motion_b, a, motion_a);
  }
}

static void add_room(const double *rod, uint32_t motion) {
  unsigned k, w, c, x;
  for (k = 0; k < D; ++k) {
    for (w = 0; w < 2; ++w) {
      double triangle[9];
      for (c = 0; c < D; ++c) {
        for (x = 0; x < D; ++x) triangle[D * c + x] = x == k ? (w == 0 ? 0 : N) : -64;
      }
      triangle[D + (k + 1) % D] += 512;
      if (D == 3) triangle[2 * D + (k + 2) % D] += 512;
      for (c = 0; c < 2; ++c) {
        add_pair(D == 3 ? DSW_PAIR_VERTEX_FACE : DSW_PAIR_VERTEX_EDGE, rod + D * c, 1, motion, triangle, UINT32_MAX);
      }
    }
  }
}

typedef struct tally {
  size_t touches, passed, false_stops, silent, other_times;
  double most_late;
} tally;

/* A quaternion as the library normalises it; w is positive here. */
static void normalize(const double *rotation, double *q) {
  double largest = 0, size;
  int k;
  for (k = 0; k < 4; ++k) largest = fmax(largest, fabs(rotation[k]));
  for (k = 0; k < 4; ++k) q[k] = rotation[k] / largest;
  size = sqrt((q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]));
  for (k = 0; k < 4; ++k) q[k] /= size;
}

static void random_rods(tally *t) {
  double rods[BODIES][6], numbers[BODIES][17], now[BODIES][6], again[6];
  dsw_rigid_motion motions[BODIES], reversed[BODIES];
  dsw_body_id bodies[BODIES], others[BODIES];
  dsw_move_report reports[BODIES], back[BODIES];
  dsw_scene *const scene = make_room(), *const mirror = make_room();
  dsw_pair_touch *touches;
  const dsw_body_contact *contacts;
  double first = 2;
  uint32_t flags[BODIES];
  size_t i, j, k, n, any = 0;
  int is_made = 1;
  g_pairs = 0;
  for (i = 0; i < BODIES; ++i) {
    const double far = share() < 0.5 ? 30 : 170, half = between(0.001, far) * 0.00872664625997165;
    double axis[3] = {0, 0, 1}, size = 1;
    for (k = 0; k < 2 * D; ++k) rods[i][k] = k < D ? between(0.7, N - 0.7) : rods[i][k - D] + between(-0.6, 0.6);
    flags[i] = share() < 0.3 ? DSW_BODY_RIGID : 0;
    memset(&motions[i], 0, sizeof motions[i]);
    if (D == 3) {
      for (k = 0; k < 3; ++k) axis[k] = between(-1, 1);
      size = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    }
    for (k = 0; k < 3; ++k) motions[i].rotation[k] = axis[k] / size * sin(half);
    motions[i].rotation[3] = cos(half);
    for (k = 0; k < D; ++k) {
      motions[i].centre[k] = rods[i][k] + between(-0.3, 0.3);
      motions[i].translation[k] = between(-1, 1);
    }
    memset(numbers[i], 0, sizeof numbers[i]);
    numbers[i][3] = 1;
    normalize(motions[i].rotation, numbers[i] + 4);
    for (k = 0; k < D; ++k) {
      numbers[i][8 + k] = numbers[i][11 + k] = motions[i].centre[k];
      numbers[i][14 + k] = motions[i].centre[k] + motions[i].translation[k];
    }
  }
  for (i = 0; i < BODIES; ++i) {
    const size_t other = BODIES - 1 - i;
    dsw_body_desc d = line_desc(rods[i], 2, 0, DSW_LEVEL_EDGES_SWEPT);
    d.flags = flags[i];
    is_made = is_made && dsw_body_create(scene, &d, &bodies[i]) == DSW_STATUS_OK;
    d = line_desc(rods[other], 2, 0, DSW_LEVEL_EDGES_SWEPT);
    d.flags = flags[other];
    is_made = is_made && dsw_body_create(mirror, &d, &others[i]) == DSW_STATUS_OK;
    reversed[i] = motions[other];
    add_room(rods[i], (uint32_t)i);
    for (j = 0; j < i; ++j) add_edges(rods[i], (uint32_t)i, rods[j], (uint32_t)j);
  }
  if (is_made) {
    touches = (dsw_pair_touch *)malloc(g_pairs * sizeof *touches);
    CHECK_OK(
        dsw_sweep_rigid_pairs(NULL, D, g_pairs, g_kinds, g_from, NULL, 0, numbers[0], BODIES, g_indices, 0, touches));
    for (k = 0; k < g_pairs; ++k) {
      if (touches[k].touches == 0) continue;
      ++any;
      first = fmin(first, touches[k].time);
    }
    free(touches);
    CHECK_OK(dsw_scene_move_rigid(scene, bodies, BODIES, motions, NULL, reports));
    CHECK_OK(dsw_scene_move_rigid(mirror, others, BODIES, reversed, NULL, back));
    for (i = 0; i < BODIES; ++i) {
      CHECK(reports[i].fraction == reports[0].fraction && back[i].fraction == reports[0].fraction);
      CHECK_OK(dsw_body_get_positions(scene, bodies[i], now[i], 2, 0, NULL, &n));
      CHECK_OK(dsw_body_get_positions(mirror, others[BODIES - 1 - i], again, 2, 0, NULL, &n));
      for (k = 0; k < 2 * D; ++k) CHECK(fabs(again[k] - now[i][k]) < 1e-14 && now[i][k] >= 0 && now[i][k] <= N);
    }
    for (i = n = 0; i < BODIES; ++i) {
      n += reports[i].contact_count;
      CHECK_OK(dsw_body_get_contacts(scene, bodies[i], &contacts, &k));
      while (k-- > 0) t->other_times += any > 0 && fabs(contacts[k].time - first) > 1e-9;
    }
    t->silent += n == 0 && reports[0].fraction < 1;
    if (any == 0) {
      t->false_stops += reports[0].fraction != 1;
    } else {
      ++t->touches;
      t->passed += reports[0].fraction > first;
      t->most_late = fmax(t->most_late, first - reports[0].fraction);
    }
  }
  end_scene(scene);
  end_scene(mirror);
}

/* A recorded call is made again with the same results. */
static void is_recorded(void) {
  static tape recorded;
  const double at[6] = {1, 1, 1, 2, 1, 1}, flat[4] = {1, 1, 2, 1};
  dsw_scene *const scene = make_room();
  const dsw_recording_desc desc = to_tape(&recorded);
  dsw_rigid_motion motion = turn_about_z(150, 1.5, 1);
  dsw_move_options o = move_options();
  dsw_replay *replay = NULL;
  dsw_replay_report report;
  dsw_body_id body;
  int i;
  CHECK_OK(dsw_scene_start_recording(scene, &desc));
  body = make_edge_body(scene, D == 2 ? flat : at, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_scene_move_rigid(scene, &body, 1, &motion, NULL, NULL));
  motion.translation[0] = -3;
  o.flags = DSW_MOVE_SLIDE_WHOLE;
  CHECK_OK(dsw_body_move_rigid(scene, body, &motion, &o, NULL));
  CHECK_OK(dsw_scene_stop_recording(scene));
  CHECK_OK(dsw_replay_create(NULL, recorded.bytes, recorded.size, &replay));
  for (i = 0; i < 3; ++i) {
    CHECK_OK(dsw_replay_step(replay, &report));
    CHECK(report.outcome == DSW_REPLAY_SAME);
  }
  CHECK(strcmp(report.function, "dsw_body_move_rigid") == 0);
  CHECK_OK(dsw_replay_destroy(replay));
  end_scene(scene);
}

/* Memory that is refused at every single point: nothing has moved then. */
static void memory_runs_out(int which) {
  static host h;
  const double left[6] = {1, 1, 1, 2, 1, 1}, right[6] = {1, 2, 1, 2, 2, 1};
  const double flat_left[4] = {1, 1, 2, 1}, flat_right[4] = {1, 2, 2, 2};
  const double poses[14] = {0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 0, -3, 0}, centre[3] = {1, 1, 1};
  const uint32_t indices[4] = {0, 1, 1, 0};
  dsw_context *const context = make_context(&h);
  dsw_scene *const scene =
      make_scene(D == 2 ? make_squares(context, N, N) : make_environment(context, N, N, N), DSW_FEATURE_BODY_CONTACTS);
  dsw_rigid_motion motions[2];
  dsw_move_options o = move_options();
  dsw_status status;
  dsw_body_id bodies[2];
  size_t refusals = 0, count;
  double before[6], after[6];
  bodies[0] = make_edge_body(scene, D == 2 ? flat_left : left, DSW_LEVEL_EDGES_SWEPT);
  bodies[1] = make_edge_body(scene, D == 2 ? flat_right : right, DSW_LEVEL_EDGES_SWEPT);
  motions[0] = motions[1] = turn_about_z(40, 1, 1);
  motions[0].translation[1] = motions[1].translation[1] = -2;
  o.flags = DSW_MOVE_SLIDE_WHOLE;
  CHECK_OK(dsw_body_get_positions(scene, bodies[0], before, 2, 0, NULL, &count));
  for (;;) {
    dsw_free_fraction fractions[2];
    dsw_body_contact contacts[2];
    fractions[0].fraction = fractions[1].fraction = contacts[0].time = contacts[1].time = 7;
    h.refuse = h.calls + refusals + 1;
    status = which == 0   ? dsw_scene_move_rigid(scene, bodies, 2, motions, NULL, NULL)
             : which == 1 ? dsw_body_move_rigid(scene, bodies[0], motions, &o, NULL)
                          : dsw_body_find_free_fractions(scene, bodies[0], centre, poses, 2, indices, NULL, 2,
                                                         fractions, contacts);
    h.refuse = 0;
    if (status == DSW_STATUS_OK || refusals > 3000) break;
    CHECK(status == DSW_STATUS_OUT_OF_MEMORY && !h.broken);
    CHECK(fractions[0].fraction == 7 && fractions[1].fraction == 7 && contacts[0].time == 7 && contacts[1].time == 7);
    CHECK_OK(dsw_body_get_positions(scene, bodies[0], after, 2, 0, NULL, &count));
    CHECK(memcmp(before, after, 2 * D * sizeof *before) == 0);
    ++refusals;
  }
  CHECK(status == DSW_STATUS_OK && refusals > 10);
  end_scene(scene);
  end_context(context, &h);
}

/* Finds the distance of two segments in space, by their nearest points [Ericson 2005]. */
static double distance_of(const double *a, const double *b) {
  double d[3], e[3], r[3], dd = 0, ee = 0, de = 0, dr = 0, er = 0, s, t, square = 0;
  int k;
  for (k = 0; k < 3; ++k) {
    d[k] = a[3 + k] - a[k];
    e[k] = b[3 + k] - b[k];
    r[k] = a[k] - b[k];
    dd += d[k] * d[k];
    ee += e[k] * e[k];
    de += d[k] * e[k];
    dr += d[k] * r[k];
    er += e[k] * r[k];
  }
  s = dd * ee - de * de > 0 ? fmin(fmax((de * er - dr * ee) / (dd * ee - de * de), 0), 1) : 0;
  t = (de * s + er) / ee;
  if (t < 0 || t > 1) {
    t = t < 0 ? 0 : 1;
    s = fmin(fmax((de * t - dr) / dd, 0), 1);
  }
  for (k = 0; k < 3; ++k) square += pow(r[k] + s * d[k] - t * e[k], 2);
  return sqrt(square);
}

/* Where the two ends of a rod are at a fraction of a motion. */
static void place_rod(const double *rod, const dsw_rigid_motion *m, double fraction, double *to) {
  double q[4], length = 0;
  int i, k;
  for (k = 0; k < 4; ++k) {
    q[k] = fraction * m->rotation[k] + (k == 3 ? 1 - fraction : 0);
    length += q[k] * q[k];
  }
  for (i = 0; i < 2; ++i) {
    double x[3], c[3];
    for (k = 0; k < 3; ++k) x[k] = rod[3 * i + k] - m->centre[k];
    for (k = 0; k < 3; ++k) c[k] = q[(k + 1) % 3] * x[(k + 2) % 3] - q[(k + 2) % 3] * x[(k + 1) % 3] + q[3] * x[k];
    for (k = 0; k < 3; ++k) {
      const double turned = x[k] + 2 * (q[(k + 1) % 3] * c[(k + 2) % 3] - q[(k + 2) % 3] * c[(k + 1) % 3]) / length;
      to[3 * i + k] = turned + m->centre[k] + fraction * m->translation[k];
    }
  }
}

typedef struct thick_tally {
  size_t whole, stopped, too_near, far;
} thick_tally;

/* Thick rods in a room. At 200 times of their motions they are no nearer to each other and to the walls than their radii, and
 * where they stop one of these distances is used up. */
static void thick_rods(thick_tally *t) {
  dsw_scene *const scene = make_room();
  double rods[BODIES][6], radii[BODIES], least = 1;
  dsw_body_id bodies[BODIES];
  dsw_rigid_motion motions[BODIES];
  dsw_move_report reports[BODIES];
  unsigned i, j, k, x;
  int is_too_near = 0;
  memset(rods, 0, sizeof rods);
  memset(motions, 0, sizeof motions);
  for (i = 0; i < BODIES; ++i) {
    dsw_body_desc d;
    double at[6];
    do {
      for (k = 0; k < 2; ++k) {
        for (x = 0; x < D; ++x) {
          at[D * k + x] = rods[i][3 * k + x] = k == 0 ? between(0.5, N - 0.5) : rods[i][x] + between(-0.4, 0.4);
        }
      }
      d = line_desc(at, 2, 0, DSW_LEVEL_EDGES_SWEPT);
      d.radius = radii[i] = i == 2 && share() < 0.5 ? 0 : between(0.02, 0.1);
    } while (dsw_body_create(scene, &d, &bodies[i]) != DSW_STATUS_OK);
    for (k = D == 2 ? 2 : 0; k < 3; ++k) motions[i].rotation[k] = between(-0.7, 0.7);
    motions[i].rotation[3] = between(0.5, 1);
    for (x = 0; x < D; ++x) {
      motions[i].centre[x] = rods[i][x] + between(-0.2, 0.2);
      motions[i].translation[x] = between(-1, 1);
    }
    {
      double length = 0;
      for (k = 0; k < 4; ++k) length += motions[i].rotation[k] * motions[i].rotation[k];
      for (k = 0; k < 4; ++k) motions[i].rotation[k] /= sqrt(length);
    }
  }
  CHECK_OK(dsw_scene_move_rigid(scene, bodies, BODIES, motions, NULL, reports));
  for (k = 0; k <= 200; ++k) {
    double at[BODIES][6];
    for (i = 0; i < BODIES; ++i) {
      place_rod(rods[i], &motions[i], reports[i].fraction * k / 200, at[i]);
      for (x = 0; x < 6; ++x) {
        const double wall = x % 3 < D ? fmin(at[i][x], N - at[i][x]) - radii[i] : 1;
        is_too_near |= wall < -1e-9;
        if (k == 200) least = fmin(least, wall);
      }
      for (j = 0; j < i; ++j) {
        const double left = distance_of(at[i], at[j]) - radii[i] - radii[j];
        is_too_near |= left < -1e-9;
        if (k == 200) least = fmin(least, left);
      }
    }
  }
  t->too_near += is_too_near != 0;
  if (reports[0].fraction == 1) {
    ++t->whole;
  } else {
    ++t->stopped;
    t->far += least > 1e-9;
    for (i = j = 0; i < BODIES; ++i) j += reports[i].contact_count != 0;
    CHECK(j > 0 && reports[0].fraction == reports[1].fraction && reports[1].fraction == reports[2].fraction);
  }
  end_scene(scene);
}

int main(int argc, char **argv) {
  for (D = 2; D <= 3; ++D) {
    tally t;
    int i;
    memset(&t, 0, sizeof t);
    g_state = seed_of(88172645463325252u + D);
    rods_turn_in_step();
    is_recorded();
    rods_graze();
    for (i = 0; i < 3; ++i) memory_runs_out(i);
    for (i = 0; i < effort_of(300); ++i) random_rods(&t);
    if (argc > 1 && strcmp(argv[1], "print") == 0) {
      printf(
          "dimension %u: %zu touches, %zu passed, late by up to %g, %zu false stops, %zu silent, %zu at other times\n",
          D, t.touches, t.passed, t.most_late, t.false_stops, t.silent, t.other_times);
    }
    CHECK(t.touches > 0 && t.passed == 0 && t.false_stops == 0 && t.most_late < 1e-9);
    CHECK(t.silent == 0 && t.other_times == 0);
    {
      thick_tally thick;
      memset(&thick, 0, sizeof thick);
      for (i = 0; i < effort_of(100); ++i) thick_rods(&thick);
      if (argc > 1) {
        printf("  thick: %zu whole, %zu stopped, %zu too near, %zu far\n", thick.whole, thick.stopped, thick.too_near,
               thick.far);
      }
      CHECK(thick.stopped > 0 && thick.too_near == 0 && thick.far == 0);
    }
  }
  return check_result();
}
