/** @file dartsweep.h
 * All of Dartsweep: exact contacts of moving vertices and edges with a convex subdivision of space.
 */
#ifndef DARTSWEEP_DARTSWEEP_H
#define DARTSWEEP_DARTSWEEP_H

#include "dartsweep/base.h"
#include "dartsweep/body.h"
#include "dartsweep/carve.h"
#include "dartsweep/coarsen.h"
#include "dartsweep/contact.h"
#include "dartsweep/contact_check.h"
#include "dartsweep/context.h"
#include "dartsweep/deform.h"
#include "dartsweep/detach.h"
#include "dartsweep/environment.h"
#include "dartsweep/ids.h"
#include "dartsweep/marking.h"
#include "dartsweep/move.h"
#include "dartsweep/particle.h"
#include "dartsweep/query.h"
#include "dartsweep/record.h"
#include "dartsweep/remesh.h"
#include "dartsweep/scene.h"
#include "dartsweep/snapshot.h"
#include "dartsweep/surgery.h"
#include "dartsweep/sweep.h"
#include "dartsweep/topology.h"
#include "dartsweep/trace.h"

#endif
