/* What the tests of cuts share: a block of 4 x 4 x 4 cubes or, in the plane, of 4 x 4 squares, and blades. */
#ifndef DARTSWEEP_TESTS_CAPI_BLOCK_H
#define DARTSWEEP_TESTS_CAPI_BLOCK_H

#include "fixture.h"

/* The numbers of the block, by dimension. */
typedef struct block_numbers {
  unsigned dimension;
  uint32_t cells;    /* 64 or 16 */
  uint32_t boundary; /* faces on the outer boundary: 96 or 16 */
  uint32_t layer;    /* cells that a blade right through the block crosses: 16 or 4 */
  uint32_t corners;  /* vertices of such a cut: 25 or 5 */
  uint32_t rim;      /* faces of the boundary that such a cut splits: 16 or 2 */
  uint32_t x0,
      y1; /* local numbers of a cell's faces at its low x and at its high y; the face at high x is number 1 of both */
} block_numbers;

extern block_numbers g_block;
extern dsw_environment *g_env;
/* Points of the last blade: two rows of two points, in the plane two points. */
extern double g_blade[12];
/* The report of the last cut by `cut`, and the faces that keep_faces kept. */
extern dsw_change g_cut;
extern dsw_cut_face g_faces[64];

/* Chooses the dimension of the block from here on; failures name it. */
void use_block(unsigned dimension);
/* Creates the environment g_env. Its points stay alive until end_block, for flags that borrow them. */
void begin_block(dsw_context *context, double size, uint32_t flags);
/* The block must have become this many volumes in this many parts; destroys it. */
void end_block(uint32_t volumes, uint32_t boundary, uint32_t parts);
void drop_block(void);

/* A blade at x, from below everything up to y_end; its front is on the right. */
dsw_cut_desc blade_at(double x, double y_end);
void cut(dsw_cut_desc d, uint32_t flags);
size_t keep_faces(void);
double x_of(dsw_vertex_id vertex);
/* How far a flight gets. */
double fly_between(const double *from, const double *to);
/* In space z goes from 1.4 to 1.6. */
double fly(double x, double y, double to_x, double to_y);
/* Flies downwards in the plane; in space y goes from 1.4 to 1.6, and z from `height` to `to_height`. */
double fly_down(double x, double height, double to_x, double to_height);

#endif
