#pragma once
// The floating-point mode of a thread that computes for us: round to nearest, denormal numbers as they are, no trap.
// The bounds of the filters and the rounding of results hold in no other mode, and each thread of a host has its own:
// a plugin rounds upwards, a program linked with -ffast-math flushes denormal numbers, a debugger asks for traps.

#include <cstdint>

#include "base/compiler.h"

#if defined(__x86_64__) || defined(_M_X64)
#include <xmmintrin.h>
#define DSW_HAS_FP_MODES 1
#elif defined(__aarch64__)
#define DSW_HAS_FP_MODES 1
#else
#define DSW_HAS_FP_MODES 0  // of what we know, WebAssembly, which has this mode alone
#endif

namespace dsw {

/** While it lives, the thread is in the default mode; afterwards it is in the mode in which it was. Reading the
 * register and comparing it is all that a thread in the default mode pays. Where modes differ on x86-64, the host's
 * exception flags come back, too: flags that we raise would mislead a handler of the host's traps.
 *
 * No compiler knows that arithmetic depends on the mode. A call that is never inlined changes the mode, so whatever is
 * read from memory after the beginning, or written to memory that others see, stays inside. */
class FpMode {
 public:
#if DSW_HAS_FP_MODES
  FpMode() noexcept : host_(read()) {
    if (is_other()) set(kDefault);
  }
  ~FpMode() {
    if (is_other()) set(host_);
  }
#else
  FpMode() noexcept {}  // not trivial, or compilers would call an object of this class unused
  ~FpMode() {}
#endif
  FpMode(const FpMode&) = delete;
  FpMode& operator=(const FpMode&) = delete;

#if DSW_HAS_FP_MODES
 private:
#if defined(__aarch64__)
  using Control = std::uint64_t;  // FPCR
  static constexpr Control kDefault = 0, kFlags = 0;
  static Control read() noexcept {
    Control control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    return control;
  }
#else
  using Control = std::uint32_t;  // MXCSR
  static constexpr Control kDefault = 0x1f80, kFlags = 0x3f;
  static Control read() noexcept { return _mm_getcsr(); }
#endif
  bool is_other() const noexcept { return (host_ & ~kFlags) != kDefault; }
  DSW_NOINLINE static void set(Control control) noexcept;

  const Control host_;
#endif
};

}  // namespace dsw
