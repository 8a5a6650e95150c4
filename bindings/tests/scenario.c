/* The scenario that every language plays: a vessel, particles, a catheter, a cut, walls that move, snapshots, errors. README.md tells
 * it stage by stage. Usage: scenario FILE compares with FILE; scenario --write FILE writes it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenario.h"

enum { NX = 6, NY = 6, NZ = 12, POINTS = (NX + 1) * (NY + 1) * (NZ + 1), CELLS = NX * NY * NZ, PARTICLES = 50 };

/* --- the result: a list of 64-bit patterns for each stage */
static char text[1 << 20];
static size_t used = 0;
static int first_stage = 1, first_value = 1;

static void say(const char *what) {
  const size_t size = strlen(what);
  if (used + size >= sizeof text) abort();
  memcpy(text + used, what, size + 1);
  used += size;
}

void stage(const char *name) {
  say(first_stage ? "{\n  \"" : "\"],\n  \"");
  say(name);
  say("\": [\"");
  first_stage = 0;
  first_value = 1;
}

void integer(uint64_t value) {
  char digits[24];
  sprintf(digits, "%s%016llx", first_value ? "" : "\", \"", (unsigned long long)value);
  say(digits);
  first_value = 0;
}

void number(double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  integer(bits);
}

static void point(const double *xyz) {
  int i;
  for (i = 0; i < 3; ++i) number(xyz[i]);
}

void must(dsw_status status) {
  if (status == DSW_STATUS_OK) return;
  fprintf(stderr, "scenario: %s\n", dsw_last_error_message());
  exit(1);
}

void say_flight(const dsw_flight *flight) {
  integer(flight->outcome);
  number(flight->time);
  point(flight->position);
  point(flight->contact.normal);
  integer(flight->contact.wall.volume);
  integer(flight->contact.wall.local);
  integer(flight->volumes_visited);
}

void say_sweep(const dsw_sweep *sweep) {
  integer(sweep->outcome);
  number(sweep->time);
  point(sweep->point);
  number(sweep->edge_parameter);
}

void say_contacts(const char *name, const dsw_body_contact *contacts, size_t count) {
  size_t i;
  stage(name);
  integer(count);
  for (i = 0; i < count; ++i) {
    integer(contacts[i].vertex.index);
    integer(contacts[i].contact.kind);
    number(contacts[i].time);
    point(contacts[i].point);
    point(contacts[i].contact.normal);
    integer(contacts[i].contact.wall.volume);
  }
}

void say_nearest(const dsw_nearest *nearest) {
  number(nearest->distance);
  integer(nearest->cell.kind);
  integer(nearest->cell.index);
}

void say_deformation(const dsw_deform_report *report) {
  integer(report->outcome);
  integer(report->held_count);
  integer(report->contact_count);
  integer(report->pushed_count);
}

void cut(dsw_environment *environment, const dsw_cut_desc *desc) {
  dsw_change change;
  dsw_environment_info info;
  size_t i;
  change.struct_size = sizeof change;
  must(dsw_environment_cut(environment, desc, &change));
  number(change.distance);
  integer(change.volumes_split);
  integer(change.face_count);
  info.struct_size = sizeof info;
  must(dsw_environment_get_info(environment, &info));
  integer(info.volume_count);
  for (i = 0; i < change.vertex_count; ++i)
    integer(change.vertices[i].vertex.index), number(change.vertices[i].weights[0]);
}

/* --- what it is played with: integers, so that all languages have the same bits */
static double points[3 * POINTS];
static int64_t cells[8 * CELLS];
static int32_t regions[CELLS];

static int at(int i, int j, int k) { return (k * (NY + 1) + j) * (NX + 1) + i; }

static void make_vessel(void) {
  static const int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  int i, j, k, c, cell = 0;
  for (k = 0; k <= NZ; ++k)
    for (j = 0; j <= NY; ++j)
      for (i = 0; i <= NX; ++i) {
        double *p = points + 3 * at(i, j, k);
        p[0] = 8 * i + j * k % 3;
        p[1] = 8 * j + i * k % 3;
        p[2] = 8 * k + i * j % 3;
      }
  for (k = 0; k < NZ; ++k)
    for (j = 0; j < NY; ++j)
      for (i = 0; i < NX; ++i, ++cell) {
        for (c = 0; c < 8; ++c) cells[8 * cell + c] = at(i + corner[c][0], j + corner[c][1], k + corner[c][2]);
        regions[cell] = i > 0 && i < NX - 1 && j > 0 && j < NY - 1 ? 1 : 2;
      }
}

unsigned seed;

double draw(void) { /* 0 .. 64 in steps of 1/1024 */
  seed = (seed * 4093 + 1021) % 65536;
  return seed / 1024.0;
}

static void draw_points(double *out, int count) {
  int i;
  for (i = 0; i < 3 * count; ++i) out[i] = i % 3 == 2 ? 1.5 * draw() : 4 + 0.625 * draw();
}

static dsw_environment *create(void) {
  dsw_environment_desc desc;
  dsw_environment *environment = NULL;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points;
  desc.point_count = POINTS;
  desc.connectivity = cells;
  desc.connectivity_count = 8 * CELLS;
  desc.volume_count = CELLS;
  desc.regions = regions;
  must(dsw_environment_create(NULL, &desc, &environment, NULL));
  return environment;
}

static dsw_body_id create_catheter(dsw_scene *scene, double *positions) {
  uint32_t edges[2 * (LINKS - 1)];
  dsw_body_desc desc;
  dsw_body_id body;
  unsigned i;
  for (i = 0; i < LINKS; ++i) {
    positions[3 * i] = 24.5;
    positions[3 * i + 1] = 25.25;
    positions[3 * i + 2] = 8.125 + 2.0 * i;
  }
  for (i = 0; i + 1 < LINKS; ++i) edges[2 * i] = i, edges[2 * i + 1] = i + 1;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = positions;
  desc.vertex_count = LINKS;
  desc.edges = edges;
  desc.edge_count = LINKS - 1;
  must(dsw_body_create(scene, &desc, &body));
  return body;
}

/* --- stages, in the order of README.md */
static void queries(const dsw_environment *environment) {
  static double from[3 * 64], to[3 * 64], fixed[3 * 16];
  static dsw_volume_id volumes[64];
  static dsw_location locations[64];
  static dsw_flight flights[64];
  static dsw_sweep sweeps[16];
  int i;

  stage("locate");
  seed = 1;
  draw_points(from, 64);
  must(dsw_environment_locate_points(environment, from, 64, 0, NULL, volumes, locations));
  for (i = 0; i < 64; ++i) integer(locations[i]), integer(volumes[i].index), integer(volumes[i].generation);

  stage("cast");
  draw_points(to, 64);
  must(dsw_environment_cast_segments(environment, 64, NULL, from, to, 0, NULL, flights));
  for (i = 0; i < 64; ++i) say_flight(&flights[i]);

  stage("sweep");
  draw_points(fixed, 16);
  must(dsw_environment_sweep_edges(environment, 16, NULL, from, to, fixed, 0, NULL, sweeps));
  for (i = 0; i < 16; ++i) say_sweep(&sweeps[i]);

  stage("nearest");
  for (i = 0; i < 64; ++i) {
    dsw_nearest nearest;
    if (locations[i] != DSW_LOCATION_PASSABLE) continue;
    must(dsw_environment_find_nearest(environment, from + 3 * i, volumes[i], 20.0, &nearest));
    say_nearest(&nearest);
  }
}

static void move_particles(dsw_scene *scene, const dsw_particle_id *particles) {
  static double targets[3 * PARTICLES];
  static dsw_flight flights[PARTICLES];
  int i;
  draw_points(targets, PARTICLES);
  must(dsw_scene_move_particles(scene, particles, PARTICLES, targets, 0, NULL, flights));
  for (i = 0; i < PARTICLES; ++i) integer(flights[i].outcome), number(flights[i].time), point(flights[i].position);
}

static void push_catheter(dsw_scene *scene, dsw_body_id body, double *positions) {
  dsw_move_options options;
  dsw_move_report report;
  const dsw_body_contact *contacts = NULL;
  size_t i, count = 0, step;

  stage("catheter");
  dsw_move_options_init(&options, sizeof options);
  options.vertex_response = DSW_RESPONSE_SLIDE;
  options.edge_response = DSW_RESPONSE_SLIDE;
  for (step = 0; step < 10; ++step) {
    for (i = 0; i < LINKS; ++i)
      positions[3 * i] += 1.75, positions[3 * i + 1] -= 0.5 * (double)(i % 3), positions[3 * i + 2] += 3.0;
    must(dsw_body_move(scene, body, positions, LINKS, 0, &options, &report));
    integer(report.vertices_stopped);
    integer(report.contact_count);
    must(dsw_body_get_positions(scene, body, positions, LINKS, 0, NULL, &count));
    for (i = 0; i < LINKS; ++i) point(positions + 3 * i);
  }

  must(dsw_body_get_contacts(scene, body, &contacts, &count));
  say_contacts("contacts", contacts, count);
}

size_t save(const dsw_environment *environment, const dsw_scene *scene, unsigned char **block) {
  size_t size = 0, i;
  uint64_t sum = 0;
  must(scene ? dsw_scene_save(scene, NULL, 0, &size) : dsw_environment_save(environment, NULL, 0, &size));
  *block = malloc(size);
  if (!*block) abort();
  must(scene ? dsw_scene_save(scene, *block, size, &size) : dsw_environment_save(environment, *block, size, &size));
  for (i = 0; i < size; ++i) sum += (*block)[i];
  integer(size);
  integer(sum);
  return size;
}

static void snapshots(const dsw_environment *environment, const dsw_scene *scene, const dsw_particle_id *particles) {
  unsigned char *blocks[2];
  size_t sizes[2];
  dsw_environment *other = NULL;
  dsw_scene *other_scene = NULL;

  stage("snapshot");
  sizes[0] = save(environment, NULL, &blocks[0]);
  sizes[1] = save(environment, scene, &blocks[1]);
  must(dsw_environment_load(NULL, blocks[0], sizes[0], &other));
  must(dsw_scene_load(other, blocks[1], sizes[1], &other_scene));
  move_particles(other_scene, particles);

  stage("damaged");
  integer(dsw_environment_load(NULL, blocks[0], sizes[0] / 2, &other));
  blocks[0][sizes[0] / 2] ^= 1;
  integer(dsw_environment_load(NULL, blocks[0], sizes[0], &other));
  must(dsw_scene_destroy(other_scene));
  must(dsw_environment_destroy(other));
  free(blocks[0]);
  free(blocks[1]);
}

static void errors(dsw_environment *environment, dsw_scene *scene, const dsw_particle_id *particles) {
  const double inside[3] = {24, 24, 48}, outside[3] = {-9, 0, 0}, in_wall[3] = {4, 4, 4}, no_point[3] = {0, NAN, 0};
  const dsw_volume_id anywhere = {0, 0}, stale = {3, 7};
  const int64_t twice[4] = {0, 1, 7, 7};
  dsw_particle_id particle, same[2];
  dsw_volume_id volume;
  dsw_flight flight;
  dsw_environment_desc desc;
  dsw_environment *other = NULL;
  double both[6] = {24, 24, 48, 24, 24, 48};

  stage("errors");
  integer(dsw_environment_cast(environment, anywhere, no_point, inside, NULL, &flight));
  integer(dsw_environment_cast(environment, stale, inside, outside, NULL, &flight));
  integer(dsw_environment_get_volume_id(environment, CELLS, &volume));
  integer(dsw_particle_create(scene, outside, anywhere, &particle));
  integer(dsw_particle_create(scene, in_wall, anywhere, &particle));
  same[0] = same[1] = particles[0];
  integer(dsw_scene_move_particles(scene, same, 2, both, 0, NULL, NULL));
  must(dsw_particle_create(scene, inside, anywhere, &particle));
  must(dsw_particle_get_position(scene, particle, NULL, &volume));
  integer(dsw_environment_mark_volumes(environment, &volume, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  must(dsw_particle_destroy(scene, particle));
  integer(dsw_particle_destroy(scene, particle));
  integer(dsw_scene_reset_statistics(scene));
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points;
  desc.point_count = POINTS;
  desc.connectivity = twice;
  desc.connectivity_count = 4;
  desc.volume_count = 1;
  desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  integer(dsw_environment_create(NULL, &desc, &other, NULL));
}

static void cut_vessel(dsw_environment *environment) {
  const double blade[12] = {-5, 3, 20.5, 60, 3, 20.5, -5, 3, 60.25, 60, 3, 60.25};
  dsw_cut_desc desc;
  stage("cut");
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = blade;
  desc.rows = 2;
  desc.columns = 2;
  cut(environment, &desc);
}

static void deform(void) {
  static double next[3 * POINTS], positions[3 * LINKS];
  dsw_environment *environment = create();
  dsw_scene_desc desc;
  dsw_scene *scene = NULL;
  dsw_body_id body;
  dsw_deform_report report;
  size_t i, marked, count;

  stage("deform");
  must(dsw_environment_mark_region(environment, 2, DSW_MARK_IMPASSABLE, 0, &marked, NULL));
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  must(dsw_scene_create(environment, &desc, &scene));
  body = create_catheter(scene, positions);
  for (i = 0; i < POINTS; ++i) { /* the wall x = 8 and what is left of it move to x = 26 and more */
    memcpy(next + 3 * i, points + 3 * i, 3 * sizeof *next);
    next[3 * i] += (48 - points[3 * i]) * 0.4375;
  }
  must(dsw_environment_deform(environment, next, POINTS, NULL, &report));
  say_deformation(&report);
  must(dsw_body_get_positions(scene, body, positions, LINKS, 0, NULL, &count));
  for (i = 0; i < LINKS; ++i) point(positions + 3 * i);
  must(dsw_scene_destroy(scene));
  must(dsw_environment_destroy(environment));
}

static void play(void) {
  dsw_environment *environment;
  dsw_environment_info info;
  dsw_scene *scene = NULL;
  dsw_body_id body;
  static double centres[3 * PARTICLES], positions[3 * LINKS];
  static dsw_particle_id particles[PARTICLES];
  size_t marked = 0, i, cell = 0;

  make_vessel();
  environment = create();
  stage("vessel");
  info.struct_size = sizeof info;
  must(dsw_environment_get_info(environment, &info));
  must(dsw_environment_mark_region(environment, 2, DSW_MARK_IMPASSABLE, 0, &marked, NULL));
  integer(info.vertex_count);
  integer(info.volume_count);
  integer(info.face_count);
  integer(info.boundary_face_count);
  integer(marked);
  queries(environment);

  must(dsw_scene_create(environment, NULL, &scene));
  for (i = 0; i < PARTICLES; ++i, ++cell) { /* at the centres of the first cells of the lumen */
    dsw_volume_id volume;
    while (regions[cell] != 1) ++cell;
    must(dsw_environment_get_volume_id(environment, (uint32_t)cell, &volume));
    must(dsw_environment_get_centre(environment, volume, centres + 3 * i));
  }
  must(dsw_scene_create_particles(scene, centres, PARTICLES, 0, NULL, particles, NULL));
  stage("particles");
  for (i = 0; i < 4; ++i) move_particles(scene, particles);

  body = create_catheter(scene, positions);
  push_catheter(scene, body, positions);
  snapshots(environment, scene, particles);
  errors(environment, scene, particles);
  cut_vessel(environment);
  must(dsw_scene_destroy(scene));
  must(dsw_environment_destroy(environment));
  deform();
  plane();
  say("\"]\n}\n");
}

int main(int argc, char **argv) {
  const int writes = argc == 3 && strcmp(argv[1], "--write") == 0;
  static char expected[sizeof text];
  FILE *file;
  size_t size;
  if (argc != 2 && !writes) {
    fprintf(stderr, "usage: scenario FILE | scenario --write FILE\n");
    return 2;
  }
  play();
  file = fopen(argv[argc - 1], writes ? "wb" : "rb");
  if (!file) {
    fprintf(stderr, "scenario: cannot open %s\n", argv[argc - 1]);
    return 1;
  }
  size = writes ? fwrite(text, 1, used, file) : fread(expected, 1, sizeof expected, file);
  fclose(file);
  if (writes) return size != used;
  if (size != used || memcmp(expected, text, size) != 0) {
    fprintf(stderr, "scenario: results differ from %s; --write shows them\n", argv[1]);
    return 1;
  }
  return 0;
}
