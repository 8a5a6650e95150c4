#include "walk/walk.h"

#include "base/compiler.h"

#if DSW_X86_64

DSW_UNSET_REGISTERS
DSW_BEGIN_TARGET("avx2,avx512f,avx512vl,avx512dq")

#define DSW_ISA_AVX512 1
namespace dsw {
namespace avx512 {
#include "walk/walk.inl"
}  // namespace avx512

constexpr Walk<3> kAvx512Walk = avx512::kThisWalk<3>;

}  // namespace dsw

DSW_END_TARGET

#endif
