/* A floor rises under a rod that lies aslant, drawn for each way to bend an environment. */
#include "bends.h"

#include <string.h>

#include "base.h"
#include "polygons.h"

enum { kWide = 9, kTall = 7, kFloor = 2, kRod = 5, kPanels = 6 };

static const double kRise = 2;
static const double kPanelWidth = 230, kPanelHeight = 215;
static const char *const kOpenStyle = "fill=\"#fff\" stroke=\"#d9dfe6\" stroke-width=\"1\"";
static const char *const kSolidStyle = "fill=\"#8d99a6\" stroke=\"#5b6773\" stroke-width=\"1\"";
static const char *const kRodStyle = "fill=\"none\" stroke=\"#c8321f\" stroke-width=\"3\"";
static const char *const kBeforeStyle =
    "fill=\"none\" stroke=\"#c8321f\" stroke-width=\"1.5\" stroke-dasharray=\"2 5\"";
static const char *const kNameStyle = "font-size=\"13\"";

typedef enum bend { kBefore, kSwept, kEndState, kAll, kFeature, kSlide } bend;

typedef struct panel {
  plane_mesh mesh;
  dsw_environment *environment;
  dsw_scene *scene;
  dsw_body_id rod;
  double rise[2 * (kWide + 1) * (kTall + 1)];
  double at[2 * kRod];
} panel;

static void make_mesh(plane_mesh *mesh) {
  int x, y;
  mesh_clear(mesh);
  for (y = 0; y <= kTall; ++y) {
    for (x = 0; x <= kWide; ++x) mesh_point(mesh, x, y);
  }
  for (y = 0; y < kTall; ++y) {
    for (x = 0; x < kWide; ++x) {
      const int64_t low = x + (kWide + 1) * y, high = low + kWide + 1;
      const int64_t corners[4] = {low, low + 1, high + 1, high};
      mesh_cell(mesh, corners, 4, y < kFloor ? kSolid : kOpen);
    }
  }
}

/* The floor's top goes up by kRise; what is below and above gets longer or shorter. */
static void raise_floor(const plane_mesh *mesh, double *next) {
  size_t i;
  for (i = 0; i < mesh->point_count; ++i) {
    const double y = mesh->points[2 * i + 1];
    next[2 * i] = mesh->points[2 * i];
    next[2 * i + 1] = y + kRise * (y < kFloor ? y / kFloor : (kTall - y) / (kTall - kFloor));
  }
}

static void begin_panel(panel *of) {
  uint32_t edges[2 * (kRod - 1)], i;
  dsw_scene_desc scene;
  dsw_body_desc body;
  make_mesh(&of->mesh);
  of->environment = mesh_environment(&of->mesh);
  dsw_scene_desc_init(&scene, sizeof scene);
  scene.features = DSW_FEATURE_DEFORMING;
  require(dsw_scene_create(of->environment, &scene, &of->scene), "creating a scene", kFailed);
  for (i = 0; i < kRod; ++i) {
    of->at[2 * i] = 2.7 + 0.9 * i;
    of->at[2 * i + 1] = 2.6 + 0.25 * i;
    if (i + 1 == kRod) break;
    edges[2 * i] = i;
    edges[2 * i + 1] = i + 1;
  }
  dsw_body_desc_init(&body, sizeof body);
  body.level = DSW_LEVEL_EDGES_SWEPT;
  body.positions = of->at;
  body.vertex_count = kRod;
  body.edges = edges;
  body.edge_count = kRod - 1;
  require(dsw_body_create(of->scene, &body, &of->rod), "creating the rod", kFailed);
  raise_floor(&of->mesh, of->rise);
}

static void bend_alone(panel *of, dsw_deform_method method) {
  dsw_deform_options options;
  dsw_deform_options_init(&options, sizeof options);
  options.method = method;
  require(dsw_environment_deform(of->environment, of->rise, of->mesh.point_count, &options, NULL), "raising the floor",
          kFailed);
}

/* The rod's targets are where it is. */
static void bend_with_rod(panel *of, dsw_together_stop stop, dsw_together_response response) {
  dsw_scene_deform_options options;
  dsw_scene_deform_options_init(&options, sizeof options);
  options.stop = stop;
  options.response = response;
  require(
      dsw_scene_deform(of->scene, of->rise, of->mesh.point_count, &of->rod, 1, of->at, kRod, 0, &options, NULL, NULL),
      "raising the floor and the rod", kFailed);
}

static void bend_panel(panel *of, bend how) {
  size_t count;
  switch (how) {
    case kBefore:
      return;
    case kSwept:
      bend_alone(of, DSW_DEFORM_SWEPT);
      break;
    case kEndState:
      bend_alone(of, DSW_DEFORM_END_STATE);
      break;
    case kAll:
      bend_with_rod(of, DSW_TOGETHER_STOP_ALL, DSW_TOGETHER_RESPONSE_STOP);
      break;
    case kFeature:
      bend_with_rod(of, DSW_TOGETHER_STOP_FEATURE, DSW_TOGETHER_RESPONSE_STOP);
      break;
    case kSlide:
      bend_with_rod(of, DSW_TOGETHER_STOP_FEATURE, DSW_TOGETHER_RESPONSE_SLIDE);
      break;
  }
  memcpy(of->mesh.points, of->rise, 2 * of->mesh.point_count * sizeof(double));
  require(dsw_body_get_positions(of->scene, of->rod, of->at, kRod, 0, NULL, &count), "reading the rod", kFailed);
}

/* Returns how far the middle of the floor and the middle of the rod have risen. */
static void draw_panel(FILE *file, bend how, const char *name, double *floor_risen, double *rod_risen) {
  static panel of;
  double before[2 * kRod];
  const double name_at[2] = {0, kTall + 0.35};
  svg_view view = {NULL, 10, 0, 0, 0, 23};
  begin_panel(&of);
  memcpy(before, of.at, sizeof before);
  bend_panel(&of, how);
  view.file = file;
  view.left = 10 + kPanelWidth * (how % 3);
  view.top = kPanelHeight * (1 + how / 3) - 5;
  mesh_draw(&of.mesh, &view, kOpenStyle, kSolidStyle);
  if (how != kBefore) svg_line(&view, before, kRod, kBeforeStyle);
  svg_line(&view, of.at, kRod, kRodStyle);
  svg_text(&view, name_at, kNameStyle, name);
  *floor_risen = of.mesh.points[2 * (kFloor * (kWide + 1) + kWide / 2) + 1] - kFloor;
  *rod_risen = of.at[1] - before[1];
  require(dsw_scene_destroy(of.scene), "destroying a scene", kFailed);
  require(dsw_environment_destroy(of.environment), "destroying an environment", kFailed);
}

int draw_bends(const char *directory) {
  static const char *const names[kPanels] = {"before",   "SWEPT, PUSH",        "END_STATE",
                                             "STOP_ALL", "STOP_FEATURE, STOP", "STOP_FEATURE, SLIDE"};
  double floors[kPanels], rods[kPanels];
  FILE *const file = svg_open(directory, "bends.svg", 3 * kPanelWidth, 2 * kPanelHeight + 5);
  int i;
  for (i = 0; i < kPanels; ++i) draw_panel(file, (bend)i, names[i], &floors[i], &rods[i]);
  svg_close(file);
  return floors[kSwept] == kRise && rods[kSwept] > 1 && floors[kSlide] == kRise && rods[kSlide] > 1 &&
         floors[kAll] < kRise && rods[kAll] == 0 && floors[kFeature] < kRise && rods[kFeature] == 0;
}
