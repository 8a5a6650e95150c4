/* What the scenes with bodies share: figures of their moves, contacts of the last steps, a table of the steps. */
#ifndef DARTSWEEP_DEMO_BODY_H
#define DARTSWEEP_DEMO_BODY_H

#include <dartsweep/dartsweep.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct body_figures {
  const char *name;
  size_t steps, moved, stopped, contacts, lasting, inserted, removed,
      wrong; /* wrong: edges found not free afterwards */
  double seconds, slowest;
  double *touch, *normal; /* contacts of the last steps, 3 doubles each */
  size_t touch_count, touch_capacity;
} body_figures;

void figures_create(body_figures *figures, const char *name);
void figures_destroy(body_figures *figures);

/* Keeps a contact for the files. */
void figures_touch(body_figures *figures, const double *point, const double *normal);

/* Adds what a move of a body did, and a line to `csv` if it is not null. `keep`: also its contacts. */
void figures_add(body_figures *figures, const dsw_scene *scene, dsw_body_id body, const dsw_move_report *report,
                 double seconds, int keep, FILE *csv);

/* Casts every edge of a body through the environment alone: each must be free, and end in the volume of its end. */
void prove_edges(body_figures *figures, const dsw_scene *scene, dsw_body_id body);

/* Writes the heading of the table of steps. Null when the file cannot be made; null folder: no table. */
FILE *open_steps(const char *folder);

#ifdef __cplusplus
}
#endif

#endif
