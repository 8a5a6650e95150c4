/* What the scenes share whose environment changes: figures of the changes, a deformation, the proof after each step. */
#ifndef DARTSWEEP_DEMO_CHANGES_H
#define DARTSWEEP_DEMO_CHANGES_H

#include "body.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct change_figures {
  const char *name;
  size_t volumes; /* of the environment at the end */
  size_t steps, contacts, pushed, held;
  size_t body_vertices, moves, body_contacts; /* of all bodies in it */
  size_t met;                                 /* contacts of bodies with bodies */
  size_t proofs, wrong;                       /* how often bodies were looked at, and how often one was not free */
  int sound;                                  /* all volumes are valid, and a partition, at the end */
  double seconds, slowest;                    /* of the calls that change the environment */
  double move_seconds;                        /* of the calls that move bodies */
} change_figures;

/* Adds one change of the environment that took so long. */
void changes_add(change_figures *figures, double seconds);

/* Takes the environment of a scene to `next`, as dsw_environment_deform; walls push. Wall contacts are kept in `touched` if it is not
 * null. */
void changes_deform(change_figures *figures, dsw_scene *scene, double *next, size_t point_count, body_figures *touched);

/* Proves that a body is free: it is taken down to level POINTS and up again, which the library checks; and each of its edges is
 * cast through the environment, from the volume of one end to that of the other. */
void changes_prove(change_figures *figures, body_figures *moves, dsw_scene *scene, dsw_body_id body);

/* Adds what a body did in all. */
void changes_add_body(change_figures *figures, const body_figures *moves, size_t vertices);

/* Looks at all volumes of the environment. */
void changes_end(change_figures *figures, const dsw_environment *environment);

#ifdef __cplusplus
}
#endif

#endif
