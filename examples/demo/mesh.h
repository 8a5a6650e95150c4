/* The mesh the demo runs on: plain arrays, as dsw_environment_desc wants them. */
#ifndef DARTSWEEP_DEMO_MESH_H
#define DARTSWEEP_DEMO_MESH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Owned by the caller, who gives it back to mesh_free. */
typedef struct demo_mesh {
  double *points; /* 3 doubles each */
  size_t point_count;
  uint8_t *types; /* dsw_cell_type of each cell */
  size_t cell_count;
  int64_t *offsets; /* cell_count + 1 */
  int64_t *connectivity;
  size_t connectivity_count;
  int32_t *regions;     /* a label for each cell */
  int32_t lumen;        /* label of the lumen; 0: the mesh tells no lumen from the rest */
  size_t *wall_offsets; /* faces of the wall, for meshes that name it but have no lumen */
  uint32_t *wall_points;
  size_t wall_count;
  double inlet[3]; /* middle of the inlet, if has_inlet */
  int has_inlet;
} demo_mesh;

/* Reads the arrays that read_mesh.py wrote. Returns 0, or prints why not to stderr and returns 2. */
int mesh_read(const char *path, demo_mesh *mesh);

/* Makes a branching vessel (region 1) in its tissue (region 2) out of tetrahedra on a lattice of `spacing` mm,
 * which must be within 0.6 .. 2.5. Returns 0, or prints why not to stderr and returns 2. */
int mesh_make_vessel(double spacing, demo_mesh *mesh);

/* For points of that vessel: the ways to its middle, less in the tissue, none at the outside. Neighbours go alike. */
void mesh_find_ways_inward(const double *points, size_t count, double *ways);

/* Null pointers inside are allowed. */
void mesh_free(demo_mesh *mesh);

/* malloc that ends the program with a message when there is no memory left. */
void *demo_allocate(size_t count, size_t size);

#ifdef __cplusplus
}
#endif

#endif
