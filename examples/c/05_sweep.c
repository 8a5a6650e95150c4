/* A needle turns about its hub. A wall inside the triangle that it sweeps is met, although neither the path of its tip nor
 * its new place touches it.
 *
 *               hub
 *             .'  |        4 x 4 cubes in one layer, seen from above;
 *           .' |   |       the wall is one face, at x = 2
 *         .'   |    |
 *       tip ------> tip'                                                     */
#include <dartsweep/dartsweep.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { kSide = 4, kPoints = 2 * (kSide + 1) * (kSide + 1), kCells = kSide * kSide };

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static int32_t point_at(int x, int y, int z) { return (z * (kSide + 1) + y) * (kSide + 1) + x; }

static dsw_environment *create_layer(void) {
  static const int corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  static double points[kPoints][3];
  static int32_t cells[kCells][8];
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  int x, y, z, k;
  for (z = 0; z < 2; ++z) {
    for (y = 0; y <= kSide; ++y) {
      for (x = 0; x <= kSide; ++x) {
        points[point_at(x, y, z)][0] = x;
        points[point_at(x, y, z)][1] = y;
        points[point_at(x, y, z)][2] = z;
      }
    }
  }
  for (y = 0; y < kSide; ++y) {
    for (x = 0; x < kSide; ++x) {
      for (k = 0; k < 8; ++k) {
        cells[y * kSide + x][k] = point_at(x + corners[k][0], y + corners[k][1], corners[k][2]);
      }
    }
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = &points[0][0];
  desc.point_count = kPoints;
  desc.connectivity = &cells[0][0];
  desc.connectivity_count = 8 * kCells;
  desc.volume_count = kCells;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  return environment;
}

int main(void) {
  static const char *const kLevels[] = {"", "the tip's path", "that and the new place", "the whole triangle"};
  const double tip[3] = {0.25, 0.5, 0.5}, target[3] = {3.25, 0.5, 0.5}, hub[3] = {2.25, 3.5, 0.5};
  const size_t ends[2] = {0, 4};
  dsw_environment *environment = create_layer();
  dsw_sweep_options options;
  uint32_t square[4];
  dsw_face_id wall;
  dsw_sweep sweep;
  size_t missing = 0;
  int level;

  /* The wall stands free: y from 1 to 2 at x = 2. */
  square[0] = (uint32_t)point_at(2, 1, 0);
  square[1] = (uint32_t)point_at(2, 2, 0);
  square[2] = (uint32_t)point_at(2, 2, 1);
  square[3] = (uint32_t)point_at(2, 1, 1);
  check(dsw_environment_find_faces(environment, 1, ends, square, &wall, &missing) == DSW_STATUS_OK && missing == 0,
        "finding the face");
  check(dsw_environment_mark_faces(environment, &wall, 1, DSW_MARK_IMPASSABLE) == DSW_STATUS_OK, "marking");

  /* The more is looked at, the more is found. */
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
    dsw_sweep_options_init(&options, sizeof options);
    options.level = (dsw_level)level;
    check(dsw_environment_sweep_edges(environment, 1, NULL, tip, target, hub, 0, &options, &sweep) == DSW_STATUS_OK,
          "sweeping");
    printf("%-24s %s, %u volumes looked at\n", kLevels[level],
           sweep.outcome == DSW_OUTCOME_CONTACT ? "contact" : "nothing in the way", (unsigned)sweep.volumes_visited);
    check((sweep.outcome == DSW_OUTCOME_CONTACT) == (level == DSW_LEVEL_EDGES_SWEPT), "what each level sees");
  }

  /* The needle meets the upper rim of the wall with its middle, halfway. */
  printf("after %g of the turn, tip at (%g, %g, %g)\n", sweep.time, sweep.position[0], sweep.position[1],
         sweep.position[2]);
  printf("touches (%g, %g, %g), %g along the needle, normal (%.3f, %.3f, %.3f)\n", sweep.point[0], sweep.point[1],
         sweep.point[2], sweep.edge_parameter, sweep.contact.normal[0], sweep.contact.normal[1],
         sweep.contact.normal[2]);
  check(sweep.time == 0.5 && sweep.position[0] == 1.75 && sweep.edge_parameter == 0.5, "when");
  check(sweep.point[0] == 2 && sweep.point[1] == 2 && sweep.point[2] == 0.5, "where");
  check(sweep.contact.kind == DSW_CONTACT_EDGE && sweep.contact.marked_kind == DSW_CELL_FACE &&
            sweep.contact.wall.volume == wall.volume && sweep.contact.wall.local == wall.local,
        "what");
  check(fabs(sweep.contact.normal[0] + 3 / sqrt(9.25)) < 1e-15 && sweep.contact.normal[2] == 0, "against the motion");

  check(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroying");
  return 0;
}
