/* What the tests of bodies share: 4 x 4 x 3 unit cubes or, in the plane, 4 x 4 unit squares. */
#ifndef DARTSWEEP_TESTS_CAPI_STAGE_H
#define DARTSWEEP_TESTS_CAPI_STAGE_H

#include "fixture.h"

/* Cells along x and y; along z 3. Cell (x, y, z) is number x + N * (y + N * z), a square number x + N * y. Sides of
   squares by number. */
enum { N = 4, SIDE_RIGHT = 1, SIDE_UP = 2, SIDE_LEFT = 3 };

extern unsigned g_dimension;
extern dsw_environment *g_env;
extern dsw_scene *g_scene;
/* Bytes between points of three doubles, as arguments: 0 in space; in the plane, where the third is not read, 24. */
extern size_t g_stride;
/* The cell at (2, 1, 1). */
extern uint32_t g_pillar;
/* Two points left of the pillar, 0 below and 1 above its row, and right of it. */
extern const double g_left[6], g_right[6];

void begin_stage(unsigned dimension);
void end_stage(void);
dsw_level top_level(void);

uint32_t point_at(uint32_t x, uint32_t y);
dsw_status mark_cell(uint32_t index, dsw_mark mark);
dsw_status mark_face(uint32_t volume, uint32_t local, dsw_mark mark);
dsw_status mark_point(uint32_t x, uint32_t y, dsw_mark mark);
void mark_pillar(dsw_mark mark);

/* A polyline of points of three doubles each. */
dsw_body_id make_line(const double *positions, size_t count, dsw_level level);
dsw_move_report move(dsw_body_id body, const double *targets, size_t count, const dsw_move_options *o);
/* Three doubles each, the last one in the plane 0. */
size_t positions_of(dsw_body_id body, double *p, size_t capacity);
/* Whether a point is this one: in the plane x and y are compared, and the third number is 0. */
int is_point(const double *p, const double *wanted);
int is_at(dsw_body_id body, const double *wanted, size_t count);
size_t contacts_of(dsw_body_id body, const dsw_body_contact **contacts);
size_t edits_of(dsw_body_id body, const dsw_body_edit **edits);
size_t body_count(void);
/* A description that is refused: the message has `text`, nothing is created. */
void refuses(dsw_status status, const dsw_body_desc *d, const char *text);
dsw_body_counts counts_of(dsw_body_id body);
int has(dsw_body_id body, uint32_t vertices, uint32_t edges, uint32_t faces);

/* Ids of the first generation. */
dsw_body_vertex_id vertex_id(uint32_t index);
dsw_body_edge_id edge_id(uint32_t index);
dsw_body_face_id face_id(uint32_t index);

#endif
