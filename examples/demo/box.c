#include "box.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh.h"
#include "output.h"
#include "run.h"

enum { kAlong = 12, kAcross = 9, kKeptSteps = 6, kPeriod = 80 };

static const double kPi = 3.14159265358979323846, kLength = 8, kWidth = 6, kGravity = 0.5, kSize = 3, kSpeed = 2.5;

/* kAlong x kAcross x kAcross hexahedra. */
static void create_environment(demo_box *box, dsw_context *context) {
  const size_t row = kAlong + 1, column = kAcross + 1, cells = kAlong * kAcross * kAcross;
  box->point_count = row * column * column;
  box->rest = (double *)demo_allocate(9 * box->point_count, sizeof(double));
  box->lent[0] = box->rest + 3 * box->point_count;
  box->lent[1] = box->lent[0] + 3 * box->point_count;
  int64_t *connectivity = (int64_t *)demo_allocate(8 * cells, sizeof(int64_t));
  dsw_environment_desc desc;
  for (size_t i = 0; i < box->point_count; ++i) {
    box->rest[3 * i] = kLength * (double)(i % row) / (double)kAlong;
    box->rest[3 * i + 1] = kWidth * (double)(i / row % column) / (double)kAcross;
    box->rest[3 * i + 2] = kWidth * (double)(i / row / column) / (double)kAcross;
  }
  for (size_t i = 0; i < cells; ++i) {
    size_t x = i % kAlong, y = i / kAlong % kAcross, z = i / kAlong / kAcross;
    for (size_t k = 0; k < 8; ++k) {
      connectivity[8 * i + k] = (int64_t)(x + (k + 1) / 2 % 2 + row * (y + k / 2 % 2 + column * (z + k / 4)));
    }
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = box->rest;
  desc.point_count = box->point_count;
  desc.connectivity = connectivity;
  desc.connectivity_count = 8 * cells;
  desc.volume_count = cells;
  require(dsw_environment_create(context, &desc, &box->environment, NULL), "creating the box", kFailed);
  free(connectivity);
}

/* One ring lies, the other one stands and comes from the other side. */
static void create_ring(demo_box *box, size_t i) {
  static const char *const kNames[kRings] = {"ring one", "ring two"};
  const double middle[3] = {i == 0 ? 0.27 * kLength : 0.73 * kLength, 0.5 * kWidth, 0.5 * kWidth};
  demo_surface *s = box->surfaces + i;
  demo_soft *ring = box->rings + i;
  surface_make_ring(56, 24, s);
  surface_place(s, kSize, middle);
  for (size_t k = 0; k < s->point_count && i > 0; ++k) {
    double *p = s->points + 3 * k, y = p[1] - middle[1], z = p[2] - middle[2];
    p[1] = middle[1] - z; /* a quarter turn about x */
    p[2] = middle[2] + y;
  }
  require(soft_create(ring, box->scene, s, kNames[i]), "creating a ring", kFailed);
  for (size_t k = 0; k < s->point_count; ++k) {
    ring->velocity[3 * k] = i == 0 ? kSpeed : -kSpeed;
  }
}

void box_create(demo_box *box, dsw_context *context) {
  dsw_scene_desc desc;
  memset(box, 0, sizeof *box);
  box->figures.name = "box";
  create_environment(box, context);
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS;
  require(dsw_scene_create(box->environment, &desc, &box->scene), "creating a scene", kFailed);
  for (size_t i = 0; i < kRings; ++i) {
    create_ring(box, i);
  }
}

/* The walls at both ends come in and go out again, most of all in their middles, and the floor heaves. */
static void bend(const demo_box *box, size_t step, double *next) {
  double phase = kPi * (double)step / (double)kPeriod, in = 2.1 * sin(phase) * sin(phase), up = 0.9 * sin(2 * phase);
  for (size_t i = 0; i < box->point_count; ++i) {
    const double *p = box->rest + 3 * i;
    double x = p[0] / kLength, y = p[1] / kWidth, z = p[2] / kWidth;
    next[3 * i] = p[0] + in * (0.35 + 0.65 * sin(kPi * y) * sin(kPi * z)) * (1 - 2 * x);
    next[3 * i + 1] = p[1];
    next[3 * i + 2] = p[2] + up * (1 - z) * sin(kPi * x) * sin(kPi * y);
  }
}

static size_t count_met(const demo_box *box, const demo_soft *ring) {
  const dsw_contact_partner *partners = NULL;
  size_t count = 0, met = 0;
  require(dsw_body_get_contact_partners(box->scene, ring->body, &partners, &count), "reading contacts", kFailed);
  for (size_t i = 0; i < count; ++i) {
    met += partners[i].body.generation != 0;
  }
  return met;
}

void box_run(demo_box *box, size_t steps, FILE *csv) {
  for (size_t step = 0; step < steps; ++step) {
    double *next = box->lent[step % 2]; /* the environment reads the other one */
    int keep = step + kKeptSteps >= steps;
    bend(box, step + 1, next);
    changes_deform(&box->figures, box->scene, next, box->point_count, NULL);
    for (size_t i = 0; i < kRings; ++i) {
      demo_soft *ring = box->rings + i;
      soft_read_places(ring);
      soft_step(ring, kGravity, keep, csv);
      box->figures.met += count_met(box, ring);
    }
    for (size_t i = 0; i < kRings; ++i) {
      changes_prove(&box->figures, &box->rings[i].figures, box->scene, box->rings[i].body);
    }
  }
  for (size_t i = 0; i < kRings; ++i) {
    changes_add_body(&box->figures, &box->rings[i].figures, box->surfaces[i].point_count);
  }
  changes_end(&box->figures, box->environment);
}

int box_write(const demo_box *box, const char *out) {
  int code = write_trace(box->environment, out, "box.vtu", 1);
  for (size_t i = 0; i < kRings; ++i) {
    const demo_soft *ring = box->rings + i;
    const demo_surface *s = ring->surface;
    vtu_field touched = field("contacts", ring->touched, 1);
    code |= vtu_write(out, i == 0 ? "ring_one.vtu" : "ring_two.vtu", s->points, s->point_count, s->corners, 3,
                      s->triangle_count, &touched, 1);
    code |= write_touches(out, i == 0 ? "ring_one_contacts.vtu" : "ring_two_contacts.vtu", ring->figures.touch,
                          ring->figures.normal, ring->figures.touch_count);
  }
  return code;
}

void box_destroy(demo_box *box) {
  require(dsw_scene_destroy(box->scene), "destroying a scene", kFailed);
  require(dsw_environment_destroy(box->environment), "destroying the box", kFailed);
  for (size_t i = 0; i < kRings; ++i) {
    soft_destroy(box->rings + i);
    surface_free(box->surfaces + i);
  }
  free(box->rest);
}
