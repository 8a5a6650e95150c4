/* A batch: thousands of particles in a block of cells with pillars, moved together. Two runs, on one thread and on
 * two, give the same bits. */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kSide = 12, kPoints = (kSide + 1) * (kSide + 1) * (kSide + 1), kCells = kSide * kSide * kSide };
enum { kParticles = 5000, kSteps = 20, kOpen = 0, kPillar = 1 };

static double points[3 * kPoints], positions[3 * kParticles], targets[3 * kParticles], reached[2][3 * kParticles];
static int32_t hexahedra[8 * kCells], regions[kCells];
static dsw_particle_id particles[kParticles];
static dsw_flight flights[kParticles];

static void check(dsw_status status, const char *what) {
  if (status != DSW_STATUS_OK) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static void fill_block(void) {
  static const int kCorner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  int n = kSide + 1;
  for (int i = 0; i < kPoints; ++i) {
    points[3 * i] = i % n;
    points[3 * i + 1] = i / n % n;
    points[3 * i + 2] = i / n / n;
  }
  for (int i = 0; i < kCells; ++i) {
    int x = i % kSide, y = i / kSide % kSide, z = i / kSide / kSide;
    regions[i] = x % 4 == 2 && y % 4 == 2 ? kPillar : kOpen;
    for (int k = 0; k < 8; ++k) {
      hexahedra[8 * i + k] = ((z + kCorner[k][2]) * n + y + kCorner[k][1]) * n + x + kCorner[k][0];
    }
  }
}

static double next_number(uint32_t *state) {
  *state = *state * 1664525u + 1013904223u;
  return (double)(*state >> 8) / 16777216.0;
}

static size_t run(uint32_t threads, double *end) {
  const dsw_volume_id no_hint = {0, 0};
  dsw_context_desc context_desc;
  dsw_environment_desc desc;
  dsw_scene_desc scene_desc;
  dsw_statistics statistics;
  dsw_context *context = NULL;
  dsw_environment *environment = NULL;
  dsw_scene *scene = NULL;
  uint32_t state = 1;

  dsw_context_desc_init(&context_desc, sizeof context_desc);
  context_desc.thread_count = threads;
  check(dsw_context_create(&context_desc, &context), "creating a context");
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = points;
  desc.point_count = kPoints;
  desc.connectivity = hexahedra;
  desc.connectivity_count = 8 * kCells;
  desc.volume_count = kCells;
  desc.regions = regions;
  desc.flags = DSW_ENVIRONMENT_LOCATE_TREE;
  check(dsw_environment_create(context, &desc, &environment, NULL), "creating the environment");
  check(dsw_environment_mark_region(environment, kPillar, DSW_MARK_IMPASSABLE, 0, NULL, NULL), "marking");

  dsw_scene_desc_init(&scene_desc, sizeof scene_desc);
  scene_desc.features = DSW_FEATURE_STATISTICS;
  check(dsw_scene_create(environment, &scene_desc, &scene), "creating the scene");
  for (int i = 0; i < kParticles;) { /* anywhere but in a pillar */
    dsw_volume_id volume;
    dsw_location location;
    for (int k = 0; k < 3; ++k) {
      positions[3 * i + k] = (double)kSide * next_number(&state);
    }
    check(dsw_environment_locate(environment, positions + 3 * i, no_hint, &volume, &location), "locating");
    i += location == DSW_LOCATION_PASSABLE;
  }
  check(dsw_scene_create_particles(scene, positions, kParticles, 0, NULL, particles, NULL), "creating particles");
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < 3 * kParticles; ++i) { /* some leave the block: its outer boundary stops them */
      targets[i] = (double)kSide * (1.1 * next_number(&state) - 0.05);
    }
    check(dsw_scene_move_particles(scene, particles, kParticles, targets, 0, NULL, flights), "moving");
  }
  for (int i = 0; i < kParticles; ++i) {
    memcpy(end + 3 * i, flights[i].position, sizeof flights[i].position);
  }
  statistics.struct_size = sizeof statistics;
  check(dsw_scene_get_statistics(scene, &statistics), "reading the statistics");
  printf("%u thread(s): %lu casts, %lu contacts, %.2f cells and %.2f orientation tests a cast\n", (unsigned)threads,
         (unsigned long)statistics.casts, (unsigned long)statistics.contacts,
         (double)statistics.volumes_visited / (double)statistics.casts,
         (double)statistics.orientation_tests / (double)statistics.casts);
  check(dsw_scene_destroy(scene), "destroying the scene");
  check(dsw_environment_destroy(environment), "destroying the environment");
  check(dsw_context_destroy(context), "destroying the context");
  return (size_t)statistics.contacts;
}

int main(void) {
  fill_block();
  size_t one = run(1, reached[0]), two = run(2, reached[1]);
  int same = one == two && one > 0 && memcmp(reached[0], reached[1], sizeof reached[0]) == 0;
  printf("the two runs are %s\n", same ? "the same, bit for bit" : "DIFFERENT");
  return !same;
}
