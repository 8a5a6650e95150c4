#include "environment/environment.h"

#include "base/dimensions.h"

namespace dsw {

template <int D>
void centre(const Environment<D>& env, Cell c, double* out) {
  const uint32_t* const w = env.map.record(c);
  if (D == 3 &&
      form_of(w[0]) == Form::kBox) {  // which most large environments are made of: no form is asked eight times
    return mean_point<D>(
        8, [&](uint32_t i) { return env.point(w[kUnitWords<3> + i]); }, out);
  }
  mean_point<D>(
      env.map.vertices_of(c), [&](uint32_t i) { return env.point(c, i); }, out);
}

DSW_INSTANTIATE(centre);

}  // namespace dsw
