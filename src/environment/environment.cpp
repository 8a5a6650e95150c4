#include "environment/environment.h"

#include <cmath>

namespace dsw {

template <int D>
void centre(const Environment<D>& env, Cell c, double* out) {
  const uint32_t n = env.map.vertices_of(c);
  const double count = n;
  double sum[D] = {};
  for (uint32_t i = 0; i < n; ++i) {
    const double* const p = env.point(c, i);
    for (int k = 0; k < D; ++k) sum[k] += p[k];
  }
  for (int k = 0; k < D; ++k) {
    if (__builtin_expect(!std::isfinite(sum[k]), 0)) {
      sum[k] = 0;
      for (uint32_t i = 0; i < n; ++i) sum[k] += env.point(c, i)[k] / count;
      out[k] = sum[k];
    } else {
      out[k] = sum[k] / count;
    }
  }
}

template void centre(const Environment<2>&, Cell, double*);
template void centre(const Environment<3>&, Cell, double*);

}  // namespace dsw
