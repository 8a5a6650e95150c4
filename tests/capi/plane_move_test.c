/* Moves of bodies in the plane: contacts, responses, rigid motions, and what is refused. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* 4 x 4 unit squares; square (x, y) is polygon x + 4 y, point (x, y) is vertex x + 5 y. The square (2, 1) is
   the pillar that things meet. */
enum { N = 4, PILLAR = 2 + N, SIDE_RIGHT = 1 };

static dsw_environment *g_env;
static dsw_scene *g_scene;

static uint32_t point_at(uint32_t x, uint32_t y) { return x + (N + 1) * y; }

static dsw_status mark_square(uint32_t volume, dsw_mark mark) { return set_volume_mark(g_env, volume, mark); }

static dsw_status mark_point(uint32_t x, uint32_t y, dsw_mark mark) {
  return set_vertex_mark(g_env, point_at(x, y), mark);
}

static dsw_body_id make_line(const double *positions, size_t count, dsw_level level) {
  const dsw_body_desc d = line_desc(positions, count, 0, level);
  dsw_body_id body = {0, 0};
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  return body;
}

/* 0 below and 1 above the pillar's row, left of it and right of it. */
static const double g_left[4] = {1.25, 0.25, 1.25, 3.75}, g_right[4] = {3.25, 0.25, 3.25, 3.75};

static dsw_move_options options(void) {
  dsw_move_options o;
  dsw_move_options_init(&o, sizeof o);
  return o;
}

static dsw_move_report move(dsw_body_id body, const double *targets, size_t count, const dsw_move_options *o) {
  dsw_move_report r;
  memset(&r, 0x55, sizeof r);
  CHECK_OK(dsw_body_move(g_scene, body, targets, count, 0, o, &r));
  return r;
}

static size_t positions_of(dsw_body_id body, double *p, size_t capacity) {
  size_t count = 0;
  CHECK_OK(dsw_body_get_positions(g_scene, body, p, capacity, 0, NULL, &count));
  return count;
}

static int is_at(dsw_body_id body, const double *wanted, size_t count) {
  double p[32];
  return positions_of(body, p, 16) == count && memcmp(p, wanted, 2 * count * sizeof(double)) == 0;
}

static size_t contacts_of(dsw_body_id body, const dsw_contact **contacts) {
  size_t count = 99;
  CHECK_OK(dsw_body_get_contacts(g_scene, body, contacts, &count));
  return count;
}

static int has(dsw_body_id body, uint32_t vertices, uint32_t edges) {
  dsw_body_counts c;
  c.struct_size = sizeof c;
  CHECK_OK(dsw_body_get_counts(g_scene, body, &c));
  return c.vertex_count == vertices && c.edge_count == edges && c.face_count == 0 && c.face_slots == 0;
}

static void a_free_move_arrives(void) {
  int level;
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
    const dsw_body_id body = make_line(g_left, 2, (dsw_level)level);
    dsw_move_report r = move(body, g_right, 2, NULL);
    CHECK(r.fraction == 1 && r.vertices_moved == 2 && r.vertices_stopped == 0 && r.contact_count == 0);
    CHECK(r.edges_swept == (level > DSW_LEVEL_POINTS ? 2u : 0u) && is_at(body, g_right, 2));
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
}

/* The edge turns about 1 and touches the corner of the pillar at (2, 1). */
static void a_contact_says_everything(void) {
  const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT);
  const double touched[2] = {2, 1};
  const dsw_contact *c = NULL;
  dsw_move_report r;
  uint32_t first = 0;
  double p[4];
  dsw_move_options o = options();
  int k;
  o.order = &first;
  o.order_count = 1;
  o.stand_off = -1;
  CHECK_OK(mark_square(PILLAR, DSW_MARK_IMPASSABLE));
  r = move(body, g_right, 2, &o);
  CHECK(r.vertices_moved == 1 && r.vertices_stopped == 1 && r.contact_count == 1 && contacts_of(body, &c) == 1);
  positions_of(body, p, 2);
  CHECK(c->from[0] == 1.25 && c->from[1] == 0.25 && c->from[2] == 0 && c->to[0] == 3.25 && c->to[2] == 0);
  CHECK(c->fixed[0][0] == 1.25 && c->fixed[0][1] == 3.75 && c->fixed[0][2] == 0 && c->fixed[1][0] == 0);
  CHECK(c->time <= 10.5 / 22 && c->time > 10.5 / 22 - 1e-15); /* the line through (1.25, 3.75) and (2, 1) */
  CHECK(fabs(c->position[0] - (1.25 + 2 * c->time)) < 1e-15 && c->position[1] == 0.25 && c->position[2] == 0);
  for (k = 0; k < 2; ++k) CHECK(fabs(c->point[k] - touched[k]) < 1e-14);
  CHECK(fabs(c->normal[0] * c->normal[0] + c->normal[1] * c->normal[1] - 1) < 1e-14);
  CHECK(c->normal[0] < -0.9 && c->normal[1] < 0 && c->normal[2] == 0 && c->point[2] == 0);
  CHECK(fabs(c->along - 0.75 / 3.5) < 1e-14 && c->vertex.index == 0 && c->vertex.generation == 1);
  CHECK(c->edge.index == 0 && c->edge.generation == 1 && c->face.generation == 0);
  CHECK(c->kind == DSW_CONTACT_VERTEX && c->obstacle.kind == DSW_CELL_VERTEX);
  CHECK(c->obstacle.index == point_at(2, 1) && c->obstacle.generation == 1 && c->obstacle.local == 0);
  CHECK(c->cause == DSW_CELL_VOLUME && c->tag == 100 + PILLAR && c->wall.generation == 1 && c->front.generation == 1);
  CHECK(c->history == DSW_HISTORY_NEW && c->distance_left > 1.04 && c->distance_left < 1.05);
  CHECK(p[0] <= c->position[0] && p[0] > c->position[0] - 1e-12 && p[1] == 0.25 && memcmp(p + 2, g_left + 2, 16) == 0);
  r = move(body, g_right, 2, &o);
  CHECK(r.contact_count == 1 && contacts_of(body, &c) == 1 && c->history == DSW_HISTORY_LASTING && c->time < 1e-12);
  CHECK_OK(mark_square(PILLAR, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* A marked vertex inside of what the edge sweeps, and the pillar there alone: from EDGES_SWEPT on. */
static void small_obstacles_are_met_when_swept(void) {
  static const double from[4] = {0.5, 0.25, 3.75, 1.75}, to[4] = {0.5, 3.75, 3.75, 1.75};
  const uint32_t first = 0;
  int level, small;
  for (small = 0; small < 2; ++small) {
    for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
      const dsw_body_id body = make_line(from, 2, (dsw_level)level);
      dsw_move_options o = options();
      dsw_move_report r;
      const dsw_contact *c = NULL;
      o.order = &first;
      o.order_count = 1;
      CHECK_OK(small != 0 ? mark_point(2, 2, DSW_MARK_IMPASSABLE) : mark_square(PILLAR + N, DSW_MARK_IMPASSABLE));
      r = move(body, to, 2, &o);
      if (level != DSW_LEVEL_EDGES_SWEPT && (small != 0 || level == DSW_LEVEL_POINTS)) {
        CHECK(r.vertices_stopped == 0 && r.contact_count == 0 && is_at(body, to, 2));
      } else if (level == DSW_LEVEL_EDGES_SWEPT) {
        CHECK(r.vertices_stopped == 1 && r.contact_count == 1 && contacts_of(body, &c) == 1);
        CHECK(c->kind == DSW_CONTACT_VERTEX && c->obstacle.kind == DSW_CELL_VERTEX);
        CHECK(c->obstacle.index == point_at(2, 2));
        CHECK(c->cause == (small != 0 ? DSW_CELL_VERTEX : DSW_CELL_VOLUME));
        CHECK((c->wall.generation == 0) == (small != 0) && (c->tag == 0) == (small != 0));
        CHECK(c->normal[1] < 0 && c->normal[2] == 0 && c->edge.generation == 1);
      }
      CHECK_OK(dsw_body_destroy(g_scene, body));
      CHECK_OK(small != 0 ? mark_point(2, 2, DSW_MARK_PASSABLE) : mark_square(PILLAR + N, DSW_MARK_PASSABLE));
    }
  }
}

static void a_vertex_stops_or_slides(void) {
  const double from[2] = {1.5, 1.25}, to[2] = {2.5, 1.75};
  const dsw_contact *c = NULL;
  dsw_move_options o = options();
  int level;
  CHECK_OK(mark_square(PILLAR, DSW_MARK_IMPASSABLE));
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
    const dsw_body_id body = make_line(from, 1, (dsw_level)level);
    double p[2];
    dsw_move_report r;
    o.vertex_response = DSW_RESPONSE_STOP;
    r = move(body, to, 1, &o);
    CHECK(r.vertices_stopped == 1 && r.contact_count == 1 && contacts_of(body, &c) == 1);
    CHECK(c->time == 0.5 && c->kind == DSW_CONTACT_PLANE && c->obstacle.kind == DSW_CELL_FACE && c->normal[0] == -1);
    CHECK(c->obstacle.index == PILLAR - 1 && c->obstacle.local == SIDE_RIGHT && c->edge.generation == 0);
    CHECK(c->point[0] == 2 && c->point[1] == 1.5 && c->tag == 100 + PILLAR && c->front.index == PILLAR - 1);
    CHECK(fabs(c->distance_left - sqrt(0.3125)) < 1e-8);
    o.vertex_response = DSW_RESPONSE_SLIDE;
    r = move(body, to, 1, &o);
    CHECK(r.contact_count >= 1 && contacts_of(body, &c) == r.contact_count && c->history == DSW_HISTORY_LASTING);
    positions_of(body, p, 1);
    CHECK(p[0] <= 2 && p[0] > 2 - 1e-8 && p[1] == 1.75);
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  CHECK_OK(mark_square(PILLAR, DSW_MARK_PASSABLE));
}

static void responses_insert_vertices(void) {
  static const dsw_response kResponses[5] = {DSW_RESPONSE_STOP, DSW_RESPONSE_ADAPTIVE_ONE, DSW_RESPONSE_ADAPTIVE_MANY,
                                             DSW_RESPONSE_HYBRID, DSW_RESPONSE_SLIDE};
  static const uint32_t kInserted[5] = {0, 2, 2, 1, 0}, kStopped[5] = {2, 0, 0, 1, 2};
  int i;
  CHECK_OK(mark_square(PILLAR, DSW_MARK_IMPASSABLE));
  for (i = 0; i < 5; ++i) {
    const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT);
    const dsw_body_edit *e = NULL;
    dsw_move_options o = options();
    double targets[8];
    dsw_move_report r;
    size_t count = 0, k;
    o.edge_response = kResponses[i];
    o.min_part = 0.125;
    r = move(body, g_right, 2, &o);
    CHECK_OK(dsw_body_get_edits(g_scene, body, &e, &count));
    CHECK(r.edit_count == kInserted[i] && count == r.edit_count && r.vertices_moved == 2);
    CHECK(r.vertices_stopped == kStopped[i] &&
          r.contact_count >= (i == 2 ? 1u : 2u)); /* many at once: then 1 meets nothing */
    CHECK(has(body, 2 + kInserted[i], 1 + kInserted[i]) && positions_of(body, targets, 4) == 2 + kInserted[i]);
    for (k = 0; k < r.edit_count; ++k) {
      CHECK(e[k].inserted == 1 && e[k].vertex.index == 2 + k && e[k].share > 0.125 && e[k].share < 0.875);
      CHECK(targets[4 + 2 * k] <= 2 && targets[4 + 2 * k] > 2 - 1e-6); /* at the corners (2, 1) and (2, 2) */
      CHECK(fabs(targets[5 + 2 * k] - (double)(1 + k)) < 1e-6);
    }
    if (i == 2) { /* straight again, the inserted ones are noise */
      targets[0] = targets[2] = targets[4] = targets[6] = 1.25;
      o.noise_share = 1e-3;
      r = move(body, targets, 4, &o);
      CHECK(r.edit_count == 2 && has(body, 2, 1));
    }
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  CHECK_OK(mark_square(PILLAR, DSW_MARK_PASSABLE));
}

static void searches_agree(void) {
  static const dsw_search kSearches[3] = {DSW_SEARCH_EXACT, DSW_SEARCH_ALL, DSW_SEARCH_BISECTION};
  double exact = 0;
  int i;
  CHECK_OK(mark_square(PILLAR, DSW_MARK_IMPASSABLE));
  for (i = 0; i < 3; ++i) {
    const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT);
    dsw_move_options o = options();
    const dsw_contact *c = NULL;
    o.search = kSearches[i];
    o.bisection_depth = 10;
    move(body, g_right, 2, &o);
    CHECK(contacts_of(body, &c) >= 2);
    if (i == 0) exact = c->time;
    CHECK(i == 2 ? c->time <= exact && c->time >= exact - 1.0 / 1024 : c->time == exact);
    if (i == 2) { /* the pillar's lower side is what a cast along the edge meets first */
      CHECK(c->kind == DSW_CONTACT_PLANE && c->obstacle.kind == DSW_CELL_FACE && c->tag == 100 + PILLAR);
      CHECK(c->normal[0] == 0 && c->normal[1] == -1 && fabs(c->point[0] - 2) < 1e-2 && fabs(c->point[1] - 1) < 1e-15);
      CHECK(fabs(c->along - 0.75 / 3.5) < 1e-2 && c->edge.generation == 1 && c->front.index == PILLAR - N);
    } else {
      CHECK(c->kind == DSW_CONTACT_VERTEX);
    }
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  CHECK_OK(mark_square(PILLAR, DSW_MARK_PASSABLE));
}

static void bad_moves_are_refused(void) {
  const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT), stale = {body.index, body.generation + 1};
  const double far[4] = {1e300, -1e300, -1e300, 1e300};
  double bad[4] = {3.25, 0.25, NAN, 3.75}, p[4];
  const uint32_t first = 0;
  const dsw_contact *contacts;
  dsw_move_options o = options();
  dsw_move_report r;
  size_t count;
  int k;
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_move(g_scene, stale, g_right, 2, 0, NULL, &r));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_contacts(g_scene, stale, &contacts, &count));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_body_move(g_scene, body, g_right, 1, 0, NULL, &r));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_body_move(g_scene, body, g_right, 2, 8, NULL, &r));
  CHECK_MESSAGE("from 16 on");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_move(g_scene, body, NULL, 2, 0, NULL, &r));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_body_move(g_scene, body, bad, 2, 0, NULL, &r));
  CHECK_MESSAGE("targets[1][0] is nan");
  CHECK(is_at(body, g_left, 2));
  o.order = &first; /* the other target is not read */
  o.order_count = 1;
  CHECK_OK(dsw_body_move(g_scene, body, bad, 2, 0, &o, &r));
  CHECK(r.vertices_moved == 1 && r.vertices_stopped == 0);
  r = move(body, far, 2, NULL); /* a target like any other */
  CHECK(r.vertices_stopped == 2);
  positions_of(body, p, 2);
  for (k = 0; k < 4; ++k) CHECK(p[k] >= 0 && p[k] <= N);
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void many_bodies_move(void) {
  const double from[4] = {1.5, 1.25, 0.5, 0.5}, to[12] = {2.5, 1.75, NAN, 0.5, 3.5, NAN, 1.25, 1.5, NAN, 1.25, 3, NAN};
  dsw_body_id bodies[3];
  dsw_move_report reports[3];
  double p[4];
  int k;
  CHECK_OK(mark_square(PILLAR, DSW_MARK_IMPASSABLE));
  for (k = 0; k < 2; ++k) bodies[k] = make_line(from + 2 * k, 1, DSW_LEVEL_POINTS);
  bodies[2] = make_line(g_left, 2, DSW_LEVEL_EDGES);
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_scene_move_bodies(g_scene, bodies, 3, to, 3, 24, NULL, reports));
  CHECK_OK(dsw_scene_move_bodies(g_scene, bodies, 3, to, 4, 24, NULL, reports));
  CHECK(reports[0].vertices_stopped == 1 && reports[1].vertices_stopped == 0 && reports[2].vertices_stopped == 0);
  CHECK(positions_of(bodies[1], p, 1) == 1 && p[0] == 0.5 && p[1] == 3.5);
  CHECK(positions_of(bodies[2], p, 2) == 2 && p[1] == 1.5 && p[3] == 3);
  for (k = 0; k < 3; ++k) CHECK_OK(dsw_body_destroy(g_scene, bodies[k]));
  CHECK_OK(mark_square(PILLAR, DSW_MARK_PASSABLE));
}

static void rigid_motions_stay_in_the_plane(void) {
  const double points[4] = {1.5, 1.5, 1.5, 3.5}, turned[4] = {1.5, 1.5, 3.5, 1.5};
  const double wall =
      2 * (1.57079632679489661923 - atan(1.0 / 0.5)); /* twice the angle at which the edge meets (2, 2) */
  const dsw_body_id body = make_line(points, 2, DSW_LEVEL_EDGES_SWEPT);
  dsw_rigid_motion m, bad[5];
  dsw_move_report r;
  double p[4];
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
  for (k = 0; k < 4; ++k) CHECK(fabs(p[k] - turned[k]) < 1e-15);
  m.rotation[2] = 1;
  CHECK_OK(dsw_body_move_rigid(g_scene, body, &m, NULL, &r));
  CHECK_OK(mark_square(PILLAR, DSW_MARK_IMPASSABLE));
  m.rotation[2] = -1;
  CHECK_OK(dsw_body_move_rigid(g_scene, body, &m, NULL, &r));
  CHECK(r.fraction < 1 && r.fraction > 0 && r.contact_count >= 1 && positions_of(body, p, 2) == 2);
  CHECK(fabs(hypot(p[2] - p[0], p[3] - p[1]) - 2) < 1e-14 && atan2(p[2] - p[0], p[3] - p[1]) <= wall / 2);
  memset(&m, 0, sizeof m);
  m.rotation[3] = 1;
  m.translation[0] = -0.25;
  m.translation[1] = -1;
  CHECK_OK(dsw_body_move_rigid(g_scene, body, &m, NULL, &r));
  CHECK(r.fraction == 1);
  CHECK_OK(mark_square(PILLAR, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* Two lines, and one that folds onto itself. */
static void bodies_meet(void) {
  const double pole[4] = {2.5, 0.5, 2.5, 2.5}, bar[4] = {0.5, 1.25, 1.5, 1.25}, on[4] = {2.75, 1.25, 3.75, 1.25};
  const double hook[6] = {0.5, 2.5, 0.5, 3.5, 1.5, 3.5}, closed[6] = {0.5, 2.5, 0.5, 3.5, 0.25, 2.75};
  dsw_scene *const scene = make_scene(g_env, DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_STATISTICS);
  const dsw_contact_partner *partners = NULL;
  const dsw_contact *c = NULL;
  const uint32_t tip = 2;
  dsw_move_options o = options();
  dsw_body_desc d = line_desc(pole, 2, 0, DSW_LEVEL_EDGES_SWEPT);
  dsw_body_id still, moving;
  dsw_move_report r;
  double p[6];
  size_t count = 0;
  CHECK_OK(dsw_body_create(scene, &d, &still));
  d.positions = bar;
  CHECK_OK(dsw_body_create(scene, &d, &moving));
  CHECK_OK(dsw_body_move(scene, moving, on, 2, 0, NULL, &r));
  CHECK(r.vertices_stopped == 2 && r.contact_count == 2);
  CHECK_OK(dsw_body_get_contacts(scene, moving, &c, &count));
  CHECK_OK(dsw_body_get_contact_partners(scene, moving, &partners, &count));
  CHECK(count == 2 && c[0].vertex.index == 0 && c[0].kind == DSW_CONTACT_EDGE && c[0].normal[0] == -1);
  CHECK(c[0].obstacle.kind == DSW_CELL_NONE && c[0].wall.generation == 0 && fabs(c[0].point[0] - 2.5) < 1e-14);
  CHECK(partners[0].body.index == still.index && partners[0].body.generation == still.generation);
  CHECK(partners[0].edge.generation == 1 && partners[0].vertex.generation == 0 && partners[0].face.generation == 0);
  CHECK_OK(dsw_body_get_positions(scene, moving, p, 3, 0, NULL, &count));
  CHECK(p[0] < 2.5 && p[2] < 2.5 && (p[0] > 2.4 || p[2] > 2.4));
  CHECK_OK(dsw_body_destroy(scene, moving));
  d = line_desc(hook, 3, 0, DSW_LEVEL_EDGES);
  d.flags = DSW_BODY_SELF_CONTACTS;
  CHECK_OK(dsw_body_create(scene, &d, &moving));
  o.order = &tip;
  o.order_count = 1;
  CHECK_OK(dsw_body_move(scene, moving, closed, 3, 0, &o, &r));
  CHECK(r.vertices_stopped == 1 && r.contact_count == 1);
  CHECK_OK(dsw_body_get_contact_partners(scene, moving, &partners, &count));
  CHECK(count == 1 && partners[0].body.index == moving.index && partners[0].edge.index == 0);
  CHECK_OK(dsw_scene_destroy(scene));
}

int main(void) {
  g_env = make_squares(NULL, N, N);
  g_scene = make_scene(g_env, 0);
  a_free_move_arrives();
  a_contact_says_everything();
  small_obstacles_are_met_when_swept();
  a_vertex_stops_or_slides();
  responses_insert_vertices();
  searches_agree();
  bad_moves_are_refused();
  many_bodies_move();
  rigid_motions_stay_in_the_plane();
  CHECK_OK(dsw_scene_destroy(g_scene));
  bodies_meet();
  CHECK_OK(dsw_environment_destroy(g_env));
  return check_result();
}
