/* A soft closed surface: gravity, damping and shape matching (Mueller, Heidelberger, Teschner, Gross 2005) make targets; the
 * library says how far each vertex comes, and its velocity is what it made of that. */
#ifndef DARTSWEEP_DEMO_SOFT_H
#define DARTSWEEP_DEMO_SOFT_H

#include "body.h"
#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct demo_soft {
  body_figures figures;
  dsw_scene *scene;
  dsw_body_id body;
  demo_surface *surface;              /* its points follow the body */
  double *shape, *velocity, *targets; /* where the vertices were at rest; how fast they are; where they should go */
  double *touched, *weight;           /* contacts of each vertex; how much it counts for the shape */
  double rotation[4];                 /* of the shape, a quaternion x, y, z, w */
} demo_soft;

/* A body at level FACES where the surface is. */
dsw_status soft_create_body(const demo_surface *surface, dsw_scene *scene, dsw_body_id *body);

/* The surface, borrowed, becomes a body of the scene. A status that is not OK is for the caller to report. */
dsw_status soft_create(demo_soft *soft, dsw_scene *scene, demo_surface *surface, const char *name);

/* One step of its motion; `keep`: its contacts are kept for the files. */
void soft_step(demo_soft *soft, double gravity, int keep, FILE *csv);

/* Reads where the vertices are, as after a push by a wall. */
void soft_read_places(demo_soft *soft);

/* Frees what it holds; the body goes with its scene. */
void soft_destroy(demo_soft *soft);

#ifdef __cplusplus
}
#endif

#endif
