/* Reading the arrays of read_mesh.py: a header of fixed size, then the arrays one after the other, little endian. */
#include "mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct file_header {
  char magic[8];
  int64_t point_count, cell_count, connectivity_count, wall_count, wall_point_count;
  int32_t lumen, has_inlet;
  double inlet[3];
} file_header;

static const char kMagic[8] = {'D', 'S', 'W', 'M', 'E', 'S', 'H', '1'};
static const int64_t kMostItems = 0x7fffffff;

void *demo_allocate(size_t count, size_t size) {
  void *memory = malloc(count == 0 ? size : count * size);
  if (memory == NULL) {
    fprintf(stderr, "demo: out of memory (%lu x %lu bytes)\n", (unsigned long)count, (unsigned long)size);
    exit(1);
  }
  return memory;
}

void mesh_free(demo_mesh *mesh) {
  free(mesh->points);
  free(mesh->types);
  free(mesh->offsets);
  free(mesh->connectivity);
  free(mesh->regions);
  free(mesh->wall_offsets);
  free(mesh->wall_points);
  memset(mesh, 0, sizeof *mesh);
}

/* Reads `count` items into new memory; null when the file ends early. */
static void *read_array(FILE *file, size_t count, size_t size) {
  void *memory = demo_allocate(count, size);
  if (fread(memory, size, count, file) != count) {
    free(memory);
    return NULL;
  }
  return memory;
}

static int in_range(int64_t value, int64_t least) { return value >= least && value <= kMostItems; }

static int read_arrays(FILE *file, demo_mesh *mesh) {
  file_header head;
  if (fread(&head, sizeof head, 1, file) != 1 || memcmp(head.magic, kMagic, sizeof kMagic) != 0 ||
      !in_range(head.point_count, 1) || !in_range(head.cell_count, 1) || !in_range(head.connectivity_count, 1) ||
      !in_range(head.wall_count, 0) || !in_range(head.wall_point_count, 0)) {
    return 0;
  }
  mesh->point_count = (size_t)head.point_count;
  mesh->cell_count = (size_t)head.cell_count;
  mesh->connectivity_count = (size_t)head.connectivity_count;
  mesh->wall_count = (size_t)head.wall_count;
  mesh->lumen = head.lumen;
  mesh->has_inlet = head.has_inlet;
  memcpy(mesh->inlet, head.inlet, sizeof head.inlet);
  return (mesh->points = (double *)read_array(file, 3 * mesh->point_count, sizeof(double))) != NULL &&
         (mesh->types = (uint8_t *)read_array(file, mesh->cell_count, 1)) != NULL &&
         (mesh->offsets = (int64_t *)read_array(file, mesh->cell_count + 1, sizeof(int64_t))) != NULL &&
         (mesh->connectivity = (int64_t *)read_array(file, mesh->connectivity_count, sizeof(int64_t))) != NULL &&
         (mesh->regions = (int32_t *)read_array(file, mesh->cell_count, sizeof(int32_t))) != NULL &&
         (mesh->wall_offsets = (size_t *)read_array(file, mesh->wall_count + 1, sizeof(size_t))) != NULL &&
         (mesh->wall_points = (uint32_t *)read_array(file, (size_t)head.wall_point_count, sizeof(uint32_t))) != NULL &&
         mesh->wall_offsets[mesh->wall_count] == (size_t)head.wall_point_count;
}

int mesh_read(const char *path, demo_mesh *mesh) {
  FILE *file = fopen(path, "rb");
  memset(mesh, 0, sizeof *mesh);
  if (file == NULL) {
    fprintf(stderr, "demo: cannot open mesh file '%s'\n", path);
    return 2;
  }
  if (!read_arrays(file, mesh)) {
    fprintf(stderr, "demo: '%s' is not a mesh array file, or it ends early; demo.sh makes one from any mesh\n", path);
    mesh_free(mesh);
    fclose(file);
    return 2;
  }
  fclose(file);
  return 0;
}
