/* A city: houses are octagons, streets are the convex polygons between them. A snake-like chain follows its head through it; what touches a
 * corner slides along. */
#include "city.h"

#include <math.h>
#include <string.h>

#include "base.h"
#include "chain.h"
#include "polygons.h"

enum { kHouses = 7, kLinks = 60, kSteps = 900, kCorners = 8 };

static const double kHouse = 1.0, kStreet = 0.3, kCut = 0.2, kLink = 0.12, kSpeed = 0.02;

/* Gives a small offset; the picture is the same each time, whatever the machine. */
static double jitter(uint32_t *state) {
  *state = *state * 1664525u + 1013904223u;
  return ((double)(*state >> 8) / 16777216.0 - 0.5) * 0.16;
}

/* Corners of a house, counter-clockwise from the lower left one: two where each corner of a square is cut off. */
static void add_house(plane_mesh *mesh, double x, double y, uint32_t *state, int64_t *corners) {
  static const double signs[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  int k;
  for (k = 0; k < 4; ++k) {
    const double cx = x + kHouse * signs[k][0] + jitter(state), cy = y + kHouse * signs[k][1] + jitter(state);
    const double dx = signs[k][0] > 0 ? -kCut : kCut, dy = signs[k][1] > 0 ? -kCut : kCut;
    /* Walking round, the first of the two lies on the side that is walked along. */
    const int along_x = k % 2 == 1;
    corners[2 * k] = mesh_point(mesh, along_x ? cx + dx : cx, along_x ? cy : cy + dy);
    corners[2 * k + 1] = mesh_point(mesh, along_x ? cx : cx + dx, along_x ? cy + dy : cy);
  }
}

static void build_city(plane_mesh *mesh) {
  int64_t houses[kHouses][kHouses][kCorners];
  uint32_t state = 7;
  int i, j;
  mesh_clear(mesh);
  for (j = 0; j < kHouses; ++j) {
    for (i = 0; i < kHouses; ++i) {
      add_house(mesh, (kHouse + kStreet) * i, (kHouse + kStreet) * j, &state, houses[j][i]);
      mesh_cell(mesh, houses[j][i], kCorners, kSolid);
    }
  }
  for (j = 0; j < kHouses; ++j) {
    for (i = 0; i < kHouses; ++i) {
      const int64_t *const h = houses[j][i];
      if (i + 1 < kHouses) {
        const int64_t *const r = houses[j][i + 1];
        const int64_t street[4] = {h[3], r[0], r[7], h[4]};
        mesh_cell(mesh, street, 4, kOpen);
      }
      if (j + 1 < kHouses) {
        const int64_t *const u = houses[j + 1][i];
        const int64_t street[4] = {h[6], h[5], u[2], u[1]};
        mesh_cell(mesh, street, 4, kOpen);
      }
      if (i + 1 < kHouses && j + 1 < kHouses) {
        const int64_t *const r = houses[j][i + 1], *const u = houses[j + 1][i], *const d = houses[j + 1][i + 1];
        const int64_t crossing[8] = {h[4], r[7], r[6], d[1], d[0], u[3], u[2], h[5]};
        mesh_cell(mesh, crossing, 8, kOpen);
      }
    }
  }
}

/* Crossing (i, j) lies up and to the right of house (i, j). */
static void crossing(int i, int j, double *point) {
  point[0] = (kHouse + kStreet) * i + kHouse + kStreet / 2;
  point[1] = (kHouse + kStreet) * j + kHouse + kStreet / 2;
}

/* `to` at a distance from `from`, in its direction. */
static void pull(const double *from, const double *to, double distance, double *out) {
  const double dx = to[0] - from[0], dy = to[1] - from[1], length = sqrt(dx * dx + dy * dy);
  const double share = length > 0 ? distance / length : 0;
  out[0] = from[0] + share * dx;
  out[1] = from[1] + share * dy;
}

scene_figures draw_city(const char *directory) {
  static const int route[][2] = {{0, 0}, {1, 0}, {1, 2}, {3, 2}, {3, 1}, {5, 1}, {5, 4}, {2, 4}, {2, 5}, {0, 5}};
  static plane_mesh mesh;
  static chain snake;
  double positions[2 * kLinks], head[2], corner[2], target[2 * kMostLinks];
  size_t next = 2, v;
  int step;
  scene_figures figures = {0, 0, 0, 0};
  dsw_environment *environment;
  dsw_scene *scene = NULL;
  dsw_move_options options;
  svg_view view = {NULL, 20, 980, -0.2, -0.2, 1};

  build_city(&mesh);
  environment = mesh_environment(&mesh);
  require(dsw_scene_create(environment, NULL, &scene), "creating a scene", kFailed);
  view.scale = 960 / ((kHouse + kStreet) * (int)kHouses + 0.1);
  view.file = svg_open(directory, "city.svg", 1000, 1000);
  mesh_draw(&mesh, &view, "fill=\"#fff\" stroke=\"#d5dbe3\" stroke-width=\"0.7\"",
            "fill=\"#8d99a6\" stroke=\"#5b6773\" stroke-width=\"1.2\"");

  /* It begins folded up in the first street. */
  crossing(route[0][0], route[0][1], corner);
  for (v = 0; v < kLinks; ++v) {
    positions[2 * v] = corner[0] + 0.02 * kLink * (double)(v % 2);
    positions[2 * v + 1] = corner[1] - 0.0005 * (double)v;
  }
  chain_create(&snake, scene, positions, kLinks);
  dsw_move_options_init(&options, sizeof options);
  options.vertex_response = DSW_RESPONSE_SLIDE;
  options.edge_response = DSW_RESPONSE_SLIDE;
  for (step = 0; step < kSteps && next < sizeof route / sizeof route[0] + 1; ++step) {
    dsw_move_report report;
    crossing(route[next - 1][0], route[next - 1][1], corner);
    memcpy(head, snake.positions, sizeof head);
    pull(head, corner, kSpeed, target);
    for (v = 1; v < snake.vertex_count; ++v) {
      const double dx = snake.positions[2 * v] - target[2 * v - 2], dy = snake.positions[2 * v + 1] - target[2 * v - 1];
      const int slack = dx * dx + dy * dy <= kLink * kLink;
      if (slack) {
        memcpy(target + 2 * v, snake.positions + 2 * v, 2 * sizeof *target);
      } else {
        pull(target + 2 * v - 2, snake.positions + 2 * v, kLink, target + 2 * v);
      }
    }
    report = chain_move(&snake, target, &options);
    figures.steps += 1;
    figures.contacts += report.contact_count;
    figures.free_steps += chain_count_free(&snake) == snake.edge_count;
    if (step % 150 == 149) chain_draw(&snake, &view, "stroke=\"#f2a65a\" stroke-width=\"3\" fill=\"none\"");
    if (hypot(snake.positions[0] - corner[0], snake.positions[1] - corner[1]) < 2 * kSpeed) ++next;
  }
  chain_draw(&snake, &view, "stroke=\"#c8321f\" stroke-width=\"4\" fill=\"none\"");
  svg_dot(&view, snake.positions, 6, "fill=\"#c8321f\"");
  chain_draw_contacts(&snake, &view, "stroke=\"#1a7f37\" stroke-width=\"2\"");
  svg_close(view.file);
  require(dsw_scene_destroy(scene), "destroying a scene", kFailed);
  require(dsw_environment_destroy(environment), "destroying an environment", kFailed);
  return figures;
}
