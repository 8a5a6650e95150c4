/* A tunnel is carved through a block of bone, and something flies through it. Then the tunnel is tied like a vessel, and that flight ends at
 * the ligature, until it is undone. */
#include <dartsweep/dartsweep.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 8, ALONG = SIDE + 1, ROUND = 12 };

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static int64_t at(int x, int y, int z) { return x + ALONG * (y + ALONG * (int64_t)z); }

/* SIDE x SIDE x SIDE unit cubes, all impassable. */
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
  check(dsw_environment_mark_region(environment, 0, DSW_MARK_IMPASSABLE, 0, NULL, NULL) == DSW_STATUS_OK, "marking");
  return environment;
}

/* A ring of points round the tunnel's middle. */
static void ring(double x, double radius, double points[ROUND][3]) {
  const double step = 6.283185307179586 / (double)ROUND;
  int i;
  for (i = 0; i < ROUND; ++i) {
    points[i][0] = x;
    points[i][1] = 4 + radius * cos(step * i);
    points[i][2] = 4 + radius * sin(step * i);
  }
}

/* A drill: two rings, beyond the block on both sides, each closed by a fan. */
static dsw_change drill(dsw_environment *environment) {
  double points[2][ROUND][3];
  uint32_t triangles[3 * (4 * ROUND - 4)], n = 0, i;
  dsw_carve_desc desc;
  dsw_change report;
  report.struct_size = sizeof report;
  ring(-1, 1.8, points[0]);
  ring(SIDE + 1, 1.8, points[1]);
  for (i = 0; i < ROUND; ++i) {
    const uint32_t next = (i + 1) % ROUND;
    const uint32_t side[6] = {i, next, i + ROUND, next, next + ROUND, i + ROUND};
    unsigned k;
    for (k = 0; k < 6; ++k) triangles[n++] = side[k];
    if (i < 1 || i + 1 == ROUND) continue;
    triangles[n++] = 0, triangles[n++] = next, triangles[n++] = i;
    triangles[n++] = ROUND, triangles[n++] = i + ROUND, triangles[n++] = next + ROUND;
  }
  dsw_carve_desc_init(&desc, sizeof desc);
  desc.points = &points[0][0][0];
  desc.point_count = 2 * ROUND;
  desc.triangles = triangles;
  desc.triangle_count = n / 3;
  check(dsw_environment_carve(environment, &desc, &report) == DSW_STATUS_OK, "carving");
  return report;
}

/* How far a flight along the tunnel gets. */
static double fly(const dsw_environment *environment) {
  const double from[3] = {0.5, 4.1, 4.2}, to[3] = {7.5, 4.3, 3.9};
  const dsw_volume_id anywhere = {0, 0};
  dsw_flight flight;
  check(dsw_environment_cast(environment, anywhere, from, to, NULL, &flight) == DSW_STATUS_OK, "flying");
  return flight.time;
}

int main(void) {
  dsw_environment *environment = create_block();
  const dsw_change carved = drill(environment);
  double loop[ROUND][3];
  dsw_face_id fronts[256], backs[256];
  dsw_tie_desc desc;
  dsw_change tied;
  tied.struct_size = sizeof tied;
  size_t i;
  printf("%u volumes were split and %u carved; a flight gets to %g\n", carved.volumes_split,
         (unsigned)carved.carved_count, fly(environment));
  check(carved.carved_count > 0 && fly(environment) == 1, "the tunnel");

  ring(3.3, 2.6, loop); /* in the bone */
  dsw_tie_desc_init(&desc, sizeof desc);
  desc.points = &loop[0][0];
  desc.point_count = ROUND;
  check(dsw_environment_tie(environment, &desc, &tied) == DSW_STATUS_OK, "tying");
  printf("tied: %u volumes were split and %u marked; a flight gets to %g\n", tied.volumes_split,
         (unsigned)tied.whole_count, fly(environment));
  check(tied.is_closed && tied.whole_count == 0 && fabs(fly(environment) - 0.4) < 1e-12, "the ligature");

  check(tied.face_count <= 256, "the faces of the ligature");
  for (i = 0; i < tied.face_count; ++i) fronts[i] = tied.faces[i].front, backs[i] = tied.faces[i].back;
  check(dsw_environment_sew_faces(environment, fronts, backs, tied.face_count) == DSW_STATUS_OK, "undoing");
  check(fly(environment) == 1, "the tunnel again");
  dsw_environment_destroy(environment);
  return 0;
}
