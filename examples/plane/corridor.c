/* Three drawings of an edge p q in the plane: the polygons that it crosses, the turn of that corridor round a vertex when p
   moves a little, and the triangle that it sweeps up to a contact. */
#include "corridor.h"

#include <string.h>

#include "base.h"
#include "polygons.h"

enum { kWide = 9, kTall = 5, kMostCrossed = 64 };

static const char *const kOpenStyle = "fill=\"#fff\" stroke=\"#c3cbd5\" stroke-width=\"1\"";
static const char *const kSolidStyle = "fill=\"#8d99a6\" stroke=\"#5b6773\" stroke-width=\"1\"";
static const char *const kBefore = "fill=\"#9cc3ee\" stroke=\"#3b6fb6\" stroke-width=\"1\"";
static const char *const kAfter = "fill=\"#ffd98a\" stroke=\"#b98a1d\" stroke-width=\"1\"";
static const char *const kBoth = "fill=\"#bfe0b4\" stroke=\"#4f8a3d\" stroke-width=\"1\"";
static const char *const kEdge = "fill=\"none\" stroke=\"#c8321f\" stroke-width=\"3\"";
static const char *const kWay = "fill=\"none\" stroke=\"#c8321f\" stroke-width=\"1.5\" stroke-dasharray=\"2 5\"";
static const char *const kDot = "fill=\"#c8321f\"";
static const char *const kName = "font-size=\"20\" font-style=\"italic\"";

/* Triangles beside each other, none like the next. Those of square (5, 2) are solid if that is wanted. */
static void make_mesh(plane_mesh *mesh, int with_wall) {
  int x, y;
  mesh_clear(mesh);
  for (y = 0; y <= kTall; ++y) {
    for (x = 0; x <= kWide; ++x) {
      const int inner = x > 0 && x < kWide && y > 0 && y < kTall;
      const int a = (7 * x + 5 * y) % 9 - 4, b = (4 * x + 11 * y) % 9 - 4;
      mesh_point(mesh, x + (inner ? 0.0625 * a : 0), y + (inner ? 0.0625 * b : 0));
    }
  }
  for (y = 0; y < kTall; ++y) {
    for (x = 0; x < kWide; ++x) {
      const int64_t low = x + (kWide + 1) * y, high = low + kWide + 1;
      const int64_t one[2][3] = {{low, low + 1, high + 1}, {low, high + 1, high}};
      const int64_t other[2][3] = {{low, low + 1, high}, {low + 1, high + 1, high}};
      const int32_t region = with_wall && x == 5 && y == 2 ? kSolid : kOpen;
      int k;
      for (k = 0; k < 2; ++k) mesh_cell(mesh, (x + y) % 2 == 0 ? one[k] : other[k], 3, region);
    }
  }
}

static svg_view begin(const char *directory, const char *name, const plane_mesh *mesh) {
  svg_view view = {NULL, 10, 0, 0, 0, 60};
  view.top = 10 + kTall * view.scale;
  view.file = svg_open(directory, name, 20 + kWide * view.scale, 20 + kTall * view.scale);
  mesh_draw(mesh, &view, kOpenStyle, kSolidStyle);
  return view;
}

static void draw_cell(const plane_mesh *mesh, const svg_view *view, uint32_t cell, const char *style) {
  double corners[6];
  int i;
  for (i = 0; i < 3; ++i)
    memcpy(corners + 2 * i, mesh->points + 2 * mesh->corners[mesh->first[cell] + i], sizeof(double[2]));
  svg_polygon(view, corners, 3, style);
}

static void draw_edge(const svg_view *view, const double *p, const double *q, const char *style, const char *name) {
  double ends[4];
  memcpy(ends, p, sizeof(double[2]));
  memcpy(ends + 2, q, sizeof(double[2]));
  svg_line(view, ends, 2, style);
  if (name == NULL) return;
  svg_dot(view, p, 5, kDot);
  svg_dot(view, q, 5, kDot);
  ends[0] -= 0.3;
  svg_text(view, ends, kName, name);
  ends[2] += 0.15;
  svg_text(view, ends + 2, kName, "q");
}

/* Notes in `crossed`, by polygon, a bit for those that the edge crosses. Returns whether the edge is free. */
static int note_corridor(const dsw_environment *environment, const double *p, const double *q, int bit, int *crossed) {
  const dsw_volume_id anywhere = {0, 0};
  dsw_crossing crossings[kMostCrossed];
  dsw_flight flight;
  size_t count, i;
  require(dsw_environment_cast_path(environment, anywhere, p, q, NULL, crossings, kMostCrossed, &count, &flight),
          "casting an edge", kFailed);
  for (i = 0; i < count; ++i) crossed[crossings[i].volume.index] |= bit;
  return flight.outcome == DSW_OUTCOME_REACHED;
}

static int draw_corridors(const char *directory, const char *name, const double *p, const double *to, const double *q) {
  static plane_mesh mesh;
  static int crossed[kMostCells];
  dsw_environment *environment;
  svg_view view;
  int free;
  uint32_t cell;
  make_mesh(&mesh, 0);
  environment = mesh_environment(&mesh);
  view = begin(directory, name, &mesh);
  memset(crossed, 0, sizeof crossed);
  free = note_corridor(environment, p, q, 1, crossed) && note_corridor(environment, to, q, 2, crossed);
  for (cell = 0; cell < mesh.cell_count; ++cell) {
    if (crossed[cell] != 0)
      draw_cell(&mesh, &view, cell, crossed[cell] == 1 ? kBefore : crossed[cell] == 2 ? kAfter : kBoth);
  }
  if (p != to) {
    draw_edge(&view, p, to, kWay, NULL);
    draw_edge(&view, to, q, kEdge, "p'");
  }
  draw_edge(&view, p, q, kEdge, "p");
  svg_close(view.file);
  require(dsw_environment_destroy(environment), "destroying an environment", kFailed);
  return free;
}

static int draw_sweep(const char *directory, const double *p, const double *to, const double *q) {
  static plane_mesh mesh;
  const dsw_volume_id anywhere = {0, 0};
  dsw_environment *environment;
  dsw_sweep sweep;
  double triangle[6];
  svg_view view;
  make_mesh(&mesh, 1);
  environment = mesh_environment(&mesh);
  require(dsw_environment_sweep_edges(environment, 1, &anywhere, p, to, q, sizeof(double[2]), NULL, &sweep),
          "sweeping an edge", kFailed);
  view = begin(directory, "sweep.svg", &mesh);
  memcpy(triangle, p, sizeof(double[2]));
  memcpy(triangle + 2, to, sizeof(double[2]));
  memcpy(triangle + 4, q, sizeof(double[2]));
  svg_polygon(&view, triangle, 3, "fill=\"#c8321f\" fill-opacity=\"0.12\" stroke=\"none\"");
  draw_edge(&view, p, to, kWay, NULL);
  draw_edge(&view, to, q, kWay, "p'");
  draw_edge(&view, p, q, kEdge, "p");
  draw_edge(&view, sweep.position, q, "fill=\"none\" stroke=\"#b98a1d\" stroke-width=\"3\"", NULL);
  svg_dot(&view, sweep.position, 5, "fill=\"#b98a1d\"");
  svg_dot(&view, sweep.point, 6, "fill=\"#ffd33d\" stroke=\"#7a5c00\"");
  svg_arrow(&view, sweep.point, sweep.contact.normal, 40, "stroke=\"#7a5c00\" stroke-width=\"2\"");
  svg_close(view.file);
  require(dsw_environment_destroy(environment), "destroying an environment", kFailed);
  return sweep.outcome == DSW_OUTCOME_CONTACT;
}

int draw_edges(const char *directory) {
  static const double p[2] = {0.7, 1.4}, beside[2] = {0.7, 1.65}, q[2] = {8.3, 3.3};
  static const double low[2] = {0.7, 0.6}, high[2] = {0.7, 4.4}, fixed[2] = {8.3, 1.6};
  int good = draw_corridors(directory, "corridor.svg", p, p, q);
  good = draw_corridors(directory, "turn.svg", p, beside, q) && good;
  return draw_sweep(directory, low, high, fixed) && good;
}
