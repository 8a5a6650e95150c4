/* A scalpel cuts tissue that lies in air, the lips of the cut open, and a probe is pushed in. The tissue is impassable: before, the probe is
 * stopped at its surface. */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 8, ALONG = SIDE + 1, TISSUE = SIDE * SIDE * 5 }; /* the lower 5 layers of cubes */

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static int64_t at(int x, int y, int z) { return x + ALONG * (y + ALONG * (int64_t)z); }

/* SIDE x SIDE x SIDE unit cubes, those of the tissue first. */
static dsw_environment *create_block(void) {
  static double points[3 * ALONG * ALONG * ALONG];
  static int64_t cells[8 * SIDE * SIDE * SIDE];
  static dsw_volume_id tissue[TISSUE];
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  size_t n = 0;
  int x, y, z, k;
  for (z = 0; z <= SIDE; ++z) {
    for (y = 0; y <= SIDE; ++y) {
      for (x = 0; x <= SIDE; ++x) {
        double *p = points + 3 * at(x, y, z);
        p[0] = x, p[1] = y, p[2] = z;
        if (x == SIDE || y == SIDE || z == SIDE) continue;
        for (k = 0; k < 8; ++k) cells[n++] = at(x + ((k + 1) / 2) % 2, y + (k / 2) % 2, z + k / 4);
      }
    }
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points;
  desc.point_count = ALONG * ALONG * ALONG;
  desc.connectivity = cells;
  desc.connectivity_count = n;
  desc.volume_count = n / 8;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  for (k = 0; k < TISSUE; ++k) {
    check(dsw_environment_get_volume_id(environment, (uint32_t)k, &tissue[k]) == DSW_STATUS_OK, "naming the tissue");
  }
  check(dsw_environment_mark_volumes(environment, tissue, TISSUE, DSW_MARK_IMPASSABLE, 0, NULL) == DSW_STATUS_OK,
        "marking the tissue");
  return environment;
}

/* Cuts down to z = 1.5, and gives the faces of the cut that lie inside of the tissue: from there it opens into the air by itself. */
static size_t cut(dsw_environment *environment, dsw_cut_face *inside, size_t room) {
  const double blade[2][2][3] = {{{4.3, 1.2, 1.5}, {4.3, 1.2, 9}}, {{3.6, 6.8, 1.5}, {3.6, 6.8, 9}}};
  dsw_change change;
  dsw_cut_desc desc;
  size_t i, kept = 0;
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = &blade[0][0][0];
  desc.rows = desc.columns = 2;
  change.struct_size = sizeof change;
  check(dsw_environment_cut(environment, &desc, &change) == DSW_STATUS_OK, "cutting");
  for (i = 0; i < change.face_count && kept < room; ++i) {
    dsw_cell volume = {DSW_CELL_VOLUME, 0, 0, 0};
    int is_tissue = 0;
    volume.index = change.faces[i].front.volume;
    volume.generation = change.faces[i].front.generation;
    check(dsw_environment_is_marked(environment, volume, &is_tissue) == DSW_STATUS_OK, "asking for a mark");
    if (is_tissue) inside[kept++] = change.faces[i];
  }
  return kept;
}

/* A needle above the tissue is pushed down by 3, which takes its tip 2.5 deep; how much of that it goes. */
static double push_probe(dsw_environment *environment) {
  static const double above[2][3] = {{3.95, 4, 5.5}, {3.95, 4, 7.5}}, down[2][3] = {{3.95, 4, 2.5}, {3.95, 4, 4.5}};
  static const uint32_t edge[2] = {0, 1};
  double now[2][3];
  dsw_scene *scene = NULL;
  dsw_body_desc desc;
  dsw_body_id probe;
  size_t count = 0;
  check(dsw_scene_create(environment, NULL, &scene) == DSW_STATUS_OK, "creating a scene");
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = &above[0][0];
  desc.vertex_count = 2;
  desc.edges = edge;
  desc.edge_count = 1;
  check(dsw_body_create(scene, &desc, &probe) == DSW_STATUS_OK, "creating the probe");
  check(dsw_body_move(scene, probe, &down[0][0], 2, 0, NULL, NULL) == DSW_STATUS_OK, "pushing it");
  check(dsw_body_get_positions(scene, probe, &now[0][0], 2, 0, NULL, &count) == DSW_STATUS_OK, "reading its place");
  check(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroying the scene");
  return (above[0][2] - now[0][2]) / 3;
}

int main(void) {
  dsw_cut_face inside[64];
  dsw_environment *environment = create_block();
  dsw_open_crack_desc desc;
  dsw_change report;
  report.struct_size = sizeof report;
  double depth;
  dsw_open_crack_desc_init(&desc, sizeof desc);
  desc.faces = inside;
  desc.face_count = cut(environment, inside, 64);
  desc.width = 0.5;
  desc.region = 1; /* a longer cut, later, would open into this gap */
  depth = push_probe(environment);
  printf("the cut is closed: the probe goes %.3f of its way\n", depth);
  check(depth < 0.2, "the tissue stops the probe");
  check(dsw_environment_open_crack(environment, &desc, &report) == DSW_STATUS_OK, "opening");
  printf("%u of %u faces opened, %u vertices came apart by %.3f to %.3f\n", (unsigned)report.face_count,
         (unsigned)desc.face_count, (unsigned)report.vertices_parted, report.smallest_width, report.largest_width);
  check(report.vertex_count == 2 * report.vertices_parted && report.vertex_count > 0, "each comes apart in two");
  printf("the first two new vertices, %u and %u, were vertex %u\n", (unsigned)report.vertices[0].vertex.index,
         (unsigned)report.vertices[1].vertex.index, (unsigned)report.vertices[0].from[0].index);
  depth = push_probe(environment);
  printf("the cut is open: the probe goes %.3f of its way\n", depth);
  check(depth == 1, "the probe enters the cut");
  check(dsw_environment_check(environment, NULL) == DSW_STATUS_OK, "all volumes are valid");
  check(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroying");
  return 0;
}
