/* Where the lumen leads: directions for the cloud and the catheters, found by walking from volume to volume. */
#ifndef DARTSWEEP_DEMO_FLOW_H
#define DARTSWEEP_DEMO_FLOW_H

#include <dartsweep/dartsweep.h>

#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Volumes that the cloud can reach, by slot 0 .. count-1, nearest to the inlet first. */
typedef struct demo_flow {
  size_t count;
  dsw_volume_id *volumes;
  uint32_t *slot_of;  /* slot of every volume of the environment; kNoSlot where the cloud never comes */
  double *centre;     /* 3 doubles a slot */
  double *from_inlet; /* length of the way from the inlet */
  double *along;      /* 3 doubles a slot: unit direction away from the inlet */
  double *guide;      /* 3 doubles a slot: unit direction to the end that was chosen, kept off the wall */
  uint32_t *path;     /* slots from the inlet to that end */
  size_t path_count;
  size_t end_count; /* ends of branches, the inlet not counted */
  double length;    /* largest from_inlet */
  double radius;    /* of the lumen, roughly: three times the mean distance to the wall */
} demo_flow;

static const uint32_t kNoSlot = 0xffffffffu;

/* Returns DSW_STATUS_OK, or what a call answered. A mesh without an inlet: the widest end of all branches is taken.
 * `route`: to which end the guide and the path lead, 0 the farthest, 1 the next, ...; from end_count on, to the farthest. */
dsw_status flow_create(const dsw_environment *environment, const demo_mesh *mesh, size_t route, demo_flow *flow);
void flow_destroy(demo_flow *flow);

double distance(const double *a, const double *b);

#ifdef __cplusplus
}
#endif

#endif
