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
  dsw_move_options options;
  double entry[3], link, reached, whole; /* how far along the way from the inlet the tip came, and how long that is */
} demo_catheter;

/* Puts a catheter of one link into the inlet; `edge_response` is what its edges do at the wall, its vertices slide. The scene
 * becomes its own. */
void catheter_create(demo_catheter *catheter, dsw_scene *scene, const demo_flow *flow, const char *name,
                     dsw_response edge_response);

/* Pushes it in by `reach`; `keep`: its contacts are kept for the files. */
void catheter_step(demo_catheter *catheter, const demo_flow *flow, double reach, int keep, FILE *csv);

/* Reads where its vertices are, as after a push by the wall. */
void catheter_read_places(demo_catheter *catheter);

/* Creates a scene and a catheter in it, and pushes it in for so many steps. */
void catheter_run(demo_catheter *catheter, dsw_environment *environment, const demo_flow *flow, const char *name,
                  dsw_response edge_response, size_t steps, FILE *csv);
/* Writes catheter_NAME.vtu and its contacts. Returns 0 or kBadInput. */
int catheter_write(const demo_catheter *catheter, const char *out);
void catheter_destroy(demo_catheter *catheter);

#ifdef __cplusplus
}
#endif

#endif
