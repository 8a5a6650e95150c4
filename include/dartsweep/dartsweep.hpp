// The C++17 interface, header-only over the C functions: handles that destroy themselves, spans as
// arguments, an exception for each status. The C headers are its manual: a method does what the C
// function of its name does. No source is added to a program, and the ABI is that of C.
#pragma once

#include "dartsweep/cpp/body.hpp"
#include "dartsweep/cpp/environment.hpp"
#include "dartsweep/cpp/pairs.hpp"
#include "dartsweep/cpp/scene.hpp"
#include "dartsweep/cpp/trace.hpp"
