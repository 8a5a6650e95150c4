#include "polygons.h"

#include <stdlib.h>

#include "base.h"

static void expect_room(int there_is) {
  if (there_is) return;
  fprintf(stderr, "the mesh is too large\n");
  exit(kFailed);
}

void mesh_clear(plane_mesh *mesh) { mesh->point_count = mesh->cell_count = 0, mesh->first[0] = 0; }

int64_t mesh_point(plane_mesh *mesh, double x, double y) {
  expect_room(mesh->point_count < kMostPoints);
  mesh->points[2 * mesh->point_count] = x;
  mesh->points[2 * mesh->point_count + 1] = y;
  return (int64_t)mesh->point_count++;
}

void mesh_cell(plane_mesh *mesh, const int64_t *corners, size_t count, int32_t region) {
  const size_t cell = mesh->cell_count, first = (size_t)mesh->first[cell];
  size_t i;
  expect_room(cell < kMostCells && first + count <= kMostCorners);
  for (i = 0; i < count; ++i) mesh->corners[first + i] = corners[i];
  mesh->first[cell + 1] = (int64_t)(first + count);
  mesh->types[cell] = (uint8_t)(count == 3   ? DSW_CELL_TYPE_TRIANGLE
                                : count == 4 ? DSW_CELL_TYPE_QUAD
                                             : DSW_CELL_TYPE_POLYGON);
  mesh->regions[cell] = region;
  ++mesh->cell_count;
}

dsw_environment *mesh_environment(const plane_mesh *mesh) {
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.dimension = 2;
  desc.points = mesh->points;
  desc.point_count = mesh->point_count;
  desc.cell_types = mesh->types;
  desc.volume_count = mesh->cell_count;
  desc.offsets = mesh->first;
  desc.connectivity = mesh->corners;
  desc.connectivity_count = (size_t)mesh->first[mesh->cell_count];
  desc.regions = mesh->regions;
  desc.flags = DSW_ENVIRONMENT_CHECK_BOUNDARY;
  require(dsw_environment_create(NULL, &desc, &environment, NULL), "creating an environment", kFailed);
  require(dsw_environment_mark_region(environment, kSolid, DSW_MARK_IMPASSABLE, 0, NULL, NULL), "marking", kFailed);
  return environment;
}

void mesh_draw(const plane_mesh *mesh, const svg_view *view, const char *open_style, const char *solid_style) {
  double corners[2 * 64];
  size_t cell, i;
  int pass;
  /* What is solid covers the lines round it. */
  for (pass = 0; pass < 2; ++pass) {
    for (cell = 0; cell < mesh->cell_count; ++cell) {
      const size_t first = (size_t)mesh->first[cell], count = (size_t)mesh->first[cell + 1] - first;
      if ((mesh->regions[cell] == kSolid) != (pass == 1)) continue;
      for (i = 0; i < count && i < 64; ++i) {
        corners[2 * i] = mesh->points[2 * mesh->corners[first + i]];
        corners[2 * i + 1] = mesh->points[2 * mesh->corners[first + i] + 1];
      }
      svg_polygon(view, corners, i, pass == 1 ? solid_style : open_style);
    }
  }
}
