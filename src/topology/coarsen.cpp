#include "topology/coarsen.h"

#include "environment/builder.h"
#include "environment/local_points.h"
#include "topology/rebuild.h"

namespace dsw {
namespace {

/** Area of all facets that can be passed: how many of them a random segment crosses is in proportion to it. */
double passable_area(const Environment<3>& env, double scale) {
  double sum = 0;
  for_each_cell(env.map, [&](Cell c) {
    const Shape shape = env.map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = env.map.half_facet(c, f);
      if (canonical(env.map, h) != h || is_impassable(env.map, h)) continue;
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        const double* points[3];
        simplex_points(env, c, shape, s, points);
        sum += scaled_area(points, scale);
      }
    }
  });
  return sum / scale / scale;
}

}  // namespace

void coarsen(const Environment<3>& source, const CoarsenOptions& options, Environment<3>& target,
             Array<uint32_t>& new_index, CoarsenReport& report) {
  Merging merging(source);
  merging.run(options);
  rebuild(source, merging, target, new_index);
  finish_topology(target, nullptr);
  target.index.set_use(source.index.use());
  if (target.index.use() == TreeUse::kAtOnce) target.index.build(target);
  keep_local_points(target);
  report.trials = merging.trials();
  report.complete = merging.complete();
  report.area_before = passable_area(source, merging.scale());
  report.area_after = passable_area(target, merging.scale());
}

}  // namespace dsw
