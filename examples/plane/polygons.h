/* Environments in the plane, collected polygon by polygon. */
#ifndef DARTSWEEP_PLANE_POLYGONS_H
#define DARTSWEEP_PLANE_POLYGONS_H

#include <dartsweep/dartsweep.h>

#include "svg.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { kMostPoints = 4096, kMostCells = 4096, kMostCorners = 16384 };

typedef struct plane_mesh {
  double points[2 * kMostPoints];
  size_t point_count;
  int64_t corners[kMostCorners];
  int64_t first[kMostCells + 1];
  uint8_t types[kMostCells];
  int32_t regions[kMostCells]; /* kOpen or kSolid */
  size_t cell_count;
} plane_mesh;

enum { kOpen = 0, kSolid = 1 };

void mesh_clear(plane_mesh *mesh);
int64_t mesh_point(plane_mesh *mesh, double x, double y);
/* A convex polygon, counter-clockwise. */
void mesh_cell(plane_mesh *mesh, const int64_t *corners, size_t count, int32_t region);
/* What is solid is impassable. */
dsw_environment *mesh_environment(const plane_mesh *mesh);
void mesh_draw(const plane_mesh *mesh, const svg_view *view, const char *open_style, const char *solid_style);

#ifdef __cplusplus
}
#endif

#endif
