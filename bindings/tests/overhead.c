/* What calls cost in C, for languages to compare themselves with. Usage: overhead SNAPSHOT POSITIONS COUNT
 * SNAPSHOT is an environment; POSITIONS holds 2 * COUNT points (doubles): COUNT particles fly from the first half to the second and
 * back. One thread. Prints the least seconds of a batch of COUNT moves, and of one move (of the first particle). */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "dartsweep/dartsweep.h"

static void must(dsw_status status) {
  if (status == DSW_STATUS_OK) return;
  fprintf(stderr, "overhead: %s\n", dsw_last_error_message());
  exit(1);
}

static void *read_file(const char *path, size_t *size) {
  FILE *file = fopen(path, "rb");
  void *block;
  if (!file || fseek(file, 0, SEEK_END) != 0) exit(1);
  *size = (size_t)ftell(file);
  rewind(file);
  block = malloc(*size);
  if (!block || fread(block, 1, *size, file) != *size) exit(1);
  fclose(file);
  return block;
}

static double now(void) { return (double)clock() / CLOCKS_PER_SEC; } /* of this process: there is one thread */

int main(int argc, char **argv) {
  enum { ROUNDS = 100, SINGLES = 10000 };
  size_t size, bytes, count, round, i;
  double batch = 1e9, single = 1e9;
  dsw_context_desc desc;
  dsw_context *context = NULL;
  dsw_environment *environment = NULL;
  dsw_scene *scene = NULL;
  dsw_particle_id *particles;
  dsw_flight *flights;
  void *block;
  double *positions;
  if (argc != 4) return 2;
  block = read_file(argv[1], &size);
  positions = read_file(argv[2], &bytes);
  count = (size_t)atol(argv[3]);
  if (bytes != 6 * sizeof(double) * count) return 2;
  particles = malloc(count * sizeof *particles);
  flights = malloc(count * sizeof *flights);
  if (!particles || !flights) return 1;
  dsw_context_desc_init(&desc, sizeof desc);
  desc.thread_count = 1;
  must(dsw_context_create(&desc, &context));
  must(dsw_environment_load(context, block, size, &environment));
  must(dsw_scene_create(environment, NULL, &scene));
  must(dsw_scene_create_particles(scene, positions, count, 0, NULL, particles, NULL));
  for (round = 0; round < ROUNDS; ++round) {
    const double start = now();
    must(dsw_scene_move_particles(scene, particles, count, positions + (round % 2 ? 0 : 3 * count), 0, NULL, flights));
    if (now() - start < batch) batch = now() - start;
  }
  for (round = 0; round < 10; ++round) {
    const double start = now();
    for (i = 0; i < SINGLES; ++i)
      must(dsw_particle_move(scene, particles[0], positions + (i % 2 ? 0 : 3 * count), NULL, flights));
    if ((now() - start) / SINGLES < single) single = (now() - start) / SINGLES;
  }
  printf("%.9f %.9f\n", batch, single);
  must(dsw_scene_destroy(scene));
  must(dsw_environment_destroy(environment));
  must(dsw_context_destroy(context));
  free(positions);
  free(block);
  free(particles);
  free(flights);
  return 0;
}
