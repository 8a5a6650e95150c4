#include "walk/walk.h"

#include "base/dimensions.h"

namespace dsw {
namespace counted {
#include "walk/walk.inl"
}  // namespace counted

template <int D>
void walk_counted(const Environment<D>& env, const CastRequest* requests, uint32_t count, CastResult* results,
                  CastCounters* counters) noexcept {
  counted::Walkers<D, CountAll>(env, requests, results, {counters}).run(count);
  counters->casts += count;
  for (uint32_t i = 0; i < count; ++i) counters->volumes_visited += results[i].volumes_visited;
}
DSW_INSTANTIATE(walk_counted);

}  // namespace dsw
