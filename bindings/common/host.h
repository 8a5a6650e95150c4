// The C++ interface as bindings use it: every call takes a lock, since the threads of a host call as they like.
#pragma once

#define DARTSWEEP_LOCKS
#include "dartsweep/dartsweep.hpp"
