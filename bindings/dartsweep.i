// The one interface that all languages share. A language runs SWIG on this file, with its own folder first on the path of
// includes: there it keeps typemaps.i, how arrays, ids and errors look to it. README.md says what has to be in it.
%module(directors="1") dartsweep

%{
#include "common/host.h"
%}

%include <stdint.i>

%include "common/elements.i"
%include "common/structs.i"
%include "common/names.i"

%include "typemaps.i"

// Types and constants of the C interface. Its functions are left out: hosts call the methods of the classes below.
%include "dartsweep/base.h"
%include "dartsweep/ids.h"
%include "dartsweep/context.h"
%include "dartsweep/contact.h"
%include "dartsweep/cross_check.h"
%include "dartsweep/environment.h"
%include "dartsweep/query.h"
%include "dartsweep/sweep.h"
%include "dartsweep/marking.h"
%include "dartsweep/topology.h"
%include "dartsweep/surgery.h"
%include "dartsweep/carve.h"
%include "dartsweep/remesh.h"
%include "dartsweep/coarsen.h"
%include "dartsweep/scene.h"
%include "dartsweep/particle.h"
%include "dartsweep/body.h"
%include "dartsweep/move.h"
%include "dartsweep/near.h"
%include "dartsweep/rays.h"
%include "dartsweep/pairs.h"
%include "dartsweep/deform.h"
%include "dartsweep/together.h"
%include "dartsweep/detach.h"
%include "dartsweep/snapshot.h"
%include "dartsweep/record.h"
%include "dartsweep/trace.h"

%include "dartsweep/cpp/arrays.hpp"
%include "dartsweep/cpp/results.hpp"
%include "dartsweep/cpp/handles.hpp"
%include "dartsweep/cpp/environment.hpp"
%include "dartsweep/cpp/scene.hpp"
%include "dartsweep/cpp/body.hpp"
%include "dartsweep/cpp/pairs.hpp"
%include "dartsweep/cpp/trace.hpp"
