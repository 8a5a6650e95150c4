/** @file dartsweep.h All headers of Dartsweep: exact contacts of moving points, edges and surfaces
 * with a volume mesh. base.h says what all functions share, the end of this file what changes in
 * the plane. */
#ifndef DARTSWEEP_DARTSWEEP_H
#define DARTSWEEP_DARTSWEEP_H

#include "dartsweep/base.h"
#include "dartsweep/body.h"
#include "dartsweep/carve.h"
#include "dartsweep/coarsen.h"
#include "dartsweep/contact.h"
#include "dartsweep/context.h"
#include "dartsweep/cross_check.h"
#include "dartsweep/deform.h"
#include "dartsweep/detach.h"
#include "dartsweep/environment.h"
#include "dartsweep/ids.h"
#include "dartsweep/marking.h"
#include "dartsweep/move.h"
#include "dartsweep/near.h"
#include "dartsweep/pairs.h"
#include "dartsweep/particle.h"
#include "dartsweep/query.h"
#include "dartsweep/record.h"
#include "dartsweep/remesh.h"
#include "dartsweep/scene.h"
#include "dartsweep/snapshot.h"
#include "dartsweep/surgery.h"
#include "dartsweep/sweep.h"
#include "dartsweep/together.h"
#include "dartsweep/topology.h"
#include "dartsweep/trace.h"

/* In the plane
 *
 * With `dimension` 2 the headers read so (more: bindings/docs/plane.md):
 *  - Volumes are polygons with counter-clockwise corners. Faces are their sides: face i runs from
 *    corner i to the next.
 *  - Points have 2 doubles. Third numbers in structs are 0. The shift is (e, e^2). x and y of a
 *    rotation are 0.
 *  - In topology.h an edge id names a side, by the numbers of its face id. Elsewhere there are no
 *    edges.
 *  - DSW_STATUS_UNSUPPORTED: coarsen.h, remesh.h, detach.h, cross_check.h, edges elsewhere,
 *    dsw_environment_merge_faces, dsw_environment_split_face, faces of bodies, DSW_LEVEL_FACES,
 *    DSW_BODY_SKIP_BACK_EDGES, DSW_INVALID_REMESH.
 *  - Edges of bodies meet vertices (DSW_CONTACT_VERTEX) instead of edges, also marked vertices.
 *    `contact.obstacle` is that vertex; the normal is that of the edge.
 *  - dsw_environment_split_volume takes 2 corners that no side joins; the first part is left of the
 *    way between them.
 *  - A blade has 1 column: the path of a point, with its front on the right.
 *  - Shapes of carve.h are bounded by segments. A vessel is tied along a line from wall to wall.
 */

#endif
