#include "walk/walk.h"

#include "base/target.h"

#if defined(__x86_64__)

DSW_BEGIN_TARGET("avx2")

#define DSW_ISA_AVX2 1
namespace dsw {
namespace avx2 {
#include "walk/walk.inl"
}  // namespace avx2

Walk<3> avx2_walk() noexcept { return avx2::this_walk<3>(); }

}  // namespace dsw

DSW_END_TARGET

#endif
