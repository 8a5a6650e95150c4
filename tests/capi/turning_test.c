/* Rigid moves follow their arcs: known angles, and first touches beside those of all pairs, which dsw_sweep_rigid_pairs finds. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../effort.h"
#include "check.h"
#include "draw.h"
#include "fixture.h"

enum { N = 4, MOST = 4, MOST_PAIRS = 4096 };

static unsigned g_dimension;
static dsw_environment *g_env;
static dsw_scene *g_scene;

static void begin(unsigned dimension, unsigned n, uint32_t features) {
  g_dimension = dimension;
  g_env = dimension == 2 ? make_squares(NULL, n, n) : make_environment(NULL, n, n, n);
  g_scene = make_scene(g_env, features);
}

static dsw_move_report turn(dsw_body_id body, const dsw_rigid_motion *motion) {
  dsw_move_report report;
  memset(&report, 0, sizeof report);
  CHECK_OK(dsw_body_move_rigid(g_scene, body, motion, NULL, &report));
  return report;
}

static dsw_rigid_motion turn_about_z(double degrees, double x, double y) {
  dsw_rigid_motion m;
  const double half = degrees * 3.14159265358979323846 / 360;
  memset(&m, 0, sizeof m);
  m.rotation[2] = sin(half);
  m.rotation[3] = cos(half);
  m.centre[0] = x;
  m.centre[1] = y;
  return m;
}

/* In a room of half width 1 a rod of length 0.9 sqrt(2) turns by 6.78 degrees, until its end is at a wall. */
static void a_rod_in_a_room_stops_at_the_wall(unsigned dimension) {
  const double rod[6] = {0.5, 0.5, 0.5, 0.95, 0.95, 0.5}, flat[4] = {0.5, 0.5, 0.95, 0.95};
  double now[6];
  size_t count;
  dsw_body_id body;
  dsw_move_report report;
  const dsw_rigid_motion m = turn_about_z(90, 0.5, 0.5);
  const dsw_body_contact *contacts;
  begin(dimension, 1, 0);
  body = make_edge_body(g_scene, dimension == 2 ? flat : rod, DSW_LEVEL_EDGES_SWEPT);
  report = turn(body, &m);
  CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 0, NULL, &count));
  CHECK(report.fraction > 0.05 && report.fraction < 0.1 && report.contact_count == 1);
  CHECK(now[dimension + 1] <= 1 && now[dimension + 1] > 1 - 16 * 0x1p-53); /* its end is at the wall y = 1 */
  CHECK_OK(dsw_body_get_contacts(g_scene, body, &contacts, &count));
  CHECK(fabs(contacts[0].distance_left - hypot(now[dimension] - 0.05, now[dimension + 1] - 0.95)) < 1e-12);
  CHECK(turn(body, &m).fraction < 1e-12);
  end_scene(g_scene);
}

/* A wall between the arc and its chord is met, and one between the arc and the centre is not. */
static void what_lies_between_arc_and_chord_counts(unsigned dimension) {
  const double needle[6] = {1.9, 1.5, 1.5, 1.95, 1.5, 1.5}, flat[4] = {1.9, 1.5, 1.95, 1.5};
  int turned;
  for (turned = 0; turned < 2; ++turned) {
    dsw_body_id body;
    dsw_move_report report;
    dsw_rigid_motion m = turn_about_z(120, 1.5, 1.5);
    double now[6];
    size_t count;
    begin(dimension, 3, 0);
    body = make_edge_body(g_scene, dimension == 2 ? flat : needle, DSW_LEVEL_EDGES_SWEPT);
    if (turned == 1) { /* the wall x = 1 of the middle cell; the arc goes away from it */
      CHECK_OK(set_face_mark(g_env, dimension == 2 ? 4 : 13, dimension == 2 ? 3 : FACE_X0, DSW_MARK_IMPASSABLE));
    } else { /* the wall y = 2, over which the arc would pass if the radius were 0.5 */
      m.centre[0] = 1.4;
      m.centre[1] = 1.2;
      CHECK_OK(set_face_mark(g_env, dimension == 2 ? 4 : 13, dimension == 2 ? 2 : FACE_Y1, DSW_MARK_IMPASSABLE));
    }
    report = turn(body, &m);
    CHECK_OK(dsw_body_get_positions(g_scene, body, now, 2, 0, NULL, &count));
    CHECK(report.fraction == 1 && report.contact_count == 0);
    end_scene(g_scene);
  }
}

/* The end of a rod leaves the room where its arc is nearly along the wall, by less and less. */
static void a_flat_way_out_is_no_graze(void) {
  const double quarter = 0.78539816339744831;
  int e;
  for (e = 1; e <= 14; ++e) {
    const double r = 0.5 + 1.2345 * pow(10, -e);
    const double rod[4] = {0.5, 0.5, 0.5 - r * cos(quarter), 0.5 - r * sin(quarter)};
    const dsw_rigid_motion m = turn_about_z(90, 0.5, 0.5);
    dsw_move_report report;
    begin(2, 1, 0);
    report = turn(make_edge_body(g_scene, rod, DSW_LEVEL_EDGES_SWEPT), &m);
    CHECK(report.fraction < 0.5 && report.contact_count == 1);
    end_scene(g_scene);
  }
}

/* Half a turn whose circle touches the wall y = 0, or y = 2, and comes back. The shift takes the body up, so only y = 2 is met. */
static void the_shift_decides_about_a_circle_that_touches(unsigned dimension) {
  int above;
  for (above = 0; above < 2; ++above) {
    const double y = above ? 1.5 : 0.5, rod[6] = {1, y, 1, 1.5, y, 1}, flat[4] = {1, y, 1.5, y};
    const dsw_body_contact *contacts;
    size_t count;
    dsw_body_id body;
    dsw_move_report report;
    dsw_rigid_motion m = turn_about_z(0, 1, y);
    begin(dimension, 2, 0);
    m.rotation[2] = above ? 1 : -1;
    m.rotation[3] = 0;
    body = make_edge_body(g_scene, dimension == 2 ? flat : rod, DSW_LEVEL_EDGES_SWEPT);
    report = turn(body, &m);
    CHECK_OK(dsw_body_get_contacts(g_scene, body, &contacts, &count));
    if (above) {
      CHECK(report.fraction < 0.5 && report.fraction > 0.499999 && count == 1 && contacts[0].time == 0.5);
    } else {
      CHECK(report.fraction == 1 && count == 0);
    }
    end_scene(g_scene);
  }
}

/* A triangle on the floor turns in its plane, then stands up about one of its sides, and does not get through the floor. */
static void what_lies_on_the_floor_slides_and_leaves(void) {
  const double at[9] = {1, 1, 0, 2, 1, 0, 1, 2, 0};
  const uint32_t corners[3] = {0, 1, 2}, offsets[2] = {0, 3};
  dsw_rigid_motion m = turn_about_z(70, 1, 1);
  dsw_move_report report;
  dsw_body_id body;
  dsw_body_desc d;
  begin(3, 3, 0);
  d = surface_desc(at, 3, offsets, corners, 1, DSW_LEVEL_FACES);
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  CHECK(turn(body, &m).fraction == 1);
  m = turn_about_z(-70, 1, 1);
  CHECK(turn(body, &m).fraction == 1);
  m.rotation[0] = 0.5;
  m.rotation[2] = 0;
  m.rotation[3] = 0.75;
  m.centre[2] = 0;
  {
    double now[9];
    size_t count;
    CHECK_OK(dsw_body_get_positions(g_scene, body, now, 3, 0, NULL, &count));
    memcpy(m.centre, now, 3 * sizeof *now);
  }
  CHECK(turn(body, &m).fraction == 1);
  m.rotation[0] = -1;
  report = turn(body, &m);
  CHECK(report.fraction > 0.5 && report.fraction < 1 && report.contact_count == 1);
  end_scene(g_scene);
}

/* A rod across a radius turns past a body on its inner side, however close, in both directions. */
static void what_stands_on_the_inner_side_is_passed(void) {
  int e, side, i;
  for (e = 1; e <= 12; ++e) {
    for (side = -1; side <= 1; side += 2) {
      const double turned = 1.5707963267948966 + side * 0.61, peg[4] = {0.5, 0.4, 0.5, 0.75 - pow(10, -e)};
      const dsw_rigid_motion m = turn_about_z(-90 * side, 0.5, 0.5);
      double rod[4];
      dsw_body_id body;
      dsw_move_report report;
      for (i = 0; i < 2; ++i) {
        const double along = i == 0 ? -0.2 : 0.2;
        rod[2 * i] = 0.5 + 0.25 * cos(turned) - along * sin(turned);
        rod[2 * i + 1] = 0.5 + 0.25 * sin(turned) + along * cos(turned);
      }
      begin(2, 1, DSW_FEATURE_BODY_CONTACTS);
      body = make_edge_body(g_scene, rod, DSW_LEVEL_EDGES_SWEPT);
      make_edge_body(g_scene, peg, DSW_LEVEL_EDGES_SWEPT);
      report = turn(body, &m);
      CHECK(report.fraction == 1 && report.contact_count == 0);
      end_scene(g_scene);
    }
  }
}

/* The pairs of a body with the walls of the environment, as dsw_sweep_rigid_pairs takes them. */
static uint8_t g_kinds[MOST_PAIRS];
static uint32_t g_indices[2 * MOST_PAIRS];
static double g_from[12 * MOST_PAIRS];
static size_t g_pairs;

static void add_pair(uint8_t kind, const double *first, size_t first_count, const double *second, int second_moves) {
  double *const to = g_from + (g_dimension + 1) * g_dimension * g_pairs;
  memcpy(to, first, first_count * g_dimension * sizeof *to);
  memcpy(to + first_count * g_dimension, second, (g_dimension + 1 - first_count) * g_dimension * sizeof *to);
  g_kinds[g_pairs] = kind;
  g_indices[2 * g_pairs] = second_moves ? UINT32_MAX : 0;
  g_indices[2 * g_pairs + 1] = second_moves ? 0 : UINT32_MAX;
  CHECK(g_pairs < MOST_PAIRS);
  ++g_pairs;
}

/* A body of `count` vertices in a line, or a triangle, and a wall: a segment or a triangle. */
static void add_wall(const double *body, size_t count, int is_face, const double *wall) {
  const unsigned D = g_dimension;
  size_t i, k;
  for (i = 0; i < count; ++i) add_pair(D == 2 ? DSW_PAIR_VERTEX_EDGE : DSW_PAIR_VERTEX_FACE, body + D * i, 1, wall, 0);
  for (i = 0; i < (is_face ? 3 : count - 1); ++i) {
    double edge[6];
    memcpy(edge, body + D * i, D * sizeof *edge);
    memcpy(edge + D, body + D * ((i + 1) % count), D * sizeof *edge);
    for (k = 0; k < D; ++k) {
      double side[6];
      memcpy(side, wall + D * k, D * sizeof *side);
      memcpy(side + D, wall + D * ((k + 1) % D), D * sizeof *side);
      if (D == 3) add_pair(DSW_PAIR_EDGE_EDGE, edge, 2, side, 0);
      if (D == 2) add_pair(DSW_PAIR_VERTEX_EDGE, wall + D * k, 1, edge, 1);
    }
  }
  for (k = 0; k < 3 && is_face; ++k) add_pair(DSW_PAIR_VERTEX_FACE, wall + 3 * k, 1, body, 1);
}

/* All corners of a unit square across an axis, as two triangles; in the plane a unit segment. */
static void add_square(const double *body, size_t count, int is_face, unsigned axis, const double *at) {
  const unsigned D = g_dimension;
  double corners[4][3], triangle[9];
  unsigned i, k;
  for (i = 0; i < (D == 2 ? 2u : 4u); ++i) {
    for (k = 0; k < D; ++k) corners[i][k] = at[k];
    corners[i][(axis + 1) % D] += i == 1 || i == 2 ? 1 : 0;
    if (D == 3) corners[i][(axis + 2) % D] += i >= 2 ? 1 : 0;
  }
  for (i = 0; i + 2 < (D == 2 ? 3u : 4u); ++i) {
    for (k = 0; k < D; ++k) {
      triangle[k] = corners[0][k];
      triangle[D + k] = corners[i + 1][k];
      if (D == 3) triangle[2 * D + k] = corners[i + 2][k];
    }
    add_wall(body, count, is_face, triangle);
  }
}

typedef struct tally {
  size_t touches, passed, false_stops, not_free;
  size_t wide; /* stops that are more than 64 units in the last place of the room before the touch, along the way */
} tally;

static void random_turns(unsigned dimension, tally *t) {
  const size_t wanted = (size_t)effort_of(150);
  const unsigned D = dimension;
  size_t i, k, w;
  for (i = 0; i < wanted; ++i) {
    double at[3 * MOST], now[3 * MOST], numbers[17], middle[3], first = 2, longest = 0, centre_way = 0;
    const int is_face = D == 3 && share() < 0.4, turns_far = share() < 0.5;
    const size_t count = is_face ? 3 : 2 + (size_t)(2 * share());
    const double size = between(0.05, 0.9), angle = between(0.001, turns_far ? 180 : 30);
    dsw_rigid_motion m;
    dsw_body_id body;
    dsw_body_desc d;
    dsw_move_report report;
    const uint32_t corners[3] = {0, 1, 2}, offsets[2] = {0, 3};
    size_t now_count, number_of_touches = 0;
    dsw_pair_touch *touches;
    begin(D, N, DSW_FEATURE_BODY_CONTACTS);
    for (k = 0; k < D; ++k) middle[k] = between(1, N - 1);
    for (k = 0; k < D * count; ++k) at[k] = middle[k % D] + between(-size, size);
    g_pairs = 0;
    for (k = 0; k < D; ++k) { /* the outer walls */
      for (w = 0; w < 2; ++w) {
        double big[3] = {-64, -64, -64}, triangle[9];
        unsigned c, x;
        big[k] = w == 0 ? 0 : N;
        for (c = 0; c < D; ++c) {
          for (x = 0; x < D; ++x) triangle[D * c + x] = big[x];
        }
        triangle[D + (k + 1) % D] += 512;
        if (D == 3) triangle[2 * D + (k + 2) % D] += 512;
        add_wall(at, count, is_face, triangle);
      }
    }
    for (w = 0; w < 6; ++w) { /* and walls inside */
      const unsigned x = (unsigned)(share() * (N - 1)), y = (unsigned)(share() * N), z = (unsigned)(share() * N);
      const unsigned axis = (unsigned)(share() * D),
                     cell[3] = {axis == 0 ? x : y, axis == 1 ? x : y, axis == 2 ? x : z};
      const uint32_t index = cell[0] + N * (cell[1] + N * (D == 3 ? cell[2] : 0));
      const double corner[3] = {cell[0] + (axis == 0), cell[1] + (axis == 1), cell[2] + (axis == 2)};
      CHECK_OK(set_face_mark(g_env, index, D == 3 ? 2 * axis + 1 : axis == 0 ? 1 : 2, DSW_MARK_IMPASSABLE));
      add_square(at, count, is_face, axis, corner);
    }
    d = is_face ? surface_desc(at, 3, offsets, corners, 1, DSW_LEVEL_FACES)
                : line_desc(at, count, 0, D == 3 ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT);
    if (dsw_body_create(g_scene, &d, &body) != DSW_STATUS_OK) {
      end_scene(g_scene);
      continue;
    }
    if (share() < 0.7) { /* another body: a triangle, in the plane an edge */
      double other[9];
      dsw_body_id standing;
      for (k = 0; k < D * D; ++k) other[k] = between(0.2, N - 0.2);
      d = D == 3 ? surface_desc(other, 3, offsets, corners, 1, DSW_LEVEL_FACES)
                 : line_desc(other, 2, 0, DSW_LEVEL_EDGES_SWEPT);
      if (dsw_body_create(g_scene, &d, &standing) == DSW_STATUS_OK) {
        add_wall(at, count, is_face, other);
      }
    }
    memset(&m, 0, sizeof m);
    for (k = 0; k < 3; ++k) m.rotation[k] = D == 3 || k == 2 ? between(-1, 1) : 0;
    longest = sqrt(m.rotation[0] * m.rotation[0] + m.rotation[1] * m.rotation[1] + m.rotation[2] * m.rotation[2]);
    for (k = 0; k < 3; ++k) m.rotation[k] *= sin(angle * 0.00872664625997165) / longest;
    m.rotation[3] = cos(angle * 0.00872664625997165);
    for (k = 0; k < D; ++k) m.centre[k] = between(0, N);
    for (k = 0; k < D; ++k) m.translation[k] = share() < 0.5 ? 0 : between(-0.5, 0.5);
    memset(numbers, 0, sizeof numbers);
    numbers[3] = 1;
    {
      /* The motion as moving_bodies.md says: a quaternion of length 1. */
      double largest = 0, q[4], length_of;
      for (k = 0; k < 4; ++k) largest = fmax(largest, fabs(m.rotation[k]));
      for (k = 0; k < 4; ++k) q[k] = m.rotation[k] / largest;
      length_of = sqrt((q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]));
      for (k = 0; k < 4; ++k) numbers[4 + k] = q[k] / length_of;
    }
    for (k = 0; k < D; ++k) {
      numbers[8 + k] = numbers[11 + k] = m.centre[k];
      numbers[14 + k] = m.centre[k] + m.translation[k];
      centre_way += fabs(m.translation[k]);
    }
    touches = (dsw_pair_touch *)malloc(g_pairs * sizeof *touches);
    CHECK_OK(dsw_sweep_rigid_pairs(NULL, D, g_pairs, g_kinds, g_from, NULL, 0, numbers, 1, g_indices, 0, touches));
    for (k = 0; k < g_pairs; ++k) {
      if (touches[k].touches == 0) continue;
      ++number_of_touches;
      first = fmin(first, touches[k].time);
    }
    report = turn(body, &m);
    CHECK_OK(dsw_body_get_positions(g_scene, body, now, MOST, 0, NULL, &now_count));
    for (k = 0; k < D * count; ++k) t->not_free += now[k] < 0 || now[k] > N;
    if (number_of_touches == 0) {
      t->false_stops += report.fraction != 1 || report.contact_count != 0;
    } else {
      double furthest = 0;
      ++t->touches;
      for (k = 0; k < count; ++k) {
        double square = 0;
        size_t x;
        for (x = 0; x < D; ++x) square += (at[D * k + x] - m.centre[x]) * (at[D * k + x] - m.centre[x]);
        furthest = fmax(furthest, sqrt(square));
      }
      t->passed += report.fraction > first;
      t->wide += (first - report.fraction) * (furthest * 2 + centre_way) > 64 * 0x1p-51;
      CHECK(report.contact_count <= 1);
    }
    free(touches);
    end_scene(g_scene);
  }
}

/* The middle of a rod that twists goes straight, whatever its ends do in their turns. Between two of 64 steps it passes a peg
 * that is nearer than its radius, by 0.002. */
static void a_thick_rod_that_twists_keeps_its_distance(void) {
  const double time = 32.5 / 64, root = sqrt(0.5), angle = 2 * atan2(time * root, (1 - time) + time * root);
  int side;
  for (side = -1; side <= 1; side += 2) {
    const double x = 0.35 * cos(angle), y = -0.35 * sin(angle), z = 1 + 6 * time;
    const double rod[6] = {4 + x, 4 + y, 1, 4 - x, 4 - y, 1}, peg[6] = {4, 4 + 0.098 * side, z, 4, 4 + 0.5 * side, z};
    dsw_rigid_motion m = turn_about_z(90, 4, 4);
    dsw_move_report report;
    dsw_body_id body;
    m.translation[2] = 6;
    begin(3, 8, DSW_FEATURE_BODY_CONTACTS);
    make_edge_body(g_scene, peg, DSW_LEVEL_EDGES_SWEPT);
    body = make_edge_body(g_scene, rod, DSW_LEVEL_EDGES_SWEPT);
    CHECK_OK(dsw_body_set_radius(g_scene, body, 0.1));
    report = turn(body, &m);
    CHECK(report.fraction > time - 0.004 && report.fraction < time - 0.003 && report.contact_count == 1);
    end_scene(g_scene);
  }
}

/* Parts of a body that are not joined can be in different rooms. */
static void each_part_meets_the_walls_of_its_room(void) {
  const double points[12] = {0.2, 0.5, 0.5, 0.4, 0.5, 0.5, 2.5, 0.5, 0.5, 2.9, 0.5, 0.5};
  const uint32_t edges[4] = {0, 1, 2, 3};
  dsw_rigid_motion m = turn_about_z(0, 0, 0);
  dsw_move_report report;
  dsw_body_desc d;
  dsw_body_id body;
  uint32_t i;
  dsw_body_desc_init(&d, sizeof d);
  d.positions = points;
  d.vertex_count = 4;
  d.stride_bytes = 3 * sizeof *points;
  d.edges = edges;
  d.edge_count = 2;
  begin(3, 3, 0);
  for (i = 1; i < 27; i += 3) CHECK_OK(set_volume_mark(g_env, i, DSW_MARK_IMPASSABLE)); /* those from x = 1 to 2 */
  m.translation[0] = 0.2;
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  report = turn(body, &m);
  CHECK(report.fraction > 0.4999999 && report.fraction < 0.5 + 1e-12 && report.contact_count == 1);
  end_scene(g_scene);
}

/* A triangle that was removed has no corners to look at. */
static void a_body_without_one_of_its_triangles_turns(void) {
  const double points[12] = {0.2, 0.2, 0.2, 0.8, 0.2, 0.2, 0.2, 0.8, 0.2, 0.2, 0.2, 0.8};
  const uint32_t offsets[5] = {0, 3, 6, 9, 12}, corners[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  dsw_rigid_motion m = turn_about_z(40, 0.5, 0.5);
  dsw_body_face_id ids[4];
  dsw_body_desc d;
  dsw_body_id body;
  dsw_move_report report;
  size_t count, i;
  for (i = 0; i < 4; ++i) {
    dsw_body_desc_init(&d, sizeof d);
    d.positions = points;
    d.vertex_count = 4;
    d.stride_bytes = 3 * sizeof *points;
    d.face_offsets = offsets;
    d.face_corners = corners;
    d.face_count = 4;
    d.face_corner_count = 12;
    d.level = DSW_LEVEL_FACES;
    begin(3, 1, 0);
    CHECK_OK(dsw_body_create(g_scene, &d, &body));
    CHECK_OK(dsw_body_get_face_ids(g_scene, body, ids, 4, &count));
    CHECK_OK(dsw_body_remove_face(g_scene, body, ids[i]));
    m.translation[0] = 0.5;
    report = turn(body, &m);
    CHECK(report.fraction > 0 && report.fraction < 1 && report.contact_count > 0);
    end_scene(g_scene);
  }
}

/* A vertex goes along less than half of a unit below the ceiling, which its places are rounded to. It stops at the wall behind. */
static void what_goes_along_a_wall_is_not_rounded_to_it(void) {
  const double rod[6] = {3.8328674119285629, 1.1466469343966827, 3.9999999999999996, 3.6, 1.25, 3.5};
  const dsw_rigid_motion motion = {{-6.7956605745521224e-08, 2.1020986390145443e-09, 0, 0.99999999999999767},
                                   {3.9875747455091269, 1.1418613921355407, 3.8044738940958642},
                                   {0.3226877403786842, -0.0099816854069615796, 0}};
  dsw_scene *const scene = make_scene(make_environment(NULL, N, N, N), 0);
  const dsw_body_contact *contacts;
  dsw_move_report report;
  dsw_body_id body;
  size_t count;
  body = make_edge_body(scene, rod, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_body_move_rigid(scene, body, &motion, NULL, &report));
  CHECK(report.fraction > 0.5179 && report.fraction < 0.518);
  CHECK_OK(dsw_body_get_contacts(scene, body, &contacts, &count));
  CHECK(count == 1 && contacts[0].time >= report.fraction && contacts[0].time - report.fraction < 1e-14);
  end_scene(scene);
}

/* Both ends of a rod are in the wall x = 0 exactly. It goes into the room by less than a unit of 2^-53 and comes back, through the wall, at a time that
   was computed in rational numbers. The side that the shift takes it to is that of the room, so the touch at the start is none. */
static void what_begins_in_a_wall_leaves_it_and_comes_back(void) {
  const double rod[6] = {0, 1.1077558473978428, 2.0688218471126203, 0, 0.92417555622416381, 2.2830409024296499};
  const dsw_rigid_motion motion = {{0, 1.2278750563428041e-08, -1.4328021430593117e-08, 0.99999999999999978},
                                   {-2.7321334940557231, 1.0568162261300753, 2.1282630302877394},
                                   {0, -0.049113253943931831, 0.057310045627179521}};
  const double back = 0.53843216997614196;
  dsw_scene *const scene = make_scene(make_environment(NULL, N, N, N), 0);
  const dsw_body_contact *contacts;
  dsw_move_report report;
  size_t count;
  const dsw_body_id body = make_edge_body(scene, rod, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_body_move_rigid(scene, body, &motion, NULL, &report));
  CHECK(report.fraction < back && back - report.fraction < 1e-13);
  CHECK_OK(dsw_body_get_contacts(scene, body, &contacts, &count));
  CHECK(count == 1 && contacts[0].time == back);
  end_scene(scene);
}

int main(int argc, char **argv) {
  unsigned dimension;
  a_body_without_one_of_its_triangles_turns();
  a_thick_rod_that_twists_keeps_its_distance();
  each_part_meets_the_walls_of_its_room();
  a_flat_way_out_is_no_graze();
  what_stands_on_the_inner_side_is_passed();
  what_lies_on_the_floor_slides_and_leaves();
  what_goes_along_a_wall_is_not_rounded_to_it();
  what_begins_in_a_wall_leaves_it_and_comes_back();
  for (dimension = 2; dimension <= 3; ++dimension) {
    tally t;
    memset(&t, 0, sizeof t);
    g_state = seed_of(88172645463325252u + dimension);
    a_rod_in_a_room_stops_at_the_wall(dimension);
    what_lies_between_arc_and_chord_counts(dimension);
    the_shift_decides_about_a_circle_that_touches(dimension);
    random_turns(dimension, &t);
    if (argc > 1 && strcmp(argv[1], "print") == 0) {
      printf("dimension %u: touches %zu passed %zu false_stops %zu not_free %zu wide %zu\n", dimension, t.touches,
             t.passed, t.false_stops, t.not_free, t.wide);
    }
    CHECK(t.touches > 0 && t.passed == 0 && t.false_stops == 0 && t.not_free == 0);
    CHECK(100 * t.wide <= 2 * t.touches); /* where a way only grazes a wall */
  }
  return check_result();
}
