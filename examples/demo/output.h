/* Writes .vtu files (VTK XML, text) that ParaView and PyVista read. */
#ifndef DARTSWEEP_DEMO_OUTPUT_H
#define DARTSWEEP_DEMO_OUTPUT_H

#include <dartsweep/dartsweep.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Opens a file of a folder for writing; null, and why on stderr, if that fails. */
FILE *output_open(const char *directory, const char *name);

/* Values at the points: `components` doubles each. */
typedef struct vtu_field {
  const char *name;
  const double *values;
  int components;
} vtu_field;

vtu_field field(const char *name, const double *values, int components);

/* Writes points and, with cell_points > 0, cells of that many points each (2: lines, 3: triangles); with
 * cell_points 0 every point is a dot. Returns 0, or prints why not to stderr and returns 2. */
int vtu_write(const char *directory, const char *name, const double *points, size_t point_count, const uint32_t *cells,
              size_t cell_points, size_t cell_count, const vtu_field *fields, size_t field_count);

/* Dots with a normal each. */
int write_touches(const char *directory, const char *name, const double *points, const double *normals, size_t count);

/* Triangles of all that is impassable; of the outer boundary too, if `with_boundary` is not 0. */
int write_trace(const dsw_environment *environment, const char *directory, const char *name, int with_boundary);

#ifdef __cplusplus
}
#endif

#endif
