/* Gravity, damping and shape matching (Mueller, Heidelberger, Teschner, Gross 2005) make targets; the library says how
 * far each vertex comes, and its velocity is what it made of that. */
#include "fall.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh.h"
#include "run.h"

enum { kWide = 10, kHigh = 8, kTurns = 4, kKeptSteps = 1 };

static const double kGravity = 9.81, kStep = 1.0 / 60, kDamping = 0.995, kStiffness = 0.35, kSize = 6.0, kCarries = 40;

/* Cubes of side 1; pyramid k of a cube has its tip in the middle, and as base the face k: z0, z1, y0, x1, y1, x0. */
static dsw_environment *create_pyramids(dsw_context *context, size_t *cells) {
  static const int kCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  /* Bases are counter-clockwise seen from the tip. */
  static const int kBases[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  const size_t row = kWide + 1, corners = row * row * (kHigh + 1), cubes = kWide * kWide * kHigh;
  double *points = (double *)demo_allocate(3 * (corners + cubes), sizeof(double));
  int64_t *connectivity = (int64_t *)demo_allocate(30 * cubes, sizeof(int64_t));
  dsw_environment_desc desc;
  dsw_environment *environment = NULL;
  for (size_t i = 0; i < corners; ++i) {
    points[3 * i] = (double)(i % row);
    points[3 * i + 1] = (double)(i / row % row);
    points[3 * i + 2] = (double)(i / row / row);
  }
  for (size_t i = 0; i < cubes; ++i) {
    size_t at[3] = {i % kWide, i / kWide % kWide, i / kWide / kWide};
    for (size_t k = 0; k < 3; ++k) {
      points[3 * (corners + i) + k] = (double)at[k] + 0.5;
    }
    for (size_t f = 0; f < 6; ++f) {
      int64_t *cell = connectivity + 30 * i + 5 * f;
      for (size_t k = 0; k < 4; ++k) {
        const int *c = kCorners[kBases[f][k]];
        cell[k] = (int64_t)((at[0] + (size_t)c[0]) + row * ((at[1] + (size_t)c[1]) + row * (at[2] + (size_t)c[2])));
      }
      cell[4] = (int64_t)(corners + i);
    }
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.uniform_cell_type = DSW_CELL_TYPE_PYRAMID;
  desc.points = points;
  desc.point_count = corners + cubes;
  desc.connectivity = connectivity;
  desc.connectivity_count = 30 * cubes;
  desc.cell_count = *cells = 6 * cubes;
  desc.flags = DSW_ENVIRONMENT_LOCATE_GRID;
  require(dsw_environment_create(context, &desc, &environment, NULL), "creating the pyramids", kFailed);
  free(points);
  free(connectivity);
  return environment;
}

/* The floor is a bed of spikes; a few cubes, roofs and a post stand on it. */
static size_t mark_obstacles(dsw_environment *environment) {
  static const int kCubes[][3] = {{2, 2, 0}, {7, 4, 0}, {7, 5, 0}, {4, 7, 0}, {4, 7, 1}, {5, 7, 0}, {5, 4, 0}};
  static const int kRoofs[][3] = {{2, 2, 1}, {7, 4, 1}, {7, 5, 1}, {4, 7, 2}, {5, 7, 1}, {5, 4, 1}};
  dsw_volume_id marked[kWide * kWide + 6 * 7 + 6];
  size_t count = 0;
  for (uint32_t i = 0; i < kWide * kWide; ++i) {
    require(dsw_environment_get_volume(environment, 6 * i, &marked[count++]), "marking the floor", kFailed);
  }
  for (size_t i = 0; i < sizeof kCubes / sizeof kCubes[0]; ++i) {
    uint32_t cube = (uint32_t)(kCubes[i][0] + kWide * (kCubes[i][1] + kWide * kCubes[i][2]));
    for (uint32_t k = kCubes[i][2] == 0 ? 1 : 0; k < 6; ++k) {
      require(dsw_environment_get_volume(environment, 6 * cube + k, &marked[count++]), "marking a cube", kFailed);
    }
  }
  for (size_t i = 0; i < sizeof kRoofs / sizeof kRoofs[0]; ++i) {
    uint32_t cube = (uint32_t)(kRoofs[i][0] + kWide * (kRoofs[i][1] + kWide * kRoofs[i][2]));
    require(dsw_environment_get_volume(environment, 6 * cube, &marked[count++]), "marking a roof", kFailed);
  }
  require(dsw_environment_mark_volumes(environment, marked, count, DSW_MARK_IMPASSABLE, 0, NULL), "marking", kFailed);
  return count;
}

static dsw_status create_body(const demo_fall *fall, dsw_scene *scene, dsw_body_id *body) {
  const demo_surface *s = fall->surface;
  uint32_t *offsets = (uint32_t *)demo_allocate(s->triangle_count + 1, sizeof(uint32_t));
  dsw_body_desc desc;
  for (size_t i = 0; i <= s->triangle_count; ++i) {
    offsets[i] = (uint32_t)(3 * i);
  }
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = DSW_LEVEL_FACES;
  desc.positions = s->points;
  desc.vertex_count = s->point_count;
  desc.face_offsets = offsets;
  desc.face_corners = s->corners;
  desc.face_count = s->triangle_count;
  desc.face_corner_count = 3 * s->triangle_count;
  dsw_status status = dsw_body_create(scene, &desc, body);
  free(offsets);
  return status;
}

void fall_create(demo_fall *fall, dsw_context *context, demo_surface *surface) {
  const double middle[3] = {kWide / 2, kWide / 2, kHigh - 2};
  dsw_scene_desc desc;
  size_t n = surface->point_count;
  memset(fall, 0, sizeof *fall);
  figures_create(&fall->figures, "surface");
  fall->surface = surface;
  surface_place(surface, kSize, middle);
  fall->environment = create_pyramids(context, &fall->cells);
  fall->impassable = mark_obstacles(fall->environment);
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_STATISTICS;
  require(dsw_scene_create(fall->environment, &desc, &fall->scene), "creating a scene", kFailed);
  require(create_body(fall, fall->scene, &fall->body), "the surface cannot be used", kBadInput);
  fall->shape = (double *)demo_allocate(11 * n, sizeof(double));
  memset(fall->shape, 0, 11 * n * sizeof(double));
  memcpy(fall->shape, surface->points, 3 * n * sizeof(double));
  fall->velocity = fall->shape + 3 * n;
  fall->targets = fall->velocity + 3 * n;
  fall->touched = fall->targets + 3 * n;
  fall->weight = fall->touched + n;
  for (size_t i = 0; i < n; ++i) {
    fall->weight[i] = 1;
  }
  fall->rotation[3] = 1;
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
static void find_targets(demo_fall *fall) {
  const double *x = fall->surface->points, *w = fall->weight;
  double *q = fall->targets, here[3], rest[3], a[3][3];
  size_t n = fall->surface->point_count;
  memset(a, 0, sizeof a);
  for (size_t i = 0; i < 3 * n; ++i) {
    double *v = fall->velocity + i;
    *v = kDamping * *v - (i % 3 == 2 && w[i / 3] == 1 ? kGravity * kStep : 0);
    q[i] = x[i] + kStep * *v;
  }
  find_mean(q, w, n, here);
  find_mean(fall->shape, w, n, rest);
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      for (size_t k = 0; k < 3; ++k) {
        a[j][k] += w[i] * (fall->shape[3 * i + j] - rest[j]) * (q[3 * i + k] - here[k]);
      }
    }
  }
  match_rotation(fall->rotation, a);
  for (size_t i = 0; i < n; ++i) {
    double arm[3] = {fall->shape[3 * i] - rest[0], fall->shape[3 * i + 1] - rest[1], fall->shape[3 * i + 2] - rest[2]};
    double goal[3];
    rotate(fall->rotation, arm, goal);
    for (size_t k = 0; k < 3; ++k) {
      q[3 * i + k] += kStiffness * (here[k] + goal[k] - q[3 * i + k]);
    }
  }
}

static void count_touches(demo_fall *fall) {
  const dsw_contact *contacts = NULL;
  size_t count = 0;
  require(dsw_body_get_contacts(fall->scene, fall->body, &contacts, &count), "reading contacts", kFailed);
  for (size_t i = 0; i < fall->surface->point_count; ++i) {
    fall->weight[i] = 1;
  }
  for (size_t i = 0; i < count; ++i) {
    fall->touched[contacts[i].vertex.index] += 1;
    fall->weight[contacts[i].vertex.index] = kCarries;
  }
}

void fall_run(demo_fall *fall, size_t steps, FILE *csv) {
  size_t n = fall->surface->point_count;
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  options.vertex_response = DSW_RESPONSE_SLIDE;
  options.edge_response = DSW_RESPONSE_SLIDE;
  for (size_t step = 0; step < steps; ++step) {
    dsw_move_report report;
    find_targets(fall);
    double start = seconds_now();
    require(dsw_body_move(fall->scene, fall->body, fall->targets, n, 0, &options, &report), "moving the surface",
            kFailed);
    figures_add(&fall->figures, fall->scene, fall->body, &report, seconds_now() - start, step + kKeptSteps >= steps,
                csv);
    count_touches(fall);
    memcpy(fall->targets, fall->surface->points, 3 * n * sizeof(double));
    require(dsw_body_get_positions(fall->scene, fall->body, fall->surface->points, n, 0, NULL, &n),
            "reading the surface", kFailed);
    for (size_t i = 0; i < 3 * n; ++i) {
      fall->velocity[i] = (fall->surface->points[i] - fall->targets[i]) / kStep;
    }
  }
  /* Faces and all: a body created anew where this one ended must be free there. */
  dsw_scene *scene = NULL;
  dsw_body_id body;
  require(dsw_scene_create(fall->environment, NULL, &scene), "creating a scene", kFailed);
  fall->still_free = create_body(fall, scene, &body) == DSW_STATUS_OK;
  require(dsw_scene_destroy(scene), "destroying a scene", kFailed);
  prove_edges(&fall->figures, fall->scene, fall->body);
}

void fall_destroy(demo_fall *fall) {
  require(dsw_scene_destroy(fall->scene), "destroying a scene", kFailed);
  require(dsw_environment_destroy(fall->environment), "destroying the pyramids", kFailed);
  free(fall->shape);
  figures_destroy(&fall->figures);
}
