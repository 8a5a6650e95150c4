#include "svg.h"

#include <stdlib.h>

#include "base.h"
#include "output.h"

FILE *svg_open(const char *directory, const char *name, double width, double height) {
  FILE *file = output_open(directory, name);
  if (file == NULL) exit(kBadInput);
  fprintf(file,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\" "
          "stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<rect width=\"%g\" height=\"%g\" fill=\"#fff\"/>\n",
          width, height, width, height);
  return file;
}

void svg_close(FILE *file) {
  fprintf(file, "</svg>\n");
  if (ferror(file) != 0 || fclose(file) != 0) {
    fprintf(stderr, "cannot write a picture\n");
    exit(kFailed);
  }
}

static double across(const svg_view *view, const double *point) {
  return view->left + (point[0] - view->x) * view->scale;
}
static double down(const svg_view *view, const double *point) { return view->top - (point[1] - view->y) * view->scale; }

static void write_points(const svg_view *view, const char *shape, const double *points, size_t count,
                         const char *style) {
  size_t i;
  fprintf(view->file, "<%s points=\"", shape);
  for (i = 0; i < count; ++i) {
    fprintf(view->file, "%s%.2f,%.2f", i == 0 ? "" : " ", across(view, points + 2 * i), down(view, points + 2 * i));
  }
  fprintf(view->file, "\" %s/>\n", style);
}

void svg_polygon(const svg_view *view, const double *points, size_t count, const char *style) {
  write_points(view, "polygon", points, count, style);
}

void svg_line(const svg_view *view, const double *points, size_t count, const char *style) {
  write_points(view, "polyline", points, count, style);
}

void svg_dot(const svg_view *view, const double *point, double radius, const char *style) {
  fprintf(view->file, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%g\" %s/>\n", across(view, point), down(view, point), radius,
          style);
}

void svg_arrow(const svg_view *view, const double *point, const double *normal, double length, const char *style) {
  const double x = across(view, point), y = down(view, point), dx = length * normal[0], dy = 0 - length * normal[1];
  const double tip = 0.35;
  fprintf(view->file, "<path d=\"M%.2f %.2fl%.2f %.2fm%.2f %.2fl%.2f %.2fl%.2f %.2f\" fill=\"none\" %s/>\n", x, y, dx,
          dy, -tip * (dx - 0.6 * dy), -tip * (dy + 0.6 * dx), tip * (dx - 0.6 * dy), tip * (dy + 0.6 * dx),
          -tip * (dx + 0.6 * dy), -tip * (dy - 0.6 * dx), style);
}

void svg_text(const svg_view *view, const double *point, const char *style, const char *text) {
  fprintf(view->file, "<text x=\"%.2f\" y=\"%.2f\" %s>%s</text>\n", across(view, point), down(view, point), style,
          text);
}
