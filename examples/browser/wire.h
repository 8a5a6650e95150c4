/* The wire without its walls: where its vertices would go. Lengths are kept, the wire bends like a rod, its tip is bent at rest,
 * and near rows of the library push it away from walls. */
#ifndef DARTSWEEP_BROWSER_WIRE_H
#define DARTSWEEP_BROWSER_WIRE_H

#include <dartsweep/dartsweep.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { kMostVertices = 200, kMostRows = 512, kHeld = 2 };

/* Vertices from the tip to the hand; the last kHeld of them are in the hand. */
typedef struct wire {
  double at[3 * kMostVertices], target[3 * kMostVertices];
  size_t count;
  double link, radius, most; /* most: that a vertex goes in a step, and the margin of the near rows */
  double entry[3], direction[3];
  double in;                 /* how far the last vertex is in, below a link */
  double cosine, sine;       /* of the angle by which the hand has turned the wire */
  double impulse[kMostRows]; /* of each near row */
} wire;

/* Near rows as the library gives them. */
typedef struct wire_rows {
  const dsw_near_row *rows;
  const uint32_t *offsets, *columns;
  const double *values;
  size_t count;
} wire_rows;

/* A straight wire of `count` vertices in the hand. */
void wire_create(wire *w, const double *entry, const double *direction, double radius, double link, size_t count);

void wire_turn(wire *w, double angle);

/* How much longer the wire is than at rest, over its length. */
double wire_stretch(const wire *w);

/* Finds targets for a wire whose hand moves by `push`. */
void wire_find_targets(wire *w, double push, const wire_rows *rows);

#ifdef __cplusplus
}
#endif

#endif
