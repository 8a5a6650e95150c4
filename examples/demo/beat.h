/* A catheter is pushed into a vessel that beats: its wall narrows and widens in waves, and squeezes the catheter. */
#ifndef DARTSWEEP_DEMO_BEAT_H
#define DARTSWEEP_DEMO_BEAT_H

#include "catheter.h"
#include "changes.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct demo_beat {
  change_figures figures;
  demo_catheter catheter;
  dsw_environment *environment; /* borrowed, for this scene alone */
  double *rest, *lent[2];       /* points: at rest; two arrays that the environment reads in turn */
  double *inward, *along; /* of each point: the way to the middle of the vessel, and how far from the inlet that is */
  size_t point_count;
  double radius, length; /* of the lumen; of the way that beats */
  size_t squeezed;       /* steps in which the wall pushed the catheter */
} demo_beat;

/* Finds out how `environment` beats: along the way of `flow`, which may come from another environment of the same mesh. */
void beat_create(demo_beat *beat, dsw_environment *environment, const demo_flow *flow);
/* Bends the vessel and pushes the catheter in so many times; after each the catheter is proved free. */
void beat_run(demo_beat *beat, const demo_flow *flow, size_t steps, FILE *csv);
/* Writes wall, catheter and contacts of the wall. Returns 0 or kBadInput. */
int beat_write(const demo_beat *beat, const char *out, int with_boundary);
void beat_destroy(demo_beat *beat);

#ifdef __cplusplus
}
#endif

#endif
