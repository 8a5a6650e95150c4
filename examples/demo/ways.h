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

/* Marks the ends of branches: slots farther from the start than all around them, at the tip of a branch that is long
 * enough to be one and no bump of the wall. `from` is the way from the start, `length` the longest. */
void find_ends(const demo_graph *g, const double *from, double length, char *is_end);

/* The slots that belong to an end: nearly as far and connected. `seen` slots are left out, and marked. */
size_t find_end_slots(const demo_graph *g, const double *from, double length, uint32_t end, char *seen,
                      uint32_t *slots);

/* A potential in balance between the inlet and the ends of branches, where it is as high as the way from the inlet is
 * long, so that long branches get their share. `zone` is the length of the way that still belongs to the inlet. */
void find_potential(const demo_graph *g, const double *from_inlet, double length, double zone, double *potential);

/* Unit directions in which `values` rises (sign 1) or falls (sign -1), smoothed over the
 * neighbours that many rounds. */
void find_directions(const demo_graph *g, const double *values, double sign, int rounds, double *direction);

#ifdef __cplusplus
}
#endif

#endif
