#include "environment/local_points.h"

#include <limits>

#include "map/integrity.h"

namespace dsw {

void keep_local_points(Environment<3>& env) {
  env.local_points.assign(env.map.words.size(), 0.0f);
  for_each_cell(env.map, [&](Cell c) {
    if (env.map.form(c) != Form::kGeneral) return;
    const uint32_t count = env.map.vertices_of(c), units = record_units(env.map, env.map.record(c)[0]);
    float* const out = env.local_points.data() + size_t{c.unit} * kUnitWords;
    if (count > kMostLocalPoints || 3 * count > units * kUnitWords) {
      *out = std::numeric_limits<float>::infinity();
      return;
    }
    const double* const origin = env.point(c, 0);
    for (uint32_t v = 0; v < count; ++v) {
      for (uint32_t k = 0; k < 3; ++k) out[k * count + v] = static_cast<float>(env.point(c, v)[k] - origin[k]);
    }
  });
}

}  // namespace dsw
