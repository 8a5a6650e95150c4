#include "walk/cast.h"

#include <cmath>

#include "base/compiler.h"
#include "base/dimensions.h"
#include "predicates/plane_hit.h"
#include "walk/walk.h"
#include "walk/walks.h"

namespace dsw {
namespace {

template <int D>
[[maybe_unused]] bool are_finite(const CastRequest* requests, uint32_t count) noexcept {
  for (uint32_t i = 0; i < count; ++i) {
    for (int k = 0; k < D; ++k) {
      if (!std::isfinite(requests[i].from[k]) || !std::isfinite(requests[i].to[k])) return false;
    }
  }
  return true;
}

}  // namespace

template <int D>
CastResult cast(const Environment<D>& env, const CastRequest& request, CastCounters* counters) noexcept {
  CastResult result;
  cast_side_by_side(env, &request, 1, &result, counters);
  return result;
}

template <int D>
void cast_side_by_side(const Environment<D>& env, const CastRequest* requests, uint32_t count, CastResult* results,
                       CastCounters* counters) noexcept {
  DSW_ASSERT(count <= kPacket && are_finite<D>(requests, count));
  if (count == 0) return;
  if (counters == nullptr) {
    walk_for(env, requests[0].start).plain(env, requests, count, results);
  } else {
    walk_counted(env, requests, count, results, counters);
  }
}

template <int D>
bool contains(const Environment<D>& env, Cell cell, const double* point) noexcept {
  double from[D];
  centre(env, cell, from);
  return walk_for(env, cell).contains(env, cell, from, point);
}

template <int D>
bool sees_all(const Environment<D>& env, Cell cell, const double* point, CastCounters* counters) noexcept {
  if (counters != nullptr && (D == 2 || env.map.form(cell) == Form::kBox)) {
    counters->orientation_tests += D == 2 ? env.map.facets_of(cell) : 12;
  }
  return walk_for(env, cell).sees_all(env, cell, point);
}

template <int D>
bool admits_with_centre(const Environment<D>& env, Cell cell, double* centre) noexcept {
  return walk_for(env, cell).admits_with_centre(env, cell, centre);
}

template <int D>
double crossing_time(const Environment<D>& env, Cell cell, uint32_t simplex, const double* from,
                     const double* to) noexcept {
  const double* points[D];
  boundary_points(env, cell, simplex, points);
  return crossing_time<D>(from, to, points);
}

template CastResult cast(const Environment<2>&, const CastRequest&, CastCounters*) noexcept;
template CastResult cast(const Environment<3>&, const CastRequest&, CastCounters*) noexcept;
DSW_INSTANTIATE(cast_side_by_side);
DSW_INSTANTIATE(contains);
DSW_INSTANTIATE(sees_all);
DSW_INSTANTIATE(admits_with_centre);
template double crossing_time(const Environment<2>&, Cell, uint32_t, const double*, const double*) noexcept;
template double crossing_time(const Environment<3>&, Cell, uint32_t, const double*, const double*) noexcept;

}  // namespace dsw
