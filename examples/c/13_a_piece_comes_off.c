/* Two cuts meet below the surface of an organ: the wedge between them comes off. Its volumes become passable, its surface a body that is
 * pulled out; then something can fly where it was.
 *
 *    \  |piece|  /
 *  ---\-------/---   z = 4
 *      \     /
 *  organ \ /                                                              */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 8, ALONG = SIDE + 1, TOP = 4 };

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static int64_t at(int x, int y, int z) { return x + ALONG * (y + ALONG * (int64_t)z); }

/* SIDE x SIDE x SIDE unit cubes, of which those below TOP are the organ: region 1. */
static dsw_environment *create_organ(void) {
  static double points[3 * ALONG * ALONG * ALONG];
  static int64_t cells[8 * SIDE * SIDE * SIDE];
  static int32_t regions[SIDE * SIDE * SIDE];
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
        regions[n / 8] = z < TOP ? 1 : 0;
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
  desc.regions = regions;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  check(dsw_environment_mark_region(environment, 1, DSW_MARK_IMPASSABLE, 0, NULL, NULL) == DSW_STATUS_OK, "marking");
  return environment;
}

/* Down from (x, z) = `from`, just above the organ, to `to` in it, all along y. */
static void cut(dsw_environment *environment, const double *from, const double *to) {
  const double start[3] = {from[0], 4.5, from[1]};
  const dsw_volume_id anywhere = {0, 0};
  double blade[2][2][3];
  dsw_cut_desc desc;
  dsw_change report;
  report.struct_size = sizeof report;
  int row, column;
  for (row = 0; row < 2; ++row) {
    for (column = 0; column < 2; ++column) {
      blade[row][column][0] = row == 0 ? from[0] : to[0];
      blade[row][column][1] = column == 0 ? -1 : SIDE + 1;
      blade[row][column][2] = row == 0 ? from[1] : to[1];
    }
  }
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = &blade[0][0][0];
  desc.rows = desc.columns = 2;
  desc.flags = DSW_CUT_UNSEW;
  check(dsw_environment_locate(environment, start, anywhere, &desc.start, NULL) == DSW_STATUS_OK, "locating");
  check(dsw_environment_cut(environment, &desc, &report) == DSW_STATUS_OK, "cutting");
  printf("a cut through %u volumes, %u faces\n", (unsigned)report.volumes_split, (unsigned)report.face_count);
}

/* Whether something can fly along y, below the organ's surface. */
static int is_way_free(const dsw_environment *environment) {
  const double from[3] = {4.15, 0.5, 3.2}, to[3] = {4.15, 7.5, 3.2};
  const dsw_volume_id anywhere = {0, 0};
  dsw_flight flight;
  check(dsw_environment_cast(environment, anywhere, from, to, NULL, &flight) == DSW_STATUS_OK, "flying");
  return flight.outcome == DSW_OUTCOME_REACHED;
}

int main(void) {
  const double left[2][2] = {{1.7, 4.4}, {5.6, 0.5}}, right[2][2] = {{6.6, 4.4}, {2.7, 0.5}};
  const double inside[3] = {4.15, 4.5, 3.2};
  const dsw_volume_id anywhere = {0, 0};
  dsw_environment *environment = create_organ();
  dsw_scene *scene = NULL;
  dsw_body_id piece;
  dsw_detach_desc desc;
  dsw_change report;
  report.struct_size = sizeof report;
  dsw_rigid_motion pull = {{0, 0, 0, 1}, {0, 0, 0}, {0, 0, 3}};
  dsw_move_report moved;
  check(dsw_scene_create(environment, NULL, &scene) == DSW_STATUS_OK, "a scene");

  cut(environment, left[0], left[1]);
  dsw_detach_desc_init(&desc, sizeof desc);
  check(dsw_environment_locate(environment, inside, anywhere, &desc.volume, NULL) == DSW_STATUS_OK, "locating");
  desc.level = DSW_LEVEL_FACES;
  desc.max_volumes = 150;
  check(dsw_environment_detach(environment, &desc, &piece, &report) == DSW_STATUS_TOO_LARGE, "one cut is not enough");
  cut(environment, right[0], right[1]);
  check(!is_way_free(environment), "the piece is in the way");

  check(dsw_environment_locate(environment, inside, anywhere, &desc.volume, NULL) == DSW_STATUS_OK, "locating");
  check(dsw_environment_detach(environment, &desc, &piece, &report) == DSW_STATUS_OK, "detaching");
  printf("%u volumes came off as a body of %u vertices and %u triangles, drawn in by %.3f at most\n",
         (unsigned)report.detached_count, (unsigned)report.body_vertex_count, (unsigned)report.body_face_count,
         report.distance);
  printf("the first was vertex %u of the organ\n", (unsigned)report.body_vertices[0].from[0].index);
  check(report.faces_sewn > 0 && is_way_free(environment), "the space is one again");

  check(dsw_body_move_rigid(scene, piece, &pull, NULL, &moved) == DSW_STATUS_OK, "pulling");
  printf("it is pulled out by %.3f of the way\n", moved.fraction);
  check(moved.fraction == 1.0, "nothing holds it");
  check(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroying the scene");
  check(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroying");
  return 0;
}
