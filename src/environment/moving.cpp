#include "environment/moving.h"

#include "base/dimensions.h"
#include "environment/local_points.h"

namespace dsw {

template <int D>
void let_points_move(Environment<D>& env) {
  if (env.checked.active()) return;
  Map<D>& map = env.map;
  env.checked.activate(map.index_count());
  for_each_cell(map, [&](Cell c) {
    if (map.form(c) != Form::kSimplex) map.record(c)[0] &= ~kConvexBit;
  });
  drop_local_points(env);
}

template <int D>
void release_owned_points(Environment<D>& env) noexcept {
  if (env.points == env.owned_points.data()) return;
  Array<double>(env.owned_points.get_allocator()).swap(env.owned_points);
}

DSW_INSTANTIATE(release_owned_points);
DSW_INSTANTIATE(let_points_move);

}  // namespace dsw
