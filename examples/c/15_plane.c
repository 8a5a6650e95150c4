/* In the plane: points have two coordinates, cells are polygons, all functions are the same. A string of two edges is lowered on
 * a triangular roof and bends round it; then a scalpel scratches a crack beside the roof, and what falls there lands on it.
 *
 *   a-----b-----c         8 x 6 squares; the roof is made of four triangles,
 *   |     |     |         two squares cut along their diagonals
 *   v     v     v
 *        /\
 *       /__\   \crack                                                          */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDE = 8, HIGH = 6, ALONG = WIDE + 1, MOST = 16 };

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static int64_t at(int x, int y) { return x + ALONG * (int64_t)y; }

static size_t add_cell(int64_t *corners, size_t first, int64_t a, int64_t b, int64_t c) {
  corners[first] = a, corners[first + 1] = b, corners[first + 2] = c;
  return first + 3;
}

/* Squares, counter-clockwise; the two of the roof are triangles. What lies under the roof has region 1 and is made impassable. */
static dsw_environment *create_town(void) {
  static double points[2 * ALONG * (HIGH + 1)];
  static int64_t corners[4 * WIDE * HIGH + 8], offsets[WIDE * HIGH + 3];
  static uint8_t types[WIDE * HIGH + 2];
  static int32_t regions[WIDE * HIGH + 2];
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  size_t n = 0, cell = 0;
  int x, y;
  for (y = 0; y <= HIGH; ++y) {
    for (x = 0; x <= WIDE; ++x) {
      const int is_left = x == 3 && y == 1, is_right = x == 4 && y == 1;
      points[2 * at(x, y)] = x, points[2 * at(x, y) + 1] = y;
      if (x == WIDE || y == HIGH) continue;
      if (is_left || is_right) { /* up to the ridge, or down from it */
        n = add_cell(corners, n, at(x, y), at(x + 1, y), at(is_left ? x + 1 : x, y + 1));
        types[cell] = DSW_CELL_TYPE_TRIANGLE, regions[cell++] = 1, offsets[cell] = (int64_t)n;
        n = add_cell(corners, n, at(x, y + 1), at(is_left ? x : x + 1, y), at(x + 1, y + 1));
        types[cell] = DSW_CELL_TYPE_TRIANGLE;
      } else {
        n = add_cell(corners, n, at(x, y), at(x + 1, y), at(x + 1, y + 1));
        corners[n++] = at(x, y + 1);
        types[cell] = DSW_CELL_TYPE_QUAD;
      }
      offsets[++cell] = (int64_t)n;
    }
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.dimension = 2;
  desc.points = points, desc.point_count = ALONG * (HIGH + 1);
  desc.connectivity = corners, desc.connectivity_count = n;
  desc.offsets = offsets, desc.cell_types = types, desc.regions = regions, desc.volume_count = cell;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  check(dsw_environment_mark_region(environment, 1, DSW_MARK_IMPASSABLE, 0, NULL, NULL) == DSW_STATUS_OK, "marking");
  return environment;
}

/* The height at which what falls at x lands. */
static double fall(const dsw_environment *environment, double x) {
  const double from[2] = {x, 5.5}, to[2] = {x, 0.5};
  const dsw_volume_id anywhere = {0, 0};
  dsw_flight flight;
  check(dsw_environment_cast(environment, anywhere, from, to, NULL, &flight) == DSW_STATUS_OK, "falling");
  return flight.outcome == DSW_OUTCOME_CONTACT ? flight.position[1] : to[1];
}

int main(void) {
  const double string[3][2] = {{1.5, 4.5}, {5, 4.5}, {6.5, 4.5}};
  const uint32_t edges[2][2] = {{0, 1}, {1, 2}};
  const double path[3][2] = {{5.1, 2.8}, {6.3, 1.9}, {7.4, 1.2}}; /* of the scalpel's point */
  dsw_environment *environment = create_town();
  const dsw_body_contact *contacts = NULL;
  dsw_scene *scene = NULL;
  dsw_body_desc body_desc;
  dsw_body_id body;
  dsw_move_options options;
  dsw_move_report report;
  dsw_cut_desc cut;
  double p[MOST][2];
  size_t count = 0, contact_count = 0, i;
  int step;

  check(dsw_scene_create(environment, NULL, &scene) == DSW_STATUS_OK, "creating a scene");
  dsw_body_desc_init(&body_desc, sizeof body_desc);
  body_desc.positions = &string[0][0], body_desc.vertex_count = 3;
  body_desc.edges = &edges[0][0], body_desc.edge_count = 2;
  check(dsw_body_create(scene, &body_desc, &body) == DSW_STATUS_OK, "creating a body");
  dsw_move_options_init(&options, sizeof options);
  options.edge_response = DSW_RESPONSE_ADAPTIVE_ONE;
  for (step = 0; step < 8; ++step) {
    check(dsw_body_get_positions(scene, body, &p[0][0], MOST, 0, NULL, &count) == DSW_STATUS_OK, "reading positions");
    for (i = 0; i < count; ++i) p[i][1] -= 0.4;
    check(dsw_body_move(scene, body, &p[0][0], count, 0, &options, &report) == DSW_STATUS_OK, "moving");
    check(dsw_body_get_contacts(scene, body, &contacts, &contact_count) == DSW_STATUS_OK, "reading contacts");
    for (i = 0; i < contact_count; ++i) {
      printf("step %d: vertex %u, touch at (%g, %g), normal (%.3f, %.3f)\n", step, (unsigned)contacts[i].vertex.index,
             contacts[i].point[0], contacts[i].point[1], contacts[i].contact.normal[0], contacts[i].contact.normal[1]);
    }
  }
  check(dsw_body_get_positions(scene, body, &p[0][0], MOST, 0, NULL, &count) == DSW_STATUS_OK, "reading positions");
  for (i = 0; i < count; ++i) printf("(%.4f, %.4f) ", p[i][0], p[i][1]);
  printf("\n");
  check(count > 3, "the string bends where it meets the ridge");

  check(fall(environment, 6) == 0.5, "nothing is in the way");
  dsw_cut_desc_init(&cut, sizeof cut);
  cut.points = &path[0][0], cut.rows = 3, cut.columns = 1;
  cut.flags = DSW_CUT_UNSEW;
  check(dsw_environment_cut(environment, &cut, NULL) == DSW_STATUS_OK, "cutting");
  printf("what falls at x = 6 now lands at y = %.4f\n", fall(environment, 6));
  check(fall(environment, 6) > 2 && fall(environment, 6) < 2.2, "it lands on the crack");
  check(dsw_scene_destroy(scene) == DSW_STATUS_OK && dsw_environment_destroy(environment) == DSW_STATUS_OK,
        "destroying");
  return 0;
}
