#include "fall.h"

#include <stdlib.h>
#include <string.h>

#include "mesh.h"
#include "run.h"

enum { kWide = 10, kHigh = 8, kKeptSteps = 1 };

static const double kGravity = 9.81, kSize = 6.0;

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
  desc.volume_count = *cells = 6 * cubes;
  desc.flags = DSW_ENVIRONMENT_LOCATE_TREE;
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
    require(dsw_environment_get_volume_id(environment, 6 * i, &marked[count++]), "marking the floor", kFailed);
  }
  for (size_t i = 0; i < sizeof kCubes / sizeof kCubes[0]; ++i) {
    uint32_t cube = (uint32_t)(kCubes[i][0] + kWide * (kCubes[i][1] + kWide * kCubes[i][2]));
    for (uint32_t k = kCubes[i][2] == 0 ? 1 : 0; k < 6; ++k) {
      require(dsw_environment_get_volume_id(environment, 6 * cube + k, &marked[count++]), "marking a cube", kFailed);
    }
  }
  for (size_t i = 0; i < sizeof kRoofs / sizeof kRoofs[0]; ++i) {
    uint32_t cube = (uint32_t)(kRoofs[i][0] + kWide * (kRoofs[i][1] + kWide * kRoofs[i][2]));
    require(dsw_environment_get_volume_id(environment, 6 * cube, &marked[count++]), "marking a roof", kFailed);
  }
  require(dsw_environment_mark_volumes(environment, marked, count, DSW_MARK_IMPASSABLE, 0, NULL), "marking", kFailed);
  return count;
}

void fall_create(demo_fall *fall, dsw_context *context, demo_surface *surface) {
  const double middle[3] = {kWide / 2, kWide / 2, kHigh - 2};
  dsw_scene_desc desc;
  memset(fall, 0, sizeof *fall);
  surface_place(surface, kSize, middle);
  fall->environment = create_pyramids(context, &fall->cells);
  fall->impassable = mark_obstacles(fall->environment);
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_STATISTICS;
  require(dsw_scene_create(fall->environment, &desc, &fall->scene), "creating a scene", kFailed);
  require(soft_create(&fall->soft, fall->scene, surface, "surface"), "the surface cannot be used", kBadInput);
}

void fall_run(demo_fall *fall, size_t steps, FILE *csv) {
  for (size_t step = 0; step < steps; ++step) {
    soft_step(&fall->soft, kGravity, step + kKeptSteps >= steps, csv);
  }
  /* Faces and all: a body created anew where this one ended must be free there. */
  dsw_scene *scene = NULL;
  dsw_body_id body;
  require(dsw_scene_create(fall->environment, NULL, &scene), "creating a scene", kFailed);
  fall->still_free = soft_create_body(fall->soft.surface, scene, &body) == DSW_STATUS_OK;
  require(dsw_scene_destroy(scene), "destroying a scene", kFailed);
  prove_edges(&fall->soft.figures, fall->scene, fall->soft.body);
}

void fall_destroy(demo_fall *fall) {
  require(dsw_scene_destroy(fall->scene), "destroying a scene", kFailed);
  require(dsw_environment_destroy(fall->environment), "destroying the pyramids", kFailed);
  soft_destroy(&fall->soft);
}
