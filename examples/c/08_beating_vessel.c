/* A vessel that beats squeezes a catheter. Its wall is that between the 3 x 3 cubes in the middle of a bar of 5 x 5 x 8 and the rest; every
 * step all points of the environment go to new places, and the wall pushes the catheter where it narrows. */
#include <dartsweep/dartsweep.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDE = 5, LONG = 8, LINKS = 12, STEPS = 60, POINTS = (WIDE + 1) * (WIDE + 1) * (LONG + 1) };
enum { LUMEN = 1, TISSUE = 2 };

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static int is_lumen(int x, int y) { return x >= 1 && x <= 3 && y >= 1 && y <= 3; }

static int64_t at(int x, int y, int z) { return x + (WIDE + 1) * (y + (WIDE + 1) * z); }

static dsw_environment *create_vessel(double *points) {
  static int64_t cells[8 * WIDE * WIDE * LONG];
  static int32_t regions[WIDE * WIDE * LONG];
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  size_t n = 0, faces = 0;
  int x, y, z, k;
  for (z = 0; z <= LONG; ++z) {
    for (y = 0; y <= WIDE; ++y) {
      for (x = 0; x <= WIDE; ++x) {
        double *p = points + 3 * at(x, y, z);
        p[0] = x - (double)WIDE / 2;
        p[1] = y - (double)WIDE / 2;
        p[2] = z;
      }
    }
  }
  for (z = 0; z < LONG; ++z) {
    for (y = 0; y < WIDE; ++y) {
      for (x = 0; x < WIDE; ++x) {
        for (k = 0; k < 8; ++k) cells[8 * n + (size_t)k] = at(x + ((k + 1) / 2) % 2, y + (k / 2) % 2, z + k / 4);
        regions[n++] = is_lumen(x, y) ? LUMEN : TISSUE;
      }
    }
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points;
  desc.point_count = POINTS;
  desc.connectivity = cells;
  desc.connectivity_count = 8 * n;
  desc.volume_count = n;
  desc.regions = regions;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  check(dsw_environment_mark_between(environment, LUMEN, TISSUE, DSW_MARK_IMPASSABLE, &faces) == DSW_STATUS_OK,
        "marking the wall");
  printf("a vessel of %u volumes, its wall of %u faces\n", (unsigned)n, (unsigned)faces);
  return environment;
}

/* A line along the vessel, near its wall. */
static dsw_body_id create_catheter(dsw_scene *scene) {
  double positions[3 * LINKS];
  uint32_t edges[2 * (LINKS - 1)];
  dsw_body_desc desc;
  dsw_body_id body;
  uint32_t i;
  for (i = 0; i < LINKS; ++i) {
    positions[3 * i] = 1.3;
    positions[3 * i + 1] = 0.1 * sin((double)i);
    positions[3 * i + 2] = 0.5 + 7.0 * i / (LINKS - 1);
    if (i + 1 < LINKS) {
      edges[2 * i] = i;
      edges[2 * i + 1] = i + 1;
    }
  }
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = DSW_LEVEL_EDGES_SWEPT;
  desc.positions = positions;
  desc.vertex_count = LINKS;
  desc.edges = edges;
  desc.edge_count = LINKS - 1;
  check(dsw_body_create(scene, &desc, &body) == DSW_STATUS_OK, "creating the catheter");
  return body;
}

/* Where the points are when a wave of narrowness has come so far: the wall, but not the outside, comes nearer to the axis. */
static void beat(const double *rest, double phase, double *next) {
  size_t i;
  for (i = 0; i < POINTS; ++i) {
    const double *from = rest + 3 * i;
    const double narrow = 0.4 * exp(-pow(from[2] - phase, 2));
    const int inside = fabs(from[0]) < 2 && fabs(from[1]) < 2;
    next[3 * i] = from[0] * (inside ? 1 - narrow : 1);
    next[3 * i + 1] = from[1] * (inside ? 1 - narrow : 1);
    next[3 * i + 2] = from[2];
  }
}

int main(void) {
  static double rest[3 * POINTS], arrays[2][3 * POINTS];
  dsw_environment *environment = create_vessel(rest);
  dsw_scene *scene = NULL;
  dsw_scene_desc desc;
  dsw_deform_options options;
  dsw_body_id catheter;
  double positions[3 * LINKS], nearest = 1e9;
  unsigned contacts = 0, pushed = 0, held = 0;
  size_t count = 0;
  int step, i;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  check(dsw_scene_create(environment, &desc, &scene) == DSW_STATUS_OK, "creating a scene");
  catheter = create_catheter(scene);
  dsw_deform_options_init(&options, sizeof options);
  options.response = DSW_WALL_PUSH;
  for (step = 0; step < STEPS; ++step) {
    /* The environment reads one array, the other one is written. */
    double *next = arrays[step % 2];
    dsw_deform_report report;
    beat(rest, -2 + 12.0 * step / (STEPS - 1), next);
    check(dsw_environment_deform(dsw_scene_get_environment(scene), next, POINTS, &options, &report) == DSW_STATUS_OK,
          "deforming");
    contacts += report.contact_count;
    pushed += report.pushed_count;
    held += report.held_count;
  }
  check(dsw_body_get_positions(scene, catheter, positions, LINKS, 0, NULL, &count) == DSW_STATUS_OK, "reading");
  for (i = 0; i < LINKS; ++i) nearest = positions[3 * i] < nearest ? positions[3 * i] : nearest;
  printf("%d steps: %u contacts of the wall, %u vertices pushed, %u wall vertices held\n", STEPS, contacts, pushed,
         held);
  printf("the catheter was pushed from 1.3 to %.3f from the axis\n", nearest);
  check(contacts > 0 && pushed > 0 && nearest < 1.0 && nearest > 0, "the wall pushes the catheter towards the axis");
  check(dsw_environment_check(environment, NULL) == DSW_STATUS_OK, "all volumes are valid");

  check(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroying the scene");
  check(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroying");
  return 0;
}
