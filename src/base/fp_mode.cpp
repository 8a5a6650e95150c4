#include "base/fp_mode.h"

namespace dsw {

#if defined(__aarch64__)
void FpMode::set(Control control) noexcept { __asm__ volatile("msr fpcr, %0" : : "r"(control) : "memory"); }
#elif DSW_HAS_FP_MODES
void FpMode::set(Control control) noexcept { _mm_setcsr(control); }
#endif

}  // namespace dsw
