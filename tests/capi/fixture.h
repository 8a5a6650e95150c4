/* What the tests of the C interface share: a grid of unit cubes, and a host that counts, and refuses, memory. */
#ifndef DARTSWEEP_TESTS_CAPI_FIXTURE_H
#define DARTSWEEP_TESTS_CAPI_FIXTURE_H

#include "dartsweep/dartsweep.h"

/* nx * ny * nz unit cubes; cube (x, y, z) is cell x + nx * (y + ny * z), its region is x and its tag 100 + cell. */
typedef struct grid {
  unsigned nx, ny, nz;
  double *points;
  int64_t *cells;
  int32_t *regions;
  uint32_t *tags;
  size_t point_count, cell_count;
} grid;

grid grid_create(unsigned nx, unsigned ny, unsigned nz);
void grid_destroy(grid *g);
/* Index of the point at a corner. */
uint32_t grid_point(const grid *g, unsigned x, unsigned y, unsigned z);
dsw_environment_desc grid_desc(const grid *g);
/* The squares below the cubes, in the plane; for a grid one cube high. Packs the points and the cells of the grid. */
dsw_environment_desc squares_desc(grid *g);
/* An environment of the grid; stops the program if that fails. */
dsw_environment *make_environment(dsw_context *context, unsigned nx, unsigned ny, unsigned nz);
/* nx * ny unit squares in the plane; square (x, y) is cell x + nx * y, its region is x and its tag 100 + cell. Its
   sides run along y = 0, x = 1, y = 1 and x = 0 of it. */
dsw_environment *make_squares(dsw_context *context, unsigned nx, unsigned ny);
/* Triangles or quadrilaterals of the plane. */
dsw_environment_desc polygons_desc(const double *points, size_t point_count, dsw_cell_type type, const int64_t *cells,
                                   size_t cell_count);
/* Creates an environment, null if that fails, without a context; the report says how that went. */
dsw_build_report create_reported(const dsw_environment_desc *d, dsw_environment **environment);
/* The report alone. */
dsw_build_report create_alone(const dsw_environment_desc *d);
dsw_scene *make_scene(dsw_environment *environment, uint32_t features);
/* Destroys a scene and its environment. */
void end_scene(dsw_scene *scene);
dsw_environment_info info_of(const dsw_environment *environment);
/* The last change of the topology. */
dsw_change change_of(const dsw_environment *environment);
/* A dsw_change to be filled. */
dsw_change empty_change(void);
dsw_body_desc body_desc(const double *positions, size_t count, const uint32_t *edges, size_t edge_count,
                        dsw_level level);
/* Faces alone; the last offset is the number of their corners. */
dsw_body_desc surface_desc(const double *positions, size_t count, const uint32_t *offsets, const uint32_t *corners,
                           size_t face_count, dsw_level level);
/* A line of up to 16 vertices that edges join in their order, the last with the first if it is closed. */
dsw_body_desc line_desc(const double *positions, size_t count, int closed, dsw_level level);
/* A body of one edge between two points; stops the program if that fails. */
dsw_body_id make_edge_body(dsw_scene *scene, const double *positions, dsw_level level);

dsw_body_counts body_counts(const dsw_scene *scene, dsw_body_id body);

dsw_move_options move_options(void);
dsw_deform_options deform_options_of(dsw_deform_method method, dsw_wall_response response);
/* Deforms to the one of two arrays of points, one behind the other, that may be written; it becomes the other one,
   unless that is refused. point_count points of the scene's dimension each. */
dsw_deform_report deform_to_next(dsw_scene *scene, double *points, size_t point_count, unsigned dimension, int *next,
                                 const dsw_deform_options *o);

/* The mark of one cell. */
dsw_status set_volume_mark(dsw_environment *environment, uint32_t index, dsw_mark mark);
dsw_status set_face_mark(dsw_environment *environment, uint32_t volume, uint32_t local, dsw_mark mark);
dsw_status set_vertex_mark(dsw_environment *environment, uint32_t index, dsw_mark mark);

dsw_volume_id volume_at(uint32_t index);
dsw_face_id face_at(uint32_t volume, uint32_t local);
dsw_edge_id edge_at(uint32_t volume, uint32_t local);
dsw_vertex_id vertex_at(uint32_t index);
dsw_cell cell_at(dsw_cell_kind kind, uint32_t index, uint32_t local);
/* Ids that name nothing: the null id where null means "none", and otherwise a generation never given out. */
extern const dsw_volume_id no_volume, stale_volume;
extern const dsw_particle_id stale_particle;

/* Where recordings go: memory, which may refuse. */
typedef struct tape {
  unsigned char bytes[65536];
  size_t size, writes, refuse; /* the write that is refused, from 1; 0: none */
} tape;
/* Empties a tape and describes recording to it. */
dsw_recording_desc to_tape(tape *t);

/* Faces of a hexahedron, in the order of its type. */
enum { FACE_X0 = 0, FACE_X1 = 1, FACE_Y0 = 2, FACE_Y1 = 3, FACE_Z0 = 4, FACE_Z1 = 5 };

/* Memory of a host: counts what is alive and refuses the call number `refuse` (counted from 1; 0: none). Not for
   several threads. */
typedef struct host {
  size_t calls, refuse, alive, alive_bytes;
  int broken; /* a block came back with other sizes, or was asked for with bad ones */
  size_t log_lines;
  dsw_log_level last_level;
  char last_line[256];
  size_t parallel_calls, tasks;
} host;

/* A description whose callbacks use the host; parallel_for runs the tasks here, last one first. */
dsw_context_desc host_desc(host *h);
dsw_context *make_context(host *h);
/* Destroys a context, whose host must have all memory back. */
void end_context(dsw_context *context, const host *h);
/* Whether `call` runs out of memory when the host refuses its allocation number n, from 0 on. */
#define RUNS_OUT(h, n, call) (refuse_after((h), (n)), ran_out((h), (call)))
void refuse_after(host *h, size_t n);
int ran_out(host *h, dsw_status status);

#endif
