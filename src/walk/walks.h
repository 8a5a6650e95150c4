#pragma once
// Which walk a cast is given.

#include "base/compiler.h"
#include "walk/walk.h"

namespace dsw {

// The walks that this library has; a kernel that it does not have is never chosen.
inline constexpr const Walk<3>* kSpaceWalks[] = {
    &kPortableWalk,
#if DSW_X86_64
    &kAvx2Walk,
    &kAvx512Walk,
#endif
};

/** The walk that is fastest in cells like this one. */
template <int D>
const Walk<D>& walk_for(const Environment<D>& env, Cell cell) noexcept {
  if constexpr (D == 2)
    return kPlaneWalk;
  else
    return *kSpaceWalks[static_cast<uint32_t>(env.kernels->of(env.map.kind_bits(cell)))];
}

}  // namespace dsw
