/* How far a body could go: known fractions, beside the moves themselves, and that nothing moves. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../effort.h"
#include "check.h"
#include "draw.h"
#include "fixture.h"

enum { N = 4, POSES = 24, PATHS = 60, MOST_INDICES = 4 * PATHS };

static dsw_environment *make_grid(unsigned dimension, dsw_context *context, unsigned n) {
  return dimension == 2 ? make_squares(context, n, n) : make_environment(context, n, n, n);
}

/* A pose that turns about z. */
static void set_pose(double *pose, double degrees, double x, double y) {
  memset(pose, 0, 7 * sizeof *pose);
  pose[2] = sin(degrees * 0.00872664625997165);
  pose[3] = cos(degrees * 0.00872664625997165);
  pose[4] = x;
  pose[5] = y;
}

static void known_fractions(unsigned dimension) {
  const double rod[6] = {0.5, 0.5, 0.5, 0.9, 0.5, 0.5}, flat[4] = {0.5, 0.5, 0.9, 0.5}, centre[3] = {0.5, 0.5, 0.5};
  const uint32_t indices[] = {0, 1, 2, 3, 0, 4, 5, 0, 0, 0, 6, 0, 1}, offsets[] = {0, 5, 7, 8, 10, 11, 13};
  double poses[7 * 7];
  dsw_free_fraction f[6];
  dsw_body_contact contacts[6];
  dsw_environment *const env = make_grid(dimension, NULL, 1);
  dsw_scene *const scene = make_scene(env, 0);
  const dsw_body_id body = make_edge_body(scene, dimension == 2 ? flat : rod, DSW_LEVEL_EDGES_SWEPT);
  dsw_move_report report;
  dsw_rigid_motion m;
  set_pose(poses, 0, 0, 0);
  set_pose(poses + 7, 120, 0, 0);
  set_pose(poses + 14, 240, 0, 0);
  set_pose(poses + 21, 300, 0, 0);
  set_pose(poses + 28, 0, 0.2, 0); /* outside */
  set_pose(poses + 35, 0, 0, 0.25);
  set_pose(poses + 42, 90, 0, 0.25); /* through the wall */
  CHECK_OK(dsw_body_find_free_fractions(scene, body, centre, poses, 7, indices, offsets, 6, f, contacts));
  CHECK(f[0].fraction == 1 && f[0].piece == 4 && f[0].piece_fraction == 0 && f[0].starts_free == 1); /* once around */
  CHECK(f[1].fraction == 0 && f[1].piece == 0 && f[1].starts_free == 0); /* begins outside */
  CHECK(f[2].fraction == 1 && f[2].piece == 0 && f[2].starts_free == 1); /* a pose alone */
  CHECK(f[3].fraction == 1 && f[3].piece == 1 && f[3].starts_free == 1); /* stays */
  CHECK(f[4].fraction == 0 && f[4].starts_free == 0);                    /* a pose alone that is not free */
  CHECK(contacts[0].time == 0 && contacts[0].contact.wall.generation == 0);
  CHECK_OK(dsw_body_find_free_fractions(scene, body, centre, poses, 7, indices + 11, NULL, 1, f, NULL));
  CHECK(f[0].fraction == 1);
  { /* 0.1 of 0.25 to the wall above, after a piece that is free */
    const uint32_t up[] = {0, 5, 0, 6}, both[] = {0, 4};
    CHECK_OK(dsw_body_find_free_fractions(scene, body, centre, poses, 7, up, both, 1, f, contacts));
    CHECK(f[0].piece == 2 && f[0].piece_fraction > 0 && f[0].piece_fraction < 1);
    CHECK(f[0].fraction == (2 + f[0].piece_fraction) / 3);
    CHECK(contacts[0].time >= f[0].piece_fraction && contacts[0].contact.wall.generation != 0);
  }
  memset(&m, 0, sizeof m); /* dsw_body_move_rigid says so, too */
  memcpy(m.rotation, poses + 42, sizeof m.rotation);
  memcpy(m.centre, centre, dimension * sizeof *centre);
  m.translation[1] = 0.25;
  CHECK_OK(dsw_body_move_rigid(scene, body, &m, NULL, &report));
  CHECK(report.fraction == f[0].piece_fraction);
  end_scene(scene);
}

static void wrong_arguments(unsigned dimension) {
  const double rod[6] = {0.5, 0.5, 0.5, 0.9, 0.5, 0.5}, flat[4] = {0.5, 0.5, 0.9, 0.5};
  double centre[3] = {0.5, 0.5, 0.5}, poses[7] = {0, 0, 0, 1, 0, 0, 0};
  const uint32_t indices[2] = {0, 0}, wrong[2] = {0, 1}, empty[2] = {0, 0}, late[2] = {1, 2};
  dsw_free_fraction f = {7, 7, 7, 7};
  dsw_scene *const scene = make_scene(make_grid(dimension, NULL, 1), 0);
  const dsw_body_id body = make_edge_body(scene, dimension == 2 ? flat : rod, DSW_LEVEL_EDGES_SWEPT), none = {7, 1};
#define ASK(scene, body, centre, poses, count, indices, offsets, f) \
  dsw_body_find_free_fractions(scene, body, centre, poses, count, indices, offsets, 1, f, NULL)
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, ASK(NULL, body, centre, poses, 1, indices, NULL, &f));
  CHECK_FAILS(DSW_STATUS_STALE_ID, ASK(scene, none, centre, poses, 1, indices, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, ASK(scene, body, NULL, poses, 1, indices, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, ASK(scene, body, centre, NULL, 1, indices, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, ASK(scene, body, centre, poses, 1, NULL, NULL, &f));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, ASK(scene, body, centre, poses, 1, indices, NULL, NULL));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, ASK(scene, body, centre, poses, 1, wrong, NULL, &f));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, ASK(scene, body, centre, poses, 1, indices, empty, &f));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, ASK(scene, body, centre, poses, 1, indices, late, &f));
  poses[3] = 0;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, ASK(scene, body, centre, poses, 1, indices, NULL, &f));
  poses[3] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, ASK(scene, body, centre, poses, 1, indices, NULL, &f));
  poses[3] = 1;
  poses[4] = 1.7e308;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, ASK(scene, body, centre, poses, 1, indices, NULL, &f));
  poses[4] = 0;
  centre[1] = INFINITY;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, ASK(scene, body, centre, poses, 1, indices, NULL, &f));
  centre[1] = 0.5;
  if (dimension == 2) {
    poses[6] = 1;
    CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, ASK(scene, body, centre, poses, 1, indices, NULL, &f));
    poses[6] = 0;
  }
  CHECK(f.fraction == 7 && f.piece == 7);
  CHECK_OK(dsw_body_find_free_fractions(scene, body, centre, NULL, 0, NULL, NULL, 0, NULL, NULL));
  CHECK_OK(ASK(scene, body, centre, poses, 1, indices, NULL, &f));
  CHECK(f.fraction == 1);
#undef ASK
  end_scene(scene);
}

/* The product of two quaternions x y z w, the second one conjugated. */
static void times_conjugate(const double *a, const double *b, double *to) {
  to[0] = -a[3] * b[0] + a[0] * b[3] - a[1] * b[2] + a[2] * b[1];
  to[1] = -a[3] * b[1] + a[1] * b[3] - a[2] * b[0] + a[0] * b[2];
  to[2] = -a[3] * b[2] + a[2] * b[3] - a[0] * b[1] + a[1] * b[0];
  to[3] = a[3] * b[3] + a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static dsw_rigid_motion motion_of(unsigned dimension, const double *centre, const double *a, const double *b) {
  dsw_rigid_motion m;
  unsigned k;
  memset(&m, 0, sizeof m);
  times_conjugate(b, a, m.rotation);
  for (k = 0; k < dimension; ++k) {
    m.centre[k] = centre[k] + a[4 + k];
    m.translation[k] = b[4 + k] - a[4 + k];
  }
  return m;
}

/* A wide room without walls, in which every pose is free. */
static dsw_scene *make_wide_room(unsigned dimension) {
  grid g = grid_create(1, 1, 1);
  dsw_environment_desc d = grid_desc(&g);
  dsw_environment *env = NULL;
  size_t i;
  if (dimension == 2) d = squares_desc(&g);
  for (i = 0; i < 3 * g.point_count; ++i) g.points[i] = 64 * g.points[i] - 30;
  CHECK_OK(dsw_environment_create(NULL, &d, &env, NULL));
  grid_destroy(&g);
  return make_scene(env, DSW_FEATURE_BODY_CONTACTS);
}

/* Walls and bodies that stand; equal for equal seeds. */
static dsw_scene *make_world(unsigned dimension, dsw_context *context, double radius, uint64_t seed) {
  const uint64_t before = g_state;
  dsw_environment *const env = make_grid(dimension, context, N);
  dsw_scene *const scene = make_scene(env, DSW_FEATURE_BODY_CONTACTS);
  int w;
  g_state = seed;
  draw_walls(env, dimension, N, 8);
  for (w = 0; w < 3; ++w) {
    double other[6];
    unsigned k;
    dsw_body_desc d;
    dsw_body_id id;
    for (k = 0; k < 2 * dimension; ++k) other[k] = k < dimension ? between(0.3, N - 0.3) : other[k - dimension];
    other[dimension] += 0.3;
    d = line_desc(other, 2, 0, DSW_LEVEL_EDGES_SWEPT);
    d.radius = radius / 2;
    if (dsw_body_create(scene, &d, &id) != DSW_STATUS_OK) continue;
    other[0] += 1e-3; /* its boxes are out of date then */
    dsw_body_move(scene, id, other, 2, 0, NULL, NULL);
  }
  g_state = before;
  return scene;
}

static size_t bytes_of(const dsw_scene *scene, void **block) {
  size_t size = 0;
  dsw_scene_save(scene, NULL, 0, &size);
  *block = malloc(size);
  CHECK_OK(dsw_scene_save(scene, *block, size, &size));
  return size;
}

/* Beside dsw_body_move_rigid of a body that is made at the first pose of each path. */
static void beside_moves(unsigned dimension, double radius, size_t *stops, size_t *blocked) {
  const unsigned D = dimension;
  double at[9], centre[3] = {0, 0, 0}, poses[7 * POSES];
  uint32_t indices[MOST_INDICES], offsets[PATHS + 1];
  dsw_free_fraction f[PATHS], again[PATHS];
  dsw_body_contact contacts[PATHS], contacts_again[PATHS];
  const int is_face = D == 3 && share() < 0.5, is_self = share() < 0.3, is_rigid = share() < 0.3;
  const uint64_t seed = g_state;
  dsw_context *context = NULL;
  dsw_context_desc cd;
  dsw_scene *scene = make_world(D, NULL, radius, seed), *wide = make_wide_room(D), *many;
  dsw_body_id body, copy;
  dsw_body_desc d;
  const uint32_t corners[3] = {0, 1, 2}, face[2] = {0, 3};
  const size_t count = is_face ? 3 : 2;
  size_t i, k, size, size_after;
  void *state, *state_after;
  do {
    for (k = 0; k < D * count; ++k) at[k] = k < D ? between(1, N - 1) : at[k % D] + between(-0.4, 0.4);
    d = is_face ? surface_desc(at, 3, face, corners, 1, DSW_LEVEL_FACES) : line_desc(at, 2, 0, DSW_LEVEL_EDGES_SWEPT);
    d.radius = radius;
    d.flags = (is_self ? DSW_BODY_SELF_CONTACTS : 0u) | (is_rigid ? DSW_BODY_RIGID : 0u);
  } while (dsw_body_create(scene, &d, &body) != DSW_STATUS_OK);
  memcpy(centre, at, D * sizeof *at);
  for (i = 0; i < POSES; ++i) {
    double *const pose = poses + 7 * i;
    for (k = 0; k < 4; ++k) pose[k] = k >= 2 || D == 3 ? between(-1, 1) : 0;
    for (k = 0; k < 3; ++k) pose[4 + k] = k < D ? between(0, N) - centre[k] : 0;
    if (i == 0) set_pose(pose, 0, 0, 0);
  }
  offsets[0] = 0;
  for (i = 0; i < PATHS; ++i) {
    const uint32_t length = 1 + (uint32_t)(4 * share());
    offsets[i + 1] = offsets[i] + length;
    for (k = 0; k < length; ++k) indices[offsets[i] + k] = (uint32_t)(POSES * share());
    if (share() < 0.3) indices[offsets[i]] = 0;
  }
  size = bytes_of(scene, &state);
  CHECK_OK(dsw_body_find_free_fractions(scene, body, centre, poses, POSES, indices, offsets, PATHS, f, contacts));
  size_after = bytes_of(scene, &state_after);
  CHECK(size == size_after && memcmp(state, state_after, size) == 0); /* nothing has changed */
  free(state);
  free(state_after);

  CHECK_OK(dsw_body_create(wide, &d, &copy));
  for (i = 0; i < PATHS; ++i) { /* one piece after the other by moves */
    const uint32_t *const path = indices + offsets[i];
    const uint32_t pieces = offsets[i + 1] - offsets[i] - 1;
    uint32_t piece;
    for (piece = 0; piece == 0 || (piece < pieces && piece <= f[i].piece); ++piece) {
      const double nowhere[7] = {0, 0, 0, 1, 0, 0, 0};
      double now[9];
      dsw_rigid_motion m = motion_of(D, centre, nowhere, poses + 7 * path[piece]);
      dsw_scene *const trial = make_world(D, NULL, radius, seed);
      dsw_body_id moved;
      dsw_move_report report;
      const dsw_body_contact *contact;
      size_t contact_count, vertex_count;
      CHECK_OK(dsw_body_destroy(wide, copy));
      CHECK_OK(dsw_body_create(wide, &d, &copy));
      CHECK_OK(dsw_body_move_rigid(wide, copy, &m, NULL, &report));
      CHECK(report.fraction == 1);
      CHECK_OK(dsw_body_get_positions(wide, copy, now, 3, 0, NULL, &vertex_count));
      d.positions = now;
      if (dsw_body_create(trial, &d, &moved) != DSW_STATUS_OK) {
        CHECK(piece == 0 && f[i].starts_free == 0 && f[i].fraction == 0 && contacts[i].vertex.generation == 0);
        ++*blocked;
        piece = pieces; /* no more of this path */
      } else if (pieces == 0) {
        CHECK(f[i].starts_free == 1 && f[i].fraction == 1 && f[i].piece == 0);
      } else {
        m = motion_of(D, centre, poses + 7 * path[piece], poses + 7 * path[piece + 1]);
        CHECK_OK(dsw_body_move_rigid(trial, moved, &m, NULL, &report));
        CHECK_OK(dsw_body_get_contacts(trial, moved, &contact, &contact_count));
        if (piece < f[i].piece) CHECK(report.fraction == 1);
        if (piece == f[i].piece) {
          CHECK(fabs(report.fraction - f[i].piece_fraction) < 1e-9 && report.fraction < 1);
          CHECK(contact_count == 1 && memcmp(&contact->contact.wall, &contacts[i].contact.wall, 12) == 0);
          double apart = 0;
          for (k = 0; k < D; ++k) apart = fmax(apart, fabs(contact->point[k] - contacts[i].point[k]));
          CHECK(apart < 1e-12); /* rounding decides which vertex there moves first on the last chord, and is named */
          ++*stops;
        }
      }
      d.positions = at;
      end_scene(trial);
    }
  }

  dsw_context_desc_init(&cd, sizeof cd);
  cd.thread_count = 3;
  CHECK_OK(dsw_context_create(&cd, &context));
  many = make_world(D, context, radius, seed);
  CHECK_OK(dsw_body_create(many, &d, &body));
  CHECK_OK(
      dsw_body_find_free_fractions(many, body, centre, poses, POSES, indices, offsets, PATHS, again, contacts_again));
  CHECK(memcmp(f, again, sizeof f) == 0 && memcmp(contacts, contacts_again, sizeof contacts) == 0);
  end_scene(many);
  dsw_context_destroy(context);
  end_scene(scene);
  end_scene(wide);
}

/* An edge that comes to an edge between two walls: rounding decides which of its ends goes first, and not which wall is named. */
static void tied_walls(void) {
  static const uint64_t states[] = {88172645495325351u, 88172645508325390u, 7812917712752661320u, 6296099840450688519u};
  size_t stops = 0, blocked = 0, i;
  for (i = 0; i < sizeof states / sizeof *states; ++i) {
    g_state = states[i];
    beside_moves(3, 0, &stops, &blocked);
  }
  CHECK(stops > 0);
}

int main(int argc, char **argv) {
  unsigned dimension;
  for (dimension = 2; dimension <= 3; ++dimension) {
    size_t stops = 0, blocked = 0;
    int i;
    g_state = seed_of(88172645463325252u + dimension);
    known_fractions(dimension);
    wrong_arguments(dimension);
    for (i = 0; i < (effort_of(6) > 3 ? effort_of(6) : 3); ++i)
      beside_moves(dimension, i % 3 == 2 ? 0.0625 : 0, &stops, &blocked);
    if (argc > 1 && strcmp(argv[1], "print") == 0)
      printf("dimension %u: %zu stops, %zu blocked\n", dimension, stops, blocked);
    CHECK(stops > 0 && blocked > 0);
  }
  tied_walls();
  return check_result();
}
