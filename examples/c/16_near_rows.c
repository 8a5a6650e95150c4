/* Near rows and a solver: a wire with a radius falls on a post. Each step asks what is near. Sweeps of projected
 * Gauss-Seidel then change the velocities: no gap gets negative, and the links keep their length. So dsw_body_move
 * meets nothing.
 *
 *    o---o---o---o---o       a box of 3 x 1 x 2 cubes, seen from the side;
 *         +-----+            the post is the lower cube in the middle
 *         |     |                                                              */
#include <dartsweep/dartsweep.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kPoints = 4 * 2 * 3, kCells = 3 * 2, kWire = 7, kMost = 64, kSteps = 200, kSweeps = 30 };

static const double kLink = 0.45;

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static dsw_environment *create_box(void) {
  static const int32_t corners[8] = {0, 1, 5, 4, 8, 9, 13, 12};
  double points[3 * kPoints];
  int32_t cells[8 * kCells];
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  dsw_volume_id post;
  int i;
  for (i = 0; i < kPoints; ++i) {
    points[3 * i] = i % 4, points[3 * i + 1] = i / 4 % 2, points[3 * i + 2] = i / 8;
  }
  for (i = 0; i < 8 * kCells; ++i) cells[i] = corners[i % 8] + i / 8 % 3 + 8 * (i / 24);
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = points, desc.point_count = kPoints;
  desc.connectivity = cells, desc.connectivity_count = 8 * kCells, desc.volume_count = kCells;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  check(dsw_environment_get_volume_id(environment, 1, &post) == DSW_STATUS_OK, "finding the post");
  check(dsw_environment_mark_volumes(environment, &post, 1, DSW_MARK_IMPASSABLE, 0, NULL) == DSW_STATUS_OK, "marking");
  return environment;
}

/* One link: its two vertices get velocities along it that bring its length back. */
static void keep_length(const double *p, double *v) {
  double way[3], length = 0, change = 0;
  int k;
  for (k = 0; k < 3; ++k) way[k] = p[3 + k] - p[k], length += way[k] * way[k];
  length = sqrt(length);
  for (k = 0; k < 3; ++k) change += way[k] / length * (v[3 + k] - v[k]);
  change += length - kLink;
  for (k = 0; k < 3; ++k) v[k] += change / 2 * way[k] / length, v[3 + k] -= change / 2 * way[k] / length;
}

/* One row: an impulse along the normal, so that gap + J v >= 0. Walls push, they do not pull. */
static void keep_gap(double gap, const double *j, const uint32_t *columns, size_t entries, double *impulse, double *v) {
  double after = gap, size = 0, change;
  size_t k;
  for (k = 0; k < entries; ++k) after += j[k] * v[columns[k]], size += j[k] * j[k];
  change = -after / size;
  if (*impulse + change < 0) change = -*impulse;
  for (k = 0; k < entries; ++k) v[columns[k]] += j[k] * change;
  *impulse += change;
}

int main(void) {
  dsw_environment *environment = create_box();
  double p[3 * kWire], v[3 * kWire] = {0}, impulses[kMost], before[kMost], least = 0;
  uint32_t edges[2 * (kWire - 1)], contacts = 0;
  size_t count = 0, entries = 0, i, k;
  dsw_scene *scene = NULL;
  dsw_body_desc desc;
  dsw_body_id wire;
  dsw_near_options options;
  int step, sweep;

  for (i = 0; i < kWire; ++i) p[3 * i] = 0.15 + kLink * (double)i, p[3 * i + 1] = 0.5, p[3 * i + 2] = 1.75;
  for (i = 0; i + 1 < kWire; ++i) edges[2 * i] = (uint32_t)i, edges[2 * i + 1] = (uint32_t)i + 1;
  check(dsw_scene_create(environment, NULL, &scene) == DSW_STATUS_OK, "creating a scene");
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = p, desc.vertex_count = kWire;
  desc.edges = edges, desc.edge_count = kWire - 1;
  check(dsw_body_create(scene, &desc, &wire) == DSW_STATUS_OK, "creating a body");

  dsw_near_options_init(&options, sizeof options);
  options.flags = DSW_NEAR_JACOBIAN;
  options.radius = 0.05;
  options.margin = 0.1; /* more than any vertex moves in a step */
  for (step = 1; step <= kSteps; ++step) {
    const dsw_near_row *rows = NULL;
    const uint32_t *offsets = NULL, *columns = NULL;
    const double *values = NULL;
    dsw_move_report report;
    check(dsw_body_find_near_rows(scene, wire, &options, NULL) == DSW_STATUS_OK, "finding rows");
    check(dsw_body_get_near_offsets(scene, wire, &offsets, &count) == DSW_STATUS_OK, "reading offsets");
    check(dsw_body_get_near_columns(scene, wire, &columns, &entries) == DSW_STATUS_OK, "reading columns");
    check(dsw_body_get_near_values(scene, wire, &values, &entries) == DSW_STATUS_OK, "reading values");
    check(dsw_body_get_near_rows(scene, wire, &rows, &count) == DSW_STATUS_OK && count <= kMost, "reading rows");
    memcpy(before, impulses, sizeof before);
    for (i = 0; i < kWire; ++i) v[3 * i + 2] -= 0.0005;
    for (least = 1, i = 0; i < count; ++i) { /* a row begins with the impulse that it had */
      impulses[i] = rows[i].previous == UINT32_MAX ? 0 : before[rows[i].previous];
      for (k = offsets[i]; k < offsets[i + 1]; ++k) v[columns[k]] += values[k] * impulses[i];
      least = rows[i].gap < least ? rows[i].gap : least;
    }
    for (sweep = 0; sweep < kSweeps; ++sweep) {
      for (i = 0; i + 1 < kWire; ++i) keep_length(p + 3 * i, v + 3 * i);
      for (i = 0; i < count; ++i) {
        const size_t at = offsets[i];
        keep_gap(rows[i].gap, values + at, columns + at, offsets[i + 1] - at, &impulses[i], v);
      }
    }
    if (step % 50 == 0) printf("step %3d: %2u rows, smallest gap %.4f\n", step, (unsigned)count, least);
    check(least > -options.radius / 4, "gaps stay");
    for (i = 0; i < 3 * kWire; ++i) p[i] += v[i];
    check(dsw_body_move(scene, wire, p, kWire, 0, NULL, &report) == DSW_STATUS_OK, "moving");
    contacts += report.contact_count;
  }
  printf("%u contacts; the wire lies at", (unsigned)contacts);
  for (i = 0; i < kWire; ++i) printf(" (%.2f, %.2f)", p[3 * i], p[3 * i + 2]);
  printf("\n");
  check(contacts == 0, "the rows keep the wire away");
  check(p[3 * (kWire / 2) + 2] > 1.04 && p[2] < 0.9, "it hangs on the post");
  check(dsw_scene_destroy(scene) == DSW_STATUS_OK && dsw_environment_destroy(environment) == DSW_STATUS_OK,
        "destroying");
  return 0;
}
