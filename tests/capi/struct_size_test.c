/* Structs that begin with their size, every one in every function that takes it: at the size of the first release, at
   every size since, and larger than they are today, as a later header makes them. abi/check_abi.py structs compares
   the tables with the headers. */
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

enum { GUARD = 64, LARGEST = 4096 };

/* ---- the last member of each in the first release: never changes ------------------------------------------------- */
#define LAST_dsw_body_counts reserved
#define LAST_dsw_body_desc motion_share
#define LAST_dsw_build_report convex_volume_count
#define LAST_dsw_bug_report_desc note
#define LAST_dsw_carve_desc snap
#define LAST_dsw_cast_options reserved
#define LAST_dsw_change body_face_count
#define LAST_dsw_coarsen_options max_trials
#define LAST_dsw_coarsen_report trials
#define LAST_dsw_context_desc parallel_for
#define LAST_dsw_cut_desc snap
#define LAST_dsw_deform_options min_part
#define LAST_dsw_detach_desc max_volumes
#define LAST_dsw_environment_desc reserved
#define LAST_dsw_environment_info upper
#define LAST_dsw_move_options order_count
#define LAST_dsw_near_options radius
#define LAST_dsw_together_options response
#define LAST_dsw_scene_deform_options point_room
#define LAST_dsw_open_crack_desc tag
#define LAST_dsw_recording_desc user
#define LAST_dsw_remesh_desc max_faces
#define LAST_dsw_replay_info validation
#define LAST_dsw_scene_desc features
#define LAST_dsw_statistics candidates
#define LAST_dsw_sweep_options max_volumes
#define LAST_dsw_tie_desc snap
#define LAST_dsw_trace_data triangle_count
#define LAST_dsw_validation text
#define LAST_dsw_volumes_desc reserved

/* ---- calls that succeed with what is described ------------------------------------------------------------------- */
enum { SIDE = 4, POINTS = (SIDE + 1) * (SIDE + 1) * (SIDE + 1), CUBE = 1 + SIDE * (1 + SIDE) };

static grid g_grid;
static dsw_environment *g_env; /* SIDE * SIDE * SIDE cubes */
static dsw_scene *g_scene;
static double g_next[3 * POINTS];
static const dsw_rigid_motion kStays = {{0, 0, 0, 1}, {0, 0, 0}, {0, 0, 0}};
static dsw_flight g_flight;

static void begin(void) {
  g_env = make_environment(NULL, SIDE, SIDE, SIDE);
  g_scene = make_scene(g_env, DSW_FEATURE_STATISTICS | DSW_FEATURE_DEFORMING);
}

static void end(void) { end_scene(g_scene); }
static const double g_from[3] = {0.5, 0.25, 0.5}, g_to[3] = {2.5, 0.25, 0.5}, g_fixed[3] = {0.5, 2.25, 0.5};
static dsw_contact_partner g_partner;
static dsw_sweep g_sweep;
static const double g_line[6] = {0.5, 0.25, 0.5, 0.5, 2.25, 0.5}, g_target[6] = {1.5, 0.25, 0.5, 1.5, 2.25, 0.5};

static dsw_particle_id particle(void) {
  dsw_particle_id id = {0, 0};
  CHECK_OK(dsw_particle_create(g_scene, g_from, no_volume, &id));
  return id;
}

static dsw_body_id body(void) { return make_edge_body(g_scene, g_line, DSW_LEVEL_EDGES); }

#define RUN(function, type) static dsw_status run_##function##_##type(type *s)

RUN(dsw_context_create, dsw_context_desc) {
  dsw_context *context = NULL;
  const dsw_status status = dsw_context_create(s, &context);
  CHECK_OK(dsw_context_destroy(context));
  return status;
}
static const dsw_body_id *one(void) {
  static dsw_body_id id;
  id = body();
  return &id;
}

RUN(dsw_environment_create, dsw_environment_desc) {
  dsw_environment *environment = NULL;
  const dsw_status status = dsw_environment_create(NULL, s, &environment, NULL);
  CHECK_OK(dsw_environment_destroy(environment));
  return status;
}
RUN(dsw_environment_create, dsw_build_report) {
  const dsw_environment_desc desc = grid_desc(&g_grid);
  dsw_environment *environment = NULL;
  const dsw_status status = dsw_environment_create(NULL, &desc, &environment, s);
  CHECK_OK(dsw_environment_destroy(environment));
  return status;
}
RUN(dsw_environment_check, dsw_build_report) { return dsw_environment_check(g_env, s); }
RUN(dsw_environment_get_info, dsw_environment_info) { return dsw_environment_get_info(g_env, s); }

/* One cube of six tetrahedra. */
static dsw_status coarsen(const dsw_coarsen_options *options, dsw_coarsen_report *report) {
  static const int64_t cells[24] = {0, 1, 3, 7, 0, 5, 1, 7, 0, 4, 5, 7, 0, 3, 2, 7, 0, 2, 6, 7, 0, 6, 4, 7};
  static const double points[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
  dsw_environment *source = NULL, *coarse = NULL;
  dsw_environment_desc desc;
  dsw_status status;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points;
  desc.point_count = 8;
  desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  desc.volume_count = 6;
  desc.connectivity = cells;
  desc.connectivity_count = 24;
  CHECK_OK(dsw_environment_create(NULL, &desc, &source, NULL));
  status = dsw_environment_coarsen(source, options, &coarse, NULL, 0, report);
  CHECK_OK(dsw_environment_destroy(coarse));
  CHECK_OK(dsw_environment_destroy(source));
  return status;
}
RUN(dsw_environment_coarsen, dsw_coarsen_options) { return coarsen(s, NULL); }
RUN(dsw_environment_coarsen, dsw_coarsen_report) { return coarsen(NULL, s); }

RUN(dsw_scene_create, dsw_scene_desc) {
  dsw_scene *scene = NULL;
  dsw_environment *const environment = make_environment(NULL, 1, 1, 1);
  const dsw_status status = dsw_scene_create(environment, s, &scene);
  if (scene == NULL) CHECK_OK(dsw_environment_destroy(environment));
  end_scene(scene);
  return status;
}
RUN(dsw_scene_get_statistics, dsw_statistics) { return dsw_scene_get_statistics(g_scene, s); }

RUN(dsw_environment_cast, dsw_cast_options) {
  return dsw_environment_cast(g_env, no_volume, g_from, g_to, s, &g_flight);
}
RUN(dsw_environment_cast_segments, dsw_cast_options) {
  return dsw_environment_cast_segments(g_env, 1, NULL, g_from, g_to, 0, s, &g_flight);
}
RUN(dsw_environment_cast_path, dsw_cast_options) {
  dsw_crossing crossings[8];
  size_t count = 0;
  return dsw_environment_cast_path(g_env, no_volume, g_from, g_to, s, crossings, 8, &count, &g_flight);
}
RUN(dsw_particle_move, dsw_cast_options) { return dsw_particle_move(g_scene, particle(), g_to, s, &g_flight); }
RUN(dsw_scene_move_particles, dsw_cast_options) {
  const dsw_particle_id id = particle();
  return dsw_scene_move_particles(g_scene, &id, 1, g_to, 0, s, &g_flight);
}
RUN(dsw_scene_cast, dsw_cast_options) {
  return dsw_scene_cast(g_scene, 1, NULL, g_from, g_to, 0, s, &g_flight, &g_partner);
}
RUN(dsw_scene_cast_from_particles, dsw_cast_options) {
  const dsw_particle_id id = particle();
  return dsw_scene_cast_from_particles(g_scene, &id, 1, g_to, 0, s, &g_flight);
}
RUN(dsw_environment_sweep_edges, dsw_sweep_options) {
  return dsw_environment_sweep_edges(g_env, 1, NULL, g_from, g_to, g_fixed, 0, s, &g_sweep);
}

static dsw_trace *g_trace;
RUN(dsw_trace_add_walk, dsw_cast_options) {
  dsw_status status;
  CHECK_OK(dsw_trace_create(NULL, &g_trace));
  status = dsw_trace_add_walk(g_trace, g_env, no_volume, g_from, g_to, s, 1, 0);
  CHECK_OK(dsw_trace_destroy(g_trace));
  return status;
}
RUN(dsw_trace_get_data, dsw_trace_data) {
  dsw_status status;
  CHECK_OK(dsw_trace_create(NULL, &g_trace));
  status = dsw_trace_get_data(g_trace, s); /* empty: all is 0 */
  CHECK_OK(dsw_trace_destroy(g_trace));
  return status;
}

RUN(dsw_body_create, dsw_body_desc) { return dsw_body_create(g_scene, s, (dsw_body_id[1]){{0}}); }
RUN(dsw_body_get_counts, dsw_body_counts) { return dsw_body_get_counts(g_scene, body(), s); }
RUN(dsw_body_move, dsw_move_options) { return dsw_body_move(g_scene, body(), g_target, 2, 0, s, NULL); }
RUN(dsw_body_find_near_rows, dsw_near_options) { return dsw_body_find_near_rows(g_scene, body(), s, NULL); }
RUN(dsw_scene_move_bodies, dsw_move_options) {
  return dsw_scene_move_bodies(g_scene, one(), 1, g_target, 2, 0, s, NULL);
}
RUN(dsw_scene_move_together, dsw_together_options) {
  return dsw_scene_move_together(g_scene, one(), 1, g_target, 2, 0, s, NULL);
}
RUN(dsw_scene_step_fraction, dsw_together_options) {
  double f;
  return dsw_scene_step_fraction(g_scene, one(), 1, g_target, 2, 0, NULL, 0, s, &f, NULL, NULL, NULL);
}
RUN(dsw_scene_move_rigid, dsw_together_options) { return dsw_scene_move_rigid(g_scene, one(), 1, &kStays, s, NULL); }
RUN(dsw_body_move_rigid, dsw_move_options) { return dsw_body_move_rigid(g_scene, body(), &kStays, s, NULL); }

static double *bent(void) {
  memcpy(g_next, g_grid.points, sizeof g_next);
  g_next[3 * grid_point(&g_grid, 1, 1, 1)] += 0.125;
  return g_next;
}
RUN(dsw_environment_deform, dsw_deform_options) { return dsw_environment_deform(g_env, bent(), POINTS, s, NULL); }
RUN(dsw_scene_deform, dsw_scene_deform_options) {
  return dsw_scene_deform(g_scene, bent(), POINTS, one(), 1, g_target, 2, 0, s, NULL, NULL);
}
RUN(dsw_scene_deform_rigid, dsw_scene_deform_options) {
  return dsw_scene_deform_rigid(g_scene, bent(), POINTS, one(), 1, &kStays, s, NULL, NULL);
}
RUN(dsw_environment_remesh, dsw_remesh_desc) { return dsw_environment_remesh(g_env, s, NULL); }
RUN(dsw_environment_add_volumes, dsw_volumes_desc) {
  dsw_volume_id volume;
  return dsw_environment_add_volumes(g_env, s, &volume, NULL);
}
RUN(dsw_environment_cut, dsw_cut_desc) { return dsw_environment_cut(g_env, s, NULL); }
RUN(dsw_scene_cut_bodies, dsw_cut_desc) { return dsw_scene_cut_bodies(g_scene, s, one(), 1, NULL); }
RUN(dsw_environment_carve, dsw_carve_desc) { return dsw_environment_carve(g_env, s, NULL); }
RUN(dsw_environment_tie, dsw_tie_desc) { return dsw_environment_tie(g_env, s, NULL); }
RUN(dsw_environment_open_crack, dsw_open_crack_desc) { return dsw_environment_open_crack(g_env, s, NULL); }
RUN(dsw_environment_detach, dsw_detach_desc) {
  const dsw_volume_id cube = volume_at(CUBE);
  dsw_body_id id;
  CHECK_OK(dsw_environment_mark_volumes(g_env, &cube, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  return dsw_environment_detach(g_env, s, &id, NULL);
}
RUN(dsw_scene_start_recording, dsw_recording_desc) { return dsw_scene_start_recording(g_scene, s); }
static tape g_tape;

/* Makes the replay of a recording in which a particle is created. */
static dsw_replay *replay(void) {
  const dsw_recording_desc desc = to_tape(&g_tape);
  dsw_replay *r = NULL;
  CHECK_OK(dsw_scene_start_recording(g_scene, &desc));
  particle();
  CHECK_OK(dsw_scene_stop_recording(g_scene));
  CHECK_OK(dsw_replay_create(NULL, g_tape.bytes, g_tape.size, &r));
  return r;
}
RUN(dsw_replay_get_info, dsw_replay_info) {
  dsw_replay *const r = replay();
  const dsw_status status = dsw_replay_get_info(r, s);
  CHECK_OK(dsw_replay_destroy(r));
  return status;
}
RUN(dsw_replay_step_validated, dsw_validation) {
  dsw_replay *const r = replay();
  dsw_replay_report report;
  const dsw_status status = dsw_replay_step_validated(r, &report, s);
  CHECK_OK(dsw_replay_destroy(r));
  return status;
}
RUN(dsw_scene_write_bug_report, dsw_bug_report_desc) { return dsw_scene_write_bug_report(g_scene, s, NULL); }
RUN(dsw_scene_write_bug_report, dsw_validation) {
  dsw_bug_report_desc desc;
  dsw_bug_report_desc_init(&desc, sizeof desc);
  desc.write = to_tape(&g_tape).write;
  desc.user = &g_tape;
  return dsw_scene_write_bug_report(g_scene, &desc, s);
}

/* ---- what is described: the members without a default ------------------------------------------------------------ */
static const double g_square[12] = {1.25, -1, -1, 1.25, 5, -1, 1.25, -1, 5, 1.25, 5, 5};
static const double g_loop[12] = {1.25, 0.5, 0.5, 1.25, 3.5, 0.5, 1.25, 3.5, 3.5, 1.25, 0.5, 3.5};
static const double g_box[24] = {1, 1, 1, 3, 1, 1, 1, 3, 1, 3, 3, 1, 1, 1, 3, 3, 1, 3, 1, 3, 3, 3, 3, 3};
static const uint32_t g_box_triangles[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                             2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
static const double g_more_points[24] = {8, 0, 0, 9, 0, 0, 9, 1, 0, 8, 1, 0, 8, 0, 1, 9, 0, 1, 9, 1, 1, 8, 1, 1};
static const int64_t g_more_cells[8] = {0, 1, 2, 3, 4, 5, 6, 7};
static const dsw_cut_face g_inner_face = {{CUBE, 1, FACE_X1}, {CUBE + 1, 1, FACE_X0}};

static int write_nowhere(void *user, const void *bytes, size_t size_bytes) {
  (void)user, (void)bytes, (void)size_bytes;
  return 0;
}

#define FILL(type) static void fill_##type(type *s)
FILL(dsw_context_desc) { s->thread_count = 1; }
FILL(dsw_environment_desc) { *s = grid_desc(&g_grid); }
FILL(dsw_coarsen_options) { s->max_faces = 16; }
FILL(dsw_scene_desc) { s->features = DSW_FEATURE_STATISTICS; }
FILL(dsw_cast_options) { s->max_volumes = 9; }
FILL(dsw_sweep_options) { s->max_volumes = 99; }
FILL(dsw_body_desc) {
  s->positions = g_line;
  s->vertex_count = 2;
}
FILL(dsw_move_options) { s->max_volumes = 99; }
FILL(dsw_near_options) { s->margin = 0.75; }
FILL(dsw_together_options) { s->max_work = 5; }
FILL(dsw_scene_deform_options) { s->max_work = 5; }
FILL(dsw_deform_options) { s->most_halvings = 3; }
FILL(dsw_remesh_desc) { s->radius = 1; }
FILL(dsw_volumes_desc) {
  s->points = g_more_points;
  s->point_count = 8;
  s->volume_count = 1;
  s->connectivity = g_more_cells;
  s->connectivity_count = 8;
}
FILL(dsw_cut_desc) {
  s->points = g_square;
  s->rows = s->columns = 2;
}
FILL(dsw_carve_desc) {
  s->points = g_box;
  s->point_count = 8;
  s->triangles = g_box_triangles;
  s->triangle_count = 12;
}
FILL(dsw_tie_desc) {
  s->points = g_loop;
  s->point_count = 4;
}
FILL(dsw_open_crack_desc) {
  s->faces = &g_inner_face;
  s->face_count = 1;
  s->width = 0.125;
}
FILL(dsw_detach_desc) { s->volume = volume_at(CUBE); }
FILL(dsw_recording_desc) { s->write = write_nowhere; }
FILL(dsw_bug_report_desc) { s->write = write_nowhere; }

/* Where arrays lie is not the same in two runs. */
static dsw_status without_arrays(dsw_status status, dsw_change *s) {
  if (status != DSW_STATUS_OK) return status;
  s->volumes = NULL;
  s->vertices = s->body_vertices = NULL;
  s->faces = NULL;
  s->whole = s->carved = s->unrepaired = s->detached = NULL;
  s->body_faces = NULL;
  return status;
}

/* What a change tells: described as above, with all other arguments as for its description. */
#define CHANGE(function, type)                           \
  RUN(function, dsw_change) {                            \
    type desc;                                           \
    type##_init(&desc, sizeof desc);                     \
    fill_##type(&desc);                                  \
    return without_arrays(function(g_env, &desc, s), s); \
  }
CHANGE(dsw_environment_cut, dsw_cut_desc)
CHANGE(dsw_environment_carve, dsw_carve_desc)
CHANGE(dsw_environment_tie, dsw_tie_desc)
CHANGE(dsw_environment_open_crack, dsw_open_crack_desc)
CHANGE(dsw_environment_remesh, dsw_remesh_desc)
RUN(dsw_environment_detach, dsw_change) {
  const dsw_volume_id cube = volume_at(CUBE);
  dsw_detach_desc desc;
  dsw_body_id id;
  CHECK_OK(dsw_environment_mark_volumes(g_env, &cube, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  dsw_detach_desc_init(&desc, sizeof desc);
  desc.volume = cube;
  return without_arrays(dsw_environment_detach(g_env, &desc, &id, s), s);
}
RUN(dsw_environment_tear_faces, dsw_change) {
  const double load = 2;
  return without_arrays(dsw_environment_tear_faces(g_env, &g_inner_face.front, &load, 1, 1, s), s);
}
RUN(dsw_environment_get_change, dsw_change) { return without_arrays(dsw_environment_get_change(g_env, s), s); }

/* ---- the tables -------------------------------------------------------------------------------------------------- */
typedef union any { /* aligned for each of them */
  uint32_t struct_size;
  void *pointer;
  double number;
  unsigned char bytes[LARGEST + GUARD];
} any;

typedef struct row {
  const char *function;
  size_t first, now;
  void (*prepare)(any *); /* of an input: all members; null: an output */
  dsw_status (*run)(any *);
} row;

typedef struct init_row {
  const char *function;
  size_t now;
  void (*run)(any *, size_t);
} init_row;

#define FIRST(type) (offsetof(type, LAST(type)) + sizeof(((type *)0)->LAST(type)))
#define LAST(type) LAST_##type
#define EACH_INPUT(X)                                 \
  X(dsw_body_create, dsw_body_desc)                   \
  X(dsw_body_find_near_rows, dsw_near_options)        \
  X(dsw_body_move, dsw_move_options)                  \
  X(dsw_body_move_rigid, dsw_move_options)            \
  X(dsw_context_create, dsw_context_desc)             \
  X(dsw_environment_add_volumes, dsw_volumes_desc)    \
  X(dsw_environment_carve, dsw_carve_desc)            \
  X(dsw_environment_cast, dsw_cast_options)           \
  X(dsw_environment_cast_path, dsw_cast_options)      \
  X(dsw_environment_cast_segments, dsw_cast_options)  \
  X(dsw_environment_coarsen, dsw_coarsen_options)     \
  X(dsw_environment_create, dsw_environment_desc)     \
  X(dsw_environment_cut, dsw_cut_desc)                \
  X(dsw_environment_open_crack, dsw_open_crack_desc)  \
  X(dsw_environment_remesh, dsw_remesh_desc)          \
  X(dsw_environment_sweep_edges, dsw_sweep_options)   \
  X(dsw_environment_tie, dsw_tie_desc)                \
  X(dsw_particle_move, dsw_cast_options)              \
  X(dsw_scene_cast, dsw_cast_options)                 \
  X(dsw_scene_cast_from_particles, dsw_cast_options)  \
  X(dsw_scene_create, dsw_scene_desc)                 \
  X(dsw_scene_cut_bodies, dsw_cut_desc)               \
  X(dsw_environment_deform, dsw_deform_options)       \
  X(dsw_environment_detach, dsw_detach_desc)          \
  X(dsw_scene_deform, dsw_scene_deform_options)       \
  X(dsw_scene_deform_rigid, dsw_scene_deform_options) \
  X(dsw_scene_move_bodies, dsw_move_options)          \
  X(dsw_scene_move_together, dsw_together_options)    \
  X(dsw_scene_move_rigid, dsw_together_options)       \
  X(dsw_scene_step_fraction, dsw_together_options)    \
  X(dsw_scene_move_particles, dsw_cast_options)       \
  X(dsw_scene_start_recording, dsw_recording_desc)    \
  X(dsw_scene_write_bug_report, dsw_bug_report_desc)  \
  X(dsw_trace_add_walk, dsw_cast_options)
#define EACH_OUTPUT(X)                              \
  X(dsw_body_get_counts, dsw_body_counts)           \
  X(dsw_environment_carve, dsw_change)              \
  X(dsw_environment_check, dsw_build_report)        \
  X(dsw_environment_coarsen, dsw_coarsen_report)    \
  X(dsw_environment_create, dsw_build_report)       \
  X(dsw_environment_cut, dsw_change)                \
  X(dsw_environment_detach, dsw_change)             \
  X(dsw_environment_get_change, dsw_change)         \
  X(dsw_environment_open_crack, dsw_change)         \
  X(dsw_environment_remesh, dsw_change)             \
  X(dsw_environment_tear_faces, dsw_change)         \
  X(dsw_environment_tie, dsw_change)                \
  X(dsw_environment_get_info, dsw_environment_info) \
  X(dsw_replay_get_info, dsw_replay_info)           \
  X(dsw_replay_step_validated, dsw_validation)      \
  X(dsw_scene_get_statistics, dsw_statistics)       \
  X(dsw_scene_write_bug_report, dsw_validation)     \
  X(dsw_trace_get_data, dsw_trace_data)
#define EACH_INIT(X)                                         \
  X(dsw_body_desc_init, dsw_body_desc)                       \
  X(dsw_bug_report_desc_init, dsw_bug_report_desc)           \
  X(dsw_carve_desc_init, dsw_carve_desc)                     \
  X(dsw_cast_options_init, dsw_cast_options)                 \
  X(dsw_coarsen_options_init, dsw_coarsen_options)           \
  X(dsw_context_desc_init, dsw_context_desc)                 \
  X(dsw_cut_desc_init, dsw_cut_desc)                         \
  X(dsw_deform_options_init, dsw_deform_options)             \
  X(dsw_detach_desc_init, dsw_detach_desc)                   \
  X(dsw_environment_desc_init, dsw_environment_desc)         \
  X(dsw_move_options_init, dsw_move_options)                 \
  X(dsw_near_options_init, dsw_near_options)                 \
  X(dsw_together_options_init, dsw_together_options)         \
  X(dsw_scene_deform_options_init, dsw_scene_deform_options) \
  X(dsw_open_crack_desc_init, dsw_open_crack_desc)           \
  X(dsw_recording_desc_init, dsw_recording_desc)             \
  X(dsw_remesh_desc_init, dsw_remesh_desc)                   \
  X(dsw_scene_desc_init, dsw_scene_desc)                     \
  X(dsw_sweep_options_init, dsw_sweep_options)               \
  X(dsw_tie_desc_init, dsw_tie_desc)                         \
  X(dsw_volumes_desc_init, dsw_volumes_desc)

/* All with one signature, so that a table can hold them. */
#define WRAP_INPUT(function, type)                  \
  static void prepare_##function##_##type(any *s) { \
    type##_init((type *)s, sizeof(type));           \
    fill_##type((type *)s);                         \
  }                                                 \
  static dsw_status call_##function##_##type(any *s) { return run_##function##_##type((type *)s); }
#define WRAP_OUTPUT(function, type) \
  static dsw_status call_##function##_##type(any *s) { return run_##function##_##type((type *)s); }
#define WRAP_INIT(function, type) \
  static void call_##function(any *s, size_t size) { function((type *)s, size); }
EACH_INPUT(WRAP_INPUT)
EACH_OUTPUT(WRAP_OUTPUT)
EACH_INIT(WRAP_INIT)

#define INPUT_ROW(function, type) \
  {#function, FIRST(type), sizeof(type), prepare_##function##_##type, call_##function##_##type},
#define OUTPUT_ROW(function, type) {#function, FIRST(type), sizeof(type), NULL, call_##function##_##type},
#define INIT_ROW(function, type) {#function, sizeof(type), call_##function},
static const row g_rows[] = {EACH_INPUT(INPUT_ROW) EACH_OUTPUT(OUTPUT_ROW)};
static const init_row g_init_rows[] = {EACH_INIT(INIT_ROW)};

/* ---- what holds for all of them ---------------------------------------------------------------------------------- */
static void check(int holds, const char *function, const char *what, size_t size) {
  if (!holds) fprintf(stderr, "%s with struct_size %u: %s\n", function, (unsigned)size, dsw_last_error_message());
  check_that(holds, what, function, (int)size);
}

static dsw_status call(const row *r, any *s) {
  dsw_status status;
  begin();
  status = r->run(s);
  end();
  return status;
}

static int is_filled(const unsigned char *bytes, size_t from, size_t to, unsigned char value) {
  while (from < to && bytes[from] == value) ++from;
  return from == to;
}

static int names_size(void) { return strstr(dsw_last_error_message(), "->struct_size is ") != NULL; }

/* Everything before `size` as `r` wants it, then what must not be read. */
static void describe(const row *r, any *s, size_t size) {
  memset(s, 0, sizeof *s);
  r->prepare(s);
  s->struct_size = (uint32_t)size;
  memset(s->bytes + size, 0xa5, sizeof *s - size);
}

/* 0, 4, all from one too few to a few more than there are, and some larger ones. */
static size_t next_size(const row *r, size_t size) {
  if (size == 0) return 4;
  if (size < r->first - 1) return r->first - 1;
  return size < r->now + 16 ? size + 1 : size + 512;
}

static void test_input(const row *r) {
  static const size_t extra[] = {1, 4, 8, 64};
  any s, before;
  size_t size, i;
  for (size = 0; size <= r->now; size = next_size(r, size)) {
    const dsw_status wanted = size < r->first ? DSW_STATUS_BAD_STRUCT_SIZE : DSW_STATUS_OK;
    describe(r, &s, size < 4 ? 4 : size);
    s.struct_size = (uint32_t)size;
    before = s;
    check(call(r, &s) == wanted && (wanted == DSW_STATUS_OK || names_size()), r->function, "an older size", size);
    check(memcmp(&s, &before, sizeof s) == 0, r->function, "is left as it is", size);
  }
  for (i = 0; i <= sizeof extra / sizeof *extra; ++i) {
    size = i == sizeof extra / sizeof *extra ? LARGEST : r->now + extra[i];
    describe(r, &s, size);
    check(call(r, &s) == DSW_STATUS_OK, r->function, "a later size, 0 where unknown", size);
    s.bytes[size - 1] = 1;
    check(call(r, &s) == DSW_STATUS_UNSUPPORTED, r->function, "a later size, not 0 at its end", size);
    s.bytes[size - 1] = 0, s.bytes[r->now] = 1;
    check(call(r, &s) == DSW_STATUS_UNSUPPORTED, r->function, "a later size, not 0 at its start", size);
  }
}

static void test_output(const row *r) {
  any full, s;
  size_t size;
  memset(&full, 0x5a, sizeof full);
  full.struct_size = (uint32_t)r->now;
  check(call(r, &full) == DSW_STATUS_OK, r->function, "today's size", r->now);
  for (size = 0; size <= LARGEST; size = next_size(r, size)) {
    const size_t written = size < r->first ? 4 : size, known = written < r->now ? written : r->now;
    const dsw_status wanted = size < r->first ? DSW_STATUS_BAD_STRUCT_SIZE : DSW_STATUS_OK;
    memset(&s, 0x5a, sizeof s);
    s.struct_size = (uint32_t)size;
    check(call(r, &s) == wanted && (wanted == DSW_STATUS_OK || names_size()), r->function, "any size", size);
    check(s.struct_size == size, r->function, "the size stays", size);
    check(memcmp(s.bytes + 4, full.bytes + 4, known - 4) == 0, r->function, "what is known is the same", size);
    check(is_filled(s.bytes, known, written, 0), r->function, "what is unknown is 0", size);
    check(is_filled(s.bytes, written, sizeof s, 0x5a), r->function, "no byte beyond is written", size);
  }
}

static void test_init(const init_row *r) {
  any full, s;
  size_t size;
  memset(&full, 0x5a, sizeof full);
  r->run(&full, r->now);
  check(full.struct_size == r->now, r->function, "the size is set", r->now);
  for (size = 0; size <= r->now + GUARD; ++size) {
    const size_t known = size < r->now ? size : r->now;
    memset(&s, 0x5a, sizeof s);
    r->run(&s, size);
    check(size < 4 || s.struct_size == size, r->function, "the size is set", size);
    check(size < 4 || memcmp(s.bytes + 4, full.bytes + 4, known - 4) == 0, r->function, "defaults", size);
    check(is_filled(s.bytes, known, size, 0), r->function, "what is unknown is 0", size);
    check(is_filled(s.bytes, size, sizeof s, 0x5a), r->function, "no byte beyond is written", size);
  }
  r->run(NULL, r->now);
}

/* Sizes that no version will have are refused before anything is read. */
static void test_garbage(const row *r) {
  any s;
  memset(&s, 0, sizeof s);
  s.struct_size = LARGEST + 1;
  check(call(r, &s) == DSW_STATUS_UNSUPPORTED && names_size(), r->function, "garbage", s.struct_size);
  s.struct_size = 0xffffffffu;
  check(call(r, &s) == DSW_STATUS_UNSUPPORTED && names_size(), r->function, "garbage", s.struct_size);
  check(is_filled(s.bytes, 4, sizeof s, 0), r->function, "is left as it is", s.struct_size);
}

int main(void) {
  size_t i;
  g_grid = grid_create(SIDE, SIDE, SIDE);
  for (i = 0; i < sizeof g_rows / sizeof *g_rows; ++i) {
    if (g_rows[i].prepare != NULL) test_input(&g_rows[i]);
    if (g_rows[i].prepare == NULL) test_output(&g_rows[i]);
    test_garbage(&g_rows[i]);
  }
  for (i = 0; i < sizeof g_init_rows / sizeof *g_init_rows; ++i) test_init(&g_init_rows[i]);
  grid_destroy(&g_grid);
  return check_result();
}
