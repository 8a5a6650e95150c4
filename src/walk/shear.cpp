#include "walk/shear.h"

namespace dsw {

size_t pass_triangles(Shear& shear, const FacetSpan<3>& triangles) noexcept {
  for (size_t n = 0; n < triangles.size(); ++n) {
    Shear::Point corners[3];
    for (int i = 0; i < 3; ++i) {
      const double x[3] = {triangles.row(i, 0)[n], triangles.row(i, 1)[n], triangles.row(i, 2)[n]};
      corners[i] = shear(x);
    }
    for (int i = 0; i < 3; ++i) {
      const Shear::Point &a = corners[i], &b = corners[(i + 1) % 3];
      if (!(Shear::side(a, b) > 0)) return n;
      shear.pass(a, b);
    }
  }
  return triangles.size();
}

PassTriangles choose_pass_triangles() noexcept {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
    return pass_triangles_avx512;
  }
  if (__builtin_cpu_supports("avx2")) return pass_triangles_avx2;
#endif
  return pass_triangles;
}

}  // namespace dsw
