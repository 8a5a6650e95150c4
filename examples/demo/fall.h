/* The second scene: a soft closed surface falls into cubes split into six pyramids each, of which some are impassable
 * ([JCD10] figure 12). */
#ifndef DARTSWEEP_DEMO_FALL_H
#define DARTSWEEP_DEMO_FALL_H

#include "soft.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct demo_fall {
  demo_soft soft;
  dsw_environment *environment;
  dsw_scene *scene;
  size_t cells, impassable;
  int still_free; /* created again where it ended, at its level */
} demo_fall;

void fall_create(demo_fall *fall, dsw_context *context, demo_surface *surface);
/* Lets it fall for so many steps. */
void fall_run(demo_fall *fall, size_t steps, FILE *csv);
void fall_destroy(demo_fall *fall);

#ifdef __cplusplus
}
#endif

#endif
