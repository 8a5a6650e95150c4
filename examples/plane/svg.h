/* Pictures of scenes in the plane, as SVG. */
#ifndef DARTSWEEP_PLANE_SVG_H
#define DARTSWEEP_PLANE_SVG_H

#include <dartsweep/dartsweep.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Where the plane lies in the picture; y points up in the plane. */
typedef struct svg_view {
  FILE *file;
  double left, top; /* of the picture: where `x`, `y` are */
  double x, y;      /* of the plane */
  double scale;     /* picture units for one of the plane */
} svg_view;

/* Opens DIRECTORY/NAME and begins a picture; ends the program if that fails. */
FILE *svg_open(const char *directory, const char *name, double width, double height);
void svg_close(FILE *file);

void svg_polygon(const svg_view *view, const double *points, size_t count, const char *style);
void svg_line(const svg_view *view, const double *points, size_t count, const char *style);
void svg_dot(const svg_view *view, const double *point, double radius, const char *style);
/* From `point`, `length` picture units along a unit normal. */
void svg_arrow(const svg_view *view, const double *point, const double *normal, double length, const char *style);
void svg_text(const svg_view *view, const double *point, const char *style, const char *text);

#ifdef __cplusplus
}
#endif

#endif
