#include "walk/short_way.h"

#include <algorithm>

#include "base/dimensions.h"
#include "predicates/filtered.h"
#include "predicates/tally.h"
#include "walk/walk.h"
#include "walk/walks.h"

namespace dsw {

template <int D>
void find_outside(const Environment<D>& env, const Cell* cells, const double* const* points, uint32_t count,
                  uint8_t* facets) noexcept {
  DSW_ASSERT(count <= kPacket);
  if (count == 0) return;
  if constexpr (D == 3) {
    walk_for(env, cells[0]).find_outside(env, cells, points, count, facets);
  } else {
    std::fill_n(facets, count, uint8_t{0});
  }
}

template <int D>
uint32_t leads_into([[maybe_unused]] const Environment<D>& env, [[maybe_unused]] Cell cell,
                    [[maybe_unused]] uint32_t facets, [[maybe_unused]] const double* const (&from)[2],
                    [[maybe_unused]] const double* to, [[maybe_unused]] Cell next,
                    [[maybe_unused]] uint32_t asked) noexcept {
  uint32_t leads = 0;
  if constexpr (D == 3) {
    const uint32_t f = lowest_bit(facets), g = highest_bit(facets);
    if ((facets & ~(1u << f | 1u << g)) != 0) return 0;
    const bool by_f = open_neighbour(env, cell, f) == next;
    if (!by_f && open_neighbour(env, cell, g) != next) return 0;
    const double* ridge[2];
    if (!shared_ridge(env, env.map.record(cell), f, g, ridge)) return 0;
    // What line_side asks, with the end as the origin: the ridge's plane with the end serves both ways.
    const filter::Vec<3> a = filter::difference<3>(ridge[0], to), b = filter::difference<3>(ridge[1], to),
                         normal = filter::cross(a, b);
    for (uint32_t i = 0; i < 2; ++i) {
      if ((asked >> i & 1) == 0) continue;
      const filter::Vec<3> way = filter::difference<3>(to, from[i]);
      const double det = filter::dot(normal, way);
      const bool certain = filter::certain(det, filter::extent(way, a, b));
      const int side = certain ? filter::sign_of(det) : line_side<3>(from[i], to, ridge, NoTally{}).sign;
      leads |= uint32_t{(side > 0) == by_f} << i;
    }
  }
  return leads;
}

DSW_INSTANTIATE(find_outside);
DSW_INSTANTIATE(leads_into);

}  // namespace dsw
