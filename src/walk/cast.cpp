#include "walk/cast.h"

#include <cmath>

#include "base/dimensions.h"
#include "base/processor.h"
#include "predicates/plane_hit.h"
#include "walk/walk.h"

namespace dsw {
namespace {

template <int D>
Walk<D> choose_walk() noexcept {
#if defined(__x86_64__)
  if constexpr (D == 3) {
    if (has_avx512()) return avx512_walk();
    if (has_avx2()) return avx2_walk();
  }
#endif
  return portable_walk<D>();
}

template <int D>
const Walk<D> kWalk = choose_walk<D>();

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
  if (counters == nullptr) {
    kWalk<D>.plain(env, requests, count, results);
  } else {
    kWalk<D>.counted(env, requests, count, results, counters);
  }
}

template <int D>
bool contains(const Environment<D>& env, Cell cell, const double* point) noexcept {
  double from[D];
  centre(env, cell, from);
  return kWalk<D>.contains(env, cell, from, point);
}

template <int D>
bool sees_all(const Environment<D>& env, Cell cell, const double* point, CastCounters* counters) noexcept {
  if (counters != nullptr && (D == 2 || env.map.form(cell) == Form::kBox)) {
    counters->orientation_tests += D == 2 ? env.map.facets_of(cell) : 12;
  }
  return kWalk<D>.sees_all(env, cell, point);
}

template <int D>
bool admits_with_centre(const Environment<D>& env, Cell cell, double* centre) noexcept {
  return kWalk<D>.admits_with_centre(env, cell, centre);
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
