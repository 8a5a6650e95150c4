/* 4 x 4 unit squares in the plane that bend, for tests of the C interface: a scene of theirs, and the two arrays of their points. */
#ifndef DARTSWEEP_TESTS_CAPI_BENDING_SQUARES_H
#define DARTSWEEP_TESTS_CAPI_BENDING_SQUARES_H

#include "fixture.h"

/* Square (x, y) is polygon x + 4 y, point (x, y) is vertex x + 5 y; two doubles each. */
enum { N = 4, POINTS = 25, SIDE_RIGHT = 1, SIDE_UP = 2 };

extern dsw_environment *g_env;
extern dsw_scene *g_scene;
extern double g_points[2][2 * POINTS];
extern int g_next; /* the array that may be written */

void begin(uint32_t features);
void end(void);

uint32_t square(uint32_t x, uint32_t y);
uint32_t vertex(uint32_t x, uint32_t y);
/* Where it is to go. */
double *point(uint32_t x, uint32_t y);
void raise_row(uint32_t y, double by);
/* A wall of the sides above the squares of a row. */
void mark_floor(uint32_t row);
dsw_body_id make_line(const double *positions, size_t count, dsw_level level);

/* Deforms to the array that may be written, which becomes the other one. */
dsw_deform_report deform(const dsw_deform_options *o);

#endif
