/* Contact history: vertices that rest, slide from face to face and bounce, as dsw_previous_contact tells them apart. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* 4 x 4 x 1 cubes, in the plane 4 x 4 squares; those with y = 0 are a floor of four tiles. */
enum { N = 4 };

static dsw_environment *g_env;
static dsw_scene *g_scene;
static unsigned g_dimension;

static void begin(unsigned dimension, uint32_t features) {
  uint32_t x;
  g_dimension = dimension;
  g_env = dimension == 2 ? make_squares(NULL, N, N) : make_environment(NULL, N, N, 1);
  for (x = 0; x < N; ++x) CHECK_OK(set_volume_mark(g_env, x, DSW_MARK_IMPASSABLE));
  g_scene = make_scene(g_env, features);
}

static void end(void) { end_scene(g_scene); }

static dsw_body_id make_ball(double x, double y) {
  const double at[3] = {x, y, 0.5};
  const dsw_body_desc d = body_desc(at, 1, NULL, 0, DSW_LEVEL_POINTS);
  dsw_body_id body = {0, 0};
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  return body;
}

/* What the host makes of it, with the distance that it chooses. */
enum { FREE, FIRST, RESTING, SLIDING, BOUNCING };
static int classify(const dsw_body_contact *contact, const dsw_previous_contact *previous) {
  double way = 0;
  int k;
  if (previous->since == 0) return FIRST;
  if (previous->since > 1) return BOUNCING;
  for (k = 0; k < 3; ++k) way += fabs(contact->point[k] - previous->point[k]);
  return way < 1e-6 ? RESTING : SLIDING;
}

static const dsw_body_contact *g_contact; /* of the last move, the first of them */
static dsw_previous_contact g_previous;

/* Sends the ball by a step, and says how it touches. */
static int step(dsw_body_id body, double dx, double dy) {
  double p[3] = {0, 0, 0};
  dsw_move_options o = move_options();
  dsw_move_report report;
  const dsw_body_contact *contacts = NULL;
  const dsw_previous_contact *previous = NULL;
  size_t count = 0, previous_count = 99;
  CHECK_OK(dsw_body_get_positions(g_scene, body, p, 1, 0, NULL, &count));
  p[0] += dx;
  p[1] += dy;
  o.vertex_response = DSW_RESPONSE_SLIDE;
  CHECK_OK(dsw_body_move(g_scene, body, p, 1, 0, &o, &report));
  CHECK_OK(dsw_body_get_contacts(g_scene, body, &contacts, &count));
  CHECK_OK(dsw_body_get_previous_contacts(g_scene, body, &previous, &previous_count));
  CHECK(previous_count == count && count == report.contact_count);
  if (count == 0) return FREE;
  CHECK((previous[0].moves > 1) == (contacts[0].history == DSW_HISTORY_LASTING) && previous[0].reserved == 0);
  CHECK(previous[0].moves >= 1 && previous[0].touching >= previous[0].moves);
  g_contact = contacts;
  g_previous = previous[0];
  return classify(g_contact, &g_previous);
}

static void a_ball_rests(unsigned dimension) {
  dsw_body_id ball;
  double point[3];
  uint32_t i;
  begin(dimension, 0);
  ball = make_ball(1.5, 1.25);
  CHECK(step(ball, 0, -1) == FIRST);
  CHECK(g_previous.since == 0 && g_previous.moves == 1 && g_previous.touching == 1 &&
        g_previous.obstacle.kind == DSW_CELL_NONE);
  CHECK(g_previous.point[0] == 0 && g_previous.normal[1] == 0);
  for (i = 2; i < 6; ++i) {
    memcpy(point, g_contact->point, sizeof point);
    CHECK(step(ball, 0, -0.1) == RESTING);
    CHECK(g_previous.since == 1 && g_previous.moves == i && g_previous.touching == i &&
          g_previous.body.generation == 0);
    CHECK(memcmp(g_previous.point, point, sizeof point) == 0 && g_previous.normal[1] == 1);
    CHECK(memcmp(&g_previous.obstacle, &g_contact->contact.obstacle, sizeof g_previous.obstacle) == 0);
  }
  end();
}

/* Along the floor by 0.3 a step: three tiles of it, and never a step without it. */
static void a_ball_slides_over_tiles(unsigned dimension) {
  dsw_body_id ball;
  dsw_body_contact before;
  uint32_t i, same = 1, changes = 0;
  begin(dimension, 0);
  ball = make_ball(0.25, 1.25);
  CHECK(step(ball, 0, -1) == FIRST);
  for (i = 2; i <= 11; ++i) {
    int lasts;
    before = *g_contact;
    CHECK(step(ball, 0.3, -0.2) == (i == 2 ? RESTING : SLIDING)); /* it touches, then begins to slide */
    lasts = memcmp(&before.contact.obstacle, &g_contact->contact.obstacle, sizeof before.contact.obstacle) == 0;
    same = lasts ? same + 1 : 1;
    changes += lasts ? 0 : 1;
    CHECK(g_previous.since == 1 && g_previous.moves == same && g_previous.touching == i);
    CHECK(memcmp(g_previous.point, before.point, sizeof before.point) == 0);
    CHECK(memcmp(&g_previous.obstacle, &before.contact.obstacle, sizeof before.contact.obstacle) == 0);
  }
  CHECK(changes == 2);
  end();
}

static void a_ball_bounces(unsigned dimension) {
  dsw_body_id ball;
  dsw_body_contact before;
  begin(dimension, 0);
  ball = make_ball(1.25, 1.25);
  CHECK(step(ball, 0.1, -1) == FIRST);
  before = *g_contact;
  CHECK(step(ball, 0.1, 0.5) == FREE);
  CHECK(step(ball, 0.1, -1) == BOUNCING);
  CHECK(g_previous.since == 2 && g_previous.moves == 1 && g_previous.touching == 1);
  CHECK(memcmp(g_previous.point, before.point, sizeof before.point) == 0 && g_previous.normal[1] == 1);
  CHECK(step(ball, 0.1, 0.2) == FREE && step(ball, 0.1, 0.2) == FREE && step(ball, 0.1, 0.2) == FREE);
  CHECK(step(ball, 0, -2) == BOUNCING && g_previous.since == 4);
  CHECK(step(ball, 0, -1) == RESTING && g_previous.since == 1 && g_previous.touching == 2); /* and stays */
  end();
}

/* A vertex that `order` leaves out moves without a contact; a new one has no past; a rigid motion counts. */
static void all_kinds_of_moves_count(void) {
  const double two[6] = {1.25, 1.25, 0.5, 2.75, 1.25, 0.5};
  const uint32_t first = 0;
  double to[9] = {1.25, 0.25, 0.5, 2.75, 0.25, 0.5, 2, 0.25, 0.5};
  const double third[3] = {2, 1.25, 0.5};
  dsw_rigid_motion down = {{0, 0, 0, 1}, {0, 0, 0}, {0, -1, 0}};
  const dsw_body_contact *contacts = NULL;
  const dsw_previous_contact *previous = NULL;
  dsw_body_vertex_id vertex;
  dsw_move_options o = move_options();
  size_t count = 0, i;
  dsw_body_id body;
  begin(3, 0);
  body = make_edge_body(g_scene, two, DSW_LEVEL_POINTS);
  CHECK_OK(dsw_body_move(g_scene, body, to, 2, 0, NULL, NULL));
  o.order = &first;
  o.order_count = 1;
  CHECK_OK(dsw_body_move(g_scene, body, to, 2, 0, &o, NULL));
  CHECK_OK(dsw_scene_move_bodies(g_scene, &body, 1, to, 2, 0, NULL, NULL));
  CHECK_OK(dsw_body_get_previous_contacts(g_scene, body, &previous, &count));
  CHECK_OK(dsw_body_get_contacts(g_scene, body, &contacts, &count));
  CHECK(count == 2 && contacts[0].vertex.index == 0 && contacts[1].vertex.index == 1);
  CHECK(previous[0].moves == 3 && previous[0].since == 1 && previous[1].moves == 1 && previous[1].since == 2);
  CHECK_OK(dsw_body_move_rigid(g_scene, body, &down, NULL, NULL)); /* its first contact stops all of it */
  CHECK_OK(dsw_body_get_previous_contacts(g_scene, body, &previous, &count));
  CHECK(count == 1 && previous[0].moves == 4);
  /* An edit counts for nothing, and the vertex that takes a free slot does not take its past. */
  CHECK_OK(dsw_body_get_vertex_id(g_scene, body, 1, &vertex));
  CHECK_OK(dsw_body_remove_vertex(g_scene, body, vertex));
  CHECK_OK(dsw_body_add_vertex(g_scene, body, third, no_volume, &vertex));
  CHECK(vertex.index == 1 && vertex.generation == 2);
  memcpy(to + 3, to + 6, 3 * sizeof(double));
  CHECK_OK(dsw_body_move(g_scene, body, to, 2, 0, NULL, NULL));
  CHECK_OK(dsw_body_get_previous_contacts(g_scene, body, &previous, &count));
  CHECK_OK(dsw_body_get_contacts(g_scene, body, &contacts, &count));
  CHECK(count == 2);
  for (i = 0; i < count; ++i) {
    CHECK(contacts[i].vertex.index == i && previous[i].moves == (i == 0 ? 5u : 1u) &&
          previous[i].since == (i == 0 ? 1u : 0u));
  }
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_previous_contacts(NULL, body, &previous, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_previous_contacts(g_scene, body, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_previous_contacts(g_scene, body, &previous, NULL));
  CHECK_OK(dsw_body_destroy(g_scene, body));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_previous_contacts(g_scene, body, &previous, &count));
  end();
}

/* Down on another body, then beside it down to the floor: what was touched before is told. */
static void another_body_was_touched(void) {
  const double bar[4] = {1.75, 2, 2.25, 2};
  dsw_body_id polyline, ball;
  begin(2, DSW_FEATURE_BODY_CONTACTS);
  polyline = make_edge_body(g_scene, bar, DSW_LEVEL_EDGES);
  ball = make_ball(2.125, 2.5);
  CHECK(step(ball, 0, -1) == FIRST);
  CHECK(g_contact->contact.obstacle.kind == DSW_CELL_NONE);
  CHECK(step(ball, 0, -1) == RESTING);
  CHECK(g_previous.moves == 2 && g_previous.body.index == polyline.index &&
        g_previous.body.generation == polyline.generation);
  CHECK(g_previous.obstacle.kind == DSW_CELL_NONE && g_previous.point[1] == 2);
  CHECK(step(ball, 0.25, 0.5) == FREE);
  CHECK(step(ball, 0, -2) == BOUNCING);
  CHECK(g_contact->contact.obstacle.kind != DSW_CELL_NONE && g_previous.since == 2 && g_previous.moves == 1 &&
        g_previous.point[1] == 2);
  CHECK(g_previous.body.index == polyline.index && g_previous.body.generation == polyline.generation);
  end();
}

/* What is loaded goes on as what was saved: also a ball that is in the air. */
static void snapshots_keep_it(void) {
  size_t size = 0, again_size = 0;
  unsigned char *block, *again;
  dsw_scene *loaded = NULL;
  dsw_body_id ball;
  int in_air;
  for (in_air = 0; in_air < 2; ++in_air) {
    begin(3, 0);
    ball = make_ball(1.25, 1.25);
    CHECK(step(ball, 0, -1) == FIRST && step(ball, 0, -1) == RESTING);
    if (in_air) CHECK(step(ball, 0, 0.5) == FREE);
    CHECK_OK(dsw_scene_save(g_scene, NULL, 0, &size));
    block = (unsigned char *)malloc(size);
    again = (unsigned char *)malloc(size);
    CHECK_OK(dsw_scene_save(g_scene, block, size, &size));
    CHECK_OK(dsw_scene_load(g_env, block, size, &loaded));
    CHECK_OK(dsw_scene_save(loaded, again, size, &again_size));
    CHECK(again_size == size && memcmp(block, again, size) == 0);
    CHECK_OK(dsw_scene_destroy(g_scene));
    g_scene = loaded;
    if (!in_air) {
      const dsw_previous_contact *previous = NULL;
      size_t count = 0;
      CHECK_OK(dsw_body_get_previous_contacts(g_scene, ball, &previous, &count));
      CHECK(count == 1 && previous[0].moves == 2 && previous[0].since == 1 &&
            memcmp(&previous[0], &g_previous, sizeof g_previous) == 0);
    }
    CHECK(step(ball, 0, -1) == (in_air ? BOUNCING : RESTING) && g_previous.touching == (in_air ? 1u : 3u));
    free(block);
    free(again);
    end();
  }
}

int main(void) {
  unsigned dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    a_ball_rests(dimension);
    a_ball_slides_over_tiles(dimension);
    a_ball_bounces(dimension);
  }
  all_kinds_of_moves_count();
  another_body_was_touched();
  snapshots_keep_it();
  return check_result();
}
