#include "surface.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh.h"

static const double kPi = 3.14159265358979323846;

void surface_free(demo_surface *surface) {
  free(surface->points);
  free(surface->corners);
  memset(surface, 0, sizeof *surface);
}

/* Counts what the file has, or with arrays reads it; corners may be written as 7, 7/1, 7/1/2 or 7//2. */
static int scan(FILE *file, demo_surface *surface, int take) {
  char line[512];
  size_t points = 0, triangles = 0;
  rewind(file);
  while (fgets(line, sizeof line, file) != NULL) {
    if (line[0] == 'v' && line[1] == ' ') {
      double *p = take ? surface->points + 3 * points : NULL;
      ++points;
      if (take && sscanf(line + 2, "%lf %lf %lf", p, p + 1, p + 2) != 3) {
        return 0;
      }
    } else if (line[0] == 'f' && line[1] == ' ') {
      uint32_t *corners = take ? surface->corners + 3 * triangles : NULL;
      char *at = line + 2;
      ++triangles;
      for (int k = 0; take && k < 3; ++k) {
        long corner = strtol(at, &at, 10);
        if (corner < 1 || (size_t)corner > surface->point_count) {
          return 0;
        }
        corners[k] = (uint32_t)(corner - 1);
        at += strcspn(at, " ");
      }
      if (take && strtol(at, NULL, 10) != 0) { /* a fourth corner */
        return 0;
      }
    }
  }
  surface->point_count = points;
  surface->triangle_count = triangles;
  return points > 0 && triangles > 0;
}

static void allocate(demo_surface *surface) {
  surface->points = (double *)demo_allocate(3 * surface->point_count, sizeof(double));
  surface->corners = (uint32_t *)demo_allocate(3 * surface->triangle_count, sizeof(uint32_t));
}

int surface_read(const char *path, demo_surface *surface) {
  FILE *file = fopen(path, "r");
  memset(surface, 0, sizeof *surface);
  if (file == NULL) {
    fprintf(stderr, "demo: cannot open surface file '%s'\n", path);
    return 2;
  }
  int good = scan(file, surface, 0);
  if (good) {
    allocate(surface);
    good = scan(file, surface, 1);
  }
  fclose(file);
  if (!good) {
    fprintf(stderr, "demo: '%s' is not a Wavefront .obj file of triangles\n", path);
    surface_free(surface);
    return 2;
  }
  return 0;
}

void surface_make_ring(size_t around, size_t across, demo_surface *surface) {
  surface->point_count = around * across;
  surface->triangle_count = 2 * around * across;
  allocate(surface);
  uint32_t *corners = surface->corners;
  for (size_t i = 0; i < around; ++i) {
    for (size_t j = 0; j < across; ++j) {
      double a = 2 * kPi * (double)i / (double)around, b = 2 * kPi * (double)j / (double)across;
      double thick = 0.3 + 0.04 * sin(5 * a) * cos(2 * b), *p = surface->points + 3 * (i * across + j);
      p[0] = 1.2 * (0.8 + thick * cos(b)) * cos(a);
      p[1] = (0.8 + thick * cos(b)) * sin(a);
      p[2] = thick * sin(b);
      uint32_t c[4] = {(uint32_t)(i * across + j), (uint32_t)((i + 1) % around * across + j),
                       (uint32_t)((i + 1) % around * across + (j + 1) % across),
                       (uint32_t)(i * across + (j + 1) % across)};
      uint32_t both[6] = {c[0], c[1], c[2], c[0], c[2], c[3]};
      memcpy(corners, both, sizeof both);
      corners += 6;
    }
  }
}

void surface_place(demo_surface *surface, double size, const double *middle) {
  double low[3], high[3], extent[3];
  int axis[3] = {0, 1, 2};
  memcpy(low, surface->points, sizeof low);
  memcpy(high, surface->points, sizeof high);
  for (size_t i = 0; i < 3 * surface->point_count; ++i) {
    double x = surface->points[i];
    low[i % 3] = x < low[i % 3] ? x : low[i % 3];
    high[i % 3] = x > high[i % 3] ? x : high[i % 3];
  }
  for (int k = 0; k < 3; ++k) {
    extent[k] = high[k] - low[k];
  }
  for (int turn = 0; turn < 3; ++turn) { /* three swaps sort three numbers */
    int k = turn % 2, l = k + 1, swap = axis[k];
    if (extent[axis[k]] < extent[axis[l]]) {
      axis[k] = axis[l];
      axis[l] = swap;
    }
  }
  /* An odd order of the axes would turn it inside out. */
  double mirror = (axis[0] + 1) % 3 == axis[1] ? 1 : -1, scale = size / extent[axis[0]];
  for (size_t i = 0; i < surface->point_count; ++i) {
    double *p = surface->points + 3 * i, old[3];
    memcpy(old, p, sizeof old);
    for (int k = 0; k < 3; ++k) {
      double sign = k == 1 ? mirror : 1;
      p[k] = middle[k] + sign * scale * (old[axis[k]] - 0.5 * (low[axis[k]] + high[axis[k]]));
    }
  }
}
