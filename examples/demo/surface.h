/* A closed surface of triangles, from a file or made here. */
#ifndef DARTSWEEP_DEMO_SURFACE_H
#define DARTSWEEP_DEMO_SURFACE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Owned by the caller, who gives it back to surface_free. */
typedef struct demo_surface {
  double *points;    /* 3 doubles each */
  uint32_t *corners; /* 3 a triangle */
  size_t point_count, triangle_count;
} demo_surface;

/* Reads `v` and `f` of a Wavefront .obj file. Returns 0, or prints why not to stderr and returns 2. */
int surface_read(const char *path, demo_surface *surface);

/* Makes a ring with dents, `around` x `across` vertices, two triangles for each. */
void surface_make_ring(size_t around, size_t across, demo_surface *surface);

/* Turns and moves it so that its longest extent, now `size`, is along x, its shortest along z, its middle at `middle`. */
void surface_place(demo_surface *surface, double size, const double *middle);

void surface_free(demo_surface *surface);

#ifdef __cplusplus
}
#endif

#endif
