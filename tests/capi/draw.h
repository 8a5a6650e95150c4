/* What tests of rigid moves draw: numbers of one sequence, which g_state begins, and walls of a grid. */
#ifndef DARTSWEEP_TESTS_CAPI_DRAW_H
#define DARTSWEEP_TESTS_CAPI_DRAW_H

#include "check.h"
#include "fixture.h"

static uint64_t g_state;

/* At least 0, below 1. */
static inline double share(void) {
  g_state ^= g_state << 13;
  g_state ^= g_state >> 7;
  g_state ^= g_state << 17;
  return (double)(g_state >> 11) / 9007199254740992.0;
}
static inline double between(double low, double high) { return low + (high - low) * share(); }

/* Makes inner faces of a grid of n unit cubes, or squares, in each direction impassable. */
static inline void draw_walls(dsw_environment *env, unsigned dimension, unsigned n, int count) {
  int w;
  for (w = 0; w < count; ++w) {
    const unsigned x = (unsigned)(share() * (n - 1)), y = (unsigned)(share() * n), z = (unsigned)(share() * n);
    const unsigned axis = (unsigned)(share() * dimension);
    const unsigned cell[3] = {axis == 0 ? x : y, axis == 1 ? x : y, axis == 2 ? x : z};
    const uint32_t index = cell[0] + n * (cell[1] + n * (dimension == 3 ? cell[2] : 0));
    const uint32_t face = dimension == 3 ? 2 * axis + 1 : axis == 0 ? 1 : 2;
    CHECK_OK(set_face_mark(env, index, face, DSW_MARK_IMPASSABLE));
  }
}

#endif
