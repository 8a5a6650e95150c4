/* A thick wire is pushed along the floor of a box. Its radius is a distance that the library keeps. So the wire slides,
 * and its middle line stays one radius above the floor.
 *
 *    o---o---o---o---o         each step wants (0.05, 0, -0.05)
 *       \
 *    ----->-------------       a box of 4 x 1 x 1 cubes, seen from the side          */
#include <dartsweep/dartsweep.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { kPoints = 5 * 2 * 2, kCells = 4, kWire = 5, kSteps = 50 };

static const double kRadius = 0.15;

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static dsw_environment *create_box(void) {
  static const int32_t corners[8] = {0, 1, 6, 5, 10, 11, 16, 15};
  double points[3 * kPoints];
  int32_t cells[8 * kCells];
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  int i;
  for (i = 0; i < kPoints; ++i) {
    points[3 * i] = i % 5, points[3 * i + 1] = i / 5 % 2, points[3 * i + 2] = i / 10;
  }
  for (i = 0; i < 8 * kCells; ++i) cells[i] = corners[i % 8] + i / 8;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = points, desc.point_count = kPoints;
  desc.connectivity = cells, desc.connectivity_count = 8 * kCells, desc.volume_count = kCells;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  return environment;
}

int main(void) {
  dsw_environment *environment = create_box();
  double p[3 * kWire], gap = 0;
  uint32_t edges[2 * (kWire - 1)];
  const uint32_t *near_edges = NULL;
  size_t count = 0, i;
  dsw_scene *scene = NULL;
  dsw_body_desc desc;
  dsw_body_id wire;
  dsw_move_options options;
  int step;

  for (i = 0; i < kWire; ++i) p[3 * i] = 0.2 + 0.25 * (double)i, p[3 * i + 1] = 0.5, p[3 * i + 2] = 0.5;
  for (i = 0; i + 1 < kWire; ++i) edges[2 * i] = (uint32_t)i, edges[2 * i + 1] = (uint32_t)i + 1;
  check(dsw_scene_create(environment, NULL, &scene) == DSW_STATUS_OK, "creating a scene");
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = p, desc.vertex_count = kWire;
  desc.edges = edges, desc.edge_count = kWire - 1;

  desc.radius = 0.6; /* the walls are 0.5 away */
  check(dsw_body_create(scene, &desc, &wire) == DSW_STATUS_OCCUPIED, "refusing");
  check(dsw_scene_get_offending_edges(scene, &near_edges, &count) == DSW_STATUS_OK, "reading what is too near");
  printf("with radius %.2f, %u edges are too near to walls; the first has vertices %u and %u\n", desc.radius,
         (unsigned)count, (unsigned)near_edges[0], (unsigned)near_edges[1]);
  desc.radius = kRadius;
  check(dsw_body_create(scene, &desc, &wire) == DSW_STATUS_OK, "creating a body");

  dsw_move_options_init(&options, sizeof options);
  options.vertex_response = options.edge_response = DSW_RESPONSE_SLIDE;
  for (step = 1; step <= kSteps; ++step) {
    dsw_move_report report;
    for (i = 0; i < kWire; ++i) p[3 * i] += 0.05, p[3 * i + 2] -= 0.05;
    check(dsw_body_move(scene, wire, p, kWire, 0, &options, &report) == DSW_STATUS_OK, "moving");
    check(dsw_body_get_positions(scene, wire, p, kWire, 0, NULL, &count) == DSW_STATUS_OK, "reading positions");
    /* A lower bound of the distance to all walls, less the radius; 1 if nothing is nearer. */
    check(dsw_body_find_least_gap(scene, wire, 1, &gap) == DSW_STATUS_OK, "finding the least gap");
    check(gap >= -ldexp(kRadius, -31), "the radius is kept");
    if (step == 5 || step % 10 == 0) {
      printf("step %2d: tip at (%.2f, %.2f), least gap %.4f, %u contacts\n", step, p[3 * kWire - 3], p[3 * kWire - 1],
             gap, (unsigned)report.contact_count);
    }
  }
  check(p[3 * kWire - 3] > 3 && p[3 * kWire - 1] < kRadius + 0.01, "the wire slides along the floor");
  check(dsw_body_set_radius(scene, wire, 0.5) == DSW_STATUS_OCCUPIED, "no thicker here");
  check(dsw_body_set_radius(scene, wire, 0.1) == DSW_STATUS_OK, "but thinner");
  check(dsw_body_find_least_gap(scene, wire, 1, &gap) == DSW_STATUS_OK && gap > 0.04, "which leaves a gap");
  check(dsw_scene_destroy(scene) == DSW_STATUS_OK && dsw_environment_destroy(environment) == DSW_STATUS_OK,
        "destroying");
  return 0;
}
