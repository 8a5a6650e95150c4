#include "walk/walk.h"

#if defined(__x86_64__)

// The target holds for what is defined from here on, not for the headers above.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif

#define DSW_ISA_AVX2 1
namespace dsw {
namespace avx2 {
#include "walk/walk.inl"
}  // namespace avx2

Walk<3> avx2_walk() noexcept { return avx2::this_walk<3>(); }

}  // namespace dsw

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#endif
