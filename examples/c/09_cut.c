/* A scalpel cuts a block of tissue. What comes of each volume, and where each new vertex comes from, is told, so that a mechanical model
 * can follow; what flew through the block before is stopped by the crack afterwards. */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 8, ALONG = SIDE + 1 };

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static int64_t at(int x, int y, int z) { return x + ALONG * (y + ALONG * (int64_t)z); }

/* SIDE x SIDE x SIDE unit cubes. */
static dsw_environment *create_block(void) {
  static double points[3 * ALONG * ALONG * ALONG];
  static int64_t cells[8 * SIDE * SIDE * SIDE];
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
  return environment;
}

/* How far a flight along z through the middle of the block gets. */
static double fly(const dsw_environment *environment) {
  const double from[3] = {3.4, 4.3, 0.5}, to[3] = {3.4, 4.3, 7.5};
  const dsw_volume_id anywhere = {0, 0};
  dsw_flight flight;
  check(dsw_environment_cast(environment, anywhere, from, to, NULL, &flight) == DSW_STATUS_OK, "flying");
  return flight.time;
}

int main(void) {
  /* The scalpel's edge, two points, at three places: it comes from outside, sinks in and is drawn through. */
  const double blade[3][2][3] = {
      {{-1, 1.2, 2.6}, {-1, 7.7, 3.1}}, {{4, 1.2, 3.2}, {4, 7.7, 3.8}}, {{9, 1.2, 4.1}, {9, 7.7, 4.4}}};
  dsw_environment *environment = create_block();
  dsw_cut_desc desc;
  dsw_change report;
  report.struct_size = sizeof report;
  check(fly(environment) == 1.0, "nothing is in the way");
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = &blade[0][0][0];
  desc.rows = 3;
  desc.columns = 2;
  desc.flags = DSW_CUT_UNSEW;
  check(dsw_environment_cut(environment, &desc, &report) == DSW_STATUS_OK, "cutting");
  printf("the blade crossed %u of %d volumes: %u were split, %u stayed whole round its end\n",
         (unsigned)report.volumes_crossed, SIDE * SIDE * SIDE, (unsigned)report.volumes_split,
         (unsigned)report.whole_count);
  printf("%u faces of the cut, at most %.3f from the blade\n", (unsigned)report.face_count, report.distance);
  check(report.vertex_count > 0 && report.volume_count > 0, "a cut changes something");
  printf("%u new vertices; the first is %.2f of vertex %u and %.2f of vertex %u\n", (unsigned)report.vertex_count,
         report.vertices[0].weights[0], (unsigned)report.vertices[0].from[0].index, report.vertices[0].weights[1],
         (unsigned)report.vertices[0].from[1].index);
  printf("a flight across gets %.3f of its way\n", fly(environment));
  check(fly(environment) < 0.5, "the crack is in the way");
  check(dsw_environment_check(environment, NULL) == DSW_STATUS_OK, "all volumes are valid");
  check(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroying");
  return 0;
}
