#include "walk/walk.h"

#include "base/compiler.h"

#if DSW_X86_64

DSW_BEGIN_TARGET("avx2")

#define DSW_ISA_AVX2 1
namespace dsw {
namespace avx2 {
#include "walk/walk.inl"
}  // namespace avx2

constexpr Walk<3> kAvx2Walk = avx2::kThisWalk<3>;

}  // namespace dsw

DSW_END_TARGET

#endif
