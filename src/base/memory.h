#pragma once
// Memory through the host's hooks, and arrays in it.

#include "base/allocator.h"
#include "base/array.h"
