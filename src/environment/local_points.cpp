#include "environment/local_points.h"

#include "map/integrity.h"

namespace dsw {

void keep_local_points(Environment<3>& env) {
  // The end has room to spare: a reader that has not yet seen that a cell does not fit reads as much as for a cell that
  // does.
  env.local_points.assign(env.map.words.size() + kOriginWords + 3 * kMostLocalPoints, 0.0f);
  for_each_cell(env.map, [&](Cell c) {
    if (env.map.form(c) != Form::kGeneral) return;
    const uint32_t count = env.map.vertices_of(c), units = record_units(env.map, env.map.record(c)[0]);
    float* out = env.local_points.data() + size_t{c.unit} * kUnitWords<3>;
    const bool fits = count <= kMostLocalPoints && kOriginWords + 3 * (count - 1) <= units * kUnitWords<3>;
    constexpr double kNone[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    const double* const origin = env.point(c, 0);
    std::memcpy(out, fits ? origin : kNone, sizeof kNone);
    out += kOriginWords;
    for (uint32_t k = 0; fits && k < 3; ++k) {
      for (uint32_t v = 1; v < count; ++v) *out++ = static_cast<float>(env.point(c, v)[k] - origin[k]);
    }
  });
}

}  // namespace dsw
