#include "walk/walk.h"

#if defined(__x86_64__)

// The target holds for what is defined from here on, not for the headers above.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,avx512f,avx512vl,avx512dq"))), apply_to = function)
#else
#pragma GCC diagnostic ignored "-Wuninitialized"  // GCC 12 says it of its own intrinsics
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC push_options
#pragma GCC target("avx2,avx512f,avx512vl,avx512dq")
#endif

#define DSW_ISA_AVX512 1
namespace dsw {
namespace avx512 {
#include "walk/walk.inl"
}  // namespace avx512

Walk<3> avx512_walk() noexcept { return avx512::this_walk<3>(); }

}  // namespace dsw

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#endif
