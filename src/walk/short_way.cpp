#include "walk/short_way.h"

#include <algorithm>

#include "base/dimensions.h"
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
bool leads_into([[maybe_unused]] const Environment<D>& env, [[maybe_unused]] Cell cell,
                [[maybe_unused]] uint32_t facets, [[maybe_unused]] const double* from,
                [[maybe_unused]] const double* to, [[maybe_unused]] Cell next) noexcept {
  if constexpr (D == 3) {
    const uint32_t f = lowest_bit(facets), g = highest_bit(facets);
    if ((facets & ~(1u << f | 1u << g)) != 0) return false;
    const bool by_f = open_neighbour(env, cell, f) == next;
    if (!by_f && open_neighbour(env, cell, g) != next) return false;
    const double* ridge[2];
    if (!shared_ridge(env, env.map.record(cell), f, g, ridge)) return false;
    return (line_side<3>(from, to, ridge, NoTally{}).sign > 0) == by_f;
  } else {
    return false;
  }
}

DSW_INSTANTIATE(find_outside);
DSW_INSTANTIATE(leads_into);

}  // namespace dsw
