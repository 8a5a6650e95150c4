#include "motion/shear.h"

namespace dsw {

void pass_triangles(Shear& shear, const double* points, const Triangle* triangles, size_t count) noexcept {
  for (size_t n = 0; n < count; ++n) {
    const uint32_t(&corners)[3] = triangles[n].corners;
    const Shear::Point a = shear(points + size_t{corners[0]} * 3), b = shear(points + size_t{corners[1]} * 3),
                       c = shear(points + size_t{corners[2]} * 3);
    shear.pass(a, b);
    shear.pass(b, c);
    shear.pass(c, a);
  }
}

PassTriangles choose_pass_triangles() noexcept {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2")) return pass_triangles_avx2;
#endif
  return pass_triangles;
}

}  // namespace dsw
