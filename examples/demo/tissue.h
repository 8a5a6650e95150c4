/* Tissue that can be cut: a volume mesh of an organ, or one made here, with air around it. */
#ifndef DARTSWEEP_DEMO_TISSUE_H
#define DARTSWEEP_DEMO_TISSUE_H

#include <dartsweep/dartsweep.h>

#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { kAirRegion = -1 }; /* its region label */

/* Makes an organ of tetrahedra, `across` cubes of six in each direction. */
void mesh_make_organ(size_t across, demo_mesh *mesh);

/* Marks all volumes impassable and surrounds them by passable ones: layers on the outer boundary, scaled from a point from which all of
 * that can be seen, out to `most` times as far. Ends the program with kBadInput where there is no such point, or a face has more than
 * four corners. The first layer ends at `*first`
 * times the distance from that point, `centre`. */
void tissue_put_in_air(dsw_environment *environment, double most, double *first, double *centre);

#ifdef __cplusplus
}
#endif

#endif
