/* Rigid moves, many bodies at once, and memory that runs out under either. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* 4 x 4 x 3 cubes; the cube (2, 1, 1) is impassable. */
enum { NX = 4, NY = 4, NZ = 3, PILLAR = 2 + NX * (1 + NY), BODIES = 40 };

static dsw_environment *make_pillar(dsw_context *context) {
  dsw_environment *const environment = make_environment(context, NX, NY, NZ);
  CHECK_OK(set_volume_mark(environment, PILLAR, DSW_MARK_IMPASSABLE));
  return environment;
}

/* A tetrahedron with its first corner at `at`. */
static dsw_status create_tetrahedron(dsw_scene *scene, const double *at, dsw_level level, dsw_body_id *body) {
  static const uint32_t offsets[5] = {0, 3, 6, 9, 12}, corners[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  double positions[12];
  dsw_body_desc d;
  int i, k;
  for (i = 0; i < 4; ++i) {
    for (k = 0; k < 3; ++k) positions[3 * i + k] = at[k] + (i == k + 1 ? 0.375 : 0);
  }
  d = surface_desc(positions, 4, offsets, corners, 4, level);
  return dsw_body_create(scene, &d, body);
}

static void positions_of(const dsw_scene *scene, dsw_body_id body, double *p) {
  size_t count = 0;
  CHECK_OK(dsw_body_get_positions(scene, body, p, 4, 0, NULL, &count));
  CHECK(count == 4);
}

static dsw_rigid_motion translation(double x, double y, double z) {
  dsw_rigid_motion m = {{0, 0, 0, 1}, {0, 0, 0}, {0, 0, 0}};
  m.translation[0] = x;
  m.translation[1] = y;
  m.translation[2] = z;
  return m;
}

static void a_rigid_body_keeps_its_shape(void) {
  const double at[3] = {0.5, 1.25, 1.25};
  const double turned[12] = {1.5, 1.25, 1.25, 1.5, 1.625, 1.25, 1.125, 1.25, 1.25, 1.5, 1.25, 1.625};
  dsw_environment *environment = make_pillar(NULL);
  dsw_scene *scene = make_scene(environment, 0);
  dsw_rigid_motion motion = translation(1, 0, 0);
  const dsw_body_contact *c = NULL;
  const dsw_body_edit *e = NULL;
  dsw_move_report r;
  size_t count = 0;
  double p[12];
  int level, i;
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_FACES; ++level) {
    dsw_body_id body = {0, 0};
    CHECK_OK(create_tetrahedron(scene, at, (dsw_level)level, &body));
    motion = translation(1, 0, 0); /* a quarter turn about z, and one to the right; the quaternion is of any length */
    motion.rotation[2] = motion.rotation[3] = -7;
    memcpy(motion.centre, at, sizeof at);
    CHECK_OK(dsw_body_move_rigid(scene, body, &motion, NULL, &r));
    CHECK(r.fraction == 1 && r.vertices_moved == 4 && r.vertices_stopped == 0 && r.contact_count == 0);
    positions_of(scene, body, p);
    for (i = 0; i < 12; ++i) CHECK(fabs(p[i] - turned[i]) < 1e-15);
    motion = translation(0, 0, 0);
    CHECK_OK(dsw_body_move_rigid(scene, body, &motion, NULL, &r));
    CHECK(r.fraction == 1 && r.vertices_stopped == 0);
    motion = translation(1, 0.0625, 0.0625); /* the pillar is half a unit away */
    CHECK_OK(dsw_body_move_rigid(scene, body, &motion, NULL, &r));
    CHECK(r.fraction > 0.5 - 1e-14 && r.fraction <= 0.5 && r.vertices_stopped == 4);
    CHECK_OK(dsw_body_get_contacts(scene, body, &c, &count));
    CHECK(count == 1 && r.contact_count == 1 && c->contact.normal[0] == -1 && c->contact.tag == 100 + PILLAR &&
          c->point[0] == 2);
    CHECK(c->history == DSW_HISTORY_NEW);
    CHECK_OK(dsw_body_get_edits(scene, body, &e, &count));
    CHECK(count == 0 && r.edit_count == 0);
    positions_of(scene, body, p);
    for (i = 0; i < 12; ++i) {
      const double way = (i % 3 == 0 ? 1 : 0.0625) * r.fraction;
      CHECK(fabs(p[i] - turned[i] - way) < 1e-15 && p[i - i % 3] <= 2);
    }
    CHECK_OK(dsw_body_destroy(scene, body));
  }
  end_scene(scene);
}

static void bad_motions_are_refused(void) {
  static const struct {
    dsw_status status;
    int member; /* 0 to 3 rotation, 4 to 6 centre, 7 to 9 translation */
    double value;
  } kBad[] = {{DSW_STATUS_OUT_OF_RANGE, 3, 0},       {DSW_STATUS_NON_FINITE, 0, NAN},
              {DSW_STATUS_NON_FINITE, 3, INFINITY},  {DSW_STATUS_NON_FINITE, 5, NAN},
              {DSW_STATUS_NON_FINITE, 8, -INFINITY}, {DSW_STATUS_NON_FINITE, 9, NAN}};
  const double at[3] = {0.5, 1.25, 1.25};
  const uint32_t some[2] = {0, 1}, all[4] = {3, 1, 0, 2};
  dsw_environment *environment = make_pillar(NULL);
  dsw_scene *scene = make_scene(environment, 0);
  dsw_body_id body = {0, 0}, stale = {0, 9};
  dsw_rigid_motion motion = translation(0.25, 0, 0);
  dsw_move_options o = move_options();
  dsw_move_report r, before;
  double p[12], now[12];
  size_t i;
  CHECK_OK(create_tetrahedron(scene, at, DSW_LEVEL_FACES, &body));
  positions_of(scene, body, p);
  memset(&r, 0x55, sizeof r);
  before = r;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_move_rigid(NULL, body, &motion, NULL, &r));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_move_rigid(scene, body, NULL, NULL, &r));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_move_rigid(scene, stale, &motion, NULL, &r));
  for (i = 0; i < sizeof kBad / sizeof kBad[0]; ++i) {
    const int k = kBad[i].member;
    motion = translation(0.25, 0, 0);
    *(k < 4 ? &motion.rotation[k] : k < 7 ? &motion.centre[k - 4] : &motion.translation[k - 7]) = kBad[i].value;
    CHECK_FAILS(kBad[i].status, dsw_body_move_rigid(scene, body, &motion, NULL, &r));
    CHECK_MESSAGE("motion");
  }
  motion = translation(0, 0, 0); /* finite, but where it leads is not */
  motion.rotation[2] = 1;
  motion.rotation[3] = 0;
  motion.centre[0] = -1.7e308;
  motion.translation[0] = 1.7e308;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_body_move_rigid(scene, body, &motion, NULL, &r));
  motion = translation(0.25, 0, 0);
  o.order = some;
  o.order_count = 2;
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_body_move_rigid(scene, body, &motion, &o, &r));
  CHECK_MESSAGE("a rigid body moves as a whole");
  positions_of(scene, body, now);
  CHECK(memcmp(&r, &before, sizeof r) == 0 && memcmp(p, now, sizeof p) == 0);
  o.order = all;
  o.order_count = 4;
  CHECK_OK(dsw_body_move_rigid(scene, body, &motion, &o, NULL));
  motion = translation(1e300, 0, 0); /* a value */
  CHECK_OK(dsw_body_move_rigid(scene, body, &motion, NULL, &r));
  CHECK(r.fraction == 0 && r.vertices_stopped == 4 && r.contact_count == 1);
  end_scene(scene);
}

/* Bodies on a lattice, all driven at the pillar; those that would not be free are left out. */
static size_t make_bodies(dsw_scene *scene, dsw_body_id *bodies, double *targets) {
  size_t n = 0, i, k;
  for (i = 0; i < BODIES; ++i) {
    const double at[3] = {0.25 + 0.375 * (double)(i % 8), 0.25 + 0.625 * (double)(i / 8), 1.3125};
    const dsw_status status = create_tetrahedron(scene, at, (dsw_level)(1 + i % 4), &bodies[n]);
    CHECK(status == DSW_STATUS_OK || status == DSW_STATUS_IMPASSABLE);
    if (status != DSW_STATUS_OK) continue;
    positions_of(scene, bodies[n], targets + 12 * n);
    for (k = 0; k < 12; k += 3) {
      targets[12 * n + k] += 0.75 * (2.5 - at[0]);
      targets[12 * n + k + 1] += 0.75 * (1.5 - at[1]);
    }
    ++n;
  }
  CHECK(n == BODIES - 7);
  return n;
}

/* One by one, and at once on one, four and a host's threads: the same bytes. */
static void many_move_as_one_by_one(void) {
  static double targets[12 * BODIES], p[12], q[12];
  static dsw_move_report one[BODIES], many[BODIES];
  dsw_body_id bodies[BODIES], others[BODIES];
  dsw_environment *environment = make_pillar(NULL);
  dsw_scene *alone = make_scene(environment, 0);
  dsw_move_options o = move_options();
  size_t n = make_bodies(alone, bodies, targets), i, contacts = 0;
  host h;
  int k;
  CHECK(n > 20);
  o.vertex_response = o.edge_response = DSW_RESPONSE_SLIDE;
  memset(one, 0x55, sizeof one);
  for (i = 0; i < n; ++i) {
    CHECK_OK(dsw_body_move(alone, bodies[i], targets + 12 * i, 4, 0, &o, &one[i]));
    contacts += one[i].contact_count;
  }
  CHECK(contacts > n / 2);
  for (k = 0; k < 3; ++k) {
    dsw_context *context = NULL;
    dsw_context_desc d;
    dsw_environment *env;
    dsw_scene *scene;
    if (k < 2) {
      dsw_context_desc_init(&d, sizeof d);
      d.thread_count = k == 0 ? 1 : 4;
      CHECK_OK(dsw_context_create(&d, &context));
    } else {
      context = make_context(&h);
    }
    env = make_pillar(context);
    scene = make_scene(env, 0);
    CHECK(make_bodies(scene, others, targets) == n);
    memset(many, 0xaa, sizeof many);
    CHECK_OK(dsw_scene_move_bodies(scene, others, n, targets, 4 * n, 0, &o, many));
    CHECK(memcmp(one, many, n * sizeof one[0]) == 0);
    for (i = 0; i < n; ++i) {
      const dsw_body_contact *a = NULL, *b = NULL;
      size_t count_a = 0, count_b = 0;
      positions_of(alone, bodies[i], p);
      positions_of(scene, others[i], q);
      CHECK(memcmp(p, q, sizeof p) == 0);
      CHECK_OK(dsw_body_get_contacts(alone, bodies[i], &a, &count_a));
      CHECK_OK(dsw_body_get_contacts(scene, others[i], &b, &count_b));
      CHECK(count_a == count_b && (count_a == 0 || memcmp(a, b, count_a * sizeof *a) == 0));
    }
    end_scene(scene);
    CHECK_OK(dsw_context_destroy(context));
  }
  CHECK(h.alive == 0 && !h.broken && h.parallel_calls > 0);
  end_scene(alone);
}

static void bad_batches_change_nothing(void) {
  const double at[2][3] = {{0.25, 0.25, 1.25}, {0.25, 2.25, 1.25}};
  const uint32_t order[1] = {0};
  dsw_environment *environment = make_pillar(NULL);
  dsw_scene *scene = make_scene(environment, 0);
  dsw_body_id bodies[2], twice[2], stale[2];
  dsw_move_options o = move_options();
  dsw_move_report r[2], before[2];
  double p[24], targets[24], now[24];
  size_t i;
  for (i = 0; i < 2; ++i) {
    CHECK_OK(create_tetrahedron(scene, at[i], DSW_LEVEL_FACES, &bodies[i]));
    positions_of(scene, bodies[i], p + 12 * i);
    stale[i] = twice[i] = bodies[0];
  }
  stale[1].generation = 9;
  for (i = 0; i < 24; ++i) targets[i] = p[i] + 0.125;
  memset(r, 0x55, sizeof r);
  memcpy(before, r, sizeof r);
#define MANY(scene, ids, targets, n, stride, o) dsw_scene_move_bodies(scene, ids, 2, targets, n, stride, o, r)
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, MANY(NULL, bodies, targets, 8, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, MANY(scene, NULL, targets, 8, 0, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, MANY(scene, bodies, NULL, 8, 0, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, MANY(scene, stale, targets, 8, 0, NULL));
  CHECK_MESSAGE("bodies[1] {index 0, generation 9}");
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, MANY(scene, twice, targets, 8, 0, NULL));
  CHECK_MESSAGE("bodies[1] occurs twice");
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, MANY(scene, bodies, targets, 7, 0, NULL));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, MANY(scene, bodies, targets, 8, 12, NULL));
  targets[23] = NAN;
  CHECK_FAILS(DSW_STATUS_NON_FINITE, MANY(scene, bodies, targets, 8, 0, NULL));
  CHECK_MESSAGE("targets[7][2] is nan");
  targets[23] = p[23];
  o.order = order;
  o.order_count = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, MANY(scene, bodies, targets, 8, 0, &o));
  o.order = NULL;
  o.order_count = 0;
  o.flags = 2;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, MANY(scene, bodies, targets, 8, 0, &o));
#undef MANY
  for (i = 0; i < 2; ++i) positions_of(scene, bodies[i], now + 12 * i);
  CHECK(memcmp(p, now, sizeof p) == 0 && memcmp(r, before, sizeof r) == 0);
  CHECK_OK(dsw_scene_move_bodies(scene, NULL, 0, NULL, 0, 0, NULL, NULL));
  CHECK_OK(dsw_scene_move_bodies(scene, bodies, 2, targets, 8, 0, NULL, NULL));
  end_scene(scene);
}

/* Every allocation of a call is refused in turn; whatever was refused, the body is where and what it was. */
static void memory_runs_out(void) {
  const double at[3] = {0.5, 1.25, 1.25};
  const dsw_rigid_motion motion = translation(0.5, 0.0625, 0);
  static const int kEnough = 400;
  host h;
  dsw_context *context = make_context(&h);
  dsw_environment *environment = make_pillar(context);
  dsw_scene *scene = make_scene(environment, 0);
  dsw_body_id body = {7, 8};
  dsw_body_edge_id e = {0, 1};
  dsw_move_options o = move_options();
  double p[12], now[12], targets[12];
  size_t count = 0, body_count = 9;
  int call, refusals, i;
  o.edge_response = DSW_RESPONSE_ADAPTIVE_SLIDE;
  for (call = 0; call < 6; ++call) {
    dsw_status status = DSW_STATUS_OUT_OF_MEMORY;
    if (call > 0) {
      positions_of(scene, body, p);
      for (i = 0; i < 12; ++i) targets[i] = p[i] + (i % 3 == 0 ? 1 : 0.0625);
    }
    for (refusals = 0; refusals < kEnough && status == DSW_STATUS_OUT_OF_MEMORY; ++refusals) {
      h.refuse = h.calls + 1 + (size_t)refusals;
      switch (call) {
        case 0:
          status = create_tetrahedron(scene, at, DSW_LEVEL_FACES, &body);
          break;
        case 1:
          status = dsw_body_move_rigid(scene, body, &motion, NULL, NULL);
          break;
        case 2:
          status = dsw_scene_move_bodies(scene, &body, 1, targets, 4, 0, &o, NULL);
          break;
        case 3:
          status = dsw_body_set_level(scene, body, DSW_LEVEL_POINTS);
          break;
        case 4:
          status = dsw_body_set_level(scene, body, DSW_LEVEL_FACES);
          break;
        default:
          status = dsw_body_split_edge(scene, body, e, 0.5, NULL);
      }
      h.refuse = 0;
      CHECK_OK(dsw_scene_get_body_count(scene, &body_count));
      if (status != DSW_STATUS_OUT_OF_MEMORY) break;
      CHECK_MESSAGE("allocator returned null");
      CHECK(body_count == (call == 0 ? 0u : 1u) && (call > 0 || (body.index == 7 && body.generation == 8)));
      if (call == 0) continue;
      CHECK(dsw_body_get_vertex_ids(scene, body, NULL, 0, &count) == DSW_STATUS_BUFFER_TOO_SMALL);
      CHECK(count == 4);
      positions_of(scene, body, now);
      CHECK(memcmp(p, now, sizeof p) == 0);
    }
    CHECK(status == DSW_STATUS_OK);
    CHECK(refusals > 0 || call == 3 || call == 4);
    if (call == 2) { /* a new body, the moved one may have other vertices by now */
      CHECK_OK(dsw_body_destroy(scene, body));
      CHECK_OK(create_tetrahedron(scene, at, DSW_LEVEL_FACES, &body));
    }
  }
  end_scene(scene);
  end_context(context, &h);
}

int main(void) {
  a_rigid_body_keeps_its_shape();
  bad_motions_are_refused();
  many_move_as_one_by_one();
  bad_batches_change_nothing();
  memory_runs_out();
  return check_result();
}
