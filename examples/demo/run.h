/* What moves: a cloud and a chain, how they move, and the proof that they went through nothing. */
#ifndef DARTSWEEP_DEMO_RUN_H
#define DARTSWEEP_DEMO_RUN_H

#include <dartsweep/dartsweep.h>

#include "flow.h"
#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { kChain = 20, kFailed = 1, kBadInput = 2 };

/* What moves: the cloud first, then the chain, its tip last. */
typedef struct demo_run {
  dsw_environment *environment;
  dsw_scene *scene;
  demo_flow flow;
  size_t cloud, count;
  dsw_particle_id *ids;
  double *position, *target, *moved, *last_normal, *contacts; /* contacts: how many, as doubles for the files */
  double *touch, *touch_normal;                               /* contacts of the last steps */
  size_t touch_count, touch_capacity;
  dsw_flight *flight, *proof;
  dsw_volume_id *volume;
  double rest; /* length of a link of the chain */
  size_t edge_casts, edge_contacts, wrong_moves, wrong_places;
  double move_seconds;
} demo_run;

/* Ends the program with the library's message unless `status` is OK. */
void require(dsw_status status, const char *what, int exit_code);

/* Places cloud and chain in the lumen and creates their particles. The environment must outlive the run. */
void create_run(demo_run *run, dsw_environment *environment, const demo_mesh *mesh, size_t cloud);
void destroy_run(demo_run *run);

/* Moves everything `steps` times; every move is cast again, every last place is found again. */
void drive(demo_run *run, size_t steps);

#ifdef __cplusplus
}
#endif

#endif
