#include "environment/environment.h"

namespace dsw {

template <int D>
void centre(const Environment<D>& env, Cell c, double* out) {
  mean_point<D>(
      env.map.vertices_of(c), [&](uint32_t i) { return env.point(c, i); }, out);
}

template void centre(const Environment<2>&, Cell, double*);
template void centre(const Environment<3>&, Cell, double*);

}  // namespace dsw
