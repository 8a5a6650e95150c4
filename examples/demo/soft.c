#include "soft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh.h"
#include "run.h"

enum { kTurns = 4 };

static const double kStep = 1.0 / 60, kDamping = 0.995, kStiffness = 0.35, kCarries = 40;

dsw_status soft_create_body(const demo_surface *surface, dsw_scene *scene, dsw_body_id *body) {
  uint32_t *offsets = (uint32_t *)demo_allocate(surface->triangle_count + 1, sizeof(uint32_t));
  dsw_body_desc desc;
  for (size_t i = 0; i <= surface->triangle_count; ++i) {
    offsets[i] = (uint32_t)(3 * i);
  }
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = DSW_LEVEL_FACES;
  desc.positions = surface->points;
  desc.vertex_count = surface->point_count;
  desc.face_offsets = offsets;
  desc.face_corners = surface->corners;
  desc.face_count = surface->triangle_count;
  desc.face_corner_count = 3 * surface->triangle_count;
  dsw_status status = dsw_body_create(scene, &desc, body);
  free(offsets);
  return status;
}

dsw_status soft_create(demo_soft *soft, dsw_scene *scene, demo_surface *surface, const char *name) {
  size_t n = surface->point_count;
  memset(soft, 0, sizeof *soft);
  figures_create(&soft->figures, name);
  soft->scene = scene;
  soft->surface = surface;
  soft->shape = (double *)demo_allocate(11 * n, sizeof(double));
  memset(soft->shape, 0, 11 * n * sizeof(double));
  memcpy(soft->shape, surface->points, 3 * n * sizeof(double));
  soft->velocity = soft->shape + 3 * n;
  soft->targets = soft->velocity + 3 * n;
  soft->touched = soft->targets + 3 * n;
  soft->weight = soft->touched + n;
  for (size_t i = 0; i < n; ++i) {
    soft->weight[i] = 1;
  }
  soft->rotation[3] = 1;
  return soft_create_body(surface, scene, &soft->body);
}

static void find_mean(const double *points, const double *weight, size_t count, double *mean) {
  double sum = 0;
  memset(mean, 0, 3 * sizeof(double));
  for (size_t i = 0; i < count; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      mean[k] += weight[i] * points[3 * i + k];
    }
    sum += weight[i];
  }
  for (size_t k = 0; k < 3; ++k) {
    mean[k] /= sum;
  }
}

static void rotate(const double *q, const double *x, double *y) {
  double c[3] = {q[1] * x[2] - q[2] * x[1] + q[3] * x[0], q[2] * x[0] - q[0] * x[2] + q[3] * x[1],
                 q[0] * x[1] - q[1] * x[0] + q[3] * x[2]};
  y[0] = x[0] + 2 * (q[1] * c[2] - q[2] * c[1]);
  y[1] = x[1] + 2 * (q[2] * c[0] - q[0] * c[2]);
  y[2] = x[2] + 2 * (q[0] * c[1] - q[1] * c[0]);
}

/* Turns the shape a little more towards where the vertices want to be (Mueller, Bender, Chentanez, Macklin 2016). */
static void match_rotation(double *rotation, double a[3][3]) {
  for (int turn = 0; turn < kTurns; ++turn) {
    double r[3][3], axis[3] = {0, 0, 0}, size = 1e-9, q[4], old[4], length = 0;
    for (int j = 0; j < 3; ++j) {
      double e[3] = {0, 0, 0};
      e[j] = 1;
      rotate(rotation, e, r[j]);
      axis[0] += r[j][1] * a[j][2] - r[j][2] * a[j][1];
      axis[1] += r[j][2] * a[j][0] - r[j][0] * a[j][2];
      axis[2] += r[j][0] * a[j][1] - r[j][1] * a[j][0];
      size += fabs(r[j][0] * a[j][0] + r[j][1] * a[j][1] + r[j][2] * a[j][2]);
    }
    for (int k = 0; k < 3; ++k) {
      q[k] = 0.5 * axis[k] / size;
    }
    q[3] = 1;
    memcpy(old, rotation, sizeof old);
    rotation[0] = q[3] * old[0] + q[0] * old[3] + q[1] * old[2] - q[2] * old[1];
    rotation[1] = q[3] * old[1] + q[1] * old[3] + q[2] * old[0] - q[0] * old[2];
    rotation[2] = q[3] * old[2] + q[2] * old[3] + q[0] * old[1] - q[1] * old[0];
    rotation[3] = q[3] * old[3] - q[0] * old[0] - q[1] * old[1] - q[2] * old[2];
    for (int k = 0; k < 4; ++k) {
      length += rotation[k] * rotation[k];
    }
    for (int k = 0; k < 4; ++k) {
      rotation[k] /= sqrt(length);
    }
  }
}

/* Vertices that touch something carry the others: they weigh more, and do not fall. */
static void find_targets(demo_soft *soft, double gravity) {
  const double *x = soft->surface->points, *w = soft->weight;
  double *q = soft->targets, here[3], rest[3], a[3][3];
  size_t n = soft->surface->point_count;
  memset(a, 0, sizeof a);
  for (size_t i = 0; i < 3 * n; ++i) {
    double *v = soft->velocity + i;
    *v = kDamping * *v - (i % 3 == 2 && w[i / 3] == 1 ? gravity * kStep : 0);
    q[i] = x[i] + kStep * *v;
  }
  find_mean(q, w, n, here);
  find_mean(soft->shape, w, n, rest);
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      for (size_t k = 0; k < 3; ++k) {
        a[j][k] += w[i] * (soft->shape[3 * i + j] - rest[j]) * (q[3 * i + k] - here[k]);
      }
    }
  }
  match_rotation(soft->rotation, a);
  for (size_t i = 0; i < n; ++i) {
    double arm[3] = {soft->shape[3 * i] - rest[0], soft->shape[3 * i + 1] - rest[1], soft->shape[3 * i + 2] - rest[2]};
    double goal[3];
    rotate(soft->rotation, arm, goal);
    for (size_t k = 0; k < 3; ++k) {
      q[3 * i + k] += kStiffness * (here[k] + goal[k] - q[3 * i + k]);
    }
  }
}

static void count_touches(demo_soft *soft) {
  const dsw_body_contact *contacts = NULL;
  size_t count = 0;
  require(dsw_body_get_contacts(soft->scene, soft->body, &contacts, &count), "reading contacts", kFailed);
  for (size_t i = 0; i < soft->surface->point_count; ++i) {
    soft->weight[i] = 1;
  }
  for (size_t i = 0; i < count; ++i) {
    soft->touched[contacts[i].vertex.index] += 1;
    soft->weight[contacts[i].vertex.index] = kCarries;
  }
}

void soft_read_places(demo_soft *soft) {
  size_t n = soft->surface->point_count;
  require(dsw_body_get_positions(soft->scene, soft->body, soft->surface->points, n, 0, NULL, &n), "reading a surface",
          kFailed);
}

void soft_step(demo_soft *soft, double gravity, int keep, FILE *csv) {
  size_t n = soft->surface->point_count;
  dsw_move_options options;
  dsw_move_report report;
  dsw_move_options_init(&options, sizeof options);
  options.vertex_response = DSW_RESPONSE_SLIDE;
  options.edge_response = DSW_RESPONSE_SLIDE;
  find_targets(soft, gravity);
  double start = seconds_now();
  require(dsw_body_move(soft->scene, soft->body, soft->targets, n, 0, &options, &report), "moving a surface", kFailed);
  figures_add(&soft->figures, soft->scene, soft->body, &report, seconds_now() - start, keep, csv);
  count_touches(soft);
  memcpy(soft->targets, soft->surface->points, 3 * n * sizeof(double));
  soft_read_places(soft);
  for (size_t i = 0; i < 3 * n; ++i) {
    soft->velocity[i] = (soft->surface->points[i] - soft->targets[i]) / kStep;
  }
}

void soft_destroy(demo_soft *soft) {
  free(soft->shape);
  figures_destroy(&soft->figures);
}
