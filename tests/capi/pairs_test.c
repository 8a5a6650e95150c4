/* Pairs of moving features: known times and ranks, arguments that are refused, batches.
   tests/unit/predicates compares times and orders with exact arithmetic. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

enum { VERTEX_FACE = DSW_PAIR_VERTEX_FACE, EDGE_EDGE = DSW_PAIR_EDGE_EDGE, VERTEX_EDGE = DSW_PAIR_VERTEX_EDGE };

/* The first feature of each pair moves along z, in the plane along y, from 1 to `height`. The second one stays. */
typedef struct fall {
  uint8_t kind;
  double x, height;
} fall;

static const double triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, crossed[6] = {0, -1, 0, 0, 1, 0}, flat[4] = {0, 0, 1, 0};

/* Writes the points of a pair, and returns how many numbers they are. */
static size_t put(fall f, double *from, double *to) {
  const int planar = f.kind == VERTEX_EDGE;
  const size_t moving = f.kind == EDGE_EDGE ? 2 : 1, size = planar ? 2 : 3, all = planar ? 6 : 12;
  const double *const rest = planar ? flat : f.kind == EDGE_EDGE ? crossed : triangle;
  size_t i;
  for (i = 0; i < moving; ++i) {
    double *const p = from + size * i;
    p[0] = f.kind == EDGE_EDGE ? (i == 0 ? -1 : 1) : f.x;
    p[1] = f.kind == EDGE_EDGE ? f.x : 0.25;
    p[size - 1] = 1;
    memcpy(to + size * i, p, size * sizeof *p);
    to[size * i + size - 1] = f.height;
  }
  memcpy(from + size * moving, rest, (all - size * moving) * sizeof *from);
  memcpy(to + size * moving, rest, (all - size * moving) * sizeof *to);
  return all;
}

static dsw_pair_touch sweep(fall f) {
  double from[12], to[12];
  dsw_pair_touch touch;
  memset(&touch, 0x55, sizeof touch);
  put(f, from, to);
  CHECK_OK(dsw_sweep_pairs(NULL, f.kind == VERTEX_EDGE ? 2 : 3, 1, &f.kind, from, to, 0, 0, &touch));
  CHECK(touch.rank == 0);
  return touch;
}

static int is_touch(dsw_pair_touch touch, double time) { return touch.touches == 1 && touch.time == time; }
static int is_none(dsw_pair_touch touch) { return touch.touches == 0 && touch.time == 0; }

static void times_are_the_largest_doubles_not_later(void) {
  static const uint8_t kinds[3] = {VERTEX_FACE, EDGE_EDGE, VERTEX_EDGE};
  size_t i;
  for (i = 0; i < 3; ++i) {
    fall f;
    f.kind = kinds[i];
    f.x = 0.25;
    f.height = -1;
    CHECK(is_touch(sweep(f), 0.5));
    f.height = -2;
    CHECK(is_touch(sweep(f), 1.0 / 3));
    f.height = -9; /* a tenth; the nearest double is later */
    CHECK(is_touch(sweep(f), nextafter(0.1, 0)));
    f.height = 0; /* at the end */
    CHECK(is_touch(sweep(f), 1));
    f.height = 5e-324;
    CHECK(is_none(sweep(f)));
    f.height = 1;
    CHECK(is_none(sweep(f)));
    f.height = -1;
    f.x = 2; /* beside */
    CHECK(is_none(sweep(f)));
  }
}

static void ends_and_sides_belong_to_features(void) {
  fall f = {VERTEX_FACE, 0.75, -1};
  CHECK(is_touch(sweep(f), 0.5)); /* the long side of the triangle */
  f.x = nextafter(0.75, 1);
  CHECK(is_none(sweep(f)));
  f.kind = EDGE_EDGE;
  f.x = 1;
  CHECK(is_touch(sweep(f), 0.5)); /* an end */
  f.x = nextafter(1, 2);
  CHECK(is_none(sweep(f)));
  f.kind = VERTEX_EDGE;
  f.x = 1;
  CHECK(is_touch(sweep(f), 0.5));
  f.x = nextafter(1, 2);
  CHECK(is_none(sweep(f)));
}

static void pairs_without_extent_touch(void) {
  /* A vertex meets a triangle that is a point; edges along one line meet; a vertex and an edge that lies at a point. */
  static const double from[24] = {0, 0, 0, 4, 0, 0, 4, 0, 0, 4, 0, 0, 0, 1, 0, 1, 1, 0, 3, 1, 0, 5, 1, 0};
  static const double to[24] = {4, 0, 0, 4, 0, 0, 4, 0, 0, 4, 0, 0, 4, 1, 0, 5, 1, 0, 3, 1, 0, 5, 1, 0};
  static const double flat_from[6] = {0, 0, 3, 3, 3, 3}, flat_to[6] = {6, 6, 3, 3, 3, 3};
  static const uint8_t kinds[2] = {VERTEX_FACE, EDGE_EDGE}, flat_kind = VERTEX_EDGE;
  dsw_pair_touch touches[2];
  CHECK_OK(dsw_sweep_pairs(NULL, 3, 2, kinds, from, to, 0, DSW_PAIRS_RANK, touches));
  CHECK(is_touch(touches[0], 1) && is_touch(touches[1], 0.5) && touches[0].rank == 1 && touches[1].rank == 0);
  CHECK_OK(dsw_sweep_pairs(NULL, 3, 2, kinds, from, from, 0, 0, touches));
  CHECK(is_none(touches[0]) && is_none(touches[1]));
  CHECK_OK(dsw_sweep_pairs(NULL, 2, 1, &flat_kind, flat_from, flat_to, 0, 0, touches));
  CHECK(is_touch(touches[0], 0.5));
  CHECK_OK(dsw_sweep_pairs(NULL, 2, 1, &flat_kind, flat_to, flat_to, 0, 0, touches));
  CHECK(is_none(touches[0]));
}

static void ranks_are_exact(void) {
  /* The first time is 2^-52 / 9 later than a third, which no double tells. */
  static const fall falls[7] = {{VERTEX_FACE, 0.25, -2 + 0x1p-52},
                                {EDGE_EDGE, 0.25, -2},
                                {VERTEX_FACE, 0.25, 0.5},
                                {VERTEX_FACE, 0.5, -2},
                                {VERTEX_FACE, 0, -1},
                                {EDGE_EDGE, 0, -9},
                                {EDGE_EDGE, 7, -1}};
  static const uint32_t ranks[7] = {3, 1, 5, 1, 4, 0, 5};
  double from[84], to[84];
  uint8_t kinds[7];
  dsw_pair_touch touches[7], again[7];
  size_t i;
  for (i = 0; i < 7; ++i) {
    kinds[i] = falls[i].kind;
    put(falls[i], from + 12 * i, to + 12 * i);
  }
  memset(touches, 0x55, sizeof touches);
  CHECK_OK(dsw_sweep_pairs(NULL, 3, 7, kinds, from, to, 0, DSW_PAIRS_RANK, touches));
  for (i = 0; i < 7; ++i) CHECK(touches[i].rank == ranks[i]);
  CHECK(touches[0].time == touches[1].time && is_touch(touches[1], 1.0 / 3) && is_none(touches[2]));
  CHECK_OK(dsw_sweep_pairs(NULL, 3, 7, kinds, from, to, 0, 0, again));
  for (i = 0; i < 7; ++i) {
    CHECK(again[i].rank == 0 && again[i].time == touches[i].time && again[i].touches == touches[i].touches);
  }
}

static void points_lie_a_stride_apart(void) {
  const fall f = {EDGE_EDGE, 0.25, -2};
  double from[12], to[12], wide_from[20], wide_to[20];
  const uint8_t kind = EDGE_EDGE;
  dsw_pair_touch touch;
  size_t i, k;
  put(f, from, to);
  for (i = 0; i < 20; ++i) wide_from[i] = wide_to[i] = (double)NAN; /* what is between is not read */
  for (i = 0; i < 4; ++i) {
    for (k = 0; k < 3; ++k) {
      wide_from[5 * i + k] = from[3 * i + k];
      wide_to[5 * i + k] = to[3 * i + k];
    }
  }
  CHECK_OK(dsw_sweep_pairs(NULL, 3, 1, &kind, wide_from, wide_to, 40, 0, &touch));
  CHECK(is_touch(touch, 1.0 / 3));
}

/* Half a turn about z, from -y over x to y, and a wall where x is `far`. */
static const double half_turn[17] = {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};

static dsw_pair_touch turn(unsigned dimension, double far, double end_of_wall, uint32_t second) {
  double from[12] = {0, -5, 0, 0, -9, -9, 0, 9, -9, 0, 0, 15}, to[12];
  const double planar[6] = {0, -5, 0, -9, 0, 9};
  const uint8_t kind = dimension == 2 ? VERTEX_EDGE : VERTEX_FACE;
  const uint32_t indices[2] = {0, second};
  dsw_pair_touch touch;
  size_t i;
  if (dimension == 2) memcpy(from, planar, sizeof planar);
  for (i = 1; i <= dimension; ++i) from[dimension * i] = far;
  memcpy(to, from, sizeof to);
  for (i = 1; i <= dimension; ++i) to[dimension * i] = end_of_wall;
  memset(&touch, 0x55, sizeof touch);
  CHECK_OK(dsw_sweep_rigid_pairs(NULL, dimension, 1, &kind, from, far == end_of_wall ? NULL : to, 0, half_turn, 1,
                                 indices, 0, &touch));
  return touch;
}

static void features_turn_on_arcs(void) {
  const uint32_t none = UINT32_MAX;
  unsigned dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    CHECK(is_touch(turn(dimension, 5, 5, none), 0.5)); /* the arc grazes the wall */
    CHECK(is_none(turn(dimension, nextafter(5, 6), nextafter(5, 6), none)));
    CHECK(is_touch(turn(dimension, 3, 3, none), 0.25)); /* q = (0, 0, 1, 3) / 4 */
    CHECK(is_none(turn(dimension, 9, 6, none)));
    CHECK(is_touch(turn(dimension, 10, 0, none), 0.5)); /* it meets the wall that comes */
    CHECK(is_none(turn(dimension, 2, 2, 0)));           /* both on one motion */
  }
}

static void bad_motions_are_refused(void) {
  double from[12], to[12], motion[17];
  uint8_t kind = VERTEX_FACE, planar = VERTEX_EDGE;
  uint32_t indices[2] = {0, UINT32_MAX};
  dsw_pair_touch touch;
  const fall f = {VERTEX_FACE, 0.25, -1};
  put(f, from, to);
  memcpy(motion, half_turn, sizeof motion);
  memset(&touch, 0x55, sizeof touch);
#define SWEEP(dimension, kind, from, motions, count, indices, touches) \
  dsw_sweep_rigid_pairs(NULL, dimension, 1, kind, from, NULL, 0, motions, count, indices, 0, touches)
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(3, &kind, NULL, motion, 1, indices, &touch));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(3, &kind, from, NULL, 1, indices, &touch));
  CHECK_MESSAGE("motions is null");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(3, &kind, from, motion, 1, NULL, &touch));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(3, &kind, from, motion, 1, indices, NULL));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, SWEEP(4, &kind, from, motion, 1, indices, &touch));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, SWEEP(2, &kind, from, motion, 1, indices, &touch));
  indices[1] = 1;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, SWEEP(3, &kind, from, motion, 1, indices, &touch));
  CHECK_MESSAGE("indices[1] is 1, must be below 1 or UINT32_MAX");
  indices[1] = UINT32_MAX;
  motion[12] = (double)NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, SWEEP(3, &kind, from, motion, 1, indices, &touch));
  CHECK_MESSAGE("motions[0][12] is nan, must be finite");
  motion[12] = 0;
  motion[6] = 0;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, SWEEP(3, &kind, from, motion, 1, indices, &touch));
  CHECK_MESSAGE("motions[0] has a quaternion that is 0 at some time");
  motion[7] = -3; /* from 1 to -3 */
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, SWEEP(3, &kind, from, motion, 1, indices, &touch));
  motion[4] = 1;
  CHECK_OK(SWEEP(3, &kind, from, motion, 1, indices, &touch));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, SWEEP(2, &planar, from, motion, 1, indices, &touch));
  CHECK_MESSAGE("motions[0][4] is 1, must be 0 in the plane");
  CHECK_OK(dsw_sweep_rigid_pairs(NULL, 3, 0, NULL, NULL, NULL, 0, NULL, 0, NULL, DSW_PAIRS_RANK, NULL));
#undef SWEEP
}

/* Without motions both functions say one thing. */
static void straight_pairs_are_those_of_the_other_function(void) {
  double from[24], to[24];
  const uint8_t kinds[2] = {VERTEX_FACE, EDGE_EDGE};
  const uint32_t indices[4] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX};
  const fall falls[2] = {{VERTEX_FACE, 0.25, -2 + 0x1p-52}, {EDGE_EDGE, 0.25, -2}};
  dsw_pair_touch touches[2], others[2];
  put(falls[0], from, to);
  put(falls[1], from + 12, to + 12);
  CHECK_OK(dsw_sweep_pairs(NULL, 3, 2, kinds, from, to, 0, DSW_PAIRS_RANK, touches));
  CHECK_OK(dsw_sweep_rigid_pairs(NULL, 3, 2, kinds, from, to, 0, NULL, 0, indices, DSW_PAIRS_RANK, others));
  CHECK(memcmp(touches, others, sizeof touches) == 0 && touches[0].rank == 1);
}

static void bad_arguments_change_nothing(void) {
  double from[24], to[24];
  uint8_t kinds[2] = {VERTEX_FACE, EDGE_EDGE}, planar[2] = {VERTEX_EDGE, VERTEX_EDGE};
  dsw_pair_touch touches[2], before[2];
  dsw_environment *const environment = make_environment(NULL, 1, 1, 1);
  const fall falls[2] = {{VERTEX_FACE, 0.25, -1}, {EDGE_EDGE, 0.25, -1}};
  put(falls[0], from, to);
  put(falls[1], from + 12, to + 12);
  memset(touches, 0x55, sizeof touches);
  memcpy(before, touches, sizeof touches);
#define SWEEP(dimension, count, kinds, from, to, stride, flags, touches) \
  dsw_sweep_pairs(NULL, dimension, count, kinds, from, to, stride, flags, touches)
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(3, 2, NULL, from, to, 0, 0, touches));
  CHECK_MESSAGE("kinds is null");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(3, 2, kinds, NULL, to, 0, 0, touches));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(3, 2, kinds, from, NULL, 0, 0, touches));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(3, 2, kinds, from, to, 0, 0, NULL));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, SWEEP(0, 2, kinds, from, to, 0, 0, touches));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, SWEEP(4, 2, kinds, from, to, 0, 0, touches));
  CHECK_MESSAGE("dimension is 4, must be 2 or 3");
  CHECK_FAILS(DSW_STATUS_TOO_LARGE, SWEEP(3, ((size_t)1 << 28) + 1, kinds, from, to, 0, 0, touches));
  CHECK_FAILS(DSW_STATUS_TOO_LARGE, SWEEP(3, SIZE_MAX, kinds, from, to, 0, 0, touches));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, SWEEP(3, 2, kinds, from, to, 16, 0, touches));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, SWEEP(3, 2, kinds, from, to, 25, 0, touches));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, SWEEP(3, 2, kinds, from, to, 0, 2, touches));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, SWEEP(2, 2, kinds, from, to, 0, 0, touches));
  CHECK_MESSAGE("kinds[0] is 0, must be 2 .. 2 in dimension 2");
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, SWEEP(3, 2, planar, from, to, 0, 0, touches));
  kinds[1] = 3;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, SWEEP(3, 2, kinds, from, to, 0, 0, touches));
  CHECK_MESSAGE("kinds[1] is 3, must be 0 .. 1 in dimension 3");
  kinds[1] = EDGE_EDGE;
  to[16] = HUGE_VAL;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, SWEEP(3, 2, kinds, from, to, 0, 0, touches));
  CHECK_MESSAGE("to[5][1] is inf, must be finite");
  to[16] = from[16];
  from[23] = (double)NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, SWEEP(3, 2, kinds, from, to, 0, 0, touches));
  from[23] = 0;
  CHECK_FAILS(DSW_STATUS_STALE_ID,
              dsw_sweep_pairs((const dsw_context *)(const void *)environment, 3, 2, kinds, from, to, 0, 0, touches));
  CHECK(memcmp(touches, before, sizeof touches) == 0);
  CHECK_OK(SWEEP(3, 0, NULL, NULL, NULL, 0, DSW_PAIRS_RANK, NULL));
  CHECK_OK(SWEEP(2, 0, kinds, from, to, 0, 0, touches));
  CHECK(memcmp(touches, before, sizeof touches) == 0);
  CHECK_OK(SWEEP(3, 2, kinds, from, to, 24, DSW_PAIRS_RANK, touches));
  CHECK(is_touch(touches[0], 0.5) && is_touch(touches[1], 0.5) && touches[0].rank == 0 && touches[1].rank == 0);
#undef SWEEP
  CHECK_OK(dsw_environment_destroy(environment));
}

/* Many pairs in a batch; times repeat. */
enum { COUNT = 3000 };

static void batches_are_the_same_for_any_sharing(unsigned dimension) {
  const size_t numbers = dimension == 2 ? 6 : 12;
  double *const points = malloc(2 * numbers * COUNT * sizeof *points), *const from = points,
                *const to = points + numbers * COUNT;
  dsw_pair_touch *const touches = malloc(3 * COUNT * sizeof *touches);
  uint8_t kinds[COUNT];
  dsw_context *contexts[2];
  dsw_context_desc two_threads;
  host h;
  size_t i, k, none = 0;
  contexts[0] = make_context(&h);
  dsw_context_desc_init(&two_threads, sizeof two_threads);
  two_threads.thread_count = 2;
  CHECK_OK(dsw_context_create(&two_threads, &contexts[1]));
  for (i = 0; i < COUNT; ++i) {
    fall f;
    f.kind = (uint8_t)(dimension == 2 ? VERTEX_EDGE : i % 3 == 0 ? EDGE_EDGE : VERTEX_FACE);
    f.x = (double)(i % 5) / 4;
    f.height = 0.75 - (double)(i * 7919 % 97) / 16;
    kinds[i] = f.kind;
    put(f, from + numbers * i, to + numbers * i);
  }
  memset(touches, 0x55, 3 * COUNT * sizeof *touches);
  CHECK_OK(dsw_sweep_pairs(NULL, dimension, COUNT, kinds, from, to, 0, DSW_PAIRS_RANK, touches));
  for (k = 0; k < 2; ++k) {
    dsw_pair_touch *const again = touches + (k + 1) * COUNT;
    CHECK_OK(dsw_sweep_pairs(contexts[k], dimension, COUNT, kinds, from, to, 0, DSW_PAIRS_RANK, again));
    CHECK(memcmp(touches, again, COUNT * sizeof *touches) == 0);
  }
  CHECK(h.parallel_calls == 1 && h.tasks > 1 && h.calls > 0);
  for (i = 0; i < COUNT; ++i) none += touches[i].touches == 0;
  CHECK(none > 100 && none < COUNT - 100);
  for (i = 0; i < COUNT; ++i) {
    dsw_pair_touch one;
    uint32_t rank = 0;
    for (k = 0; k < COUNT; ++k) {
      rank += touches[k].touches != 0 && (touches[i].touches == 0 || touches[k].time < touches[i].time);
    }
    CHECK(touches[i].rank == rank); /* different times differ as doubles, too */
    if (i % 29 != 0) continue;
    CHECK_OK(dsw_sweep_pairs(NULL, dimension, 1, kinds + i, from + numbers * i, to + numbers * i, 0, 0, &one));
    CHECK(one.time == touches[i].time && one.touches == touches[i].touches);
  }
  CHECK_OK(dsw_context_destroy(contexts[1]));
  end_context(contexts[0], &h);
  free(points);
  free(touches);
}

int main(void) {
  times_are_the_largest_doubles_not_later();
  ends_and_sides_belong_to_features();
  pairs_without_extent_touch();
  ranks_are_exact();
  points_lie_a_stride_apart();
  features_turn_on_arcs();
  bad_motions_are_refused();
  straight_pairs_are_those_of_the_other_function();
  bad_arguments_change_nothing();
  check_in("in the plane");
  batches_are_the_same_for_any_sharing(2);
  check_in("in space");
  batches_are_the_same_for_any_sharing(3);
  return check_result();
}
