/* The cloud: how it moves, and the proof that it went through nothing. */
#ifndef DARTSWEEP_DEMO_RUN_H
#define DARTSWEEP_DEMO_RUN_H

#include <dartsweep/dartsweep.h>

#include "base.h"
#include "flow.h"
#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct demo_run {
  dsw_environment *environment;
  dsw_scene *scene;
  demo_flow flow;
  size_t cloud; /* how many */
  dsw_particle_id *ids;
  double *position, *target, *moved, *last_normal, *contacts; /* contacts: how many, as doubles for the files */
  double *touch, *touch_normal;                               /* contacts of the last steps */
  size_t touch_count, touch_capacity;
  dsw_flight *flight, *proof;
  dsw_volume_id *volume;
  size_t wrong_moves, wrong_places;
  double move_seconds;
} demo_run;

/* Places the cloud in the lumen and creates its particles. The environment must outlive the run. */
void create_run(demo_run *run, dsw_environment *environment, const demo_mesh *mesh, size_t cloud);
void destroy_run(demo_run *run);

/* Moves everything `steps` times; every move is cast again, every last place is found again. */
void drive(demo_run *run, size_t steps);

#ifdef __cplusplus
}
#endif

#endif
