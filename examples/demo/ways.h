/* Ways over a graph of volumes: shortest ones, and the potential of a flow from the inlet to every end. */
#ifndef DARTSWEEP_DEMO_WAYS_H
#define DARTSWEEP_DEMO_WAYS_H

#include "flow.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Neighbours of slot i are link[first[i] .. first[i + 1] - 1]; hops counts the volumes between i
 * and the wall; flood sets it to 0 at the wall, to kNoSlot elsewhere. */
typedef struct demo_graph {
  size_t count, capacity;
  size_t *first;
  uint32_t *link;
  uint32_t *hops;
  const double *centre;
} demo_graph;

/* Completes hops. */
void count_hops(demo_graph *g);

/* Dijkstra's algorithm. `off_wall` makes ways near the wall dear. Fills cost and, if not null, the slot each way
 * comes from. Returns the farthest slot. */
uint32_t find_ways(const demo_graph *g, uint32_t start, int off_wall, double *cost, uint32_t *comes_from);

/* The slot where the cloud starts: next to the inlet, or the roomier of the two ends farthest apart. */
uint32_t find_start(const demo_graph *g, const demo_mesh *mesh, double *cost);

/* A potential that is 0 at the inlet, 1 at every end of a branch and in balance everywhere else. */
void find_potential(const demo_graph *g, const double *from_inlet, double length, double *potential);

/* Unit directions in which `values` rises (sign 1) or falls (sign -1), smoothed over the neighbours. */
void find_directions(const demo_graph *g, const double *values, double sign, double *direction);

double distance(const double *a, const double *b);

#ifdef __cplusplus
}
#endif

#endif
