#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

/* 4 x 4 x 3 cubes; the one that holds (2.5, 2.5, 1.5) is impassable. Contacts are filled in by hand. */
enum { NX = 4, NY = 4, NZ = 3, BEFORE = 1 + NX * (2 + NY), SOLID = BEFORE + 1 };

static dsw_environment *g_env;

static uint32_t point_index(unsigned x, unsigned y, unsigned z) { return x + (NX + 1) * (y + (NY + 1) * z); }

static void set(double *out, double x, double y, double z) {
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

static dsw_cell edge_between(unsigned x, unsigned y, unsigned z, unsigned x2, unsigned y2, unsigned z2) {
  uint32_t ends[2];
  dsw_edge_id edge = {0, 0, 0};
  ends[0] = point_index(x, y, z);
  ends[1] = point_index(x2, y2, z2);
  CHECK_OK(dsw_environment_find_edges(g_env, 1, ends, &edge, NULL));
  return cell_at(DSW_CELL_EDGE, edge.volume, edge.local);
}

/* The moving vertex at the wall x = 2. */
static dsw_body_contact plane_contact(void) {
  dsw_body_contact c;
  memset(&c, 0, sizeof c);
  set(c.position, 2, 2.25, 1.5);
  set(c.fixed[0], 1.5, 1.5, 1.5);
  memcpy(c.point, c.position, sizeof c.point);
  set(c.contact.normal, -1, 0, 0);
  c.contact.wall = face_at(BEFORE, FACE_X1);
  c.contact.obstacle = cell_at(DSW_CELL_FACE, BEFORE, FACE_X1);
  c.contact.front = volume_at(BEFORE);
  c.contact.kind = DSW_CONTACT_PLANE;
  c.contact.marked_kind = DSW_CELL_VOLUME;
  return c;
}

/* An edge of the body across the cube's edge x = y = 2. */
static dsw_body_contact edge_contact(void) {
  dsw_body_contact c = plane_contact();
  set(c.position, 1.5, 2.5, 1.25);
  set(c.fixed[0], 2.5, 1.5, 1.75);
  set(c.point, 2, 2, 1.5);
  set(c.contact.normal, -sqrt(0.5), -sqrt(0.5), 0);
  c.edge_parameter = 0.5;
  c.edge.generation = 1;
  c.contact.obstacle = edge_between(2, 2, 1, 2, 2, 2);
  c.contact.kind = DSW_CONTACT_EDGE;
  return c;
}

/* A face of the body on the cube's corner (2, 2, 1), in the plane x + y + z = 5. */
static dsw_body_contact corner_contact(void) {
  dsw_body_contact c = plane_contact();
  set(c.position, 1.5, 2, 1.5);
  set(c.fixed[0], 2.5, 1.75, 0.75);
  set(c.fixed[1], 2, 2.5, 0.5);
  set(c.point, 2, 2, 1);
  set(c.contact.normal, -sqrt(1 / 3.0), -sqrt(1 / 3.0), -sqrt(1 / 3.0));
  c.face.generation = 1;
  c.contact.obstacle = cell_at(DSW_CELL_VERTEX, point_index(2, 2, 1), 0);
  c.contact.kind = DSW_CONTACT_VERTEX;
  return c;
}

static dsw_cross_check cross_check_of(const dsw_body_contact *c) {
  dsw_cross_check o;
  memset(&o, 0x55, sizeof o);
  CHECK_OK(dsw_environment_cross_check(g_env, c, &o));
  return o;
}

static int agrees(const dsw_body_contact *c, dsw_cross_check_kind kind) {
  const dsw_cross_check o = cross_check_of(c);
  return o.kind == kind && o.reason == DSW_NO_CROSS_CHECK_NONE && o.angle_rad >= 0 && o.angle_rad < 1e-7 &&
         fabs(o.normal[0] - c->contact.normal[0]) < 1e-7 && fabs(o.normal[1] - c->contact.normal[1]) < 1e-7 &&
         fabs(o.normal[2] - c->contact.normal[2]) < 1e-7 && o.pushed_in > 0 && o.pushed_in < 1e-4 &&
         fabs(o.depth - o.pushed_in) < 1e-3 * o.pushed_in;
}

static int has_none(const dsw_body_contact *c, dsw_no_cross_check reason) {
  const dsw_cross_check o = cross_check_of(c);
  return o.kind == DSW_CROSS_CHECK_NONE && o.reason == reason && o.normal[0] == 0 && o.normal[1] == 0 &&
         o.normal[2] == 0 && o.depth == 0 && o.pushed_in == 0 && o.angle_rad == 0;
}

static void a_right_normal_is_confirmed(void) {
  dsw_body_contact c = plane_contact();
  CHECK(agrees(&c, DSW_CROSS_CHECK_PLANE));
  c = edge_contact();
  CHECK(agrees(&c, DSW_CROSS_CHECK_EDGE));
  c = corner_contact();
  CHECK(agrees(&c, DSW_CROSS_CHECK_VERTEX));
  c = plane_contact(); /* at the outer boundary there is nothing behind */
  set(c.position, 0, 2.25, 1.5);
  memcpy(c.point, c.position, sizeof c.point);
  set(c.contact.normal, 1, 0, 0);
  c.contact.wall = face_at(BEFORE - 1, FACE_X0);
  c.contact.front = volume_at(BEFORE - 1);
  CHECK(agrees(&c, DSW_CROSS_CHECK_PLANE));
}

static void a_wrong_normal_is_told(void) {
  dsw_body_contact c = plane_contact();
  dsw_cross_check o;
  set(c.contact.normal, -0.8, 0.6, 0);
  o = cross_check_of(&c);
  CHECK(o.kind == DSW_CROSS_CHECK_PLANE && fabs(o.angle_rad - acos(0.8)) < 1e-7);
  CHECK(fabs(o.normal[0] + 1) < 1e-7 && fabs(o.depth - 0.8 * o.pushed_in) < 1e-3 * o.pushed_in);
  set(c.contact.normal, 1, 0, 0); /* out of the body: pushed that way it comes free */
  CHECK(has_none(&c, DSW_NO_CROSS_CHECK_NOT_CONVERGED));
}

static void reasons_are_told(void) {
  dsw_body_contact c = edge_contact();
  set(c.position, 2, 2, 1.25);
  set(c.fixed[0], 2, 2, 1.75);
  CHECK(has_none(&c, DSW_NO_CROSS_CHECK_PARALLEL));
  c = edge_contact();
  set(c.contact.normal, sqrt(0.5), -sqrt(0.5), 0);
  CHECK(has_none(&c, DSW_NO_CROSS_CHECK_OUTSIDE_CONE));
  c = corner_contact();
  set(c.contact.normal, 0, 0, 1);
  CHECK(has_none(&c, DSW_NO_CROSS_CHECK_OUTSIDE_CONE));
  c = edge_contact(); /* a marked edge and a marked vertex belong to no wall */
  memset(&c.contact.wall, 0, sizeof c.contact.wall);
  CHECK(has_none(&c, DSW_NO_CROSS_CHECK_MARKED));
  c = corner_contact();
  memset(&c.contact.wall, 0, sizeof c.contact.wall);
  CHECK(has_none(&c, DSW_NO_CROSS_CHECK_MARKED));
}

/* What is wrong with the arguments is told with and without libccd. */
static void bad_input_changes_nothing(void) {
  const dsw_body_contact good = plane_contact();
  dsw_body_contact c = good;
  dsw_cross_check o, before;
  memset(&o, 0x55, sizeof o);
  before = o;
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cross_check(NULL, &c, &o));
  CHECK_MESSAGE("environment is null");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cross_check(g_env, NULL, &o));
  CHECK_MESSAGE("contact is null");
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_cross_check(g_env, &c, NULL));
  CHECK_MESSAGE("result is null");
#define REFUSED(status, text)                                        \
  CHECK_FAILS((status), dsw_environment_cross_check(g_env, &c, &o)); \
  CHECK_MESSAGE(text);                                               \
  c = good
  c.position[1] = NAN;
  REFUSED(DSW_STATUS_NON_FINITE, "contact->position[1] is nan");
  c.fixed[0][2] = INFINITY;
  REFUSED(DSW_STATUS_NON_FINITE, "contact->fixed[0][2] is inf");
  c.fixed[1][0] = NAN;
  REFUSED(DSW_STATUS_NON_FINITE, "contact->fixed[1][0] is nan");
  c.point[0] = -INFINITY;
  REFUSED(DSW_STATUS_NON_FINITE, "contact->point[0] is -inf");
  c.contact.normal[0] = NAN;
  REFUSED(DSW_STATUS_NON_FINITE, "contact->contact.normal[0] is nan");
  c.contact.normal[0] = -2;
  REFUSED(DSW_STATUS_OUT_OF_RANGE, "contact->contact.normal (-2, 0, 0) is not of length 1");
  c.contact.kind = DSW_CONTACT_NONE;
  REFUSED(DSW_STATUS_UNSUPPORTED, "contact->contact.kind is 0");
  c.contact.kind = DSW_CONTACT_EDGE; /* of a face */
  REFUSED(DSW_STATUS_UNSUPPORTED, "contact->contact.obstacle.kind is 3");
  c.contact.kind = DSW_CONTACT_VERTEX;
  REFUSED(DSW_STATUS_UNSUPPORTED, "contact->contact.obstacle.kind is 3");
  c.contact.wall.generation = 7;
  REFUSED(DSW_STATUS_STALE_ID, "contact->contact.wall {volume ");
  memset(&c.contact.wall, 0, sizeof c.contact.wall);
  REFUSED(DSW_STATUS_STALE_ID, "contact->contact.wall {volume 0, generation 0, local 0}");
  c.contact.front.index = NX * NY * NZ;
  REFUSED(DSW_STATUS_STALE_ID, "contact->contact.front {index 48");
  c.contact.front = volume_at(0);
  REFUSED(DSW_STATUS_NOT_FOUND, "contact->contact.front (volume 0) is not at contact->contact.wall");
  c.contact.kind = DSW_CONTACT_EDGE;
  c.contact.obstacle = cell_at(DSW_CELL_EDGE, 0, 12);
  REFUSED(DSW_STATUS_STALE_ID, "contact->contact.obstacle {volume 0, generation 1, local 12}");
  c.contact.kind = DSW_CONTACT_VERTEX;
  c.contact.obstacle = cell_at(DSW_CELL_VERTEX, 1000, 0);
  REFUSED(DSW_STATUS_STALE_ID, "contact->contact.obstacle {index 1000");
#undef REFUSED
  CHECK(memcmp(&o, &before, sizeof o) == 0);
}

static void without_libccd_it_says_so(void) {
  const dsw_body_contact c = plane_contact();
  dsw_cross_check o, before;
  memset(&o, 0x55, sizeof o);
  before = o;
  CHECK_FAILS(DSW_STATUS_NOT_BUILT, dsw_environment_cross_check(g_env, &c, &o));
  CHECK_MESSAGE("built without libccd");
  CHECK(memcmp(&o, &before, sizeof o) == 0);
}

/* Every allocation refused in turn: an error each time, nothing kept, and then the answer. */
static void refused_memory_is_told(void) {
  const dsw_volume_id solid = volume_at(SOLID);
  const dsw_body_contact contacts[3] = {plane_contact(), edge_contact(), corner_contact()};
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const environment = make_environment(context, NX, NY, NZ);
  size_t before, i, n;
  CHECK_OK(dsw_environment_mark_volumes(environment, &solid, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  before = h.alive;
  for (i = 0; i < 3; ++i) {
    dsw_status status = DSW_STATUS_OUT_OF_MEMORY;
    for (n = 1; n < 100 && status == DSW_STATUS_OUT_OF_MEMORY; ++n) {
      dsw_cross_check o;
      memset(&o, 0x55, sizeof o);
      h.refuse = h.calls + n;
      status = dsw_environment_cross_check(environment, &contacts[i], &o);
      CHECK(h.alive == before && (status == DSW_STATUS_OK ? o.kind != DSW_CROSS_CHECK_NONE : o.depth != 0));
    }
    CHECK(status == DSW_STATUS_OK && n > 2);
  }
  h.refuse = 0;
  CHECK_OK(dsw_environment_destroy(environment));
  end_context(context, &h);
}

int main(int argc, char **argv) {
  const dsw_volume_id solid = volume_at(SOLID);
  const char *const other =
      getenv("DSW_TEST_WITH_LIBCCD"); /* of a library that takes the place of the one built with the tests */
  const int built = other != NULL ? *other == '1' : argc > 1 && strcmp(argv[1], "with-libccd") == 0;
  g_env = make_environment(NULL, NX, NY, NZ);
  CHECK_OK(dsw_environment_mark_volumes(g_env, &solid, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  bad_input_changes_nothing();
  if (built) {
    a_right_normal_is_confirmed();
    a_wrong_normal_is_told();
    reasons_are_told();
    refused_memory_is_told();
  } else {
    without_libccd_it_says_so();
  }
  CHECK_OK(dsw_environment_destroy(g_env));
  return check_result();
}
