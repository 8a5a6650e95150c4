#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* 4 x 4 x 3 cubes. Most edges here move in the plane z = 1.5: from (0.25, 0.5) to (3.25, 0.5), the fixed end at
   (2.25, 3.5). The face and the marked below are met inside that triangle, halfway, at (2, 2, 1.5). */
enum { NX = 4, NY = 4, NZ = 3, BEFORE = 1 + NX * (1 + NY), BEHIND = BEFORE + 1 };

static dsw_environment *g_env;
static const double g_from[3] = {0.25, 0.5, 1.5}, g_to[3] = {3.25, 0.5, 1.5}, g_fixed[3] = {2.25, 3.5, 1.5};
static const double g_half[3] = {1.75, 0.5, 1.5}, g_touched[3] = {2, 2, 1.5};
static const double g_zero[3] = {0, 0, 0};

static uint32_t point_index(unsigned x, unsigned y, unsigned z) { return x + (NX + 1) * (y + (NY + 1) * z); }

static void mark_face(uint32_t volume, uint32_t local, dsw_mark mark) {
  CHECK_OK(set_face_mark(g_env, volume, local, mark));
}

static void mark_volume(uint32_t index, dsw_mark mark) { CHECK_OK(set_volume_mark(g_env, index, mark)); }

/* The edge of the grid from a point along z. */
static dsw_edge_id edge_along_z(unsigned x, unsigned y, unsigned z) {
  uint32_t ends[2];
  dsw_edge_id edge = {0, 0, 0};
  ends[0] = point_index(x, y, z);
  ends[1] = point_index(x, y, z + 1);
  CHECK_OK(dsw_environment_find_edges(g_env, 1, ends, &edge, NULL));
  return edge;
}

static dsw_sweep_options at_level(dsw_level level) {
  dsw_sweep_options o;
  dsw_sweep_options_init(&o, sizeof o);
  o.level = level;
  return o;
}

static dsw_sweep sweep_with(const dsw_sweep_options *options, dsw_volume_id start, const double *from, const double *to,
                            const double *fixed) {
  dsw_sweep s;
  memset(&s, 0x55, sizeof s);
  CHECK_OK(dsw_environment_sweep_edges(g_env, 1, &start, from, to, fixed, 0, options, &s));
  CHECK(s.contact.obstacle.generation != 0 || s.outcome != DSW_OUTCOME_CONTACT);
  return s;
}

static dsw_sweep sweep_at(dsw_level level, const double *from, const double *to, const double *fixed) {
  const dsw_sweep_options o = at_level(level);
  return sweep_with(&o, no_volume, from, to, fixed);
}

static int same_point(const double *a, const double *b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

static int is_volume(dsw_volume_id id, uint32_t index) { return id.index == index && id.generation == 1; }

static int is_edge(dsw_cell cell, dsw_edge_id edge) {
  return cell.kind == DSW_CELL_EDGE && cell.index == edge.volume && cell.generation == edge.generation &&
         cell.local == edge.local;
}

static int is_face(dsw_face_id id, uint32_t volume, uint32_t local) {
  return id.volume == volume && id.generation == 1 && id.local == local;
}

static int is_near(const double *a, double x, double y, double z) {
  return fabs(a[0] - x) < 1e-15 && fabs(a[1] - y) < 1e-15 && fabs(a[2] - z) < 1e-15;
}

static int has_no_contact(const dsw_sweep *s) {
  return same_point(s->contact.normal, g_zero) && s->contact.front.generation == 0 && s->contact.wall.generation == 0 &&
         s->contact.obstacle.generation == 0 && s->contact.kind == DSW_CONTACT_NONE &&
         s->contact.marked_kind == DSW_CELL_NONE && s->contact.tag == 0;
}

static int reached(const dsw_sweep *s, const double *to, uint32_t volume) {
  return s->outcome == DSW_OUTCOME_REACHED && s->time == 1 && same_point(s->position, to) &&
         is_volume(s->volume, volume) && s->volumes_visited >= 1 && has_no_contact(s);
}

static int stayed(const dsw_sweep *s, dsw_outcome outcome, const double *from) {
  return s->outcome == outcome && s->time == 0 && same_point(s->position, from) && has_no_contact(s);
}

/* Reports that differ at most in the work they took. */
static int same_but_work(dsw_sweep a, dsw_sweep b) {
  a.volumes_visited = b.volumes_visited = 0;
  return memcmp(&a, &b, sizeof a) == 0;
}

static void init_writes_the_defaults(void) {
  dsw_sweep_options o;
  memset(&o, 0xff, sizeof o);
  dsw_sweep_options_init(&o, sizeof o);
  CHECK(o.struct_size == sizeof o && o.flags == 0 && o.level == DSW_LEVEL_EDGES_SWEPT && o.max_volumes == 0);
  memset(&o, 0xff, sizeof o);
  dsw_sweep_options_init(&o, 8); /* a shorter struct than ours */
  CHECK(o.struct_size == 8 && o.flags == 0 && o.max_volumes == 0xffffffffu);
  dsw_sweep_options_init(NULL, sizeof o);
}

static void an_edge_comes_through(void) {
  const dsw_sweep s = sweep_at(DSW_LEVEL_EDGES_SWEPT, g_from, g_to, g_fixed);
  int level;
  CHECK(reached(&s, g_to, 3 + NX * NY));
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES; ++level) {
    const dsw_sweep less = sweep_at((dsw_level)level, g_from, g_to, g_fixed);
    CHECK(same_but_work(less, s) && less.volumes_visited <= s.volumes_visited);
  }
  CHECK(same_but_work(s, sweep_with(NULL, no_volume, g_from, g_to, g_fixed)));
}

/* What only the triangle holds is found at EDGES_SWEPT and missed below. */
static dsw_sweep met_half_way(dsw_cell_kind marked_kind, dsw_edge_id edge) {
  const double length = sqrt(9.25);
  dsw_sweep s;
  int level;
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES; ++level) {
    s = sweep_at((dsw_level)level, g_from, g_to, g_fixed);
    CHECK(reached(&s, g_to, 3 + NX * NY));
  }
  s = sweep_at(DSW_LEVEL_EDGES_SWEPT, g_from, g_to, g_fixed);
  CHECK(s.outcome == DSW_OUTCOME_CONTACT && s.contact.kind == DSW_CONTACT_EDGE && s.contact.marked_kind == marked_kind);
  CHECK(s.time == 0.5 && same_point(s.position, g_half) && same_point(s.point, g_touched) && s.edge_parameter == 0.5);
  CHECK(is_near(s.contact.normal, -3 / length, 0.5 / length, 0));
  CHECK(is_volume(s.volume, NX * NY) && s.contact.front.generation == 1 && is_edge(s.contact.obstacle, edge));
  return s;
}

static void a_free_standing_face_is_met_by_the_edge(void) {
  const dsw_edge_id rim = edge_along_z(2, 2, 1);
  const double length = sqrt(9.25);
  dsw_sweep s;
  mark_face(BEHIND, FACE_X0, DSW_MARK_IMPASSABLE);
  s = met_half_way(DSW_CELL_FACE, rim);
  CHECK(is_volume(s.contact.front, BEFORE) && is_face(s.contact.wall, BEFORE, FACE_X1));
  CHECK(s.contact.tag == 100 + BEHIND && s.volumes_visited >= 4);
  { /* from the other side: the mirror image, and the tag of what is behind then */
    const double from[3] = {3.75, 0.5, 1.5}, to[3] = {0.75, 0.5, 1.5}, fixed[3] = {1.75, 3.5, 1.5};
    s = sweep_at(DSW_LEVEL_EDGES_SWEPT, from, to, fixed);
    CHECK(s.outcome == DSW_OUTCOME_CONTACT && s.contact.kind == DSW_CONTACT_EDGE && s.time == 0.5 &&
          s.edge_parameter == 0.5);
    CHECK(s.position[0] == 2.25 && same_point(s.point, g_touched) &&
          is_near(s.contact.normal, 3 / length, 0.5 / length, 0));
    CHECK(is_volume(s.volume, 3 + NX * NY) && is_volume(s.contact.front, BEHIND) &&
          is_face(s.contact.wall, BEFORE, FACE_X1));
    CHECK(is_edge(s.contact.obstacle, rim) && s.contact.tag == 100 + BEFORE);
  }
  mark_face(BEHIND, FACE_X0, DSW_MARK_PASSABLE);
}

static void a_marked_edge_is_met_by_the_edge(void) {
  const dsw_edge_id marked = edge_along_z(2, 2, 1);
  dsw_sweep s;
  CHECK_OK(dsw_environment_mark_edges(g_env, &marked, 1, DSW_MARK_IMPASSABLE));
  s = met_half_way(DSW_CELL_EDGE, marked);
  CHECK(s.contact.wall.volume == 0 && s.contact.wall.generation == 0 && s.contact.wall.local == 0 &&
        s.contact.tag == 0);
  CHECK_OK(dsw_environment_mark_edges(g_env, &marked, 1, DSW_MARK_PASSABLE));
}

/* The moving end, ahead of the rest of its edge, meets a wall at x half-way. */
static void the_end_meets(uint32_t x, dsw_cell_kind marked_kind, uint32_t tag) {
  const double from[3] = {0.5, 0.25, 1.5}, fixed[3] = {0.5, 1.75, 1.5};
  const double to[3] = {2 * x - 0.5, 0.25, 1.5}, met[3] = {x, 0.25, 1.5};
  const uint32_t front = x - 1 + NX * NY;
  int level;
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
    const dsw_sweep s = sweep_at((dsw_level)level, from, to, fixed);
    CHECK(s.outcome == DSW_OUTCOME_CONTACT && s.contact.kind == DSW_CONTACT_PLANE &&
          s.contact.marked_kind == marked_kind);
    CHECK(s.time == 0.5 && same_point(s.position, met) && same_point(s.point, met) && s.edge_parameter == 0);
    CHECK(s.contact.normal[0] == -1 && s.contact.normal[1] == 0 && s.contact.normal[2] == 0 &&
          s.contact.obstacle.kind == DSW_CELL_FACE);
    CHECK(is_volume(s.contact.front, front) && is_face(s.contact.wall, front, FACE_X1) && s.contact.tag == tag);
    CHECK(is_volume(s.volume, NX * NY));
  }
}

static void the_moving_end_meets_a_face(void) {
  mark_volume(2 + NX * NY, DSW_MARK_IMPASSABLE);
  the_end_meets(2, DSW_CELL_VOLUME, 100 + 2 + NX * NY);
  mark_volume(2 + NX * NY, DSW_MARK_PASSABLE);
}

static void the_outer_boundary_is_met(void) { the_end_meets(4, DSW_CELL_FACE, 100 + 3 + NX * NY); }

/* A fifth of the way has no double: it is the largest one before, not the nearest. */
static void a_time_is_rounded_down(void) {
  const double from[3] = {1.5, 0.25, 1.5}, to[3] = {4, 0.25, 1.5}, fixed[3] = {1.5, 1.75, 1.5};
  dsw_sweep s;
  mark_face(1 + NX * NY, FACE_X1, DSW_MARK_IMPASSABLE);
  s = sweep_at(DSW_LEVEL_EDGES_SWEPT, from, to, fixed);
  CHECK(s.outcome == DSW_OUTCOME_CONTACT && s.time == nextafter(0.2, 0) && s.point[0] == 2);
  mark_face(1 + NX * NY, FACE_X1, DSW_MARK_PASSABLE);
}

/* The new place of the edge crosses the face, the path of its end does not. */
static void a_hit_at_edges_is_reported_as_swept(void) {
  const double to[3] = {1.9375, 0.5, 1.5};
  dsw_sweep s, swept;
  mark_face(BEFORE, FACE_X1, DSW_MARK_IMPASSABLE);
  s = sweep_at(DSW_LEVEL_POINTS, g_from, to, g_fixed);
  CHECK(reached(&s, to, 1 + NX * NY));
  s = sweep_at(DSW_LEVEL_EDGES, g_from, to, g_fixed);
  swept = sweep_at(DSW_LEVEL_EDGES_SWEPT, g_from, to, g_fixed);
  CHECK(s.outcome == DSW_OUTCOME_CONTACT && s.contact.kind == DSW_CONTACT_EDGE && same_but_work(s, swept));
  CHECK(s.time <= 1.5 / 1.6875 && s.time > 0.8888 && same_point(s.point, g_touched) && s.edge_parameter == 0.5);
  mark_face(BEFORE, FACE_X1, DSW_MARK_PASSABLE);
}

static void degenerate_edges_have_answers(void) {
  const double from[3] = {0.5, 0.25, 1.5}, to[3] = {3.5, 0.25, 1.5}, met[3] = {2, 0.25, 1.5};
  int level;
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
    dsw_sweep s = sweep_at((dsw_level)level, g_from, g_from, g_fixed); /* p = p' */
    CHECK(reached(&s, g_from, NX * NY));
    s = sweep_at((dsw_level)level, g_from, g_to, g_from); /* p = q */
    CHECK(reached(&s, g_to, 3 + NX * NY));
    s = sweep_at((dsw_level)level, g_from, g_to, g_to); /* p' = q: it shrinks to a point */
    CHECK(reached(&s, g_to, 3 + NX * NY));
    s = sweep_at((dsw_level)level, g_from, g_half, g_to); /* all on one line */
    CHECK(reached(&s, g_half, 1 + NX * NY));
    s = sweep_at((dsw_level)level, g_from, g_from, g_from); /* a point at rest */
    CHECK(reached(&s, g_from, NX * NY));
    mark_face(1 + NX * NY, FACE_X1, DSW_MARK_IMPASSABLE);
    s = sweep_at((dsw_level)level, from, to, from); /* p = q, and a wall in the way */
    CHECK(s.outcome == DSW_OUTCOME_CONTACT && s.contact.kind == DSW_CONTACT_PLANE && s.time == 0.5 &&
          s.edge_parameter == 0);
    CHECK(same_point(s.position, met) && same_point(s.point, met) && s.contact.normal[0] == -1);
    CHECK(is_volume(s.contact.front, 1 + NX * NY) && is_face(s.contact.wall, 1 + NX * NY, FACE_X1));
    mark_face(1 + NX * NY, FACE_X1, DSW_MARK_PASSABLE);
  }
}

static void an_edge_that_can_not_start_says_so(void) {
  const double outside[3] = {-1, 0.5, 1.5}, beyond[3] = {3.25, 5, 1.5};
  int level;
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
    dsw_sweep s = sweep_at((dsw_level)level, outside, g_to, g_fixed);
    CHECK(stayed(&s, DSW_OUTCOME_OUTSIDE, outside) && s.volume.generation == 0 && s.volumes_visited == 0);
    mark_volume(NX * NY, DSW_MARK_IMPASSABLE);
    s = sweep_at((dsw_level)level, g_from, g_to, g_fixed);
    CHECK(stayed(&s, DSW_OUTCOME_IMPASSABLE, g_from) && is_volume(s.volume, NX * NY));
    mark_volume(NX * NY, DSW_MARK_PASSABLE);
    s = sweep_at((dsw_level)level, g_from, g_to, beyond); /* the fixed end is outside */
    CHECK(stayed(&s, DSW_OUTCOME_IMPASSABLE, g_from) && is_volume(s.volume, NX * NY));
    mark_face(BEFORE, FACE_X0, DSW_MARK_IMPASSABLE); /* p q goes through it */
    s = sweep_at((dsw_level)level, g_from, g_to, g_fixed);
    CHECK(stayed(&s, DSW_OUTCOME_IMPASSABLE, g_from) && is_volume(s.volume, NX * NY));
    mark_face(BEFORE, FACE_X0, DSW_MARK_PASSABLE);
  }
}

/* What is known to hold costs less and changes nothing else. */
static void known_starts_change_no_answer(void) {
  const dsw_volume_id start = volume_at(NX * NY), elsewhere = volume_at(2);
  dsw_sweep_options o = at_level(DSW_LEVEL_EDGES_SWEPT);
  dsw_sweep plain, s;
  uint32_t flags;
  mark_face(BEFORE, FACE_X1, DSW_MARK_IMPASSABLE);
  plain = sweep_with(&o, no_volume, g_from, g_to, g_fixed);
  CHECK(plain.outcome == DSW_OUTCOME_CONTACT);
  s = sweep_with(&o, elsewhere, g_from, g_to, g_fixed); /* a hint only */
  CHECK(same_but_work(s, plain));
  for (flags = 0; flags < 4; ++flags) {
    o.flags = ((flags & 1) != 0 ? DSW_SWEEP_START_KNOWN : 0u) | ((flags & 2) != 0 ? DSW_SWEEP_START_FREE : 0u);
    s = sweep_with(&o, start, g_from, g_to, g_fixed);
    CHECK(same_but_work(s, plain) && s.volumes_visited <= plain.volumes_visited);
  }
  mark_face(BEFORE, FACE_X1, DSW_MARK_PASSABLE);
  mark_volume(NX * NY, DSW_MARK_IMPASSABLE);
  s = sweep_with(&o, start, g_from, g_to, g_fixed);
  CHECK(stayed(&s, DSW_OUTCOME_IMPASSABLE, g_from) && is_volume(s.volume, NX * NY));
  mark_volume(NX * NY, DSW_MARK_PASSABLE);
}

static void work_is_limited(void) {
  int level;
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
    dsw_sweep_options o = at_level((dsw_level)level);
    const dsw_sweep whole = sweep_with(&o, no_volume, g_from, g_to, g_fixed);
    for (o.max_volumes = 1; o.max_volumes <= whole.volumes_visited; ++o.max_volumes) {
      const dsw_sweep s = sweep_with(&o, no_volume, g_from, g_to, g_fixed);
      CHECK(s.volumes_visited <= o.max_volumes);
      if (o.max_volumes == whole.volumes_visited) {
        CHECK(memcmp(&s, &whole, sizeof s) == 0);
      } else {
        CHECK(stayed(&s, DSW_OUTCOME_WORK_LIMIT, g_from) && is_volume(s.volume, NX * NY));
      }
    }
  }
}

static void options_are_checked(void) {
  struct {
    dsw_sweep_options known;
    uint32_t unknown;
  } newer;
  dsw_sweep_options o = at_level(DSW_LEVEL_EDGES_SWEPT);
  dsw_sweep s;
  int bad_level;
  o.flags = 0x10;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_sweep_edges(g_env, 1, NULL, g_from, g_to, g_fixed, 0, &o, &s));
  CHECK_MESSAGE("dsw_environment_sweep_edges: options->flags is 0x10, this version knows 0x3");
  for (bad_level = 0; bad_level <= 4; bad_level += 4) {
    o = at_level((dsw_level)bad_level);
    CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_sweep_edges(g_env, 1, NULL, g_from, g_to, g_fixed, 0, &o, &s));
    CHECK_MESSAGE("options->level is ");
    CHECK_MESSAGE(", must be 1 .. 3 here");
  }
  o = at_level(DSW_LEVEL_EDGES_SWEPT);
  o.struct_size = sizeof o - 4;
  CHECK_FAILS(DSW_STATUS_BAD_STRUCT_SIZE,
              dsw_environment_sweep_edges(g_env, 1, NULL, g_from, g_to, g_fixed, 0, &o, &s));
  CHECK_MESSAGE("options->struct_size is 12, must be at least 16");
  o.struct_size = 4097;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_sweep_edges(g_env, 1, NULL, g_from, g_to, g_fixed, 0, &o, &s));
  memset(&newer, 0, sizeof newer); /* of a later header */
  newer.known = at_level(DSW_LEVEL_EDGES_SWEPT);
  newer.known.struct_size = sizeof newer;
  CHECK_OK(dsw_environment_sweep_edges(g_env, 1, NULL, g_from, g_to, g_fixed, 0, &newer.known, &s));
  newer.unknown = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED,
              dsw_environment_sweep_edges(g_env, 1, NULL, g_from, g_to, g_fixed, 0, &newer.known, &s));
  CHECK_MESSAGE("non-zero byte at 16");
}

static void bad_arguments_change_nothing(void) {
  const double points[6] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5};
  const double nan_point[6] = {0.5, 0.5, 0.5, 1.5, 0.5, NAN}, infinite[6] = {0.5, -INFINITY, 0.5, 1.5, 0.5, 0.5};
  const dsw_volume_id starts[2] = {{0, 1}, {NX * NY * NZ, 1}}, stale[2] = {{0, 7}, {0, 0}};
  dsw_sweep s[2], before[2];
  memset(s, 0x55, sizeof s);
  memcpy(before, s, sizeof s);
#define SWEEP(env, starts, from, to, fixed, stride, out) \
  dsw_environment_sweep_edges(env, 2, starts, from, to, fixed, stride, NULL, out)
  CHECK_FAILS(DSW_STATUS_NON_FINITE, SWEEP(g_env, NULL, nan_point, points, points, 0, s));
  CHECK_MESSAGE("dsw_environment_sweep_edges: from[1][2] is nan, must be finite");
  CHECK_FAILS(DSW_STATUS_NON_FINITE, SWEEP(g_env, NULL, points, infinite, points, 0, s));
  CHECK_MESSAGE("to[0][1] is -inf");
  CHECK_FAILS(DSW_STATUS_NON_FINITE, SWEEP(g_env, NULL, points, points, nan_point, 0, s));
  CHECK_MESSAGE("fixed[1][2] is nan");
  CHECK_FAILS(DSW_STATUS_STALE_ID, SWEEP(g_env, starts, points, points, points, 0, s));
  CHECK_MESSAGE("starts[1] {index 48, generation 1}");
  CHECK_FAILS(DSW_STATUS_STALE_ID, SWEEP(g_env, stale, points, points, points, 0, s));
  CHECK_MESSAGE("starts[0] {index 0, generation 7}");
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, SWEEP(g_env, NULL, points, points, points, 8, s));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, SWEEP(g_env, NULL, points, points, points, 28, s));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE,
              dsw_environment_sweep_edges(g_env, SIZE_MAX / 16, NULL, points, points, points, 24, NULL, s));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(NULL, NULL, points, points, points, 0, s));
  CHECK_MESSAGE("environment is null");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(g_env, NULL, NULL, points, points, 0, s));
  CHECK_MESSAGE("from is null");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(g_env, NULL, points, NULL, points, 0, s));
  CHECK_MESSAGE("to is null");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(g_env, NULL, points, points, NULL, 0, s));
  CHECK_MESSAGE("fixed is null");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, SWEEP(g_env, NULL, points, points, points, 0, NULL));
  CHECK_MESSAGE("sweeps is null");
#undef SWEEP
  CHECK(memcmp(s, before, sizeof s) == 0);
  CHECK_OK(dsw_environment_sweep_edges(g_env, 0, NULL, NULL, NULL, NULL, 0, NULL, NULL));
}

/* A stride apart, and every edge as if alone. */
static void edges_lie_a_stride_apart(void) {
  double from[10], to[10], fixed[10];
  dsw_sweep s[2];
  int i, k;
  for (i = 0; i < 2; ++i) {
    for (k = 0; k < 3; ++k) {
      from[5 * i + k] = i == 0 ? g_from[k] : g_to[k];
      to[5 * i + k] = i == 0 ? g_to[k] : g_from[k];
      fixed[5 * i + k] = g_fixed[k];
    }
    for (; k < 5; ++k) from[5 * i + k] = to[5 * i + k] = fixed[5 * i + k] = NAN; /* not a coordinate */
  }
  memset(s, 0x55, sizeof s);
  CHECK_OK(dsw_environment_sweep_edges(g_env, 2, NULL, from, to, fixed, 40, NULL, s));
  CHECK(reached(&s[0], g_to, 3 + NX * NY) && reached(&s[1], g_from, NX * NY));
}

static void far_targets_are_values(void) {
  const double from[3] = {0.5, 0.25, 1.5}, to[3] = {1e300, -1e300, 1e300}, fixed[3] = {0.5, 1.75, 1.5};
  dsw_sweep s = sweep_at(DSW_LEVEL_EDGES_SWEPT, from, to, fixed);
  CHECK(s.outcome == DSW_OUTCOME_CONTACT && s.time >= 0 && s.time < 1e-299 && s.edge_parameter >= 0 &&
        s.edge_parameter <= 1);
  CHECK(s.position[0] >= 0 && s.position[0] <= 4 && s.position[1] >= 0 && s.position[1] <= 4);
  CHECK(s.point[0] >= 0 && s.point[0] <= 4 && s.point[1] >= 0 && s.point[1] <= 4);
}

/* Numbers of a small lattice, which make ties, and some outside. */
static double lattice_number(uint32_t *random, unsigned size) {
  *random = *random * 1664525u + 1013904223u;
  return (*random >> 16) % (size * 16 + 9) / 16.0 - 0.25;
}

static void mark_here_and_there(dsw_environment *environment) {
  dsw_face_id faces[8];
  dsw_edge_id wires[8];
  const dsw_volume_id solid = volume_at(BEHIND);
  uint32_t i;
  for (i = 0; i < 8; ++i) {
    faces[i] = face_at(5 * i + 1, i % 6);
    wires[i] = edge_at(4 * i + 2, (5 * i) % 12);
  }
  CHECK_OK(dsw_environment_mark_faces(environment, faces, 8, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_mark_edges(environment, wires, 8, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_mark_volumes(environment, &solid, 1, DSW_MARK_IMPASSABLE, 0, NULL));
}

/* One, four and a host's threads, hints, and one by one: the same bytes. */
static void batches_are_the_same_for_any_sharing(void) {
  enum { COUNT = 3000 };
  dsw_context_desc d;
  dsw_context *contexts[3] = {NULL, NULL, NULL};
  dsw_environment *env[3];
  double *const points = (double *)malloc(9 * COUNT * sizeof(double));
  const double *const from = points, *const to = points + 3 * COUNT, *const fixed = points + 6 * COUNT;
  dsw_sweep *const sweeps = (dsw_sweep *)malloc(2 * COUNT * sizeof(dsw_sweep)), *const again = sweeps + COUNT;
  dsw_volume_id *const starts = (dsw_volume_id *)malloc(COUNT * sizeof(dsw_volume_id));
  size_t i, k, outcomes[8] = {0, 0, 0, 0, 0, 0, 0, 0}, kinds[4] = {0, 0, 0, 0}, wires = 0;
  uint32_t random = 12345;
  host h;
  int level;
  for (i = 0; i < 9 * COUNT; ++i) points[i] = lattice_number(&random, i % 3 == 2 ? NZ : NX);
  dsw_context_desc_init(&d, sizeof d);
  for (k = 0; k < 2; ++k) {
    d.thread_count = k == 0 ? 1 : 4;
    CHECK_OK(dsw_context_create(&d, &contexts[k]));
  }
  contexts[2] = make_context(&h);
  for (k = 0; k < 3; ++k) {
    env[k] = make_environment(contexts[k], NX, NY, NZ);
    mark_here_and_there(env[k]);
  }
  CHECK_OK(dsw_environment_locate_points(env[0], from, COUNT, 0, NULL, starts, NULL));
  h.parallel_calls = h.tasks = 0;
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
    dsw_sweep_options o = at_level((dsw_level)level);
    memset(sweeps, 0xaa, COUNT * sizeof(dsw_sweep));
    CHECK_OK(dsw_environment_sweep_edges(env[0], COUNT, NULL, from, to, fixed, 0, &o, sweeps));
    for (k = 1; k < 3; ++k) {
      memset(again, 0x55, COUNT * sizeof(dsw_sweep)); /* no byte is left as it was */
      CHECK_OK(dsw_environment_sweep_edges(env[k], COUNT, NULL, from, to, fixed, 0, &o, again));
      CHECK(memcmp(sweeps, again, COUNT * sizeof(dsw_sweep)) == 0);
    }
    for (i = 0; i < COUNT; i += 29) {
      CHECK_OK(dsw_environment_sweep_edges(env[0], 1, NULL, from + 3 * i, to + 3 * i, fixed + 3 * i, 0, &o, again));
      CHECK(memcmp(sweeps + i, again, sizeof(dsw_sweep)) == 0);
    }
    o.flags = DSW_SWEEP_START_KNOWN;
    CHECK_OK(dsw_environment_sweep_edges(env[1], COUNT, starts, from, to, fixed, 0, &o, again));
    for (i = 0; i < COUNT; ++i) CHECK(same_but_work(sweeps[i], again[i]));
  }
  CHECK(h.parallel_calls == 3 && h.tasks > 3);
  for (i = 0; i < COUNT; ++i) {
    ++outcomes[sweeps[i].outcome];
    ++kinds[sweeps[i].contact.kind];
    wires += sweeps[i].contact.marked_kind == DSW_CELL_EDGE;
  }
  CHECK(outcomes[DSW_OUTCOME_REACHED] > 50 && outcomes[DSW_OUTCOME_OUTSIDE] > 50 && wires > 10);
  CHECK(outcomes[DSW_OUTCOME_IMPASSABLE] > 50 && kinds[DSW_CONTACT_PLANE] > 50 && kinds[DSW_CONTACT_EDGE] > 50);
  for (k = 0; k < 3; ++k) {
    CHECK_OK(dsw_environment_destroy(env[k]));
    CHECK_OK(dsw_context_destroy(contexts[k]));
  }
  CHECK(h.alive == 0 && !h.broken);
  free(points);
  free(sweeps);
  free(starts);
}

int main(void) {
  g_env = make_environment(NULL, NX, NY, NZ);
  init_writes_the_defaults();
  an_edge_comes_through();
  a_free_standing_face_is_met_by_the_edge();
  a_marked_edge_is_met_by_the_edge();
  the_moving_end_meets_a_face();
  a_time_is_rounded_down();
  the_outer_boundary_is_met();
  a_hit_at_edges_is_reported_as_swept();
  degenerate_edges_have_answers();
  an_edge_that_can_not_start_says_so();
  known_starts_change_no_answer();
  work_is_limited();
  options_are_checked();
  bad_arguments_change_nothing();
  edges_lie_a_stride_apart();
  far_targets_are_values();
  batches_are_the_same_for_any_sharing();
  CHECK_OK(dsw_environment_destroy(g_env));
  return check_result();
}
