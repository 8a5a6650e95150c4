#include "environment/environment.h"

#include <cmath>

namespace dsw {

template <int D>
void centre(const Environment<D>& env, Cell c, double* out) {
  const uint32_t n = env.map.vertices_of(c);
  const double count = n;
  for (int k = 0; k < D; ++k) {
    double sum = 0;
    for (uint32_t i = 0; i < n; ++i) sum += env.point(c, i)[k];
    if (std::isfinite(sum)) {
      out[k] = sum / count;
    } else {
      sum = 0;
      for (uint32_t i = 0; i < n; ++i) sum += env.point(c, i)[k] / count;
      out[k] = sum;
    }
  }
}

template void centre(const Environment<2>&, Cell, double*);
template void centre(const Environment<3>&, Cell, double*);

}  // namespace dsw
