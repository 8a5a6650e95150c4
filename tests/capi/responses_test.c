/* Responses of edges to contacts, each with its own result on one scene in space and in the plane: [JCD10] figure 5. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"
#include "scenes/figure5.h"

static figure5_answer run(uint32_t dimension, figure5_panel panel, const figure5_options *options) {
  figure5_answer answer;
  CHECK(figure5_run(dimension, panel, options, &answer));
  return answer;
}

static int are_same(const figure5_answer *a, const figure5_answer *b) {
  return a->inserted == b->inserted && memcmp(a->pegs, b->pegs, sizeof a->pegs) == 0 &&
         fabs(a->end[0] - b->end[0]) < 1e-3 && fabs(a->end[1] - b->end[1]) < 1e-3;
}

/* Every response does what its panel shows, and no two of them the same. */
static void every_panel_has_its_own_result(void) {
  const figure5_options options = figure5_default_options();
  uint32_t dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    figure5_answer answers[FIGURE5_PANELS];
    int panel, other;
    for (panel = 0; panel < FIGURE5_PANELS; ++panel) {
      answers[panel] = run(dimension, (figure5_panel)panel, &options);
      CHECK(figure5_is_expected((figure5_panel)panel, &answers[panel]));
      for (other = 0; other < panel; ++other) {
        CHECK(!are_same(&answers[panel], &answers[other]));
        CHECK(!figure5_is_expected((figure5_panel)other, &answers[panel]));
      }
    }
  }
}

/* C lies under the edge, but the edge that is bent at A never comes to it: only all obstacles at once have it. */
static void the_exhaustive_search_finds_what_no_sequence_meets(void) {
  figure5_options options = figure5_default_options();
  uint32_t dimension, i;
  for (dimension = 2; dimension <= 3; ++dimension) {
    const figure5_answer one = run(dimension, FIGURE5_ADAPTIVE_ONE, &options),
                         many = run(dimension, FIGURE5_ADAPTIVE_MANY, &options);
    CHECK(one.inserted == 2 && many.inserted == 3 && many.pegs[2] == FIGURE5_C);
    for (i = 0; i < one.inserted; ++i) CHECK(one.pegs[i] != FIGURE5_C);
    options.search = DSW_SEARCH_EXHAUSTIVE; /* reports what the response finds by itself: four, then D once more */
    CHECK(run(dimension, FIGURE5_ADAPTIVE_MANY, &options).contacts == 5);
    options.search = DSW_SEARCH_EXACT;
  }
}

/* Where each part must keep a quarter of the edge, B and C get no vertex in the whole edge, at 0.233 and 0.767 of it;
   in the part from A to p there is room at B. B is at 0.467 of that part: where each part must keep 0.47, p stops as
   soon as B is met. */
static void parts_keep_their_share(void) {
  figure5_options options = figure5_default_options();
  uint32_t dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    figure5_answer answer;
    options.min_part = 0; /* the default */
    answer = run(dimension, FIGURE5_ADAPTIVE_MANY, &options);
    CHECK(answer.inserted == 2 && answer.pegs[0] == FIGURE5_A && answer.pegs[1] == FIGURE5_B);
    CHECK(answer.contacts == 3);
    options.min_part = 0.47;
    answer = run(dimension, FIGURE5_ADAPTIVE_ONE, &options);
    CHECK(answer.inserted == 1 && answer.pegs[0] == FIGURE5_A && fabs(answer.end[1] - 3.25) < 1e-6);
    options.min_part = 0.46;
    answer = run(dimension, FIGURE5_ADAPTIVE_ONE, &options);
    CHECK(answer.inserted == 2);
  }
}

/* Pegs are smaller than what is swept: no cast meets one, and the contact is what the sweep meets. */
static void halving_inserts_one_vertex_at_a_time(void) {
  figure5_options options = figure5_default_options();
  uint32_t dimension, depth;
  options.search = DSW_SEARCH_BISECTION;
  for (dimension = 2; dimension <= 3; ++dimension) {
    figure5_answer answer;
    for (depth = 4; depth <= 52; depth += 8) {
      const double step = ldexp(1, -(int)depth), first = 1 / 6.75; /* A is met when p has come down by 1 */
      options.bisection_depth = depth;
      answer = run(dimension, FIGURE5_STATIC, &options);
      CHECK(answer.contacts == 1 && answer.first_time <= first && answer.first_time >= first - step);
      CHECK(fabs(answer.first_contact[0] - 8) < 1e-12 && fabs(answer.first_contact[1] - 7) < 1e-12);
      CHECK(answer.end[1] >= 6.5 && answer.end[1] < 6.5 + 6.75 * step + 1e-6);
    }
    options.bisection_depth = 40;
    answer = run(dimension, FIGURE5_ADAPTIVE_ONE, &options);
    CHECK(figure5_is_expected(FIGURE5_ADAPTIVE_ONE, &answer));
    answer = run(dimension, FIGURE5_HYBRID, &options);
    CHECK(figure5_is_expected(FIGURE5_HYBRID, &answer));
    answer = run(dimension, FIGURE5_ADAPTIVE_MANY, &options); /* it knows of no second obstacle */
    CHECK(figure5_is_expected(FIGURE5_ADAPTIVE_ONE, &answer));
  }
}

/* A ring of quads round a disc of many sides: the edge winds round more corners than a call inserts vertices. */
static void a_vertex_inserts_64_at_most(void) {
  enum { kSides = 512 };
  static double points[4 * kSides];
  static int64_t quads[4 * kSides];
  const double from[4] = {3, 1.3, -3, 1.3}, pi = 3.14159265358979323846;
  const uint32_t first = 0;
  double targets[2 * 512] = {3, -6};
  dsw_environment_desc d;
  dsw_environment *ring = NULL;
  dsw_scene *scene;
  dsw_body_id body;
  dsw_move_options o = move_options();
  dsw_move_report r;
  uint32_t i, calls = 0, inserted = 0;
  for (i = 0; i < kSides; ++i) {
    const double angle = 2 * pi * i / kSides;
    const int64_t next = (i + 1) % kSides, quad[4] = {i, kSides + i, kSides + next, next};
    points[2 * i] = cos(angle);
    points[2 * i + 1] = sin(angle);
    points[2 * (kSides + i)] = 8 * cos(angle);
    points[2 * (kSides + i) + 1] = 8 * sin(angle);
    memcpy(quads + 4 * i, quad, sizeof quad);
  }
  d = polygons_desc(points, 2 * kSides, DSW_CELL_TYPE_QUAD, quads, kSides);
  CHECK_OK(dsw_environment_create(NULL, &d, &ring, NULL));
  scene = make_scene(ring, 0);
  body = make_edge_body(scene, from, DSW_LEVEL_EDGES_SWEPT);
  o.edge_response = DSW_RESPONSE_ADAPTIVE_ONE;
  o.min_part = 1e-5;
  o.order = &first;
  o.order_count = 1;
  do {
    CHECK_OK(dsw_body_move(scene, body, targets, 2 + inserted, 0, &o, &r));
    inserted += r.edit_count;
    ++calls;
    CHECK(r.edit_count <= 64 && (r.vertices_stopped == 0 || r.edit_count == 64));
  } while (r.vertices_stopped != 0 && calls < 4);
  CHECK(r.vertices_stopped == 0 && calls == 2 && inserted > 64);
  CHECK(body_counts(scene, body).vertex_count == 2 + inserted);
  end_scene(scene);
}

int main(void) {
  every_panel_has_its_own_result();
  the_exhaustive_search_finds_what_no_sequence_meets();
  parts_keep_their_share();
  halving_inserts_one_vertex_at_a_time();
  a_vertex_inserts_64_at_most();
  return check_result();
}
