#include "fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

const dsw_volume_id no_volume = {0, 0}, stale_volume = {0, 7};
const dsw_particle_id stale_particle = {0, 7};

static void stop_unless(int passed, const char *what) {
  if (passed) return;
  fprintf(stderr, "fixture: %s: %s\n", what, dsw_last_error_message());
  exit(2);
}

uint32_t grid_point(const grid *g, unsigned x, unsigned y, unsigned z) {
  return x + (g->nx + 1) * (y + (g->ny + 1) * z);
}

grid grid_create(unsigned nx, unsigned ny, unsigned nz) {
  static const unsigned corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  grid g;
  unsigned x, y, z, k;
  size_t cell = 0;
  g.nx = nx, g.ny = ny, g.nz = nz;
  g.cell_count = (size_t)nx * ny * nz;
  g.point_count = (size_t)(nx + 1) * (ny + 1) * (nz + 1);
  g.points = (double *)malloc(g.point_count * 3 * sizeof(double));
  g.cells = (int64_t *)malloc(g.cell_count * 8 * sizeof(int64_t));
  g.regions = (int32_t *)malloc(g.cell_count * sizeof(int32_t));
  g.tags = (uint32_t *)malloc(g.cell_count * sizeof(uint32_t));
  stop_unless(g.points != NULL && g.cells != NULL && g.regions != NULL && g.tags != NULL, "malloc");
  for (z = 0; z <= nz; ++z) {
    for (y = 0; y <= ny; ++y) {
      for (x = 0; x <= nx; ++x) {
        double *const p = g.points + 3 * (size_t)grid_point(&g, x, y, z);
        p[0] = x, p[1] = y, p[2] = z;
      }
    }
  }
  for (z = 0; z < nz; ++z) {
    for (y = 0; y < ny; ++y) {
      for (x = 0; x < nx; ++x, ++cell) {
        for (k = 0; k < 8; ++k) {
          g.cells[8 * cell + k] = grid_point(&g, x + corners[k][0], y + corners[k][1], z + corners[k][2]);
        }
        g.regions[cell] = (int32_t)x;
        g.tags[cell] = 100 + (uint32_t)cell;
      }
    }
  }
  return g;
}

void grid_destroy(grid *g) {
  free(g->points);
  free(g->cells);
  free(g->regions);
  free(g->tags);
}

dsw_environment_desc grid_desc(const grid *g) {
  dsw_environment_desc d;
  dsw_environment_desc_init(&d, sizeof d);
  d.points = g->points;
  d.point_count = g->point_count;
  d.volume_count = g->cell_count;
  d.connectivity = g->cells;
  d.connectivity_count = 8 * g->cell_count;
  d.regions = g->regions;
  d.tags = g->tags;
  return d;
}

dsw_environment *make_environment(dsw_context *context, unsigned nx, unsigned ny, unsigned nz) {
  grid g = grid_create(nx, ny, nz);
  const dsw_environment_desc d = grid_desc(&g);
  dsw_environment *environment = NULL;
  stop_unless(dsw_environment_create(context, &d, &environment, NULL) == DSW_STATUS_OK, "environment");
  grid_destroy(&g);
  return environment;
}

dsw_environment_desc squares_desc(grid *g) {
  dsw_environment_desc d = grid_desc(g);
  size_t i;
  d.dimension = 2;
  d.point_count /= 2;
  d.uniform_cell_type = DSW_CELL_TYPE_QUAD;
  d.connectivity_count /= 2;
  /* The points below come first, and in each cube the face below. */
  for (i = 0; i < d.point_count; ++i) memmove(g->points + 2 * i, g->points + 3 * i, 2 * sizeof *g->points);
  for (i = 0; i < d.volume_count; ++i) memmove(g->cells + 4 * i, g->cells + 8 * i, 4 * sizeof *g->cells);
  return d;
}

dsw_environment *make_squares(dsw_context *context, unsigned nx, unsigned ny) {
  grid g = grid_create(nx, ny, 1);
  const dsw_environment_desc d = squares_desc(&g);
  dsw_environment *environment = NULL;
  stop_unless(dsw_environment_create(context, &d, &environment, NULL) == DSW_STATUS_OK, "squares");
  grid_destroy(&g);
  return environment;
}

void end_scene(dsw_scene *scene) {
  dsw_environment *const environment = dsw_scene_get_environment(scene);
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_environment_destroy(environment));
}

dsw_change empty_change(void) {
  dsw_change change;
  memset(&change, 0, sizeof change);
  change.struct_size = sizeof change;
  return change;
}

dsw_change change_of(const dsw_environment *environment) {
  dsw_change change = empty_change();
  CHECK_OK(dsw_environment_get_change(environment, &change));
  return change;
}

dsw_environment_info info_of(const dsw_environment *environment) {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  CHECK_OK(dsw_environment_get_info(environment, &info));
  return info;
}

dsw_environment_desc polygons_desc(const double *points, size_t point_count, dsw_cell_type type, const int64_t *cells,
                                   size_t cell_count) {
  dsw_environment_desc d;
  dsw_environment_desc_init(&d, sizeof d);
  d.dimension = 2;
  d.points = points;
  d.point_count = point_count;
  d.uniform_cell_type = type;
  d.volume_count = cell_count;
  d.connectivity = cells;
  d.connectivity_count = (type == DSW_CELL_TYPE_TRIANGLE ? 3 : 4) * cell_count;
  return d;
}

dsw_build_report create_reported(const dsw_environment_desc *d, dsw_environment **environment) {
  dsw_build_report r;
  memset(&r, 0x55, sizeof r);
  r.struct_size = sizeof r;
  *environment = NULL;
  dsw_environment_create(NULL, d, environment, &r);
  return r;
}

dsw_build_report create_alone(const dsw_environment_desc *d) {
  dsw_environment *environment;
  const dsw_build_report r = create_reported(d, &environment);
  CHECK_OK(dsw_environment_destroy(environment));
  return r;
}

dsw_scene *make_scene(dsw_environment *environment, uint32_t features) {
  dsw_scene_desc d;
  dsw_scene *scene = NULL;
  dsw_scene_desc_init(&d, sizeof d);
  d.features = features;
  stop_unless(dsw_scene_create(environment, &d, &scene) == DSW_STATUS_OK, "scene");
  return scene;
}

dsw_body_desc body_desc(const double *positions, size_t count, const uint32_t *edges, size_t edge_count,
                        dsw_level level) {
  dsw_body_desc d;
  dsw_body_desc_init(&d, sizeof d);
  d.level = level;
  d.positions = positions;
  d.vertex_count = count;
  d.edges = edges;
  d.edge_count = edge_count;
  return d;
}

dsw_body_desc surface_desc(const double *positions, size_t count, const uint32_t *offsets, const uint32_t *corners,
                           size_t face_count, dsw_level level) {
  dsw_body_desc d = body_desc(positions, count, NULL, 0, level);
  d.face_offsets = offsets;
  d.face_corners = corners;
  d.face_count = face_count;
  d.face_corner_count = offsets[face_count];
  return d;
}

dsw_body_desc line_desc(const double *positions, size_t count, int closed, dsw_level level) {
  static uint32_t open[32], loop[32];
  size_t i;
  stop_unless(count >= 1 && count <= 16, "line");
  for (i = 0; i < 32; ++i) open[i] = (uint32_t)((i + 1) / 2);
  memcpy(loop, open, sizeof loop);
  loop[2 * count - 1] = 0;
  return body_desc(positions, count, closed ? loop : open, closed ? count : count - 1, level);
}

dsw_body_id make_edge_body(dsw_scene *scene, const double *positions, dsw_level level) {
  const dsw_body_desc d = line_desc(positions, 2, 0, level);
  dsw_body_id id = {0, 0};
  stop_unless(dsw_body_create(scene, &d, &id) == DSW_STATUS_OK, "body");
  return id;
}

dsw_body_counts body_counts(const dsw_scene *scene, dsw_body_id body) {
  dsw_body_counts c;
  c.struct_size = sizeof c;
  CHECK_OK(dsw_body_get_counts(scene, body, &c));
  return c;
}

dsw_move_options move_options(void) {
  dsw_move_options o;
  dsw_move_options_init(&o, sizeof o);
  return o;
}

dsw_deform_options deform_options_of(dsw_deform_method method, dsw_wall_response response) {
  dsw_deform_options o;
  dsw_deform_options_init(&o, sizeof o);
  o.method = method;
  o.response = response;
  return o;
}

dsw_deform_report deform_to_next(dsw_scene *scene, double *points, size_t point_count, unsigned dimension, int *next,
                                 const dsw_deform_options *o) {
  const size_t numbers = dimension * point_count;
  double *const to = points + (size_t)*next * numbers, *const other = points + (size_t)(1 - *next) * numbers;
  dsw_deform_report report;
  memset(&report, 9, sizeof report);
  CHECK_OK(dsw_environment_deform(dsw_scene_get_environment(scene), to, point_count, o, &report));
  if (report.outcome != DSW_DEFORM_REFUSED) {
    const double *read = NULL;
    size_t count = 0;
    CHECK_OK(dsw_environment_get_points(dsw_scene_get_environment(scene), &read, &count));
    CHECK(read == to && count == point_count);
    memcpy(other, to, numbers * sizeof *to);
    *next = 1 - *next;
  }
  return report;
}

dsw_status set_volume_mark(dsw_environment *environment, uint32_t index, dsw_mark mark) {
  const dsw_volume_id id = volume_at(index);
  return dsw_environment_mark_volumes(environment, &id, 1, mark, 0, NULL);
}

dsw_status set_face_mark(dsw_environment *environment, uint32_t volume, uint32_t local, dsw_mark mark) {
  const dsw_face_id id = face_at(volume, local);
  return dsw_environment_mark_faces(environment, &id, 1, mark);
}

dsw_status set_vertex_mark(dsw_environment *environment, uint32_t index, dsw_mark mark) {
  const dsw_vertex_id id = vertex_at(index);
  return dsw_environment_mark_vertices(environment, &id, 1, mark);
}

dsw_volume_id volume_at(uint32_t index) {
  const dsw_volume_id id = {index, 1};
  return id;
}

dsw_face_id face_at(uint32_t volume, uint32_t local) {
  const dsw_face_id id = {volume, 1, local};
  return id;
}

dsw_edge_id edge_at(uint32_t volume, uint32_t local) {
  const dsw_edge_id id = {volume, 1, local};
  return id;
}

dsw_vertex_id vertex_at(uint32_t index) {
  const dsw_vertex_id id = {index, 1};
  return id;
}

dsw_cell cell_at(dsw_cell_kind kind, uint32_t index, uint32_t local) {
  const dsw_cell cell = {kind, index, 1, local};
  return cell;
}

static int write_tape(void *user, const void *bytes, size_t size_bytes) {
  tape *const t = (tape *)user;
  if (++t->writes == t->refuse || t->size + size_bytes > sizeof t->bytes) return 1;
  memcpy(t->bytes + t->size, bytes, size_bytes);
  t->size += size_bytes;
  return 0;
}

dsw_recording_desc to_tape(tape *t) {
  dsw_recording_desc desc;
  dsw_recording_desc_init(&desc, sizeof desc);
  memset(t, 0, sizeof *t);
  desc.write = write_tape;
  desc.user = t;
  return desc;
}

/* Sizes are kept in front of a block, so that what comes back can be compared. */
typedef struct block_head {
  void *base;
  size_t size, alignment;
} block_head;

static void *host_allocate(void *user, size_t size, size_t alignment) {
  host *const h = (host *)user;
  char *base;
  uintptr_t at;
  block_head *head;
  if (size == 0 || alignment == 0 || alignment > 64 || (alignment & (alignment - 1)) != 0) h->broken = 1;
  if (++h->calls == h->refuse) return NULL;
  base = (char *)malloc(size + sizeof(block_head) + 64);
  stop_unless(base != NULL, "malloc");
  at = ((uintptr_t)base + sizeof(block_head) + alignment - 1) & ~((uintptr_t)alignment - 1);
  if (at % sizeof(void *) != 0) at += sizeof(void *) - at % sizeof(void *);
  head = (block_head *)at - 1;
  head->base = base;
  head->size = size;
  head->alignment = alignment;
  ++h->alive;
  h->alive_bytes += size;
  return (void *)at;
}

static void host_release(void *user, void *memory, size_t size, size_t alignment) {
  host *const h = (host *)user;
  block_head *head;
  if (memory == NULL) {
    h->broken = 1;
    return;
  }
  head = (block_head *)memory - 1;
  if (head->size != size || head->alignment != alignment) h->broken = 1;
  --h->alive;
  h->alive_bytes -= head->size;
  free(head->base);
}

static void host_log(void *user, dsw_log_level level, const char *text) {
  host *const h = (host *)user;
  ++h->log_lines;
  h->last_level = level;
  strncpy(h->last_line, text, sizeof h->last_line - 1);
}

static void host_parallel_for(void *user, dsw_task_fn task, void *task_data, size_t task_count) {
  host *const h = (host *)user;
  ++h->parallel_calls;
  h->tasks += task_count;
  while (task_count-- > 0) task(task_data, task_count);
}

dsw_context_desc host_desc(host *h) {
  dsw_context_desc d;
  memset(h, 0, sizeof *h);
  dsw_context_desc_init(&d, sizeof d);
  d.user = h;
  d.allocate = host_allocate;
  d.release = host_release;
  d.log = host_log;
  d.parallel_for = host_parallel_for;
  return d;
}

dsw_context *make_context(host *h) {
  const dsw_context_desc d = host_desc(h);
  dsw_context *context = NULL;
  stop_unless(dsw_context_create(&d, &context) == DSW_STATUS_OK, "context");
  return context;
}

void end_context(dsw_context *context, const host *h) {
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h->alive == 0 && h->alive_bytes == 0 && h->broken == 0);
}

void refuse_after(host *h, size_t n) {
  stop_unless(n < 100000, "a call that never succeeds");
  h->refuse = h->calls + n + 1;
}

int ran_out(host *h, dsw_status status) {
  h->refuse = 0;
  if (status != DSW_STATUS_OUT_OF_MEMORY) CHECK_OK(status);
  return status == DSW_STATUS_OUT_OF_MEMORY;
}
