/* A catheter: a polyline that is pushed through the lumen by its tail. */
#ifndef DARTSWEEP_DEMO_CATHETER_H
#define DARTSWEEP_DEMO_CATHETER_H

#include "body.h"
#include "flow.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { kMostLinks = 1000 };

typedef struct demo_catheter {
  body_figures figures;
  dsw_scene *scene;
  dsw_body_id body;
  /* From the tail to the tip: vertices, where they are, whether they were inserted by a response; length of each link
   * towards the next one. */
  size_t count;
  dsw_body_vertex_id vertex[kMostLinks];
  double at[3 * kMostLinks], inserted[kMostLinks], rest[kMostLinks];
  double entry[3], link, reached, whole; /* how far along the way from the inlet the tip came, and how long that is */
} demo_catheter;

/* Pushes a catheter in for so many steps; `edge_response` is what its edges do at the wall, its vertices slide. */
void catheter_run(demo_catheter *catheter, dsw_environment *environment, const demo_flow *flow, const char *name,
                  dsw_response edge_response, size_t steps, FILE *csv);
void catheter_destroy(demo_catheter *catheter);

#ifdef __cplusplus
}
#endif

#endif
