/* What the tests of deformations share: 4 x 4 x 4 unit cubes or, in the plane, 4 x 4 unit squares. */
#ifndef DARTSWEEP_TESTS_CAPI_BENDING_H
#define DARTSWEEP_TESTS_CAPI_BENDING_H

#include "fixture.h"

/* `h` is height: z, or in the plane y, where there is no other y. */
enum { N = 4, MOST_POINTS = 125, SIDE_UP = 2 };

extern unsigned g_dimension, g_up; /* g_up: the coordinate of heights */
extern dsw_environment *g_env;
extern dsw_scene *g_scene;
extern size_t g_point_count;
extern double g_points[2][3 * MOST_POINTS]; /* the numbers of an array are one behind the other */
extern int g_next;                          /* the array that may be written */

void use_dimension(unsigned dimension);
void begin(uint32_t features);
void end(void);

uint32_t cell(uint32_t x, uint32_t y, uint32_t h);
uint32_t vertex(uint32_t x, uint32_t y, uint32_t h);
/* Where a vertex is to go. */
double *point(uint32_t x, uint32_t y, uint32_t h);
double *next_points(void);
/* All vertices of a height. */
void raise_row(uint32_t h, double by);
void set_row(uint32_t h, double to);
/* A wall of the faces above the cells of a row. */
void mark_floor(uint32_t row);
/* In the plane drops the y of each of some points of three doubles. */
double *flat(double *xyz, size_t count);
dsw_body_id make_line(const double *positions, size_t count, dsw_level level);

/* Deforms to the array that may be written, which becomes the other one. */
dsw_deform_report deform(const dsw_deform_options *o);

#endif
