/* A mesh as an environment whose lumen is closed off. */
#ifndef DARTSWEEP_DEMO_LUMEN_H
#define DARTSWEEP_DEMO_LUMEN_H

#include <dartsweep/dartsweep.h>

#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Both end the program with a message when a call fails. */
dsw_environment *create_environment(dsw_context *context, const demo_mesh *mesh);

/* Makes the wall impassable: faces between the lumen and any other region, or those that the mesh names. Returns how many. */
size_t mark_wall(dsw_environment *environment, const demo_mesh *mesh);

#ifdef __cplusplus
}
#endif

#endif
