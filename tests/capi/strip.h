/* What the tests of topology.h share: 3 x 1 x 1 unit cubes or, in the plane, 3 x 1 unit squares along x. */
#ifndef DARTSWEEP_TESTS_CAPI_STRIP_H
#define DARTSWEEP_TESTS_CAPI_STRIP_H

#include "fixture.h"

enum { SIDE_RIGHT = 1, SIDE_UP = 2, SIDE_LEFT = 3 };

extern unsigned g_dimension;
extern dsw_environment *g_env;

void use_dimension(unsigned dimension);
void begin(void);
/* What changes must leave a partition of as much space as it was: `boundary` faces on the outside. */
void end(uint32_t volumes, uint32_t boundary);

/* In the plane z is 0. */
uint32_t corner_index(unsigned x, unsigned y, unsigned z);
dsw_vertex_id corner(unsigned x, unsigned y, unsigned z);
/* The face with these vertices. */
dsw_face_id find_face(unsigned count, const uint32_t *corners);
/* The face of the cells at x. */
dsw_face_id wall(unsigned x);
size_t change_count(void);

#endif
