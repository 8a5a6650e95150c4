/* Moves of bodies: what a move answers, contacts, edits, and what is refused; in space and in the plane. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "stage.h"

static int is_unit(const double *v) { return fabs(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1) < 1e-14; }

static void init_writes_the_defaults(void) {
  dsw_move_options o;
  memset(&o, 0xff, sizeof o);
  dsw_move_options_init(&o, sizeof o);
  CHECK(o.struct_size == sizeof o && o.flags == 0 && o.vertex_response == DSW_RESPONSE_STOP);
  CHECK(o.edge_response == DSW_RESPONSE_STOP && o.search == DSW_SEARCH_EXACT && o.bisection_depth == 0);
  CHECK(o.min_part == 0 && o.stand_off == 0 && o.min_length == 0 && o.max_volumes == 0 && o.noise_share == 0 &&
        o.order == NULL && o.order_count == 0);
  memset(&o, 0xff, sizeof o);
  dsw_move_options_init(&o, 8);
  CHECK(o.struct_size == 8 && o.flags == 0 && o.bisection_depth == 0xffffffffu);
  dsw_move_options_init(NULL, sizeof o);
}

static void a_free_move_arrives(void) {
  const dsw_body_contact *contacts = NULL;
  const dsw_body_edit *edits = NULL;
  int level;
  for (level = DSW_LEVEL_POINTS; level <= (int)top_level(); ++level) {
    const dsw_body_id body = make_line(g_left, 2, (dsw_level)level);
    dsw_move_report r = move(body, g_right, 2, NULL);
    CHECK(r.fraction == 1 && r.vertices_moved == 2 && r.vertices_stopped == 0 && r.contact_count == 0);
    CHECK(r.edit_count == 0 && r.edges_swept == (level > DSW_LEVEL_POINTS ? 2u : 0u) &&
          r.edges_skipped <= r.edges_swept);
    CHECK(is_at(body, g_right, 2) && contacts_of(body, &contacts) == 0 && edits_of(body, &edits) == 0);
    r = move(body, g_right, 2, NULL); /* to where it is */
    CHECK(r.fraction == 1 && r.vertices_moved == 2 && r.vertices_stopped == 0 && is_at(body, g_right, 2));
    CHECK_OK(dsw_body_move(g_scene, body, g_left, 2, 24, NULL, NULL)); /* nobody wants the report */
    CHECK(is_at(body, g_left, 2));
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
}

/* From one cube to the next but one: three volumes. */
static void a_work_limit_stops_free(void) {
  int level;
  for (level = DSW_LEVEL_POINTS; level <= (int)top_level(); ++level) {
    const dsw_body_id body = make_line(g_left, 2, (dsw_level)level);
    dsw_move_options o = move_options();
    dsw_move_report r;
    o.max_volumes = 1;
    r = move(body, g_right, 2, &o);
    CHECK(r.vertices_stopped == 2 && r.vertices_limited == 2 && r.contact_count == 0 && is_at(body, g_left, 2));
    o.max_volumes = 1000;
    r = move(body, g_right, 2, &o);
    CHECK(r.vertices_stopped == 0 && r.vertices_limited == 0 && is_at(body, g_right, 2));
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
}

/* The edge turns about 1 and touches the edge of the pillar at (2, 1), in the plane its corner. */
static void a_contact_says_everything(void) {
  const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT);
  const double touched[3] = {2, 1, 1.5}, origin[3] = {0, 0, 0};
  const int space = g_dimension == 3;
  const dsw_body_contact *c = NULL;
  dsw_move_report r;
  uint32_t first = 0;
  double p[6];
  dsw_move_options o = move_options();
  int k;
  o.order = &first;
  o.order_count = 1;
  o.stand_off = -1;
  mark_pillar(DSW_MARK_IMPASSABLE);
  r = move(body, g_right, 2, &o);
  CHECK(r.vertices_moved == 1 && r.vertices_stopped == 1 && r.contact_count == 1 && r.fraction == 1);
  CHECK(contacts_of(body, &c) == 1);
  positions_of(body, p, 2);
  CHECK(is_point(c->from, g_left) && is_point(c->to, g_right));
  CHECK(is_point(c->fixed[0], g_left + 3) && memcmp(c->fixed[1], origin, sizeof origin) == 0);
  CHECK(c->time <= 10.5 / 22 && c->time > 10.5 / 22 - 1e-15); /* the line through (1.25, 3.75) and (2, 1) */
  CHECK(fabs(c->position[0] - (1.25 + 2 * c->time)) < 1e-15 && c->position[1] == 0.25);
  CHECK(c->position[2] == (space ? 1.5 : 0));
  for (k = 0; k < (int)g_dimension; ++k) CHECK(fabs(c->point[k] - touched[k]) < 1e-14);
  CHECK(is_unit(c->contact.normal) && c->contact.normal[0] < -0.9 && c->contact.normal[1] < 0 &&
        c->contact.normal[2] == 0);
  CHECK(fabs(c->edge_parameter - 0.75 / 3.5) < 1e-14 && c->vertex.index == 0 && c->vertex.generation == 1);
  CHECK(c->edge.index == 0 && c->edge.generation == 1 && c->face.generation == 0);
  CHECK(c->contact.obstacle.generation == 1 && c->contact.obstacle.kind == (space ? DSW_CELL_EDGE : DSW_CELL_VERTEX));
  CHECK(c->contact.kind == (space ? DSW_CONTACT_EDGE : DSW_CONTACT_VERTEX));
  CHECK(space || (c->contact.obstacle.index == point_at(2, 1) && c->contact.obstacle.local == 0 && c->point[2] == 0));
  CHECK(c->contact.marked_kind == DSW_CELL_VOLUME && c->contact.tag == 100 + g_pillar &&
        c->contact.wall.generation == 1 && c->contact.front.generation == 1);
  CHECK(c->history == DSW_HISTORY_NEW && c->distance_left > 1.04 && c->distance_left < 1.05);
  CHECK(p[0] <= c->position[0] && p[0] > c->position[0] - 1e-12 && p[1] == 0.25 && is_point(p + 3, g_left + 3));
  r = move(body, g_right, 2, &o);
  CHECK(r.contact_count == 1 && contacts_of(body, &c) == 1 && c->history == DSW_HISTORY_LASTING && c->time < 1e-12);
  r = move(body, g_left, 2, &o); /* away from it, and back */
  CHECK(r.contact_count == 0 && is_at(body, g_left, 2));
  r = move(body, g_right, 2, &o);
  CHECK(contacts_of(body, &c) == 1 && c->history == DSW_HISTORY_NEW);
  mark_pillar(DSW_MARK_PASSABLE);
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* A vertex that got the index of another has no history. */
static void a_new_vertex_has_no_history(void) {
  const double from[3] = {0.5, 0.5, 0.5}, down[3] = {0.5, -1, 0.5};
  const dsw_body_id body = make_line(from, 1, top_level());
  const dsw_body_contact *c = NULL;
  dsw_body_vertex_id v = {0, 1};
  move(body, down, 1, NULL);
  CHECK(contacts_of(body, &c) == 1 && c->history == DSW_HISTORY_NEW);
  CHECK_OK(dsw_body_remove_vertex(g_scene, body, v));
  CHECK_OK(dsw_body_add_vertex(g_scene, body, from, no_volume, &v));
  CHECK(v.index == 0 && v.generation == 2);
  move(body, down, 1, NULL);
  CHECK(contacts_of(body, &c) == 1 && c->vertex.generation == 2 && c->history == DSW_HISTORY_NEW);
  move(body, down, 1, NULL);
  CHECK(contacts_of(body, &c) == 1 && c->history == DSW_HISTORY_LASTING);
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* Sliding into a corner, a vertex is stopped by two walls in each move: both last. */
static void every_obstacle_has_its_history(void) {
  const double from[3] = {3.5, 3.25, 1.5}, corner[3] = {5, 5, 1.5};
  const dsw_body_id body = make_line(from, 1, top_level());
  const dsw_body_contact *c = NULL;
  dsw_move_options o = move_options();
  size_t count, i;
  int turn;
  o.vertex_response = DSW_RESPONSE_SLIDE;
  for (turn = 0; turn < 3; ++turn) {
    move(body, corner, 1, &o);
    count = contacts_of(body, &c);
    CHECK(count >= 2);
    for (i = 0; i < count; ++i) CHECK(c[i].history == (turn == 0 ? DSW_HISTORY_NEW : DSW_HISTORY_LASTING));
  }
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void a_vertex_stops_or_slides(void) {
  const double from[3] = {1.5, 1.25, 1.5}, to[3] = {2.5, 1.75, 1.5};
  const dsw_body_contact *c = NULL;
  dsw_move_options o = move_options();
  int level;
  mark_pillar(DSW_MARK_IMPASSABLE);
  for (level = DSW_LEVEL_POINTS; level <= (int)top_level(); ++level) {
    const dsw_body_id body = make_line(from, 1, (dsw_level)level);
    double p[3];
    dsw_move_report r;
    o.vertex_response = DSW_RESPONSE_STOP;
    r = move(body, to, 1, &o);
    CHECK(r.vertices_stopped == 1 && r.contact_count == 1 && contacts_of(body, &c) == 1);
    CHECK(c->time == 0.5 && c->contact.kind == DSW_CONTACT_PLANE && c->contact.obstacle.kind == DSW_CELL_FACE &&
          c->contact.normal[0] == -1);
    CHECK(c->edge.generation == 0 && c->face.generation == 0 && c->edge_parameter == 0 && c->point[0] == 2 &&
          c->point[1] == 1.5);
    CHECK(c->contact.tag == 100 + g_pillar && c->contact.front.index == g_pillar - 1 &&
          c->contact.obstacle.index == g_pillar - 1);
    CHECK(c->contact.obstacle.local == FACE_X1 && fabs(c->distance_left - sqrt(0.3125)) < 1e-8);
    positions_of(body, p, 1);
    CHECK(p[0] <= 2 && p[0] > 2 - 1e-8);
    o.vertex_response = DSW_RESPONSE_SLIDE;
    r = move(body, to, 1, &o);
    CHECK(r.vertices_stopped == 1 && r.contact_count >= 1 && contacts_of(body, &c) == r.contact_count);
    CHECK(c->history == DSW_HISTORY_LASTING);
    positions_of(body, p, 1);
    CHECK(p[0] <= 2 && p[0] > 2 - 1e-8 && p[1] == 1.75 && p[2] == (g_dimension == 3 ? 1.5 : 0));
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  mark_pillar(DSW_MARK_PASSABLE);
}

static void responses_insert_vertices(void) {
  static const dsw_response kResponses[5] = {DSW_RESPONSE_STOP, DSW_RESPONSE_ADAPTIVE_ONE, DSW_RESPONSE_ADAPTIVE_MANY,
                                             DSW_RESPONSE_HYBRID, DSW_RESPONSE_SLIDE};
  static const uint32_t kInserted[5] = {0, 2, 2, 1, 0}, kStopped[5] = {2, 0, 0, 1, 2};
  int i;
  mark_pillar(DSW_MARK_IMPASSABLE);
  for (i = 0; i < 5; ++i) {
    const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT);
    const dsw_body_edit *e = NULL;
    dsw_move_options o = move_options();
    dsw_body_vertex_id v[8];
    double targets[12];
    dsw_move_report r;
    size_t count = 0, k;
    o.edge_response = kResponses[i];
    o.min_part = 0.125;
    r = move(body, g_right, 2, &o);
    CHECK(r.edit_count == kInserted[i] && edits_of(body, &e) == r.edit_count && r.vertices_moved == 2);
    CHECK(r.vertices_stopped == kStopped[i]);
    CHECK(r.contact_count >= (i == 2 ? 1u : 2u)); /* many at once: then 1 meets nothing */
    CHECK(has(body, 2 + kInserted[i], 1 + kInserted[i], 0));
    CHECK_OK(dsw_body_get_vertex_ids(g_scene, body, v, 8, &count));
    CHECK(count == 2 + kInserted[i] && positions_of(body, targets, 4) == count);
    for (k = 0; k < r.edit_count; ++k) {
      CHECK(e[k].inserted == 1 && e[k].vertex.index == 2 + k && e[k].vertex.generation == 1 && e[k].reserved == 0);
      CHECK(e[k].edge_parameter > 0.125 && e[k].edge_parameter < 0.875 && e[k].edge.generation == 1 &&
            e[k].rest.generation == 1);
      CHECK(targets[6 + 3 * k] <= 2 && targets[6 + 3 * k] > 2 - 1e-6); /* at the corners (2, 1) and (2, 2) */
      CHECK(fabs(targets[7 + 3 * k] - (double)(1 + k)) < 1e-6);
    }
    CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_body_move(g_scene, body, g_right, count - 1, g_stride, &o, &r));
    if (i == 2) { /* straight again, the inserted ones are noise */
      targets[0] = targets[3] = targets[6] = targets[9] = 1.25;
      o.noise_share = 1e-3;
      r = move(body, targets, 4, &o);
      CHECK(r.edit_count == 2 && edits_of(body, &e) == 2 && e[0].inserted == 0 && e[1].inserted == 0);
      CHECK(e[0].vertex.index >= 2 && e[1].vertex.index >= 2 && e[0].ends[0].generation == 1);
      CHECK_OK(dsw_body_get_vertex_ids(g_scene, body, v, 8, &count));
      CHECK(count == 2);
    }
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  mark_pillar(DSW_MARK_PASSABLE);
}

static void searches_agree(void) {
  static const dsw_search kSearches[4] = {DSW_SEARCH_EXACT, DSW_SEARCH_EXHAUSTIVE, DSW_SEARCH_BISECTION,
                                          DSW_SEARCH_BISECTION_VERTEX};
  const double diagonal = sqrt(g_dimension == 3 ? 1.0 / 3 : 0.5);
  double exact = 0;
  int i;
  mark_pillar(DSW_MARK_IMPASSABLE);
  for (i = 0; i < 4; ++i) {
    const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT);
    dsw_move_options o = move_options();
    const dsw_body_contact *c = NULL;
    size_t count;
    o.search = kSearches[i];
    o.bisection_depth = 10;
    move(body, g_right, 2, &o);
    count = contacts_of(body, &c);
    CHECK(count >= 2);
    if (i == 0) exact = c->time;
    CHECK(i >= 2 ? c->time <= exact && c->time >= exact - 1.0 / 1024 : c->time == exact);
    if (i >= 2) { /* the pillar's lower face is what a cast along the edge meets first */
      CHECK(c->contact.kind == DSW_CONTACT_PLANE && c->contact.obstacle.kind == DSW_CELL_FACE &&
            c->contact.tag == 100 + g_pillar);
      CHECK(fabs(c->point[0] - 2) < 1e-2 && fabs(c->point[1] - 1) < 1e-15);
      if (i == 2) {
        CHECK(c->contact.normal[0] == 0 && c->contact.normal[1] == -1);
      } else { /* of the pillar's walls at its lower corner on the left */
        CHECK(fabs(c->contact.normal[0] + diagonal) < 1e-15 && fabs(c->contact.normal[1] + diagonal) < 1e-15);
        CHECK(is_unit(c->contact.normal));
      }
      CHECK(fabs(c->edge_parameter - 0.75 / 3.5) < 1e-2 && c->edge.generation == 1);
      CHECK(c->contact.front.index == g_pillar - N && c->contact.front.generation == 1);
    } else {
      CHECK(c->contact.kind == (g_dimension == 3 ? DSW_CONTACT_EDGE : DSW_CONTACT_VERTEX));
      CHECK(c->contact.obstacle.kind == (g_dimension == 3 ? DSW_CELL_EDGE : DSW_CELL_VERTEX));
    }
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  mark_pillar(DSW_MARK_PASSABLE);
}

/* The two sides of a thin wall cancel at its rim: the normal is that of the side. */
static void the_sides_of_a_thin_wall_have_no_mean(void) {
  const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT);
  const uint32_t side = g_dimension == 3 ? (uint32_t)FACE_X1 : 1;
  const dsw_body_contact *c = NULL;
  dsw_move_options o = move_options();
  o.search = DSW_SEARCH_BISECTION_VERTEX;
  CHECK_OK(mark_face(g_pillar - 1, side, DSW_MARK_IMPASSABLE));
  CHECK(move(body, g_right, 2, &o).contact_count >= 1 && contacts_of(body, &c) >= 1);
  CHECK(c->contact.normal[0] == 1 && c->contact.normal[1] == 0 &&
        c->contact.normal[2] == 0); /* where the cast comes from */
  CHECK_OK(mark_face(g_pillar - 1, side, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* In space: a face meets the upper corner at the lower edge of a thin wall, from its right and from its left: the tag
   is that of its other side. */
static void a_tag_at_a_corner_of_a_wall_is_that_of_its_other_side(void) {
  static const uint32_t corners[3] = {0, 1, 2}, offsets[2] = {0, 3};
  int left;
  CHECK_OK(mark_face(g_pillar - 1, FACE_X1, DSW_MARK_IMPASSABLE));
  for (left = 0; left < 2; ++left) {
    double p[9] = {3.5, 0.5, 2.1, 2.25, 2.9, 0.3, 2.2, 2.9, 2.7};
    const dsw_body_contact *c = NULL;
    dsw_body_desc d;
    dsw_body_id body;
    int i;
    if (left) {
      for (i = 0; i < 9; i += 3) p[i] = 4 - p[i];
    }
    d = surface_desc(p, 3, offsets, corners, 1, DSW_LEVEL_FACES);
    CHECK_OK(dsw_body_create(g_scene, &d, &body));
    p[0] = 4 - p[0];
    CHECK(move(body, p, 3, NULL).contact_count == 1 && contacts_of(body, &c) == 1);
    CHECK(c->contact.kind == DSW_CONTACT_VERTEX && c->point[0] == 2 && c->point[1] == 1 && c->point[2] == 2);
    CHECK((left ? -c->contact.normal[0] : c->contact.normal[0]) > 0.9 &&
          c->contact.tag == 100u + g_pillar - (left ? 0 : 1));
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  CHECK_OK(mark_face(g_pillar - 1, FACE_X1, DSW_MARK_PASSABLE));
}

static void bad_options_are_refused(void) {
  const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT);
  const dsw_rigid_motion motion = {{0, 0, 0, 1}, {0, 0, 0}, {0.125, 0, 0}};
  struct {
    dsw_move_options known;
    uint32_t unknown;
  } newer;
  dsw_move_options bad[25];
  dsw_status status[25];
  const uint32_t twice[2] = {1, 1}, astray[2] = {0, 2};
  size_t n = 0, i;
  memset(&newer, 0, sizeof newer);
  for (i = 0; i < 25; ++i) bad[i] = move_options();
#define BAD(which, member, value) (bad[n].member = (value), status[n++] = DSW_STATUS_##which)
  BAD(BAD_STRUCT_SIZE, struct_size, 16);
  BAD(UNSUPPORTED, struct_size, 4097);
  BAD(UNSUPPORTED, flags, 8);
  BAD(UNSUPPORTED, vertex_response, DSW_RESPONSE_ADAPTIVE_ONE);
  BAD(UNSUPPORTED, vertex_response, DSW_RESPONSE_HYBRID);
  BAD(UNSUPPORTED, vertex_response, DSW_RESPONSE_ADAPTIVE_SLIDE);
  BAD(UNSUPPORTED, vertex_response, (dsw_response)6);
  BAD(UNSUPPORTED, edge_response, (dsw_response)6);
  BAD(UNSUPPORTED, edge_response, (dsw_response)-1);
  BAD(UNSUPPORTED, search, (dsw_search)4);
  BAD(OUT_OF_RANGE, bisection_depth, 53);
  BAD(OUT_OF_RANGE, min_part, -0.25);
  BAD(OUT_OF_RANGE, min_part, 0.50001);
  BAD(OUT_OF_RANGE, min_part, NAN);
  BAD(NON_FINITE, stand_off, NAN);
  BAD(NON_FINITE, stand_off, INFINITY);
  BAD(OUT_OF_RANGE, min_length, -1);
  BAD(OUT_OF_RANGE, min_length, NAN);
  BAD(OUT_OF_RANGE, min_length, INFINITY);
  BAD(OUT_OF_RANGE, passes, 65);
  BAD(OUT_OF_RANGE, noise_share, -1);
  BAD(OUT_OF_RANGE, noise_share, NAN);
  BAD(NULL_ARGUMENT, order_count, 2);
  bad[n].order = twice;
  BAD(DUPLICATE_ID, order_count, 2);
  bad[n].order = astray;
  BAD(OUT_OF_RANGE, order_count, 2);
#undef BAD
  CHECK(n == 25);
  for (i = 0; i < n; ++i) {
    dsw_move_report r, before;
    memset(&r, 0x55, sizeof r);
    before = r;
    CHECK_FAILS(status[i], dsw_body_move(g_scene, body, g_right, 2, g_stride, &bad[i], &r));
    CHECK_MESSAGE("options->");
    CHECK_FAILS(status[i], dsw_body_move_rigid(g_scene, body, &motion, &bad[i], &r));
    CHECK_MESSAGE("options->");
    CHECK(memcmp(&r, &before, sizeof r) == 0);
  }
  newer.known = move_options();
  newer.known.struct_size = sizeof newer;
  newer.unknown = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_body_move(g_scene, body, g_right, 2, g_stride, &newer.known, NULL));
  CHECK(is_at(body, g_left, 2));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void bad_arguments_change_nothing(void) {
  const dsw_body_id body = make_line(g_left, 2, DSW_LEVEL_EDGES_SWEPT), stale = {body.index, body.generation + 1};
  const uint32_t first = 0;
  const dsw_body_contact *contacts = NULL;
  const dsw_body_edit *edits = NULL;
  dsw_move_options o = move_options();
  double bad[6];
  dsw_move_report r, before;
  size_t count = 0;
  memset(&r, 0x55, sizeof r);
  before = r;
  memcpy(bad, g_right, sizeof bad);
  bad[4] = NAN;
#define MOVE(scene, body, targets, n, stride) dsw_body_move(scene, body, targets, n, stride, NULL, &r)
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, MOVE(NULL, body, g_right, 2, g_stride));
  CHECK_FAILS(DSW_STATUS_STALE_ID, MOVE(g_scene, stale, g_right, 2, g_stride));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, MOVE(g_scene, body, NULL, 2, g_stride));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, MOVE(g_scene, body, g_right, 1, g_stride));
  CHECK_MESSAGE("target_count is 1, there are 2 vertex slots");
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, MOVE(g_scene, body, g_right, 3, g_stride));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, MOVE(g_scene, body, NULL, 0, g_stride));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, MOVE(g_scene, body, g_right, 2, 20));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, MOVE(g_scene, body, bad, 2, g_stride));
  CHECK_MESSAGE("targets[1][1] is nan, must be finite");
  bad[4] = -INFINITY;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, MOVE(g_scene, body, bad, 2, g_stride));
#undef MOVE
  CHECK(memcmp(&r, &before, sizeof r) == 0 && is_at(body, g_left, 2));
  o.order = &first; /* the other target is not read */
  o.order_count = 1;
  CHECK_OK(dsw_body_move(g_scene, body, bad, 2, g_stride, &o, &r));
  CHECK(r.vertices_moved == 1 && r.vertices_stopped == 0);
  o.order_count = 0; /* none moves */
  CHECK_OK(dsw_body_move(g_scene, body, bad, 2, g_stride, &o, &r));
  CHECK(r.vertices_moved == 0);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_contacts(NULL, body, &contacts, &count));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_contacts(g_scene, stale, &contacts, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_contacts(g_scene, body, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_contacts(g_scene, body, &contacts, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_edits(NULL, body, &edits, &count));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_edits(g_scene, stale, &edits, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_edits(g_scene, body, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_edits(g_scene, body, &edits, NULL));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* A target of a free slot is not read; the slot keeps its place in the arrays. */
static void free_slots_are_left_out(void) {
  const double line[9] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5, 2.5, 0.5, 0.5};
  const double to[9] = {0.5, 1.5, 0.5, NAN, NAN, NAN, 2.5, 1.5, 0.5}, at[9] = {0.5, 1.5, 0.5, 0, 0, 0, 2.5, 1.5, 0.5};
  const dsw_body_id body = make_line(line, 3, top_level());
  const dsw_body_vertex_id middle = {1, 1};
  const uint32_t gone = 1;
  dsw_move_options o = move_options();
  dsw_move_report r;
  CHECK_OK(dsw_body_remove_vertex(g_scene, body, middle));
  r = move(body, to, 3, NULL);
  CHECK(r.vertices_moved == 2 && r.vertices_stopped == 0 && r.edges_swept == 0 && is_at(body, at, 3));
  o.order = &gone;
  o.order_count = 1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_move(g_scene, body, at, 3, g_stride, &o, NULL));
  CHECK_MESSAGE("options->order[0] is 1, which names no vertex");
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* 1e300 is a target like any other. */
static void far_targets_are_values(void) {
  const double to[6] = {1e300, -1e300, 1e300, -1e300, 1e300, 1e300};
  static const dsw_response kResponses[2] = {DSW_RESPONSE_STOP, DSW_RESPONSE_SLIDE};
  int level, i, k;
  for (level = DSW_LEVEL_POINTS; level <= (int)top_level(); ++level) {
    for (i = 0; i < 2; ++i) {
      const dsw_body_id body = make_line(g_left, 2, (dsw_level)level);
      dsw_move_options o = move_options();
      dsw_move_report r;
      double p[6];
      o.vertex_response = o.edge_response = kResponses[i];
      r = move(body, to, 2, &o);
      CHECK(r.vertices_stopped == 2 && r.contact_count >= 2);
      positions_of(body, p, 2);
      for (k = 0; k < 6; ++k) CHECK(p[k] >= 0 && p[k] <= 4);
      CHECK_OK(dsw_body_destroy(g_scene, body));
    }
  }
}

/* In a corner the slide of DSW_MOVE_KEEP_WALLS ends: each of its walls is met once. */
static void slides_end_in_a_corner(void) {
  const double from[3] = {0.5, 0.625, 0.75}, to[3] = {-1, -1.25, -1.5}, corner[3] = {0, 0, 0};
  const uint32_t walls = g_dimension;
  int level, k;
  for (level = DSW_LEVEL_POINTS; level <= (int)top_level(); ++level) {
    const dsw_body_id body = make_line(from, 1, (dsw_level)level);
    dsw_move_options o = move_options();
    dsw_move_report r;
    double p[3];
    o.vertex_response = DSW_RESPONSE_SLIDE;
    o.flags = DSW_MOVE_KEEP_WALLS;
    r = move(body, to, 1, &o);
    CHECK(r.vertices_stopped == 1 && r.contact_count == walls);
    positions_of(body, p, 1);
    for (k = 0; k < 3; ++k) CHECK(p[k] >= corner[k] && p[k] < 1e-8);
    r = move(body, from, 1, &o);
    CHECK(r.contact_count == 0 && is_at(body, from, 1));
    o.flags = 0;
    r = move(body, to, 1, &o);
    CHECK(r.vertices_stopped == 1 && r.contact_count >= walls + (g_dimension == 3 ? 1u : 0u));
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
}

/* Along the pillar, and behind it: only a further pass tries the target itself again. */
static void a_further_pass_goes_round_an_edge(void) {
  const double from[3] = {1.25, 1.25, 1.5}, to[3] = {3.5, 2.625, 1.5};
  int level;
  mark_pillar(DSW_MARK_IMPASSABLE);
  for (level = DSW_LEVEL_POINTS; level <= (int)top_level(); ++level) {
    const dsw_body_id body = make_line(from, 1, (dsw_level)level);
    dsw_move_options o = move_options();
    dsw_move_report r;
    double p[3];
    o.vertex_response = DSW_RESPONSE_SLIDE;
    r = move(body, to, 1, &o);
    positions_of(body, p, 1);
    CHECK(r.vertices_stopped == 1 && r.contact_count == 1 && p[0] < 2 && p[1] == 2.625);
    move(body, from, 1, NULL);
    o.passes = 1;
    r = move(body, to, 1, &o);
    CHECK(r.vertices_stopped == 0 && r.contact_count == 1 && is_at(body, to, 1));
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  mark_pillar(DSW_MARK_PASSABLE);
}

/* An edge between two vertices hangs on the pillar until the second has moved; then the first goes on. */
static void a_held_vertex_goes_on(void) {
  const double from[6] = {1.25, 0.25, 1.5, 1.25, 1.75, 1.5}, to[6] = {3.5, 0.5, 1.5, 1.75, 0.25, 1.5};
  static const uint32_t pulled_end_first[2] = {1, 0};
  const dsw_body_contact *c = NULL;
  int level;
  mark_pillar(DSW_MARK_IMPASSABLE);
  for (level = DSW_LEVEL_EDGES_SWEPT; level <= (int)top_level(); ++level) {
    const dsw_body_id body = make_line(from, 2, (dsw_level)level);
    dsw_move_options o = move_options();
    dsw_move_report r = move(body, to, 2, &o);
    CHECK(r.vertices_stopped == 1 && r.contact_count == 1 && is_at(body, to, 2) == 0);
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  for (level = DSW_LEVEL_EDGES_SWEPT; level <= (int)top_level(); ++level) {
    const dsw_body_id body = make_line(from, 2, (dsw_level)level);
    dsw_move_options o = move_options();
    dsw_move_report r;
    o.passes = 64; /* as many as are needed */
    r = move(body, to, 2, &o);
    CHECK(r.vertices_moved == 2 && r.vertices_stopped == 0 && is_at(body, to, 2));
    CHECK(r.contact_count == 1 && contacts_of(body, &c) == 1 && c->edge.generation == 1 && c->distance_left > 0.5);
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  for (level = DSW_LEVEL_EDGES_SWEPT; level <= (int)top_level(); ++level) {
    const dsw_body_id body = make_line(from, 2, (dsw_level)level);
    dsw_move_options o = move_options();
    dsw_move_report r;
    o.order = pulled_end_first;
    o.order_count = 2;
    r = move(body, to, 2, &o);
    CHECK(r.vertices_stopped == 0 && r.contact_count == 0 && is_at(body, to, 2));
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  mark_pillar(DSW_MARK_PASSABLE);
}

/* A vertex that is stopped again by what had stopped it reports that once, from where it was in the last pass. */
static void passes_report_a_contact_once(void) {
  const double from[6] = {0.5, 0.5, 1.5, 0.5, 3.5, 1.5}, to[6] = {0.75, -1, 1.5, 0.75, 5, 1.5};
  const dsw_body_id body = make_line(from, 2, top_level());
  const dsw_body_contact *c = NULL;
  dsw_move_options o = move_options();
  dsw_move_report r;
  o.passes = 3;
  r = move(body, to, 2, &o);
  CHECK(r.vertices_stopped == 2 && r.contact_count == 2 && contacts_of(body, &c) == 2);
  CHECK(c[0].vertex.index + c[1].vertex.index == 1 && c[0].from[1] != 0.5 && c[1].from[1] != 3.5);
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void in_both(void) {
  init_writes_the_defaults();
  a_free_move_arrives();
  a_work_limit_stops_free();
  a_contact_says_everything();
  a_new_vertex_has_no_history();
  every_obstacle_has_its_history();
  a_vertex_stops_or_slides();
  responses_insert_vertices();
  searches_agree();
  the_sides_of_a_thin_wall_have_no_mean();
  bad_options_are_refused();
  bad_arguments_change_nothing();
  free_slots_are_left_out();
  far_targets_are_values();
  slides_end_in_a_corner();
  a_further_pass_goes_round_an_edge();
  a_held_vertex_goes_on();
  passes_report_a_contact_once();
}

int main(void) {
  begin_stage(2);
  in_both();
  end_stage();
  begin_stage(3);
  in_both();
  a_tag_at_a_corner_of_a_wall_is_that_of_its_other_side();
  end_stage();
  return check_result();
}
