/* Two soft rings collide in a box whose walls bend: they stop at each other and are pushed by the walls. */
#ifndef DARTSWEEP_DEMO_BOX_H
#define DARTSWEEP_DEMO_BOX_H

#include "changes.h"
#include "soft.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { kRings = 2 };

typedef struct demo_box {
  change_figures figures;
  demo_soft rings[kRings];
  demo_surface surfaces[kRings];
  dsw_environment *environment;
  dsw_scene *scene;
  double *rest, *lent[2]; /* points of the box: at rest; two arrays that the environment reads in turn */
  size_t point_count;
} demo_box;

void box_create(demo_box *box, dsw_context *context);
/* Bends the box and moves the rings so many times; after each all is proved free. */
void box_run(demo_box *box, size_t steps, FILE *csv);
/* Writes the box, the rings and their contacts. Returns 0 or kBadInput. */
int box_write(const demo_box *box, const char *out);
void box_destroy(demo_box *box);

#ifdef __cplusplus
}
#endif

#endif
