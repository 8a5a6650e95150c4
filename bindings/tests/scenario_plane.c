/* The part of the scenario that is played in the plane; scenario.c has the rest. */
#include <stdlib.h>

#include "scenario.h"

/* Squares whose corners have moved, half of them cut into two triangles; the outer ring is the wall */
enum { SIDE = 10, CORNERS = (SIDE + 1) * (SIDE + 1), SHARDS = SIDE * SIDE * 3 / 2, ROOM = 64 };
static double corners[2 * CORNERS];
static int64_t sides[SIDE * SIDE * 5], ends[SHARDS + 1];
static uint8_t types[SHARDS];
static int32_t wards[SHARDS];

static void add_shard(size_t *count, int ward, uint8_t type, int64_t a, int64_t b, int64_t c, int64_t d) {
  int64_t *const at = sides + ends[*count];
  at[0] = a, at[1] = b, at[2] = c;
  if (type == DSW_CELL_TYPE_QUAD) at[3] = d;
  types[*count] = type;
  wards[*count] = ward;
  ends[*count + 1] = ends[*count] + (type == DSW_CELL_TYPE_QUAD ? 4 : 3);
  ++*count;
}

static dsw_environment *create_plane(void) {
  dsw_environment_desc desc;
  dsw_environment *environment = NULL;
  size_t count = 0;
  int i, j;
  for (j = 0; j <= SIDE; ++j)
    for (i = 0; i <= SIDE; ++i) {
      corners[2 * (j * (SIDE + 1) + i)] = 8 * i + i * j % 3;
      corners[2 * (j * (SIDE + 1) + i) + 1] = 8 * j + (i + 2 * j) % 3;
    }
  for (j = 0; j < SIDE; ++j)
    for (i = 0; i < SIDE; ++i) {
      const int64_t a = j * (SIDE + 1) + i, d = a + SIDE + 1;
      const int ward = i > 0 && i < SIDE - 1 && j > 0 && j < SIDE - 1 ? 1 : 2;
      if ((i + j) % 2 == 0) add_shard(&count, ward, DSW_CELL_TYPE_QUAD, a, a + 1, d + 1, d);
      if ((i + j) % 2 != 0) add_shard(&count, ward, DSW_CELL_TYPE_TRIANGLE, a, a + 1, d + 1, 0);
      if ((i + j) % 2 != 0) add_shard(&count, ward, DSW_CELL_TYPE_TRIANGLE, a, d + 1, d, 0);
    }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.dimension = 2;
  desc.points = corners;
  desc.point_count = CORNERS;
  desc.cell_types = types;
  desc.volume_count = SHARDS;
  desc.offsets = ends;
  desc.connectivity = sides;
  desc.connectivity_count = (size_t)ends[SHARDS];
  desc.regions = wards;
  must(dsw_environment_create(NULL, &desc, &environment, NULL));
  return environment;
}

static void draw_plane(double *out, int count) {
  int i;
  for (i = 0; i < 2 * count; ++i) out[i] = 11 + 0.90625 * draw();
}

static dsw_body_id pull_rope(dsw_scene *scene) {
  double positions[2 * LINKS];
  uint32_t edges[2 * (LINKS - 1)];
  dsw_body_desc desc;
  dsw_body_id body;
  dsw_move_options options;
  dsw_move_report report;
  const dsw_body_contact *contacts = NULL;
  size_t i, count = 0, step;
  for (i = 0; i < LINKS; ++i) positions[2 * i] = 20.25 + 3.0 * (double)i, positions[2 * i + 1] = 40.5;
  for (i = 0; i + 1 < LINKS; ++i) edges[2 * i] = (uint32_t)i, edges[2 * i + 1] = (uint32_t)i + 1;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = positions;
  desc.vertex_count = LINKS;
  desc.edges = edges;
  desc.edge_count = LINKS - 1;
  must(dsw_body_create(scene, &desc, &body));
  dsw_move_options_init(&options, sizeof options);
  options.vertex_response = DSW_RESPONSE_SLIDE;
  options.edge_response = DSW_RESPONSE_SLIDE;
  stage("rope");
  for (step = 0; step < 10; ++step) {
    for (i = 0; i < LINKS; ++i) positions[2 * i] += 1.5, positions[2 * i + 1] += 4.0 - 0.75 * (double)(i % 3);
    must(dsw_body_move(scene, body, positions, LINKS, 0, &options, &report));
    integer(report.vertices_stopped);
    integer(report.contact_count);
    must(dsw_body_get_positions(scene, body, positions, LINKS, 0, NULL, &count));
    for (i = 0; i < 2 * LINKS; ++i) number(positions[i]);
  }
  must(dsw_body_get_contacts(scene, body, &contacts, &count));
  say_contacts("rope contacts", contacts, count);
  return body;
}

static void bend_and_cut(dsw_environment *environment, dsw_scene *scene, dsw_body_id rope) {
  static double next[2 * (CORNERS + ROOM)];
  const double blade[4] = {20, 20.5, 60.25, 41.25};
  double positions[2 * LINKS];
  dsw_deform_options options;
  dsw_deform_report report;
  dsw_cut_desc desc;
  size_t i, count = 0;

  stage("plane deform");
  for (i = 0; i < CORNERS; ++i) {
    next[2 * i] = corners[2 * i];
    next[2 * i + 1] = corners[2 * i + 1] + (40 - corners[2 * i + 1]) * 0.125;
  }
  dsw_deform_options_init(&options, sizeof options);
  options.point_room = CORNERS + ROOM;
  must(dsw_environment_deform(environment, next, CORNERS, &options, &report));
  say_deformation(&report);
  must(dsw_body_get_positions(scene, rope, positions, LINKS, 0, NULL, &count));
  for (i = 0; i < 2 * LINKS; ++i) number(positions[i]);

  stage("plane cut");
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = blade;
  desc.rows = 2;
  desc.columns = 1;
  cut(environment, &desc);
}

void plane(void) {
  static double from[2 * 32], to[2 * 32], fixed[2 * 16];
  static dsw_flight flights[32];
  static dsw_sweep sweeps[16];
  static dsw_particle_id particles[32];
  static dsw_volume_id volumes[32];
  static dsw_location locations[32];
  dsw_environment *const environment = create_plane();
  const dsw_vertex_id pole = {5 * (SIDE + 1) + 5, 1};
  dsw_environment_info info;
  dsw_nearest nearest;
  dsw_scene_desc desc;
  dsw_scene *scene = NULL;
  dsw_body_id rope;
  unsigned char *block = NULL;
  size_t marked = 0, i;

  stage("plane");
  info.struct_size = sizeof info;
  must(dsw_environment_get_info(environment, &info));
  must(dsw_environment_mark_region(environment, 2, DSW_MARK_IMPASSABLE, 0, &marked, NULL));
  must(dsw_environment_mark_vertices(environment, &pole, 1, DSW_MARK_IMPASSABLE));
  integer(info.dimension);
  integer(info.vertex_count);
  integer(info.volume_count);
  integer(info.face_count);
  integer(info.boundary_face_count);
  integer(marked);

  stage("plane locate");
  seed = 1;
  draw_plane(from, 32);
  must(dsw_environment_locate_points(environment, from, 32, 0, NULL, volumes, locations));
  for (i = 0; i < 32; ++i) {
    integer(locations[i]), integer(volumes[i].index), integer(volumes[i].generation);
    if (locations[i] != DSW_LOCATION_PASSABLE) continue;
    must(dsw_environment_find_nearest(environment, from + 2 * i, volumes[i], 20.0, &nearest));
    say_nearest(&nearest);
  }

  stage("plane cast");
  draw_plane(to, 32);
  for (i = 0; i < 64; i += 4) to[i] += 40; /* into the wall */
  must(dsw_environment_cast_segments(environment, 32, NULL, from, to, 0, NULL, flights));
  for (i = 0; i < 32; ++i) say_flight(&flights[i]);

  stage("plane sweep");
  draw_plane(fixed, 16);
  must(dsw_environment_sweep_edges(environment, 16, NULL, from, to, fixed, 0, NULL, sweeps));
  for (i = 0; i < 16; ++i) say_sweep(&sweeps[i]);

  stage("plane particles");
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  must(dsw_scene_create(environment, &desc, &scene));
  must(dsw_scene_create_particles(scene, from, 32, 0, NULL, particles, NULL));
  must(dsw_scene_move_particles(scene, particles, 32, to, 0, NULL, NULL));
  must(dsw_scene_get_particle_positions(scene, particles, 32, from, 0, NULL));
  for (i = 0; i < 64; ++i) number(from[i]);
  rope = pull_rope(scene);
  stage("plane snapshot");
  for (i = 0; i < 2; ++i) {
    save(environment, i == 0 ? NULL : scene, &block);
    free(block);
  }
  bend_and_cut(environment, scene, rope);
  must(dsw_scene_destroy(scene));
  must(dsw_environment_destroy(environment));
}
