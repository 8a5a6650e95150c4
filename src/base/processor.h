#pragma once
// What this processor can run. Of a function with several forms the fastest is chosen once; all give the same bits.

namespace dsw {

#if defined(__x86_64__)
inline bool has_avx2() noexcept {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2");
}
inline bool has_avx2_and_fma() noexcept { return has_avx2() && __builtin_cpu_supports("fma"); }
inline bool has_avx512() noexcept {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#endif

}  // namespace dsw
