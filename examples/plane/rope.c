/* A rope falls on hexagons, in one move: the panels of figure 5 [JCD10] 4.2, each with a response of its own. */
#include <math.h>
#include <string.h>

#include "base.h"
#include "chain.h"
#include "city.h"
#include "polygons.h"

enum { kColumns = 24, kRows = 12, kRope = 4 };

static const double kHeight = 0.8660254037844386; /* of an equilateral triangle */

/* The rope's vertices fall between the obstacles, its edges on them; or one vertex falls on an obstacle. */
static const double kBetween[kRope] = {0.8, 10.6, 13.7, 23.3}, kOnto[kRope] = {0.8, 8.2, 15.4, 23.3};
static const uint32_t kOne = 1;
static const double kFall = 7.4;

/* Triangles round lattice points (i, j) of a lattice are solid where one of these stands. */
static const int kObstacles[][2] = {{4, 3}, {8, 6}, {12, 2}, {15, 5}, {19, 4}};

static void lattice_point(int i, int j, double *point) {
  point[0] = i + 0.5 * (j % 2);
  point[1] = kHeight * j;
}

static int32_t region_of(const double *a, const double *b, const double *c) {
  size_t k;
  for (k = 0; k < sizeof kObstacles / sizeof kObstacles[0]; ++k) {
    double centre[2];
    lattice_point(kObstacles[k][0], kObstacles[k][1], centre);
    if (memcmp(a, centre, sizeof centre) == 0 || memcmp(b, centre, sizeof centre) == 0 ||
        memcmp(c, centre, sizeof centre) == 0) {
      return kSolid;
    }
  }
  return kOpen;
}

static void add_triangle(plane_mesh *mesh, int64_t a, int64_t b, int64_t c) {
  const double *const p = mesh->points;
  const int64_t corners[3] = {a, b, c};
  mesh_cell(mesh, corners, 3, region_of(p + 2 * a, p + 2 * b, p + 2 * c));
}

static void build_lattice(plane_mesh *mesh) {
  int i, j;
  mesh_clear(mesh);
  for (j = 0; j <= kRows; ++j) {
    for (i = 0; i <= kColumns; ++i) {
      double point[2];
      lattice_point(i, j, point);
      mesh_point(mesh, point[0], point[1]);
    }
  }
  for (j = 0; j < kRows; ++j) {
    for (i = 0; i < kColumns; ++i) {
      const int64_t a = (int64_t)(kColumns + 1) * j + i, b = a + 1, c = a + kColumns + 1, d = c + 1;
      if (j % 2 == 0) {
        add_triangle(mesh, a, b, c);
        add_triangle(mesh, b, d, c);
      } else {
        add_triangle(mesh, a, b, d);
        add_triangle(mesh, a, d, c);
      }
    }
  }
}

static void fall(dsw_environment *environment, const svg_view *view, const double *across, dsw_response response,
                 scene_figures *figures) {
  static chain rope;
  dsw_scene *scene = NULL;
  dsw_move_options options;
  dsw_move_report report;
  double positions[2 * kRope], target[2 * kRope];
  size_t v;
  for (v = 0; v < kRope; ++v) {
    positions[2 * v] = target[2 * v] = across[v];
    positions[2 * v + 1] = kHeight * ((int)kRows - 2.5) + 0.05 * across[v];
    target[2 * v + 1] = positions[2 * v + 1] - (across == kOnto && v != kOne ? 0 : kFall);
  }
  require(dsw_scene_create(environment, NULL, &scene), "creating a scene", kFailed);
  chain_create(&rope, scene, positions, kRope);
  chain_draw(&rope, view, "stroke=\"#3b6fb6\" stroke-width=\"1.5\" stroke-dasharray=\"5 4\"");
  for (v = 0; v < kRope; ++v) {
    const double way[4] = {positions[2 * v], positions[2 * v + 1], target[2 * v], target[2 * v + 1]};
    svg_line(view, way, 2, "stroke=\"#3b6fb6\" stroke-width=\"1\" stroke-dasharray=\"1 4\"");
  }
  dsw_move_options_init(&options, sizeof options);
  options.edge_response = response;
  options.min_part = 0.05;
  if (across == kOnto) options.order = &kOne, options.order_count = 1;
  report = chain_move(&rope, target, &options);
  figures->steps += 1;
  figures->contacts += report.contact_count;
  figures->inserted += report.edit_count;
  figures->free_steps += chain_count_free(&rope) == rope.edge_count;
  chain_draw(&rope, view, "stroke=\"#c8321f\" stroke-width=\"2.5\"");
  for (v = 0; v < rope.vertex_count; ++v) {
    svg_dot(view, rope.positions + 2 * v, v < kRope ? 4 : 3.5,
            v < kRope ? "fill=\"#c8321f\"" : "fill=\"#ffd33d\" stroke=\"#7a5c00\"");
  }
  chain_draw_contacts(&rope, view, "stroke=\"#1a7f37\" stroke-width=\"1.5\"");
  require(dsw_scene_destroy(scene), "destroying a scene", kFailed);
}

scene_figures draw_rope(const char *directory) {
  static const struct {
    const double *across;
    dsw_response response;
    const char *title;
  } kPanels[] = {{kOnto, DSW_RESPONSE_STOP, "a vertex stops"},
                 {kBetween, DSW_RESPONSE_STOP, "static: edges stop"},
                 {kBetween, DSW_RESPONSE_ADAPTIVE_ONE, "adaptive, one vertex after the other"},
                 {kBetween, DSW_RESPONSE_ADAPTIVE_MANY, "adaptive, a vertex at each obstacle under the edge"},
                 {kBetween, DSW_RESPONSE_HYBRID, "hybrid: one vertex, then static"},
                 {kBetween, DSW_RESPONSE_SLIDE, "slide (not in the paper)"}};
  enum { kPanelCount = sizeof kPanels / sizeof kPanels[0], kWidth = 690, kTall = 330 };
  static plane_mesh mesh;
  scene_figures figures = {0, 0, 0, 0};
  svg_view view = {NULL, 0, 0, 0, 0, 27};
  dsw_environment *environment;
  int panel;
  build_lattice(&mesh);
  environment = mesh_environment(&mesh);
  view.file = svg_open(directory, "rope.svg", 2 * kWidth + 10, (kPanelCount + 1) / 2 * kTall);
  for (panel = 0; panel < kPanelCount; ++panel) {
    const double title[2] = {0, kHeight * (int)kRows + 0.4};
    view.left = kWidth * (panel % 2) + 15;
    view.top = kTall * (panel / 2 + 1) - 8;
    svg_text(&view, title, "font-size=\"18\"", kPanels[panel].title);
    mesh_draw(&mesh, &view, "fill=\"#fff\" stroke=\"#d5dbe3\" stroke-width=\"0.7\"",
              "fill=\"#8d99a6\" stroke=\"#5b6773\" stroke-width=\"1\"");
    fall(environment, &view, kPanels[panel].across, kPanels[panel].response, &figures);
  }
  svg_close(view.file);
  require(dsw_environment_destroy(environment), "destroying an environment", kFailed);
  return figures;
}
