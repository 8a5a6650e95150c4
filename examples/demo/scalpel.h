/* A scalpel cuts an organ that lies in air, step by step, on both sides of a wedge; that is taken out, and a probe is pushed in to the
 * floor of the cut. */
#ifndef DARTSWEEP_DEMO_SCALPEL_H
#define DARTSWEEP_DEMO_SCALPEL_H

#include "changes.h"
#include "mesh.h"
#include "soft.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { kMostCuts = 50, kMostStations = 200 };

typedef struct demo_scalpel {
  change_figures figures;
  body_figures probe_figures;
  dsw_environment *environment;
  dsw_scene *scene;
  dsw_body_id probe;
  demo_surface surface; /* of the probe; its points follow the body */
  size_t tissue_volumes;
  /* The organ's own axes, the longest first, the shortest up; its middle and its size along these. */
  int axis[3];
  double middle[3], size[3];
  /* The blades of both sides, their edges from above the surface of the organ down to the floor of the cut, at places one after the
   * other: 6 doubles each. */
  size_t stations;
  double blades[2][6 * kMostStations];
  double first, centre[3]; /* the air's first layer is the organ's surface times `first` from `centre` */
  size_t split, opened;    /* volumes split, and made passable */
  double distance;         /* of the cut from the blade, the largest */
  double start, depth,
      reached; /* height of the surface; how deep below it the cut's floor is, and the probe's tip at the end */
} demo_scalpel;

/* Puts the organ in air, and the probe above it. */
void scalpel_create(demo_scalpel *scalpel, dsw_context *context, const demo_mesh *organ);
/* Cuts in so many steps, opens the cut, pushes the probe in; after each step the probe is proved free. */
void scalpel_run(demo_scalpel *scalpel, size_t steps, FILE *csv);
/* Writes the organ, blade, probe and contacts. Returns 0 or kBadInput. */
int scalpel_write(const demo_scalpel *scalpel, const char *out);
void scalpel_destroy(demo_scalpel *scalpel);

#ifdef __cplusplus
}
#endif

#endif
