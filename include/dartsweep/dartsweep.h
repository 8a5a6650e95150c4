/** @file dartsweep.h All headers of Dartsweep: exact contacts of moving points, edges and surfaces
 * with a volume mesh. base.h says what all share, the end of this file what changes in the
 * plane. */
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
#include "dartsweep/rays.h"
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
 * With `dimension` 2 volumes are polygons with counter-clockwise corners, and faces are their
 * sides: face i runs from corner i to the next. Points have 2 doubles; third numbers in structs are
 * 0. The shift is (e, e^2). There are no edges but in topology.h, where an edge id names a side.
 * Bodies meet vertices instead of edges. A blade has 1 column: the path of a point, with its front
 * on the right. coarsen.h, remesh.h, detach.h, cross_check.h, edges elsewhere and faces of bodies
 * answer DSW_STATUS_UNSUPPORTED. More: bindings/docs/plane.md.
 */

#endif
