#include "environment/moving.h"

#include "base/dimensions.h"
#include "environment/local_points.h"

namespace dsw {

template <int D>
void let_points_move(Environment<D>& env) {
  if (env.checked.active()) return;
  env.checked.activate(env.map.index_count());
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
