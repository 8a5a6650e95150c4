/* A mesh by hand: two hexahedra in a row, a roof (wedge) on the first, a tip (pyramid) on the second and a
 * polyhedron below. One face between them becomes a wall and a particle meets it.
 *
 *            13----14
 *            /  roof \
 *           3---------7--------11
 *           |  left   |  right  | > 12 tip
 *           0---------4--------8
 *            \ below /                        */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>

enum { kLeft, kRight, kTip, kRoof, kBelow, kCells };

static const double kPoints[] = {
    0,   0,   0,   0, 1,   0, 0, 1,   1, 0, 0, 1, /* 0 1 2 3: the square at x = 0 */
    1,   0,   0,   1, 1,   0, 1, 1,   1, 1, 0, 1, /* 4 5 6 7: at x = 1 */
    2,   0,   0,   2, 1,   0, 2, 1,   1, 2, 0, 1, /* 8 9 10 11: at x = 2 */
    3,   0.5, 0.5, 0, 0.5, 2, 1, 0.5, 2,          /* 12: tip; 13 14: ridge of the roof */
    0.5, 0.5, -1                                  /* 15: lowest point */
};
static const uint8_t kTypes[kCells] = {DSW_CELL_TYPE_HEXAHEDRON, DSW_CELL_TYPE_HEXAHEDRON, DSW_CELL_TYPE_PYRAMID,
                                       DSW_CELL_TYPE_WEDGE, DSW_CELL_TYPE_POLYHEDRON};
/* A polyhedron is a stream: count of faces, then each face's count of points and its points, seen from outside. */
static const int32_t kConnectivity[] = {0, 1,  2,  3,  4,  5,  6,  7,  /* left */
                                        4, 5,  6,  7,  8,  9,  10, 11, /* right */
                                        8, 9,  10, 11, 12,             /* tip */
                                        3, 13, 2,  7,  14, 6,          /* roof */
                                        5, 4,  0,  4,  5,  1,  3,  0,  15, 4,  3,
                                        4, 15, 5,  3,  5,  15, 1,  3,  1,  15, 0}; /* below */
static const int32_t kOffsets[kCells + 1] = {0, 8, 16, 21, 27, 49};

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static double move_to(dsw_scene *scene, dsw_particle_id particle, double x, double y, double z, dsw_flight *flight) {
  double target[3];
  target[0] = x;
  target[1] = y;
  target[2] = z;
  check(dsw_particle_move(scene, particle, target, NULL, flight) == DSW_STATUS_OK, "moving");
  printf("to (%g, %g, %g): %s in cell %u at x = %.17g\n", x, y, z,
         flight->outcome == DSW_OUTCOME_REACHED ? "reached" : "stopped", (unsigned)flight->volume.index,
         flight->position[0]);
  return flight->position[0];
}

int main(void) {
  const double start[3] = {0.25, 0.4, 0.3};
  const uint32_t square[4] = {8, 9, 10, 11};
  const size_t ends[2] = {0, 4};
  const dsw_volume_id no_hint = {0, 0};
  dsw_environment_desc desc;
  dsw_environment_info info;
  dsw_environment *environment = NULL;
  dsw_scene *scene = NULL;
  dsw_particle_id particle;
  dsw_face_id wall;
  dsw_flight flight;
  size_t missing = 0;

  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = kPoints;
  desc.point_count = sizeof kPoints / sizeof kPoints[0] / 3;
  desc.cell_types = kTypes;
  desc.volume_count = kCells;
  desc.offsets = kOffsets;
  desc.connectivity = kConnectivity;
  desc.connectivity_count = sizeof kConnectivity / sizeof kConnectivity[0];
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  info.struct_size = sizeof info;
  check(dsw_environment_get_info(environment, &info) == DSW_STATUS_OK, "reading");
  printf("%u cells, %u faces, %u of them on the outside\n", (unsigned)info.volume_count, (unsigned)info.face_count,
         (unsigned)info.boundary_face_count);
  check(info.face_count == 23 && info.boundary_face_count == 19 && info.part_count == 1, "counting");

  check(dsw_scene_create(environment, NULL, &scene) == DSW_STATUS_OK, "creating the scene");
  check(dsw_particle_create(scene, start, no_hint, &particle) == DSW_STATUS_OK, "creating the particle");

  /* Everything inside is passable at first: from the left cell into the tip. */
  check(move_to(scene, particle, 2.5, 0.5, 0.5, &flight) == 2.5 && flight.volume.index == kTip, "no wall yet");
  check(move_to(scene, particle, 0.25, 0.4, 0.3, &flight) == 0.25 && flight.volume.index == kLeft, "and back");

  /* A wall is found by its points and marked while the scene runs. */
  check(dsw_environment_find_faces(environment, 1, ends, square, &wall, &missing) == DSW_STATUS_OK && missing == 0,
        "finding the face");
  check(dsw_environment_mark_faces(environment, &wall, 1, DSW_MARK_IMPASSABLE) == DSW_STATUS_OK, "marking");
  check(move_to(scene, particle, 2.5, 0.5, 0.5, &flight) <= 2 && flight.volume.index == kRight, "stopped");
  check(flight.outcome == DSW_OUTCOME_CONTACT && flight.contact.normal[0] == -1 && flight.contact.behind.index == kTip,
        "contact");

  /* Back, up into the roof and down through the left cell into the polyhedron. */
  check(move_to(scene, particle, 0.25, 0.4, 0.3, &flight) == 0.25 && flight.volume.index == kLeft, "back again");
  check(move_to(scene, particle, 0.5, 0.5, 1.5, &flight) == 0.5 && flight.volume.index == kRoof, "roof");
  check(move_to(scene, particle, 0.5, 0.5, -0.5, &flight) == 0.5 && flight.volume.index == kBelow, "below");

  check(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroying the scene");
  check(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroying the environment");
  return 0;
}
