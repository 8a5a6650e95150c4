#pragma once
// What arithmetic has to be for signs to be right and for bits to be the same everywhere: that of IEEE 754, each
// operation rounded once to its type. A compiler that was told otherwise is refused here. Options that no macro shows
// are refused, and undone, by cmake/floating_point.cmake.

#include <cfloat>
#include <limits>

#if defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error "Dartsweep can't be compiled with -ffast-math, -Ofast or /fp:fast: signs would be wrong"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ == 1
#error "Dartsweep can't be compiled with -ffinite-math-only: it tells finite numbers from others"
#endif
#if !defined(FLT_EVAL_METHOD) || FLT_EVAL_METHOD != 0
#error "Dartsweep needs double arithmetic that is rounded to double: on x86 use -msse2 -mfpmath=sse"
#endif

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53);
static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<float>::digits == 24);
